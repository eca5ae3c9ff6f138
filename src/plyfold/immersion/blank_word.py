"""Blank's word and its groupings, to read and to print (§2.3 of the paper; [Bla67]_).

References
----------
.. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from string import ascii_lowercase

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange
from plyfold.immersion.dual_tree import grow_dual_tree
from plyfold.immersion.grouping import Grouping, Groupings, find_groupings, list_groupings
from plyfold.immersion.obstructions import is_visibly_no_disk, require_curve_without_cusps
from plyfold.immersion.word import Word, write_word

__all__ = ["BlankWord", "Letter", "blank_word"]


@dataclass(frozen=True)
class Letter:
    """One letter of the word: an arc that crosses the curve, or may end there.

    Parameters
    ----------
    label : str
        The name of the arc, a, b, c, …
    sign : int
        −1 where the arc sets out across a border to a higher cell, and must be joined; +1 where it may be joined.
    border : int
        The border of the curve.
    """

    label: str
    sign: int
    border: int

    def __str__(self) -> str:
        return self.label + ("⁺" if self.sign > 0 else "⁻")


@dataclass(frozen=True, eq=False)
class BlankWord:
    """The word of a curve: letters in order along it, with the groupings that are its immersions.

    Printed, it is a line of letters above a line of borders. Plus letters are written only where the joined arc would
    cut off a piece that turns once; all others stay free in every grouping.

    Parameters
    ----------
    arrangement : Arrangement
    word : Word
        The same in numbers.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> word = blank_word(milnor)
    >>> print(word)
    a⁺ b⁻ a⁺ b⁺ a⁻ b⁺
     0  2  5  5  8 10
    >>> [word.bracketed(grouping) for grouping in word.groupings()]
    ['(a⁺ (b⁻ a⁺ b⁺) a⁻) b⁺', 'a⁺ (b⁻ (a⁺ b⁺ a⁻) b⁺)']
    """

    arrangement: Arrangement
    word: Word

    @cached_property
    def letters(self) -> tuple[Letter, ...]:
        """The letters in order along the curve, the arcs named in the order in which they appear."""
        minus, labels = set(self.word.minus.tolist()), self.word.label.tolist()
        names = {label: _name(number) for number, label in enumerate(dict.fromkeys(labels))}
        return tuple(
            Letter(names[label], -1 if place in minus else 1, border)
            for place, (label, border) in enumerate(zip(labels, self.word.border.tolist(), strict=True))
        )

    def __len__(self) -> int:
        return len(self.word)

    def __repr__(self) -> str:
        return f"<BlankWord of {len(self)} letters on {len(self.word.minus)} arcs>"

    def _repr_html_(self) -> str:
        letters = "".join(f"<td>{letter}</td>" for letter in self.letters)
        borders = "".join(f"<td>{letter.border}</td>" for letter in self.letters)
        return f"<table><tr><th>letter</th>{letters}</tr><tr><th>border</th>{borders}</tr></table>"

    def __str__(self) -> str:
        names, borders = [str(letter) for letter in self.letters], [str(letter.border) for letter in self.letters]
        widths = [max(len(name), len(border)) for name, border in zip(names, borders, strict=True)]
        lines = (
            " ".join(text.rjust(width) for text, width in zip(row, widths, strict=True)) for row in (names, borders)
        )
        return "\n".join(lines) if len(self) else "(empty)"

    def groupings(self) -> Iterator[tuple[tuple[int, int], ...]]:
        """List the groupings: each as pairs of places in the word, minus letter first.

        Yields
        ------
        tuple of (int, int)
            One grouping for every immersion of the curve, in the order of :func:`plyfold.immersions`; nothing if the
            curve does not turn once or winds a negative number of times somewhere.
        """
        found = None if is_visibly_no_disk(self.arrangement) else find_groupings(self.word)
        if isinstance(found, Groupings):
            yield from (self._pairs(grouping) for grouping in list_groupings(found))

    def _pairs(self, grouping: Grouping) -> tuple[tuple[int, int], ...]:
        return tuple(sorted(zip(self.word.minus.tolist(), grouping.tolist(), strict=True)))

    def bracketed(self, grouping: tuple[tuple[int, int], ...]) -> str:
        """Write a grouping as the word with brackets around joined letters."""
        first, last = {min(pair) for pair in grouping}, {max(pair) for pair in grouping}
        return " ".join("(" * (i in first) + str(letter) + ")" * (i in last) for i, letter in enumerate(self.letters))


def blank_word(curve: CurveLike) -> BlankWord:
    """Write Blank's word of a curve, on a spanning tree of its cells in place of rays.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    BlankWord
        Empty if no link of the tree ascends, which means: no choice. Cost: O(k log k) as a rule.

    References
    ----------
    .. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967.

    Examples
    --------
    >>> print(blank_word([(0, 0), (1, 0), (0, 1)]))
    (empty)
    """
    arranged = arrange(curve)
    require_curve_without_cusps(arranged, "Blank's word")
    return BlankWord(arranged, write_word(grow_dual_tree(arranged)))


def _name(number: int) -> str:
    """Return a, b, …, z, aa, ab and so on."""
    name = ""
    number += 1
    while number:
        number, letter = divmod(number - 1, len(ascii_lowercase))
        name = ascii_lowercase[letter] + name
    return name
