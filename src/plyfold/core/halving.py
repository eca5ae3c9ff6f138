"""Triangles halved towards some vertices: always across the longest side, so that no angle becomes small."""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer, WholeBuffer
from plyfold.core.sides import next_side

__all__ = ["HalvedMesh", "halve_towards"]

# On the other side is a triangle that must stay as it is.
_FIXED = -2


class HalvedMesh:
    """So many triangles and vertices, with room for more.

    Half-edge 3t + i starts at corner i of triangle t; ``twin`` is −1 along the boundary and −2 where the triangle on
    the other side must stay as it is. ``origin`` is the given triangle that each one is a part of. Vertices have
    coordinates ``x`` and ``y``, a ``target``, which is a vertex or −1, and the square of their ``way`` there, infinite
    if there is none. Each new vertex is the middle of an edge, whose ends, two for each, are written into ``ends``.
    """

    def __init__(
        self,
        triangles: int,
        vertices: int,
        corner: WholeBuffer,
        twin: WholeBuffer,
        origin: WholeBuffer,
        x: RealBuffer,
        y: RealBuffer,
        target: WholeBuffer,
        way: RealBuffer,
        ends: WholeBuffer,
    ) -> None:
        self.corner, self.twin, self.origin, self.ends = corner, twin, origin, ends
        self.x, self.y, self.target, self.way = x, y, target, way
        self.triangles, self.vertices, self.given = triangles, vertices, vertices


def halve_towards(mesh: HalvedMesh, finest: float, growth: float, excess: RealBuffer, most: int) -> int:
    """Halve triangles until no side is longer than the finest length, or than its way to a target times the growth.

    Parameters
    ----------
    mesh : HalvedMesh
    finest, growth : float
        Squares.
    excess : buffer of float
        Falling numbers, the last one 1: first the squares of all sides are made at most so many times as large as
        wanted, then at most the next number of times, and so on.
    most : int
        With so many triangles it ends; there is room for one more.

    Returns
    -------
    int
        How many of the numbers have been come down to.
    """
    for step in range(len(excess)):
        halved = True
        while halved:
            halved = False
            triangle = 0
            while triangle < mesh.triangles:
                while _is_too_long(mesh, triangle, finest, growth, excess[step]):
                    if mesh.triangles >= most:
                        return step
                    if not _halve_at(mesh, triangle):
                        break
                    halved = True
                triangle += 1
    return len(excess)


def _is_too_long(mesh: HalvedMesh, triangle: int, finest: float, growth: float, excess: float) -> bool:
    """Tell whether the longest side of a triangle is too long, by more than some excess."""
    first = 3 * triangle
    way = (mesh.way[mesh.corner[first]] + mesh.way[mesh.corner[first + 1]] + mesh.way[mesh.corner[first + 2]]) / 3
    return _length(mesh, _longest(mesh, triangle)) > excess * max(finest, growth * way)


def _halve_at(mesh: HalvedMesh, triangle: int) -> bool:
    """Halve an edge that is the longest one of both its triangles: from a triangle over ever longer edges.

    Return whether there is one, for the way may end at a triangle that must stay as it is.
    """
    side = _longest(mesh, triangle)
    while mesh.twin[side] >= 0:
        longer = _longest(mesh, mesh.twin[side] // 3)
        if _length(mesh, longer) <= _length(mesh, side):
            break
        side = longer
    if mesh.twin[side] == _FIXED:
        return False
    _halve(mesh, side)
    return True


def _halve(mesh: HalvedMesh, side: int) -> None:
    """Put a vertex in the middle of an edge, and join it to what is on both sides."""
    other, start, end, middle = mesh.twin[side], mesh.corner[side], mesh.corner[next_side(side)], mesh.vertices
    mesh.ends[2 * (middle - mesh.given)], mesh.ends[2 * (middle - mesh.given) + 1] = start, end
    mesh.x[middle] = mesh.x[start] / 2 + mesh.x[end] / 2
    mesh.y[middle] = mesh.y[start] / 2 + mesh.y[end] / 2
    target = mesh.target[start] if mesh.way[start] <= mesh.way[end] else mesh.target[end]
    mesh.target[middle] = target
    mesh.way[middle] = mesh.way[start] if target < 0 else _distance(mesh, middle, target)
    mesh.vertices += 1
    ahead = _split(mesh, side, middle)
    if other >= 0:
        behind = _split(mesh, other, middle)
        mesh.twin[side], mesh.twin[behind] = behind, side
        mesh.twin[ahead], mesh.twin[other] = other, ahead


def _split(mesh: HalvedMesh, side: int, middle: int) -> int:
    """Split the triangle on the left of a side at its middle; return the further half of the side."""
    ahead, added = next_side(side), 3 * mesh.triangles
    back, outer = next_side(ahead), mesh.twin[ahead]
    mesh.corner[added], mesh.corner[added + 1], mesh.corner[added + 2] = middle, mesh.corner[ahead], mesh.corner[back]
    mesh.twin[added], mesh.twin[added + 1], mesh.twin[added + 2] = -1, outer, ahead
    mesh.corner[ahead], mesh.twin[ahead] = middle, added + 2
    if outer >= 0:
        mesh.twin[outer] = added + 1
    mesh.origin[mesh.triangles] = mesh.origin[side // 3]
    mesh.triangles += 1
    return added


def _longest(mesh: HalvedMesh, triangle: int) -> int:
    """Return the longest side of a triangle, the first of several."""
    longest = 3 * triangle
    for side in range(longest + 1, longest + 3):
        if _length(mesh, side) > _length(mesh, longest):
            longest = side
    return longest


def _length(mesh: HalvedMesh, side: int) -> float:
    """Return the square of the length of a side."""
    return _distance(mesh, mesh.corner[side], mesh.corner[next_side(side)])


def _distance(mesh: HalvedMesh, start: int, end: int) -> float:
    """Return the square of the distance of two vertices."""
    x, y = mesh.x[end] - mesh.x[start], mesh.y[end] - mesh.y[start]
    return x * x + y * y
