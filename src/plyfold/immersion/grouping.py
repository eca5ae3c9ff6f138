"""Groupings of a word: every minus letter joined, no two chords crossing. One grouping is one immersion.

What propagation leaves open is settled interval by interval: the first letter of an interval is either free or the end
of a chord, and the chord splits the rest into two intervals that no other chord connects. A table tells which intervals
can be grouped at all. Chords whose inside cannot be are left out, which mostly lets propagation go on nearly to the
end; counting and listing then never enter an interval in vain.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from math import prod
from typing import Any, TypeAlias

import numpy as np

from plyfold.arrays import Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.core.intervals import Intervals
from plyfold.immersion.intervals import OpenLetters, lay_out
from plyfold.immersion.propagation import Conflict, Narrowed, narrow
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
        True where a minus letter is, which cannot stay free, and where a region ends.
    table : Intervals or None
        Which intervals of places can be grouped; None if no letters are open.
    counts : dict of (int, int) to int
        Groupings of the intervals counted so far.
    """

    word: Word
    chosen: Ints
    regions: list[Interval]
    openings: list[list[Opening]]
    bound: list[bool]
    table: Intervals | None
    counts: dict[Interval, int] = field(default_factory=dict)


def find_groupings(word: Word, watch: Watch = UNWATCHED) -> Groupings | Conflict:
    """Decide whether a word has a grouping, and prepare all of them.

    Returns
    -------
    Groupings or Conflict
        A conflict, which is false, if there is none. Exact. Cost: propagation, and for each region left open with k
        labels, and c chords whose inside can be grouped, O(c k / 64) time, and c k / 4 bytes at most.
    """
    narrowed = narrow(word, watch)
    if isinstance(narrowed, Conflict):
        return narrowed
    if not narrowed.regions:
        return Groupings(word, narrowed.chosen, [], [], [], None)
    layout = lay_out(word, narrowed.regions, watch)
    for region, (start, end) in zip(narrowed.regions, layout.regions, strict=True):
        if not layout.table.has(start, end):
            return narrowed.conflict(region)
    return _groupings(*_narrowed_further(narrowed, layout, watch))


def _narrowed_further(narrowed: Narrowed, layout: OpenLetters, watch: Watch) -> tuple[Ints, OpenLetters]:
    """Leave out the chords whose inside cannot be grouped, and all that does not fit in with those that are left."""
    misfits = layout.letter[layout.plus[~layout.fits]]
    if not len(misfits):
        return narrowed.chosen, layout
    chosen, gone = narrowed.further(misfits)
    return chosen, layout.without(gone, watch)


def _groupings(chosen: Ints, layout: OpenLetters) -> Groupings:
    openings: list[list[Opening]] = [[] for _ in layout.letter]
    columns = layout.opens_at, layout.minus, layout.plus, layout.block, layout.letter[layout.plus]
    for place, minus, plus, block, letter in np.stack(columns, axis=1)[layout.fits].tolist():
        inside = (minus + 1, block) if minus < block else (plus + 1, minus)
        openings[place].append((*inside, max(minus, plus) + 1, letter))
    return Groupings(layout.word, chosen, layout.regions, openings, layout.is_wall.tolist(), layout.table)


def _choices(groupings: Groupings, interval: Interval) -> list[tuple[int | None, tuple[Interval, ...]]]:
    """Return what the first letter of an interval may do: the plus letter of its chord, and the intervals left."""
    start, end = interval
    assert groupings.table is not None
    has = groupings.table.has
    joined: list[tuple[int | None, tuple[Interval, ...]]] = [
        (plus, ((inside, middle), (behind, end)))
        for inside, middle, behind, plus in groupings.openings[start]
        if behind <= end and has(behind, end)
    ]
    if not groupings.bound[start] and has(start + 1, end):
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
