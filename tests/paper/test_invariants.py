"""The pairwise invariants of §2.4 of the paper, on every curve with few crossings, against the reference."""

import numpy as np
import pytest

from plyfold.arrangement.arrangement import Arrangement
from plyfold.paper.invariants import border_differences, cells_around_crossings, diagonal_differences, diagonal_sums
from reference import planar_maps
from reference.planar_maps import census, may_bound_disk

LIMACON = ([1, 0], [True, False], 1)
EIGHT = ([1, 0], [True, False], 3)


def cases(k):
    """All curves with k crossings, in the direction in which they are used."""
    arranged = [Arrangement.from_gauss(*code) for code in census(k)]
    return [(planar_maps.gauss_code(*drawn.gauss_code()), drawn) for drawn in arranged]


def reference_corners(code):
    """For each crossing, in order of first visits, the winding numbers of bottom, left of a, top, left of b."""
    winding = planar_maps.windings(code)
    corners = sorted(planar_maps.corners(code), key=lambda c: min(c.a_bottom, code.partner[c.a_bottom]))
    return [[winding[cell] for cell in (c.bottom, c.left_of_a, c.top, c.left_of_b)] for c in corners]


@pytest.mark.parametrize("k", [0, 1, 2, 3, 4, 5])
def test_cells_around_crossings(k):
    for code, arranged in cases(k):
        assert arranged.winding[cells_around_crossings(arranged)].tolist() == reference_corners(code)


@pytest.mark.parametrize("k", [0, 1, 2, 3, 4, 5])
def test_signed_numbers_are_the_same_for_every_curve(k):
    for code, arranged in cases(k):
        lowest = np.array(reference_corners(code), dtype=int).reshape(-1, 4).min(axis=1, initial=99)
        assert border_differences(arranged).tolist() == [1] * arranged.n_borders
        assert diagonal_differences(arranged).tolist() == [[2, 0]] * k
        assert diagonal_sums(arranged).tolist() == [[2 * w + 2, 2 * w + 2] for w in lowest.tolist()]


@pytest.mark.parametrize("k", [1, 2, 3, 4, 5])
def test_unsigned_sums_differ_somewhere_exactly_if_two_cells_wind_in_opposite_ways(k):
    verdicts = set()
    for code, arranged in cases(k):
        winding = planar_maps.windings(code)
        sums = diagonal_sums(arranged, unsigned=True)
        assert bool((sums[:, 0] != sums[:, 1]).any()) == (min(winding) < 0 < max(winding))
        verdicts.add(min(winding) < 0 < max(winding))
    assert verdicts == {False, True}


def test_the_two_loops_of_figure_8():
    eight, limacon = Arrangement.from_gauss(*EIGHT), Arrangement.from_gauss(*LIMACON)
    assert diagonal_sums(eight, unsigned=True).tolist() == [[2, 0]]
    assert diagonal_differences(eight, unsigned=True).tolist() == [[0, 0]]
    assert diagonal_sums(limacon, unsigned=True).tolist() == [[2, 2]]
    assert limacon.turning_number == 2, "so it bounds no disk, and no sum shows it"


def test_the_smallest_curves_that_pass_every_invariant_turn_once_and_bound_no_disk():
    passing = [arranged for code, arranged in cases(4) if may_bound_disk(code)]
    assert len(passing) == 11
    for arranged in passing:
        sums = diagonal_sums(arranged, unsigned=True)
        assert (sums[:, 0] == sums[:, 1]).all()
