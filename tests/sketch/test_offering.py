"""What is offered where there is no surface, and ribbons: what is offered must be one, by looking at it."""

import numpy as np
import pytest
import shapely

from coarse import CURVES
from plyfold import bounds_disk, least_homotopy
from plyfold.errors import CurveError
from plyfold.sketch.answers import answer
from plyfold.sketch.look import look_at
from plyfold.sketch.offering import offered
from plyfold.sketch.ribbons import ribbons
from plyfold.sketch.schema import Look, Offer, Stroke, Widen

CORNER = [(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)]
# A bow-tie whose waist is a thin lens.
WAIST = [(0, 0), (40, 21), (60, 21), (100, 0), (100, 40), (60, 20), (40, 20), (0, 40)]
LIMACON = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
KITE = [(1, 0), (3, 0), (3, 4), (-3, 4), (-3, 0), (-1, 0), (1, 1), (1, 3), (2.2, 2), (-2, 2), (-1, 3), (-1, 1)]
ROAD = [(0, 0), (9, 0), (9, 6), (4, 6), (4, -5)]


def closed(points, **cusps):
    marks = tuple((int(point), index) for point, index in cusps.items())
    return Stroke(tuple((float(x), float(y)) for x, y in points), closed=True, cusps=marks)


def offers(points):
    return {offer["kind"]: offer for offer in offered(Offer((closed(points),)))["offers"]}


def looked_at(loops):
    return look_at(Look(tuple(closed(loop["points"], **loop["cusps"]) for loop in loops)))


def area(points):
    return float(shapely.Polygon(points).area)


def test_a_small_loop_is_left_out():
    repair = offers(CORNER)["repair"]
    assert repair["label"] == "Leave out a small loop"
    assert repair["sentence"] == "Leaving out 1 loop, 0.0416% of the region, makes it a disk of cloth."
    assert repair["where"] == [[60, 40]]
    assert sum(map(area, repair["areas"])) == 1
    assert looked_at(repair["loops"])["verdict"]["immersible"]


def test_a_lens_is_undone():
    repair = offers(WAIST)["repair"]
    assert repair["label"] == "Undo this crossing"
    assert looked_at(repair["loops"])["verdict"]["immersible"]


def test_half_a_bow_tie_is_no_small_loop():
    assert list(offers(EIGHT)) == ["pieces"]


def test_cusps_are_offered_at_points_of_the_drawing():
    cusps = offers(LIMACON)["cusps"]
    assert cusps["label"] == "A cusp here"
    marks = {str(LIMACON.index(tuple(mark["where"]))): mark["index"] for mark in cusps["cusps"]}
    assert look_at(Look((closed(LIMACON, **marks),)))["verdict"]["immersible"]


@pytest.mark.parametrize("points", [CORNER, WAIST, LIMACON, EIGHT], ids=["corner", "waist", "limacon", "eight"])
@pytest.mark.parametrize("direction", [1, -1])
def test_pieces_add_up_to_the_winding_numbers(points, direction):
    pieces = offers(points[::direction])["pieces"]
    cells = look_at(Look((closed(points),)))["cells"]
    covered = sum(abs(cell["winding"]) * area(cell["outline"]) for cell in cells)
    assert sum(map(area, pieces["areas"])) == pytest.approx(covered)
    assert all(shapely.LinearRing(loop["points"]).is_ccw for loop in pieces["loops"])
    assert looked_at(pieces["loops"])["verdict"]["immersible"]


def test_pieces_of_a_curve_are_the_loops_of_its_least_homotopy():
    """One loop of the kite overlaps itself, and the other runs the other way."""
    found = least_homotopy(KITE)
    pieces = offers(KITE)["pieces"]
    assert pieces["sentence"] == "It can be cut into 2 loops, each the outline of a disk of cloth."
    winds = [abs(loop.winding) @ found.weights for loop in found.loops]
    assert [bounds_disk(loop["points"]) for loop in pieces["loops"]] == [True, True]
    assert sum(winds) == pytest.approx(25.9)
    assert looked_at(pieces["loops"])["verdict"]["headline"].startswith("2 pieces of cloth: 2 disks")


@pytest.mark.parametrize("name", CURVES)
def test_whatever_is_offered_for_a_curve_of_the_gallery_is_a_surface(name):
    points = CURVES[name].curve.points.tolist()
    found = offers(points)
    assert bool(found) == (CURVES[name].immersions == 0)
    for kind in {"repair", "pieces"} & set(found):
        assert looked_at(found[kind]["loops"])["verdict"]["immersible"]


def test_several_loops_are_repaired_together():
    square = [(10, 10), (10, 20), (20, 20), (20, 10)]
    (repair,) = (o for o in offered(Offer((closed(CORNER), closed(square))))["offers"] if o["kind"] == "repair")
    assert looked_at(repair["loops"])["verdict"]["headline"] == "A ring of cloth"


# ---- ribbons ---------------------------------------------------------------------------------------------------------


def open_stroke(points):
    return Stroke(tuple((float(x), float(y)) for x, y in points))


def test_an_open_stroke_becomes_a_ribbon_that_is_a_disk():
    (loop,) = ribbons(Widen((open_stroke(ROAD), closed(EIGHT)), 2.0))["loops"]
    found = looked_at([loop])
    assert found["verdict"]["headline"] == "A disk of cloth"
    covered = sum(cell["winding"] * area(cell["outline"]) for cell in found["cells"])
    length = shapely.LineString(ROAD).length
    assert 2 * length < covered < 2 * length + np.pi  # and its round ends, less what corners take away


def test_a_bend_that_is_too_tight_is_named_and_no_mistake_of_the_page():
    hook = [(0, 0), (9, 0), (9, 1), (0, 1)]
    with pytest.raises(CurveError, match="too tight") as caught:
        ribbons(Widen((open_stroke(hook),), 3.0))
    (place,) = caught.value.where
    assert tuple(place) in hook[1:3]
    told = answer("ribbon", b'{"version": 3, "strokes": [[[0, 0], [9, 0], [9, 1], [0, 1]]], "width": 3}', {})
    assert told.status == 200


@pytest.mark.parametrize("width", ["", ', "width": 0', ', "width": -1', ', "width": "2"'])
def test_a_width_is_a_positive_number(width):
    question = f'{{"version": 3, "strokes": [[[0, 0], [9, 0]]]{width}}}'
    assert answer("ribbon", question.encode(), {}).status == 400
