"""Moves that turn out not to be needed once all are made: they are taken back."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from plyfold.clock import Clock
from plyfold.offers.greedy import Caps, is_within, numbers_allow, rerouted_by
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
    turns = {} if has_lenses or plan.drawn.n_loops > 1 else _turns_of_lobes(plan, kept)
    stretch = len(kept)
    made = _made(plan, kept)
    while stretch > 1:
        stretch = -(-stretch // 2)
        for start in range(0, len(kept), stretch)[::-1]:
            clock.check()
            end = min(start + stretch, len(kept))
            if not _turn_alike(turns, kept[start:end], plan) or made.are_needed(start, end):
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
    winding : list of int
        In the end.
    n_positive, n_negative : int
        How many cells have such a winding number.
    times : sequence of mapping from cell to int
        By how much each move changed winding numbers.
    touched : sequence of set of int
        The borders at which each changed what moves there would do, or whether they can be done.
    last_at : mapping from border to int
        The last move along each border.
    """

    winding: list[int]
    n_positive: int
    n_negative: int
    times: Sequence[Mapping[int, int]]
    touched: Sequence[set[int]]
    last_at: Mapping[int, int]

    def are_needed(self, start: int, end: int) -> bool:
        """Tell whether without some of the moves there surely are cells of both signs."""
        if any(self.last_at.get(border, -1) >= end for at in range(start, end) for border in self.touched[at]):
            return False  # Later moves would do something else.
        fewer: dict[int, int] = {}
        for at in range(start, end):
            for cell, more in self.times[at].items():
                fewer[cell] = fewer.get(cell, self.winding[cell]) - more
        before = [self.winding[cell] for cell in fewer]
        n_positive = self.n_positive - _count_positive(before) + _count_positive(fewer.values())
        n_negative = self.n_negative - _count_negative(before) + _count_negative(fewer.values())
        return n_positive > 0 and n_negative > 0


def _count_positive(numbers: Iterable[int]) -> int:
    return sum(number > 0 for number in numbers)


def _count_negative(numbers: Iterable[int]) -> int:
    return sum(number < 0 for number in numbers)


def _made(plan: Plan, moves: Sequence[Move]) -> _Made:
    left = Rerouted.of(plan)
    times, touched = [], []
    last_at: dict[int, int] = {}
    for at, move in enumerate(moves):
        effect = left.effect(move)
        places = [border for run in move.runs for border in plan.places(run)]
        last_at |= dict.fromkeys(places, at)
        ended = move.visits if move.is_lens else left.visits_in(move.runs[0])
        touched.append({*places, *(plan.border_before[visit] for visit in ended)})
        times.append(effect.times)
        left.make(move, effect)
    return _Made(left.winding, _count_positive(left.winding), _count_negative(left.winding), times, touched, last_at)


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


def _turns_of_lobes(plan: Plan, moves: Sequence[Move]) -> dict[Move, int]:
    """Return how often the outline turns less without each of some lobes, of which none lies in another."""
    left = Rerouted.of(plan)
    turns = {}
    for move in moves:
        before = left.turning
        left.make(move, left.effect(move))
        turns[move] = before - left.turning
    return turns


def _turn_alike(turns: dict[Move, int], moves: Sequence[Move], plan: Plan) -> bool:
    """Tell whether an outline can turn as often as it should with some lobes and without them."""
    more = abs(sum(turns[move] for move in moves)) if turns else 0
    # Turned round, it turns once the other way, and each cusp is one too many for both.
    return more == 0 or (plan.drawn.winding.min() < 0 and more == 2 + 2 * int(plan.drawn.cusp_index.sum()))
