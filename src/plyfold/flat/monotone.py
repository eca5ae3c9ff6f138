"""Monotone polygons that grow vertex by vertex, and are cut into triangles on the way [GJPT78]_.

A polygon gets its vertices in the order of a sweeping line. As soon as a triangle can be cut off at its end, it is.

Two vertices do not tell an edge: round two cusps a surface winds so often that several edges may join them. So edges
have numbers of their own. The two triangles, of one polygon or of two, that have sides of the same number are beside
each other there.

References
----------
.. [GJPT78] M. R. Garey, D. S. Johnson, F. P. Preparata, R. E. Tarjan, "Triangulating a simple polygon", Information
   Processing Letters 7, 1978.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Ints
from plyfold.compiled import called_from_loops
from plyfold.predicates import Coordinates, turn

__all__ = [
    "TRIANGLES",
    "MonotonePolygons",
    "Stacks",
    "Triangles",
    "add_vertex",
    "close",
    "count_up",
    "empty_triangles",
    "new_edge",
    "new_polygon",
]

_POLYGONS, _ENTRIES, TRIANGLES, _EDGES = range(4)


class Stacks(NamedTuple):
    """The polygons as far as they are not cut into triangles yet: a vertex, and a chain of others on one side.

    They are stacks whose entries hold a vertex and the entry before, or −1, and the edge from there. The chain is
    above, ``side`` 1, or below, −1; there is none, 0, beside a single vertex. It bends inward: no triangle can be cut
    off.
    """

    last: Ints
    side: Ints
    vertex: Ints
    before: Ints
    edge: Ints


class Triangles(NamedTuple):
    """The triangles, the edges at their sides, and how many there are of: polygons, entries, triangles, edges.

    Side i of a triangle runs from its corner i to the next one.
    """

    faces: Ints
    sides: Ints
    counts: Ints


class MonotonePolygons(NamedTuple):
    """The places of vertices, polygons of them, and their triangles.

    ``flat`` is 1 if polygons may have no width. Then there may be triangles without area.
    """

    places: Coordinates
    flat: Ints
    stacks: Stacks
    output: Triangles


def empty_triangles(most: int) -> Triangles:
    """Return room for triangles."""
    faces, sides = np.empty((2, most, 3), dtype=np.int64)
    return Triangles(faces, sides, np.zeros(4, dtype=np.int64))


@called_from_loops
def count_up(counts: Ints, what: int) -> int:
    """Return the number of something new, and count it."""
    number: int = counts[what]
    counts[what] = number + 1
    return number


@called_from_loops
def new_edge(polygons: MonotonePolygons) -> int:
    """Return a number for an edge."""
    return count_up(polygons.output.counts, _EDGES)


@called_from_loops
def new_polygon(polygons: MonotonePolygons, vertex: int) -> int:
    """Return a polygon that begins at a vertex."""
    polygon = count_up(polygons.output.counts, _POLYGONS)
    polygons.stacks.side[polygon] = 0
    _push(polygons, polygon, vertex, (-1, -1))
    return polygon


@called_from_loops
def _push(polygons: MonotonePolygons, polygon: int, vertex: int, behind: tuple[int, int]) -> None:
    """Put a vertex on a stack; behind it are an entry, and an edge from there."""
    stacks = polygons.stacks
    entry = count_up(polygons.output.counts, _ENTRIES)
    stacks.vertex[entry] = vertex
    stacks.before[entry], stacks.edge[entry] = behind
    stacks.last[polygon] = entry


@called_from_loops
def add_vertex(polygons: MonotonePolygons, polygon: int, vertex: int, side: int, edge: int) -> None:
    """Add a vertex to a polygon, on its upper (1) or lower (−1) side, and cut off all triangles that can be.

    The edge is the one along this side that leads to the vertex.
    """
    stacks = polygons.stacks
    last = stacks.last[polygon]
    if stacks.side[polygon] == -side:
        across = new_edge(polygons)
        close(polygons, polygon, vertex, across, edge)
        stacks.before[last] = -1
        behind = (last, across)
    else:
        behind = _cut_off(polygons, polygon, vertex, edge, -1)
    stacks.side[polygon] = side
    _push(polygons, polygon, vertex, behind)


@called_from_loops
def close(polygons: MonotonePolygons, polygon: int, vertex: int, near: int, far: int) -> None:
    """Cut all that is left of a polygon into triangles with a vertex that faces its chain.

    Edges lead to the vertex from the near end of the chain, which is the last one, and from the far end.
    """
    _cut_off(polygons, polygon, vertex, near, far)


@called_from_loops
def _cut_off(polygons: MonotonePolygons, polygon: int, vertex: int, edge: int, last_edge: int) -> tuple[int, int]:
    """Cut triangles with a new vertex off the end of a polygon's chain; return what is left behind the vertex.

    That is an entry, and the edge from there. The first of these triangles has an edge to the vertex, and if this faces
    the chain, so that they are cut off up to the far end, the last of them has another one.
    """
    stacks = polygons.stacks
    entry: int = stacks.last[polygon]
    while stacks.before[entry] >= 0:
        before = stacks.before[entry]
        corners = stacks.vertex[before], stacks.vertex[entry], vertex
        if not _is_cut(polygons, corners, stacks.side[polygon], last_edge >= 0):
            break
        rung = last_edge if last_edge >= 0 and stacks.before[before] < 0 else new_edge(polygons)
        _add_triangle(polygons, corners, (stacks.edge[entry], edge, rung), stacks.side[polygon])
        entry, edge = before, rung
    return entry, edge


@called_from_loops
def _is_cut(polygons: MonotonePolygons, corners: tuple[int, int, int], side: int, faces_chain: bool) -> bool:
    """Tell whether a triangle is cut off: two corners on a chain on some side, the far one first, and the new one."""
    far, near, vertex = corners
    sign = side * turn(polygons.places, far, vertex, near)
    return sign > 0 or (sign == 0 and _is_cut_flat(polygons, corners, faces_chain))


@called_from_loops
def _add_triangle(
    polygons: MonotonePolygons, corners: tuple[int, int, int], edges: tuple[int, int, int], side: int
) -> None:
    """Add a triangle of such corners, counter-clockwise; each of the edges joins one of them to the next."""
    faces, sides, _ = polygons.output
    (far, near, vertex), (chain, other, rung) = corners, edges
    triangle = count_up(polygons.output.counts, TRIANGLES)
    faces[triangle][0], sides[triangle][1] = far, other
    if side > 0:
        faces[triangle][1], faces[triangle][2] = vertex, near
        sides[triangle][0], sides[triangle][2] = rung, chain
    else:
        faces[triangle][1], faces[triangle][2] = near, vertex
        sides[triangle][0], sides[triangle][2] = chain, rung


@called_from_loops
def _is_cut_flat(polygons: MonotonePolygons, corners: tuple[int, int, int], faces_chain: bool) -> bool:
    """Tell whether a triangle without area is cut off: if it must be, or to leave no two places in a row the same."""
    if polygons.flat[0] == 0:
        return False
    far, near, vertex = corners
    return faces_chain or _is_same(polygons, far, near) or _is_same(polygons, near, vertex)


@called_from_loops
def _is_same(polygons: MonotonePolygons, one: int, other: int) -> bool:
    """Tell whether two vertices are at the same place."""
    x, y, _ = polygons.places
    return bool(x[one] == x[other] and y[one] == y[other])
