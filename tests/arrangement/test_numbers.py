"""The numbers of visits, borders, darts and cells of one curve, which everything else and stored files rely on."""

import json
from pathlib import Path

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.errors import PlyfoldError
from reference import crossings, planar_maps, random_curves

STORED = json.loads((Path(__file__).parent / "gallery_numbers.json").read_text())


@pytest.mark.parametrize("name", STORED)
def test_the_gallery_has_the_numbers_that_it_always_had(name):
    drawn, stored = pf.arrange(CURVES[name].curve), STORED[name]
    code = " ".join(f"{1 + c}{'+' if s else '-'}" for c, s in zip(drawn.crossing_of_visit, drawn.ccw, strict=True))
    assert f"{code} / outer {drawn.outer}".strip() == stored["code"]
    assert drawn.reversed == stored["reversed"]
    assert drawn.turning_number == stored["turning number"]
    assert drawn.winding.tolist() == stored["winding"]
    assert drawn.cell_darts.tolist() == stored["cell darts"]


def directed(points):
    """The polygon in the direction in which no winding number is negative; if none is, with a turning number ≥ 0."""
    code = crossings.crossings(points).code
    low, high = min(planar_maps.windings(code)), max(planar_maps.windings(code))
    turned = high <= 0 or (low < 0 and planar_maps.turning_number(code) < 0)
    return (crossings.reversed_polygon(points) if turned else points), turned


def cells_in_order(code):
    """The boundary of the unbounded cell, then those of the others by their lowest darts, each from its lowest dart."""
    orbits = []
    for dart in [code.outer, *range(2 * planar_maps.border_count(code))]:
        if not any(dart in orbit for orbit in orbits):
            orbit = [dart]
            while (following := planar_maps.next_dart(code.partner, code.ccw, orbit[-1])) != dart:
                orbit.append(following)
            lowest = orbit.index(min(orbit))
            orbits.append(orbit[lowest:] + orbit[:lowest])
    return orbits


def random_curve(rng):
    kind = rng.integers(0, 4)
    if kind == 0:
        return random_curves.random_polygon(rng, int(rng.integers(3, 12)), int(rng.choice([12, 1000])))
    if kind == 1:
        return random_curves.smooth_curve(rng, int(rng.integers(1, 4)), 24)
    if kind == 2:
        return random_curves.ribbon_outline(rng, int(rng.integers(1, 8)))
    return random_curves.glued_disk(rng, int(rng.integers(1, 8)))


def test_a_thousand_curves_have_the_numbers_of_the_conventions():
    rng = np.random.default_rng(14)
    compared = turned_round = 0
    while compared < 1000:
        points = random_curve(rng)
        try:
            used, turned = directed(points)
        except (crossings.DegenerateError, ZeroDivisionError):
            continue
        try:
            drawn = pf.arrange(points, general_position="raise")
        except PlyfoldError:
            continue
        expected = crossings.crossings(used)
        assert drawn.gauss_code() == (list(expected.code.partner), list(expected.code.ccw), expected.code.outer)
        assert drawn.reversed == turned
        assert drawn.visit_edge.tolist() == list(expected.edges)
        first = [p for p, q in enumerate(expected.code.partner) if p < q]
        assert drawn.crossing_of_visit[first].tolist() == list(range(len(first)))
        assert np.allclose(drawn.crossings, np.array([expected.points[p] for p in first], float).reshape(-1, 2))
        assert drawn.curve.points.tolist() == np.array(used, float).tolist()
        assert list(map(list, drawn.cells)) == cells_in_order(expected.code)
        assert drawn.border_before.tolist() == [(p - 1) % len(drawn.partner) for p in range(len(drawn.partner))]
        assert drawn.border_after.tolist() == list(range(len(drawn.partner)))
        compared, turned_round = compared + 1, turned_round + turned
    assert turned_round > 100


HANDLE = [
    (0, 0), (8, 0), (8, 2), (7.5, 2), (7.5, 10), (2.5, 10), (2.5, 2), (1.5, 2), (1.5, 6), (4.5, 6),
    (4.5, 2), (3.5, 2), (3.5, 9), (6.5, 9), (6.5, 2), (5.5, 2), (5.5, 7), (0.5, 7), (0.5, 2), (0, 2),
]  # fmt: skip
MIXED = [(-6, -2), (4, 1), (-10, -12), (9, 6), (8, 1), (8, -4), (-1, 7)]


@pytest.mark.parametrize("points", [HANDLE, random_curves.LIMACON, MIXED, [(0, 0), (1, 0), (0, 1)]])
def test_directions(points):
    """All ways to give a curve agree about it, and turning it round or reflecting it does what it should."""
    there, back = pf.arrange(points), pf.arrange([points[0], *points[:0:-1]])
    assert there.winding.min() >= 0 or (there.winding.max() > 0 and there.turning_number >= 0)
    assert there.reversed != back.reversed
    assert there.curve.points.tolist() == back.curve.points.tolist()
    for name in ("partner", "ccw", "cell_darts", "winding"):
        assert np.array_equal(getattr(there, name), getattr(back, name))
    mirrored = pf.arrange([(-x, y) for x, y in points])
    assert mirrored.reversed == back.reversed
    assert sorted(mirrored.winding.tolist()) == sorted(there.winding.tolist())
    assert mirrored.turning_number == there.turning_number
    code = planar_maps.gauss_code(*there.gauss_code())
    for given, turned in ((code, False), (planar_maps.reversed_code(code), True)):
        again = pf.Arrangement.from_gauss(*given)
        assert again.reversed == turned
        assert again.turning_number == there.turning_number
        assert sorted(again.winding.tolist()) == sorted(there.winding.tolist())
    assert pf.arrange(pf.GaussCode.of(points).to_curve()).turning_number == there.turning_number


def test_a_handle_stays_as_given_though_it_turns_the_other_way():
    drawn = pf.arrange(HANDLE)
    assert (drawn.turning_number, drawn.reversed, int(drawn.winding.min())) == (-1, False, 0)
