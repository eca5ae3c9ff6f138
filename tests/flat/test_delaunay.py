"""Round triangles: made from the sweep's, and compared with all triangles whose circles are empty and flips."""

import math
import sys

import numpy as np
import pytest

from coarse import CURVES
from plyfold import compiled
from plyfold.compiled import run_in_python
from plyfold.flat.delaunay import delaunay_triangles, flip_edges
from plyfold.flat.sweep import sweep_triangles
from plyfold.halfedges import GluedTriangles, twins_of
from plyfold.immersion.solve import immersions
from plyfold.predicates import orient
from reference import random_curves


def as_set(faces):
    return {tuple(np.roll(face, -face.argmin()).tolist()) for face in faces}


def glued(faces):
    return GluedTriangles(np.array(faces), twins_of(np.array(faces)))


def assert_same_disk(points, faces, triangles):
    """As many triangles, counter-clockwise, glued to a disk with the same boundary: all its corners lie on that."""
    found, twin = triangles
    assert found.shape == faces.shape
    assert twin.tolist() == twins_of(found).tolist()
    assert (orient(*points[found].swapaxes(0, 1)) > 0).all()
    assert len(triangles.pairs) == len(found) - 1
    sides = {(u, v) for a, b, c in found.tolist() for u, v in ((a, b), (b, c), (c, a))}
    n = len(points)
    assert {side for side in sides if side[::-1] not in sides} == {(i, (i + 1) % n) for i in range(n)}


def assert_locally_delaunay(points, triangles):
    """Angles across from an inner edge add up to no more than half a turn; that makes it so everywhere."""
    z = points @ np.array([1, 1j])
    found = triangles.faces
    corners = np.stack([found, np.roll(found, -1, axis=1), np.roll(found, -2, axis=1)], axis=2).reshape(-1, 3)
    start, end, apex = corners.T
    angle = np.abs(np.angle((z[start] - z[apex]) / (z[end] - z[apex])))
    one, other = triangles.pairs.T
    assert (angle[one] + angle[other]).max(initial=0) < math.pi + 1e-7


def ladder(m):
    """Two straight rows of points that face each other, joined to a strip with steep ends."""
    x = np.arange(m, dtype=np.float64)
    return np.concatenate([np.stack([x, 0 * x], axis=1), np.stack([x[::-1] + 0.3, 0 * x + 7], axis=1)])


def disks():
    for name, named in CURVES.items():
        if named.immersions:
            yield pytest.param(named.curve.points, id=name)
    for seed in range(8):
        rng = np.random.default_rng(seed)
        yield pytest.param(np.array(random_curves.glued_disk(rng, 60), dtype=np.float64), id=f"glued disk {seed}")
        yield pytest.param(np.array(random_curves.ribbon_outline(rng, 150), dtype=np.float64), id=f"ribbon {seed}")
    yield pytest.param(ladder(60), id="ladder")


@pytest.mark.parametrize("points", list(disks()))
def test_round_triangles_of_the_same_disk(points):
    for immersion in list(immersions(points))[:3]:
        drawn = immersion.arrangement.curve.points
        swept = sweep_triangles(immersion)
        found = delaunay_triangles(drawn, swept)
        assert_same_disk(drawn, swept.faces, found)
        assert_locally_delaunay(drawn, found)
        flipped = flip_edges(drawn, found)
        assert flipped.twin.tolist() == twins_of(flipped.faces).tolist()
        assert as_set(flipped.faces) == as_set(found.faces)


@pytest.mark.parametrize("seed", range(12))
def test_the_same_as_flips_find(seed):
    """No four corners on a circle: there is one triangulation with empty circles. It depends on the immersion alone."""
    rng = np.random.default_rng(seed)
    points = np.array(random_curves.glued_disk(rng, 50), dtype=np.float64)
    immersion = next(immersions(points))
    drawn = immersion.arrangement.curve.points
    swept = sweep_triangles(immersion)
    assert as_set(delaunay_triangles(drawn, swept).faces) == as_set(flip_edges(drawn, swept).faces)


@pytest.mark.parametrize("seed", range(6))
def test_plain_python_and_machine_code_give_the_same(seed, monkeypatch):
    pytest.importorskip("numba")
    points = np.array(random_curves.ribbon_outline(np.random.default_rng(seed), 200), dtype=np.float64)
    immersion = next(immersions(points))
    drawn, swept = immersion.arrangement.curve.points, sweep_triangles(immersion)
    found = []
    for machine_code in (False, True):
        monkeypatch.setattr(compiled, "_machine_code_pays", lambda steps, yes=machine_code: yes)
        found.append([array.tolist() for array in delaunay_triangles(drawn, swept)])
    assert found[0] == found[1]


def test_tiny_coordinates_take_fractions():
    points = ladder(9) * 2.0**-600
    immersion = next(immersions(ladder(9)))
    swept = sweep_triangles(immersion)
    drawn = immersion.arrangement.curve.points
    assert as_set(delaunay_triangles(points, swept).faces) == as_set(delaunay_triangles(drawn, swept).faces)


def test_single_triangle():
    triangle = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    assert delaunay_triangles(triangle, glued([(0, 1, 2)])).faces.tolist() == [[0, 1, 2]]


@pytest.mark.parametrize("m", [500, 2000])
def test_steps_grow_hardly_faster_than_the_points(m, monkeypatch):
    """Flips would take about m² / 4: from the fan of one row to the fan of the other there is no shorter way."""
    module = sys.modules["plyfold.flat.delaunay"]
    monkeypatch.setattr(module, "run_loop", lambda loop, _, given, results: run_in_python(loop, given, results))
    steps, count = [], module.wants_flip
    monkeypatch.setattr(module, "wants_flip", lambda *given: steps.append(1) or count(*given))
    points = ladder(m)
    fans = [(i, i + 1, 2 * m - 1) for i in range(m - 1)] + [(m - 1, m + j, m + j + 1) for j in range(m - 1)]
    found = delaunay_triangles(points, glued(fans))
    assert_same_disk(points, np.array(fans), found)
    assert_locally_delaunay(points, found)
    assert len(steps) < 4 * m * math.log2(m)
