"""The exact search for a layering of an immersed disk, or for the reason why there is none (§3 of the paper)."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping
from itertools import chain
from typing import Literal, TypeAlias, cast

import numpy as np

from plyfold.clock import Clock, Progress
from plyfold.errors import InputError, TimeLimitError
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.problem import OrderProblem, order_problem, places_of_cells
from plyfold.layering.sat import minimal_core, solve
from plyfold.loading import FOR_LAYERINGS, load_libraries
from plyfold.obstruction import Obstruction, Unknown

__all__ = ["FixedOrders", "Progress", "find_layering", "first_layering", "solve_orders", "undecided"]

FixedOrders: TypeAlias = Mapping[tuple[int, int, int], Literal["above", "below"]]

_QUESTION = "whether there is a layering"
_NOTHING: FixedOrders = {}


def find_layering(
    immersion: Immersion,
    time_limit: float | None = None,
    fix: FixedOrders | None = None,
    method: Literal["exact", "paper"] = "exact",
) -> Layering | Obstruction | Unknown:
    """Find an order of the sheets over every cell that all gluings keep, or prove that there is none.

    Parameters
    ----------
    immersion : Immersion
    time_limit : float, optional
        Seconds after which to give up; none by default.
    fix : mapping of (cell, sheet_a, sheet_b) to "above" or "below", optional
        Orders that the layering must have: over the cell, sheet a lies above or below sheet b.
    method : {"exact", "paper"}
        Decide exactly, or follow the paper's linear spanning subtrees, which may fail where there is a layering and
        then says so; see :mod:`plyfold.paper.layering`. The latter knows no time limit and no fixed orders.

    Returns
    -------
    Layering or Obstruction or Unknown
        The result is true if there is a layering; it has been checked. An obstruction holds the reason: a chain of
        cells along which a pair of sheets returns reversed (``value`` is a tuple of (cell, lower, upper)), sheets that
        would have to lie above each other in a circle (``value`` is a tuple of (cell, three sheets)), or fixed orders
        that contradict each other (``value`` is a tuple of (cell, sheet a, sheet b, "above" or "below")). None of the
        latter two can be left out, unless the time limit ended the search for the fewest. If the limit was reached
        before there was an answer, it is Unknown.

    Raises
    ------
    InputError
        If ``fix`` names a sheet that does not lie over the cell, or a sheet twice; if there is no such method, or
        it knows no fixed orders and no time limit.
    MemoryLimitError
        If the pairs or triples of sheets would not fit into memory.

    Notes
    -----
    Exact in both directions. The problem is NP-complete [EM09]_; the instances of drawings are solved at once. The
    classes of pairs cost O(Σ w²), and triples of sheets O(Σ w³).

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> lower, upper = ramp.sheets[1]
    >>> find_layering(ramp, fix={(1, lower, upper): "below"}).level.tolist()
    [1, 2, 1, 1, 1]
    >>> find_layering(ramp, fix={(1, lower, upper): "above"}).level.tolist()
    [2, 1, 1, 1, 1]
    """
    if method == "paper":
        if fix or time_limit is not None:
            raise InputError(
                "the paper's way knows no fixed orders and no time limit",
                hint='leave out "fix" and "time_limit", or use method="exact"',
            )
        from plyfold.paper.layering import paper_layering

        return paper_layering(immersion)
    if method != "exact":
        raise InputError(f'method must be "exact" or "paper", not {method!r}')
    clock = Clock(time_limit)
    try:
        problem = order_problem(immersion, clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock)
    return problem if isinstance(problem, Obstruction) else solve_orders(problem, clock, fix or {})


def solve_orders(problem: OrderProblem, clock: Clock, fix: FixedOrders = _NOTHING) -> Layering | Obstruction | Unknown:
    """Return a solution of the problem with some orders fixed, or why there is none."""
    fixed = _fixed_literals(problem, fix)
    try:
        true = solve(chain(problem.clauses, ([literal] for literal in fixed)), clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock, problem)
    if true is not None:
        return problem.layering(true)
    return _contradiction(problem, fix, fixed, clock)


def first_layering(
    candidates: Iterable[Immersion], time_limit: float | None = None, progress: Progress | None = None
) -> tuple[Layering | Obstruction, int]:
    """Find the first of several immersions that can be layered.

    Parameters
    ----------
    candidates : iterable of Immersion
        At least one, for example all immersions of a curve.
    time_limit : float, optional
        Seconds for all of them together, once the libraries are loaded; none by default.
    progress : callable, optional
        Called with a few words and the fraction done before each immersion.

    Returns
    -------
    Layering or Obstruction
        The obstruction is that of the first immersion.
    int
        How many immersions were examined.

    Raises
    ------
    TimeLimitError
        If the time limit was reached: the answer is unknown.
    """
    load_libraries(FOR_LAYERINGS, progress)
    clock = Clock(time_limit)
    first: Obstruction | None = None
    examined = 0
    for examined, immersion in enumerate(candidates, 1):
        stage = f"layering immersion {examined}"
        if progress is not None:
            progress(stage, 0.0)
        found = find_layering(immersion, clock.left)
        if isinstance(found, Layering):
            return found, examined
        if isinstance(found, Unknown):
            raise TimeLimitError(
                f"whether the surface can be layered is unknown after {time_limit or 0:.3g} seconds, which ended while "
                f"{stage}",
                hint="allow more time",
                stage=stage,
            )
        first = found if first is None else first
    if first is None:
        raise ValueError("there is no immersion to layer")
    return first, examined


def undecided(reason: str, question: str, clock: Clock, problem: OrderProblem | None = None) -> Unknown:
    """Return the answer to a question that was left open, with what is known of the problem."""
    seconds = clock.spent
    why = f"after {seconds:.3g} s" if reason == "time limit" else "for want of memory"
    sentence = f"Unknown {why}: {question}."
    if problem is None:
        return Unknown(reason, sentence, {"seconds": seconds})
    known = {"pair classes": problem.n_variables, "triples": len(problem.triples), "seconds": seconds}
    sentence += (
        f" No pair of sheets returns reversed; {problem.n_variables} classes of pairs are to be ordered under "
        f"{len(problem.triples)} constraints."
    )
    return Unknown(reason, sentence, known)


def _fixed_literals(problem: OrderProblem, fix: FixedOrders) -> list[int]:
    """Return the literals that fixed orders make true; refuse what are not two sheets over the cell."""
    pairs = []
    for key, order in fix.items():
        if order not in ("above", "below"):
            raise InputError(f'a sheet lies "above" or "below" another one, not {order!r}')
        cell, first, second = _cell_and_sheets(key)
        _require_sheets(problem.immersion, cell, first, second)
        pairs.append((second, first) if order == "above" else (first, second))
    lower, upper = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    return [int(literal) for literal in problem.above(lower, upper)]


def _cell_and_sheets(key: object) -> tuple[int, int, int]:
    try:
        cell, first, second = (operator.index(number) for number in cast(tuple[int, int, int], key))
    except (TypeError, ValueError):
        raise InputError(f"a fixed order is for (cell, sheet a, sheet b), not for {key!r}") from None
    return cell, first, second


def _require_sheets(immersion: Immersion, cell: int, first: int, second: int) -> None:
    if not 0 <= cell < immersion.arrangement.n_cells:
        raise InputError(f"there is no cell {cell}: cells are numbered 0 to {immersion.arrangement.n_cells - 1}")
    sheets = immersion.sheets[cell]
    if first == second or first not in sheets or second not in sheets:
        raise InputError(
            f"{first} and {second} are not two sheets over cell {cell}",
            where=places_of_cells(immersion, [cell]),
            hint=f"its sheets are {list(sheets)}" if sheets else "no sheet lies over it",
        )


def _contradiction(problem: OrderProblem, fix: FixedOrders, fixed: list[int], clock: Clock) -> Obstruction:
    """Return why there is no solution: constraints that contradict each other, or only together with fixed orders."""
    if not fixed or _contradictory(problem, clock):
        return _cyclic_order(problem, clock)
    orders = [(*key, order) for key, order in fix.items()]
    value = tuple(orders[i] for i in minimal_core([[[x]] for x in fixed], problem.clauses, clock))
    listed = "; ".join(f"over cell {cell}, {a} {order} {b}" for cell, a, b, order in value)
    sentence = f"No layering has these fixed orders of sheets together: {listed}."
    places = places_of_cells(problem.immersion, [cell for cell, *_ in value])
    return Obstruction("fixed orders", sentence, places, value, problem.immersion)


def _contradictory(problem: OrderProblem, clock: Clock) -> bool:
    """Tell whether the constraints are known to contradict each other without any fixed orders."""
    try:
        return solve(problem.clauses, clock) is None
    except TimeoutError:
        return False


def _cyclic_order(problem: OrderProblem, clock: Clock) -> Obstruction:
    triples = problem.triples.tolist()
    core = minimal_core([[triple, [-x for x in triple]] for triple in triples], clock=clock)
    value = tuple((problem.cell_of(i), problem.sheets[i].tolist()) for i in core)
    triples_of_sheets = f"among {len(core)} triples of sheets, some three" if len(core) > 1 else "three sheets"
    sentence = f"No layering: {triples_of_sheets} always lie above each other in a circle."
    places = places_of_cells(problem.immersion, [cell for cell, _ in value])
    return Obstruction("cyclic order", sentence, places, value, problem.immersion)
