"""Exact signs, against plain fractions."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from plyfold.predicates import compare_along_edge, cross_sign, orient

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
    edge = [[0.0, 0.0], [3.0, 0.0]]
    third = 1.0  # the edges pass through (1, 0) and, one unit in the last place of a far end later, just beyond it
    first = [[third, -1.0], [third, 1.0]]
    second = [[third, -1.0], [np.nextafter(third, 2), 1e-9]]
    assert compare_along_edge(edge, first, second) == -1
    assert compare_along_edge(edge, second, first) == 1
    assert compare_along_edge(edge, first, first[::-1]) == 0
