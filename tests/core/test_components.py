"""Components of graphs, numbered in the order of their first nodes."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from plyfold.graphs import components


def components_by_merging(n, edges):
    """Return the number of each node's component, by joining sets until no edge leads from one to another."""
    member_of = {node: {node} for node in range(n)}
    for start, end in edges:
        joined = member_of[start] | member_of[end]
        member_of.update(dict.fromkeys(joined, joined))
    lowest = [min(member_of[node]) for node in range(n)]
    return [sorted(set(lowest)).index(low) for low in lowest]


@given(st.integers(1, 12).flatmap(lambda n: st.tuples(st.just(n), edges_between(n))))
def test_components_are_those_found_by_merging_sets(graph):
    n, edges = graph
    start, end = np.array(edges, dtype=np.int64).reshape(-1, 2).T
    assert components(n, start, end).tolist() == components_by_merging(n, edges)


def edges_between(n):
    """Up to 20 edges, loops and double ones too."""
    node = st.integers(0, n - 1)
    return st.lists(st.tuples(node, node), max_size=20)
