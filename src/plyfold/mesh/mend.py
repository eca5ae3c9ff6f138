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
from typing import Any, NamedTuple

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops, run_loop
from plyfold.halfedges import before, following
from plyfold.predicates import Coordinates, turn

__all__ = ["FREE", "GIVEN", "Edged", "Limits", "mend_angles", "sharp_triangles"]

_COSINE, _SINE = float(np.cos(np.radians(25.0))), float(np.sin(np.radians(25.0)))
# A point so far from the shortest side, by its length, makes an angle a little larger than needed.
_FAR = 0.475 * sqrt((1 + _COSINE) / (1 - _COSINE))
# Two edges of the curve make a strip if they are side by side for so many times their distance.
_THIN = 4.0
_LONGEST_WALK = 1000
# A step is a few microseconds of plain Python; so long it takes to make lists of each triangle, too.
_STEPS_FOR_EACH = 30


# What a point is on instead of a piece: none, or it is an end of pieces.
FREE, GIVEN = -1, -2
_HEAD, _WAITING, _CAVITY, _EDGES = range(4)


class Edged(NamedTuple):
    """Triangles with the curve among their edges, in the unit square.

    ``start`` and ``beyond`` of each half-edge, -1 where there is no triangle; ``piece`` is the piece of the outline it
    is part of, -1 if none. Points are ``on`` a piece, or ``FREE``, or ``GIVEN``. Triangles lie in a ``cell``. The
    ``total`` is that of points, and that of triangles; there may be room for more.
    """

    x: Floats
    y: Floats
    on: Ints
    start: Ints
    beyond: Ints
    piece: Ints
    cell: Ints
    total: Ints


class _Pieces(NamedTuple):
    """The points at the ends of each piece of the outline, and the shortest length to split, as an array of one."""

    first: Ints
    last: Ints
    finest: Floats


class _Notes(NamedTuple):
    """Where notes are made.

    ``waiting`` is a ring of triangles to look at, ``waits`` tells which are in it. To add a point, the triangles in
    ``cavity`` (``inside`` tells which) are replaced; around them run edges with their ends, what is beyond, and piece.
    ``spoke`` is the half-edge from the new point to each point around. ``sizes`` are how many there are of each.
    """

    scratch: Floats
    place: Floats
    spoke: Ints
    sizes: Ints
    waiting: Ints
    waits: Ints
    cavity: Ints
    inside: Ints
    edge: Ints
    edge_from: Ints
    edge_to: Ints
    edge_beyond: Ints
    edge_piece: Ints


class _Work(NamedTuple):
    """All that a loop reads and writes."""

    pieces: _Pieces
    room: _Notes
    mesh: Edged


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
    more = (most, most, most, 6 * most, 6 * most, 6 * most, 2 * most, 0)
    grown = Edged(*(np.pad(column, (0, number)) for column, number in zip(mesh, more, strict=True)))
    pieces, room = _Pieces(*ends, np.array([limits.finest])), _room_for(sharp, len(grown.cell), len(grown.x))
    work = _Work(pieces, room, grown)
    if all(_side_to_mend(work, triangle) < 0 for triangle in sharp.tolist()):
        return mesh
    made = run_loop(_mend, _STEPS_FOR_EACH * len(sharp) + len(mesh.cell), (pieces, room), grown)
    points, triangles = made.total
    if points == len(grown.x):
        return None
    sizes = (points, points, points, 3 * triangles, 3 * triangles, 3 * triangles, triangles, 2)
    columns: list[Any] = [column[:size] for column, size in zip(made, sizes, strict=True)]
    return Edged(*columns)


def _room_for(sharp: Ints, triangles: int, points: int) -> _Notes:
    waiting, waits, *notes = np.zeros((9, triangles + 2), dtype=np.int64)
    waiting[: len(sharp)] = sharp
    waits[sharp] = 1
    sizes, spoke = np.array([0, len(sharp), 0, 0]), np.full(points, -1)
    return _Notes(np.zeros(12), np.zeros(2), spoke, sizes, waiting, waits, *notes)


def _mend(given: tuple[_Pieces, _Notes], mesh: Edged) -> int:
    """Look at the triangles that wait, and at those that take the place of others; return how many points there are."""
    pieces, room = given
    work = _Work(pieces, room, mesh)
    while room.sizes[_WAITING] > 0 and mesh.total[0] < len(mesh.x):
        triangle = _next_waiting(room)
        side = _side_to_mend(work, triangle)
        if side >= 0 and _improve(work, side):
            _wait(room, triangle)
    return int(mesh.total[0])


@called_from_loops
def _next_waiting(room: _Notes) -> int:
    triangle: int = room.waiting[room.sizes[_HEAD]]
    room.sizes[_HEAD] = (room.sizes[_HEAD] + 1) % len(room.waiting)
    room.sizes[_WAITING] -= 1
    room.waits[triangle] = 0
    return triangle


@called_from_loops
def _side_to_mend(work: _Work, triangle: int) -> int:
    """Return the shortest side of a triangle if the angle opposite is bad and can be mended, or -1."""
    mesh = work.mesh
    first = 3 * triangle
    a, b, c = mesh.start[first], mesh.start[first + 1], mesh.start[first + 2]
    ab, bc, ca = _distance(mesh, a, b), _distance(mesh, b, c), _distance(mesh, c, a)
    area = (mesh.x[b] - mesh.x[a]) * (mesh.y[c] - mesh.y[a]) - (mesh.y[b] - mesh.y[a]) * (mesh.x[c] - mesh.x[a])
    least = min(ab, bc, ca)
    if area * least >= _SINE * ab * bc * ca:
        return -1
    side: int = first if ab == least else (first + 1 if bc == least else first + 2)
    return -1 if _is_left_alone(work, side) else side


@called_from_loops
def _is_left_alone(work: _Work, side: int) -> bool:
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
def _is_across_corner(work: _Work, u: int, v: int) -> bool:
    """Tell whether two points are on two pieces that meet with less than 60°."""
    pieces, mesh = work.pieces, work.mesh
    for corner in (pieces.first[mesh.on[u]], pieces.last[mesh.on[u]]):
        if corner in (pieces.first[mesh.on[v]], pieces.last[mesh.on[v]]):
            ux, uy = mesh.x[u] - mesh.x[corner], mesh.y[u] - mesh.y[corner]
            vx, vy = mesh.x[v] - mesh.x[corner], mesh.y[v] - mesh.y[corner]
            return bool(ux * vx + uy * vy > 0.5 * hypot(ux, uy) * hypot(vx, vy))
    return False


@called_from_loops
def _is_strip(work: _Work, side: int) -> bool:
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
    if length < max(_THIN * width, _distance(mesh, u, v)) or ux * place[0] + uy * place[1] <= 0:
        return False
    return bool(abs(1 - _THIN * (ux * place[1] - uy * place[0])) <= 2)


@called_from_loops
def _look_along(work: _Work, point: int, towards: int, piece: int) -> float:
    """Find the direction of a piece of the curve from a point on it; return how far it goes."""
    mesh, place = work.mesh, work.room.place
    a, b = work.pieces.first[piece], work.pieces.last[piece]
    along = (mesh.x[b] - mesh.x[a]) * (mesh.x[towards] - mesh.x[point])
    along += (mesh.y[b] - mesh.y[a]) * (mesh.y[towards] - mesh.y[point])
    end = b if along > 0 else a
    length = _distance(mesh, point, end)
    place[0], place[1] = (mesh.x[end] - mesh.x[point]) / length, (mesh.y[end] - mesh.y[point]) / length
    return length


@called_from_loops
def _improve(work: _Work, side: int) -> bool:
    """Add a point that mends a triangle with this shortest side, or on the edge in its way; tell whether it was."""
    mesh, room = work.mesh, work.room
    _find_place(work, side)
    new = mesh.total[0]
    mesh.x[new], mesh.y[new] = room.place[0], room.place[1]
    found = _walk(mesh, side // 3, new)
    if found == -1:
        return False
    if found < -1:
        return _split_edge(work, -2 - found)
    found = _add_point(work, found, new)
    return found == -1 or (found >= 0 and _split_edge(work, found))


@called_from_loops
def _find_place(work: _Work, side: int) -> None:
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
def _walk(mesh: Edged, triangle: int, point: int) -> int:
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
def _is_left(mesh: Edged, side: int, point: int) -> bool:
    a, b = mesh.start[side], mesh.start[following(side)]
    along = (mesh.x[b] - mesh.x[a]) * (mesh.y[point] - mesh.y[a])
    return bool(along >= (mesh.y[b] - mesh.y[a]) * (mesh.x[point] - mesh.x[a]))


# ---- points are added one by one -------------------------------------------------------------------------------------
#
# The triangles that see a new point in their circles make way for it: they leave a cavity, and new triangles stand on
# the edges around, with the point as their tip. Edges of the curve are never crossed; on one of them, a point has a
# cavity on either side.


@called_from_loops
def _distance(mesh: Edged, a: int, b: int) -> float:
    """Return the distance of two points."""
    return hypot(mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a])


@called_from_loops
def _add_point(work: _Work, triangle: int, new: int) -> int:
    """Add a point that lies in a triangle and return -1; or return an edge of the curve that it is too near.

    Or -2, if rounding errors leave no room for its triangles.
    """
    near = _open_cavity(work, triangle, new, -1)
    if near >= 0:
        _close(work.room)
        return near
    if not _is_open(work, new, 0):
        return -2
    work.mesh.on[new] = FREE
    work.mesh.total[0] += 1
    _fill(work, new)
    return -1


@called_from_loops
def _open_cavity(work: _Work, triangle: int, point: int, base: int) -> int:
    """Note the triangles that see a point in their circles; return an edge of the curve that it is too near, or -1.

    The half-edge ``base`` is not among the edges around them: the point is on it.
    """
    mesh, room = work.mesh, work.room
    room.sizes[_CAVITY], room.sizes[_EDGES] = 1, 0
    room.cavity[0], room.inside[triangle] = triangle, 1
    near, looked = -1, 0
    while looked < room.sizes[_CAVITY]:
        first = 3 * room.cavity[looked]
        looked += 1
        for side in range(first, first + 3):
            other = mesh.beyond[side] // 3
            if side == base or (mesh.piece[side] < 0 and room.inside[other]):
                continue
            if mesh.piece[side] < 0 and _is_in_circle(mesh, other, point):
                room.cavity[room.sizes[_CAVITY]], room.inside[other] = other, 1
                room.sizes[_CAVITY] += 1
                continue
            if mesh.piece[side] >= 0 and base < 0 and _is_near(mesh, side, point):
                near = side
            room.edge[room.sizes[_EDGES]] = side
            room.sizes[_EDGES] += 1
    _keep_edges(work)
    return near


@called_from_loops
def _keep_edges(work: _Work) -> None:
    """Note the edges around the cavity, without those between two triangles that were both found to be in it."""
    mesh, room = work.mesh, work.room
    kept = 0
    for i in range(room.sizes[_EDGES]):
        side = room.edge[i]
        if mesh.piece[side] >= 0 or not room.inside[mesh.beyond[side] // 3]:
            room.edge_from[kept], room.edge_to[kept] = mesh.start[side], mesh.start[following(side)]
            room.edge_beyond[kept], room.edge_piece[kept] = mesh.beyond[side], mesh.piece[side]
            kept += 1
    room.sizes[_EDGES] = kept


@called_from_loops
def _is_in_circle(mesh: Edged, triangle: int, point: int) -> bool:
    x, y, first = mesh.x, mesh.y, 3 * triangle
    a, b, c = mesh.start[first], mesh.start[first + 1], mesh.start[first + 2]
    ax, ay, bx, by = x[a] - x[point], y[a] - y[point], x[b] - x[point], y[b] - y[point]
    cx, cy = x[c] - x[point], y[c] - y[point]
    left = (ax * ax + ay * ay) * (bx * cy - by * cx)
    return bool(left + (bx * bx + by * by) * (cx * ay - cy * ax) + (cx * cx + cy * cy) * (ax * by - ay * bx) > 0)


@called_from_loops
def _is_near(mesh: Edged, side: int, point: int) -> bool:
    """Tell whether a point is in the smallest circle around an edge."""
    a, b = mesh.start[side], mesh.start[following(side)]
    along = (mesh.x[a] - mesh.x[point]) * (mesh.x[b] - mesh.x[point])
    return bool(along + (mesh.y[a] - mesh.y[point]) * (mesh.y[b] - mesh.y[point]) < 0)


@called_from_loops
def _close(room: _Notes) -> None:
    for i in range(room.sizes[_CAVITY]):
        room.inside[room.cavity[i]] = 0


@called_from_loops
def _is_open(work: _Work, point: int, bases: int) -> bool:
    """Tell whether triangles from all edges around the cavity to the point fill it; if not, the cavity is closed."""
    mesh, room = work.mesh, work.room
    places = Coordinates(mesh.x, mesh.y, room.scratch)
    fills = room.sizes[_EDGES] + bases == room.sizes[_CAVITY] + 2
    for i in range(room.sizes[_EDGES]):
        fills = fills and turn(places, room.edge_from[i], room.edge_to[i], point) > 0
    if not fills:
        _close(room)
    return bool(fills)


@called_from_loops
def _fill(work: _Work, point: int) -> int:
    """Put triangles from all edges around the cavity to a point; return the half-edge to it that is left, or -1."""
    mesh, room = work.mesh, work.room
    _close(room)
    for i in range(room.sizes[_EDGES]):
        room.spoke[room.edge_to[i]] = -1
    for i in range(room.sizes[_EDGES]):
        if i < room.sizes[_CAVITY]:
            triangle = room.cavity[i]
        else:
            triangle = mesh.total[1]
            mesh.cell[triangle] = mesh.cell[room.cavity[0]]
            mesh.total[1] += 1
        _put(work, triangle, i, point)
        room.cavity[i] = triangle
        _wait(room, triangle)
    left = -1
    for i in range(room.sizes[_EDGES]):
        last = 3 * room.cavity[i] + 1
        other = room.spoke[room.edge_to[i]]
        if other < 0:
            left = last
        else:
            mesh.beyond[last], mesh.beyond[other] = other, last
    return left


@called_from_loops
def _put(work: _Work, triangle: int, i: int, point: int) -> None:
    """Put a triangle on an edge around the cavity."""
    mesh, room = work.mesh, work.room
    first, outer = 3 * triangle, room.edge_beyond[i]
    mesh.start[first], mesh.start[first + 1], mesh.start[first + 2] = room.edge_from[i], room.edge_to[i], point
    mesh.piece[first], mesh.piece[first + 1], mesh.piece[first + 2] = room.edge_piece[i], -1, -1
    mesh.beyond[first], mesh.beyond[first + 1], mesh.beyond[first + 2] = outer, -1, -1
    if outer >= 0:
        mesh.beyond[outer] = first
    room.spoke[room.edge_from[i]] = first + 2


@called_from_loops
def _split_edge(work: _Work, side: int) -> bool:
    """Split an edge of the curve, unless it is too short or does not leave triangles room; tell whether it was."""
    mesh, room = work.mesh, work.room
    other, piece, new = mesh.beyond[side], mesh.piece[side], mesh.total[0]
    u, v = mesh.start[side], mesh.start[following(side)]
    if _distance(mesh, u, v) <= work.pieces.finest[0]:
        return False
    _place_between(mesh, u, v, new)
    if other >= 0:
        _open_cavity(work, other // 3, new, other)
        if not _is_open(work, new, 1):
            return False
        _close(room)
    _open_cavity(work, side // 3, new, side)
    if not _is_open(work, new, 1):
        return False
    mesh.on[new] = piece
    mesh.total[0] += 1
    to_new = _fill(work, new)
    from_new = room.spoke[v]
    mesh.piece[to_new], mesh.piece[from_new] = piece, piece
    if other >= 0:
        _open_cavity(work, other // 3, new, other)
        back_to_new = _fill(work, new)
        back = room.spoke[u]
        mesh.piece[back_to_new], mesh.piece[back] = piece, piece
        mesh.beyond[to_new], mesh.beyond[back] = back, to_new
        mesh.beyond[from_new], mesh.beyond[back_to_new] = back_to_new, from_new
    return True


@called_from_loops
def _place_between(mesh: Edged, u: int, v: int, new: int) -> None:
    """Place a point in the middle of an edge, or at a power of two from a given point: corners have equal sides."""
    share = 0.5
    if (mesh.on[u] == GIVEN) != (mesh.on[v] == GIVEN):
        length = _distance(mesh, u, v)
        power = 1.0
        while power > 0.67 * length:
            power /= 2
        share = power / length if mesh.on[u] == GIVEN else 1 - power / length
    mesh.x[new] = mesh.x[u] + share * (mesh.x[v] - mesh.x[u])
    mesh.y[new] = mesh.y[u] + share * (mesh.y[v] - mesh.y[u])


@called_from_loops
def _wait(room: _Notes, triangle: int) -> None:
    """Put a triangle at the end of those that wait to be looked at."""
    if not room.waits[triangle]:
        room.waits[triangle] = 1
        room.waiting[(room.sizes[_HEAD] + room.sizes[_WAITING]) % len(room.waiting)] = triangle
        room.sizes[_WAITING] += 1
