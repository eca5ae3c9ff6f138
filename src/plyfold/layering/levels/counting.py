"""How many solutions the equations between levels have: crossings are merged one after the other.

The *table* of some crossings holds the levels that are possible on the borders which lead out of them, each with the
number of ways to complete it inside. Two tables are merged by joining rows that agree on the borders in between, which
are then forgotten. Borders on which only one level is possible connect nothing, so a curve falls apart there, and the
numbers of the parts multiply.
"""

from __future__ import annotations

import heapq
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, count, permutations
from math import prod

import numpy as np

from plyfold.clock import Clock
from plyfold.layering.levels.equations import LevelEquations

__all__ = ["count_level_solutions"]


@dataclass(frozen=True, eq=False)
class _Table:
    """The possible levels on some borders, and in how many ways each is completed by what was merged."""

    borders: tuple[int, ...]
    ways: Counter[tuple[int, ...]]


def count_level_solutions(equations: LevelEquations, clock: Clock | None = None) -> int:
    """Count the solutions, exactly.

    Parameters
    ----------
    equations : LevelEquations
    clock : Clock, optional
        TimeoutError is raised when it is over.

    Returns
    -------
    int

    Notes
    -----
    Linear for curves that fall apart into small parts. The rows of a table are at most w to the power of the number of
    borders that lead out of it: O(√k) borders for a part with k crossings if tables are merged well, which is done
    greedily. So a part with hundreds of crossings can take all time and memory.

    Examples
    --------
    >>> from plyfold import arrange
    >>> from plyfold.layering.levels.equations import level_equations
    >>> ramp = arrange([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> count_level_solutions(level_equations(ramp))
    2
    """
    alone = np.setdiff1d(np.arange(len(equations.highest)), [equations.top, equations.bottom])
    tables = [_table_of_crossing(equations, crossing) for crossing in range(equations.n_crossings)]
    return prod([*equations.highest[alone].tolist(), *_merge_all(tables, clock or Clock(None))])


def _table_of_crossing(equations: LevelEquations, crossing: int) -> _Table:
    """Return the levels on the borders of one crossing, but not on those where there is only one or that lead back."""
    borders = equations.top[crossing].tolist() + equations.bottom[crossing].tolist()
    kept = [i for i, border in enumerate(borders) if borders.count(border) == 1 and equations.highest[border] > 1]
    same = [(i, j) for i, j in combinations(range(4), 2) if borders[i] == borders[j]]
    ways: Counter[tuple[int, ...]] = Counter()
    for a, b in permutations(range(1, int(equations.highest[borders[0]]) + 1), 2):
        levels = (a, b, a - (b < a), b - (a < b))
        if all(levels[i] == levels[j] for i, j in same):
            ways[tuple(levels[i] for i in kept)] += 1
    return _Table(tuple(borders[i] for i in kept), ways)


def _merge_all(tables: list[_Table], clock: Clock) -> Iterator[int]:
    """Merge tables as long as there are borders between them; yield the number of ways of each part."""
    current, numbers = dict(enumerate(tables)), count(len(tables))
    beside: dict[int, list[int]] = defaultdict(list)
    for number, table in current.items():
        for border in table.borders:
            beside[border].append(number)
    waiting = [(*_size(current[i], current[j]), i, j) for i, j in map(sorted, beside.values())]
    heapq.heapify(waiting)
    while waiting:
        *_, first, second = heapq.heappop(waiting)
        if first not in current or second not in current:
            continue
        new = next(numbers)
        current[new] = _merged(current.pop(first), current.pop(second), clock)
        for border in current[new].borders:
            (other,) = set(beside[border]) - {first, second}
            beside[border] = [other, new]
            heapq.heappush(waiting, (*_size(current[other], current[new]), other, new))
    for table in current.values():
        yield table.ways[()]


def _size(first: _Table, second: _Table) -> tuple[int, int]:
    """Return how many borders lead out of two tables when they are merged, and how many pairs of rows there are."""
    between = len(set(first.borders) & set(second.borders))
    return len(first.borders) + len(second.borders) - 2 * between, len(first.ways) * len(second.ways)


def _merged(first: _Table, second: _Table, clock: Clock) -> _Table:
    """Join two tables and forget the borders between them."""
    between = [border for border in first.borders if border in second.borders]
    own, key = _columns(first, between)
    other_own, other_key = _columns(second, between)
    matching: dict[tuple[int, ...], list[tuple[tuple[int, ...], int]]] = defaultdict(list)
    for row, number in second.ways.items():
        matching[_pick(row, other_key)].append((_pick(row, other_own), number))
    ways: Counter[tuple[int, ...]] = Counter()
    for row, number in first.ways.items():
        if clock.over:
            raise TimeoutError
        start = _pick(row, own)
        for end, other_number in matching.get(_pick(row, key), ()):
            ways[start + end] += number * other_number
    borders = _pick(first.borders, own) + _pick(second.borders, other_own)
    return _Table(borders, ways)


def _columns(table: _Table, between: list[int]) -> tuple[list[int], list[int]]:
    """Return the columns that stay, and those of the borders in between, in their order."""
    key = [table.borders.index(border) for border in between]
    return [i for i in range(len(table.borders)) if i not in key], key


def _pick(row: tuple[int, ...], columns: list[int]) -> tuple[int, ...]:
    return tuple([row[i] for i in columns])
