"""Disks with flaps lift exactly if two colours suffice for their digraphs, which all colourings decide here."""

from itertools import combinations, permutations, product

import numpy as np
import pytest

import plyfold as pf
from plyfold.errors import InputError
from plyfold.hard.flaps import PALEY, flap_disk
from reference import crossings, gluings, layerings

BOTH_WAYS = list(permutations(range(3), 2))


def has_circle(vertices, arcs):
    """Whether a directed cycle stays within some vertices: those without an arc into them are taken away first."""
    left = set(vertices)
    while free := {v for v in left if not any(j == v and i in left for i, j in arcs)}:
        left -= free
    return bool(left)


def good_colouring(colours, arcs):
    return not any(has_circle([v for v, c in enumerate(colours) if c == colour], arcs) for colour in (False, True))


def two_colours_suffice(flaps, arcs):
    return any(good_colouring(colours, arcs) for colours in product([False, True], repeat=flaps))


def check_verdict(flaps, arcs):
    disk = flap_disk(flaps, arcs)
    found = pf.find_layering(disk.immersion)
    assert bool(found) == two_colours_suffice(flaps, arcs)
    if found:
        assert good_colouring(disk.sides(found), arcs)
    return disk


def test_every_digraph_with_three_vertices():
    for chosen in product([False, True], repeat=6):
        check_verdict(3, [arc for arc, taken in zip(BOTH_WAYS, chosen, strict=True) if taken])


@pytest.mark.parametrize("seed", range(25))
def test_random_digraphs(seed):
    rng = np.random.default_rng(seed)
    flaps, share = int(rng.integers(4, 8)), rng.uniform(0.2, 0.8)
    arcs = [arc for arc in permutations(range(flaps), 2) if rng.random() < share]
    disk = check_verdict(flaps, arcs)
    assert disk.immersion.arrangement.winding.max() <= flaps + 1
    assert disk.immersion.arrangement.n_crossings <= 3 * flaps * (flaps - 1) + 4 * flaps


def test_paley_has_no_pair_that_returns_reversed():
    assert not two_colours_suffice(7, PALEY)
    assert all(two_colours_suffice(7, [arc for arc in PALEY if arc != left_out]) for left_out in PALEY[:3])
    assert pf.find_layering(flap_disk(7, PALEY).immersion).reason == "cyclic order"


def test_paley_has_one_immersion_and_no_embedding():
    """Two other ways to the same answer: the count of groupings, and levels straight from the curve."""
    curve = flap_disk(7, PALEY).curve
    assert pf.count_immersions(curve) == 1
    assert not pf.find_embedding(curve)


def test_three_flaps_in_a_circle_may_not_all_be_on_one_side():
    disk = flap_disk(3, [(0, 1), (1, 2), (2, 0)])
    sides = {disk.sides(layering) for layering in pf.layerings(disk.immersion)}
    assert sides == set(product([False, True], repeat=3)) - {(False,) * 3, (True,) * 3}


@pytest.mark.parametrize("arcs", [[(0, 1), (1, 0)], [(0, 1)], []])
def test_layerings_say_the_definition(arcs):
    """The immersion is one of the reference's, and so are its layerings."""
    immersion = flap_disk(2, arcs).immersion
    code = crossings.crossings([(int(x), int(y)) for x, y in immersion.arrangement.curve.points]).code
    own, rows = immersion.own_sheet.tolist(), [tuple(row) for row in immersion.gluing.tolist()]
    assert code == gluings.gauss_code(*immersion.arrangement.gauss_code())
    assert gluings.key_of(*code, own, rows) in gluings.keys(*code)
    assert len(layerings.layerings(*code, own, rows)) == pf.count_layerings(immersion)


def test_reversed_pair_is_confirmed_by_trying_all_orders():
    immersion = flap_disk(3, BOTH_WAYS).immersion
    own, rows = immersion.own_sheet.tolist(), [tuple(row) for row in immersion.gluing.tolist()]
    assert layerings.layerings(*immersion.arrangement.gauss_code(), own, rows) == []


def test_outline_needs_no_repair():
    for flaps in (1, 2, 5, 9):
        assert not flap_disk(flaps, combinations(range(flaps), 2)).curve.repairs


@pytest.mark.parametrize(("flaps", "arcs"), [(0, []), (2, [(0, 0)]), (2, [(0, 2)]), (2, [(-1, 0)])])
def test_refuses(flaps, arcs):
    with pytest.raises(InputError):
        flap_disk(flaps, arcs)
