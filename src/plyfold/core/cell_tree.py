"""The dual tree of a planar map, in hot loops. See `immersion.dual_tree`."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer
from plyfold.core.cells import root_of

__all__ = ["CellTree", "room_for_tree"]


class CellTree:
    """A spanning tree of the cells, rooted at the unbounded one, and the turning of arcs that run along it.

    Attributes
    ----------
    parent, link : buffer of int
        See `immersion.dual_tree.DualTree`. The other ones there are known after :meth:`measure`.
    ascends, along, turning, bend, first_child, next_sibling : buffer of int
        −1 where there is no child and no sibling.

    Examples
    --------
    A triangle:

    >>> from array import array
    >>> tree, room = CellTree(), memoryview(array("q", [0] * room_for_tree(2, 1)))
    >>> tree.begin(array("q", [1, 0]), array("q", [0, 1]), array("q", [0, 1]), room)
    >>> tree.flood(), tree.measure(), list(tree.parent), list(tree.turning)
    (None, None, [0, 0], [4])
    """

    def __init__(self) -> None:
        self.cells = self.borders = self.n_saddles = 0

    def begin(self, cell_of_dart: WholeBuffer, next_dart: WholeBuffer, winding: WholeBuffer, room: WholeBuffer) -> None:
        """Look at a planar map next.

        Parameters
        ----------
        cell_of_dart, next_dart, winding : buffer of int
            See `Arrangement`.
        room : buffer of int
            Room for :func:`room_for_tree` numbers.
        """
        n, borders = len(winding), len(cell_of_dart) // 2
        self.cells, self.borders = n, borders
        self.cell_of_dart, self.next_dart, self.winding = cell_of_dart, next_dart, winding
        self.parent, self.link, self.ascends = room[:n], room[n : 2 * n], room[2 * n : 3 * n]
        self.along, self.bend = room[3 * n : 4 * n], room[4 * n : 5 * n]
        self.first_child, self.next_sibling = room[5 * n : 6 * n], room[6 * n : 7 * n]
        self.turning, rest = room[7 * n : 7 * n + borders], room[7 * n + borders :]
        # What the flood needs is of no use afterwards.
        self.pit, self.joined, self.shore = rest[:n], rest[n : 2 * n], rest[2 * n : 3 * n]
        self.stack, self.saddle, self.next_shore = rest[3 * n : 4 * n], rest[4 * n : 5 * n], rest[5 * n : 7 * n]
        self.rising, self.between = rest[7 * n : 7 * n + borders], rest[7 * n + borders :]
        self.order, self.behind, self.is_listed = self.pit, self.joined, self.shore

    # ---- the tree: water rises, lake by lake, over the lowest saddles ------------------------------------------------

    def flood(self) -> None:
        """Let every cell drain into a lower one, and join the lakes over their lowest saddles.

        A cell that has a lower neighbour has it across a border with the cell on its left. Only the way from a pit up
        to its saddle ascends in the end.
        """
        for cell in range(self.cells):
            self.parent[cell], self.link[cell], self.pit[cell] = cell, -1, -1
        for border in range(self.borders):
            cell = self.cell_of_dart[2 * border]
            self.parent[cell], self.link[cell] = self.cell_of_dart[2 * border + 1], border
        for cell in range(self.cells):
            self._find_pit(cell)
        self._find_saddles()
        self._turn_to_root()

    def _find_pit(self, cell: int) -> None:
        """Find where a cell drains to in the end, and all cells on the way there."""
        size = 0
        while self.pit[cell] < 0 and self.parent[cell] != cell:
            self.stack[size] = cell
            cell, size = self.parent[cell], size + 1
        pit = cell if self.pit[cell] < 0 else self.pit[cell]
        self.pit[cell] = pit
        for place in range(size):
            self.pit[self.stack[place]] = pit

    def _find_saddles(self) -> None:
        """Find the borders of a minimal spanning tree of the lakes, the lowest first (Kruskal)."""
        for cell in range(self.cells):
            self.joined[cell], self.shore[cell] = cell, -1
        self.n_saddles = 0
        for place in range(self._sort_by_winding(self._find_borders_between())):
            border = self.rising[place]
            one = root_of(self.joined, self.pit[self.cell_of_dart[2 * border]])
            other = root_of(self.joined, self.pit[self.cell_of_dart[2 * border + 1]])
            if one != other:
                self.joined[one] = other
                self._note_saddle(border)

    def _find_borders_between(self) -> int:
        """Find the borders between lakes, and return how many there are."""
        size = 0
        for border in range(self.borders):
            if self.pit[self.cell_of_dart[2 * border]] != self.pit[self.cell_of_dart[2 * border + 1]]:
                self.between[size] = border
                size += 1
        return size

    def _sort_by_winding(self, size: int) -> int:
        """Sort the borders between lakes by the winding numbers of their left cells, by counting; return their number.

        A winding number lies no further from 0 than there are borders.
        """
        if size == 0:
            return 0
        low = high = self.winding[self.cell_of_dart[2 * self.between[0]]]
        for place in range(size):
            winding = self.winding[self.cell_of_dart[2 * self.between[place]]]
            low, high = min(low, winding), max(high, winding)
        count = self.between[size:]
        for number in range(high - low + 2):
            count[number] = 0
        for place in range(size):
            count[self.winding[self.cell_of_dart[2 * self.between[place]]] - low + 1] += 1
        for number in range(high - low + 1):
            count[number + 1] += count[number]
        for place in range(size):
            number = self.winding[self.cell_of_dart[2 * self.between[place]]] - low
            self.rising[count[number]] = self.between[place]
            count[number] += 1
        return size

    def _note_saddle(self, border: int) -> None:
        """Note a saddle at the lakes on both sides of it: entry 2 s is that of the lake on the left."""
        for side in range(2):
            lake = self.pit[self.cell_of_dart[2 * border + side]]
            entry = 2 * self.n_saddles + side
            self.next_shore[entry] = self.shore[lake]
            self.shore[lake] = entry
        self.saddle[self.n_saddles] = border
        self.n_saddles += 1

    def _turn_to_root(self) -> None:
        """Go from the lake of the unbounded cell over the saddles, and turn round the drains from there to the pits."""
        self._evert(0, 0, -1)
        self.stack[0], size = self.pit[0], 1
        self.joined[self.pit[0]] = -1
        while size > 0:
            size -= 1
            entry = self.shore[self.stack[size]]
            while entry >= 0:
                border, side = self.saddle[entry // 2], entry % 2
                cell = self.cell_of_dart[2 * border + 1 - side]
                if self.joined[self.pit[cell]] >= 0:
                    self._evert(cell, self.cell_of_dart[2 * border + side], border)
                    self.stack[size], size = self.pit[cell], size + 1
                    self.joined[self.pit[cell]] = -1
                entry = self.next_shore[entry]

    def _evert(self, cell: int, above: int, border: int) -> None:
        """Give a cell another parent, across a border, and turn round the way from there down to its pit."""
        below, next_border = self.parent[cell], self.link[cell]
        self.parent[cell], self.link[cell] = above, border
        while below != cell:
            above, border, cell = cell, next_border, below
            below, next_border = self.parent[cell], self.link[cell]
            self.parent[cell], self.link[cell] = above, border

    # ---- turnings ----------------------------------------------------------------------------------------------------

    def measure(self) -> None:
        """Measure the turning of the borders of one curve and of arcs along the tree."""
        self._sort_from_root()
        self._find_turnings()
        self.bend[0] = 0
        for cell in range(self.cells):
            self.first_child[cell] = self.next_sibling[cell] = -1
        for cell in range(self.cells):
            self._find_children(cell)

    def _sort_from_root(self) -> None:
        """List the cells, each after its parent, and see which links ascend."""
        for cell in range(self.cells):
            self.is_listed[cell] = 0
            self.ascends[cell] = 1 if self.winding[cell] < self.winding[self.parent[cell]] else 0
        self.order[0], self.is_listed[0] = 0, 1
        size = 1
        for start in range(1, self.cells):
            cell, top = start, 0
            while self.is_listed[cell] == 0:
                self.stack[top], self.is_listed[cell] = cell, 1
                cell, top = self.parent[cell], top + 1
            while top > 0:
                top -= 1
                self.order[size] = self.stack[top]
                size += 1

    def _find_turnings(self) -> None:
        """Find the turning of each border in quarter turns, as if every crossing were a right angle.

        Around a bounded cell the borders turn by 4 − corners. Borders off the tree are straight; one of the tree turns
        by the sum over all cells that the tree has behind it, since the turnings of the links among them cancel.
        """
        for cell in range(self.cells):
            self.behind[cell] = 4
        for border in range(self.borders):
            self.turning[border] = 0
        if self.borders > 1:
            for dart in range(2 * self.borders):
                self.behind[self.cell_of_dart[dart]] -= 1
        for place in range(self.cells - 1, 0, -1):
            cell = self.order[place]
            border, turn = self.link[cell], self.behind[cell]
            self.turning[border] = turn if self.cell_of_dart[2 * border] == cell else -turn
            self.behind[self.parent[cell]] += turn
        self.along[0], total = 0, 0
        for border in range(self.borders):
            for side in range(2):
                cell = self.cell_of_dart[2 * border + side]
                if self.link[cell] == border:
                    self.along[cell] = total
            total += self.turning[border]

    def _find_children(self, cell: int) -> None:
        """Walk round a cell from its link on, and note children in order, and how arcs bend on the way to the link.

        An arc that enters through a dart turned left of it by one quarter and leaves through the link one quarter
        right of it, so between the two it turns by the boundary's turning less 2. Arcs cross a border near its start:
        before its own turning if it is walked forward, after it otherwise.
        """
        exit_dart = self._exit_of(cell)
        dart, last = exit_dart, -1
        turned = self.turning[dart // 2] if dart % 2 == 1 else 0
        while dart >= 0:
            border, forward = dart // 2, 1 - dart % 2
            turn = self.turning[border] if forward else -self.turning[border]
            child = self.cell_of_dart[2 * border + forward]
            if self.link[child] == border and self.parent[child] == cell:
                if last < 0:
                    self.first_child[cell] = child
                else:
                    self.next_sibling[last] = child
                last = child
                self.bend[child] = 0 if cell == 0 else turned - 2 + (0 if forward else turn)
            turned += 1 + turn
            dart = self.next_dart[dart]
            if dart == exit_dart:
                dart = -1

    def _exit_of(self, cell: int) -> int:
        """Return the dart of a cell's link that has the cell on its left; of the root, its lowest dart."""
        dart = 2 * self.link[cell]
        if cell == 0:
            dart = 0
            while self.cell_of_dart[dart] != 0:
                dart += 1
        elif self.cell_of_dart[dart] != cell:
            dart += 1
        return dart


def room_for_tree(cells: int, borders: int) -> int:
    """Return how many numbers :class:`CellTree` takes room for."""
    return 14 * cells + 4 * borders + 3
