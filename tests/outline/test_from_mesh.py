"""Outlines of flat meshes against walks in fractions, and what is refused."""

from itertools import islice

import numpy as np
import pytest

import plyfold as pf
from bodies import patches
from coarse import CURVES
from plyfold.errors import CurveError
from reference.mesh_outlines import fans_of, marked, mesh_outline
from reference.random_curves import glued_disk

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]


def loops_of(outline):
    """Each loop as rows of (vertex, index), in the form of the reference."""
    return marked(np.split(outline.rows, outline.first_point[1:-1]), outline.cusps)


def assert_as_in_fractions(points, faces):
    found = pf.Outline.from_mesh(points, faces)
    assert loops_of(found) == mesh_outline(points, np.asarray(faces).tolist())
    assert found.points.tolist() == np.asarray(points, dtype=float)[found.rows].tolist()
    starts = found.rows[found.first_point[:-1]].tolist()
    assert starts == sorted(starts)
    return found


def test_patches_of_bodies_give_back_their_outlines():
    for patch in islice(patches(21), 60):
        found = assert_as_in_fractions(patch.vertices[:, :2], patch.faces)
        assert loops_of(found) == marked(patch.loops, patch.cusps)
        assert isinstance(found, pf.Curve) == (len(patch.loops) == 1)
        assert not found.repairs


def test_patches_in_space_lose_their_depths_and_say_so():
    patch = next(patches(22))
    found, flat = (pf.Outline.from_mesh(patch.vertices[:, :count], patch.faces) for count in (3, 2))
    assert [loop.tolist() for loop in found.loops] == [loop.tolist() for loop in flat.loops]
    assert [repair.kind for repair in found.repairs] == ["z left out"]


def test_triangulations_of_known_disks():
    rng = np.random.default_rng(3)
    known = [pf.Curve(glued_disk(rng, int(rng.integers(3, 30)))) for _ in range(20)]
    for curve in [*known, *(named.curve for named in CURVES.values() if pf.bounds_disk(named.curve))]:
        drawn = pf.arrange(curve).curve
        found = assert_as_in_fractions(drawn.points, pf.triangulate(curve))
        assert found.points.tolist() == drawn.points.tolist()
        assert not found.has_cusps


def test_lifted_surfaces_seen_from_above():
    for name in ("exit-ramp", "milnor"):
        surface = pf.lift(CURVES[name].curve, triangles=300)
        found = assert_as_in_fractions(surface.vertices[:, :2], surface.faces)
        outline = pf.arrange(CURVES[name].curve).curve.points.tolist()
        on_boundary = found.points.tolist()
        assert [point for point in on_boundary if point in outline] == outline
        assert not found.has_cusps


def spiral(total, steps, rng):
    """Triangles round a point that turn by so many degrees altogether."""
    angles = np.radians(total * np.arange(steps + 1) / steps + rng.uniform(0, 360))
    rim = rng.uniform(1, 2, steps + 1)[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return np.concatenate([[(0.0, 0.0)], rim]), [(0, i, i + 1) for i in range(1, steps + 1)]


@pytest.mark.parametrize(("total", "index"), [(10, 0), (350, 0), (370, 1), (710, 1), (730, 2), (1430, 3), (1450, 4)])
def test_stairs_round_a_point(total, index):
    rng = np.random.default_rng(total)
    for _ in range(5):
        points, faces = spiral(total, 1 + total // 90, rng)
        found = assert_as_in_fractions(points, faces)
        assert found.cusps[0][0] == index == sum(map(np.sum, found.cusps))


QUARTERS = [(3, 0), (0, 2), (-1, 0), (0, -5)]


@pytest.mark.parametrize(("quarters", "index"), [(1, 0), (3, 0), (4, 0), (5, 1), (7, 1), (8, 1), (9, 2), (12, 2)])
def test_whole_turns_are_counted_exactly(quarters, index):
    """A fan that ends in the direction in which it began makes its last full turn in view: α = 360°."""
    for start in range(4):
        rim = [QUARTERS[(start + i) % 4] for i in range(quarters + 1)]
        points = [(0, 0), *((x * (i + 1), y * (i + 1)) for i, (x, y) in enumerate(rim))]
        found = assert_as_in_fractions(points, [(0, i, i + 1) for i in range(1, quarters + 1)])
        assert found.cusps[0].tolist() == [index] + [0] * (quarters + 1)


def test_turns_hold_at_every_scale():
    for scale in (1e-300, 5e-324, 1e-20, 1e20, 1e148):
        points = scale * np.array([(0, 0), *((i + 1) * np.array(QUARTERS[i % 4]) for i in range(6))])
        assert pf.Outline.from_mesh(points, [(0, i, i + 1) for i in range(1, 6)]).cusps[0][0] == 1


def test_a_mesh_is_cut_where_triangles_touch_in_a_vertex():
    bow_tie = [(0, 0), (2, -1), (2, 1), (-2, 1), (-2, -1)]
    found = assert_as_in_fractions(bow_tie, [(0, 1, 2), (0, 3, 4)])
    assert [loop.tolist() for loop in found.loops] == [[[0, 0], [2, -1], [2, 1]], [[0, 0], [-2, 1], [-2, -1]]]
    assert [str(repair) for repair in found.repairs] == ["cut where triangles touch in a vertex at (0, 0)"]


def test_a_ring_whose_hole_touches_itself_passes_the_vertex_twice():
    """Of the six vertices of the hole two opposite ones are one; it comes up twice in one loop."""
    degrees = np.radians([0, 60, 120, 180, 240, 300, 75, 105, 255, 285])
    size = np.array([4] * 6 + [1] * 4)
    points = [*(size[:, None] * np.stack([np.cos(degrees), np.sin(degrees)], axis=1)), (0, 0), (9, 9)]
    hole = [10, 6, 7, 10, 8, 9]
    faces = [(i, (i + 1) % 6, hole[i]) for i in range(6)]
    faces += [((i + 1) % 6, hole[(i + 1) % 6], hole[i]) for i in range(6)]
    found = assert_as_in_fractions(points, faces)
    assert found.rows.tolist() == [0, 1, 2, 3, 4, 5, 6, 10, 9, 8, 10, 7]
    assert found.n_loops == 2
    assert [repair.kind for repair in found.repairs] == [
        "1 vertex of no triangle left out",
        "cut where triangles touch in a vertex",
    ]
    assert len([fan for fan in fans_of(faces) if fan.vertex == 10]) == 2


def test_a_full_fan_may_touch_the_boundary():
    """A vertex inside one part of the mesh is on the boundary of another, which lies over it."""
    points = [(0, 0), *QUARTERS, (5, 5), (1, 5)]
    found = assert_as_in_fractions(points, [*((0, i, i % 4 + 1) for i in range(1, 5)), (0, 5, 6)])
    assert found.n_loops == 2
    assert len(found.repairs) == 1


WITH_MIDDLE = [*SQUARE, (1, 1)]


@pytest.mark.parametrize(
    ("points", "faces", "message", "where"),
    [
        (SQUARE, [(0, 1, 2), (0, 3, 2)], "triangle 1 runs clockwise", (2 / 3, 4 / 3)),
        (SQUARE, [(2, 1, 0), (3, 2, 0)], r"triangle 0 runs clockwise \(and 1 more.*\n.*all of them", (4 / 3, 2 / 3)),
        ([*SQUARE, (1, 0)], [(0, 4, 1), (0, 1, 2)], "triangle 0 is flat", (1, 0)),
        (SQUARE, [(0, 1, 2), (0, 0, 3)], "triangle 1 is flat", (0, 2 / 3)),
        (WITH_MIDDLE, [(0, 1, 4), (0, 1, 2)], "triangles 0 and 1 lie on the same side", (1, 0)),
        (WITH_MIDDLE, [(0, 1, 4), (0, 1, 2), (0, 1, 3)], "triangles 0, 1 and 2 share one edge", (1, 0)),
        ([(0, 0), (3, 0), (0, 3), (1, 1)], [(0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)], "the mesh is closed", None),
        (SQUARE, [(0, 1, 4)], "triangle 0 names a vertex that does not exist", None),
        (SQUARE, [(0, 1, -1)], "triangle 0 names a vertex that does not exist", None),
        (SQUARE, [(0, 1, 2, 3)], r"the shape \(1, 4\).*\n.*split larger polygons", None),
        (SQUARE, [(0.0, 1.0, 2.0)], "the type float64", None),
        (SQUARE, [], "no triangles", None),
        ([(0, 0), (1, 0), (0, np.nan)], [(0, 1, 2)], "not finite", (1, 0)),
        ([(0, 0, 0, 1)] * 3, [(0, 1, 2)], "shape", None),
    ],
)
def test_what_is_no_flat_mesh_is_refused_with_its_place(points, faces, message, where):
    with pytest.raises(CurveError, match=message) as caught:
        pf.Outline.from_mesh(points, faces)
    assert caught.value.hint
    assert caught.value.where == (() if where is None else (pytest.approx(where),))


def test_a_branch_point_inside_is_refused():
    """Triangles that close after two turns; open, they are a cusp."""
    angles = np.arange(10) * 2 * np.pi / 5
    points = [(0, 0), *zip(np.cos(angles) + np.arange(10) / 50, np.sin(angles), strict=True)]
    faces = [(0, i, i % 10 + 1) for i in range(1, 11)]
    with pytest.raises(CurveError, match="around vertex 0, inside the mesh, turn round it 2 times") as caught:
        pf.Outline.from_mesh(points, faces)
    assert caught.value.where == ((0, 0),)
    assert assert_as_in_fractions(points, faces[:-1]).cusps[0][0] == 1


def test_answers_do_not_depend_on_the_order_of_triangles_and_corners():
    rng = np.random.default_rng(9)
    for patch in islice(patches(23), 20):
        turned = [np.roll(face, int(rng.integers(3))) for face in rng.permutation(patch.faces)]
        one, other = (pf.Outline.from_mesh(patch.vertices[:, :2], faces) for faces in (patch.faces, turned))
        assert one.rows.tolist() == other.rows.tolist()
        assert np.concatenate(one.cusps).tolist() == np.concatenate(other.cusps).tolist()
