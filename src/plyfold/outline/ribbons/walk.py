"""The line walked through the strip of its ribbon: it must never leave it on the way from one cap to the other.

The strip's triangles make a row: each has one edge on a side of the ribbon, one towards the triangle before it and one
towards the triangle after it. So where a line is in the strip follows, triangle by triangle, from where it starts, also
where the strip lies over itself. A line that gets from the first edge of the row to the last one passes every triangle:
no part of the ribbon is without its line.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.outline.ribbons.line import TightBendError
from plyfold.outline.ribbons.strip import Strip
from plyfold.predicates import orient

__all__ = ["walk_through"]

# The triangle of a point that is not in the strip.
_OUTSIDE = np.iinfo(np.int64).min


class _Edges(NamedTuple):
    """Of some triangles of a row, the ends of their edges towards the triangles before and after, and on the side.

    Of the first two, the left end and the right one, seen by who walks along the row; of the side, in the order that
    has the triangle on its left.
    """

    back_left: Ints
    back_right: Ints
    front_left: Ints
    front_right: Ints
    side_start: Ints
    side_end: Ints


class _Row(NamedTuple):
    """A strip, and the line that is to be walked through it.

    Parameters
    ----------
    strip : Strip
    points : (n, 2) float
        Of the line. Those of a closed one begin and end in the middle of a segment.
    corners : (p, 2) float
        Of the strip's triangles.
    closed : bool
        Whether the last triangle is followed by the first one.
    last_tip : int or None
        The corner in which an open line ends; None in the middle of a flat cap.
    """

    strip: Strip
    points: Floats
    corners: Floats
    closed: bool
    last_tip: int | None

    def is_first(self, segments: Ints) -> Bools:
        """Tell which segments begin an open line."""
        return np.asarray((segments == 0) & (not self.closed))

    def is_last(self, segments: Ints) -> Bools:
        """Tell which segments end an open line."""
        return np.asarray((segments == len(self.points) - 2) & (not self.closed))

    def edges(self, triangles: Ints) -> _Edges:
        first, front_right, front_left = self.strip.faces[triangles % len(self.strip.faces)].T
        on_left = self.strip.on_left[triangles % len(self.strip.faces)]
        back_left, back_right = np.where(on_left, first, front_left), np.where(on_left, front_right, first)
        side_start, side_end = np.where(on_left, front_left, first), np.where(on_left, first, front_right)
        return _Edges(back_left, back_right, front_left, front_right, side_start, side_end)


def walk_through(strip: Strip, line: Floats, closed: bool, tips: tuple[Floats, Floats]) -> Ints:
    """Return the triangle that each point of a line is in, when the line is walked through the strip of its ribbon.

    Parameters
    ----------
    strip : Strip
    line : (n, 2) float
        Of a closed line the first point, which is on no side, is repeated.
    closed : bool
    tips : pair of (0 or 1, 2) float
        The tips of round caps before and after the line, which are corners of the strip. Otherwise an open line begins
        and ends in a corner or in the middle of a flat cap.

    Returns
    -------
    (n,) int
        Rows of ``strip.faces``, counted on beyond the first and the last one if the line is closed.

    Raises
    ------
    TightBendError
        If the line leaves the strip or touches its sides, or does not end where the strip ends.

    Notes
    -----
    Exact. All segments are walked at once, each from the triangle in which its start is looked for by its place along
    the line; those that do not start where the one before has ended are walked again. Linear in the number of edges of
    the row that segments pass, unless the line is far from its place along a long part of the strip.
    """
    before, after = tips
    corners, points = np.concatenate(strip.loops), np.concatenate([before, line, after])
    row = _Row(strip, points, corners, closed, None if closed else _last_tip(strip, corners, points[-1]))
    failed = _LostError(0)
    for first in _first_triangles(row):
        try:
            return _walked(row, first)[len(before) : len(before) + len(line)]
        except _LostError as error:
            failed = error
    raise TightBendError(failed.segment - len(before) + 0.5)


class _LostError(Exception):
    """A segment leaves the strip."""

    def __init__(self, segment: int) -> None:
        super().__init__(segment)
        self.segment = segment


def _last_tip(strip: Strip, corners: Floats, end: Floats) -> int | None:
    """Return the corner at the end of the strip that a line ends in, if there is one."""
    return next((corner for corner in strip.faces[-1, 1:].tolist() if np.array_equal(corners[corner], end)), None)


def _first_triangles(row: _Row) -> list[int]:
    """Return the triangles in which the line may start.

    Of an open line that is the first one, if it starts in a corner or passes the cap: in the middle of it, it is beside
    it by rounding. Of a closed one they are those that hold its first point, those next to the first one before others.
    """
    n = len(row.strip.faces)
    if row.closed:
        triangles = (np.arange(n) + n // 2) % n - n // 2
        around = triangles[_is_inside(row, triangles, np.broadcast_to(row.points[0], (n, 2)))]
        return sorted(around.tolist(), key=abs)
    edges = row.edges(np.zeros(1, dtype=np.int64))
    left, right = row.corners[edges.back_left], row.corners[edges.back_right]
    return [0] if _is_passed(row.points[:1], row.points[1:2], left, right, np.array([True]))[0] else []


def _walked(row: _Row, first: int) -> Ints:
    """Return the triangle of each point of the line, if that of the first point is known."""
    last = len(row.points) - 1
    start = _looked_for(row)
    start[0] = first
    end = _ends(row, np.arange(last), start)
    while True:
        wrong = np.append(False, start[1:] != end[:-1])
        known = int(wrong.argmax()) if wrong.any() else last
        lost = np.flatnonzero(end[:known] == _OUTSIDE)
        if len(lost):
            raise _LostError(int(lost[0]))
        if known == last:
            break
        start[1:] = end[:-1]
        end[wrong] = _ends(row, np.flatnonzero(wrong), start[wrong])
    if row.closed and end[-1] != first + len(row.strip.faces):
        raise _LostError(last - 1)
    return np.append(start, end[-1])


def _looked_for(row: _Row) -> Ints:
    """Return the triangle in which each segment would start if all lay straight across the strip."""
    edges = row.edges(np.arange(len(row.strip.faces)))
    reached = row.strip.places[np.where(row.strip.on_left, edges.front_left, edges.front_right), 0]
    place = np.arange(len(row.points) - 1)
    return np.minimum(np.searchsorted(np.maximum.accumulate(reached), place), len(reached) - 1)


def _is_passed(start: Floats, end: Floats, left: Floats, right: Floats, touched: Bools) -> Bools:
    """Tell which lines pass between two points; at these points only if they start there and may touch them."""
    passed = (orient(start, end, left) > 0) & (orient(start, end, right) < 0)
    begins = np.flatnonzero(touched)
    if len(begins):
        start, end, left, right = (values[begins] for values in (start, end, left, right))
        is_left = (orient(start, end, left) > 0) | (start == left).all(axis=1)
        passed[begins] = is_left & ((orient(start, end, right) < 0) | (start == right).all(axis=1))
    return np.asarray(passed)


def _ends(row: _Row, segments: Ints, start: Ints) -> Ints:
    """Return the triangles in which segments end that start in some others; ``_OUTSIDE`` of those that leave the strip.

    A segment passes the row in one direction, so this ends.
    """
    at = start.copy()
    walking = np.flatnonzero(at != _OUTSIDE)
    while len(walking):
        step = _steps(row, segments[walking], at[walking])
        walking, step = walking[step != 0], step[step != 0]
        at[walking] = np.where(np.abs(step) == 1, at[walking] + step, _OUTSIDE)
        walking = walking[np.abs(step) == 1]
    return at


def _steps(row: _Row, segments: Ints, triangles: Ints) -> Ints:
    """Return by how many triangles segments go on from some: ±1, 0 if they end there, 2 if they leave the strip."""
    edges, n = row.edges(triangles), len(row.strip.faces)
    forward = _goes_over(row, segments, edges.front_left, edges.front_right)
    backward = _goes_over(row, segments, edges.back_right, edges.back_left)
    is_last = row.is_last(segments)
    arrives = is_last & _is_end(row, triangles) & (forward | (row.last_tip is not None))
    rest = ~(forward | backward | is_last)
    arrives[rest] = _is_inside(row, triangles[rest], row.points[segments[rest] + 1])
    step = np.where(forward, 1, np.where(backward, -1, 2))
    beyond = (triangles + step < 0) | (triangles + step >= n)
    return np.where(arrives, 0, np.where(beyond & (not row.closed), 2, step))


def _goes_over(row: _Row, segments: Ints, left: Ints, right: Ints) -> Bools:
    """Tell which segments leave their triangle over an edge, from one corner on their left to another on their right.

    A line that ends in a flat cap does so by rounding alone: it must pass the cap.
    """
    start, end, is_first = row.points[segments], row.points[segments + 1], row.is_first(segments)
    left_end, right_end = row.corners[left], row.corners[right]
    goes = orient(right_end, left_end, end) < 0
    if row.last_tip is None:
        goes |= row.is_last(segments)
    goes[goes] = _is_passed(start[goes], end[goes], left_end[goes], right_end[goes], is_first[goes])
    return np.asarray(goes)


def _is_end(row: _Row, triangles: Ints) -> Bools:
    """Tell which triangles have the tip in which an open line ends, or are the one at the cap in which it does."""
    if row.last_tip is None:
        return np.asarray(triangles == len(row.strip.faces) - 1)
    return np.asarray((row.strip.faces[triangles % len(row.strip.faces)] == row.last_tip).any(axis=1))


def _is_inside(row: _Row, triangles: Ints, points: Floats) -> Bools:
    """Tell which points are in triangles, also between two of them, but not on the boundary of the strip."""
    edges = row.edges(triangles)
    back = orient(row.corners[edges.back_left], row.corners[edges.back_right], points)
    front = orient(row.corners[edges.front_right], row.corners[edges.front_left], points)
    side = orient(row.corners[edges.side_start], row.corners[edges.side_end], points)
    is_first, is_last = ((triangles == k) & (not row.closed) for k in (0, len(row.strip.faces) - 1))
    return np.asarray((side > 0) & (back >= is_first) & (front >= is_last))
