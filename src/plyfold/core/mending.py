"""Points are added to triangles with sharp angles, one by one. See `mesh.mend`.

The triangles that see a new point in their circles make way for it: they leave a cavity, and new triangles stand on the
edges around, with the point as their tip. Edges of the curve are never crossed; on one of them, a point has a cavity on
either side.
"""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer, WholeBuffer, real_room, whole_room
from plyfold.core.pauses import pause
from plyfold.core.sides import distance, next_side, previous_side
from plyfold.core.turns import ExactPoints, turn

__all__ = ["EdgedMesh", "Mending", "is_to_mend", "mend"]

# What a point is on instead of a piece, see `mesh.mend`: none, or it is an end of pieces.
_FREE = -1
_GIVEN = -2

# The sine of 25°.
_SINE = 0.42261826174069944
# A point so far from the shortest side, by its length, makes an angle a little larger: 0.475 · cot 12.5°.
_FAR = 2.142586539239477
# Two edges of the curve make a strip if they are side by side for so many times their distance.
_THIN = 4.0
_LONGEST_WALK = 1000
# After so many triangles there is a pause.
_AT_A_TIME = 4096


class EdgedMesh:
    """Triangles with the curve among their edges, in the unit square; there may be room for more of them.

    ``places`` are the coordinates, point after point. Each half-edge has its ``start`` and what is ``beyond``, −1 where
    there is no triangle; ``piece`` is the piece of the outline that it is part of, −1 if none. Points are ``on`` a
    piece, or free, or given. Triangles lie in a ``cell``.
    """

    def __init__(
        self,
        n_points: int,
        n_triangles: int,
        places: RealBuffer,
        on: WholeBuffer,
        start: WholeBuffer,
        beyond: WholeBuffer,
        piece: WholeBuffer,
        cell: WholeBuffer,
    ) -> None:
        self.n_points, self.n_triangles = n_points, n_triangles
        self.places, self.on, self.start, self.beyond, self.piece, self.cell = places, on, start, beyond, piece, cell
        self.points = ExactPoints(places)


class Mending:
    """A mesh, the points at both ends of each piece of the outline, and the shortest length to split; and notes.

    ``waiting`` is a ring of triangles to look at, ``waits`` tells which are in it. To add a point, the triangles in
    ``cavity`` (``inside`` tells which) are replaced; around them run edges, ``edge``, with their ends, what is beyond,
    and piece. ``spoke`` is the half-edge from the new point to each point around. In ``place`` is a place or a
    direction.
    """

    def __init__(self, mesh: EdgedMesh, first: WholeBuffer, last: WholeBuffer, finest: float) -> None:
        self.mesh, self.first, self.last, self.finest = mesh, first, last, finest
        self.place = real_room(2)
        self.ring = len(self.mesh.cell) + 2
        self.head = self.n_waiting = self.n_cavity = self.n_edges = 0
        self.room = whole_room(9 * self.ring + len(self.mesh.on))
        self.waiting, self.waits = self._row(0), self._row(1)
        self.cavity, self.inside = self._row(2), self._row(3)
        self.edge, self.edge_from, self.edge_to = self._row(4), self._row(5), self._row(6)
        self.edge_beyond, self.edge_piece = self._row(7), self._row(8)
        self.spoke = self.room[9 * self.ring :]

    def _row(self, number: int) -> WholeBuffer:
        return self.room[number * self.ring : (number + 1) * self.ring]


def is_to_mend(work: Mending, triangle: int) -> bool:
    """Tell whether a triangle has a sharp angle that can be mended."""
    return _side_to_mend(work, triangle) >= 0


def mend(work: Mending, sharp: WholeBuffer) -> bool:
    """Look at some triangles, and at those that take the place of others; tell whether there was room for all points.

    Parameters
    ----------
    work : Mending
    sharp : buffer of int
        Triangles.
    """
    mesh, looked = work.mesh, 0
    for place in range(len(sharp)):
        _wait(work, sharp[place])
    while work.n_waiting > 0 and mesh.n_points < len(mesh.on):
        looked += 1
        if looked % _AT_A_TIME == 0:
            pause()
        triangle = _next_waiting(work)
        side = _side_to_mend(work, triangle)
        if side >= 0 and _improve(work, side):
            _wait(work, triangle)
    return mesh.n_points < len(mesh.on)


def _next_waiting(work: Mending) -> int:
    triangle = work.waiting[work.head]
    work.head = (work.head + 1) % work.ring
    work.n_waiting -= 1
    work.waits[triangle] = 0
    return triangle


def _wait(work: Mending, triangle: int) -> None:
    """Put a triangle at the end of those that wait to be looked at."""
    if work.waits[triangle] == 0:
        work.waits[triangle] = 1
        work.waiting[(work.head + work.n_waiting) % work.ring] = triangle
        work.n_waiting += 1


def _side_to_mend(work: Mending, triangle: int) -> int:
    """Return the shortest side of a triangle if the angle opposite is bad and can be mended, or -1."""
    mesh, first = work.mesh, 3 * triangle
    a, b, c = mesh.start[first], mesh.start[first + 1], mesh.start[first + 2]
    ab, bc, ca = _distance(mesh, a, b), _distance(mesh, b, c), _distance(mesh, c, a)
    least = min(ab, bc, ca)
    if _cross(mesh, a, b, c) * least >= _SINE * ab * bc * ca:
        return -1
    side = first if ab == least else first + 1 if bc == least else first + 2
    return -1 if _is_left_alone(work, side) else side


def _cross(mesh: EdgedMesh, a: int, b: int, c: int) -> float:
    """Return the cross product of a → b and a → c."""
    at = 2 * a
    along = (mesh.places[2 * b] - mesh.places[at]) * (mesh.places[2 * c + 1] - mesh.places[at + 1])
    return along - (mesh.places[2 * b + 1] - mesh.places[at + 1]) * (mesh.places[2 * c] - mesh.places[at])


def _is_left_alone(work: Mending, side: int) -> bool:
    """Tell whether the shortest side of a bad triangle is across a corner of the curve, or across a strip."""
    mesh = work.mesh
    ahead = next_side(side)
    if mesh.piece[ahead] >= 0 and mesh.piece[previous_side(side)] >= 0:
        return True
    on_u, on_v = mesh.on[mesh.start[side]], mesh.on[mesh.start[ahead]]
    if mesh.piece[side] >= 0 or _FREE in (on_u, on_v) or (on_u == on_v and on_u >= 0):
        return False
    if on_u >= 0 and on_v >= 0 and _is_across_corner(work, mesh.start[side], mesh.start[ahead]):
        return True
    return _is_strip(work, side) or _is_strip(work, mesh.beyond[side])


def _is_across_corner(work: Mending, u: int, v: int) -> bool:
    """Tell whether two points are on two pieces that meet with less than 60°."""
    on_u, on_v = work.mesh.on[u], work.mesh.on[v]
    corner = work.first[on_u]
    if corner not in (work.first[on_v], work.last[on_v]):
        corner = work.last[on_u]
    if corner not in (work.first[on_v], work.last[on_v]):
        return False
    mesh = work.mesh
    u_x, u_y = mesh.places[2 * u] - mesh.places[2 * corner], mesh.places[2 * u + 1] - mesh.places[2 * corner + 1]
    v_x, v_y = mesh.places[2 * v] - mesh.places[2 * corner], mesh.places[2 * v + 1] - mesh.places[2 * corner + 1]
    return u_x * v_x + u_y * v_y > 0.5 * distance(u_x, u_y) * distance(v_x, v_y)


def _is_strip(work: Mending, side: int) -> bool:
    """Tell whether the curve runs side by side from both ends of a half-edge, on its left."""
    mesh = work.mesh
    u, v = mesh.start[side], mesh.start[next_side(side)]
    around = previous_side(side)
    while mesh.piece[around] < 0:
        around = previous_side(mesh.beyond[around])
    length = _look_along(work, u, mesh.start[around], mesh.piece[around])
    u_x, u_y = work.place[0], work.place[1]
    around = next_side(side)
    while mesh.piece[around] < 0:
        around = next_side(mesh.beyond[around])
    length = min(length, _look_along(work, v, mesh.start[next_side(around)], mesh.piece[around]))
    v_x, v_y = work.place[0], work.place[1]
    across_x, across_y = mesh.places[2 * v] - mesh.places[2 * u], mesh.places[2 * v + 1] - mesh.places[2 * u + 1]
    width = abs(u_x * across_y - u_y * across_x)
    if length < max(_THIN * width, distance(across_x, across_y)) or u_x * v_x + u_y * v_y <= 0:
        return False
    return abs(1 - _THIN * (u_x * v_y - u_y * v_x)) <= 2


def _look_along(work: Mending, point: int, towards: int, piece: int) -> float:
    """Find the direction of a piece of the curve from a point on it; return how far it goes."""
    mesh, a, b = work.mesh, work.first[piece], work.last[piece]
    along = (mesh.places[2 * b] - mesh.places[2 * a]) * (mesh.places[2 * towards] - mesh.places[2 * point])
    rises = mesh.places[2 * towards + 1] - mesh.places[2 * point + 1]
    along += (mesh.places[2 * b + 1] - mesh.places[2 * a + 1]) * rises
    end = b if along > 0 else a
    x, y = mesh.places[2 * end] - mesh.places[2 * point], mesh.places[2 * end + 1] - mesh.places[2 * point + 1]
    length = distance(x, y)
    work.place[0], work.place[1] = x / length, y / length
    return length


def _improve(work: Mending, side: int) -> bool:
    """Add a point that mends a triangle with this shortest side, or on the edge in its way; tell whether it was."""
    mesh = work.mesh
    _find_place(work, side)
    new = mesh.n_points
    mesh.places[2 * new], mesh.places[2 * new + 1] = work.place[0], work.place[1]
    found = _walk(mesh, side // 3, new)
    if found == -1:
        return False
    if found < -1:
        return _split_edge(work, -2 - found)
    found = _add_point(work, found, new)
    return found == -1 or (found >= 0 and _split_edge(work, found))


def _find_place(work: Mending, side: int) -> None:
    """Find the centre of a triangle's circle, or a place closer to its shortest side that is far enough."""
    mesh = work.mesh
    u, v, w = 2 * mesh.start[side], 2 * mesh.start[next_side(side)], 2 * mesh.start[previous_side(side)]
    u_x, u_y = mesh.places[u] - mesh.places[w], mesh.places[u + 1] - mesh.places[w + 1]
    v_x, v_y = mesh.places[v] - mesh.places[w], mesh.places[v + 1] - mesh.places[w + 1]
    sine, cosine = u_x * v_y - u_y * v_x, u_x * v_x + u_y * v_y
    far = _FAR if cosine > 2 * _FAR * sine else cosine / (2 * sine)
    work.place[0] = (mesh.places[u] + mesh.places[v]) / 2 - far * (mesh.places[v + 1] - mesh.places[u + 1])
    work.place[1] = (mesh.places[u + 1] + mesh.places[v + 1]) / 2 + far * (mesh.places[v] - mesh.places[u])


def _walk(mesh: EdgedMesh, triangle: int, point: int) -> int:
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


def _is_left(mesh: EdgedMesh, side: int, point: int) -> bool:
    a, b = 2 * mesh.start[side], 2 * mesh.start[next_side(side)]
    along = (mesh.places[b] - mesh.places[a]) * (mesh.places[2 * point + 1] - mesh.places[a + 1])
    return along >= (mesh.places[b + 1] - mesh.places[a + 1]) * (mesh.places[2 * point] - mesh.places[a])


def _distance(mesh: EdgedMesh, a: int, b: int) -> float:
    """Return the distance of two points."""
    return distance(mesh.places[2 * b] - mesh.places[2 * a], mesh.places[2 * b + 1] - mesh.places[2 * a + 1])


def _add_point(work: Mending, triangle: int, new: int) -> int:
    """Add a point that lies in a triangle and return -1; or return an edge of the curve that it is too near.

    Or -2, if rounding errors leave no room for its triangles.
    """
    near = _open_cavity(work, triangle, new, -1)
    if near >= 0:
        _close(work)
        return near
    if not _is_open(work, new, 0):
        return -2
    work.mesh.on[new] = _FREE
    work.mesh.n_points += 1
    _fill(work, new)
    return -1


def _open_cavity(work: Mending, triangle: int, point: int, base: int) -> int:
    """Note the triangles that see a point in their circles; return an edge of the curve that it is too near, or -1.

    The half-edge ``base`` is not among the edges around them: the point is on it.
    """
    work.n_cavity, work.n_edges = 1, 0
    work.cavity[0], work.inside[triangle] = triangle, 1
    near, looked = -1, 0
    while looked < work.n_cavity:
        first = 3 * work.cavity[looked]
        looked += 1
        for side in range(first, first + 3):
            if side != base and _note_edge(work, side, point) and base < 0 and _is_near(work.mesh, side, point):
                near = side
    _keep_edges(work)
    return near


def _note_edge(work: Mending, side: int, point: int) -> bool:
    """Note what lies beyond a side of the cavity if it is inside, or else the side; tell if the curve is there."""
    mesh = work.mesh
    is_curve = mesh.piece[side] >= 0
    if not is_curve:
        other = mesh.beyond[side] // 3
        if work.inside[other] != 0:
            return False
        if _is_in_circle(mesh, other, point):
            work.cavity[work.n_cavity], work.inside[other] = other, 1
            work.n_cavity += 1
            return False
    work.edge[work.n_edges] = side
    work.n_edges += 1
    return is_curve


def _keep_edges(work: Mending) -> None:
    """Note the edges around the cavity, without those between two triangles that were both found to be in it."""
    mesh, kept = work.mesh, 0
    for i in range(work.n_edges):
        side = work.edge[i]
        if mesh.piece[side] >= 0 or work.inside[mesh.beyond[side] // 3] == 0:
            work.edge_from[kept], work.edge_to[kept] = mesh.start[side], mesh.start[next_side(side)]
            work.edge_beyond[kept], work.edge_piece[kept] = mesh.beyond[side], mesh.piece[side]
            kept += 1
    work.n_edges = kept


def _is_in_circle(mesh: EdgedMesh, triangle: int, point: int) -> bool:
    first = 3 * triangle
    a, b, c = 2 * mesh.start[first], 2 * mesh.start[first + 1], 2 * mesh.start[first + 2]
    x, y = mesh.places[2 * point], mesh.places[2 * point + 1]
    ax, ay, bx, by = mesh.places[a] - x, mesh.places[a + 1] - y, mesh.places[b] - x, mesh.places[b + 1] - y
    cx, cy = mesh.places[c] - x, mesh.places[c + 1] - y
    left = (ax * ax + ay * ay) * (bx * cy - by * cx)
    return left + (bx * bx + by * by) * (cx * ay - cy * ax) + (cx * cx + cy * cy) * (ax * by - ay * bx) > 0


def _is_near(mesh: EdgedMesh, side: int, point: int) -> bool:
    """Tell whether a point is in the smallest circle around an edge."""
    a, b = 2 * mesh.start[side], 2 * mesh.start[next_side(side)]
    x, y = mesh.places[2 * point], mesh.places[2 * point + 1]
    return (mesh.places[a] - x) * (mesh.places[b] - x) + (mesh.places[a + 1] - y) * (mesh.places[b + 1] - y) < 0


def _close(work: Mending) -> None:
    for i in range(work.n_cavity):
        work.inside[work.cavity[i]] = 0


def _is_open(work: Mending, point: int, bases: int) -> bool:
    """Tell whether triangles from all edges around the cavity to the point fill it; if not, the cavity is closed."""
    fills = work.n_edges + bases == work.n_cavity + 2
    for i in range(work.n_edges):
        fills = fills and turn(work.mesh.points, work.edge_from[i], work.edge_to[i], point) > 0
    if not fills:
        _close(work)
    return fills


def _fill(work: Mending, point: int) -> int:
    """Put triangles from all edges around the cavity to a point; return the half-edge to it that is left, or -1."""
    _close(work)
    for i in range(work.n_edges):
        work.spoke[work.edge_to[i]] = -1
    for i in range(work.n_edges):
        triangle = work.cavity[i] if i < work.n_cavity else _one_more(work.mesh, work.mesh.cell[work.cavity[0]])
        _put(work, triangle, i, point)
        work.cavity[i] = triangle
        _wait(work, triangle)
    left = -1
    for i in range(work.n_edges):
        last = 3 * work.cavity[i] + 1
        other = work.spoke[work.edge_to[i]]
        if other < 0:
            left = last
        else:
            work.mesh.beyond[last], work.mesh.beyond[other] = other, last
    return left


def _one_more(mesh: EdgedMesh, cell: int) -> int:
    """Return a new triangle in a cell."""
    triangle = mesh.n_triangles
    mesh.cell[triangle] = cell
    mesh.n_triangles += 1
    return triangle


def _put(work: Mending, triangle: int, i: int, point: int) -> None:
    """Put a triangle on an edge around the cavity."""
    mesh, first, outer = work.mesh, 3 * triangle, work.edge_beyond[i]
    mesh.start[first], mesh.start[first + 1], mesh.start[first + 2] = work.edge_from[i], work.edge_to[i], point
    mesh.piece[first], mesh.piece[first + 1], mesh.piece[first + 2] = work.edge_piece[i], -1, -1
    mesh.beyond[first], mesh.beyond[first + 1], mesh.beyond[first + 2] = outer, -1, -1
    if outer >= 0:
        mesh.beyond[outer] = first
    work.spoke[work.edge_from[i]] = first + 2


def _split_edge(work: Mending, side: int) -> bool:
    """Split an edge of the curve, unless it is too short or does not leave triangles room; tell whether it was."""
    mesh = work.mesh
    other, piece, new = mesh.beyond[side], mesh.piece[side], mesh.n_points
    u, v = mesh.start[side], mesh.start[next_side(side)]
    if _distance(mesh, u, v) <= work.finest:
        return False
    _place_between(mesh, u, v, new)
    if other >= 0:
        _open_cavity(work, other // 3, new, other)
        if not _is_open(work, new, 1):
            return False
        _close(work)
    _open_cavity(work, side // 3, new, side)
    if not _is_open(work, new, 1):
        return False
    mesh.on[new] = piece
    mesh.n_points += 1
    to_new = _fill(work, new)
    from_new = work.spoke[v]
    mesh.piece[to_new], mesh.piece[from_new] = piece, piece
    if other >= 0:
        _open_cavity(work, other // 3, new, other)
        back_to_new = _fill(work, new)
        back = work.spoke[u]
        mesh.piece[back_to_new], mesh.piece[back] = piece, piece
        mesh.beyond[to_new], mesh.beyond[back] = back, to_new
        mesh.beyond[from_new], mesh.beyond[back_to_new] = back_to_new, from_new
    return True


def _place_between(mesh: EdgedMesh, u: int, v: int, new: int) -> None:
    """Place a point in the middle of an edge, or at a power of two from a given point: corners have equal sides."""
    share = 0.5
    if (mesh.on[u] == _GIVEN) != (mesh.on[v] == _GIVEN):
        length, power = _distance(mesh, u, v), 1.0
        while power > 0.67 * length:
            power /= 2
        share = power / length if mesh.on[u] == _GIVEN else 1 - power / length
    for axis in range(2):
        start = mesh.places[2 * u + axis]
        mesh.places[2 * new + axis] = start + share * (mesh.places[2 * v + axis] - start)
