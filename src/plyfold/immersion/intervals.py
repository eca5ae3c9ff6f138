"""The letters that propagation leaves open, laid out in places, and which intervals of them can be grouped."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Ints
from plyfold.clock import Watch
from plyfold.core.buffers import Buffer, all_flat
from plyfold.core.intervals import Intervals
from plyfold.immersion.word import Word
from plyfold.memory import require_memory

__all__ = ["OpenLetters", "lay_out"]


@dataclass(frozen=True, eq=False)
class OpenLetters:
    """Letters of a word in places, region after region; behind each region there is one more place, which ends it.

    Parameters
    ----------
    word : Word
    letter : (places,) int
        The letter at each place, ``len(word)`` where a region ends.
    region : (places,) int
        The region of each place.
    is_wall : (places,) bool
        Whether nothing but a chord passes a place: where there is a minus letter, and where a region ends.
    opens_at : (c,) int
        For each chord the place where it begins, in rising order: its minus letter, or the block of its plus letter.
    minus, plus, block : (c,) int
        The places of its letters, and where the block of the plus letter begins.
    table : Intervals
    """

    word: Word
    letter: Ints
    region: Ints
    is_wall: Bools
    opens_at: Ints
    minus: Ints
    plus: Ints
    block: Ints
    table: Intervals

    @property
    def regions(self) -> list[tuple[int, int]]:
        """The first place of each region, and the one that ends it."""
        ends = np.flatnonzero(self.letter == len(self.word))
        return list(zip(np.append(0, ends[:-1] + 1).tolist(), ends.tolist(), strict=True))

    @property
    def fits(self) -> Bools:
        """Whether each chord's inside can be grouped."""
        return np.asarray(self.table.fits).astype(bool)

    def without(self, gone: Bools, watch: Watch) -> OpenLetters:
        """Return the layout without the chords of some letters; those that stay begin in the same order."""
        stays = ~np.append(gone, False)[self.letter]
        stays[self.opens_at[stays[self.plus]]] = True
        return _laid(self.word, self.letter[stays], self.region[stays], gone, watch)


def lay_out(word: Word, regions: Sequence[Ints], watch: Watch) -> OpenLetters:
    """Lay out the letters of some regions, each in order along the curve."""
    letter = np.concatenate([part for region in regions for part in (region, [len(word)])])
    region = np.repeat(np.arange(len(regions)), [len(region) + 1 for region in regions])
    return _laid(word, letter, region, np.zeros(len(word), dtype=bool), watch)


def _laid(word: Word, letter: Ints, region: Ints, gone: Bools, watch: Watch) -> OpenLetters:
    ends = letter == len(word)
    label = np.append(word.label, 0)[letter]
    is_minus = ~ends & (word.minus[label] == letter)
    plus = np.flatnonzero(~ends & ~is_minus & ~np.append(gone, False)[letter])
    place_of = np.zeros(len(word) + 1, dtype=np.int64)
    place_of[letter] = np.arange(len(letter))
    minus, block = place_of[word.minus[label[plus]]], plus.copy()
    longer = np.flatnonzero(word.block[letter[plus]] < letter[plus])
    # A block begins with the first letter of the same region that is in it.
    key, first = region * (len(word) + 1) + letter, region[plus[longer]] * (len(word) + 1)
    block[longer] = np.searchsorted(key, first + word.block[letter[plus[longer]]])
    opens_at = np.minimum(minus, block)
    chords = np.flatnonzero((minus < block) | (plus < minus))
    chords = chords[np.argsort(opens_at[chords], kind="stable")]
    opens_at, minus, plus, block = opens_at[chords], minus[chords], plus[chords], block[chords]
    is_wall = ends | is_minus
    wall, first = np.flatnonzero(is_wall), np.searchsorted(opens_at, np.arange(len(letter) + 1))
    table = _table(wall, all_flat(wall, first, np.searchsorted(wall, minus), plus, block), watch)
    return OpenLetters(word, letter, region, is_wall, opens_at, minus, plus, block, table)


def _table(wall: Ints, buffers: list[Buffer[int]], watch: Watch) -> Intervals:
    def ask(size: int) -> None:
        what = f"the table of intervals of a word with {len(wall):,} open letters to be joined"
        require_memory(size, what, None, "give the process more memory, or find the disks of parts of the curve")

    return Intervals(watch.step, ask, *buffers)
