"""Small changes of an outline until its numbers allow a surface: always the one that changes the covered region least.

Of several that change it equally, the one that changes least how often it is covered; then the one furthest left. If
that is wanted, how often it is covered counts first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple, TypeVar

import numpy as np

from plyfold.arrays import Ints
from plyfold.clock import Clock
from plyfold.offers.areas import CellAreas, Measure
from plyfold.offers.changes import Change, Changes
from plyfold.offers.rerouted import Move, Plan, Rerouted, Run

__all__ = [
    "Aim",
    "Caps",
    "covered",
    "flips",
    "is_within",
    "made_until",
    "may_bound",
    "numbers_allow",
    "rerouted_by",
    "wholes",
]

_T = TypeVar("_T")

# Lobes that are too large by less than this part of the cap are looked at all the same.
_SLACK = 0.5


class Caps(NamedTuple):
    """What parts may change: of the covered area, and of all areas taken as often as they are covered."""

    region: float
    layers: float


class Aim(NamedTuple):
    """Which moves are made, and which of them first.

    Parameters
    ----------
    caps : Caps
        Moves that would change more, all together, are not made.
    all_lenses : bool
        Whether strands in one direction change places, too; else those alone that run against each other.
    layers_first : bool, optional
        Whether the smallest moves are those that change winding numbers least; else those that change the region least.
    """

    caps: Caps
    all_lenses: bool
    layers_first: bool = False


def numbers_allow(left: Rerouted) -> bool:
    """Tell whether numbers alone do not show that what is left bounds no disk; of several loops, no surface."""
    return may_bound(left.plan, max(left.winding) > 0, min(left.winding) < 0, left.turning)


def may_bound(plan: Plan, has_positive: bool, has_negative: bool, turning: int) -> bool:
    """Tell the same, given whether there are cells of either sign, and how often the outline turns."""
    if plan.drawn.n_loops > 1:
        return not (has_positive and has_negative)
    cusps = int(plan.drawn.cusp_index.sum())
    return (not has_negative and turning == 1) or (not has_positive and turning + 2 * cusps == -1)


def flips(winding: list[int], times: Mapping[int, int]) -> dict[int, int]:
    """Return the cells that are covered before a change and not after it, or the other way round, each once."""
    return {cell: 1 for cell, more in times.items() if (winding[cell] != 0) != (winding[cell] + more != 0)}


def is_within(left: Rerouted, caps: Caps) -> bool:
    """Tell whether all that was changed, from the drawing on, keeps within the caps, exactly."""
    plan, given = left.plan, left.plan.drawn.winding.tolist()
    more = {cell: now - then for cell, (then, now) in enumerate(zip(given, left.winding, strict=True)) if now != then}
    region = Measure.of(plan.areas, flips(given, more))
    layers = Measure.of(plan.areas, {cell: abs(times) for cell, times in more.items()})
    whole = wholes(plan)
    return _Spent(caps.region, whole[0]).allows(region) and _Spent(caps.layers, whole[1]).allows(layers)


def wholes(plan: Plan) -> tuple[Measure, Measure]:
    """Return the covered area, and the areas of all cells, each as often as it is covered."""
    return covered(plan.areas, plan.drawn.winding.tolist())


def covered(areas: CellAreas, winding: Sequence[int]) -> tuple[Measure, Measure]:
    """Return the same, given the winding numbers of the cells."""
    layers = {cell: abs(times) for cell, times in enumerate(winding) if times}
    return Measure.of(areas, dict.fromkeys(layers, 1)), Measure.of(areas, layers)


def rerouted_by(plan: Plan, moves: Iterable[Move]) -> Rerouted | None:
    """Return the outline after some moves; None if they are not all possible."""
    left = Rerouted.of(plan)
    for move in moves:
        if not left.can_be_done(move):
            return None
        left.make(move, left.effect(move))
    return left


def made_until(plan: Plan, aim: Aim, is_enough: Callable[[Rerouted], bool], clock: Clock) -> list[Move] | None:
    """Return the smallest moves in turn with which an outline is good enough; None if none is left before.

    Parameters
    ----------
    plan : Plan
    aim : Aim
    is_enough : callable
        Asked of an outline whose numbers allow a surface.
    clock : Clock

    Raises
    ------
    TimeoutError
        When the time is over.

    Notes
    -----
    O(n + k log k) for small loops.
    """
    search = _Search.of(plan, aim, clock)
    moves: list[Move] = []
    while not (numbers_allow(search.left) and is_enough(search.left)):
        clock.check()
        change = search.changes.smallest(search.look_again, search.judge)
        if change is None:
            return None
        search.make(change)
        moves.append(change.move)
    return moves


@dataclass(eq=False)
class _Spent:
    """How much is changed so far, of one of the two kinds, and how much may be.

    Parameters
    ----------
    times : dict from cell to int
        What is changed.
    rounded, error : float
        Its area.
    part : float
        The part of the whole that may be changed.
    whole : Measure
    """

    part: float
    whole: Measure
    times: dict[int, int] = field(default_factory=dict)
    rounded: float = 0.0
    error: float = 0.0

    @property
    def most_in_one(self) -> float:
        """What changes more is never allowed, even if it takes back all that is changed."""
        return self.part if self.part == float("inf") else 2 * self.part * self.whole.most

    def allows(self, more: Measure) -> bool:
        """Tell whether so much more can be changed, exactly."""
        if self.part == float("inf"):
            return True
        limit = self.part * self.whole.rounded
        total, error = self.rounded + more.rounded, self.error + more.error + self.part * self.whole.error
        error += 4 * np.finfo(np.float64).eps * (abs(self.rounded) + abs(more.rounded) + limit)
        if abs(total - limit) > error:
            return bool(total < limit)
        spent = Measure(more.areas, self.times, self.rounded, self.error)
        return spent.exact + more.exact <= Fraction(self.part) * self.whole.exact

    def add(self, more: Measure) -> None:
        """Take in what is changed."""
        for cell, times in more.times.items():
            self.times[cell] = self.times.get(cell, 0) + times
        self.rounded += more.rounded
        self.error += more.error + np.finfo(np.float64).eps * abs(self.rounded)


def _ordered(pair: tuple[_T, _T], layers_first: bool) -> tuple[_T, _T]:
    """Return what is known of the region and of the layers in the order in which they count."""
    return pair[::-1] if layers_first else pair


@dataclass(eq=False)
class _Search:
    """The outline on its way, what each move would change, and what has been changed."""

    plan: Plan
    aim: Aim
    clock: Clock
    left: Rerouted
    region: _Spent
    layers: _Spent
    changes: Changes
    # By how much areas between runs may have changed since large lobes were looked at.
    unseen: float = 0.0

    @classmethod
    def of(cls, plan: Plan, aim: Aim, clock: Clock) -> _Search:
        region, layers = (_Spent(part, whole) for part, whole in zip(aim.caps, wholes(plan), strict=True))
        changes = Changes(_ordered((region.most_in_one, layers.most_in_one), aim.layers_first))
        search = cls(plan, aim, clock, Rerouted.of(plan), region, layers, changes)
        search._look_at_lobes()
        search._look_at_lenses(range(len(plan.partner)))
        return search

    # ---- what moves would change -------------------------------------------------------------------------------------

    def judge(self, change: Change) -> bool | None:
        """Tell whether a change keeps all that is changed, from the drawing on, within the caps.

        None if the move is no longer possible; it is forgotten then.
        """
        if not self.left.can_be_done(change.move):
            self.changes.forget(change.move)
            return None
        return all(spent.allows(more) for spent, more in self._added(change))

    def _added(self, change: Change) -> list[tuple[_Spent, Measure]]:
        """Return by how much more of each kind would be changed in all."""
        region, layers = {}, {}
        given, now = self.plan.drawn.winding, self.left.winding
        for cell, times in change.effect.times.items():
            before, after = now[cell] - int(given[cell]), now[cell] + times - int(given[cell])
            layers[cell] = abs(after) - abs(before)
            was = given[cell] != 0
            region[cell] = int((now[cell] + times != 0) != was) - int((now[cell] != 0) != was)
        areas = self.plan.areas
        return [(self.region, Measure.of(areas, region)), (self.layers, Measure.of(areas, layers))]

    def _look_at_lobes(self) -> None:
        """Look at all lobes that are not surely too large: by the area between them, taken with its sign."""
        self.unseen = 0.0
        most = (1 + _SLACK) * self.layers.most_in_one
        for start, end in self._lobes_up_to(most).tolist():
            self.clock.check()
            lobe = Run(start, end)
            if self.left.is_live[start] and Move((lobe,)) not in self.changes and not self.plan.has_cusp(lobe):
                self._look_at(Move((lobe,)))

    def _lobes_up_to(self, most: float) -> Ints:
        """Return the first and the last visit of lobes with at most so much area, rows (first, last)."""
        drawn, moment = self.plan.drawn, self.plan.areas.moment
        along = np.array(
            [sum(-moment[dart // 2] if dart % 2 else moment[dart // 2] for dart in path) for path in self.left.path]
        )
        total = np.append(0.0, np.cumsum(along))
        start, end = drawn.border_after, drawn.border_before[drawn.partner]
        loop = drawn.loop_of_border[start]
        first = np.searchsorted(drawn.loop_of_border, np.arange(drawn.n_loops + 1))
        area = total[end + 1] - total[start] + np.where(start > end, (total[first[1:]] - total[first[:-1]])[loop], 0.0)
        visits = np.arange(len(start))
        is_lobe = (drawn.partner != visits) & (loop == loop[drawn.partner])
        error = 1e-9 * np.abs(along).sum()
        chosen = visits[is_lobe & (np.abs(area) <= most + error)]
        return np.stack([chosen, drawn.partner[chosen]], axis=1)

    def _look_at_lenses(self, visits: Iterable[int]) -> None:
        for visit in visits:
            for lens in self.left.lenses_at(visit) if self.left.is_live[visit] else ():
                if lens not in self.changes and (self.aim.all_lenses or self.left.runs_back(lens)):
                    self._look_at(lens)

    def _look_at(self, move: Move) -> None:
        """Find out what a move would change, as far as it is not surely too much."""
        plan, left = self.plan, self.left
        effect = left.effect(move, (self.region.most_in_one, self.layers.most_in_one))
        region = Measure.of(plan.areas, flips(left.winding, effect.times))
        layers = Measure.of(plan.areas, {cell: abs(more) for cell, more in effect.times.items()})
        borders = [dart // 2 for strand in move.runs for dart in left.darts(strand)]
        is_thin = not move.is_lens or left.is_thin(move, effect.inside)
        sizes = _ordered((region, layers), self.aim.layers_first)
        self.changes.put(Change(plan, move, effect, sizes, borders), effect.is_all and is_thin)

    def look_again(self, move: Move) -> None:
        """Find out what a move would change now, if it still is possible."""
        self.clock.check()
        if self.left.can_be_done(move):
            self._look_at(move)
        else:
            self.changes.forget(move)

    # ---- making one --------------------------------------------------------------------------------------------------

    def make(self, change: Change) -> None:
        """Make a move, and take in what it may concern."""
        added = self._added(change)
        for spent, more in added:
            spent.add(more)
        if any(more.least < 0 for _, more in added):
            self.changes.reconsider()
        cells = change.effect.inside
        beside = self.left.make(change.move, change.effect)
        self.changes.forget(change.move)
        once = Measure.of(self.plan.areas, dict.fromkeys(cells, 1)).most
        often = Measure.of(self.plan.areas, {cell: 2 * abs(times) for cell, times in cells.items()}).most
        self.changes.touch(cells, change.borders, _ordered((once, often), self.aim.layers_first))
        self._look_at_lenses(sorted(beside))
        self.unseen += often
        if self.unseen > _SLACK * self.layers.most_in_one:
            self._look_at_lobes()
