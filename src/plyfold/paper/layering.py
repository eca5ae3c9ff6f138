"""The paper's own way to a layering: orders along the edge-collapsed graphs of all cells (§3 and §4 of [MGR11]_).

Each cell gets a spanning tree of its edge-collapsed graph, a linear one if there is any, and the sheets are ordered
such that they rise or fall along it. The paper's lemma says that linear spanning subtrees in all cells are sufficient.
They are not: docs/paper-layers.md shows a curve with eight crossings that has them and does not lift. So an order found
is checked; where none is found the obstruction says that this procedure failed, not that there is no layering.

The paper leaves open what to do in the places below. The numbers come back in the comments.

1. *What are the nodes?* Sheets without own borders do not occur in the disk layout, so they are not in the graph.
2. *What are the edges?* They are only shown in a figure: consecutive own borders of the cell along the boundary of the
   disk are joined. Two borders of one sheet give no edge, and two edges between the same sheets count once.
3. *Which linear spanning subtree?* There can be several. The paper lists all of them exhaustively, so any will do, and
   each cell is free to choose.
4. *Up or down along it?* Layers must be "monotonic" in each cell and "consistent" over all of them, which is not
   defined. The reading taken: directions are free, and every gluing must keep the order.
5. *Where do sheets without own borders go?* The text does not say, but nothing is left to choose. Follow the part of
   the disk where one piece of cloth lies above another. Its edge cannot belong to one of them alone, for it would be
   the whole boundary of the disk, and part of that is next to the unbounded cell, where there is nothing else. So
   somewhere the edges of both cross; over the top cell there both have own borders, and the graph orders them.
6. *What is a 2-constrained spanning subtree?* The summary (§3.2) says that it, too, is sufficient; the word occurs
   nowhere else. If no node may have more than two neighbours it is a linear one, and nothing is gained. The reading
   taken, from the star of Figure 11: each node with several neighbours in the tree lies between *some* two of them, so
   that two of the star's three constraints hold. Then any spanning tree may be tried, where there is no linear one.
7. *How are trees and directions of all cells fitted together?* Trying all combinations takes exponential time. Here
   a SAT solver does it, together with the rule that no three sheets lie above each other in a circle; so an order is
   found whenever there is one along some spanning trees, and a failure is not for want of trying.

References
----------
.. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
   Sketch-Based Interfaces and Modeling, 2011.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

import numpy as np

from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.search import OrderProblem, order_problem, places_of_cells
from plyfold.obstruction import Obstruction
from plyfold.paper.collapsed import CollapsedGraph, edge_collapsed_graphs
from plyfold.sat import minimal_core, solve

__all__ = ["find_layering"]

Clause = list[int]
Option = tuple[int, tuple[int, ...]]
"""A variable, and the path round a gap that is taken if it is true."""


def find_layering(immersion: Immersion) -> Layering | Obstruction:
    """Look for an order of the sheets that follows a spanning tree of every edge-collapsed graph (§3 of [MGR11]_).

    Parameters
    ----------
    immersion : Immersion

    Returns
    -------
    Layering or Obstruction
        The layering has been checked. The obstruction has the reason ``"paper's procedure"`` and for its value a tuple
        of cells whose spanning trees cannot be followed together. It says only that the procedure failed:
        :func:`plyfold.find_layering` decides.

    Notes
    -----
    Linear spanning subtrees are used in every cell that has one, other spanning trees elsewhere, in the sense of
    :mod:`plyfold.paper.layering`. Cost: that of the exact search, and O(Σ n²) for cells with n own borders.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> sorted(find_layering(find_immersion(ramp)).level.tolist())
    [1, 1, 1, 1, 2]
    """
    problem = order_problem(immersion)
    if isinstance(problem, Obstruction):
        return _failed(immersion, [cell for cell, _, _ in problem.value])
    demands = _demands(problem)
    given = problem.clauses
    true = solve([*given, *(clause for clauses in demands.values() for clause in clauses)])
    if true is not None:
        return problem.layering(literal for literal in true if abs(literal) <= problem.n_variables)
    cells = list(demands)
    return _failed(immersion, [cells[i] for i in minimal_core(list(demands.values()), given)])


def _failed(immersion: Immersion, cells: Sequence[int]) -> Obstruction:
    among = tuple(sorted(set(cells)))
    listed = f"cells {', '.join(map(str, among))}" if among else "all cells"
    sentence = (
        f"The paper's procedure found no order of the sheets that follows spanning trees of the edge-collapsed graphs "
        f"of {listed} together; that does not mean that there is no layering."
    )
    return Obstruction("paper's procedure", sentence, places_of_cells(immersion, among), among, immersion)


def _demands(problem: OrderProblem) -> dict[int, list[Clause]]:
    """Return for each cell the clauses that its order follows a spanning tree, but for cells with nothing to ask."""
    fresh = count(problem.n_variables + 1)
    found = {
        graph.cell: list(_follow_a_tree(problem, graph, fresh))
        for graph in edge_collapsed_graphs(problem.immersion)
        if len(graph.nodes) > 2
    }
    return {cell: clauses for cell, clauses in found.items() if clauses}


def _follow_a_tree(problem: OrderProblem, graph: CollapsedGraph, fresh: Iterator[int]) -> Iterator[Clause]:
    """Yield clauses: a path round each gap is chosen (notes 3 and 6), and each node lies between two neighbours."""
    openings = graph.openings(linear=graph.has_linear_spanning_subtree)
    gaps = [[(next(fresh), path) for path in paths] for paths in openings]
    yield from ([chosen for chosen, _ in options] for options in gaps)
    for node in graph.nodes:
        around = [options for options in gaps if node.sheet in options[0][1]]
        for side in (1, -1):
            yield from _some_neighbour(problem, node.sheet, around, side, fresh)


def _some_neighbour(
    problem: OrderProblem, sheet: int, gaps: Sequence[Sequence[Option]], side: int, fresh: Iterator[int]
) -> Iterator[Clause]:
    """Yield clauses: a sheet has a neighbour in the tree above it (side 1) or below it (side −1), or is a leaf."""
    helpers = [next(fresh) for _ in gaps]
    yield helpers
    for helper, options in zip(helpers, gaps, strict=True):
        for chosen, path in options:
            place = path.index(sheet)
            neighbours = np.array(path[max(place - 1, 0) : place] + path[place + 1 : place + 2])
            if len(gaps) > 1 or len(neighbours) > 1:
                above = problem.above(np.full(len(neighbours), sheet), neighbours)
                yield [-helper, -chosen, *(side * above).tolist()]
