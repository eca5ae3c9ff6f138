"""One triangulation of the whole drawing, cut along its borders into cells."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, partial
from math import sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.certify.surface import check_rounded
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import CertificateError, InputError, PrecisionError
from plyfold.graphs import components
from plyfold.halfedges import half_edges_from_to
from plyfold.mesh.mend import FREE, GIVEN, Edged, Limits, mend_angles, sharp_triangles
from plyfold.mesh.refine import (
    ENCLOSING,
    NodedCurve,
    PlanarMesh,
    Size,
    chain_of,
    constrained,
    given_outline,
    is_moved,
    left_of_chain,
    noded_curve,
    planar_mesh,
    refine,
    split_chain,
    split_points,
    too_close,
    usual_area,
)
from plyfold.mesh.strips import Strips, noded_strips, strips_of
from plyfold.options import refuse_unless_number
from plyfold.outline.points import refuse_tiny
from plyfold.ragged import next_in_rows

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = [
    "DEFAULT_TRIANGLES",
    "MOST_TRIANGLES",
    "CellTriangulation",
    "area_of_edge",
    "chain_of",
    "refuse_broken",
    "refuse_max_area",
    "refuse_sizes",
    "triangulate_cells",
]


DEFAULT_TRIANGLES = 4000
MOST_TRIANGLES = 10_000_000
# No edge shorter than so many roundings is split: points on it would not lie well enough on a line.
_FINEST = (2.0**10, 2.0**24)
# Where points that were added do not fit, they are taken out so many times at most.
_MOST_REPAIRS = 20
# Angles outside thin strips may take so many triangles more, as a share of those that were asked for, or there are.
_MENDING = 0.28
# Few triangles may become so many times those of the curve alone.
_GROWTH = 3
# Shares of the number asked for that are tried for the rest.
_SHARES = (1.0, 0.5, 0.25)


@dataclass(frozen=True, eq=False)
class CellTriangulation:
    """Triangles over the cells that the surface covers.

    Half-edge 3t + i runs along the side of triangle t that starts at its corner i.

    Parameters
    ----------
    points : (p, 2) float
        The points of the outline in their order, bit for bit; then the crossings, rounded; then points added for the
        quality of the triangles. Of an outline whose points were moved apart, those given and its crossings in no such
        order, each place once.
    triangles : (t, 3) int
        Counter-clockwise (exactly) and none across a border.
    twin : (3t,) int
        The half-edge on the other side of each half-edge, -1 where there is no triangle.
    cell : (t,) int
        The cell each triangle lies in; its winding number is at least 1.
    chain : (s,) int
        The points along the loops in order, each from its first point, crossings and added points included (a crossing
        occurs twice). Piece j of the outline runs from ``chain[j]`` to ``chain[j + 1]``, the last one of a loop back to
        its first point. On given points several pieces may run along the same edge.
    chain_border : (s,) int
        The border each piece belongs to; with ``strips`` it is one of those.
    first_piece : (loops + 1,) int
        Loop l consists of the pieces from ``first_piece[l]`` up to ``first_piece[l + 1]``.
    left : (s,) int
        The half-edge along each piece, in the triangle on its left; -1 where there is none.
    strips : Strips, optional
        The borders on the given points, if points of the outline were moved apart.
    """

    points: Floats
    triangles: Ints
    twin: Ints
    cell: Ints
    chain: Ints
    chain_border: Ints
    first_piece: Ints
    left: Ints
    strips: Strips | None = None

    @property
    def chain_end(self) -> Ints:
        """The point at which each piece of the outline ends."""
        return self.chain[next_in_rows(self.first_piece)]

    @cached_property
    def right(self) -> Ints:
        """The half-edge along each piece, in the triangle on its right; -1 where there is none."""
        right = np.where(self.left >= 0, self.twin[self.left], -1)
        alone = np.flatnonzero(self.left < 0)
        if len(alone):
            right[alone] = half_edges_from_to(self.triangles, self.chain_end[alone], self.chain[alone])
        return right

    @property
    def beside(self) -> Ints:
        """The half-edge along each piece on its left, or else on its right; -1 where nothing is covered."""
        return np.where(self.left >= 0, self.left, self.right)

    def places_of(self, points: Ints) -> Ints:
        """Return the numbers here of points of the outline."""
        if self.strips is None:
            return points
        strands = self.strips.strands
        return np.unique(strands.start[strands.first[points]])


def triangulate_cells(
    arrangement: Arrangement,
    max_area: float | None = None,
    triangles: int = DEFAULT_TRIANGLES,
    watch: Watch = UNWATCHED,
) -> CellTriangulation:
    """Triangulate all cells with winding number 1 or more, with the borders as edges.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing.
    max_area : float, optional
        Largest area of a triangle, in square units of the drawing; by default it follows from ``triangles``.
    triangles : int, optional
        Roughly how many triangles the *lifted surface* shall have (a triangle over a cell with winding number w counts
        w times). With 0, no points are added.
    watch : Watch, optional

    Returns
    -------
    CellTriangulation
        Angles are at least 25°, and triangles grow from fine features to the usual size. A triangle may have a sharper
        angle, opposite its shortest side, only if

        - the angle is between two edges that meet with less than 60°, or that side goes from one to the other, or
        - that side goes across a thin strip: from one edge to another that runs beside it for at least four times
          their distance, and less than 15° apart in direction.

        Edges here are those of the drawing, cut at crossings. All this holds if it takes no more triangles than 1.28
        times those that were asked for, or three times those of the curve alone (but then no more than the default);
        and as far as edges a thousand times longer than rounding errors allow it. Strips are filled well, too, where
        the number asked for is enough.

    Raises
    ------
    PrecisionError
        If the crossings, rounded to doubles, no longer draw the same cells; it names the place. Points that were added
        and do not fit, in strips as thin as rounding errors, are left out. Or if the whole drawing
        is so small that areas of triangles are no doubles.

    Notes
    -----
    Constrained Delaunay triangulation with Ruppert's refinement, by the library CDT; what that leaves around strips too
    thin for it is mended after Chew, triangle by triangle. Crossings are rational points and have to be rounded, so the
    cells are read off the triangulation and compared with the exact ones. O(n log n) for n triangles; about half a
    million triangles a second, and twenty thousand points a second in mending.

    Examples
    --------
    >>> from plyfold import arrange
    >>> mesh = triangulate_cells(arrange([(0, 0), (4, 0), (4, 4), (0, 4)]), max_area=100.0)
    >>> mesh.points[:4].tolist(), mesh.chain[0]
    ([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], np.int64(0))
    """
    watch = watch.begin("triangulating the cells")
    refuse_tiny(given_outline(arrangement).points, "a mesh")
    outline = noded_strips(strips_of(arrangement)) if is_moved(arrangement) else noded_curve(arrangement)
    if triangles:
        size = usual_area(outline, triangles, max_area)
        for finest in _FINEST:
            # Added points are rounded too, and may not fit where the cells are as thin as rounding errors.
            with suppress(PrecisionError):
                return _with_good_angles(arrangement, outline, size, finest * outline.rounding, watch)
    plain = _plain(outline, watch)
    return watch.wait_for(lambda: _verified(arrangement, outline, plain), len(plain.triangles))


def refuse_max_area(points: Floats, max_area: float) -> None:
    """Raise InputError for a largest area of triangles that is not positive, or so small that no machine can do it."""
    if not max_area > 0:
        raise InputError(f"the largest area of a triangle must be positive, not {max_area!r}")
    width, height = np.ptp(points, axis=0)
    if width * height > MOST_TRIANGLES * max_area:
        raise InputError(
            f"triangles of area {max_area:g} are too small for a drawing of {width:g} by {height:g}",
            hint=f"at most {MOST_TRIANGLES:,} triangles are made",
        )


def _plain(outline: NodedCurve, watch: Watch) -> PlanarMesh:
    """Triangulate without adding points."""
    return _planar(constrained(outline, watch), outline)


def _planar(library: Any, outline: NodedCurve) -> PlanarMesh:
    return planar_mesh(library, outline.points, outline.chain, outline.chain_border, outline.first_piece)


def _refined(
    arrangement: Arrangement, outline: NodedCurve, size: Size, finest: float, watch: Watch
) -> tuple[PlanarMesh, int]:
    """Triangulate, and refine what the surface covers; the library cannot take back steps that were too many.

    Also return how many triangles the surface has without points added.
    """
    while True:
        library = constrained(outline, watch)
        plain = _planar(library, outline)
        winding = arrangement.winding[_cells(outline, plain)[0]]
        affordable = refine(library, outline, winding, size, finest, watch=watch)
        if affordable <= finest:
            break
        finest = affordable
    corners = library.vertices_array()[ENCLOSING:]
    unit_points = np.stack([corners["x"], corners["y"]], axis=1)
    points = outline.centre + unit_points * outline.scale
    points[: len(outline.points)] = outline.points
    chain = split_chain(outline, unit_points, split_points(library, outline))
    return planar_mesh(library, points, *chain), int(winding[winding > 0].sum())


def _with_good_angles(
    arrangement: Arrangement, outline: NodedCurve, size: Size, finest: float, watch: Watch
) -> CellTriangulation:
    """Refine, and mend; if that takes too many triangles, larger ones elsewhere leave room for more."""
    found: list[CellTriangulation] = []
    for share in _SHARES:
        sparser = size._replace(wanted=share * size.wanted)
        refined, fewest = _refined(arrangement, outline, sparser, finest, watch)
        found.append(watch.wait_for(partial(_repaired, arrangement, outline, refined), len(refined.triangles)))
        enough = max((1 + _MENDING) * size.wanted, min(_GROWTH * fewest, DEFAULT_TRIANGLES))
        mend = partial(_mended, arrangement, outline, found[-1], enough, finest)
        mended = watch.wait_for(mend, int(enough))
        if mended:
            return mended
        if size.most or len(found[-1].points) == len(outline.points):
            break
    return found[0]


def _mended(
    arrangement: Arrangement, outline: NodedCurve, mesh: CellTriangulation, enough: float, finest: float
) -> CellTriangulation | None:
    """Mend triangles with sharp angles outside thin strips, unless it takes too many triangles."""
    sharp = sharp_triangles((mesh.points - outline.centre) / outline.scale, mesh.triangles)
    if not len(sharp):
        return mesh
    winding = arrangement.winding[mesh.cell]
    more = max(enough - winding.sum(), _MENDING * winding.sum())
    limits = Limits(int(more / (2 * winding.mean())), finest)
    mended = mend_angles(_edged(outline, mesh), sharp, (outline.edges[:, 0], outline.edges[:, 1]), limits)
    if not mended:
        return None
    drawn = _drawn(outline, mesh, mended)
    with suppress(PrecisionError):
        refuse_broken(arrangement, drawn)
        return drawn
    return mesh


def _drawn(outline: NodedCurve, mesh: CellTriangulation, mended: Edged) -> CellTriangulation:
    """Return a mesh with the points that mending has added."""
    points = outline.centre + mended.points * outline.scale
    points[: len(mesh.points)] = mesh.points
    triangles = mended.start.reshape(-1, 3)
    added = np.flatnonzero(mended.on >= 0)
    chain = split_chain(outline, mended.points, np.stack([mended.on[added], added], axis=1))
    left = left_of_chain(triangles, *_ends(*chain), outline.strips is not None)
    return CellTriangulation(points, triangles, mended.beyond, mended.cell, *chain, left, outline.strips)


def _ends(chain: Ints, chain_border: Ints, first_piece: Ints) -> tuple[Ints, Ints]:
    """Return the points at both ends of each piece of a chain."""
    return chain, chain[next_in_rows(first_piece)]


def _edged(outline: NodedCurve, mesh: CellTriangulation) -> Edged:
    """Return triangles in the unit square, with the edges of the outline that points and half-edges are on."""
    known = len(outline.points)
    edge_of_chain = outline.edge_of_piece[np.cumsum(mesh.chain < known) - 1]
    on = np.full(len(mesh.points), FREE)
    on[mesh.chain] = edge_of_chain
    on[:known] = GIVEN
    edge = np.full(len(mesh.twin), -1)
    for side in (mesh.left, mesh.right):
        edge[side[side >= 0]] = edge_of_chain[side >= 0]
    unit_points = (mesh.points - outline.centre) / outline.scale
    return Edged(unit_points, on, mesh.triangles.ravel(), mesh.twin, edge, mesh.cell)


def _verified(arrangement: Arrangement, outline: NodedCurve, mesh: PlanarMesh) -> CellTriangulation:
    """Keep the triangles over covered cells; they must be what they should be, exactly."""
    cell, left = _cells(outline, mesh)
    keep = arrangement.winding[cell] > 0
    if not keep.any():
        hint = "coverage and fills of such an outline are empty, too"
        raise InputError(
            "the surface has no width anywhere, so there is no mesh of it", where=mesh.points[:1], hint=hint
        )
    kept = mesh.triangles[keep]
    moved = np.full(3 * len(keep) + 1, -1)  # one more, so that −1 stays −1
    moved[np.flatnonzero(np.repeat(keep, 3))] = np.arange(3 * len(kept))
    twin = moved[mesh.twin.reshape(-1, 3)[keep].ravel()]
    points = mesh.points[:-ENCLOSING]
    chain = mesh.chain, mesh.chain_border, mesh.first_piece
    verified = CellTriangulation(points, kept, twin, cell[keep], *chain, moved[left], outline.strips)
    refuse_broken(arrangement, verified)
    return verified


def _repaired(arrangement: Arrangement, outline: NodedCurve, mesh: PlanarMesh) -> CellTriangulation:
    """Verify a mesh; where rounding has broken it, in strips as thin as rounding errors, with fewer points there."""
    for _ in range(_MOST_REPAIRS):
        try:
            return _verified(arrangement, outline, mesh)
        except PrecisionError as error:
            unfit = _unfit(outline, mesh, np.array(error.where))
            if not len(unfit):
                raise
            mesh = _without(outline, mesh, unfit)
    return _verified(arrangement, outline, mesh)


def _unfit(outline: NodedCurve, mesh: PlanarMesh, places: Floats) -> Ints:
    """Return the points that were added at some places, and all others on the same pieces of the outline."""
    known = len(outline.points)
    there = np.zeros(len(mesh.points), dtype=bool)
    there[known:] = np.isin(mesh.points[known:].view(complex), places.view(complex)).ravel()
    piece = np.cumsum(mesh.chain < known) - 1
    on_same = np.isin(piece, piece[there[mesh.chain]]) & (mesh.chain >= known)
    there[mesh.chain[on_same]] = True
    return np.flatnonzero(there)


def _without(outline: NodedCurve, mesh: PlanarMesh, unfit: Ints) -> PlanarMesh:
    """Triangulate again without some of the points."""
    kept = np.delete(np.arange(len(mesh.points) - ENCLOSING), unfit)
    number = np.full(len(mesh.points), -1)
    number[kept] = np.arange(len(kept))
    along = number[mesh.chain] >= 0
    points = mesh.points[kept]
    fewer = replace(
        outline,
        points=points,
        chain=number[mesh.chain[along]],
        chain_border=mesh.chain_border[along],
        first_piece=np.append(0, np.cumsum(along))[mesh.first_piece],
        unit_points=(points - outline.centre) / outline.scale,
    )
    return _plain(fewer, UNWATCHED)


def refuse_broken(arrangement: Arrangement, mesh: CellTriangulation) -> None:
    """Raise PrecisionError where rounding has broken a mesh."""
    loops = given_outline(arrangement).loops
    try:
        check_rounded(loops, mesh.points, mesh.triangles, mesh.chain, mesh.first_piece)
    except CertificateError as error:
        raise too_close(error.where) from error


def _cells(outline: NodedCurve, mesh: PlanarMesh) -> tuple[Ints, Ints]:
    """Return the cell of each triangle: cut along the curve, the triangles must fall apart into exactly the cells.

    Also the half-edge on the left of each piece of the chain. The faces of a plane graph are what is inside of their
    boundary cycles. So if every component of triangles has only the borders of one cell on its sides, the right way
    round, and every cell only one component, the drawing is the exact one.
    """
    ends = _ends(mesh.chain, mesh.chain_border, mesh.first_piece)
    left = left_of_chain(mesh.triangles, *ends, outline.strips is not None)
    if len(missing := np.flatnonzero(left < 0)):
        raise too_close(mesh.points[mesh.chain[missing]])
    right = mesh.twin[left]
    component = _components(mesh, left, right)
    touching = np.concatenate([component[left // 3], component[right // 3]])
    cell = np.concatenate([outline.left_cell[mesh.chain_border], outline.right_cell[mesh.chain_border]])
    cell_of_component = np.full(component.max() + 1, -1)
    cell_of_component[touching] = cell
    component_of_cell = np.full(cell.max() + 1, -1)
    component_of_cell[cell] = touching
    wrong = (cell_of_component[touching] != cell) | (component_of_cell[cell] != touching)
    if wrong.any() or (cell_of_component < 0).any():
        raise too_close(mesh.points[np.concatenate([mesh.chain, mesh.chain])[wrong]])
    found = cell_of_component[component]
    return found if outline.strips is None else outline.strips.cell[found], left


def _components(mesh: PlanarMesh, left: Ints, right: Ints) -> Ints:
    """Return the component of each triangle when the mesh is cut along the chain."""
    twin = mesh.twin.copy()
    twin[left] = twin[right] = -1
    side = np.flatnonzero(np.arange(len(twin)) < twin)
    return components(len(mesh.triangles), side // 3, twin[side] // 3)


# ---- sizes of triangles that make a mesh -----------------------------------------------------------------------------

# Of triangles with equal sides to the area allowed: on average, refined ones have 0.6 of that.
_ALLOWED = sqrt(3) / 4 / 0.6


def refuse_sizes(points: Floats, triangles: int, max_area: float | None) -> None:
    """Raise InputError for sizes that make no mesh, or one that no machine can hold."""
    refuse_unless_number("triangles", triangles)
    if not 1 <= triangles <= MOST_TRIANGLES:
        raise InputError(f"the number of triangles must be from 1 to {MOST_TRIANGLES:,}, not {triangles!r}")
    if max_area is not None:
        refuse_unless_number("max_area", max_area)
        refuse_max_area(points, max_area)


def area_of_edge(size: float | None, max_area: float | None) -> float | None:
    """Return the largest area of triangles whose usual edge has the length ``size``, or ``max_area``."""
    if size is None:
        return max_area
    if max_area is not None:
        raise InputError("give the size of triangles by their edges or by their area, not by both")
    refuse_unless_number("size", size)
    if not size > 0:
        raise InputError(f"the usual length of edges must be positive, not {size!r}")
    return _ALLOWED * size * size
