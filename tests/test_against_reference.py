"""The library against slow code written from the definitions: every curve with few crossings, and random curves."""

import numpy as np
import pytest

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.errors import CurveError, GeneralPositionError
from plyfold.immersion.solve import count_immersions, find_immersion, immersions
from plyfold.immersion.verdict import bounds_disk
from plyfold.layering.orders.search import find_layering
from reference import crossings, gluings, layerings, outline_gluings, outline_levels, planar_maps, random_curves
from reference.outlines import of_gauss
from reference.planar_maps import census, gauss_code, may_bound_disk, oriented, plane_codes, windings

SMALLEST_WITHOUT_LAYERING = [
    ([9, 4, 3, 2, 1, 10, 7, 6, 11, 0, 5, 8, 13, 12, 15, 14], [1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0], 5),
    ([1, 0, 3, 2, 7, 14, 11, 4, 9, 8, 15, 6, 13, 12, 5, 10], [1, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0], 25),
    ([1, 0, 3, 2, 7, 10, 15, 4, 9, 8, 5, 14, 13, 12, 11, 6], [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 0, 0], 25),
    ([1, 0, 5, 14, 11, 2, 9, 8, 7, 6, 15, 4, 13, 12, 3, 10], [1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0], 25),
    ([1, 0, 5, 10, 15, 2, 9, 8, 7, 6, 3, 14, 13, 12, 11, 4], [1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0], 25),
]
"""The four curves with eight crossings of which one immersion has no layering; one of them twice, also as published."""


def code_of(arranged):
    return gauss_code(arranged.partner, arranged.ccw, arranged.outer)


def key_of(immersion):
    code = code_of(immersion.arrangement)
    if immersion.is_disk:
        return gluings.key_of(*code, immersion.own_sheet, immersion.gluing)
    return outline_gluings.key_of(of_gauss(code), immersion.own_sheet, immersion.gluing)


def directed(code):
    """The curve turned round if that makes winding numbers positive; if none does, to a positive turning number."""
    low, high = min(windings(code)), max(windings(code))
    if low < 0 < high:
        return oriented(code)
    return planar_maps.reversed_code(code) if low < 0 else code


def assert_same_map(arranged, code):
    """Same Gauss code and outer cell, cells, winding numbers and turning number; cells may be numbered otherwise."""
    assert planar_maps.with_smallest_outer_dart(code_of(arranged)) == planar_maps.with_smallest_outer_dart(code)
    assert arranged.turning_number == planar_maps.turning_number(code)
    expected = [windings(code)[cell] for cell in planar_maps.cell_of_dart(code)]
    assert arranged.winding[arranged.cell_of_dart].tolist() == expected
    assert set(map(frozenset, arranged.cells)) == set(map(frozenset, planar_maps.cells(code.partner, code.ccw)))
    assert all(arranged.cell_of_dart[dart] == cell for cell, darts in enumerate(arranged.cells) for dart in darts)
    assert arranged.cell_of_dart[arranged.outer] == 0


def expected_keys(arranged):
    """The immersions by the reference for disks, or else by that for all outlines: disks with handles."""
    code = code_of(arranged)
    if arranged.turning_number == 1:
        return gluings.keys(*code)
    if min(windings(code)) < 0:
        return set()
    outline = of_gauss(code)
    return {outline_gluings.key_of(outline, *surface) for surface in outline_gluings.surfaces(outline)}


def assert_same_immersions(arranged):
    """Decision, count and set of immersions are those of the reference, which works on the same Gauss code."""
    expected = expected_keys(arranged)
    found = list(immersions(arranged))
    assert {key_of(immersion) for immersion in found} == expected
    assert count_immersions(arranged) == len(found) == len(expected)
    assert bounds_disk(arranged) == (arranged.turning_number == 1 and bool(expected))
    first = find_immersion(arranged)
    assert bool(first) == bool(expected)
    assert not expected or key_of(first) in expected
    return found


def assert_right_layering(immersion):
    """There is a layering if and only if brute force finds one, and it is one of those."""
    code = code_of(immersion.arrangement)
    rows = [tuple(int(value) for value in row) for row in immersion.gluing]
    found = find_layering(immersion)
    if not immersion.is_disk:
        expected = outline_levels.layerings(of_gauss(code), immersion.own_sheet.tolist(), rows)
        assert not found or tuple(found.border_level.tolist()) in expected
        assert bool(found) == bool(expected)
        return bool(found)
    expected = layerings.layerings(*code, immersion.own_sheet.tolist(), rows)
    assert bool(found) == bool(expected)
    if found:
        assert dict(enumerate(found.level.tolist())) in expected
    return bool(found)


def judge(curve):
    """Compare everything about one curve; returns which of its immersions have a layering."""
    return [assert_right_layering(immersion) for immersion in assert_same_immersions(arrange(curve))]


class TestEveryCurve:
    @pytest.mark.parametrize("k", [0, 1, 2, 3, 4, 5, pytest.param(6, marks=pytest.mark.slow)])
    def test_arrangement(self, k):
        for code in census(k):
            assert_same_map(Arrangement.from_gauss(*code), directed(code))

    @pytest.mark.parametrize("k", [0, 1, 2, 3, 4, 5, pytest.param(6, marks=pytest.mark.slow)])
    def test_immersions_and_layerings(self, k):
        for code in census(k):
            judge(Arrangement.from_gauss(*code))

    def test_the_246_curves_with_six_crossings_that_pass_the_cheap_conditions(self):
        verdicts = [judge(Arrangement.from_gauss(*code)) for code in census(6) if may_bound_disk(code)]
        assert sum(map(bool, verdicts)) == 86
        assert sorted(map(len, verdicts))[-3:] == [1, 2, 2]

    @pytest.mark.parametrize("k", [2, 3, pytest.param(4, marks=pytest.mark.slow)])
    def test_every_start_direction_and_mirror_image(self, k):
        for code in plane_codes(k):
            arranged = Arrangement.from_gauss(*code)
            used = directed(code)
            assert arranged.reversed == (used != code)
            assert_same_map(arranged, used)
            judge(arranged)


class TestSeveralImmersions:
    @pytest.mark.parametrize(("polygon", "k", "layering_counts"), random_curves.SEVERAL_IMMERSIONS)
    def test_known_polygons(self, polygon, k, layering_counts):
        assert arrange(polygon).n_crossings == k
        assert sorted(judge(polygon)) == [count > 0 for count in layering_counts]

    @pytest.mark.parametrize("code", SMALLEST_WITHOUT_LAYERING)
    def test_smallest_curves_with_an_immersion_without_layering(self, code):
        assert sorted(judge(Arrangement.from_gauss(*code))) == [False, True]


POLYGONS = {
    "random polygons": lambda rng: random_curves.random_polygon(rng, int(rng.integers(3, 11))),
    "smooth curves": lambda rng: random_curves.smooth_curve(rng, int(rng.integers(1, 7)), 40),
    "ribbons": lambda rng: random_curves.ribbon_outline(rng, int(rng.integers(1, 25))),
    "glued disks": lambda rng: random_curves.glued_disk(rng, int(rng.integers(1, 30))),
}


def polygons(name, count):
    rng = np.random.default_rng(sum(map(ord, name)))
    return [POLYGONS[name](rng) for _ in range(count)]


def turned_inside_out(code):
    """The curve on the sphere with each of its cells as the unbounded one, if it may bound a disk then."""
    variants = [oriented(code._replace(outer=min(darts))) for darts in planar_maps.cells(code.partner, code.ccw)]
    return [variant for variant in variants if may_bound_disk(variant)]


def assert_same_crossings(arranged, polygon):
    """Everything exact is equal, and crossings lie where the fractions say, up to rounding."""
    found = crossings.crossings(polygon)
    assert_same_map(arranged, found.code)
    assert arranged.visit_edge.tolist() == list(found.edges)
    expected = np.array([(float(x), float(y)) for x, y in found.points]).reshape(-1, 2)
    np.testing.assert_allclose(arranged.crossings[arranged.crossing_of_visit], expected, rtol=1e-9, atol=1e-9)
    for cell, winding in enumerate(arranged.winding.tolist()):
        assert crossings.winding_number(polygon, arranged.cell_point(cell)) == winding


class TestRandomCurves:
    @pytest.mark.parametrize("name", POLYGONS)
    def test_arrangement(self, name):
        for polygon in polygons(name, 40):
            arranged = arrange(polygon, general_position="raise")
            turning = crossings.turning_number(polygon)
            assert arranged.reversed == (turning < 0)
            assert arranged.turning_number == abs(turning)
            assert_same_crossings(arranged, crossings.reversed_polygon(polygon) if turning < 0 else polygon)

    @pytest.mark.parametrize("name", POLYGONS)
    def test_immersions_and_layerings(self, name):
        for polygon in polygons(name, 40):
            verdicts = judge(polygon)
            assert verdicts or name not in ("ribbons", "glued disks"), "these bound disks by construction"

    def test_other_cells_of_random_polygons_made_the_outside(self):
        """Many of these pass the cheap conditions and bound no disk; random polygons seldom get that far."""
        rng = np.random.default_rng(11)
        verdicts = [
            judge(Arrangement.from_gauss(*code))
            for _ in range(150)
            for code in turned_inside_out(crossings.crossings(random_curves.random_polygon(rng, 11)).code)
        ]
        assert min(verdicts.count([]), verdicts.count([True])) >= 20

    @pytest.mark.slow
    def test_many_random_disks(self):
        rng = np.random.default_rng(2011)
        for _ in range(1000):
            assert judge(random_curves.glued_disk(rng, int(rng.integers(10, 60))))

    @pytest.mark.parametrize(("points", "step"), [(5, 2), (7, 3), (9, 4)])
    def test_stars_bound_no_disk(self, points, step):
        star = random_curves.star_polygon(points, step)
        assert_same_crossings(arrange(star), star)
        assert find_immersion(star).reason == "turning number"


class TestDegeneratePolygons:
    """Vertices on a small grid: most of these polygons are not in general position."""

    @staticmethod
    def grid_polygons():
        rng = np.random.default_rng(5)
        found = [random_curves.without_repeats(random_curves.random_polygon(rng, 6, 3)) for _ in range(150)]
        return [polygon for polygon in found if is_curve(polygon)]

    def test_general_position_is_decided_exactly(self):
        for polygon in self.grid_polygons():
            assert accepts(arrange, polygon) == accepts(crossings.crossings, polygon), polygon

    def test_repaired_polygons_are_in_general_position(self):
        for polygon in self.grid_polygons():
            arranged = arrange(polygon)
            assert bool(arranged.curve.repairs) != accepts(crossings.crossings, polygon)
            assert_same_crossings(arranged, arranged.curve.points.tolist())


def is_curve(polygon):
    try:
        arrange(polygon)
    except CurveError:
        return False
    return True


def accepts(function, polygon):
    """Whether the polygon is in general position for this implementation."""
    try:
        function(polygon, general_position="raise") if function is arrange else function(polygon)
    except (GeneralPositionError, crossings.DegenerateError):
        return False
    return True
