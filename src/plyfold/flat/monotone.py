"""Monotone polygons that grow vertex by vertex, and are cut into triangles on the way [GJPT78]_.

A polygon gets its vertices in the order of a sweeping line. As soon as a triangle can be cut off at its end, it is.

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
    "new_polygon",
]

_POLYGONS, _ENTRIES, TRIANGLES = range(3)


class Stacks(NamedTuple):
    """The polygons as far as they are not cut into triangles yet: a vertex, and a chain of others on one side.

    They are stacks whose entries hold a vertex and the entry before, or −1. The chain is above, ``side`` 1, or below,
    −1; there is none, 0, beside a single vertex. It bends inward: no triangle can be cut off.
    """

    last: Ints
    side: Ints
    vertex: Ints
    before: Ints


class Triangles(NamedTuple):
    """The triangles, and how many there are of: polygons, entries, triangles."""

    faces: Ints
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
    return Triangles(np.empty((most, 3), dtype=np.int64), np.zeros(3, dtype=np.int64))


@called_from_loops
def count_up(counts: Ints, what: int) -> int:
    """Return the number of something new, and count it."""
    number: int = counts[what]
    counts[what] = number + 1
    return number


@called_from_loops
def new_polygon(polygons: MonotonePolygons, vertex: int) -> int:
    """Return a polygon that begins at a vertex."""
    polygon = count_up(polygons.output.counts, _POLYGONS)
    polygons.stacks.side[polygon] = 0
    _push(polygons, polygon, vertex, -1)
    return polygon


@called_from_loops
def _push(polygons: MonotonePolygons, polygon: int, vertex: int, before: int) -> None:
    stacks = polygons.stacks
    entry = count_up(polygons.output.counts, _ENTRIES)
    stacks.vertex[entry] = vertex
    stacks.before[entry] = before
    stacks.last[polygon] = entry


@called_from_loops
def add_vertex(polygons: MonotonePolygons, polygon: int, vertex: int, side: int) -> None:
    """Add a vertex to a polygon, on its upper (1) or lower (−1) side, and cut off all triangles that can be."""
    stacks = polygons.stacks
    last = stacks.last[polygon]
    if stacks.side[polygon] == -side:
        close(polygons, polygon, vertex)
        stacks.before[last] = -1
        left = last
    else:
        left = _cut_off(polygons, polygon, vertex, False)
    stacks.side[polygon] = side
    _push(polygons, polygon, vertex, left)


@called_from_loops
def close(polygons: MonotonePolygons, polygon: int, vertex: int) -> None:
    """Cut all that is left of a polygon into triangles with a vertex that faces its chain."""
    _cut_off(polygons, polygon, vertex, True)


@called_from_loops
def _cut_off(polygons: MonotonePolygons, polygon: int, vertex: int, faces_chain: bool) -> int:
    """Cut triangles with a new vertex off the end of a polygon's chain; return the entry up to which it is left."""
    stacks, faces = polygons.stacks, polygons.output.faces
    above = stacks.side[polygon] > 0
    entry: int = stacks.last[polygon]
    while stacks.before[entry] >= 0:
        near, far = stacks.vertex[entry], stacks.vertex[stacks.before[entry]]
        second, third = (vertex, near) if above else (near, vertex)
        side = turn(polygons.places, far, second, third)
        if side < 0 or (side == 0 and not _is_cut_flat(polygons, (far, near, vertex), faces_chain)):
            break
        triangle = count_up(polygons.output.counts, TRIANGLES)
        faces[triangle][0], faces[triangle][1], faces[triangle][2] = far, second, third
        entry = stacks.before[entry]
    return entry


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
