"""Triangles of a disk made rounder: cuts of it are opened, and its parts put together. See `flat.delaunay`."""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer, WholeBuffer, whole_room
from plyfold.core.pauses import pause
from plyfold.core.sides import distance, next_side, previous_side
from plyfold.core.turns import ExactPoints, turn

__all__ = ["Corners", "Triangles", "open_cuts", "wants_flip"]

_LEFT = 0
_RIGHT = 1

# Two opposite angles must add up to more than half a turn by this much, or rounding could flip an edge for ever.
_CLEARLY = 1e-9
# After so many cuts there is a pause.
_AT_A_TIME = 4096


class Corners:
    """The corners of triangles, for exact turns; and as ``unit``, by a power of two, at most 1 in size, for angles."""

    def __init__(self, points: ExactPoints, unit: RealBuffer) -> None:
        self.points, self.unit = points, unit


class Triangles:
    """Triangles; three half-edges each, numbered in order.

    ``start`` is the vertex at which a half-edge starts, ``beyond`` the half-edge on its other side, −1 where a cut or
    the boundary is: at first everywhere. There it has a ``name``, and ``named`` leads from names to half-edges.
    """

    def __init__(self, start: WholeBuffer, beyond: WholeBuffer) -> None:
        self.start, self.beyond = start, beyond
        size = len(self.start)
        self.room = whole_room(2 * size)
        self.name, self.named = self.room[:size], self.room[size:]
        for side in range(size):
            self.beyond[side], self.name[side], self.named[side] = -1, side, side


class Cut:
    """A cut that is opened, and what is written down about it.

    ``chains`` are two stacks of half-edges, each with the next one on top and each in one half of the buffer: those on
    the left, then those on the right, all seen from between the chains. ``sizes`` are how many each has. So many
    triangles, ``n_removed``, are ``removed``. On the ladder are ``n_steps`` edges of the chains: the first is its
    lowest rung, the last its highest, and on each of the others stands a triangle. Of each, ``side`` is its chain,
    ``corner`` its end, and ``outer`` and ``name`` are the half-edge beyond it and its name.
    """

    def __init__(self, corners: Corners, triangles: Triangles) -> None:
        self.corners, self.triangles = corners, triangles
        most = len(self.triangles.start) // 3 + 2
        self.n_removed = self.n_steps = 0
        self.room = whole_room(7 * most + 2)
        self.half = most
        self.chains, self.removed = self.room[: 2 * most], self.room[2 * most : 3 * most]
        self.side, self.corner = self.room[3 * most : 4 * most], self.room[4 * most : 5 * most]
        self.outer, self.name = self.room[5 * most : 6 * most], self.room[6 * most : 7 * most]
        self.sizes = self.room[7 * most :]


def open_cuts(corners: Corners, triangles: Triangles, one: WholeBuffer, other: WholeBuffer) -> int:
    """Open cuts one after the other.

    Parameters
    ----------
    corners : Corners
    triangles : Triangles
        They will be replaced by others.
    one, other : buffer of int
        The names of the half-edges on both sides of the cuts.

    Returns
    -------
    int
        How many triangles were replaced, each as often as that happened.
    """
    cut, replaced = Cut(corners, triangles), 0
    for place in range(len(one)):
        if place % _AT_A_TIME == _AT_A_TIME - 1:
            pause()
        replaced += _open(cut, triangles.named[one[place]], triangles.named[other[place]])
    return replaced


def _open(cut: Cut, one: int, other: int) -> int:
    """Open the cut between two half-edges; return how many triangles were replaced."""
    triangles = cut.triangles
    _glue(triangles, one, other, -1)
    cut.chains[0], cut.chains[cut.half] = other, one  # both begin with the cut, seen from beyond it
    cut.sizes[_LEFT] = cut.sizes[_RIGHT] = 1
    cut.n_removed = cut.n_steps = 0
    foot = triangles.start[one]
    if not _widen(cut, _LEFT, triangles.start[previous_side(other)]):
        return 0
    _remove(cut, _RIGHT, other)
    _widen_at_foot(cut)
    if not _climb(cut, foot):
        return 0
    _rebuild(cut, foot)
    return cut.n_removed


def _glue(triangles: Triangles, side: int, other: int, name: int) -> None:
    """Put a half-edge in its place: beside another one, or at the cut or boundary with a name."""
    triangles.beyond[side] = other
    triangles.name[side] = name
    if other >= 0:
        triangles.beyond[other] = side
    else:
        triangles.named[name] = side


def _next(cut: Cut, chain: int) -> int:
    """Return the next half-edge of a chain."""
    return cut.chains[chain * cut.half + cut.sizes[chain] - 1]


def _corner(cut: Cut, chain: int) -> int:
    """Return the next corner of a chain."""
    side = _next(cut, chain)
    return cut.triangles.start[side if chain == _LEFT else next_side(side)]


def _widen(cut: Cut, chain: int, witness: int) -> bool:
    """Remove the triangle beyond a chain's next edge if its circle contains a corner on the other side."""
    triangles = cut.triangles
    side = triangles.beyond[_next(cut, chain)]
    if side < 0:
        return False
    begin, end = triangles.start[side], triangles.start[next_side(side)]
    if turn(cut.corners.points, begin, witness, end) <= 0:
        return False
    if not wants_flip(cut.corners, begin, witness, end, triangles.start[previous_side(side)]):
        return False
    _remove(cut, chain, side)
    return True


def _remove(cut: Cut, chain: int, side: int) -> None:
    """Remove the triangle of a half-edge beyond a chain's next edge: its two other edges take the place of that."""
    top = chain * cut.half + cut.sizes[chain] - 1
    ahead, back = next_side(side), previous_side(side)
    cut.chains[top], cut.chains[top + 1] = ahead if chain == _LEFT else back, back if chain == _LEFT else ahead
    cut.sizes[chain] += 1
    cut.removed[cut.n_removed] = side // 3
    cut.n_removed += 1


def _widen_at_foot(cut: Cut) -> None:
    """Remove the triangles at the first end of the cut, left and right in turn, until the ladder can stand there."""
    while _widen(cut, _LEFT, _corner(cut, _RIGHT)) or _widen(cut, _RIGHT, _corner(cut, _LEFT)):
        pass


def _climb(cut: Cut, foot: int) -> bool:
    """Build the ladder, whose first rung is the next edge on the right; tell whether it reaches the end of the cut."""
    left, right = foot, _corner(cut, _RIGHT)
    _step(cut, _RIGHT, right)
    while cut.sizes[_LEFT] + cut.sizes[_RIGHT] > 1:
        while cut.sizes[_LEFT] > 0 and _widen(cut, _LEFT, right):
            pass
        while cut.sizes[_RIGHT] > 0 and _widen(cut, _RIGHT, left):
            pass
        chain = _next_chain(cut, left, right)
        if chain < 0:
            return False
        corner = _corner(cut, chain)
        _step(cut, chain, corner)
        if chain == _LEFT:
            left = corner
        else:
            right = corner
    last = _LEFT if cut.sizes[_LEFT] > 0 else _RIGHT
    _step(cut, last, _corner(cut, last))
    return True


def _next_chain(cut: Cut, left: int, right: int) -> int:
    """Return the chain on which the ladder steps up from a rung; −1 if there is no triangle to stand on."""
    corners = cut.corners
    points = corners.points
    on_left = _corner(cut, _LEFT) if cut.sizes[_LEFT] > 0 else right
    on_right = _corner(cut, _RIGHT) if cut.sizes[_RIGHT] > 0 else left
    if on_left == right or turn(points, left, right, on_left) <= 0:
        return _RIGHT if on_right != left and turn(points, left, right, on_right) > 0 else -1
    if on_right in (left, on_left) or turn(points, left, right, on_right) <= 0:
        return _LEFT
    if turn(points, right, on_left, on_right) >= 0:
        return _RIGHT
    return _RIGHT if wants_flip(corners, right, on_right, on_left, left) else _LEFT


def _step(cut: Cut, chain: int, corner: int) -> None:
    """Take a chain's next edge off it and on to the ladder."""
    step, side = cut.n_steps, _next(cut, chain)
    cut.side[step], cut.corner[step] = chain, corner
    cut.outer[step], cut.name[step] = cut.triangles.beyond[side], cut.triangles.name[side]
    cut.sizes[chain] -= 1
    cut.n_steps += 1


def _rebuild(cut: Cut, foot: int) -> None:
    """Put the triangles of the ladder where others were removed."""
    triangles, last = cut.triangles, cut.n_steps - 1
    left, right, rung, name = foot, cut.corner[0], cut.outer[0], cut.name[0]
    for step in range(1, last):
        first, corner = 3 * cut.removed[step - 1], cut.corner[step]
        triangles.start[first], triangles.start[first + 1], triangles.start[first + 2] = left, right, corner
        _glue(triangles, first, rung, name)
        if cut.side[step] == _LEFT:
            left, rung, rail = corner, first + 1, first + 2
        else:
            right, rung, rail = corner, first + 2, first + 1
        _glue(triangles, rail, cut.outer[step], cut.name[step])
    _glue(triangles, rung, cut.outer[last], cut.name[last])


def wants_flip(corners: Corners, u: int, b: int, v: int, a: int) -> bool:
    """Tell whether a quadrilateral u, b, v, a is convex, and its angles at a and b are more than half a turn.

    Examples
    --------
    >>> from array import array
    >>> from plyfold.core.turns import ExactPoints
    >>> kite = array("d", [0, 0, 0.5, -0.125, 1, 0, 0.5, 0.125])
    >>> wants_flip(Corners(ExactPoints(kite), kite), 0, 1, 2, 3)
    True
    """
    if _sine_of_both(corners.unit, u, b, v, a) > -_CLEARLY:
        return False
    return turn(corners.points, u, b, a) > 0 and turn(corners.points, b, v, a) > 0


def _sine_of_both(unit: RealBuffer, u: int, b: int, v: int, a: int) -> float:
    """Return the sine of the sum of the angles at a and at b."""
    p_x, p_y = unit[2 * v] - unit[2 * a], unit[2 * v + 1] - unit[2 * a + 1]
    q_x, q_y = unit[2 * u] - unit[2 * a], unit[2 * u + 1] - unit[2 * a + 1]
    r_x, r_y = unit[2 * u] - unit[2 * b], unit[2 * u + 1] - unit[2 * b + 1]
    s_x, s_y = unit[2 * v] - unit[2 * b], unit[2 * v + 1] - unit[2 * b + 1]
    size, other_size = distance(p_x, p_y) * distance(q_x, q_y), distance(r_x, r_y) * distance(s_x, s_y)
    size, other_size = 1.0 if size == 0.0 else size, 1.0 if other_size == 0.0 else other_size
    sine, other_sine = abs(p_x * q_y - p_y * q_x) / size, abs(r_x * s_y - r_y * s_x) / other_size
    return sine * ((r_x * s_x + r_y * s_y) / other_size) + (p_x * q_x + p_y * q_y) / size * other_sine
