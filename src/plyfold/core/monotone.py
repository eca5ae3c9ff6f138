"""Monotone polygons that grow vertex by vertex, and are cut into triangles on the way [GJPT78]_.

A polygon gets its vertices in the order of a sweeping line. As soon as a triangle can be cut off at its end, it is.

References
----------
.. [GJPT78] M. R. Garey, D. S. Johnson, F. P. Preparata, R. E. Tarjan, "Triangulating a simple polygon", Information
   Processing Letters 7, 1978.
"""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer, whole_room
from plyfold.core.turns import ExactPoints, turn

__all__ = ["MonotonePolygons"]


class MonotonePolygons:
    """The polygons as far as they are not cut into triangles yet: a vertex, and a chain of others on one side.

    They are stacks whose entries hold a vertex and the entry before, or −1; polygon i has the entry ``last[i]`` on top.
    The chain is above, ``side`` 1, or below, −1; there is none, 0, beside a single vertex. It bends inward: no triangle
    can be cut off.

    Parameters
    ----------
    points : ExactPoints
        The vertices.
    is_flat : bool
        Whether polygons may have no width. Then there may be triangles without area.
    most, entries : int
        How many polygons, and how many entries of all together, there can be.
    faces : buffer of int
        Room for triangles, three numbers each.
    """

    def __init__(self, points: ExactPoints, is_flat: bool, most: int, entries: int, faces: WholeBuffer) -> None:
        self.points, self.is_flat, self.faces = points, is_flat, faces
        self.n_polygons = self.n_entries = self.n_triangles = 0
        self.room = whole_room(2 * (most + entries))
        self.last, self.side = self.room[:most], self.room[most : 2 * most]
        self.vertex, self.before = self.room[2 * most : 2 * most + entries], self.room[2 * most + entries :]

    def begin(self, vertex: int) -> int:
        """Return a polygon that begins at a vertex."""
        polygon = self.n_polygons
        self.n_polygons += 1
        self.side[polygon] = 0
        self._push(polygon, vertex, -1)
        return polygon

    def begin_behind(self, polygon: int) -> int:
        """Return a polygon that begins at the vertex which another one has got last."""
        return self.begin(self.vertex[self.last[polygon]])

    def _push(self, polygon: int, vertex: int, before: int) -> None:
        entry = self.n_entries
        self.n_entries += 1
        self.vertex[entry] = vertex
        self.before[entry] = before
        self.last[polygon] = entry

    def add(self, polygon: int, vertex: int, side: int) -> None:
        """Add a vertex to a polygon, on its upper (1) or lower (−1) side, and cut off all triangles that can be."""
        left = self.last[polygon]
        if self.side[polygon] == -side:
            self.close(polygon, vertex)
            self.before[left] = -1
        else:
            left = self._cut_off(polygon, vertex, False)
        self.side[polygon] = side
        self._push(polygon, vertex, left)

    def close(self, polygon: int, vertex: int) -> None:
        """Cut all that is left of a polygon into triangles with a vertex that faces its chain."""
        self._cut_off(polygon, vertex, True)

    def _cut_off(self, polygon: int, vertex: int, faces_chain: bool) -> int:
        """Cut triangles with a new vertex off the end of a polygon's chain; return the entry up to which it is left."""
        is_above, entry = self.side[polygon] > 0, self.last[polygon]
        while self.before[entry] >= 0:
            near, far = self.vertex[entry], self.vertex[self.before[entry]]
            second, third = vertex if is_above else near, near if is_above else vertex
            side = turn(self.points, far, second, third)
            if side < 0 or (side == 0 and not self._is_cut_flat(far, near, vertex, faces_chain)):
                break
            first = 3 * self.n_triangles
            self.faces[first], self.faces[first + 1], self.faces[first + 2] = far, second, third
            self.n_triangles += 1
            entry = self.before[entry]
        return entry

    def _is_cut_flat(self, far: int, near: int, vertex: int, faces_chain: bool) -> bool:
        """Tell whether a triangle without area is cut off: if it must be, or to leave no place twice in a row."""
        return self.is_flat and (faces_chain or self._is_same(far, near) or self._is_same(near, vertex))

    def _is_same(self, one: int, other: int) -> bool:
        """Tell whether two vertices are at the same place."""
        places = self.points.places
        return places[2 * one] == places[2 * other] and places[2 * one + 1] == places[2 * other + 1]
