"""Gauss codes as values: reading, writing, turning and mirroring, and the published numbers of curves."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.arrangement import gauss
from plyfold.arrangement.gauss import GaussCode
from plyfold.errors import GaussCodeError
from reference import planar_maps
from reference.crossings import crossings
from reference.random_curves import BENNEQUIN_LIKE, ribbon_outline

TREFOIL = "1+ 2- 3+ 1- 2+ 3- / outer 1"


def as_reference(code):
    return planar_maps.GaussCode(code.partner, code.ccw, code.outer)


def plane_codes(most):
    return [GaussCode(*code) for k in range(1, most + 1) for code in planar_maps.plane_codes(k)]


@pytest.mark.parametrize("code", [GaussCode((), (), 0), GaussCode((), (), 1), *plane_codes(2)])
def test_text_there_and_back(code):
    assert GaussCode.parse(str(code)) == code


def test_text_of_every_curve_with_three_crossings():
    codes = plane_codes(3)
    texts = [str(code) for code in codes]
    assert len(set(texts)) == len(codes)
    assert [GaussCode.parse(text) for text in texts] == codes


@pytest.mark.parametrize(
    "text",
    [
        "1+2-3+1-2+3-/outer1",
        "1+, 2-, 3+, 1-, 2+, 3- / outer: 1",
        "  1 +; 2 −; 3 +; 1 –; 2 +; 3 － /  outer = 1 ",
        "a+ bc- d+ a- bc+ d- / outer 1",
        "7+ 2- 1+ 7- 2+ 1- / outer 5",
    ],
)
def test_other_ways_to_write_a_trefoil(text):
    assert GaussCode.parse(text) == GaussCode.parse(TREFOIL)
    assert str(GaussCode.parse(text)) == TREFOIL


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1+ 1-", "expected '/ outer' and a dart, at character 6"),
        ("1+ 1- / outer left", "expected '/ outer' and a dart, at character 8"),
        ("1+ 1- / outer 1 / outer 2", "expected '/ outer'"),
        ("1+ 2 1- 2+ / outer 1", r"expected a crossing with its sign behind it, at character 4 \(2 1-"),
        ("-1, 2, -3 / outer 1", "at character 1"),
        ("1+ 2- 1+ 2+ / outer 1", r"both visits to crossing 1 have the same sign.*character 7"),
        ("1+ 1- 1+ / outer 1", "crossing 1 is visited a third time, at character 7"),
        ("1+ 1- 2+ / outer 1", "crossing 2 is visited only once"),
        ("O1+U2+O3+U1+O2+U3+ / outer 1", "over and under belong to knots.*character 1"),
        ("1+ 1- / outer 4", "dart 4 does not exist"),
        ("1+ 2+ 1- 2- / outer 0", "surface with handles"),
    ],
)
def test_what_is_no_code_says_where(text, message):
    with pytest.raises(GaussCodeError, match=message) as caught:
        GaussCode.parse(text)
    assert caught.value.hint or "dart 4" in message


def test_wrong_lists_are_refused():
    with pytest.raises(GaussCodeError, match="partner"):
        GaussCode([0, 1], [True, False], 0)
    with pytest.raises(GaussCodeError, match="handles"):
        GaussCode([2, 3, 0, 1], [True, True, False, False], 0)


def test_any_dart_of_the_unbounded_cell_means_the_same():
    for code in plane_codes(3):
        cell = next(darts for darts in planar_maps.cells(code.partner, code.ccw) if code.outer in darts)
        assert code.outer == min(cell)
        assert {GaussCode(code.partner, code.ccw, dart) for dart in cell} == {code}


def test_entries_are_plain_and_codes_are_keys():
    code = GaussCode(np.array([1, 0]), np.array([1, 0]), np.int64(1))
    assert {code: "limaçon"}[GaussCode((1, 0), (True, False), 1)] == "limaçon"
    assert [type(entry) for entry in (*code.partner, *code.ccw, code.outer)] == [int, int, bool, bool, int]


def test_operations_are_those_of_the_reference():
    for code in plane_codes(3):
        reference = as_reference(code)
        turns = [as_reference(code.rotated(start)) for start in range(len(code.partner))]
        assert turns == planar_maps.rotations(reference)
        assert as_reference(code.reversed()) == planar_maps.reversed_code(reference)
        assert as_reference(code.reflected()) == planar_maps.reflected(reference)
        assert code.rotated(-1).rotated(1) == code.reversed().reversed() == code.reflected().reflected() == code


def test_circles():
    outward, inward = GaussCode((), (), 1), GaussCode((), (), 0)
    assert outward.reversed() == outward.reflected() == inward
    assert outward.rotated(3) == outward
    assert outward.canonical() == inward.canonical()
    assert outward.canonical(reversal=False, reflection=False) != inward.canonical(reversal=False, reflection=False)
    assert outward.canonical(False, False, any_outer=True) == inward.canonical(False, False, any_outer=True)


def test_code_of_a_drawing():
    ribbon = ribbon_outline(np.random.default_rng(3), 60)
    drawn = crossings(ribbon).code
    assert planar_maps.turning_number(drawn) == 1
    assert as_reference(GaussCode.of(ribbon)) == planar_maps.with_smallest_outer_dart(drawn)
    assert GaussCode.of(pf.Curve(ribbon)) == GaussCode.of(pf.arrange(ribbon)) == GaussCode.of(GaussCode.of(ribbon))


def test_another_cell_may_be_unbounded():
    code = GaussCode.parse(TREFOIL)
    for darts in planar_maps.cells(code.partner, code.ccw):
        other = code.with_outer(darts[-1])
        assert other.outer == min(darts)
        assert other.canonical(any_outer=True) == code.canonical(any_outer=True)
    with pytest.raises(GaussCodeError):
        code.with_outer(12)


def test_notebooks_show_a_drawing_or_the_chords_of_many_crossings(monkeypatch):
    code = GaussCode.parse(TREFOIL)
    assert code._repr_svg_().count("winding number") == 4
    monkeypatch.setattr(gauss, "_MOST_CROSSINGS_DRAWN", 2)
    assert code._repr_svg_().count("stroke='#c8501e'") == 3


# Published numbers of curves with 1, 2, … crossings, from Arnold's tables and the on-line encyclopedia of integer
# sequences: in the plane up to reversal and reflection A008983; on the sphere A008986 to A008989.
IN_THE_PLANE = {(True, True): (2, 5, 20, 82, 435, 2645)}
ON_THE_SPHERE = {
    (False, False): (1, 3, 9, 37, 182, 1143),
    (True, False): (1, 2, 6, 21, 99, 588),
    (False, True): (1, 2, 6, 21, 97, 579),
    (True, True): (1, 2, 6, 19, 76, 376),
}
TABLES = [(IN_THE_PLANE, False), (ON_THE_SPHERE, True)]


def forms(codes, reversal, reflection, any_outer):
    return {code.canonical(reversal, reflection, any_outer) for code in codes}


@pytest.mark.parametrize(("table", "any_outer"), TABLES)
@pytest.mark.parametrize("k", [1, 2, 3])
def test_published_numbers_of_curves(k, table, any_outer):
    codes = [GaussCode(*code) for code in planar_maps.plane_codes(k)]
    for symmetries, numbers in table.items():
        assert len(forms(codes, *symmetries, any_outer)) == numbers[k - 1]


def test_published_number_of_curves_with_four_crossings():
    codes = [GaussCode(*code) for code in planar_maps.plane_codes(4)]
    plane = forms(codes, True, True, False)
    assert len(plane) == 82
    assert len(forms(plane, True, True, True)) == 19


@pytest.mark.slow
@pytest.mark.parametrize("k", [5, 6])
def test_published_numbers_of_larger_curves(k):
    plane = {GaussCode(*code).canonical() for code in planar_maps.plane_codes(k)}
    assert len(plane) == IN_THE_PLANE[True, True][k - 1]
    assert len(forms(plane, True, True, True)) == ON_THE_SPHERE[True, True][k - 1]


def test_equivalent_codes_have_the_same_form_and_others_do_not():
    codes = [as_reference(code) for code in plane_codes(2)]
    for code in codes:
        form = GaussCode(*code).canonical()
        equivalent = planar_maps.symmetric_copies(code)
        assert {GaussCode(*other).canonical() == form for other in equivalent} == {True}
        assert {GaussCode(*other).canonical() == form for other in codes if other not in equivalent} <= {False}
        assert as_reference(form) in equivalent


def test_form_of_a_large_curve_does_not_depend_on_the_start():
    rng = np.random.default_rng(5)
    code = GaussCode.of(ribbon_outline(rng, 120))
    assert code.n_crossings > 40
    for start in rng.integers(0, len(code.partner), 5):
        turned = code.rotated(int(start))
        assert turned.canonical(False, False) == code.canonical(False, False)
        assert turned.reversed().canonical(True, False) == code.canonical(True, False)
        assert turned.reflected().canonical(False, True) == code.canonical(False, True)
        assert turned.reflected().canonical(False, False) != code.canonical(False, False)


def test_a_code_stands_for_a_curve_where_no_drawing_is_needed():
    code = GaussCode.of(BENNEQUIN_LIKE)
    assert pf.count_immersions(code) == 5
    assert GaussCode.of(pf.arrange(code)) == code


def test_text_is_drawn_and_what_is_no_text_is_refused():
    assert GaussCode.of(GaussCode.parse(TREFOIL).to_curve()) == GaussCode.parse(TREFOIL)
    with pytest.raises(GaussCodeError, match="no text"):
        GaussCode.parse(None)


@pytest.mark.parametrize("wrong", [None, 1.5, "a", True])
def test_visits_and_darts_are_whole_numbers(wrong):
    code = GaussCode([1, 0], [True, False], 1)
    for make in (
        lambda: GaussCode([1, 0], [True, False], wrong),
        lambda: code.with_outer(wrong),
        lambda: code.rotated(wrong),
    ):
        with pytest.raises(GaussCodeError, match="whole number"):
            make()
