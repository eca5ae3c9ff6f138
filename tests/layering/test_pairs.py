"""Classes of pairs of sheets over summits: against those of all pairs, carried over every border and bridge."""

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.arrangement.arrangement import Arrangement
from plyfold.graphs import components
from plyfold.layering.orders.pairs import every_pair, pair_graph
from plyfold.layering.orders.search import find_layering
from reference.planar_maps import census, may_bound_disk
from reference.random_curves import glued_disk

RINGS = {
    "a hole": [[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]],
    "a hole under a flap": [
        [(0, 0), (9, 0), (9, 9), (0, 9)],
        [(1, 1), (1, 8), (8, 8), (8, 1)],
        [(-1, 4), (3, 4), (3, 5), (-1, 5)],
    ],
    "two sheets with holes": [
        [(0, 0), (20, 0), (20, 20), (0, 20)],
        [(-1, -1), (21, -1), (21, 21), (-1, 21)],
        [(5, 5), (5, 9), (9, 9), (9, 5)],
        [(11, 11), (11, 15), (15, 15), (15, 11)],
    ],
    "three sheets with crossing holes": [
        [(0, 0), (20, 0), (20, 20), (0, 20)],
        [(-1, -1), (21, -1), (21, 21), (-1, 21)],
        [(-2, -2), (22, -2), (22, 22), (-2, 22)],
        [(5, 5), (5, 10), (10, 10), (10, 5)],
        [(8, 8), (8, 15), (15, 15), (15, 8)],
    ],
}


def classes_of_all(immersion):
    """All pairs of sheets over a cell, and a number for each, equal for those that borders carry into each other."""
    first_sheet, winding = immersion.first_sheet, immersion.arrangement.winding
    number = {
        (lower, upper): i
        for i, (lower, upper) in enumerate(
            (first + a, first + b)
            for first, w in zip(first_sheet.tolist(), winding.tolist(), strict=True)
            for a in range(w)
            for b in range(w)
        )
    }
    glued = {}
    for border, right, left in immersion.gluing.tolist():
        glued.setdefault(border, []).append((right, left))
    edges = [
        (number[right, other_right], number[left, other_left])
        for pairs in glued.values()
        for right, left in pairs
        for other_right, other_left in pairs
    ]
    start, end = np.array(edges, dtype=np.int64).reshape(-1, 2).T
    return np.array(list(number)).reshape(-1, 2), components(len(number), start, end)


def assert_same_classes(immersion):
    pairs, expected = classes_of_all(immersion)
    lower, upper = pairs[pairs[:, 0] != pairs[:, 1]].T
    expected = expected[pairs[:, 0] != pairs[:, 1]]
    graph = pair_graph(immersion)
    found = graph.label[graph.pair_of(lower, upper)]
    together = {*zip(expected.tolist(), found.tolist(), strict=True)}
    assert len(together) == len(set(expected.tolist())) == len(set(found.tolist()))
    assert bool(len(graph.contradictions())) == (getattr(find_layering(immersion), "reason", "") == "reversed pair")


@pytest.mark.parametrize("name", CURVES)
def test_curves_of_the_gallery(name):
    for immersion, _ in zip(pf.immersions(CURVES[name].curve), range(5), strict=False):
        assert_same_classes(immersion)


@pytest.mark.parametrize("k", range(5))
def test_every_small_curve(k):
    for code in filter(may_bound_disk, census(k)):
        for immersion in pf.immersions(Arrangement.from_gauss(*code)):
            assert_same_classes(immersion)


@pytest.mark.parametrize("seed", range(8))
def test_random_disks(seed):
    assert_same_classes(pf.find_immersion(glued_disk(np.random.default_rng(seed), 60 + 20 * seed)))


@pytest.mark.parametrize("name", RINGS)
def test_outlines_with_holes(name):
    found = [immersion for immersion, _ in zip(pf.immersions(RINGS[name]), range(20), strict=False)]
    assert found
    for immersion in found:
        assert_same_classes(immersion)


def test_a_cusp():
    limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    assert_same_classes(pf.find_immersion(pf.Curve(limacon, cusps={6: 1})))


def test_few_pairs_are_looked_at():
    immersion = pf.find_immersion(glued_disk(np.random.default_rng(3), 300))
    assert len(pair_graph(immersion).label) < len(every_pair(immersion).label) / 3
