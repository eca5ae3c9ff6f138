"""What moves would change, the smallest change first, kept up to date while moves are made."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from heapq import heappop, heappush

import numpy as np

from plyfold.offers.areas import Measure, exact_places
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
    region, layers : Measure
        The area that would be covered and is not, or the other way round; and all changes of winding numbers.
    borders : collection of int
        Those along the runs of the move.
    """

    plan: Plan
    move: Move
    effect: Effect
    region: Measure
    layers: Measure
    borders: Collection[int]

    @property
    def least(self) -> tuple[float, float]:
        """It is not less than this."""
        return self.region.least, self.layers.least

    def comes_before_all(self, least: tuple[float, float]) -> bool:
        """Tell whether this comes before all changes that are at least so much: (region, layers) and what is above."""
        return least[0] > self.region.most or (least[0] == self.region.most and least[1] > self.layers.most)

    def comes_before(self, other: Change) -> bool:
        """Tell whether this is the smaller change, exactly; of equal ones, the one further left."""
        for mine, theirs in ((self.region, other.region), (self.layers, other.layers)):
            if mine.most < theirs.least or mine.least > theirs.most:
                return mine.most < theirs.least
            if mine.times != theirs.times and mine.exact != theirs.exact:
                return mine.exact < theirs.exact
        return self._place < other._place

    @property
    def _place(self) -> tuple[list[tuple[Fraction, Fraction]], bool, bool]:
        """Where it is, exactly; whether it is a lens, or else a lobe with the leftmost vertex of its loop."""
        drawn, is_lens = self.plan.drawn, self.move.is_lens
        assert drawn.outline is not None
        crossing = np.unique(drawn.crossing_of_visit[list(self.move.visits)])
        places = sorted(exact_places(drawn, len(drawn.outline) + crossing))
        return places, is_lens, not is_lens and self.plan.has_leftmost(self.move.runs[0])


@dataclass(eq=False)
class Changes:
    """The changes that moves would make.

    Parameters
    ----------
    of : dict from move to Change
        As they are now.
    """

    of: dict[Move, Change] = field(default_factory=dict)
    _waiting: list[tuple[float, float, int, Change]] = field(default_factory=list)
    _at_cell: defaultdict[int, set[Move]] = field(default_factory=lambda: defaultdict(set))
    _at_border: defaultdict[int, set[Move]] = field(default_factory=lambda: defaultdict(set))
    _number: int = 0

    def put(self, change: Change, may_be_allowed: bool) -> None:
        """Take in what a move would change, in place of what was known of it."""
        self.of[change.move] = change
        if may_be_allowed:
            self._wait(change)
        for where, numbers in ((self._at_cell, change.effect.inside), (self._at_border, change.borders)):
            for number in numbers:
                where[number].add(change.move)

    def _wait(self, change: Change) -> None:
        self._number += 1
        heappush(self._waiting, (*change.least, self._number, change))

    def out_of_date(self, cells: Iterable[int], borders: Iterable[int]) -> list[Move]:
        """Return the moves whose changes depend on some cells or borders, in the order in which they came in."""
        moves: dict[Move, None] = {}
        for where, numbers in ((self._at_cell, cells), (self._at_border, borders)):
            for number in numbers:
                moves |= dict.fromkeys(where.pop(number, ()))
        return list(moves)

    def smallest(self, is_possible: Callable[[Move], bool], is_allowed: Callable[[Change], bool]) -> Change | None:
        """Return the smallest change that is allowed; forget those of moves that are no longer possible."""
        passed = []
        best: Change | None = None
        while self._waiting and not (best and best.comes_before_all(self._waiting[0][:2])):
            change = heappop(self._waiting)[-1]
            if self.of.get(change.move) is not change:
                continue
            if not is_possible(change.move):
                del self.of[change.move]
                continue
            passed.append(change)
            if (best is None or change.comes_before(best)) and is_allowed(change):
                best = change
        for change in passed:
            self._wait(change)
        return best
