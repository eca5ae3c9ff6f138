"""Repairs of outlines against the slow reference, and what they promise: caps, polygons, independence of the start."""

import numpy as np
import pytest

import plyfold as pf
from reference.random_curves import random_polygon, smooth_curve
from repaired import agree, as_close, check_promises, is_disk_by_reference
from strokes import stroke

NO_CAPS = (float("inf"), float("inf"))
CORNER = [(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
WAIST = [(0, 0), (40, 21), (60, 21), (100, 0), (100, 40), (60, 20), (40, 20), (0, 40)]


@pytest.mark.parametrize("seed", range(40))
def test_as_by_definition(seed):
    rng = np.random.default_rng(seed)
    for polygon in (random_polygon(rng, int(rng.integers(4, 9))), smooth_curve(rng, 3, samples=40)):
        for caps in ((0.01, 0.2), (0.2, 0.5), NO_CAPS):
            agree(polygon, caps)


@pytest.mark.parametrize("seed", range(20))
def test_strokes_as_by_definition(seed):
    agree(stroke(np.random.default_rng(seed), 5), (0.01, 0.2))


@pytest.mark.parametrize("batch", range(10))
def test_a_thousand_strokes_become_disks(batch):
    n_changed = 0
    for seed in range(100 * batch, 100 * batch + 100):
        rng = np.random.default_rng(seed)
        polygon = stroke(rng, int(rng.integers(2, 6)))
        found = pf.repair(polygon, 0.01, 0.5)
        if not found:
            # The end of the stroke lies within its beginning, or there is no small repair at all.
            assert found.reason == "repair"
            continue
        check_promises(polygon, found, (0.01, 0.5))
        assert is_disk_by_reference(found.outline)
        n_changed += bool(found.changes)
    assert n_changed > 40


@pytest.mark.parametrize("seed", range(30))
def test_longer_strokes_become_disks(seed):
    rng = np.random.default_rng(seed)
    polygon = stroke(rng, int(rng.integers(8, 25)))
    found = pf.repair(polygon, 0.01, 0.5)
    if found:
        check_promises(polygon, found, (0.01, 0.5))
        assert is_disk_by_reference(found.outline) in (True, None)


@pytest.mark.parametrize("seed", range(25))
def test_neither_start_nor_direction_nor_unit_matters(seed):
    rng = np.random.default_rng(seed)
    polygon = stroke(rng, 8) if seed % 2 else np.array(random_polygon(rng, 7), dtype=float)
    caps = (0.01, 0.5) if seed % 2 else (0.3, 2.0)
    found = pf.repair(polygon, *caps)
    as_close(pf.repair(np.roll(polygon, -3, axis=0), *caps), found)
    as_close(pf.repair(polygon[::-1], *caps), found)
    scaled = pf.repair(polygon * 2.0**-30, *caps)
    assert bool(scaled) == bool(found)
    if found:
        assert np.array_equal(scaled.outline.points, found.outline.points * 2.0**-30)
        # No two moves tie in random drawings, so the mirror image is repaired alike; corners are rounded alike, too.
        mirrored = pf.repair(polygon * [-1, 1], *caps)
        assert np.array_equal(mirrored.outline.points, found.outline.points * [-1, 1])


@pytest.mark.parametrize("seed", [*range(20), 71])
def test_no_power_of_two_matters(seed):
    rng = np.random.default_rng(10_000 + seed)
    polygon = rng.normal(size=(int(rng.integers(3, 12)) + 3, 2))
    caps = [(0.05, 0.5), (0.3, 1.0), (1.0, 1.0)][(seed + 1) % 3]
    found = pf.repair(polygon, *caps)
    for power in (-300, -20, 17, 20, 300):
        scaled = pf.repair(polygon * 2.0**power, *caps)
        assert bool(scaled) == bool(found)
        if found:
            assert np.array_equal(scaled.outline.points, found.outline.points * 2.0**power)
            assert scaled.region_change == found.region_change
            assert scaled.layer_change == found.layer_change
        else:
            assert scaled.value == found.value


@pytest.mark.parametrize("scale", [1e-6, 1, 1e4])
def test_wide_lenses_of_large_coordinates_are_no_hairs(scale):
    star = [(231, 512), (414, 33), (0, 324), (512, 359), (139, 0)]
    found = pf.repair(np.array(star) * scale)
    assert not found
    assert found.value["region"] > 0.2


def test_of_equal_loops_the_one_furthest_left_goes_first():
    half = [(0, 0), (40, 0), (40, 6), (36, 6), (36, -4), (44, -4), (44, 0), (80, 0)]
    polygon = np.array([*half, *((80 - x, 60 - y) for x, y in half)], dtype=float)
    assert pf.arrange(polygon).n_crossings == 2
    for turned in (polygon, polygon[::-1], np.roll(polygon, 9, axis=0), polygon * [-1, 1], polygon * [1, -1]):
        found = pf.repair(turned)
        one, other = found.changes
        assert one.where < other.where
        assert one.layers == pytest.approx(other.layers, rel=1e-12)
        check_promises(turned, found)


def test_nothing_to_do():
    square = pf.Curve([(0, 0), (1, 0), (1, 0), (1, 1), (0, 1)])
    found = pf.repair(square)
    assert found.changes == ()
    assert found.outline.points.tolist() == square.points.tolist()
    assert found.outline.repairs == square.repairs
    assert (found.region_change, found.layer_change) == (0, 0)
    assert repr(found) == "<Repaired: nothing changed; 0 of the region, 0 of the layers>"


def test_corner():
    found = pf.repair(CORNER)
    assert found.outline.points.tolist() == [[0, 0], [60, 0], [60, 40], [0, 40]]
    (change,) = found.changes
    assert (change.kind, change.where) == ("loop left out", (60, 40))
    assert found.region_change == pytest.approx(1 / 2401) == change.region


def test_a_lens_is_undone():
    found = pf.repair(WAIST)
    (change,) = found.changes
    assert change.kind == "lens undone"
    assert found.region_change == 0
    assert len(change.polygons) == 2
    check_promises(WAIST, found)
    assert pf.bounds_disk(found.outline)


@pytest.mark.parametrize("seed", [0, 2, 4, 5, 7, 9, 10, 11, 12, 13])
def test_a_lens_as_narrow_as_rounding(seed):
    start, end = np.array([(1033.0, 309.0), (1024.0, 512.0)])
    one, other = (start + share * (end - start) for share in sorted(np.random.default_rng(seed).uniform(0.1, 0.3, 2)))
    polygon = np.array([start, end, (879, 332), (968, 318.7), (968, other[1]), other, one, (one[0], 309.1)])
    drawn = pf.arrange(polygon, "raise")
    assert (drawn.n_crossings, drawn.winding.min()) == (2, -1)
    found = pf.repair(polygon)
    assert [change.kind for change in found.changes] == ["lens undone"]
    check_promises(polygon, found)


def test_bow_ties_are_refused():
    found = pf.repair(EIGHT)
    assert not found
    assert found.reason == "repair"
    assert found.value == {"region": 0.5, "layers": 0.5}
    assert found.where == ((1.0, 1.0),)
    assert "50% of the region" in str(found)
    check_promises(EIGHT, pf.repair(EIGHT, 0.5, 0.5), (0.5, 0.5))
    assert not pf.repair(EIGHT, np.nextafter(0.5, 0), 0.5)


def test_what_exceeds_the_caps_least_is_named_and_what_changes_less_of_one_kind():
    # A triangle with a loop at each corner. Turning its middle round changes all layers, and less of the region.
    tips = [(-4, 0), (104, 0), (102.5, -4), (47.5, 84), (52.5, 84), (-2.5, -4)]
    found = pf.repair(tips, 0.001)
    assert found.value == {"region": pytest.approx(26 / 4026), "layers": pytest.approx(26 / 4026)}
    assert "with 3 loops left out, which changes 0.646% of the region and 0.646% of the layers, or" in str(found)
    assert "1 loop left out and 1 lens undone, which changes 0.199% of the region and 199% of the layers" in str(found)
    assert len(found.where) == 3
    assert pf.repair(tips, found.value["region"] * (1 + 1e-9), found.value["layers"] * (1 + 1e-9))


@pytest.mark.parametrize("seed", range(40))
def test_what_would_do_is_as_by_definition(seed):
    rng = np.random.default_rng(seed)
    agree(random_polygon(rng, int(rng.integers(4, 8))), (0.02, 0.05))


def test_spikes_are_reported():
    found = pf.repair([(0, 0), (60, 0), (60, 60), (60, 90), (60, 60), (0, 60)])
    assert [change.kind for change in found.changes] == ["spike taken out"]
    assert found.changes[0].where == (60, 90)
    assert found.outline.points.tolist() == [[0, 0], [60, 0], [60, 60], [0, 60]]


def test_several_loops():
    hole = [(10, 10), (10, 20), (30, 20), (30, 9), (31, 9), (31, 10)]
    outline = pf.Outline([CORNER, hole])
    found = pf.repair(outline)
    assert [change.where for change in found.changes] == [(30, 10), (60, 40)]
    assert [loop.tolist() for loop in found.outline.loops] == [
        [[0, 0], [60, 0], [60, 40], [0, 40]],
        [[10, 10], [10, 20], [30, 20], [30, 10]],
    ]
    check_promises([CORNER, hole], found)


def test_loops_may_share_a_lens():
    ring = [(-20, -20), (60, -20), (60, 60), (-20, 60)]
    hole = [(0, 0), (0, 40), (40, 40), (61, 20), (40, 0)]
    found = pf.repair([ring, hole])
    assert [change.kind for change in found.changes] == ["lens undone"]
    assert found.region_change == 0
    check_promises([ring, hole], found)


def test_cusps_stay():
    limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    marked = pf.Curve(limacon, cusps={7: 1})
    assert pf.repair(marked).changes == ()
    curl = [(3, 0), (1, 3), (-2.02, 0), (-2.02, -0.02), (-1.98, -0.02), *limacon[3:]]
    found = pf.repair(pf.Curve(curl, cusps={9: 1}), 0.05)
    assert found.outline.cusps[0].sum() == 1
    assert found.outline.points[found.outline.cusps[0] > 0].tolist() == [[1, -1]]


def test_what_it_takes():
    with pytest.raises(pf.errors.InputError, match="allow must be a number"):
        pf.repair(CORNER, allow="much")
    with pytest.raises(pf.errors.InputError, match="from 0 on"):
        pf.repair(CORNER, allow_layers=-1)
    with pytest.raises(pf.errors.InputError, match="no points"):
        pf.repair(pf.Arrangement.from_gauss([1, 0], [True, False], outer=1))


def test_no_time():
    found = pf.repair(CORNER, time_limit=0.0)
    assert isinstance(found, pf.Unknown)
    assert found.reason == "time limit"
