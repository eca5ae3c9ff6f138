"""Self-overlapping polygons by the definition: can the polygon be cut into positive triangles on its own corners?

The dynamic program of Shor and Van Wyk over pairs of corners, O(n³), in integers. Polygons are lists of integer points
in general position, with the disk on the left.

A row of corners i, i + 1, …, j with the chord from j back to i is cut into positive triangles if one of them,
(i, k, j), leaves two shorter rows that are. If the polygon turns once, the angles of its n − 2 triangles add up to
those of the polygon, so none of the angles is a full turn too large, and the triangles are an immersed disk.
"""

import cmath
import math
from itertools import pairwise

Polygon = list[tuple[int, int]]


def turning_number(polygon: Polygon) -> int:
    """Exterior angles, added up."""
    steps = [complex(q[0] - p[0], q[1] - p[1]) for p, q in pairwise([*polygon, *polygon[:2]])]
    return round(sum(cmath.phase(after / before) for before, after in pairwise(steps)) / (2 * math.pi))


def turn(p: tuple[int, int], q: tuple[int, int], r: tuple[int, int]) -> int:
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def triangulation(polygon: Polygon) -> list[tuple[int, int, int]] | None:
    """Triangles on the corners that make an immersed disk bounded by the polygon, or None if there are none."""
    if turning_number(polygon) != 1:
        return None
    n = len(polygon)
    apex: dict[tuple[int, int], int | None] = {(i, i + 1): None for i in range(n - 1)}
    for length in range(2, n):
        for i in range(n - length):
            j = i + length
            for k in range(i + 1, j):
                if (i, k) in apex and (k, j) in apex and turn(polygon[i], polygon[k], polygon[j]) > 0:
                    apex[i, j] = k
                    break
    return list(_triangles(apex, 0, n - 1)) if (0, n - 1) in apex else None


def _triangles(apex: dict[tuple[int, int], int | None], i: int, j: int):
    k = apex[i, j]
    if k is not None:
        yield (i, k, j)
        yield from _triangles(apex, i, k)
        yield from _triangles(apex, k, j)
