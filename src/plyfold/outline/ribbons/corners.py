"""Inner corners that do not fit between their neighbours: the side is cut where it crosses itself around them.

Where the segments of a line are short for the width, a side of the ribbon makes a wrong loop at an inner corner. The
shortest such loop round each gap of the side is left out; whether what remains bounds a ribbon, the strip tells.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.outline.ribbons.line import TightBendError
from plyfold.outline.ribbons.sides import Side

__all__ = ["without_gaps"]

# How many edges before and after a gap are looked at; four times as many each time.
_FIRST_LOOK, _LAST_LOOK = 8, 2048


# Columns of the rows that stand for points after x and y: the part of the line beside each in joints and by length, and
# whether there is no edge to the next one.
_LOW, _HIGH, _FROM, _TO, _GAP = range(2, 7)


class _Cut(NamedTuple):
    """What is left out around a gap: points before and after it; and what comes in between.

    Parameters
    ----------
    before, after : int
    between : (0 or 1, 7) float
        The row of a point.
    cost : float
        The length of the line that is left out.
    """

    before: int
    after: int
    between: Floats
    cost: float


def without_gaps(side: Side, way: int, along: Floats, widths: Floats) -> Side:
    """Return a side whose gaps are closed, each by cutting off the shortest loop around it.

    Parameters
    ----------
    side : Side
    way : int
        Which side it is, ``LEFT`` or ``RIGHT``.
    along : (n,) float
        The length of the line up to each of its joints.
    widths : (n,) float

    Raises
    ------
    TightBendError
        If the side does not cross itself around a gap.

    Notes
    -----
    O(m), and the squares of the numbers of edges that loops have.
    """
    # Upside down, the right side is a left one.
    upright = np.array([1.0, way])
    places = [side.low, side.high]
    lengths = [np.interp(place, np.arange(len(along)), along) for place in places]
    rows = np.column_stack([side.points * upright, *places, *lengths, side.gap])
    kept = done = 0  # rows[:kept] is finished, and rows[done:] has not been looked at; kept <= done
    for gap in np.flatnonzero(side.gap).tolist():
        if gap < done:
            continue
        kept = _append(rows, kept, rows[done : gap + 1])
        cut = _shortest_cut(rows, kept, gap + 1, float(widths[int(side.low[gap])]))
        kept = _append(rows, kept - cut.before, cut.between)
        done = gap + 1 + cut.after
    kept = _append(rows, kept, rows[done:])
    finished = rows[:kept]
    return Side(finished[:, :2] * upright, finished[:, _LOW], finished[:, _HIGH], np.zeros(kept, dtype=bool))


def _append(rows: Floats, kept: int, more: Floats) -> int:
    """Move rows to the finished ones, and return how many those are now."""
    rows[kept : kept + len(more)] = more
    return kept + len(more)


def _shortest_cut(rows: Floats, kept: int, beyond: int, width: float) -> _Cut:
    """Return the cut that leaves out least of the line, between the finished rows and those beyond a gap.

    Where segments are so short that what they add is lost between the points of an arc, nothing crosses, and the ends
    are joined; that costs the width more.
    """
    look = _FIRST_LOOK
    while True:
        before, after = rows[max(kept - look - 1, 0) : kept][::-1], rows[beyond : beyond + look + 1]
        found = [*_cheapest_crossing(before, after), *_joined(before, after, width)]
        cut = min(found, key=lambda cut: cut.cost, default=None)
        unseen = _cost_of_unseen(before, after, look)
        if cut is not None and cut.cost <= unseen:
            return cut
        if unseen == np.inf or look >= _LAST_LOOK:
            raise TightBendError(float(before[0, _HIGH]))
        look *= 4


def _cost_of_unseen(before: Floats, after: Floats, look: int) -> float:
    """Return what a cut costs at least that is not within sight."""
    farther = [after[0, _FROM] - before[-1, _TO]] if len(before) > look else []
    farther += [after[-1, _FROM] - before[0, _TO]] if len(after) > look else []
    return float(min(farther, default=np.inf))


def _joined(before: Floats, after: Floats, width: float) -> list[_Cut]:
    """Return the cuts that leave out what is beside the first edge after the gap, or beside the last one before it.

    No more of the line may be left out than half the width: more could not lie within the ribbon.
    """
    end, start = before[0], after[0]
    ahead, back = after[1, :2] - start[:2], before[1, :2] - end[:2]
    behind = ~((before[1:, :2] - start[:2]) @ ahead > 0)
    beyond = ~((after[1:, :2] - end[:2]) @ back > 0)
    behind[-1], beyond[-1] = True, True
    first, last = 1 + int(behind.argmax()), 1 + int(beyond.argmax())
    lengths = [float(end[_TO] - before[first, _TO]), float(after[last, _FROM] - end[_TO])]
    cuts = [_Cut(first, 0, before[:0], lengths[0] + width), _Cut(0, last, before[:0], lengths[1] + width)]
    return [cut for cut, length in zip(cuts, lengths, strict=True) if 2 * length <= width]


def _cheapest_crossing(before: Floats, after: Floats) -> list[_Cut]:
    """Return the cheapest cut at a crossing, the one next to the gap of several; or nothing."""
    one, other, share, other_share = _crossings(before[:, :2], after[:, :2], after[:-1, _GAP] == 0)
    if not len(one):
        return []
    cost = after[other, _FROM] - before[one, _TO]
    best = int(np.lexsort([one + other, cost])[0])
    i, j = int(one[best]), int(other[best])
    # The crossing is beside what lies between the parts of the line that its two edges are beside.
    start, end = before[i + 1].copy(), before[i]
    from_end = after[j, [_HIGH, _TO]] + other_share[best] * (after[j + 1, [_LOW, _FROM]] - after[j, [_HIGH, _TO]])
    to_start = start[[_HIGH, _TO]] + share[best] * (end[[_LOW, _FROM]] - start[[_HIGH, _TO]])
    start[:2] += share[best] * (end[:2] - start[:2])
    start[[_LOW, _FROM]], start[[_HIGH, _TO]] = to_start, from_end
    return [_Cut(i + 1, j + 1, start[None], float(cost[best]))]


def _crossings(before: Floats, after: Floats, is_edge: Bools) -> tuple[Ints, Ints, Floats, Floats]:
    """Return where edges after the gap cross edges before it to their left: both numbers, and the shares of both edges.

    Points are counted away from the gap, so an edge before it runs from one point to the point with the number before.
    """
    start, step = before[1:, None], before[:-1, None] - before[1:, None]
    other, other_step = after[None, :-1], after[None, 1:] - after[None, :-1]
    between = other - start
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        turn = _cross(step, other_step)
        share, other_share = _cross(between, other_step) / turn, _cross(between, step) / turn
    met = is_edge & (turn > 0) & (share >= 0) & (share <= 1) & (other_share >= 0) & (other_share <= 1)
    one, two = np.nonzero(met)
    return one, two, share[met], other_share[met]


def _cross(one: Floats, other: Floats) -> Floats:
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])
