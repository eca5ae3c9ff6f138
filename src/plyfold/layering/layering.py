"""A layering: the vertical order of the sheets over every cell (§3 of the paper)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Ints, freeze
from plyfold.errors import PlyfoldError
from plyfold.immersion.immersion import Immersion, count_each

__all__ = ["Layering", "meeting_sheets"]


@dataclass(frozen=True, eq=False)
class Layering:
    """The levels of the sheets: a way to lift an immersed disk off the table so that it does not cut itself.

    Parameters
    ----------
    immersion : Immersion
    level : (sheets,) int
        Level of each sheet among the sheets over its cell, counted from below, starting at 1.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> from plyfold import find_layering
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> layering = find_layering(ramp)
    >>> sorted(layering.level.tolist())
    [1, 1, 1, 1, 2]
    >>> layering.casing.sum(), layering.changes
    (np.int64(4), 2)
    """

    immersion: Immersion
    level: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        return f"<Layering: {self.immersion.n_sheets} sheets on up to {self.level.max(initial=0)} levels>"

    def _repr_svg_(self) -> str | None:
        # A Gauss code alone has no picture.
        from plyfold.draw.over_under_files import over_under_svg

        return None if self.immersion.arrangement.curve is None else over_under_svg(self, colours="sheets")

    @property
    def border_level(self) -> Ints:
        """Level of each border's own sheet, shape (borders,). These numbers alone determine the layering."""
        return self.level[self.immersion.own_sheet]

    @property
    def casing(self) -> Bools:
        """True where the strand passes over the other one, False where it passes under, shape (2k,), by visits.

        :func:`~plyfold.embed_cased` gives the layering back.
        """
        here, there = meeting_sheets(self.immersion)
        return self.level[here] > self.level[there]

    @property
    def changes(self) -> int:
        """How often the curve changes between passing over and passing under, once round; an even number."""
        casing = self.casing
        return int((casing != np.roll(casing, 1)).sum())

    def check(self) -> None:
        """Check that every cell's levels are 1 … w and that every gluing keeps the order.

        Raises
        ------
        PlyfoldError
            Naming the cell or the border. That would be a mistake in plyfold.

        Notes
        -----
        O(Σ w log w).
        """
        for condition, holds in self._conditions():
            if not holds:
                raise PlyfoldError(f"internal check failed: {condition}")

    def _conditions(self) -> Iterator[tuple[str, bool]]:
        cell = self.immersion.sheet_cell
        upward = np.lexsort((self.level, cell))
        wrong = np.flatnonzero(self.level[upward] != 1 + count_each(self.immersion.arrangement.winding))
        where = f"the sheets of cell {cell[upward[wrong[0]]]}" if len(wrong) else "the sheets of every cell"
        yield f"{where} have levels 1 to its winding number", not len(wrong)
        border, right, left = self.immersion.gluing.T
        order = np.lexsort((self.level[right], border))
        rises = np.diff(self.level[left[order]]) > 0
        elsewhere = np.diff(border[order]) > 0
        yield "every gluing keeps the order of the sheets", bool((rises | elsewhere).all())


def meeting_sheets(immersion: Immersion) -> tuple[Ints, Ints]:
    """Return for every visit the sheets, over the top cell of the crossing, of its strand and of the other strand.

    The top cell is on the left of both strands. One of them crosses the other from right to left: that one leaves
    along the top cell, the other one comes along it.
    """
    arrangement = immersion.arrangement
    visit = np.arange(len(arrangement.partner))
    beside_top = np.where(arrangement.ccw, visit - 1, visit)
    here = immersion.own_sheet[beside_top]
    return here, here[arrangement.partner]
