"""What moves would change, the smallest change first, kept up to date while moves are made."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from heapq import heappop, heappush
from typing import NamedTuple

import numpy as np

from plyfold.offers.areas import Measure
from plyfold.offers.rerouted import Effect, Move, Plan

__all__ = ["Change", "Changes"]


@dataclass(frozen=True, eq=False)
class Change:
    """What a move would change now: the region that is covered, and how often it is.

    Parameters
    ----------
    plan : Plan
    move : Move
    effect : Effect
    sizes : (Measure, Measure)
        How much it changes, by what comes first and by what tells equal ones apart.
    borders : collection of int
        Those along the runs of the move.
    """

    plan: Plan
    move: Move
    effect: Effect
    sizes: tuple[Measure, Measure]
    borders: Collection[int]

    @property
    def least(self) -> tuple[float, float]:
        """It is not less than this."""
        return self.sizes[0].least, self.sizes[1].least

    def comes_before_all(self, least: tuple[float, float]) -> bool:
        """Tell whether this comes before all changes that are not less than so much."""
        first, second = self.sizes
        return least[0] > first.most or (least[0] == first.most and least[1] > second.most)

    def __lt__(self, other: Change) -> bool:
        """Tell whether this is the smaller change, exactly; of equal ones, the one further left."""
        for mine, theirs in zip(self.sizes, other.sizes, strict=True):
            if mine.most < theirs.least or mine.least > theirs.most:
                return mine.most < theirs.least
            if mine.times != theirs.times and mine.exact != theirs.exact:
                return mine.exact < theirs.exact
        return self._place < other._place

    @cached_property
    def _place(self) -> tuple[list[tuple[Fraction, Fraction]], bool, bool]:
        """Where it is, exactly; whether it is a lens, or else a lobe with the leftmost vertex of its loop."""
        drawn, is_lens = self.plan.drawn, self.move.is_lens
        assert drawn.outline is not None
        crossing = np.unique(drawn.crossing_of_visit[list(self.move.visits)])
        places = sorted(map(self.plan.areas.place, (len(drawn.outline) + crossing).tolist()))
        return places, is_lens, not is_lens and self.plan.has_leftmost(self.move.runs[0])


class _Known(NamedTuple):
    """What is known of a move: the last change that was found, and what it cannot be less than now.

    ``is_now`` is false if something was changed since then that may concern it. Of all that was known of a move the
    highest number counts.
    """

    least: tuple[float, float]
    number: int
    change: Change
    is_now: bool


@dataclass(eq=False)
class Changes:
    """The changes that moves would make, each found out when it may be the smallest one.

    Parameters
    ----------
    most : (float, float)
        What changes more is surely not allowed.
    """

    most: tuple[float, float]
    _known: dict[Move, _Known] = field(default_factory=dict)
    # Those that may be allowed: by what they cannot be less than, and those that may come first in their order.
    _waiting: list[_Known] = field(default_factory=list)
    _ready: list[tuple[Change, int]] = field(default_factory=list)
    _refused: list[tuple[Change, int]] = field(default_factory=list)
    _at_cell: defaultdict[int, set[Move]] = field(default_factory=lambda: defaultdict(set))
    _at_border: defaultdict[int, set[Move]] = field(default_factory=lambda: defaultdict(set))
    _number: int = 0

    def __contains__(self, move: Move) -> bool:
        return move in self._known

    def put(self, change: Change, is_possible: bool) -> None:
        """Take in what a move would change now; one that is not possible waits until something near it is changed."""
        self._know(change, change.least, is_now=True, is_possible=is_possible)
        for where, numbers in ((self._at_cell, change.effect.inside), (self._at_border, change.borders)):
            for number in numbers:
                where[number].add(change.move)

    def _know(self, change: Change, least: tuple[float, float], is_now: bool, is_possible: bool = True) -> None:
        self._number += 1
        known = self._known[change.move] = _Known(least, self._number, change, is_now)
        if is_possible and least[0] <= self.most[0] and least[1] <= self.most[1]:
            heappush(self._waiting, known)

    def touch(self, cells: Iterable[int], borders: Iterable[int], by: tuple[float, float]) -> None:
        """Take in that something was changed at some cells and borders: changes there may be less by so much."""
        touched: dict[Move, None] = {}
        for where, numbers in ((self._at_cell, cells), (self._at_border, borders)):
            for number in numbers:
                touched |= dict.fromkeys(where.get(number, ()))
        for move in touched:
            if move in self._known:
                least, _, change, _ = self._known[move]
                self._know(change, (max(least[0] - by[0], 0.0), max(least[1] - by[1], 0.0)), is_now=False)

    def forget(self, move: Move) -> None:
        """Forget a move: it is made, or no longer possible."""
        del self._known[move]

    def reconsider(self) -> None:
        """Take in that more may be allowed than before."""
        for ready in self._refused:
            heappush(self._ready, ready)
        self._refused = []

    def smallest(self, look_at: Callable[[Move], None], judge: Callable[[Change], bool | None]) -> Change | None:
        """Return the smallest change that is allowed.

        Parameters
        ----------
        look_at : callable
            Asked to find out what a move would change now, where that may have become less, and to put it in.
        judge : callable
            Tells whether a change is allowed; None if the move is no longer possible.
        """
        while True:
            self._make_ready(look_at)
            if not self._ready:
                return None
            change, number = self._ready[0]
            verdict = judge(change) if self._counts(change.move, number) else None
            if verdict:
                return change
            heappop(self._ready)
            if verdict is False:
                self._refused.append((change, number))

    def _make_ready(self, look_at: Callable[[Move], None]) -> None:
        """Make ready what may come before all that is ready."""
        while self._waiting and not (self._ready and self._ready[0][0].comes_before_all(self._waiting[0].least)):
            _, number, change, is_now = heappop(self._waiting)
            if self._counts(change.move, number):
                if is_now:
                    heappush(self._ready, (change, number))
                else:
                    look_at(change.move)

    def _counts(self, move: Move, number: int) -> bool:
        return move in self._known and self._known[move].number == number
