"""Which way round loops run, exactly, and which way they should by even and odd."""

from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from plyfold.outline.direction import bounds_nothing, even_odd_directions, sense

numbers = st.one_of(st.integers(-3, 3).map(float), st.floats(-1e150, 1e150), st.floats(-1, 1))
polylines = st.lists(st.tuples(numbers, numbers), min_size=1, max_size=8).map(np.array)


@given(polylines)
@settings(deadline=None)
def test_the_sense_is_the_sign_of_the_exact_area(points):
    places = [(Fraction(x), Fraction(y)) for x, y in points.tolist()]
    area = sum(a * d - b * c for (a, b), (c, d) in zip(places, places[1:] + places[:1], strict=True))
    assert sense(points) == (area > 0) - (area < 0)


def test_the_sense_of_slivers_far_away():
    """In doubles the area is far below the rounding."""
    sliver = np.array([(1e9, 1e9), (1e9 + 1, 1e9 + 1), (1e9 + 2, np.nextafter(1e9 + 2, 2e9))])
    assert [sense(sliver), sense(sliver[::-1])] == [1, -1]


@given(st.lists(st.tuples(st.integers(-2, 2), st.integers(-2, 2)), min_size=1, max_size=7))
@settings(deadline=None)
def test_what_bounds_nothing_winds_round_no_place(places):
    points = np.array(places, dtype=float)
    grid = [(x / 7 + 0.01 * y + 0.0123, y / 7 + 0.003 * x + 0.0071) for x in range(-15, 16) for y in range(-15, 16)]
    winds = any(winding(points, place) for place in grid)
    assert not (bounds_nothing(points) and winds)


def winding(points, place):
    """By angles; no grid point lies on an edge."""
    x, y = (points - place).T
    angles = np.arctan2(y, x)
    turns = np.diff([*angles, angles[0]])
    return round(float(((turns + np.pi) % (2 * np.pi) - np.pi).sum() / (2 * np.pi)))


@pytest.mark.parametrize(
    ("places", "nothing"),
    [
        ([(0, 0), (4, 0), (4, 2), (4, 0)], True),
        ([(0, 0), (4, 0), (2, 0), (2, 3), (2, 0)], True),
        ([(0, 0), (1, 0), (1, 1), (2, 1), (1, 1), (1, 0)], True),
        ([(0, 0), (4, 0), (4, 4), (0, 4)], False),
        ([(0, 0), (4, 4), (4, 0), (0, 4)], False),
        ([(0, 0), (4, 0), (4, 4), (0, 0), (4, 4), (4, 0)], True),
    ],
)
def test_what_runs_back_all_the_way(places, nothing):
    for start in range(len(places)):
        assert bounds_nothing(np.array(places[start:] + places[:start], dtype=float)) == nothing


boxes = st.tuples(st.integers(0, 12), st.integers(0, 12), st.integers(1, 12), st.integers(1, 12), st.booleans())


@given(st.lists(boxes, min_size=2, max_size=5))
@settings(deadline=None)
def test_even_odd_directions_of_boxes(drawn):
    """Shapely says which boxes lie in which, and which boundaries meet."""
    shapes = [shapely.box(x, y, x + width, y + height, ccw=ccw) for x, y, width, height, ccw in drawn]
    found = even_odd_directions([shapely.get_coordinates(shape)[:-1] for shape in shapes])
    for shape, direction in zip(shapes, found, strict=True):
        others = [other for other in shapes if other is not shape]
        if any(shape.exterior.intersects(other.exterior) for other in others):
            assert direction == 0
        else:
            assert direction == (-1) ** sum(other.contains(shape) for other in others)


def test_a_loop_alone_is_a_shell():
    assert even_odd_directions([np.array([(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)])]) == [1]
