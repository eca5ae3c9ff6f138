"""What meets at the crossings and at the feet of bridges: the four seams around each, whose gluings must agree.

Strand b crosses strand a from right to left. The *top* cell is left of both strands, the *bottom* cell right of both.
So a comes along the top and leaves along the bottom, and b comes along the bottom and leaves along the top. From the
bottom cell to the top one lead two ways, and every sheet must come out the same:

    b_top ∘ a_bottom = a_top ∘ b_bottom.

A *bridge* is a strand without sheets of its own. It begins or ends at a loop, so one of its halves is missing there:
along that, every sheet is glued to itself.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.gluing import find_corners, find_corners_at_feet

__all__ = ["NO_SEAM", "corners", "corners_at_feet", "feet", "sides"]

# In place of the half of a bridge that is not there.
NO_SEAM = -1


def sides(arrangement: Arrangement) -> tuple[Ints, Ints]:
    """Return the cells on the left and on the right of all borders, and then of all bridges."""
    left, right = arrangement.left_cell, arrangement.right_cell
    if not len(arrangement.bridges):
        return left, right
    bridged = arrangement.cell_of_dart[arrangement.bridges[:, 0]]
    return np.append(left, bridged), np.append(right, bridged)


def corners(arrangement: Arrangement) -> Ints:
    """Return for each crossing its borders: rows (a to top, a to bottom, b to top, b to bottom), shape (k, 4)."""
    around = np.empty((arrangement.n_crossings, 4), dtype=np.int64)
    before, after = arrangement.border_before, arrangement.border_after
    find_corners(*all_flat(arrangement.partner, arrangement.ccw.view(np.uint8), before, after, around))
    return around


def feet(arrangement: Arrangement) -> Ints:
    """Return the visits at which the feet of bridges are: all first feet, then all second ones, shape (2 b,)."""
    dart = arrangement.bridges.T.ravel()
    border = dart // 2
    return np.asarray(arrangement.start_visit[np.where(dart % 2 == 0, border, arrangement.next_border[border])])


def corners_at_feet(arrangement: Arrangement) -> Ints:
    """Return the same for the feet of bridges, shape (2 b, 4); bridge j has number n_borders + j.

    A bridge that sets out to the left of a loop, or comes to it from the right, crosses it as strand b; the other way
    round it is strand a.
    """
    around = np.empty((2 * len(arrangement.bridges), 4), dtype=np.int64)
    foot, dart = all_flat(feet(arrangement), arrangement.bridges.T)
    before, after = all_flat(arrangement.border_before, arrangement.border_after)
    find_corners_at_feet(foot, dart, before, after, arrangement.n_borders, flat(around))
    return around
