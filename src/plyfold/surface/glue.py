"""Copies of the cells' triangles, one per sheet, glued along the borders into a disk."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.planar_map import Ints
from plyfold.surface.halfedges import HalfEdges, following
from plyfold.surface.triangulation import CellTriangulation

if TYPE_CHECKING:
    from plyfold.layering import Layering

__all__ = ["LiftedMesh", "glue_sheets"]


@dataclass(frozen=True, eq=False)
class LiftedMesh:
    """The disk as a triangle mesh, with everything but its heights.

    Parameters
    ----------
    planar_vertex : (v,) int
        The point of the planar triangulation below each vertex.
    faces : (m, 3) int
        Vertices of each triangle, counter-clockwise seen from above.
    sheet : (m,) int
        The sheet of each triangle.
    boundary : (b,) int
        The vertices along the curve, from the curve's first point: 0, 1, …, b − 1.
    level : (v,) int
        How many vertices lie below each vertex, over the same point.
    stacked : (c, 2) int
        Rows (lower, upper): vertices next to each other over the same point.
    """

    planar_vertex: Ints
    faces: Ints
    sheet: Ints
    boundary: Ints
    level: Ints
    stacked: Ints


@dataclass(frozen=True, eq=False)
class _Copies:
    """Which triangle and sheet each lifted triangle is a copy of, and how to find the copy for both.

    The copies of a triangle follow each other, in the order of the sheets over its cell.
    """

    triangle: Ints
    sheet: Ints
    first: Ints
    first_sheet: Ints

    def lifted(self, half_edge: Ints, sheet: Ints) -> Ints:
        """Return the half-edges over the given ones, in the given sheets."""
        triangle, side = np.divmod(half_edge, 3)
        return np.asarray(3 * (self.first[triangle] + sheet - self.first_sheet[triangle]) + side)


def glue_sheets(layering: Layering, mesh: CellTriangulation) -> LiftedMesh:
    """Copy the triangles of each cell once per sheet and glue the copies as the immersion says.

    Parameters
    ----------
    layering : Layering
    mesh : CellTriangulation
        Of the same arrangement.

    Returns
    -------
    LiftedMesh
        Corners of triangles are joined, not points of sheets: a cell can touch itself at a crossing, and then its
        sheets have two different vertices there. Cost: O(m log m) for m lifted triangles.

    Examples
    --------
    >>> from plyfold.immersion import find_immersion
    >>> from plyfold.layering import find_layering
    >>> from plyfold.surface.triangulation import triangulate
    >>> triangle = find_layering(find_immersion([(0, 0), (1, 0), (0, 1)]))
    >>> lifted = glue_sheets(triangle, triangulate(triangle.immersion.arrangement, max_area=1.0))
    >>> lifted.faces.shape, lifted.boundary.tolist(), lifted.stacked.tolist()
    ((1, 3), [0, 1, 2], [])
    """
    sides = HalfEdges(mesh.triangles)
    copies = _copy(layering, mesh)
    left = sides.find(mesh.chain, np.roll(mesh.chain, -1))
    upper, lower = _seams(layering, mesh, sides, copies, left)
    own = layering.immersion.own_sheet[mesh.chain_border]
    along = copies.lifted(left, own)
    vertex = _boundary_first(_joined_corners(3 * len(copies.triangle), upper, lower), along)
    point_of_corner = mesh.triangles[copies.triangle].ravel()
    planar_vertex = np.empty(vertex.max() + 1, dtype=np.int64)
    planar_vertex[vertex] = point_of_corner
    return LiftedMesh(
        planar_vertex,
        vertex.reshape(-1, 3),
        copies.sheet,
        vertex[along],
        *_stacks(layering, mesh, copies, vertex, planar_vertex),
    )


def _copy(layering: Layering, mesh: CellTriangulation) -> _Copies:
    immersion = layering.immersion
    copies = immersion.arrangement.winding[mesh.cell]
    first = np.cumsum(copies) - copies
    triangle = np.repeat(np.arange(len(copies)), copies)
    first_sheet = immersion.first_sheet[mesh.cell]
    return _Copies(triangle, first_sheet[triangle] + np.arange(len(triangle)) - first[triangle], first, first_sheet)


def _seams(
    layering: Layering, mesh: CellTriangulation, sides: HalfEdges, copies: _Copies, left: Ints
) -> tuple[Ints, Ints]:
    """Return pairs of lifted half-edges that are to be one edge."""
    twin = sides.twin
    right = twin[left]
    twin[left] = twin[right[right >= 0]] = -1
    half_edge = (3 * copies.triangle[:, None] + np.arange(3)).ravel()
    sheet = np.repeat(copies.sheet, 3)
    within = np.flatnonzero(twin[half_edge] > half_edge)
    across_first, across_second = _across_borders(layering, mesh, copies, left, right)
    return (
        np.concatenate([within, across_first]),
        np.concatenate([copies.lifted(twin[half_edge[within]], sheet[within]), across_second]),
    )


def _across_borders(
    layering: Layering, mesh: CellTriangulation, copies: _Copies, left: Ints, right: Ints
) -> tuple[Ints, Ints]:
    """Return the pairs of lifted half-edges on the two sides of the curve that the immersion's gluing joins."""
    border, right_sheet, left_sheet = layering.immersion.gluing.T
    count = np.bincount(border, minlength=layering.immersion.arrangement.n_borders)
    start = np.cumsum(count) - count
    times = count[mesh.chain_border]
    piece = np.repeat(np.arange(len(times)), times)
    row = start[mesh.chain_border[piece]] + np.arange(len(piece)) - np.repeat(np.cumsum(times) - times, times)
    return copies.lifted(left[piece], left_sheet[row]), copies.lifted(right[piece], right_sheet[row])


def _joined_corners(corners: int, first: Ints, second: Ints) -> Ints:
    """Return the vertex of each corner, where the second half-edges run against the first and coincide with them."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    a = np.concatenate([first, following(first)])
    b = np.concatenate([following(second), second])
    graph = coo_array((np.ones(len(a), dtype=np.int8), (a, b)), shape=(corners, corners))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _boundary_first(vertex: Ints, along: Ints) -> Ints:
    """Renumber the vertices: first those at the corners along the curve, in order, then the others."""
    number = np.full(vertex.max() + 1, -1)
    number[vertex[along]] = np.arange(len(along))
    inner = number < 0
    number[inner] = len(along) + np.arange(inner.sum())
    return np.asarray(number[vertex])


def _stacks(
    layering: Layering, mesh: CellTriangulation, copies: _Copies, vertex: Ints, planar_vertex: Ints
) -> tuple[Ints, Ints]:
    """Return the level of each vertex and the pairs of vertices next to each other over a point.

    Around a crossing lie four cells; every sheet of the other three is glued to one of the highest cell, so its
    order is the order of all vertices over the crossing. Along a border, likewise.
    """
    winding = layering.immersion.arrangement.winding[mesh.cell]
    corner_of_point = np.zeros(len(mesh.points), dtype=np.int64)
    by_height = np.argsort(winding, kind="stable")
    corner_of_point[mesh.triangles[by_height].ravel()] = (3 * by_height[:, None] + np.arange(3)).ravel()
    top = corner_of_point[planar_vertex]
    sheets = winding[top // 3]
    # Every vertex over a point is the corner of exactly one copy of the point's highest triangle.
    at = np.unique(planar_vertex, return_index=True)[1]
    repeated = np.repeat(top[at], sheets[at])
    step = np.arange(len(repeated)) - np.repeat(np.cumsum(sheets[at]) - sheets[at], sheets[at])
    sheet = copies.first_sheet[repeated // 3] + step
    stacked_vertex = vertex[copies.lifted(repeated, sheet)]
    level = np.empty(len(planar_vertex), dtype=np.int64)
    level[stacked_vertex] = layering.level[sheet] - 1
    order = np.lexsort((level, planar_vertex))
    above = np.flatnonzero(np.diff(planar_vertex[order]) == 0)
    return level, np.stack([order[above], order[above + 1]], axis=1)
