"""One triangulation of the whole drawing, cut along its borders into cells."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.errors import InputError, PlyfoldError, PrecisionError
from plyfold.predicates import orient

if TYPE_CHECKING:
    from plyfold.arrangement import Arrangement

__all__ = [
    "DEFAULT_TRIANGLES",
    "MOST_TRIANGLES",
    "CellTriangulation",
    "chain_of",
    "refuse_max_area",
    "triangulate_cells",
]

DEFAULT_TRIANGLES = 4000
MOST_TRIANGLES = 10_000_000
# Refined triangles have on average 0.6 of the area that is allowed.
_USUAL_SHARE = 0.6
_SMALLEST_ANGLE = 25.0
# Edges are not split below this fraction of the usual edge, so that tiny features do not attract tiny triangles.
_SHORTEST_EDGE = 0.05
# Nor below this fraction of the usual edge of the curve.
_SHORTEST_PIECE = 0.3
_MOST_POINTS = 20_000_000
# The library starts with the three corners of a triangle around everything.
_ENCLOSING = 3


@dataclass(frozen=True, eq=False)
class CellTriangulation:
    """Triangles over the cells that the surface covers.

    Half-edge 3t + i runs along the side of triangle t that starts at its corner i.

    Parameters
    ----------
    points : (p, 2) float
        The points of the curve in their order, bit for bit; then the crossings, rounded; then points added for the
        quality of the triangles.
    triangles : (t, 3) int
        Counter-clockwise (exactly) and none across a border.
    twin : (3t,) int
        The half-edge on the other side of each half-edge, -1 where there is no triangle.
    cell : (t,) int
        The cell each triangle lies in; its winding number is at least 1.
    chain : (s,) int
        The points along the curve in order, from the curve's first point, crossings and added points included (a
        crossing occurs twice). Piece j of the curve runs from ``chain[j]`` to ``chain[j + 1]``, the last one back.
    chain_border : (s,) int
        The border each piece belongs to.
    left : (s,) int
        The half-edge along each piece, in the triangle on its left; -1 where there is none.
    """

    points: Floats
    triangles: Ints
    twin: Ints
    cell: Ints
    chain: Ints
    chain_border: Ints
    left: Ints


def triangulate_cells(
    arrangement: Arrangement, max_area: float | None = None, triangles: int = DEFAULT_TRIANGLES
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
        w times). Curves with many points have more. With 0, no points are added.

    Returns
    -------
    CellTriangulation
        Angles are at least 25° except at sharp corners of the drawing and features much finer than the triangles.

    Raises
    ------
    PrecisionError
        If the crossings, rounded to doubles, no longer draw the same cells; it names the place.

    Notes
    -----
    Constrained Delaunay triangulation with Ruppert's refinement, by the library CDT. Crossings are rational points and
    have to be rounded, so the cells are read off the triangulation and compared with the exact ones. O(n log n) for
    n triangles; about 1e6 triangles a second.

    Examples
    --------
    >>> from plyfold.arrangement import arrangement
    >>> mesh = triangulate_cells(arrangement([(0, 0), (4, 0), (4, 4), (0, 4)]), max_area=100.0)
    >>> mesh.points[:4].tolist(), mesh.chain[0]
    ([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], np.int64(0))
    """
    outline = _outline(arrangement)
    if not triangles:
        return _verified(arrangement, _plain(outline))
    try:
        return _verified(arrangement, _refined(arrangement, outline, max_area, triangles))
    except PrecisionError:
        # Added points are rounded too, and may not fit where the cells are as thin as rounding errors.
        return _verified(arrangement, _plain(outline))


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


@dataclass(frozen=True, eq=False)
class _Outline:
    """The points of curve and crossings, the curve as a chain through them, and the same points in a unit square."""

    points: Floats
    chain: Ints
    chain_border: Ints
    unit_points: Floats
    centre: Floats
    scale: float


def _outline(arrangement: Arrangement) -> _Outline:
    curve = arrangement.curve
    if curve is None:
        raise PlyfoldError("triangles need a drawing, and this arrangement is a Gauss code alone")
    points = np.concatenate([curve.points, arrangement.crossings])
    chain, chain_border = chain_of(arrangement)
    return _Outline(points, chain, chain_border, *_unit_square(points))


def chain_of(arrangement: Arrangement) -> tuple[Ints, Ints]:
    """Return points and crossings along the curve (crossing i is number n + i), and the border each is followed by."""
    edge = arrangement.visit_edge
    visits = len(edge)
    n = len(arrangement.curve.points) if arrangement.curve else 0
    at = edge + np.arange(1, visits + 1)
    on_curve = np.ones(n + visits, dtype=bool)
    on_curve[at] = False
    chain = np.empty(n + visits, dtype=np.int64)
    chain[on_curve] = np.arange(n)
    chain[at] = n + arrangement.crossing_of_visit
    border = (np.cumsum(~on_curve) - 1) % max(visits, 1)
    return chain, border


def _unit_square(points: Floats) -> tuple[Floats, Floats, float]:
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


@dataclass(frozen=True, eq=False)
class _Mesh:
    """What the triangulation library has made, in coordinates of the drawing; a triangle around everything included.

    Its three corners come last.
    """

    points: Floats
    triangles: Ints
    twin: Ints
    chain: Ints
    chain_border: Ints


def _plain(outline: _Outline) -> _Mesh:
    """Triangulate without adding points."""
    return _mesh_of(_constrained(outline), outline, outline.points, outline.chain, outline.chain_border)


def _refined(arrangement: Arrangement, outline: _Outline, max_area: float | None, triangles: int) -> _Mesh:
    """Triangulate, and refine what the surface covers."""
    library = _constrained(outline)
    plain = _mesh_of(library, outline, outline.points, outline.chain, outline.chain_border)
    uncovered = set(np.flatnonzero(arrangement.winding[_cells(arrangement, plain)[0]] <= 0).tolist())
    covered = _covered(outline)
    most = covered / (_USUAL_SHARE * triangles) if max_area is None else max_area / outline.scale**2
    _refine(library, most, covered / most, uncovered, _shortest_edge(outline, most))
    corners = library.vertices_array()[_ENCLOSING:]
    unit_points = np.stack([corners["x"], corners["y"]], axis=1)
    points = outline.centre + unit_points * outline.scale
    points[: len(outline.points)] = outline.points
    return _mesh_of(library, outline, points, *_split_chain(outline, unit_points, library.piece_to_originals))


def _constrained(outline: _Outline) -> Any:
    """Return the constrained Delaunay triangulation; its first three vertices are those of an enclosing triangle."""
    import pythoncdt as cdt

    edges = np.stack([outline.chain, np.roll(outline.chain, -1)], axis=1)
    mesh = cdt.Triangulation(cdt.VertexInsertionOrder.AUTO, cdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0)
    try:
        mesh.insert_vertices(outline.unit_points)  # type: ignore[call-overload,unused-ignore]
        mesh.insert_edges(edges.astype(np.uintc))  # type: ignore[call-overload,unused-ignore]
    except RuntimeError as error:
        _refuse_equal(outline.points)
        named = [int(number) for pair in re.findall(r"\((\d+), (\d+)\)", str(error)) for number in pair]
        raise _too_close(outline.points[named]) from error
    if mesh.fixed_edges_count() != len(edges):
        named = [edge.v1 - _ENCLOSING for originals in mesh.piece_to_originals.values() for edge in originals]
        raise _too_close(outline.points[named])
    return mesh


def _refuse_equal(points: Floats) -> None:
    places, count = np.unique(points, axis=0, return_counts=True)
    if (count > 1).any():
        raise PrecisionError(
            "crossings fall on each other or on a point of the curve when rounded to double precision",
            where=places[count > 1],
            hint="move the strands apart there",
        )


def _too_close(places: Floats) -> PrecisionError:
    return PrecisionError(
        "strands are so close that rounding their crossings to double precision changes the drawing",
        where=places,
        hint="move the strands apart there",
    )


def _mesh_of(library: Any, outline: _Outline, points: Floats, chain: Ints, chain_border: Ints) -> _Mesh:
    rows = library.triangles_array()
    corners = rows["vertices"].astype(np.int64) - _ENCLOSING
    corners[corners < 0] += len(points) + _ENCLOSING
    around = np.full((_ENCLOSING, 2), np.nan)
    return _Mesh(np.concatenate([points, around]), corners, _twins(corners, rows["neighbors"]), chain, chain_border)


def _twins(corners: Ints, neighbours: Any) -> Ints:
    """Return the half-edge beside each half-edge, from the triangle beside it; -1 where there is none."""
    first = 3 * neighbours.ravel().astype(np.int64)
    outside = np.flatnonzero(first >= corners.size)
    first[outside] = 0
    # The twin starts where the half-edge ends.
    start, end = corners.ravel(), corners[:, [1, 2, 0]].ravel()
    twin = first + (start[first + 1] == end)
    twin += 2 * (start[first + 2] == end)
    twin[outside] = -1
    return np.asarray(twin)


def _covered(outline: _Outline) -> float:
    """Return the area of the lifted surface in the unit square: what the curve encloses, times winding numbers."""
    x, y = outline.unit_points[outline.chain].T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def _shortest_edge(outline: _Outline, most: float) -> float:
    """Return the length below which edges are not split: features finer than that attract no triangles.

    It is well below the usual edge, and below most edges of the curve, which would stay the sides of slivers.
    """
    piece = outline.unit_points[np.roll(outline.chain, -1)] - outline.unit_points[outline.chain]
    return float(min(_SHORTEST_EDGE * np.sqrt(most), _SHORTEST_PIECE * np.median(np.hypot(*piece.T))))


def _refine(library: Any, most: float, wanted: float, uncovered: set[int], shortest: float) -> None:
    """Split triangles larger than ``most``, about ``wanted`` in all, and then those with sharp angles."""
    import pythoncdt as cdt

    # A limit on added points, for needles would take as many as they are longer than wide to get good angles.
    limit = min(int(wanted) + library.vertices_count(), _MOST_POINTS)
    library.refine_triangles(limit, cdt.RefinementCriterion.LARGEST_AREA, most, uncovered, shortest)
    angle = cdt.deg_to_rad(_SMALLEST_ANGLE)
    library.refine_triangles(limit, cdt.RefinementCriterion.SMALLEST_ANGLE, angle, uncovered, shortest)


def _split_chain(outline: _Outline, unit_points: Floats, originals: dict[Any, list[Any]]) -> tuple[Ints, Ints]:
    """Return the chain along the curve with the points that refinement has put on it, and the borders."""
    starts, ends = outline.chain, np.roll(outline.chain, -1)
    piece_of = {frozenset(pair): j for j, pair in enumerate(zip(starts.tolist(), ends.tolist(), strict=True))}
    known = len(outline.points)
    added = {
        (piece_of[frozenset((whole[0].v1 - _ENCLOSING, whole[0].v2 - _ENCLOSING))], vertex - _ENCLOSING)
        for piece, whole in originals.items()
        for vertex in (piece.v1, piece.v2)
        if vertex >= known + _ENCLOSING
    }
    piece, vertex = np.array(sorted(added), dtype=np.int64).reshape(-1, 2).T
    direction = unit_points[ends[piece]] - unit_points[starts[piece]]
    advance = ((unit_points[vertex] - unit_points[starts[piece]]) * direction).sum(axis=1)
    every_piece = np.concatenate([np.arange(len(starts)), piece])
    order = np.lexsort((np.concatenate([np.full(len(starts), -np.inf), advance]), every_piece))
    return np.concatenate([starts, vertex])[order], outline.chain_border[every_piece[order]]


def _verified(arrangement: Arrangement, mesh: _Mesh) -> CellTriangulation:
    """Keep the triangles over covered cells, and check exactly that they are what they should be."""
    cell, left = _cells(arrangement, mesh)
    keep = arrangement.winding[cell] > 0
    kept = mesh.triangles[keep]
    a, b, c = mesh.points[kept].swapaxes(0, 1)
    if len(flat := np.flatnonzero(orient(a, b, c) <= 0)):
        raise _too_close(a[flat])
    moved = np.full(3 * len(keep) + 1, -1)  # one more, so that −1 stays −1
    moved[np.flatnonzero(np.repeat(keep, 3))] = np.arange(3 * len(kept))
    twin = moved[mesh.twin.reshape(-1, 3)[keep].ravel()]
    points = mesh.points[:-_ENCLOSING]
    return CellTriangulation(points, kept, twin, cell[keep], mesh.chain, mesh.chain_border, moved[left])


def _cells(arrangement: Arrangement, mesh: _Mesh) -> tuple[Ints, Ints]:
    """Return the cell of each triangle: cut along the curve, the triangles must fall apart into exactly the cells.

    Also the half-edge on the left of each piece of the chain. The faces of a connected plane graph are disks. So if
    every component of triangles has only the borders of one cell on its sides, the right way round, and every cell
    only one component, the drawing is the exact one.
    """
    left = _left_of_chain(mesh)
    if len(missing := np.flatnonzero(left < 0)):
        raise _too_close(mesh.points[mesh.chain[missing]])
    right = mesh.twin[left]
    component = _components(mesh, left, right)
    touching = np.concatenate([component[left // 3], component[right // 3]])
    cell = np.concatenate([arrangement.left_cell[mesh.chain_border], arrangement.right_cell[mesh.chain_border]])
    cell_of_component = np.full(component.max() + 1, -1)
    cell_of_component[touching] = cell
    component_of_cell = np.full(arrangement.n_cells, -1)
    component_of_cell[cell] = touching
    wrong = (cell_of_component[touching] != cell) | (component_of_cell[cell] != touching)
    if wrong.any() or (cell_of_component < 0).any():
        raise _too_close(mesh.points[np.concatenate([mesh.chain, mesh.chain])[wrong]])
    return np.asarray(cell_of_component[component]), left


def _left_of_chain(mesh: _Mesh) -> Ints:
    """Return the half-edge along each piece of the chain; a point is the start of at most two pieces."""
    start, end = mesh.triangles.ravel(), mesh.triangles[:, [1, 2, 0]].ravel()
    pieces = np.arange(len(mesh.chain))
    left = np.full(len(pieces), -1)
    for order in (pieces, pieces[::-1]):
        piece_from, next_point = np.full((2, len(mesh.points)), -1)
        piece_from[mesh.chain[order]] = order
        next_point[mesh.chain[order]] = np.roll(mesh.chain, -1)[order]
        along = np.flatnonzero(next_point[start] == end)
        left[piece_from[start[along]]] = along
    return left


def _components(mesh: _Mesh, left: Ints, right: Ints) -> Ints:
    """Return the component of each triangle when the mesh is cut along the chain."""
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    twin = mesh.twin.copy()
    twin[left] = twin[right] = -1
    linked = twin >= 0
    t = len(mesh.triangles)
    row = np.concatenate([[0], np.cumsum(linked.reshape(t, 3).sum(axis=1))])
    graph = csr_array((np.ones(row[-1]), twin[linked] // 3, row), shape=(t, t))
    # Links go both ways, so the strong components are the components, and they need no second copy of the graph.
    return np.asarray(connected_components(graph, connection="strong")[1], dtype=np.int64)
