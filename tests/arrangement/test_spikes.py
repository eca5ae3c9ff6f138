"""Spikes: what is left without them does not depend on the order, and each is reported."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement.spikes import tips, without_spikes
from plyfold.errors import CurveError
from reference import contacts as reference
from reference.crossings import exact

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]


def test_an_antenna():
    left, kept = without_spikes(pf.Curve([*SQUARE[:3], (7, 7), (4, 4), (0, 4)]))
    assert kept.tolist() == left.rows.tolist() == [0, 1, 2, 5]
    assert [(repair.kind, repair.where) for repair in left.repairs] == [("spike taken out", (7, 7))]
    assert left.repairs[0].size == pytest.approx(3 * 2**0.5)


def test_an_outline_without_spikes_stays():
    curve = pf.Curve(SQUARE)
    assert without_spikes(curve)[0] is curve


def test_numbers_of_rows_are_kept():
    """Also where repeated points were dropped, and where the outline is turned round."""
    points = [(0, 0), (0, 0), (0, 4), (4, 4), (7, 7), (4, 4), (4, 0), (9, 0), (4, 0)]
    drawn = pf.arrange(points)
    assert drawn.reversed
    assert [tuple(p) for p in drawn.given.points.tolist()] == [(0, 0), (4, 0), (4, 4), (0, 4)]
    outline = pf.Curve(points)
    assert np.array_equal(outline.points[drawn.numbers], drawn.given.points)
    faces = pf.triangulate(points)
    assert {tuple(points[row]) for row in faces.ravel().tolist()} == set(SQUARE)
    assert len(pf.triangulate(points, pf.find_immersion(points))) == 2


def test_a_zigzag_on_a_side_goes():
    drawn = pf.arrange([(0, 0), (3, 0), (1, 0), (4, 0), (4, 4), (0, 4)])
    assert len(drawn.outline) < 6
    assert pf.bounds_disk(drawn, touching=False)


def test_a_marked_cusp_is_no_spike():
    """Two tips of a zigzag that turn right are a flattened curl: a cusp of index 1 on that side, where marked."""
    zigzag = [(0, 0), (3, 0), (1, 0), (4, 0), (4, 4), (0, 4)]
    for marked in (1, 2):
        drawn = pf.arrange(pf.Curve(zigzag, cusps={marked: 1}))
        assert int(drawn.cusp_index.sum()) == 1
        assert drawn.euler_characteristic == 0


def test_a_cusp_at_a_tip_has_an_angle_of_360_degrees_that_one_sees():
    """A spiral stair that goes round the origin twice and ends where it began."""
    stair = [(0, 0), (4, 0), (0, 4), (-4, 0), (0, -4), (5, 0), (0, 5), (-5, 0), (0, -5), (6, 0)]
    for start in range(len(stair)):
        points = stair[start:] + stair[:start]
        assert pf.bounds_disk(pf.Curve(points, cusps={(-start) % len(stair): 1}))
        assert not pf.bounds_disk(pf.Curve(points, cusps={(-start) % len(stair): 2}))


def test_nothing_is_left():
    with pytest.raises(CurveError, match="nothing is left"):
        pf.arrange([(0, 0), (4, 0), (4, 3), (9, 9), (4, 3), (4, 0)])


GRID = st.lists(st.tuples(st.integers(0, 2), st.integers(0, 2)), min_size=3, max_size=12)


@given(GRID, st.integers(0, 11))
def test_what_is_left_does_not_depend_on_the_start(points, start):
    """It has the corners that are left when spikes go one by one, from every start and in both directions."""
    try:
        curve = pf.Curve(points)
    except CurveError:
        return
    expected = corners(reference.without_spikes(exact(points)))
    turned = points[start % len(points) :] + points[: start % len(points)]
    for given_points in (points, turned, turned[::-1]):
        try:
            left = without_spikes(pf.Curve(given_points))[0]
        except CurveError:
            assert not expected
            continue
        assert not tips(left).any()
        assert corners(exact(left.points.tolist())) == expected
    assert len(curve) >= len(expected)


def corners(polygon):
    """The places where a polygon turns, with how often it does."""
    return sorted(
        here
        for before, here, after in zip(polygon[-1:] + polygon[:-1], polygon, polygon[1:] + polygon[:1], strict=True)
        if (here[0] - before[0]) * (after[1] - here[1]) != (here[1] - before[1]) * (after[0] - here[0])
    )
