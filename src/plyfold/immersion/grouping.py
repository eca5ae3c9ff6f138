"""Groupings of a word: every minus letter joined, no two chords crossing. One grouping is one immersion.

The word is cut open at its start, and every question is answered interval by interval: the first letter of an interval
is either free or the end of a chord, and the chord splits the rest into two intervals that no other chord connects.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, TypeAlias

from plyfold.immersion.word import Chord, Word

__all__ = ["Counts", "count_groupings", "list_groupings"]

Interval: TypeAlias = tuple[int, int]
Counts: TypeAlias = dict[Interval, int]
Choice: TypeAlias = tuple[Chord | None, tuple[Interval, ...]]


def _choices(word: Word, interval: Interval) -> list[Choice]:
    """Return what the first letter of an interval may do, with the intervals that remain."""
    start, end = interval
    if start >= end:
        return []
    if start in word.chords_from:
        return [
            (chord, ((start + 1, chord.block[0]), (chord.block[1] + 1, end)))
            for chord in word.chords_from[start]
            if start < chord.block[0] and chord.block[1] < end
        ]
    joined: list[Choice] = [
        (chord, ((chord.block[1] + 1, chord.minus), (chord.minus + 1, end)))
        for chord in word.chords_to.get(start, [])
        if chord.block[1] < chord.minus < end
    ]
    return [(None, ((start + 1, end),)), *joined]


def count_groupings(word: Word) -> tuple[int, Counts]:
    """Count the groupings of a word, exactly.

    Returns
    -------
    int
        The number of groupings of the whole word.
    dict
        The number for every interval that was asked for on the way, which :func:`list_groupings` follows.

    Notes
    -----
    Polynomial: at most one sum per interval of the word, of as many terms as the letter has partners.
    """
    counts: Counts = {}
    whole = (0, word.length)
    stack = [whole]
    while stack:
        interval = stack[-1]
        if interval in counts:
            stack.pop()
            continue
        choices = _choices(word, interval)
        missing = [part for _, parts in choices for part in parts if part not in counts]
        if missing:
            stack.extend(missing)
            continue
        total = sum(_product(counts, parts) for _, parts in choices)
        counts[interval] = 1 if interval[0] >= interval[1] else total
    return counts[whole], counts


def _product(counts: Counts, parts: tuple[Interval, ...]) -> int:
    product = 1
    for part in parts:
        product *= counts[part]
    return product


def list_groupings(word: Word, counts: Counts) -> Iterator[tuple[Chord, ...]]:
    """List the groupings of a word, each as its chords, without repeats and in a stable order.

    Parameters
    ----------
    word : Word
    counts : dict
        From :func:`count_groupings`; only intervals that have a grouping are entered, so there are no dead ends.
    """
    # Pending intervals and chords found are linked lists, (first, rest) or None: branches share their tails.
    whole = (0, word.length)
    stack: list[tuple[Any, Any]] = [((whole, None), None)] if counts[whole] else []
    while stack:
        pending, found = stack.pop()
        if pending is None:
            yield tuple(_unlinked(found))
            continue
        interval, rest = pending
        if interval[0] >= interval[1]:
            stack.append((rest, found))
        for chord, parts in reversed(_choices(word, interval)):
            if _product(counts, parts):
                stack.append((_linked(parts, rest), found if chord is None else (chord, found)))


def _linked(items: Iterable[Any], rest: Any) -> Any:
    for item in reversed(tuple(items)):
        rest = (item, rest)
    return rest


def _unlinked(linked: Any) -> Iterator[Any]:
    while linked is not None:
        item, linked = linked
        yield item
