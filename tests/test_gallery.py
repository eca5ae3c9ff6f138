"""The gallery's known answers, against the reference code."""

import pytest

import plyfold as pf
from plyfold.gallery import CURVES
from reference import crossings, gluings, layerings

# Enumerating all gluings takes too long for more crossings; tests/hard has other proofs for those curves.
ENUMERABLE = {name: named for name, named in CURVES.items() if named.crossings <= 30}


@pytest.mark.parametrize("named", ENUMERABLE.values(), ids=ENUMERABLE.keys())
def test_reference_gives_the_known_answers(named):
    code = crossings.crossings(named.curve.points.tolist())[0]
    assert len(code.partner) // 2 == named.crossings
    assert abs(crossings.turning_number(named.curve.points.tolist())) == named.turning_number
    if crossings.turning_number(named.curve.points.tolist()) == -1:
        code = crossings.crossings(named.curve.points[::-1].tolist())[0]
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
