"""An immersed surface, mostly a disk: sheets over the cells, glued along the borders (§2.2 of the paper).

Over a border the sheets of the lower cell (right) are glued one-to-one to sheets of the higher cell (left); the one
left over there is the border's own sheet, which has the border on the boundary of the surface.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.as_given import given_windings
from plyfold.arrays import Ints, Shorts, freeze, read_only
from plyfold.core.buffers import all_flat
from plyfold.core.gluing import number_pieces
from plyfold.errors import InputError, NotImmersibleError, PlyfoldError
from plyfold.graphs import members_of
from plyfold.immersion.checks import as_glued, conditions
from plyfold.immersion.corners import sides
from plyfold.memory import require_memory
from plyfold.obstruction import Obstruction
from plyfold.ragged import starts_of
from plyfold.wording import counted

__all__ = [
    "Group",
    "Immersion",
    "Piece",
    "require_disk",
    "require_immersion",
    "require_memory_for_gluing",
]

# Bytes for each pair of glued sheets: the result, and what is there while it is made and checked.
_BYTES_PER_PAIR = 30


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
        The curves that are its boundary; of a surface that was cut where it touches itself, the loops of what is left.
    euler_characteristic : int
        The sum of their turning numbers, less the indices of their cusps.
    """

    loops: tuple[int, ...]
    euler_characteristic: int

    @property
    def genus(self) -> int:
        """Number of handles."""
        return (2 - len(self.loops) - self.euler_characteristic) // 2


@dataclass(frozen=True, eq=False)
class Immersion:
    """One way in which a piece of cloth can lie flat with an outline: a disk, or with holes and handles, or in pieces.

    Parameters
    ----------
    arrangement : Arrangement
        Crossings, borders and cells of the outline.
    own_sheet : (borders,) int
        The sheet on the left of each border that has the border on the boundary of the surface. Cell c has
        ``winding[c]`` sheets, numbered consecutively from ``first_sheet[c]``.
    glued_to : (pairs,) int
        For each border the sheets on its left that the sheets on its right are glued to, in order: see :attr:`gluing`,
        where they are the last column. In 32 bits.

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
    own_sheet: Ints
    glued_to: Shorts

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        windings = given_windings(self.arrangement)[1:]
        sheets, cells = counted(int(windings.sum()), "sheet"), counted(len(windings), "cell")
        places = f", touches itself in {counted(len(self.touches), 'place')}" if self.touches else ""
        return f"<Immersion: {sheets} over {cells}{places}>"

    def _repr_svg_(self) -> str | None:
        # The disk layout; what is no disk has none, and is shown as it lies over the drawing.
        from plyfold.draw.svg import layout_svg

        return layout_svg(self) if self.is_disk else None

    def _repr_png_(self) -> bytes | None:
        from plyfold.draw.notebook import immersion_png

        return None if self.is_disk or self.arrangement.outline is None else immersion_png(self)

    @property
    def n_sheets(self) -> int:
        """Number of sheets: the winding numbers of all cells of the arrangement added up.

        Where an outline touches itself, that counts cells which only its moves have opened; ``repr`` does not.
        """
        return int(self.arrangement.winding.sum())

    @cached_property
    def first_sheet(self) -> Ints:
        """The number of each cell's first sheet, shape (cells,)."""
        return read_only(starts_of(self.arrangement.winding))

    @cached_property
    def sheet_cell(self) -> Ints:
        """The cell below each sheet, shape (sheets,)."""
        return read_only(np.repeat(np.arange(self.arrangement.n_cells), self.arrangement.winding))

    @cached_property
    def first_pair(self) -> Ints:
        """Where the pairs of each border, and then of each bridge, start in ``glued_to``, and where the last end."""
        _, right = sides(self.arrangement)
        return read_only(np.append(0, np.cumsum(self.arrangement.winding[right])))

    @cached_property
    def gluing(self) -> Ints:
        """Rows (border, sheet on its right, sheet on its left): two sheets glued along a border; shape (pairs, 3).

        Every sheet on the right occurs once per border, in order, and every sheet on the left except the border's own.
        Bridge j counts as border n_borders + j: it has no own sheet, and right and left are as seen from its first
        foot. They are made when they are first asked for.
        """
        _, right = sides(self.arrangement)
        gluing = np.empty((len(self.glued_to), 3), dtype=np.int64)
        gluing[:, 0] = np.repeat(np.arange(len(right)), np.diff(self.first_pair))
        gluing[:, 1] = np.arange(len(gluing)) + np.repeat(
            self.first_sheet[right] - self.first_pair[:-1], np.diff(self.first_pair)
        )
        gluing[:, 2] = self.glued_to
        return read_only(gluing)

    @cached_property
    def sheets(self) -> tuple[range, ...]:
        """The sheets over each cell, as ranges of numbers: ``sheets[c]`` has ``winding[c]`` of them."""
        return tuple(
            range(first, first + winding)
            for first, winding in zip(self.first_sheet.tolist(), self.arrangement.winding.tolist(), strict=True)
        )

    @property
    def euler_characteristic(self) -> int:
        """That of all :attr:`pieces` together: how often their boundaries turn, less the indices of their cusps."""
        return sum(piece.euler_characteristic for piece in self.pieces)

    @property
    def genus(self) -> int:
        """Number of handles, of all pieces together."""
        return sum(piece.genus for piece in self.pieces)

    @property
    def is_disk(self) -> bool:
        """Whether the surface is a disk, perhaps one that touches itself: one curve, with Euler characteristic 1."""
        return self.arrangement.n_loops == 1 == self.arrangement.euler_characteristic

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The connected pieces, in the order of their first loops: those of meshes and triangles.

        A surface that touches itself is cut there, and its loops are those of what is left, in the order in which the
        outline comes to them; otherwise they are the curves. Cost: that of :func:`~plyfold.triangulate` where the
        outline has contacts, and O(Σ w) without.

        Examples
        --------
        >>> from plyfold import find_immersion
        >>> two_triangles = find_immersion([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)])
        >>> two_triangles.pieces
        (Piece(loops=(0,), euler_characteristic=1), Piece(loops=(1,), euler_characteristic=1))
        >>> two_triangles.uncut_pieces, two_triangles.is_disk
        ((Piece(loops=(0,), euler_characteristic=1),), True)
        """
        return self._left[1]

    @cached_property
    def uncut_pieces(self) -> tuple[Piece, ...]:
        """The connected pieces before the surface is cut where it touches itself; each curve bounds one of them.

        In the order of their first curves. What these are together is what the outline bounds, if only as a limit.
        Cost: O(Σ w).
        """
        turns, loops_of = self.arrangement.loop_characteristics.tolist(), members_of(self.piece_of_loop)
        return tuple(Piece(tuple(loops), sum(turns[loop] for loop in loops)) for loops in loops_of.values())

    @property
    def piece_of_loop(self) -> Ints:
        """The number of the piece that each curve bounds."""
        if self.arrangement.n_loops == 1:  # no piece is without boundary
            return np.zeros(1, dtype=np.int64)
        first_border = np.searchsorted(self.arrangement.loop_of_border, np.arange(self.arrangement.n_loops))
        return self.piece_of_sheet[self.own_sheet[first_border]]

    @cached_property
    def piece_of_sheet(self) -> Ints:
        """The number of the connected piece that each sheet belongs to."""
        joined, piece = np.empty((2, self.n_sheets), dtype=np.int64)
        number_pieces(as_glued(self), *all_flat(joined, piece))
        return piece

    @property
    def touches(self) -> tuple[tuple[float, float], ...]:
        """Where the surface touches itself, for it has no width there; none mostly.

        Then the outline as given bounds no such surface in the strict sense, but is a limit of outlines that do.

        Examples
        --------
        >>> from plyfold import find_immersion
        >>> find_immersion([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]).touches
        ((1.0, 1.0),)
        """
        return self._left[0]

    @cached_property
    def _left(self) -> tuple[tuple[tuple[float, float], ...], tuple[Piece, ...]]:
        """Where the surface is cut, and the pieces that are left."""
        if self.arrangement.given is self.arrangement.outline:
            return (), self.uncut_pieces
        from plyfold.flat.settle import what_is_left

        touches, pieces = what_is_left(self)
        return touches, pieces if touches else self.uncut_pieces

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
        borders_of = members_of(self.own_sheet)
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
        for condition, holds in conditions(self):
            if not holds:
                raise PlyfoldError(f"internal check failed: {condition}")


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
        curves = counted(immersion.arrangement.n_loops, "boundary curve")
        characteristic = immersion.euler_characteristic
        raise InputError(
            f"this is there for disks alone, and the surface has {curves} and Euler characteristic {characteristic}"
        )
    return immersion
