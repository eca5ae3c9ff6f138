"""How many solutions the equations between levels have: crossing by crossing and mark by mark, along the borders.

Borders on which only one level is possible connect nothing, so a curve falls apart there, and the numbers of the parts
multiply.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, combinations, permutations, product
from math import prod

import numpy as np

from plyfold.clock import Clock
from plyfold.layering.levels.equations import LevelEquations
from plyfold.layering.tables import Relation, Table, count_solutions

__all__ = ["count_level_solutions"]


def count_level_solutions(equations: LevelEquations, clock: Clock | None = None) -> int:
    """Count the solutions, exactly.

    Parameters
    ----------
    equations : LevelEquations
    clock : Clock, optional
        TimeoutError is raised when it is over; TooLargeError if it takes too much memory.

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
    meeting = [equations.top, equations.bottom, equations.before, equations.after]
    alone = np.setdiff1d(np.arange(len(equations.highest)), np.concatenate([borders.ravel() for borders in meeting]))
    crossings = (_table_of_crossing(equations, crossing) for crossing in range(equations.n_crossings))
    marks = (_table_of_mark(equations, mark) for mark in range(len(equations.index)))
    free: int = prod(equations.highest[alone].tolist())
    return free * count_solutions(chain(crossings, marks), clock or Clock(None))


def _table_of_crossing(equations: LevelEquations, crossing: int) -> Table:
    borders = equations.top[crossing].tolist() + equations.bottom[crossing].tolist()
    pairs = permutations(range(1, int(equations.highest[borders[0]]) + 1), 2)
    return _table(equations, borders, ((a, b, a - (b < a), b - (a < b)) for a, b in pairs))


def _table_of_mark(equations: LevelEquations, mark: int) -> Table:
    borders = [int(equations.before[mark]), int(equations.after[mark])]
    pairs = product(range(1, int(equations.highest[borders[0]]) + 1), repeat=2)
    index = equations.index[mark]
    return _table(equations, borders, ((a, b) for a, b in pairs if abs(a - b) == index))


def _table(equations: LevelEquations, borders: list[int], possible: Iterable[tuple[int, ...]]) -> Table:
    """Return the levels on some borders, but not on those where there is only one or that lead back."""
    kept = [i for i, border in enumerate(borders) if borders.count(border) == 1 and equations.highest[border] > 1]
    same = [(i, j) for i, j in combinations(range(len(borders)), 2) if borders[i] == borders[j]]
    ways: dict[tuple[int, ...], int] = {}
    for levels in possible:
        if all(levels[i] == levels[j] for i, j in same):
            row = tuple(levels[i] for i in kept)
            ways[row] = ways.get(row, 0) + 1
    return Table(tuple(borders[i] for i in kept), Relation(tuple(ways), tuple(ways.values())))
