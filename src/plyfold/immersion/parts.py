"""Parts of a word that have nothing to do with each other: no chord of one crosses or touches a chord of another.

A band between two disks joins their words in this way, and one disk's letters then lie between two letters of the
other's. Each part can be looked at by itself, however long the word is.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from plyfold.immersion.word import Word

__all__ = ["independent_parts"]


def independent_parts(word: Word, labels: Sequence[int], partners: Sequence[Sequence[int]]) -> list[list[int]]:
    """Split the letters of some labels into as many parts as can be without chords from one part across another.

    Parameters
    ----------
    word : Word
    labels : sequence of int
    partners : sequence of sequence of int
        The plus letters that each label of the word may still be joined to.

    Returns
    -------
    list of list of int
        The letters of each part in order along the curve; the parts in the order of their first labels. Near-linear.
    """
    letters = sorted(letter for label in labels for letter in (word.minus[label], *partners[label]))
    part = list(range(len(word.minus)))
    _join_blocks(word, letters, part)
    _join_crossing(word, letters, part)
    parts: dict[int, list[int]] = {_part_of(part, label): [] for label in labels}
    for letter in letters:
        parts[_part_of(part, word.label[letter])].append(letter)
    return list(parts.values())


def _join_blocks(word: Word, letters: list[int], part: list[int]) -> None:
    """Join labels with a letter in the block of another's: a chord occupies the whole block of its plus letter."""
    begin, following = len(word), -1
    for letter in reversed(letters):
        if begin <= letter:
            part[_part_of(part, word.label[letter])] = _part_of(part, word.label[following])
        begin, following = min(begin, word.block[letter]), letter


def _join_crossing(word: Word, letters: list[int], part: list[int]) -> None:
    """Join parts whose letters alternate along the curve.

    The parts of which a letter has come, and others have not, wait on a stack. A part that comes again while others
    wait above it alternates with them.
    """
    to_come = Counter(_part_of(part, word.label[letter]) for letter in letters)
    open_parts: list[int] = []
    waiting: set[int] = set()
    for letter in letters:
        here = _part_of(part, word.label[letter])
        if here not in waiting:
            open_parts.append(here)
            waiting.add(here)
        while open_parts[-1] != here:
            other = open_parts.pop()
            part[other] = here
            to_come[here] += to_come[other]
        to_come[here] -= 1
        if not to_come[here]:
            open_parts.pop()


def _part_of(part: list[int], label: int) -> int:
    """Return the label that stands for the part of a label; the way there is halved for the next time."""
    while part[label] != label:
        part[label] = label = part[part[label]]
    return label
