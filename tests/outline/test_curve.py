from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from plyfold import bounds_disk, fill, winding_at
from plyfold.errors import CurveError, InputError, StrokeError
from plyfold.outline.curve import Curve, Outline, Repair
from plyfold.outline.given import as_curve, as_outline

TRIANGLE = [(0, 0), (4, 0), (0, 3)]
PLACES = st.tuples(st.integers(-3, 3), st.integers(-3, 3))


def collapsed(points):
    """The obvious version: walk round, skip what equals the last kept point, then close."""
    kept = []
    for point in points:
        if not kept or kept[-1] != point:
            kept.append(point)
    while len(kept) > 1 and kept[-1] == kept[0]:
        kept.pop()
    return kept


def all_on_one_line(points):
    (ax, ay), rest = points[0], points[1:]
    directions = [(x - ax, y - ay) for x, y in rest if (x, y) != (ax, ay)]
    return all(dx * directions[0][1] == dy * directions[0][0] for dx, dy in directions)


def test_points_are_a_read_only_copy_in_double_precision():
    given_points = np.array([[0, 0], [4, 0], [0, 3]])
    curve = Curve(given_points)
    given_points[0] = 9
    assert curve.points.dtype == np.float64
    assert curve.points.tolist() == [[0, 0], [4, 0], [0, 3]]
    assert len(curve) == 3
    assert curve.repairs == ()
    with pytest.raises(ValueError, match="read-only"):
        curve.points[0, 0] = 1
    with pytest.raises(AttributeError):
        curve.points = given_points


def test_curves_are_compared_by_identity_and_can_be_keys():
    first, second = Curve(TRIANGLE), Curve(TRIANGLE)
    assert first != second
    assert len({first, second, first}) == 2


def test_explicit_closing_point_is_dropped_silently():
    curve = Curve([*TRIANGLE, TRIANGLE[0]])
    assert curve.points.tolist() == Curve(TRIANGLE).points.tolist()
    assert curve.repairs == ()


def test_repeated_points_are_dropped_and_recorded_also_around_the_end():
    curve = Curve([(0, 0), (0, 0), (4, 0), (0, 3), (0, 3), (0, 3), (0, 0), (0, 0)])
    assert curve.points.tolist() == [[0, 0], [4, 0], [0, 3]]
    assert curve.repairs == (
        Repair("repeated point dropped", (0, 0), 0),
        Repair("repeated point dropped", (0, 3), 0),
    )


def test_given_repairs_come_first():
    before = Repair("gap bridged", (1, 1), 0.5)
    assert Curve([(0, 0), *TRIANGLE], [before]).repairs[0] is before


@given(st.lists(PLACES, min_size=1, max_size=12))
def test_random_lists_of_small_integers(points):
    expected = collapsed(points)
    if len(set(expected)) < 3 or all_on_one_line(expected):
        with pytest.raises(CurveError) as caught:
            Curve(points)
        assert caught.value.hint
    else:
        assert Curve(points).points.tolist() == [list(point) for point in expected]


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([1, 2, 3], "shape"),
        ([(0, 0, 0, 0), (1, 0, 0, 0), (0, 1, 0, 0)], "shape"),
        ([(0, 0), (1, 0, 3), (0, 1)], "same length"),
        (5.0, "shape"),
        ([], "no points"),
        ([(1, 1)], "only 1"),
        ([(1, 1), (2, 2), (1, 1), (2, 2)], "only 2"),
        ([(1j, 0), (1, 0), (0, 1)], "complex numbers"),
        ([("0", "0"), ("1", "0"), ("0", "1")], "real numbers"),
        (np.array([("0", 0), (1, 0), (0, 1)], dtype=object), "text"),
        ([({}, 0), (1, 0), (0, 1)], "real numbers"),
        ([(10**400, 0), (1, 0), (0, 1)], "real numbers"),
        ([(0, 0), (1, 1), (2, 2), (-5, -5)], "one line"),
        ([(0, 0), (0.1, 0.3), (0.2, 0.6), (0.4, 1.2)], "one line"),
        ([(2**53 + 1, 0), (1, 0), (0, 1)], "double precision"),
        ([(2**70 + 1, 0), (1, 0), (0, 1)], "double precision"),
        ([(0, 0), (1, 0), (0, 1e151)], "beyond"),
    ],
)
def test_unusable_points_give_one_clear_error(points, message):
    with pytest.raises(CurveError, match=message) as caught:
        Curve(points)
    assert caught.value.hint


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_an_infinite_coordinate_names_its_index_and_a_finite_neighbour(bad):
    with pytest.raises(CurveError, match="point 2 is not finite") as caught:
        Curve([(0, 0), (4, 0), (5, bad), (bad, 2), (0, 3)])
    assert caught.value.where == ((4, 0),)


def test_nothing_but_nan():
    with pytest.raises(CurveError, match="point 0 is not finite") as caught:
        Curve([(np.nan, np.nan)] * 4)
    assert caught.value.where == ()


def test_masked_points_count_as_missing():
    points = np.ma.masked_array([[0, 0], [4, 0], [0, 3]], mask=[[0, 0], [0, 1], [0, 0]])
    with pytest.raises(CurveError, match="point 1 is not finite"):
        Curve(points)


def test_exact_numbers_of_other_types_are_welcome():
    assert Curve([(Fraction(1, 2), 0), (2**60, 0), (0, 1)]).points.tolist() == [[0.5, 0], [2.0**60, 0], [0, 1]]


def test_a_figure_eight_with_signed_area_zero_is_a_curve():
    assert len(Curve([(0, 0), (2, 2), (2, 0), (0, 2)])) == 4


@pytest.mark.parametrize("scale", [2.0**-1060, 2.0**-500, 1e-200, 1.0, 1e140, 2.0**490])
def test_degeneracy_does_not_depend_on_the_scale(scale):
    bent = np.array([(0, 0), (1, 1), (2, 2), (3, 4)]) * scale
    straight = np.array([(0, 0), (1, 1), (2, 2), (4, 4)]) * scale
    assert len(Curve(bent)) == 4
    with pytest.raises(CurveError, match="one line"):
        Curve(straight)


def test_the_last_bit_decides_whether_points_are_on_a_line():
    above = np.nextafter(0.5, 1)
    assert len(Curve([(0, 0), (0.5, above), (1, 1)])) == 3
    with pytest.raises(CurveError, match="one line"):
        Curve([(0, 0), (0.5, 0.5), (1, 1)])


def test_reversed_starts_at_the_same_point_and_keeps_the_repairs():
    curve = Curve([(0, 0), (0, 0), (4, 0), (4, 3), (0, 3)])
    assert curve.reversed().points.tolist() == [[0, 0], [0, 3], [4, 3], [4, 0]]
    assert curve.reversed().repairs == curve.repairs


def test_repair_is_a_sentence():
    assert str(Repair("gap bridged", (1, 2), 0.25)) == "gap bridged at (1, 2), size 0.25"


@pytest.mark.parametrize(
    "geometry",
    [
        shapely.Polygon(TRIANGLE),
        shapely.LinearRing(TRIANGLE),
        shapely.LineString([*TRIANGLE, TRIANGLE[0]]),
        shapely.MultiLineString([[(0, 0), (4, 0), (0, 3)], [(0, 3), (0, 0)]]),
        shapely.Polygon([(0, 0, 7), (4, 0, 8), (0, 3, 9)]),
        shapely.GeometryCollection([shapely.MultiPolygon([shapely.Polygon(TRIANGLE)])]),
        np.array(TRIANGLE),
        Curve(TRIANGLE),
        Outline([TRIANGLE]),
        SimpleNamespace(outline=Curve(TRIANGLE)),
    ],
)
def test_as_curve_accepts_what_stands_for_a_curve(geometry):
    assert as_curve(geometry).points.tolist() == [[0, 0], [4, 0], [0, 3]]


def test_an_outline_of_one_loop_keeps_its_cusps_and_repairs_as_a_curve():
    outline = Outline([[*TRIANGLE[:2], *TRIANGLE[1:]]], {(0, 0): 1})
    curve = as_curve(outline)
    assert (curve.cusps[0].tolist(), curve.repairs) == ([1, 0, 0], outline.repairs)
    assert len(outline.repairs) == 1


def test_as_curve_returns_a_curve_itself():
    curve = Curve(TRIANGLE)
    assert as_curve(curve) is curve


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (shapely.box(0, 0, 9, 9).difference(shapely.box(1, 1, 2, 2)), "2 loops"),
        (shapely.Point(0, 0), "Point is not one outline"),
        (shapely.MultiPoint(TRIANGLE), "not one outline"),
        (shapely.Polygon(), "empty"),
        (shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(2, 2, 3, 3)]), "2 loops"),
        (SimpleNamespace(outline=None), "no coordinates"),
        ("loop.svg", "text is not a list of points"),
        (None, "shape|real numbers"),
    ],
)
def test_as_curve_refuses_everything_else(value, message):
    with pytest.raises(CurveError, match=message):
        as_curve(value)


def test_an_open_line_of_a_geometry_must_nearly_close():
    assert as_curve(shapely.LineString([(0, 0), (4, 0), (0, 3), (0, 0.1)])).repairs == (
        Repair("gap bridged", (0, 0.05), 0.1),
    )
    with pytest.raises(StrokeError):
        as_curve(shapely.LineString(TRIANGLE))


def test_input_errors_are_value_errors():
    assert issubclass(CurveError, InputError)
    assert issubclass(CurveError, ValueError)


SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9)]
HOLE = [(1, 1), (1, 3), (3, 1)]


def test_an_outline_numbers_its_loops_one_after_the_other():
    outline = Outline([SQUARE, HOLE])
    assert outline.n_loops == 2
    assert outline.points.tolist() == [list(map(float, point)) for point in SQUARE + HOLE]
    assert outline.first_point.tolist() == [0, 4, 7]
    assert outline.next_point.tolist() == [1, 2, 3, 0, 5, 6, 4]
    assert outline.rows.tolist() == list(range(7))
    assert [len(curve) for curve in outline.curves] == [4, 3]


def test_an_outline_of_one_loop_stands_for_a_curve_with_all_that_is_known_of_it():
    outline = Outline([[SQUARE[0], *SQUARE]], {(0, 2): 1})
    curve = as_curve(outline)
    assert isinstance(as_outline(outline), Curve)
    assert curve.points.tolist() == outline.points.tolist()
    assert curve.repairs == outline.repairs != ()
    assert curve.cusps[0].tolist() == [0, 1, 0, 0]


def test_an_outline_of_an_outline_keeps_its_repairs():
    first = Outline([[SQUARE[0], *SQUARE], HOLE])
    assert Outline(first, [[0, 1, 0, 0], [0, 0, 0]]).repairs == first.repairs != ()


def test_rows_count_the_points_that_were_left_out():
    outline = Outline([[*SQUARE, SQUARE[0]], [HOLE[0], *HOLE]])
    assert outline.rows.tolist() == [0, 1, 2, 3, 5, 7, 8]
    assert len(outline.repairs) == 1


def test_cusps_of_points_left_out_go_to_the_point_that_they_repeat():
    curve = Curve([(0, 0), (1, 0), (1, 0), (0, 1), (0, 1), (0, 0)], cusps={2: 1, 4: 2, 5: 3})
    assert [index.tolist() for index in curve.cusps] == [[3, 1, 2]]


def test_cusps_follow_a_reversal_and_lists_of_curves():
    outline = as_outline([Curve(SQUARE, cusps=[0, 1, 0, 0]), HOLE]).reversed()
    assert [index.tolist() for index in outline.cusps] == [[0, 0, 0, 1], [0, 0, 0]]
    assert outline.has_cusps
    assert not Outline([SQUARE]).has_cusps


@pytest.mark.parametrize(
    ("loops", "cusps", "message"),
    [
        ([], None, "no loop"),
        ([SQUARE, []], None, "curve 1 of 2"),
        ([SQUARE, [(0, 0), (1, np.nan), (1, 1)]], None, "curve 1 of 2"),
        ([[(0, 0), (2, 0), (1, 0)], [(5, 5)]], None, "none of the 2 loops has an area"),
        ([SQUARE, [(0, 0), (2, 0), (1, 0)]], {(1, 2): 1}, "has no cusps"),
        ([SQUARE], [[0, 0.5, 0, 0]], "whole number"),
        ([SQUARE], [[0, -1, 0, 0]], "whole number"),
        ([SQUARE], [[0, 1]], "4 points have the shape"),
        ([SQUARE], [[0] * 4, [0] * 4], "2 loops"),
        ([SQUARE], {(1, 0): 1}, "no point 0 of loop 1"),
        ([SQUARE], {(0, 4): 1}, "no point 4 of loop 0"),
        ([SQUARE], {(0, 0): True}, "whole number"),
        ([SQUARE], {(0, 0): 10**30}, "beyond 1,000,000"),
        ([SQUARE], [[10**30, 0, 0, 0]], "beyond 1,000,000"),
        ([SQUARE], {0: 1}, "named by its loop and its point"),
        ([SQUARE], {"0:1": 1}, "named by its loop and its point"),
        (shapely.box(0, 0, 1, 1), None, "a Polygon is no list of loops"),
        (None, None, "no list of loops"),
    ],
)
def test_an_outline_refuses_what_it_cannot_be(loops, cusps, message):
    with pytest.raises(CurveError, match=message):
        Outline(loops, cusps)


def test_polygons_with_holes_have_the_surface_on_the_left():
    clockwise = shapely.Polygon(SQUARE[::-1], [HOLE[::-1]])
    outline = as_outline(clockwise)
    assert outline.loops[0].tolist() == [[0, 9], [0, 0], [9, 0], [9, 9]]
    assert shapely.LinearRing(outline.loops[0]).is_ccw
    assert not shapely.LinearRing(outline.loops[1]).is_ccw
    assert not shapely.LinearRing(as_outline(shapely.Polygon(SQUARE[::-1])).points).is_ccw


FLAT = [(2, 2), (4, 1), (2, 2)]


@pytest.mark.parametrize(
    "drawn",
    [
        [SQUARE, FLAT],
        [FLAT, SQUARE],
        [SQUARE, [(2, 2)]],
        [np.array(SQUARE), np.array([(2, 2), (4, 1), (3, 1.5)])],
        shapely.Polygon(SQUARE, [[*FLAT, (2, 2)]]),
        shapely.MultiPolygon([shapely.Polygon(SQUARE), shapely.Polygon([*FLAT, (2, 2)])]),
    ],
)
def test_a_loop_without_area_beside_others_is_left_out(drawn):
    outline = as_outline(drawn)
    assert isinstance(outline, Curve)
    assert outline.points.tolist() == np.array(SQUARE).tolist()
    assert "loop without area left out at (2, 2)" in map(str, outline.repairs)
    assert bounds_disk(drawn)
    assert fill(drawn).area == shapely.Polygon(SQUARE).area
    assert winding_at(drawn, (0.5, 0.5)) == 1


def test_rows_and_cusps_are_counted_with_loops_that_are_left_out():
    outline = Outline([FLAT, SQUARE, SQUARE], {(1, 2): 1})
    assert outline.rows.tolist() == list(range(3, 11))
    assert [index.tolist() for index in outline.cusps] == [[0, 0, 1, 0], [0, 0, 0, 0]]
