"""The references of outlines that touch themselves: known answers, and two ways to each answer."""

from itertools import product

import numpy as np
import pytest

from reference import gluings
from reference.contacts import (
    answer,
    any_move,
    contacts,
    count_moved,
    count_outward,
    count_strict,
    either_direction,
    may_bound,
    moved,
    moves_that_bound,
    opposite,
    outward_move,
    positions,
    random_touching,
    random_touching_with_cusps,
    starts,
    with_vertices_at_cusps,
    without_spikes,
)
from reference.crossings import DegenerateError, crossings, crossings_between, exact
from reference.outline_drawings import outline_code
from reference.outline_gluings import surfaces
from reference.outlines import outline_map
from reference.planar_maps import windings
from reference.random_curves import FRAME, SEVERAL_IMMERSIONS, glued_disk, random_polygon, small_loops

TRIANGLES_IN_A_POINT = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
ON_A_CUT = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]
ON_A_NECK = [(0, 0), (1, 0), (1, 1), (3, 1), (3, 0), (4, 0), (4, 1), (3, 1), (1, 1), (0, 1)]
CUSP_ON_AN_EDGE = [(3, 4), (1, 2), (4, 4), (2, 4), (3, 3)]


class TestKnownAnswers:
    @pytest.mark.parametrize(
        ("polygon", "expected"),
        [
            ([(0, 0), (2, 0), (2, 2), (0, 2)], (1, 1)),
            (TRIANGLES_IN_A_POINT, (0, 1)),
            (ON_A_CUT, (1, 1)),
            (ON_A_NECK, (0, 1)),
            ([(0, 0), (2, 2), (2, 0), (0, 2)], (0, 0)),  # no disk
            ([(11, 7), (8, 4), (3, 0), (11, 2), (11, 12), (2, 4), (11, 9)], (0, 1)),  # a disk for s → 0 alone
            ([(0, 2), (2, 0), (1, 2), (0, 2), (2, 1)], (1, 1)),  # without its spike
            *((polygon, (2, 2)) for polygon, *_ in SEVERAL_IMMERSIONS[:2]),
        ],
    )
    def test_polygons(self, polygon, expected):
        assert answer(polygon) == answer(polygon[::-1]) == expected

    def test_nothing_but_spikes(self):
        assert answer([(0, 0), (2, 0), (2, 3), (5, 1), (2, 3), (2, 0)]) is None
        assert without_spikes(exact([(0, 0), (4, 0), (2, 0), (6, 0), (6, 6)])) == exact(
            [(0, 0), (2, 0), (6, 0), (6, 6)]
        )

    def test_cusps(self):
        for loops, cusps in either_direction([exact(CUSP_ON_AN_EDGE)], [[1, 0, 0, 0, 0]]):
            if may_bound(loops, cusps):
                loops, cusps = with_vertices_at_cusps(loops, cusps)  # noqa: PLW2901
                rng = np.random.default_rng(0)
                assert bool(count_outward(rng, loops, cusps)) == any(moves_that_bound(rng, loops, 100, cusps))
                break
        else:
            raise AssertionError("it turns once too often for a disk")

    def test_two_loops_may_touch_like_one(self):
        square, hole = exact([(0, 0), (4, 0), (4, 4), (0, 4)]), exact([(0, 0), (1, 2), (2, 1)])
        rng = np.random.default_rng(0)
        assert (count_strict([square, hole]), count_outward(rng, [square, hole])) == (0, 1)
        beside = exact([(4, 1), (6, 1), (4, 3)])
        assert (count_strict([square, beside]), count_outward(rng, [square, beside])) == (1, 1)
        assert count_strict([square, square]) == count_outward(rng, [square, square]) == 1


class TestStrict:
    """Gluing over faces with strands is gluing over cells, where nothing touches."""

    def test_curves(self):
        rng, bound = np.random.default_rng(1), 0
        for i in range(50):
            polygon = random_polygon(rng, 8) if i % 2 else glued_disk(rng, 8)
            for points in (polygon, polygon[::-1]):
                code = crossings(points).code
                expected = len(list(gluings.families(code))) if min(windings(code)) >= 0 else 0
                assert count_strict([exact(points)]) == expected
                bound += expected > 0
        assert bound > 10

    def test_loops_and_cusps(self):
        rng, compared, bound = np.random.default_rng(2), 0, 0
        while compared < 40:
            loops = [*small_loops(rng, 5), FRAME]
            cusps = [[int(rng.random() < 0.1) for _ in loop] for loop in loops]
            try:
                code = outline_code(loops, cusps)
            except DegenerateError:
                continue
            if set(outline_map(code).winding) <= {0, 1, 2, 3}:
                expected = len(surfaces(code))
                assert count_strict([exact(loop) for loop in loops], cusps) == expected
                compared += 1
                bound += expected > 0
        assert bound > 10


class TestSmallness:
    def test_halving_changes_nothing(self):
        rng = np.random.default_rng(3)
        for _ in range(40):
            loops = [exact(random_polygon(rng, 7, size=2))]
            move = any_move(rng, loops)
            codes = []
            for halvings in (0, 1, 2, 10, 1000):
                try:
                    codes.append(crossings_between(moved(loops, move, halvings)[0]))
                except DegenerateError as error:
                    codes.append(len(error.places))
            assert all(code.code == codes[0].code for code in codes if not isinstance(code, int))
            assert len({isinstance(code, int) for code in codes}) == 1

    def test_a_size_that_looks_small_may_be_large(self):
        """A move that has one map at half and at a quarter of its size, no disk, and is one for s → 0."""
        loops = [exact([(11, 7), (8, 4), (3, 0), (11, 2), (11, 12), (2, 4), (11, 9)])]
        still = [(0 * x, 0 * y) for x, y in loops[0]]
        move = [[*exact([(-2, 7)]), *still[1:6], *exact([(-1, -3)])]]
        assert count_moved(loops, move) == 1
        for size in (1 / 2, 1 / 4):
            points = [(x + size * dx, y + size * dy) for (x, y), (dx, dy) in zip(loops[0], move[0], strict=True)]
            assert not list(gluings.families(crossings(points).code))


def judge_theorem(rng, loops, tries, cusps=()):
    """Outward moves tell the limits, inward ones what is strict; return both counts."""
    move = outward_move(rng, loops, cusps)
    strict, outward = count_strict(loops, cusps), count_moved(loops, move, cusps)
    assert count_moved(loops, opposite(move), cusps) in (strict, None)
    assert count_moved(loops, outward_move(rng, loops, cusps), cusps) in (outward, None)
    assert outward or not any(moves_that_bound(rng, loops, tries, cusps))
    assert outward is None or strict <= outward
    return strict, outward


def judge_polygon(polygon, tries):
    """The answers about a polygon that may bound a disk, None about others."""
    loop = without_spikes(exact(polygon))
    for loops, _ in either_direction([loop]) if loop else ():
        if may_bound(loops):
            return judge_theorem(np.random.default_rng(0), loops, tries)
    return None


def judged_with_cusps(seeds, tries):
    """The answers about outlines with a cusp or two in different places."""
    for seed in seeds:
        polygon, index = random_touching_with_cusps(rng := np.random.default_rng(seed), 1 + (seed % 4 == 0))
        loops, cusps = with_vertices_at_cusps([exact(polygon)], [index])
        places = [p for p, m in zip(loops[0], cusps[0], strict=True) if m]
        if may_bound(loops, cusps) and contacts(loops) and len(set(places)) == len(places):
            yield judge_theorem(rng, loops, tries, cusps)


class TestTheorem:
    def test_random_polygons(self):
        found = [judge_polygon(random_touching(np.random.default_rng(seed)), tries=10) for seed in range(60)]
        assert sum(answers == (0, 1) for answers in found) > 10
        assert sum(answers == (1, 1) for answers in found) > 2

    def test_cusps(self):
        found = list(judged_with_cusps(range(20), tries=5))
        assert {(0, 0), (0, 1)} < set(found)

    @pytest.mark.slow
    def test_all_pentagons_on_the_smallest_grid(self):
        grid = list(product(range(3), repeat=2))
        for p, q, r in product(grid, repeat=3):
            for first in ((0, 0), (1, 0), (1, 1)):  # every place looks like one of these from some side
                for last in grid:
                    judge_polygon([first, p, q, r, last], tries=20)

    @pytest.mark.slow
    def test_more_random_polygons(self):
        for seed in range(1_000, 2_000):
            judge_polygon(random_touching(np.random.default_rng(seed)), tries=60)
            judge_polygon(random_touching(np.random.default_rng(seed), most=14), tries=10)

    @pytest.mark.slow
    def test_more_cusps(self):
        assert len(set(judged_with_cusps(range(1_000, 2_000), tries=30))) > 3


def test_answers_belong_to_the_drawing():
    for seed in range(6):
        polygon = random_touching(np.random.default_rng(seed), most=7)
        expected = answer(polygon)
        for changed in (*positions(polygon), *starts(polygon)):
            assert answer(changed) == expected
