"""What an immersion has to be, by its definition: looked at border by border, crossing by crossing, piece by piece."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat
from plyfold.core.cusps import Cusped, wind_round
from plyfold.immersion.corners import NO_SEAM, corners, corners_at_feet
from plyfold.ragged import count_each, starts_of

if TYPE_CHECKING:
    from plyfold.immersion.immersion import Immersion

__all__ = ["conditions"]


class _Rows(NamedTuple):
    """The cells on both sides of all borders, and then of all bridges; where the rows of the gluing start.

    Sheet s on the right of seam e is glued in row ``first[e] + s``.
    """

    left: Ints
    right: Ints
    first: Ints


def conditions(immersion: Immersion) -> Iterator[tuple[str, bool]]:
    """Yield in words what has to hold, and whether it does; each relies on those before it. Cost: O(Σ w)."""
    arrangement = immersion.arrangement
    sheet_cell = np.repeat(np.arange(arrangement.n_cells), arrangement.winding)
    yield "as many sheets as windings", np.array_equal(immersion.sheet_cell, sheet_cell)
    rows = _rows(immersion)
    yield from _along_borders(immersion, rows)
    yield "the gluings agree around every crossing", _agree_at_crossings(immersion, rows)
    if len(arrangement.bridges):
        yield "the gluings agree at the feet of bridges", _agree_at_feet(immersion, rows)
    if arrangement.cusp_index.any():
        yield "the sheets wind round every cusp as often as its index says", _wind_round_cusps(immersion, rows)
    chi, pieces = _characteristics(immersion), immersion.piece_of_loop
    loops = np.bincount(pieces, minlength=len(chi))
    turns = np.bincount(pieces, arrangement.loop_characteristics, len(chi))
    fits = (loops > 0) & (turns == chi)
    yield "every piece has the Euler characteristic that its curves turn", bool(fits.all())
    handles = 2 - loops - chi
    is_whole = (handles >= 0) & (handles % 2 == 0)
    yield "no number of handles is negative or half a number", bool(is_whole.all())


def _rows(immersion: Immersion) -> _Rows:
    arrangement = immersion.arrangement
    left, right = arrangement.left_cell, arrangement.right_cell
    if len(arrangement.bridges):
        bridged = arrangement.cell_of_dart[arrangement.bridges[:, 0]]
        left, right = np.append(left, bridged), np.append(right, bridged)
    return _Rows(left, right, starts_of(arrangement.winding[right]) - immersion.first_sheet[right])


def _along_borders(immersion: Immersion, rows: _Rows) -> Iterator[tuple[str, bool]]:
    arrangement, first_sheet = immersion.arrangement, immersion.first_sheet
    left, right, _ = rows
    lower, upper = arrangement.winding[right], arrangement.winding[left]
    seam = np.repeat(np.arange(len(right)), lower)
    glued = np.stack([seam, first_sheet[right[seam]] + count_each(lower)], axis=1)
    yield "every sheet on the right is glued once", np.array_equal(immersion.gluing[:, :2], glued)
    inside = left[seam] == immersion.sheet_cell[immersion.gluing[:, 2]]
    inside_own = arrangement.left_cell == immersion.sheet_cell[immersion.own_sheet]
    yield "sheets are glued to sheets on the left", bool(inside.all() and inside_own.all())
    taken = np.zeros(int(upper.sum()), dtype=np.int64)
    first_taken = starts_of(upper) - first_sheet[left]
    np.add.at(taken, first_taken[seam] + immersion.gluing[:, 2], 1)
    np.add.at(taken, first_taken[: arrangement.n_borders] + immersion.own_sheet, 1)
    yield "every sheet on the left is glued once or has the border for its own", bool((taken == 1).all())


def _agree_at_crossings(immersion: Immersion, rows: _Rows) -> bool:
    """Compare the two ways from the bottom cell to the top cell, and follow the own sheets of both strands."""
    around, own = corners(immersion.arrangement), immersion.own_sheet
    a_top, a_bottom, b_top, b_bottom = around.T
    up = partial(_glued_to, immersion, rows)
    return (
        _same_both_ways(immersion, rows, around, up)
        and np.array_equal(up(b_top, own[a_bottom]), own[a_top])
        and np.array_equal(up(a_top, own[b_bottom]), own[b_top])
    )


def _agree_at_feet(immersion: Immersion, rows: _Rows) -> bool:
    """Do the same at the feet of bridges, where one of the two strands is a loop."""
    around, own = corners_at_feet(immersion.arrangement), immersion.own_sheet
    if not _same_both_ways(immersion, rows, around, partial(_glued_to_or_itself, immersion, rows)):
        return False
    for loop, across in (([0, 1], 2), ([2, 3], 0)):
        is_loop = around[:, loop].max(axis=1) < immersion.arrangement.n_borders
        top, bottom = around[is_loop][:, loop].T
        above = _glued_to_or_itself(immersion, rows, around[is_loop, across], own[bottom])
        if not np.array_equal(above, own[top]):
            return False
    return True


def _same_both_ways(immersion: Immersion, rows: _Rows, around: Ints, up: Callable[[Ints, Ints], Ints]) -> bool:
    a_top, a_bottom, b_top, b_bottom = around.T
    bottom = rows.right[np.maximum(a_bottom, b_bottom)]
    sheets = _sheets_over(immersion, bottom)
    at = np.repeat(np.arange(len(around)), immersion.arrangement.winding[bottom])
    one_way = up(b_top[at], up(a_bottom[at], sheets))
    return np.array_equal(one_way, up(a_top[at], up(b_bottom[at], sheets)))


def _glued_to(immersion: Immersion, rows: _Rows, seam: Ints, right_sheet: Ints) -> Ints:
    """Return the sheets on the left that are glued to sheets on the right of seams."""
    return np.asarray(immersion.gluing[rows.first[seam] + right_sheet, 2])


def _glued_to_or_itself(immersion: Immersion, rows: _Rows, seam: Ints, right_sheet: Ints) -> Ints:
    """Return the same, and where there is no seam the sheets themselves."""
    glued = immersion.gluing[:, 2].take(rows.first[seam] + right_sheet, mode="clip")
    return np.where(seam == NO_SEAM, right_sheet, glued)


def _wind_round_cusps(immersion: Immersion, rows: _Rows) -> bool:
    arrangement, cells = immersion.arrangement, immersion.arrangement.right_cell
    cusps = np.flatnonzero(arrangement.cusp_index)
    index, before, after = (
        of_visit[cusps] for of_visit in (arrangement.cusp_index, arrangement.border_before, arrangement.border_after)
    )
    sheets, first_sheet = arrangement.winding[cells], immersion.first_sheet[cells]
    glued = all_flat(immersion.own_sheet, sheets, first_sheet, rows.first, immersion.gluing[:, 2])
    return wind_round(Cusped(*all_flat(index, before, after), *glued)) == 1


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
