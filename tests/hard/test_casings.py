"""The search through all casings, a contender of the benchmark, agrees with the search through all levels."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.hard import flap_disk
from reference import casings, layerings
from reference.planar_maps import gauss_code
from reference.random_curves import glued_disk


@pytest.mark.parametrize("seed", range(40))
def test_against_levels(seed):
    arranged = pf.arrangement(glued_disk(np.random.default_rng(seed), 6))
    if 1 <= arranged.n_crossings <= 8:
        code = gauss_code(*arranged.gauss_code())
        assert sorted(casings.casing_solutions(code)) == sorted(layerings.level_solutions(code))


def test_counts_of_a_known_curve():
    """Two flaps that cover each other's handles: above and below, in two immersions."""
    immersion = flap_disk(2, [(0, 1), (1, 0)]).immersion
    code = gauss_code(*immersion.arrangement.gauss_code())
    expected = sum(pf.layering.count_layerings(each) for each in pf.immersions(immersion.arrangement))
    assert sum(1 for _ in casings.casing_solutions(code)) == expected > 0
