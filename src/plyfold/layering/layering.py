"""A layering: the vertical order of the sheets over every cell, and the exact search for one (§3 of the paper)."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import combinations
from threading import Timer
from typing import TypeAlias

import numpy as np

from plyfold.arrangement.planar_map import Ints
from plyfold.errors import PlyfoldError, TimeLimitError
from plyfold.immersion import Immersion
from plyfold.layering.sheet_pairs import PairGraph, chain_to_reverse, pair_graph
from plyfold.obstruction import Obstruction

__all__ = ["Layering", "find_layering", "first_layering"]

Progress: TypeAlias = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Layering:
    """The levels of the sheets: a way to lift an immersed disk off the table so that it does not cut itself.

    Parameters
    ----------
    immersion : Immersion
    level : (sheets,) int
        Level of each sheet among the sheets over its cell, counted from below, starting at 1.

    Examples
    --------
    >>> from plyfold.immersion import find_immersion
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> sorted(find_layering(ramp).level.tolist())
    [1, 1, 1, 1, 2]
    """

    immersion: Immersion
    level: Ints

    def __post_init__(self) -> None:
        self.level.flags.writeable = False

    def __repr__(self) -> str:
        return f"<Layering: {self.immersion.n_sheets} sheets on up to {self.level.max(initial=0)} levels>"

    def check(self) -> None:
        """Check that every cell's levels are 1 … w and that every gluing keeps the order.

        Raises
        ------
        PlyfoldError
            Naming the cell or the border. That would be a mistake in plyfold.

        Notes
        -----
        O(Σ w log w).
        """
        for condition, holds in self._conditions():
            if not holds:
                raise PlyfoldError(f"internal check failed: {condition}")

    def _conditions(self) -> Iterator[tuple[str, bool]]:
        arrangement = self.immersion.arrangement
        for cell, winding in enumerate(arrangement.winding.tolist()):
            levels = sorted(self.level[list(self.immersion.sheets[cell])].tolist())
            yield f"the sheets of cell {cell} have levels 1 to {winding}", levels == list(range(1, winding + 1))
        border, right, left = self.immersion.gluing.T
        order = np.lexsort((self.level[right], border))
        rises = np.diff(self.level[left[order]]) > 0
        elsewhere = np.diff(border[order]) > 0
        yield "every gluing keeps the order of the sheets", bool((rises | elsewhere).all())


def find_layering(immersion: Immersion, time_limit: float | None = None) -> Layering | Obstruction:
    """Find an order of the sheets over every cell that all gluings keep, or prove that there is none.

    Parameters
    ----------
    immersion : Immersion
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    Layering or Obstruction
        The result is true if there is a layering; it has been checked. An obstruction holds the reason: a chain of
        cells along which a pair of sheets returns reversed (``value`` is a tuple of (cell, lower, upper)), or sheets
        that would have to lie above each other in a circle (``value`` is a tuple of (cell, three sheets)).

    Raises
    ------
    TimeLimitError
        If the time limit was reached: the answer is unknown.

    Notes
    -----
    Exact in both directions. The problem is NP-complete [EM09]_; the instances of drawings are solved at once. The
    classes of pairs cost O(Σ w²), and triples of sheets O(Σ w³).

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    >>> from plyfold.immersion import find_immersion
    >>> bool(find_layering(find_immersion([(0, 0), (1, 0), (0, 1)])))
    True
    """
    if time_limit is not None and not time_limit > 0:
        raise _unknown(time_limit)
    graph = pair_graph(immersion)
    contradictions = graph.contradictions()
    if len(contradictions):
        return _reversed_pair(immersion, graph, int(contradictions[0]))
    literal = _literals(graph)
    triples = _triples(immersion, graph, literal)
    true = _solve([list(clause) for clause, _ in triples], time_limit)
    if true is None:
        return _cyclic_order(immersion, triples)
    layering = Layering(immersion, _levels(immersion, graph, literal, true))
    layering.check()
    return layering


def first_layering(
    candidates: Iterable[Immersion], time_limit: float | None = None, progress: Progress | None = None
) -> tuple[Layering | Obstruction, int]:
    """Find the first of several immersions that can be layered.

    Parameters
    ----------
    candidates : iterable of Immersion
        At least one, for example all immersions of a curve.
    time_limit : float, optional
        Seconds for all of them together; none by default.
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
    deadline = None if time_limit is None else time.monotonic() + time_limit
    first: Obstruction | None = None
    examined = 0
    for examined, immersion in enumerate(candidates, 1):
        if progress is not None:
            progress(f"layering immersion {examined}", 0.0)
        left = None if deadline is None else deadline - time.monotonic()
        found = find_layering(immersion, left)
        if isinstance(found, Layering):
            return found, examined
        first = found if first is None else first
    if first is None:
        raise ValueError("there is no immersion to layer")
    return first, examined


def _literals(graph: PairGraph) -> Ints:
    """Return a signed variable for each ordered pair: it is true if the second sheet lies above the first."""
    mirrored = graph.label[graph.reverse]
    representative = np.minimum(graph.label, mirrored)
    variable = np.unique(representative, return_inverse=True)[1] + 1
    return np.where(graph.label == representative, variable, -variable)


Triple = tuple[tuple[int, int, int], tuple[int, int, int, int]]


def _triples(immersion: Immersion, graph: PairGraph, literal: Ints) -> list[Triple]:
    """Return for all triples of sheets the literals that must not be equal, each set once, with cell and sheets."""
    found: dict[frozenset[int], Triple] = {}
    winding = immersion.arrangement.winding.tolist()
    for cell in np.flatnonzero(immersion.arrangement.winding >= 3).tolist():
        w, first = winding[cell], int(immersion.first_sheet[cell])
        pairs = literal[graph.first_pair[cell] :][: w * w].reshape(w, w).tolist()
        for i, j, k in combinations(range(w), 3):
            cycle = (pairs[i][j], pairs[j][k], pairs[k][i])
            if -cycle[0] not in cycle and -cycle[1] not in cycle:
                key = frozenset(cycle) if max(cycle, key=abs) > 0 else frozenset(-x for x in cycle)
                found.setdefault(key, (cycle, (cell, first + i, first + j, first + k)))
    return list(found.values())


def _solve(cycles: list[list[int]], time_limit: float | None) -> set[int] | None:
    """Return the true literals of a solution in which no cycle is all true or all false; None if there is none."""
    from pysat.solvers import Glucose4

    clauses = [clause for cycle in cycles for clause in (cycle, [-x for x in cycle])]
    with Glucose4(bootstrap_with=clauses) as solver:
        timer = Timer(time_limit, solver.interrupt) if time_limit is not None else None
        if timer is not None:
            timer.start()
        answer = solver.solve_limited(expect_interrupt=True)
        if timer is not None:
            timer.cancel()
        if answer is None:
            raise _unknown(time_limit)
        return set(solver.get_model()) if answer else None


def _unknown(time_limit: float | None) -> TimeLimitError:
    return TimeLimitError(
        f"whether the surface can be layered is unknown after {time_limit or 0:g} seconds", hint="allow more time"
    )


def _levels(immersion: Immersion, graph: PairGraph, literal: Ints, true: set[int]) -> Ints:
    """Return each sheet's level: one more than the number of sheets below it. Free variables count as true."""
    below = np.isin(literal, list(true)) | ((literal > 0) & ~np.isin(-literal, list(true)))
    counted = below & (graph.lower != graph.upper)
    return np.asarray(1 + np.bincount(graph.upper[counted], minlength=immersion.n_sheets), dtype=np.int64)


def _reversed_pair(immersion: Immersion, graph: PairGraph, pair: int) -> Obstruction:
    chain = chain_to_reverse(graph, pair)
    steps = tuple((int(immersion.sheet_cell[graph.lower[p]]), int(graph.lower[p]), int(graph.upper[p])) for p in chain)
    sentence = f"No layering: two sheets, followed through {len(steps)} cells, return with their order reversed."
    return Obstruction("reversed pair", sentence, _places(immersion, [cell for cell, _, _ in steps]), steps)


def _cyclic_order(immersion: Immersion, triples: list[Triple]) -> Obstruction:
    core = _minimal_core(triples)
    value = tuple((cell, sheets) for _, (cell, *sheets) in core)
    sentence = f"No layering: among {len(core)} triples of sheets, some three always lie above each other in a circle."
    return Obstruction("cyclic order", sentence, _places(immersion, [cell for cell, _ in value]), value)


def _minimal_core(triples: list[Triple]) -> list[Triple]:
    """Return triples that already contradict each other, none of which can be left out."""
    from pysat.solvers import Glucose4

    first_selector = 1 + max(abs(x) for cycle, _ in triples for x in cycle)
    with Glucose4() as solver:
        for selector, (cycle, _) in enumerate(triples, first_selector):
            solver.add_clause([*cycle, -selector])
            solver.add_clause([*(-x for x in cycle), -selector])
        core = list(range(first_selector, first_selector + len(triples)))
        for selector in list(core):
            rest = [other for other in core if other != selector]
            if selector in core and not solver.solve(assumptions=rest):
                core = sorted(solver.get_core() or [])
    return [triples[selector - first_selector] for selector in core]


def _places(immersion: Immersion, cells: list[int]) -> tuple[tuple[float, float], ...]:
    if immersion.arrangement.curve is None:
        return ()
    return tuple(immersion.arrangement.cell_point(cell) for cell in dict.fromkeys(cells))
