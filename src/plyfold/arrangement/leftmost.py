"""Which crossing of a drawing lies leftmost. It is compared exactly, and without fractions in almost all drawings."""

from __future__ import annotations

import numpy as np

from plyfold.arrays import Ints, Reals
from plyfold.predicates import crossing_bounds, exact_crossings

__all__ = ["leftmost_crossing"]


def leftmost_crossing(points: Reals, edge: Ints, other: Ints) -> int:
    """Return which of the places where edges of a closed polyline cross lies leftmost, and lowest of several.

    Parameters
    ----------
    points : (n, 2) float, or object
        Vertices, as doubles or as fractions; edge i runs from point i to point i + 1.
    edge, other : (k,) int
        The two edges of each crossing, k ≥ 1. No two crossings lie at one place.

    Returns
    -------
    int
        Exact. Cost: O(n + k), and fractions for crossings that are not told apart by bounds on their places.

    Examples
    --------
    >>> points = np.array([(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (1.0, 2.0), (1.0, -1.0), (3.0, -1.0), (3.0, 4.0)])
    >>> leftmost_crossing(points, np.array([5, 0, 0]), np.array([2, 3, 5]))
    1
    """
    near = _near_left(points[:, 0], edge, other)
    for axis in range(2):
        if len(near) > 1:
            first, second = edge[near], other[near]
            ends = points[np.array([first, first + 1, second, second + 1]) % len(points)]
            near = near[_least(ends, axis)]
    return int(near[0])


def _near_left(x: Reals, edge: Ints, other: Ints) -> Ints:
    """Return the crossings that may be leftmost, as far as the ends of their edges tell."""
    (left, right), (other_left, other_right) = _sides(x, edge), _sides(x, other)
    return np.flatnonzero(np.maximum(left, other_left) <= np.minimum(right, other_right).min())


def _sides(x: Reals, edge: Ints) -> tuple[Reals, Reals]:
    start, end = x[edge], x[(edge + 1) % len(x)]
    return np.minimum(start, end), np.maximum(start, end)


def _least(ends: Reals, axis: int) -> Ints:
    """Return the crossings whose coordinate is least, one or several; ``ends`` of their edges has shape (4, m, 2)."""
    least = np.arange(ends.shape[1])
    if ends.dtype != object:
        low, high = (bound[:, axis] for bound in crossing_bounds(*ends))
        least = np.flatnonzero(low <= high.min())
        if len(least) == 1 or (low[least] == high[least]).all():
            return least
    places = exact_crossings(ends[:, least], axis)
    first = min(places)
    return least[[place == first for place in places]]
