"""A layering: the vertical order of the sheets over every cell (§3 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.as_given import given_windings
from plyfold.arrangement.base_visit import visits_from_base
from plyfold.arrays import Bools, Ints, freeze
from plyfold.errors import PlyfoldError
from plyfold.immersion.immersion import Immersion, Piece, require_memory_for_gluing
from plyfold.ragged import count_each, starts_of
from plyfold.wording import counted

__all__ = [
    "Layering",
    "borders_beside_top",
    "check_levels",
    "crossing_visits_by_loop",
    "glued_along_borders",
    "layering_of_levels",
    "meeting_sheets",
]

# Bytes for each pair of glued sheets of a surface made from its levels, and what is there while it is made.
_BYTES_PER_PAIR = 80


@dataclass(frozen=True, eq=False)
class Layering:
    """The levels of the sheets: a way to lift an immersed surface off the table so that it does not cut itself.

    The surface is a disk, or whatever else its outline bounds, see :attr:`pieces`. It is true as a value.

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
    >>> from plyfold import find_embedding
    >>> annulus = find_embedding([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])
    >>> annulus.border_level.tolist(), annulus.pieces
    ([1, 1], (Piece(loops=(0, 1), euler_characteristic=0),))
    """

    immersion: Immersion
    level: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        windings = given_windings(self.immersion.arrangement)
        sheets, levels = counted(int(windings.sum()), "sheet"), counted(int(windings.max()), "level")
        return f"<Layering: {sheets} on up to {levels}>"

    def _repr_svg_(self) -> str | None:
        # A Gauss code alone has no picture.
        from plyfold.draw.over_under_files import over_under_svg

        return over_under_svg(self, colours="sheets") if self.immersion.arrangement.outline else None

    @property
    def euler_characteristic(self) -> int:
        """That of all :attr:`pieces` together."""
        return self.immersion.euler_characteristic

    @property
    def genus(self) -> int:
        """Number of handles, of all pieces together."""
        return self.immersion.genus

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The connected pieces, as :attr:`Immersion.pieces`: those of meshes, cut where the surface touches itself."""
        return self.immersion.pieces

    @property
    def border_level(self) -> Ints:
        """Level of each border's own sheet, shape (borders,). These numbers alone determine the layering."""
        return self.level[self.immersion.own_sheet]

    @property
    def casing(self) -> Bools:
        """True where the strand passes over the other one, False where it passes under and at marks, shape (visits,).

        :func:`~plyfold.embed_cased` gives the layering back, or says what the casing does not determine.
        """
        here, there = meeting_sheets(self.immersion)
        return self.level[here] > self.level[there]

    @property
    def changes(self) -> int:
        """How often the curve changes between passing over and passing under, once round; an even number.

        Of several loops, those of all of them together.
        """
        casing = self.casing
        return sum(
            int((casing[visits] != casing[np.roll(visits, 1)]).sum())
            for visits in crossing_visits_by_loop(self.immersion.arrangement)
        )

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
        check_levels(self.immersion, self.level)
        border, right, left = self.immersion.gluing.T
        order = np.lexsort((self.level[right], border))
        rises = np.diff(self.level[left[order]]) > 0
        elsewhere = np.diff(border[order]) > 0
        if not (rises | elsewhere).all():
            raise PlyfoldError("internal check failed: every gluing keeps the order of the sheets")


def check_levels(immersion: Immersion, level: Ints) -> None:
    """Check that the sheets over every cell have the levels 1 … w. Raises PlyfoldError, naming the cell."""
    cell, winding = immersion.sheet_cell, immersion.arrangement.winding
    upward = np.lexsort((level, cell))
    wrong = np.flatnonzero(level[upward] != 1 + count_each(winding))
    if len(wrong):
        where = int(cell[upward[wrong[0]]])
        raise PlyfoldError(f"internal check failed: the sheets of cell {where} have levels 1 to {winding[where]}")


def meeting_sheets(immersion: Immersion) -> tuple[Ints, Ints]:
    """Return for every visit the sheets, over the top cell of the crossing, of its strand and of the other strand."""
    here = immersion.own_sheet[borders_beside_top(immersion.arrangement)]
    return here, here[immersion.arrangement.partner]


def borders_beside_top(arrangement: Arrangement) -> Ints:
    """Return for every visit the border of its strand that runs along the top cell of the crossing.

    The top cell is on the left of both strands. One of them crosses the other from right to left: that one leaves
    along the top cell, the other one comes along it. At a mark both sheets are the same.
    """
    return np.where(arrangement.ccw, arrangement.border_before, arrangement.border_after)


def crossing_visits_by_loop(arrangement: Arrangement) -> list[Ints]:
    """Return the visits to crossings along each loop; along a single one from the base visit on."""
    visits = visits_from_base(arrangement)
    visits = visits[arrangement.crossing_of_visit[visits] >= 0]
    if arrangement.n_loops == 1:
        return [visits]
    return np.split(visits, np.searchsorted(visits, arrangement.first_visit[1:-1]))


def layering_of_levels(arranged: Arrangement, level: Ints) -> Layering:
    """Build the layered surface in which the own sheets of the borders have given levels, and check it.

    Parameters
    ----------
    arranged : Arrangement
        No negative winding number.
    level : (borders,) int
        From 1 to the winding number on the left of the border. At every crossing the two strands have different
        levels over the top cell, and past the crossing the upper one's is one less on the side away from it. At a cusp
        the levels differ by its index, and at the feet of bridges not at all.

    Returns
    -------
    Layering
        Over each cell the sheets are numbered from below. Cost: O(Σ w), the sheets counted once per border.
    """
    require_memory_for_gluing(arranged, _BYTES_PER_PAIR)
    first_sheet = starts_of(arranged.winding)
    immersion = Immersion(
        arrangement=arranged,
        own_sheet=first_sheet[arranged.left_cell] + level - 1,
        glued_to=np.concatenate([glued_along_borders(arranged, level), _sheets_along_bridges(arranged)]).astype(
            np.int32
        ),
    )
    layering = Layering(immersion, count_each(arranged.winding) + 1)
    immersion.check()
    layering.check()
    return layering


def glued_along_borders(arranged: Arrangement, level: Ints) -> Ints:
    """Return for each border the sheets on its left, in order, but for the one on the given level."""
    lower = arranged.winding[arranged.right_cell]
    border, right = np.repeat(np.arange(arranged.n_borders), lower), count_each(lower)
    return np.asarray(starts_of(arranged.winding)[arranged.left_cell[border]] + right + (right >= level[border] - 1))


def _sheets_along_bridges(arranged: Arrangement) -> Ints:
    """Return for each bridge the sheets over its cell: every sheet goes on as itself."""
    cell = arranged.cell_of_dart[arranged.bridges[:, 0]]
    sheets = arranged.winding[cell]
    return np.repeat(starts_of(arranged.winding)[cell], sheets) + count_each(sheets)
