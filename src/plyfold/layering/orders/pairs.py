"""Pairs of sheets over a cell, and the classes that the gluings put them into.

Two sheets that are glued to two sheets of the next cell keep their order across the border. So ordered pairs of sheets
fall into classes: all pairs of a class are in order, or all are reversed. They are the components of a graph with a
node for every ordered pair and an edge for every border that carries one pair to another.

Few of these pairs need to be looked at. All sheets over the cell on the right of a border are glued to sheets over the
cell on its left, where one more lies. So every cell below others has its pairs in common with a *summit*, a cell with
no higher one beside it: each of its sheets has a *stand-in* over the summit at the end of a way up. Which way that is
matters only where there are several: at a crossing whose lowest cell it is, the ways over both borders lead to the same
sheets over the highest one. So of each *stretch* of borders that meet at such crossings the first border is enough. (A
stretch without a first border runs all round its cell, and is the only one: at the feet of bridges no stretch goes on.)
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plyfold.arrays import Bools, Ints, freeze
from plyfold.clock import NO_LIMIT, Clock
from plyfold.graphs import components, end_of_path, shortest_path
from plyfold.immersion.corners import sides
from plyfold.immersion.immersion import Immersion, require_immersion
from plyfold.memory import number_of_tuples, require_memory
from plyfold.ragged import count_each, starts_of

__all__ = ["PairGraph", "every_pair", "pair_graph", "shortest_chain_to_reverse"]

# Of sheets over a cell, and of those glued along a border, with what is needed to make them.
_BYTES_PER_PAIR = 100


@dataclass(frozen=True, eq=False)
class PairGraph:
    """Ordered pairs of sheets over the same cell, and the classes they fall into.

    Parameters
    ----------
    immersion : Immersion
    stand_in : (sheets,) int
        The sheet that stands for each sheet in pairs, itself for those in pairs.
    lower, upper : (p,) int
        The two sheets of each ordered pair; equal where the slot is unused.
    reverse : (p,) int
        Index of the pair with the sheets exchanged.
    label : (p,) int
        Class of each pair.
    first_pair : (cells,) int
        Index of the first pair over each cell. The pair of its i-th and j-th sheet is ``first_pair[c] + i * w + j``.
    """

    immersion: Immersion
    stand_in: Ints
    lower: Ints
    upper: Ints
    reverse: Ints
    label: Ints
    first_pair: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def contradictions(self) -> Ints:
        """Return the pairs that are in the same class as their reverse; no layering exists if there is one."""
        return np.flatnonzero((self.label == self.label[self.reverse]) & (self.lower != self.upper))

    def pair_of(self, lower: Ints, upper: Ints) -> Ints:
        """Return the indices of the pairs that stand for pairs of sheets, each two over one cell."""
        return np.asarray(self._row[lower] + self.stand_in[upper])

    @cached_property
    def _row(self) -> Ints:
        """What the number of the upper sheet is added to, for each lower sheet."""
        cell = self.immersion.sheet_cell[self.stand_in]
        first = self.immersion.first_sheet[cell]
        winding = self.immersion.arrangement.winding[cell]
        return np.asarray(self.first_pair[cell] + (self.stand_in - first) * winding - first)

    def cells(self) -> Ints:
        """Return the cells of which all pairs are here, and each by itself."""
        first_sheet, winding = self.immersion.first_sheet, self.immersion.arrangement.winding
        covered = np.flatnonzero(winding)
        return np.asarray(covered[self.stand_in[first_sheet[covered]] == first_sheet[covered]])


def pair_graph(immersion: Immersion, clock: Clock = NO_LIMIT) -> PairGraph:
    """Return the pairs over the summits of an immersion, and their classes.

    Cost: O(Σ w) over borders and O(Σ w²) over summits. Raises TimeoutError when the time is over.
    """
    arrangement = require_immersion(immersion).arrangement
    clock.check()
    begins = np.ones(arrangement.n_borders, dtype=bool)
    begins[arrangement.border_after[arrangement.ccw]] = False
    rising = np.full(arrangement.n_cells, -1)
    for borders in (np.arange(arrangement.n_borders), np.flatnonzero(begins)):
        rising[arrangement.right_cell[borders]] = borders
    begins[rising[rising >= 0]] = False
    pairs = _pairs(immersion, rising < 0, _stand_ins(immersion, rising))
    clock.check()
    edges = _carried(pairs, np.append(begins, np.ones(len(arrangement.bridges), dtype=bool)))
    clock.check()
    return replace(pairs, label=components(len(pairs.label), *edges.T))


def every_pair(immersion: Immersion, clock: Clock = NO_LIMIT) -> PairGraph:
    """Return all pairs, each in a class of its own. Cost: O(Σ w²). Raises TimeoutError when the time is over."""
    arrangement = require_immersion(immersion).arrangement
    clock.check()
    pairs = _pairs(immersion, np.ones(arrangement.n_cells, dtype=bool), np.arange(immersion.n_sheets))
    clock.check()
    return pairs


def shortest_chain_to_reverse(graph: PairGraph, clock: Clock) -> list[tuple[int, int, int]]:
    """Return a shortest chain of pairs, each glued to the next, from one of a contradictory class to its own reverse.

    Each is given by cell, lower and upper sheet. Cost: O(Σ w²) over cells and borders. Raises TimeoutError when the
    time is over.
    """
    pairs = every_pair(graph.immersion, clock)
    is_contradictory = np.zeros(len(graph.label), dtype=bool)
    is_contradictory[graph.contradictions()] = True
    start = int(is_contradictory[graph.pair_of(pairs.lower, pairs.upper)].argmax())
    arrangement = graph.immersion.arrangement
    edges = _carried(pairs, np.ones(arrangement.n_borders + len(arrangement.bridges), dtype=bool))
    clock.check()
    chain = shortest_path(len(pairs.label), edges, start, int(pairs.reverse[start]))
    cells = graph.immersion.sheet_cell[pairs.lower[chain]]
    return list(zip(cells.tolist(), pairs.lower[chain].tolist(), pairs.upper[chain].tolist(), strict=True))


def _stand_ins(immersion: Immersion, rising: Ints) -> Ints:
    """Return the sheet over a summit to which each sheet leads, on the way up over one border of each cell."""
    below = np.flatnonzero(rising[immersion.sheet_cell] >= 0)
    cell = immersion.sheet_cell[below]
    step = np.arange(immersion.n_sheets)
    step[below] = immersion.glued_to[immersion.first_pair[rising[cell]] + below - immersion.first_sheet[cell]]
    return end_of_path(step)


def _pairs(immersion: Immersion, has_pairs: Bools, stand_in: Ints) -> PairGraph:
    """Return the pairs over some cells, each in a class of its own."""
    winding = immersion.arrangement.winding
    _require_memory(immersion, number_of_tuples(winding[has_pairs], 2))
    count = np.where(has_pairs, winding**2, 0)
    first_pair = starts_of(count)
    total = int(count.sum())
    cell = np.repeat(np.arange(len(winding)), count)
    row, column = np.divmod(np.arange(total) - first_pair[cell], winding[cell])
    return PairGraph(
        immersion=immersion,
        stand_in=stand_in,
        lower=immersion.first_sheet[cell] + row,
        upper=immersion.first_sheet[cell] + column,
        reverse=np.asarray(first_pair[cell] + column * winding[cell] + row),
        label=np.arange(total),
        first_pair=first_pair,
    )


def _require_memory(immersion: Immersion, pairs: int) -> None:
    require_memory(
        _BYTES_PER_PAIR * pairs,
        f"a graph of {pairs:,} pairs of sheets",
        immersion.arrangement,
        "embed_cased(curve, over) orders sheets without pairs, where over and under are known",
    )


def _carried(pairs: PairGraph, seams: Bools) -> Ints:
    """Return the edges (pair on the right of a border, pair on its left), for some borders and bridges."""
    immersion, seam = pairs.immersion, np.flatnonzero(seams)
    counts = np.diff(immersion.first_pair)[seam]
    _require_memory(immersion, number_of_tuples(counts, 2))
    each, own = counts.repeat(counts), count_each(counts)
    right = immersion.first_sheet[sides(immersion.arrangement)[1][seam]].repeat(counts) + own
    left = immersion.glued_to[immersion.first_pair[seam].repeat(counts) + own]
    first = np.repeat(np.arange(len(each)), each)
    second = (np.arange(len(each)) - own)[first] + count_each(each)
    differ = first != second
    first, second = first[differ], second[differ]
    return np.stack([pairs.pair_of(side[first], side[second]) for side in (right, left)], axis=1)
