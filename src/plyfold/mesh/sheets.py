"""Copies of the cells' triangles, one per sheet, glued along the borders into a surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from plyfold.arrays import Bools, Ints
from plyfold.errors import InputError
from plyfold.graphs import components
from plyfold.halfedges import following
from plyfold.immersion.corners import feet
from plyfold.immersion.immersion import Immersion, require_memory_for_gluing
from plyfold.memory import require_memory
from plyfold.mesh.cells import CellTriangulation
from plyfold.mesh.strips import Strips
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
        The vertices along the boundary, 0, 1, …, b − 1: loop after loop, each from its first point. Where the outline
        touches itself, its loops are those of the surface that is left, each from the first piece of the outline on it.
    first_boundary : (loops + 1,) int
        Where in this row each loop begins, and last its length.
    first_copy, first_sheet : (t,) int
        For each planar triangle its first copy and the sheet of that.
    """

    planar_vertex: Ints
    faces: Ints
    sheet: Ints
    boundary: Ints
    first_boundary: Ints
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
    copy_of_sheet = first_copy - first_sheet
    seams, own_sheet = seams_and_own_sheets(immersion, mesh.strips)
    piece = np.flatnonzero(own_sheet[mesh.chain_border] >= 0)
    along = _lifted(mesh.left[piece], own_sheet[mesh.chain_border[piece]], copy_of_sheet)
    shared = np.flatnonzero(_under_several(immersion, mesh)[point])
    below = 3 * triangle[shared // 3] + shared % 3
    beside = _beside(seams, mesh, below, sheet[shared // 3], copy_of_sheet)
    label = _joined(point, shared, beside, len(mesh.points))
    along, first_boundary = _loops(label, along) if mesh.strips else (along, mesh.first_piece)
    vertex = _boundary_first(label, along)
    planar_vertex = np.empty(vertex.max() + 1, dtype=np.int64)
    planar_vertex[vertex] = point
    boundary = vertex[along]
    return SheetMesh(planar_vertex, vertex.reshape(-1, 3), sheet, boundary, first_boundary, first_copy, first_sheet)


def seams_and_own_sheets(immersion: Immersion, strips: Strips | None) -> tuple[Seams, Ints]:
    """Return the gluing over the borders of a drawing, and the sheet on the left of each that ends there.

    On its given points there is none, −1, where the sheet of the moved outline lies in thin cells alone.
    """
    seams = seams_of(immersion)
    if strips is None:
        return seams, immersion.own_sheet
    return _seams_across(immersion, strips, seams), _own_sheets(immersion, strips, seams)


def _seams_across(immersion: Immersion, strips: Strips, seams: Seams) -> Seams:
    """Return the gluing across all that runs side by side: dart 2j leads across border j and all borders beside it."""
    borders = len(strips.order)
    cell = strips.cell[np.stack([strips.left_face, strips.right_face], axis=1).ravel()]
    count = immersion.arrangement.winding[cell]
    row = starts_of(count) - immersion.first_sheet[cell]
    dart = np.repeat(np.arange(2 * borders), count)
    first, last = strips.ends_of_parts
    # Dart 2j comes from the left of border j; that may be the right of its part.
    leftward = (dart % 2 == 1) != strips.backward[dart // 2]
    ways = _Ways(np.where(leftward, first[dart // 2], last[dart // 2]), leftward, (last - first)[dart // 2] + 1)
    return Seams(row, _followed(strips, seams, np.arange(len(dart)) - row[dart], ways))


def _own_sheets(immersion: Immersion, strips: Strips, seams: Seams) -> Ints:
    """Return the sheet on the left of each border, and of all that run beside it, that ends at it; or −1."""
    first, last = strips.ends_of_parts
    leftward, place = ~strips.backward, strips.place
    ways = _Ways(np.where(leftward, place + 1, place - 1), leftward, np.where(leftward, last - place, place - first))
    return _followed(strips, seams, immersion.own_sheet[strips.moved_border], ways)


class _Ways(NamedTuple):
    """Ways across so many borders side by side, from the one at a place in their order, to the left or to the right."""

    place: Ints
    leftward: Bools
    steps: Ints


def _followed(strips: Strips, seams: Seams, sheet: Ints, ways: _Ways) -> Ints:
    """Return the sheets that some lead to on their ways; −1 where they end."""
    found = sheet.copy()
    for step in range(int(ways.steps.max(initial=0))):
        going = np.flatnonzero((ways.steps > step) & (found >= 0))
        leftward = ways.leftward[going]
        border = strips.order[ways.place[going] + np.where(leftward, step, -step)]
        # From the right of a border comes its second dart.
        dart = 2 * strips.moved_border[border] + (leftward != strips.backward[border])
        found[going] = seams.beyond(dart, found[going])
    return found


def _lifted(half_edge: Ints, sheet: Ints, copy_of_sheet: Ints) -> Ints:
    """Return lifted half-edges; ``copy_of_sheet`` plus a sheet is the number of the triangle's copy in that sheet."""
    triangle = half_edge // 3
    return np.asarray(3 * (copy_of_sheet[triangle] + sheet - triangle) + half_edge)


def _under_several(immersion: Immersion, mesh: CellTriangulation) -> Bools:
    """Tell over which points there may be more than one vertex.

    A sheet of a cell with winding number 2 comes there, or the outline touches itself.
    """
    several = np.zeros(len(mesh.points), dtype=bool)
    if mesh.strips:
        several[mesh.chain] = True
    several[mesh.triangles[immersion.arrangement.winding[mesh.cell] > 1].ravel()] = True
    return several


def _beside(seams: Seams, mesh: CellTriangulation, below: Ints, sheet: Ints, copy_of_sheet: Ints) -> Ints:
    """Return the lifted half-edge glued to each lifted half-edge, named by what is below and its sheet; or −1."""
    dart = np.full(3 * len(mesh.cell), -1)
    for side, half_edge in enumerate((mesh.left, mesh.right)):
        covered = half_edge >= 0
        dart[half_edge[covered]] = 2 * mesh.chain_border[covered] + side
    dart = dart[below]
    crossing = np.flatnonzero(dart >= 0)
    target = sheet.copy()
    target[crossing] = seams.beyond(dart[crossing], sheet[crossing])
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


def _loops(label: Ints, along: Ints) -> tuple[Ints, Ints]:
    """Return half-edges of the boundary, loop after loop, each from its first one; and where these begin."""
    start, end = label[along], label[following(along)]
    from_vertex = np.empty(label.max() + 1, dtype=np.int64)
    from_vertex[start] = np.arange(len(along))
    after, order, first = from_vertex[end].tolist(), [], [0]
    seen = [False] * len(after)
    for at in range(len(after)):
        while not seen[at]:
            seen[at] = True
            order.append(at)
            at = after[at]  # noqa: PLW2901 - round the loop
        if len(order) > first[-1]:
            first.append(len(order))
    return along[order], np.array(first)


def _boundary_first(label: Ints, along: Ints) -> Ints:
    """Renumber the vertices: first those at the corners along the curve, in order, then the others."""
    used = np.zeros(label.max() + 1, dtype=bool)
    used[label] = True
    used[label[along]] = False
    number = len(along) + np.cumsum(used) - 1
    number[label[along]] = np.arange(len(along))
    return np.asarray(number[label])
