"""The equations between levels as clauses for a SAT solver, in the order encoding.

Each border e has a variable x(e, i) for every i from 1 to w − 1: its level is at most i. Each crossing has one variable
more: the first strand lies above the second. All questions to the solver are asked here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np

from plyfold.arrays import Bools, Ints
from plyfold.clock import Clock
from plyfold.errors import PlyfoldError
from plyfold.immersion.immersion import count_each
from plyfold.layering.levels.equations import LevelEquations
from plyfold.layering.sat import Clauses, minimal_core, solver_of
from plyfold.memory import require_memory

__all__ = ["LevelClauses", "contradicting_crossings", "list_levels", "solve_levels"]

# The variable that is always true stands for x(e, i) with i ≥ w, its opposite for x(e, 0).
_TRUE = 1
# Conflicts after which the solver may give up when it is asked whether one crossing less is a contradiction too.
_EFFORT = 5000
# Clauses of the borders and crossings, and what the solver keeps of them.
_BYTES_PER_LEVEL = 3500


@dataclass(frozen=True, eq=False)
class LevelClauses:
    """The clauses of the equations between levels.

    Parameters
    ----------
    equations : LevelEquations
    first_is_over : (k,) bool, optional
        Whether the first strand of each crossing has to lie above the second; free by default.
    """

    equations: LevelEquations
    first_is_over: Bools | None = None

    @cached_property
    def _before(self) -> Ints:
        """The number before each border's first variable."""
        count = self.equations.highest - 1
        return _TRUE + np.cumsum(count) - count

    @cached_property
    def first_over(self) -> list[int]:
        """The variable of each crossing: its first strand lies above its second one."""
        start = _TRUE + 1 + int((self.equations.highest - 1).sum())
        return list(range(start, start + self.equations.n_crossings))

    @cached_property
    def choices(self) -> list[int]:
        """Variables that determine a solution: all crossings, and the level of one border of each curve."""
        return [*self.first_over, *self._at_most(*self._anchors).tolist()]

    def other_than(self, level: Ints) -> list[int]:
        """Return the clause that some curve lies on another level than in a solution, given the same casing."""
        border, i = self._anchors
        variable = self._at_most(border, i)
        clause: list[int] = np.where(level[border] <= i, -variable, variable).tolist()
        return clause

    @cached_property
    def _anchors(self) -> tuple[Ints, Ints]:
        """The variables x(e, i) of one border e of each curve, as e and i; few, for most have a border with w = 1."""
        anchor = self.equations.anchors
        border = np.repeat(anchor, self.equations.highest[anchor] - 1)
        return border, 1 + count_each(self.equations.highest[anchor] - 1)

    @property
    def n_variables(self) -> int:
        """Number of variables."""
        return _TRUE + int((self.equations.highest - 1).sum()) + self.equations.n_crossings

    @cached_property
    def of_borders(self) -> list[list[int]]:
        """What holds on every border: a level that is at most i is at most i + 1."""
        self._require_memory()
        highest = self.equations.highest
        border, i = np.repeat(np.arange(len(highest)), highest), count_each(highest)
        rows = np.stack([-self._at_most(border, i), self._at_most(border, i + 1)], axis=1)
        # The second clause says nothing; it makes the solver's models name every variable.
        return [[_TRUE], [self.n_variables, -self.n_variables], *_without_constants(rows)[1]]

    @cached_property
    def of_crossings(self) -> list[list[list[int]]]:
        """What each crossing demands. The last two rules follow from the others and speed up the solver."""
        self._require_memory()
        top, bottom = self.equations.top, self.equations.bottom
        levels = self.equations.highest[top[:, 0]] + 1
        crossing, i = np.repeat(np.arange(len(top)), levels), count_each(levels)
        over = np.array(self.first_over, dtype=np.int64)[crossing]
        x = self._at_most
        rows = []
        for upper, lower, holds in ((0, 1, over), (1, 0, -over)):
            upper_top, upper_bottom = top[crossing, upper], bottom[crossing, upper]
            lower_top, lower_bottom = top[crossing, lower], bottom[crossing, lower]
            rows += [
                (-holds, -x(upper_top, i), x(upper_bottom, i - 1)),
                (-holds, x(upper_top, i), -x(upper_bottom, i - 1)),
                (-holds, -x(lower_top, i), x(lower_bottom, i)),
                (-holds, x(lower_top, i), -x(lower_bottom, i)),
                (-holds, -x(upper_top, i), x(lower_top, i - 1)),
                (-x(upper_top, i), x(upper_bottom, i), x(upper_bottom, i)),
                (-x(upper_bottom, i - 1), x(upper_top, i), x(upper_top, i)),
            ]
        which, clauses = _without_constants(np.concatenate([np.stack(row, axis=1) for row in rows]))
        demands: list[list[list[int]]] = [[] for _ in top]
        for number, clause in zip(np.tile(crossing, len(rows))[which].tolist(), clauses, strict=True):
            demands[number].append(clause)
        if self.first_is_over is not None:
            for number, (variable, holds) in enumerate(zip(self.first_over, self.first_is_over, strict=True)):
                demands[number].append([variable if holds else -variable])
        return demands

    def _require_memory(self) -> None:
        levels = int(self.equations.highest.sum())
        require_memory(
            _BYTES_PER_LEVEL * levels,
            f"a formula for {levels:,} levels of borders",
            None,
            "embed_cased(curve, over) takes one pass along a single curve, where over and under are known",
        )

    @property
    def every(self) -> Iterator[list[int]]:
        """All of them."""
        return chain(self.of_borders, chain.from_iterable(self.of_crossings))

    def levels(self, model: list[int]) -> Ints:
        """Return the levels in a solution: one more than the number of levels that are not high enough."""
        highest = self.equations.highest
        border = np.repeat(np.arange(len(highest)), highest - 1)
        too_low = np.array(model[_TRUE : _TRUE + len(border)]) < 0
        level = 1 + np.bincount(border[too_low], minlength=len(highest))
        if not self.equations.hold(level):
            raise PlyfoldError("internal check failed: levels of the borders around every crossing fit together")
        return np.asarray(level, dtype=np.int64)

    def _at_most(self, border: Ints, i: Ints) -> Ints:
        variable = np.where(i < self.equations.highest[border], self._before[border] + i, _TRUE)
        return np.where(i > 0, variable, -_TRUE)


def _without_constants(rows: Ints) -> tuple[Ints, list[list[int]]]:
    """Return which clauses do not hold anyway, and those without literals that are always false."""
    which = np.flatnonzero(~(rows == _TRUE).any(axis=1))
    return which, [list({x for x in row if x != -_TRUE}) for row in rows[which].tolist()]


def solve_levels(clauses: LevelClauses, clock: Clock, more: Clauses = ()) -> Ints | None:
    """Return the levels of a solution, or None if there is none. Raises TimeoutError when the time is over.

    More clauses can be given that it has to meet.
    """
    with solver_of(chain(clauses.every, more), clock) as solver:
        return clauses.levels(solver.get_model()) if solver.ask(clock=clock) else None


def list_levels(clauses: LevelClauses) -> Iterator[Ints]:
    """Yield all solutions, each once.

    The solver is asked for one; then the last choice whose opposite has not been tried, under the choices before it, is
    turned round, and the solver is asked for the rest. Nothing is remembered but the way back.
    """
    with solver_of(clauses.every) as solver:
        tried: list[tuple[int, bool]] = []
        possible = solver.ask()
        while True:
            if possible:
                model = solver.get_model()
                yield clauses.levels(model)
                tried += [(model[variable - 1], False) for variable in clauses.choices[len(tried) :]]
            while tried and tried[-1][1]:
                tried.pop()
            if not tried:
                return
            tried[-1] = (-tried[-1][0], True)
            possible = solver.ask([literal for literal, _ in tried])


def contradicting_crossings(clauses: LevelClauses, clock: Clock) -> list[int]:
    """Return crossings whose equations have no solution, given that those of all crossings have none.

    As few as leaving out one after the other can reach; where the solver does not know soon, a crossing stays, and when
    the time is over, so do all the others.
    """
    return minimal_core(clauses.of_crossings, clauses.of_borders, clock, _EFFORT)
