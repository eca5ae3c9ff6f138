"""A spanning tree of the cells, rooted at the unbounded one, and the turning of arcs that run along it.

The tree replaces the rays of Blank's theorem [Bla67]_: from every *pit* an arc runs along the tree to the outside.
A link of the tree leads from a cell to its parent across one border. It **descends** if the parent's winding number
is lower and **ascends** if it is higher. An immersion is a choice of one sheet for every ascending link, so the tree
is grown to have few of them: as water rises, lake by lake, over the lowest saddles.

References
----------
.. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967;
   told by V. Poénaru, Séminaire Bourbaki 342, 1968.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Ints, freeze
from plyfold.core.buffers import all_flat
from plyfold.core.cell_tree import CellTree, room_for_tree

__all__ = ["DualTree", "around_cells", "grow_dual_tree", "grow_tree"]


@dataclass(frozen=True, eq=False)
class DualTree:
    """The tree of cells; all arrays but one are indexed by cell.

    Parameters
    ----------
    cell_tree : CellTree
        The same for hot loops, with the children of each cell in order.
    parent : (cells,) int
        Parent of each cell; the root, cell 0, is its own.
    link : (cells,) int
        Border that the link to the parent crosses; −1 for the root.
    ascends : (cells,) bool
        True if the parent's winding number is higher.
    along : (cells,) int
        Θ: the direction of the curve at the link's border, in quarter turns since the start of the curve.
    turning : (borders,) int
        By how many quarter turns each border turns, as if every crossing were a right angle. Of the many solutions one
        in which borders off the tree are straight.
    bend : (cells,) int
        By how much an outgoing arc turns in the parent, from this link to the parent's own, in quarter turns, counted
        inward; 0 for children of the root.
    """

    cell_tree: CellTree
    parent: Ints
    link: Ints
    ascends: Bools
    along: Ints
    turning: Ints
    bend: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def ascending_cells(self) -> list[int]:
        """Return the cells whose link to the parent ascends."""
        cells: list[int] = np.flatnonzero(self.ascends).tolist()
        return cells


def grow_tree(arrangement: Arrangement) -> tuple[Ints, Ints]:
    """Grow the tree alone, for an outline of any kind: return the parent of each cell and the link to it."""
    tree = _flooded(arrangement)
    return np.array(tree.parent), np.array(tree.link)


def grow_dual_tree(arrangement: Arrangement) -> DualTree:
    """Grow the tree and measure the turning of curve and arcs. Cost: O(k)."""
    tree = _flooded(arrangement)
    tree.measure()
    return DualTree(
        cell_tree=tree,
        parent=np.asarray(tree.parent),
        link=np.asarray(tree.link),
        ascends=np.asarray(tree.ascends) != 0,
        along=np.asarray(tree.along),
        turning=np.asarray(tree.turning),
        bend=np.asarray(tree.bend),
    )


def _flooded(arrangement: Arrangement) -> CellTree:
    tree, winding = CellTree(), arrangement.winding
    room = np.empty(room_for_tree(arrangement.n_cells, arrangement.n_borders), dtype=np.int64)
    tree.begin(*all_flat(arrangement.cell_of_dart, arrangement.next_dart, winding, room))
    tree.flood()
    return tree


def around_cells(arrangement: Arrangement, turning: Ints) -> tuple[Ints, Ints]:
    """Return for each dart its position in its cell, and the boundary's turning up to it, corners included."""
    darts, start = arrangement.cell_darts, arrangement.cell_start
    cell = arrangement.cell_of_dart[darts]
    step = 1 + np.where(darts % 2 == 1, -1, 1) * turning[darts // 2]
    total = np.cumsum(step) - step
    position, since_start = np.empty_like(darts), np.empty_like(darts)
    position[darts] = np.arange(len(darts)) - start[cell]
    since_start[darts] = total - total[start[cell]]
    return position, since_start
