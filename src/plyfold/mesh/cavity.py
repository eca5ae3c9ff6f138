"""Triangles with the curve among their edges, to which points are added one by one.

The triangles that see a new point in their circles make way for it: they leave a cavity, and new triangles stand on the
edges around, with the point as their tip. Edges of the curve are never crossed; on one of them, a point has a cavity on
either side.
"""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops
from plyfold.turns import Places, turn

__all__ = [
    "FREE",
    "GIVEN",
    "HEAD",
    "WAITING",
    "Edged",
    "Grown",
    "Pieces",
    "Room",
    "Work",
    "add_point",
    "before",
    "distance",
    "following",
    "split_edge",
    "wait",
]

# What a point is on instead of a piece: none, or it is an end of pieces.
FREE, GIVEN = -1, -2
HEAD, WAITING, _CAVITY, _EDGES = range(4)


class Edged(NamedTuple):
    """Triangles with the curve among their edges, in the unit square.

    ``start`` and ``beyond`` of each half-edge, -1 where there is no triangle; ``piece`` is the piece of the outline it
    is part of, -1 if none. Points are ``on`` a piece, or ``FREE``, or ``GIVEN``. Triangles lie in a ``cell``.
    """

    x: Floats
    y: Floats
    on: Ints
    start: Ints
    beyond: Ints
    piece: Ints
    cell: Ints


class Pieces(NamedTuple):
    """The points at the ends of each piece of the outline, and the shortest length to split, as an array of one."""

    first: Ints
    last: Ints
    finest: Floats


class Room(NamedTuple):
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


class Grown(NamedTuple):
    """The triangles with room for more, and how many points and triangles there are."""

    x: Floats
    y: Floats
    on: Ints
    start: Ints
    beyond: Ints
    piece: Ints
    cell: Ints
    total: Ints


class Work(NamedTuple):
    """All that a loop reads and writes."""

    pieces: Pieces
    room: Room
    mesh: Grown


@called_from_loops
def following(half_edge: int) -> int:
    """Return the next half-edge of the same triangle."""
    return half_edge - 2 if half_edge % 3 == 2 else half_edge + 1


@called_from_loops
def before(half_edge: int) -> int:
    """Return the half-edge of the same triangle that ends where this one starts."""
    return half_edge + 2 if half_edge % 3 == 0 else half_edge - 1


@called_from_loops
def distance(mesh: Grown, a: int, b: int) -> float:
    """Return the distance of two points."""
    return hypot(mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a])


@called_from_loops
def add_point(work: Work, triangle: int, new: int) -> int:
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
def _open_cavity(work: Work, triangle: int, point: int, base: int) -> int:
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
def _keep_edges(work: Work) -> None:
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
def _is_in_circle(mesh: Grown, triangle: int, point: int) -> bool:
    x, y, first = mesh.x, mesh.y, 3 * triangle
    a, b, c = mesh.start[first], mesh.start[first + 1], mesh.start[first + 2]
    ax, ay, bx, by = x[a] - x[point], y[a] - y[point], x[b] - x[point], y[b] - y[point]
    cx, cy = x[c] - x[point], y[c] - y[point]
    left = (ax * ax + ay * ay) * (bx * cy - by * cx)
    return bool(left + (bx * bx + by * by) * (cx * ay - cy * ax) + (cx * cx + cy * cy) * (ax * by - ay * bx) > 0)


@called_from_loops
def _is_near(mesh: Grown, side: int, point: int) -> bool:
    """Tell whether a point is in the smallest circle around an edge."""
    a, b = mesh.start[side], mesh.start[following(side)]
    along = (mesh.x[a] - mesh.x[point]) * (mesh.x[b] - mesh.x[point])
    return bool(along + (mesh.y[a] - mesh.y[point]) * (mesh.y[b] - mesh.y[point]) < 0)


@called_from_loops
def _close(room: Room) -> None:
    for i in range(room.sizes[_CAVITY]):
        room.inside[room.cavity[i]] = 0


@called_from_loops
def _is_open(work: Work, point: int, bases: int) -> bool:
    """Tell whether triangles from all edges around the cavity to the point fill it; if not, the cavity is closed."""
    mesh, room = work.mesh, work.room
    places = Places(mesh.x, mesh.y, room.scratch)
    fills = room.sizes[_EDGES] + bases == room.sizes[_CAVITY] + 2
    for i in range(room.sizes[_EDGES]):
        fills = fills and turn(places, room.edge_from[i], room.edge_to[i], point) > 0
    if not fills:
        _close(room)
    return bool(fills)


@called_from_loops
def _fill(work: Work, point: int) -> int:
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
        wait(room, triangle)
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
def _put(work: Work, triangle: int, i: int, point: int) -> None:
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
def split_edge(work: Work, side: int) -> bool:
    """Split an edge of the curve, unless it is too short or does not leave triangles room; tell whether it was."""
    mesh, room = work.mesh, work.room
    other, piece, new = mesh.beyond[side], mesh.piece[side], mesh.total[0]
    u, v = mesh.start[side], mesh.start[following(side)]
    if distance(mesh, u, v) <= work.pieces.finest[0]:
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
def _place_between(mesh: Grown, u: int, v: int, new: int) -> None:
    """Place a point in the middle of an edge, or at a power of two from a given point: corners have equal sides."""
    share = 0.5
    if (mesh.on[u] == GIVEN) != (mesh.on[v] == GIVEN):
        length = distance(mesh, u, v)
        power = 1.0
        while power > 0.67 * length:
            power /= 2
        share = power / length if mesh.on[u] == GIVEN else 1 - power / length
    mesh.x[new] = mesh.x[u] + share * (mesh.x[v] - mesh.x[u])
    mesh.y[new] = mesh.y[u] + share * (mesh.y[v] - mesh.y[u])


@called_from_loops
def wait(room: Room, triangle: int) -> None:
    """Put a triangle at the end of those that wait to be looked at."""
    if not room.waits[triangle]:
        room.waits[triangle] = 1
        room.waiting[(room.sizes[HEAD] + room.sizes[WAITING]) % len(room.waiting)] = triangle
        room.sizes[WAITING] += 1
