"""Walls of solids, compared with many points of both sides that see each other."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

import plyfold as pf
from coarse import CURVES
from plyfold.errors import InputError, WallError

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
# Two banks beside a slit that is narrower than they are thick.
SLIT = [(0, 0), (2, 0), (2, 3), (2.05, 3), (2.05, 0), (4, 0), (4, 4), (0, 4)]
DIVISIONS = 7


def on_heights(outline, heights, triangles=40):
    """The flat surface of an outline, with other heights."""
    surface = pf.lift(outline, triangles=triangles)
    x, y, _ = surface.vertices.T
    return replace(surface, vertices=np.column_stack([x, y, heights(x, y)]))


def sampled(vertices, faces):
    """Points of all triangles, evenly."""
    shares = [(i, j, DIVISIONS - i - j) for i in range(DIVISIONS + 1) for j in range(DIVISIONS + 1 - i)]
    return np.einsum("sk,tkx->tsx", np.array(shares) / DIVISIONS, vertices[faces]).reshape(-1, 3)


def slow_wall(solid, outline):
    """The least distance of sampled points of both sides that see each other, seen from above, inside of a polygon."""
    faces = solid.surface.faces
    upper, lower = (np.unique(sampled(solid.vertices, side), axis=0) for side in (faces, solid.below[faces]))
    distance = np.linalg.norm(upper[:, None] - lower, axis=2).ravel()
    inside = shapely.Polygon(outline).buffer(1e-9)
    for pair in np.argsort(distance, kind="stable"):
        i, j = divmod(int(pair), len(lower))
        if inside.covers(shapely.LineString([upper[i, :2], lower[j, :2]])):
            return float(distance[pair])
    raise AssertionError("a point sees the one right below it")


def waves(rng):
    a, b, c, d = rng.uniform(-2, 2, 4)
    return lambda x, y: np.sin(a * x + b * y) + np.cos(c * x - d * y) + rng.uniform(-0.1, 0.1, len(x))


@pytest.mark.parametrize("outline", [SQUARE, SLIT], ids=["square", "slit"])
@pytest.mark.parametrize("seed", range(5))
def test_as_sampled(outline, seed):
    rng = np.random.default_rng(seed)
    solid = on_heights(outline, waves(rng)).thicken(rng.uniform(0.1, 1.0))
    corners = solid.surface.vertices[solid.surface.faces]
    pitch = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() / DIVISIONS
    slow = slow_wall(solid, outline)
    assert slow - pitch <= solid.wall.length <= slow + 1e-9
    assert np.linalg.norm(np.subtract(*solid.wall.ends)) == pytest.approx(solid.wall.length)


def test_a_slope():
    """A plane that rises by 3 of 4."""
    solid = on_heights(SQUARE, lambda x, y: 0.75 * x).thicken(0.5)
    assert solid.wall.length == pytest.approx(0.4)
    upper, lower = solid.wall.ends
    assert (upper - lower) / solid.wall.length == pytest.approx([-0.6, 0, 0.8])


def test_a_slit_is_no_wall():
    """The banks are so high above each other that the upper side of one is beside the lower side of the other."""

    def banks(x, y):
        return np.where(x > 2.02, 0.3, -0.3) * np.minimum((3 - y).clip(0) / 2, 1)

    solid = on_heights(SLIT, banks, triangles=300).thicken(0.6)
    assert solid.wall.length > 0.4


def test_air_is_no_wall():
    surface = pf.lift(CURVES["exit-ramp"].curve, triangles=300)
    solid = surface.thicken(0.9 * surface.gap)
    assert solid.wall.length > 0.8 * solid.height


@pytest.mark.parametrize("scale", [2.0**-27, 2.0**27])
def test_scaled(scale):
    walls = [
        pf.lift(factor * np.array(CURVES["milnor"].draw()), gap=20.0 * factor, triangles=300).thicken(8 * factor).wall
        for factor in (1.0, scale)
    ]
    assert walls[1].length == pytest.approx(scale * walls[0].length, rel=1e-9)


def test_level_slabs():
    solid = pf.lift(SQUARE, triangles=100).thicken(0.5)
    assert solid.wall.length == 0.5
    assert solid.volume == pytest.approx(8.0)
    assert solid.overhang() == pytest.approx(16 / (32 + 8))
    assert solid.overhang(0.0) == pytest.approx(16 / (32 + 8))


def test_overhang_leans_more_than_the_angle():
    """The lower side of a plane that rises by one of one leans by 45 degrees."""
    solid = on_heights(SQUARE, lambda x, y: x).thicken(0.5)
    assert solid.overhang(44.9) > 0.3
    assert solid.overhang(45.1) == 0.0
    with pytest.raises(InputError, match="angle"):
        solid.overhang(90.0)


def test_rims_are_no_walls():
    body = pf.lift(SQUARE, triangles=400).inflate(1.0)
    assert 0 < body.wall.length < 1.0
    assert pf.lift(SQUARE, triangles=400).inflate(40.0).wall is None


# ---- walls that are asked for ----------------------------------------------------------------------------------------


def test_least_walls_are_made():
    surface = pf.lift(CURVES["milnor"].curve, triangles=600)
    plain = surface.thicken(0.4 * surface.gap)
    wall = 1.5 * plain.wall.length
    solid = surface.thicken(0.4 * surface.gap, min_wall=wall)
    solid.check()
    assert plain.wall.length < wall <= solid.wall.length
    assert (solid.thickness >= plain.thickness).all()
    assert solid.height > plain.height


def test_where_nothing_is_missing_nothing_changes():
    surface = pf.lift(CURVES["exit-ramp"].curve, triangles=300)
    plain, walled = surface.thicken(0.2), surface.thicken(0.2, min_wall=0.1)
    assert np.array_equal(plain.vertices, walled.vertices)


def test_no_room_for_walls():
    surface = pf.lift(CURVES["milnor"].curve, triangles=600)
    with pytest.raises(WallError, match="no room") as caught:
        surface.thicken(0.4 * surface.gap, min_wall=0.9 * surface.gap)
    assert caught.value.where
    assert caught.value.hint


@pytest.mark.parametrize("wall", [0.0, -1.0, np.nan, np.inf, "thick"])
def test_wrong_walls(wall):
    with pytest.raises(InputError, match="wall"):
        pf.lift(SQUARE, triangles=20).thicken(0.1, min_wall=wall)
