"""The references of outlines: three ways to count surfaces with cusps, two for levels, and known answers."""

from math import factorial, prod

import numpy as np
import pytest

from reference import crossings, gluings
from reference.crossings import DegenerateError
from reference.loops import level_solutions as levels_by_borders
from reference.loops import loop_borders
from reference.outline_drawings import outline_code
from reference.outline_gluings import count_by_labels, key_of, pieces, surfaces
from reference.outline_levels import layerings, level_solutions, levels_by_gluings
from reference.outlines import of_gauss, outline_map, to_gauss, with_curls, with_cusps
from reference.planar_maps import border_count, gauss_code, nonnegative_curves, windings
from reference.random_curves import FRAME, small_loops

HANDLE = gauss_code([1, 0, 3, 2, 5, 4, 7, 6], [1, 0] * 4, 13)
"""The smallest curve that bounds a disk with a handle."""
HANDLE_THAT_CUTS_ITSELF = gauss_code([3, 2, 1, 0, 5, 4, 9, 8, 7, 6, 11, 10], [1, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0], 15)
"""One of the two smallest that bound one, and only such as cut themselves in space."""
LIMACON = gauss_code([1, 0], [True, False], 1)

BIG = [(0, 0), (90, 0), (0, 90)]
INSIDE = [(5, 5), (25, 6), (6, 25)]
HOLE = [(20, 20), (20, 30), (30, 21)]


def count_of_curls(code, sites):
    """The surfaces of the curve with its cusps drawn out, by the reference for curves."""
    curled = to_gauss(with_curls(code, sites))
    return len(list(gluings.families(curled))) if min(windings(curled)) >= 0 else 0


def assert_three_ways_agree(code, sites):
    """Sheets round the cusps, curls, and all orders of sheets against all levels; return the number of surfaces."""
    cusped = with_cusps(code, sites)
    found = surfaces(cusped)
    assert len(found) == count_of_curls(code, sites)
    assert_levels_agree(cusped, found)
    return len(found)


def assert_levels_agree(code, found):
    """Levels by their rules, by increasing gluings, and by all orders of sheets over all surfaces."""
    levels = sorted(level_solutions(code))
    assert levels == sorted(levels_by_gluings(code))
    assert levels == sorted(level for surface in found for level in layerings(code, *surface))


class TestPlaneCurves:
    @pytest.mark.parametrize("k", range(5))
    def test_without_cusps_as_by_the_reference_for_curves(self, k):
        for code in nonnegative_curves(k):
            assert len(surfaces(of_gauss(code))) == len(list(gluings.families(code)))

    @pytest.mark.parametrize(("k", "expected"), [(0, 0), (1, 1), (2, 1), (3, 14), (4, 26)])
    def test_a_cusp_on_each_border(self, k, expected):
        sites = [
            (code, border, m) for code in nonnegative_curves(k) for border in range(border_count(code)) for m in (1, 2)
        ]
        found = [assert_three_ways_agree(of_gauss(code), [(border, m)]) for code, border, m in sites]
        assert sum(map(bool, found)) == expected

    @pytest.mark.slow
    def test_a_cusp_on_each_border_of_curves_with_five_crossings(self):
        for code in nonnegative_curves(5):
            for border in range(border_count(code)):
                for m in (1, 2, 3):
                    assert_three_ways_agree(of_gauss(code), [(border, m)])

    def test_pairs_of_cusps(self):
        rng, bound = np.random.default_rng(9), 0
        every = [code for k in (2, 3, 4) for code in nonnegative_curves(k)]
        for _ in range(600):
            code = every[rng.integers(len(every))]
            sites = [(int(rng.integers(border_count(code))), int(rng.integers(1, 3))) for _ in range(2)]
            bound += bool(assert_three_ways_agree(of_gauss(code), sites))
        assert bound > 20

    def test_cusps_in_a_row_are_not_one_of_higher_index(self):
        """Two of index 1 on one border may climb and fall; one of index 2 goes up or down by two levels."""
        sites = [(of_gauss(code), border) for k in (2, 3) for code in nonnegative_curves(k) for border in range(2 * k)]
        differ = [
            len(surfaces(with_cusps(code, [(border, 1)] * 2))) != len(surfaces(with_cusps(code, [(border, 2)])))
            for code, border in sites
        ]
        assert any(differ)

    def test_labels_divided_by_their_number(self):
        rng, bound = np.random.default_rng(4), 0
        for _ in range(150):
            code = (every := nonnegative_curves(int(rng.integers(1, 4))))[rng.integers(len(every))]
            cusped = with_cusps(of_gauss(code), [(int(rng.integers(border_count(code))), 1)])
            if prod(map(factorial, outline_map(cusped).winding)) <= 24:
                bound += bool(count := len(surfaces(cusped)))
                assert count_by_labels(cusped) == count
        assert bound > 5


class TestKnownAnswers:
    def test_disk_with_a_handle(self):
        (only,) = surfaces(of_gauss(HANDLE))
        assert pieces(of_gauss(HANDLE), *only) == [((0,), -1)]
        assert len(level_solutions(of_gauss(HANDLE))) == 2

    def test_disks_with_a_handle_none_of_which_lifts(self):
        code = of_gauss(HANDLE_THAT_CUTS_ITSELF)
        assert (len(surfaces(code)), level_solutions(code)) == (3, [])

    def test_limacon_with_a_cusp_on_its_inner_border(self):
        code = of_gauss(LIMACON)
        assert [len(surfaces(with_cusps(code, [(border, 1)]))) for border in range(2)] == [0, 1]
        assert len(level_solutions(with_cusps(code, [(1, 1)]))) == 2
        assert not surfaces(code)

    def test_loops_inside_others(self):
        assert len(level_solutions(outline_code([BIG, INSIDE]))) == 2
        twice = outline_code([BIG, [(1, 2), (93, 3), (2, 91)], HOLE])
        found = surfaces(twice)
        assert len(found) == count_by_labels(twice) == 2
        assert sorted(pieces(twice, *surface) for surface in found) == [
            [((0,), 1), ((1, 2), 0)],
            [((0, 2), 0), ((1,), 1)],
        ]
        ring = outline_code([BIG, HOLE])
        assert [pieces(ring, *surface) for surface in surfaces(ring)] == [[((0, 1), 0)]]


def drawings(seed, count, most=4):
    """Loops and their codes, without negative winding numbers."""
    rng, found = np.random.default_rng(seed), 0
    while found < count:
        loops = [*small_loops(rng, 5), *([FRAME] if rng.random() < 0.8 else [])]
        try:
            code = outline_code(loops)
            turns = sum(map(crossings.turning_number, loops))
        except DegenerateError:
            continue
        winding = outline_map(code).winding
        if min(winding) >= 0 and max(winding) <= most and len(code.partner) <= 24:
            found += 1
            yield loops, code, turns


class TestDrawings:
    def test_pieces_levels_and_keys(self):
        """The Euler characteristic is the turning number; levels also by the older reference."""
        several = 0
        for loops, code, turns in drawings(1, 80):
            found = surfaces(code)
            assert_levels_agree(code, found)
            assert len(level_solutions(code)) == len(list(levels_by_borders(loop_borders(loops))))
            assert len({key_of(code, *surface) for surface in found}) == len(found)
            for surface in found:
                parts = pieces(code, *surface)
                assert sum(euler for _, euler in parts) == turns
                assert all(2 - len(own) - euler >= 0 and (len(own) + euler) % 2 == 0 for own, euler in parts)
                several += len(parts) > 1
        assert several > 5

    def test_cusps_and_curls(self):
        rng, bound = np.random.default_rng(3), 0
        for _, code, turns in drawings(2, 80, most=3):
            for border in range(outline_map(code).n_borders):
                sites = [(border, int(rng.integers(1, 3)))]
                cusped, curled = with_cusps(code, sites), with_curls(code, sites)
                found = surfaces(cusped)
                assert len(found) == len(surfaces(curled))
                assert len(level_solutions(cusped)) == len(level_solutions(curled))
                assert_levels_agree(cusped, found)
                for surface in found:
                    assert sum(euler for _, euler in pieces(cusped, *surface)) == turns - sum(cusped.index)
                bound += bool(found)
        assert bound > 20

    def test_labels_divided_by_their_number(self):
        compared = 0
        for _, code, _ in drawings(4, 60, most=2):
            if prod(map(factorial, outline_map(code).winding)) <= 64:
                assert count_by_labels(code) == len(surfaces(code))
                compared += 1
        assert compared > 20

    def test_cusps_at_vertices_are_cusps_on_their_borders(self):
        for loops, code, _ in drawings(6, 40, most=3):
            marks = [[0] * len(loop) for loop in loops]
            marks[-1][2] = 1
            cusped = outline_code(loops, marks)
            assert cusped.index.count(1) == sum(cusped.index) == 1
            on_borders = [with_cusps(code, [(border, 1)]) for border in range(outline_map(code).n_borders)]
            assert len(surfaces(cusped)) in {len(surfaces(other)) for other in on_borders}


class TestKeys:
    def test_numbers_of_sheets_and_the_order_of_rows_do_not_matter(self):
        rng, seen = np.random.default_rng(8), 0
        for _, code, _ in drawings(5, 30):
            for own, rows in surfaces(code):
                name = rng.permutation(200)
                other = [(edge, name[right], name[left]) for edge, right, left in rows]
                shuffled = [other[i] for i in rng.permutation(len(other))]
                assert key_of(code, name[list(own)], shuffled) == key_of(code, own, rows)
                seen += 1
        assert seen > 10

    def test_what_is_no_surface_is_refused(self):
        code = with_cusps(of_gauss(LIMACON), [(1, 1)])
        ((own, rows),) = surfaces(code)
        for wrong in ((own, rows[1:]), (own[::-1], rows), (own, [*rows, rows[0]])):
            with pytest.raises(ValueError, match="not a surface"):
                key_of(code, *wrong)
        with pytest.raises(ValueError, match="around a vertex"):
            key_of(with_cusps(of_gauss(LIMACON), [(1, 0)]), own, rows)
