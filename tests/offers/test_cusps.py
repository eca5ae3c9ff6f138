"""Cusps proposed for outlines that turn too often: they hold, are few and sharp, and belong to the drawing."""

import math
from itertools import combinations, islice, product

import numpy as np
import pytest

import plyfold as pf
from bodies import patches
from plyfold.errors import InputError
from reference import crossings
from reference.crossings import DegenerateError
from reference.outline_drawings import outline_code
from reference.outline_levels import level_solutions
from reference.outlines import outline_map
from reference.random_curves import LIMACON, random_polygon, without_repeats

SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9)]


def fronts(seed, count):
    """Fronts of bodies with one to three turns at cusps, and without handles."""
    wanted = (
        patch
        for patch in patches(seed, ("tube", "ball"))
        if 0 < sum(map(sum, patch.cusps)) <= 3 and patch.chi == 2 - len(patch.loops)
    )
    return islice(wanted, count)


def angle(polygon, vertex):
    """The angle on the left, from 0 to 2π."""
    (x, y), (u, v), (a, b) = polygon[vertex], polygon[(vertex + 1) % len(polygon)], polygon[vertex - 1]
    return (math.atan2(b - y, a - x) - math.atan2(v - y, u - x)) % (2 * math.pi)


def embeds_with(polygon, index):
    marks = [index.get(vertex, 0) for vertex in range(len(polygon))]
    return bool(level_solutions(outline_code([polygon], [marks])))


def border_of_each_vertex(polygon):
    """A visit that comes before each vertex: found from the code with the vertex as a mark."""
    found = []
    for vertex in range(len(polygon)):
        code = outline_code([polygon], [[int(i == vertex) for i in range(len(polygon))]])
        found.append((code.index.index(1) - 1) % (len(code.partner) - 1))
    return found


def best_by_trying(polygon, turns):
    """The fewest cusps, on different borders, and of these those with the sharpest points, one after the other."""
    border = border_of_each_vertex(polygon)
    sharp = sorted(range(len(polygon)), key=lambda vertex: angle(polygon, vertex))
    for cusps in range(1, turns + 1):
        for chosen in combinations(sharp, cusps):
            if len({border[vertex] for vertex in chosen}) == cusps:
                for m in sorted(product(range(1, turns + 1), repeat=cusps), reverse=True):
                    if sum(m) == turns and embeds_with(polygon, dict(zip(chosen, m, strict=True))):
                        return dict(zip(chosen, m, strict=True))
    return None


def polygons_that_turn(rng, turns):
    """Small polygons that run counter-clockwise and turn a number of times more than once."""
    while True:
        polygon = without_repeats(random_polygon(rng, int(rng.integers(5, 10)), 12))
        try:
            if len(polygon) < 4 or crossings.turning_number(polygon) != 1 + turns:
                continue
            winding = outline_map(outline_code([polygon])).winding
        except DegenerateError:
            continue
        if min(winding) >= 0 and len({angle(polygon, vertex) for vertex in range(len(polygon))}) == len(polygon):
            yield polygon


@pytest.mark.parametrize(("turns", "count"), [(1, 60), (2, 12)])
def test_the_sharpest_points_of_the_fewest_borders_that_do(turns, count):
    found = 0
    for polygon in islice(polygons_that_turn(np.random.default_rng(turns), turns), count):
        expected, proposed = best_by_trying(polygon, turns), pf.suggest_cusps(polygon)
        assert bool(proposed) == bool(expected)
        if proposed:
            assert {point: m for (_, point), m in proposed.cusps.items()} == expected
            found += 1
        else:
            assert (proposed.reason, proposed.value) == ("no embedding", turns)
    assert found > count / 3


def test_proposals_for_fronts_of_bodies_hold_and_belong_to_the_drawing():
    """Whatever points the loops begin with, in whatever direction they run, and with their cusps taken off."""
    rng, seen = np.random.default_rng(3), 0
    for patch in fronts(5, 12):
        loops = patch.outline
        proposed = pf.suggest_cusps(loops)
        if patch.cuts_itself and not proposed:
            continue
        assert pf.find_embedding(proposed.outline, connected=True)
        assert sum(proposed.cusps.values()) == sum(map(sum, patch.cusps))
        places = {tuple(loops[loop][point]) for loop, point in proposed.cusps}
        rolled = [np.roll(loop, rng.integers(len(loop)), axis=0) for loop in loops]
        for other in (rolled, [loop[::-1] for loop in rolled]):
            again = pf.suggest_cusps(other)
            assert {tuple(other[loop][point]) for loop, point in again.cusps} == places
            assert all(again.outline.cusps[loop][point] == m for (loop, point), m in again.cusps.items())
        seen += 1
    assert seen > 8


def test_what_is_proposed_is_taken_as_it_is():
    proposed = pf.suggest_cusps(LIMACON)
    assert proposed.cusps == {(0, 7): 1}
    assert pf.find_embedding(pf.Outline([LIMACON], proposed.cusps)).euler_characteristic == 1
    assert isinstance(proposed.outline, pf.Curve)
    assert repr(proposed) == "<SuggestedCusps: point 7 of loop 0>"


def test_cusps_that_are_there_stay():
    patch = next(patch for patch in fronts(8, 40) if sum(map(sum, patch.cusps)) == 2 and not patch.cuts_itself)
    first = next((loop, point) for loop, index in enumerate(patch.cusps) for point in np.flatnonzero(index))
    proposed = pf.suggest_cusps(pf.Outline(patch.outline, {first: 1}))
    assert proposed
    assert first not in proposed.cusps
    assert proposed.outline.cusps[first[0]][first[1]] == 1
    assert sum(map(sum, proposed.outline.cusps)) == 2


def test_one_piece_is_demanded_unless_an_euler_characteristic_is():
    apart = [LIMACON, [(x + 20, y) for x, y in LIMACON]]
    assert pf.suggest_cusps(apart, chi=2).cusps == {(0, 7): 1, (1, 7): 1}
    found = pf.suggest_cusps(apart, most=4)
    assert (found.reason, found.value) == ("pieces", 2)


def test_why_there_is_no_proposal():
    assert (found := pf.suggest_cusps(SQUARE)).reason == "turning number"
    assert (found.value, str(found)) == (0, "No turns are too many: the curve turns once.")
    assert (found := pf.suggest_cusps(LIMACON, chi=-5)).reason == "turning number"
    assert "7 turns, more than 3, are too many" in str(found)
    assert pf.suggest_cusps(LIMACON, chi=-1, most=9).reason == "no embedding"
    apart = [LIMACON, [(20 + x, y) for x, y in SQUARE[::-1]]]
    assert pf.suggest_cusps(apart).reason == "negative winding"
    assert isinstance(pf.suggest_cusps(LIMACON, time_limit=0), pf.Unknown)
    with pytest.raises(InputError, match="no points"):
        pf.suggest_cusps(pf.Arrangement.from_gauss([1, 0], [True, False], 1))


@pytest.mark.parametrize("most", [0, -1, 1.5, True])
def test_the_most_turns_are_a_count(most):
    with pytest.raises(InputError, match="most must be a whole number from 1"):
        pf.suggest_cusps(LIMACON, most=most)
