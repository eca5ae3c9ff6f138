"""How many layerings there are, exactly: one class of pairs after the other is counted out.

A table lists the orders of some classes of pairs that are possible so far, each with the number of ways to complete it
by classes that are no longer there. To count out a class, join all tables that have it, and add up the rows that differ
in nothing else. Classes with few neighbours go first, so that tables stay small; parts of the problem that have no
class in common never share a table.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from itertools import permutations, product

from plyfold.clock import Clock
from plyfold.immersion.immersion import Immersion
from plyfold.layering.orders.problem import OrderProblem, order_problem
from plyfold.layering.orders.search import undecided
from plyfold.obstruction import Obstruction, Unknown

__all__ = ["count_layerings", "count_solutions"]

_QUESTION = "how many layerings there are"
_MOST_ROWS = 2_000_000
_ROWS_AT_A_TIME = 4096


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
    try:
        problem = order_problem(immersion, clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock)
    if isinstance(problem, Obstruction):
        return 0
    try:
        return count_solutions(problem, clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock, problem)
    except _TooLargeError:
        return undecided("size", _QUESTION, clock, problem)


def count_solutions(problem: OrderProblem, clock: Clock) -> int:
    """Count the solutions of the problem. Raises TimeoutError when the time is over."""
    order = _elimination_order(problem, clock)
    position = {variable: number for number, variable in enumerate(order)}
    waiting: defaultdict[int, list[_Table]] = defaultdict(list)
    for triple in clock.while_time(problem.triples.tolist()):
        table = _table_of(triple)
        waiting[min(table.variables, key=position.__getitem__)].append(table)
    total = 1 << (problem.n_variables - len(order))
    for variable in order:
        table = _joined(waiting.pop(variable), clock).without(variable)
        if table.variables:
            waiting[min(table.variables, key=position.__getitem__)].append(table)
        else:
            total *= table.rows.get((), 0)
    return total


class _TooLargeError(Exception):
    """A table has too many rows."""


@dataclass(frozen=True)
class _Table:
    """For some variables, the values that are possible, and the number of ways for each."""

    variables: tuple[int, ...]
    rows: dict[tuple[bool, ...], int]

    def without(self, variable: int) -> _Table:
        """Return the table with a variable counted out."""
        at = self.variables.index(variable)
        rows: defaultdict[tuple[bool, ...], int] = defaultdict(int)
        for row, ways in self.rows.items():
            rows[row[:at] + row[at + 1 :]] += ways
        return _Table(self.variables[:at] + self.variables[at + 1 :], rows)

    def join(self, other: _Table, clock: Clock) -> _Table:
        """Return the table of values that are possible in both."""
        mine = [self.variables.index(x) for x in other.variables if x in self.variables]
        common = [i for i, x in enumerate(other.variables) if x in self.variables]
        new = [i for i, x in enumerate(other.variables) if x not in self.variables]
        matching = defaultdict(list)
        for row, ways in other.rows.items():
            matching[tuple(row[i] for i in common)].append((tuple(row[i] for i in new), ways))
        rows: dict[tuple[bool, ...], int] = {}
        for number, (row, ways) in enumerate(self.rows.items()):
            if number % _ROWS_AT_A_TIME == 0:
                _require_room(len(rows), clock)
            for more, other_ways in matching.get(tuple(row[i] for i in mine), ()):
                rows[row + more] = ways * other_ways
        return _Table(self.variables + tuple(other.variables[i] for i in new), rows)


def _require_room(rows: int, clock: Clock) -> None:
    if rows > _MOST_ROWS:
        raise _TooLargeError
    if clock.over:
        raise TimeoutError


def _table_of(triple: list[int]) -> _Table:
    """Return the values for which the literals are not all true and not all false."""
    variables = tuple(sorted({abs(x) for x in triple}))
    at = [variables.index(abs(x)) for x in triple]
    rows = product((False, True), repeat=len(variables))
    kept = (row for row in rows if len({row[i] == (x > 0) for i, x in zip(at, triple, strict=True)}) == 2)
    return _Table(variables, dict.fromkeys(kept, 1))


def _joined(tables: list[_Table], clock: Clock) -> _Table:
    """Return the join of tables: the largest first, and then always one that adds fewest variables."""
    rest = sorted(tables, key=lambda table: len(table.rows))
    whole = rest.pop()
    while rest:
        new = [len(set(table.variables) - set(whole.variables)) for table in rest]
        whole = whole.join(rest.pop(new.index(min(new))), clock)
    return whole


def _elimination_order(problem: OrderProblem, clock: Clock) -> list[int]:
    """Return the variables that have constraints, always one next that has fewest neighbours, old ones or by joins."""
    neighbours: defaultdict[int, set[int]] = defaultdict(set)
    for triple in clock.while_time(problem.triples.tolist()):
        for first, second in permutations(map(abs, triple), 2):
            neighbours[first] |= {second}
    for variable, others in neighbours.items():
        others.discard(variable)
    order = []
    while neighbours:
        _require_room(0, clock)
        variable = min(neighbours, key=lambda x: len(neighbours[x]))
        others = neighbours.pop(variable)
        for other in others:
            neighbours[other] |= others
            neighbours[other] -= {other, variable}
        order.append(variable)
    return order
