"""The bound on angles: every triangle with a sharp one is at a sharp corner, or in a thin strip, and has to be."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.arrangement.arrangement import arrange
from plyfold.errors import PlyfoldError
from plyfold.halfedges import following
from plyfold.mesh.cells import triangulate_cells
from plyfold.predicates import orient
from reference import random_curves
from reference.sharp_triangles import edges_of, reason, smallest_angles

HAIR = 1e-6


def ring(angle, outer, inner):
    direction = np.column_stack([np.cos(angle), np.sin(angle)])
    return np.concatenate([outer[:, None] * direction, (inner[:, None] * direction)[::-1]])


def kiss(height, samples=260, turn=0.8, waves=5.1):
    """A band whose ends lie on each other, and weave to and fro."""
    angle = np.linspace(0, 2 * np.pi + turn, samples)
    sway = height * np.sin(waves * (angle + 0.1))
    return ring(angle, 3 + sway, 2 + 0.7 * sway)


def strip(width):
    """Two corners of a band on each other, a unit and less wide: the strip is from (0.5, 5) to (1, 5 + width)."""
    outer = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 5), (1, 5), (1, 9), (9, 9), (9, 1)]
    return np.array([*outer, (1.5, 1), (1.5, 5 + width), (0.5, 5 + width), (0.5, 2)])


def sharp_triangles(mesh):
    return mesh.points[mesh.triangles[smallest_angles(mesh.points, mesh.triangles) < 25 - HAIR]]


def reasons(drawn, mesh):
    edges, close = edges_of(drawn), 16 * np.spacing(np.abs(mesh.points).max())
    return [reason(edges, corners, close) for corners in sharp_triangles(mesh)]


def check_bound(points, exponent=0):
    try:
        drawn = arrange(points * 10.0**exponent)
    except PlyfoldError:
        assume(False)
    assume((drawn.winding > 0).any())
    assert None not in reasons(drawn, triangulate_cells(drawn))


SCALES = st.integers(-8, 8)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10**6), st.integers(3, 14), SCALES)
def test_random_polygons(seed, size, exponent):
    check_bound(np.random.default_rng(seed).random((size, 2)), exponent)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.integers(6, 40), SCALES)
def test_random_disks(seed, size, exponent):
    check_bound(np.array(random_curves.glued_disk(np.random.default_rng(seed), size), dtype=float), exponent)


@settings(max_examples=25, deadline=None)
@given(st.floats(1, 11), st.integers(20, 120), st.floats(0.1, 1), st.floats(1, 9), SCALES)
def test_strands_that_nearly_touch(fineness, samples, turn, waves, exponent):
    check_bound(kiss(10**-fineness, samples, turn, waves), exponent)


@settings(max_examples=15, deadline=None)
@given(st.floats(1, 11), st.floats(0, 7), SCALES)
def test_thin_strips(fineness, angle, exponent):
    turn = np.array([(np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))])
    check_bound(strip(10**-fineness) @ turn, exponent)


@pytest.mark.parametrize("name", CURVES)
def test_gallery(name):
    drawn = arrange(CURVES[name].curve)
    found = reasons(drawn, triangulate_cells(drawn))
    assert set(found) <= {"corner"}
    assert len(found) <= 10


@pytest.mark.parametrize("width", [1e-4, 1e-6, 1e-9, 1e-11])
def test_strips_spoil_nothing_around_them(width):
    """All triangles with sharp angles lie in the strip, all of them, and are no more than shrink towards its ends."""
    bad = sharp_triangles(triangulate_cells(arrange(strip(width))))
    assert 0 < len(bad) < 5 * np.log2(1 / width)
    assert bad.min(axis=(0, 1)) == pytest.approx([0.5, 5], abs=5 * width)
    assert bad.max(axis=(0, 1)) == pytest.approx([1, 5], abs=5 * width)
    assert (bad[..., 0] >= 0.5).all()
    assert (bad[..., 0] <= 1).all()
    assert (bad[..., 1] >= 5).all()
    assert (bad[..., 1] <= 5 + width).all()


@pytest.mark.parametrize("points", [kiss(1e-3), kiss(1e-10), strip(1e-7)], ids=["woven", "touching", "strip"])
def test_mended_meshes_are_whole(points):
    """Positive triangles that fill the cells; half-edges fit; the curve is there, point by point and edge by edge."""
    drawn = arrange(points)
    mesh = triangulate_cells(drawn)
    corner = mesh.points[mesh.triangles]
    assert (orient(*corner.swapaxes(0, 1)) > 0).all()
    u, v = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    x, y = drawn.curve.points.T
    enclosed = (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    area = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    assert area @ drawn.winding[mesh.cell] == pytest.approx(enclosed, rel=1e-9)
    start = mesh.triangles.ravel()
    inner = np.flatnonzero(mesh.twin >= 0)
    assert (mesh.twin[mesh.twin[inner]] == inner).all()
    assert (start[mesh.twin[inner]] == start[following(inner)]).all()
    assert (start[mesh.left] == mesh.chain).all()
    assert (start[following(mesh.left)] == np.roll(mesh.chain, -1)).all()
    assert (mesh.cell[mesh.left // 3] == drawn.left_cell[mesh.chain_border]).all()
    n = len(drawn.curve)
    assert mesh.points[:n].tobytes() == drawn.curve.points.tobytes()
    assert mesh.chain[mesh.chain < n].tolist() == list(range(n))
    across = np.flatnonzero(mesh.cell[inner // 3] != mesh.cell[mesh.twin[inner] // 3])
    assert set(inner[across]) <= set(mesh.left) | set(mesh.twin[mesh.left])


@pytest.mark.parametrize("points", [kiss(1e-10), strip(1e-9)], ids=["touching", "strip"])
def test_surfaces_are_proved_right(points):
    pf.lift(points).check()


def test_number_of_triangles_with_strands_that_touch():
    drawn = arrange(kiss(1e-10))
    assert 3200 < drawn.winding[triangulate_cells(drawn).cell].sum() < 5200
