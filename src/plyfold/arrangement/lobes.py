"""The two lobes into which a curve falls apart at each of its crossings, and how often they turn."""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange, require_one_loop
from plyfold.arrays import Ints
from plyfold.graphs import spanning_tree

__all__ = ["lobe_turning_numbers", "quarter_turns"]


def lobe_turning_numbers(curve: CurveLike) -> Ints:
    """Return the turning numbers (Whitney indices) of the two lobes at every crossing.

    At a crossing the curve is two lobes: from the first visit to the second, and from there on to the first again. Each
    turns at the crossing from one strand to the other by less than half a turn, one to the left and one to the right,
    so the two turning numbers add up to that of the curve.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
        A Gauss code without a drawing will do.

    Returns
    -------
    (k, 2) int
        One row for each crossing: the lobe from its first visit to its second, and the rest.

    Raises
    ------
    CurveError
        If the points do not make a closed curve.

    Notes
    -----
    O(k). With right angles at all crossings, the quarter turns of the borders are integers that add up to 4 around each
    bounded cell, corners included; outside a spanning tree of neighbouring cells they can be 0.

    Examples
    --------
    >>> from plyfold import Arrangement
    >>> limacon = Arrangement.from_gauss([1, 0], [True, False], outer=1)
    >>> lobe_turning_numbers(limacon).tolist()
    [[1, 1]]
    """
    drawn = arrange(curve)
    require_one_loop(drawn)
    first = drawn.first_visits
    second = drawn.partner[first]
    along = np.concatenate([[0], np.cumsum(quarter_turns(drawn))])
    corner = np.where(drawn.ccw[second], 1, -1)
    lobe = (along[second] - along[first] + corner) // 4
    return np.column_stack([lobe, drawn.turning_number - lobe])


def quarter_turns(drawn: Arrangement) -> Ints:
    """Return how many quarters each border turns to the left in a drawing whose crossings are right angles.

    A cell with c corners and one boundary lacks 4 − c quarters, and 4 more for each further boundary. What a cell and
    all cells behind it in the tree lack together, the border towards the root must turn.
    """
    left, right, cells = drawn.left_cell, drawn.right_cell, drawn.n_cells
    parent, border, order = spanning_tree(cells, left, right)
    starts_at_crossing = np.append(drawn.crossing_of_visit, -1)[drawn.start_visit] >= 0
    corners = np.bincount(left[starts_at_crossing[drawn.next_border]], minlength=cells)
    corners += np.bincount(right[starts_at_crossing], minlength=cells)
    lacking = 4 * (2 - drawn.n_cycles) - corners
    for level in _levels(parent, order)[:0:-1]:
        np.add.at(lacking, parent[level], lacking[level])
    turns = np.zeros(len(left), dtype=np.int64)
    cell = order[1:]
    turns[border[cell]] = np.where(left[border[cell]] == cell, lacking[cell], -lacking[cell])
    return turns


def _levels(parent: Ints, order: Ints) -> list[Ints]:
    """Return the cells level by level, from the root on; in their order, parents are in order as well."""
    place = np.empty(len(order), dtype=np.int64)
    place[order] = np.arange(len(order))
    place_of_parent = place[parent[order[1:]]]
    starts = [0, 1]
    while starts[-1] < len(order):
        starts.append(1 + int(np.searchsorted(place_of_parent, starts[-1])))
    return np.split(order, starts[1:-1])
