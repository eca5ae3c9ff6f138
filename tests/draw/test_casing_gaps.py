import numpy as np
import pytest
import shapely

import plyfold as pf
from coarse import CURVES
from plyfold import draw
from plyfold.draw.casing_gaps import cased_strands
from plyfold.draw.placement import Frame
from plyfold.errors import InputError

GAP = 0.002
NAMES = ["exit-ramp", "stacked-spiral", "smallest-unliftable", "knotted-ribbon"]


def cased(name):
    layering = pf.find_embedding(CURVES[name].curve)
    frame = Frame(layering.immersion.arrangement.curve.points)
    return layering, frame, list(cased_strands(layering, frame, GAP))


@pytest.mark.parametrize("name", NAMES)
def test_gaps_are_where_the_curve_passes_under(name):
    layering, frame, strands = cased(name)
    arrangement = layering.immersion.arrangement
    assert len(strands) == arrangement.n_crossings  # each crossing has one lower strand
    lines = [shapely.LineString(strand) for strand in strands]
    for crossing in frame(arrangement.crossings):
        touching = [line for line in lines if line.distance(shapely.Point(crossing)) < 1e-9]
        assert len(touching) == 1  # the upper one goes through


@pytest.mark.parametrize("name", NAMES)
def test_strands_do_not_meet_and_leave_only_gaps(name):
    layering, frame, strands = cased(name)
    arrangement = layering.immersion.arrangement
    lines = [shapely.LineString(strand) for strand in strands]
    for number, line in enumerate(lines):
        assert not any(line.crosses(other) for other in lines[:number])
    whole = shapely.LinearRing(frame(arrangement.curve.points)).length
    missing = whole - sum(line.length for line in lines)
    assert 0 < missing <= 2 * 4 * GAP * arrangement.n_crossings + 1e-12


def test_a_gap_is_as_wide_as_asked_for_seen_across():
    layering, frame, strands = cased("exit-ramp")
    arrangement = layering.immersion.arrangement
    points = frame(arrangement.curve.points)
    under = np.flatnonzero(~layering.casing)
    for strand, start, end in zip(strands, under, np.roll(under, -1), strict=True):
        for visit, place in ((start, strand[0]), (end, strand[-1])):
            edge = arrangement.visit_edge[arrangement.partner[visit]]
            (dx, dy), (x, y) = points[edge + 1] - points[edge], place - points[edge]
            assert abs(dx * y - dy * x) / np.hypot(dx, dy) == pytest.approx(GAP, rel=0.05)


def test_cased_curve_without_crossings_is_closed():
    (strand,) = cased("circle")[2]
    assert strand[0].tolist() == strand[-1].tolist()


def test_knot_drawing_has_the_strands_and_cloth_its_layers():
    layering = pf.find_embedding(CURVES["exit-ramp"].curve)
    knot = draw.plot_casing(layering, cloth=False)
    assert len(knot.lines) == 4
    assert len(knot.patches) == 0
    cloth = draw.plot_casing(layering)
    assert len(cloth.patches) == layering.immersion.n_sheets
    assert any(line.get_linestyle() == "--" for line in cloth.lines)


def test_obstructions_have_no_casing():
    with pytest.raises(InputError):
        draw.plot_casing(pf.find_embedding(CURVES["figure-eight"].curve))
