"""The immersion of a disk that a grouping describes: chords first, then crossing by crossing (§2.2 of the paper).

The sheets of a grouping are numbered along the dual tree: a cell behind a descending link has the sheets of its parent
in the same order and the link's own sheet as the last one; a cell behind an ascending link has them all but the
partner's. The borders off the tree follow, for at every crossing three gluings give the fourth.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.compiled import called_from_loops, run_loop
from plyfold.immersion.corners import corners
from plyfold.immersion.dual_tree import DualTree
from plyfold.immersion.immersion import Immersion
from plyfold.ragged import starts_of

__all__ = ["glue_sheets"]


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
