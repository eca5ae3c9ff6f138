"""Copies of the cells' triangles, one per sheet, glued along the borders into a surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Ints
from plyfold.errors import InputError
from plyfold.graphs import components
from plyfold.halfedges import following
from plyfold.immersion.corners import feet
from plyfold.immersion.immersion import Immersion, require_memory_for_gluing
from plyfold.memory import require_memory
from plyfold.mesh.cells import CellTriangulation
from plyfold.ragged import count_each, starts_of

__all__ = ["Seams", "SheetMesh", "glue_copies", "seams_of", "twisted_bridges"]

# With what is needed to make them.
_BYTES_PER_SEAM = 40
_BYTES_PER_COPY = 350


@dataclass(frozen=True, eq=False)
class SheetMesh:
    """The surface as a flat triangle mesh.

    The copies of a planar triangle follow each other, in the order of the sheets over its cell.

    Parameters
    ----------
    planar_vertex : (v,) int
        The point of the planar triangulation below each vertex.
    faces : (m, 3) int
        Vertices of each triangle, counter-clockwise.
    sheet : (m,) int
        The sheet of each triangle.
    boundary : (b,) int
        The vertices along the outline, loop after loop, each from its first point: 0, 1, …, b − 1.
    first_copy, first_sheet : (t,) int
        For each planar triangle its first copy and the sheet of that.
    """

    planar_vertex: Ints
    faces: Ints
    sheet: Ints
    boundary: Ints
    first_copy: Ints
    first_sheet: Ints

    def lifted(self, half_edge: Ints, sheet: Ints) -> Ints:
        """Return the half-edges over those of the planar triangulation, in the given sheets."""
        return _lifted(half_edge, sheet, self.first_copy - self.first_sheet)


@dataclass(frozen=True, eq=False)
class Seams:
    """The gluing as a table: the sheet beyond a dart, seen from a sheet on its left, is ``table[row[dart] + sheet]``.

    It is −1 where the sheet ends: the dart's border is its own.
    """

    row: Ints
    table: Ints

    def beyond(self, dart: Ints, sheet: Ints) -> Ints:
        """Return the sheet on the right of each dart that is glued to the given one on its left."""
        return np.asarray(self.table[self.row[dart] + sheet])


def seams_of(immersion: Immersion) -> Seams:
    """Return the gluing as a table; bridges have darts after those of all borders, from their first feet to second."""
    arrangement = immersion.arrangement
    require_memory_for_gluing(arrangement, _BYTES_PER_SEAM)
    cell = np.append(arrangement.cell_of_dart, np.repeat(arrangement.cell_of_dart[arrangement.bridges[:, 0]], 2))
    count = arrangement.winding[cell]
    row = starts_of(count) - immersion.first_sheet[cell]
    table = np.full(int(count.sum()), -1)
    border, right, left = immersion.gluing.T
    table[row[2 * border] + left] = right
    table[row[2 * border + 1] + right] = left
    return Seams(row, table)


def twisted_bridges(immersion: Immersion) -> Ints:
    """Return the bridges over which sheets are glued to others: on the way round a ring, sheets change places."""
    bridge, right, left = immersion.gluing[immersion.gluing[:, 0] >= immersion.arrangement.n_borders].T
    return np.unique(bridge[right != left]) - immersion.arrangement.n_borders


def glue_copies(immersion: Immersion, mesh: CellTriangulation) -> SheetMesh:
    """Copy the triangles of each cell once per sheet and glue the copies as the immersion says.

    Parameters
    ----------
    immersion : Immersion
        Over bridges each sheet must be glued to itself: so it is in layerings, where gluings keep the order of sheets.
    mesh : CellTriangulation
        Of the same arrangement.

    Returns
    -------
    SheetMesh
        Corners of triangles are joined, not points of sheets: a cell can touch itself at a crossing, and then its
        sheets have two different vertices there; and round a cusp, several sheets share one vertex. Cost: linear in the
        number of copies.

    Examples
    --------
    >>> from plyfold.mesh.cells import triangulate_cells
    >>> from plyfold import find_immersion
    >>> triangle = find_immersion([(0, 0), (1, 0), (0, 1)])
    >>> glued = glue_copies(triangle, triangulate_cells(triangle.arrangement, triangles=0))
    >>> glued.faces.shape, glued.boundary.tolist()
    ((1, 3), [0, 1, 2])
    """
    if len(twisted := twisted_bridges(immersion)):
        raise InputError(
            "on the way round a ring, sheets change places: there is a flat mesh with the points of the outline alone",
            where=immersion.arrangement.visit_point[feet(immersion.arrangement)[twisted]],
            hint="triangulate(outline, immersion) makes it",
        )
    copies = immersion.arrangement.winding[mesh.cell]
    require_memory(
        _BYTES_PER_COPY * int(copies.sum()),
        f"a mesh of {int(copies.sum()):,} copies of triangles",
        immersion.arrangement,
        "triangulate(curve) fills the disk without them",
    )
    first_copy = starts_of(copies)
    first_sheet = immersion.first_sheet[mesh.cell]
    triangle = np.repeat(np.arange(len(copies)), copies)
    sheet = first_sheet[triangle] + count_each(copies)
    point = mesh.triangles[triangle].ravel()
    along = _lifted(mesh.left, immersion.own_sheet[mesh.chain_border], first_copy - first_sheet)
    shared = np.flatnonzero(_under_several(immersion, mesh)[point])
    below = 3 * triangle[shared // 3] + shared % 3
    beside = _beside(immersion, mesh, below, sheet[shared // 3], first_copy - first_sheet)
    vertex = _boundary_first(_joined(point, shared, beside, len(mesh.points)), along)
    planar_vertex = np.empty(vertex.max() + 1, dtype=np.int64)
    planar_vertex[vertex] = point
    return SheetMesh(planar_vertex, vertex.reshape(-1, 3), sheet, vertex[along], first_copy, first_sheet)


def _lifted(half_edge: Ints, sheet: Ints, copy_of_sheet: Ints) -> Ints:
    """Return lifted half-edges; ``copy_of_sheet`` plus a sheet is the number of the triangle's copy in that sheet."""
    triangle = half_edge // 3
    return np.asarray(3 * (copy_of_sheet[triangle] + sheet - triangle) + half_edge)


def _under_several(immersion: Immersion, mesh: CellTriangulation) -> Bools:
    """Tell over which points there is more than one vertex: a sheet of a cell with winding number 2 comes there."""
    several = np.zeros(len(mesh.points), dtype=bool)
    several[mesh.triangles[immersion.arrangement.winding[mesh.cell] > 1].ravel()] = True
    return several


def _beside(immersion: Immersion, mesh: CellTriangulation, below: Ints, sheet: Ints, copy_of_sheet: Ints) -> Ints:
    """Return the lifted half-edge glued to each lifted half-edge, named by what is below and its sheet; or −1."""
    dart = np.full(3 * len(mesh.cell), -1)
    dart[mesh.left] = 2 * mesh.chain_border
    right = mesh.twin[mesh.left]
    inside = right >= 0
    dart[right[inside]] = 2 * mesh.chain_border[inside] + 1
    dart = dart[below]
    crossing = np.flatnonzero(dart >= 0)
    target = sheet.copy()
    target[crossing] = seams_of(immersion).beyond(dart[crossing], sheet[crossing])
    twin = mesh.twin[below]
    return np.where((target >= 0) & (twin >= 0), _lifted(twin, target, copy_of_sheet), -1)


def _joined(point: Ints, shared: Ints, beside: Ints, points: int) -> Ints:
    """Return a number for the vertex at each corner; corners over shared points are joined across half-edges."""
    label = point.copy()
    if len(shared):
        place = np.full(len(point), -1)
        place[shared] = np.arange(len(shared))
        linked = np.flatnonzero(beside >= 0)
        label[shared] = points + components(len(shared), linked, place[following(beside[linked])])
    return label


def _boundary_first(label: Ints, along: Ints) -> Ints:
    """Renumber the vertices: first those at the corners along the curve, in order, then the others."""
    used = np.zeros(label.max() + 1, dtype=bool)
    used[label] = True
    used[label[along]] = False
    number = len(along) + np.cumsum(used) - 1
    number[label[along]] = np.arange(len(along))
    return np.asarray(number[label])
