"""What the page is told of a loop, against the definitions."""

from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import shapely

from coarse import CURVES
from plyfold.errors import CurveError, StrokeError
from plyfold.gallery import chain
from plyfold.report import in_words
from plyfold.sketch.look import look_at
from plyfold.sketch.schema import Look, Stroke
from reference import crossings
from reference.random_curves import MILNOR_LIKE


def closed(points):
    return (Stroke(tuple((float(x), float(y)) for x, y in points), closed=True),)


def asked(points):
    return look_at(Look(closed(points)))


def points_of(answer):
    """Return the points of an outline of one loop."""
    (loop,) = answer["loops"]
    return loop["points"]


def area(points):
    x, y = np.array(points, dtype=float).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


@pytest.fixture(params=CURVES, scope="module")
def named(request):
    return CURVES[request.param], asked(CURVES[request.param].curve.points.tolist())


def test_the_figures_of_the_gallery(named):
    curve, answer = named
    assert answer["turning_numbers"] == [curve.turning_number]
    assert len(answer["crossings"]) == curve.crossings
    assert answer["verdict"]["immersions"] == str(curve.immersions)
    assert answer["verdict"]["immersible"] == (curve.immersions > 0)
    assert answer["repairs"] == []


def test_cells_cover_what_the_loop_goes_round(named):
    _, answer = named
    covered = sum(cell["winding"] * area(cell["outline"]) for cell in answer["cells"])
    assert covered == pytest.approx(area(points_of(answer)))
    assert all(area(cell["outline"]) > 0 for cell in answer["cells"])


def test_labels_lie_in_their_cells(named):
    _, answer = named
    for cell in answer["cells"]:
        assert crossings.winding_number(points_of(answer), cell["label"]) == cell["winding"]
        room = shapely.Point(cell["label"]).distance(shapely.LineString([*points_of(answer), points_of(answer)[0]]))
        assert 0 < cell["radius"] <= 1.01 * room


def test_borders_run_once_round_the_loop_from_crossing_to_crossing(named):
    curve, answer = named
    borders = answer["borders"]
    assert len(borders) == max(2 * curve.crossings, 1)
    assert [border[-1] for border in borders] == [border[0] for border in borders[1:] + borders[:1]]
    around = [p for border in borders for p in border[:-1]]
    assert shapely.LinearRing(around).length == pytest.approx(shapely.LinearRing(points_of(answer)).length)
    assert {tuple(p) for p in points_of(answer)} <= {tuple(p) for p in around}


def test_cells_and_borders_know_each_other(named):
    _, answer = named
    for cell in answer["cells"]:
        outline = {tuple(p) for p in cell["outline"]}
        beside = {i for i, border in enumerate(answer["borders"]) if {tuple(p) for p in border} <= outline}
        assert set(cell["borders"]) <= beside


def test_asking_again_about_the_answer_changes_nothing(named):
    _, answer = named
    again = asked(points_of(answer))
    assert not again["reversed"]
    for key in (
        "loops",
        "cusps",
        "repairs",
        "turning_numbers",
        "visits",
        "code",
        "crossings",
        "borders",
        "cells",
        "gauss",
        "word",
        "verdict",
    ):
        assert again[key] == answer[key]


def test_a_clockwise_loop_is_turned_round():
    forward, backward = asked([(0, 0), (4, 0), (0, 3)]), asked([(0, 0), (0, 3), (4, 0)])
    assert (forward["reversed"], backward["reversed"]) == (False, True)
    assert points_of(forward) == points_of(backward)


def test_strokes_in_any_order_and_direction_make_one_loop():
    points = [tuple(map(float, p)) for p in MILNOR_LIKE]
    pieces = [points[0:4], points[3:8], points[7:12], [points[11], points[0]]]
    strokes = [pieces[2][::-1], pieces[0], pieces[3], pieces[1][::-1]]
    answer = look_at(Look(tuple(Stroke(tuple(stroke)) for stroke in strokes)))
    assert answer["verdict"]["immersions"] == "2"
    assert {tuple(p) for p in points_of(answer)} == set(points)


def test_bridged_gaps_are_told():
    answer = look_at(Look((Stroke(((0, 0), (4, 0))), Stroke(((4, 0.25), (0, 3), (0, 0))))))
    assert answer["repairs"] == [{"kind": "gap bridged", "where": [4, 0.125], "size": 0.25}]


def test_cusps_stay_on_strokes_that_are_joined():
    strokes = (Stroke(((0, 0), (9, 0)), cusps=((1, 2),)), Stroke(((0, 0.1), (0, 9), (5, 5), (9, 0)), cusps=((2, 1),)))
    (loop,) = look_at(Look(strokes))["loops"]
    assert {tuple(loop["points"][int(point)]): index for point, index in loop["cusps"].items()} == {
        (9, 0): 2,
        (5, 5): 1,
    }


@pytest.mark.parametrize(
    ("strokes", "words"),
    [
        ((), "no stroke"),
        ((Stroke(((0, 0), (1, 0), (1, 1)), True), Stroke(((0, 0), (9, 0)))), "too far apart"),
    ],
)
def test_what_makes_no_loops_is_unfinished(strokes, words):
    with pytest.raises(StrokeError, match=words):
        look_at(Look(strokes))


def test_a_loop_that_crosses_itself_too_often_is_refused():
    points = np.random.default_rng(0).random((500, 2)).tolist()
    with pytest.raises(CurveError, match="crosses itself"):
        asked(points)


def test_long_counts_are_exact_and_their_sentence_is_short():
    answer = asked(chain(MILNOR_LIKE, 60))
    assert answer["verdict"]["immersions"] == str(2**60)
    assert "1.15 · 10^18 ways" in answer["verdict"]["sentence"]


@pytest.mark.parametrize("count", [10**12, 10**15 - 1, 123456789012345678, 2**400, 3**5000])
def test_counts_in_words_never_exceed_the_count(count):
    leading, exponent = in_words(count).removeprefix("about ").split(" · 10^")
    assert 1 <= Fraction(leading) < 10
    assert (
        Fraction(leading) * 10 ** int(exponent) <= count < (Fraction(leading) + Fraction(1, 100)) * 10 ** int(exponent)
    )


# ---- several loops, and cusps ----------------------------------------------------------------------------------------

SQUARE = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])


def moved(points, x, y):
    return points + np.array([x, y])


def loops(*drawn):
    return look_at(Look(tuple(stroke for points in drawn for stroke in closed(points))))


def test_a_hole_is_taken_out_of_its_cell():
    answer = loops(9 * SQUARE, 3 * SQUARE[::-1])
    (ring,) = (cell for cell in answer["cells"] if cell["winding"] == 1)
    assert area(ring["outline"]) == 18**2
    assert [area(hole) for hole in ring["holes"]] == [-(6**2)]
    assert answer["turning_numbers"] == [1, -1]
    assert answer["verdict"]["immersible"]
    x, y = ring["label"]
    assert 3 < max(abs(x), abs(y)) < 9


def test_strokes_and_loops_are_told_in_the_same_order():
    answer = loops(moved(SQUARE, 9, 0), SQUARE, moved(SQUARE, -9, 0))
    assert [np.mean(loop["points"], axis=0).tolist() for loop in answer["loops"]] == [[9, 0], [0, 0], [-9, 0]]


def test_visits_say_which_borders_meet_there():
    answer = loops(SQUARE, moved(SQUARE, 0.5, 0.25), moved(9 * SQUARE, 30, 0))
    assert len(answer["visits"]) == 4
    for before, after in answer["visits"]:
        assert answer["borders"][before][-1] == answer["borders"][after][0]


def test_loops_that_would_be_holes_by_their_depth_are_named():
    assert loops(9 * SQUARE, 3 * SQUARE, SQUARE)["verdict"]["turn"] == [1]
    assert loops(9 * SQUARE, 3 * SQUARE[::-1])["verdict"]["turn"] == []
    assert loops(9 * SQUARE[::-1], 3 * SQUARE)["verdict"]["turn"] == []
    assert loops(SQUARE, moved(SQUARE[::-1], 5, 0))["verdict"]["turn"] == [1]
    assert loops(SQUARE, moved(SQUARE, 0.5, 0.25))["verdict"]["turn"] == []


def test_the_same_outline_asked_again_has_the_same_code():
    one, same = loops(9 * SQUARE, 3 * SQUARE[::-1]), loops(8 * SQUARE + 1, 2 * SQUARE[::-1])
    other = loops(9 * SQUARE, 3 * SQUARE)
    assert one["code"] == same["code"] != other["code"]


LIMACON = CURVES["limacon"].curve.points.tolist()


def marked(points, **cusps):
    (stroke,) = closed(points)
    return look_at(Look((replace(stroke, cusps=tuple((int(at[1:]), turns) for at, turns in cusps.items())),)))


def inner_vertex():
    """A point of the limaçon's inner loop, where two sheets can lie."""
    inside = [crossings.winding_number([p for p in LIMACON if p != q], q) for q in LIMACON]
    return inside.index(1)


def test_a_curve_that_turns_twice_is_a_disk_with_a_cusp_where_two_sheets_lie():
    answer = marked(LIMACON, **{f"p{inner_vertex()}": 1})
    assert answer["verdict"]["immersions"] == "1"
    (cusp,) = answer["cusps"]
    assert (cusp["where"], cusp["index"]) == (LIMACON[inner_vertex()], 1)
    assert (answer["gauss"], answer["word"]) == (None, None)


def test_a_branched_disk_is_named():
    said = asked(LIMACON)["verdict"]
    assert said["reason"] == "turning number"
    assert said["sentence"].endswith("It bounds a disk of cloth with a branch point.")


def test_a_point_that_cannot_be_a_cusp_is_refused_with_the_reason():
    outer = max(range(len(LIMACON)), key=lambda i: np.hypot(*LIMACON[i]))
    verdict = marked(LIMACON, **{f"p{outer}": 1})["verdict"]
    assert (verdict["immersible"], verdict["reason"]) == (False, "cusp")
    assert verdict["where"] == [LIMACON[outer]]
    assert "2 sheets" in verdict["sentence"]


# ---- outlines that touch themselves ----------------------------------------------------------------------------------

PINCHED = [[0, 0], [4, 0], [2, 2], [4, 4], [0, 4], [2, 2]]
KEYHOLE = [[0, 0], [6, 0], [6, 6], [0, 6], [0, 3], [2, 3], [2, 4], [4, 4], [4, 2], [2, 2], [2, 3], [0, 3]]


def test_a_disk_that_touches_itself_is_a_verdict_of_its_own():
    answer = asked(PINCHED)
    assert answer["verdict"]["immersible"]
    assert answer["verdict"]["headline"] == "A disk of cloth that touches itself"
    assert answer["verdict"]["touches"] == answer["contacts"] == [[2, 2]]
    assert answer["verdict"]["cut"] == "2 pieces of cloth: 2 disks"
    assert points_of(answer) == PINCHED
    assert answer["cells_by_winding"] == [[1, 2]]


def test_contacts_where_the_surface_does_not_touch_itself_are_named_and_make_no_cells():
    answer = asked(KEYHOLE)
    assert answer["verdict"]["headline"] == "A disk of cloth"
    assert (answer["verdict"]["touches"], answer["verdict"]["cut"]) == ([], None)
    assert answer["contacts"] == [[0, 3], [2, 3]]
    assert answer["cells_by_winding"] == [[0, 1], [1, 1]]
    assert points_of(answer) == KEYHOLE


def test_contacts_of_an_outline_that_bounds_nothing_are_named():
    answer = asked([[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]][::-1])
    assert answer["contacts"] == [[2, 0]]
    bow_tie = asked([[0, 0], [4, 4], [4, 0], [0, 4], [0, 2], [-1, 1], [0, 2]])
    assert not bow_tie["verdict"]["immersible"]
    assert bow_tie["verdict"]["touches"] == []


def test_crossings_of_edges_are_told_from_those_that_moving_apart_makes():
    through_a_vertex = asked([[0, 0], [1, 1], [2, 2], [2, 0], [0, 2]])
    assert (through_a_vertex["crossings_as_given"], len(through_a_vertex["crossings"])) == (0, 1)
    apart = asked([[0, 0], [2, 2], [2, 0], [0, 2]])
    assert (apart["crossings_as_given"], len(apart["crossings"])) == (1, 1)


def test_spikes_are_taken_out_and_told():
    answer = asked([(0, 0), (4, 0), (4, 4), (6, 6), (4, 4), (0, 4)])
    assert [(repair["kind"], repair["where"]) for repair in answer["repairs"]] == [("spike taken out", [6, 6])]
    assert points_of(answer) == [[0, 0], [4, 0], [4, 4], [0, 4]]
    assert answer["contacts"] == []


def test_without_contacts_cells_are_counted_as_they_are(named):
    _, answer = named
    assert dict(answer["cells_by_winding"]) == Counter(cell["winding"] for cell in answer["cells"])


# ---- where it is wrong -----------------------------------------------------------------------------------------------


def test_a_wrong_turning_number_has_a_place(named):
    curve, answer = named
    if curve.turning_number != 1:
        assert answer["verdict"]["reason"] == "turning number"
        assert answer["verdict"]["where"][0] in answer["crossings"]


def test_negative_cells_are_the_place():
    answer = asked(CURVES["kinked-circle"].curve.points.tolist())
    assert answer["verdict"]["reason"] == "negative winding"
    (place,) = answer["verdict"]["where"]
    assert crossings.winding_number(points_of(answer), place) < 0
