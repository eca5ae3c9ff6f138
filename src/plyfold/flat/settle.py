"""Triangles of an outline that was moved apart, on the points as they were given: without those that have no area left.

Where strands touch, triangles of the moved outline become flat when their corners go back: all three on a line, or two
at one place. The surface has no width there. Each of these triangles goes in one of three ways:

* Two corners at one place. The side between them has become a point in which the surface touches itself, a *pinch*:
  both triangles on that side go, their other sides are put together, and the surface is cut at the point.
* One corner inside the longest side, and another triangle beyond that side: the side is flipped.
* One corner inside the longest side, and nothing beyond it. The corner touches the boundary from within: a pinch, too.
  The triangle goes, and the boundary runs along its two other sides. One that was on the boundary itself is now run
  there and back with nothing between, a *neck*, and drops out.

What is left does not depend on the order: it is the surface as the outline was given, cut where it has no width. This
ends. A triangle waits for the one beyond its longest side if that is flat as well, and has two corners at one place or
a longest side that reaches further: these get longer and longer. So a flip replaces one flat triangle by none, or two
of the same longest side by two of shorter ones. Everything else makes triangles fewer.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import PlyfoldError
from plyfold.flat.sweep import sweep_triangles
from plyfold.graphs import components
from plyfold.halfedges import GluedTriangles, before, ends_of, flip, following, glue
from plyfold.immersion.immersion import Immersion, Piece
from plyfold.mesh.refine import given_outline, is_moved
from plyfold.outline.curve import Outline
from plyfold.predicates import Coordinates, as_coordinates, orient, turn

__all__ = ["Settled", "settle", "settled_triangles", "what_is_left"]


class Settled(NamedTuple):
    """Triangles of a surface that was cut where it touches itself.

    Parameters
    ----------
    triangles : GluedTriangles
        Counter-clockwise, each with some area. Each corner of each piece of the surface has a number of its own, in
        their order along the outline.
    point : (corners,) int
        The point of the outline from which the boundary leaves each corner, or one that touches it there.
    inside : (corners,) bool
        The corners at which the boundary leaves from inside an edge.
    cuts : (c,) int
        The first point of the outline at each place where the surface was cut, in order.
    """

    triangles: GluedTriangles
    point: Ints
    inside: Bools
    cuts: Ints

    @property
    def faces(self) -> Ints:
        """The corners of each triangle, (m, 3)."""
        return self.triangles.faces


class _Surface(NamedTuple):
    """Triangles by their half-edges, which start at points of the outline.

    ``beyond`` is the half-edge on the other side; −1 − e on the boundary, along edge e of the outline. ``flat`` are
    triangles without area, ``gone`` those that are no more, and ``touching`` points at which the surface was cut.
    """

    places: Coordinates
    start: list[int]
    beyond: list[int]
    flat: set[int]
    gone: set[int]
    touching: set[int]


def settled_triangles(immersion: Immersion) -> Settled:
    """Return triangles of an immersed surface on the points of its outline as given, cut where it touches itself.

    Notes
    -----
    Signs and places are exact. As :func:`sweep_triangles`; where strands touch also O(n log n), some steps for each
    triangle without area, and at worst some for each pair of these on a line.
    """
    triangles, given = sweep_triangles(immersion), given_outline(immersion.arrangement)
    return settle(given, triangles) if is_moved(immersion.arrangement) else _as_it_is(triangles, len(given))


def _as_it_is(triangles: GluedTriangles, n: int) -> Settled:
    """Return triangles on n points of an outline that stay as they are."""
    return Settled(triangles, np.arange(n), np.zeros(n, dtype=bool), np.empty(0, dtype=np.int64))


def what_is_left(immersion: Immersion) -> tuple[tuple[tuple[float, float], ...], tuple[Piece, ...]]:
    """Return where an immersed surface is cut on the points as given, as it has no width there, and its pieces then.

    The places are those of points of the outline, in order along it: where two parts of the boundary have come
    together, in a pinch or along a neck. Pieces and their loops are in the order of their first corners.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> places, pieces = what_is_left(find_immersion([(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)]))
    >>> places, len(pieces)
    (((1.0, 1.0),), 2)
    """
    settled = settled_triangles(immersion)
    cuts = given_outline(immersion.arrangement).points[settled.cuts].tolist()
    return tuple((x, y) for x, y in cuts), _pieces(settled)


def _pieces(settled: Settled) -> tuple[Piece, ...]:
    """Count pieces of which each corner is on the boundary once: with b corners and t triangles, 2χ is b − t."""
    start, end = ends_of(settled.faces)
    on_boundary = settled.triangles.twin < 0
    loop_of = components(len(settled.point), start[on_boundary], end[on_boundary])
    piece_of = components(len(settled.point), start, end)
    twice_euler = np.bincount(piece_of) - np.bincount(piece_of[settled.faces[:, 0]])
    first_corner = np.unique(loop_of, return_index=True)[1]
    loops: list[list[int]] = [[] for _ in twice_euler]
    for loop, piece in enumerate(piece_of[first_corner].tolist()):
        loops[piece].append(loop)
    return tuple(map(Piece, map(tuple, loops), (twice_euler // 2).tolist()))


def settle(given: Outline, triangles: GluedTriangles) -> Settled:
    """Return the surface that triangles make when the points of their outline go back to where they were given.

    Parameters
    ----------
    given : Outline
    triangles : GluedTriangles
        n − 2χ triangles on its points, counter-clockwise or flat.

    Notes
    -----
    Signs and places are exact. O(n log n), and some steps for each pair of flat triangles on a line at worst.

    Examples
    --------
    Two triangles that meet in a point:

    >>> from plyfold.outline.curve import Curve
    >>> from plyfold.halfedges import twins_of
    >>> bow = Curve([(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)])
    >>> faces = np.array([(0, 1, 5), (1, 4, 5), (1, 2, 4), (2, 3, 4)])
    >>> settle(bow, GluedTriangles(faces, twins_of(faces))).faces.tolist()
    [[0, 4, 5], [2, 3, 1]]
    """
    sign = orient(*given.points[triangles.faces].swapaxes(0, 1))
    if (sign > 0).all():
        return _as_it_is(triangles, len(given))
    return _numbered(given, _without_flat_triangles(given.points, triangles, np.flatnonzero(sign == 0)))


def _without_flat_triangles(points: Floats, triangles: GluedTriangles, flat: Ints) -> _Surface:
    places = Coordinates(*(numbers.tolist() for numbers in as_coordinates(points)))
    start = triangles.faces.ravel()
    beyond = np.where(triangles.twin < 0, -1 - start, triangles.twin)
    surface = _Surface(places, start.tolist(), beyond.tolist(), set(flat.tolist()), set(), set())
    waiting = flat.tolist()
    while waiting:
        triangle = waiting.pop()
        if triangle in surface.flat:
            waiting += _settle_one(surface, triangle)
    return surface


def _settle_one(surface: _Surface, triangle: int) -> tuple[int, ...]:
    """Do away with a flat triangle; return those that have to be seen to, the last one first."""
    if (short := _side_without_length(surface, triangle)) is not None:
        _collapse(surface, short)
        return ()
    longest = _longest_side(surface, triangle)
    other = surface.beyond[longest]
    if other < 0:
        _open(surface, longest)
        return ()
    neighbour = other // 3
    if neighbour in surface.flat and (
        _side_without_length(surface, neighbour) is not None or _longest_side(surface, neighbour) != other
    ):
        return triangle, neighbour
    _flip(surface, longest)
    return triangle, neighbour


def _place(surface: _Surface, half_edge: int) -> tuple[float, float]:
    """Return where a half-edge starts."""
    point = surface.start[half_edge]
    return surface.places.x[point], surface.places.y[point]


def _side_without_length(surface: _Surface, triangle: int) -> int | None:
    """Return the first half-edge of a triangle that ends where it starts."""
    sides = range(3 * triangle, 3 * triangle + 3)
    return next((side for side in sides if _place(surface, side) == _place(surface, following(side))), None)


def _longest_side(surface: _Surface, triangle: int) -> int:
    """Return the half-edge of a flat triangle that does not touch the corner in its middle."""
    # On a line, places are in the order of their coordinates.
    _, middle, _ = sorted(range(3 * triangle, 3 * triangle + 3), key=lambda side: _place(surface, side))
    return following(middle)


def _remove(surface: _Surface, triangle: int) -> None:
    surface.gone.add(triangle)
    surface.flat.discard(triangle)


def _collapse(surface: _Surface, short: int) -> None:
    """Cut the surface at a side that has become a point; the triangles on both sides of it go."""
    beyond = surface.beyond
    for side in (short, beyond[short]):
        surface.touching.add(surface.start[side])
        one, other = beyond[following(side)], beyond[before(side)]
        if one >= 0:
            glue(beyond, one, other)
        elif other >= 0:
            glue(beyond, other, one)
        _remove(surface, side // 3)


def _open(surface: _Surface, longest: int) -> None:
    """Take away a triangle whose longest side is on the boundary: what is beyond its other sides comes to lie there."""
    beyond = surface.beyond
    for rest in (following(longest), before(longest)):
        if beyond[rest] >= 0:
            glue(beyond, beyond[rest], beyond[longest])
    surface.touching.add(surface.start[before(longest)])
    _remove(surface, longest // 3)


def _flip(surface: _Surface, side: int) -> None:
    """Replace the side between two triangles by the other diagonal of the two; see which of them are flat."""
    start, other = surface.start, surface.beyond[side]
    flip(start, surface.beyond, side)
    for triangle in (side // 3, other // 3):
        if turn(surface.places, *start[3 * triangle : 3 * triangle + 3]) > 0:
            surface.flat.discard(triangle)
        else:
            surface.flat.add(triangle)


# ---- corners ---------------------------------------------------------------------------------------------------------


def _numbered(given: Outline, surface: _Surface) -> Settled:
    """Give each corner of each piece a number of its own: that of the boundary's half-edge which starts there."""
    kept = np.setdiff1d(np.arange(len(surface.start) // 3), list(surface.gone))
    half_edges = (3 * kept[:, None] + np.arange(3)).ravel()
    number = np.empty(len(surface.start), dtype=np.int64)
    number[half_edges] = np.arange(len(half_edges))
    start, beyond = (np.array(values, dtype=np.int64)[half_edges] for values in (surface.start, surface.beyond))
    edge, twin = -1 - beyond, np.where(beyond < 0, -1, number[beyond])
    boundary = _along_outline(given, start, edge, np.flatnonzero(twin < 0))
    fan = _fans(twin)
    if not np.array_equal(np.sort(fan[boundary]), np.arange(fan.max(initial=-1) + 1)):
        raise PlyfoldError("internal check failed: every corner is on the boundary once", where=given.points[:1])
    corner = np.empty(len(boundary), dtype=np.int64)
    corner[fan[boundary]] = np.arange(len(boundary))
    start, edge = start[boundary], edge[boundary]
    inside = (given.points[start] != given.points[edge]).any(axis=1)
    triangles = GluedTriangles(corner[fan].reshape(-1, 3), twin)
    return Settled(triangles, np.where(inside, start, edge), inside, _first_points(given, surface.touching))


def _along_outline(given: Outline, start: Ints, edge: Ints, boundary: Ints) -> Ints:
    """Return half-edges on the boundary in the order in which the outline runs along them."""
    places = given.points[start[boundary]]
    begin, end = given.points[edge[boundary]], given.points[given.next_point[edge[boundary]]]
    rises = (begin[:, 0] < end[:, 0]) | ((begin[:, 0] == end[:, 0]) & (begin[:, 1] < end[:, 1]))
    x, y = np.where(rises, places.T, -places.T)
    return boundary[np.lexsort([y, x, edge[boundary]])]


def _fans(twin: Ints) -> Ints:
    """Return a number for each half-edge, the same for those that start at the same corner of the same piece."""
    half_edges = np.arange(len(twin))
    across = twin[before(half_edges)]
    inner = np.flatnonzero(across >= 0)
    return components(len(twin), inner, across[inner])


def _first_points(given: Outline, touching: set[int]) -> Ints:
    """Return the first point of the outline at each of the places where some points are."""
    place = np.unique(given.points, axis=0, return_inverse=True)[1].reshape(-1)
    first = np.unique(place, return_index=True)[1]
    return np.unique(first[place[list(touching)]])
