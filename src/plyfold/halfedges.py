"""Half-edges of triangles: number 3t + i runs along the side of triangle t that starts at its corner i."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from plyfold.arrays import Ints

__all__ = ["before", "ends_of", "following", "glued_pairs", "half_edges_from_to", "neighbours_of", "twins_of"]

_HalfEdge = TypeVar("_HalfEdge", int, Ints)


def following(half_edge: _HalfEdge) -> _HalfEdge:
    """Return the next half-edge of the same triangle, or of many: it starts where the given one ends."""
    return half_edge - half_edge % 3 + (half_edge + 1) % 3


def before(half_edge: _HalfEdge) -> _HalfEdge:
    """Return the half-edge of the same triangle that ends where this one starts, or many."""
    return half_edge - half_edge % 3 + (half_edge + 2) % 3


def ends_of(triangles: Ints) -> tuple[Ints, Ints]:
    """Return the vertices at which the half-edges start, and those at which they end; shape (3t,) each."""
    return triangles.ravel(), triangles[:, [1, 2, 0]].ravel()


def half_edges_from_to(triangles: Ints, start: Ints, end: Ints) -> Ints:
    """Return the half-edge between each pair of vertices, in this direction; −1 where there is none.

    Examples
    --------
    >>> half_edges_from_to(np.array([(0, 1, 2)]), np.array([1, 2, 2]), np.array([2, 1, 0])).tolist()
    [1, -1, 2]
    """
    first, last = ends_of(triangles)
    size = 1 + max(int(vertices.max(initial=0)) for vertices in (triangles, start, end))
    key, wanted = first * size + last, start * size + end
    order, wanted_order = np.argsort(key), np.argsort(wanted)
    at = np.empty(len(wanted), dtype=np.int64)
    # What is looked up in ascending order is found three times as fast.
    at[wanted_order] = np.searchsorted(key[order], wanted[wanted_order])
    at = order[np.minimum(at, len(key) - 1)]
    return np.where(key[at] == wanted, at, -1)


def twins_of(triangles: Ints) -> Ints:
    """Return the half-edge on the other side of each half-edge, −1 where there is no triangle; shape (3t,).

    Examples
    --------
    >>> twins_of(np.array([(0, 1, 2), (0, 2, 3)])).tolist()
    [-1, -1, 3, 2, -1, -1]
    """
    start, end = ends_of(triangles)
    return half_edges_from_to(triangles, end, start)


def neighbours_of(triangles: Ints) -> Ints:
    """Return the triangle beyond each side of each triangle, from corner i to i + 1, or −1; shape (t, 3)."""
    return (twins_of(triangles) // 3).reshape(triangles.shape)


def glued_pairs(triangles: Ints) -> Ints:
    """Return the pairs of half-edges on both sides of an edge, shape (e, 2), by the vertices of the edge.

    No two edges may join the same vertices. In a disk without inner vertices none do: between them would lie a disk of
    two straight sides, without angles.
    """
    start, end = ends_of(triangles)
    key = np.minimum(start, end) * (triangles.max(initial=0) + 1) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    same = np.flatnonzero(np.diff(key[order]) == 0)
    return np.stack([order[same], order[same + 1]], axis=1)
