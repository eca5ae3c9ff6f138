"""The gallery's known answers, against the reference code."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.gallery import CURVES
from reference import crossings, gluings, layerings

# Enumerating all gluings takes too long for more crossings; tests/hard has other proofs for those curves.
ENUMERABLE = {name: named for name, named in CURVES.items() if named.crossings <= 30}


@pytest.mark.parametrize("named", ENUMERABLE.values(), ids=ENUMERABLE.keys())
def test_reference_gives_the_known_answers(named):
    points = named.draw(40).tolist()
    code = crossings.crossings(points)[0]
    assert len(code.partner) // 2 == named.crossings
    assert abs(crossings.turning_number(points)) == named.turning_number
    if crossings.turning_number(points) == -1:
        code = crossings.crossings(points[::-1])[0]
    found = gluings.immersions(*code) if named.turning_number == 1 else []
    assert len(found) == named.immersions
    lifted = sum(bool(layerings.layerings(*code, gluing.own_sheet, gluing.rows)) for gluing in found)
    assert lifted == named.embeddable


@pytest.mark.parametrize("named", CURVES.values(), ids=CURVES.keys())
def test_library_gives_the_known_answers(named):
    arrangement = pf.arrange(named.curve)
    arrangement.check()
    assert arrangement.n_crossings == named.crossings
    assert arrangement.turning_number == named.turning_number
    assert pf.count_immersions(arrangement) == named.immersions
    lifted = sum(bool(pf.find_layering(immersion)) for immersion in pf.immersions(arrangement))
    assert lifted == named.embeddable


@pytest.mark.parametrize("named", CURVES.values(), ids=CURVES.keys())
def test_the_code_does_not_depend_on_the_number_of_points(named):
    assert pf.GaussCode.of(pf.arrange(named.curve)) == pf.GaussCode.of(pf.arrange(named.coarse().curve))


def test_what_is_no_polygon_looks_smooth():
    """But for the corners at a ribbon's ends, no edge turns from the one before so much that one sees it."""
    for named in CURVES.values():
        points = named.curve.points
        if len(points) > len(named.coarse().curve):
            step = np.diff(points, axis=0, append=points[:1])
            turn = np.angle(np.roll(step @ (1, 1j), -1) / (step @ (1, 1j)), deg=True)
            assert np.sum(np.abs(turn) > 6) in (0, 4), named.name
