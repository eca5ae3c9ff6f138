"""Curve and crossings as the edges of a constrained Delaunay triangulation, made by the library CDT."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import PlyfoldError, PrecisionError

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = ["ENCLOSING", "Outline", "PlanarMesh", "chain_of", "constrained", "outline_of", "planar_mesh", "too_close"]

# The library starts with the three corners of a triangle around everything.
ENCLOSING = 3


@dataclass(frozen=True, eq=False)
class Outline:
    """The points of curve and crossings, the curve as a chain through them, and the same points in a unit square."""

    points: Floats
    chain: Ints
    chain_border: Ints
    unit_points: Floats
    centre: Floats
    scale: float

    @property
    def covered(self) -> float:
        """The area of the lifted surface in the unit square: what the curve encloses, times winding numbers."""
        x, y = self.unit_points[self.chain].T
        return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2

    @property
    def rounding(self) -> float:
        """The distance of neighbouring doubles in the drawing, as a length in the unit square."""
        return float(np.spacing(np.abs(self.points).max()) / self.scale)


def outline_of(arrangement: Arrangement) -> Outline:
    """Return the curve of a drawing, with its crossings."""
    curve = arrangement.curve
    if curve is None:
        raise PlyfoldError("triangles need a drawing, and this arrangement is a Gauss code alone")
    points = np.concatenate([curve.points, arrangement.crossings])
    chain, chain_border = chain_of(arrangement)
    return Outline(points, chain, chain_border, *_unit_square(points))


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


def constrained(outline: Outline, watch: Watch = UNWATCHED) -> Any:
    """Return the constrained Delaunay triangulation; its first three vertices are those of an enclosing triangle."""
    import pythoncdt as cdt

    edges = np.stack([outline.chain, np.roll(outline.chain, -1)], axis=1)
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
    mesh.insert_vertices(points)
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


def planar_mesh(library: Any, points: Floats, chain: Ints, chain_border: Ints) -> PlanarMesh:
    """Return the library's triangles, over the given points and the chain of the curve through them."""
    rows = library.triangles_array()
    corners = rows["vertices"].astype(np.int64) - ENCLOSING
    corners[corners < 0] += len(points) + ENCLOSING
    around = np.full((ENCLOSING, 2), np.nan)
    twin = _twins(corners, rows["neighbors"])
    return PlanarMesh(np.concatenate([points, around]), corners, twin, chain, chain_border)


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
