"""Vertices deleted from triangulations, against Delaunay triangulations by another library."""

import time

import numpy as np
import pytest
from scipy.spatial import Delaunay

from plyfold.certify import check_immersed_disk
from plyfold.errors import PrecisionError
from plyfold.flat.deletion import without_vertices


def delaunay(points):
    """Counter-clockwise triangles."""
    corners = Delaunay(points).simplices
    a, b, c = points[corners].swapaxes(0, 1)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return np.where((ux * vy - uy * vx > 0)[:, None], corners, corners[:, ::-1])


def as_sets(faces):
    return {frozenset(face) for face in np.asarray(faces).tolist()}


def around(n):
    """A ring of points on a circle, and the triangles between them and a point in the middle, number n."""
    angle = 2 * np.pi * np.arange(n) / n
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return ring, np.stack([np.arange(n), (np.arange(n) + 1) % n, np.full(n, n)], axis=1)


@pytest.mark.parametrize("seed", range(20))
def test_delaunay_stays_delaunay(seed):
    """Inner points deleted from a Delaunay triangulation leave that of the others."""
    rng = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(12) / 12
    hull = 3 * np.stack([np.cos(angle), np.sin(angle)], axis=1) + rng.normal(scale=0.01, size=(12, 2))
    points = np.concatenate([hull, rng.uniform(-2, 2, (60, 2))])
    extra = np.arange(len(points)) >= 40
    left = without_vertices(points, delaunay(points), extra)
    assert as_sets(left) == as_sets(delaunay(points[:40]))


def test_where_diagonals_cross():
    """A vertex exactly on both diagonals of its four neighbours."""
    square = np.array([(0, 0), (2, 0), (2, 2), (0, 2), (1, 1)], dtype=np.float64)
    left = without_vertices(square, np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]), np.arange(5) == 4)
    assert as_sets(left) in ({frozenset({0, 1, 2}), frozenset({0, 2, 3})}, {frozenset({1, 2, 3}), frozenset({0, 1, 3})})


@pytest.mark.parametrize("shift", [-1e-17, 0.0, 1e-17])
def test_nearly_flat_on_the_boundary(shift):
    """A vertex on the boundary, a rounding error inside or outside."""
    points = np.array([(-1, 0), (1, 0), (1, 1), (0, 1), (-1, 1), (0, shift)], dtype=np.float64)
    fan = np.array([(5, 1, 2), (5, 2, 3), (5, 3, 4), (5, 4, 0)])
    left = without_vertices(points, fan, np.arange(6) == 5)
    check_immersed_disk(points[:5], points[:5], left, boundary=np.arange(5))


def test_an_ear_on_the_boundary_goes():
    """A vertex a little outside, in a single triangle."""
    points = np.array([(-1, 0), (1, 0), (0, 1), (0, -1e-17)], dtype=np.float64)
    left = without_vertices(points, np.array([(0, 1, 2), (0, 3, 1)]), np.arange(4) == 3)
    assert left.tolist() == [[0, 1, 2]]


def test_far_from_flat():
    """A corner of the boundary with a point in the way of the chord that would replace it."""
    points = np.array([(-1, 0), (0, -3), (1, 0), (0, -1)], dtype=np.float64)
    with pytest.raises(PrecisionError) as caught:
        without_vertices(points, np.array([(0, 1, 3), (1, 2, 3)]), np.arange(4) == 1)
    assert caught.value.where == ((0.0, -3.0),)


def test_large_rings_take_no_square_time():
    ring, fan = around(20_000)
    points = np.concatenate([ring, [(0.0, 0.0)]])
    start = time.perf_counter()
    left = without_vertices(points, fan, np.arange(len(points)) == len(ring))
    assert time.perf_counter() - start < 10
    assert len(left) == len(ring) - 2
