"""The surface of glued sheets, with the order in which they lie upon each other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GeneralPositionError
from plyfold.graphs import components, ways_from
from plyfold.halfedges import ends_of, following
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.intersections import IntersectingLayering
from plyfold.mesh.cells import CellTriangulation
from plyfold.mesh.sheets import SheetMesh, glue_copies
from plyfold.mesh.strips import as_numbers, turns_unseen
from plyfold.ragged import count_each, pairs_in_each

__all__ = [
    "LiftedMesh",
    "copies_over_each_other",
    "cusps_of",
    "intersection_curves",
    "numbers_of_copies",
    "passing_edges",
    "shares_of_gap",
    "stack_sheets",
    "stacked_but_passing",
]


@dataclass(frozen=True, eq=False)
class LiftedMesh:
    """The surface as a triangle mesh, with everything but its heights.

    Parameters
    ----------
    planar_vertex : (v,) int
        The point of the planar triangulation below each vertex.
    faces : (m, 3) int
        Vertices of each triangle, counter-clockwise seen from above.
    sheet : (m,) int
        The sheet of each triangle.
    boundary : (b,) int
        The vertices along the boundary, 0, 1, …, b − 1, see :class:`~plyfold.mesh.sheets.SheetMesh`.
    first_boundary : (loops + 1,) int
        Where in this row each loop begins, and last its length.
    cusps : (c,) int
        The vertices at cusps.
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
    first_boundary: Ints
    cusps: Ints
    level: Ints
    stacked: Ints
    passing: Ints

    @cached_property
    def piece(self) -> Ints:
        """The connected piece that each vertex is in, (v,)."""
        if len(self.first_boundary) == 2:  # no piece is without boundary
            return np.zeros(len(self.level), dtype=np.int64)
        start, end = ends_of(self.faces)
        return components(len(self.level), start, end)

    @cached_property
    def heap(self) -> Ints:
        """A number for each vertex, (v,): the same for pieces that lie over each other."""
        if len(self.first_boundary) == 2:
            return self.piece
        lower, upper = self.piece[self.stacked].T
        return components(int(self.piece.max()) + 1, lower, upper)[self.piece]


def stack_sheets(
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
    >>> lifted = stack_sheets(triangle, triangulate_cells(triangle.immersion.arrangement, max_area=1.0))
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
    cusps = cusps_of(immersion.arrangement)
    if len(cusps):
        cusps = np.flatnonzero(turns_unseen(mesh.points[glued.planar_vertex], glued.faces))
    return LiftedMesh(
        planar_vertex=glued.planar_vertex,
        faces=glued.faces,
        sheet=glued.sheet,
        boundary=glued.boundary,
        first_boundary=glued.first_boundary,
        cusps=cusps,
        level=level,
        stacked=stacked,
        passing=passing,
    )


def cusps_of(arrangement: Arrangement) -> Ints:
    """Return the points of the outline that are cusps."""
    outline = arrangement.outline
    return np.empty(0, dtype=np.int64) if outline is None else np.flatnonzero(np.concatenate(outline.cusps))


def _stacks(immersion: Immersion, sheet_level: Ints, mesh: CellTriangulation, glued: SheetMesh) -> tuple[Ints, Ints]:
    """Return the level of each vertex and the pairs of vertices next to each other over a point.

    Around a crossing lie four cells; every sheet of the other three is glued to one of the highest cell, so its
    order is the order of all vertices over the crossing. Along a border, likewise. Of a cusp, the sheets around it are
    next to each other in this order, and have the vertex in common.
    """
    winding = immersion.arrangement.winding[mesh.cell]
    corner_of_point = np.zeros(len(mesh.points), dtype=np.int64)
    by_height = np.argsort(winding, kind="stable")
    corner_of_point[mesh.triangles[by_height].ravel()] = (3 * by_height[:, None] + np.arange(3)).ravel()
    planar_vertex, vertex = glued.planar_vertex, glued.faces.ravel()
    top = corner_of_point[planar_vertex]
    sheets = winding[top // 3]
    # Every vertex over a point is the corner of a copy of the point's highest triangle, and no cusp of only one.
    at = np.unique(planar_vertex, return_index=True)[1]
    repeated = np.repeat(top[at], sheets[at])
    sheet = glued.first_sheet[repeated // 3] + count_each(sheets[at])
    stacked_vertex = vertex[glued.lifted(repeated, sheet)]
    level = np.full(len(planar_vertex), -1)
    level[stacked_vertex] = sheet_level[sheet] - 1
    # But not where the outline touches itself, nor where cusps lie on each other.
    is_torn = _have_several_cusps(immersion.arrangement, mesh.points)
    is_torn[planar_vertex[level < 0]] = True
    order = np.lexsort((level, planar_vertex))
    if len(stacked_vertex) > len(level):
        level[order] = count_each(np.bincount(planar_vertex))
    above = np.flatnonzero(np.diff(planar_vertex[order]) == 0)
    stacked = np.stack([order[above], order[above + 1]], axis=1)
    if is_torn.any():
        pairs = _pairs_where_torn(sheet_level, mesh, glued, is_torn)
        level[is_torn[planar_vertex]] = 0
        _raise_where_torn(level, pairs, mesh.points[planar_vertex])
        stacked = np.concatenate([stacked[~is_torn[planar_vertex[stacked[:, 0]]]], pairs])
    return level, stacked


def _have_several_cusps(arrangement: Arrangement, places: Floats) -> Bools:
    """Tell on which places several cusps lie."""
    cusps = cusps_of(arrangement)
    if arrangement.given is None or len(cusps) < 2:
        return np.zeros(len(places), dtype=bool)
    there, count = np.unique(as_numbers(arrangement.given.points[cusps]), return_counts=True)
    return np.isin(as_numbers(places), there[count > 1])


def _pairs_where_torn(sheet_level: Ints, mesh: CellTriangulation, glued: SheetMesh, is_torn: Bools) -> Ints:
    """Return the pairs of vertices next to each other in some cell at points where no cell has all vertices."""
    corner = np.flatnonzero(is_torn[mesh.triangles.ravel()])
    copies = np.diff(np.append(glued.first_copy, len(glued.faces)))[corner // 3]
    repeated = np.repeat(corner, copies)
    sheet = glued.first_sheet[repeated // 3] + count_each(copies)
    order = np.lexsort((sheet_level[sheet], repeated))
    vertex = glued.faces.ravel()[glued.lifted(repeated, sheet)][order]
    above = np.flatnonzero((np.diff(repeated[order]) == 0) & (np.diff(vertex) != 0))
    return np.unique(np.stack([vertex[above], vertex[above + 1]], axis=1), axis=0)


def _raise_where_torn(level: Ints, pairs: Ints, places: Floats) -> None:
    """Raise levels as little as can be, so that the upper vertex of each pair has a higher one than the lower."""
    for _ in range(len(pairs) + 1):
        lower, upper = pairs[level[pairs[:, 0]] >= level[pairs[:, 1]]].T
        if not len(lower):
            return
        np.maximum.at(level, upper, level[lower] + 1)
    raise GeneralPositionError(
        "where the outline touches itself, sheets lie over each other in a circle, which cannot be in a single point",
        where=places[lower[:1]],
        hint="move the strands there apart, or lift another layering",
    )


# ---- where sheets pass through each other ----------------------------------------------------------------------------
#
# Over the points of a border along which two sheets pass through each other their order is open, and strict over all
# other points. So between them, seen from above near the border, they meet in a curve.

# Sheets that pass through each other part by one unit of height on so many along them.
_WAY_PER_HEIGHT = 2.0
# They keep at least this share of the gap, wherever their order is strict.
_LEAST_SHARE = 1e-6


def passing_edges(layering: IntersectingLayering, mesh: CellTriangulation, glued: SheetMesh) -> Ints:
    """Return rows (a, b, c, d): edges a → b and c → d of two sheets that pass through each other along them."""
    border, lower, upper = layering.intersections.T
    rank = np.argsort(mesh.chain_border, kind="stable")
    first, last = (np.searchsorted(mesh.chain_border[rank], border, side=side) for side in ("left", "right"))
    row = np.repeat(np.arange(len(border)), last - first)
    beside = mesh.twin[mesh.left[rank[first[row] + count_each(last - first)]]]
    vertex = glued.faces.ravel()
    sides = (glued.lifted(beside, sheet[row]) for sheet in (lower, upper))
    return np.column_stack([vertex[end] for side in sides for end in (side, following(side))])


def stacked_but_passing(stacked: Ints, level: Ints, planar_vertex: Ints, passing: Ints) -> Ints:
    """Return the stacked vertices; over passing points all pairs but the passing ones, in place of neighbours."""
    open_points = np.unique(planar_vertex[passing])
    kept = stacked[~np.isin(planar_vertex[stacked[:, 0]], open_points)]
    members = np.flatnonzero(np.isin(planar_vertex, open_points))
    members = members[np.lexsort((level[members], planar_vertex[members]))]
    pairs = _pairs(members, np.unique(planar_vertex[members], return_counts=True)[1])
    key, open_key = (np.sort(rows, axis=1) @ [len(level), 1] for rows in (pairs, _open_pairs(passing)))
    return np.concatenate([kept, pairs[~np.isin(key, open_key)]])


def shares_of_gap(points: Floats, mesh: LiftedMesh, gap: float) -> Floats:
    """Return which share of the gap the stacked vertices must keep, shape (c,): 1 but near intersections.

    There it is half the way along the two sheets to the place where they pass through each other, as long as this is
    less than the gap.
    """
    if not len(mesh.passing):
        return np.ones(len(mesh.stacked))
    here, there = _sides_of_pairs(mesh)
    rows = (here, there, mesh.stacked, _open_pairs(mesh.passing))
    keys = [np.sort(pairs, axis=1) @ [len(mesh.level), 1] for pairs in rows]
    known, node = np.unique(np.concatenate(keys), return_inverse=True)
    start, end, stacked, sources = np.split(node, np.cumsum(list(map(len, keys)))[:-1])
    length = np.hypot(*(points[mesh.planar_vertex[here[:, 0]]] - points[mesh.planar_vertex[there[:, 0]]]).T)
    reach = _WAY_PER_HEIGHT * gap
    way = ways_from(np.unique(sources), len(known), np.stack([start, end], axis=1), length, reach)
    return np.asarray(np.clip(way[stacked] / reach, _LEAST_SHARE, 1.0))


def intersection_curves(vertices: Floats, mesh: LiftedMesh) -> tuple[Floats, ...]:
    """Return the polylines, each of shape (m, 3), along which sheets pass through each other.

    Cost: linear in the number of pairs of triangles over each other.
    """
    if not len(mesh.passing):
        return ()
    here, there = _sides_of_pairs(mesh)
    crossed = np.flatnonzero(_above(vertices, here) != _above(vertices, there))
    edges, edge = np.unique(_as_keys(here[crossed], there[crossed]), axis=0, return_inverse=True)
    places = _meeting_places(vertices, edges)
    # Every pair of triangles has three sides in a row, of which none or two are crossed.
    return tuple(places[chain] for chain in _chains(edge.reshape(-1, 2)))


def copies_over_each_other(mesh: LiftedMesh) -> Ints:
    """Return all pairs of triangles over the same triangle of the drawing, shape (q, 2)."""
    return _pairs(np.arange(len(mesh.faces)), numbers_of_copies(mesh))


def numbers_of_copies(mesh: LiftedMesh) -> Ints:
    """Return how many triangles lie over each triangle of the drawing; they follow each other."""
    below = mesh.planar_vertex[mesh.faces]
    first = np.flatnonzero(np.concatenate([[True], (below[1:] != below[:-1]).any(axis=1)]))
    return np.diff(np.append(first, len(below)))


def _pairs(members: Ints, lengths: Ints) -> Ints:
    """Return all pairs of members of groups with these lengths, that follow each other."""
    return members[np.column_stack(pairs_in_each(lengths))]


def _open_pairs(passing: Ints) -> Ints:
    """Return the pairs of vertices whose order is open."""
    return np.unique(np.sort(np.concatenate([passing[:, [0, 2]], passing[:, [1, 3]]]), axis=1), axis=0)


def _sides_of_pairs(mesh: LiftedMesh) -> tuple[Ints, Ints]:
    """Return the pairs of vertices at the starts and at the ends of the sides of triangles over each other.

    Three rows follow each other for each pair of triangles.
    """
    first, second = copies_over_each_other(mesh).T
    here = np.stack([mesh.faces[first], mesh.faces[second]], axis=2)
    return here.reshape(-1, 2), np.roll(here, -1, axis=1).reshape(-1, 2)


def _above(vertices: Floats, pairs: Ints) -> Ints:
    """Tell whether the first vertex of each pair lies above the second; of equal ones that with the larger number."""
    a, b = vertices[pairs, 2].T
    return np.where(a == b, pairs[:, 0] > pairs[:, 1], a > b).astype(np.int64)


def _as_keys(here: Ints, there: Ints) -> Ints:
    """Return rows (a, b, c, d), the same for a pair of edges a → b and c → d in any order and direction."""
    edges = np.stack([here, there], axis=2)
    swapped = edges[:, 0].min(axis=1) > edges[:, 1].min(axis=1)
    edges[swapped] = edges[swapped, ::-1]
    turned = edges[:, 0, 0] > edges[:, 0, 1]
    edges[turned] = edges[turned, :, ::-1]
    return edges.reshape(-1, 4)


def _meeting_places(vertices: Floats, edges: Ints) -> Floats:
    """Return where the edges a → b and c → d, one over the other, meet."""
    a, b, c, d = vertices[edges].swapaxes(0, 1)
    start, end = a[:, 2] - c[:, 2], b[:, 2] - d[:, 2]
    apart = start - end
    share = np.divide(start, apart, out=np.full(len(apart), 0.5), where=apart != 0)[:, None]
    return np.asarray((1 - share) * a + share * b)


def _chains(links: Ints) -> Iterator[list[int]]:
    """Yield links between nodes, of which each has one or two, as rows of nodes; the first one again at a loop's end.

    Examples
    --------
    >>> list(_chains(np.array([(3, 4), (0, 1), (5, 3), (2, 1), (4, 5)])))
    [[0, 1, 2], [3, 4, 5, 3]]
    """
    beside: dict[int, list[int]] = {}
    for a, b in links.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    ends = [node for node, others in beside.items() if len(others) == 1]
    for end in ends:
        if end in beside:
            yield list(_walk(beside, end))
    while beside:
        start = next(iter(beside))
        yield [*_walk(beside, start), start]


def _walk(beside: dict[int, list[int]], start: int) -> Iterator[int]:
    """Yield nodes, each beside the one before, as far as they are left; they are taken out."""
    ahead = [start]
    while ahead:
        yield ahead[0]
        ahead = [node for node in beside.pop(ahead[0]) if node in beside]
