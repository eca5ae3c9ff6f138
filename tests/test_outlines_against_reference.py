"""Immersions and embeddings of outlines against the definition: cusps on every border, fronts of bodies."""

from itertools import islice

import numpy as np
import pytest

import plyfold as pf
from bodies import patches
from codes import code_of
from nightly.outlines import judge_embeddings, judge_immersions
from plyfold.arrangement.arrangement import Arrangement
from reference.outlines import of_gauss, outline_map, with_cusps
from reference.planar_maps import border_count, nonnegative_curves

BIG = [(0, 0), (90, 0), (0, 90)]
OVER_IT = [(1, 2), (93, 3), (2, 91)]
HOLE = [(20, 20), (20, 30), (30, 21)]


def judge(arranged):
    """The numbers of immersions and of embeddings."""
    return judge_immersions(arranged), judge_embeddings(arranged)


@pytest.mark.parametrize("k", [0, 1, 2, 3, pytest.param(4, marks=pytest.mark.slow)])
def test_a_cusp_on_each_border_of_each_curve_in_both_directions(k):
    for code in nonnegative_curves(k):
        judge(Arrangement.from_gauss(*code))
        for border in range(border_count(code)):
            for m in (1, 2):
                arranged, expected = (
                    Arrangement.from_gauss(*code, cusps={border: m}),
                    with_cusps(of_gauss(code), [(border, m)]),
                )
                assert outline_map(code_of(arranged)) == outline_map(expected)
                judge(arranged)


def test_pairs_of_cusps():
    rng, bound = np.random.default_rng(9), 0
    every = [code for k in (2, 3, 4) for code in nonnegative_curves(k)]
    for _ in range(150):
        code = every[rng.integers(len(every))]
        borders = rng.permutation(border_count(code))[:2].tolist()
        immersions, embeddings = judge(Arrangement.from_gauss(*code, cusps=dict.fromkeys(borders, 1)))
        bound += bool(immersions and embeddings)
    assert bound > 3


@pytest.mark.parametrize("kind", ["tube", "ball"])
def test_small_fronts_of_bodies(kind):
    counted = 0
    for patch in islice(patches(51, (kind,)), 60):
        arranged = pf.arrange(pf.Outline(patch.outline, patch.cusps))
        if max(arranged.winding) <= 3 and arranged.n_borders < 25:
            immersions, embeddings = judge(arranged)
            assert immersions > 0
            assert embeddings > 0 or patch.cuts_itself
            counted += 1
    assert counted > 10


def test_two_disks_and_a_hole_in_either():
    """Two ways, and in each of them either disk above."""
    arranged = pf.arrange([BIG, OVER_IT, HOLE])
    assert judge(arranged) == (2, 4)
    assert not pf.find_immersion(arranged, connected=True)
