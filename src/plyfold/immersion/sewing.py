"""The immersion of a disk that a grouping describes: chords first, then crossing by crossing (§2.2 of the paper).

The sheets of a grouping are numbered along the dual tree: a cell behind a descending link has the sheets of its parent
in the same order and the link's own sheet as the last one; a cell behind an ascending link has them all but the
partner's. The borders off the tree follow, for at every crossing three gluings give the fourth.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.sewing import BorderSeams, Crossings, NamedTree, number_sheets, sew
from plyfold.immersion.corners import corners
from plyfold.immersion.dual_tree import DualTree
from plyfold.immersion.immersion import Immersion
from plyfold.ragged import starts_of

__all__ = ["glue_sheets"]


def glue_sheets(arrangement: Arrangement, tree: DualTree, partner: Ints) -> Immersion:
    """Build the immersion that a grouping describes.

    Parameters
    ----------
    arrangement : Arrangement
        Turning number 1, no negative winding number.
    tree : DualTree
        The tree whose word was grouped.
    partner : (borders,) int
        For the link of every ascending cell: the border through which its own sheet leaves the disk; −1 for others.

    Returns
    -------
    Immersion
        Cost: O(Σ w), the number of sheets counted once per border.
    """
    winding = arrangement.winding
    first_sheet, first_pair = starts_of(winding), np.append(0, np.cumsum(winding[arrangement.right_cell]))
    glued_to, own_sheet = np.empty(first_pair[-1], dtype=np.int32), np.empty(arrangement.n_borders, dtype=np.int64)
    seams = BorderSeams(*all_flat(first_pair, glued_to, own_sheet))
    sew(_tree(arrangement, tree, partner, first_sheet), _crossings(arrangement, tree), seams)
    number_sheets(seams, flat(first_sheet[arrangement.left_cell]))
    return Immersion(arrangement, own_sheet, glued_to)


def _tree(arrangement: Arrangement, tree: DualTree, partner: Ints, first_sheet: Ints) -> NamedTree:
    buffers = all_flat(tree.parent, tree.link, partner[tree.link], arrangement.winding, first_sheet)
    return NamedTree(int(arrangement.winding.sum()), *buffers)


def _crossings(arrangement: Arrangement, tree: DualTree) -> Crossings:
    around = corners(arrangement)
    at_start = np.zeros(arrangement.n_borders, dtype=np.int64)
    at_start[around[:, 1]] = at_start[around[:, 2]] = np.arange(len(around))
    off_tree = np.ones(arrangement.n_borders, dtype=np.int64)
    off_tree[tree.link[1:]] = 0
    unknown = off_tree[around]
    buffers = all_flat(
        around, at_start, at_start[arrangement.next_border], unknown.sum(axis=1), (around * unknown).sum(axis=1)
    )
    return Crossings(int(arrangement.winding.max()), *buffers)
