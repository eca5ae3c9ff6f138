"""The layering in which the curve changes least often between passing over and passing under.

Every crossing is visited twice, once over and once under, so without any further constraint this is the paint shop
problem of a row of cars, each to come twice, in both colours, with the fewest changes of colour: NP-hard already
[BEH06]_. MaxSAT solves it with all constraints on top; where that takes too long, a greedy walk along the curve has
found a layering that is fairly good.

References
----------
.. [BEH06] P. Bonsma, T. Epping, W. Hochstättler, "Complexity results on restricted instances of a paint shop problem
   for words", Discrete Applied Mathematics 154, 2006.
"""

from __future__ import annotations

from collections import Counter
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import chain

from plyfold.clock import Clock
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering, crossing_visits_by_loop, meeting_sheets
from plyfold.layering.orders.maxsat import equal_or_failing, fewest_failures
from plyfold.layering.orders.search import OrderProblem, order_problem_in_time, solve_orders, undecided
from plyfold.obstruction import Obstruction, Unknown
from plyfold.sat import StoppableSolver, search_in_time

__all__ = ["nicest_layering", "walked_layering"]

_QUESTION = "which layering changes least often between over and under"


def nicest_layering(immersion: Immersion, time_limit: float | None = None) -> Layering | Obstruction | Unknown:
    """Find a layering in which the curve changes least often between passing over and passing under.

    Parameters
    ----------
    immersion : Immersion
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    Layering or Obstruction or Unknown
        A layering with the fewest :attr:`Layering.changes`, the same for the same drawing; or the obstruction of
        :func:`find_layering`. If the time limit was reached, it is unknown which layering is the nicest; then
        ``established`` has a good one as ``"layering"``, if one was found, and a bound for all of them as
        ``"changes at least"``.

    Notes
    -----
    Exact, by MaxSAT over the orders of pairs of sheets; NP-hard.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> nicest_layering(find_immersion(ramp)).changes
    2
    """
    clock = Clock(time_limit)
    problem = order_problem_in_time(immersion, clock, _QUESTION)
    if not isinstance(problem, OrderProblem):
        return problem
    found = solve_orders(problem, clock)
    if not isinstance(found, Layering):
        return found
    over = _over(problem)
    good = found
    with suppress(TimeoutError):
        good = walked_layering(problem, clock)
    true, least = _fewest_changes(problem, over, clock)
    if true is not None:
        return problem.layering(true)
    unknown = undecided("time limit", _QUESTION, clock, problem)
    return replace(unknown, established={**unknown.established, "layering": good, "changes at least": least})


def walked_layering(problem: OrderProblem, clock: Clock) -> Layering:
    """Return a layering of a problem that has one, with few changes: a greedy one. Raises TimeoutError."""
    return problem.layering(_greedy(problem, list(chain(*_over(problem))), clock))


def _over(problem: OrderProblem) -> list[list[int]]:
    """Return for each visit to a crossing, loop by loop, the literal that is true if the strand passes over."""
    here, there = meeting_sheets(problem.immersion)
    loops = crossing_visits_by_loop(problem.immersion.arrangement)
    return [problem.above(there[visits], here[visits]).tolist() for visits in loops]


def _greedy(problem: OrderProblem, over: list[int], clock: Clock) -> list[int]:
    """Walk along the curve and change between over and under only where it cannot be helped."""
    return search_in_time(problem.clauses, clock, partial(_walk, over))


def _walk(over: list[int], solver: StoppableSolver) -> list[int]:
    over_now = True
    # Decisions become clauses: with more assumptions than variables, Glucose writes beyond its arrays.
    for literal in over:
        if not solver.solve([literal if over_now else -literal]):
            over_now = not over_now
        solver.add_clause([literal if over_now else -literal])
    solver.solve()
    return list(solver.get_model())


def _fewest_changes(problem: OrderProblem, over: list[list[int]], clock: Clock) -> tuple[list[int] | None, int]:
    """Return a solution with the fewest changes, None if the time is over, and a lower bound for its changes."""
    pairs = _neighbours(over)
    certain = sum(times for (first, second), times in pairs.items() if first == -second)
    open_pairs = [pair for pair in pairs if pair[0] != -pair[1]]
    change = dict(enumerate(open_pairs, problem.n_variables + 1))
    equal = equal_or_failing(change.values(), change)
    weight = {variable: pairs[pair] for variable, pair in change.items()}
    n_variables = problem.n_variables + len(change)
    true, least = fewest_failures(chain(problem.clauses, equal), n_variables, weight, clock)
    return true, certain + least


def _neighbours(over: list[list[int]]) -> Counter[tuple[int, int]]:
    """Count the pairs of different literals that follow each other along a loop, in either order, signs exchanged.

    The first literal has the smaller variable and is positive.
    """
    pairs = (pair for loop in over for pair in zip(loop, loop[1:] + loop[:1], strict=True))
    ordered = (sorted(pair, key=abs) for pair in pairs if pair[0] != pair[1])
    return Counter((abs(first), second if first > 0 else -second) for first, second in ordered)
