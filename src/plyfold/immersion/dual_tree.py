"""A spanning tree of the cells, rooted at the unbounded one, and the turning of arcs that run along it.

The tree replaces the rays of Blank's theorem [Bla67]_: from every *pit* an arc runs along the tree to the outside.
A link of the tree leads from a cell to its parent across one border. It **descends** if the parent's winding number
is lower and **ascends** if it is higher; an immersion is a choice of one sheet for every ascending link, so the tree
is grown to have few of them.

References
----------
.. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967;
   told by V. Poénaru, Séminaire Bourbaki 342, 1968.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass
from itertools import accumulate

from plyfold.arrangement import Arrangement

__all__ = ["DualTree", "grow_dual_tree"]


@dataclass(frozen=True, eq=False)
class DualTree:
    """The tree of cells, in plain Python lists indexed by cell (``potential`` by border).

    Parameters
    ----------
    parent : list of int
        Parent of each cell; the root, cell 0, is its own.
    link : list of int
        Border that the link to the parent crosses; −1 for the root.
    ascends : list of bool
        True if the parent's winding number is higher.
    preorder : list of int
        Cells numbered parents first and, around each cell, from left to right seen in the direction of its parent.
    size : list of int
        Number of cells in the subtree: those numbered ``preorder[c]`` to ``preorder[c] + size[c] - 1``.
    order : list of int
        The cells sorted by ``preorder``.
    potential : list of int
        Φ of each border of the tree: the direction of the curve minus that of an outgoing arc, in quarter turns.
        Only differences along one path to the root have a meaning.
    """

    parent: list[int]
    link: list[int]
    ascends: list[bool]
    preorder: list[int]
    size: list[int]
    order: list[int]
    potential: list[int]

    def path(self, cell: int) -> list[int]:
        """Return the cells from a cell towards the root, the root left out."""
        cells = []
        while cell != 0:
            cells.append(cell)
            cell = self.parent[cell]
        return cells


def grow_dual_tree(arrangement: Arrangement) -> DualTree:
    """Grow the tree, number it in planar order and solve for the potentials. Cost: O(k log k)."""
    parent, link, reached = _flood(arrangement)
    turning = _border_turnings(arrangement, link, reached)
    order, direction = _walk(arrangement, parent, link, turning)
    preorder = _inverse(order)
    winding = arrangement.winding.tolist()
    along_curve = accumulate(turning[:-1], initial=0)
    return DualTree(
        parent=parent,
        link=link,
        ascends=[winding[cell] < winding[parent[cell]] for cell in range(len(parent))],
        preorder=preorder,
        size=_subtree_sizes(order, parent),
        order=order,
        potential=[theta - psi for theta, psi in zip(along_curve, direction, strict=True)],
    )


def _flood(arrangement: Arrangement) -> tuple[list[int], list[int], list[int]]:
    """Return parent and link of each cell, and the cells in the order reached.

    Higher neighbours are free and taken at once; when there are none left, the lowest reachable cell costs one
    ascending link. So only pits, and the way up from each to its saddle, ascend.
    """
    winding, cell_of = arrangement.winding.tolist(), arrangement.cell_of_dart.tolist()
    parent, link = [0] * len(winding), [-1] * len(winding)
    reached: list[int] = []
    known = [False] * len(winding)
    waiting = [(0, -1, 0, 0)]
    while waiting:
        _, border, cell, source = heapq.heappop(waiting)
        if known[cell]:
            continue
        known[cell], parent[cell], link[cell] = True, source, border
        reached.append(cell)
        for dart in arrangement.cells[cell]:
            neighbour = cell_of[dart ^ 1]
            if not known[neighbour]:
                # A higher neighbour comes before everything else: its key is below every winding number.
                key = -len(winding) if winding[neighbour] > winding[cell] else winding[neighbour]
                heapq.heappush(waiting, (key, dart // 2, neighbour, cell))
    return parent, link, reached


def _border_turnings(arrangement: Arrangement, link: list[int], reached: list[int]) -> list[int]:
    """Return the turning of each border in quarter turns, as if every crossing were a right angle.

    Around a bounded cell the borders turn by 4 − corners. Borders off the tree are straight; those of the tree
    follow from the leaves.
    """
    turning = [0] * arrangement.n_borders
    left = arrangement.left_cell.tolist()
    for cell in reversed(reached[1:]):
        darts = arrangement.cells[cell]
        corners = len(darts) if arrangement.n_crossings else 0
        known = sum(-turning[dart // 2] if dart % 2 else turning[dart // 2] for dart in darts)
        missing = 4 - corners - known
        turning[link[cell]] = missing if left[link[cell]] == cell else -missing
    return turning


def _walk(
    arrangement: Arrangement, parent: list[int], link: list[int], turning: list[int]
) -> tuple[list[int], list[int]]:
    """Walk the tree parents first, children from left to right; return the order and each link's direction.

    The direction is that of an outgoing arc where it crosses the border, in quarter turns; see ``_children``.
    """
    cell_of = arrangement.cell_of_dart.tolist()
    direction = [0] * arrangement.n_borders
    order: list[int] = []
    stack = [0]
    while stack:
        cell = stack.pop()
        order.append(cell)
        children = []
        for dart, turned in _around(arrangement, cell, link[cell], turning):
            child = cell_of[dart ^ 1]
            if parent[child] == cell and link[child] == dart // 2:
                direction[dart // 2] = direction[link[cell]] + turned - 2 if cell else 0
                children.append(child)
        stack.extend(reversed(children))
    return order, direction


def _around(arrangement: Arrangement, cell: int, start: int, turning: list[int]) -> list[tuple[int, int]]:
    """Return the darts around a cell from its link to the parent on, with the boundary's turning up to each.

    An arc that enters through a dart turned left of it by one quarter and leaves through the link one quarter
    right of it, so between the two it turns by the boundary's turning less 2. Arcs cross a border near its start,
    before its own turning.
    """
    darts = arrangement.cells[cell]
    first = next((i for i, dart in enumerate(darts) if dart // 2 == start), 0)
    result: list[tuple[int, int]] = []
    turned = 0
    for dart in darts[first:] + darts[:first]:
        backward = dart % 2
        turned -= turning[dart // 2] if backward and result else 0
        result.append((dart, turned))
        turned += 1 + (0 if backward else turning[dart // 2])
    return result


def _inverse(order: list[int]) -> list[int]:
    inverse = [0] * len(order)
    for position, cell in enumerate(order):
        inverse[cell] = position
    return inverse


def _subtree_sizes(order: list[int], parent: list[int]) -> list[int]:
    size = [1] * len(order)
    for cell in reversed(order[1:]):
        size[parent[cell]] += size[cell]
    return size
