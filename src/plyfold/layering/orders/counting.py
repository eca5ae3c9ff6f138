"""How many layerings there are: the solutions of the problem of orders, class of pairs by class of pairs."""

from __future__ import annotations

from itertools import product

import numpy as np

from plyfold.clock import Clock
from plyfold.immersion.immersion import Immersion
from plyfold.layering.orders.search import OrderProblem, order_problem_in_time, undecided
from plyfold.layering.tables import Table, TooLargeError, count_solutions
from plyfold.obstruction import Obstruction, Unknown

__all__ = ["count_layerings", "count_orders"]

_QUESTION = "how many layerings there are"


def count_layerings(immersion: Immersion, time_limit: float | None = None) -> int | Unknown:
    """Count the layerings of an immersed disk, exactly.

    Parameters
    ----------
    immersion : Immersion
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    int or Unknown
        At most 2^(k/2) for k crossings ([EM09]_, theorem 6), and 0 if there is none. A layering turned upside down is
        another one, so the number is even if the curve crosses itself. Unknown at the time limit, or if a table would
        have more than two million rows.

    Raises
    ------
    MemoryLimitError
        If the pairs or triples of sheets would not fit into memory.

    Notes
    -----
    The number may have hundreds of digits. What counts is how tightly the orders of sheets depend on each other, and
    not how many there are: long ribbons and chains take a fraction of a second. Exponential in the worst case, as for
    curves that cover themselves ten times and more all over.

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> count_layerings(find_immersion([(0, 0), (1, 0), (0, 1)]))
    1
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> count_layerings(find_immersion(ramp))
    2
    """
    clock = Clock(time_limit)
    problem = order_problem_in_time(immersion, clock, _QUESTION)
    if not isinstance(problem, OrderProblem):
        return 0 if isinstance(problem, Obstruction) else problem
    try:
        return count_orders(problem, clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock, problem)
    except TooLargeError:
        return undecided("size", _QUESTION, clock, problem)


def count_orders(problem: OrderProblem, clock: Clock) -> int:
    """Count the solutions of the problem. Raises TimeoutError when the time is over, and TooLargeError."""
    triples = problem.triples
    free = problem.n_variables - len(np.unique(np.abs(triples)))
    return count_solutions(map(_table_of, clock.while_time(triples.tolist())), clock) << free


def _table_of(triple: list[int]) -> Table:
    """Return the values for which the literals are not all true and not all false."""
    variables = tuple(sorted({abs(x) for x in triple}))
    at = [variables.index(abs(x)) for x in triple]
    rows = product((False, True), repeat=len(variables))
    kept = (row for row in rows if len({row[i] == (x > 0) for i, x in zip(at, triple, strict=True)}) == 2)
    return Table(variables, dict.fromkeys(kept, 1))
