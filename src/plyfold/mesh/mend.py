"""Triangles with sharp angles that are left around thin strips are mended, on the outside of the strip alone.

Refinement in the manner of Chew's second algorithm [She02]_: a point is added near the centre of the circle around a
bad triangle, or, if an edge of the curve is in between or too near, on that edge. What counts is what the triangle can
see. The other side of a strip does not, so however thin it is, its sides do not ask each other for ever more points.

Three kinds of bad triangles are left alone: with the sharp angle between two edges of the curve; with the shortest side
across a corner sharper than 60°; and with the shortest side across a strip, where two edges of the curve run side by
side for four times their distance. Good triangles there would take points in proportion to length by width, and to the
logarithm of that everywhere else.

References
----------
.. [She02] J. R. Shewchuk, "Delaunay refinement algorithms for triangular mesh generation", Computational Geometry 22,
   2002.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.mending import EdgedMesh, Mending, is_to_mend, mend

__all__ = ["FREE", "GIVEN", "Edged", "Limits", "mend_angles", "sharp_triangles"]

_SINE = float(np.sin(np.radians(25.0)))

# What a point is on instead of a piece: none, or it is an end of pieces.
FREE, GIVEN = -1, -2


class Edged(NamedTuple):
    """Triangles with the curve among their edges, in the unit square.

    Parameters
    ----------
    points : (p, 2) float
    on : (p,) int
        The piece of the outline that each point is on, or ``FREE``, or ``GIVEN``.
    start, beyond, piece : (3t,) int
        Where each half-edge starts; the half-edge on its other side, −1 where there is no triangle; the piece of the
        outline that it is part of, −1 if none.
    cell : (t,) int
        That in which each triangle lies.
    """

    points: Floats
    on: Ints
    start: Ints
    beyond: Ints
    piece: Ints
    cell: Ints


class Limits(NamedTuple):
    """How many points may be added, and the length below which parts of the curve are not split."""

    points: int
    finest: float


def sharp_triangles(unit_points: Floats, triangles: Ints) -> Ints:
    """Return the numbers of triangles with sharp angles, by the sine rule."""
    x, y = unit_points.T.copy()
    a, b, c = triangles.T.copy()
    ab_x, ab_y, bc_x, bc_y, ca_x, ca_y = x[b] - x[a], y[b] - y[a], x[c] - x[b], y[c] - y[b], x[a] - x[c], y[a] - y[c]
    ab, bc, ca = np.sqrt(ab_x**2 + ab_y**2), np.sqrt(bc_x**2 + bc_y**2), np.sqrt(ca_x**2 + ca_y**2)
    area = ab_x * bc_y - ab_y * bc_x
    return np.flatnonzero(area * np.minimum(np.minimum(ab, bc), ca) < _SINE * ab * bc * ca)


def mend_angles(mesh: Edged, sharp: Ints, ends: tuple[Ints, Ints], limits: Limits) -> Edged | None:
    """Add points until no more triangles can be mended.

    Parameters
    ----------
    mesh : Edged
    sharp : (b,) int
        The triangles with sharp angles.
    ends : tuple of (s,) int
        The points at both ends of each piece of the outline.
    limits : Limits

    Returns
    -------
    Edged or None
        None if it takes too many points. Triangles are counter-clockwise, exactly, if those of the mesh are. O(n) for
        n triangles, and about O(1) for each point.
    """
    grown = _with_room(mesh, max(0, limits.points))
    columns = all_flat(*grown._replace(points=grown.points.reshape(-1)))
    made = EdgedMesh(len(mesh.points), len(mesh.cell), *columns)
    work = Mending(made, flat(ends[0]), flat(ends[1]), limits.finest)
    if not any(is_to_mend(work, triangle) for triangle in sharp.tolist()):
        return mesh
    return _without_room(grown, made) if mend(work, flat(sharp)) else None


def _with_room(mesh: Edged, more: int) -> Edged:
    """Return triangles with room for so many more points."""
    rows = (more, more, 6 * more, 6 * more, 6 * more, 2 * more)
    columns: Any = (
        np.concatenate([column, np.zeros((number, *column.shape[1:]), dtype=column.dtype)])
        for column, number in zip(mesh, rows, strict=True)
    )
    return Edged(*columns)


def _without_room(grown: Edged, made: EdgedMesh) -> Edged:
    """Return the points and triangles that there are."""
    points, sides = made.n_points, 3 * made.n_triangles
    sizes = (points, points, sides, sides, sides, made.n_triangles)
    columns: Any = (column[:size] for column, size in zip(grown, sizes, strict=True))
    return Edged(*columns)
