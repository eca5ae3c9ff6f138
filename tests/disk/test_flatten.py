"""Lengths of sides that fit together in the plane, against angles from the law of cosines."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from plyfold.disk.flatten import Layout, angles_of, flattened, thin


def mesh(seed, count=60):
    """Random points in a square, with their Delaunay triangles, counter-clockwise, and the outline of the square."""
    rng = np.random.default_rng(seed)
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1.0)])
    points = np.concatenate([square, 0.05 + 0.9 * rng.random((count, 2))])
    faces = Delaunay(points).simplices.astype(np.int64)
    (ux, uy), (vx, vy) = (points[faces[:, i]].T - points[faces[:, 0]].T for i in (1, 2))
    faces[ux * vy < uy * vx] = faces[ux * vy < uy * vx][:, [0, 2, 1]]
    return points, faces


def sides_of(points, faces):
    way = points[np.roll(faces, -1, axis=1)] - points[faces]
    return np.linalg.norm(way, axis=-1)


def around(sides, faces):
    """The sum of the angles around each vertex, by the law of cosines."""
    total = np.zeros(faces.max() + 1)
    for face, (ab, bc, ca) in zip(faces, sides, strict=True):
        for vertex, one, other, opposite in zip(face, (ca, ab, bc), (ab, bc, ca), (bc, ca, ab), strict=True):
            total[vertex] += np.arccos((one**2 + other**2 - opposite**2) / (2 * one * other))
    return total


@pytest.mark.parametrize("seed", range(4))
def test_a_hilly_mesh_becomes_flat(seed):
    """Lengths over hills do not fit together; the new ones do, and at the boundary they are as before."""
    points, faces = mesh(seed)
    hills = np.column_stack([points, 0.1 * np.sin(5 * points[:, 0]) * np.cos(4 * points[:, 1])])
    sides = sides_of(hills, faces)
    inner = np.arange(4, len(points))
    assert np.abs(around(sides, faces)[4:] - 2 * np.pi).max() > 0.01
    flat = flattened(sides, faces, inner)
    assert around(flat, faces)[4:] == pytest.approx(2 * np.pi, abs=1e-9)
    rim = (faces < 4) & (np.roll(faces, -1, axis=1) < 4)
    assert (flat[rim] == sides[rim]).all()
    laid = Layout(faces, np.arange(4))
    assert sides_of(laid.points(flat, laid.directions(flat)), faces) == pytest.approx(flat, abs=1e-9)


def test_what_is_flat_stays():
    points, faces = mesh(9)
    sides = sides_of(points, faces)
    assert (flattened(sides, faces, np.arange(4, len(points))) == sides).all()


def test_angles():
    sides = np.array([(3.0, 4.0, 5.0), (1.0, 1.0, 1.0), (1.0, 1.0, 3.0)])
    right = [np.arctan2(4, 3), np.pi / 2, np.arctan2(3, 4)]
    assert angles_of(sides) == pytest.approx(np.array([right, [np.pi / 3] * 3, [0, np.pi, 0]]))
    assert thin(sides).tolist() == [False, False, True]


def test_lengths_without_a_flat_shape_are_given_back_without_numbers_lost():
    """Sides as long as two others together, all around a vertex."""
    faces = np.array([(0, 1, 3), (1, 2, 3), (2, 0, 3)])
    found = flattened(np.tile([4.0, 1.0, 1.0], (3, 1)), faces, np.array([3]))
    assert np.isfinite(found).all()
