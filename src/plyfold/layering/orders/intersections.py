"""When no layering keeps all orders: the one in which sheets pass through each other least.

Any orders of the sheets over the cells make a surface. Where two sheets glued along a border lie the other way round
beyond it, they pass through each other there: along the border, they have a self-intersection curve. The shortest total
length is a weighted MaxSAT problem: a variable for every pair of sheets over a cell, orders that are no circles as
hard constraints, and for every border and every pair glued along it the wish that the order be the same on both sides.

References
----------
.. [IMM19] A. Ignatiev, A. Morgado, J. Marques-Silva, "RC2: an efficient MaxSAT solver", Journal on Satisfiability,
   Boolean Modeling and Computation 11, 2019.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import chain

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints, freeze
from plyfold.clock import Clock
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import check_levels
from plyfold.layering.orders.maxsat import equal_or_failing, fewest_failures
from plyfold.layering.orders.search import OrderProblem, independent_orders, order_problem
from plyfold.memory import number_of_tuples, require_memory
from plyfold.ragged import count_each, pairs_in_each
from plyfold.sat import StoppableSolver, search_in_time, solve
from plyfold.wording import counted

__all__ = ["IntersectingLayering", "border_lengths", "least_intersecting_layering"]

# Lengths are weighed as integers: the longest border with this many units.
_UNITS = 1_000_000
# A pair of sheets glued along a border, and all that the solvers know about the wish that it keep its order.
_BYTES_PER_PAIR = 110
_BYTES_PER_WISH = 1600
# The part of the time in which to look for a layering without any intersections.
_TO_FIND_NONE = 0.25


@dataclass(frozen=True, eq=False)
class IntersectingLayering:
    """The levels of the sheets in a surface whose sheets pass through each other along borders.

    Parameters
    ----------
    immersion : Immersion
    level : (sheets,) int
        Level of each sheet among the sheets over its cell, counted from below, starting at 1.
    optimal : bool
        Whether it is proved that no levels have shorter intersections. Otherwise these are good ones.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> from plyfold.gallery import CURVES
    >>> least_intersecting_layering(find_immersion(CURVES["seven-flaps"].curve), time_limit=5.0)  # doctest: +ELLIPSIS
    <IntersectingLayering: ... along borders, ...the least possible>
    """

    immersion: Immersion
    level: Ints
    optimal: bool

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        found = f"{counted(len(self.intersections), 'intersection')} along borders"
        return f"<IntersectingLayering: {found}, {'' if self.optimal else 'maybe not '}the least possible>"

    @cached_property
    def intersections(self) -> Ints:
        """Rows (border, lower, upper), shape (m, 3): where and which sheets pass through each other.

        They lie over the cell on the right of the border; on its left, the sheets that are glued to them lie the other
        way round. Bridge j counts as border n_borders + j.
        """
        border, lower, upper, left_lower, left_upper = _glued_pairs(self.immersion).T
        risen = self.level[upper] > self.level[lower]
        crossed = np.flatnonzero(risen != (self.level[left_upper] > self.level[left_lower]))
        ordered = np.where(risen, [lower, upper], [upper, lower])
        return np.column_stack([border, *ordered])[crossed]

    @property
    def total_length(self) -> float:
        """Length of the intersections, measured along the borders and bridges in units of the drawing.

        For a Gauss code every border counts as 1.
        """
        return float(border_lengths(self.immersion.arrangement)[self.intersections[:, 0]].sum())

    def check(self) -> None:
        """Check that every cell's levels are 1 … w.

        Raises
        ------
        PlyfoldError
            Naming the cell. That would be a mistake in plyfold.
        """
        check_levels(self.immersion, self.level)


def least_intersecting_layering(immersion: Immersion, time_limit: float | None = None) -> IntersectingLayering:
    """Find the orders of sheets whose self-intersections are shortest in total.

    Parameters
    ----------
    immersion : Immersion
    time_limit : float, optional
        Seconds after which the best orders so far are returned; none by default. The limit covers setting up the
        problem; if not even that is done in time, the sheets lie in the order of their numbers.

    Returns
    -------
    IntersectingLayering
        Without intersections if and only if the immersion has a layering, as long as ``optimal`` is true; then it is
        that of :func:`~plyfold.find_layering`.
        Intersections run along borders; the shortest total length of borders is found, or for a Gauss code the
        smallest number of them.

    Raises
    ------
    MemoryLimitError
        If the triples of sheets, or the pairs of sheets glued along borders, would not fit into memory.

    Notes
    -----
    A layering is looked for first. If there is none: MaxSAT by cores [IMM19]_; NP-hard. Lengths are weighed to a
    millionth of the longest border. Where the time ends, the answer is that of a greedy search: gluings, longest
    borders first, are kept as long as all that are kept agree.
    Cost of setting up: O(Σ w²) over borders and O(Σ w³) over cells.

    References
    ----------
    .. [IMM19] A. Ignatiev, A. Morgado, J. Marques-Silva, "RC2: an efficient MaxSAT solver", Journal on
       Satisfiability, Boolean Modeling and Computation 11, 2019.

    Examples
    --------
    >>> from plyfold.gallery import CURVES
    >>> from plyfold import immersions
    >>> [len(least_intersecting_layering(i).intersections) for i in immersions(CURVES["bennequin"].curve)]
    [0, 1, 0, 1, 0]
    """
    level, optimal = _levels_in_time(immersion, Clock(time_limit))
    layering = IntersectingLayering(immersion, level, optimal)
    layering.check()
    # None is the least, also where there was no time to prove that of the answer to hand.
    return layering if optimal else replace(layering, optimal=not len(layering.intersections))


def _levels_in_time(immersion: Immersion, clock: Clock) -> tuple[Ints, bool]:
    """Return the best levels that are found in time, and whether there are none better."""
    level = 1 + count_each(immersion.arrangement.winding)
    try:
        without = _without_intersections(immersion, clock.share(_TO_FIND_NONE))
        if without is not None:
            return without, True
        problem = independent_orders(immersion, clock)
        wishes = _wishes(problem, clock)
        if clock.left is not None:
            # The greedy search is for the case that the exact one does not end in time.
            level = problem.levels(_greedy(wishes, Clock(clock.left / 2)))
        return problem.levels(_most_wishes(wishes, clock)), True
    except TimeoutError:
        return level, False


def _without_intersections(immersion: Immersion, clock: Clock) -> Ints | None:
    """Return the levels of a layering, if one is found in time."""
    with suppress(TimeoutError):
        problem = order_problem(immersion, clock)
        if isinstance(problem, OrderProblem) and (true := solve(problem.clauses, clock)) is not None:
            return problem.levels(true)
    return None


def border_lengths(arrangement: Arrangement) -> Floats:
    """Return the length of each border, and then of each bridge, in units of the drawing; 1 for a Gauss code."""
    if arrangement.outline is None:
        return np.ones(arrangement.n_borders + len(arrangement.bridges))
    along = [_length(arrangement, border) for border in range(arrangement.n_borders)]
    border, is_backward = np.divmod(arrangement.bridges, 2)
    feet = arrangement.start_visit[np.where(is_backward, arrangement.next_border[border], border)]
    x, y = np.diff(arrangement.visit_point[feet], axis=1).reshape(-1, 2).T
    return np.append(along, np.hypot(x, y))


def _length(arrangement: Arrangement, border: int) -> float:
    points = arrangement.border_points(border)
    if arrangement.start_visit[border] < 0:
        points = np.append(points, points[:1], axis=0)
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _glued_pairs(immersion: Immersion) -> Ints:
    """Return rows (border, two sheets on its right, the two glued to them on its left); each two sheets once."""
    border, right, left = immersion.gluing.T
    _require_memory(immersion, _BYTES_PER_PAIR)
    count = np.bincount(border, minlength=immersion.arrangement.n_borders)
    first, second = pairs_in_each(count)
    return np.column_stack([border[first], right[first], right[second], left[first], left[second]])


def _require_memory(immersion: Immersion, bytes_per_pair: int) -> None:
    arrangement = immersion.arrangement
    bridged = arrangement.cell_of_dart[arrangement.bridges[:, 0]]
    lower = arrangement.winding[np.append(arrangement.right_cell, bridged)]
    pairs = (number_of_tuples(lower, 2) - int(lower.sum())) // 2
    require_memory(
        bytes_per_pair * pairs,
        f"a table of {pairs:,} pairs of sheets that are glued along a border",
        arrangement,
        "find_layering(immersion) tells with less whether there is a layering without intersections",
    )


@dataclass(frozen=True, eq=False)
class _Wishes:
    """Orders that ought to be equal: two literals each, how much that is worth, and a variable for its failure."""

    problem: OrderProblem
    literals: list[list[int]]
    weight: list[int]
    failure: list[int]

    @property
    def clauses(self) -> Iterator[list[int]]:
        """The constraints on orders, and that unequal literals are a failure."""
        return chain(self.problem.clauses, equal_or_failing(self.literals, self.failure))


def _wishes(problem: OrderProblem, clock: Clock) -> _Wishes:
    clock.check()
    _require_memory(problem.immersion, _BYTES_PER_WISH)
    border, *sheets = _glued_pairs(problem.immersion).T
    clock.check()
    literals = np.stack([problem.above(*sheets[:2]), problem.above(*sheets[2:])], axis=1)
    length = border_lengths(problem.immersion.arrangement)
    weight = np.maximum(1, np.rint(length * (_UNITS if np.ptp(length) else 1) / length.max())).astype(np.int64)
    failure = problem.n_variables + 1 + np.arange(len(border))
    return _Wishes(problem, literals.tolist(), weight[border].tolist(), failure.tolist())


def _most_wishes(wishes: _Wishes, clock: Clock) -> list[int]:
    """Return the literals of a solution whose failures weigh least. Raises TimeoutError when the time is over."""
    weight = dict(zip(wishes.failure, wishes.weight, strict=True))
    n_variables = wishes.problem.n_variables + len(weight)
    true, _ = fewest_failures(wishes.clauses, n_variables, weight, clock, stratified=True)
    if true is None:
        raise TimeoutError
    return true


def _greedy(wishes: _Wishes, clock: Clock) -> list[int]:
    """Return the literals of a solution: fulfil wishes, the weightiest first, as long as there is time."""
    return search_in_time(wishes.clauses, clock, partial(_one_by_one, wishes))


def _one_by_one(wishes: _Wishes, solver: StoppableSolver) -> list[int]:
    solver.solve()
    true: list[int] = solver.get_model()
    with suppress(TimeoutError):
        for wish in np.argsort(-np.array(wishes.weight), kind="stable").tolist():
            fulfilled = [-wishes.failure[wish]]
            if _equal(true, *wishes.literals[wish]):
                solver.add_clause(fulfilled)
            elif solver.solve(fulfilled):
                solver.add_clause(fulfilled)
                true = solver.get_model()
    return true


def _equal(true: list[int], first: int, second: int) -> bool:
    """Tell whether two literals are both true or both false in a solution."""
    return (true[abs(first) - 1] == first) == (true[abs(second) - 1] == second)
