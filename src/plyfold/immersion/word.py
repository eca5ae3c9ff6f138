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
from plyfold.core.buffers import flat
from plyfold.core.letters import Letters, room_for_arcs, room_for_letters
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
        Cost: O(k), and the number of borders that each ascending link might be joined to.
    """
    letters, wanted = Letters(), tree.ascends.astype(np.int64)
    if cells is not None:
        wanted[:] = 0
        wanted[list(cells)] = 1
    room = np.empty(room_for_arcs(len(wanted), len(tree.turning)) + 2 * len(tree.turning), dtype=np.int64)
    size = letters.walk(tree.cell_tree, flat(wanted), flat(room))
    letters.sort(flat(np.empty(room_for_letters(size), dtype=np.int64)))
    return Word(
        cells=np.array(letters.cells[: letters.labels]),
        border=np.asarray(letters.border),
        label=np.asarray(letters.label),
        minus=np.asarray(letters.minus),
        first_partner=np.array(letters.first[: letters.labels + 1]),
        partner=np.asarray(letters.partner),
        block=np.asarray(letters.block),
    )
