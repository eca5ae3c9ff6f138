"""The roundest triangles on the corners of a disk: cuts of the disk are opened one by one, and its parts put together.

Flips alone take quadratic time where triangles are long: two rows of n points that face each other can be n² / 4 flips
away from good triangles. So, as in the construction of a planar Delaunay triangulation from its halves [GS85]_, an
edge that goes is replaced by all the triangles across it at once. Those on both sides whose circles contain a corner
from beyond are removed, which leaves two chains of edges from one end of the cut to the other; then a ladder with one
corner on each chain climbs up between them.

The order in which cuts are opened is random, so small parts come first: a triangle is far from open cuts on average.
The disk may overlap itself. That does not matter here: it is looked at across one cut at a time.

References
----------
.. [GS85] L. Guibas, J. Stolfi, "Primitives for the manipulation of general subdivisions and the computation of Voronoi
   diagrams", ACM Transactions on Graphics 4, 1985.
"""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops, run_loop
from plyfold.halfedges import GluedTriangles, before, flip, following
from plyfold.predicates import Coordinates, as_coordinates, turn

__all__ = ["delaunay_triangles", "flip_edges", "wants_flip"]


# The order of the cuts is random, and the same each time.
_SEED = 1
# As found with long ribbons, of a few microseconds each.
_STEPS_PER_CUT = 15


class _Cuts(NamedTuple):
    """The cuts in the order in which to open them: the names of the half-edges on both sides."""

    one: Ints
    other: Ints


class _Room(NamedTuple):
    """What is written down about one cut.

    ``chains`` are two stacks of half-edges, each with the next one on top and each in one half of the array: those on
    the left, then those on the right, all seen from between the chains. ``sizes`` are how many each has, how many
    triangles are ``removed``, and how many edges of the chains are on the ladder: the first is its lowest rung, the
    last its highest, and on each of the others stands a triangle. Of each, ``side`` is its chain, ``corner`` its end,
    and ``outer`` and ``name`` are the half-edge beyond it and its name.
    """

    chains: Ints
    sizes: Ints
    removed: Ints
    side: Ints
    corner: Ints
    outer: Ints
    name: Ints


class _Triangles(NamedTuple):
    """The triangles; three half-edges each, numbered in order.

    ``start`` is the vertex at which a half-edge starts, ``beyond`` the half-edge on its other side, −1 where a cut or
    the disk's boundary is. There it has a ``name``, and ``named`` leads from names to half-edges.
    """

    start: Ints
    beyond: Ints
    name: Ints
    named: Ints


class _Disk(NamedTuple):
    """Everything."""

    places: Coordinates
    room: _Room
    triangles: _Triangles


_LEFT, _RIGHT, _REMOVED, _LADDER = range(4)


def delaunay_triangles(points: Floats, triangles: GluedTriangles) -> GluedTriangles:
    """Replace triangles by others on the same corners: no circle round one contains a corner that is seen from it.

    Parameters
    ----------
    points : (n, 2) float
    triangles : GluedTriangles
        Counter-clockwise triangles that make a disk, or another surface, without inner vertices.

    Returns
    -------
    GluedTriangles
        Triangles of the same surface, counter-clockwise, exactly. Whether circles contain a corner is decided as far as
        rounding errors let it.

    Notes
    -----
    O(n log² n) on average over the order of the cuts, whatever the disk: while one of r cuts is still closed, hardly
    any edge crosses more than O(r log n) of those that were opened.

    Examples
    --------
    >>> flat_kite = np.array([(0.0, 0.0), (4.0, -1.0), (8.0, 0.0), (4.0, 1.0)])
    >>> halves = GluedTriangles(np.array([(0, 1, 2), (0, 2, 3)]), np.array([-1, -1, 3, 2, -1, -1]))
    >>> delaunay_triangles(flat_kite, halves).faces.tolist()
    [[2, 3, 1], [1, 3, 0]]
    """
    places, faces = as_coordinates(points), triangles.faces
    cuts = np.random.default_rng(_SEED).permutation(triangles.pairs)
    names = np.arange(faces.size)
    apart = _Triangles(faces.ravel().copy(), np.full(faces.size, -1), names, names.copy())
    chains = np.zeros(2 * len(faces) + 4, dtype=np.int64)
    room = _Room(chains, np.zeros(4, dtype=np.int64), *np.zeros((5, len(faces) + 2), dtype=np.int64))
    given = (places, _Cuts(*cuts.T.copy()), room)
    found = run_loop(_open_all, _STEPS_PER_CUT * len(cuts), given, apart)
    return GluedTriangles(found.start.reshape(-1, 3), found.beyond)


def _open_all(given: tuple[Coordinates, _Cuts, _Room], triangles: _Triangles) -> int:
    """Open the cuts; return how many."""
    places, cuts, room = given
    disk = _Disk(places, room, triangles)
    for cut in range(len(cuts.one)):
        one, other = triangles.named[cuts.one[cut]], triangles.named[cuts.other[cut]]
        _glue(triangles, one, other, -1)
        _begin(disk, one, other)
        foot = triangles.start[one]
        if _widen(disk, _LEFT, triangles.start[before(other)]):
            _remove(disk, _RIGHT, other)
            _widen_at_foot(disk)
            if _climb(disk, foot):
                _rebuild(disk, foot)
    return len(cuts.one)


@called_from_loops
def _glue(triangles: _Triangles, half_edge: int, other: int, name: int) -> None:
    """Put a half-edge in its place: beside another one, or at the cut or boundary with a name."""
    triangles.beyond[half_edge] = other
    triangles.name[half_edge] = name
    if other >= 0:
        triangles.beyond[other] = half_edge
    else:
        triangles.named[name] = half_edge


@called_from_loops
def _begin(disk: _Disk, one: int, other: int) -> None:
    """Begin both chains with the cut, seen from beyond it."""
    room = disk.room
    room.chains[0], room.chains[len(room.chains) // 2] = other, one
    room.sizes[_LEFT], room.sizes[_RIGHT], room.sizes[_REMOVED], room.sizes[_LADDER] = 1, 1, 0, 0


@called_from_loops
def _top(room: _Room, side: int) -> int:
    """Return the place of the next half-edge of a chain."""
    place: int = side * (len(room.chains) // 2) + room.sizes[side] - 1
    return place


@called_from_loops
def _corner(disk: _Disk, side: int) -> int:
    """Return the next corner of a chain."""
    half_edge = disk.room.chains[_top(disk.room, side)]
    corner: int = disk.triangles.start[half_edge if side == _LEFT else following(half_edge)]
    return corner


@called_from_loops
def _widen(disk: _Disk, side: int, witness: int) -> bool:
    """Remove the triangle beyond a chain's next edge if its circle contains a corner on the other side."""
    start = disk.triangles.start
    edge = disk.triangles.beyond[disk.room.chains[_top(disk.room, side)]]
    if edge < 0:
        return False
    begin, end, apex = start[edge], start[following(edge)], start[before(edge)]
    if turn(disk.places, begin, witness, end) <= 0 or not wants_flip(disk.places, (begin, witness, end, apex)):
        return False
    _remove(disk, side, edge)
    return True


@called_from_loops
def _remove(disk: _Disk, side: int, edge: int) -> None:
    """Remove the triangle of a half-edge beyond a chain's next edge: its two other edges take the place of that."""
    room, top = disk.room, _top(disk.room, side)
    later, sooner = (following(edge), before(edge)) if side == _LEFT else (before(edge), following(edge))
    room.chains[top], room.chains[top + 1] = later, sooner
    room.sizes[side] += 1
    room.removed[room.sizes[_REMOVED]] = edge // 3
    room.sizes[_REMOVED] += 1


@called_from_loops
def _widen_at_foot(disk: _Disk) -> None:
    """Remove the triangles at the first end of the cut, left and right in turn, until the ladder can stand there."""
    while _widen(disk, _LEFT, _corner(disk, _RIGHT)) or _widen(disk, _RIGHT, _corner(disk, _LEFT)):
        pass


@called_from_loops
def _climb(disk: _Disk, foot: int) -> bool:
    """Build the ladder, whose first rung is the next edge on the right; tell whether it reaches the end of the cut."""
    room = disk.room
    left, right = foot, _corner(disk, _RIGHT)
    _step(disk, _RIGHT, right)
    while room.sizes[_LEFT] + room.sizes[_RIGHT] > 1:
        if room.sizes[_LEFT] > 0:
            while _widen(disk, _LEFT, right):
                pass
        if room.sizes[_RIGHT] > 0:
            while _widen(disk, _RIGHT, left):
                pass
        side = _next_side(disk, left, right)
        if side < 0:
            return False
        corner = _corner(disk, side)
        _step(disk, side, corner)
        left, right = (corner, right) if side == _LEFT else (left, corner)
    last = _LEFT if room.sizes[_LEFT] > 0 else _RIGHT
    _step(disk, last, _corner(disk, last))
    return True


@called_from_loops
def _next_side(disk: _Disk, left: int, right: int) -> int:
    """Return the chain on which the ladder steps up from a rung; −1 if there is no triangle to stand on."""
    places, sizes = disk.places, disk.room.sizes
    on_left = _corner(disk, _LEFT) if sizes[_LEFT] > 0 else right
    on_right = _corner(disk, _RIGHT) if sizes[_RIGHT] > 0 else left
    if on_left == right or turn(places, left, right, on_left) <= 0:
        return _RIGHT if on_right != left and turn(places, left, right, on_right) > 0 else -1
    if on_right in (left, on_left) or turn(places, left, right, on_right) <= 0:
        return _LEFT
    if turn(places, right, on_left, on_right) >= 0:
        return _RIGHT
    return _RIGHT if wants_flip(places, (right, on_right, on_left, left)) else _LEFT


@called_from_loops
def _step(disk: _Disk, side: int, corner: int) -> None:
    """Take a chain's next edge off it and on to the ladder."""
    room, top, step = disk.room, _top(disk.room, side), disk.room.sizes[_LADDER]
    room.side[step], room.corner[step] = side, corner
    room.outer[step], room.name[step] = disk.triangles.beyond[room.chains[top]], disk.triangles.name[room.chains[top]]
    room.sizes[side] -= 1
    room.sizes[_LADDER] += 1


@called_from_loops
def _rebuild(disk: _Disk, foot: int) -> None:
    """Put the triangles of the ladder where others were removed."""
    triangles, room = disk.triangles, disk.room
    left, right, rung, name = foot, room.corner[0], room.outer[0], room.name[0]
    last = room.sizes[_LADDER] - 1
    for step in range(1, last):
        first, corner = 3 * room.removed[step - 1], room.corner[step]
        triangles.start[first], triangles.start[first + 1], triangles.start[first + 2] = left, right, corner
        _glue(triangles, first, rung, name)
        if room.side[step] == _LEFT:
            left, rung, rail = corner, first + 1, first + 2
        else:
            right, rung, rail = corner, first + 2, first + 1
        _glue(triangles, rail, room.outer[step], room.name[step])
    _glue(triangles, rung, room.outer[last], room.name[last])


# ---- better triangles on the same points -----------------------------------------------------------------------------
#
# The disk may overlap itself. That does not matter to a flip, which looks at two triangles on either side of an edge.

# Two opposite angles must add up to more than half a turn by this much, or rounding could flip an edge for ever.
_CLEARLY = 1e-9


def flip_edges(points: Floats, triangles: GluedTriangles) -> GluedTriangles:
    """Flip inner edges until, as a rule, no circle around a triangle contains the corner beyond one of its edges.

    Parameters
    ----------
    points : (n, 2) float
    triangles : GluedTriangles
        Counter-clockwise triangles that make a surface.

    Returns
    -------
    GluedTriangles
        Triangles of the same surface, counter-clockwise, exactly. Cost: O(m) if they are round already, O(m²) at worst.
    """
    places = Coordinates(*(numbers.tolist() for numbers in as_coordinates(points)))
    start, beyond = triangles.faces.ravel().tolist(), triangles.twin.tolist()
    waiting = triangles.pairs[:, 0].tolist()
    while waiting:
        side = waiting.pop()
        other = beyond[side]
        if other < 0:
            continue
        corners = start[side], start[before(other)], start[other], start[before(side)]
        if wants_flip(places, corners):
            flip(start, beyond, side)
            waiting += [side, before(side), other, before(other)]
    return GluedTriangles(np.array(start, dtype=np.int64).reshape(-1, 3), np.array(beyond, dtype=np.int64))


@called_from_loops
def wants_flip(places: Coordinates, corners: tuple[int, int, int, int]) -> bool:
    """Tell whether a quadrilateral u, b, v, a is convex, and its angles at a and b are more than half a turn."""
    u, b, v, a = corners
    sine_a, cosine_a = _angle(places, u, a, v)
    sine_b, cosine_b = _angle(places, v, b, u)
    if sine_a * cosine_b + cosine_a * sine_b > -_CLEARLY:
        return False
    return turn(places, u, b, a) > 0 and turn(places, b, v, a) > 0


@called_from_loops
def _angle(places: Coordinates, before: int, corner: int, after: int) -> tuple[float, float]:
    """Return sine and cosine of the angle at the corner of a counter-clockwise triangle."""
    x, y, _ = places
    px, py = x[after] - x[corner], y[after] - y[corner]
    qx, qy = x[before] - x[corner], y[before] - y[corner]
    size = hypot(px, py) * hypot(qx, qy) or 1.0
    return abs(px * qy - py * qx) / size, (px * qx + py * qy) / size
