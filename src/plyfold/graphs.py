"""Graphs given by arrays of their edges: components, trees, paths, and sets that are joined."""

from __future__ import annotations

from collections.abc import MutableSequence

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import all_flat
from plyfold.core.cells import number_components

__all__ = ["components", "end_of_path", "members_of", "representative", "shortest_path", "spanning_tree", "ways_from"]


def components(n: int, start: Ints, end: Ints) -> Ints:
    """Return the connected component of each of n nodes, given edges; numbered in the order of their first nodes.

    Examples
    --------
    >>> components(4, np.array([3]), np.array([1])).tolist()
    [0, 1, 2, 1]
    """
    if not len(start):
        return np.arange(n)
    joined, number = np.empty((2, n), dtype=np.int64)
    number_components(*all_flat(start, end, joined, number))
    return number


def members_of(group: Ints) -> dict[int, list[int]]:
    """Return the members of each group, given the group of each; groups in the order of their first members.

    Examples
    --------
    >>> members_of(np.array([2, 0, 2]))
    {2: [0, 2], 0: [1]}
    """
    members: dict[int, list[int]] = {}
    for member, of in enumerate(group.tolist()):
        members.setdefault(of, []).append(member)
    return members


def spanning_tree(n: int, start: Ints, end: Ints) -> tuple[Ints, Ints, Ints]:
    """Grow a tree from node 0 along the edges of a connected graph, breadth first.

    Returns
    -------
    parent : (n,) int
        Meaningless for node 0.
    edge : (n,) int
        The edge to the parent, the last one if there are several.
    order : (n,) int
        All nodes, parents before children.

    Examples
    --------
    >>> [values.tolist() for values in spanning_tree(3, np.array([0, 2]), np.array([2, 1]))]
    [[-9999, 2, 0], [0, 1, 0], [0, 2, 1]]
    """
    from scipy.sparse import coo_array, csgraph

    graph = coo_array((np.ones(len(start), dtype=np.int8), (start, end)), shape=(n, n))
    order, parent = csgraph.breadth_first_order(graph.tocsr(), 0, directed=False)
    edge, edges = np.zeros(n, dtype=np.int64), np.arange(len(start))
    for child, above in ((start, end), (end, start)):
        in_tree = parent[child] == above
        edge[child[in_tree]] = edges[in_tree]
    return parent.astype(np.int64), edge, order.astype(np.int64)


def shortest_path(n: int, edges: Ints, start: int, end: int) -> list[int]:
    """Return the nodes on a path with fewest edges between two nodes that are connected.

    Examples
    --------
    >>> shortest_path(4, np.array([(0, 1), (1, 2), (2, 3), (1, 3)]), 0, 3)
    [0, 1, 3]
    """
    from scipy.sparse import coo_array, csgraph

    graph = coo_array((np.ones(len(edges), dtype=bool), edges.T), shape=(n, n)).tocsr()
    _, before = csgraph.breadth_first_order(graph, start, directed=False)
    path = [end]
    while path[-1] != start:
        path.append(int(before[path[-1]]))
    return path[::-1]


def ways_from(sources: Ints, n: int, edges: Ints, length: Floats, limit: float) -> Floats:
    """Return how far each of n nodes is from the nearest source, along edges of given lengths; infinite beyond a limit.

    Examples
    --------
    >>> ways_from(np.array([1]), 4, np.array([(0, 1), (1, 2), (2, 3), (1, 2)]), np.array([2.0, 3.0, 4.0, 5.0]), 6.0)
    array([ 2.,  0.,  3., inf])
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    start, end = edges.min(axis=1), edges.max(axis=1)
    # Of several edges between two nodes the shortest counts; a matrix would add them up.
    order = np.lexsort((length, end, start))
    first = order[np.append(True, (np.diff(start[order]) != 0) | (np.diff(end[order]) != 0))[: len(order)]]
    ways = coo_array((length[first], (start[first], end[first])), shape=(n, n)).tocsr()
    return np.asarray(dijkstra(ways, directed=False, indices=sources, min_only=True, limit=limit))


def end_of_path(step: Ints) -> Ints:
    """Return where each node comes to, step by step, until a step leads nowhere else; no steps lead round in a circle.

    Examples
    --------
    >>> end_of_path(np.array([2, 1, 3, 3])).tolist()
    [3, 1, 3, 3]
    """
    further = step[step]
    while (further != step).any():
        step, further = further, further[further]
    return step


def representative(joined: MutableSequence[int] | Ints, member: int) -> int:
    """Return the member that stands for all that were joined to a member; the way there is halved for the next time.

    ``joined`` leads from each member to another one of its set, or to itself. To join two sets, lead one's
    representative to the other's.
    """
    while joined[member] != member:
        joined[member] = member = joined[joined[member]]
    return member
