"""Layerings where several edges or cusps meet in one point: all sheets there lie over the point in one order."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.arrangement.ways import ways_apart
from plyfold.errors import GeneralPositionError
from reference import contacts
from reference.crossings import exact
from reference.touching_drawings import surfaces, touching_drawing
from reference.touching_layerings import count_layered_surfaces, count_layerings

# Edges through the origin, each pair of triangles over each other beside it.
THREE = [[(-6, 0), (6, 0), (1, 5)], [(3, -6), (-3, 6), (-6, -1)], [(3, 6), (-3, -6), (5, -4)]]
FOUR = [*THREE, [(6, -6), (-6, 6), (-6, -6)]]
ON_A_SQUARE = [*THREE, [(-9, -9), (9, -9), (9, 9), (-9, 9)]]
AND_A_HOLE = [*THREE[1:], THREE[0][::-1], ON_A_SQUARE[-1]]
# Two limaçons each, their cusps in one place: apart, with turns that overlap, and with an edge in common.
CUSPS_IN_ONE_PLACE = [
    ([(12, -8), (-8, 8), (-4, -4), (12, 12), (-12, 8)], 1, [(-8, 8), (-20, -8), (0, 4), (-20, 16), (4, -8)], 0),
    (
        [(-8, 12), (-8, -12), (12, 0), (0, 4), (8, -12), (8, 0)],
        5,
        [(8, 8), (0, -4), (20, 0), (4, 16), (-4, -4), (8, 0), (12, -4)],
        5,
    ),
    (
        [(8, 4), (-12, 8), (0, -12), (-4, 4), (-12, 0)],
        3,
        [(-16, 4), (-16, 0), (8, 4), (-4, 4), (4, -8), (8, 8)],
        3,
    ),
    ([(0, 12), (4, 0), (12, 12), (-4, 4), (4, 4)], 4, [(-8, 4), (0, 0), (12, 8), (0, 12), (4, 4), (0, 24)], 4),
]


def positions(loops):
    """The loops in all eight positions of the page, each time run so that the surface stays on their left."""
    for number, placed in enumerate(zip(*map(contacts.positions, loops), strict=True)):
        yield [loop[::-1] for loop in placed] if number % 2 else list(placed)


def all_lift(outline):
    """Whether all layerings lift to surfaces that do not pass through themselves."""
    for layering in pf.embeddings(outline):
        pf.lift(layering, triangles=1).check()
    return True


@pytest.mark.parametrize(("loops", "expected"), [(THREE, 6), (FOUR, 24), (ON_A_SQUARE, 24), (AND_A_HOLE, None)])
def test_edges_through_one_point(loops, expected):
    """However the edges part, all three sheets lie over a cell between them: so they never lie in a circle."""
    counts = {pf.count_embeddings(placed) for placed in positions(loops)}
    assert counts == {count_layered_surfaces([exact(loop) for loop in loops])}
    assert expected is None or counts == {expected}


def test_all_layerings_fit_the_point():
    assert all_lift(THREE)


def loop_through_the_origin(rng):
    """Four or five points on a grid with an edge through the origin; they turn once."""
    while True:
        step = rng.integers(-2, 3, 2)
        points = [-step * rng.integers(1, 4), step * rng.integers(1, 4), *rng.integers(-9, 10, (rng.integers(2, 4), 2))]
        loop = [(int(x), int(y)) for x, y in points]
        if contacts.turns(loop, 1):
            return loop


def test_loops_through_one_point_as_the_reference():
    found = set()
    for seed in range(20):
        rng = np.random.default_rng(seed)
        loops = [loop_through_the_origin(rng) for _ in range(3)]
        expected = count_layered_surfaces([exact(loop) for loop in loops])
        assert pf.count_embeddings(loops) == expected, loops
        found.add(expected)
    assert len(found) > 1


def test_what_touches_as_the_reference():
    """Where outlines bound no more as limits than as they are, they have the same layerings."""
    judged = layered = 0
    for seed in range(60):
        loops = contacts.random_touching_loops(np.random.default_rng(seed))
        drawn = pf.arrange(loops)
        as_given = touching_drawing([exact(loop.tolist()) for loop in drawn.given.loops])
        found = list(surfaces(as_given))
        if len(found) == pf.count_immersions(drawn):
            expected = sum(count_layerings(as_given, sides) for sides in found)
            assert pf.count_embeddings(drawn) == expected, loops
            judged, layered = judged + 1, layered + (expected > 1)
    assert judged > 20
    assert layered > 5


@pytest.mark.parametrize(("one", "cusp", "other", "other_cusp"), CUSPS_IN_ONE_PLACE)
def test_cusps_in_one_place(one, cusp, other, other_cusp):
    """One of them gives way; but not so that sheets come to lie in between for which there is no room."""
    marks = [[int(point == at) for point in range(len(loop))] for loop, at in ((one, cusp), (other, other_cusp))]
    expected = count_layered_surfaces([exact(one), exact(other)], marks)
    assert expected == 8
    for number, placed in enumerate(positions([one, other])):
        cusps = [mark[::-1] if number % 2 else mark for mark in marks]
        assert pf.count_embeddings(pf.Outline(placed, dict(numbered(cusps)))) == expected


def numbered(marks):
    """The cusps as outlines take them."""
    return (((i, point), turns) for i, mark in enumerate(marks) for point, turns in enumerate(mark) if turns)


def test_cusps_that_gave_way_too_far():
    """In some ways there are layerings more, that fit no single point; they are refused with the place."""
    one, cusp, other, other_cusp = CUSPS_IN_ONE_PLACE[0]
    outline = pf.Outline([one, other], {(0, cusp): 1, (1, other_cusp): 1})
    more = next(way for way in ways_apart(pf.arrange(outline)) if pf.count_embeddings(way) > 8)
    lifted = 0
    for layering in pf.embeddings(more):
        refused_at = place_of_refusal(layering)
        assert refused_at in (None, ((-8.0, 8.0),))
        lifted += refused_at is None
    assert lifted == 8


def place_of_refusal(layering):
    """Where a layering cannot be lifted; None if it can, to a surface that does not pass through itself."""
    try:
        surface = pf.lift(layering, triangles=1)
    except GeneralPositionError as error:
        return error.where
    return surface.check()
