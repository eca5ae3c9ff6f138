"""Sheets and their gluing, from the chords of a grouping.

Over a border the sheets of the lower cell (right) are glued one-to-one to sheets of the higher cell (left); the one
left over there is the border's own sheet, which has the border on the boundary of the disk.

Sheets are numbered along the dual tree: a cell behind a descending link has the sheets of its parent in the same order
and the link's own sheet as the last one; a cell behind an ascending link has them all but the partner's. The borders
off the tree follow, for at every crossing three gluings give the fourth.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain
from typing import TypeAlias

import numpy as np

from plyfold.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.immersion.dual_tree import DualTree
from plyfold.immersion.immersion import Immersion, count_each

__all__ = ["glue_sheets"]

# What happens over one border: the upper sheet that each lower sheet is glued to, and at the end the one left over.
# Sheets are counted from the first one of their cell.
# Tuples of numbers, unlike lists, cost the garbage collector nothing.
Seam: TypeAlias = tuple[int, ...]


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
    seams = _seams_on_tree(arrangement, tree, partner)
    _seams_off_tree(arrangement, seams)
    winding, lower = arrangement.winding, arrangement.winding[arrangement.right_cell]
    first_sheet = np.cumsum(winding) - winding
    flat = np.fromiter(chain.from_iterable(seams), dtype=np.int64, count=int(lower.sum()) + len(lower))
    flat += np.repeat(first_sheet[arrangement.left_cell], lower + 1)
    last = np.cumsum(lower + 1) - 1
    border = np.repeat(np.arange(arrangement.n_borders), lower)
    return Immersion(
        arrangement=arrangement,
        sheet_cell=np.repeat(np.arange(arrangement.n_cells), winding),
        first_sheet=first_sheet,
        own_sheet=flat[last],
        gluing=np.stack(
            [border, first_sheet[arrangement.right_cell[border]] + count_each(lower), np.delete(flat, last)], axis=1
        ),
    )


def _seams_on_tree(arrangement: Arrangement, tree: DualTree, partner: Mapping[int, int]) -> list[Seam]:
    """Return the seam of every link; of the other borders an empty one.

    A sheet's name is the border through which it leaves the disk when one walks along the tree to the outside. Names
    are needed on the ways to ascending links only: behind a descending one everything stays in order.
    """
    lower = arrangement.winding[arrangement.right_cell]
    straight = [tuple(range(sheets + 1)) for sheets in range(int(lower.max()) + 1)]
    on_tree = np.zeros(len(lower), dtype=bool)
    on_tree[tree.link[1:]] = True
    seams = [
        straight[sheets] if linked else () for sheets, linked in zip(lower.tolist(), on_tree.tolist(), strict=True)
    ]
    link, ascends = tree.link.tolist(), tree.ascends.tolist()
    children = tree.all_ways
    stack: list[tuple[int, tuple[int, ...]]] = [(0, ())]
    while stack:
        cell, above = stack.pop()
        for child in children.get(cell, ()):
            if ascends[child]:
                own = above.index(partner[link[child]])
                seams[link[child]] = (*range(own), *range(own + 1, len(above)), own)
                stack.append((child, above[:own] + above[own + 1 :]))
            else:
                stack.append((child, (*above, link[child])))
    return seams


def _seams_off_tree(arrangement: Arrangement, seams: list[Seam]) -> None:
    """Complete the seams, crossing by crossing: the borders off the dual tree form a tree of crossings.

    A crossing at which one seam is missing gives it to the crossing at the border's other end. ``missing`` is the sum
    of the borders without seam at each crossing, so where there is one, it is that one.
    """
    around = corners(arrangement)
    first, second = _end_crossings(arrangement, around)
    unknown = np.array([not seam for seam in seams])
    missing = np.where(unknown[around], around, 0).sum(axis=1).tolist()
    count = unknown[around].sum(axis=1)
    ready: list[int] = np.flatnonzero(count == 1).tolist()
    left: list[int] = count.tolist()
    borders: list[int] = around.ravel().tolist()
    while ready:
        crossing = ready.pop()
        if left[crossing] == 0:
            continue
        border = missing[crossing]
        seams[border] = _fourth_seam(seams, border, borders[4 * crossing : 4 * crossing + 4])
        for end in (first[border], second[border]):
            left[end] -= 1
            missing[end] -= border
            if left[end] == 1:
                ready.append(end)


def corners(arrangement: Arrangement) -> Ints:
    """Return for each crossing its borders: rows (a to top, a to bottom, b to top, b to bottom), shape (k, 4).

    Strand b crosses strand a from right to left; the top cell is left of both strands, the bottom cell right of
    both. So a comes along the top and leaves along the bottom, and b comes along the bottom and leaves along the top.
    """
    n = arrangement.n_borders
    a = np.flatnonzero(arrangement.ccw)
    b = arrangement.partner[a]
    return np.stack([(a - 1) % n, a, b, (b - 1) % n], axis=1)


def _end_crossings(arrangement: Arrangement, around: Ints) -> tuple[list[int], list[int]]:
    """Return the row of ``around`` at the start and at the end of each border."""
    at_visit = np.empty(arrangement.n_borders, dtype=np.int64)
    at_visit[around[:, 1]] = at_visit[around[:, 2]] = np.arange(len(around))
    return at_visit.tolist(), np.roll(at_visit, -1).tolist()


def _fourth_seam(seams: list[Seam], border: int, around: list[int]) -> Seam:
    """Return the missing one of the four seams around a crossing.

    Going from the bottom cell to the top one around either side is the same: b_top ∘ a_bottom = a_top ∘ b_bottom,
    and each strand has one own sheet on both sides of the crossing.
    """
    a_top, a_bottom, b_top, b_bottom = around
    if border == b_bottom:
        return _lower_seam(seams[a_bottom], seams[b_top], seams[a_top])
    if border == a_bottom:
        return _lower_seam(seams[b_bottom], seams[a_top], seams[b_top])
    if border == b_top:
        return _upper_seam(seams[a_bottom], seams[a_top], seams[b_bottom])
    return _upper_seam(seams[b_bottom], seams[b_top], seams[a_bottom])


def _lower_seam(bottom: Seam, top: Seam, other_top: Seam) -> Seam:
    """Return the seam below ``other_top``, given the way round the other side: ``bottom``, then ``top``."""
    lower_of = {upper: lower for lower, upper in enumerate(other_top)}
    # The last entries are the own sheets: that of ``top`` has one on the other side of the crossing as well.
    return (*[lower_of[top[side]] for side in bottom[:-1]], lower_of[top[-1]])


def _upper_seam(bottom: Seam, other_top: Seam, other_bottom: Seam) -> Seam:
    """Return the seam above ``bottom``, given the way round the other side: ``other_bottom``, then ``other_top``."""
    upper_of = [0] * len(other_top)
    upper_of[bottom[-1]] = other_top[-1]
    for side, low in zip(bottom[:-1], other_bottom[:-1], strict=True):
        upper_of[side] = other_top[low]
    upper_of[-1] = other_top[other_bottom[-1]]
    return tuple(upper_of)
