"""How many layerings there are: the solutions of the problem of orders, class of pairs by class of pairs."""

from __future__ import annotations

from functools import cache
from itertools import product

from plyfold.clock import Clock
from plyfold.immersion.immersion import Immersion
from plyfold.layering.orders.search import OrderProblem, order_problem_in_time, undecided
from plyfold.layering.tables import Relation, Table, TooLargeError, count_solutions
from plyfold.obstruction import Obstruction, Unknown

__all__ = ["count_layerings", "count_orders"]

# So few variables are tried in all combinations.
_FEW = 14

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
    """Count the solutions of the problem. Raises TimeoutError when the time is over, and TooLargeError.

    Parts of it that have no variable in common are counted each alone.
    """
    parts: dict[int, list[list[int]]] = {}
    for part, triple in zip(problem.parts.tolist(), problem.triples.tolist(), strict=True):
        parts.setdefault(part, []).append(triple)
    total, large = 1, []
    n_free = problem.n_variables
    for triples in clock.while_time(parts.values()):
        variables = sorted({abs(x) for triple in triples for x in triple})
        n_free -= len(variables)
        if len(variables) <= _FEW:
            total *= _count_few(variables, triples)
        else:
            large += triples
    return total * count_solutions(map(_table_of, clock.while_time(large)), clock) << n_free


def _count_few(variables: list[int], triples: list[list[int]]) -> int:
    """Count the values of some variables for which no triple is all true or all false.

    Whatever depends on n variables is a number of 2^n bits, one for each combination of their values.
    """
    everywhere = (1 << (1 << len(variables))) - 1
    truth = {}
    for place, variable in enumerate(variables):
        truth[variable] = _truth(place, len(variables))
        truth[-variable] = truth[variable] ^ everywhere
    possible = everywhere
    for x, y, z in triples:
        possible &= (truth[x] | truth[y] | truth[z]) & ~(truth[x] & truth[y] & truth[z])
    return possible.bit_count()


@cache
def _truth(place: int, n: int) -> int:
    """Return a number of 2^n bits, of which bit i is bit ``place`` of i."""
    half = 1 << place
    return ((1 << (1 << n)) - 1) // ((1 << 2 * half) - 1) * (((1 << half) - 1) << half)


def _table_of(triple: list[int]) -> Table:
    """Return the values for which the literals are not all true and not all false."""
    variables = tuple(sorted({abs(x) for x in triple}))
    return Table(variables, _not_all_equal(tuple((variables.index(abs(x)), x > 0) for x in triple)))


@cache
def _not_all_equal(literals: tuple[tuple[int, bool], ...]) -> Relation:
    """Return the values for which literals, each the place of its variable and its sign, are not all equal."""
    rows = product((0, 1), repeat=1 + max(place for place, _ in literals))
    kept = tuple(row for row in rows if len({row[place] == sign for place, sign in literals}) == 2)
    return Relation(kept, (1,) * len(kept))
