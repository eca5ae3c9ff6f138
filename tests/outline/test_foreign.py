"""Outlines of other libraries are taken as they are: complex numbers, paths of matplotlib, sections of trimesh."""

import numpy as np
import pytest
from matplotlib.path import Path

import plyfold as pf
from plyfold.errors import CurveError
from plyfold.outline.given import as_outline

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def test_complex_numbers():
    z = np.array([0, 1, 1 + 1j, 1j])
    for curve in (z, z.astype(np.complex64), z.tolist()):
        assert pf.Curve(curve).points.tolist() == [list(point) for point in SQUARE]
        assert pf.bounds_disk(curve)
    assert as_outline([3 * z - 1 - 1j, z[::-1]]).n_loops == 2
    with pytest.raises(CurveError, match="complex"):
        pf.Curve(z.reshape(2, 2))


def test_straight_paths_keep_every_digit():
    """Neither are points left out that hardly bend the curve, as for a picture."""
    random = np.random.default_rng(4)
    points = random.normal(size=(300, 2)) * 1e-3
    points[100:200] = np.linspace(points[99], points[200], 102)[1:-1] + 1e-12 * random.normal(size=(100, 2))
    for path in (Path(points), Path([*points, points[0]], closed=True)):
        assert np.array_equal(as_outline(path).points, points)


def test_curved_paths_are_flattened():
    circle = as_outline(Path.unit_circle()).points
    assert np.hypot(*circle.T) == pytest.approx(1, abs=1e-3)
    assert np.array_equal(
        as_outline(Path(Path.unit_circle().vertices * 2.0**40, Path.unit_circle().codes)).points, circle * 2.0**40
    )


def test_paths_of_several_loops_are_outlines():
    both = Path.make_compound_path(Path([*SQUARE, SQUARE[0]], closed=True), Path(0.5 * np.array(SQUARE[::-1]) + 0.25))
    assert as_outline(both).n_loops == 2
    assert pf.find_immersion(both).euler_characteristic == 0


def test_a_path_with_points_that_are_none():
    with pytest.raises(CurveError, match="not finite"):
        pf.arrange(Path([(0, 0), (1, np.nan), (1, 1)]))
    with pytest.raises(CurveError):
        pf.arrange(Path(np.empty((0, 2))))


def test_sections_of_meshes():
    trimesh = pytest.importorskip("trimesh")
    section = trimesh.creation.annulus(1.0, 2.0, 1.0).section([0, 0, 1], [0, 0, 0])
    flat, _ = section.to_2D()
    for path in (section, flat):
        outline = as_outline(path)
        assert outline.n_loops == 2
        assert abs(pf.fill(outline, "evenodd").area) == pytest.approx(3 * np.pi, rel=0.02)
