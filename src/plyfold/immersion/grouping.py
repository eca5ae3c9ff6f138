"""Groupings of a word: every minus letter joined, no two chords crossing. One grouping is one immersion.

What propagation leaves open is settled interval by interval: the first letter of an interval is either free or the end
of a chord, and the chord splits the rest into two intervals that no other chord connects. Which intervals can be
grouped at all is one row of bits per letter, in one Python integer each, so the table for a word of thousands of
letters takes a fraction of a second; counting and listing then never enter an interval in vain.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from math import prod
from typing import Any, TypeAlias

import numpy as np

from plyfold.arrays import Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.immersion.propagation import Conflict, narrow
from plyfold.immersion.word import Word

__all__ = ["Groupings", "count_groupings", "find_groupings", "list_groupings", "nth_grouping"]

Interval: TypeAlias = tuple[int, int]
# A chord that opens at a place: the two intervals inside it and behind it up to a given end, and its plus letter.
Opening: TypeAlias = tuple[int, int, int, int]
# A grouping: the plus letter of each label.
Grouping: TypeAlias = Ints


@dataclass(frozen=True, eq=False)
class Groupings:
    """All groupings of a word, in a form to count and to list them from.

    The letters still open are laid out in *places*, region after region.

    Parameters
    ----------
    word : Word
    chosen : (labels,) int
        The plus letters of the labels without choice, −1 for others.
    regions : list of (int, int)
        First and last place (exclusive) of each region.
    openings : list of list of (int, int, int, int)
        The chords whose first end is at a place: start and end of the interval inside, start of what follows, and the
        plus letter.
    bound : list of bool
        True where a minus letter is, which cannot stay free.
    groupable : list of int
        Bit t of entry s is set if the interval of places from s to s + t (exclusive) has a grouping.
    counts : dict of (int, int) to int
        Groupings of the intervals counted so far.
    """

    word: Word
    chosen: Ints
    regions: list[Interval]
    openings: list[list[Opening]]
    bound: list[bool]
    groupable: list[int]
    counts: dict[Interval, int] = field(default_factory=dict)


def find_groupings(word: Word, watch: Watch = UNWATCHED) -> Groupings | Conflict:
    """Decide whether a word has a grouping, and prepare all of them.

    Returns
    -------
    Groupings or Conflict
        A conflict, which is false, if there is none. Exact. Cost: propagation, and for each region left open with n
        letters and c chords O(c n / 64) time and O(n² / 16) bytes; regions are small as a rule.
    """
    narrowed = narrow(word, watch)
    if isinstance(narrowed, Conflict):
        return narrowed
    groupings = Groupings(word, narrowed.chosen, [], [], [], [])
    for region in narrowed.regions:
        first = len(groupings.groupable)
        _lay_out(groupings, word, region, watch)
        if not _has_grouping(groupings, (first, first + len(region))):
            return narrowed.conflict(region)
    return groupings


def _lay_out(groupings: Groupings, word: Word, region: Ints, watch: Watch) -> None:
    """Add the places of a region, and one more that ends it."""
    first = len(groupings.groupable)
    minus = (word.minus[word.label[region]] == region).tolist()
    openings = _openings(word, region, minus, first)
    rows = [1] * (len(region) + 1)
    for place in reversed(range(len(region))):
        watch.step()
        row = 1 if minus[place] else 1 | rows[place + 1] << 1
        for inside, end, behind, _ in openings[place]:
            if rows[inside - first] >> (end - inside) & 1:
                row |= rows[behind - first] << (behind - first - place)
        rows[place] = row
    groupings.regions.append((first, first + len(region)))
    groupings.openings.extend([*openings, []])
    groupings.bound.extend([*minus, False])
    groupings.groupable.extend(rows)


def _openings(word: Word, region: Ints, minus: list[bool], first: int) -> list[list[Opening]]:
    """Return the chords that open at each place: at their minus letters, or with the blocks of their plus letters."""
    openings: list[list[Opening]] = [[] for _ in minus]
    minus_place = (first + np.searchsorted(region, word.minus[word.label[region]])).tolist()
    block_place = (first + np.searchsorted(region, word.block[region])).tolist()
    for plus, letter in enumerate(region.tolist(), first):
        bound, block = minus_place[plus - first], block_place[plus - first]
        if bound < block:
            openings[bound - first].append((bound + 1, block, plus + 1, letter))
        elif plus < bound:
            openings[block - first].append((plus + 1, bound, bound + 1, letter))
    return openings


def _has_grouping(groupings: Groupings, interval: Interval) -> bool:
    start, end = interval
    return bool(groupings.groupable[start] >> (end - start) & 1) if start <= end else False


def _choices(groupings: Groupings, interval: Interval) -> list[tuple[int | None, tuple[Interval, ...]]]:
    """Return what the first letter of an interval may do: the plus letter of its chord, and the intervals left."""
    start, end = interval
    joined: list[tuple[int | None, tuple[Interval, ...]]] = [
        (plus, ((inside, middle), (behind, end)))
        for inside, middle, behind, plus in groupings.openings[start]
        if behind <= end and _has_grouping(groupings, (inside, middle)) and _has_grouping(groupings, (behind, end))
    ]
    if not groupings.bound[start] and _has_grouping(groupings, (start + 1, end)):
        joined.append((None, ((start + 1, end),)))
    return joined


def count_groupings(groupings: Groupings) -> int:
    """Count all groupings, exactly. Cost: one sum for every interval that occurs in a grouping."""
    return prod(_count(groupings, region) for region in groupings.regions)


def _count(groupings: Groupings, whole: Interval) -> int:
    counts = groupings.counts
    stack = [whole]
    while stack:
        interval = stack[-1]
        if interval in counts:
            stack.pop()
        elif interval[0] == interval[1]:
            counts[interval] = 1
        else:
            choices = _choices(groupings, interval)
            missing = [part for _, parts in choices for part in parts if part not in counts]
            stack.extend(missing)
            if not missing:
                counts[interval] = sum(prod(counts[part] for part in parts) for _, parts in choices)
    return counts[whole]


def list_groupings(groupings: Groupings, watch: Watch = UNWATCHED) -> Iterator[Grouping]:
    """List all groupings without repeats and in a stable order; between two of them lies O(n²) work at most."""
    # Pending intervals and letters found are linked lists, (first, rest) or None: branches share their tails.
    stack: list[tuple[Any, Any]] = [(_linked(groupings.regions, None), None)]
    while stack:
        watch.step()
        pending, found = stack.pop()
        if pending is None:
            yield _grouping(groupings, _unlinked(found))
            continue
        interval, rest = pending
        if interval[0] == interval[1]:
            stack.append((rest, found))
            continue
        for plus, parts in reversed(_choices(groupings, interval)):
            stack.append((_linked(parts, rest), found if plus is None else (plus, found)))


def nth_grouping(groupings: Groupings, index: int) -> Grouping:
    """Return the grouping that is listed at a number, from 0 on, without making those before it."""
    letters = []
    pending = _shared_out(groupings, groupings.regions, index)
    while pending:
        interval, index = pending.pop()
        if interval[0] < interval[1]:
            plus, parts, index = _nth_choice(groupings, interval, index)
            letters += [] if plus is None else [plus]
            pending += _shared_out(groupings, parts, index)
    return _grouping(groupings, letters)


def _shared_out(groupings: Groupings, parts: Iterable[Interval], index: int) -> list[tuple[Interval, int]]:
    """Split a number into one for each of several independent intervals, of which the last one changes first."""
    shares = []
    for part in reversed(tuple(parts)):
        index, here = divmod(index, _count(groupings, part))
        shares.append((part, here))
    return shares


def _nth_choice(groupings: Groupings, interval: Interval, index: int) -> tuple[int | None, tuple[Interval, ...], int]:
    for plus, parts in _choices(groupings, interval):
        size = prod(_count(groupings, part) for part in parts)
        if index < size:
            return plus, parts, index
        index -= size
    raise IndexError("there are fewer groupings")


def _grouping(groupings: Groupings, letters: Iterable[int]) -> Grouping:
    plus = np.fromiter(letters, dtype=np.int64)
    grouping = groupings.chosen.copy()
    grouping[groupings.word.label[plus]] = plus
    return grouping


def _linked(items: Iterable[Any], rest: Any) -> Any:
    for item in reversed(tuple(items)):
        rest = (item, rest)
    return rest


def _unlinked(linked: Any) -> Iterator[Any]:
    while linked is not None:
        item, linked = linked
        yield item
