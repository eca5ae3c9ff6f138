"""The paper's lemma and its way to a layering, compared with the exact answers of the reference.

The figures are those of docs/paper-layers.md.
"""

from collections import Counter
from itertools import combinations, pairwise, permutations

import numpy as np
import pytest

import plyfold as pf
from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.immersion.solve import find_immersion, immersions
from plyfold.layering.orders.search import find_layering
from plyfold.paper import layering as paper
from plyfold.paper.collapsed import edge_collapsed_graph, has_linear_spanning_subtrees
from reference import layerings, random_curves
from reference.planar_maps import (
    GaussCode,
    cells,
    census,
    gauss_code,
    may_bound_disk,
    oriented,
    rotations,
    spherical_codes,
    symmetric_copies,
)

COUNTEREXAMPLE = (
    [9, 4, 3, 2, 1, 10, 7, 6, 11, 0, 5, 8, 13, 12, 15, 14],
    [1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0],
    5,
)
"""Linear spanning subtrees in all cells of both immersions; one of them does not lift."""

LIFTS_ANOTHER_WAY = (
    [5, 8, 3, 2, 7, 0, 9, 4, 1, 6, 13, 12, 11, 10, 15, 14],
    [1, 1, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0],
    5,
)
"""Linear spanning subtrees in all cells, and it lifts, but in no layering do all cells follow one."""

LIFTS_WITHOUT = (
    [
        *(33, 8, 17, 28, 15, 26, 35, 34, 1, 12, 19, 18, 9, 20, 29, 4, 27, 2),
        *(11, 10, 13, 24, 31, 30, 21, 32, 5, 16, 3, 14, 23, 22, 25, 0, 7, 6),
    ],
    [0, 1, 1, 1, 0, 0, 1, 0, 0, 1, 1, 0] * 3,
    55,
)
"""A symmetric curve with 18 crossings that lifts, though one cell has no linear spanning subtree."""


def code_of(arranged):
    return gauss_code(arranged.partner, arranged.ccw, arranged.outer)


def all_layerings(immersion):
    """Every layering by brute force."""
    rows = [tuple(row) for row in immersion.gluing.tolist()]
    return layerings.layerings(*code_of(immersion.arrangement), immersion.own_sheet.tolist(), rows)


def nodes_and_edges(immersion, cell):
    """The edge-collapsed graph from its definition."""
    borders = np.flatnonzero(immersion.arrangement.left_cell == cell)
    sheets = immersion.own_sheet[borders].tolist()
    around = zip(sheets, sheets[1:] + sheets[:1], strict=True)
    return sorted(set(sheets)), {frozenset(pair) for pair in around if len(set(pair)) == 2}


def linear(nodes, edges):
    return any(edges.issuperset(map(frozenset, pairwise(order))) for order in permutations(nodes))


def follows_a_tree(nodes, edges, level):
    """Whether the levels follow a linear spanning subtree, or if there is none, a 2-constrained one."""
    if linear(nodes, edges):
        return edges.issuperset(map(frozenset, pairwise(sorted(nodes, key=level.get))))
    trees = combinations(sorted(edges, key=sorted), len(nodes) - 1)
    return any(spans(nodes, tree) and all(lies_between(node, tree, level) for node in nodes) for tree in trees)


def spans(nodes, tree):
    reached = set(nodes[:1])
    for _ in nodes:
        reached |= {sheet for edge in tree if edge & reached for sheet in edge}
    return reached == set(nodes)


def lies_between(node, tree, level):
    around = [level[sheet] for edge in tree if node in edge for sheet in edge - {node}]
    return len(around) < 2 or min(around) < level[node] < max(around)


def assert_right(immersion):
    """The verdict by definition: some layering follows spanning trees in all cells; and if so one is found."""
    graphs = [nodes_and_edges(immersion, cell) for cell in range(1, immersion.arrangement.n_cells)]
    assert list(has_linear_spanning_subtrees(immersion).values()) == [linear(*graph) for graph in graphs]
    every = all_layerings(immersion)
    along_trees = [level for level in every if all(follows_a_tree(*graph, level) for graph in graphs)]
    found = paper.find_layering(immersion)
    assert bool(found) == bool(along_trees)
    if found:
        assert dict(enumerate(found.level.tolist())) in along_trees
    else:
        assert found.reason == "paper's procedure"
        assert "does not mean that there is no layering" in found.sentence
    return all(linear(*graph) for graph in graphs), bool(every), bool(found)


def tally(codes):
    """Count immersions by (linear spanning subtrees in all cells, lifts, the paper's way finds it)."""
    found = (immersion for code in codes for immersion in immersions(Arrangement.from_gauss(*code)))
    return Counter(map(assert_right, found))


def few_crossings(k):
    return [code for code in census(k) if may_bound_disk(code)]


def eight_crossings():
    """The curves with eight crossings that pass the cheap conditions: on the sphere first, to save memory."""
    seen = set()
    for partner, ccw in spherical_codes(8):
        if (partner, ccw) not in seen:
            code = GaussCode(partner, ccw, 0)
            seen |= {(copy.partner, copy.ccw) for copy in symmetric_copies(code)}
            variants = set()
            for darts in cells(partner, ccw):
                variant = GaussCode(partner, ccw, min(darts))
                if variant not in variants:
                    variants |= symmetric_copies(variant)
                    if may_bound_disk(oriented(variant)):
                        yield oriented(variant)


class TestEveryCurve:
    @pytest.mark.parametrize(("k", "count"), [(0, 1), (2, 1), (4, 7)])
    def test_up_to_four_crossings(self, k, count):
        assert tally(few_crossings(k)) == {(True, True, True): count}

    def test_six_crossings(self):
        assert tally(few_crossings(6)) == {(True, True, True): 88}

    @pytest.mark.slow
    def test_eight_crossings(self):
        assert tally(eight_crossings()) == {
            (True, True, True): 1719,
            (True, True, False): 2,
            (True, False, False): 4,
        }


class TestTheLemma:
    def test_is_not_sufficient(self):
        verdicts = [assert_right(immersion) for immersion in immersions(Arrangement.from_gauss(*COUNTEREXAMPLE))]
        assert sorted(verdicts) == [(True, False, False), (True, True, True)]

    def test_is_not_necessary(self):
        (immersion,) = immersions(Arrangement.from_gauss(*LIFTS_WITHOUT))
        assert assert_right(immersion) == (False, True, True)
        assert list(has_linear_spanning_subtrees(immersion).values()).count(False) == 1

    def test_from_every_start(self):
        for code in rotations(gauss_code(*COUNTEREXAMPLE)):
            assert tally([code]) == {(True, False, False): 1, (True, True, True): 1}

    def test_obstruction_names_cells_of_the_chain(self):
        refused = [i for i in immersions(Arrangement.from_gauss(*COUNTEREXAMPLE)) if not paper.find_layering(i)]
        assert len(refused) == 1
        chain = find_layering(refused[0]).value
        assert paper.find_layering(refused[0]).value == tuple(sorted({cell for cell, _, _ in chain}))

    def test_a_disk_that_lifts_but_not_along_linear_spanning_subtrees(self):
        """The cells that the obstruction names cannot follow theirs together; any fewer of them can."""
        (immersion,) = immersions(Arrangement.from_gauss(*LIFTS_ANOTHER_WAY))
        assert assert_right(immersion) == (True, True, False)
        named = paper.find_layering(immersion).value
        for left_out in (None, *named):
            graphs = [nodes_and_edges(immersion, cell) for cell in named if cell != left_out]
            fits = any(all(follows_a_tree(*graph, level) for graph in graphs) for level in all_layerings(immersion))
            assert fits == (left_out is not None)


class TestSeveralImmersions:
    @pytest.mark.parametrize(
        ("polygon", "expected"),
        [
            (random_curves.MILNOR_LIKE, {(True, True, True): 2}),
            (random_curves.TEN_GON, {(True, True, True): 2}),
            (random_curves.BENNEQUIN_LIKE, {(True, True, True): 3, (False, False, False): 2}),
        ],
    )
    def test_known_polygons(self, polygon, expected):
        assert Counter(assert_right(i) for i in immersions(arrange(polygon))) == expected

    def test_the_star_is_where_the_bennequin_like_curve_fails(self):
        for immersion in immersions(arrange(random_curves.BENNEQUIN_LIKE)):
            refused = [cell for cell, has in has_linear_spanning_subtrees(immersion).items() if not has]
            assert len(refused) == (0 if find_layering(immersion) else 1)
            assert all(len(edge_collapsed_graph(immersion, cell).nodes) == 4 for cell in refused)

    def test_obstruction_has_places_in_the_drawing(self):
        refused = [i for i in immersions(arrange(random_curves.BENNEQUIN_LIKE)) if not paper.find_layering(i)]
        assert all(len(paper.find_layering(i).where) == len(paper.find_layering(i).value) > 0 for i in refused)


@pytest.mark.parametrize("outline", [random_curves.ribbon_outline, random_curves.glued_disk])
def test_random_disks(outline):
    """Whatever is found is a layering by the reference's check."""
    rng = np.random.default_rng(8)
    verdicts = Counter()
    for size in range(8, 80, 4):
        immersion = find_immersion(arrange(outline(rng, size)))
        found = paper.find_layering(immersion)
        verdicts[bool(found)] += 1
        if found:
            own, rows = immersion.own_sheet.tolist(), [tuple(row) for row in immersion.gluing.tolist()]
            level = dict(enumerate(found.level.tolist()))
            assert layerings.is_layering(code_of(immersion.arrangement), own, rows, level)
    assert verdicts[True] > 9


def test_the_papers_way_has_its_own_door():
    immersion = pf.find_immersion(pf.gallery.CURVES["exit-ramp"].curve)
    assert paper.find_layering(immersion).level.tolist() == pf.find_layering(immersion).level.tolist()
    with pytest.raises(TypeError, match="method"):
        pf.find_layering(immersion, method="paper")
