"""What an immersion has to be, by its definition: looked at border by border, crossing by crossing, piece by piece."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat
from plyfold.core.seams import AGREE, APART, ONCE, GluedSeams, first_fault
from plyfold.graphs import members_of
from plyfold.immersion.corners import NO_SEAM, corners, corners_at_feet, sides
from plyfold.ragged import count_each

if TYPE_CHECKING:
    from plyfold.immersion.immersion import Immersion

__all__ = ["conditions"]


def conditions(immersion: Immersion) -> Iterator[tuple[str, bool]]:
    """Yield in words what has to hold, and whether it does; each relies on those before it. Cost: O(Σ w)."""
    arrangement = immersion.arrangement
    is_whole = len(immersion.own_sheet) == arrangement.n_borders and len(immersion.glued_to) == immersion.first_pair[-1]
    yield "every sheet on the right is glued once", is_whole
    fault = _first_fault(immersion)
    yield "sheets are glued to sheets on the left", fault != APART
    yield "every sheet on the left is glued once or has the border for its own", fault != ONCE
    yield "the gluings agree around every crossing", fault != AGREE
    if len(arrangement.bridges):
        yield "the gluings agree at the feet of bridges", _agree_at_feet(immersion)
    if arrangement.cusp_index.any():
        yield "the sheets wind round every cusp as often as its index says", _wind_round_cusps(immersion)
    by_loops = {piece.loops: piece.euler_characteristic for piece in immersion.uncut_pieces}
    yield "every piece has the Euler characteristic that its curves turn", by_loops == _euler_by_loops(immersion)
    yield (
        "no number of handles is negative or half a number",
        all(
            piece.genus >= 0 and (len(piece.loops) + piece.euler_characteristic) % 2 == 0
            for piece in immersion.uncut_pieces
        ),
    )


def _first_fault(immersion: Immersion) -> int:
    """Look along every border and bridge, and round every crossing."""
    left, right = sides(immersion.arrangement)
    first, winding = immersion.first_sheet, immersion.arrangement.winding
    around, taken = corners(immersion.arrangement), np.zeros(immersion.n_sheets, dtype=np.int32)
    pairs = immersion.first_pair, immersion.glued_to, immersion.own_sheet
    return first_fault(
        GluedSeams(*all_flat(*pairs, first[left], first[right], winding[left])), *all_flat(around, taken)
    )


def _agree_at_feet(immersion: Immersion) -> bool:
    """Do the same at the feet of bridges, where one of the two strands is a loop."""
    around, own = corners_at_feet(immersion.arrangement), immersion.own_sheet
    if not _same_both_ways(immersion, around):
        return False
    for loop, across in (([0, 1], 2), ([2, 3], 0)):
        is_loop = around[:, loop].max(axis=1) < immersion.arrangement.n_borders
        top, bottom = around[is_loop][:, loop].T
        above = _glued_to_or_itself(immersion, around[is_loop, across], own[bottom])
        if not np.array_equal(above, own[top]):
            return False
    return True


def _same_both_ways(immersion: Immersion, around: Ints) -> bool:
    a_top, a_bottom, b_top, b_bottom = around.T
    _, right = sides(immersion.arrangement)
    bottom = right[np.maximum(a_bottom, b_bottom)]
    sheets = _sheets_over(immersion, bottom)
    at = np.repeat(np.arange(len(around)), immersion.arrangement.winding[bottom])
    up = partial(_glued_to_or_itself, immersion)
    return np.array_equal(up(b_top[at], up(a_bottom[at], sheets)), up(a_top[at], up(b_bottom[at], sheets)))


def _pair(immersion: Immersion, seam: Ints, right_sheet: Ints) -> Ints:
    """Return which pair of the immersion sheets on the right of seams are in."""
    _, right = sides(immersion.arrangement)
    return np.asarray(immersion.first_pair[seam] + right_sheet - immersion.first_sheet[right[seam]])


def _glued_to(immersion: Immersion, seam: Ints, right_sheet: Ints) -> Ints:
    """Return the sheets on the left that are glued to sheets on the right of seams."""
    return immersion.glued_to[_pair(immersion, seam, right_sheet)].astype(np.int64)


def _glued_to_or_itself(immersion: Immersion, seam: Ints, right_sheet: Ints) -> Ints:
    """Return the same, and where there is no seam the sheets themselves."""
    glued = immersion.glued_to.take(_pair(immersion, seam, right_sheet), mode="clip")
    return np.where(seam == NO_SEAM, right_sheet, glued)


def _wind_round_cusps(immersion: Immersion) -> bool:
    """Turn counter-clockwise from the border after each cusp to the border before it.

    That begins on the own sheet of the one, goes down over the other and up again as often as the index says, and ends
    on the own sheet of the other. All other sheets on the right go on to the same sheet on the left over both.
    """
    arrangement, own = immersion.arrangement, immersion.own_sheet
    cusps = np.flatnonzero(arrangement.cusp_index)
    index = arrangement.cusp_index[cusps]
    before, after = arrangement.border_before[cusps], arrangement.border_after[cusps]
    sheet = own[after].copy()
    for turn in range(int(index.max())):
        turning = np.flatnonzero(turn < index)
        down = _glued_from(immersion, before[turning], sheet[turning])
        if (down < 0).any():
            return False
        sheet[turning] = _glued_to(immersion, after[turning], down)
    cells = arrangement.right_cell[after]
    at = np.repeat(np.arange(len(cusps)), arrangement.winding[cells])
    right = _sheets_over(immersion, cells)
    differ = _glued_to(immersion, before[at], right) != _glued_to(immersion, after[at], right)
    return np.array_equal(sheet, own[before]) and np.array_equal(np.bincount(at, differ, len(cusps)), index)


def _glued_from(immersion: Immersion, seam: Ints, left_sheet: Ints) -> Ints:
    """Return the sheets on the right that are glued to sheets on the left, −1 for own sheets."""
    cells = sides(immersion.arrangement)[1][seam]
    right = _sheets_over(immersion, cells)
    at = np.repeat(np.arange(len(seam)), immersion.arrangement.winding[cells])
    found = np.full(len(seam), -1)
    is_it = _glued_to(immersion, seam[at], right) == left_sheet[at]
    found[at[is_it]] = right[is_it]
    return found


def _euler_by_loops(immersion: Immersion) -> dict[tuple[int, ...], int]:
    """Return the Euler characteristic of each piece of the glued sheets, by the curves that bound it.

    Cells cut open along bridges are disks, so a sheet counts 1, and a bridge −1 on each sheet over its cell. A crossing
    counts 1 on each sheet over its top cell, and a border between crossings −1 on each sheet over the cell on its left.
    At a mark there would be a point and a border more for each of these sheets, which is nothing; but the sheets that
    wind round a cusp have one point there together.
    """
    arrangement = immersion.arrangement
    if arrangement.n_loops == 1:
        return {(0,): arrangement.turning_by_windings() - int(arrangement.cusp_index.sum())}
    piece, cells, visits = immersion.piece_of_sheet, arrangement.left_cell, arrangement.crossing_visits
    counted = partial(np.bincount, minlength=int(piece.max()) + 1)
    cusps = np.flatnonzero(arrangement.cusp_index)
    over = partial(_sheets_over, immersion)
    total = counted(piece) - counted(piece[over(arrangement.cell_of_dart[arrangement.bridges[:, 0]])])
    total += counted(piece[over(cells[corners(arrangement)[:, 0]])])
    total -= counted(piece[over(cells[arrangement.border_after[visits]])])
    at_cusps = piece[immersion.own_sheet[arrangement.border_after[cusps]]]
    total -= counted(np.repeat(at_cusps, arrangement.cusp_index[cusps]))
    loops = members_of(immersion.piece_of_loop)
    return {tuple(loops.get(number, ())): value for number, value in enumerate(total.tolist())}


def _sheets_over(immersion: Immersion, cells: Ints) -> Ints:
    """Return all sheets over some cells, cell by cell."""
    sheets = immersion.arrangement.winding[cells]
    return np.repeat(immersion.first_sheet[cells], sheets) + count_each(sheets)
