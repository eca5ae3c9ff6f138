"""The arrangement's own interface: borders, outlines, points in cells, codes in and out, errors."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement import winding_number
from plyfold.errors import GaussCodeError, PlyfoldError
from plyfold.gallery import CURVES

NAMES = list(CURVES)


@pytest.mark.parametrize("name", NAMES)
def test_borders_in_order_draw_the_curve(name):
    drawn = pf.arrangement(CURVES[name].curve)
    borders = [drawn.border_points(border) for border in range(drawn.n_borders)]
    length = sum(np.hypot(*np.diff(points, axis=0).T).sum() for points in borders)
    closing = 0.0 if drawn.n_crossings else np.hypot(*(borders[0][0] - borders[0][-1]))
    assert length + closing == pytest.approx(shapely.LinearRing(drawn.curve.points).length, rel=1e-12)
    visited = {tuple(p) for points in borders for p in points.tolist()}
    assert {tuple(p) for p in drawn.curve.points.tolist()} <= visited


@pytest.mark.parametrize("name", NAMES)
def test_cells_are_those_of_geos(name):
    drawn = pf.arrangement(CURVES[name].curve)
    ours = sorted(shapely.Polygon(drawn.cell_outline(cell)).area for cell in range(1, drawn.n_cells))
    noded = shapely.unary_union(shapely.LinearRing(drawn.curve.points))
    theirs = sorted(polygon.area for polygon in shapely.polygonize([noded]).geoms)
    assert ours == pytest.approx(theirs, rel=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_areas_weighted_by_winding_are_the_signed_area(name):
    drawn = pf.arrangement(CURVES[name].curve)
    weighted = sum(
        int(drawn.winding[cell]) * shapely.Polygon(drawn.cell_outline(cell)).area for cell in range(1, drawn.n_cells)
    )
    x, y = drawn.curve.points.T
    assert weighted == pytest.approx((x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_points_of_cells_lie_in_them(name):
    drawn = pf.arrangement(CURVES[name].curve)
    for cell in range(drawn.n_cells):
        assert winding_number(drawn.curve.points, drawn.cell_point(cell)) == drawn.winding[cell]


def test_a_sliver_without_any_double_inside_still_has_a_place():
    thin = np.nextafter(0.0, 1.0)
    drawn = pf.arrangement([(0, 0), (1, 0), (0.5, thin)])
    x, y = drawn.cell_point(1)
    assert 0 <= x <= 1
    assert 0 <= y <= thin


@pytest.mark.parametrize("name", NAMES)
def test_codes_come_back(name):
    drawn = pf.arrangement(CURVES[name].curve)
    again = pf.Arrangement.from_gauss(*drawn.gauss_code())
    again.check()
    assert again.gauss_code() == drawn.gauss_code()
    assert np.array_equal(again.cell_of_dart, drawn.cell_of_dart)
    assert np.array_equal(again.winding, drawn.winding)
    assert pf.count_immersions(again) == CURVES[name].immersions


def test_clockwise_curves_are_turned_round_and_say_so():
    clockwise = pf.arrangement([(0, 0), (0, 1), (1, 0)])
    assert clockwise.reversed
    assert clockwise.turning_number == 1
    assert clockwise.curve.points[0].tolist() == [0, 0]
    assert not pf.arrangement([(0, 0), (1, 0), (0, 1)]).reversed


@pytest.mark.parametrize(
    ("code", "complaint"),
    [
        (([1, 0], [True], 0), "partner has 2"),
        (([1, 2, 0], [True, False, True], 0), "not each other's partner"),
        (([0, 1], [True, False], 0), "not each other's partner"),
        (([1, 0], [True, True], 0), "same side"),
        (([1, 0], [True, False], 4), "does not exist"),
        (([1.5, 0], [True, False], 0), "whole numbers"),
        ((None, [True, False], 0), "whole numbers"),
        (("ab", "cd", 0), "whole numbers"),
        (([1, 0], [2, 0], 0), "neither true nor false"),
        (([2, 3, 0, 1], [True, False, False, True], 0), "cells"),
        (([2, 3, 0, 1], [True, True, False, False], 0), "cells"),
    ],
)
def test_codes_of_no_plane_curve_are_refused(code, complaint):
    with pytest.raises(GaussCodeError, match=complaint):
        pf.Arrangement.from_gauss(*code)


def test_a_code_alone_has_no_points():
    code = pf.Arrangement.from_gauss([1, 0], [True, False], 1)
    with pytest.raises(PlyfoldError, match="without a drawing"):
        code.border_points(0)
    with pytest.raises(PlyfoldError, match="Gauss code alone"):
        pf.lift(pf.Arrangement.from_gauss([], [], 1))


def test_arrangements_cannot_be_changed():
    drawn = pf.arrangement([(0, 0), (1, 0), (0, 1)])
    with pytest.raises(ValueError, match="read-only"):
        drawn.winding[0] = 5


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32))
def test_random_polygons_check(seed):
    points = np.random.default_rng(seed).normal(size=(30, 2))
    drawn = pf.arrangement(points)
    drawn.check()
    for cell in range(0, drawn.n_cells, 7):
        assert winding_number(points if not drawn.reversed else points[::-1], drawn.cell_point(cell)) in {
            int(drawn.winding[cell]),
            None,
        }
