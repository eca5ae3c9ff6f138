"""Disks with flaps: immersed disks that lift if and only if a digraph can be coloured.

The *base* is a rectangle. From its lower side hang *handles*: a handle is a strip that leaves the base downward, turns
round a hole and comes back up over the base, where it widens into a *flap*, a rectangle of its own. A flap may *cover*
handles of other flaps: there it reaches down beyond the base, over the whole handle and its hole. Base and flaps all
lie over one common place, so a layering is one order of them, and a handle that flap i covers says what it may be.
Along the handle of j the strip begins as base and ends as flap j, always on the same side of flap i, so

    flap i does not lie between the base and flap j.

If i and j are on the same side of the base, j is the nearer one: flaps that cover each other's handles in a circle
cannot all be on one side. Conversely, if each of the two sides is free of circles, sort it. So the disk lifts if and
only if the digraph of covers (i to j if flap i covers the handle of flap j) has two colours without a one-coloured
directed cycle: its *dichromatic number* is at most two. Deciding that is NP-complete.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.errors import InputError
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.outline.curve import Curve

__all__ = ["PALEY", "FlapDisk", "flap_disk", "immersion_of_pieces"]

PALEY = tuple((i, (i + step) % 7) for i in range(7) for step in (1, 2, 4))
"""The Paley tournament on seven flaps. Without opposite arcs no smaller digraph needs more than two colours."""

# Handles are strips of width 2 round a hole of width 2.
STRIP = 2
HANDLE = 3 * STRIP

Corner = tuple[int, int]
Box = tuple[int, int, int, int]


@dataclass(frozen=True, eq=False)
class FlapDisk:
    """An immersed disk made of a base and flaps.

    Parameters
    ----------
    immersion : Immersion
        The disk. Its curve may bound other disks too; some of those may lift where this one does not.
    covers : tuple of frozenset of int
        For each flap the flaps whose handles it covers.
    piece_of_sheet : (sheets,) int
        What each sheet is part of: 0 the base, i + 1 flap i.

    Examples
    --------
    >>> from plyfold import find_layering
    >>> disk = flap_disk(3, [(0, 1), (1, 2), (2, 0)])
    >>> disk.immersion.arrangement.n_crossings, bool(find_layering(disk.immersion))
    (20, True)
    """

    immersion: Immersion
    covers: tuple[frozenset[int], ...]
    piece_of_sheet: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def curve(self) -> Curve:
        """The outline of the disk, with whole coordinates."""
        curve = self.immersion.arrangement.curve
        assert curve is not None
        return curve

    def sides(self, layering: Layering) -> tuple[bool, ...]:
        """Return for each flap whether a layering of the disk has it above the base.

        Parameters
        ----------
        layering : Layering
            Of this disk's immersion.

        Returns
        -------
        tuple of bool
            A colouring of the digraph of covers without one-coloured directed cycle. Cost: O(Σ w).

        Examples
        --------
        >>> from plyfold import find_layering
        >>> disk = flap_disk(2, [(0, 1), (1, 0)])
        >>> sum(disk.sides(find_layering(disk.immersion)))
        1
        """
        base_level = np.zeros(self.immersion.arrangement.n_cells, dtype=np.int64)
        base = self.piece_of_sheet == 0
        base_level[self.immersion.sheet_cell[base]] = layering.level[base]
        under = base_level[self.immersion.sheet_cell]
        above = set(self.piece_of_sheet[(under > 0) & (layering.level > under)].tolist())
        return tuple(flap + 1 in above for flap in range(len(self.covers)))


def flap_disk(flaps: int, arcs: Iterable[tuple[int, int]]) -> FlapDisk:
    """Return the disk with flaps that lifts if and only if two colours suffice for a digraph.

    Parameters
    ----------
    flaps : int
        Number of vertices, at least one. They hang from the base in this order; the disk has fewer crossings if
        neighbours in the digraph are close in it.
    arcs : iterable of (int, int)
        From the flap that covers a handle to the flap that the handle belongs to. Opposite arcs are allowed: the two
        flaps then lie on different sides.

    Returns
    -------
    FlapDisk
        It lifts if and only if the vertices can have two colours such that no directed cycle has only one colour.

    Raises
    ------
    InputError
        If there is no vertex, or an arc is a loop or leaves the range.

    Notes
    -----
    At most 6 crossings for each pair of flaps, 4 for each handle, and winding number ``flaps + 1``. Deciding
    whether an immersed disk lifts is NP-complete [EM09]_; here by way of acyclic colourings [BFJ04]_.

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.
    .. [BFJ04] D. Bokal, G. Fijavž, M. Juvan, P. M. Kayll, B. Mohar, "The circular chromatic number of a digraph",
       Journal of Graph Theory 46, 2004.

    Examples
    --------
    Three flaps that cover one another's handles: with two sides for three flaps there is no layering.

    >>> from plyfold import find_layering
    >>> both_ways = [(0, 1), (1, 0), (1, 2), (2, 1), (0, 2), (2, 0)]
    >>> print(find_layering(flap_disk(3, both_ways).immersion).reason)
    reversed pair
    """
    covers = _checked_covers(flaps, arcs)
    shapes = _shapes(covers)
    corners, piece_of_edge = _outline(shapes)
    arranged = arrange(corners, general_position="raise")
    over = _pieces_over_cells(arranged, [[_base_box(shapes), *_handles(shapes)], *(shape.boxes() for shape in shapes)])
    # A side of a handle turns into a side of the flap on the edge on which the border before the base's side ends.
    immersion = immersion_of_pieces(arranged, over, piece_of_edge[np.roll(arranged.visit_edge, -1)])
    return FlapDisk(immersion, covers, np.nonzero(over)[1])


def _checked_covers(flaps: int, arcs: Iterable[tuple[int, int]]) -> tuple[frozenset[int], ...]:
    if flaps < 1:
        raise InputError(f"a disk with {flaps} flaps has nothing to lift", hint="ask for at least one flap")
    covers: list[set[int]] = [set() for _ in range(flaps)]
    for i, j in arcs:
        if i == j or not (0 <= i < flaps and 0 <= j < flaps):
            raise InputError(f"({i}, {j}) is no arc between two of {flaps} flaps", hint="flaps are numbered from 0")
        covers[i].add(j)
    return tuple(map(frozenset, covers))


@dataclass(frozen=True)
class _Shape:
    """Where a handle hangs and how far its flap reaches; no two flaps share a low side, a top, or a reach.

    The handle hangs between x and x + 6, down to -6. The flap is the rectangle from (left, low) to (right, top), and
    round each handle it covers it leaves a margin as wide as its reach.
    """

    x: int
    left: int
    right: int
    low: int
    top: int
    reach: int
    covered_x: tuple[int, ...]

    def cover(self, x: int) -> Box:
        """Return the part that hangs down over the handle at x."""
        return x - self.reach, -HANDLE - self.reach, x + HANDLE + self.reach, self.low

    def boxes(self) -> list[Box]:
        entry = (self.x + HANDLE - STRIP, 0, self.x + HANDLE, self.low)
        return [(self.left, self.low, self.right, self.top), entry, *map(self.cover, self.covered_x)]

    def outline(self) -> list[Corner]:
        """Return the corners of the flap, from the right side of its handle, above the base's side, to the left one."""
        start, end = (self.x + HANDLE, 1), (self.x + HANDLE - STRIP, self.low)
        before = [corner for x in self.covered_x if x < self.x for corner in self._dip(x)]
        behind = [corner for x in self.covered_x if x > self.x for corner in self._dip(x)]
        low, high = self.low, self.top
        upper = [(self.right, low), (self.right, high), (self.left, high), (self.left, low)]
        corners = [start, (self.x + HANDLE, low), *behind, *upper, *before, end]
        return [corner for corner, _ in groupby(corners)]

    def _dip(self, x: int) -> list[Corner]:
        left, bottom, right, top = self.cover(x)
        return [(left, top), (left, bottom), (right, bottom), (right, top)]


def _shapes(covers: Sequence[frozenset[int]]) -> list[_Shape]:
    """Lay out the flaps: the wider ones reach further out on all sides, so that fewer outlines cross."""
    flaps = len(covers)
    spans = [(min(covered | {i}), max(covered | {i})) for i, covered in enumerate(covers)]
    by_width = sorted(range(flaps), key=lambda i: spans[i][0] - spans[i][1])
    pitch = HANDLE + 2 * (flaps + 1)
    shapes: dict[int, _Shape] = {}
    for rank, i in enumerate(by_width):
        reach = flaps - rank
        shapes[i] = _Shape(
            x=pitch * i,
            left=pitch * spans[i][0] - reach,
            right=pitch * spans[i][1] + HANDLE + reach,
            low=2 * (1 + rank),
            top=3 * flaps - rank,
            reach=reach,
            covered_x=tuple(pitch * j for j in sorted(covers[i])),
        )
    return [shapes[i] for i in range(flaps)]


def _base_box(shapes: Sequence[_Shape]) -> Box:
    margin = len(shapes) + 1
    return -margin, 0, shapes[-1].x + HANDLE + margin, 3 * len(shapes) + 1


def _handles(shapes: Sequence[_Shape]) -> list[Box]:
    """Return the three parts of each handle: down, along, and up to the base's side again."""
    bottom = -HANDLE
    return [
        box
        for x in (shape.x for shape in shapes)
        for box in (
            (x, bottom, x + STRIP, 0),
            (x, bottom, x + HANDLE, bottom + STRIP),
            (x + HANDLE - STRIP, bottom, x + HANDLE, 0),
        )
    ]


def _outline(shapes: Sequence[_Shape]) -> tuple[Floats, Ints]:
    """Return the corners of the whole disk, and the piece that the edge after each of them belongs to."""
    left, low, right, top = _base_box(shapes)
    parts: list[tuple[int, list[Corner]]] = [(0, [(left, top), (left, low)])]
    for flap, shape in enumerate(shapes):
        outer, inner = shape.x + HANDLE, shape.x + STRIP
        parts.append((0, [(shape.x, low), (shape.x, -HANDLE), (outer, -HANDLE)]))
        parts.append((flap + 1, shape.outline()))
        parts.append((0, [(outer - STRIP, -1), (outer - STRIP, STRIP - HANDLE), (inner, STRIP - HANDLE), (inner, low)]))
    parts.append((0, [(right, low), (right, top)]))
    corners = np.array([corner for _, part in parts for corner in part], dtype=np.float64)
    return corners, np.repeat([piece for piece, _ in parts], [len(part) for _, part in parts])


def _pieces_over_cells(arranged: Arrangement, pieces: Sequence[Sequence[Box]]) -> Bools:
    """Return whether each piece (column), given as boxes, lies over each cell (row)."""
    x, y = np.array([arranged.cell_point(cell) for cell in range(arranged.n_cells)]).T
    return np.stack([np.any([_inside(box, x, y) for box in boxes], axis=0) for boxes in pieces], axis=1)


def _inside(box: Box, x: Floats, y: Floats) -> Bools:
    left, low, right, top = box
    return (left <= x) & (x <= right) & (low <= y) & (y <= top)


# ---- the disk that is glued from pieces ------------------------------------------------------------------------------
#
# A curve may bound several immersed disks. Where it was drawn as the outline of one of them, that one is written down
# here without a search: the sheets over a cell are the polygons that contain it.


def immersion_of_pieces(arrangement: Arrangement, over: Bools, own_piece: Ints) -> Immersion:
    """Return the immersed disk that is glued from given pieces.

    Parameters
    ----------
    arrangement : Arrangement
        Of the outline of the disk as it was drawn, with at least one crossing.
    over : (cells, pieces) bool
        Whether each piece lies over each cell. Pieces do not overlap themselves, and are glued along borders of the
        arrangement, at most one to one other along each border.
    own_piece : (borders,) int
        The piece on the left of each border that has the border on the boundary of the disk.

    Returns
    -------
    Immersion
        It has been checked. The sheets over each cell are in order of the pieces they are part of: in all, in the order
        of ``np.nonzero(over)``.

    Raises
    ------
    PlyfoldError
        If the pieces do not make an immersed disk with this outline.

    Notes
    -----
    O(k · pieces).
    """
    sheet = np.cumsum(over).reshape(over.shape) - 1
    right, left = over[arrangement.right_cell], over[arrangement.left_cell]
    left[np.arange(arrangement.n_borders), own_piece] = False
    border, right_piece = np.nonzero(right)
    left_piece = _glued_pieces(right, left)[border, right_piece]
    immersion = Immersion(
        arrangement=arrangement,
        own_sheet=sheet[arrangement.left_cell, own_piece],
        glued_to=sheet[arrangement.left_cell[border], left_piece].astype(np.int32),
    )
    immersion.check()
    return immersion


def _glued_pieces(right: Bools, left: Bools) -> Ints:
    """Return the piece on the left that each piece (column) on the right of each border (row) goes on as.

    It is the piece itself, except at a seam, where one piece ends on the right and another begins on the left.
    """
    glued = np.tile(np.arange(right.shape[1]), (len(right), 1))
    ends, begins = right & ~left, left & ~right
    seam = np.flatnonzero(ends.any(axis=1))
    glued[seam, ends[seam].argmax(axis=1)] = begins[seam].argmax(axis=1)
    return glued
