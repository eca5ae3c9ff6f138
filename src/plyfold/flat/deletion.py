"""Take vertices out of an immersed disk of triangles, one at a time.

The triangles around an inner vertex are positive and turn round it once, so their outline is a star-shaped polygon,
and so is that around a vertex which lies flat on the boundary. Such a polygon can be cut into positive triangles on
its own corners, and the disk stays an immersed disk.
"""

from __future__ import annotations

from fractions import Fraction
from heapq import heapify, heappop, heappush
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.planar_map import Ints
from plyfold.errors import PrecisionError
from plyfold.predicates import Floats

__all__ = ["without_vertices"]

Triangle: TypeAlias = tuple[int, int, int]

# The rounding error of a cross product of differences is at most 3.4e-16 of the sizes of its two products, which are
# at most the product of the distances; three are added, with as much error again.
_ERROR = 4e-15
# Below this size a product may have underflowed, and the bound above does not hold.
_UNDERFLOW = 1e-290


def without_vertices(places: Floats, faces: Ints, extra: npt.NDArray[np.bool_]) -> Ints:
    """Delete vertices from an immersed disk and fill the gaps with triangles between the others.

    Parameters
    ----------
    places : (v, 2) float
    faces : (m, 3) int
        Counter-clockwise triangles that make an immersed disk.
    extra : (v,) bool
        The vertices to delete: inner ones, and such as lie on the boundary where it is straight.

    Returns
    -------
    (m', 3) int
        Counter-clockwise (exactly) triangles on the other vertices, numbered as before. Inside, they are the Delaunay
        triangles of the gap wherever the triangles around it were.

    Raises
    ------
    PrecisionError
        If a vertex on the boundary is so far from flat that its neighbours are in the way; it names the place.

    Notes
    -----
    The vertex with the fewest triangles goes first. O(m) in bulk, and a few microseconds for each deleted vertex.

    Examples
    --------
    >>> places = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 3.0), (1.0, 1.0)])
    >>> fan = np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
    >>> without_vertices(places, fan, np.arange(5) == 4).tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    touched = extra[faces].any(axis=1)
    disk = _Disk(_fans(faces[touched], extra), *places.T.tolist())
    filled: list[Triangle] = []
    waiting = [(len(fan), vertex) for vertex, fan in disk.fans.items()]
    heapify(waiting)
    while waiting:
        size, vertex = heappop(waiting)
        if len(disk.fans[vertex]) > size:
            heappush(waiting, (len(disk.fans[vertex]), vertex))
        else:
            filled += _delete(disk, vertex)
    return np.concatenate([faces[~touched], np.array(filled, dtype=np.int64).reshape(-1, 3)])


class _Disk(NamedTuple):
    """The vertices still to be deleted, each with its triangles, and where all vertices are.

    The triangles are a table that leads from each neighbour to the next one, counter-clockwise.
    """

    fans: dict[int, dict[int, int]]
    x: list[float]
    y: list[float]


def _fans(faces: Ints, extra: npt.NDArray[np.bool_]) -> dict[int, dict[int, int]]:
    fans: dict[int, dict[int, int]] = {vertex: {} for vertex in np.flatnonzero(extra).tolist()}
    for corner in range(3):
        here = faces[extra[faces[:, corner]]]
        around = (here[:, (corner + step) % 3].tolist() for step in range(3))
        for vertex, neighbour, following in zip(*around, strict=True):
            fans[vertex][neighbour] = following
    return fans


def _delete(disk: _Disk, vertex: int) -> list[Triangle]:
    """Replace the fan of a vertex; return the new triangles that have no extra vertex."""
    fans = disk.fans
    fan = fans.pop(vertex)
    for a, b in fan.items():
        if a in fans:
            del fans[a][b]
        if b in fans:
            del fans[b][vertex]
    finished = []
    for triangle in _gap_filled(disk, vertex, fan):
        a, b, c = triangle
        inner = True
        if a in fans:
            fans[a][b], inner = c, False
        if b in fans:
            fans[b][c], inner = a, False
        if c in fans:
            fans[c][a], inner = b, False
        if inner:
            finished.append(triangle)
    return finished


def _gap_filled(disk: _Disk, vertex: int, fan: dict[int, int]) -> list[Triangle]:
    """Return positive triangles that cover what the fan of a vertex has covered."""
    ends = fan.keys() - fan.values()
    here = ends.pop() if ends else next(iter(fan))
    ring = [here]
    for _ in range(1, len(fan)):
        here = fan[here]
        ring.append(here)
    if len(fan) > 2 and fan[here] == ring[0]:
        closed = True
    else:
        closed = False
        ring.append(fan[here])
    if len(ring) < 4:
        return [_positive(disk, vertex, (ring[0], ring[1], ring[2]))] if len(ring) == 3 else []
    return _ears_cut(disk, vertex, ring, closed)


class _Star(NamedTuple):
    """The neighbours of a vertex, seen from there, and their squared distances; ``error`` bounds that of a turn."""

    ring: list[int]
    x: list[float]
    y: list[float]
    square: list[float]
    error: float


def _ears_cut(disk: _Disk, vertex: int, ring: list[int], closed: bool) -> list[Triangle]:
    """Cut off one corner after another, in the order in which the circles around the corners enclose the vertex.

    That is how the Delaunay triangles of the gap follow each other [Dev02]_. What is left is seen from the vertex as
    a star all the time, or has it on its boundary.

    References
    ----------
    .. [Dev02] O. Devillers, "On deletion in Delaunay triangulations", International Journal of Computational
       Geometry and Applications 12, 2002.
    """
    star = _star(disk, vertex, ring)
    left = len(ring)
    before, after = [left - 1, *range(left - 1)], [*range(1, left), 0]
    corners = range(left) if closed else range(1, left - 1)
    ears = [ear for b in corners if (ear := _ear(disk, vertex, star, (before[b], b, after[b])))]
    heapify(ears)
    triangles = []
    a = 0
    while left > 3:
        if not ears:
            raise _in_the_way(disk, vertex)
        _, (first, b, c) = heappop(ears)
        if before[b] != first or after[b] != c:
            continue
        a = first
        triangles.append((ring[a], ring[b], ring[c]))
        after[a], before[c], after[b] = c, a, -1
        left -= 1
        for corner in (a, c) if left > 3 else ():
            if corner in corners and (ear := _ear(disk, vertex, star, (before[corner], corner, after[corner]))):
                heappush(ears, ear)
    triangles.append(_positive(disk, vertex, (ring[a], ring[after[a]], ring[before[a]])))
    return triangles


def _star(disk: _Disk, vertex: int, ring: list[int]) -> _Star:
    x, y = disk.x, disk.y
    x0, y0 = x[vertex], y[vertex]
    away_x, away_y = [x[v] - x0 for v in ring], [y[v] - y0 for v in ring]
    square = [u * u + v * v for u, v in zip(away_x, away_y, strict=True)]
    return _Star(ring, away_x, away_y, square, _ERROR * max(square) + _UNDERFLOW)


def _ear(disk: _Disk, vertex: int, star: _Star, corner: Triangle) -> tuple[float, Triangle] | None:
    """Return a corner that can be cut off, after how far its circle goes beyond the vertex; None if it cannot."""
    a, b, c = corner
    ring, x, y, square, error = star
    ax, ay, bx, by, cx, cy = x[a], y[a], x[b], y[b], x[c], y[c]
    ac = ax * cy - ay * cx
    if not ac > error and (ac < -error or _exact_turn(disk, vertex, ring[a], ring[c]) < 0):
        return None
    ab, bc = ax * by - ay * bx, bx * cy - by * cx
    turn = ab + bc - ac
    if not turn > error and (turn < -error or _exact_turn(disk, ring[a], ring[b], ring[c]) <= 0):
        return None
    circle = square[a] * bc - square[b] * ac + square[c] * ab
    return circle / turn if turn else 0.0, corner


def _positive(disk: _Disk, vertex: int, triangle: Triangle) -> Triangle:
    """Return the last triangle of a gap, checked."""
    _, x, y = disk
    a, b, c = triangle
    left, right = (x[b] - x[a]) * (y[c] - y[a]), (y[b] - y[a]) * (x[c] - x[a])
    if left - right > _ERROR * (abs(left) + abs(right)) + _UNDERFLOW or _exact_turn(disk, a, b, c) > 0:
        return triangle
    raise _in_the_way(disk, vertex)


def _exact_turn(disk: _Disk, a: int, b: int, c: int) -> int:
    """Return the sign of the turn a, b, c."""
    (ax, ay), (bx, by), (cx, cy) = ((Fraction(disk.x[v]), Fraction(disk.y[v])) for v in (a, b, c))
    turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (turn > 0) - (turn < 0)


def _in_the_way(disk: _Disk, vertex: int) -> PrecisionError:
    return PrecisionError(
        "strands are so close that rounding a crossing to double precision puts it on the wrong side of another point",
        where=[(disk.x[vertex], disk.y[vertex])],
        hint="move the strands apart there",
    )
