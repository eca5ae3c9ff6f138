"""Orders with the least self-intersections, against all orders tried."""

from itertools import pairwise

import numpy as np
import pytest

from coarse import CURVES
from plyfold.arrangement.arrangement import Arrangement
from plyfold.errors import PlyfoldError
from plyfold.immersion.solve import immersions
from plyfold.layering.orders import intersections as module
from plyfold.layering.orders.intersections import IntersectingLayering, least_intersecting_layering
from plyfold.layering.orders.search import find_layering
from reference import intersections as reference
from reference.planar_maps import census, gauss_code, may_bound_disk
from reference.random_curves import glued_disk

# Curves with eight crossings; one of the two immersions of each has no layering.
SMALLEST_WITHOUT_LAYERING = [
    ([9, 4, 3, 2, 1, 10, 7, 6, 11, 0, 5, 8, 13, 12, 15, 14], [1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0], 5),
    ([1, 0, 3, 2, 7, 14, 11, 4, 9, 8, 15, 6, 13, 12, 5, 10], [1, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0], 25),
    ([1, 0, 3, 2, 7, 10, 15, 4, 9, 8, 5, 14, 13, 12, 11, 6], [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 0, 0], 25),
    ([1, 0, 5, 10, 15, 2, 9, 8, 7, 6, 3, 14, 13, 12, 11, 4], [1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0], 25),
]


def parts(immersion):
    """Code, own sheets and rows of the gluing, as the reference reads them."""
    arranged = immersion.arrangement
    rows = [tuple(row) for row in immersion.gluing.tolist()]
    return gauss_code(arranged.partner, arranged.ccw, arranged.outer), immersion.own_sheet.tolist(), rows


def lengths(arranged):
    """Length of every border, from its points."""
    if arranged.curve is None:
        return [1.0] * arranged.n_borders
    walks = [arranged.border_points(border) for border in range(arranged.n_borders)]
    return [float(sum(np.linalg.norm(b - a) for a, b in pairwise(w))) for w in walks]


def assert_consistent(found):
    """The intersections are those that follow from the levels, and their length is as stated."""
    _, own_sheet, rows = parts(found.immersion)
    expected = reference.intersections(own_sheet, rows, dict(enumerate(found.level.tolist())))
    assert sorted((border, (a, b)) for border, a, b in found.intersections.tolist()) == sorted(expected)
    weight = lengths(found.immersion.arrangement)
    assert found.total_length == pytest.approx(sum(weight[border] for border, _ in expected))
    found.check()


@pytest.mark.parametrize("k", [0, 2, 4, pytest.param(6, marks=pytest.mark.slow)])
def test_none_on_small_curves(k):
    """All immersions of curves with up to six crossings lift."""
    found = [
        least_intersecting_layering(immersion)
        for code in census(k)
        if may_bound_disk(code)
        for immersion in immersions(Arrangement.from_gauss(*code))
    ]
    assert len(found) == {0: 1, 2: 1, 4: 7, 6: 88}[k]
    for layering in found:
        assert layering.optimal
        assert len(layering.intersections) == 0
        assert layering.total_length == 0


@pytest.mark.parametrize("code", SMALLEST_WITHOUT_LAYERING)
def test_smallest_curves_without_layering(code):
    costs = []
    for immersion in immersions(Arrangement.from_gauss(*code)):
        found = least_intersecting_layering(immersion)
        assert_consistent(found)
        assert found.optimal
        assert found.total_length == reference.least_cost(*parts(immersion), lengths(immersion.arrangement))
        assert (found.total_length == 0) == bool(find_layering(immersion))
        costs.append(found.total_length)
    assert sorted(costs) == [0.0, 1.0]


def test_drawn_curve_that_does_not_lift():
    """Lengths count where there is a drawing; two of the five immersions need an intersection."""
    costs = []
    for immersion in immersions(CURVES["bennequin"].curve):
        found = least_intersecting_layering(immersion)
        assert_consistent(found)
        expected = reference.least_cost(*parts(immersion), lengths(immersion.arrangement))
        assert found.total_length == pytest.approx(expected, rel=1e-6)
        costs.append(found.total_length)
    assert sorted(costs)[:3] == [0.0, 0.0, 0.0]
    assert sorted(costs)[3] > 0


@pytest.mark.parametrize("seed", range(5))
def test_length_rather_than_number(seed):
    """With random weights in place of lengths, the optimum is that of the reference, whatever border it takes."""
    weight = np.random.default_rng(seed).uniform(1, 20, 24)
    immersion = next(i for i in immersions(CURVES["bennequin"].curve) if not find_layering(i))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("plyfold.layering.orders.intersections.border_lengths", lambda _: weight)
        found = least_intersecting_layering(immersion)
        assert found.total_length == pytest.approx(reference.least_cost(*parts(immersion), weight), rel=1e-5)


def test_random_disks_lift():
    for seed in range(5):
        curve = glued_disk(np.random.default_rng(seed), 25)
        for immersion in immersions(curve):
            found, layering = least_intersecting_layering(immersion), find_layering(immersion)
            assert (found.total_length == 0) == bool(layering)
            assert not layering or np.array_equal(found.level, layering.level)


def test_out_of_time():
    """Without time there is an answer all the same; it does not claim to be the best, and never beats the best."""
    for immersion in immersions(CURVES["bennequin"].curve):
        hasty, best = least_intersecting_layering(immersion, time_limit=0), least_intersecting_layering(immersion)
        assert_consistent(hasty)
        assert not hasty.optimal
        assert "maybe not" in repr(hasty)
        assert hasty.total_length >= best.total_length
        assert least_intersecting_layering(immersion, time_limit=60).optimal


def test_greedy_search_alone_is_good(monkeypatch):
    """When the exact search does not end, gluings of long borders have been kept."""
    monkeypatch.setattr("plyfold.layering.orders.intersections.fewest_failures", lambda *_, **options: (None, 0))
    for immersion in immersions(CURVES["bennequin"].curve):
        found = least_intersecting_layering(immersion, time_limit=60)
        assert_consistent(found)
        assert found.optimal == (not len(found.intersections))
        assert len(found.intersections) <= 2
        assert (found.total_length == 0) == bool(find_layering(immersion))


def test_wrong_levels_are_noticed():
    immersion = next(immersions(CURVES["exit-ramp"].curve))
    with pytest.raises(PlyfoldError, match="levels 1 to 2"):
        IntersectingLayering(immersion, np.ones(immersion.n_sheets, dtype=np.int64), optimal=False).check()


def test_none_is_the_least_also_out_of_time(monkeypatch):
    """Whether more could be proved in time does not matter to an answer without intersections."""
    immersion = next(immersions(CURVES["exit-ramp"].curve))
    monkeypatch.setattr(module, "_levels_in_time", lambda immersion, clock: (found.level, False))
    found = find_layering(immersion)
    assert least_intersecting_layering(immersion).optimal
