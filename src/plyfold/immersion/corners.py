"""What meets at the crossings and at the feet of bridges: the four seams around each, whose gluings must agree.

Strand b crosses strand a from right to left. The *top* cell is left of both strands, the *bottom* cell right of both.
So a comes along the top and leaves along the bottom, and b comes along the bottom and leaves along the top. From the
bottom cell to the top one lead two ways, and every sheet must come out the same:

    b_top ∘ a_bottom = a_top ∘ b_bottom.

A *bridge* is a strand without sheets of its own. It begins or ends at a loop, so one of its two halves there is missing,
and what is glued along that is glued to itself.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints

__all__ = ["NO_SEAM", "corners", "corners_at_feet"]

# In place of the half of a bridge that is not there.
NO_SEAM = -1


def corners(arrangement: Arrangement) -> Ints:
    """Return for each crossing its borders: rows (a to top, a to bottom, b to top, b to bottom), shape (k, 4)."""
    a = np.flatnonzero(arrangement.ccw)
    b = arrangement.partner[a]
    before, after = arrangement.border_before, arrangement.border_after
    return np.stack([before[a], after[a], after[b], before[b]], axis=1)


def corners_at_feet(arrangement: Arrangement) -> Ints:
    """Return the same for both feet of each bridge, shape (2 b, 4); bridge j has number n_borders + j.

    A bridge that sets out to the left of a loop, or comes to it from the right, crosses it as strand b; the other way
    round it is strand a.
    """
    bridges = len(arrangement.bridges)
    dart = arrangement.bridges.T.ravel()
    bridge = arrangement.n_borders + np.tile(np.arange(bridges), 2)
    sets_out = np.arange(2 * bridges) < bridges
    on_left = dart % 2 == 0
    before = np.where(on_left, arrangement.border_before[arrangement.start_visit[dart // 2]], dart // 2)
    after = arrangement.next_border[before]
    nothing = np.full_like(dart, NO_SEAM)
    upper, lower = np.where(on_left, bridge, nothing), np.where(on_left, nothing, bridge)
    crosses = sets_out == on_left
    as_b, as_a = np.stack([before, after, upper, lower], axis=1), np.stack([upper, lower, after, before], axis=1)
    return np.where(crosses[:, None], as_b, as_a)
