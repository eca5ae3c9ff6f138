"""Most labels of a word have only one partner that fits: arc consistency over the chords of the disk.

Chords must not cross. So every label clears the space around it: between the nearest of its partners on its left and
the nearest on its right lies a gap with its minus letter in it, and whatever chord joins the two sides of the gap
crosses each of its own, so it can go. When a label has one partner left, its chord is drawn; then the two sides of
the gap are the two sides of the chord, and have nothing to do with each other from there on.

Either way only the smaller of the two sides is walked through, in the ring of letters that are still in play; each
part of the word that no chord of another crosses has a ring of its own.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.core.buffers import all_flat, flat, whole_room
from plyfold.core.propagation import Parts, Propagation, room_for_parts, room_for_propagation
from plyfold.immersion.word import Word

__all__ = ["Conflict", "Narrowed", "begin_propagation", "independent_parts", "narrow"]


@dataclass(frozen=True, eq=False)
class Narrowed:
    """What is left to choose in a word.

    Parameters
    ----------
    word : Word
    chosen : (labels,) int
        The plus letter of each label that has no choice, −1 for others.
    regions : list of arrays of int
        The letters still in play, in order along the curve, region by region: no chord of one joins or crosses another.
    removed_by : (letters,) int
        For each plus letter out of play the label that removed it, −1 for others.
    propagation : Propagation
        It can go on.
    """

    word: Word
    chosen: Ints
    regions: list[Ints]
    removed_by: Ints
    propagation: Propagation

    def conflict(self, region: Ints) -> Conflict:
        """Return the conflict of a region that turned out to have no grouping."""
        return Conflict(_reasons(self.word, self.removed_by, self.word.label[region].tolist()))

    def further(self, misfits: Ints) -> tuple[Ints, Bools]:
        """Leave out some of the letters still in play, once: return what is chosen then, and which letters are gone.

        There is a grouping without them, and all groupings are without them.
        """
        failed = self.propagation.narrow_further(flat(misfits))
        assert failed < 0
        gone = np.ones(len(self.word), dtype=bool)
        gone[_in_play(self.propagation)] = False
        return np.array(self.propagation.chosen), gone


@dataclass(frozen=True)
class Conflict:
    """Labels that cannot all be joined; false as a truth value."""

    labels: tuple[int, ...]

    def __bool__(self) -> bool:
        return False


def narrow(word: Word, watch: Watch = UNWATCHED) -> Narrowed | Conflict:
    """Remove the partners that fit no grouping, as far as looking at two labels at a time can tell.

    Returns
    -------
    Narrowed or Conflict
        A conflict if a label has no partner left: the word has no grouping. Otherwise all groupings remain.

    Notes
    -----
    Near-linear as a rule. Drawing all chords costs O(n log n) for n letters, since letters that are walked over move
    to a side of at most half the size; every other walk follows the removal of a partner.
    """
    propagation = begin_propagation(word, watch)
    failed = propagation.narrow()
    removed_by = np.asarray(propagation.removed_by)
    if failed >= 0:
        return Conflict(_reasons(word, removed_by, [failed]))
    regions = independent_parts(word, _in_play(propagation))
    return Narrowed(word, np.array(propagation.chosen), regions, removed_by.copy(), propagation)


def begin_propagation(word: Word, watch: Watch = UNWATCHED) -> Propagation:
    """Return the propagation in a word before anything is removed."""
    propagation = Propagation(watch.step)
    room = np.empty(room_for_propagation(len(word), len(word.minus)), dtype=np.int64)
    letters = word.border, word.label, word.block
    propagation.begin(*all_flat(*letters, word.minus, word.first_partner, word.partner.copy(), room))
    return propagation


def _in_play(propagation: Propagation) -> Ints:
    """Return the letters of the labels that have a choice left."""
    size = propagation.letters_in_play()
    return np.array(propagation.found[:size])


def _reasons(word: Word, removed_by: Ints, labels: Iterable[int]) -> tuple[int, ...]:
    """Return the labels to which some others owe it that they have no more partners, themselves included."""
    reasons = set(labels)
    waiting = list(reasons)
    while waiting:
        for label in set(removed_by[word.partners_of(waiting.pop())].tolist()) - reasons - {-1}:
            reasons.add(label)
            waiting.append(label)
    return tuple(sorted(reasons))


def independent_parts(word: Word, letters: Ints) -> list[Ints]:
    """Split some letters into as many parts as can be without chords from one part across another.

    A band between two disks joins their words so that one disk's letters lie between two letters of the other's. Each
    part can be looked at by itself, however long the word is.

    Parameters
    ----------
    word : Word
    letters : array of int
        In order along the curve: minus letters of some labels, and plus letters that they may still be joined to.

    Returns
    -------
    list of array of int
        The letters of each part in order along the curve; the parts in the order of their first labels. Near-linear.
    """
    if not len(letters):
        return []
    labels = len(word.minus)
    parts, listed, start = Parts(), np.empty_like(letters), np.empty(labels + 1, dtype=np.int64)
    parts.begin(flat(word.label), flat(word.block), labels, whole_room(room_for_parts(labels)))
    parts.join(flat(letters), len(letters))
    count = parts.list_in(flat(letters), len(letters), flat(listed), flat(start))
    return np.split(listed, start[1:count])
