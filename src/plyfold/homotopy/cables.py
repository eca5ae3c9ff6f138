"""The word of a closed curve: the cables that it crosses, from every cell to the outside.

A tree of the cells, rooted at the unbounded one, carries a cable from each bounded cell along its links to the root;
cables on one link run side by side in planar order. Where the curve crosses a link it crosses all its cables, in the
order of the tree with the cell on its left, and in the other one with it on its right ([Nie14]_, [CW13]_).

References
----------
.. [CW13] E. W. Chambers, Y. Wang, "Measuring similarity between curves on 2-manifolds via homotopy area", Symposium on
   Computational Geometry, 2013.
.. [Nie14] Z. Nie, "On the minimum area of null homotopies of curves traced twice", arXiv:1412.0101, 2014.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Ints, freeze
from plyfold.immersion.dual_tree import grow_tree
from plyfold.ragged import count_each

__all__ = ["Cables", "lay_cables"]


@dataclass(frozen=True, eq=False)
class Cables:
    """A tree of the cells with its cables, and the letters that the curve reads where it crosses them.

    Cells are taken in the order of a walk through the tree, each with all that hangs on it behind it.

    Parameters
    ----------
    n_borders : int
        How many the curve has.
    walk : (cells,) int
        The cells in this order; the unbounded one is the first.
    link : (cells,) int
        The border that leads from each of them to its parent; −1 for the first.
    behind : (cells,) int
        Where in the order the cells that hang on each of them end.
    is_left : (cells,) bool
        Whether the curve has the cell on its left at that border.
    border : (letters,) int
        The border at which each letter is read, in the order of the curve.
    label : (letters,) int
        The cell of each letter, by its place in the order. Cells whose cable is crossed in one direction alone have
        none: such letters cancel nothing.
    is_plus : (letters,) bool
        Whether the curve has that cell on its left.
    """

    n_borders: int
    walk: Ints
    link: Ints
    behind: Ints
    is_left: Bools
    border: Ints
    label: Ints
    is_plus: Bools

    def __post_init__(self) -> None:
        freeze(self)

    @cached_property
    def places_of_borders(self) -> Ints:
        """The place in the order of the cell that each border leads from to its parent; −1 for those off the tree."""
        places = np.full(self.n_borders, -1)
        places[self.link[1:]] = np.arange(1, len(self.link))
        return places

    @property
    def n_letters(self) -> int:
        """Number of letters."""
        return len(self.label)


def lay_cables(arranged: Arrangement) -> Cables:
    """Lay the cables of a curve: along a flooded tree or a tree of shortest ways, whichever is read in fewer letters.

    Cost: O(k), and the number of letters.
    """
    trees = [grow_tree(arranged)[1].tolist(), _links_of_shortest_ways(arranged)]
    laid = [_laid_along(arranged, link) for link in trees]
    return min(laid, key=lambda cables: cables.n_letters)


def _links_of_shortest_ways(arranged: Arrangement) -> list[int]:
    """Return the links of the tree in which all cells have as few borders as can be on their way out."""
    link = [-1] * arranged.n_cells
    across = arranged.cell_of_dart.tolist()
    reached, cells = {0}, arranged.cells
    queue = [0]
    for cell in queue:
        for dart in cells[cell]:
            other = across[dart ^ 1]
            if other not in reached:
                reached.add(other)
                link[other] = dart // 2
                queue.append(other)
    return link


def _laid_along(arranged: Arrangement, link: list[int]) -> Cables:
    """Return the cables along the tree with these links."""
    walk, behind = _walked(arranged, link)
    order = np.array(walk)
    links = np.array(link)[order]
    is_left = (links >= 0) & (arranged.left_cell[links] == order)
    return Cables(arranged.n_borders, order, links, behind, is_left, *_letters(links, behind, is_left))


def _walked(arranged: Arrangement, link: list[int]) -> tuple[list[int], Ints]:
    """Return the cells of a tree, each with its children clockwise from its link behind it, and where these end."""
    across, cells = arranged.cell_of_dart.tolist(), arranged.cells
    walk, stack, parent = [], [0], [0] * len(link)
    while stack:
        cell = stack.pop()
        walk.append(cell)
        darts = cells[cell]
        own = next((place for place, dart in enumerate(darts) if dart // 2 == link[cell]), 0)
        for dart in darts[own:] + darts[:own]:
            child = across[dart ^ 1]
            if link[child] == dart // 2 and child != cell and link[cell] != dart // 2:
                parent[child] = cell
                stack.append(child)
    size = [1] * len(link)
    for cell in reversed(walk[1:]):
        size[parent[cell]] += size[cell]
    return walk, np.arange(len(walk)) + np.array(size)[walk]


def _letters(link: Ints, behind: Ints, is_left: Bools) -> tuple[Ints, Ints, Bools]:
    """Return border, cell and direction of each letter along the curve."""
    labels = np.flatnonzero((_on_ways_out(behind, is_left) > 0) & (_on_ways_out(behind, ~is_left) > 0))
    crossed = np.argsort(link)[1:]
    first, last = np.searchsorted(labels, crossed), np.searchsorted(labels, behind[crossed])
    count = last - first
    plus = is_left[crossed].repeat(count)
    at = count_each(count)
    label = labels[np.where(plus, first.repeat(count) + at, last.repeat(count) - 1 - at)]
    return link[crossed].repeat(count), label, plus


def _on_ways_out(behind: Ints, counts: Bools) -> Ints:
    """Return how many links on the way from each cell to the root count."""
    change = np.zeros(len(behind) + 1, dtype=np.int64)
    change[:-1] += counts
    np.subtract.at(change, behind, counts.astype(np.int64))
    change[0] = 0
    return np.cumsum(change)[:-1]
