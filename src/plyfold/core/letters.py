"""Blank's word of a dual tree, in hot loops. See `immersion.word`."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer
from plyfold.core.cell_tree import CellTree
from plyfold.core.numbers import Numbers

__all__ = ["Letters", "room_for_arcs", "room_for_letters"]

_NONE = -1
# A key of the table of potentials that is not taken.
_FREE = -2


class Letters:
    """The letters along the curve, after :meth:`walk` and :meth:`sort`.

    Attributes
    ----------
    labels : int
        How many there are.
    cells : buffer of int
        The cell below each label.
    border, label, block, minus, first, partner : buffer of int
        See `immersion.word.Word`.

    Notes
    -----
    Descending borders on the way from the root to a cell are kept by their potential: in a table, in chains that lead
    from each to the one before it.
    """

    def __init__(self) -> None:
        self.labels = self.n_plus = self.mask = self.n_arcs = 0
        self.plus = Numbers()

    def walk(self, tree: CellTree, wanted: WholeBuffer, room: WholeBuffer) -> int:
        """Walk the tree from the root, in planar order, over the cells that have an arc to draw behind them.

        Parameters
        ----------
        tree : CellTree
            Measured.
        wanted : buffer of int
            1 for cells whose ascending links are to be joined.
        room : buffer of int
            Room for :func:`room_for_arcs` numbers, and for letters.

        Returns
        -------
        int
            How many letters there are.
        """
        n, table = tree.cells, _size_of_table(tree.cells)
        self.tree, self.wanted, self.mask = tree, wanted, table - 1
        self.is_on_way, self.arc, self.last_arc = room[:n], room[n : 2 * n], room[2 * n : 3 * n]
        self.direction, self.potential, self.before = room[3 * n : 4 * n], room[4 * n : 5 * n], room[5 * n : 6 * n]
        self.cells, self.first, rest = room[6 * n : 7 * n], room[7 * n : 8 * n + 1], room[8 * n + 1 :]
        self.place, rest = rest[: tree.borders + 1], rest[tree.borders + 1 :]
        self.key, self.last, rest = rest[:table], rest[table : 2 * table], rest[2 * table :]
        self.plus.begin(rest, len(rest))
        self.labels = self.n_arcs = 0
        self._mark_ways()
        self._walk()
        self.first[self.labels] = self.n_plus = self.plus.size // 2
        return self.labels + self.n_plus

    def _mark_ways(self) -> None:
        """Mark the cells on the ways from those that are wanted to the root, and clear the table."""
        for cell in range(self.tree.cells):
            self.is_on_way[cell] = 0
        for slot in range(self.mask + 1):
            self.last[slot] = _FREE
        self.is_on_way[0], self.direction[0] = 1, 0
        for start in range(self.tree.cells):
            cell = start if self.wanted[start] and self.tree.ascends[start] else 0
            while self.is_on_way[cell] == 0:
                self.is_on_way[cell] = 1
                cell = self.tree.parent[cell]

    def _walk(self) -> None:
        cell = self._on_way(self.tree.first_child[0])
        while cell >= 0:
            self._enter(cell)
            further = self._on_way(self.tree.first_child[cell])
            while further < 0 and cell > 0:
                self._leave(cell)
                further = self._on_way(self.tree.next_sibling[cell])
                cell = self.tree.parent[cell]
            cell = further

    def _on_way(self, cell: int) -> int:
        """Return a cell or the first one of its later siblings that has an arc to draw behind it, or −1."""
        while cell >= 0 and self.is_on_way[cell] == 0:
            cell = self.tree.next_sibling[cell]
        return cell

    def _enter(self, cell: int) -> None:
        """Cross the link of a cell: note a descending border, or the letters of a label.

        An arc may end on a descending border y further out where the piece that the chord cuts off turns once: Φ, the
        direction of the curve less that of the arc, grows by 2 from e to y if y comes later along the curve, and
        shrinks by 2 if it comes earlier.
        """
        self.arc[cell] = self.n_arcs
        self.n_arcs += 1
        direction = self.direction[self.tree.parent[cell]] + self.tree.bend[cell]
        potential = self.tree.along[cell] - direction
        self.direction[cell], self.potential[cell] = direction, potential
        if self.tree.ascends[cell] == 0:
            slot = self._slot(potential)
            self.before[cell] = self.last[slot] if self.last[slot] != _FREE else _NONE
            self.key[slot], self.last[slot] = potential, cell
        elif self.wanted[cell]:
            self.cells[self.labels], self.first[self.labels] = cell, self.plus.size // 2
            self._join_to(self._slot(potential + 2), self.tree.link[cell], 1)
            self._join_to(self._slot(potential - 2), self.tree.link[cell], 0)
            self.labels += 1

    def _leave(self, cell: int) -> None:
        self.last_arc[cell] = self.n_arcs - 1
        if self.tree.ascends[cell] == 0:
            self.last[self._slot(self.potential[cell])] = self.before[cell]

    def _slot(self, potential: int) -> int:
        """Return where a potential is in the table, or where there is room for it."""
        slot = potential & self.mask
        while self.last[slot] != _FREE and self.key[slot] != potential:
            slot = (slot + 1) & self.mask
        return slot

    def _join_to(self, slot: int, border: int, is_later: int) -> None:
        """Note the borders of a chain that come later along the curve than a given one, or earlier."""
        cell = self.last[slot]
        while cell >= 0:
            outer = self.tree.link[cell]
            if (outer > border) == (is_later == 1):
                self.plus.append(outer)
                self.plus.append(self.labels)
            cell = self.before[cell]

    # ---- the letters in order ----------------------------------------------------------------------------------------

    def sort(self, room: WholeBuffer) -> None:
        """Sort the letters along the curve; ``room`` is for :func:`room_for_letters` numbers.

        On a descending border the curve meets the rightmost arc first, so the arcs behind come before the label's own:
        the later labels before the earlier ones.
        """
        labels, letters = self.labels, self.labels + self.n_plus
        self.border, self.label, self.block = (
            room[:letters],
            room[letters : 2 * letters],
            room[2 * letters : 3 * letters],
        )
        self.minus, self.next = room[3 * letters : 3 * letters + labels], self.potential
        self.partner = room[3 * letters + labels : 4 * letters]
        self._count_on_borders()
        for label in range(labels):
            border = self.tree.link[self.cells[label]]
            self.minus[label] = self.place[border]
            self._put(border, label)
            self.next[label] = self.first[label]
        for plus in range(self.n_plus - 1, -1, -1):
            self._put(self.plus.data[2 * plus], self.plus.data[2 * plus + 1])
        for letter in range(letters):
            self._find_block(letter, self.label[letter])

    def _count_on_borders(self) -> None:
        """Find the place of the first letter on each border."""
        for border in range(self.tree.borders + 1):
            self.place[border] = 0
        for label in range(self.labels):
            self.place[self.tree.link[self.cells[label]] + 1] += 1
        for plus in range(self.n_plus):
            self.place[self.plus.data[2 * plus] + 1] += 1
        for border in range(self.tree.borders):
            self.place[border + 1] += self.place[border]

    def _put(self, border: int, label: int) -> None:
        """Put a letter behind those before it on its border."""
        self.border[self.place[border]], self.label[self.place[border]] = border, label
        self.place[border] += 1

    def _find_block(self, letter: int, label: int) -> None:
        """Find the first letter of a block: those before it on its border whose arcs run behind its own belong to it.

        Blocks lie within each other, or apart.
        """
        self.block[letter] = letter
        if letter != self.minus[label]:
            first, last_arc = letter, self.last_arc[self.cells[label]]
            while (
                first > 0
                and self.border[first - 1] == self.border[letter]
                and self.arc[self.cells[self.label[first - 1]]] <= last_arc
            ):
                first = self.block[first - 1]
            self.block[letter] = first
            self.partner[self.next[label]] = letter
            self.next[label] += 1


def _size_of_table(cells: int) -> int:
    """Return a power of two that leaves half of a table free."""
    size = 2
    while size < 2 * cells:
        size *= 2
    return size


def room_for_arcs(cells: int, borders: int) -> int:
    """Return how many numbers :meth:`Letters.walk` takes room for, without letters."""
    return 8 * cells + borders + 2 + 2 * _size_of_table(cells)


def room_for_letters(letters: int) -> int:
    """Return how many numbers :meth:`Letters.sort` takes room for."""
    return 4 * letters
