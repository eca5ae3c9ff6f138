"""Exact signs, against plain fractions."""

from fractions import Fraction
from itertools import permutations

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from plyfold.predicates import (
    counted_cross_sign,
    cross_sign,
    crossing_bounds,
    exact_crossings,
    exact_parameter,
    orient,
)
from reference.crossings import exact, meetings

numbers = st.one_of(
    st.integers(-3, 3).map(float),
    st.floats(allow_nan=False, allow_infinity=False),
    st.floats(-1, 1),
    st.floats(-1e-300, 1e-300),
)
points = st.tuples(numbers, numbers)


def exact_cross(a, b, c, d):
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = (map(Fraction, p) for p in (a, b, c, d))
    value = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    return (value > 0) - (value < 0)


@given(points, points, points)
def test_orientation_is_exact(a, b, c):
    assert orient(a, b, c) == exact_cross(a, b, a, c)


@given(points, points, points, points)
def test_cross_sign_is_exact(a, b, c, d):
    assert cross_sign(a, b, c, d) == exact_cross(a, b, c, d)


@given(st.integers(0, 40), st.integers(0, 40), st.integers(0, 40))
def test_nearly_collinear_points_are_told_apart(i, j, k):
    """The classic grid around (0.5, 0.5), where a rounded determinant is wrong half of the time."""
    ulp = 2.0**-53
    a, b, c = (0.5 + i * ulp, 0.5 + j * ulp), (12.0, 12.0), (24.0, 24.0 + k * 2.0**-48)
    assert orient(a, b, c) == exact_cross(a, b, a, c)


def test_a_million_easy_signs_need_no_fractions(monkeypatch):
    rng = np.random.default_rng(0)
    a, b, c = rng.normal(size=(3, 100_000, 2))
    monkeypatch.setattr("plyfold.predicates._exact", None)
    (px, py), (qx, qy) = (b - a).T, (c - a).T
    assert np.array_equal(orient(a, b, c), np.sign(px * qy - py * qx))


def test_order_along_an_edge_of_crossings_closer_than_rounding():
    edge = np.array([[0.0, 0.0], [3.0, 0.0]])
    third = 1.0  # the edges pass through (1, 0) and, one unit in the last place of a far end later, just beyond it
    first = np.array([[third, -1.0], [third, 1.0]])
    second = np.array([[third, -1.0], [np.nextafter(third, 2), 1e-9]])
    assert exact_parameter(*edge, *first) < exact_parameter(*edge, *second)
    assert exact_parameter(*edge, *first) == exact_parameter(*edge, *first[::-1])


@given(
    st.lists(st.integers(-(2**30), 2**30), min_size=8, max_size=8), st.integers(-20, 20), st.sampled_from([1, 2**20])
)
def test_whole_numbers_need_no_fractions(numbers, times, scale):
    """Parallel directions and nearly parallel ones on a lattice; Python's integers know the answer."""
    ax, ay, ux, uy, cx, cy, dx, dy = numbers
    vx, vy = times * (ux % 1000) + dx % 2, times * (uy % 1000) + dy % 2
    corners = [(ax, ay), (ax + ux % 1000, ay + uy % 1000), (cx, cy), (cx + vx, cy + vy)]
    value = (ux % 1000) * vy - (uy % 1000) * vx
    signs, count = counted_cross_sign(*(np.array(corner, dtype=float) * scale for corner in corners))
    assert signs == (value > 0) - (value < 0)
    assert count == 0


def test_long_products_of_whole_numbers_need_no_fractions():
    """Products of 106 bits that differ in the last one, or not at all."""
    u, v = 2**53 - 1, 2**53 - 3
    ends = np.array([[u, u - 2], [u - 2, v - 2], [u, v], [v, u]], dtype=float)
    signs, count = counted_cross_sign([0, 0], ends, [0, 0], np.array([[v, v - 2], [u, v], [u, v], [u, v]], dtype=float))
    values = [u * (v - 2) - (u - 2) * v, (u - 2) * v - (v - 2) * u, 0, v * v - u * u]
    assert signs.tolist() == [(value > 0) - (value < 0) for value in values]
    assert count == 0


def test_signs_settled_with_fractions_are_counted():
    start, end = [0.1, 0.1], [0.7, 0.7]
    signs, count = counted_cross_sign(start, end, start, [[1e9, 1e9], [3.3, 3.3], [1e9, 1.0], [0.0, 1.0]])
    assert signs.tolist() == [0, 0, -1, 1]
    assert count == 2


def near_line(draw):
    """Two points, and two more on their line up to a few units in the last place."""
    a, b = np.array(draw(points)), np.array(draw(points))
    shares = draw(st.lists(st.sampled_from([0.0, 0.5, 1.0, 2.0, -1.0, 1 / 3, 7.7]), min_size=2, max_size=2))
    units = np.array(draw(st.lists(st.integers(-2, 2), min_size=4, max_size=4))).reshape(2, 2)
    with np.errstate(all="ignore"):
        on_line = a + np.array(shares)[:, None] * (b - a)
        return np.array([a, b, *(on_line + units * np.spacing(on_line))])


@given(st.data())
def test_signs_of_nearly_parallel_directions_are_exact(data):
    places = near_line(data.draw)
    assume(np.isfinite(places).all())
    assert cross_sign(*places) == exact_cross(*places)
    assert orient(*places[:3]) == exact_cross(places[0], places[1], places[0], places[2])


def crossing_edges(four):
    """Two edges between four points that cross, and where they do, in fractions; None if the points allow none."""
    for a, b, c, d in permutations(exact(four)):
        for meeting in meetings([a, b, c, d]):
            if (meeting.first, meeting.second) == (0, 2):
                return np.array([[a], [b], [c], [d]], dtype=float), meeting.point
    return None


@given(st.tuples(points, points, points, points))
def test_places_of_crossings_are_exact_and_within_their_bounds(four):
    found = crossing_edges(four)
    assume(found is not None)
    ends, place = found
    low, high = crossing_bounds(*ends)
    for axis in range(2):
        assert exact_crossings(ends, axis) == [place[axis]]
        assert Fraction(low[0, axis]) <= place[axis] <= Fraction(high[0, axis])
