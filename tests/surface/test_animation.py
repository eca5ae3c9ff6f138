"""The motion from the round disk to the surface."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.errors import InputError
from plyfold.gallery import CURVES
from plyfold.surface.animation import Motion


def motion_of(name, triangles=300):
    return Motion(pf.lift(CURVES[name].curve, triangles=triangles).unwrap())


def sides(points, faces):
    return np.hypot(*(points[faces] - points[np.roll(faces, 1, axis=1)]).reshape(-1, 2).T)


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
    faces = motion.unwound.faces

    def turning(points):
        outline = points[motion.unwound.boundary, 0] + 1j * points[motion.unwound.boundary, 1]
        half = outline[: len(outline) // 2]
        return np.angle(np.diff(half)[1:] / np.diff(half)[:-1]).sum()

    start, middle, end = (turning(motion.at(time)) for time in (0.0, 0.5, 1.0))
    assert abs(end - start) > 4 * np.pi
    assert min(start, end) + np.pi < middle < max(start, end) - np.pi
    a, b, c = motion.at(0.5)[:, :2][faces].swapaxes(0, 1)
    turned = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert (turned > 0).mean() > 0.98


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
