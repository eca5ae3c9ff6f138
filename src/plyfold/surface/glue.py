"""The disk of glued sheets, with the order in which they lie upon each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.intersections import IntersectingLayering
from plyfold.mesh.cells import CellTriangulation
from plyfold.mesh.sheets import SheetMesh, glue_copies
from plyfold.surface.passages import passing_edges, stacked_but_passing

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
        Rows (lower, upper): vertices next to each other over the same point. Over points where sheets pass through
        each other, all pairs of vertices but those that do.
    passing : (e, 4) int
        Rows (a, b, c, d): one sheet has an edge from a to b and another one an edge from c to d, over the same piece
        of a border, along which they pass through each other. Their order there is open.
    """

    planar_vertex: Ints
    faces: Ints
    sheet: Ints
    boundary: Ints
    level: Ints
    stacked: Ints
    passing: Ints


def glue_sheets(
    layering: Layering | IntersectingLayering, mesh: CellTriangulation, watch: Watch = UNWATCHED
) -> LiftedMesh:
    """Copy the triangles of each cell once per sheet, glue the copies and stack them.

    Parameters
    ----------
    layering : Layering or IntersectingLayering
    mesh : CellTriangulation
        Of the same arrangement.
    watch : Watch, optional

    Returns
    -------
    LiftedMesh
        Cost: O(m log m) for m lifted triangles.

    Examples
    --------
    >>> from plyfold.mesh.cells import triangulate_cells
    >>> from plyfold import find_immersion
    >>> from plyfold import find_layering
    >>> triangle = find_layering(find_immersion([(0, 0), (1, 0), (0, 1)]))
    >>> lifted = glue_sheets(triangle, triangulate_cells(triangle.immersion.arrangement, max_area=1.0))
    >>> lifted.faces.shape, lifted.boundary.tolist(), lifted.stacked.tolist()
    ((1, 3), [0, 1, 2], [])
    """
    watch = watch.begin("gluing the sheets")
    immersion, copies = layering.immersion, int(layering.immersion.arrangement.winding[mesh.cell].sum())
    glued = watch.wait_for(lambda: glue_copies(immersion, mesh), copies)
    level, stacked = watch.wait_for(lambda: _stacks(immersion, layering.level, mesh, glued), copies)
    passing = np.empty((0, 4), dtype=np.int64)
    if isinstance(layering, IntersectingLayering):
        watch.step()
        passing = passing_edges(layering, mesh, glued)
        stacked = stacked_but_passing(stacked, level, glued.planar_vertex, passing)
    return LiftedMesh(
        glued.planar_vertex, glued.faces, glued.sheet, glued.boundary, level=level, stacked=stacked, passing=passing
    )


def _stacks(immersion: Immersion, sheet_level: Ints, mesh: CellTriangulation, glued: SheetMesh) -> tuple[Ints, Ints]:
    """Return the level of each vertex and the pairs of vertices next to each other over a point.

    Around a crossing lie four cells; every sheet of the other three is glued to one of the highest cell, so its
    order is the order of all vertices over the crossing. Along a border, likewise.
    """
    winding = immersion.arrangement.winding[mesh.cell]
    corner_of_point = np.zeros(len(mesh.points), dtype=np.int64)
    by_height = np.argsort(winding, kind="stable")
    corner_of_point[mesh.triangles[by_height].ravel()] = (3 * by_height[:, None] + np.arange(3)).ravel()
    planar_vertex, vertex = glued.planar_vertex, glued.faces.ravel()
    top = corner_of_point[planar_vertex]
    sheets = winding[top // 3]
    # Every vertex over a point is the corner of exactly one copy of the point's highest triangle.
    at = np.unique(planar_vertex, return_index=True)[1]
    repeated = np.repeat(top[at], sheets[at])
    step = np.arange(len(repeated)) - np.repeat(np.cumsum(sheets[at]) - sheets[at], sheets[at])
    sheet = glued.first_sheet[repeated // 3] + step
    stacked_vertex = vertex[glued.lifted(repeated, sheet)]
    level = np.empty(len(planar_vertex), dtype=np.int64)
    level[stacked_vertex] = sheet_level[sheet] - 1
    order = np.lexsort((level, planar_vertex))
    above = np.flatnonzero(np.diff(planar_vertex[order]) == 0)
    return level, np.stack([order[above], order[above + 1]], axis=1)
