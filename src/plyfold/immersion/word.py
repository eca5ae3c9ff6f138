"""Blank's word of a curve: who may be joined to whom (§2.3 of the paper; [Bla67]_).

Every ascending link e of the dual tree needs a partner: a descending border y further out on the way to the
unbounded cell, through which the sheet that lies above e leaves the disk. The pair is a chord of the disk from border
e to border y. The word lists the possible ends of chords in order along the curve:

* a **minus letter** on each ascending border, to be joined;
* a **plus letter** on each border that it may be joined to, taken or left free.

A chord must cut off a piece of turning number 1, which leaves few partners to choose from. The arcs behind a chord's
own cell run along with it, so on the border y a chord occupies not only its own plus letter but also those of the
links behind it: the *block* of the chord.

References
----------
.. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import dataclass

from plyfold.immersion.dual_tree import DualTree

__all__ = ["Chord", "Word", "write_word"]


@dataclass(frozen=True)
class Chord:
    """A possible pairing of an ascending border with one through which its upper sheet leaves the disk.

    Parameters
    ----------
    border, partner : int
        The ascending border e and the descending border y.
    minus : int
        Position of the minus letter in the word.
    block : (int, int)
        Positions first and last that the chord occupies on y; the last is its own plus letter.
    """

    border: int
    partner: int
    minus: int
    block: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Word:
    """The letters along the curve, as the chords that may end on them.

    Parameters
    ----------
    length : int
        Number of letters.
    chords_from : dict of int to list of Chord
        For the position of each minus letter: the chords from there.
    chords_to : dict of int to list of Chord
        For the position of a plus letter: the chords whose block begins there.
    """

    length: int
    chords_from: dict[int, list[Chord]]
    chords_to: dict[int, list[Chord]]


def ascending_cells(tree: DualTree) -> list[int]:
    """Return the cells whose link to the parent ascends."""
    return [cell for cell in tree.order if tree.ascends[cell]]


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
        Cost: the lengths of the paths from the ascending links to the root.
    """
    partners = {cell: _partners(tree, cell) for cell in (ascending_cells(tree) if cells is None else cells)}
    letters = sorted(
        [(tree.link[cell], tree.preorder[cell]) for cell in partners]
        + [(tree.link[outer], -tree.preorder[cell]) for cell, outers in partners.items() for outer in outers]
    )
    chords_from: dict[int, list[Chord]] = {}
    chords_to: dict[int, list[Chord]] = {}
    for cell, outers in partners.items():
        minus = bisect_left(letters, (tree.link[cell], tree.preorder[cell]))
        chords_from[minus] = [_chord(tree, letters, cell, outer, minus) for outer in outers]
        for chord in chords_from[minus]:
            chords_to.setdefault(chord.block[0], []).append(chord)
    return Word(len(letters), chords_from, chords_to)


def _partners(tree: DualTree, cell: int) -> list[int]:
    """Return the cells further out whose descending link may be joined to the ascending link of a cell.

    The piece that the chord cuts off must turn once: Φ grows by 2 from e to y if y comes later along the curve, and
    shrinks by 2 if it comes earlier.
    """
    border = tree.link[cell]
    return [
        outer
        for outer in tree.path(tree.parent[cell])
        if not tree.ascends[outer]
        and tree.potential[tree.link[outer]] - tree.potential[border] == (2 if tree.link[outer] > border else -2)
    ]


def _chord(tree: DualTree, letters: list[tuple[int, int]], cell: int, outer: int, minus: int) -> Chord:
    partner = tree.link[outer]
    # On a descending border the curve meets the rightmost arc first, so the arcs behind come before the cell's own.
    last = bisect_left(letters, (partner, -tree.preorder[cell]))
    first = bisect_left(letters, (partner, -(tree.preorder[cell] + tree.size[cell] - 1)))
    return Chord(tree.link[cell], partner, minus, (first, last))
