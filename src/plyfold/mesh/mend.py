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

from math import hypot, sqrt
from typing import NamedTuple

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops, run_loop
from plyfold.mesh.cavity import (
    FREE,
    HEAD,
    WAITING,
    Edged,
    Grown,
    Pieces,
    Room,
    Work,
    add_point,
    before,
    distance,
    following,
    split_edge,
    wait,
)

__all__ = ["Limits", "mend_angles", "sharp_triangles"]

_COSINE, _SINE = float(np.cos(np.radians(25.0))), float(np.sin(np.radians(25.0)))
# A point so far from the shortest side, by its length, makes an angle a little larger than needed.
_FAR = 0.475 * sqrt((1 + _COSINE) / (1 - _COSINE))
# Two edges of the curve make a strip if they are side by side for so many times their distance.
_THIN = 4.0
_LONGEST_WALK = 1000
# A step is a few microseconds of plain Python; so long it takes to make lists of each triangle, too.
_STEPS_FOR_EACH = 30


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
    most = max(0, limits.points)
    points, triangles = len(mesh.x), len(mesh.cell)
    more = (most, most, most, 6 * most, 6 * most, 6 * most, 2 * most)
    padded = Edged(*(np.pad(column, (0, number)) for column, number in zip(mesh, more, strict=True)))
    grown = Grown(*padded, total=np.array([points, triangles]))
    pieces, room = Pieces(*ends, np.array([limits.finest])), _room_for(sharp, len(grown.cell), len(grown.x))
    work = Work(pieces, room, grown)
    if all(_side_to_mend(work, triangle) < 0 for triangle in sharp.tolist()):
        return mesh
    made = run_loop(_mend, _STEPS_FOR_EACH * len(sharp) + triangles, (pieces, room), grown)
    points, triangles = made.total
    if points == len(grown.x):
        return None
    sides = 3 * triangles
    x, y, on, start, beyond, piece, cell, _ = made
    return Edged(x[:points], y[:points], on[:points], start[:sides], beyond[:sides], piece[:sides], cell[:triangles])


def _room_for(sharp: Ints, triangles: int, points: int) -> Room:
    waiting, waits, *notes = np.zeros((9, triangles + 2), dtype=np.int64)
    waiting[: len(sharp)] = sharp
    waits[sharp] = 1
    sizes, spoke = np.array([0, len(sharp), 0, 0]), np.full(points, -1)
    return Room(np.zeros(12), np.zeros(2), spoke, sizes, waiting, waits, *notes)


def _mend(given: tuple[Pieces, Room], mesh: Grown) -> int:
    """Look at the triangles that wait, and at those that take the place of others; return how many points there are."""
    pieces, room = given
    work = Work(pieces, room, mesh)
    while room.sizes[WAITING] > 0 and mesh.total[0] < len(mesh.x):
        triangle = _next_waiting(room)
        side = _side_to_mend(work, triangle)
        if side >= 0 and _improve(work, side):
            wait(room, triangle)
    return int(mesh.total[0])


@called_from_loops
def _next_waiting(room: Room) -> int:
    triangle: int = room.waiting[room.sizes[HEAD]]
    room.sizes[HEAD] = (room.sizes[HEAD] + 1) % len(room.waiting)
    room.sizes[WAITING] -= 1
    room.waits[triangle] = 0
    return triangle


@called_from_loops
def _side_to_mend(work: Work, triangle: int) -> int:
    """Return the shortest side of a triangle if the angle opposite is bad and can be mended, or -1."""
    mesh = work.mesh
    first = 3 * triangle
    a, b, c = mesh.start[first], mesh.start[first + 1], mesh.start[first + 2]
    ab, bc, ca = distance(mesh, a, b), distance(mesh, b, c), distance(mesh, c, a)
    area = (mesh.x[b] - mesh.x[a]) * (mesh.y[c] - mesh.y[a]) - (mesh.y[b] - mesh.y[a]) * (mesh.x[c] - mesh.x[a])
    least = min(ab, bc, ca)
    if area * least >= _SINE * ab * bc * ca:
        return -1
    side: int = first if ab == least else (first + 1 if bc == least else first + 2)
    return -1 if _is_left_alone(work, side) else side


@called_from_loops
def _is_left_alone(work: Work, side: int) -> bool:
    """Tell whether the shortest side of a bad triangle is across a corner of the curve, or across a strip."""
    mesh = work.mesh
    if mesh.piece[following(side)] >= 0 and mesh.piece[before(side)] >= 0:
        return True
    u, v = mesh.start[side], mesh.start[following(side)]
    if mesh.piece[side] >= 0 or mesh.on[u] == FREE or mesh.on[v] == FREE or mesh.on[u] == mesh.on[v] >= 0:
        return False
    if mesh.on[u] >= 0 and mesh.on[v] >= 0 and _is_across_corner(work, u, v):
        return True
    return _is_strip(work, side) or _is_strip(work, mesh.beyond[side])


@called_from_loops
def _is_across_corner(work: Work, u: int, v: int) -> bool:
    """Tell whether two points are on two pieces that meet with less than 60°."""
    pieces, mesh = work.pieces, work.mesh
    for corner in (pieces.first[mesh.on[u]], pieces.last[mesh.on[u]]):
        if corner in (pieces.first[mesh.on[v]], pieces.last[mesh.on[v]]):
            ux, uy = mesh.x[u] - mesh.x[corner], mesh.y[u] - mesh.y[corner]
            vx, vy = mesh.x[v] - mesh.x[corner], mesh.y[v] - mesh.y[corner]
            return bool(ux * vx + uy * vy > 0.5 * hypot(ux, uy) * hypot(vx, vy))
    return False


@called_from_loops
def _is_strip(work: Work, side: int) -> bool:
    """Tell whether the curve runs side by side from both ends of a half-edge, on its left."""
    mesh, place = work.mesh, work.room.place
    u, v = mesh.start[side], mesh.start[following(side)]
    around = before(side)
    while mesh.piece[around] < 0:
        around = before(mesh.beyond[around])
    length = _look_along(work, u, mesh.start[around], mesh.piece[around])
    ux, uy = place[0], place[1]
    around = following(side)
    while mesh.piece[around] < 0:
        around = following(mesh.beyond[around])
    length = min(length, _look_along(work, v, mesh.start[following(around)], mesh.piece[around]))
    width = abs(ux * (mesh.y[v] - mesh.y[u]) - uy * (mesh.x[v] - mesh.x[u]))
    if length < max(_THIN * width, distance(mesh, u, v)) or ux * place[0] + uy * place[1] <= 0:
        return False
    return bool(abs(1 - _THIN * (ux * place[1] - uy * place[0])) <= 2)


@called_from_loops
def _look_along(work: Work, point: int, towards: int, piece: int) -> float:
    """Find the direction of a piece of the curve from a point on it; return how far it goes."""
    mesh, place = work.mesh, work.room.place
    a, b = work.pieces.first[piece], work.pieces.last[piece]
    along = (mesh.x[b] - mesh.x[a]) * (mesh.x[towards] - mesh.x[point])
    along += (mesh.y[b] - mesh.y[a]) * (mesh.y[towards] - mesh.y[point])
    end = b if along > 0 else a
    length = distance(mesh, point, end)
    place[0], place[1] = (mesh.x[end] - mesh.x[point]) / length, (mesh.y[end] - mesh.y[point]) / length
    return length


@called_from_loops
def _improve(work: Work, side: int) -> bool:
    """Add a point that mends a triangle with this shortest side, or on the edge in its way; tell whether it was."""
    mesh, room = work.mesh, work.room
    _find_place(work, side)
    new = mesh.total[0]
    mesh.x[new], mesh.y[new] = room.place[0], room.place[1]
    found = _walk(mesh, side // 3, new)
    if found == -1:
        return False
    if found < -1:
        return split_edge(work, -2 - found)
    found = add_point(work, found, new)
    return found == -1 or (found >= 0 and split_edge(work, found))


@called_from_loops
def _find_place(work: Work, side: int) -> None:
    """Find the centre of a triangle's circle, or a place closer to its shortest side that is far enough."""
    mesh, place = work.mesh, work.room.place
    u, v, w = mesh.start[side], mesh.start[following(side)], mesh.start[before(side)]
    ux, uy = mesh.x[u] - mesh.x[w], mesh.y[u] - mesh.y[w]
    vx, vy = mesh.x[v] - mesh.x[w], mesh.y[v] - mesh.y[w]
    sine, cosine = ux * vy - uy * vx, ux * vx + uy * vy
    far = _FAR if cosine > 2 * _FAR * sine else cosine / (2 * sine)
    place[0] = (mesh.x[u] + mesh.x[v]) / 2 - far * (mesh.y[v] - mesh.y[u])
    place[1] = (mesh.y[u] + mesh.y[v]) / 2 + far * (mesh.x[v] - mesh.x[u])


@called_from_loops
def _walk(mesh: Grown, triangle: int, point: int) -> int:
    """Return the triangle that a point lies in, or -2 - the half-edge of the curve in its way; -1 if it is far off."""
    came = -1
    for _ in range(_LONGEST_WALK):
        out = -1
        for side in range(3 * triangle, 3 * triangle + 3):
            if side != came and out < 0 and not _is_left(mesh, side, point):
                out = side
        if out < 0:
            return triangle
        if mesh.piece[out] >= 0:
            return -2 - out
        came = mesh.beyond[out]
        triangle = came // 3
    return -1


@called_from_loops
def _is_left(mesh: Grown, side: int, point: int) -> bool:
    a, b = mesh.start[side], mesh.start[following(side)]
    along = (mesh.x[b] - mesh.x[a]) * (mesh.y[point] - mesh.y[a])
    return bool(along >= (mesh.y[b] - mesh.y[a]) * (mesh.x[point] - mesh.x[a]))
