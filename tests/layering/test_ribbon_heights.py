"""Layerings of ribbons obey the heights of their lines: the strands followed through the lifted surface."""

from fractions import Fraction
from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from outline.test_ribbon_lines import tight_on_a_grid
from outline.test_ribbons import KINDS
from plyfold.io.shapes import Line, Shape
from plyfold.io.widths import Wide, outline_and_ribbon
from plyfold.layering.levels import heights as levels_by_heights
from plyfold.layering.levels.heights import layering_by_heights
from reference.ribbons import Surface, as_walked, between, cross, exact, lift

# Off the corners of meshes, and less than the slow reference takes for rounding.
ASIDE = (3e-11, 1e-11)


def crossings(points):
    """Where segments of a line cross: both segments, and the shares of both."""
    ends = exact(points)
    segments = list(pairwise(ends))
    for (i, one), (j, other) in combinations(enumerate(segments), 2):
        sides, other_sides = ([cross(*a, end) for end in b] for a, b in ((one, other), (other, one)))
        if sides[0] * sides[1] < 0 and other_sides[0] * other_sides[1] < 0:
            yield (i, other_sides[0] / (other_sides[0] - other_sides[1])), (j, sides[0] / (sides[0] - sides[1]))


def height_at(heights, segment, share):
    low, high = (Fraction(float(z)) for z in heights[segment : segment + 2])
    return low + share * (high - low)


def heights_in_space(layering, points):
    """A function of segment and share: the z of the lifted surface there, where the strand runs through it."""
    cloth = pf.lift(layering)
    surface, z = Surface(cloth.vertices[:, :2], cloth.faces), cloth.vertices[:, 2]
    points = points + ASIDE
    faces, walked = lift(surface, points, False, (0, 0)), as_walked(points, False)

    def height(segment, share):
        start = walked[segment] if segment else between(*walked[:2], Fraction(1, 2))
        place = between(*walked[segment : segment + 2], share)
        face, _, stayed = surface.walk(faces[segment], start, place)
        assert stayed
        corners = surface.faces[face]
        a, b, c = (surface.points[corner] for corner in corners)
        weights = cross(b, c, place), cross(c, a, place), cross(a, b, place)
        return sum(w * Fraction(float(z[k])) for w, k in zip(weights, corners, strict=True)) / sum(weights)

    return height


def disobeyed(layering, points, heights):
    """The crossings of a line with itself at which the strand with the greater height is not on top."""
    found = [pair for pair in crossings(points) if height_at(heights, *pair[0]) != height_at(heights, *pair[1])]
    if not found:
        return []
    in_space = heights_in_space(layering, points)
    upward = [sorted(pair, key=lambda strand: height_at(heights, *strand)) for pair in found]
    return [(low, high) for low, high in upward if in_space(*low) >= in_space(*high)]


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.sampled_from((*KINDS, tight_on_a_grid)), st.booleans())
def test_the_higher_strand_is_on_top_wherever_the_line_crosses_itself(seed, kind, climbs):
    rng = np.random.default_rng(seed)
    points = kind(rng, int(rng.integers(4, 12)))
    points += rng.normal(0, 0.01, points.shape)  # where ribbons touch, lifts are another matter
    heights = np.sort(rng.normal(size=len(points))) if climbs else rng.normal(size=len(points))
    try:
        layering = pf.ribbon_layering(np.column_stack([points, heights]), rng.uniform(0.2, 2), closed=False)
    except pf.errors.InputError:
        return
    assert not layering or not disobeyed(layering, points, heights)


def test_heights_that_the_ribbon_cannot_follow_are_an_obstruction_with_the_place():
    """By a hairpin the heights of the ribbon are others than the line's: the layering that they ask for disobeys."""
    points = np.array([(2.0, 0), (5, 4), (2, 5), (2, 4), (3, 5), (2, 3)])
    heights = [0.85, -0.65, 0.2, 0.6, 1.5, 0.75]
    line = np.column_stack([points, heights])
    found = pf.ribbon_layering(line, 2, "bevel")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(levels_by_heights, "first_disobeyed", lambda *_: None)
        unasked = pf.ribbon_layering(line, 2, "bevel")
    wrong = disobeyed(unasked, points, heights)
    places = [between(*exact(points)[k : k + 2], share) for (k, share), _ in wrong]
    assert isinstance(found, pf.Obstruction)
    assert found.reason == "heights"
    assert found.where == (tuple(map(float, places[0])),)
    assert found.value == pytest.approx((1.275, -0.0125))


def test_several_lines_obey_together():
    crossing = [
        Line([[0, 0, 0], [9, 0, 0.5]], closed=False, is_line=True),
        Line([[4, -5, 1], [4, 5, 1]], closed=False, is_line=True),
    ]
    _, ribbon = outline_and_ribbon([Shape(tuple(crossing))], Wide(1.0))
    assert [(course.first, course.n_triangles) for course in ribbon.courses] == [(0, 2), (2, 2)]
    layering = layering_by_heights(ribbon)
    assert layering.casing.tolist() == [False] * 4 + [True] * 4
    passed = [course.faces_along(0).tolist() for course in ribbon.courses]
    assert passed == [[0, 1], [2, 3]]


def test_places_are_those_of_the_drawing_as_given():
    """Of a ribbon that touches itself, points are moved apart by a millionth, which nobody wants to read."""
    flat = [(0, 0, 0), (6, 0, 0), (6, 6, 0), (2, 6, 0), (2, -1, 0)]
    with pytest.raises(pf.errors.InputError, match="at the same height") as caught:
        pf.ribbon_layering(flat, 2, join_style="mitre")
    assert caught.value.where[0][1] == -1
    steep = [(0, 0, 1), (-5, 0, 2), (-5, -3, 2), (-1, -3, 2), (-1, 2, 0), (2, 2, 2)]
    found = pf.ribbon_layering(steep, 2, join_style="mitre")
    assert found.where == ((0, -1),)
    assert "around the crossing there" in found.sentence
