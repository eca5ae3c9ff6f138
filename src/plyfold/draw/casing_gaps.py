"""Gaps in a strand where another one passes over it, as in pictures of knots."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Floats
from plyfold.draw.placement import Frame

if TYPE_CHECKING:
    from plyfold.layering.layering import Layering

__all__ = ["cased_strands", "cut_strands", "strand_with_gaps"]

# At shallow crossings, gaps become longer, but not longer than so many times, nor than this part of their border.
_LONGEST_GAP = 4.0
_MOST_OF_BORDER = 1 / 3


def cased_strands(layering: Layering, frame: Frame, gap: float) -> Iterator[Floats]:
    """Yield the curve cut wherever it passes under itself: polylines with gaps at their ends.

    Parameters
    ----------
    layering : Layering
        Of a drawing.
    frame : Frame
        Places in the picture.
    gap : float
        How far from the middle of the upper strand the lower one ends, in the picture.

    Yields
    ------
    (m, 2) float
        In order along the curve. Without crossings, the closed curve, its first point repeated.

    Examples
    --------
    >>> from plyfold import find_embedding
    >>> ramp = find_embedding([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> frame = Frame(ramp.immersion.arrangement.curve.points)
    >>> len(list(cased_strands(ramp, frame, gap=0.01)))
    4
    """
    arrangement = layering.immersion.arrangement
    if arrangement.n_crossings == 0:
        points = frame(arrangement.border_points(0))
        yield np.concatenate([points, points[:1]])
    for borders in cut_strands(arrangement, ~layering.casing):
        yield strand_with_gaps(arrangement, borders, frame, gap)


def cut_strands(arrangement: Arrangement, cuts: Bools) -> Iterator[list[int]]:
    """Yield the borders between one visit to be cut at and the next, in order along the curve; nothing without cuts."""
    visits = np.flatnonzero(cuts).tolist()
    n = arrangement.n_borders
    for start, end in zip(visits, visits[1:] + visits[:1], strict=True):
        yield [(start + i) % n for i in range((end - start - 1) % n + 1)]


def strand_with_gaps(arrangement: Arrangement, borders: Sequence[int], frame: Frame, gap: float) -> Floats:
    """Return consecutive borders as one polyline in the picture, shortened at both ends; not at all by a gap of 0."""
    lines = [frame(arrangement.border_points(border)) for border in borders]
    if gap:
        end = (borders[-1] + 1) % arrangement.n_borders
        lines[0] = _shortened(lines[0], _gap_at(arrangement, borders[0], gap))
        lines[-1] = _shortened(lines[-1][::-1], _gap_at(arrangement, end, gap))[::-1]
    return np.concatenate([*(line[:-1] for line in lines), lines[-1][-1:]])


def _gap_at(arrangement: Arrangement, visit: int, gap: float) -> float:
    """Return how much of a strand to leave out at a visit, so that the gap is as wide as asked for, seen across."""
    assert arrangement.curve is not None
    points = arrangement.curve.points
    start = arrangement.visit_edge[[visit, arrangement.partner[visit]]]
    (ax, ay), (bx, by) = points[(start + 1) % len(points)] - points[start]
    sine = abs(ax * by - ay * bx) / (np.hypot(ax, ay) * np.hypot(bx, by))
    return float(gap / max(sine, 1 / _LONGEST_GAP))


def _shortened(points: Floats, length: float) -> Floats:
    """Return a polyline without its beginning, but most of it."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    travelled = np.concatenate([[0.0], np.cumsum(steps)])
    cut = min(length, _MOST_OF_BORDER * travelled[-1])
    edge = int(np.searchsorted(travelled, cut, side="right")) - 1
    share = (cut - travelled[edge]) / steps[edge]
    return np.concatenate([points[edge : edge + 1] + share * (points[edge + 1] - points[edge]), points[edge + 1 :]])
