"""Half-edges of triangles: number 3t + i runs along the side of triangle t that starts at its corner i.

The half-edge on the other side is its twin. On the boundary there is none, and a negative number stands for it.
"""

from __future__ import annotations

from typing import NamedTuple, TypeVar

import numpy as np

from plyfold.arrays import Ints
from plyfold.compiled import called_from_loops

__all__ = [
    "GluedTriangles",
    "before",
    "ends_of",
    "flip",
    "following",
    "glue",
    "half_edges_from_to",
    "neighbours_of",
    "split_in_three",
    "split_in_two",
    "twins_of",
    "twins_of_edges",
]

_HalfEdge = TypeVar("_HalfEdge", int, Ints)


class GluedTriangles(NamedTuple):
    """Triangles of a surface, and how they are glued.

    Vertices do not tell that where several edges join the same two, as may be at cusps.

    Parameters
    ----------
    faces : (t, 3) int
    twin : (3t,) int
        The half-edge on the other side of each half-edge, −1 on the boundary.
    """

    faces: Ints
    twin: Ints

    @property
    def pairs(self) -> Ints:
        """The half-edges on both sides of each inner edge, the lower number first, shape (e, 2)."""
        lower = np.flatnonzero(self.twin > np.arange(len(self.twin)))
        return np.stack([lower, self.twin[lower]], axis=1)

    @property
    def doubles(self) -> list[Ints]:
        """The edges that join the same two vertices, for all such vertices, by one half-edge each; at cusps alone.

        Edges on the boundary come first.
        """
        edge = np.flatnonzero(self.twin < np.arange(len(self.twin)))
        edge = edge[np.argsort(self.twin[edge] >= 0, kind="stable")]
        ends = np.sort(np.stack(ends_of(self.faces))[:, edge], axis=0)
        key, times = np.unique(ends[0] * (1 + ends.max(initial=0)) + ends[1], return_inverse=True, return_counts=True)[
            1:
        ]
        several = np.flatnonzero(times > 1)
        return [edge[key == number] for number in several.tolist()]


@called_from_loops
def following(half_edge: _HalfEdge) -> _HalfEdge:
    """Return the next half-edge of the same triangle, or of many: it starts where the given one ends."""
    return half_edge - half_edge % 3 + (half_edge + 1) % 3


@called_from_loops
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


def twins_of_edges(edge: Ints) -> Ints:
    """Return the half-edge on the other side of each half-edge, −1 for none, by the edges that they are sides of.

    Examples
    --------
    >>> twins_of_edges(np.array([0, 1, 2, 2, 4, 3])).tolist()
    [-1, -1, 3, 2, -1, -1]
    """
    half_edges = np.arange(len(edge))
    first, last = np.empty((2, 1 + int(edge.max(initial=-1))), dtype=np.int64)
    last[edge] = half_edges
    first[edge[::-1]] = half_edges[::-1]
    twin = first[edge] + last[edge] - half_edges
    return np.where(twin == half_edges, -1, twin)


def neighbours_of(triangles: Ints) -> Ints:
    """Return the triangle beyond each side of each triangle, from corner i to i + 1, or −1; shape (t, 3)."""
    return (twins_of(triangles) // 3).reshape(triangles.shape)


def glue(beyond: list[int], half_edge: int, other: int) -> None:
    """Put a half-edge beside another one, or on the boundary."""
    beyond[half_edge] = other
    if other >= 0:
        beyond[other] = half_edge


def flip(start: list[int], beyond: list[int], side: int) -> None:
    """Replace the side between two triangles by the other diagonal of the two.

    The half-edges 3t, 3t + 1, 3t + 2 stay those of triangle t, and the given one starts where it did.

    Examples
    --------
    >>> start, beyond = [0, 1, 2, 0, 2, 3], [-1, -1, 3, 2, -1, -1]
    >>> flip(start, beyond, 2)
    >>> start, beyond
    ([3, 1, 2, 0, 1, 3], [4, -1, -1, -1, 0, -1])
    """
    other = beyond[side]
    ahead, other_ahead = following(side), following(other)
    outer = beyond[other_ahead], beyond[ahead]
    start[ahead], start[other_ahead] = start[before(other)], start[before(side)]
    glue(beyond, side, outer[0])
    glue(beyond, other, outer[1])
    glue(beyond, ahead, other_ahead)


def split_in_three(triangles: GluedTriangles, which: Ints, middle: Ints) -> GluedTriangles:
    """Join a vertex in the middle of each of some triangles to its corners.

    Examples
    --------
    >>> split_in_three(GluedTriangles(np.array([(0, 1, 2)]), np.array([-1, -1, -1])), np.array([0]), np.array([3]))
    GluedTriangles(faces=array([[0, 1, 3],
           [1, 2, 3],
           [2, 0, 3]]), twin=array([-1,  5,  7, -1,  8,  1, -1,  2,  4]))
    """
    corners = triangles.faces[which].T
    parts = [np.stack([*corners[ends], middle], axis=1) for ends in ([0, 1], [1, 2], [2, 0])]
    faces = np.concatenate([triangles.faces, *parts[1:]])
    faces[which] = parts[0]
    # The first side of each part is a side of the triangle.
    new = len(triangles.faces) + np.arange(2 * len(which)).reshape(2, -1)
    sides = 3 * np.stack([which, *new])
    moved = np.arange(triangles.faces.size)
    moved[3 * which + 1], moved[3 * which + 2] = sides[1:]
    twin = np.empty(faces.size, dtype=np.int64)
    twin[moved] = np.where(triangles.twin < 0, -1, moved[triangles.twin])
    ahead, behind = sides + 1, np.roll(sides + 2, -1, axis=0)
    twin[ahead], twin[behind] = behind, ahead
    return GluedTriangles(faces, twin)


def split_in_two(triangles: GluedTriangles, side: int, middle: int) -> GluedTriangles:
    """Join a vertex in the middle of an inner edge, which a half-edge names, to what is on both sides.

    Examples
    --------
    >>> kite = GluedTriangles(np.array([(0, 1, 2), (0, 2, 3)]), np.array([-1, -1, 3, 2, -1, -1]))
    >>> split_in_two(kite, 2, 4).faces.tolist()
    [[4, 1, 2], [0, 4, 3], [4, 0, 1], [4, 2, 3]]
    """
    start, beyond = triangles.faces.ravel().tolist(), triangles.twin.tolist()
    both = side, beyond[side]
    new = len(start), len(start) + 3
    for one, part in zip(both, new, strict=True):
        start += [middle, start[following(one)], start[before(one)]]
        beyond += [-1, -1, -1]
        glue(beyond, part + 1, beyond[following(one)])
        glue(beyond, part + 2, following(one))
    for one, part in zip(both, reversed(new), strict=True):
        start[following(one)] = middle
        glue(beyond, one, part)
    return GluedTriangles(np.array(start, dtype=np.int64).reshape(-1, 3), np.array(beyond, dtype=np.int64))
