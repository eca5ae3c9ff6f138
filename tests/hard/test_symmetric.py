"""The symmetric search finds disks that do not lift, and trying all orders finds no layering either."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.errors import InputError
from plyfold.hard.symmetric import search_symmetric
from reference import layerings


def smallest():
    found = search_symmetric(np.random.default_rng(62), attempts=60)
    return min(found, key=lambda each: each.immersion.arrangement.n_crossings)


def test_finds_the_bennequin_curve():
    curve, immersion, _ = smallest()
    bennequin = pf.arrange(pf.gallery.CURVES["bennequin"].curve)
    codes = [pf.GaussCode(*arranged.gauss_code()) for arranged in (immersion.arrangement, bennequin)]
    assert codes[0].canonical() == codes[1].canonical()
    assert pf.count_immersions(curve) == 5


def test_all_orders_confirm_it():
    immersion = smallest().immersion
    own, rows = immersion.own_sheet.tolist(), [tuple(row) for row in immersion.gluing.tolist()]
    assert layerings.layerings(*immersion.arrangement.gauss_code(), own, rows) == []


@pytest.mark.parametrize("order", [3, 5])
def test_symmetric_and_refused(order):
    found = next(search_symmetric(np.random.default_rng(1), order, triangles=10))
    points = found.curve.points @ np.array([1, 1j])
    turned = np.roll(points, -len(points) // order)
    assert np.allclose(turned, points * np.exp(2j * np.pi / order))
    assert found.obstruction.reason in ("reversed pair", "cyclic order")


def test_ends_after_the_attempts():
    assert len(list(search_symmetric(np.random.default_rng(2), order=2, triangles=2, attempts=5))) == 0


def test_refuses_no_symmetry():
    with pytest.raises(InputError):
        next(search_symmetric(np.random.default_rng(0), order=1))
