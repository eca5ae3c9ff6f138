"""Where a curve turns too often, or not enough: the crossing of a lobe that could be left out."""

import json

import numpy as np
import pytest

import plyfold as pf
from plyfold.cli.commands import main
from plyfold.gallery import CURVES
from plyfold.sketch.look import look_at
from plyfold.sketch.schema import Look, Stroke
from reference import crossings
from reference.random_curves import random_polygon, ribbon_outline

NOT_ONCE = [name for name, known in CURVES.items() if known.turning_number != 1]


def lobes_at(points, place):
    """The two lobes at a crossing of a polygon, as polygons themselves."""
    (meeting,) = (m for m in crossings.meetings(crossings.exact(points)) if np.allclose(place, [*map(float, m.point)]))
    corner = tuple(map(float, meeting.point))
    first, second = meeting.first + 1, meeting.second + 1
    return [corner, *points[first:second]], [corner, *points[second:], *points[:first]]


def refused(points):
    found = pf.find_immersion(points)
    return found if not found and found.reason == "turning number" else None


def test_a_curve_that_does_not_turn_once_has_a_place():
    seen = 0
    for seed in range(150):
        points = random_polygon(np.random.default_rng(seed), 3 + seed % 8)
        if (why := refused(points)) is None:
            continue
        seen += 1
        turning = abs(crossings.turning_number(points))
        left = [abs(crossings.turning_number(lobe)) for lobe in lobes_at(points, why.where[0])]
        # One of the two lobes turns once, or at least nearer to it than the curve.
        assert min(abs(turns - 1) for turns in left) < abs(turning - 1) or len(why.where) == 2
    assert seen > 60


def off(points, cusps):
    """By how much a polygon with so many turns at cusps does not turn as often as the outline of a disk."""
    return abs(abs(crossings.turning_number(points)) - 1 - cusps)


def random_cusps(rng, points):
    """One to three cusps of index 1 or 2."""
    return {int(i): int(rng.integers(1, 3)) for i in rng.integers(0, len(points), int(rng.integers(1, 4)))}


def places_of(points, cusps):
    """Where a curve with cusps turns too often, or not often enough; nothing if that is not what is wrong with it."""
    why = pf.find_immersion(pf.Curve(points, cusps=cusps))
    return why.where if not why and why.reason == "turning number" else ()


def nearer_without(points, cusps, place):
    """By how much a lobe at a crossing is nearer to the outline of a disk, or the curve with a cusp less."""
    total = sum(cusps.values())
    if place in points:
        return off(points, total) - off(points, total - cusps[points.index(place)])
    lobes = lobes_at(points, place)
    inside = [sum(cusps.get(points.index(point), 0) for point in lobe[1:]) for lobe in lobes]
    return off(points, total) - min(map(off, lobes, inside))


def test_with_cusps_the_place_is_one_of_them_or_a_lobe():
    seen = {True: 0, False: 0}
    for seed in range(400):
        rng = np.random.default_rng(seed)
        points = random_polygon(rng, 9)
        cusps = random_cusps(rng, points)
        places = places_of(points, cusps)
        if len(places) == 1:
            assert nearer_without(points, cusps, places[0]) > 0
            seen[places[0] in points] += 1
    assert all(seen.values())


def test_a_cusp_on_a_disk_without_any_is_the_place():
    ramp = [(0, 0), (3.5, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    assert pf.find_immersion(ramp)
    assert places_of(ramp, {1: 1}) == ((3.5, 0.0),)


def test_a_curve_with_a_cusp_that_turns_once_has_a_place():
    """It would be right without its cusp, by how often it turns alone."""
    points = [(2, 6), (-5, 4), (-6, 5), (-1, 2), (-4, 4), (3, -1), (5, 3), (1, -2)]
    places = places_of(points, {4: 1})
    assert len(places) == 2
    assert all(lobes_at(points, place) for place in places)


def test_a_curl_is_the_place():
    curl = [(0, 0), (6, 0), (6, 3), (5, 3), (5, -1), (7, -1), (7, 6), (0, 6)]
    assert pf.find_immersion(curl).where == ((5.0, 0.0),)
    with pytest.raises(pf.errors.NotImmersibleError) as caught:
        pf.lift(curl)
    assert caught.value.where == ((5.0, 0.0),)
    assert pf.embed_cased(curl, [True]).where == ((5.0, 0.0),)


@pytest.mark.parametrize("name", NOT_ONCE)
def test_python_the_command_line_and_the_page_name_the_same_place(name, capsys):
    curve = CURVES[name].curve
    places = [list(place) for place in pf.find_immersion(curve).where]
    assert places
    stroke = Stroke(tuple((float(x), float(y)) for x, y in curve.points), closed=True)
    assert look_at(Look((stroke,)))["verdict"]["where"] == places
    assert main(["check", f"gallery:{name}", "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["where"] == places
    assert main(["check", f"gallery:{name}"]) == 1
    assert f"at ({places[0][0]:.6g}, {places[0][1]:.6g})" in capsys.readouterr().out


def test_one_curl_of_a_long_ribbon_is_the_place():
    points = np.array(ribbon_outline(np.random.default_rng(3), 1500, 0.05, 100_000), dtype=float)
    lowest = int(points[:, 1].argmin())
    start, (x, y) = points[lowest], points[lowest + 1] - points[lowest]
    curl = start + np.array([(0.5, 0), (0.3, -0.1), (0.2, -0.1)]) @ [(x, y), (-y, x)]
    why = refused(np.insert(points, lowest + 1, curl, axis=0))
    assert why.value == 0
    assert np.hypot(*(why.where[0] - start)) < np.hypot(x, y)


def test_a_code_without_a_drawing_has_no_place():
    assert pf.find_immersion(pf.GaussCode.parse("1+ 1- / outer 1")).where == ()
