"""Take vertices out of an immersed disk of triangles, one at a time.

The triangles around an inner vertex are positive and turn round it once, so their outline is a star-shaped polygon,
and so is that around a vertex which lies flat on the boundary. Such a polygon can be cut into positive triangles on
its own corners, and the disk stays an immersed disk.
"""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from math import inf
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.errors import PrecisionError

__all__ = ["turns_left", "without_vertices"]

Triangle: TypeAlias = tuple[int, int, int]
# A vertex seen from another one: x, y, squared distance, and its number.
_Seen: TypeAlias = tuple[float, float, float, int]

# The rounding error of a cross product of differences is at most 3.4e-16 of the sizes of its two products, which
# together are at most the product of the two distances, and that is at most half the sum of their squares. For a turn
# three are added, with as much error again.
_ERROR = 2e-15
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
    corners = np.concatenate([faces, faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]])
    vertex, neighbour, following = corners[extra[corners[:, 0]]].T.tolist()
    fans: dict[int, dict[int, int]] = {extra_vertex: {} for extra_vertex in np.flatnonzero(extra).tolist()}
    for here, one, other in zip(vertex, neighbour, following, strict=True):
        fans[here][one] = other
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
    closed = not ends
    here = next(iter(fan)) if closed else ends.pop()
    ring = [here]
    for _ in range(len(fan) - closed):
        here = fan[here]
        ring.append(here)
    if len(ring) == 3:
        return [_positive(disk, vertex, (ring[0], ring[1], ring[2]))]
    if len(ring) == 4:
        return _four_cut(disk, vertex, ring)
    return _ears_cut(disk, vertex, ring, closed) if len(ring) > 4 else []


def _four_cut(disk: _Disk, vertex: int, ring: list[int]) -> list[Triangle]:
    """Cut a polygon of four corners along its Delaunay diagonal, or the one inside; no bookkeeping is needed."""
    _, x, y = disk
    a, b, c, d = ring
    x0, y0 = x[d], y[d]
    ax, ay, bx, by, cx, cy = x[a] - x0, y[a] - y0, x[b] - x0, y[b] - y0, x[c] - x0, y[c] - y0
    ab, bc, ac = ax * by - ay * bx, bx * cy - by * cx, ax * cy - ay * cx
    square_a, square_b, square_c = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    error = _ERROR * (square_a + square_b + square_c) + _UNDERFLOW
    # The turns of the other triangles: ac is that of a, c, d; ab that of a, b, d; and bc that of b, c, d.
    sure_ac, sure_bd = ab + bc - ac > error and ac > error, ab > error and bc > error
    if sure_ac and not (sure_bd and square_a * bc - square_b * ac + square_c * ab > 0):
        return [(a, b, c), (a, c, d)]
    if sure_bd:
        return [(a, b, d), (b, c, d)]
    if _exact_turn(disk.x, disk.y, a, b, c) > 0 and _exact_turn(disk.x, disk.y, a, c, d) > 0:
        return [(a, b, c), (a, c, d)]
    return [_positive(disk, vertex, (a, b, d)), _positive(disk, vertex, (b, c, d))]


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
    ears = [(_depth(disk, vertex, star[b - 1], star[b], star[after[b]]), before[b], b, after[b]) for b in corners]
    heapify(ears)
    triangles = []
    while True:
        depth, a, b, c = heappop(ears) if ears else (inf, 0, 0, 0)
        if depth == inf:
            raise _in_the_way(disk, vertex)
        if before[b] != a or after[b] != c:
            continue
        triangles.append((ring[a], ring[b], ring[c]))
        after[a], before[c], after[b] = c, a, -1
        left -= 1
        if left == 3:
            return [*triangles, _positive(disk, vertex, (ring[before[a]], ring[a], ring[c]))]
        for corner in (a, c):
            if corner in corners:
                first, last = before[corner], after[corner]
                depth = _depth(disk, vertex, star[first], star[corner], star[last])
                heappush(ears, (depth, first, corner, last))


def _star(disk: _Disk, vertex: int, ring: list[int]) -> list[_Seen]:
    _, x, y = disk
    x0, y0 = x[vertex], y[vertex]
    return [(u := x[v] - x0, w := y[v] - y0, u * u + w * w, v) for v in ring]


def _depth(disk: _Disk, vertex: int, a: _Seen, b: _Seen, c: _Seen) -> float:
    """Return how far the circle around a corner goes beyond the vertex; infinity if it cannot be cut off."""
    (ax, ay, aa, i), (bx, by, bb, j), (cx, cy, cc, k) = a, b, c
    ac = ax * cy - ay * cx
    error = _ERROR * (aa + bb + cc) + _UNDERFLOW
    if not ac > error and (ac < -error or _exact_turn(disk.x, disk.y, vertex, i, k) < 0):
        return inf
    ab, bc = ax * by - ay * bx, bx * cy - by * cx
    turn = ab + bc - ac
    if not turn > error and (turn < -error or _exact_turn(disk.x, disk.y, i, j, k) <= 0):
        return inf
    depth = (aa * bc - bb * ac + cc * ab) / turn if turn else 0.0
    # Beyond the range of doubles any order will do.
    return depth if -inf < depth < inf else 0.0


def _positive(disk: _Disk, vertex: int, triangle: Triangle) -> Triangle:
    """Return the last triangle of a gap, checked."""
    _, x, y = disk
    if turns_left(x, y, *triangle):
        return triangle
    raise _in_the_way(disk, vertex)


def turns_left(x: list[float], y: list[float], a: int, b: int, c: int) -> bool:
    """Tell whether three of the points with given coordinates turn counter-clockwise, exactly."""
    left, right = (x[b] - x[a]) * (y[c] - y[a]), (y[b] - y[a]) * (x[c] - x[a])
    return left - right > _ERROR * (abs(left) + abs(right)) + _UNDERFLOW or _exact_turn(x, y, a, b, c) > 0


def _exact_turn(x: list[float], y: list[float], a: int, b: int, c: int) -> int:
    """Return the sign of the turn a, b, c, in integers: doubles are fractions over powers of two.

    Vertices over a crossing lie in line with neighbours, so this is called often, and class Fraction would be slow.
    """
    fractions = [place[v].as_integer_ratio() for v in (a, b, c) for place in (x, y)]
    common = max(below for _, below in fractions)
    ax, ay, bx, by, cx, cy = (above * (common // below) for above, below in fractions)
    turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (turn > 0) - (turn < 0)


def _in_the_way(disk: _Disk, vertex: int) -> PrecisionError:
    return PrecisionError(
        "strands are so close that rounding a crossing to double precision puts it on the wrong side of another point",
        where=[(disk.x[vertex], disk.y[vertex])],
        hint="move the strands apart there",
    )
