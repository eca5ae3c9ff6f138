"""Pairs of sheets over one cell, and which pairs are bound to have the same order.

Two sheets that are glued to two sheets of the next cell keep their order across the border. So ordered pairs of sheets
fall into classes: all pairs of a class are in order, or all are reversed. The *graph of pairs* has a node for every
ordered pair and an edge for every border that carries one pair to another; its components are the classes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Ints
from plyfold.clock import NO_LIMIT, Clock
from plyfold.immersion.immersion import Immersion, require_immersion
from plyfold.memory import number_of_tuples, require_memory

__all__ = ["PairGraph", "chain_to_reverse", "pair_graph", "pair_of"]


# Of sheets over a cell, and of those glued along a border, with what is needed to make them.
_BYTES_PER_PAIR = 100


@dataclass(frozen=True, eq=False)
class PairGraph:
    """The ordered pairs of sheets over the same cell, and the classes they fall into.

    Parameters
    ----------
    lower, upper : (p,) int
        The two sheets of each ordered pair; equal where the slot is unused.
    reverse : (p,) int
        Index of the pair with the sheets exchanged.
    edges : (e, 2) int
        Pairs carried into each other across some border.
    label : (p,) int
        Class of each pair.
    first_pair : (cells,) int
        Index of the first pair over each cell. The pair of its i-th and j-th sheet is ``first_pair[c] + i * w + j``.
    """

    lower: Ints
    upper: Ints
    reverse: Ints
    edges: Ints
    label: Ints
    first_pair: Ints

    def contradictions(self) -> Ints:
        """Return the pairs that are in the same class as their reverse; no layering exists if there is one."""
        return np.flatnonzero((self.label == self.label[self.reverse]) & (self.lower != self.upper))


def pair_graph(immersion: Immersion, clock: Clock = NO_LIMIT) -> PairGraph:
    """Return the graph of pairs of an immersion. Cost: O(Σ w²) over cells and borders.

    Raises TimeoutError when the time is over.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    winding = require_immersion(immersion).arrangement.winding
    clock.check()
    _require_memory(immersion)
    first_pair = np.concatenate([[0], np.cumsum(winding**2)])
    total = int(first_pair[-1])
    cell = np.repeat(np.arange(len(winding)), winding**2)
    row, column = np.divmod(np.arange(total) - first_pair[cell], winding[cell])
    clock.check()
    edges = _carried(immersion, first_pair)
    clock.check()
    graph = coo_array((np.ones(len(edges), dtype=bool), edges.T), shape=(total, total))
    return PairGraph(
        lower=immersion.first_sheet[cell] + row,
        upper=immersion.first_sheet[cell] + column,
        reverse=first_pair[cell] + column * winding[cell] + row,
        edges=edges,
        label=connected_components(graph, directed=False)[1].astype(np.int64),
        first_pair=first_pair[:-1],
    )


def _require_memory(immersion: Immersion) -> None:
    arrangement = immersion.arrangement
    pairs = number_of_tuples(arrangement.winding, 2)
    carried = number_of_tuples(arrangement.winding[arrangement.right_cell], 2)
    require_memory(
        _BYTES_PER_PAIR * (pairs + carried),
        f"a graph of {pairs:,} pairs of sheets",
        arrangement,
        "embed_cased(curve, over) orders sheets without pairs, where over and under are known",
    )


def _carried(immersion: Immersion, first_pair: Ints) -> Ints:
    """Return the edges (pair on the right of a border, pair on its left)."""
    border, right, left = immersion.gluing.T
    counts = np.bincount(border, minlength=immersion.arrangement.n_borders)
    start = np.cumsum(counts) - counts
    first = np.repeat(np.arange(len(border)), counts[border])
    second = np.arange(len(first)) - np.repeat(np.cumsum(counts[border]) - counts[border], counts[border])
    second += start[border[first]]
    differ = first != second
    return np.stack(
        [pair_of(immersion, first_pair, side[first], side[second])[differ] for side in (right, left)], axis=1
    )


def pair_of(immersion: Immersion, first_pair: Ints, lower: Ints, upper: Ints) -> Ints:
    """Return the indices of pairs of sheets, each two over one cell."""
    cell = immersion.sheet_cell[lower]
    first = immersion.first_sheet[cell]
    return np.asarray(first_pair[cell] + (lower - first) * immersion.arrangement.winding[cell] + upper - first)


def chain_to_reverse(graph: PairGraph, pair: int) -> list[int]:
    """Return a shortest chain of pairs, each glued to the next, from a pair to its own reverse."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order

    total = len(graph.label)
    matrix = coo_array((np.ones(len(graph.edges), dtype=bool), graph.edges.T), shape=(total, total)).tocsr()
    _, before = breadth_first_order(matrix, pair, directed=False)
    chain = [int(graph.reverse[pair])]
    while chain[-1] != pair:
        chain.append(int(before[chain[-1]]))
    return chain[::-1]
