"""The search through all casings, a contender of the benchmark, agrees with the search through all levels."""

import pytest

import plyfold as pf
from plyfold.hard.flaps import flap_disk
from reference import casings, layerings
from reference.planar_maps import census, gauss_code, may_bound_disk


@pytest.mark.parametrize("crossings", [2, 4])
def test_every_small_curve_against_all_levels(crossings):
    codes = [code for code in census(crossings) if may_bound_disk(code)]
    found = [sorted(casings.casing_solutions(code)) for code in codes]
    assert any(found)
    assert found == [sorted(layerings.level_solutions(code)) for code in codes]


def test_counts_of_a_known_curve():
    """Two flaps that cover each other's handles: above and below, in two immersions."""
    immersion = flap_disk(2, [(0, 1), (1, 0)]).immersion
    code = gauss_code(*immersion.arrangement.gauss_code())
    expected = sum(pf.count_layerings(each) for each in pf.immersions(immersion.arrangement))
    assert sum(1 for _ in casings.casing_solutions(code)) == expected > 0
