"""Triangles over the cells: compared with areas, winding numbers and angles that are computed otherwise."""

import math
from collections import Counter

import numpy as np
import pytest

from coarse import CURVES
from plyfold.arrangement.arrangement import arrange
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.halfedges import following
from plyfold.mesh.cells import triangulate_cells
from reference import random_curves

RAMP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], dtype=np.float64)


def areas(points, triangles):
    a, b, c = points[triangles].swapaxes(0, 1)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return (ux * vy - uy * vx) / 2


def smallest_angles(points, triangles):
    a, b, c = (points[triangles[:, [i, (i + 1) % 3, (i + 2) % 3]]].swapaxes(0, 1) for i in range(3))
    angles = []
    for p, q, r in (a, b, c):
        u, v = q - p, r - p
        angles.append(np.degrees(np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))))
    return np.min(angles, axis=0)


def winding_number(points, place):
    """By adding up angles."""
    z = (points - place) @ np.array([1, 1j])
    return round(np.angle(np.roll(z, -1) / z).sum() / (2 * math.pi))


def drawings():
    yield from (pytest.param(arrange(named.curve), id=name) for name, named in CURVES.items() if named.embeddable)
    for seed in range(4):
        rng = np.random.default_rng(seed)
        yield pytest.param(arrange(random_curves.glued_disk(rng, 12)), id=f"glued disk {seed}")


@pytest.fixture(params=drawings(), scope="module")
def drawn(request):
    return request.param


@pytest.fixture(scope="module")
def mesh(drawn):
    return triangulate_cells(drawn, triangles=400)


def test_covers_each_cell(drawn, mesh):
    """Triangles are positive, fill the areas of their cells, and lie where the winding number is that of the cell."""
    size = areas(mesh.points, mesh.triangles)
    assert (size > 0).all()
    for cell in np.flatnonzero(drawn.winding > 0):
        border = [drawn.border_points(dart // 2)[:: -1 if dart % 2 else 1] for dart in drawn.cells[cell]]
        x, y = np.concatenate(border).T
        assert size[mesh.cell == cell].sum() == pytest.approx((x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2, rel=1e-6)
    for middle, cell in zip(mesh.points[mesh.triangles].mean(axis=1), mesh.cell, strict=True):
        assert winding_number(drawn.curve.points, middle) == drawn.winding[cell] > 0


def test_points_of_the_curve_come_first(drawn, mesh):
    n = len(drawn.curve)
    assert mesh.points[:n].tobytes() == drawn.curve.points.tobytes()
    assert mesh.points[n : n + drawn.n_crossings].tolist() == drawn.crossings.tolist()
    assert len(np.unique(mesh.points, axis=0)) == len(mesh.points)


def test_chain_runs_along_the_curve(drawn, mesh):
    """Through the points in order, twice through each crossing, once through added points, along edges of triangles."""
    n = len(drawn.curve)
    assert mesh.chain[0] == 0
    assert mesh.chain[mesh.chain < n].tolist() == list(range(n))
    times = Counter(mesh.chain.tolist())
    assert all(times[vertex] == (2 if n <= vertex < n + drawn.n_crossings else 1) for vertex in times)
    ends = np.stack([mesh.triangles, np.roll(mesh.triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    assert ends[mesh.left].tolist() == np.stack([mesh.chain, np.roll(mesh.chain, -1)], axis=1).tolist()
    assert (mesh.cell[mesh.left // 3] == drawn.left_cell[mesh.chain_border]).all()


def test_borders_change_at_crossings(drawn, mesh):
    n = len(drawn.curve)
    changed = mesh.chain_border != np.roll(mesh.chain_border, 1)
    at_crossing = (mesh.chain >= n) & (mesh.chain < n + drawn.n_crossings)
    assert (changed == at_crossing).all()


def test_good_angles():
    """No corner of a circle is sharp, and those of a square are not either."""
    for points in (CURVES["circle"].curve.points, [(0, 0), (4, 0), (4, 4), (0, 4)]):
        mesh = triangulate_cells(arrange(points), triangles=1000)
        assert smallest_angles(mesh.points, mesh.triangles).min() >= 25 - 1e-6


@pytest.mark.parametrize("triangles", [300, 1000, 10_000])
def test_number_of_triangles(triangles):
    """Of the lifted surface, where triangles over deep cells count several times."""
    drawn = arrange(CURVES["two-turn-spiral"].curve)
    mesh = triangulate_cells(drawn, triangles=triangles)
    assert 0.6 * triangles < drawn.winding[mesh.cell].sum() < 2 * triangles


def test_max_area():
    mesh = triangulate_cells(arrange(RAMP), max_area=0.05)
    assert areas(mesh.points, mesh.triangles).max() <= 0.05 * (1 + 1e-9)


@pytest.mark.parametrize("exponent", [-300, -60, 60, 300])
def test_powers_of_two_change_nothing(exponent):
    plain, scaled = triangulate_cells(arrange(RAMP)), triangulate_cells(arrange(np.ldexp(RAMP, exponent)))
    assert np.ldexp(plain.points, exponent).tobytes() == scaled.points.tobytes()
    assert plain.triangles.tolist() == scaled.triangles.tolist()


def test_crossings_closer_than_doubles():
    """A strip so thin that its crossings with another strand are the same pair of doubles."""
    strip = RAMP.copy()
    strip[8:, 1] = 1e-17
    with pytest.raises(PrecisionError, match="fall on each other") as caught:
        triangulate_cells(arrange(strip))
    assert {(3.0, 0.0), (4.0, 0.0)} <= set(caught.value.where)


def test_needs_a_drawing():
    ramp = arrange(RAMP)
    with pytest.raises(PlyfoldError, match="Gauss code"):
        triangulate_cells(type(ramp).from_gauss(ramp.partner, ramp.ccw, ramp.outer))


def test_half_edges():
    """Against dictionaries, on a triangulated drawing."""
    mesh = triangulate_cells(arrange(RAMP), triangles=100)
    ends = [(t[i], t[(i + 1) % 3]) for t in mesh.triangles.tolist() for i in range(3)]
    number = {pair: i for i, pair in enumerate(ends)}
    assert mesh.twin.tolist() == [number.get((b, a), -1) for a, b in ends]
    half_edge = np.arange(len(ends))
    assert [ends[i][0] for i in following(half_edge)] == [b for a, b in ends]
    assert (following(half_edge) // 3 == half_edge // 3).all()
