"""Which orders of sheets make a layering, as a problem of truth values.

There is one unknown for every class of pairs of sheets whose orders depend on each other, and one constraint for every
three sheets over a cell: they must not lie above each other in a circle, so of their three orders, taken round the
circle, not all are true and not all are false. Finding, counting and listing layerings all read this one value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import numpy as np

from plyfold.arrangement.base import visits_from_base
from plyfold.arrays import Ints, freeze
from plyfold.clock import NO_LIMIT, Clock
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering, meeting_sheets
from plyfold.layering.orders.sheet_pairs import PairGraph, chain_to_reverse, pair_graph, pair_of
from plyfold.memory import number_of_tuples, require_memory
from plyfold.obstruction import Obstruction

__all__ = ["OrderProblem", "independent_orders", "order_problem", "places_of_cells"]

_ROWS_AT_A_TIME = 4096
# With what is needed to make them.
_BYTES_PER_TRIPLE = 200


@dataclass(frozen=True, eq=False)
class OrderProblem:
    """The orders of sheets over an immersed disk that no pair of sheets contradicts by itself.

    Parameters
    ----------
    immersion : Immersion
    graph : PairGraph
        The ordered pairs of sheets.
    literal : (pairs,) int
        A variable 1, 2, … for each class of pairs, negative for the reversed pairs: it is true if the pair's second
        sheet lies above its first. Where a pair is no pair, 0.
    triples : (t, 3) int
        Literals of which not all may be true and not all false. Each such constraint occurs once.
    sheets : (t, 3) int
        Three sheets over one cell that demand it.
    """

    immersion: Immersion
    graph: PairGraph
    literal: Ints
    triples: Ints
    sheets: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @cached_property
    def n_variables(self) -> int:
        """Number of classes of pairs of sheets."""
        return int(self.literal.max(initial=0))

    @property
    def clauses(self) -> Iterator[list[int]]:
        """The constraints as clauses: two for every triple."""
        for start in range(0, len(self.triples), _ROWS_AT_A_TIME):
            for triple in self.triples[start : start + _ROWS_AT_A_TIME].tolist():
                yield triple
                yield [-x for x in triple]

    def cell_of(self, triple: int) -> int:
        """Return the cell of the three sheets that demand a constraint."""
        return int(self.immersion.sheet_cell[self.sheets[triple, 0]])

    def above(self, lower: Ints, upper: Ints) -> Ints:
        """Return the literals that are true if the second sheets lie above the first."""
        return np.asarray(self.literal[pair_of(self.immersion, self.graph.first_pair, lower, upper)])

    def components(self) -> list[list[int]]:
        """Return the variables that constraints tie together, and those that are free each alone, in order."""
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        n = self.n_variables
        variable = np.abs(self.triples) - 1
        ends = np.concatenate([variable[:, :2], variable[:, 1:]])
        tied = coo_array((np.ones(len(ends), dtype=bool), ends.T), shape=(n, n))
        groups: dict[int, list[int]] = {}
        for number, label in enumerate(connected_components(tied, directed=False)[1].tolist(), 1):
            groups.setdefault(label, []).append(number)
        return list(groups.values())

    def layering(self, true: Iterable[int]) -> Layering:
        """Return the checked layering of a solution; variables that it does not name are true."""
        layering = Layering(self.immersion, self.levels(true))
        layering.check()
        return layering

    def levels(self, true: Iterable[int]) -> Ints:
        """Return the level of each sheet: one more than the number of sheets below it, in a solution.

        Literals of other variables do not count.
        """
        value = np.ones(self.n_variables + 1, dtype=bool)
        literals = np.fromiter(true, dtype=np.int64)
        value[-literals[(literals < 0) & (literals >= -self.n_variables)]] = False
        below = (value[np.abs(self.literal)] == (self.literal > 0)) & (self.literal != 0)
        return np.asarray(1 + np.bincount(self.graph.upper[below], minlength=self.immersion.n_sheets), dtype=np.int64)


def order_problem(immersion: Immersion, clock: Clock = NO_LIMIT) -> OrderProblem | Obstruction:
    """Return the problem, or a pair of sheets that returns reversed: then there is no layering.

    Cost: O(Σ w²) for pairs, over cells and borders, and O(Σ w³) for triples, over cells. Raises TimeoutError when the
    time is over.
    """
    graph = pair_graph(immersion, clock)
    contradictions = graph.contradictions()
    if len(contradictions):
        return _reversed_pair(immersion, graph, int(contradictions[0]))
    return _problem(immersion, graph, clock)


def independent_orders(immersion: Immersion, clock: Clock = NO_LIMIT) -> OrderProblem:
    """Return the problem without the gluings: every pair of sheets over a cell has a variable of its own.

    Raises TimeoutError when the time is over.
    """
    graph = pair_graph(immersion, clock)
    return _problem(immersion, replace(graph, label=np.arange(len(graph.label))), clock)


def places_of_cells(immersion: Immersion, cells: Iterable[int]) -> tuple[tuple[float, float], ...]:
    """Return a point in each of the cells, in order of appearance; none if there is no drawing."""
    if immersion.arrangement.curve is None:
        return ()
    return tuple(immersion.arrangement.cell_point(cell) for cell in dict.fromkeys(cells))


def _problem(immersion: Immersion, graph: PairGraph, clock: Clock) -> OrderProblem:
    clock.check()
    literal = _literals(immersion, graph)
    return OrderProblem(immersion, graph, literal, *_triples(immersion, graph, literal, clock))


def _literals(immersion: Immersion, graph: PairGraph) -> Ints:
    """Return a signed variable for each ordered pair, numbered without gaps.

    The classes are numbered in the order in which the curve, from its base visit on, meets their sheets at a crossing,
    and a variable is true if the strand that comes first passes over. So equal drawings get equal problems, and equal
    solutions, wherever their lists of points begin.
    """
    representative = np.minimum(graph.label, graph.label[graph.reverse])
    here, there = (sheets[visits_from_base(immersion.arrangement)] for sheets in meeting_sheets(immersion))
    met = pair_of(immersion, graph.first_pair, there, here)
    met_first = np.concatenate([met, np.flatnonzero(graph.lower != graph.upper)])
    classes, place = np.unique(representative[met_first], return_index=True)
    variable = np.zeros(len(graph.label), dtype=np.int64)
    variable[classes[np.argsort(place)]] = 1 + np.arange(len(classes))
    true = np.zeros(len(graph.label), dtype=np.int64)
    true[classes] = graph.label[met_first[place]]
    literal = variable[representative]
    return np.where(graph.label == true[representative], literal, -literal)


def _triples(immersion: Immersion, graph: PairGraph, literal: Ints, clock: Clock) -> tuple[Ints, Ints]:
    """Return the constraints on triples of sheets, each once, and for each three sheets that demand it."""
    winding = immersion.arrangement.winding
    number = number_of_tuples(winding, 3) // 6
    require_memory(
        _BYTES_PER_TRIPLE * number,
        f"{number:,} triples of sheets",
        immersion.arrangement,
        "embed_cased(curve, over) orders sheets without triples, where over and under are known",
    )
    cycles, sheets = [np.empty((0, 3), dtype=np.int64)], [np.empty((0, 3), dtype=np.int64)]
    for w in np.unique(winding[winding >= 3]).tolist():
        clock.check()
        cells = np.flatnonzero(winding == w)
        three = np.array(list(combinations(range(w), 3)))
        pair = three * w + np.roll(three, -1, axis=1)
        cycles.append(literal[graph.first_pair[cells, None, None] + pair].reshape(-1, 3))
        sheets.append((immersion.first_sheet[cells, None, None] + three).reshape(-1, 3))
    clock.check()
    return _each_once(np.concatenate(cycles), np.concatenate(sheets))


def _each_once(cycles: Ints, sheets: Ints) -> tuple[Ints, Ints]:
    """Leave out constraints that always hold, for they have a literal and its opposite, and repeated ones."""
    always = (cycles == -np.roll(cycles, 1, axis=1)).any(axis=1)
    cycles, sheets = cycles[~always], sheets[~always]
    cycles = np.take_along_axis(cycles, np.argsort(np.abs(cycles), axis=1), axis=1)
    cycles = np.where(cycles[:, :1] < 0, -cycles, cycles)
    cycles[:, 1] = np.where(cycles[:, 0] == cycles[:, 1], cycles[:, 2], cycles[:, 1])
    order = np.lexsort(cycles.T)
    repeats = np.zeros(len(order), dtype=bool)
    repeats[order[1:]] = (cycles[order[1:]] == cycles[order[:-1]]).all(axis=1)
    return cycles[~repeats], sheets[~repeats]


def _reversed_pair(immersion: Immersion, graph: PairGraph, pair: int) -> Obstruction:
    chain = chain_to_reverse(graph, pair)
    steps = tuple((int(immersion.sheet_cell[graph.lower[p]]), int(graph.lower[p]), int(graph.upper[p])) for p in chain)
    sentence = f"No layering: two sheets, followed through {len(steps)} cells, return with their order reversed."
    places = places_of_cells(immersion, [cell for cell, _, _ in steps])
    return Obstruction("reversed pair", sentence, places, steps, immersion)
