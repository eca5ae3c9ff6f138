"""The families of the benchmarks are what they are said to be."""

import families
import numpy as np
import pytest
from families import FAMILIES

import plyfold as pf
from reference import crossings, gluings, planar_maps

RIBBONS = ("ribbon", "wild-ribbon", "coil", "chain", "spiral", "band")


def whole(points):
    return [(int(x), int(y)) for x, y in points]


def left_turn(p, q, r):
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0


@pytest.mark.parametrize("name", FAMILIES)
class TestEveryFamily:
    def test_size_and_seed(self, name):
        draw = FAMILIES[name].draw
        for vertices in (400, 1_000):
            points = draw(vertices, 0)
            assert points.shape == (vertices, 2)
            assert np.array_equal(points, np.round(points))
            assert np.array_equal(points, draw(vertices, 0))
            assert not np.array_equal(points, draw(vertices, 1))

    def test_verdict(self, name):
        assert pf.bounds_disk(FAMILIES[name].draw(300, 0)) == FAMILIES[name].disk

    def test_sizes_are_even_and_grow(self, name):
        sizes = FAMILIES[name].sizes
        assert list(sizes) == sorted(set(sizes))
        assert all(size % 2 == 0 for size in sizes)


class TestRibbons:
    @pytest.mark.parametrize("name", RIBBONS)
    @pytest.mark.parametrize("vertices", [400, 20_000])
    def test_strip_of_positive_triangles(self, name, vertices):
        """So it bounds a disk, however it crosses itself."""
        points = whole(FAMILIES[name].draw(vertices, 3))
        for i in range(vertices // 2 - 1):
            strip = [points[i], points[i + 1], points[-2 - i], points[-1 - i]]
            assert left_turn(strip[0], strip[1], strip[2])
            assert left_turn(strip[0], strip[2], strip[3])

    def test_coil_has_the_same_crossings_at_every_size(self):
        assert {pf.arrange(families.coil(n)).n_crossings for n in (400, 1_600, 10_000)} == {48}

    def test_chain_has_four_crossings_per_loop(self):
        for count in (5, 50, 200):
            assert abs(pf.arrange(families.chain(48 * count)).n_crossings - 4 * count) <= 4

    def test_winding_of_a_spiral_grows_as_the_root_of_its_size(self):
        highest = [int(pf.arrange(families.spiral(100 * turns**2)).winding.max()) for turns in (5, 10, 20)]
        assert all(0 <= winding - turns <= 2 for winding, turns in zip(highest, (5, 10, 20), strict=True))

    @pytest.mark.parametrize("turns", [2, 6, 24])
    def test_band_has_two_crossings_for_each_turn(self, turns):
        drawn = pf.arrange(families.band(120 * turns))
        assert drawn.n_crossings == 2 * turns - 2
        assert drawn.winding.max() == turns


class TestGluedDisks:
    @pytest.mark.parametrize("seed", range(20))
    def test_bounds_a_disk_says_the_reference(self, seed):
        found = crossings.crossings(whole(families.glued_disk(30, seed)))
        assert gluings.keys(*found.code)

    def test_windings_pile_up(self):
        assert pf.arrange(families.glued_disk(2_000)).winding.max() >= 20
        piled = pf.arrange(families.glued_disk(800, pull=0.8))
        assert piled.winding.max() >= 40
        assert piled.n_crossings >= 10_000


class TestKinked:
    @pytest.mark.parametrize("why", ["turning number", "negative winding", "no grouping"])
    def test_says_why(self, why):
        assert {pf.find_immersion(families.kinked(300, seed, why)).reason for seed in range(5)} == {why}

    def test_no_disk_says_the_reference(self):
        codes = [crossings.crossings(whole(families.kinked(90, seed))).code for seed in (0, 4)]
        assert all(planar_maps.may_bound_disk(code) for code in codes)
        assert not any(gluings.keys(*code) for code in codes)

    def test_needs_a_ribbon_that_lies_on_itself(self):
        with pytest.raises(ValueError, match="does not lie on itself"):
            families.kinked(20)
