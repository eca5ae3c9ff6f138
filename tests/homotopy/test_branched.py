"""Disks with branch points by definition: without its branch points such a disk is a surface with more boundary.

Round a simple branch point the cloth goes twice, so a small disk round it has a boundary that winds twice. Taken out,
it leaves a surface bounded by the curve and by a loop that winds twice the other way round. Where the branch points
are, is free: all cells are tried.
"""

from itertools import combinations_with_replacement

import numpy as np
import pytest

import plyfold as pf
from plyfold.draw.placement import label_circle
from reference.planar_maps import census, turning_number, windings

LIMACON = np.array([(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)])


def twice_round(x, y, radius):
    """A small loop that winds twice round a place, clockwise."""
    return ((LIMACON - (0.75, 0)) * radius / 4 + (x, y))[::-1]


def bounds_branched_disk(curve, branch_points):
    arranged = pf.arrange(curve)
    circles = [label_circle(arranged, cell) for cell in np.flatnonzero(arranged.winding > 1).tolist()]
    for places in combinations_with_replacement(circles, branch_points):
        loops = [
            twice_round(x + 0.4 * radius * (2 * number - branch_points + 1), y, 0.4 * radius)
            for number, (x, y, radius) in enumerate(places)
        ]
        if pf.find_immersion([arranged.curve, *loops], connected=True):
            return True
    return False


@pytest.mark.parametrize(
    ("crossings", "turning", "found"),
    [
        (1, 2, (1, 0)),
        (2, 3, (2, 0)),
        (3, 2, (5, 0)),
        pytest.param(4, 3, None, marks=pytest.mark.slow),
        pytest.param(5, 2, None, marks=pytest.mark.slow),
    ],
)
def test_branch_points_by_definition(crossings, turning, found):
    counts = [0, 0]
    for code in census(crossings):
        if turning_number(code) == turning and min(windings(code)) >= 0:
            wanted = pf.GaussCode(*code)
            is_branched = pf.least_homotopy(wanted).branch_points is not None
            assert bounds_branched_disk(wanted.to_curve(), turning - 1) == is_branched
            counts[not is_branched] += 1
    assert found is None or tuple(counts) == found
    assert counts[0] > 0
