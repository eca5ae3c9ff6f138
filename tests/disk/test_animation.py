"""The motion from the round disk to the surface."""

from itertools import pairwise

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.disk.motion import Motion, turned_over
from plyfold.errors import InputError
from reference import random_curves


def motion_of(name, triangles=300):
    return Motion(pf.lift(CURVES[name].curve, triangles=triangles).unwrap())


def sides(points, faces):
    return np.hypot(*(points[faces] - points[np.roll(faces, 1, axis=1)]).reshape(-1, 2).T)


def areas(points, faces):
    (ux, uy), (vx, vy) = (points[faces[:, i], :2].T - points[faces[:, 0], :2].T for i in (1, 2))
    return ux * vy - uy * vx


DISKS = [name for name, named in CURVES.items() if named.immersions and name != "seven-flaps"]


@pytest.mark.parametrize("name", DISKS)
def test_no_triangle_turns_over(name):
    """At no time, and neither on the straight ways between a dozen shapes, of which each is tried in its middle."""
    motion = Motion(pf.unwrap(CURVES[name].curve, triangles=1000))
    faces = motion.unwound.faces
    shapes = [motion.at(time) for time in np.linspace(0, 1, 13)]
    for before, after in pairwise(shapes):
        for share in (0, 0.25, 0.5, 0.75):
            assert (areas((1 - share) * before + share * after, faces) > 0).all()


@pytest.mark.parametrize("time", [0.001, 0.013, 0.35, 0.7, 0.993])
def test_lengths_go_from_those_of_the_disk_to_those_of_the_drawing(time):
    """Compared triangle by triangle: those in between are never much thinner than the thinner of both ends."""
    motion = motion_of("two-loops")
    faces = motion.unwound.faces

    def roundness(points):
        return areas(points, faces) / (sides(points[:, :2], faces).reshape(-1, 3) ** 2).sum(axis=1)

    ends = np.minimum(roundness(motion.at(0.0)), roundness(motion.at(1.0)))
    assert (roundness(motion.at(time)) > 0.3 * ends).all()


@pytest.mark.parametrize("name", ["two-loops", "stacked-spiral", "milnor", "smallest-unliftable"])
def test_straight_ways_between_shapes(name):
    motion = Motion(pf.unwrap(CURVES[name].curve, triangles=1000))
    faces, shapes = motion.unwound.faces, motion.shapes(16)
    assert (shapes[0] == motion.unwound.plane).all()
    assert (shapes[-1] == motion.disk).all()
    assert 5 <= len(shapes) <= 9
    for before, after in pairwise(shapes):
        assert turned_over(before, after, faces) == 0
        for share in np.linspace(0, 1, 21):
            assert (areas((1 - share) * before + share * after, faces) > 0).all()


def test_turned_over_counts_what_a_fine_sampling_finds():
    rng = np.random.default_rng(0)
    faces, found = np.arange(600).reshape(-1, 3), 0
    before, after = rng.normal(size=(2, 600, 2))
    for points in (before, after):
        flipped = areas(points, faces) < 0
        points[faces[flipped, 1]], points[faces[flipped, 2]] = points[faces[flipped, 2]], points[faces[flipped, 1]]
    share = np.linspace(0, 1, 2001)
    least = np.min([areas((1 - t) * before + t * after, faces) for t in share], axis=0)
    found = turned_over(before, after, faces)
    assert 20 < found < 180
    assert abs(found - (least <= 0).sum()) <= 1


@pytest.mark.parametrize("scale", [1e-120, 1e120])
def test_scale_changes_nothing(scale):
    points = CURVES["exit-ramp"].curve.points
    plain, scaled = (Motion(pf.unwrap(outline, triangles=1)) for outline in (points, scale * points))
    assert scaled.at(0.4) == pytest.approx(scale * plain.at(0.4), abs=1e-6 * scale * np.ptp(points))
    assert len(scaled.shapes(17)) == len(plain.shapes(17))


@pytest.mark.parametrize("seed", range(6))
def test_random_disks(seed):
    """Sharp corners, thin cells and long ribbons: no triangle turns over, but for single ones in coarse meshes."""
    rng = np.random.default_rng(seed)
    for outline in (random_curves.glued_disk(rng, 12), random_curves.ribbon_outline(rng, 40)):
        motion = Motion(pf.unwrap(outline, triangles=300))
        for time in (0.2, 0.5, 0.8):
            assert (areas(motion.at(time), motion.unwound.faces) <= 0).sum() <= 1


def test_one_triangle():
    motion = Motion(pf.unwrap([(0, 0), (2, 0), (0, 1)], triangles=1))
    assert all((areas(shape, motion.unwound.faces) > 0).all() for shape in motion.shapes(17))


def test_shapes_are_no_more_than_allowed():
    """A helix turns so far that a few shapes do not do."""
    angle = np.linspace(0, 8 * np.pi, 240)
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    helix = np.concatenate([(3 + 0.05 * angle)[:, None] * way, ((2 + 0.05 * angle)[:, None] * way)[::-1]])
    motion = Motion(pf.unwrap(helix, triangles=1))
    assert len(motion.shapes(4)) == 5
    assert 6 < len(motion.shapes(17)) <= 17


def test_uneven_cloth_loses_few_triangles():
    """What the documentation says: where no lengths fit together, single triangles turn over."""
    motion = Motion(pf.unwrap(CURVES["seven-flaps"].curve))
    for time in (0.1, 0.2, 0.35, 0.6):
        assert (areas(motion.at(time), motion.unwound.faces) <= 0).mean() <= 0.002


@pytest.mark.parametrize("name", ["exit-ramp", "stacked-spiral", "bennequin"])
def test_stations(name):
    """At time 0 similar to the unwound disk, at 1 the drawing, at 2 the surface."""
    motion = motion_of(name)
    unwound = motion.unwound
    disk = motion.at(0.0)
    ratio = sides(disk[:, :2], unwound.faces) / sides(unwound.disk, unwound.faces)
    assert ratio == pytest.approx(np.ptp(unwound.plane, axis=0).max() / 2)
    assert (motion.at(1.0)[:, :2] == unwound.plane).all()
    assert (motion.at(1.0)[:, 2] == 0).all()
    assert (motion.at(2.0) == unwound.space).all()
    assert (motion.at(1.5) == unwound.space * [1, 1, 0.5]).all()


@pytest.mark.parametrize("name", ["exit-ramp", "stacked-spiral", "bennequin"])
def test_no_jumps(name):
    """Ever smaller steps of time make ever smaller steps of the vertices, at the stations too."""
    motion = motion_of(name)
    size = np.ptp(motion.unwound.plane)
    for time in (1e-6, 0.3, 0.7, 1 - 1e-6, 1 + 1e-6):
        before, after = motion.at(time - 1e-6), motion.at(min(time + 1e-6, 2.0))
        assert np.abs(after - before).max() < 1e-4 * size


def test_a_spiral_unrolls():
    """It winds several times round; halfway it winds half as often, and its triangles are not crushed."""
    motion = motion_of("stacked-spiral", triangles=1000)

    def turning(points):
        outline = points[motion.unwound.boundary, 0] + 1j * points[motion.unwound.boundary, 1]
        half = outline[: len(outline) // 2]
        return np.angle(np.diff(half)[1:] / np.diff(half)[:-1]).sum()

    start, middle, end = (turning(motion.at(time)) for time in (0.0, 0.5, 1.0))
    assert abs(end - start) > 4 * np.pi
    assert min(start, end) + np.pi < middle < max(start, end) - np.pi
    assert (areas(motion.at(0.5), motion.unwound.faces) > 0).all()


@pytest.mark.parametrize("angle", [0.3, 2.0, -2.8])
def test_a_turned_drawing_has_a_turned_motion(angle):
    """The disk is turned to fit the drawing, so nothing depends on how the drawing lies."""
    points = CURVES["exit-ramp"].draw()
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    plain, turned = (pf.unwrap(outline, triangles=1) for outline in (points, points @ turn))
    # The middle and size are those of a box that does not turn with the drawing: compare the direction of a chord.
    first, other = (Motion(unwound).disk[:2] for unwound in (plain, turned))
    way, turned_way = (first[1] - first[0]) @ turn, other[1] - other[0]
    assert turned_way / np.hypot(*turned_way) == pytest.approx(way / np.hypot(*way), abs=0.05)


def test_thickness_keeps_sheets_in_their_order():
    motion = motion_of("exit-ramp")
    assert (motion.at(0.5, thickness=0.1)[:, 2] == 0.1 * motion.unwound.space[:, 2]).all()
    assert (motion.at(1.5, thickness=0.1)[:, 2] == 0.5 * motion.unwound.space[:, 2]).all()


@pytest.mark.parametrize("time", [-0.1, 2.1, np.nan])
def test_times_beyond_the_motion(time):
    with pytest.raises(InputError, match="time"):
        motion_of("circle", 50).at(time)


def test_a_disk_that_has_not_been_lifted_ends_flat():
    motion = Motion(pf.unwrap(CURVES["circle"].curve, triangles=50))
    assert (motion.at(1.0)[:, 2] == 0).all()
    with pytest.raises(InputError, match="from 0 to 1"):
        motion.at(1.5)
    with pytest.raises(InputError, match="thickness"):
        motion.at(0.5, thickness=2.0)
