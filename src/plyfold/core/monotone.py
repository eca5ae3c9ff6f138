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

from plyfold.core.buffers import WholeBuffer, whole_room
from plyfold.core.turns import ExactPoints, turn

__all__ = ["MonotonePolygons"]


class MonotonePolygons:
    """The polygons as far as they are not cut into triangles yet: a vertex, and a chain of others on one side.

    They are stacks whose entries hold a vertex and the entry before, or −1, and the edge from there; polygon i has the
    entry ``last[i]`` on top. The chain is above, ``side`` 1, or below, −1; there is none, 0, beside a single vertex. It
    bends inward: no triangle can be cut off. ``rung`` is the edge from what was left of a chain to the last vertex.

    Parameters
    ----------
    points : ExactPoints
        The vertices.
    is_flat : bool
        Whether polygons may have no width. Then there may be triangles without area.
    most, entries : int
        How many polygons, and how many entries of all together, there can be.
    faces, sides : buffer of int
        Room for triangles and for the edges at their sides, three numbers each. Side i of a triangle runs from its
        corner i to the next one.
    """

    def __init__(
        self, points: ExactPoints, is_flat: bool, most: int, entries: int, faces: WholeBuffer, sides: WholeBuffer
    ) -> None:
        self.points, self.is_flat, self.faces, self.sides = points, is_flat, faces, sides
        self.n_polygons = self.n_entries = self.n_triangles = self.n_edges = 0
        self.rung = -1
        self.room = whole_room(2 * most + 3 * entries)
        self.last, self.side = self.room[:most], self.room[most : 2 * most]
        stacks = self.room[2 * most :]
        self.vertex, self.before = stacks[:entries], stacks[entries : 2 * entries]
        self.edge = stacks[2 * entries :]

    def new_edge(self) -> int:
        """Return a number for an edge."""
        self.n_edges += 1
        return self.n_edges - 1

    def begin(self, vertex: int) -> int:
        """Return a polygon that begins at a vertex."""
        polygon = self.n_polygons
        self.n_polygons += 1
        self.side[polygon] = 0
        self._push(polygon, vertex, -1, -1)
        return polygon

    def begin_behind(self, polygon: int) -> int:
        """Return a polygon that begins at the vertex which another one has got last."""
        return self.begin(self.vertex[self.last[polygon]])

    def _push(self, polygon: int, vertex: int, before: int, edge: int) -> None:
        """Put a vertex on a stack; before it are an entry, and an edge from there."""
        entry = self.n_entries
        self.n_entries += 1
        self.vertex[entry] = vertex
        self.before[entry], self.edge[entry] = before, edge
        self.last[polygon] = entry

    def add(self, polygon: int, vertex: int, side: int, edge: int) -> None:
        """Add a vertex to a polygon, on its upper (1) or lower (−1) side, and cut off all triangles that can be.

        The edge is the one along this side that leads to the vertex.
        """
        left = self.last[polygon]
        if self.side[polygon] == -side:
            across = self.new_edge()
            self.close(polygon, vertex, across, edge)
            self.before[left] = -1
            self.rung = across
        else:
            left = self._cut_off(polygon, vertex, edge, -1)
        self.side[polygon] = side
        self._push(polygon, vertex, left, self.rung)

    def close(self, polygon: int, vertex: int, near: int, far: int) -> None:
        """Cut all that is left of a polygon into triangles with a vertex that faces its chain.

        Edges lead to the vertex from the near end of the chain, which is the last one, and from the far end.
        """
        self._cut_off(polygon, vertex, near, far)

    def _cut_off(self, polygon: int, vertex: int, edge: int, last_edge: int) -> int:
        """Cut triangles with a new vertex off the end of a polygon's chain; return the entry up to which it is left.

        The first of these triangles has an edge to the vertex, and if this faces the chain, so that they are cut off up
        to the far end, the last of them has another one.
        """
        is_above, faces_chain, entry = self.side[polygon] > 0, last_edge >= 0, self.last[polygon]
        self.rung = edge
        while self.before[entry] >= 0 and self._is_cut(entry, vertex, is_above, faces_chain):
            edge, before = self.rung, self.before[entry]
            self.rung = last_edge if faces_chain and self.before[before] < 0 else self.new_edge()
            self._add_triangle(entry, vertex, is_above, edge)
            entry = before
        return entry

    def _is_cut(self, entry: int, vertex: int, is_above: bool, faces_chain: bool) -> bool:
        """Tell whether the triangle of an entry's vertex, the one before on a chain, and a new one is cut off."""
        near, far = self.vertex[entry], self.vertex[self.before[entry]]
        sign = turn(self.points, far, vertex if is_above else near, near if is_above else vertex)
        return sign > 0 or (sign == 0 and self._is_cut_flat(far, near, vertex, faces_chain))

    def _add_triangle(self, entry: int, vertex: int, is_above: bool, edge: int) -> None:
        """Add such a triangle, counter-clockwise; an edge leads to its new vertex from the entry's one."""
        near, far, chain = self.vertex[entry], self.vertex[self.before[entry]], self.edge[entry]
        first = 3 * self.n_triangles
        self.n_triangles += 1
        self.faces[first], self.sides[first + 1] = far, edge
        if is_above:
            self.faces[first + 1], self.faces[first + 2] = vertex, near
            self.sides[first], self.sides[first + 2] = self.rung, chain
        else:
            self.faces[first + 1], self.faces[first + 2] = near, vertex
            self.sides[first], self.sides[first + 2] = chain, self.rung

    def _is_cut_flat(self, far: int, near: int, vertex: int, faces_chain: bool) -> bool:
        """Tell whether a triangle without area is cut off: if it must be, or to leave no place twice in a row."""
        return self.is_flat and (faces_chain or self._is_same(far, near) or self._is_same(near, vertex))

    def _is_same(self, one: int, other: int) -> bool:
        """Tell whether two vertices are at the same place."""
        places = self.points.places
        return places[2 * one] == places[2 * other] and places[2 * one + 1] == places[2 * other + 1]
