"""A place to number a curve from that depends on the drawing alone, not on the point where it was begun.

Where several answers are equally good, the first one is taken, and "first" is counted from here: so the same drawing
gets the same immersion and the same layering wherever its list of points begins, and whichever way it runs.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from plyfold.arrangement.core import Arrangement
from plyfold.arrays import Ints

__all__ = ["base_visit", "numbered_from", "visits_from_base"]


def base_visit(arrangement: Arrangement) -> int:
    """Return the visit at the crossing of the leftmost edges, of the strand that the other crosses from right to left.

    Edges that cross others are compared by the coordinates of their ends, which is exact; of those that cross the
    first one, the first again. Two edges cross once at most, so this is one visit. It is 0 for a curve without
    crossings and where only the code is known.

    Cost: O(k).

    Examples
    --------
    >>> from plyfold.arrangement import arrangement
    >>> points = [(0, 0), (4, 0), (4, 3), (1, -1)]
    >>> [base_visit(arrangement(points[i:] + points[:i])) for i in range(4)]
    [1, 0, 0, 1]
    """
    if arrangement.curve is None or not arrangement.n_crossings:
        return 0
    start = arrangement.curve.points[arrangement.visit_edge]
    end = arrangement.curve.points[(arrangement.visit_edge + 1) % len(arrangement.curve)]
    swap = (end[:, 0] < start[:, 0]) | ((end[:, 0] == start[:, 0]) & (end[:, 1] < start[:, 1]))
    edge = np.where(swap[:, None], np.hstack([end, start]), np.hstack([start, end]))
    least = np.arange(len(edge))
    for column in (*edge.T, *edge[arrangement.partner].T):
        least = least[column[least] == column[least].min()]
    visit = int(least[0])
    return visit if arrangement.ccw[visit] else int(arrangement.partner[visit])


def visits_from_base(arrangement: Arrangement) -> Ints:
    """Return all visits in order along the curve, the base visit first."""
    n = len(arrangement.partner)
    return (base_visit(arrangement) + np.arange(n)) % max(n, 1)


def numbered_from(arrangement: Arrangement, base: int) -> Arrangement:
    """Return the planar map, without the drawing, with visits, borders and darts numbered from a visit on.

    Cells and crossings keep their numbers. Cost: O(k).
    """
    if base == 0:
        return arrangement
    darts, visits = 2 * arrangement.n_borders, len(arrangement.partner)
    cell_darts = (arrangement.cell_darts - 2 * base) % darts
    outside = cell_darts[: arrangement.cell_start[1]]
    cell_darts[: len(outside)] = np.roll(outside, -int(outside.argmin()))
    return replace(
        arrangement,
        partner=(np.roll(arrangement.partner, -base) - base) % visits,
        ccw=np.roll(arrangement.ccw, -base),
        outer=(arrangement.outer - 2 * base) % darts,
        next_dart=(np.roll(arrangement.next_dart, -2 * base) - 2 * base) % darts,
        cell_of_dart=np.roll(arrangement.cell_of_dart, -2 * base),
        cell_darts=cell_darts,
        crossing_of_visit=np.roll(arrangement.crossing_of_visit, -base),
        curve=None,
        crossings=np.empty((0, 2)),
        visit_edge=np.empty(0, dtype=np.int64),
    )
