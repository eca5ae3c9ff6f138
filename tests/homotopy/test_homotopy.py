"""Least homotopies against all ways to cut a curve, and against themselves."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.errors import InputError, MemoryLimitError
from plyfold.homotopy.cancellation import _in_pairs
from plyfold.offers.areas import areas_of
from reference.homotopies import least_area
from reference.planar_maps import cell_of_dart, census, gauss_code, reversed_code
from reference.random_curves import glued_disk, random_polygon

PUBLISHED = [
    ([(1, 0), (2, 2), (0, 3), (-2, 2), (-1, 0), (1, 1), (-1, 2), (1, 2), (-1, 1)], 8.0),
    (
        [(1, 0), (2, 1), (1, 2), (2, 2), (1, 1), (2, 0), (3, 0), (3, 3), (-3, 3), (-3, 0), (-2, 0), (-1, 1), (-2, 2),
         (-1, 2), (-2, 1), (-1, 0)],
        18.0,
    ),
    ([(1, 0), (3, 0), (3, 4), (-3, 4), (-3, 0), (-1, 0), (1, 1), (1, 3), (2.2, 2), (-2, 2), (-1, 3), (-1, 1)], 25.9),
]  # fmt: skip
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]


def weights_of(code, arranged, weights):
    """Weights of the reference's cells as those of an arrangement of the same code, which may be turned round."""
    here = cell_of_dart(code)
    n = max(1, len(code.partner))
    found = np.zeros(arranged.n_cells)
    for dart, cell in enumerate(here):
        border, backward = divmod(dart, 2)
        same = 2 * ((n - 2 - border) % n) + 1 - backward if arranged.reversed else dart
        found[arranged.cell_of_dart[same]] = weights[cell]
    return found


def judge(code, weights):
    arranged = pf.Arrangement.from_gauss(*code)
    found = pf.least_homotopy(arranged, weights=weights_of(code, arranged, weights))
    found.check()
    assert found.optimal
    outside = cell_of_dart(code)[code.outer]
    assert found.area == least_area(code, [0 if cell == outside else w for cell, w in enumerate(weights)])
    return found


@pytest.mark.parametrize("crossings", [0, 1, 2, 3, 4, pytest.param(5, marks=pytest.mark.slow)])
def test_least_of_all_cuttings_on_every_curve(crossings):
    rng = np.random.default_rng(crossings)
    for code in census(crossings):
        for way in (code, reversed_code(code)):
            judge(way, rng.integers(0, 9, crossings + 2).tolist())


@pytest.mark.slow
def test_least_of_all_cuttings_on_every_curve_with_six_crossings():
    rng = np.random.default_rng(6)
    for code in census(6):
        judge(code, rng.integers(1, 9, 8).tolist())


@settings(max_examples=60)
@given(seed=st.integers(0, 2**32), vertices=st.integers(3, 8))
def test_least_of_all_cuttings_on_random_polygons(seed, vertices):
    arranged = pf.arrange(random_polygon(np.random.default_rng(seed), vertices))
    if arranged.n_crossings <= 8:
        found = pf.least_homotopy(arranged)
        code = gauss_code(*arranged.gauss_code())
        weights = dict(zip(cell_of_dart(code), found.weights[arranged.cell_of_dart], strict=True))
        assert found.area == pytest.approx(least_area(code, [weights[cell] for cell in sorted(weights)]), rel=1e-9)


@settings(max_examples=30)
@given(seed=st.integers(0, 2**32), vertices=st.integers(3, 14), start=st.integers(0, 13))
def test_the_same_from_every_start_and_direction(seed, vertices, start):
    points = random_polygon(np.random.default_rng(seed), vertices)
    found = pf.least_homotopy(points)
    found.check()
    for same in (points[start:] + points[:start], points[::-1], [(x, -y) for x, y in points]):
        assert pf.least_homotopy(same).area == pytest.approx(found.area, rel=1e-9)
    assert found.area >= found.winding_area


def test_loops_are_curves_that_bound_disks():
    rng = np.random.default_rng(7)
    for _ in range(20):
        found = pf.least_homotopy(random_polygon(rng, 12))
        for loop in found.loops:
            drawn = pf.arrange(loop.curve)
            assert pf.bounds_disk(drawn)
            assert pf.GaussCode.of(drawn).canonical() == pf.GaussCode.of(loop.arrangement).canonical()
            area = np.ldexp(areas_of(drawn).rounded, -2 * areas_of(drawn).unit)
            assert (area * drawn.winding).sum() == pytest.approx((found.weights * abs(loop.winding)).sum())
            assert drawn.reversed == (loop.sign < 0)


def test_trees_of_cuts():
    found = pf.least_homotopy(random_polygon(np.random.default_rng(3), 30))
    assert found.loops[0].parent == -1
    assert len(found.cuts) == len(set(found.cuts)) == len(found.loops) - 1 > 3
    for number, loop in enumerate(found.loops[1:], start=1):
        assert loop.parent != number
        around = found.arrangement.crossings[loop.crossing]
        assert (loop.curve.points[0] == around).all()
        assert (found.loops[loop.parent].curve.points == around).all(axis=1).any()


def test_published_areas():
    for points, area in PUBLISHED:
        assert pf.least_homotopy(points).area == pytest.approx(area, rel=1e-12)


def test_a_disk_is_swept_once():
    found = pf.least_homotopy(glued_disk(np.random.default_rng(5), 40))
    assert (found.branch_points, len(found.loops)) == (0, 1)
    assert found.swept.tolist() == found.arrangement.winding.tolist()


def test_branch_points_are_told_by_the_word():
    """Also where cells cost nothing, so that cuts which sweep them too often are as good."""
    twice = pf.GaussCode.parse("1+ 1- / outer 1")
    for weights in ([0, 1, 1], [0, 0, 0]):
        assert pf.least_homotopy(twice, weights=weights).branch_points == 1
    inward = pf.GaussCode.parse("1+ 1- 2- 2+ / outer 3")
    assert pf.least_homotopy(inward).branch_points is None
    assert pf.least_homotopy(EIGHT).branch_points is None


def test_the_end_of_time_leaves_bounds():
    points = random_polygon(np.random.default_rng(1), 60)
    found, best = pf.least_homotopy(pf.arrange(points), time_limit=0), pf.least_homotopy(points)
    found.check()
    assert not found.optimal
    assert found.lower == found.winding_area < best.area < found.area
    assert best.optimal
    assert best.lower == best.area


def test_the_end_of_time_says_where_bounds_meet():
    found = pf.least_homotopy(pf.arrange(EIGHT), time_limit=0)
    assert found.optimal
    assert found.area == found.lower == 2


def test_bounds_instead_of_memory(monkeypatch):
    points = random_polygon(np.random.default_rng(1), 60)
    monkeypatch.setattr("plyfold.memory._SURELY_THERE", 1000)
    monkeypatch.setattr("plyfold.memory.available_memory", lambda: 5_000_000)
    with pytest.raises(MemoryLimitError, match="costs of all stretches"):
        pf.least_homotopy(points)
    assert not pf.least_homotopy(points, time_limit=60).optimal


def test_cusps_are_left_out_of_account():
    limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    found = pf.least_homotopy(pf.Curve(limacon, cusps={6: 1}))
    assert found.area == pf.least_homotopy(limacon).area
    assert found.arrangement.turning_number == 2


def test_loops_that_have_only_begun_to_open_are_codes():
    points = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (0, -4), (-4, -4), (-4, 0)]
    found = pf.least_homotopy(points)
    found.check()
    assert found.area == pytest.approx(32)


@pytest.mark.parametrize("weights", [[1, 2], [0, 1, -1], [0, 1, np.nan], [[0, 1, 1]]])
def test_weights_are_one_number_for_each_cell(weights):
    with pytest.raises(InputError, match="3 numbers from 0 on"):
        pf.least_homotopy(EIGHT, weights=weights)


def test_one_curve_alone():
    with pytest.raises(InputError, match="one closed curve alone"):
        pf.least_homotopy([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])


@pytest.mark.parametrize(
    ("spoiled", "message"),
    [
        ({"swept": lambda found: found.swept + 1}, "sweep what is said"),
        ({"area": lambda found: found.area + 1}, "the area is what they sweep"),
        ({"loops": lambda found: found.loops[::-1]}, "cut off the one"),
        ({"loops": lambda found: found.loops[:-1]}, "joined again"),
        ({"branch_points": lambda _: 7}, "one loop more than branch points"),
    ],
)
def test_checks_refuse_what_is_spoiled(spoiled, message):
    found = pf.least_homotopy(PUBLISHED[2][0])
    with pytest.raises(pf.errors.PlyfoldError, match=message):
        replace(found, **{name: spoil(found) for name, spoil in spoiled.items()}).check()


def test_labels_in_a_circle_become_pairs():
    """Labels can follow each other in a circle, and one label two others: none is in two pairs."""
    assert _in_pairs(np.array([1, 2, 1, -1, 3])).tolist() == [1, -1, -1, -1, 3]
    assert _in_pairs(np.array([1, 0])).tolist() == [1, -1]
