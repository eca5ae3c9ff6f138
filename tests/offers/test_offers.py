"""All offers about a "no" as data."""

import plyfold as pf
from plyfold.gallery import CURVES
from plyfold.offers.offers import offers
from plyfold.report import verdict


def test_a_limacon_can_lose_its_loop_or_get_a_cusp():
    found = offers(pf.arrange(CURVES["limacon"].curve))
    assert [change.kind for change in found.repaired.changes] == ["loop left out"]
    assert list(found.cusps.cusps.values()) == [1]
    assert pf.bounds_disk(found.repaired.outline)
    assert pf.find_embedding(found.cusps.outline)


def test_a_figure_eight_can_have_neither():
    found = offers(pf.arrange([(0, 0), (2, 2), (2, 0), (0, 2)]))
    assert (found.repaired, found.cusps) == (None, None)


def test_no_time():
    found = offers(pf.arrange(CURVES["limacon"].curve), time_limit=0)
    assert (found.repaired, found.cusps) == (None, None)


def test_codes_and_surfaces_have_no_offers():
    assert "offers" not in verdict(pf.Arrangement.from_gauss([1, 0], [True, False], outer=1))
    assert "offers" not in verdict(pf.arrange([(0, 0), (1, 0), (0, 1)]))
