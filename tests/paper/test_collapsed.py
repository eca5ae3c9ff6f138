"""Edge-collapsed graphs against their definition, and linear spanning subtrees against all orders of the nodes."""

from itertools import combinations, pairwise, permutations

import numpy as np
import pytest

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.errors import InputError
from plyfold.immersion.solve import find_immersion, immersions
from plyfold.paper.collapsed import (
    CollapsedGraph,
    edge_collapsed_graph,
    edge_collapsed_graphs,
    has_linear_spanning_subtrees,
    linear_spanning_subtrees,
    spanning_trees,
)
from reference import random_curves
from reference.planar_maps import census, may_bound_disk

STAR = CollapsedGraph(1, (), gaps=((0, 1), (0, 2), (0, 3)))


def edges_by_definition(immersion, cell):
    """Own borders of the cell in order along the curve; each and the next one, if on different sheets."""
    borders = np.flatnonzero(immersion.arrangement.left_cell == cell)
    sheets = immersion.own_sheet[borders].tolist()
    around = zip(sheets, sheets[1:] + sheets[:1], strict=True)
    return {frozenset(pair) for pair in around if len(set(pair)) == 2}


def paths_by_trying_all_orders(nodes, edges):
    """Every Hamiltonian path, as the set of its edges."""
    walks = ([frozenset(pair) for pair in pairwise(order)] for order in permutations(nodes))
    return {frozenset(walk) for walk in walks if edges.issuperset(walk)}


def trees_by_trying_all_sets(nodes, edges):
    chosen = combinations(sorted(edges, key=sorted), max(len(nodes) - 1, 0))
    return {frozenset(tree) for tree in chosen if is_connected(nodes, tree)}


def is_connected(nodes, edges):
    reached = set(list(nodes)[:1])
    for _ in nodes:
        reached |= {sheet for edge in edges if edge & reached for sheet in edge}
    return reached == set(nodes)


def as_sets(trees):
    return [frozenset(map(frozenset, tree)) for tree in trees]


def assert_right(immersion):
    graphs = edge_collapsed_graphs(immersion)
    for cell, graph in enumerate(graphs):
        assert graph == edge_collapsed_graph(immersion, cell)
        nodes = {node.sheet for node in graph.nodes}
        assert nodes == set(immersion.own_sheet[immersion.arrangement.left_cell == cell].tolist())
        edges = edges_by_definition(immersion, cell)
        assert set(map(frozenset, graph.edges)) == edges
        if len(nodes) <= 6:
            assert_same_sets(linear_spanning_subtrees(graph), paths_by_trying_all_orders(nodes, edges))
            assert_same_sets(spanning_trees(graph), trees_by_trying_all_sets(nodes, edges))
        assert graph.has_linear_spanning_subtree == bool(linear_spanning_subtrees(graph))
    expected = {graph.cell: graph.has_linear_spanning_subtree for graph in graphs if graph.cell}
    assert has_linear_spanning_subtrees(immersion) == expected
    return graphs


def assert_same_sets(trees, expected):
    found = as_sets(trees)
    assert len(found) == len(set(found)), "each once"
    assert set(found) == expected


@pytest.mark.parametrize("k", [0, 2, 4, pytest.param(6, marks=pytest.mark.slow)])
def test_every_immersion(k):
    for code in census(k):
        for immersion in immersions(Arrangement.from_gauss(*code)) if may_bound_disk(code) else ():
            assert_right(immersion)


@pytest.mark.parametrize("outline", [random_curves.ribbon_outline, random_curves.glued_disk])
def test_random_disks(outline):
    """Dense disks have cells with many nodes, rings of more than two, and sheets between gaps."""
    rng = np.random.default_rng(4)
    graphs = [g for n in range(10, 100, 6) for g in assert_right(find_immersion(arrange(outline(rng, n))))]
    assert any(len(graph.nodes) > 2 for graph in graphs)
    if outline is random_curves.glued_disk:
        assert any(len(gap) > 2 for graph in graphs for gap in graph.gaps)


def test_the_cell_in_the_middle_of_the_bennequin_like_curve():
    """Two of its five immersions have the star of the paper's figure 11, right; they are those that do not lift."""
    for immersion in immersions(arrange(random_curves.BENNEQUIN_LIKE)):
        deepest = int(immersion.arrangement.winding.argmax())
        graph = edge_collapsed_graph(immersion, deepest)
        ends = sorted(sum(sheet in edge for edge in graph.edges) for sheet in {s for e in graph.edges for s in e})
        assert (ends == [1, 1, 1, 3]) == (not has_linear_spanning_subtrees(immersion)[deepest])


def test_star_has_no_linear_spanning_subtree():
    assert linear_spanning_subtrees(STAR) == ()
    assert list(spanning_trees(STAR)) == [STAR.edges]


def test_three_rings_on_one_triangle():
    """A triangle with a leaf at each corner: every corner would have to be an end of the edge left out."""
    graph = CollapsedGraph(1, (), gaps=((0, 1, 2), (0, 3), (1, 4), (2, 5)))
    assert max(graph.gaps_at.values()) == 2
    assert not graph.has_linear_spanning_subtree
    assert paths_by_trying_all_orders(range(6), set(map(frozenset, graph.edges))) == set()
    assert len(list(spanning_trees(graph))) == 3


@pytest.mark.parametrize("cell", [-1, 3])
def test_no_such_cell(cell):
    with pytest.raises(InputError, match="0 to 1"):
        edge_collapsed_graph(find_immersion([(0, 0), (1, 0), (0, 1)]), cell)
