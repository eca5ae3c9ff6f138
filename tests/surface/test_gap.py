"""The gap that fits the cloth: 1/20 of the drawing, or 1/5 of the cloth's mean width."""

import numpy as np
import pytest
from families import FAMILIES

import plyfold as pf
from plyfold.gallery import CURVES, OUTLINES
from plyfold.surface.gap import fitting_gap

ALL = CURVES | OUTLINES


def steepest(surface):
    """Return the slope in degrees that a hundredth of the area, seen from above, exceeds."""
    a, b, c = np.moveaxis(surface.vertices[surface.faces], 1, 0)
    x, y, area = np.cross(b - a, c - a).T
    angle = np.degrees(np.arctan2(np.hypot(x, y), area))
    steep = np.argsort(-angle)
    return angle[steep][np.searchsorted(np.cumsum(area[steep]), 0.01 * area.sum())]


def width_of(surface):
    """Return the mean width of a surface, from its own triangles."""
    corners = surface.vertices[surface.faces][:, :, :2]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    length = sum(np.hypot(*(loop - np.roll(loop, 1, axis=0)).T).sum() for loop in surface.outline.loops)
    return float((ax * by - ay * bx).sum() / length)


@pytest.mark.parametrize("name", ["milnor", "exit-ramp", "letter-b", "linked-rings", "disk-with-handle"])
def test_the_mean_width_is_that_of_the_triangles(name):
    surface = pf.lift(ALL[name].outline, triangles=500)
    size = np.ptp(surface.outline.points, axis=0).max()
    assert surface.gap == pytest.approx(min(size / 20, width_of(surface) / 5), rel=1e-9)


@pytest.mark.parametrize("scale", [1e-8, 1.0, 1e8])
def test_it_belongs_to_the_drawing(scale):
    points = CURVES["exit-ramp"].curve.points
    gap = scale * fitting_gap(pf.Curve(points))
    turned = points @ [[0, 1], [-1, 0]]
    for drawn in (points, points[::-1], np.roll(points, 5, axis=0), turned, points * [-1, 1], points + 1000):
        assert pf.lift(scale * drawn, triangles=100).gap == pytest.approx(gap, rel=1e-9)


def test_one_that_is_given_is_taken():
    strip = [(0, 0), (99, 0), (99, 1), (0, 1)]
    assert pf.lift(strip, triangles=50).gap == pytest.approx(0.4 * 99 / 200)
    assert pf.lift(strip, triangles=50, gap=4.95).gap == 4.95


def test_without_cloth_it_is_that_of_the_drawing():
    there_and_back = pf.Curve([(0, 0), (8, 0), (8, 8), (9, 9), (8, 8), (8, 0)])
    assert fitting_gap(there_and_back) == 9 / 20


@pytest.mark.parametrize(("name", "points"), [("chain", 1500), ("ribbon", 3000), ("wild-ribbon", 1000)])
def test_long_ribbons_are_not_steep(name, points):
    drawn = FAMILIES[name].draw(points, 0)
    assert steepest(pf.lift(drawn)) <= 35
