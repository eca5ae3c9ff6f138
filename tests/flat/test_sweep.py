"""The sweep over immersed disks, in plain Python and in machine code: order, turns, lists and triangles."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.certify import check_immersed_disk
from plyfold.errors import GeneralPositionError
from plyfold.flat.sweep import sweep_triangles
from plyfold.flat.sweep_line import empty_skip_list, link_above, sweep_order, sweep_plan, unlink
from plyfold.halfedges import twins_of
from plyfold.predicates import as_coordinates, turn
from reference import random_curves


def certify(immersion):
    points = immersion.arrangement.curve.points
    faces, twin = sweep_triangles(immersion)
    assert twin.tolist() == twins_of(faces).tolist()
    assert faces.shape == (len(points) - 2, 3)
    check_immersed_disk(points, points, faces, boundary=np.arange(len(points)))
    return faces


def cross(a, b, c):
    (ax, ay), (bx, by), (cx, cy) = (map(Fraction, place) for place in (a, b, c))
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("name", [name for name, named in CURVES.items() if named.immersions])
def test_gallery(name):
    drawn = pf.arrange(CURVES[name].curve)
    found = [certify(immersion) for immersion in pf.immersions(drawn)]
    assert len({frozenset(map(frozenset, faces.tolist())) for faces in found}) == CURVES[name].immersions


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("seed", range(40))
def test_random_disks(seed):
    """Small grids: many vertices and crossings are reached at the same time, and many lie in line."""
    rng = np.random.default_rng(seed)
    outline = random_curves.ribbon_outline if seed % 2 else random_curves.glued_disk
    points = np.array(outline(rng, int(rng.integers(3, 80))), dtype=np.float64)
    turned = points @ [[0, 1], [-1, 0]]
    for places in (points, turned, np.round(points / 50), points / 3 + 0.1):
        try:
            drawn = pf.arrange(places, general_position="raise")
        except GeneralPositionError:
            continue
        if (immersion := pf.find_immersion(drawn)) and len(immersion.arrangement.curve) > 3:
            certify(immersion)


@pytest.mark.usefixtures("way")
def test_combs_and_stairs():
    """Many corners that split, many that merge, and flat corners everywhere along the axes."""
    teeth = [(2 * tooth + step, height) for tooth in range(40) for step, height in ((0, 0), (1, 9))]
    comb = np.array([*teeth, (80, 0), (80, -5), (0, -5)], dtype=np.float64)
    stairs = [(step, rise) for number in range(30) for step, rise in ((number, number), (number + 1, number))]
    flight = np.array([*stairs, (30, 30), *[(30 - step, 31) for step in range(40)], (-9, 0)], dtype=np.float64)
    for points in (comb, comb[:, ::-1], -comb, flight, flight[:, ::-1], flight @ [[0.6, 0.8], [-0.8, 0.6]]):
        certify(pf.find_immersion(points))


@pytest.mark.usefixtures("way")
def test_a_hundred_sheets():
    """A band that winds round a hundred times over itself."""
    t = np.linspace(0, 200 * np.pi, 6000)
    radius = 4 + 0.001 * t / np.pi
    band = np.concatenate([radius * np.exp(1j * t), ((radius + 2) * np.exp(1j * t))[::-1]])[::-1]
    points = np.round(np.stack([band.real, band.imag], axis=1) * 2**20)
    immersion = pf.find_immersion(points)
    assert immersion.arrangement.winding.max() >= 100
    certify(immersion)


@pytest.mark.parametrize("factor", [2.0**-700, 2.0**480, 2.0**-1000])
def test_beyond_the_products_of_doubles(factor):
    """The same triangles in fractions, where products of coordinates over- or underflow."""
    points = CURVES["ten-gon"].curve.points
    assert (
        sweep_triangles(pf.find_immersion(points * factor)).faces.tolist()
        == certify(pf.find_immersion(points)).tolist()
    )


def test_order_is_exact():
    """Against fractions; on a grid along the direction of the line many places are reached together."""
    rng = np.random.default_rng(4)
    for scale in [1.0, 1e-9, 3.7] * 5:
        drawn = pf.arrange(scale * rng.permutation(24).reshape(12, 2))
        places = [tuple(map(Fraction, place)) for place in drawn.curve.points.tolist()]
        reach = {vertex: (x + Fraction(0.3) * y, y) for vertex, (x, y) in enumerate(places)}
        n = len(places)
        for visit in np.flatnonzero(np.arange(len(drawn.partner)) < drawn.partner).tolist():
            edge, other = drawn.visit_edge[visit], drawn.visit_edge[drawn.partner[visit]]
            a, b, c, d = (places[end % n] for end in (edge, edge + 1, other, other + 1))
            share = cross(c, d, a) / (cross(c, d, a) - cross(c, d, b))
            x, y = (start + share * (end - start) for start, end in zip(a, b, strict=True))
            reach[n + visit] = (x + Fraction(0.3) * y, y)
        assert sweep_order(sweep_plan(drawn, np.empty(0, dtype=int))).tolist() == sorted(reach, key=reach.__getitem__)


@pytest.mark.parametrize("kind", ["grid", "line", "doubles", "tiny", "huge"])
def test_turns_are_exact(kind):
    rng = np.random.default_rng(3)
    points = {
        "grid": rng.integers(-3, 4, (60, 2)) * 1.0,
        "line": np.linspace(0, 1, 60)[:, None] * [0.1, 0.7] + [0.3, -0.9],
        "doubles": rng.normal(size=(60, 2)),
        "tiny": rng.integers(-3, 4, (60, 2)) * 5e-324,
        "huge": rng.normal(size=(60, 2)) * 1e307,
    }[kind]
    places = as_coordinates(points)
    for a, b, c in rng.integers(0, 60, (400, 3)).tolist():
        exact = cross(*points[[a, b, c]].tolist())
        assert turn(places, a, b, c) == (exact > 0) - (exact < 0)


def test_skip_list():
    """Against a plain list."""
    rng = np.random.default_rng(8)
    nodes, expected = empty_skip_list(500), []
    for node in range(1, 501):
        place = int(rng.integers(len(expected) + 1))
        link_above(nodes, node, expected[place - 1] if place else 0)
        expected.insert(place, node)
        if rng.random() < 0.4:
            unlink(nodes, expected.pop(int(rng.integers(len(expected)))))
    size = len(nodes.height)
    for level in range(nodes.height[0] + 1):
        on_level = [0, *(node for node in expected if nodes.height[node] >= level), 0]
        for below, above in pairwise(on_level):
            assert nodes.above[level * size + below] == above
            assert nodes.below[level * size + above] == below
    assert nodes.height[0] > 2
