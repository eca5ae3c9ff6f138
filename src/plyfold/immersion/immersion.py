"""An immersed disk: sheets over the cells, glued along the borders (§2.2 of the paper)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints, freeze
from plyfold.errors import InputError, NotImmersibleError, PlyfoldError
from plyfold.memory import require_memory
from plyfold.obstruction import Obstruction

__all__ = ["Group", "Immersion", "count_each", "require_immersion", "require_memory_for_gluing"]

# Bytes for each pair of glued sheets: the result, and what is there while it is made and checked.
_BYTES_PER_PAIR = 130


@dataclass(frozen=True)
class Group:
    """A sheet and the borders that lie on its boundary: one region of the disk layout.

    Parameters
    ----------
    sheet, cell : int
        The sheet (the paper's *face*) and the cell below it.
    borders : tuple of int
        Its own borders in order along the curve.
    """

    sheet: int
    cell: int
    borders: tuple[int, ...]

    @property
    def arcs(self) -> tuple[tuple[int, int], ...]:
        """The paper's arcs: each border with the next one of the group; a border alone has a self-arc."""
        if len(self.borders) < 3:
            return ((self.borders[0], self.borders[-1]),)
        return tuple(zip(self.borders, self.borders[1:] + self.borders[:1], strict=True))


@dataclass(frozen=True, eq=False)
class Immersion:
    """One way in which a disk of cloth can lie flat with the curve as its outline.

    Parameters
    ----------
    arrangement : Arrangement
        The curve's crossings, borders and cells.
    sheet_cell : (sheets,) int
        The cell below each sheet. Cell c has ``winding[c]`` sheets, numbered consecutively from ``first_sheet[c]``.
    first_sheet : (cells,) int
        Number of each cell's first sheet.
    own_sheet : (borders,) int
        The sheet on the left of each border that has the border on the boundary of the disk.
    gluing : (g, 3) int
        Rows (border, sheet on its right, sheet on its left): the two sheets are glued along the border. Every sheet
        on the right occurs once per border, and every sheet on the left except the border's own.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> ramp.arrangement.winding.tolist(), ramp.n_sheets
    ([0, 2, 1, 1, 1, 0], 5)
    >>> [(group.cell, group.borders) for group in ramp.disk_layout()]
    [(1, (0, 6)), (3, (1, 5)), (1, (2, 4)), (2, (3,)), (4, (7,))]
    """

    arrangement: Arrangement
    sheet_cell: Ints
    first_sheet: Ints
    own_sheet: Ints
    gluing: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        return f"<Immersion: {self.n_sheets} sheets over {self.arrangement.n_cells - 1} cells>"

    def _repr_svg_(self) -> str:
        from plyfold.draw.svg import layout_svg

        return layout_svg(self)

    @property
    def n_sheets(self) -> int:
        """Number of sheets: the winding numbers of all cells added up."""
        return len(self.sheet_cell)

    @cached_property
    def sheets(self) -> tuple[range, ...]:
        """The sheets over each cell, as ranges of numbers: ``sheets[c]`` has ``winding[c]`` of them."""
        return tuple(
            range(first, first + winding)
            for first, winding in zip(self.first_sheet.tolist(), self.arrangement.winding.tolist(), strict=True)
        )

    def disk_layout(self) -> tuple[Group, ...]:
        """Return the disk layout: the borders of the disk, grouped by the sheet they lie on (§2.2 of [MGR11]_).

        Returns
        -------
        tuple of Group
            In order of their first borders. They are a non-crossing partition of the borders: drawn in a round
            disk, arcs between borders of one group never meet those of another. Sheets without own borders are
            not listed. Cost: O(k log k).

        References
        ----------
        .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
           Sketch-Based Interfaces and Modeling, 2011.
        """
        borders_of: dict[int, list[int]] = {}
        for border, sheet in enumerate(self.own_sheet.tolist()):
            borders_of.setdefault(sheet, []).append(border)
        return tuple(Group(s, int(self.sheet_cell[s]), tuple(borders)) for s, borders in borders_of.items())

    def check(self) -> None:
        """Check the immersion against its definition, border by border and crossing by crossing.

        Raises
        ------
        PlyfoldError
            Naming the condition that failed and the border. That would be a mistake in plyfold.

        Notes
        -----
        O(Σ w).
        """
        for condition, holds in self._conditions():
            if not holds:
                raise PlyfoldError(f"internal check failed: {condition}")

    def _conditions(self) -> Iterator[tuple[str, bool]]:
        arrangement = self.arrangement
        lower, upper = arrangement.winding[arrangement.right_cell], arrangement.winding[arrangement.left_cell]
        yield "the curve turns once", arrangement.turning_number == 1
        yield (
            "as many sheets as windings",
            np.array_equal(self.sheet_cell, np.repeat(np.arange(arrangement.n_cells), arrangement.winding)),
        )
        border = np.repeat(np.arange(arrangement.n_borders), lower)
        right = self.first_sheet[arrangement.right_cell[border]] + count_each(lower)
        yield "every sheet on the right is glued once", np.array_equal(self.gluing[:, :2], np.stack([border, right], 1))
        taken = np.zeros(int(upper.sum()), dtype=np.int64)
        first_taken = np.cumsum(upper) - upper - self.first_sheet[arrangement.left_cell]
        inside = arrangement.left_cell[border] == self.sheet_cell[self.gluing[:, 2]]
        inside_own = arrangement.left_cell == self.sheet_cell[self.own_sheet]
        yield "sheets are glued to sheets on the left", bool(inside.all() and inside_own.all())
        np.add.at(taken, first_taken[border] + self.gluing[:, 2], 1)
        np.add.at(taken, first_taken + self.own_sheet, 1)
        yield "every sheet on the left is glued once or has the border for its own", bool((taken == 1).all())
        yield "the gluings agree around every crossing", self._agree_around_crossings()

    def _agree_around_crossings(self) -> bool:
        """Compare the two ways from the bottom cell to the top cell around every crossing."""
        arrangement, own = self.arrangement, self.own_sheet
        n = arrangement.n_borders
        a = np.flatnonzero(arrangement.ccw)
        b = arrangement.partner[a]
        a_top, a_bottom, b_top, b_bottom = (a - 1) % n, a, b, (b - 1) % n
        sheets = arrangement.winding[arrangement.right_cell[a_bottom]]
        bottom = np.repeat(self.first_sheet[arrangement.right_cell[a_bottom]], sheets) + count_each(sheets)
        at = np.repeat(np.arange(len(a)), sheets)
        one_way = self._glued_to(b_top[at], self._glued_to(a_bottom[at], bottom))
        other_way = self._glued_to(a_top[at], self._glued_to(b_bottom[at], bottom))
        return (
            np.array_equal(one_way, other_way)
            and np.array_equal(self._glued_to(b_top, own[a_bottom]), own[a_top])
            and np.array_equal(self._glued_to(a_top, own[b_bottom]), own[b_top])
        )

    def _glued_to(self, border: Ints, right_sheet: Ints) -> Ints:
        """Return the sheets on the left that are glued to sheets on the right of borders."""
        cell = self.arrangement.right_cell
        sheets = self.arrangement.winding[cell]
        first_row = np.cumsum(sheets) - sheets - self.first_sheet[cell]
        return np.asarray(self.gluing[first_row[border] + right_sheet, 2])


def count_each(lengths: Ints) -> Ints:
    """Return 0, 1, … for each length, one after the other."""
    return np.arange(int(lengths.sum())) - np.repeat(np.cumsum(lengths) - lengths, lengths)


def require_immersion(value: object) -> Immersion:
    """Return an immersion as it is; raise an error that says why for the obstruction that stands in for one.

    Raises
    ------
    NotImmersibleError
        If the value is the obstruction of a curve that has no immersion.
    InputError
        If it is anything else.
    """
    if isinstance(value, Immersion):
        return value
    if isinstance(value, Obstruction):
        raise NotImmersibleError(value)
    raise InputError(f"a {type(value).__name__} is no immersion", hint="find_immersion(curve) makes one")


def require_memory_for_gluing(arrangement: Arrangement, bytes_per_pair: int = _BYTES_PER_PAIR) -> None:
    """Raise MemoryLimitError if the gluing of an immersion would not fit into memory."""
    pairs = int(arrangement.winding[arrangement.right_cell].sum())
    require_memory(
        bytes_per_pair * (pairs + arrangement.n_borders),
        f"the gluing of {pairs:,} pairs of sheets",
        arrangement,
        "bounds_disk, count_immersions and coverage answer without sheets",
    )
