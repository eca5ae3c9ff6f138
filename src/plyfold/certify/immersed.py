"""Check that a flat mesh is an immersed disk with the curve as its boundary."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from plyfold.certify.disk import Sides, disk_sides
from plyfold.certify.exact import Bools, CertificateError, Floats, Ints, cross_sign, finite, require_positive

__all__ = ["check_immersed_disk"]

# How far a vertex between two points of the curve may lie off their edge, in units in the last place of the largest
# coordinate. Each time an edge is split, the new point is off by another rounding error.
_ULPS_OFF_THE_EDGE = 64


def check_immersed_disk(
    curve_points: npt.ArrayLike, vertices_xy: npt.ArrayLike, faces: npt.ArrayLike, boundary: npt.ArrayLike
) -> None:
    """Check that a flat mesh is an immersed disk with the curve as its boundary.

    Parameters
    ----------
    curve_points : array_like, shape (n, 2)
        The closed curve with the disk on its left; the last point joins the first.
    vertices_xy : array_like, shape (v, 2)
        Positions; several vertices may lie at one place.
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, counter-clockwise.
    boundary : array_like of int, shape (b,)
        Vertices along the curve; the first one lies at the curve's first point.

    Raises
    ------
    CertificateError
        If the mesh is no disk (see :func:`check_disk_mesh`), a triangle is not strictly counter-clockwise, the
        boundary does not run along the curve or the triangles at a vertex turn too often. It names the place.

    Notes
    -----
    The boundary must hold the curve's points exactly. Vertices between them may be off their edge by 64 units in the
    last place of the largest coordinate, and must advance along it.

    The triangles at an inner vertex must turn round it exactly once; those at a boundary vertex must fill the angle
    between its two boundary edges and less than a full turn. Both are counted by signs: triangles are
    counter-clockwise, so each sweeps less than half a turn. This condition is needed: without it a curve with turning
    number 2, the limaçon, passes. O(m log m); 1e5 triangles take about 0.3 s.

    Examples
    --------
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> check_immersed_disk(square, square, [[0, 1, 2], [0, 2, 3]], boundary=[0, 1, 2, 3])
    >>> check_immersed_disk(square, square, [[0, 1, 2], [0, 2, 3]], boundary=[1, 2, 3, 0])
    Traceback (most recent call last):
    plyfold.certify.exact.CertificateError: the boundary does not start at the curve's first point, at (0, 0)
    """
    points, places = finite(curve_points, 2), finite(vertices_xy, 2)
    sides = disk_sides(faces, len(places))
    loop = np.asarray(boundary)
    require_positive(places, sides.start.reshape(-1, 3))
    _require_boundary_loop(sides, loop, places)
    _require_along_curve(points, places[loop])
    _require_single_turns(sides, loop, places)


def _require_boundary_loop(sides: Sides, loop: Ints, places: Floats) -> None:
    """Check that the loop is the boundary of the mesh, walked with the mesh on the left."""
    if loop.ndim != 1 or loop.dtype.kind not in "iu" or len(loop) != np.count_nonzero(sides.twin < 0):
        raise CertificateError("the given boundary is not a row of all boundary vertices of the mesh")
    if loop.min() < 0 or loop.max() >= len(places):
        raise CertificateError("the given boundary names a vertex that does not exist")
    side = sides.boundary_side[loop]
    wrong = np.flatnonzero((side < 0) | (sides.end[side] != np.roll(loop, -1)))
    if len(wrong):
        raise CertificateError("the given boundary leaves the boundary of the mesh", where=places[loop[wrong[:1]]])


def _require_along_curve(points: Floats, walk: Floats) -> None:
    """Check that the positions along the boundary go through the curve's points and along its edges."""
    at = _positions_of(points, walk)
    edge = np.repeat(np.arange(len(points)), np.diff(np.append(at, len(walk))))
    start, end = points[edge], np.roll(points, -1, axis=0)[edge]
    between = np.setdiff1d(np.arange(len(walk)), at)
    off = _off_the_edge(start[between], end[between], walk[between], float(np.abs(points).max()))
    if len(bad := between[off]):
        raise CertificateError("the boundary leaves the curve", where=walk[bad])
    # The dot product is the cross product with the edge turned by a quarter.
    quarter = np.array([[0.0, 1.0], [-1.0, 0.0]])
    advance = cross_sign(walk, np.roll(walk, -1, axis=0), start @ quarter, end @ quarter)
    if len(back := np.flatnonzero(advance <= 0)):
        raise CertificateError("the boundary stops or runs backwards along the curve", where=walk[back])


def _positions_of(points: Floats, walk: Floats) -> Ints:
    """Return where the curve's points occur along the boundary, in order."""
    if not len(walk) or (walk[0] != points[0]).any():
        raise CertificateError("the boundary does not start at the curve's first point", where=points[:1])
    wanted: list[list[float]] = points.tolist()
    at: list[int] = []
    for position, place in enumerate(walk.tolist()):
        if len(at) < len(wanted) and place == wanted[len(at)]:
            at.append(position)
    if len(at) < len(wanted):
        raise CertificateError("the boundary misses a point of the curve", where=points[len(at) : len(at) + 1])
    return np.array(at)


def _off_the_edge(start: Floats, end: Floats, place: Floats, largest: float) -> Bools:
    """Tell which places are further from the lines through their edges than rounding explains."""
    unit = 2.0 ** -float(np.frexp(largest)[1])
    # Differences and products lose a few units in the last place more, which the allowance covers.
    edge, step = (end - start) * unit, (place - start) * unit
    distance = np.abs(edge[:, 0] * step[:, 1] - edge[:, 1] * step[:, 0]) / np.hypot(*edge.T)
    return np.asarray(~(distance <= _ULPS_OFF_THE_EDGE * np.spacing(largest) * unit))


def _require_single_turns(sides: Sides, loop: Ints, places: Floats) -> None:
    """Check that the triangles turn once round each inner vertex, and less than once at each boundary vertex.

    Full turns are counted as passages through the direction of +x: from a direction in [π, 2π) to one in [0, π). The
    fan at a boundary vertex goes from its outgoing edge to its incoming one.
    """
    upward = _upward(places[sides.start], places[sides.end])
    # A triangle's corner sweeps from the side that leaves it to the one that arrives, reversed.
    passages = np.bincount(sides.start[~upward & ~upward[sides.previous]], minlength=len(places))
    here, after, before = places[loop], places[np.roll(loop, -1)], places[np.roll(loop, 1)]
    outgoing, incoming = _upward(here, after), _upward(here, before)
    turn = cross_sign(here, after, here, before)
    same_half = outgoing == incoming
    expected = np.ones(len(places), dtype=np.int64)
    expected[loop] = np.where(same_half, turn <= 0, incoming)
    wrong = passages != expected
    wrong[loop] |= same_half & (turn == 0)
    if wrong.any():
        raise CertificateError("the triangles at a vertex turn round it too often", where=places[wrong])


def _upward(start: Floats, end: Floats) -> Bools:
    """Tell which directions have an angle in [0, π)."""
    return np.asarray((end[:, 1] > start[:, 1]) | ((end[:, 1] == start[:, 1]) & (end[:, 0] > start[:, 0])))
