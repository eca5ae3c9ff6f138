"""Cusps that would make an outline bound a surface: where it turns too often, some angles may be larger than seen.

What cusps do depends on the borders that they lie on, and not on the points there. So borders are chosen first,
together with the levels of an embedding: a cusp splits its border into two halves, whose levels differ by its index. As
few borders as can be; and then those with the sharpest points: outlines of visible surfaces nearly turn back at cusps.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, watched_arrangement
from plyfold.arrays import Floats, Ints
from plyfold.clock import Clock, Watch
from plyfold.errors import InputError, TimeLimitError
from plyfold.immersion.obstructions import loops_apart, negative_winding
from plyfold.layering.embedding import find_embedding
from plyfold.layering.levels.equations import LevelClauses, LevelEquations, clauses_of, level_equations
from plyfold.layering.orders.search import undecided
from plyfold.mesh.refine import borders_at_points
from plyfold.obstruction import Obstruction, Unknown
from plyfold.options import refuse_unless_count
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.given import OutlineLike
from plyfold.ragged import count_each, starts_of
from plyfold.sat import StoppableSolver, solver_of

__all__ = ["SuggestedCusps", "suggest_cusps"]

_QUESTION = "whether cusps would make it the outline of an embedded surface"


@dataclass(frozen=True, eq=False)
class SuggestedCusps:
    """Points that may be cusps of an outline, and the outline with them.

    Parameters
    ----------
    cusps : mapping from (loop, point) to int
        The index of each; as :class:`~plyfold.Outline` takes it.
    outline : Outline
        The outline with these cusps, and with those that it had. It has an embedding.

    Examples
    --------
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> proposed = suggest_cusps(limacon)
    >>> proposed.cusps, proposed.outline
    ({(0, 7): 1}, <Curve of 8 points, 1 cusp>)
    """

    cusps: Mapping[tuple[int, int], int]
    outline: Outline

    def __repr__(self) -> str:
        listed = ", ".join(
            f"point {point} of loop {loop}" + f" (index {index})" * (index > 1)
            for (loop, point), index in self.cusps.items()
        )
        return f"<SuggestedCusps: {listed}>"


def suggest_cusps(
    outline: OutlineLike, chi: int | None = None, most: int = 3, time_limit: float | None = None
) -> SuggestedCusps | Obstruction | Unknown:
    """Propose cusps with which an outline that turns too often bounds an embedded surface.

    Parameters
    ----------
    outline : Curve, Outline, array_like of shape (n, 2) or shapely geometry; or a list of such
        Cusps that it has stay.
    chi : int, optional
        The Euler characteristic that the surface is to have; by default that of one piece without handles, 2 less the
        number of loops, and then it is to be in one piece.
    most : int, optional
        How many turns that are too many cusps are looked for.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    SuggestedCusps or Obstruction or Unknown
        The result is true if there is a proposal. It is one of the fewest cusps, at most one on each border, and on
        borders with the sharpest points: first the sharpest of all that can be, and so on. It depends neither on the
        points with which the loops begin nor on their direction. An obstruction has the reason ``"turning number"`` (no
        turns are too many, or more than ``most``: ``value`` says how many), ``"negative winding"``, ``"pieces"`` (the
        loops lie too far apart to bound one) or ``"no embedding"`` (no such cusps help).

    Raises
    ------
    InputError
        If it is a Gauss code, which has no points, or ``most`` is no whole number from 1 on.

    Notes
    -----
    Which borders can have the cusps is a SAT problem with O(Σ w) variables and clauses, over borders. A proposal is no
    more than that: other cusps can do as well.

    Examples
    --------
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> suggest_cusps(limacon)
    <SuggestedCusps: point 7 of loop 0>
    >>> print(suggest_cusps([(0, 0), (1, 0), (0, 1)]))
    No turns are too many: the curve turns once.
    """
    refuse_unless_count("most", most)
    clock = Clock(time_limit)
    try:
        arranged = watched_arrangement(outline, "perturb", Watch(clock))
        _drawn(arranged)
        turns = arranged.euler_characteristic - (2 - arranged.n_loops if chi is None else chi)
        found = _no_such_turns(arranged, turns, most)
        found = negative_winding(arranged) if found is None else found
        found = loops_apart(arranged) if found is None and chi is None else found
        return _search(arranged, turns, chi is None, clock) if found is None else found
    except (TimeoutError, TimeLimitError):
        return undecided("time limit", _QUESTION, clock)


def _drawn(arranged: Arrangement) -> Outline:
    if arranged.outline is None:
        raise InputError("a Gauss code has no points to be cusps", hint="give the drawing")
    return arranged.outline


def _no_such_turns(arranged: Arrangement, turns: int, most: int) -> Obstruction | None:
    if 0 < turns <= most:
        return None
    times = "once" if arranged.euler_characteristic == 1 else f"{arranged.euler_characteristic} times"
    who = "the curve turns" if arranged.n_loops == 1 else f"the {arranged.n_loops} curves together turn"
    too_many = "No turns are" if turns <= 0 else f"{turns} turns, more than {most}, are"
    return Obstruction("turning number", f"{too_many} too many: {who} {times}.", (), turns, arranged)


def _search(arranged: Arrangement, turns: int, connected: bool, clock: Clock) -> SuggestedCusps | Obstruction | Unknown:
    """Return the first proposal that holds, fewest cusps first. May raise TimeoutError."""
    places = _Places.of(arranged, turns)
    for cusps in range(1, turns + 1):
        for index in _proposals(places, turns, cusps, clock):
            proposal = _as_given(arranged, {places.vertex[border]: m for border, m in index.items()})
            found = find_embedding(proposal.outline, clock.left, connected)
            if isinstance(found, Unknown):
                raise TimeoutError
            if found:
                return proposal
    sentence = f"No cusps for {turns} turns, one on a border at most, make it the outline of an embedded surface."
    return Obstruction("no embedding", sentence, (), turns, arranged)


def _as_given(arranged: Arrangement, index: Mapping[int, int]) -> SuggestedCusps:
    """Return the proposal with the points numbered as they were given, before the outline was turned round."""
    outline = _drawn(arranged)
    marked = np.concatenate(outline.cusps)
    marked[list(index)] = list(index.values())
    whole = _with_cusps(outline, np.split(marked, outline.first_point[1:-1]))
    if arranged.reversed:
        whole, outline = whole.reversed(), outline.reversed()
    new = ((loop, after - before) for loop, (before, after) in enumerate(zip(outline.cusps, whole.cusps, strict=True)))
    cusps = {(loop, int(point)): int(m[point]) for loop, m in new for point in np.flatnonzero(m)}
    return SuggestedCusps(cusps, whole)


def _with_cusps(outline: Outline, cusps: Sequence[Ints]) -> Outline:
    if isinstance(outline, Curve):
        return Curve(outline.points, outline.repairs, cusps[0])
    return Outline(outline.loops, cusps, outline.repairs)


# ---- where cusps can be ----------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Places:
    """The borders that can have a cusp, those with the sharpest points first.

    Parameters
    ----------
    equations : LevelEquations
        The equations between levels, in which these borders have two halves, which nothing ties together.
    border, other : (c,) int
        The halves of each of these borders, as numbered in the equations.
    most : (c,) int
        The highest index that a cusp can have there.
    vertex : (c,) int
        The sharpest point of each, counted over all loops.
    """

    equations: LevelEquations
    border: Ints
    other: Ints
    most: Ints
    vertex: list[int]

    @classmethod
    def of(cls, arranged: Arrangement, turns: int) -> _Places:
        equations = level_equations(arranged)
        sharpest = _sharpest_points(arranged)
        border = np.array([b for b in sharpest if equations.highest[b] > 1], dtype=int)
        end = np.arange(len(equations.highest))
        end[border] = len(end) + np.arange(len(border))
        top, bottom = equations.top, equations.bottom
        opened = replace(
            equations,
            highest=np.append(equations.highest, equations.highest[border]),
            loop=np.append(equations.loop, equations.loop[border]),
            top=np.stack([end[top[:, 0]], top[:, 1]], axis=1),
            bottom=np.stack([bottom[:, 0], end[bottom[:, 1]]], axis=1),
            before=end[equations.before],
        )
        most = np.minimum(turns, equations.highest[border] - 1)
        return cls(opened, border, end[border], most, [sharpest[b] for b in border.tolist()])


def _sharpest_points(arranged: Arrangement) -> dict[int, int]:
    """Return the sharpest point of each border that has points: that with the smallest angle on its left.

    In the order of their angles. Of equal ones the leftmost comes first, the lowest of several.
    """
    outline, border = _drawn(arranged), _border_of_each_point(arranged)
    x, y = outline.points.T
    order = np.lexsort((y, x, _angles(outline)))
    order = order[border[order] >= 0]
    first = np.sort(np.unique(border[order], return_index=True)[1])
    return dict(zip(border[order[first]].tolist(), order[first].tolist(), strict=True))


def _border_of_each_point(arranged: Arrangement) -> Ints:
    """Return the border in which each point of the outline lies; −1 at cusps and for loops without visits."""
    border, _ = borders_at_points(arranged)
    is_inside = (arranged.start_visit[border] >= 0) & (np.concatenate(_drawn(arranged).cusps) == 0)
    return np.where(is_inside, border, -1)


def _angles(outline: Outline) -> Floats:
    """Return the angle on the left at each point, from 0 to 2π."""
    onward = outline.points[outline.next_point] - outline.points
    back = np.empty_like(onward)
    back[outline.next_point] = -onward
    (x, y), (u, v) = onward.T, back.T
    return np.asarray(np.arctan2(x * v - y * u, x * u + y * v) % (2 * np.pi))


# ---- as a question to the SAT solver ---------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _CuspClauses:
    """The clauses of levels with so many turns at so many cusps; each of the places may have one.

    A place has a variable for every index from 1 on, which says that its cusp has at least that index; and one more:
    the surface climbs.
    """

    places: _Places
    turns: int
    cusps: int

    @cached_property
    def levels(self) -> LevelClauses:
        """The clauses of what is known."""
        return LevelClauses(self.places.equations)

    def at_least(self, index: int) -> Ints:
        """Return for every place the literal that its cusp has at least that index, which it has not above the most."""
        most = self.places.most
        never = self.levels.at_most(self.places.border, np.zeros_like(most))
        return np.where(index <= most, self.levels.n_variables + starts_of(most) + index, never)

    @property
    def every(self) -> Iterator[list[int]]:
        """All clauses."""
        rows = [row for index in range(self.turns + 1) for row in self._halves(index)]
        in_order = [[-self.at_least(index + 1), self.at_least(index)] for index in range(1, self.turns)]
        return chain(self.levels.every, clauses_of(rows), clauses_of(in_order), self._numbers())

    def _halves(self, index: int) -> list[list[Ints]]:
        """Return what ties the halves of borders together if their cusps have less, or more, than a certain index.

        The levels of the halves differ by at most that index, unless it is higher; and by at least so much, unless it
        is lower.
        """
        places = self.places
        possible = np.flatnonzero(places.most >= index)
        levels = places.equations.highest[places.border[possible]]
        place, i = np.repeat(possible, levels), 1 + count_each(levels)
        before, after = places.border[place], places.other[place]
        more, reached = self.at_least(index + 1)[place], self.at_least(max(index, 1))[place]
        climbs = self.levels.n_variables + int(places.most.sum()) + 1 + place
        near = [[more, *row] for row in self.levels.at_most_apart(before, after, i, index)]
        if index == 0:
            return near
        return [*near, *([-reached, *row] for row in self.levels.at_least_apart(before, after, i, index, climbs))]

    def _numbers(self) -> list[list[int]]:
        """Return that there are so many cusps, and so many turns at them."""
        from pysat.card import CardEnc

        first = self.at_least(1).tolist()
        each = list(range(self.levels.n_variables + 1, self.levels.n_variables + 1 + int(self.places.most.sum())))
        number = CardEnc.equals(first, self.cusps, each[-1] + len(first))
        total = CardEnc.equals(each, self.turns, max(each[-1] + len(first), number.nv))
        return [*number.clauses, *total.clauses]


def _proposals(places: _Places, turns: int, cusps: int, clock: Clock) -> Iterator[dict[int, int]]:
    """Yield the index at each chosen place, for all choices that levels fit to: those with the sharpest points first.

    Raises TimeoutError when the time is over.
    """
    if len(places.border) < cusps or places.most.sum() < turns:
        return
    clauses = _CuspClauses(places, turns, cusps)
    done: list[list[int]] = []
    while True:
        with solver_of(chain(clauses.every, done), clock) as solver:
            found = _sharpest_choice(solver, clauses, clock)
        if found is None:
            return
        yield found
        done.append([-int(clauses.at_least(index)[place]) for place, index in found.items()])


def _sharpest_choice(solver: StoppableSolver, clauses: _CuspClauses, clock: Clock) -> dict[int, int] | None:
    if not solver.ask(clock=clock):
        return None
    chosen = _first_true(solver, clauses.at_least(1).tolist(), clauses.cusps, clock)
    more = [(place, index) for index in range(2, clauses.turns + 1) for place in chosen]
    possible = [(place, index) for place, index in more if index <= clauses.places.most[place]]
    literals = [int(clauses.at_least(index)[place]) for place, index in possible]
    index = dict.fromkeys(chosen, 1)
    for number in _first_true(solver, literals, clauses.turns - clauses.cusps, clock):
        index[possible[number][0]] += 1
    return index


def _first_true(solver: StoppableSolver, literals: list[int], number: int, clock: Clock) -> list[int]:
    """Return which of some literals, of which so many are true in every solution, can be: in the first places.

    Their first place is as low as can be, then the second, and so on; it is made sure that later solutions keep to it.
    There is a solution.
    """
    solver.ask(clock=clock)
    chosen: list[int] = []
    true, start = set(solver.get_model()), 0
    while len(chosen) < number:
        place = next(place for place in range(start, len(literals)) if literals[place] in true)
        earlier = literals[start:place]
        if earlier and (better := _one_of(solver, earlier, clock)) is not None:
            true = better
            continue
        for literal in [*(-literal for literal in earlier), literals[place]]:
            solver.add_clause([literal])
        chosen.append(place)
        start = place + 1
    return chosen


def _one_of(solver: StoppableSolver, literals: list[int], clock: Clock) -> set[int] | None:
    """Return the literals of a solution in which one of some is true, if there is one."""
    selector = solver.nof_vars() + 1
    solver.add_clause([-selector, *literals])
    return set(solver.get_model()) if solver.ask([selector], clock) else None
