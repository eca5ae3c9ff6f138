"""The strip of triangles between the two sides of a ribbon, which proves that it is an immersed disk or ring.

All vertices are on the boundary. If every triangle is positively oriented, the strip is immersed but perhaps at its
vertices; and if the angles of the triangles at a vertex make less than a full turn, there too.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.outline.ribbons.line import TightBendError
from plyfold.outline.ribbons.sides import Side
from plyfold.predicates import orient

__all__ = ["Strip", "strip_between"]


# So many steps before and after one whose triangle is not positive may change their order.
_MENDED = 60


class Strip(NamedTuple):
    """The triangles between the sides of a ribbon, with the surface on their left.

    Parameters
    ----------
    loops : tuple of (n, 2) float
        The right side forward and back along the left one; or each by itself, if the line is closed.
    faces : (t, 3) int
        Triangles in their order along the line, counter-clockwise; points are counted loop after loop. The last two
        corners of each, on the right and on the left, are two of the next one.
    on_left : (t,) bool
        On which side each triangle has its edge of the outline.
    places : (points, 2) float
        Where along the line each point is: from and to.
    """

    loops: tuple[Floats, ...]
    faces: Ints
    on_left: Bools
    places: Floats


class _Steps(NamedTuple):
    """One entry for each step along one of the sides, which makes a triangle: to which point, from which, and opposite.

    Points of the left side are counted first, then those of the right one.
    """

    on_left: Bools
    end: Ints
    start: Ints
    opposite: Ints

    @property
    def triangles(self) -> Ints:
        """The triangle of each step, counter-clockwise."""
        middle = np.where(self.on_left, self.opposite, self.end)
        return np.stack([self.start, middle, np.where(self.on_left, self.end, self.opposite)], axis=1)


def strip_between(left: Side, right: Side, closed: bool) -> Strip:
    """Return the strip between two sides.

    Raises
    ------
    TightBendError
        If it is not immersed.

    Notes
    -----
    Linear in the number of points. Sides advance by their places along the line; where that makes a triangle that is
    not positive, other orders are tried nearby.
    """
    left, right = (_without_repeats(side, closed) for side in (left, right))
    points = np.concatenate([left.points, right.points])
    place = np.concatenate([left.low, right.low])
    n, m = len(left.points), len(right.points)
    on_left = _by_places(left, right, closed)
    folded = _folded(points, _steps(on_left, n, m, closed))
    for step in folded.tolist():
        _mend(on_left, step, points, n, closed)
    steps = _steps(on_left, n, m, closed)
    if len(folded) and len(still := _folded(points, steps)):
        raise TightBendError(float(place[steps.end[still[0]]]))
    full = _first_full_turn(points, n, steps, closed)
    if full is not None:
        raise TightBendError(float(place[full]))
    return _numbered(left, right, steps, closed)


def _without_repeats(side: Side, closed: bool) -> Side:
    """Return a side without points that rounding has made equal to the one before."""
    fresh = np.append(True, (side.points[1:] != side.points[:-1]).any(axis=1))
    if closed and len(fresh) > 1:
        fresh[0] = (side.points[0] != side.points[-1]).any()
    first = np.flatnonzero(fresh)
    last = np.append(first[1:], len(fresh)) - 1
    return Side(side.points[first], side.low[first], side.high[last], side.gap[first])


def _by_places(left: Side, right: Side, closed: bool) -> Bools:
    """Return for each step whether it is along the left side, in the order of the places that they lead to."""
    skipped = 0 if closed else 1  # the strip begins at the first points of both sides
    place = np.concatenate([np.maximum.accumulate(side.low)[skipped:] for side in (left, right)])
    return np.asarray(np.argsort(place, kind="stable") < len(left.points) - skipped)


def _steps(on_left: Bools, n: int, m: int, closed: bool) -> _Steps:
    """Return the steps between n points on the left and m points on the right."""
    skipped = 0 if closed else 1
    left, right = np.cumsum(on_left) - 1 + skipped, np.cumsum(~on_left) - 1 + skipped
    end, opposite = np.where(on_left, left, n + right), np.where(on_left, n + right % m, left % n)
    start = np.where(on_left, (left - 1) % n, n + (right - 1) % m)
    return _Steps(on_left, end, start, opposite)


def _folded(points: Floats, steps: _Steps) -> Ints:
    """Return the steps whose triangles are not positive."""
    return np.flatnonzero(orient(*points[steps.triangles].transpose(1, 0, 2)) <= 0)


def _mend(on_left: Bools, step: int, points: Floats, n: int, closed: bool) -> None:
    """Change the order of the steps around one, so that all of their triangles are positive, if there is such an order.

    Of a closed strip the places next to where it was opened stay as they are.
    """
    first, stop = max(step - _MENDED, 0), min(step + _MENDED + 1, len(on_left))
    skipped = 0 if closed else 1
    left, right = int(on_left[:first].sum()), first - int(on_left[:first].sum())
    ahead = int(on_left[first:stop].sum())
    if closed and (left == 0 or right == 0):
        return
    at = left - 1 + skipped
    lefts = points[at : at + ahead + 1]
    at = n + right - 1 + skipped
    rights = points[at : at + stop - first - ahead + 1]
    order = _positive_order(lefts, rights)
    if order is not None:
        on_left[first:stop] = order


def _positive_order(left: Floats, right: Floats) -> Bools | None:
    """Return an order of the steps between a few points on both sides whose triangles are all positive, or None.

    The end is reached from its back: a pair of points is good if a step from it leads to a good pair.
    """
    n, m = len(left), len(right)
    to_left = orient(left[:-1, None], right[None], left[1:, None]) > 0
    to_right = orient(right[None, :-1], right[None, 1:], left[:, None]) > 0
    good = np.zeros((n + 1, m + 1), dtype=bool)
    good[n - 1, m - 1] = True
    for i in range(n - 1, -1, -1):
        for j in range(m - 1, -1, -1):
            by_left = i < n - 1 and to_left[i, j] and good[i + 1, j]
            by_right = j < m - 1 and to_right[i, j] and good[i, j + 1]
            good[i, j] |= by_left or by_right
    if not good[0, 0]:
        return None
    order, i, j = [], 0, 0
    while (i, j) != (n - 1, m - 1):
        order.append(i < n - 1 and bool(to_left[i, j] and good[i + 1, j]))
        i, j = (i + 1, j) if order[-1] else (i, j + 1)
    return np.array(order)


def _first_full_turn(points: Floats, n_left: int, steps: _Steps, closed: bool) -> int | None:
    """Return the first point round which the triangles make a full turn or more, if there is one.

    From one edge at the point to the next it is less than half a turn. So from the first edge on, the others are first
    on one side of its line, and then on the other; once there, they must not come back to the line.
    """
    point, ray = _fans(steps, closed)
    begins = np.append(True, point[1:] != point[:-1])
    begin = np.flatnonzero(begins)[np.cumsum(begins) - 1]
    # Edges go round points of the left side counter-clockwise, and round the others clockwise.
    side = np.where(point < n_left, 1, -1) * orient(points[point], points[ray[begin]], points[ray])
    beyond = (side <= 0) & ~begins
    before = np.cumsum(beyond) - beyond
    full = np.flatnonzero((side >= 0) & ~begins & (before > before[begin]))
    return int(point[full[0]]) if len(full) else None


def _fans(steps: _Steps, closed: bool) -> tuple[Ints, Ints]:
    """Return the edges at each point in their order round it: the point, and where the edge ends.

    The step along its own side reaches a point; later ones add edges to it, the last one along its own side again.
    """
    count = np.arange(len(steps.end))
    point = np.concatenate([steps.end, steps.end, steps.opposite, steps.start])
    ray = np.concatenate([steps.start, steps.opposite, steps.end, steps.end])
    step, rank = np.tile(count, 4), np.repeat([0, 1, 2, 2], len(count))
    if not closed:  # the edge that the strip begins with
        first = [steps.start[0], steps.opposite[0]]
        point, ray = np.append(point, first), np.append(ray, first[::-1])
        step, rank = np.append(step, [0, 0]), np.append(rank, [0, 0])
    reached = np.zeros(int(point.max()) + 1, dtype=np.int64)
    reached[steps.end] = count
    since = (step - reached[point]) % len(count) if closed else step
    order = np.lexsort([rank, since, point])
    return point[order], ray[order]


def _numbered(left: Side, right: Side, steps: _Steps, closed: bool) -> Strip:
    """Return the strip with its points in their order along its boundary."""
    n, m = len(left.points), len(right.points)
    loops = [right.points, left.points[::-1]]
    places = [np.column_stack([side.low, side.high]) for side in (right, left)]
    number = np.concatenate([m + np.arange(n)[::-1], np.arange(m)])
    whole = tuple(loops) if closed else (np.concatenate(loops),)
    return Strip(whole, number[steps.triangles], steps.on_left, np.concatenate([places[0], places[1][::-1]]))
