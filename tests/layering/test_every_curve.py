"""Layerings of every curve with few crossings, and of the curves with several immersions, against brute force."""

from functools import cache
from itertools import product

import numpy as np
import pytest

import plyfold as pf
from plyfold.arrangement.arrangement import Arrangement
from plyfold.gallery import chain
from plyfold.layering.levels.casing import embed_cased
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.listing import layerings
from plyfold.layering.orders.nicest import nicest_layering
from plyfold.obstruction import Unknown
from reference import layerings as reference
from reference.gluings import key_of
from reference.planar_maps import CIRCLE, census, corners, gauss_code, may_bound_disk
from reference.random_curves import MILNOR_LIKE, SEVERAL_IMMERSIONS

UP_TO_SIX = [0, 2, 4, 6]
"""A curve that turns once has an even number of crossings."""


def code_of(immersion):
    arranged = immersion.arrangement
    return gauss_code(arranged.partner, arranged.ccw, arranged.outer)


def key(immersion):
    return key_of(*code_of(immersion), immersion.own_sheet, immersion.gluing)


@cache
def disks(k):
    return [code for code in census(k) if may_bound_disk(code)]


def every_immersion(k):
    return [immersion for code in disks(k) for immersion in pf.immersions(Arrangement.from_gauss(*code))]


def brute_force(immersion):
    """The levels of all sheets, of every layering."""
    rows = [tuple(row) for row in immersion.gluing.tolist()]
    found = reference.layerings(*code_of(immersion), immersion.own_sheet.tolist(), rows)
    return {tuple(level[sheet] for sheet in range(immersion.n_sheets)) for level in found}


def changes(immersion, level):
    """Changes between over and under along the curve, from the reference's crossings."""
    code = code_of(immersion)
    over = [None] * len(code.partner)
    own = immersion.own_sheet.tolist()
    for corner in corners(code):
        a_over = level[own[corner.a_top]] > level[own[corner.b_top]]
        over[corner.a_bottom] = a_over
        over[corner.b_top] = not a_over
    return sum(over[i] != over[i - 1] for i in range(len(over)))


def assert_all_found(immersion):
    expected = brute_force(immersion)
    found = [tuple(layering.level.tolist()) for layering in layerings(immersion)]
    assert set(found) == expected
    assert len(found) == len(expected) == count_layerings(immersion)
    assert len(expected) <= 2 ** (immersion.arrangement.n_crossings // 2)
    return expected


def assert_nicest(immersion, expected):
    """The nicest has the fewest changes of all, counted with the reference's crossings."""
    nicest = nicest_layering(immersion)
    assert bool(nicest) == bool(expected)
    if nicest:
        assert tuple(nicest.level.tolist()) in expected
        assert nicest.changes == min(changes(immersion, level) for level in expected)


class TestEveryCurve:
    @pytest.mark.parametrize("k", UP_TO_SIX)
    def test_list_count_and_nicest(self, k):
        for immersion in every_immersion(k):
            assert_nicest(immersion, assert_all_found(immersion))

    @pytest.mark.parametrize("k", UP_TO_SIX)
    def test_changes(self, k):
        for immersion in every_immersion(k):
            for layering in layerings(immersion):
                assert layering.changes == changes(immersion, layering.level.tolist())

    @pytest.mark.parametrize("k", UP_TO_SIX)
    def test_fixed_orders(self, k):
        """Over every cell, every order of two sheets, alone and with the order of two others: as brute force."""
        for immersion in every_immersion(k):
            expected = brute_force(immersion)
            for fix in some_orders(immersion):
                fitting = {level for level in expected if all(fits(level, *order) for order in fix.items())}
                found = pf.find_layering(immersion, fix=fix)
                assert bool(found) == bool(fitting)
                assert not found or tuple(found.level.tolist()) in fitting

    @pytest.mark.parametrize("k", UP_TO_SIX)
    def test_all_casings(self, k):
        """Every way to go over or under at all crossings: those that lift are the layerings of all immersions."""
        for code in disks(k):
            arranged = Arrangement.from_gauss(*code)
            solutions = reference.level_solutions(code)
            lifted = [found for over in product([False, True], repeat=k) if (found := embed_cased(arranged, over))]
            assert sorted(tuple(found.border_level.tolist()) for found in lifted) == sorted(solutions)

    @pytest.mark.parametrize("k", UP_TO_SIX)
    def test_a_casing_gives_its_layering_back(self, k):
        for immersion in every_immersion(k):
            for layering in layerings(immersion):
                back = embed_cased(immersion.arrangement, layering.casing)
                back.check()
                back.immersion.check()
                assert key(back.immersion) == key(immersion)
                assert back.border_level.tolist() == layering.border_level.tolist()
                assert back.casing.tolist() == layering.casing.tolist()


def some_orders(immersion):
    pairs = [(cell, a, b) for cell, sheets in enumerate(immersion.sheets) for a in sheets for b in sheets if a != b]
    alone = [{pair: order} for pair in pairs for order in ("above", "below")]
    return alone + [{first: "above", second: "above"} for first, second in zip(pairs, pairs[2:], strict=False)]


def fits(level, pair, order):
    _, first, second = pair
    return (level[first] > level[second]) == (order == "above")


class TestKnownCurves:
    @pytest.mark.parametrize(("polygon", "k", "counts"), SEVERAL_IMMERSIONS)
    def test_curves_with_several_immersions(self, polygon, k, counts):
        found = [(count_layerings(i), len(assert_all_found(i))) for i in pf.immersions(polygon)]
        assert sorted(found) == [(count, count) for count in counts]

    def test_a_circle(self):
        (immersion,) = pf.immersions(Arrangement.from_gauss(*CIRCLE))
        assert count_layerings(immersion) == 1
        assert nicest_layering(immersion).changes == 0
        assert embed_cased(immersion.arrangement, []).level.tolist() == [1]

    @pytest.mark.parametrize("links", [1, 2, 100])
    def test_horseshoes_in_a_row_attain_the_bound(self, links):
        """Each has two crossings and two layerings; an immersed disk has at most 2^(k/2)."""
        horseshoe = [(0, 0), (8, -1), (12, 4), (8, 9), (3, 8), (3, 0.2), (5, 6), (7, 6), (8, 2)]
        immersion = pf.find_immersion(chain(horseshoe, links))
        assert immersion.arrangement.n_crossings == 2 * links
        assert count_layerings(immersion) == 2**links

    def test_a_long_chain_is_counted_and_listed(self):
        """Its links have nothing in common, so their layerings multiply: two each."""
        immersion = pf.find_immersion(chain(MILNOR_LIKE, 100))
        assert count_layerings(immersion) == 2**100
        first = [layering.level for layering, _ in zip(layerings(immersion), range(100), strict=False)]
        assert len(np.unique(first, axis=0)) == 100

    def test_time_is_limited(self):
        immersion = pf.find_immersion(chain(MILNOR_LIKE, 3))
        assert isinstance(nicest_layering(immersion, time_limit=0), Unknown)
        assert nicest_layering(immersion, time_limit=60)
        assert count_layerings(immersion, time_limit=60) == 8
