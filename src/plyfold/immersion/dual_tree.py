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

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat
from plyfold.core.cells import join_lakes, sum_down
from plyfold.graphs import end_of_path

__all__ = ["DualTree", "around_cells", "grow_dual_tree", "grow_tree"]


@dataclass(frozen=True, eq=False)
class DualTree:
    """The tree of cells; all arrays are indexed by cell.

    Parameters
    ----------
    parent : (cells,) int
        Parent of each cell; the root, cell 0, is its own.
    link : (cells,) int
        Border that the link to the parent crosses; −1 for the root.
    ascends : (cells,) bool
        True if the parent's winding number is higher.
    place : (cells,) int
        Where the link leaves the boundary of the parent: darts counted from the parent's own link on, with the parent
        on the left. Siblings in this order are siblings from left to right, seen outward.
    along : (cells,) int
        Θ: the direction of the curve at the link's border, in quarter turns since the start of the curve.
    turning : (borders,) int
        By how many quarter turns each border turns, as if every crossing were a right angle. Of the many solutions one
        in which borders off the tree are straight.
    bend : (cells,) int
        By how much an outgoing arc turns in the parent, from this link to the parent's own, in quarter turns, counted
        inward; 0 for children of the root.
    """

    parent: Ints
    link: Ints
    ascends: np.ndarray[tuple[int], np.dtype[np.bool_]]
    place: Ints
    along: Ints
    turning: Ints
    bend: Ints

    def ascending_cells(self) -> list[int]:
        """Return the cells whose link to the parent ascends."""
        cells: list[int] = np.flatnonzero(self.ascends).tolist()
        return cells

    @cached_property
    def all_ways(self) -> dict[int, list[int]]:
        """The ways from all ascending links to the root; see :meth:`ways`."""
        return self.ways(self.ascending_cells())

    def ways(self, cells: Iterable[int]) -> dict[int, list[int]]:
        """Return the part of the tree on the ways from some cells to the root: children by parent, right to left."""
        parent = self.parent.tolist()
        on_the_way = {0}
        for start in cells:
            cell = start
            while cell not in on_the_way:
                on_the_way.add(cell)
                cell = parent[cell]
        on_the_way.discard(0)
        children: dict[int, list[int]] = {}
        for cell in sorted(on_the_way, key=self.place.tolist().__getitem__, reverse=True):
            children.setdefault(parent[cell], []).append(cell)
        return children


def grow_tree(arrangement: Arrangement) -> tuple[Ints, Ints]:
    """Grow the tree alone, for an outline of any kind: return the parent of each cell and the link to it."""
    lakes = _flood(arrangement)
    return lakes.parent, lakes.link


def grow_dual_tree(arrangement: Arrangement) -> DualTree:
    """Grow the tree and measure the turning of curve and arcs. Cost: O(k log k)."""
    lakes = _flood(arrangement)
    turning = _border_turnings(arrangement, lakes)
    link_dart = _dart_inside(arrangement, lakes.link)
    entry_dart = link_dart ^ 1
    place, bend = _bends(arrangement, lakes, turning, link_dart, entry_dart)
    theta = np.cumsum(turning) - turning
    return DualTree(
        parent=lakes.parent,
        link=lakes.link,
        ascends=arrangement.winding < arrangement.winding[lakes.parent],
        place=place,
        along=theta[lakes.link],
        turning=turning,
        bend=bend,
    )


@dataclass(frozen=True, eq=False)
class _Lakes:
    """Cells grouped by the pit to which they drain, and the tree over the saddles between the lakes.

    ``drain`` and ``drain_link`` lead from each cell to a lower one (from a pit to itself, −1); ``pit`` is where that
    ends. ``saddles`` has one row (cell, cell beyond, border) for every lake but the root's, each lake after the one
    beyond it: ``cell`` is the lake's cell at its saddle. ``parent`` and ``link`` are the tree: the drains, turned round
    between every pit and its saddle.
    """

    drain: Ints
    drain_link: Ints
    pit: Ints
    saddles: list[tuple[int, int, int]]
    parent: Ints
    link: Ints


def _flood(arrangement: Arrangement) -> _Lakes:
    """Let every cell drain into a lower one, and join the lakes over their lowest saddles.

    A cell that has a lower neighbour has it across a border with the cell on its left. Only the way from a pit up to
    its saddle ascends in the end.
    """
    left, right = arrangement.left_cell, arrangement.right_cell
    link = np.full(arrangement.n_cells, -1)
    link[left] = np.arange(arrangement.n_borders)
    drain = np.where(link >= 0, right[link], np.arange(arrangement.n_cells))
    pit = end_of_path(drain)
    saddles = _join_lakes(arrangement, pit)
    parent, tree_link = drain.copy(), link.copy()
    turned: list[int] = []
    above: list[int] = []
    for cell, beyond, _ in [(0, 0, -1), *saddles]:
        way = [cell, *_drains(drain, cell)]
        turned += way
        above += [beyond, *way[:-1]]
    parent[turned], tree_link[turned] = above, link[above]
    tree_link[[0, *(cell for cell, _, _ in saddles)]] = [-1, *(border for _, _, border in saddles)]
    return _Lakes(drain, link, pit, saddles, parent, tree_link)


def _drains(drain: Ints, cell: int) -> Iterator[int]:
    """Yield the cells below a cell, down to its pit."""
    while drain[cell] != cell:
        cell = int(drain[cell])
        yield cell


def _join_lakes(arrangement: Arrangement, pit: Ints) -> list[tuple[int, int, int]]:
    """Return the saddles of a minimal spanning tree of the lakes, from the lake of the unbounded cell outward."""
    left, right = arrangement.left_cell, arrangement.right_cell
    between = np.flatnonzero(pit[left] != pit[right])
    rising = between[np.argsort(arrangement.winding[left[between]], kind="stable")]
    joins, joined = np.zeros(len(rising), dtype=np.int64), np.arange(arrangement.n_cells)
    join_lakes(*all_flat(pit[left[rising]], pit[right[rising]], joined, joins))
    saddles = rising[np.flatnonzero(joins)]
    columns = (saddles, left[saddles], right[saddles], pit[left[saddles]], pit[right[saddles]])
    shores: dict[int, list[tuple[int, int, int, int]]] = {}
    for border, cell, other, lake, other_lake in zip(*(column.tolist() for column in columns), strict=True):
        shores.setdefault(lake, []).append((border, cell, other, other_lake))
        shores.setdefault(other_lake, []).append((border, other, cell, lake))
    return list(_from_root(shores, int(pit[0])))


def _from_root(shores: dict[int, list[tuple[int, int, int, int]]], root: int) -> Iterator[tuple[int, int, int]]:
    """Yield a saddle (cell, cell beyond, border) for each lake, once the lake beyond is reached."""
    reached, waiting = {root}, [root]
    while waiting:
        for border, beyond, cell, lake in shores.get(waiting.pop(), ()):
            if lake not in reached:
                reached.add(lake)
                waiting.append(lake)
                yield cell, beyond, border


def _dart_inside(arrangement: Arrangement, link: Ints) -> Ints:
    """Return the dart of each cell's link that has the cell on its left."""
    forward = arrangement.left_cell[link] == np.arange(len(link))
    return np.asarray(2 * link + ~forward)


def _border_turnings(arrangement: Arrangement, lakes: _Lakes) -> Ints:
    """Return the turning of each border in quarter turns, as if every crossing were a right angle.

    Around a bounded cell the borders turn by 4 − corners. Borders off the tree are straight; one of the tree turns by
    the sum over all cells that the tree has behind it, since the turnings of the links among them cancel.
    """
    corners = np.bincount(arrangement.cell_of_dart) if arrangement.n_crossings else 0
    behind = _sums_behind(arrangement, lakes, 4 - corners + np.zeros(arrangement.n_cells, dtype=np.int64))
    turning = np.zeros(arrangement.n_borders, dtype=np.int64)
    forward = arrangement.left_cell[lakes.link[1:]] == np.arange(1, arrangement.n_cells)
    turning[lakes.link[1:]] = np.where(forward, behind[1:], -behind[1:])
    return turning


def _sums_behind(arrangement: Arrangement, lakes: _Lakes, value: Ints) -> Ints:
    """Return the sum of the values over the subtree of each cell.

    Down the drains level by level; the cells between a pit and its saddle have behind them the whole lake, and all
    lakes beyond, except what is behind the next cell up.
    """
    lake_sum = np.zeros(arrangement.n_cells, dtype=np.int64)
    np.add.at(lake_sum, lakes.pit, value)
    behind = value.copy()
    for cell, beyond, _ in reversed(lakes.saddles):
        whole = lake_sum[lakes.pit[cell]]
        lake_sum[lakes.pit[beyond]] += whole
        behind[beyond] += whole
    _sum_down_the_drains(arrangement, lakes, behind)
    for cell, _, _ in [*lakes.saddles, (0, 0, -1)]:
        above = 0
        for inner in [cell, *_drains(lakes.drain, cell)]:
            behind[inner], above = lake_sum[lakes.pit[cell]] - above, behind[inner]
    return behind


def _sum_down_the_drains(arrangement: Arrangement, lakes: _Lakes, behind: Ints) -> None:
    """Add to every cell, in place, what drains into it; a cell drains into one with winding number one lower."""
    highest_first = np.argsort(-arrangement.winding, kind="stable")
    sum_down(*all_flat(highest_first, lakes.drain, behind))


def _bends(
    arrangement: Arrangement, lakes: _Lakes, turning: Ints, link_dart: Ints, entry_dart: Ints
) -> tuple[Ints, Ints]:
    """Return where each link leaves the boundary of its parent, and how an arc bends from there to the parent's link.

    An arc that enters through a dart turned left of it by one quarter and leaves through the link one quarter right
    of it, so between the two it turns by the boundary's turning less 2. Arcs cross a border near its start: before its
    own turning if it is walked forward, after it otherwise.
    """
    position, since_start = around_cells(arrangement, turning)
    size = np.diff(arrangement.cell_start)[lakes.parent]
    exit_dart = link_dart[lakes.parent]
    backward = np.arange(2 * arrangement.n_borders) % 2 == 1
    crossed_at = since_start - np.where(backward, np.repeat(turning, 2), 0)
    place = position[entry_dart] - position[exit_dart]
    bend = crossed_at[entry_dart] - crossed_at[exit_dart] + np.where(place < 0, 4, 0) - 2
    at_root = lakes.parent == 0
    return np.where(at_root, position[entry_dart], place % size), np.where(at_root, 0, bend)


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
