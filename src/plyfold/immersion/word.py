"""Blank's word of a curve: who may be joined to whom (§2.3 of the paper; [Bla67]_).

Every ascending link e of the dual tree needs a partner: a descending border y further out on the way to the
unbounded cell, through which the sheet that lies above e leaves the disk. The pair is a chord of the disk from border
e to border y. The word lists the possible ends of chords in order along the curve:

* a **minus letter** on each ascending border, to be joined;
* a **plus letter** on each border that it may be joined to, taken or left free.

A chord must cut off a piece of turning number 1, which leaves few partners to choose from. The arcs behind a chord's
own cell run along with it, so on the border y a chord occupies not only its own plus letter but also those of the
links behind it: the *block* of the letter.

References
----------
.. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Ints, freeze
from plyfold.immersion.dual_tree import DualTree

__all__ = ["Word", "write_word"]


@dataclass(frozen=True, eq=False)
class Word:
    """The letters along the curve.

    Parameters
    ----------
    cells : (labels,) int
        The cell below each label: labels are numbered 0, 1, …
    border : (letters,) int
        The border of each letter.
    label : (letters,) int
        The label of each letter.
    minus : (labels,) int
        The minus letter of each label.
    first_partner : (labels + 1,) int
        Where the plus letters of each label start in ``partner``, and where the last ones end.
    partner : (letters − labels,) int
        The plus letters of each label in order: where its chord may end.
    block : (letters,) int
        For a plus letter the first letter of its block, which ends with itself; for a minus letter itself.
    """

    cells: Ints
    border: Ints
    label: Ints
    minus: Ints
    first_partner: Ints
    partner: Ints
    block: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def __len__(self) -> int:
        return len(self.border)

    def partners_of(self, label: int) -> Ints:
        """Return the plus letters of a label in order."""
        return self.partner[self.first_partner[label] : self.first_partner[label + 1]]


@dataclass(frozen=True, eq=False)
class _Arcs:
    """The arcs of some cells: their order across a shared link, those that run behind, and where they may end."""

    order: dict[int, int]
    last_behind: dict[int, int]
    ends: list[tuple[int, list[int]]]


def write_word(tree: DualTree, cells: Iterable[int] | None = None) -> Word:
    """Write the word of a dual tree.

    Parameters
    ----------
    tree : DualTree
    cells : iterable of int, optional
        Cells whose ascending links are to be joined; all by default.

    Returns
    -------
    Word
        Cost: the number of cells on the ways from ascending links to the root, and of letters, times its logarithm.
    """
    wanted = set(tree.ascending_cells() if cells is None else cells)
    arcs = _draw_arcs(tree, wanted, tree.all_ways if cells is None else tree.ways(wanted))
    n = len(arcs.ends)
    link = tree.link[np.array([cell for cell, _ in arcs.ends], dtype=np.int64)]
    order = np.array([arcs.order[cell] for cell, _ in arcs.ends], dtype=np.int64)
    last = np.array([arcs.last_behind[cell] for cell, _ in arcs.ends], dtype=np.int64)
    partners = np.array([len(ends) for _, ends in arcs.ends], dtype=np.int64)
    label = np.repeat(np.arange(n), partners)
    partner = np.array([border for _, ends in arcs.ends for border in ends], dtype=np.int64)
    # On a descending border the curve meets the rightmost arc first, so the arcs behind come before the label's own.
    width = int(last.max(initial=0)) + 1
    keys = np.concatenate([link * width, partner * width + width - 1 - order[label]])
    by_place = np.argsort(keys)
    letter = np.empty_like(by_place)
    letter[by_place] = np.arange(len(keys))
    block = np.concatenate([letter[:n], np.searchsorted(keys[by_place], partner * width + width - 1 - last[label])])
    plus = by_place[by_place >= n]
    return Word(
        cells=np.array([cell for cell, _ in arcs.ends], dtype=np.int64),
        border=np.concatenate([link, partner])[by_place],
        label=np.concatenate([np.arange(n), label])[by_place],
        minus=letter[:n],
        first_partner=np.append(0, np.cumsum(partners)),
        partner=letter[plus[np.argsort(label[plus - n], kind="stable")]],
        block=block[by_place],
    )


def _draw_arcs(tree: DualTree, wanted: set[int], children: dict[int, list[int]]) -> _Arcs:
    """Walk the tree from the root, in planar order, over the cells that have an arc to draw behind them.

    An arc may end on a descending border y further out where the piece that the chord cuts off turns once: Φ, the
    direction of the curve less that of the arc, grows by 2 from e to y if y comes later along the curve, and shrinks
    by 2 if it comes earlier.
    """
    link, along, bend, ascends = tree.link.tolist(), tree.along.tolist(), tree.bend.tolist(), tree.ascends.tolist()
    arcs = _Arcs({}, {}, [])
    open_borders: dict[int, list[int]] = {}
    stack = [(child, 0) for child in children.get(0, [])]
    while stack:
        cell, direction = stack.pop()
        if cell < 0:  # the way back
            arcs.last_behind[~cell] = len(arcs.order) - 1
            if not ascends[~cell]:
                open_borders[direction].pop()
            continue
        arcs.order[cell] = len(arcs.order)
        direction += bend[cell]
        potential = along[cell] - direction
        border = link[cell]
        if not ascends[cell]:
            open_borders.setdefault(potential, []).append(border)
        elif cell in wanted:
            later = [outer for outer in open_borders.get(potential + 2, ()) if outer > border]
            arcs.ends.append((cell, later + [y for y in open_borders.get(potential - 2, ()) if y < border]))
        stack.append((~cell, potential))
        stack.extend((child, direction) for child in children.get(cell, ()))
    return arcs
