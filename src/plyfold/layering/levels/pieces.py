"""Levels of surfaces in one piece: whether a solution is one, and the clause that keeps others like it out.

Over every cell the sheets of a piece make a pattern, read from below: one of the piece, one of another, and so on. A
gluing carries the pattern over the lower cell into that over the higher one without the letter on the border's own
level. The piece stays cut off as long as every border's level keeps to the run of equal letters that it lies in; in a
surface of one piece, some border's does not.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Ints
from plyfold.graphs import components
from plyfold.layering.layering import glued_along_borders
from plyfold.layering.levels.equations import LevelClauses
from plyfold.ragged import count_each, starts_of

__all__ = ["not_cut_off", "piece_of_each_sheet"]


def piece_of_each_sheet(arranged: Arrangement, level: Ints) -> Ints:
    """Return a number for each sheet, cell by cell from below: the same for sheets of one piece. Cost: O(Σ w)."""
    lower = arranged.winding[arranged.right_cell]
    right = np.repeat(starts_of(arranged.winding)[arranged.right_cell], lower) + count_each(lower)
    return components(int(arranged.winding.sum()), right, glued_along_borders(arranged, level))


def not_cut_off(arranged: Arrangement, clauses: LevelClauses, level: Ints) -> list[int] | None:
    """Return a clause that no solution with the patterns of this one meets, but every one of one piece does.

    Parameters
    ----------
    arranged : Arrangement
        Of several loops, so that its borders are numbered as those of the clauses are.
    clauses : LevelClauses
    level : (borders,) int
        A solution.

    Returns
    -------
    list of int or None
        The shortest of those of all pieces; None if there is only one piece.
    """
    piece = piece_of_each_sheet(arranged, level)
    if not piece.any():
        return None
    cut = (_left_run(arranged, clauses, level, piece == number) for number in range(int(piece.max()) + 1))
    return min(cut, key=len)


def _left_run(arranged: Arrangement, clauses: LevelClauses, level: Ints, inside: Bools) -> list[int]:
    """Return the clause that the level of some border leaves its run of sheets inside or outside of a piece."""
    first_sheet = starts_of(arranged.winding)
    begins = np.append(True, inside[1:] != inside[:-1])
    begins[first_sheet[arranged.winding > 0]] = True
    run = np.cumsum(begins) - 1
    start = np.flatnonzero(begins)
    end = np.append(start[1:], len(inside))
    first = first_sheet[arranged.left_cell]
    here = run[first + level - 1]
    border = np.arange(len(level))
    below, above = clauses.at_most(border, start[here] - first), -clauses.at_most(border, end[here] - first)
    return clauses.possible(np.concatenate([below, above]))
