"""Outlines that touch themselves: three answers, as many moves and gluing by definition tell, in every position."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement import unless
from plyfold.arrangement.general_position import InContact, without_contacts
from plyfold.arrangement.ways import ways_apart
from plyfold.errors import CurveError
from plyfold.immersion.obstructions import touches_as_no_disk
from plyfold.immersion.solve import nth_immersion
from plyfold.report import verdict
from reference import contacts as reference
from reference.contacts import Answer, may_bound, random_touching, without_spikes
from reference.crossings import base_visit, exact

TRIANGLES_IN_A_POINT = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
ON_A_CUT = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]
ON_A_NECK = [(0, 0), (1, 0), (1, 1), (3, 1), (3, 0), (4, 0), (4, 1), (3, 1), (1, 1), (0, 1)]
FOR_SMALL_MOVES_ALONE = [(11, 7), (8, 4), (3, 0), (11, 2), (11, 12), (2, 4), (11, 9)]
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]

# (outline, disk in the strict sense, disk that may touch itself, where it does)
KNOWN = [
    (SQUARE, True, True, ()),
    (TRIANGLES_IN_A_POINT, False, True, ((1, 1),)),
    (ON_A_CUT, True, True, ()),
    (ON_A_NECK, False, True, ((1, 1), (3, 1))),
    (FOR_SMALL_MOVES_ALONE, False, True, None),
    ([(0, 0), (2, 2), (2, 0), (0, 2)], False, False, ()),
    (SQUARE * 2, False, False, ()),
]


@pytest.mark.parametrize(("outline", "strict", "touching", "places"), KNOWN)
def test_three_answers(outline, strict, touching, places):
    found = pf.find_immersion(outline)
    assert (pf.bounds_disk(outline, touching=False), pf.bounds_disk(outline)) == (strict, touching)
    assert bool(found) == touching
    if touching and places is not None:
        assert set(found.touches) == set(places)
        assert ("touches itself" in repr(found)) == bool(places)


def answer(outline):
    """How many surfaces an outline bounds: in the strict sense, and as a limit."""
    arranged = pf.arrange(outline)
    arranged.check()
    return Answer(pf.count_immersions(next(ways_apart(arranged, inward=True))), pf.count_immersions(arranged))


def answer_or_none(polygon):
    """The same; None if nothing is left of a polygon without its spikes."""
    try:
        return answer(polygon)
    except CurveError:
        return None


def assert_as_the_reference(polygon):
    expected = reference.answer(polygon)
    assert answer_or_none(polygon) == expected, polygon
    if expected:
        touches = [immersion.touches for immersion in pf.immersions(polygon)]
        assert (len(touches), touches.count(())) == (expected.outward, expected.strict), polygon
    return expected


def test_polygons_as_the_reference():
    found = [assert_as_the_reference(random_touching(np.random.default_rng(seed), most=8)) for seed in range(100)]
    assert found.count((0, 1)) > 15
    assert found.count((1, 1)) > 5


@pytest.mark.slow
def test_more_polygons_as_the_reference():
    for seed in range(10_000, 12_000):
        assert_as_the_reference(random_touching(np.random.default_rng(seed), most=9 + 5 * (seed % 7 == 0)))


@pytest.mark.slow
def test_all_pentagons_on_the_smallest_grid():
    grid = list(product(range(3), repeat=2))
    for rest in product(grid, repeat=4):
        for first in ((0, 0), (1, 0), (1, 1)):  # every place looks like one of these from some side
            assert answer_or_none([first, *rest]) == reference.answer([first, *rest])


def in_the_direction_that_may_bound(loops, cusps=()):
    return next((way for way in reference.either_direction(loops, cusps) if may_bound(*way)), None)


def expected_of(loops, cusps=()):
    """The answer of the reference about loops without spikes."""
    directed = in_the_direction_that_may_bound(loops, cusps)
    if directed is None:
        return Answer(0, 0)
    return Answer(reference.count_strict(*directed), reference.count_outward(np.random.default_rng(0), *directed))


def test_loops_may_touch_like_one():
    found = []
    for seed in range(60):
        loops = reference.random_touching_loops(np.random.default_rng(seed))
        expected = expected_of([exact(loop) for loop in loops])
        assert answer(loops) == expected, loops
        found.append(expected)
    assert found.count((0, 0)) < 50
    assert any(strict < outward for strict, outward in found)


def test_a_loop_of_which_nothing_is_left_is_dropped():
    found = pf.arrange([SQUARE, [(1, 1), (3, 1), (3, 2), (3, 1)]])
    assert found.n_loops == 1
    assert [repair.kind for repair in found.outline.repairs][-1] == "loop of which nothing is left dropped"
    assert found.given.rows.tolist() == found.numbers.tolist() == [0, 1, 2, 3]


def test_cusps_in_contact_stay():
    outline = pf.Curve([(3, 4), (1, 2), (4, 4), (2, 4), (3, 3)], cusps={0: 1})
    arranged = pf.arrange(outline)
    vertex = arranged.numbers.tolist().index(0)
    assert arranged.outline.points[vertex].tolist() == arranged.given.points[vertex].tolist() == [3, 4]
    loops, cusps = reference.with_vertices_at_cusps([exact(outline.points.tolist())], [[1, 0, 0, 0, 0]])
    assert answer(outline) == expected_of(loops, cusps)


# The surface winds twice round the origin, from one side of a slit to the other.
CUSP_AT_A_TIP = [(0, 0), (3, 0), (3, 3), (-3, 3), (-3, -3), (5, -3), (5, 5), (-5, 5), (-5, -5), (4, -5), (4, 0)]


def test_cusps_at_tips_have_an_angle_of_a_full_turn_that_one_sees():
    turns = [1] + [0] * 10
    assert reference.count_strict([exact(CUSP_AT_A_TIP)], [turns]) == 1
    for position in reference.positions(CUSP_AT_A_TIP):
        outline = pf.Curve(position, cusps=turns)
        assert pf.bounds_disk(outline)
        assert pf.bounds_disk(outline, touching=False)
        assert pf.find_immersion(outline).touches == ()
    once_too_often = pf.Curve(CUSP_AT_A_TIP, cusps=[2, *turns[1:]])
    assert not pf.bounds_disk(once_too_often)


def test_a_cusp_at_a_tip_stays_where_its_edge_moves():
    """The other end of the edge moves, in the one direction in which it stays on a third edge; so that moves, too."""
    loops, cusps = [[(2, 0), (2, 3), (2, 4), (1, 2), (3, 4), (2, 2)], [(0, 2), (0, 3), (3, 3)]], {(0, 0): 1}
    marks = [[1, 0, 0, 0, 0, 0], [0, 0, 0]]
    assert in_the_direction_that_may_bound([exact(loop) for loop in loops], marks) is None
    arranged = pf.arrange(pf.Outline(loops, cusps))
    arranged.check()
    assert arranged.outline.points[0].tolist() == [2, 0]
    assert not pf.find_immersion(arranged)


def with_cusps(seed):
    """A polygon with cusps at different places, and the same for the reference; None if two lie at one place."""
    polygon, index = reference.random_touching_with_cusps(np.random.default_rng(seed), 1 + (seed % 4 == 0), most=8)
    places = [place for place, turns in zip(polygon, index, strict=True) if turns]
    if len(set(places)) < len(places):
        return None
    return pf.Curve(polygon, cusps=index), reference.with_vertices_at_cusps([exact(polygon)], [index])


def test_cusps_as_the_reference():
    cases = filter(None, map(with_cusps, range(60)))
    found = [(answer(curve), expected_of(*loops)) for curve, loops in cases]
    assert all(ours == expected for ours, expected in found)
    assert {(0, 0), (0, 1)} <= {expected for _, expected in found}


def test_cusps_on_each_other_give_way():
    """A disk if some move bounds one."""
    polygon, index = [(1, 0), (1, 1), (0, 0), (1, 0), (0, 1), (0, 0), (1, 1), (0, 2)], [0, 0, 1, 0, 0, 1, 0, 0]
    loops, cusps = reference.with_vertices_at_cusps([exact(polygon)], [index])
    directed = in_the_direction_that_may_bound(loops, cusps)
    some = any(reference.moves_that_bound(np.random.default_rng(0), directed[0], 60, directed[1]))
    assert pf.bounds_disk(pf.Curve(polygon, cusps=index)) == some


# Two cusps in one place, each beside the other on the same surface: whichever moves, and whereto, there is room for it.
CUSPS_BESIDE_EACH_OTHER = [
    ([(1, 2), (2, 0), (2, 3), (0, 1), (2, 1), (1, 2), (1, 0), (3, 2)], [1, 0, 0, 0, 0, 1, 0, 0]),
    ([(2, 1), (0, 2), (2, 0), (2, 2), (1, 1), (2, 1), (1, 2), (2, 0)], [1, 0, 0, 0, 0, 1, 0, 0]),
]


@pytest.mark.parametrize(("polygon", "index"), CUSPS_BESIDE_EACH_OTHER)
def test_cusps_beside_each_other_touch(polygon, index):
    """Moves inward make a disk, but there is none in the strict sense."""
    assert reference.count_strict([exact(polygon)], [index]) == 0
    for position in reference.positions(polygon):
        curve = pf.Curve(position, cusps=index)
        assert pf.bounds_disk(curve)
        assert not pf.bounds_disk(curve, touching=False)
        assert pf.find_immersion(curve).touches


# ---- what the given points tell --------------------------------------------------------------------------------------


def known_before_moves(outline):
    """Whether the given points show that an outline is no disk; None if it does not touch itself."""
    found = without_contacts(pf.Outline([outline]) if isinstance(outline, list) else outline, "perturb")
    return touches_as_no_disk(found) if isinstance(found, InContact) else None


def test_a_no_before_points_move_is_one_after_moves():
    """However they move: by the definition of limits and of strict disks, and by all outward and inward ways."""
    known = []
    for seed in range(120):
        polygon = random_touching(np.random.default_rng(seed), most=8)
        expected = reference.answer(polygon)
        known.append(expected and known_before_moves(polygon))
        assert not known[-1] or expected == (0, 0)
    for curve, loops in filter(None, map(with_cusps, range(60))):
        known.append(known_before_moves(curve))
        assert not known[-1] or expected_of(*loops) == (0, 0)
    for mirrored in reference.positions(CUSP_AT_A_TIP):
        assert not known_before_moves(pf.Curve(mirrored, cusps=[1] + [0] * 10))
    assert known.count(True) > 20
    assert known.count(False) > 20


def test_no_point_moves_where_the_given_ones_tell(monkeypatch):
    """However crowded they are."""
    monkeypatch.setattr(unless, "moved_apart", None)
    crowded = [np.random.default_rng(seed).integers(0, 8, (100, 2)) for seed in range(3)]
    both_signs = [(0, 0), (1, -1), (2, 0), (3, 1), (5, -1), (6, 0), (5, 1), (3, -1), (1, 1)]  # turns once
    assert pf.arrange(both_signs).turning_number == 1
    for points in (*crowded, SQUARE * 2, both_signs):
        for touching in (True, False):
            assert not pf.bounds_disk(points, touching=touching)


# ---- the answer belongs to the drawing -------------------------------------------------------------------------------


def numbered_from_base(immersion):
    """The borders that share a sheet, counted from the base visit; disks alone."""
    n, base = immersion.arrangement.n_borders, base_visit(immersion.arrangement.curve.points)
    return {frozenset((border - base) % n for border in group.borders) for group in immersion.disk_layout()}


def first_disk(points):
    found = pf.find_immersion(points)
    return numbered_from_base(found) if found else None


def assert_belongs_to_the_drawing(polygon, start):
    expected = answer_or_none(polygon)
    for position in reference.positions(polygon):
        assert answer_or_none(position) == expected
    if expected is None:
        return
    points = np.array(polygon, dtype=float)
    first = first_disk(points)
    turned = np.roll(points, start, axis=0)
    for changed in (turned, turned[::-1], points * 2.0**26, points * 2.0**-26, points + np.array([12345, -777])):
        assert answer(changed) == expected
        assert first_disk(changed) == first


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.integers(0, 9))
def test_answers_belong_to_the_drawing(seed, start):
    assert_belongs_to_the_drawing(random_touching(np.random.default_rng(seed), most=9), start)


GRID = st.lists(st.tuples(st.integers(-2, 2), st.integers(-2, 2)), min_size=4, max_size=9)


@settings(max_examples=60, deadline=None)
@given(GRID, st.integers(0, 9))
def test_answers_about_grid_polygons_belong_to_the_drawing(polygon, start):
    try:
        pf.Curve(polygon)
    except CurveError:
        return
    assert_belongs_to_the_drawing(polygon, start)


def test_vertices_on_edges_change_nothing():
    for seed in range(40):
        polygon = without_spikes(exact(random_touching(np.random.default_rng(seed), most=8)))
        if polygon:
            points = np.array(polygon, dtype=float)
            middles = (points + np.roll(points, -1, axis=0)) / 2
            assert answer(np.stack([points, middles], axis=1).reshape(-1, 2)) == answer(points)


STRIP_OVER_ITSELF = [(-10, 0), (10, 0), (16, 6), (10, 10), (-10, -10), (-6, -16), (0, -14), (0, 14), (1, 14)]
STRIP_OVER_ITSELF += [(1, -14.75), (-6.5, -17), (-11, -10), (10, 11), (17.5, 6), (10.5, -1), (-10, -1)]


def test_edges_through_one_point_are_no_contact():
    """A long strip, three of whose edges run through the origin, where no vertex is."""
    for outline in (STRIP_OVER_ITSELF, STRIP_OVER_ITSELF[::-1]):
        found = pf.find_immersion(outline)
        assert found.touches == ()
        assert len(found.arrangement.contacts) == 0
        assert found.arrangement.outline.repairs
        assert answer(outline) == (1, 1)


TWO_WAYS = [(-7, 1), (8, -2), (-5, -3), (-4, 9), (5, 7), (6, -2), (-7, 1), (-1, 8), (-2, 8), (6, 1), (4, -2), (-2, 8)]
TWO_WAYS += [(1, 8), (5, 0), (5, 1), (1, -1), (2, -1)]


def test_a_disk_that_does_not_touch_itself_comes_first():
    """One of the two disks touches itself; which of them is found first depends on how the drawing lies on the page."""
    for position in reference.positions(TWO_WAYS):
        for outline in (position, position[::-1], position[5:] + position[:5]):
            listed = list(pf.immersions(outline))
            assert [len(immersion.touches) for immersion in listed] == [0, 2]
            assert pf.bounds_disk(outline, touching=False)
            for number, immersion in enumerate(listed):
                assert nth_immersion(outline, number).own_sheet.tolist() == immersion.own_sheet.tolist()
            assert pf.find_immersion(outline).own_sheet.tolist() == listed[0].own_sheet.tolist()
            assert len(pf.triangulate(outline)) == len(outline) - 2
            figures = verdict(pf.arrange(outline))
            assert (figures["touches"], figures["euler_characteristic"], len(figures["pieces"])) == ([], 1, 1)


def test_cusps_are_told_by_the_points_that_came_in_and_as_one_sees_them():
    repeated = pf.Curve([(0, 0), (0, 0), (9, 0), (9, 9), (0, 9)], (), [0, 0, 0, 1, 0])
    assert "No cusp of index 1 can be at point 3: it needs 2 sheets" in str(pf.find_immersion(repeated))
    assert verdict(pf.arrange(repeated))["cusps"] == [{"loop": 0, "point": 3, "index": 1, "where": [9.0, 9.0]}]
    spike = pf.Curve([(0, 0), (9, 0), (9, 9), (9, 12), (9, 9), (0, 9)], (), [0, 0, 0, 1, 0, 0])
    assert "No cusp of index 1 can be at point 3: it needs 3 sheets" in str(pf.find_immersion(spike))
