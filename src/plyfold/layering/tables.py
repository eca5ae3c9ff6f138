"""How many solutions constraints have, exactly: tables are joined, and what no other table knows is counted out.

A table holds the values of some variables that are possible together, each with the number of ways to complete it by
variables that are no longer there. To count out a variable, join all tables that have it, and add up the rows that
differ in nothing else. Always next is the variable whose tables leave fewest variables when they are joined. Parts of
the problem that have no variable in common never share a table, and their numbers multiply.
"""

from __future__ import annotations

import heapq
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from math import log
from typing import TypeAlias

from plyfold.clock import Clock

__all__ = ["Table", "TooLargeError", "count_solutions"]

Row: TypeAlias = tuple[int, ...]

_MOST_ROWS = 2_000_000
_ROWS_AT_A_TIME = 4096


class TooLargeError(Exception):
    """A table has too many rows."""


@dataclass(frozen=True, eq=False)
class Table:
    """For some variables, the values that are possible, and the number of ways for each.

    Parameters
    ----------
    variables : tuple of int
    rows : dict of tuple of int to int
    """

    variables: tuple[int, ...]
    rows: dict[Row, int]


def count_solutions(tables: Iterable[Table], clock: Clock) -> int:
    """Count the values of all variables that are possible in every table, weighted by the products of ways.

    Raises
    ------
    TimeoutError
        When the time is over.
    TooLargeError
        If a table has more than two million rows.

    Examples
    --------
    >>> unequal = {(0, 1): 1, (1, 0): 1}
    >>> count_solutions([Table((1, 2), unequal), Table((2, 3), unequal), Table((4, 5), unequal)], Clock(None))
    4
    """
    store = _Store(clock.while_time(tables))
    total = 1
    while (numbers := store.cheapest()) is not None:
        taken = [store.take(number) for number in numbers]
        gone = {variable for table in taken for variable in table.variables if not store.beside[variable]}
        joined = _joined(taken, gone, clock)
        if joined.variables:
            store.add(joined)
        else:
            total *= joined.rows.get((), 0)
    for table in store.current.values():  # those without variables
        total *= table.rows.get((), 0)
    return total


class _Store:
    """The tables that are left, by their numbers; which of them have each variable; and variables by their cost."""

    def __init__(self, tables: Iterable[Table]) -> None:
        self.current: dict[int, Table] = {}
        self.beside: defaultdict[int, set[int]] = defaultdict(set)
        self.waiting: list[tuple[int, float, int]] = []
        self.made = 0
        for table in tables:
            self._put(table)
        for variable in self.beside:
            heapq.heappush(self.waiting, (*self._cost(variable), variable))

    def add(self, table: Table) -> None:
        """Add a table; its variables have other costs now."""
        self._put(table)
        for variable in table.variables:
            heapq.heappush(self.waiting, (*self._cost(variable), variable))

    def _put(self, table: Table) -> None:
        self.current[self.made] = table
        for variable in table.variables:
            self.beside[variable].add(self.made)
        self.made += 1

    def take(self, number: int) -> Table:
        """Remove a table and return it."""
        table = self.current.pop(number)
        for variable in table.variables:
            self.beside[variable].discard(number)
        return table

    def cheapest(self) -> list[int] | None:
        """Return the tables of the variable to be counted out next; None if there is none left."""
        while self.waiting:
            *cost, variable = heapq.heappop(self.waiting)
            if self.beside[variable] and tuple(cost) == self._cost(variable):
                return sorted(self.beside[variable])
        return None

    def _cost(self, variable: int) -> tuple[int, float]:
        """Return how many variables stay when all tables of one are joined, and how large they are together."""
        tables = self.beside[variable]
        union = {other for number in tables for other in self.current[number].variables}
        stay = sum(not self.beside[other] <= tables for other in union)
        return stay, sum(log(1 + len(self.current[number].rows)) for number in sorted(tables))


def _joined(tables: list[Table], gone: set[int], clock: Clock) -> Table:
    """Return the join of tables, some variables counted out as soon as no table to come has them.

    The largest table comes first, and then always one that adds fewest variables.
    """
    rest = sorted(tables, key=lambda table: len(table.rows))
    whole = rest.pop()
    rest = rest or [Table((), {(): 1})]
    while rest:
        new = [len(set(table.variables) - set(whole.variables)) for table in rest]
        following = rest.pop(new.index(min(new)))
        to_come = {variable for table in rest for variable in table.variables}
        whole = _join(whole, following, gone - to_come, clock)
    return whole


def _join(first: Table, second: Table, gone: set[int], clock: Clock) -> Table:
    """Return the table of values that are possible in both, without some variables."""
    common = [place for place, variable in enumerate(second.variables) if variable in first.variables]
    mine = [first.variables.index(second.variables[place]) for place in common]
    kept = [place for place, variable in enumerate(first.variables) if variable not in gone]
    new = [place for place, variable in enumerate(second.variables) if variable not in {*first.variables, *gone}]
    matching: defaultdict[Row, list[tuple[Row, int]]] = defaultdict(list)
    for row, ways in second.rows.items():
        matching[_pick(row, common)].append((_pick(row, new), ways))
    rows: defaultdict[Row, int] = defaultdict(int)
    for number, (row, ways) in enumerate(first.rows.items()):
        if number % _ROWS_AT_A_TIME == 0:
            _require_room(len(rows), clock)
        start = _pick(row, kept)
        for more, other_ways in matching.get(_pick(row, mine), ()):
            rows[start + more] += ways * other_ways
    return Table(_pick(first.variables, kept) + _pick(second.variables, new), rows)


def _require_room(rows: int, clock: Clock) -> None:
    if rows > _MOST_ROWS:
        raise TooLargeError
    clock.check()


def _pick(row: Row, places: list[int]) -> Row:
    return tuple([row[place] for place in places])
