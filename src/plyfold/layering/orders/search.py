"""The exact search for a layering of an immersed surface, or for the reason why there is none (§3 of the paper).

Two sheets that are glued to two sheets of the next cell keep their order across the border. So ordered pairs of sheets
fall into classes (:mod:`plyfold.layering.orders.pairs`): all pairs of a class are in order, or all are reversed.

There is one unknown for every class, and one constraint for every three sheets over a cell: they must not lie above
each other in a circle, so of their three orders, taken round the circle, not all are true and not all are false.
Finding, counting and listing layerings all read this one problem.
"""

from __future__ import annotations

import operator
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, combinations
from typing import Literal, TypeAlias, cast

import numpy as np

from plyfold.arrangement.places import place_in_cell
from plyfold.arrays import Bools, Ints, freeze
from plyfold.clock import NO_LIMIT, Clock, Progress
from plyfold.errors import InputError, TimeLimitError
from plyfold.graphs import components
from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering, crossing_visits_by_loop, meeting_sheets
from plyfold.layering.orders.pairs import PairGraph, every_pair, pair_graph, shortest_chain_to_reverse
from plyfold.loading import FOR_LAYERINGS, load_libraries
from plyfold.memory import require_memory
from plyfold.obstruction import Obstruction, Unknown
from plyfold.ragged import count_each, pairs_in_each
from plyfold.sat import minimal_core, solve

__all__ = [
    "FixedOrders",
    "OrderProblem",
    "find_layering",
    "first_layering",
    "independent_orders",
    "order_problem",
    "places_of_cells",
    "solve_orders",
    "undecided",
]


FixedOrders: TypeAlias = Mapping[tuple[int, int, int], Literal["above", "below"]]

_QUESTION = "whether there is a layering"
_NOTHING: FixedOrders = {}


def find_layering(
    immersion: Immersion, time_limit: float | None = None, fix: FixedOrders | None = None
) -> Layering | Obstruction | Unknown:
    """Find an order of the sheets over every cell that all gluings keep, or prove that there is none.

    Parameters
    ----------
    immersion : Immersion
    time_limit : float, optional
        Seconds after which to give up; none by default.
    fix : mapping of (cell, sheet_a, sheet_b) to "above" or "below", optional
        Orders that the layering must have: over the cell, sheet a lies above or below sheet b.

    Returns
    -------
    Layering or Obstruction or Unknown
        The result is true if there is a layering; it has been checked. An obstruction holds the reason: a chain of
        cells along which a pair of sheets returns reversed (``value`` is a tuple of (cell, lower, upper)), sheets that
        would have to lie above each other in a circle (``value`` is a tuple of (cell, three sheets)), or fixed orders
        that contradict each other (``value`` is a tuple of (cell, sheet a, sheet b, "above" or "below")). None of the
        latter two can be left out, unless the time limit ended the search for the fewest. If the limit was reached
        before there was an answer, it is Unknown.

    Raises
    ------
    InputError
        If ``fix`` names a sheet that does not lie over the cell, or a sheet twice.
    MemoryLimitError
        If the pairs or triples of sheets would not fit into memory.

    Notes
    -----
    Exact in both directions. The problem is NP-complete [EM09]_; the instances of drawings are solved at once. The
    classes of pairs cost O(Σ w²), and triples of sheets O(Σ w³), over cells that no higher cell lies beside.

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> lower, upper = ramp.sheets[1]
    >>> find_layering(ramp, fix={(1, lower, upper): "below"}).level.tolist()
    [1, 2, 1, 1, 1]
    >>> find_layering(ramp, fix={(1, lower, upper): "above"}).level.tolist()
    [2, 1, 1, 1, 1]
    """
    clock = Clock(time_limit)
    problem = order_problem_in_time(immersion, clock, _QUESTION)
    return solve_orders(problem, clock, fix or {}) if isinstance(problem, OrderProblem) else problem


def solve_orders(problem: OrderProblem, clock: Clock, fix: FixedOrders = _NOTHING) -> Layering | Obstruction | Unknown:
    """Return a solution of the problem with some orders fixed, or why there is none."""
    fixed = _fixed_literals(problem, fix)
    try:
        true = solve(chain(problem.clauses, ([literal] for literal in fixed)), clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock, problem)
    if true is not None:
        return problem.layering(true)
    return _contradiction(problem, fix, fixed, clock)


def first_layering(
    candidates: Iterable[Immersion], time_limit: float | None = None, progress: Progress | None = None
) -> tuple[Layering | Obstruction, int]:
    """Find the first of several immersions that can be layered.

    Parameters
    ----------
    candidates : iterable of Immersion
        At least one, for example all immersions of a curve.
    time_limit : float, optional
        Seconds for all of them together, once the libraries are loaded; none by default.
    progress : callable, optional
        Called with a few words and the fraction done before each immersion.

    Returns
    -------
    Layering or Obstruction
        The obstruction is that of the first immersion.
    int
        How many immersions were examined.

    Raises
    ------
    TimeLimitError
        If the time limit was reached: the answer is unknown.
    """
    load_libraries(FOR_LAYERINGS, progress)
    clock = Clock(time_limit)
    first: Obstruction | None = None
    examined = 0
    for examined, immersion in enumerate(candidates, 1):
        stage = f"layering immersion {examined}"
        if progress is not None:
            progress(stage, 0.0)
        found = find_layering(immersion, clock.left)
        if isinstance(found, Layering):
            return found, examined
        if isinstance(found, Unknown):
            raise TimeLimitError(
                f"whether the surface can be layered is unknown after {time_limit or 0:.3g} seconds, which ended while "
                f"{stage}",
                hint="allow more time",
                stage=stage,
            )
        first = found if first is None else first
    if first is None:
        raise ValueError("there is no immersion to layer")
    return first, examined


def undecided(reason: str, question: str, clock: Clock, problem: OrderProblem | None = None) -> Unknown:
    """Return the answer to a question that was left open, with what is known of the problem."""
    seconds = clock.spent
    why = f"after {seconds:.3g} s" if reason == "time limit" else "for want of memory"
    sentence = f"Unknown {why}: {question}."
    if problem is None:
        return Unknown(reason, sentence, {"seconds": seconds})
    known = {"pair classes": problem.n_variables, "triples": len(problem.triples), "seconds": seconds}
    sentence += (
        f" No pair of sheets returns reversed; {problem.n_variables} classes of pairs are to be ordered under "
        f"{len(problem.triples)} constraints."
    )
    return Unknown(reason, sentence, known)


def _fixed_literals(problem: OrderProblem, fix: FixedOrders) -> list[int]:
    """Return the literals that fixed orders make true; refuse what are not two sheets over the cell."""
    pairs = []
    for key, order in fix.items():
        if order not in ("above", "below"):
            raise InputError(f'a sheet lies "above" or "below" another one, not {order!r}')
        cell, first, second = _cell_and_sheets(key)
        _require_sheets(problem.immersion, cell, first, second)
        pairs.append((second, first) if order == "above" else (first, second))
    lower, upper = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    return [int(literal) for literal in problem.above(lower, upper)]


def _cell_and_sheets(key: object) -> tuple[int, int, int]:
    try:
        cell, first, second = (operator.index(number) for number in cast(tuple[int, int, int], key))
    except (TypeError, ValueError):
        raise InputError(f"a fixed order is for (cell, sheet a, sheet b), not for {key!r}") from None
    return cell, first, second


def _require_sheets(immersion: Immersion, cell: int, first: int, second: int) -> None:
    if not 0 <= cell < immersion.arrangement.n_cells:
        raise InputError(f"there is no cell {cell}: cells are numbered 0 to {immersion.arrangement.n_cells - 1}")
    sheets = immersion.sheets[cell]
    if first == second or first not in sheets or second not in sheets:
        raise InputError(
            f"{first} and {second} are not two sheets over cell {cell}",
            where=places_of_cells(immersion, [cell]),
            hint=f"its sheets are {list(sheets)}" if sheets else "no sheet lies over it",
        )


def _contradiction(problem: OrderProblem, fix: FixedOrders, fixed: list[int], clock: Clock) -> Obstruction:
    """Return why there is no solution: constraints that contradict each other, or only together with fixed orders."""
    if not fixed or _contradictory(problem, clock):
        return _cyclic_order(problem, clock)
    orders = [(*key, order) for key, order in fix.items()]
    value = tuple(orders[i] for i in minimal_core([[[x]] for x in fixed], problem.clauses, clock))
    listed = "; ".join(f"over cell {cell}, {a} {order} {b}" for cell, a, b, order in value)
    sentence = f"No layering has these fixed orders of sheets together: {listed}."
    places = places_of_cells(problem.immersion, [cell for cell, *_ in value])
    return Obstruction("fixed orders", sentence, places, value, problem.immersion)


def _contradictory(problem: OrderProblem, clock: Clock) -> bool:
    """Tell whether the constraints are known to contradict each other without any fixed orders."""
    try:
        return solve(problem.clauses, clock) is None
    except TimeoutError:
        return False


def _cyclic_order(problem: OrderProblem, clock: Clock) -> Obstruction:
    triples = problem.triples.tolist()
    core = minimal_core([[triple, [-x for x in triple]] for triple in triples], clock=clock)
    value = tuple((problem.cell_of(i), problem.sheets[i].tolist()) for i in core)
    triples_of_sheets = f"among {len(core)} triples of sheets, some three" if len(core) > 1 else "three sheets"
    sentence = f"No layering: {triples_of_sheets} always lie above each other in a circle."
    places = places_of_cells(problem.immersion, [cell for cell, _ in value])
    return Obstruction("cyclic order", sentence, places, value, problem.immersion)


# ---- the problem ---------------------------------------------------------------------------------------------------

_ROWS_AT_A_TIME = 4096
# With what is needed to make them.
_BYTES_PER_TRIPLE = 200
_TRIPLES_AT_A_TIME = 1_000_000
# Three numbers up to this one, and their signs, fit into one.
_SMALL = 2**20


@dataclass(frozen=True, eq=False)
class OrderProblem:
    """The orders of sheets over an immersion that no pair of sheets contradicts by itself.

    Parameters
    ----------
    immersion : Immersion
    graph : PairGraph
        Ordered pairs of sheets, with all that the constraints are between.
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
        return np.asarray(self.literal[self.graph.pair_of(lower, upper)])

    @cached_property
    def _component(self) -> Ints:
        """The number of the component of each variable: of those that constraints tie together."""
        variable = np.abs(self.triples) - 1
        return components(self.n_variables, *np.concatenate([variable[:, :2], variable[:, 1:]]).T)

    @property
    def parts(self) -> Ints:
        """The component of each constraint."""
        return np.asarray(self._component[np.abs(self.triples[:, 0]) - 1])

    def components(self) -> list[list[int]]:
        """Return the variables that constraints tie together, and those that are free each alone, in order."""
        groups: dict[int, list[int]] = {}
        for number, label in enumerate(self._component.tolist(), 1):
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
        number_below = np.bincount(self.graph.upper[below], minlength=self.immersion.n_sheets)
        upward = np.lexsort((number_below[self.graph.stand_in], self.immersion.sheet_cell))
        level = np.empty(self.immersion.n_sheets, dtype=np.int64)
        level[upward] = 1 + count_each(self.immersion.arrangement.winding)
        return level


def order_problem(immersion: Immersion, clock: Clock = NO_LIMIT) -> OrderProblem | Obstruction:
    """Return the problem, or a pair of sheets that returns reversed: then there is no layering.

    Cost: O(Σ w²) for pairs and O(Σ w³) for triples, over summits. Raises TimeoutError when the time is over.
    """
    graph = pair_graph(immersion, clock)
    if len(graph.contradictions()):
        return _reversed_pair(graph, clock)
    return _problem(immersion, graph, clock)


def order_problem_in_time(immersion: Immersion, clock: Clock, question: str) -> OrderProblem | Obstruction | Unknown:
    """Return the same, or at the time limit that a question is left open."""
    try:
        return order_problem(immersion, clock)
    except TimeoutError:
        return undecided("time limit", question, clock)


def independent_orders(immersion: Immersion, clock: Clock = NO_LIMIT) -> OrderProblem:
    """Return the problem without the gluings: every pair of sheets over a cell has a variable of its own.

    Raises TimeoutError when the time is over.
    """
    return _problem(immersion, every_pair(immersion, clock), clock)


def places_of_cells(immersion: Immersion, cells: Iterable[int]) -> tuple[tuple[float, float], ...]:
    """Return a point in each of the cells, in order of appearance; none if there is no drawing."""
    if immersion.arrangement.outline is None:
        return ()
    return tuple(place_in_cell(immersion.arrangement, cell) for cell in dict.fromkeys(cells))


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
    visits = np.concatenate(crossing_visits_by_loop(immersion.arrangement))
    here, there = (sheets[visits] for sheets in meeting_sheets(immersion))
    met = graph.pair_of(there, here)
    is_met = np.zeros(len(graph.label), dtype=bool)
    is_met[representative[met]] = True
    if not (is_met[representative] | (graph.lower == graph.upper)).all():
        met = np.concatenate([met, graph.pair_of(*pairs_in_each(immersion.arrangement.winding))])
    classes, place = np.unique(representative[met], return_index=True)
    variable = np.zeros(len(graph.label), dtype=np.int64)
    variable[classes[np.argsort(place)]] = 1 + np.arange(len(classes))
    true = np.zeros(len(graph.label), dtype=np.int64)
    true[classes] = graph.label[met[place]]
    literal = variable[representative]
    return np.where(graph.label == true[representative], literal, -literal)


def _triples(immersion: Immersion, graph: PairGraph, literal: Ints, clock: Clock) -> tuple[Ints, Ints]:
    """Return the constraints on triples of sheets, each once, and for each the first three sheets that demand it."""
    nothing = np.empty((0, 3), dtype=np.int64)
    waiting = [(nothing, nothing)]
    for more in _all_triples(immersion, graph, literal):
        clock.check()
        waiting.append(more)
        number = sum(len(some) for some, _ in waiting)
        _require_memory_for_triples(immersion, number)
        if number > max(_TRIPLES_AT_A_TIME, 2 * len(waiting[0][0])):
            waiting = [_together(waiting)]
    return _together(waiting)


def _require_memory_for_triples(immersion: Immersion, number: int) -> None:
    require_memory(
        _BYTES_PER_TRIPLE * number,
        f"{number:,} triples of sheets",
        immersion.arrangement,
        "embed_cased(curve, over) orders sheets without triples, where over and under are known",
    )


def _all_triples(immersion: Immersion, graph: PairGraph, literal: Ints) -> Iterator[tuple[Ints, Ints]]:
    """Yield the constraints on three sheets, and the sheets, of some cells at a time, the lowest first."""
    with_pairs = graph.cells()
    winding = immersion.arrangement.winding[with_pairs]
    for w in np.unique(winding[winding >= 3]).tolist():
        three = np.array(list(combinations(range(w), 3)))
        pair = three * w + three[:, [1, 2, 0]]
        cells, step = with_pairs[winding == w], max(1, _TRIPLES_AT_A_TIME // len(three))
        for some in (cells[start : start + step] for start in range(0, len(cells), step)):
            _require_memory_for_triples(immersion, len(some) * len(three))
            x, y, z = (literal[graph.first_pair[some, None] + column].ravel() for column in pair.T)
            cycles, rows = _in_standard_form(x, y, z)
            kept = _each_once(cycles)
            cell, which = np.divmod(rows[kept], len(three))
            yield cycles[kept], immersion.first_sheet[some[cell], None] + three[which]


def _in_standard_form(x: Ints, y: Ints, z: Ints) -> tuple[Ints, Ints]:
    """Bring equal constraints into the same form; return also which rows they are of.

    Those that have a literal and its opposite are left out, for they always hold.
    """
    rows = np.flatnonzero((x != -y) & (y != -z) & (z != -x))
    # Variables with their signs behind them are in order if they are as whole numbers.
    x, y, z = (2 * np.abs(literal[rows]) + (literal[rows] < 0) for literal in (x, y, z))
    x, y = np.minimum(x, y), np.maximum(x, y)
    y, z = np.minimum(y, z), np.maximum(y, z)
    x, y = np.minimum(x, y), np.maximum(x, y)
    is_reversed = x & 1
    first, middle, last = ((a >> 1) * (1 - 2 * ((a & 1) ^ is_reversed)) for a in (x, y, z))
    return np.stack([first, np.where(first == middle, last, middle), last], axis=1), rows


def _together(parts: list[tuple[Ints, Ints]]) -> tuple[Ints, Ints]:
    """Put constraints of several parts in order, each once, with their sheets."""
    cycles, sheets = (np.concatenate(columns) for columns in zip(*parts, strict=True))
    kept = _each_once(cycles)
    return cycles[kept], sheets[kept]


def _each_once(cycles: Ints) -> Ints:
    """Return constraints in order, by their last literals, then by those in the middle; of equal ones the first.

    That order belongs to the drawing, as literals do, and not to how cells are numbered.
    """
    highest = int(np.abs(cycles).max(initial=0))
    if highest >= _SMALL:
        order = np.lexsort(cycles.T)
        return order[_begins((cycles[order[1:]] != cycles[order[:-1]]).any(axis=1))]
    first, middle, last = cycles.T
    base = 2 * highest + 1
    key = (last * base + middle) * base + first
    # Not stable, which is faster; the first of equal ones is the least.
    order = np.argsort(key)
    begins = np.flatnonzero(_begins(np.diff(key[order]) != 0))
    return np.minimum.reduceat(order, begins) if len(order) else order


def _begins(differs: Bools) -> Bools:
    """Tell which of some values in order differ from the one before; the first one does."""
    return np.append(True, differs)


def _reversed_pair(graph: PairGraph, clock: Clock) -> Obstruction:
    steps = tuple(shortest_chain_to_reverse(graph, clock))
    sentence = f"No layering: two sheets, followed through {len(steps)} cells, return with their order reversed."
    places = places_of_cells(graph.immersion, [cell for cell, _, _ in steps])
    return Obstruction("reversed pair", sentence, places, steps, graph.immersion)
