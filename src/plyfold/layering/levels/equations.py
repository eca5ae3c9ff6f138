"""Levels straight from the curve: all that embedded surfaces of all immersions have in common (§5 of the paper).

Number the sheets over each cell 1 … w from below. In a surface without self-intersections every gluing keeps this
order, so all of it is determined by one whole number for each border: the level of its own sheet, from 1 to the winding
number on its left. At a crossing, let a and b be the levels of the two strands over the top cell, the one on the left
of both. They differ. Past the crossing each strand bounds a sheet over a side cell, where the other strand's sheet is
missing: the strand above has lost a level there, the one below has not. These equations are the only ones, whatever the
immersion, the number of curves or the genus.

For the SAT solver the equations are clauses, in the order encoding: each border e has a variable x(e, i) for every i
from 1 to w − 1: its level is at most i. Each crossing has one variable more: the first strand lies above the second.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.base_visit import begun_at, numbered_from, visits_from_base
from plyfold.arrays import Bools, Ints, freeze
from plyfold.clock import Clock
from plyfold.errors import PlyfoldError
from plyfold.immersion.solve import negative_winding, subject_of, wrong_turning
from plyfold.layering.sat import Clauses, minimal_core, solutions_by_choice, solve
from plyfold.memory import require_memory
from plyfold.obstruction import Obstruction
from plyfold.ragged import count_each, starts_of

__all__ = [
    "LevelClauses",
    "LevelEquations",
    "contradicting_crossings",
    "level_clauses",
    "level_equations",
    "list_levels",
    "no_levels",
    "no_surface",
    "solve_levels",
]

# The variable that is always true stands for x(e, i) with i ≥ w, its opposite for x(e, 0).
_TRUE = 1
# Conflicts after which the solver may give up when it is asked whether one crossing less is a contradiction too.
_EFFORT = 5000
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
        The curve that each border belongs to.
    top, bottom : (k, 2) int
        For both strands of each crossing, the border beside the top cell and the one beside the bottom cell.
    """

    highest: Ints
    loop: Ints
    top: Ints
    bottom: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def n_crossings(self) -> int:
        """Number of crossings, k."""
        return len(self.top)

    @property
    def anchors(self) -> Ints:
        """For each curve, a border of it on which fewest levels are possible.

        Over and under at the crossings say how the level changes along a curve, so they and the levels of these borders
        determine all levels. Of a curve that comes to the outside, or over a cell with w = 1, nothing is left open.
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
    return LevelEquations(
        highest=arranged.winding[arranged.left_cell],
        loop=arranged.loop_of_border,
        top=np.stack([before[first], after[second]], axis=1),
        bottom=np.stack([after[first], before[second]], axis=1),
    )


def _first_strands(arranged: Arrangement) -> Ints:
    """Return for each crossing the visit that is crossed from right to left, in the order of first visits."""
    first = np.flatnonzero(arranged.ccw)
    return first[np.argsort(np.minimum(first, arranged.partner[first]))]


def no_surface(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction that numbers alone show, if there is one: the turning number or a winding number.

    The outline of a connected surface that lies flat turns 2 times less 2 for each handle and 1 for each of its curves.
    """
    loops, turning = arranged.n_loops, arranged.turning_number
    if turning > loops or (loops - turning) % 2:
        who, most = ("curve turns", "once") if loops == 1 else (f"{loops} curves together turn", f"{loops} times")
        sentence = f"The {who} {turning} times; what bounds a surface turns {most}, or less by an even number."
        return wrong_turning(arranged, sentence)
    return negative_winding(arranged)


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
        count = self.equations.highest[anchor] - 1
        return np.repeat(anchor, count), 1 + count_each(count)

    @property
    def every(self) -> Iterator[list[int]]:
        """All of them."""
        return chain(self.of_borders, chain.from_iterable(self.of_crossings))

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
    model = solve(chain(clauses.every, more), clock)
    return None if model is None else clauses.levels(model)


def list_levels(clauses: LevelClauses) -> Iterator[Ints]:
    """Yield all solutions, each once."""
    return map(clauses.levels, solutions_by_choice(clauses.every, clauses.choices))


def contradicting_crossings(clauses: LevelClauses, clock: Clock) -> list[int]:
    """Return crossings whose equations have no solution, given that those of all crossings have none.

    As few as leaving out one after the other can reach; where the solver does not know soon, a crossing stays, and when
    the time is over, so do all the others.
    """
    return minimal_core(clauses.of_crossings, clauses.of_borders, clock, _EFFORT)


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
    from_base = list(dict.fromkeys(arranged.crossing_of_visit[visits_from_base(arranged)].tolist()))
    crossings = tuple(sorted(from_base[crossing] for crossing in contradicting_crossings(clauses, clock)))
    sentence = f"No embedding: {because}no levels of the strands fit together at {len(crossings)} crossings."
    places = tuple((x, y) for x, y in arranged.crossings[list(crossings)].tolist()) if arranged.curves else ()
    return Obstruction("no embedding", sentence, places, crossings, subject_of(arranged))
