"""General position: what touches comes apart, nothing else changes, and the answer does not depend on the frame."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement.polylines import polygon_turning_number
from plyfold.errors import CurveError, GeneralPositionError
from reference import crossings as reference
from reference.contacts import moved
from reference.crossings import cross, exact, minus

TOUCHING = {
    "vertex touches an edge": ([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], 0),
    "vertex runs through an edge": ([(0, 0), (4, 0), (4, 4), (2, 4), (2, 0), (2, -2), (1, -2), (1, 4), (0, 4)], 2),
    "three edges through one point": (
        [(-1, -1), (1, 1), (2, 1), (2, -1), (1, -1), (-1, 1), (-2, 1), (-2, 0), (3, 0)],
        6,
    ),
    "two strands in opposite directions": ([(0, 0), (4, 0), (4, 2), (2, 2), (2, 0), (0, 0), (0, 4), (-4, 4)], 0),
    "a square run through twice": ([(0, 0), (4, 0), (4, 4), (0, 4)] * 2, 1),
    "two corners touch": ([(0, 0), (2, 2), (4, 0), (4, 4), (2, 2), (0, 4)], 0),
}


@pytest.mark.parametrize("name", TOUCHING)
def test_strands_come_apart(name):
    points, crossings = TOUCHING[name]
    drawn = pf.arrange(points)
    drawn.check()
    assert drawn.n_crossings == crossings
    code, _, _ = reference.crossings(drawn.curve.points.tolist())
    assert (drawn.partner.tolist(), drawn.ccw.tolist()) == (list(code.partner), list(map(bool, code.ccw)))


@pytest.mark.parametrize("name", TOUCHING)
def test_every_move_is_reported_and_small(name):
    points = np.array(TOUCHING[name][0], dtype=float)
    drawn = pf.arrange(points)
    moves = [repair for repair in drawn.curve.repairs if repair.kind == "vertex moved"]
    kept = {tuple(p) for p in points.tolist()} & {tuple(p) for p in drawn.curve.points.tolist()}
    assert moves
    assert all(0 < move.size < 1e-4 for move in moves)
    assert {move.where for move in moves} | kept == {tuple(p) for p in points.tolist()}


@pytest.mark.parametrize("name", TOUCHING)
def test_raise_names_the_places(name):
    with pytest.raises(GeneralPositionError) as caught:
        pf.arrange(TOUCHING[name][0], general_position="raise")
    assert caught.value.where
    assert "perturb" in caught.value.hint


def test_touching_place_is_the_place():
    with pytest.raises(GeneralPositionError) as caught:
        pf.arrange(TOUCHING["vertex touches an edge"][0], general_position="raise")
    assert caught.value.where == ((2.0, 0.0),)


def test_unknown_policy_is_refused():
    with pytest.raises(ValueError, match="general_position"):
        pf.arrange([(0, 0), (1, 0), (0, 1)], general_position="ignore")


def summary(points):
    drawn = pf.arrange(points)
    drawn.check()
    return drawn.n_crossings, abs(drawn.turning_number), pf.count_immersions(drawn)


grid = st.lists(st.tuples(st.integers(-2, 2), st.integers(-2, 2)), min_size=4, max_size=8)


@settings(max_examples=150, deadline=None)
@given(grid, st.integers(0, 7))
def test_the_answer_does_not_depend_on_the_frame(points, start):
    points = np.array(points, dtype=float)
    try:
        expected = summary(points)
    except CurveError:
        return
    assert summary(points * 2.0**26) == expected
    assert summary(points * 2.0**-26) == expected
    assert summary(points * 1e8) == expected
    assert summary(points + np.array([12345, -777])) == expected
    assert summary(np.roll(points, start, axis=0)) == expected
    # A curve that turns 0 times has no direction of its own, and no outside to move to.
    assert expected[1] == 0 or summary(points[::-1]) == expected


@settings(max_examples=100, deadline=None)
@given(grid)
def test_points_in_contact_move_outward(points):
    """To the right of both edges, in fractions; the others stay, and none is near where it was not."""
    try:
        drawn = pf.arrange(points)
    except CurveError:
        return
    given, goals = (list(map(tuple, outline.points.tolist())) for outline in (drawn.given, drawn.outline))
    if polygon_turning_number(drawn.given.points) == 0 or len(drawn.contacts) == 0:
        return
    assert {v for v, (p, q) in enumerate(zip(given, goals, strict=True)) if p != q} >= set(drawn.contacts.tolist())
    for v in drawn.contacts.tolist():
        before, here, after, goal = (
            exact([p])[0] for p in (given[v - 1], given[v], given[(v + 1) % len(given)], goals[v])
        )
        away = minus(goal, here)
        assert cross(minus(here, before), away) < 0
        assert cross(minus(after, here), away) < 0
        assert max(map(abs, away)) < 1e-4


@settings(max_examples=60, deadline=None)
@given(grid)
def test_the_moved_outline_shows_what_infinitely_small_moves_do(points):
    """The code of the outline in doubles is that of moves in the same directions of next to no size, in fractions."""
    try:
        drawn = pf.arrange(points)
    except CurveError:
        return
    given, goals = (exact(outline.points.tolist()) for outline in (drawn.given, drawn.outline))
    move = [minus(goal, here) for here, goal in zip(given, goals, strict=True)]
    code = reference.crossings_between(moved([given], [move])[0]).code
    assert (drawn.partner.tolist(), drawn.ccw.tolist()) == (list(code.partner), list(map(bool, code.ccw)))


@pytest.mark.parametrize("seed", range(4))
def test_crowded_grids(seed):
    """Points that lie on each other several times, and everything on edges: crossings as in fractions."""
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 5, (24, 2))
    drawn = pf.arrange(points)
    drawn.check()
    code, _, _ = reference.crossings(drawn.curve.points.tolist())
    assert (drawn.partner.tolist(), drawn.ccw.tolist()) == (list(code.partner), list(map(bool, code.ccw)))


def test_hundreds_of_points_on_a_crowded_grid():
    points = np.random.default_rng(1).integers(0, 10, (300, 2))
    drawn = pf.arrange(points)
    drawn.check()
    assert drawn.n_crossings > 5000


def test_far_from_the_origin_steps_are_as_short_as_they_can_be():
    drawn = pf.arrange(np.array(TOUCHING["two corners touch"][0]) + 2.0**44)
    assert drawn.n_crossings == 0
    assert drawn.outline.repairs


def test_no_room_between_doubles():
    """Neighbours among doubles, with a vertex between two of them: the drawing is that of points that begin to move."""
    one = 1.0 + 2**-52 * np.arange(4)
    points = [(one[0], one[0]), (one[2], one[0]), (one[2], one[2]), (one[1], one[0]), (one[0], one[2])]
    drawn = pf.arrange(points)
    drawn.check()
    assert drawn.is_begun
    code = reference.crossings_between(drawn.begun.tolist()).code
    assert (drawn.partner.tolist(), drawn.ccw.tolist()) == (list(code.partner), list(map(bool, code.ccw)))
