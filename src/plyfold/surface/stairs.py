"""Spiral stairs round cusps: where the surface winds round a vertex of its outline.

Heights near a cusp depend on the direction from it, and hardly on the distance: the surface climbs the more steeply,
the nearer to the cusp. So the triangles there are made narrow, and their edges at the cusp get further points at a
quarter of the length, at a sixteenth and so on, which have the height of the edge's other end. Only the innermost
triangles lead to the cusp itself. Sheets that pass above or below keep straight there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.halfedges import before, ends_of, following
from plyfold.mesh.cells import CellTriangulation
from plyfold.surface.chords import halved, triangulation
from plyfold.surface.glue import LiftedMesh
from plyfold.surface.heights import distances_apart, highest_below, rows_upward

__all__ = ["Steps", "heights_of_stairs", "with_cusps_apart", "with_steps"]

# Points on the edges at a cusp, and how much shorter each is than the one before.
_RINGS, _RATIO = 3, 4.0
# The points of each ring are turned by this share of the angle to the next one: no three are on one line.
_TURNED = 1 / 32
# Cusps with edges that are so many roundings short stay as they are.
_SHORTEST = 2.0**24


@dataclass(frozen=True, eq=False)
class Steps:
    """Triangles with the points on the edges at cusps.

    Parameters
    ----------
    cells : CellTriangulation
    outer : (p,) int
        Of each point on an edge at a cusp the next one outward, −1 of all other points; empty if there are no steps.
    """

    cells: CellTriangulation
    outer: Ints

    @classmethod
    def none(cls, cells: CellTriangulation) -> Steps:
        """Return triangles as they are."""
        return cls(cells, np.empty(0, dtype=np.int64))


def with_steps(mesh: CellTriangulation, cusps: Ints) -> Steps:
    """Make triangles at cusps narrower, and divide them by rings of points.

    Parameters
    ----------
    mesh : CellTriangulation
    cusps : (c,) int
        Points of the outline.

    Returns
    -------
    Steps
        No other triangles change, but those beside the ones at cusps.

    Raises
    ------
    PrecisionError
        If double precision has no point in the middle of an edge.

    Examples
    --------
    >>> from plyfold import arrange
    >>> from plyfold.mesh.cells import triangulate_cells
    >>> square = triangulate_cells(arrange([(0, 0), (2, 0), (2, 2), (0, 2)]), triangles=0)
    >>> points = with_steps(square, np.array([0])).cells.points
    >>> round(float(np.hypot(*points[1:].T).min()), 6)
    0.011049
    """
    mesh, cusps = with_cusps_apart(mesh, cusps), _with_room(mesh, cusps)
    if not len(cusps):
        return Steps.none(mesh)
    mesh = halved(mesh, _seen_from(mesh, cusps))
    mesh = halved(mesh, _half_edges_at(mesh, cusps))
    return _with_rings(halved(mesh, _seen_from(mesh, cusps)), cusps)


def with_cusps_apart(mesh: CellTriangulation, cusps: Ints) -> CellTriangulation:
    """Split the edges between two cusps: there, the two sides of a solid would have an edge in common."""
    start, end = ends_of(mesh.triangles)
    between = np.isin(start, cusps) & np.isin(end, cusps) & ((start < end) | (mesh.twin < 0))
    return halved(mesh, np.flatnonzero(between))


def _with_room(mesh: CellTriangulation, cusps: Ints) -> Ints:
    """Return the cusps whose edges are all long enough to be divided."""
    start, end = ends_of(mesh.triangles)
    short = np.abs(mesh.points[end] - mesh.points[start]).max(axis=1) < _SHORTEST * np.spacing(
        np.abs(mesh.points).max()
    )
    return np.setdiff1d(cusps, np.append(start[short], end[short]))


def _seen_from(mesh: CellTriangulation, cusps: Ints) -> Ints:
    """Return the half-edges opposite to a cusp in their triangle, one for each edge; none that ends at a cusp."""
    start, end = ends_of(mesh.triangles)
    opposite = np.flatnonzero(np.isin(start[before(np.arange(len(start)))], cusps))
    opposite = opposite[~np.isin(start[opposite], cusps) & ~np.isin(end[opposite], cusps)]
    twin = mesh.twin[opposite]
    return opposite[~(np.isin(twin, opposite) & (twin < opposite))]


def _half_edges_at(mesh: CellTriangulation, cusps: Ints) -> Ints:
    """Return the half-edges that start at cusps, or only end there, one for each edge."""
    start, end = ends_of(mesh.triangles)
    leaves, arrives = np.isin(start, cusps), np.isin(end, cusps)
    alone = arrives & ~leaves & (mesh.twin < 0)
    return np.flatnonzero((leaves & ~(arrives & (start > end))) | alone)


def _with_rings(mesh: CellTriangulation, cusps: Ints) -> Steps:
    """Divide the triangles at cusps by rings of points on their edges there."""
    spokes = _half_edges_at(mesh, cusps)
    inner = mesh.triangles.ravel()[spokes]
    begins = np.isin(inner, cusps)
    cusp, end = np.where(begins, [inner, _end_of(mesh, spokes)], [_end_of(mesh, spokes), inner])
    first, count = len(mesh.points), len(spokes)
    added = _ring_points(mesh, spokes, cusp, end)
    # Point j of spoke i has the number first + count * j + i.
    outer = np.full(first + _RINGS * count, -1)
    outer[first:] = np.concatenate([end, first + np.arange((_RINGS - 1) * count)])
    spoke_of = np.full(3 * len(mesh.triangles), -1)
    spoke_of[spokes] = np.arange(count)
    twin = mesh.twin[spokes]
    spoke_of[twin[twin >= 0]] = np.flatnonzero(twin >= 0)
    points = np.concatenate([mesh.points, added])
    triangles, cell = _divided(mesh, cusps, spoke_of, first, count)
    chain = _chain_with_rings(mesh, cusps, spoke_of, first, count)
    return Steps(triangulation(points, triangles, cell, chain, mesh.strips), outer)


def _end_of(mesh: CellTriangulation, half_edges: Ints) -> Ints:
    return np.asarray(mesh.triangles.ravel()[following(half_edges)])


def _ring_points(mesh: CellTriangulation, spokes: Ints, cusp: Ints, end: Ints) -> Floats:
    """Return the points on all spokes, ring after ring; those inside of cells are turned a little."""
    centre = mesh.points[cusp].view(np.complex128).ravel()
    spoke = mesh.points[end].view(np.complex128).ravel() - centre
    turn = _TURNED * _narrower_angle(mesh, spokes)
    rings = [centre + spoke * np.exp(1j * turn * (ring + 1)) / _RATIO ** (ring + 1) for ring in range(_RINGS)]
    return np.concatenate(rings).view(np.float64).reshape(-1, 2)


def _narrower_angle(mesh: CellTriangulation, spokes: Ints) -> Floats:
    """Return the smaller of the angles on both sides of half-edges inside cells, at their starts; 0 of others."""
    angle, twin = np.zeros(len(spokes)), mesh.twin[spokes]
    inside = np.flatnonzero((twin >= 0) & ~np.isin(spokes, mesh.beside) & ~np.isin(twin, mesh.beside))
    left, right = (_angle_at_start(mesh, side[inside]) for side in (spokes, following(twin)))
    # What is turned to the left leaves an angle of less than half a turn on its right.
    angle[inside] = np.minimum(np.minimum(left, right), np.pi - right)
    return angle


def _angle_at_start(mesh: CellTriangulation, half_edges: Ints) -> Floats:
    corner = mesh.triangles.ravel()
    start, end, third = (
        mesh.points[corner[side]].view(np.complex128).ravel()
        for side in (half_edges, following(half_edges), before(half_edges))
    )
    return np.angle((third - start) / (end - start))


def _divided(mesh: CellTriangulation, cusps: Ints, spoke_of: Ints, first: int, count: int) -> tuple[Ints, Ints]:
    """Return all triangles, those at cusps divided, and their cells."""
    side = np.flatnonzero(np.isin(mesh.triangles.ravel(), cusps) & (spoke_of >= 0))
    side = side[spoke_of[before(side)] >= 0]
    right, left = spoke_of[side], spoke_of[before(side)]
    cusp, a, b = (mesh.triangles.ravel()[corner] for corner in (side, following(side), before(side)))
    parts = []
    for ring in range(_RINGS):
        p, q = first + count * ring + right, first + count * ring + left
        parts += [np.stack([p, a, b], axis=1), np.stack([p, b, q], axis=1)]
        a, b = p, q
    parts.append(np.stack([cusp, a, b], axis=1))
    kept = np.delete(np.arange(len(mesh.triangles)), side // 3)
    triangles = np.concatenate([mesh.triangles[kept], *parts])
    return triangles, np.concatenate([mesh.cell[kept], np.tile(mesh.cell[side // 3], len(parts))])


def _chain_with_rings(
    mesh: CellTriangulation, cusps: Ints, spoke_of: Ints, first: int, count: int
) -> tuple[Ints, Ints, Ints]:
    """Return the chain with the points on the pieces that are spokes."""
    beside = mesh.beside
    piece = np.flatnonzero((beside >= 0) & (spoke_of[beside] >= 0))
    ring = np.arange(_RINGS)
    # From a cusp the innermost comes first.
    order = np.where(np.isin(mesh.chain[piece], cusps)[:, None], ring[::-1], ring)
    added = (first + count * order + spoke_of[beside[piece]][:, None]).ravel()
    at = np.repeat(piece + 1, _RINGS)
    chain_border = np.insert(mesh.chain_border, at, np.repeat(mesh.chain_border[piece], _RINGS))
    return (
        np.insert(mesh.chain, at, added),
        chain_border,
        mesh.first_piece + np.searchsorted(at, mesh.first_piece, side="right"),
    )


# ---- heights ---------------------------------------------------------------------------------------------------------


def heights_of_stairs(  # noqa: PLR0913 - a mesh, and what is asked of its heights
    points: Floats,
    mesh: LiftedMesh,
    outer: Ints,
    gap: float,
    heights: Callable[..., Floats],
    *,
    thickness: Floats | None = None,
) -> Floats:
    """Return the heights of a mesh with steps, given a function for meshes without.

    Parameters
    ----------
    points : (p, 2) float
    mesh : LiftedMesh
    outer : (p,) int
        As in :class:`Steps`.
    gap : float
    heights : function
        From the points, the mesh without those on edges at cusps, the gap and ``thickness=`` to the heights of the
        mesh's vertices.
    thickness : (v,) float, optional
        See :func:`~plyfold.surface.heights.smooth_heights`.

    Returns
    -------
    (v,) float
        Stacked vertices over these points are as far apart as those at the outer ends of the edges.
    """
    if not len(outer):
        return heights(points, mesh, gap, thickness=thickness)
    up, down = _along_spokes(mesh, outer)
    kept = up == np.arange(len(up))
    number = np.cumsum(kept) - 1
    thickest = None if thickness is None else _thickest(thickness, up)[kept]
    z = heights(points, _without_steps(mesh, kept, number[up]), gap, thickness=thickest)[number[up]]
    passing_by = np.flatnonzero(~kept & ~np.isin(down, mesh.cusps))
    ring, tip, foot = (points[mesh.planar_vertex[vertex[passing_by]]] for vertex in (np.arange(len(up)), up, down))
    share = np.hypot(*(ring - foot).T) / np.hypot(*(tip - foot).T)
    straight = z[down[passing_by]] + share * (z[up[passing_by]] - z[down[passing_by]])
    return _never_nearer(z, passing_by, straight, mesh, distances_apart(mesh, gap, thickness))


def _thickest(thickness: Floats, up: Ints) -> Floats:
    """Return the largest thickness of all vertices that have their heights from each vertex."""
    most = np.zeros(len(up))
    np.maximum.at(most, up, thickness)
    return most


def _along_spokes(mesh: LiftedMesh, outer: Ints) -> tuple[Ints, Ints]:
    """Return for each vertex on an edge at a cusp, or over it, the outer and the inner end; for others themselves."""
    start, end = (np.concatenate(ends) for ends in zip(ends_of(mesh.faces), ends_of(mesh.faces)[::-1], strict=True))
    point, beyond = mesh.planar_vertex[start], mesh.planar_vertex[end]
    up, down = np.tile(np.arange(len(mesh.level)), (2, 1))
    outward = np.flatnonzero((outer[point] >= 0) & (outer[point] == beyond))
    up[start[outward]] = end[outward]
    inward = np.flatnonzero((outer[point] >= 0) & np.isin(beyond, mesh.planar_vertex[mesh.cusps]))
    down[start[inward]] = end[inward]
    ring = np.flatnonzero(outer[mesh.planar_vertex] >= 0)
    at = ring[down[ring] != ring]
    for _ in range(_RINGS - 1):
        down[up[at]] = down[at]
        at = up[at]
    for _ in range(_RINGS - 1):
        up[ring] = up[up[ring]]
    return up, down


def _without_steps(mesh: LiftedMesh, kept: Bools, number: Ints) -> LiftedMesh:
    """Return the mesh with some vertices kept, all others moved to them, and without the triangles lost by that."""
    faces = number[mesh.faces]
    left = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    passing = number[mesh.passing]
    return LiftedMesh(
        planar_vertex=mesh.planar_vertex[kept],
        faces=faces[left],
        sheet=mesh.sheet[left],
        boundary=number[mesh.boundary[kept[mesh.boundary]]],
        first_boundary=np.append(0, np.cumsum(kept[mesh.boundary]))[mesh.first_boundary],
        cusps=number[mesh.cusps],
        level=mesh.level[kept],
        stacked=number[mesh.stacked[kept[mesh.stacked].all(axis=1)]],
        passing=passing[passing[:, 0] != passing[:, 1]],
    )


def _never_nearer(z: Floats, vertices: Ints, wanted: Floats, mesh: LiftedMesh, distance: Floats) -> Floats:
    """Return heights with those of some vertices as wanted, as far as they keep their distance to others over them.

    They are above or below a stair, which stays as it is.
    """
    moved, free = z.copy(), np.zeros(len(z), dtype=bool)
    moved[vertices], free[vertices] = wanted, True
    lower, upper = mesh.stacked.T
    least = np.where(z[lower] + distance <= z[upper], distance, z[upper] - z[lower])
    top = np.full(int(mesh.planar_vertex.max()) + 1, -1)
    np.maximum.at(top, mesh.planar_vertex[~free], mesh.level[~free])
    above = mesh.level > top[mesh.planar_vertex]
    for rows in rows_upward(mesh):
        pressed = rows[free[upper[rows]] & above[upper[rows]]]
        np.maximum.at(moved, upper[pressed], moved[lower[pressed]] + least[pressed])
    for rows in reversed(list(rows_upward(mesh))):
        pressed = rows[free[lower[rows]] & ~above[lower[rows]]]
        np.minimum.at(moved, lower[pressed], highest_below(moved[upper[pressed]], least[pressed]))
    return moved
