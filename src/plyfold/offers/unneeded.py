"""Moves that turn out not to be needed once all are made: they are taken back."""

from __future__ import annotations

from collections.abc import Callable, Sequence

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
    while stretch > 1:
        stretch = -(-stretch // 2)
        for start in range(0, len(kept), stretch)[::-1]:
            clock.check()
            fewer = kept[:start] + kept[start + stretch :]
            if not _turn_alike(turns, kept[start : start + stretch], plan):
                continue
            left = rerouted_by(plan, fewer)
            if left is not None and numbers_allow(left) and is_within(left, caps) and is_enough(left):
                kept = fewer
    return kept


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
