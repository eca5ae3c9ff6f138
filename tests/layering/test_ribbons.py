"""Ribbons laid over themselves by the heights of their lines."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.outline.ribbons.line import as_line
from plyfold.outline.ribbons.ribbon import Style, ribbon_of_line

# From left to right, round and down across itself.
LOOP = np.array([(0.0, 0), (9, 0), (9, 6), (4, 6), (4, -5)])


def with_heights(points, heights):
    return np.column_stack([points, np.broadcast_to(heights, len(points))])


@st.composite
def wandering(draw):
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n = draw(st.integers(5, 30))
    angle = np.cumsum(rng.normal(0, 0.6, n))
    return np.cumsum(np.stack([np.cos(angle), np.sin(angle)], axis=1), axis=0), rng.normal(size=n)


def layered(line, width=0.5, **options):
    """The layering; None if a bend is too tight."""
    try:
        return pf.ribbon_layering(line, width, **options)
    except pf.errors.InputError as error:
        if "too tight" in str(error):
            return None
        raise


def heights_at_visits(layering, line, width):
    """The height of the strand at each visit: between those of the points of the ribbon that its edge joins."""
    ribbon = ribbon_of_line(as_line(line, width), Style())
    arranged = layering.immersion.arrangement
    assert np.array_equal(arranged.given.points, ribbon.outline.points)
    edge = arranged.visit_edge
    start, end = ribbon.outline.points[edge], ribbon.outline.points[ribbon.outline.next_point[edge]]
    share = np.hypot(*(arranged.visit_point - start).T) / np.hypot(*(end - start).T)
    heights = ribbon.heights
    return (1 - share) * heights[edge] + share * heights[ribbon.outline.next_point[edge]]


@settings(deadline=None)
@given(wandering(), st.booleans())
def test_the_higher_strand_passes_over_and_its_casing_gives_the_layering_back(line, climbs):
    points, heights = line
    line = with_heights(points, np.sort(heights) if climbs else heights)
    layering = layered(line)
    if climbs and layering is not None:
        assert isinstance(layering, pf.Layering)  # a spiral ramp meets itself nowhere
    if layering:
        height = heights_at_visits(layering, line, 0.5)
        assert np.array_equal(layering.casing, height > height[layering.immersion.arrangement.partner])
        again = pf.embed_cased(layering.immersion.arrangement, layering.casing)
        assert np.array_equal(again.border_level, layering.border_level)


@settings(deadline=None)
@given(wandering(), st.booleans())
def test_upside_down_everything_is_the_other_way_round(line, closed):
    points, heights = line
    up = layered(with_heights(points, heights), closed=closed)
    down = layered(with_heights(points, -heights), closed=closed)
    assert (up is None) == (down is None)
    assert bool(up) == bool(down)
    if up:
        at_crossings = up.immersion.arrangement.crossing_visits
        assert np.array_equal(up.casing[at_crossings], ~down.casing[at_crossings])
        taller = layered(with_heights(points, 1000 * heights + 7), closed=closed)
        assert np.array_equal(taller.border_level, up.border_level)


def test_over_and_under_and_the_lift():
    over = pf.ribbon_layering(with_heights(LOOP, [0, 0, 1, 1, 1]), 2)
    under = pf.ribbon_layering(with_heights(LOOP, [1, 1, 0, 0, 0]), 2)
    assert over.level.max() == 2
    assert over.casing.tolist() == (~under.casing).tolist()
    road = pf.lift(over, triangles=300)
    road.check()
    # Where it crosses itself, the end of the line is above its start.
    later = shapely.box(3.5, -4, 4.5, -3)
    place = np.flatnonzero(shapely.intersects_xy(later, *road.vertices[:, :2].T))
    assert road.vertices[place, 2].min() > road.vertices[:, 2].min()


def test_a_spiral_stair_of_three_turns_has_its_steps_in_order():
    t = np.linspace(0, 6.5 * np.pi, 150)
    stair = with_heights(np.stack([5 * np.cos(t), 5 * np.sin(t)], axis=1), t)
    layering = pf.ribbon_layering(stair, 2)
    assert layering.level.max() == 4
    assert pf.ribbon_layering(stair * (1, 1, -1), 2).level.max() == 4


def test_a_ring_that_passes_over_itself():
    t = np.linspace(0, 2 * np.pi, 80, endpoint=False)
    eight = with_heights(np.stack([9 * np.cos(t), 6 * np.sin(2 * t)], axis=1), np.sin(t))
    layering = pf.ribbon_layering(eight, 1, closed=True)
    [piece] = layering.pieces
    assert (piece.loops, piece.euler_characteristic, layering.level.max()) == ((0, 1), 0, 2)


def test_heights_that_change_places_within_the_overlap_are_an_obstruction():
    # Both parts run nearly along each other, and one of them climbs through the other there.
    line = with_heights(
        [(0, 0), (20, 0), (25, 8), (20, 12), (0, 12), (-6, 4), (0, -2), (20, 2)], [0, 0, 0, 0, 0, 0, -9, 9]
    )
    found = pf.ribbon_layering(line, 2)
    assert isinstance(found, pf.Obstruction)
    assert found.reason == "heights"
    crossing = found.subject.crossings[found.value]
    assert found.where == (tuple(crossing),)
    assert shapely.box(-1, -4, 21, 4).contains(shapely.Point(found.where[0]))


def test_equal_heights_at_an_overlap_are_an_error_that_names_the_place():
    for closed in (False, True):
        with pytest.raises(pf.errors.InputError, match="overlap at the same height") as caught:
            pf.ribbon_layering(with_heights(LOOP, 5), 2, closed=closed)
        assert shapely.box(2, -2, 6, 2).covers(shapely.Point(caught.value.where[0]))
    # Elsewhere they do no harm.
    assert pf.ribbon_layering(with_heights(LOOP[:4], 5), 2).level.max() == 1


def test_a_line_without_heights_is_refused():
    with pytest.raises(pf.errors.InputError, match="no heights"):
        pf.ribbon_layering(LOOP, 2)
    assert pf.ribbon_layering(shapely.LineString(with_heights(LOOP, range(5))), 2).level.max() == 2


def test_ribbons_that_touch_themselves_are_laid_too():
    # The end of the line runs beside an earlier part of it, with an edge in common.
    line = with_heights([(0, 0), (10, 0), (10, 6), (4, 6), (4, -6), (9, -6), (9, 4), (6, 4), (6, -3)], range(9))
    layering = pf.ribbon_layering(line, 2, "mitre")
    assert layering.level.max() >= 2
    layering.check()
