"""Edge-collapsed graphs: how the sheets over one cell follow each other along the boundary of the disk (§3.1).

The nodes are the sheets that have borders of their own. Walk once round the boundary of the disk and look only at the
own borders of this cell: where one is followed by one of another sheet, the two sheets are joined by an edge. So the
graph is a circle with points on it identified, and as the sheets are disjoint in the disk, it is a *cactus*: what is
left of the disk without them falls into gaps, the sheets round each gap form a ring of edges, or one edge if there are
two, and any two gaps share at most one sheet.

Therefore nothing has to be searched for. A spanning tree leaves out one edge of every ring. In a *linear* one, a path,
every sheet has at most two neighbours, and each gap that it is next to gives it one or two, one only if the edge left
out ends there: so no sheet may be next to three gaps, and a sheet next to two is an end of the edges left out in both.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from typing import TypeAlias

from plyfold.errors import InputError
from plyfold.immersion.immersion import Group, Immersion

__all__ = [
    "CollapsedGraph",
    "Edge",
    "edge_collapsed_graph",
    "edge_collapsed_graphs",
    "has_linear_spanning_subtrees",
    "linear_spanning_subtrees",
    "spanning_trees",
]

Edge: TypeAlias = tuple[int, int]


@dataclass(frozen=True)
class CollapsedGraph:
    """The edge-collapsed graph of one cell.

    Parameters
    ----------
    cell : int
    nodes : tuple of Group
        The sheets over the cell that have own borders, in order of their first borders.
    gaps : tuple of tuple of int
        The sheets round each gap between them, at least two, in order: each is joined to the next, and the last to the
        first.

    Examples
    --------
    >>> star = CollapsedGraph(1, (), gaps=((0, 1), (0, 2), (0, 3)))
    >>> star.edges, star.has_linear_spanning_subtree
    (((0, 1), (0, 2), (0, 3)), False)
    """

    cell: int
    nodes: tuple[Group, ...]
    gaps: tuple[tuple[int, ...], ...]

    @property
    def edges(self) -> tuple[Edge, ...]:
        """The edges, each once, as pairs of sheets, the smaller number first."""
        return tuple(sorted({edge for gap in self.gaps for edge in path_edges([*gap, gap[0]])}))

    @cached_property
    def gaps_at(self) -> Counter[int]:
        """How many gaps each sheet is next to."""
        return Counter(sheet for gap in self.gaps for sheet in gap)

    @property
    def has_linear_spanning_subtree(self) -> bool:
        """Whether some path along the edges passes through every node once."""
        return all(self.openings(linear=True)) and max(self.gaps_at.values(), default=0) <= 2

    def openings(self, linear: bool = False) -> tuple[tuple[tuple[int, ...], ...], ...]:
        """Return for each gap the paths round it that are left when one edge is left out.

        Parameters
        ----------
        linear : bool, optional
            Only those that a linear spanning subtree may use.

        Returns
        -------
        tuple of tuple of tuple of int
            For each gap its paths, each as the sheets along it.

        Notes
        -----
        Any choice of one path for each gap makes a spanning tree. If no sheet is next to three gaps, any choice of
        linear ones makes a linear spanning subtree, and there are no others.
        """
        return tuple(
            tuple(path for path in _opened(gap) if not (linear and self._joins_inside(path))) for gap in self.gaps
        )

    def _joins_inside(self, path: tuple[int, ...]) -> bool:
        return any(self.gaps_at[sheet] > 1 for sheet in path[1:-1])


def edge_collapsed_graph(immersion: Immersion, cell: int) -> CollapsedGraph:
    """Return the edge-collapsed graph of a cell (§3.1 of [MGR11]_).

    Parameters
    ----------
    immersion : Immersion
    cell : int

    Returns
    -------
    CollapsedGraph
        Without nodes if the cell has no borders on its left, or no sheets.

    Raises
    ------
    InputError
        If there is no such cell.

    Notes
    -----
    O(k). For all cells together use :func:`edge_collapsed_graphs`.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> graph = edge_collapsed_graph(ramp, cell=1)
    >>> [(node.sheet, node.borders) for node in graph.nodes], graph.edges
    ([(0, (0, 6)), (1, (2, 4))], ((0, 1),))
    """
    n_cells = immersion.arrangement.n_cells
    if not 0 <= cell < n_cells:
        raise InputError(f"there is no cell {cell}: cells are numbered 0 to {n_cells - 1}")
    return _graph(cell, [group for group in immersion.disk_layout() if group.cell == cell])


def edge_collapsed_graphs(immersion: Immersion) -> tuple[CollapsedGraph, ...]:
    """Return the edge-collapsed graph of every cell, by cells. Cost: O(k log k).

    Parameters
    ----------
    immersion : Immersion

    Returns
    -------
    tuple of CollapsedGraph

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> [len(graph.nodes) for graph in edge_collapsed_graphs(find_immersion([(0, 0), (1, 0), (0, 1)]))]
    [0, 1]
    """
    nodes: list[list[Group]] = [[] for _ in range(immersion.arrangement.n_cells)]
    for group in immersion.disk_layout():
        nodes[group.cell].append(group)
    return tuple(_graph(cell, groups) for cell, groups in enumerate(nodes))


def spanning_trees(graph: CollapsedGraph) -> Iterator[tuple[Edge, ...]]:
    """Yield every spanning tree once, as its edges in order; there can be exponentially many.

    Examples
    --------
    >>> list(spanning_trees(CollapsedGraph(1, (), gaps=((0, 1, 2),))))
    [((0, 1), (1, 2)), ((0, 2), (1, 2)), ((0, 1), (0, 2))]
    """
    return _trees(graph.openings())


def linear_spanning_subtrees(graph: CollapsedGraph) -> tuple[tuple[Edge, ...], ...]:
    """Return every linear spanning subtree, that is, Hamiltonian path, as its edges in order.

    Returns
    -------
    tuple of tuple of (int, int)
        At most max(4, nodes) of them. A graph with one node or none has one without edges. Cost: linear in the output.

    Examples
    --------
    >>> linear_spanning_subtrees(CollapsedGraph(1, (), gaps=((0, 1, 2), (0, 3))))
    (((0, 1), (0, 3), (1, 2)), ((0, 2), (0, 3), (1, 2)))
    """
    return tuple(_trees(graph.openings(linear=True))) if graph.has_linear_spanning_subtree else ()


def has_linear_spanning_subtrees(immersion: Immersion) -> dict[int, bool]:
    """Tell for every bounded cell whether its edge-collapsed graph has a linear spanning subtree.

    The paper's lemma says that an immersion lifts if all have (§3.1). That is not so: docs/paper-layers.md has a
    counterexample. Nor is it necessary. Cost: O(k log k).

    Parameters
    ----------
    immersion : Immersion

    Returns
    -------
    dict of int to bool
        By cells.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ramp = find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> has_linear_spanning_subtrees(ramp)
    {1: True, 2: True, 3: True, 4: True, 5: True}
    """
    return {graph.cell: graph.has_linear_spanning_subtree for graph in edge_collapsed_graphs(immersion)[1:]}


def path_edges(path: Iterable[int]) -> list[Edge]:
    """Return the edges along a path of sheets, the smaller number first in each."""
    return [(min(pair), max(pair)) for pair in pairwise(path)]


def _trees(openings: Sequence[Sequence[tuple[int, ...]]]) -> Iterator[tuple[Edge, ...]]:
    """Yield the trees that take one path for each gap."""
    return (tuple(sorted(edge for path in paths for edge in path_edges(path))) for paths in product(*openings))


def _opened(gap: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
    """Return the paths round a gap; if only two sheets are next to it, they have one edge, whichever way round."""
    return (gap,) if len(gap) == 2 else tuple(gap[i:] + gap[:i] for i in range(len(gap)))


def _graph(cell: int, nodes: Sequence[Group]) -> CollapsedGraph:
    sheet_of = dict(sorted((border, node.sheet) for node in nodes for border in node.borders))
    after = {b: a for node in nodes for b, a in zip(node.borders, node.borders[1:] + node.borders[:1], strict=True)}
    return CollapsedGraph(cell, tuple(nodes), tuple(_gaps(sheet_of, after)))


def _gaps(sheet_of: dict[int, int], after: dict[int, int]) -> Iterator[tuple[int, ...]]:
    """Yield the sheets round every gap next to at least two, given the sheet of each own border of a cell in order.

    Going round a gap one comes from a border back to the one before it, and along that one's sheet to the sheet's next
    border.
    """
    borders = list(sheet_of)
    before = dict(zip(borders, borders[-1:] + borders[:-1], strict=True))
    waiting = dict.fromkeys(borders)
    while waiting:
        start = next(iter(waiting))
        ring = []
        while start in waiting:
            del waiting[start]
            ring.append(sheet_of[before[start]])
            start = after[before[start]]
        if len(ring) > 1:
            yield tuple(ring)
