"""One quality triangulation of the whole drawing, cut along its borders into cells."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from plyfold.arrangement.planar_map import Ints
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.predicates import Floats, orient
from plyfold.surface.halfedges import HalfEdges

if TYPE_CHECKING:
    from plyfold.arrangement import Arrangement

__all__ = ["DEFAULT_TRIANGLES", "CellTriangulation", "triangulate"]

DEFAULT_TRIANGLES = 4000
# Refined triangles have on average 0.6 of the area that is allowed.
_USUAL_SHARE = 0.6
_SMALLEST_ANGLE = 25.0
# Edges are not split below this fraction of the usual edge, so that tiny features do not attract tiny triangles.
_SHORTEST_EDGE = 0.05
# Nor below this fraction of the usual edge of the curve.
_SHORTEST_PIECE = 0.3
_MOST_POINTS = 20_000_000


@dataclass(frozen=True, eq=False)
class CellTriangulation:
    """Triangles over the cells that the surface covers.

    Parameters
    ----------
    points : (p, 2) float
        The points of the curve in their order, bit for bit; then the crossings, rounded; then points added for the
        quality of the triangles.
    triangles : (t, 3) int
        Counter-clockwise (exactly) and none across a border.
    cell : (t,) int
        The cell each triangle lies in; its winding number is at least 1.
    chain : (s,) int
        The points along the curve in order, from the curve's first point, crossings and added points included (a
        crossing occurs twice). Piece j of the curve runs from ``chain[j]`` to ``chain[j + 1]``, the last one back.
    chain_border : (s,) int
        The border each piece belongs to.
    """

    points: Floats
    triangles: Ints
    cell: Ints
    chain: Ints
    chain_border: Ints


def triangulate(
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
        w times). Curves with many points have more.

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
    >>> mesh = triangulate(arrangement([(0, 0), (4, 0), (4, 4), (0, 4)]), max_area=100.0)
    >>> mesh.points[:4].tolist(), mesh.chain[0]
    ([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], np.int64(0))
    """
    outline = _outline(arrangement)
    try:
        return _verified(arrangement, outline, _refined(arrangement, outline, max_area, triangles))
    except PrecisionError:
        # Added points are rounded too, and may not fit where the cells are as thin as rounding errors.
        return _verified(arrangement, outline, _refined(arrangement, outline, np.inf, 0))


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
        raise PlyfoldError("a surface needs a drawing, and this arrangement is a Gauss code alone")
    n, visits = len(curve.points), len(arrangement.visit_edge)
    points = np.concatenate([curve.points, arrangement.crossings])
    _refuse_equal(points)
    node = np.concatenate([np.arange(n), n + arrangement.crossing_of_visit])
    edge = np.concatenate([np.arange(n), arrangement.visit_edge])
    along_edge = np.concatenate([np.zeros(n, dtype=np.int64), np.arange(1, visits + 1)])
    order = np.lexsort((along_edge, edge))
    border = (np.cumsum(order >= n) - 1) % max(visits, 1)
    return _Outline(points, node[order], border, *_unit_square(points))


def _refuse_equal(points: Floats) -> None:
    places, count = np.unique(points, axis=0, return_counts=True)
    if (count > 1).any():
        raise PrecisionError(
            "crossings fall on each other or on a point of the curve when rounded to double precision",
            where=places[count > 1],
            hint="move the strands apart there",
        )


def _unit_square(points: Floats) -> tuple[Floats, Floats, float]:
    """Return the points moved and scaled to about unit size, with the centre and the scale that lead back.

    Both steps are exact: the scale is a power of two, and where the centre is not left at 0 it is so far away that
    the difference of two doubles has no rounding error (Sterbenz).
    """
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high / 2 - low / 2).max())
    scale = 2.0 ** (np.frexp(size)[1] + 1)
    middle = low / 2 + high / 2
    centre = np.where(np.abs(middle) >= 4 * size, middle, 0.0)
    return (points - centre) / scale, centre, float(scale)


@dataclass(frozen=True, eq=False)
class _Mesh:
    """What comes back from the triangulation library, in the unit square."""

    unit_points: Floats
    triangles: Ints
    chain: Ints
    chain_border: Ints


def _refined(arrangement: Arrangement, outline: _Outline, max_area: float | None, triangles: int) -> _Mesh:
    """Triangulate, drop what the surface does not cover, and refine (unless no triangles are asked for)."""
    mesh = _constrained(outline)
    uncovered = _uncovered(arrangement, outline, mesh)
    if triangles:
        covered = _covered(outline)
        most = covered / (_USUAL_SHARE * triangles) if max_area is None else max_area / outline.scale**2
        _refine(mesh, most, covered / most, uncovered, _shortest_edge(outline, most))
    mesh.finalize_triangulation(uncovered)
    corners = mesh.vertices_array()
    unit_points = np.stack([corners["x"], corners["y"]], axis=1)
    return _Mesh(unit_points, _corners(mesh), *_split_chain(outline, unit_points, mesh.piece_to_originals))


def _constrained(outline: _Outline) -> Any:
    """Return the constrained Delaunay triangulation; its first three vertices are those of an enclosing triangle."""
    import pythoncdt as cdt

    edges = np.stack([outline.chain, np.roll(outline.chain, -1)], axis=1)
    mesh = cdt.Triangulation(cdt.VertexInsertionOrder.AUTO, cdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0)
    try:
        mesh.insert_vertices(outline.unit_points)  # type: ignore[call-overload,unused-ignore]
        mesh.insert_edges(edges.astype(np.uintc))  # type: ignore[call-overload,unused-ignore]
    except RuntimeError as error:
        named = [int(number) for pair in re.findall(r"\((\d+), (\d+)\)", str(error)) for number in pair]
        raise _too_close(outline.points[named]) from error
    if mesh.fixed_edges_count() != len(edges):
        named = [edge.v1 - 3 for originals in mesh.piece_to_originals.values() for edge in originals]
        raise _too_close(outline.points[named])
    return mesh


def _too_close(places: Floats) -> PrecisionError:
    return PrecisionError(
        "strands are so close that rounding their crossings to double precision changes the drawing",
        where=places,
        hint="move the strands apart there",
    )


def _corners(mesh: Any) -> Ints:
    return np.asarray(mesh.triangles_array()["vertices"].astype(np.int64))


def _uncovered(arrangement: Arrangement, outline: _Outline, mesh: Any) -> set[int]:
    """Return the triangles outside the curve and in cells with winding number 0."""
    cell = _cell_of_triangle(arrangement, _corners(mesh), outline.chain + 3, outline.chain_border, outline.points)
    return set(np.flatnonzero(arrangement.winding[cell] == 0).tolist())


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


def _refine(mesh: Any, most: float, wanted: float, uncovered: set[int], shortest: float) -> None:
    """Split triangles larger than ``most``, about ``wanted`` in all, and then those with sharp angles."""
    import pythoncdt as cdt

    # A limit on added points, for needles would take as many as they are longer than wide to get good angles.
    limit = min(int(wanted) + mesh.vertices_count(), _MOST_POINTS)
    mesh.refine_triangles(limit, cdt.RefinementCriterion.LARGEST_AREA, most, uncovered, shortest)
    angle = cdt.deg_to_rad(_SMALLEST_ANGLE)
    mesh.refine_triangles(limit, cdt.RefinementCriterion.SMALLEST_ANGLE, angle, uncovered, shortest)


def _split_chain(outline: _Outline, unit_points: Floats, originals: dict[Any, list[Any]]) -> tuple[Ints, Ints]:
    """Return the chain along the curve with the points that refinement has put on it, and the borders."""
    starts, ends = outline.chain, np.roll(outline.chain, -1)
    piece_of = {frozenset(pair): j for j, pair in enumerate(zip(starts.tolist(), ends.tolist(), strict=True))}
    known = len(outline.points)
    added = {
        (piece_of[frozenset((whole[0].v1, whole[0].v2))], vertex)
        for piece, whole in originals.items()
        for vertex in (piece.v1, piece.v2)
        if vertex >= known
    }
    piece, vertex = np.array(sorted(added), dtype=np.int64).reshape(-1, 2).T
    direction = unit_points[ends[piece]] - unit_points[starts[piece]]
    advance = ((unit_points[vertex] - unit_points[starts[piece]]) * direction).sum(axis=1)
    every_piece = np.concatenate([np.arange(len(starts)), piece])
    order = np.lexsort((np.concatenate([np.full(len(starts), -np.inf), advance]), every_piece))
    return np.concatenate([starts, vertex])[order], outline.chain_border[every_piece[order]]


def _verified(arrangement: Arrangement, outline: _Outline, mesh: _Mesh) -> CellTriangulation:
    """Carry the triangles back to the drawing and check there, exactly, that they are what they should be."""
    points = outline.centre + mesh.unit_points * outline.scale
    points[: len(outline.points)] = outline.points
    a, b, c = points[mesh.triangles].swapaxes(0, 1)
    if len(flat := np.flatnonzero(orient(a, b, c) <= 0)):
        raise _too_close(a[flat])
    cell = _cell_of_triangle(arrangement, mesh.triangles, mesh.chain, mesh.chain_border, points)
    return CellTriangulation(points, mesh.triangles, cell, mesh.chain, mesh.chain_border)


def _cell_of_triangle(
    arrangement: Arrangement, triangles: Ints, chain: Ints, chain_border: Ints, points: Floats
) -> Ints:
    """Return the cell of each triangle: cut along the curve, the triangles must fall apart into exactly the cells.

    The faces of a connected plane graph are disks. So if every component of triangles has only the borders of one
    cell on its sides, the right way round, and every cell only one component, the drawing is the exact one.
    """
    component, left, right = _components(triangles, chain)
    if len(missing := np.flatnonzero(left < 0)):
        raise _too_close(points[chain[missing]])
    inside = np.flatnonzero(right >= 0)
    touching = np.concatenate([component[left // 3], component[right[inside] // 3]])
    cell = np.concatenate([arrangement.left_cell[chain_border], arrangement.right_cell[chain_border[inside]]])
    cell_of_component = np.full(component.max() + 1, -1)
    cell_of_component[touching] = cell
    component_of_cell = np.full(arrangement.n_cells, -1)
    component_of_cell[cell] = touching
    wrong = (cell_of_component[touching] != cell) | (component_of_cell[cell] != touching)
    if wrong.any() or (cell_of_component < 0).any():
        place = chain[np.concatenate([np.arange(len(chain)), inside])[wrong]]
        raise _too_close(points[place])
    return np.asarray(cell_of_component[component])


def _components(triangles: Ints, chain: Ints) -> tuple[Ints, Ints, Ints]:
    """Return the component of each triangle when the mesh is cut along the chain, and the half-edges beside it.

    The half-edges are −1 where a piece of the chain has no triangle on that side.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    sides = HalfEdges(triangles)
    left = sides.find(chain, np.roll(chain, -1))
    right = sides.find(np.roll(chain, -1), chain)
    twin = sides.twin
    twin[left[left >= 0]] = twin[right[right >= 0]] = -1
    linked = np.flatnonzero(twin >= 0)
    t = len(triangles)
    graph = coo_array((np.ones(len(linked), dtype=np.int8), (linked // 3, twin[linked] // 3)), shape=(t, t))
    return connected_components(graph, directed=False)[1].astype(np.int64), left, right
