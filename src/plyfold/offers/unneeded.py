"""Moves that turn out not to be needed once all are made: they are taken back."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from plyfold.clock import Clock
from plyfold.offers.greedy import Caps, is_within, may_bound, numbers_allow, rerouted_by
from plyfold.offers.rerouted import Move, Plan, Rerouted

__all__ = ["needed"]


def needed(
    plan: Plan, caps: Caps, moves: Sequence[Move], is_enough: Callable[[Rerouted], bool], clock: Clock
) -> list[Move]:
    """Return moves that are good enough without any of the others.

    Parameters
    ----------
    plan : Plan
    caps : Caps
        What is changed without some moves may be more than with them, since one may undo what another one did.
    moves : sequence of Move
        Good enough, in the order in which they are made.
    is_enough : callable
        Asked of an outline whose numbers allow a surface.
    clock : Clock

    Notes
    -----
    Whole stretches are taken back first, the latest ones before earlier ones, each half as long as those before; and
    single moves at last.
    """
    has_lenses = any(move.is_lens for move in moves)
    kept = list(moves) if has_lenses else _outermost(plan, moves)
    stretch = len(kept)
    made = _made(plan, kept)
    while stretch > 1:
        stretch = -(-stretch // 2)
        for start in range(0, len(kept), stretch)[::-1]:
            clock.check()
            end = min(start + stretch, len(kept))
            if made.are_needed(start, end):
                continue
            fewer = kept[:start] + kept[end:]
            left = rerouted_by(plan, fewer)
            if left is not None and numbers_allow(left) and is_within(left, caps) and is_enough(left):
                kept, made = fewer, _made(plan, fewer)
    return kept


@dataclass(frozen=True, eq=False)
class _Made:
    """Some moves that were made one after the other.

    Parameters
    ----------
    left : Rerouted
        What is left in the end.
    n_positive, n_negative : int
        How many cells have such a winding number.
    times : sequence of mapping from cell to int
        By how much each move changed winding numbers.
    turns : sequence of int
        How often the outline turned more after each.
    touched : sequence of set of (bool, int)
        The borders where each changed what moves would do, or whether they can be done: of lobes, or of lenses.
    last_at : mapping from (bool, int) to int
        The last lobe along each border, and the last lens.
    """

    left: Rerouted
    n_positive: int
    n_negative: int
    times: Sequence[Mapping[int, int]]
    turns: Sequence[int]
    touched: Sequence[set[tuple[bool, int]]]
    last_at: Mapping[tuple[bool, int], int]

    def are_needed(self, start: int, end: int) -> bool:
        """Tell whether numbers surely allow no surface without some of the moves."""
        if any(self.last_at.get(border, -1) >= end for at in range(start, end) for border in self.touched[at]):
            return False  # Later moves would do something else.
        fewer: dict[int, int] = {}
        for at in range(start, end):
            for cell, more in self.times[at].items():
                fewer[cell] = fewer.get(cell, self.left.winding[cell]) - more
        before = [self.left.winding[cell] for cell in fewer]
        n_positive = self.n_positive - _count_positive(before) + _count_positive(fewer.values())
        n_negative = self.n_negative - _count_negative(before) + _count_negative(fewer.values())
        turning = self.left.turning - sum(self.turns[start:end])
        return not may_bound(self.left.plan, n_positive > 0, n_negative > 0, turning)


def _count_positive(numbers: Iterable[int]) -> int:
    return sum(number > 0 for number in numbers)


def _count_negative(numbers: Iterable[int]) -> int:
    return sum(number < 0 for number in numbers)


def _made(plan: Plan, moves: Sequence[Move]) -> _Made:
    left = Rerouted.of(plan)
    times, turns, touched = [], [], []
    last_at: dict[tuple[bool, int], int] = {}
    for at, move in enumerate(moves):
        effect, before = left.effect(move), left.turning
        last_at |= {(move.is_lens, border): at for run in move.runs for border in plan.places(run)}
        touched.append(_touched(left, move))
        times.append(effect.times)
        left.make(move, effect)
        turns.append(left.turning - before)
    n_positive, n_negative = _count_positive(left.winding), _count_negative(left.winding)
    return _Made(left, n_positive, n_negative, times, turns, touched, last_at)


def _touched(left: Rerouted, move: Move) -> set[tuple[bool, int]]:
    """Return the borders along which other lobes and lenses would do something else after a move, or could be done."""
    plan = left.plan
    places = {border for run in move.runs for border in plan.places(run)}
    ended = move.visits if move.is_lens else left.visits_in(move.runs[0])
    for_lobes = places if move.is_lens else {*places, plan.border_before[move.runs[0].start]}
    for_lenses = {*places, *(plan.border_before[visit] for visit in ended)}
    return {(False, border) for border in for_lobes} | {(True, border) for border in for_lenses}


def _outermost(plan: Plan, moves: Sequence[Move]) -> list[Move]:
    """Return the lobes that are not left out together with later ones."""
    gone = [False] * plan.drawn.n_borders
    kept = []
    for move in reversed(moves):
        lobe = move.runs[0]
        if not gone[plan.border_after[lobe.start]]:
            kept.append(move)
            for border in plan.places(lobe):
                gone[border] = True
    return kept[::-1]
