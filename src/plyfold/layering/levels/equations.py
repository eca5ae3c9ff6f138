"""Levels straight from the curve: all that embedded surfaces of all immersions have in common (§5 of the paper).

Number the sheets over each cell 1 … w from below. In a surface without self-intersections every gluing keeps this
order, so all of it is determined by one whole number for each border: the level of its own sheet, from 1 to the winding
number on its left. At a crossing, let a and b be the levels of the two strands over the top cell, the one on the left
of both. They differ. Past the crossing each strand bounds a sheet over a side cell, where the other strand's sheet is
missing: the strand above has lost a level there, the one below has not. These equations are the only ones, whatever the
immersion, the number of curves or the genus.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.several import Loops, components
from plyfold.arrays import Ints, freeze

__all__ = ["LevelEquations", "level_equations", "level_equations_of_loops"]


@dataclass(frozen=True, eq=False)
class LevelEquations:
    """The equations between the levels of the borders.

    Parameters
    ----------
    highest : (borders,) int
        The winding number on the left of each border, at least 1: its level is between 1 and this.
    top, bottom : (k, 2) int
        For both strands of each crossing, the border beside the top cell and the one beside the bottom cell.
    """

    highest: Ints
    top: Ints
    bottom: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def n_crossings(self) -> int:
        """Number of crossings, k."""
        return len(self.top)

    @property
    def anchors(self) -> Ints:
        """For each curve, a border of it on which fewest levels are possible.

        Over and under at the crossings say how the level changes along a curve, so they and the levels of these borders
        determine all levels. Of a curve that comes to the outside, or over a cell with w = 1, nothing is left open.
        """
        curve = components(len(self.highest), self.top.ravel(), self.bottom.ravel())
        by_curve = np.lexsort((self.highest, curve))
        return by_curve[np.searchsorted(curve[by_curve], np.arange(curve.max(initial=-1) + 1))]

    def hold(self, level: Ints) -> bool:
        """Tell whether levels are a solution. Cost: O(k)."""
        at_top, at_bottom = level[self.top], level[self.bottom]
        above = at_top > at_top[:, ::-1]
        return bool(
            ((level >= 1) & (level <= self.highest)).all()
            and (at_top[:, 0] != at_top[:, 1]).all()
            and (at_bottom == at_top - above).all()
        )


def level_equations(arranged: Arrangement) -> LevelEquations:
    """Return the equations of a closed curve without negative winding numbers; crossings by their first visits.

    Examples
    --------
    >>> from plyfold import arrange
    >>> ramp = arrange([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> level_equations(ramp).highest.tolist()
    [2, 1, 2, 1, 2, 1, 2, 1]
    """
    first = np.flatnonzero(arranged.ccw)
    first = first[np.argsort(np.minimum(first, arranged.partner[first]))]
    before = (np.arange(arranged.n_borders) - 1) % arranged.n_borders
    return _equations(arranged.winding[arranged.left_cell], first, arranged.partner[first], before)


def level_equations_of_loops(loops: Loops) -> LevelEquations:
    """Return the equations of several closed curves without negative winding numbers."""
    return _equations(loops.winding[loops.left_cell], loops.first, loops.second, loops.border_before)


def _equations(highest: Ints, first: Ints, second: Ints, border_before: Ints) -> LevelEquations:
    """Return the equations, given the visits at which a second strand crosses a first one from right to left."""
    return LevelEquations(
        highest=highest,
        top=np.stack([border_before[first], second], axis=1),
        bottom=np.stack([first, border_before[second]], axis=1),
    )
