"""Levels straight from the curve: all that embedded surfaces of all immersions have in common (§5 of the paper).

Number the sheets over each cell 1 … w from below. In a surface without self-intersections every gluing keeps this
order, so all of it is determined by one whole number for each border: the level of its own sheet, from 1 to the winding
number on its left. At a crossing, let a and b be the levels of the two strands over the top cell, the one on the left
of both. They differ. Past the crossing each strand bounds a sheet over a side cell, where the other strand's sheet is
missing: the strand above has lost a level there, the one below has not. At a cusp of index m the surface climbs or
falls by m levels, like a spiral stair; at the foot of a bridge, where all gluings keep the order too, nothing happens.
These equations are the only ones, whatever the immersion, the number of loops or the genus.

For the SAT solver the equations are clauses, in the order encoding: each border e has a variable x(e, i) for every i
from 1 to w − 1: its level is at most i. Each crossing has one variable more: the first strand lies above the second. So
has each cusp: the surface climbs there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, pairwise
from typing import TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.base_visit import begun_at, numbered_from, visits_from_base
from plyfold.arrangement.places import places_of_crossings, places_of_visits
from plyfold.arrays import Bools, Ints, freeze
from plyfold.clock import NO_LIMIT, Clock
from plyfold.errors import PlyfoldError
from plyfold.memory import require_memory
from plyfold.obstruction import Obstruction
from plyfold.ragged import count_each, starts_of
from plyfold.sat import Clauses, minimal_core, solutions_by_choice, solve
from plyfold.wording import counted

__all__ = [
    "Lacking",
    "LevelClauses",
    "LevelEquations",
    "all_wanted",
    "clauses_of",
    "contradiction",
    "level_clauses",
    "level_equations",
    "list_levels",
    "no_levels",
    "solve_levels",
]

Lacking: TypeAlias = Callable[[Ints], Sequence[int] | None]

# The variable that is always true stands for x(e, i) with i ≥ w, its opposite for x(e, 0).
_TRUE = 1
# Conflicts after which the solver may give up when it is asked whether one crossing less is a contradiction too.
_EFFORT = 5000
# Crossings whose clauses are made at a time.
_CROSSINGS_AT_A_TIME = 1024
# Clauses of the borders and crossings, and what the solver keeps of them.
_BYTES_PER_LEVEL = 3500


@dataclass(frozen=True, eq=False)
class LevelEquations:
    """The equations between the levels of the borders.

    Parameters
    ----------
    highest : (borders,) int
        The winding number on the left of each border, at least 1: its level is between 1 and this.
    loop : (borders,) int
        The loop that each border belongs to.
    top, bottom : (k, 2) int
        For both strands of each crossing, the border beside the top cell and the one beside the bottom cell.
    before, after : (marks,) int
        For each mark, which is a cusp or the foot of a bridge, the border that ends there and the one that starts.
    index : (marks,) int
        By how many levels these two differ: the index of the cusp, 0 at feet.
    """

    highest: Ints
    loop: Ints
    top: Ints
    bottom: Ints
    before: Ints
    after: Ints
    index: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def n_crossings(self) -> int:
        """Number of crossings, k."""
        return len(self.top)

    @property
    def cusps(self) -> Ints:
        """Which of the marks are cusps."""
        return np.flatnonzero(self.index)

    @property
    def anchors(self) -> Ints:
        """For each loop, a border of it on which fewest levels are possible.

        Over and under at the crossings, up and down at the cusps say how the level changes along a loop, so they and
        the levels of these borders determine all levels. Of a loop that comes to the outside, or over a cell with
        w = 1, nothing is left open.
        """
        by_loop = np.lexsort((self.highest, self.loop))
        return by_loop[np.unique(self.loop[by_loop], return_index=True)[1]]

    def hold(self, level: Ints) -> bool:
        """Tell whether levels are a solution. Cost: O(k)."""
        at_top, at_bottom = level[self.top], level[self.bottom]
        above = at_top > at_top[:, ::-1]
        return bool(
            ((level >= 1) & (level <= self.highest)).all()
            and (at_top[:, 0] != at_top[:, 1]).all()
            and (at_bottom == at_top - above).all()
            and (np.abs(level[self.before] - level[self.after]) == self.index).all()
        )


def level_equations(arranged: Arrangement) -> LevelEquations:
    """Return the equations of an outline without negative winding numbers; crossings by their first visits.

    Examples
    --------
    >>> from plyfold import arrange
    >>> ramp = arrange([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> level_equations(ramp).highest.tolist()
    [2, 1, 2, 1, 2, 1, 2, 1]
    """
    first = _first_strands(arranged)
    second = arranged.partner[first]
    before, after = arranged.border_before, arranged.border_after
    marks = np.flatnonzero(arranged.partner == np.arange(len(arranged.partner)))
    return LevelEquations(
        highest=arranged.winding[arranged.left_cell],
        loop=arranged.loop_of_border,
        top=np.stack([before[first], after[second]], axis=1),
        bottom=np.stack([after[first], before[second]], axis=1),
        before=before[marks],
        after=after[marks],
        index=arranged.cusp_index[marks],
    )


def _first_strands(arranged: Arrangement) -> Ints:
    """Return for each crossing the visit that is crossed from right to left, in the order of first visits."""
    first = np.flatnonzero(arranged.ccw)
    return first[np.argsort(np.minimum(first, arranged.partner[first]))]


# ---- as clauses for the SAT solver -----------------------------------------------------------------------------------


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
        return _TRUE + starts_of(count)

    @cached_property
    def first_over(self) -> list[int]:
        """The variable of each crossing: its first strand lies above its second one."""
        start = _TRUE + 1 + int((self.equations.highest - 1).sum())
        return list(range(start, start + self.equations.n_crossings))

    @cached_property
    def climbs(self) -> list[int]:
        """The variable of each cusp: the surface climbs there."""
        start = _TRUE + 1 + int((self.equations.highest - 1).sum()) + self.equations.n_crossings
        return list(range(start, start + len(self.equations.cusps)))

    @property
    def n_variables(self) -> int:
        """Number of variables."""
        equations = self.equations
        return _TRUE + int((equations.highest - 1).sum()) + equations.n_crossings + len(equations.cusps)

    @cached_property
    def choices(self) -> list[int]:
        """Variables that determine a solution: all crossings and cusps, and the level of one border of each loop."""
        return [*self.first_over, *self.climbs, *self.at_most(*self._anchors).tolist()]

    def other_than(self, level: Ints) -> list[int]:
        """Return the clause that tells other solutions with the same casing from one: by a choice that differs."""
        border, i = self._anchors
        variable, cusps = self.at_most(border, i), self.equations.cusps
        rises = level[self.equations.after[cusps]] > level[self.equations.before[cusps]]
        clause: list[int] = np.where(level[border] <= i, -variable, variable).tolist()
        return [*clause, *(-climbs if up else climbs for climbs, up in zip(self.climbs, rises, strict=True))]

    @cached_property
    def _anchors(self) -> tuple[Ints, Ints]:
        """The variables x(e, i) of one border e of each loop, as e and i; few, for most have a border with w = 1."""
        anchor = self.equations.anchors
        count = self.equations.highest[anchor] - 1
        return np.repeat(anchor, count), 1 + count_each(count)

    @property
    def every(self) -> Iterator[list[int]]:
        """All of them. Those of crossings come in portions, which are forgotten: so many lists keep Python busy."""
        portions = range(0, self.equations.n_crossings, _CROSSINGS_AT_A_TIME)
        at_crossings = (self._at_crossings(slice(start, start + _CROSSINGS_AT_A_TIME)) for start in portions)
        return chain(self.of_borders, chain.from_iterable(chain.from_iterable(at_crossings)), *self.of_marks)

    @cached_property
    def of_borders(self) -> list[list[int]]:
        """What holds on every border: a level that is at most i is at most i + 1."""
        self._require_memory()
        highest = self.equations.highest
        border, i = np.repeat(np.arange(len(highest)), highest), count_each(highest)
        rows = clauses_of([[-self.at_most(border, i), self.at_most(border, i + 1)]])
        # The second clause says nothing; it makes the solver's models name every variable.
        return [[_TRUE], [self.n_variables, -self.n_variables], *rows]

    @cached_property
    def of_crossings(self) -> list[list[list[int]]]:
        """What each crossing demands."""
        self._require_memory()
        return self._at_crossings(slice(None))

    def _at_crossings(self, some: slice) -> list[list[list[int]]]:
        """Return what some crossings demand. The last two rules follow from the others and speed up the solver."""
        top, bottom, first_over = self.equations.top[some], self.equations.bottom[some], self.first_over[some]
        levels = self.equations.highest[top[:, 0]] + 1
        crossing, i = np.repeat(np.arange(len(top)), levels), count_each(levels)
        over = np.array(first_over, dtype=np.int64)[crossing]
        x = self.at_most
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
        demands = _by_demand(len(top), np.tile(crossing, len(rows)), np.concatenate([np.stack(row, 1) for row in rows]))
        if self.first_is_over is not None:
            for demand, variable, holds in zip(demands, first_over, self.first_is_over[some], strict=True):
                demand.append([variable if holds else -variable])
        return demands

    @cached_property
    def of_marks(self) -> list[list[list[int]]]:
        """What each mark demands: two levels that differ by no more than its index, and at cusps by no less."""
        equations = self.equations
        levels = equations.highest[equations.before]
        mark, i = np.repeat(np.arange(len(levels)), levels), 1 + count_each(levels)
        before, after, index = equations.before[mark], equations.after[mark], equations.index[mark]
        near = self.at_most_apart(before, after, i, index)
        at_cusp = index > 0
        climbs = np.repeat(self.climbs, levels[equations.cusps])
        far = self.at_least_apart(before[at_cusp], after[at_cusp], i[at_cusp], index[at_cusp], climbs)
        demands = _by_demand(len(levels), np.tile(mark, 2), np.concatenate([np.stack(row, 1) for row in near]))
        more = _by_demand(len(levels), np.tile(mark[at_cusp], 2), np.concatenate([np.stack(row, 1) for row in far]))
        return [[*some, *others] for some, others in zip(demands, more, strict=True)]

    def _require_memory(self) -> None:
        levels = int(self.equations.highest.sum())
        require_memory(
            _BYTES_PER_LEVEL * levels,
            f"a formula for {levels:,} levels of borders",
            None,
            "embed_cased(curve, over) takes one pass along a single curve, where over and under are known",
        )

    def levels(self, model: list[int]) -> Ints:
        """Return the levels in a solution: one more than the number of levels that are not high enough."""
        highest = self.equations.highest
        border = np.repeat(np.arange(len(highest)), highest - 1)
        too_low = np.array(model[_TRUE : _TRUE + len(border)]) < 0
        level = 1 + np.bincount(border[too_low], minlength=len(highest))
        if not self.equations.hold(level):
            raise PlyfoldError("internal check failed: levels of the borders around every crossing fit together")
        return np.asarray(level, dtype=np.int64)

    def possible(self, literals: Ints) -> list[int]:
        """Leave out of a clause the literals that are always false."""
        left: list[int] = literals[literals != -_TRUE].tolist()
        return left

    def at_most(self, border: Ints, i: Ints) -> Ints:
        """Return the literals x(e, i): the level of a border is at most i."""
        variable = np.where(i < self.equations.highest[border], self._before[border] + i, _TRUE)
        return np.where(i > 0, variable, -_TRUE)

    def at_most_apart(self, before: Ints, after: Ints, i: Ints, index: Ints | int) -> list[tuple[Ints, ...]]:
        """Return rows of literals, for all levels i from 1 on: the levels of two borders differ by at most an index."""
        x = self.at_most
        return [(-x(one, i), x(other, i + index)) for one, other in ((before, after), (after, before))]

    def at_least_apart(
        self, before: Ints, after: Ints, i: Ints, index: Ints | int, climbs: Ints
    ) -> list[tuple[Ints, ...]]:
        """Return rows that they differ by at least that: the second is higher if a variable is true, lower if not."""
        x = self.at_most
        return [(-climbs, -x(after, i), x(before, i - index)), (climbs, -x(before, i), x(after, i - index))]


def _by_demand(number: int, demand: Ints, rows: Ints) -> list[list[list[int]]]:
    """Return the clauses of each of so many demands, given the demand of each row of literals."""
    is_open = ~(rows == _TRUE).any(axis=1)
    order = np.flatnonzero(is_open)[np.argsort(demand[is_open], kind="stable")]
    clauses: list[list[int]] = rows[order].tolist()
    start = np.searchsorted(demand[order], np.arange(number + 1)).tolist()
    return [clauses[low:high] for low, high in pairwise(start)]


def clauses_of(rows: Sequence[Sequence[Ints]]) -> list[list[int]]:
    """Return the clauses of rows of literals, which are arrays as long as each other, but those that hold anyway."""
    stacked = (np.stack(row, axis=1) for row in rows)
    return [clause for row in stacked for clause in row[~(row == _TRUE).any(axis=1)].tolist()]


def solve_levels(clauses: LevelClauses, clock: Clock, more: Clauses = ()) -> Ints | None:
    """Return the levels of a solution, or None if there is none. Raises TimeoutError when the time is over.

    More clauses can be given that it has to meet.
    """
    model = solve(chain(clauses.every, more), clock)
    return None if model is None else clauses.levels(model)


def all_wanted(level: Ints) -> None:
    """Leave nothing out."""


def list_levels(clauses: LevelClauses, clock: Clock = NO_LIMIT, lacking: Lacking = all_wanted) -> Iterator[Ints]:
    """Yield all solutions, each once. Raises TimeoutError when the time is over.

    If only some are wanted, ``lacking`` returns for levels that are not a clause that all those wanted meet.
    """
    models = solutions_by_choice(clauses.every, clauses.choices, clock, lambda model: lacking(clauses.levels(model)))
    return map(clauses.levels, models)


def contradiction(clauses: LevelClauses, clock: Clock) -> tuple[list[int], list[int]]:
    """Return crossings and cusps whose equations have no solution, given that all together have none.

    As few as leaving out one after the other can reach; where the solver does not know soon, a crossing stays, and when
    the time is over, so do all the others.
    """
    crossings, cusps = clauses.equations.n_crossings, clauses.equations.cusps.tolist()
    feet = (clauses.of_marks[foot] for foot in np.flatnonzero(clauses.equations.index == 0))
    demands = [*clauses.of_crossings, *(clauses.of_marks[cusp] for cusp in cusps)]
    core = minimal_core(demands, chain(clauses.of_borders, *feet), clock, _EFFORT)
    return [i for i in core if i < crossings], [i - crossings for i in core if i >= crossings]


def level_clauses(arranged: Arrangement, casing: Bools | None = None) -> LevelClauses:
    """Return the clauses of an outline without negative winding numbers, with over and under by visits if given.

    Borders and crossings are numbered from the base visit on, so that the order of answers belongs to the drawing;
    :func:`~plyfold.arrangement.base_visit.borders_numbered_back` numbers levels as usual.
    """
    base = arranged.base_visit
    numbered = numbered_from(arranged, base)
    equations = level_equations(numbered)
    return LevelClauses(equations, None if casing is None else begun_at(casing, base)[_first_strands(numbered)])


def no_levels(arranged: Arrangement, clauses: LevelClauses, clock: Clock, because: str = "") -> Obstruction:
    """Return the obstruction of an outline whose equations have no solution."""
    visits = visits_from_base(arranged)
    crossing, is_cusp = arranged.crossing_of_visit[visits], arranged.cusp_index[visits] > 0
    crossing_from_base, cusp_from_base = list(dict.fromkeys(crossing[crossing >= 0].tolist())), visits[is_cusp].tolist()
    among_crossings, among_cusps = contradiction(clauses, clock)
    crossings = sorted(crossing_from_base[i] for i in among_crossings)
    cusps = sorted(cusp_from_base[i] for i in among_cusps)
    at = " and ".join(counted(len(found), name) for found, name in ((crossings, "crossing"), (cusps, "cusp")) if found)
    sentence = f"No embedding: {because}no levels of the strands fit together at {at}."
    where = places_of_crossings(arranged, crossings) + places_of_visits(arranged, cusps)
    value = (*crossings, *(("cusp", visit) for visit in cusps))
    return Obstruction("no embedding", sentence, where, value, arranged)
