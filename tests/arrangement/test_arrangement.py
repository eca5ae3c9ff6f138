"""The arrangement's own interface: borders, outlines, points in cells, codes in and out, errors."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.arrangement.polylines import winding_number
from plyfold.errors import GaussCodeError, PlyfoldError
from reference.random_curves import ribbon_outline

NAMES = list(CURVES)


@pytest.mark.parametrize("name", NAMES)
def test_borders_in_order_draw_the_curve(name):
    drawn = pf.arrange(CURVES[name].curve)
    borders = [drawn.border_points(border) for border in range(drawn.n_borders)]
    length = sum(np.hypot(*np.diff(points, axis=0).T).sum() for points in borders)
    closing = 0.0 if drawn.n_crossings else np.hypot(*(borders[0][0] - borders[0][-1]))
    assert length + closing == pytest.approx(shapely.LinearRing(drawn.curve.points).length, rel=1e-12)
    visited = {tuple(p) for points in borders for p in points.tolist()}
    assert {tuple(p) for p in drawn.curve.points.tolist()} <= visited


@pytest.mark.parametrize("name", NAMES)
def test_cells_are_those_of_geos(name):
    drawn = pf.arrange(CURVES[name].curve)
    ours = sorted(shapely.Polygon(drawn.cell_outline(cell)).area for cell in range(1, drawn.n_cells))
    noded = shapely.unary_union(shapely.LinearRing(drawn.curve.points))
    theirs = sorted(polygon.area for polygon in shapely.polygonize([noded]).geoms)
    assert ours == pytest.approx(theirs, rel=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_areas_weighted_by_winding_are_the_signed_area(name):
    drawn = pf.arrange(CURVES[name].curve)
    weighted = sum(
        int(drawn.winding[cell]) * shapely.Polygon(drawn.cell_outline(cell)).area for cell in range(1, drawn.n_cells)
    )
    x, y = drawn.curve.points.T
    assert weighted == pytest.approx((x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_points_of_cells_lie_in_them(name):
    drawn = pf.arrange(CURVES[name].curve)
    for cell in range(drawn.n_cells):
        assert winding_number(drawn.curve.points, drawn.cell_point(cell)) == drawn.winding[cell]


def test_a_sliver_without_any_double_inside_still_has_a_place():
    thin = np.nextafter(0.0, 1.0)
    drawn = pf.arrange([(0, 0), (1, 0), (0.5, thin)])
    x, y = drawn.cell_point(1)
    assert 0 <= x <= 1
    assert 0 <= y <= thin


@pytest.mark.parametrize("name", NAMES)
def test_codes_come_back(name):
    drawn = pf.arrange(CURVES[name].curve)
    again = pf.Arrangement.from_gauss(*drawn.gauss_code())
    again.check()
    assert again.gauss_code() == drawn.gauss_code()
    assert np.array_equal(again.cell_of_dart, drawn.cell_of_dart)
    assert np.array_equal(again.winding, drawn.winding)
    assert pf.count_immersions(again) == CURVES[name].immersions


def test_clockwise_curves_are_turned_round_and_say_so():
    clockwise = pf.arrange([(0, 0), (0, 1), (1, 0)])
    assert clockwise.reversed
    assert clockwise.turning_number == 1
    assert clockwise.curve.points[0].tolist() == [0, 0]
    assert not pf.arrange([(0, 0), (1, 0), (0, 1)]).reversed


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
    drawn = pf.arrange([(0, 0), (1, 0), (0, 1)])
    with pytest.raises(ValueError, match="read-only"):
        drawn.winding[0] = 5


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32))
def test_random_polygons_check(seed):
    points = np.random.default_rng(seed).normal(size=(30, 2))
    drawn = pf.arrange(points)
    drawn.check()
    for cell in range(0, drawn.n_cells, 7):
        assert winding_number(points if not drawn.reversed else points[::-1], drawn.cell_point(cell)) in {
            int(drawn.winding[cell]),
            None,
        }


@pytest.mark.parametrize("name", NAMES)
def test_boundaries_as_arrays(name):
    drawn = pf.arrange(CURVES[name].curve)
    assert sorted(drawn.cell_darts.tolist()) == list(range(2 * drawn.n_borders))
    assert len(drawn.cell_start) == drawn.n_cells + 1
    lowest = []
    for cell in range(drawn.n_cells):
        darts = drawn.cell_darts[drawn.cell_start[cell] : drawn.cell_start[cell + 1]].tolist()
        assert drawn.next_dart[darts].tolist() == darts[1:] + darts[:1]
        assert set(drawn.cell_of_dart[darts].tolist()) == {cell}
        assert tuple(darts) == drawn.cells[cell]
        assert darts[0] == min(darts)
        lowest.append(darts[0])
    assert drawn.outer in drawn.cells[0]
    assert lowest[1:] == sorted(lowest[1:])


@pytest.mark.parametrize("name", NAMES)
def test_clockwise_drawings_are_turned_round_alike(name):
    points = pf.arrange(CURVES[name].curve).curve.points
    forward, backward = (
        pf.arrange(way, general_position="raise") for way in (points, np.concatenate([points[:1], points[:0:-1]]))
    )
    assert backward.reversed == (forward.turning_number > 0)
    if backward.reversed:
        assert backward.gauss_code() == forward.gauss_code()
        assert np.array_equal(backward.winding, forward.winding)
        for border in range(forward.n_borders):
            np.testing.assert_allclose(backward.border_points(border), forward.border_points(border), atol=1e-9)


def test_exact_signs_are_counted_and_shown():
    plain = pf.arrange([(0, 0), (4, 0), (4, 3), (1, -1)])
    assert plain.exact_signs == 0
    assert "exact" not in repr(plain)
    middle = 0.1 + (0.7 - 0.1) / 3
    close = pf.arrange([(0.1, 0.1), (0.7, 0.7), (0.7, -1.0), (middle, middle - 2e-16), (0.2, -1.0)])
    assert close.exact_signs > 0
    assert f"{close.exact_signs} exact signs" in repr(close)
    assert pf.Arrangement.from_gauss(*close.gauss_code()).exact_signs == 0


@pytest.mark.parametrize("step", [1, 2, 7])
def test_stars_have_the_known_crossings(step):
    """The star {n/m} has n (m − 1) crossings, and winds m times round its middle."""
    n = 307
    angle = 2 * np.pi * step * np.arange(n) / n
    drawn = pf.arrange(np.stack([np.cos(angle), np.sin(angle)], axis=1))
    assert (drawn.n_crossings, drawn.turning_number, drawn.winding.max()) == (n * (step - 1), step, step)


def test_a_long_ribbon_has_the_cells_of_geos():
    points = np.array(ribbon_outline(np.random.default_rng(8), 4000), dtype=float)
    drawn = pf.arrange(points, general_position="raise")
    drawn.check()
    cells = shapely.polygonize([shapely.unary_union(shapely.LinearRing(points))])
    assert drawn.n_crossings > 4000
    assert drawn.n_cells == len(cells.geoms) + 1


@pytest.mark.slow
@pytest.mark.parametrize("scale", ["vertices", "crossings", "long edges"])
def test_a_million(scale):
    rng = np.random.default_rng(1)
    angle = 2 * np.pi * 1000 / 2001 * np.arange(2001)
    points = {
        "vertices": lambda: np.array(ribbon_outline(rng, 500_000, wildness=0.05), dtype=float),
        "crossings": lambda: rng.normal(size=(1_000_000, 2)).cumsum(axis=0),
        "long edges": lambda: np.stack([np.cos(angle), np.sin(angle)], axis=1),
    }[scale]()
    drawn = pf.arrange(points)
    drawn.check()
    assert max(len(points), drawn.n_crossings) >= 1_000_000
    assert scale != "long edges" or drawn.n_crossings == 2001 * 999
