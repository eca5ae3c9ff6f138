"""Whether points make a closed polyline as they stand."""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer
from plyfold.core.signs import quick_sign

__all__ = ["LARGEST_COORDINATE", "TINY", "count_vertices", "is_tiny", "without_closing_point"]

LARGEST_COORDINATE = 1e150
"""Products of two coordinates up to this size stay inside the range of a double."""

TINY = 1e-120
"""Products of two larger sides are far from the smallest doubles."""

_LARGEST, _TINY = LARGEST_COORDINATE, TINY


def without_closing_point(points: RealBuffer) -> int:
    """Return how many points there are; a last one that repeats the first is not counted.

    Examples
    --------
    >>> from array import array
    >>> without_closing_point(array("d", [0, 0, 1, 0, 0, 1, 0, 0]))
    3
    """
    n = len(points) // 2
    if n > 1 and points[0] == points[2 * n - 2] and points[1] == points[2 * n - 1]:
        return n - 1
    return n


def count_vertices(points: RealBuffer) -> int:
    """Return how many vertices a closed polyline has; 0 where there is something to clean, to refuse or to look into.

    Each vertex is finite and not too large, neighbours differ, and not all are on one line.

    Examples
    --------
    >>> from array import array
    >>> count_vertices(array("d", [0, 0, 1, 0, 0, 1])), count_vertices(array("d", [0, 0, 1, 0, 1, 0, 0, 1]))
    (3, 0)
    """
    n = without_closing_point(points)
    if n < 3:
        return 0
    x, y = points[2 * n - 2], points[2 * n - 1]
    for point in range(n):
        next_x, next_y = points[2 * point], points[2 * point + 1]
        # Written so that NaN counts as too large.
        if not (abs(next_x) <= _LARGEST and abs(next_y) <= _LARGEST) or (next_x == x and next_y == y):
            return 0
        x, y = next_x, next_y
    return n if _has_corner(points, n) else 0


def _has_corner(points: RealBuffer, n: int) -> bool:
    """Tell whether a point is seen to be off the line through the first two; almost always the third is."""
    x, y, next_x, next_y = points[0], points[1], points[2], points[3]
    for point in range(2, n):
        side = quick_sign(x, y, next_x, next_y, x, y, points[2 * point], points[2 * point + 1])
        if abs(side) == 1:
            return True
    return False


def is_tiny(points: RealBuffer) -> bool:
    """Tell whether no coordinate is as large as :data:`TINY`.

    Examples
    --------
    >>> from array import array
    >>> is_tiny(array("d", [0, 0, 1, 0])), is_tiny(array("d", [0, 0, 1e-130, 0]))
    (False, True)
    """
    place = 0
    while place < len(points) and abs(points[place]) < _TINY:
        place += 1
    return place == len(points)
