"""An immersed surface, mostly a disk: sheets over the cells, glued along the borders (§2.2 of the paper).

Over a border the sheets of the lower cell (right) are glued one-to-one to sheets of the higher cell (left); the one
left over there is the border's own sheet, which has the border on the boundary of the surface.

The sheets of a grouping are numbered along the dual tree: a cell behind a descending link has the sheets of its parent
in the same order and the link's own sheet as the last one; a cell behind an ascending link has them all but the
partner's. The borders off the tree follow, for at every crossing three gluings give the fourth.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints, freeze
from plyfold.compiled import called_from_loops, run_loop
from plyfold.errors import InputError, NotImmersibleError, PlyfoldError
from plyfold.graphs import components
from plyfold.immersion.dual_tree import DualTree
from plyfold.memory import require_memory
from plyfold.obstruction import Obstruction
from plyfold.ragged import count_each, starts_of
from plyfold.wording import counted

__all__ = [
    "Group",
    "Immersion",
    "Piece",
    "glue_sheets",
    "require_disk",
    "require_immersion",
    "require_memory_for_gluing",
]

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


@dataclass(frozen=True)
class Piece:
    """A connected piece of a surface.

    Parameters
    ----------
    loops : tuple of int
        The curves that are its boundary.
    euler_characteristic : int
        The sum of their turning numbers.
    """

    loops: tuple[int, ...]
    euler_characteristic: int

    @property
    def genus(self) -> int:
        """Number of handles."""
        return (2 - len(self.loops) - self.euler_characteristic) // 2


@dataclass(frozen=True, eq=False)
class Immersion:
    """One way in which a piece of cloth can lie flat with the curve as its outline.

    It is a disk, if it was not made from the levels of an embedding: then it can have holes and handles, and be in
    several pieces.

    Parameters
    ----------
    arrangement : Arrangement
        Crossings, borders and cells of the outline.
    sheet_cell : (sheets,) int
        The cell below each sheet. Cell c has ``winding[c]`` sheets, numbered consecutively from ``first_sheet[c]``.
    first_sheet : (cells,) int
        Number of each cell's first sheet.
    own_sheet : (borders,) int
        The sheet on the left of each border that has the border on the boundary of the surface.
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
        sheets, cells = counted(self.n_sheets, "sheet"), counted(self.arrangement.n_cells - 1, "cell")
        return f"<Immersion: {sheets} over {cells}>"

    def _repr_svg_(self) -> str | None:
        # The disk layout; what is no disk has none.
        from plyfold.draw.svg import layout_svg

        return layout_svg(self) if self.is_disk else None

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

    @property
    def euler_characteristic(self) -> int:
        """The sum of the turning numbers of all curves: the surface lies flat, without branch points."""
        return self.arrangement.turning_number

    @property
    def genus(self) -> int:
        """Number of handles, of all pieces together."""
        return sum(piece.genus for piece in self.pieces)

    @property
    def is_disk(self) -> bool:
        """Whether the surface is a disk: bounded by one curve that turns once."""
        return self.arrangement.n_loops == 1 == self.arrangement.turning_number

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The connected pieces, in the order of their first curves; each curve bounds one of them. Cost: O(Σ w)."""
        turning = self.arrangement.turning_numbers
        loops_of: dict[int, list[int]] = {}
        for loop, piece in enumerate(self._piece_of_loop.tolist()):
            loops_of.setdefault(piece, []).append(loop)
        return tuple(Piece(tuple(loops), sum(turning[loop] for loop in loops)) for loops in loops_of.values())

    @property
    def _piece_of_loop(self) -> Ints:
        if self.arrangement.n_loops == 1:  # no piece is without boundary
            return np.zeros(1, dtype=np.int64)
        first_border = np.searchsorted(self.arrangement.loop_of_border, np.arange(self.arrangement.n_loops))
        return self._piece_of_sheet[self.own_sheet[first_border]]

    @cached_property
    def _piece_of_sheet(self) -> Ints:
        """The connected piece of each sheet."""
        return components(self.n_sheets, *self.gluing[:, 1:].T)

    def disk_layout(self) -> tuple[Group, ...]:
        """Return the disk layout: the borders of the disk, grouped by the sheet they lie on (§2.2 of [MGR11]_).

        Returns
        -------
        tuple of Group
            In order of their first borders. They are a non-crossing partition of the borders: drawn in a round
            disk, arcs between borders of one group never meet those of another. Sheets without own borders are
            not listed. Cost: O(k log k).

        Raises
        ------
        InputError
            If the surface is no disk.

        References
        ----------
        .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
           Sketch-Based Interfaces and Modeling, 2011.
        """
        require_disk(self)
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
        yield (
            "as many sheets as windings",
            np.array_equal(self.sheet_cell, np.repeat(np.arange(arrangement.n_cells), arrangement.winding)),
        )
        border = np.repeat(np.arange(arrangement.n_borders), lower)
        right = self.first_sheet[arrangement.right_cell[border]] + count_each(lower)
        yield "every sheet on the right is glued once", np.array_equal(self.gluing[:, :2], np.stack([border, right], 1))
        taken = np.zeros(int(upper.sum()), dtype=np.int64)
        first_taken = starts_of(upper) - self.first_sheet[arrangement.left_cell]
        inside = arrangement.left_cell[border] == self.sheet_cell[self.gluing[:, 2]]
        inside_own = arrangement.left_cell == self.sheet_cell[self.own_sheet]
        yield "sheets are glued to sheets on the left", bool(inside.all() and inside_own.all())
        np.add.at(taken, first_taken[border] + self.gluing[:, 2], 1)
        np.add.at(taken, first_taken + self.own_sheet, 1)
        yield "every sheet on the left is glued once or has the border for its own", bool((taken == 1).all())
        yield "the gluings agree around every crossing", self._agree_around_crossings()
        by_loops = {piece.loops: piece.euler_characteristic for piece in self.pieces}
        yield "every piece has the Euler characteristic that its curves turn", by_loops == self._euler_by_loops()
        yield (
            "no number of handles is negative or half a number",
            all(piece.genus >= 0 and (len(piece.loops) + piece.euler_characteristic) % 2 == 0 for piece in self.pieces),
        )

    def _euler_by_loops(self) -> dict[tuple[int, ...], int]:
        """Return the Euler characteristic of each piece of the glued sheets, by the curves that bound it.

        Points over crossings count 1, as many as there are sheets over the top cell; borders between crossings −1, on
        each sheet over the cell on their left; a sheet 1, and 1 less for each loop inside it.
        """
        arrangement = self.arrangement
        if arrangement.n_loops == 1:
            return {(0,): arrangement.turning_by_windings()}
        piece = self._piece_of_sheet
        cells = arrangement.left_cell
        top = cells[corners(arrangement)[:, 0]]
        sides = cells[arrangement.border_after]
        counted = partial(np.bincount, minlength=int(piece.max()) + 1)
        total = counted(piece, 2 - arrangement.n_cycles[self.sheet_cell])
        total += counted(piece[self._sheets_over(top)]) - counted(piece[self._sheets_over(sides)])
        loops = self._piece_of_loop
        return {tuple(np.flatnonzero(loops == number).tolist()): int(value) for number, value in enumerate(total)}

    def _sheets_over(self, cells: Ints) -> Ints:
        """Return all sheets over some cells, cell by cell."""
        sheets = self.arrangement.winding[cells]
        return np.repeat(self.first_sheet[cells], sheets) + count_each(sheets)

    def _agree_around_crossings(self) -> bool:
        """Compare the two ways from the bottom cell to the top cell around every crossing."""
        arrangement, own = self.arrangement, self.own_sheet
        a_top, a_bottom, b_top, b_bottom = corners(arrangement).T
        sheets = arrangement.winding[arrangement.right_cell[a_bottom]]
        bottom = self._sheets_over(arrangement.right_cell[a_bottom])
        at = np.repeat(np.arange(len(a_top)), sheets)
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
        first_row = starts_of(sheets) - self.first_sheet[cell]
        return np.asarray(self.gluing[first_row[border] + right_sheet, 2])


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


def require_disk(immersion: Immersion) -> Immersion:
    """Return a disk as it is; refuse another surface by an InputError."""
    if not immersion.is_disk:
        raise InputError(
            f"this is there for disks so far, and the surface has {immersion.arrangement.n_loops} boundary curves and "
            f"Euler characteristic {immersion.euler_characteristic}"
        )
    return immersion


# ---- from the chords of a grouping ---------------------------------------------------------------------------------


class _Tree(NamedTuple):
    """The dual tree: for each cell its parent, the link to it, the partner chosen for that or −1, and the sheets.

    ``name`` is of each sheet the border through which it leaves the disk on the way along the tree to the outside.
    ``named`` tells which cells have names for their sheets, ``waiting`` is a stack of cells.
    """

    parent: Ints
    link: Ints
    partner: Ints
    winding: Ints
    first_sheet: Ints
    name: Ints
    named: Ints
    waiting: Ints


class _Crossings(NamedTuple):
    """The borders around each crossing, and the crossings at the start and at the end of each border.

    At each crossing ``unknown`` borders have no seam yet, and ``sum_unknown`` is the sum of their numbers; where there
    is one, it is that one. ``scratch`` is room for a seam.
    """

    around: Ints
    at_start: Ints
    at_end: Ints
    unknown: Ints
    sum_unknown: Ints
    ready: Ints
    scratch: Ints


class _Seams(NamedTuple):
    """What happens over each border: the upper sheet that each lower sheet is glued to, and last the one left over.

    Sheets are counted from the first one of their cell. Border e has ``upper[start[e]:start[e + 1]]``.
    """

    start: Ints
    upper: Ints


def glue_sheets(arrangement: Arrangement, tree: DualTree, partner: Mapping[int, int]) -> Immersion:
    """Build the immersion that a grouping describes.

    Parameters
    ----------
    arrangement : Arrangement
        Turning number 1, no negative winding number.
    tree : DualTree
        The tree whose word was grouped.
    partner : mapping of int to int
        For the link of every ascending cell: the border through which its own sheet leaves the disk.

    Returns
    -------
    Immersion
        Cost: O(Σ w), the number of sheets counted once per border.
    """
    winding, lower = arrangement.winding, arrangement.winding[arrangement.right_cell]
    first_sheet = starts_of(winding)
    start = np.zeros(len(lower) + 1, dtype=np.int64)
    np.cumsum(lower + 1, out=start[1:])
    given = _tree(arrangement, tree, partner, first_sheet), _crossings(arrangement, tree)
    seams = _Seams(start, np.empty(start[-1], dtype=np.int64))
    upper = run_loop(_sew, len(seams.upper), given, seams).upper
    border = np.repeat(np.arange(len(lower)), lower + 1)
    upper += first_sheet[arrangement.left_cell[border]]
    right = np.arange(len(upper)) + (first_sheet[arrangement.right_cell] - start[:-1])[border]
    glued = np.ones(len(upper), dtype=bool)
    glued[start[1:] - 1] = False
    return Immersion(
        arrangement=arrangement,
        sheet_cell=np.repeat(np.arange(arrangement.n_cells), winding),
        first_sheet=first_sheet,
        own_sheet=upper[~glued],
        gluing=np.array([border[glued], right[glued], upper[glued]]).T,
    )


def _tree(arrangement: Arrangement, tree: DualTree, partner: Mapping[int, int], first_sheet: Ints) -> _Tree:
    chosen = np.full(arrangement.n_borders, -1)
    chosen[list(partner.keys())] = list(partner.values())
    return _Tree(
        parent=tree.parent,
        link=tree.link,
        partner=chosen[tree.link],
        winding=arrangement.winding,
        first_sheet=first_sheet,
        name=np.empty(int(arrangement.winding.sum()), dtype=np.int64),
        named=(np.arange(arrangement.n_cells) == 0).astype(np.int64),
        waiting=np.empty(arrangement.n_cells, dtype=np.int64),
    )


def _crossings(arrangement: Arrangement, tree: DualTree) -> _Crossings:
    around = corners(arrangement)
    at_start = np.zeros(arrangement.n_borders, dtype=np.int64)
    at_start[around[:, 1]] = at_start[around[:, 2]] = np.arange(len(around))
    off_tree = np.ones(arrangement.n_borders, dtype=np.int64)
    off_tree[tree.link[1:]] = 0
    unknown = off_tree[around]
    return _Crossings(
        around=around,
        at_start=at_start,
        at_end=at_start[arrangement.next_border],
        unknown=unknown.sum(axis=1),
        sum_unknown=(around * unknown).sum(axis=1),
        ready=np.empty(2 * len(around), dtype=np.int64),
        scratch=np.empty(int(arrangement.winding.max()) + 1, dtype=np.int64),
    )


def corners(arrangement: Arrangement) -> Ints:
    """Return for each crossing its borders: rows (a to top, a to bottom, b to top, b to bottom), shape (k, 4).

    Strand b crosses strand a from right to left; the top cell is left of both strands, the bottom cell right of
    both. So a comes along the top and leaves along the bottom, and b comes along the bottom and leaves along the top.
    """
    a = np.flatnonzero(arrangement.ccw)
    b = arrangement.partner[a]
    before, after = arrangement.border_before, arrangement.border_after
    return np.stack([before[a], after[a], after[b], before[b]], axis=1)


def _sew(given: tuple[_Tree, _Crossings], seams: _Seams) -> int:
    """Find the seams of all links, parents first, and then those of the other borders."""
    tree, crossings = given
    for start in range(len(tree.parent)):
        cell, size = start, 0
        while tree.named[cell] == 0:
            tree.waiting[size] = cell
            cell, size = tree.parent[cell], size + 1
        while size > 0:
            size -= 1
            _name_sheets(tree, seams, tree.waiting[size])
    return _complete(crossings, seams)


@called_from_loops
def _name_sheets(tree: _Tree, seams: _Seams, cell: int) -> None:
    """Name the sheets over a cell after those over its parent, and write down the seam between them."""
    name, upper, partner = tree.name, seams.upper, tree.partner[cell]
    count, above = tree.winding[tree.parent[cell]], tree.first_sheet[tree.parent[cell]]
    first, seam = tree.first_sheet[cell], seams.start[tree.link[cell]]
    kept = 0
    for sheet in range(count):
        if name[above + sheet] == partner:
            upper[seam + count - 1] = sheet
        else:
            name[first + kept] = name[above + sheet]
            upper[seam + kept] = sheet
            kept += 1
    if partner < 0:
        name[first + count] = tree.link[cell]
        upper[seam + count] = count
    tree.named[cell] = 1


@called_from_loops
def _complete(crossings: _Crossings, seams: _Seams) -> int:
    """Complete the seams, crossing by crossing: the borders off the dual tree form a tree of crossings.

    A crossing at which one seam is missing gives it to the crossing at the border's other end.
    """
    unknown, ready = crossings.unknown, crossings.ready
    size = 0
    for crossing in range(len(unknown)):
        if unknown[crossing] == 1:
            ready[size] = crossing
            size += 1
    while size > 0:
        size -= 1
        crossing = ready[size]
        if unknown[crossing] == 0:
            continue
        border = crossings.sum_unknown[crossing]
        _find_seam(crossings, seams, border, crossing)
        for end in (crossings.at_start[border], crossings.at_end[border]):
            unknown[end] -= 1
            crossings.sum_unknown[end] -= border
            if unknown[end] == 1:
                ready[size] = end
                size += 1
    return size


@called_from_loops
def _find_seam(crossings: _Crossings, seams: _Seams, border: int, crossing: int) -> None:
    """Find the missing one of the four seams around a crossing.

    Going from the bottom cell to the top one around either side is the same: b_top ∘ a_bottom = a_top ∘ b_bottom,
    and each strand has one own sheet on both sides of the crossing.
    """
    a_top, a_bottom, b_top, b_bottom = crossings.around[crossing]
    if border == b_bottom:
        _find_lower(seams, crossings.scratch, border, (a_bottom, b_top, a_top))
    elif border == a_bottom:
        _find_lower(seams, crossings.scratch, border, (b_bottom, a_top, b_top))
    elif border == b_top:
        _find_upper(seams, border, a_bottom, a_top, b_bottom)
    else:
        _find_upper(seams, border, b_bottom, b_top, a_bottom)


@called_from_loops
def _find_lower(seams: _Seams, lower_of: Ints, border: int, others: tuple[int, int, int]) -> None:
    """Find the seam below ``other_top``, given the way round the other side: ``bottom``, then ``top``."""
    bottom, top, other_top = others
    start, upper = seams.start, seams.upper
    for lower in range(start[other_top + 1] - start[other_top]):
        lower_of[upper[start[other_top] + lower]] = lower
    for lower in range(start[border + 1] - start[border] - 1):
        upper[start[border] + lower] = lower_of[upper[start[top] + upper[start[bottom] + lower]]]
    # The last entries are the own sheets: that of ``top`` has one on the other side of the crossing as well.
    upper[start[border + 1] - 1] = lower_of[upper[start[top + 1] - 1]]


@called_from_loops
def _find_upper(seams: _Seams, border: int, bottom: int, other_top: int, other_bottom: int) -> None:
    """Find the seam above ``bottom``, given the way round the other side: ``other_bottom``, then ``other_top``."""
    start, upper = seams.start, seams.upper
    upper[start[border] + upper[start[bottom + 1] - 1]] = upper[start[other_top + 1] - 1]
    for lower in range(start[bottom + 1] - start[bottom] - 1):
        side = upper[start[bottom] + lower]
        upper[start[border] + side] = upper[start[other_top] + upper[start[other_bottom] + lower]]
    upper[start[border + 1] - 1] = upper[start[other_top] + upper[start[other_bottom + 1] - 1]]
