"""Triangles on the curve's own points: certified, and against the dynamic program of Shor and Van Wyk."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.certify import check_immersed_disk
from plyfold.errors import GeneralPositionError, InputError, NotImmersibleError, PlyfoldError
from plyfold.flat.coverage import coverage
from plyfold.flat.decompose import decompose
from plyfold.flat.triangulate import triangulate
from reference import random_curves, shor_van_wyk

RAMP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], dtype=np.float64)
DISKS = [name for name, named in CURVES.items() if named.immersions]


def certify(points, faces):
    """The certificate of an immersed disk with nothing but the polygon's own points."""
    points = np.asarray(points, dtype=np.float64)
    assert faces.shape == (len(points) - 2, 3)
    assert faces.dtype == np.int64
    check_immersed_disk(points, points, faces, boundary=np.arange(len(points)))


def certify_clockwise(points, faces):
    """The same for a curve that runs clockwise: the disk is on the left of the curve run backward."""
    points = np.asarray(points, dtype=np.float64)
    backward = -np.arange(len(points)) % len(points)
    check_immersed_disk(points[backward], points, faces, boundary=backward)


def double_areas(points, faces):
    a, b, c = np.asarray(points, dtype=np.float64)[faces].swapaxes(0, 1)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return ux * vy - uy * vx


def times_covered(points, faces, places):
    """In how many triangles each place lies."""
    corners = np.asarray(points, dtype=np.float64)[np.asarray(faces)]
    inside = np.ones((len(places), len(faces)), dtype=bool)
    for i in range(3):
        start, end = corners[:, i], corners[:, (i + 1) % 3]
        (ux, uy), away = (end - start).T, places[:, None] - start
        inside &= ux * away[..., 1] - uy * away[..., 0] > 0
    return inside.sum(axis=1)


@pytest.mark.parametrize("name", DISKS)
def test_gallery(name):
    """Every immersion has triangles of its own."""
    drawn = pf.arrange(CURVES[name].curve)
    found = [triangulate(drawn, immersion) for immersion in pf.immersions(drawn)]
    for faces in found:
        certify(drawn.curve.points, faces)
    assert len({frozenset(map(frozenset, faces.tolist())) for faces in found}) == CURVES[name].immersions


@pytest.mark.parametrize(("polygon", "layerings"), [(p, layers) for p, _, layers in random_curves.SEVERAL_IMMERSIONS])
def test_several_immersions(polygon, layerings):
    found = [triangulate(polygon, immersion) for immersion in pf.immersions(polygon)]
    for faces in found:
        certify(polygon, faces)
    assert len({frozenset(map(frozenset, faces.tolist())) for faces in found}) == len(layerings)
    assert found[0].tolist() == triangulate(polygon).tolist()


def random_polygons(seed, count):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        yield random_curves.random_polygon(rng, int(rng.integers(4, 9)), size=100)
        yield random_curves.random_polygon(rng, int(rng.integers(9, 15)), size=100)
        yield random_curves.glued_disk(rng, int(rng.integers(2, 20)))
        yield random_curves.ribbon_outline(rng, int(rng.integers(2, 20)))


def test_verdicts_of_the_dynamic_program():
    """The same verdict on random polygons; and the triangles cover random places as often as the program's."""
    rng = np.random.default_rng(7)
    disks, others = 0, 0
    for polygon in random_polygons(seed=3, count=120):
        ordered = polygon if shor_van_wyk.turning_number(polygon) >= 0 else polygon[::-1]
        try:
            pf.arrange(ordered, general_position="raise")
        except GeneralPositionError:
            continue
        expected = shor_van_wyk.triangulation(ordered)
        if expected is None:
            with pytest.raises(NotImmersibleError):
                triangulate(ordered)
            others += 1
        else:
            faces = triangulate(ordered)
            certify(ordered, faces)
            certify(ordered, np.array(expected, dtype=np.int64))
            places = rng.uniform(np.min(ordered, axis=0), np.max(ordered, axis=0), (50, 2))
            assert times_covered(ordered, faces, places).tolist() == times_covered(ordered, expected, places).tolist()
            disks += 1
    assert disks > 150
    assert others > 50


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32), st.sampled_from(["ribbon", "disk"]), st.integers(0, 40))
def test_frames(seed, family, start):
    rng = np.random.default_rng(seed)
    outline = random_curves.ribbon_outline if family == "ribbon" else random_curves.glued_disk
    points = np.array(outline(rng, 20), dtype=np.float64)
    try:
        drawn = pf.arrange(points, general_position="raise")
    except GeneralPositionError:
        return
    faces = triangulate(drawn)
    certify(points, faces)
    for scaled in (points * 1e8, points * 1e-8):
        certify(scaled, triangulate(scaled))
    assert triangulate(np.ldexp(points, 80)).tolist() == faces.tolist()
    moved = np.roll(points, start, axis=0)
    certify(moved, triangulate(moved))
    certify_clockwise(points[::-1], triangulate(points[::-1]))
    mirrored = points * [-1, 1]
    certify_clockwise(mirrored, triangulate(mirrored))


@pytest.mark.parametrize("name", DISKS)
@pytest.mark.parametrize("share", [0.5, 0.01])
def test_refined(name, share):
    """No triangle is too large, the outline is the polygon with no more points, and the area is the same."""
    points = CURVES[name].curve.points
    whole = double_areas(points, triangulate(points)).sum() / 2
    places, faces = triangulate(points, refine=share * whole)
    assert places[: len(points)].tobytes() == points.tobytes()
    check_immersed_disk(points, places, faces, boundary=np.arange(len(points)))
    areas = double_areas(places, faces) / 2
    assert areas.max() <= share * whole * (1 + 1e-9)
    assert areas.sum() == pytest.approx(whole)


def test_refined_clockwise():
    points = RAMP[::-1]
    places, faces = triangulate(points, refine=0.5)
    assert places[: len(points)].tobytes() == points.tobytes()
    backward = -np.arange(len(points)) % len(points)
    check_immersed_disk(points[backward], places, faces, boundary=backward)


def test_refinement_is_limited():
    for refine in (0.0, -1.0, float("nan")):
        with pytest.raises(InputError, match="must be positive"):
            triangulate(RAMP, refine=refine)
    with pytest.raises(InputError, match="too small"):
        triangulate(RAMP, refine=1e-12)


def test_no_disk():
    with pytest.raises(NotImmersibleError) as caught:
        triangulate(CURVES["limacon"].curve)
    assert caught.value.obstruction.reason == "turning number"


def test_what_stands_for_a_curve():
    expected = triangulate(RAMP).tolist()
    closed = np.concatenate([RAMP, RAMP[:1]])
    for curve in (RAMP.tolist(), closed, shapely.LinearRing(RAMP), pf.Curve(RAMP), pf.arrange(RAMP)):
        assert triangulate(curve).tolist() == expected
    assert triangulate([(0, 0), (1, 0), (0, 1)]).tolist() in ([[0, 1, 2]], [[1, 2, 0]], [[2, 0, 1]])


@pytest.mark.parametrize("make", [triangulate, decompose, coverage, lambda code: triangulate(code, refine=1.0)])
def test_codes_have_no_triangles(make):
    with pytest.raises(PlyfoldError, match="Gauss code"):
        make(pf.Arrangement.from_gauss(*pf.arrange(RAMP).gauss_code()))


def test_immersion_of_another_curve():
    immersion = pf.find_immersion(RAMP)
    assert len(triangulate(RAMP, immersion)) == 8
    with pytest.raises(InputError, match="another curve"):
        triangulate(CURVES["circle"].curve, immersion)
    with pytest.raises(InputError, match="another curve"):
        triangulate(pf.arrange(RAMP[::-1]), immersion)
    with pytest.raises(InputError, match="another curve"):
        triangulate(np.roll(RAMP, 1, axis=0), immersion)
    assert len(triangulate(RAMP[::-1], pf.find_immersion(RAMP[::-1]))) == 8


def test_immersion_of_an_equal_arrangement():
    immersion = pf.find_immersion(RAMP)
    assert np.array_equal(triangulate(pf.arrange(RAMP), immersion), triangulate(RAMP, immersion))


@pytest.mark.parametrize("ring", [np.array, shapely.LinearRing], ids=["array", "shapely"])
def test_faces_number_the_points_as_given(ring):
    doubled = np.repeat(RAMP, [1, 2, 1, 1, 3, 1, 1, 1, 1, 2], axis=0)
    faces = triangulate(ring(doubled))
    assert faces.shape == (8, 3)
    assert (double_areas(doubled, faces) > 0).all()
    assert np.array_equal(doubled[faces], np.array(RAMP)[triangulate(RAMP)])
    curve = pf.Curve(doubled)
    assert np.array_equal(curve.points[triangulate(curve)], doubled[faces])


@pytest.mark.parametrize("exponent", range(1, 18))
@pytest.mark.parametrize("turned", [0.0, 0.4])
def test_needles(exponent, turned):
    """However thin the strip, even where no double lies inside it."""
    strip = RAMP.copy()
    strip[8:, 1] = 10.0**-exponent
    cosine, sine = np.cos(turned), np.sin(turned)
    strip = strip @ np.array([[cosine, sine], [-sine, cosine]])
    drawn = pf.arrange(strip)
    certify(drawn.curve.points, triangulate(strip))


def test_flat_corners():
    """Corners of 180 degrees stay corners."""
    points = [(0, 0), (1, 0), (2, 0), (4, 0), (4, 1), (4, 4), (3, 4), (0, 4), (0, 2)]
    certify(points, triangulate(points))


def test_moved_into_general_position():
    """A vertex on another edge: the triangles are those of the points as given."""
    points = RAMP.copy()
    points[5] = (4, 0)
    points[4] = (3, -3)
    drawn = pf.arrange(points)
    assert drawn.curve.repairs
    certify(points, triangulate(points))
    assert triangulate(points, pf.find_immersion(drawn)).tolist() == triangulate(points).tolist()


@pytest.mark.parametrize("name", ["exit-ramp", "pretzel", "ten-gon", "bennequin"])
def test_refined_triangles_are_round_as_a_rule(name):
    """Half of them have all angles above 35 degrees."""
    curve = CURVES[name].curve
    x, y = curve.points.T
    points, faces = triangulate(curve, refine=abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 4000)
    corners = points[faces]
    sides = np.roll(corners, -1, axis=1) - corners
    back = -np.roll(sides, 1, axis=1)
    cross = sides[..., 0] * back[..., 1] - sides[..., 1] * back[..., 0]
    smallest = np.degrees(np.arctan2(cross, (sides * back).sum(axis=2))).min(axis=1)
    assert smallest.min() > 0
    assert np.median(smallest) > 35
    assert (smallest < 10).mean() < 0.15


def test_an_obstruction_in_place_of_an_immersion_says_why():
    eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
    with pytest.raises(NotImmersibleError, match="turns 0 times"):
        triangulate(eight, pf.find_immersion(eight))
    for area in ("a", float("nan"), -1.0, True):
        with pytest.raises(InputError):
            triangulate([(0, 0), (1, 0), (0, 1)], refine=area)
