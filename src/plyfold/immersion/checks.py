"""What an immersion has to be, by its definition: looked at border by border, crossing by crossing, piece by piece."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat, flat, short_room
from plyfold.core.gluing import APART, NOT_ONCE, Gluing, add_characteristics, agree_around, first_wrong_seam, wind_round
from plyfold.immersion.corners import corners, corners_at_feet, sides

if TYPE_CHECKING:
    from plyfold.immersion.immersion import Immersion

__all__ = ["as_glued", "conditions"]


def conditions(immersion: Immersion) -> Iterator[tuple[str, bool]]:
    """Yield in words what has to hold, and whether it does; each relies on those before it. Cost: O(Σ w)."""
    arrangement = immersion.arrangement
    is_full = len(immersion.own_sheet) == arrangement.n_borders and len(immersion.glued_to) == immersion.first_pair[-1]
    yield "every sheet on the right is glued once", is_full
    gluing = as_glued(immersion)
    wrong = first_wrong_seam(gluing, short_room(immersion.n_sheets))
    yield "sheets are glued to sheets on the left", wrong != APART
    yield "every sheet on the left is glued once or has the border for its own", wrong != NOT_ONCE
    around = corners(arrangement)
    yield "the gluings agree around every crossing", agree_around(gluing, flat(around)) == 1
    if len(arrangement.bridges):
        yield "the gluings agree at the feet of bridges", agree_around(gluing, flat(corners_at_feet(arrangement))) == 1
    if arrangement.cusp_index.any():
        yield "the sheets wind round every cusp as often as its index says", _wind_round_cusps(arrangement, gluing)
    chi, pieces = _characteristics(immersion, gluing, around), immersion.piece_of_loop
    loops = np.bincount(pieces, minlength=len(chi))
    turns = np.bincount(pieces, arrangement.loop_characteristics, len(chi))
    fits = (loops > 0) & (turns == chi)
    yield "every piece has the Euler characteristic that its curves turn", bool(fits.all())
    handles = 2 - loops - chi
    is_whole = (handles >= 0) & (handles % 2 == 0)
    yield "no number of handles is negative or half a number", bool(is_whole.all())


def as_glued(immersion: Immersion) -> Gluing:
    """Return how sheets are glued, as the core reads it."""
    left, right = sides(immersion.arrangement)
    first, winding = immersion.first_sheet, immersion.arrangement.winding
    beside = first[left], winding[left], first[right]
    return Gluing(*all_flat(immersion.own_sheet, immersion.first_pair, immersion.glued_to, *beside))


def _wind_round_cusps(arrangement: Arrangement, gluing: Gluing) -> bool:
    cusps = np.flatnonzero(arrangement.cusp_index)
    of_visits = arrangement.cusp_index, arrangement.border_before, arrangement.border_after
    return wind_round(gluing, *all_flat(*(of_visit[cusps] for of_visit in of_visits))) == 1


def _characteristics(immersion: Immersion, gluing: Gluing, around: Ints) -> Ints:
    """Return the Euler characteristic of each piece of the glued sheets."""
    arrangement = immersion.arrangement
    if arrangement.n_loops == 1:
        return np.array([arrangement.turning_by_windings() - int(arrangement.cusp_index.sum())])
    piece, cusps = immersion.piece_of_sheet, np.flatnonzero(arrangement.cusp_index)
    total = np.zeros(int(piece.max()) + 1, dtype=np.int64)
    at_cusps = arrangement.cusp_index[cusps], arrangement.border_after[cusps]
    add_characteristics(gluing, *all_flat(around, *at_cusps, piece, total))
    return total
