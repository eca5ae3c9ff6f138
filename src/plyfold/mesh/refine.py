"""Points added for the quality of triangles: good angles first, then the size asked for.

Refinement after Ruppert takes as many triangles as the drawing's features are fine: a few dozen around a cell a
billionth of the drawing's size, but a billion along a strip as thin, for each point on one of its sides asks for one on
the other. So edges are split only down to a shortest length, and that is made shorter step by step: bad triangles
vanish around tiny cells, and multiply in thin strips. If a step takes more triangles than there may be, or leaves more
bad ones than an earlier step, all starts again and ends before it. The bad triangles that are left, in strips and
around them, are for :mod:`plyfold.mesh.mend`. At sharp corners of the drawing no angles are good, and there the step by
step approach to the corner, that would never end, counts as done.

Only then the triangles that are larger than the size asked for are split, so that the number asked for includes those
around features.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pythoncdt as cdt

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.halfedges import ends_of, half_edges_from_to
from plyfold.immersion.corners import feet
from plyfold.outline.curve import Outline
from plyfold.ragged import count_each, next_in_rows

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.mesh.strips import Strips

__all__ = [
    "ENCLOSING",
    "NodedCurve",
    "PlanarMesh",
    "Size",
    "borders_at_points",
    "borders_passed",
    "chain_of",
    "constrained",
    "drawn_outline",
    "given_outline",
    "is_moved",
    "left_of_chain",
    "noded_curve",
    "planar_mesh",
    "refine",
    "split_chain",
    "split_points",
    "too_close",
    "unit_square",
    "usual_area",
]


_SMALLEST_ANGLE = 25.0
# Refined triangles have on average this share of the area that is allowed.
_USUAL_SHARE = 0.6
# Good angles may take this many times the triangles of the curve alone, if that is more than the number asked for.
_MOST_GROWTH = 3
# The shortest length that is tried first, by the root of the usual area: a third of the usual edge.
_FIRST_LENGTH = 0.5
# The shortest length becomes shorter by this factor, step by step.
_STEP = 4.0
# A length a little below a side lets it be split.
_BELOW = 0.99
# A step is not worth trying if there are fewer points for each bad triangle.
_FEWEST_POINTS = 2.0
# So much of the number asked for is there for the size at least; the rest may be needed to mend bad triangles.
_LEAST_SHARE = 0.75
# Where all angles are good, splitting large triangles may need edges this many times shorter to keep them so.
_FINER = 16.0
_MOST_POINTS = 20_000_000
# Corners sharper than this have no triangles with good angles at them, or only just.
_SHARP = np.cos(np.radians(30.0))


@dataclass(frozen=True, eq=False)
class _Covered:
    """The library's triangulation, the curve in it, and the triangles to leave alone; the library updates these."""

    library: Any
    outline: NodedCurve
    uncovered: set[int]
    watch: Watch

    def add_points(self, criterion: str, threshold: float, shortest: float, limit: int) -> int:
        """Split bad triangles, but no edge below the shortest length; return how many points were added."""
        before = self.library.vertices_count()
        named = getattr(cdt.RefinementCriterion, criterion)
        self.watch.wait_for(
            lambda: self.library.refine_triangles(min(limit, _MOST_POINTS), named, threshold, self.uncovered, shortest),
            before + limit,
        )
        return int(self.library.vertices_count() - before)

    def improve_angles(self, shortest: float, limit: int) -> int:
        """Split triangles with sharp angles."""
        return self.add_points("SMALLEST_ANGLE", float(np.radians(_SMALLEST_ANGLE)), shortest, limit)


class Size(NamedTuple):
    """How many triangles the lifted surface shall have, and the area of the largest if that is what was asked for."""

    wanted: float
    most: float | None


def usual_area(outline: NodedCurve, triangles: int, max_area: float | None) -> Size:
    """Return the size asked for, in the unit square."""
    if max_area is None:
        return Size(triangles, None)
    most = max_area / outline.scale**2
    return Size(max(1.0, outline.covered / (_USUAL_SHARE * most)), most)


def refine(  # noqa: PLR0913 - what is refined, where, how far, and how long
    library: Any, outline: NodedCurve, winding: Ints, size: Size, finest: float, *, watch: Watch = UNWATCHED
) -> float:
    """Add points to a constrained triangulation where the surface is, for good angles and the size asked for.

    Parameters
    ----------
    library : Triangulation
        Without points added.
    outline : NodedCurve
    winding : (t,) int
        The winding number of each triangle of the library; those with 0 or less are left alone.
    size : Size
    finest : float
        No edge shorter than this is split for the sake of thin places, in the unit square.
    watch : Watch, optional

    Returns
    -------
    float
        The shortest length with which there are triangles enough. If it is larger than ``finest``, the triangulation
        is unfinished, and has to be made again with this length as ``finest``.
    """
    covered = _Covered(library, outline, set(np.flatnonzero(winding <= 0).tolist()), watch)
    fewest = int(winding[winding > 0].sum())
    layers = max(1, fewest) / max(1, int((winding > 0).sum()))
    # A planar point more makes two planar triangles more.
    usual = (max(size.wanted, _MOST_GROWTH * fewest) - fewest) / (2 * layers)
    budget = _Budget(usual, max(usual, (size.wanted - fewest / layers) / 2))
    first = float(_FIRST_LENGTH * np.sqrt(outline.covered / size.wanted))
    reached = _good_angles(covered, max(first, finest), finest, budget)
    if reached.unfinished:
        return reached.shortest
    left = max(size.wanted - 2 * layers * reached.bad, _LEAST_SHARE * size.wanted)
    most = _even_area(covered, left) if size.most is None else size.most
    if most > 0:
        shortest = reached.shortest if reached.bad else reached.shortest / _FINER
        limit = int(size.wanted) + library.vertices_count()
        covered.add_points("LARGEST_AREA", most, reached.shortest, limit)
        covered.improve_angles(shortest, limit)
    return finest


class _Budget(NamedTuple):
    """How many points good angles may take as a rule, and how many if that makes all angles good.

    Then there may be as many triangles in the plane as were asked for, whatever number lies over each other.
    """

    usual: float
    luxury: float


class _Reached(NamedTuple):
    """The length below which no edge was split, and how many bad triangles are left.

    If unfinished, all is to be made again with this length: there are too many points or bad triangles.
    """

    shortest: float
    bad: int
    unfinished: bool


def _good_angles(covered: _Covered, shortest: float, finest: float, budget: _Budget) -> _Reached:
    """Split triangles with sharp angles, down to a shortest length that becomes shorter step by step.

    In a strip too thin, steps make ever more bad triangles. So those count that leave half as many, or none.
    """
    taken, best, fewest = 0, _STEP * shortest, np.inf
    while True:
        added = covered.improve_angles(shortest, int(budget.luxury - taken) + 1)
        taken += added
        if taken > budget.luxury:
            return _Reached(best, 0, unfinished=True)
        sides = _bad_sides(covered)
        bad = len(sides)
        if not bad or (bad <= fewest / 2 and taken <= budget.usual):
            best, fewest = shortest, bad
        finer = _finer(shortest, sides, added)
        if not bad or finer < finest or budget.luxury - taken < _FEWEST_POINTS * bad:
            return _Reached(best, bad, unfinished=best > shortest)
        shortest = finer


def _finer(shortest: float, sides: Floats, added: int) -> float:
    """Return the next length to try: steps that would change nothing are left out, and 0 means that all would."""
    if added or not len(sides):
        return shortest / _STEP
    below = sides[sides <= shortest]
    return min(shortest / _STEP, float(below.max()) * _BELOW) if len(below) else 0.0


def _corners(library: Any, triangles: Ints) -> tuple[Ints, Floats]:
    """Return the vertices of triangles, and all points; those of the enclosing triangle are −3 to −1 and the last."""
    numbers = library.triangles_array(copy=False)["vertices"][triangles].astype(np.int64) - ENCLOSING
    rows = library.vertices_array(copy=False)
    points = np.stack([rows["x"], rows["y"]], axis=1)
    return numbers, np.roll(points, -ENCLOSING, axis=0)


def _bad_sides(covered: _Covered) -> Floats:
    """Return the shortest sides of triangles with sharp angles that no sharp corner of the drawing makes."""
    threshold = float(np.radians(_SMALLEST_ANGLE))
    found = covered.library.find_unrefined_triangles(cdt.RefinementCriterion.SMALLEST_ANGLE, threshold)
    found = [number for number in found if number not in covered.uncovered]
    if not found:
        return np.zeros(0)
    triangles, points = _corners(covered.library, np.array(found))
    sides = points[np.roll(triangles, -1, axis=1)] - points[triangles]
    lengths = np.hypot(*sides.transpose(2, 0, 1))
    side = lengths.argmin(axis=1)
    row = np.arange(len(found))
    ends = np.stack([triangles[row, side], triangles[row, (side + 1) % 3]], axis=1)
    beside = _neighbours_on_curve(covered.library, covered.outline)
    return np.asarray(lengths[row, side][~_across_sharp_corners(points, ends, beside, len(covered.outline.points))])


def _neighbours_on_curve(library: Any, outline: NodedCurve) -> Ints:
    """Return sorted rows (vertex, point of curve or crossing): those at the ends of the pieces on which it lies."""
    edge, added = split_points(library, outline).T
    there, back = outline.edges, outline.edges[:, ::-1]
    rows = [there, back, *(np.stack([added, ends], axis=1) for ends in there[edge].T)]
    return np.unique(np.concatenate(rows), axis=0)


def _across_sharp_corners(points: Floats, ends: Ints, beside: Ints, known: int) -> Bools:
    """Tell which pairs of vertices lie on two sides of a sharp corner of the drawing, and not on one piece of it.

    Vertices from the number ``known`` on are added.
    """
    n = len(points)
    key = beside[:, 0] * n + beside[:, 1]
    u, v = ends.T
    first, last = np.searchsorted(beside[:, 0], [u, u + 1])
    row = np.repeat(np.arange(len(ends)), last - first)
    corner = beside[np.repeat(first, last - first) + count_each(last - first), 1]
    common = np.isin(v[row] * n + corner, key)
    row, corner = row[common], corner[common]
    number = np.bincount(row, minlength=len(ends))
    # Each added vertex has the two ends of its piece beside it.
    on_one_piece = np.isin(u * n + v, key) | np.isin(v * n + u, key) | ((ends.min(axis=1) >= known) & (number == 2))
    to_u, to_v = (points[vertex[row]] - points[corner] for vertex in (u, v))
    sharp = (to_u * to_v).sum(axis=1) > _SHARP * np.hypot(*to_u.T) * np.hypot(*to_v.T)
    return np.asarray((np.bincount(row[sharp], minlength=len(ends)) > 0) & ~on_one_piece)


def split_points(library: Any, outline: NodedCurve) -> Ints:
    """Return rows (edge of the outline, vertex): the points added on the curve, in no order along it."""
    known = len(outline.points) + ENCLOSING
    originals = library.piece_to_originals
    rows = [
        (vertex, whole[0].v1, whole[0].v2)
        for edge, whole in originals.items()
        for vertex in (edge.v1, edge.v2)
        if vertex >= known
    ]
    vertex, first, second = np.array(rows, dtype=np.int64).reshape(-1, 3).T - ENCLOSING
    vertex, at = np.unique(vertex, return_index=True)
    n = len(outline.points)
    pairs = np.sort(outline.edges, axis=1)
    key = pairs[:, 0] * n + pairs[:, 1]
    order = np.argsort(key)
    wanted = np.minimum(first[at], second[at]) * n + np.maximum(first[at], second[at])
    return np.stack([order[np.searchsorted(key, wanted, sorter=order)], vertex], axis=1)


def _even_area(covered: _Covered, wanted: float) -> float:
    """Return the largest area that makes about so many triangles of those there are; 0 if they are enough already.

    A triangle of area A becomes A by the usual area, or stays one if it is smaller.
    """
    inside = np.ones(covered.library.triangles_count(), dtype=bool)
    inside[list(covered.uncovered)] = False
    triangles, points = _corners(covered.library, np.flatnonzero(inside))
    a, b, c = points[triangles].swapaxes(0, 1)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    area = np.sort(ux * vy - uy * vx)[::-1] / 2
    # Where winding numbers of both signs cancel, there is no surface, and each triangle counts once.
    wanted *= min(1.0, area.sum() / max(covered.outline.covered, 1e-300))
    larger = np.arange(1, len(area) + 1)
    # If the larger ones are split to the usual area x, their number is their area by x.
    usual = np.cumsum(area) / np.maximum(wanted - (len(area) - larger), 1e-300)
    fits = np.flatnonzero((usual <= area) & (wanted > len(area)))
    return float(usual[fits[-1]] / _USUAL_SHARE) if len(fits) else 0.0


# ---- curve and crossings as the edges of a constrained Delaunay triangulation ----------------------------------------

# The library starts with the three corners of a triangle around everything.
ENCLOSING = 3


@dataclass(frozen=True, eq=False)
class NodedCurve:
    """The points of an outline and its crossings, the loops as a chain through them, and the points in a unit square.

    Piece j of the chain begins at ``chain[j]``, and loop l consists of the pieces from ``first_piece[l]`` up to
    ``first_piece[l + 1]``. On both sides of each border are the cells ``left_cell`` and ``right_cell``. A drawing on
    its given points has ``strips``, and pieces that run along the same edge; its cells are the faces of the noding.
    """

    points: Floats
    chain: Ints
    chain_border: Ints
    first_piece: Ints
    unit_points: Floats
    centre: Floats
    scale: float
    left_cell: Ints
    right_cell: Ints
    strips: Strips | None = None

    @cached_property
    def chain_end(self) -> Ints:
        """The point at which each piece ends."""
        return self.chain[next_in_rows(self.first_piece)]

    @cached_property
    def _edges(self) -> tuple[Ints, Ints]:
        pieces = np.stack([self.chain, self.chain_end], axis=1)
        if self.strips is None:
            return pieces, np.arange(len(pieces))
        edges, edge = np.unique(np.sort(pieces, axis=1), axis=0, return_inverse=True)
        return edges, edge.ravel()

    @property
    def edges(self) -> Ints:
        """Both ends of each edge: of the pieces, but edges along which several run only once."""
        return self._edges[0]

    @property
    def edge_of_piece(self) -> Ints:
        """The edge along which each piece runs."""
        return self._edges[1]

    def pieces_along(self, rows: Ints) -> Ints:
        """Return rows (edge, anything) for every piece along the edge, as rows (piece, anything)."""
        if self.strips is None:
            return rows
        order = np.argsort(self.edge_of_piece, kind="stable")
        edge = self.edge_of_piece[order]
        low, high = (np.searchsorted(edge, rows[:, 0], side=side) for side in ("left", "right"))
        which = np.repeat(np.arange(len(rows)), high - low)
        return np.stack([order[low[which] + count_each(high - low)], rows[which, 1]], axis=1)

    @property
    def covered(self) -> float:
        """The area of the lifted surface in the unit square: what the curve encloses, times winding numbers."""
        (x, y), (end_x, end_y) = self.unit_points[self.chain].T, self.unit_points[self.chain_end].T
        return abs(float(x @ end_y - y @ end_x)) / 2

    @property
    def rounding(self) -> float:
        """The distance of neighbouring doubles in the drawing, as a length in the unit square."""
        return float(np.spacing(np.abs(self.points).max()) / self.scale)


def drawn_outline(arrangement: Arrangement) -> Outline:
    """Return the outline of a drawing; refuse a Gauss code."""
    if arrangement.outline is None:
        raise PlyfoldError("triangles need a drawing, and this arrangement is a Gauss code alone")
    return arrangement.outline


def given_outline(arrangement: Arrangement) -> Outline:
    """Return the outline of a drawing with its points where they were given; refuse a Gauss code."""
    drawn = drawn_outline(arrangement)
    return drawn if arrangement.given is None else arrangement.given


def is_moved(arrangement: Arrangement) -> bool:
    """Tell whether points of a drawing were moved apart."""
    outline, given = drawn_outline(arrangement), given_outline(arrangement)
    return outline is not given and not np.array_equal(arrangement.exact_points, given.points)


def noded_curve(arrangement: Arrangement) -> NodedCurve:
    """Return the outline of a drawing, with its crossings."""
    points = np.concatenate([drawn_outline(arrangement).points, arrangement.crossings])
    cells = arrangement.left_cell, arrangement.right_cell
    return NodedCurve(points, *chain_of(arrangement), *unit_square(points), *cells)


def chain_of(arrangement: Arrangement) -> tuple[Ints, Ints, Ints]:
    """Return points and crossings along the outline (crossing i is number n + i), loop after loop.

    Also the border that each is followed by, and where the loops begin. Only crossings and points are passed: past the
    foot of a bridge inside an edge, the next border begins at the next of them.
    """
    outline, crossing = drawn_outline(arrangement), arrangement.crossing_of_visit
    n, visit = len(outline), np.flatnonzero(crossing >= 0)
    at = arrangement.visit_edge[visit] + np.arange(1, len(visit) + 1)
    on_curve = np.ones(n + len(visit), dtype=bool)
    on_curve[at] = False
    chain, passed = np.empty((2, n + len(visit)), dtype=np.int64)
    chain[on_curve] = np.arange(n)
    chain[at] = n + crossing[visit]
    passed[on_curve] = _visits_before_points(arrangement)[1]
    passed[at] = visit + 1
    first_piece = outline.first_point + np.searchsorted(visit, arrangement.first_visit)
    loop = np.repeat(np.arange(arrangement.n_loops), np.diff(first_piece))
    return chain, _border_after(arrangement, passed, loop), first_piece


def borders_at_points(arrangement: Arrangement) -> tuple[Ints, Ints]:
    """Return the border that arrives at each point of an outline, and the one that leaves it: mostly the same."""
    arriving, leaving = _visits_before_points(arrangement)
    loop = np.repeat(np.arange(arrangement.n_loops), np.diff(drawn_outline(arrangement).first_point))
    return _border_after(arrangement, arriving, loop), _border_after(arrangement, leaving, loop)


def borders_passed(arrangement: Arrangement, passed: Ints, edge: Ints) -> Ints:
    """Return the borders of places on edges before which so many visits come, on earlier loops too."""
    loop = np.searchsorted(drawn_outline(arrangement).first_point, edge, side="right") - 1
    return _border_after(arrangement, passed, loop)


def _visits_before_points(arrangement: Arrangement) -> tuple[Ints, Ints]:
    """Return how many visits come before each point of an outline, on earlier loops too; and with marks on the point.

    These are its own as a cusp, and as the first foot of a bridge.
    """
    edge, points = arrangement.visit_edge, np.arange(len(drawn_outline(arrangement)))
    before = np.searchsorted(edge, points)
    on_point = edge[np.append(np.flatnonzero(arrangement.cusp_index), feet(arrangement)[: len(arrangement.bridges)])]
    return before, before + np.bincount(on_point, minlength=len(points))


def _border_after(arrangement: Arrangement, passed: Ints, loop: Ints) -> Ints:
    """Return the borders of places on loops before which so many visits come, on earlier loops too."""
    if arrangement.n_loops == 1:
        return np.asarray((passed - 1) % arrangement.n_borders)
    first, last = arrangement.first_visit[loop], arrangement.first_visit[loop + 1]
    # Before its first visit a loop is on the border that its last visit begins; without visits it has one border.
    border: Ints = np.searchsorted(arrangement.loop_of_border, loop)
    visited = last > first
    border[visited] = arrangement.border_after[np.where(passed > first, passed, last)[visited] - 1]
    return border


def unit_square(points: Floats) -> tuple[Floats, Floats, float]:
    """Return the points moved and scaled to about unit size, with the centre and the scale that lead back.

    Both steps are exact: the scale is a power of two, and where the centre is not left at 0 it is so far away that
    the difference of two doubles has no rounding error (Sterbenz).
    """
    x, y = points.T  # one column at a time is faster
    low, high = np.array([x.min(), y.min()]), np.array([x.max(), y.max()])
    size = float((high / 2 - low / 2).max())
    scale = 2.0 ** (np.frexp(size)[1] + 1)
    middle = low / 2 + high / 2
    centre = np.where(np.abs(middle) >= 4 * size, middle, 0.0)
    return (points - centre) / scale, centre, float(scale)


def constrained(outline: NodedCurve, watch: Watch = UNWATCHED) -> Any:
    """Return the constrained Delaunay triangulation; its first three vertices are those of an enclosing triangle."""
    edges = outline.edges
    mesh = cdt.Triangulation(cdt.VertexInsertionOrder.AUTO, cdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0)
    try:
        watch.wait_for(lambda: _insert(mesh, outline.unit_points, edges.astype(np.uintc)), len(edges))
    except RuntimeError as error:
        _refuse_equal(outline.points)
        named = [int(number) for pair in re.findall(r"\((\d+), (\d+)\)", str(error)) for number in pair]
        raise too_close(outline.points[named]) from error
    if mesh.fixed_edges_count() != len(edges):
        named = [edge.v1 - ENCLOSING for originals in mesh.piece_to_originals.values() for edge in originals]
        raise too_close(outline.points[named])
    return mesh


def _insert(mesh: Any, points: Floats, edges: Any) -> None:
    mesh.insert_vertices(np.ascontiguousarray(points))
    mesh.insert_edges(edges)


def _refuse_equal(points: Floats) -> None:
    places, count = np.unique(points, axis=0, return_counts=True)
    if (count > 1).any():
        raise PrecisionError(
            "crossings fall on each other or on a point of the curve when rounded to double precision",
            where=places[count > 1],
            hint="move the strands apart there",
        )


def too_close(places: Floats | tuple[tuple[float, ...], ...]) -> PrecisionError:
    """Return the error that names places where strands are closer than double precision can tell."""
    return PrecisionError(
        "strands are so close that rounding their crossings to double precision changes the drawing",
        where=places,
        hint="move the strands apart there",
    )


@dataclass(frozen=True, eq=False)
class PlanarMesh:
    """What the triangulation library has made, in coordinates of the drawing; a triangle around everything included.

    Its three corners come last.
    """

    points: Floats
    triangles: Ints
    twin: Ints
    chain: Ints
    chain_border: Ints
    first_piece: Ints


def planar_mesh(library: Any, points: Floats, chain: Ints, chain_border: Ints, first_piece: Ints) -> PlanarMesh:
    """Return the library's triangles, over the given points and the chain of the outline through them."""
    rows = library.triangles_array()
    corners = rows["vertices"].astype(np.int64) - ENCLOSING
    corners[corners < 0] += len(points) + ENCLOSING
    around = np.full((ENCLOSING, 2), np.nan)
    twin = _twins(corners, rows["neighbors"])
    return PlanarMesh(np.concatenate([points, around]), corners, twin, chain, chain_border, first_piece)


def _twins(corners: Ints, neighbours: Any) -> Ints:
    """Return the half-edge beside each half-edge, from the triangle beside it; -1 where there is none."""
    first = 3 * neighbours.ravel().astype(np.int64)
    outside = np.flatnonzero(first >= corners.size)
    first[outside] = 0
    # The twin starts where the half-edge ends.
    start, end = ends_of(corners)
    twin = first + (start[first + 1] == end)
    twin += 2 * (start[first + 2] == end)
    twin[outside] = -1
    return np.asarray(twin)


# ---- the curve as a chain of edges of triangles ----------------------------------------------------------------------


def split_chain(outline: NodedCurve, unit_points: Floats, added: Ints) -> tuple[Ints, Ints, Ints]:
    """Return the chain along the outline with the points that were added on it, the borders, and where loops begin.

    The added ones are rows (edge of the outline, vertex), in any order.
    """
    starts, ends = outline.chain, outline.chain_end
    piece, vertex = outline.pieces_along(added).T
    direction = unit_points[ends[piece]] - unit_points[starts[piece]]
    advance = ((unit_points[vertex] - unit_points[starts[piece]]) * direction).sum(axis=1)
    every_piece = np.concatenate([np.arange(len(starts)), piece])
    order = np.lexsort((np.concatenate([np.full(len(starts), -np.inf), advance]), every_piece))
    piece_of = every_piece[order]
    first_piece = np.searchsorted(piece_of, outline.first_piece)
    return np.concatenate([starts, vertex])[order], outline.chain_border[piece_of], first_piece


def left_of_chain(triangles: Ints, chain: Ints, chain_end: Ints, several: bool = False) -> Ints:
    """Return the half-edge along each piece of a chain, -1 if there is none.

    A point starts at most two pieces, but where several run along the same edge.
    """
    if several:
        return half_edges_from_to(triangles, chain, chain_end)
    start, end = ends_of(triangles)
    pieces = np.arange(len(chain))
    left = np.full(len(pieces), -1)
    for order in (pieces, pieces[::-1]):
        piece_from, next_point = np.full((2, max(start.max(), chain.max()) + 1), -1)
        piece_from[chain[order]] = order
        next_point[chain[order]] = chain_end[order]
        along = np.flatnonzero(next_point[start] == end)
        left[piece_from[start[along]]] = along
    return left
