"""Gaps in a strand where another one passes over it, as in pictures of knots."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Floats
from plyfold.draw.placement import Frame, border_line

if TYPE_CHECKING:
    from plyfold.layering.layering import Layering

__all__ = ["cased_strands", "cut_strands", "strand_with_gaps"]

# At shallow crossings, gaps become longer, but not longer than so many times, nor than this part of their border.
_LONGEST_GAP = 4.0
_MOST_OF_BORDER = 1 / 3


def cased_strands(layering: Layering, frame: Frame, gap: float) -> Iterator[Floats]:
    """Yield the outline cut wherever it passes under itself: polylines with gaps at their ends.

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
        In order along the loops. Of a loop that passes under nothing, all of it, its first point repeated.

    Examples
    --------
    >>> from plyfold import find_embedding
    >>> ramp = find_embedding([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> frame = Frame(ramp.immersion.arrangement.curve.points)
    >>> len(list(cased_strands(ramp, frame, gap=0.01)))
    4
    """
    arrangement = layering.immersion.arrangement
    under = arrangement.crossing_visits[~layering.casing[arrangement.crossing_visits]]
    cut = np.isin(np.arange(arrangement.n_borders), arrangement.border_after[under])
    for borders, is_loop in cut_strands(arrangement, cut):
        yield strand_with_gaps(arrangement, borders, frame, 0.0 if is_loop else gap)


def cut_strands(arrangement: Arrangement, cut: Bools) -> Iterator[tuple[list[int], bool]]:
    """Yield the borders from one whose start is cut to the next such one, in order along each loop.

    With them comes whether they are a whole loop, which is cut nowhere.
    """
    for borders in np.split(np.arange(arrangement.n_borders), np.flatnonzero(np.diff(arrangement.loop_of_border)) + 1):
        starts = np.flatnonzero(cut[borders])
        if len(starts):
            pieces = np.split(np.roll(borders, -starts[0]), starts[1:] - starts[0])
            yield from ((piece.tolist(), False) for piece in pieces)
        else:
            yield borders.tolist(), True


def strand_with_gaps(arrangement: Arrangement, borders: Sequence[int], frame: Frame, gap: float) -> Floats:
    """Return consecutive borders as one polyline in the picture, shortened at both ends; not at all by a gap of 0."""
    lines = [frame(border_line(arrangement, border)) for border in borders]
    if gap:
        start, end = arrangement.start_visit[[borders[0], arrangement.next_border[borders[-1]]]].tolist()
        lines[0] = _shortened(lines[0], _gap_at(arrangement, start, gap))
        lines[-1] = _shortened(lines[-1][::-1], _gap_at(arrangement, end, gap))[::-1]
    return np.concatenate([*(line[:-1] for line in lines), lines[-1][-1:]])


def _gap_at(arrangement: Arrangement, visit: int, gap: float) -> float:
    """Return how much of a strand to leave out at a visit, so that the gap is as wide as asked for, seen across.

    At a cusp a strand goes under the surface that begins there, and has no gap.
    """
    outline, other = arrangement.outline, int(arrangement.partner[visit])
    if outline is None or other == visit:
        return 0.0
    start = arrangement.visit_edge[[visit, other]]
    (ax, ay), (bx, by) = outline.points[outline.next_point[start]] - outline.points[start]
    sine = abs(ax * by - ay * bx) / (np.hypot(ax, ay) * np.hypot(bx, by))
    return float(gap / max(sine, 1 / _LONGEST_GAP))


def _shortened(points: Floats, length: float) -> Floats:
    """Return a polyline without its beginning, but most of it."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    travelled = np.concatenate([[0.0], np.cumsum(steps)])
    cut = min(length, _MOST_OF_BORDER * travelled[-1])
    if not cut:
        return points
    edge = int(np.searchsorted(travelled, cut, side="right")) - 1
    share = (cut - travelled[edge]) / steps[edge]
    return np.concatenate([points[edge : edge + 1] + share * (points[edge + 1] - points[edge]), points[edge + 1 :]])
