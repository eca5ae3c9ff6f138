"""What an immersion has to be, by its definition: looked at border by border, crossing by crossing, piece by piece."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat, flat, short_room
from plyfold.core.gluing import APART, NOT_ONCE, Gluing, agree_around, first_wrong_seam, wind_round
from plyfold.immersion.corners import corners, corners_at_feet, sides
from plyfold.ragged import count_each

if TYPE_CHECKING:
    from plyfold.immersion.immersion import Immersion

__all__ = ["conditions"]


def conditions(immersion: Immersion) -> Iterator[tuple[str, bool]]:
    """Yield in words what has to hold, and whether it does; each relies on those before it. Cost: O(Σ w)."""
    arrangement = immersion.arrangement
    is_full = len(immersion.own_sheet) == arrangement.n_borders and len(immersion.glued_to) == immersion.first_pair[-1]
    yield "every sheet on the right is glued once", is_full
    gluing = _as_glued(immersion)
    wrong = first_wrong_seam(gluing, short_room(immersion.n_sheets))
    yield "sheets are glued to sheets on the left", wrong != APART
    yield "every sheet on the left is glued once or has the border for its own", wrong != NOT_ONCE
    yield "the gluings agree around every crossing", agree_around(gluing, flat(corners(arrangement))) == 1
    if len(arrangement.bridges):
        yield "the gluings agree at the feet of bridges", agree_around(gluing, flat(corners_at_feet(arrangement))) == 1
    if arrangement.cusp_index.any():
        yield "the sheets wind round every cusp as often as its index says", _wind_round_cusps(arrangement, gluing)
    chi, pieces = _characteristics(immersion), immersion.piece_of_loop
    loops = np.bincount(pieces, minlength=len(chi))
    turns = np.bincount(pieces, arrangement.loop_characteristics, len(chi))
    fits = (loops > 0) & (turns == chi)
    yield "every piece has the Euler characteristic that its curves turn", bool(fits.all())
    handles = 2 - loops - chi
    is_whole = (handles >= 0) & (handles % 2 == 0)
    yield "no number of handles is negative or half a number", bool(is_whole.all())


def _as_glued(immersion: Immersion) -> Gluing:
    left, right = sides(immersion.arrangement)
    first, winding = immersion.first_sheet, immersion.arrangement.winding
    beside = first[left], winding[left], first[right]
    return Gluing(*all_flat(immersion.own_sheet, immersion.first_pair, immersion.glued_to, *beside))


def _wind_round_cusps(arrangement: Arrangement, gluing: Gluing) -> bool:
    cusps = np.flatnonzero(arrangement.cusp_index)
    of_visits = arrangement.cusp_index, arrangement.border_before, arrangement.border_after
    return wind_round(gluing, *all_flat(*(of_visit[cusps] for of_visit in of_visits))) == 1


def _characteristics(immersion: Immersion) -> Ints:
    """Return the Euler characteristic of each piece of the glued sheets.

    Cells cut open along bridges are disks, so a sheet counts 1, and a bridge −1 on each sheet over its cell. A crossing
    counts 1 on each sheet over its top cell, and a border between crossings −1 on each sheet over the cell on its left.
    At a mark there would be a point and a border more for each of these sheets, which is nothing; but the sheets that
    wind round a cusp have one point there together.
    """
    arrangement = immersion.arrangement
    if arrangement.n_loops == 1:
        return np.array([arrangement.turning_by_windings() - int(arrangement.cusp_index.sum())])
    piece, cells, visits = immersion.piece_of_sheet, arrangement.left_cell, arrangement.crossing_visits
    counted = partial(np.bincount, minlength=int(piece.max()) + 1)
    cusps = np.flatnonzero(arrangement.cusp_index)
    over = partial(_sheets_over, immersion)
    total = counted(piece) - counted(piece[over(arrangement.cell_of_dart[arrangement.bridges[:, 0]])])
    total += counted(piece[over(cells[corners(arrangement)[:, 0]])])
    total -= counted(piece[over(cells[arrangement.border_after[visits]])])
    at_cusps = piece[immersion.own_sheet[arrangement.border_after[cusps]]]
    return np.asarray(total - counted(np.repeat(at_cusps, arrangement.cusp_index[cusps])))


def _sheets_over(immersion: Immersion, cells: Ints) -> Ints:
    """Return all sheets over some cells, cell by cell."""
    sheets = immersion.arrangement.winding[cells]
    return np.repeat(immersion.first_sheet[cells], sheets) + count_each(sheets)
