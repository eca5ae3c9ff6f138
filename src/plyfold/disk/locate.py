"""Which triangle of a convex triangulation a point lies in, for many points at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Floats, Ints, freeze
from plyfold.predicates import orient

__all__ = ["Places", "locate", "neighbours", "twins", "weights"]


@dataclass(frozen=True, eq=False)
class Places:
    """Points on a triangle mesh, without coordinates: weighted means of the corners of triangles.

    Parameters
    ----------
    face : (p,) int
    weights : (p, 3) float
        Of the triangle's corners, none negative, with sum 1.
    """

    face: Ints
    weights: Floats

    def __post_init__(self) -> None:
        freeze(self)

    def of(self, values: Floats, faces: Ints) -> Floats:
        """Return what vertices have, an array of shape (n, ...), at these places."""
        return np.asarray(np.einsum("pi,pi...->p...", self.weights, values[faces[self.face]]))


def twins(faces: Ints) -> Ints:
    """Return the side beside each side 3t + i, from corner i of triangle t to the next one, or −1; shape (3m,)."""
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    size = int(faces.max()) + 1
    key, wanted = start * size + end, end * size + start
    order = np.argsort(key)
    at = order[np.minimum(np.searchsorted(key, wanted, sorter=order), len(key) - 1)]
    return np.where(key[at] == wanted, at, -1)


def neighbours(faces: Ints) -> Ints:
    """Return the triangle beyond each side of each triangle, from corner i to i + 1, or −1; shape (m, 3)."""
    beside = twins(faces)
    return np.where(beside >= 0, beside // 3, -1).reshape(faces.shape)


def locate(points: Floats, vertices: Floats, faces: Ints) -> Places:
    """Find the triangles that points lie in, by walks through the mesh.

    Parameters
    ----------
    points : (p, 2) float
    vertices : (n, 2) float
    faces : (m, 3) int
        Counter-clockwise triangles that cover a convex polygon once.

    Returns
    -------
    Places
        Triangles exact; a point outside the polygon is moved to the side where its walk leaves it. Cost: O(m log m),
        and a few steps for each point.

    Examples
    --------
    >>> square = np.array([(0.0, 0), (2, 0), (2, 2), (0, 2)])
    >>> places = locate(np.array([(1.5, 0.5)]), square, np.array([(0, 1, 2), (0, 2, 3)]))
    >>> places.face.tolist(), places.weights.tolist()
    ([0], [[0.25, 0.5, 0.25]])
    """
    from scipy.spatial import KDTree

    beyond = neighbours(faces)
    face = np.asarray(KDTree(vertices[faces].mean(axis=1)).query(points)[1], dtype=np.int64)
    walking = np.arange(len(points))
    # A walk that always takes the first way out may go in circles; one that takes any of them does not, for long.
    dice = np.random.default_rng(0)
    while len(walking):
        outside = _outside(points[walking], vertices[faces[face[walking]]])
        way = np.where(outside & (beyond[face[walking]] >= 0), dice.random(outside.shape), -1.0).argmax(axis=1)
        after = beyond[face[walking], way]
        going = outside[np.arange(len(way)), way] & (after >= 0)
        walking, after = walking[going], after[going]
        face[walking] = after
    return Places(face, weights(points, vertices[faces[face]]))


def _outside(points: Floats, corners: Floats) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    """Tell beyond which sides of its triangle each point lies; exact."""
    return np.stack([orient(corners[:, i], corners[:, (i + 1) % 3], points) < 0 for i in range(3)], axis=1)


def weights(points: Floats, corners: Floats) -> Floats:
    """Return the weights of the corners; at a corner exactly 1."""
    way = corners - points[:, None]
    opposite = [(way[:, i - 2, 0] * way[:, i - 1, 1] - way[:, i - 2, 1] * way[:, i - 1, 0]) for i in range(3)]
    areas = np.stack(opposite, axis=1).clip(0)
    flat = areas.sum(axis=1) == 0
    areas[flat] = _along_longest_side(points[flat], corners[flat])
    return np.asarray(areas / areas.sum(axis=1, keepdims=True))


def _along_longest_side(points: Floats, corners: Floats) -> Floats:
    """Return the weights of the corners of triangles without area in doubles: those of the longest side's ends."""
    side = np.roll(corners, -1, axis=1) - corners
    row, first = np.arange(len(points)), np.hypot(side[..., 0], side[..., 1]).argmax(axis=1)
    way, start = side[row, first], corners[row, first]
    share = (((points - start) * way).sum(axis=1) / (way * way).sum(axis=1)).clip(0, 1)
    found = np.zeros((len(points), 3))
    found[row, first], found[row, (first + 1) % 3] = 1 - share, share
    return found
