"""Which letters of a word cancel, so that the others cost least: the exact program, after all that costs nothing.

Two letters of one label and opposite signs cancel each other, and no two such pairs interleave. A letter that cancels
none costs the area of its cell once. Each label has a *rare* sign, of which it has fewer letters (the minus, if it has
as many of both). It costs |plus − minus| times its area in any case, and twice its area more for each rare letter that
stays alone: so these alone are priced.

Before the program the word is shortened, without loss. Labels with one sign go: their letters cancel nothing and block
nothing. Neighbours that can cancel do. Labels that always run together become one, with their prices added.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import Watch
from plyfold.core.buffers import all_flat, flat
from plyfold.core.cancelling import Costs, cancel_neighbours
from plyfold.memory import require_memory

__all__ = ["PricedWord", "cancelled"]

_NONE = -1
# Sums of whole numbers are exact up to this one.
_LARGEST_EXACT_INTEGER = 2.0**53


@dataclass(frozen=True, eq=False)
class PricedWord:
    """A word, and what its labels cost.

    Parameters
    ----------
    label : (letters,) int
    is_plus : (letters,) bool
    weight : (labels,) float
        What a letter of each label costs that stays alone, from 0 on.
    tie : (labels,) float
        The same in a second currency, for choices that cost the same: whole numbers from 0 on.
    """

    label: Ints
    is_plus: Bools
    weight: Floats
    tie: Floats


def cancelled(word: PricedWord, watch: Watch) -> Ints:
    """Return the letter that each letter cancels, −1 for those that stay alone, where these cost least.

    Parameters
    ----------
    word : PricedWord
    watch : Watch

    Raises
    ------
    TimeLimitError
        If the time ends before.
    MemoryLimitError
        If the costs of all stretches would not fit into memory.

    Notes
    -----
    O(L² m) time for L letters that are left of the word when it has been shortened, of which each may cancel m others.
    Sums are exact: weights that are no whole numbers, or too large, are rounded to multiples of a unit so small that
    all letters together cost less than 2⁵³ of it.

    Examples
    --------
    >>> label, is_plus = np.array([0, 1, 0, 1]), np.array([True, True, False, False])
    >>> cancelled(PricedWord(label, is_plus, np.array([2.0, 3.0]), np.zeros(2)), Watch()).tolist()
    [-1, 3, -1, 1]
    """
    shorter = _Shorter(word)
    shorter.shorten()
    if len(shorter.code):
        shorter.solve(watch)
    return shorter.with_merged()


def _is_rare(word: PricedWord) -> Bools:
    """Tell of each letter whether its label has fewer letters of this sign than of the other one."""
    plus, minus = _counts(_codes(word), len(word.weight))
    return np.asarray(word.is_plus == (plus < minus)[word.label])


def _codes(word: PricedWord) -> Ints:
    """Return 2 a for a plus letter of label a, and 2 a + 1 for a minus letter."""
    return np.asarray(2 * word.label + ~word.is_plus)


def _counts(code: Ints, labels: int) -> tuple[Ints, Ints]:
    """Return how many plus and how many minus letters each label has."""
    both = np.bincount(code, minlength=2 * labels)
    return both[0::2], both[1::2]


class _Shorter:
    """A cyclic word that gets shorter; letters that are left are known by their numbers in the whole word.

    ``merged`` are rounds of letters whose labels became part of other ones: letters of these, and those behind them.
    """

    def __init__(self, word: PricedWord) -> None:
        self.rare = _is_rare(word)
        self.weight, self.tie = word.weight.copy(), word.tie.copy()
        self.code, self.number = _codes(word), np.arange(len(word.label))
        self.mate = np.full(len(self.code), _NONE)
        self.merged: list[tuple[Ints, Ints]] = []

    def shorten(self) -> None:
        """Shorten the word until no step makes it any shorter."""
        size = -1
        while size != len(self.code):
            size = len(self.code)
            self._drop_one_signed()
            self._cancel_neighbours()
            self._merge_labels()

    def _keep(self, which: Bools) -> None:
        self.code, self.number = self.code[which], self.number[which]

    def _drop_one_signed(self) -> None:
        plus, minus = _counts(self.code, len(self.weight))
        self._keep(((plus > 0) & (minus > 0))[self.code // 2])

    def _cancel_neighbours(self) -> None:
        code, number = self.code.copy(), self.number.copy()
        left = cancel_neighbours(*all_flat(code, number, self.mate))
        self.code, self.number = code[:left], number[:left]

    def _merge_labels(self) -> None:
        """Make one label of two that always run together."""
        second = _second_labels(self.code, len(self.weight))
        kept = np.flatnonzero(second[self.code // 2] >= 0)
        gone = _behind(self.code, kept)
        self.merged.append((self.number[kept], self.number[gone]))
        first = np.flatnonzero(second >= 0)
        self.weight[first] += self.weight[second[first]]
        self.tie[first] += self.tie[second[first]]
        self._keep(~np.isin(np.arange(len(self.code)), gone))

    def solve(self, watch: Watch) -> None:
        """Let the letters that are left cancel as it costs least."""
        label, rare = self.code // 2, self.rare[self.number]
        price = _whole_prices(np.where(rare, self.weight[label], 0.0), np.where(rare, self.tie[label], 0.0))
        costs = Costs(watch.step, _ask, *all_flat(self.code, price))
        mate = np.full(len(self.code), _NONE)
        costs.find_mates(flat(mate))
        paired = np.flatnonzero(mate >= 0)
        self.mate[self.number[paired]] = self.number[mate[paired]]

    def with_merged(self) -> Ints:
        """Return the mates of all letters: those of merged labels follow those that they always run with."""
        follower = np.full(len(self.mate), _NONE)
        for kept, gone in reversed(self.merged):
            follower[kept] = gone
            paired = self.mate[kept] >= 0
            self.mate[gone[paired]] = follower[self.mate[kept[paired]]]
        return self.mate


def _behind(code: Ints, places: Ints) -> Ints:
    """Return the letter behind each of some letters: after a plus, before a minus, round the cyclic word."""
    return np.asarray((places + np.where(code[places] % 2 == 0, 1, -1)) % max(len(code), 1))


def _second_labels(code: Ints, labels: int) -> Ints:
    """Return for labels that become one with another that one; −1 for all others.

    Behind all letters of the first there are those of the second, with the same or the opposite sign, and there are no
    more of these.
    """
    following = np.full(labels, _NONE)
    if not len(code):
        return following
    places = np.arange(len(code))
    behind = code[_behind(code, places)] ^ (code % 2)
    count = np.bincount(code // 2, minlength=labels)
    least, most = np.full(labels, 2 * labels), np.full(labels, _NONE)
    np.minimum.at(least, code // 2, behind)
    np.maximum.at(most, code // 2, behind)
    first = np.flatnonzero((least == most) & (count > 0) & (count == count[np.minimum(least, 2 * labels - 1) // 2]))
    following[first] = least[first] // 2
    following[following == np.arange(labels)] = _NONE
    return _in_pairs(following)


def _in_pairs(following: Ints) -> Ints:
    """Return what follows labels, for some of them: no label is in two of these pairs.

    Labels can follow each other in a circle, and one label two others.
    """
    second, is_taken = np.full(len(following), _NONE), np.zeros(len(following), dtype=bool)
    for first in np.flatnonzero(following >= 0).tolist():
        after = following[first]
        if not (is_taken[first] or is_taken[after]):
            second[first] = after
            is_taken[[first, after]] = True
    return second


def _whole_prices(weight: Floats, tie: Floats) -> Floats:
    """Return prices as whole numbers: weights count more than all ties together."""
    factor, total = tie.sum() + 1, weight.sum()
    if (weight != np.floor(weight)).any() or total * factor >= _LARGEST_EXACT_INTEGER / 2:
        unit = total * factor / (_LARGEST_EXACT_INTEGER / 4)
        weight = np.where(weight > 0, np.maximum(np.rint(weight / unit), 1), 0)
    return np.asarray(factor * weight + tie)


def _ask(size: int) -> None:
    require_memory(size, "the costs of all stretches of the word", None, "with a time limit, bounds can be had")
