"""Added points: angles, numbers and sizes, on drawings with tiny cells, thin strips and sharp corners."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.arrangement.arrangement import arrange
from plyfold.errors import InputError
from plyfold.mesh.cells import triangulate_cells
from reference import random_curves

# The ramp with a strand that dips into another one, or a strip, as fine as wanted.
TIP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, 0), (5, 1), (8, 5), (8, 1), (0, 1)], dtype=np.float64)
STRIP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], dtype=np.float64)
ROUND = ("circle", "horseshoe", "exit-ramp", "two-loops", "pretzel", "knotted-ribbon", "pentagram", "two-turn-spiral")


def dipping(depth):
    points = TIP.copy()
    points[4, 1], points[5, 1] = -depth, 1 + 2 * depth
    return points


def thin(width):
    points = STRIP.copy()
    points[8:, 1] = width
    return points


def smallest_angle(mesh):
    """By the law of cosines."""
    corner = mesh.points[mesh.triangles]
    a, b, c = (np.hypot(*(corner[:, (i + 1) % 3] - corner[:, (i + 2) % 3]).T) for i in range(3))
    a, b, c = np.sort([a, b, c], axis=0)
    return np.degrees(np.arccos(np.clip((b * b + c * c - a * a) / (2 * b * c), -1, 1))).min()


def lifted_triangles(drawn, mesh):
    return int(drawn.winding[mesh.cell].sum())


@pytest.mark.parametrize("name", ROUND)
def test_good_angles_everywhere(name):
    """These drawings have no corner sharper than 25°, but narrow crossings and cells."""
    drawn = arrange(CURVES[name].curve)
    mesh = triangulate_cells(drawn)
    assert smallest_angle(mesh) > 25 - 1e-6
    assert 3200 < lifted_triangles(drawn, mesh) < 4800


@pytest.mark.parametrize("exponent", range(3, 13))
@pytest.mark.parametrize("draw", [dipping, thin])
def test_fine_features(draw, exponent):
    """Certified, the number asked for, and the whole surface right, down to features as fine as 1e-12."""
    points = draw(9 * 10.0**-exponent)
    drawn = arrange(points)
    for triangles in (400, 4000):
        mesh = triangulate_cells(drawn, triangles=triangles)
        assert 0.7 * triangles < lifted_triangles(drawn, mesh) < 1.4 * triangles
    pf.lift(points, triangles=400).check()


@pytest.mark.parametrize("exponent", [3, 4, 6, 9])
def test_good_angles_around_tiny_cells(exponent):
    assert smallest_angle(triangulate_cells(arrange(dipping(9 * 10.0**-exponent)))) > 25 - 1e-6


def test_good_angles_in_a_right_triangle():
    """Points added for the size leave no short edges on the long side that would spoil angles there."""
    assert smallest_angle(triangulate_cells(arrange([(0, 0), (1, 0), (0, 1)]))) > 25 - 1e-6


@pytest.mark.parametrize("size", [0.2, 0.5])
def test_usual_edge(size):
    surface = pf.lift(STRIP, size=size)
    corner = surface.vertices[surface.faces][:, :, :2]
    edges = np.hypot(*(np.roll(corner, -1, axis=1) - corner).transpose(2, 0, 1))
    assert np.median(edges) == pytest.approx(size, rel=0.2)


@pytest.mark.parametrize("options", [{"size": 0.0}, {"size": float("nan")}, {"size": 1.0, "max_area": 1.0}])
def test_sizes_that_make_no_sense(options):
    with pytest.raises(InputError):
        pf.lift(STRIP, **options)


def test_dense_drawings_do_not_blow_up():
    """At most three times the triangles that the curve has without points added, with some slack, however few asked."""
    drawn = arrange(random_curves.glued_disk(np.random.default_rng(0), 150))
    fewest = lifted_triangles(drawn, triangulate_cells(drawn, triangles=0))
    assert fewest <= lifted_triangles(drawn, triangulate_cells(drawn, triangles=1)) < 4.5 * fewest


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.integers(8, 40))
def test_added_points_lie_on_the_curve(seed, size):
    """Points of the curve bit for bit; other points of the chain lie on its edges, within a rounding."""
    points = random_curves.glued_disk(np.random.default_rng(seed), size)
    drawn = arrange(points)
    mesh = triangulate_cells(drawn, triangles=300)
    n, given_points = len(drawn.curve), drawn.curve.points
    assert mesh.points[:n].tobytes() == given_points.tobytes()
    edge = np.cumsum(mesh.chain < n) - 1
    start, end = given_points[edge], np.roll(given_points, -1, axis=0)[edge]
    place, along = mesh.points[mesh.chain], end - start
    length = np.hypot(*along.T)
    off = (along[:, 0] * (place - start)[:, 1] - along[:, 1] * (place - start)[:, 0]) / length
    advance = ((place - start) * along).sum(axis=1) / length**2
    assert np.abs(off).max() < 1e-13 * np.abs(given_points).max()
    assert (advance[mesh.chain < n] == 0).all()
    assert ((advance >= 0) & (advance < 1)).all()
    same = edge[1:] == edge[:-1]
    assert (np.diff(advance)[same] > 0).all()
    used = np.unique(mesh.chain)
    once = np.bincount(mesh.chain)[used[used >= n + drawn.n_crossings]]
    assert (once == 1).all()


@pytest.mark.slow
def test_thousands_of_random_disks():
    """Every surface is proved right by the independent checkers."""
    rng = np.random.default_rng(5)
    for _ in range(2000):
        points = random_curves.glued_disk(rng, int(rng.integers(6, 30)))
        layering = pf.find_layering(pf.find_immersion(points))
        if layering:
            pf.lift(layering, triangles=int(rng.integers(10, 600))).check()
