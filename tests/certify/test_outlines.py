"""The checkers of outlines with several loops, and with cusps: right meshes pass, no spoiled one does."""

import numpy as np
import pytest

from plyfold import gallery
from plyfold.certify import (
    check_disk_mesh,
    check_immersed_disk,
    check_immersed_surface,
    check_layered,
    check_solid,
    check_surface,
    check_surface_mesh,
)
from plyfold.certify.surface import check_rounded
from plyfold.errors import CertificateError
from reference.triangles import meeting_pairs

SQUARE = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]
HOLE = [(3.0, 3.0), (3.0, 6.0), (6.0, 6.0), (6.0, 3.0)]
RING = [[0, 1, 7], [0, 7, 4], [1, 2, 6], [1, 6, 7], [2, 3, 5], [2, 5, 6], [3, 0, 4], [3, 4, 5]]
LID = [[4, 7, 6], [4, 6, 5]]


def refused(loops, vertices, faces, boundary, cusps=None, *, match=None):  # noqa: PLR0913 - a mesh, and what is said
    with pytest.raises(CertificateError, match=match) as caught:
        check_immersed_surface(loops, vertices, faces, boundary, cusps)
    return caught.value


# Several loops


def test_a_ring():
    check_immersed_surface([SQUARE, HOLE], SQUARE + HOLE, RING, np.arange(8))
    check_immersed_surface([HOLE, SQUARE], SQUARE + HOLE, RING, [4, 5, 6, 7, 0, 1, 2, 3])
    check_surface_mesh(RING, 8, [(2, 0)])


def test_a_ring_that_is_said_to_be_a_disk():
    refused(SQUARE, SQUARE + HOLE, RING, np.arange(8), match="has 2 loops, and the outline has 1")
    with pytest.raises(CertificateError, match="2 loops"):
        check_disk_mesh(RING, 8)
    with pytest.raises(CertificateError, match=r"characteristic\) \(2, 0\), not \(1, 1\)"):
        check_surface_mesh(RING, 8, [(1, 1)])


def test_a_disk_in_place_of_a_ring():
    refused([SQUARE, HOLE], SQUARE + HOLE, RING + LID, np.arange(8), match="not a row of all boundary vertices")
    refused([SQUARE, HOLE], SQUARE + HOLE, RING + LID, np.arange(4), match="has 1 loops, and the outline has 2")


def test_a_hole_that_is_missing_in_the_outline():
    refused([SQUARE], SQUARE + HOLE, RING, np.arange(4), match="not a row of all boundary vertices")


def test_a_disk_across_its_hole():
    """Cut open from the hole to the rim it is a disk, and the boundary runs along the cut."""
    cut = [[0, 1, 7], [0, 7, 4], [1, 2, 6], [1, 6, 7], [2, 3, 5], [2, 5, 6], [3, 8, 9], [3, 9, 5]]
    vertices = [*SQUARE, *HOLE, SQUARE[0], HOLE[0]]
    check_disk_mesh(cut, 10)
    boundary = [0, 1, 2, 3, 8, 9, 5, 6, 7, 4]
    refused([SQUARE, HOLE], vertices, cut, boundary, match="has 1 loops, and the outline has 2")
    refused(SQUARE, vertices, cut, boundary, match="runs backwards")


def test_the_loops_must_come_in_their_order():
    refused([HOLE, SQUARE], SQUARE + HOLE, RING, np.arange(8), match="does not start at the curve's first point")
    refused([SQUARE, HOLE], SQUARE + HOLE, RING, [0, 1, 2, 3, 0, 1, 2, 3], match="leaves the boundary")
    refused([SQUARE, HOLE], SQUARE + HOLE, RING, [0, 1, 4, 5, 2, 3, 6, 7], match="leaves the boundary")


def test_a_hole_walked_the_wrong_way():
    refused(
        [SQUARE, HOLE[:1] + HOLE[:0:-1]], SQUARE + HOLE, RING, [0, 1, 2, 3, 4, 7, 6, 5], match="leaves the boundary"
    )
    refused([SQUARE, HOLE[:1] + HOLE[:0:-1]], SQUARE + HOLE, RING, np.arange(8), match="runs backwards|misses a point")


def test_two_pieces():
    away = [(x + 20, y) for x, y in SQUARE]
    faces = [*RING, [8, 9, 10], [8, 10, 11]]
    check_immersed_surface([SQUARE, HOLE, away], SQUARE + HOLE + away, faces, np.arange(12))
    check_surface_mesh(faces, 12, [(1, 1), (2, 0)])
    with pytest.raises(CertificateError, match=r"\(1, 1\), \(2, 0\), not \(1, 0\), \(2, 1\)"):
        check_surface_mesh(faces, 12, [(2, 1), (1, 0)])


def test_pinched_vertex():
    """Two squares that share a corner: its triangles are two fans."""
    other = [(9.0, 9.0), (18.0, 9.0), (18.0, 18.0), (9.0, 18.0)]
    vertices = SQUARE + other[1:]
    faces = [[0, 1, 2], [0, 2, 3], [2, 4, 5], [2, 5, 6]]
    refused([SQUARE, other], vertices, faces, [0, 1, 2, 3, 2, 4, 5, 6], match="through vertex 2 more than once")
    check_immersed_surface([SQUARE, other], SQUARE + other, [*faces[:2], [4, 5, 6], [4, 6, 7]], np.arange(8))


def test_ring_in_space_with_a_gap():
    """Two rings, one over the other."""
    low, high = (np.column_stack([SQUARE + HOLE, np.full(8, z)]) for z in (0.0, 1.0))
    vertices, faces = np.concatenate([low, high]), np.concatenate([RING, np.array(RING) + 8])
    loops = [SQUARE, HOLE, SQUARE, HOLE]
    check_surface(loops, vertices, faces, np.arange(16), gap=1.0)
    with pytest.raises(CertificateError, match="less than 2 apart"):
        check_surface(loops, vertices, faces, np.arange(16), gap=2.0)
    vertices[3, 2] = 2.0
    with pytest.raises(CertificateError, match="change their order"):
        check_surface(loops, vertices, faces, np.arange(16))


# Cusps


STEPS = 12


def stair(turns, opening=0.4):
    """A spiral stair round a vertex, point 0, which all triangles have as a corner; one sees an angle of `opening`."""
    angle = np.append(0.0, np.linspace(opening, 2 * np.pi, STEPS)[:-1])
    step = np.column_stack([np.cos(angle), np.sin(angle)])
    points = np.concatenate([[(0.0, 0.0)], *turns * [step], step[:2]])
    i = np.arange(1, len(points) - 1)
    cusps = np.zeros(len(points), dtype=np.int64)
    cusps[0] = turns
    height = np.append(turns / 2, (np.arange(len(points) - 1)) / STEPS)
    return points, np.stack([0 * i, i, i + 1], axis=1), cusps, height


@pytest.mark.parametrize("turns", [1, 2, 3])
@pytest.mark.parametrize("quarter", range(4))
def test_as_many_turns_as_the_cusp_has(turns, quarter):
    points, faces, cusps, _ = stair(turns)
    points = points @ np.linalg.matrix_power(np.array([[0, 1], [-1, 0]]), quarter)
    check_immersed_disk(points, points, faces, np.arange(len(points)), cusps)
    check_immersed_surface(points, points, faces, np.arange(len(points)), cusps)
    few, many = cusps.copy(), cusps.copy()
    few[0] -= 1
    many[0] += 1
    for wrong, match in ((few, "too often, at"), (many, "not often enough, at")):
        error = refused(points, points, faces, np.arange(len(points)), wrong, match=match)
        np.testing.assert_array_equal(error.where, points[:1])


def test_a_cusp_at_another_vertex():
    points, faces, cusps, _ = stair(1)
    refused(points, points, faces, np.arange(len(points)), np.roll(cusps, 1))


def test_limacon_has_its_turn_in_a_cusp():
    points = gallery.CURVES["limacon"].draw()
    tip = int(np.argmin(np.hypot(points[:, 0] - 0.4, points[:, 1])))
    points = np.roll(points, -tip, axis=0)
    i = np.arange(1, len(points) - 1)
    faces = np.stack([0 * i, i, i + 1], axis=1)
    cusps = np.zeros(len(points), dtype=int)
    cusps[0] = 1
    check_immersed_disk(points, points, faces, np.arange(len(points)), cusps)


def test_wrong_cusps():
    whole = np.arange(8)
    for cusps, match in (
        ([[0, 0, 0, 0]], "one number for each point"),
        ([[0, 0, 0, 0], [0, 0, 0]], "one number for each point"),
        ([[0, 0, 0, 0], [0, 0, 0, -1]], "from 0 on"),
        ([[0, 0, 0, 0], [0, 0, 0, 0.5]], "from 0 on"),
        ([[0, 0, 0, 0], [1, 0, 0, 0]], "not often enough"),
    ):
        refused([SQUARE, HOLE], SQUARE + HOLE, RING, whole, cusps, match=match)


def test_stair_in_space():
    points, faces, cusps, height = stair(2)
    vertices = np.column_stack([points, height])
    whole = np.arange(len(points))
    check_surface(points, vertices, faces, whole, gap=1.0 - 1e-12, cusps=cusps)
    assert meeting_pairs(vertices, faces) == []
    with pytest.raises(CertificateError, match="apart, or equal"):
        check_surface(points, vertices, faces, whole, gap=1.1, cusps=cusps)


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_steps_that_cut_each_other(turns):
    """Any two steps over one another swapped, against the generic test."""
    points, faces, cusps, height = stair(turns + 1)
    vertices = np.column_stack([points, height])
    for step in range(1, STEPS * turns + 3):
        spoiled = vertices.copy()
        spoiled[[step, step + STEPS], 2] = spoiled[[step + STEPS, step], 2]
        with pytest.raises(CertificateError, match="change their order"):
            check_surface(points, spoiled, faces, np.arange(len(points)), cusps=cusps)
        assert meeting_pairs(spoiled, faces)


def test_order_of_triangles_with_a_common_corner():
    """Random heights of three steps over one triangle, with the same tip: passed if and only if nothing meets."""
    rng = np.random.default_rng(2)
    places = np.array([(0, 0), (1, 0), (0, 1)] + 2 * [(1, 0), (0, 1)], dtype=float)
    faces = np.array([[0, 1, 2], [0, 3, 4], [0, 5, 6]])
    answers = []
    for _ in range(200):
        heights = np.append(0.0, rng.permutation(6))
        vertices = np.column_stack([places, heights])
        try:
            check_layered(vertices, faces)
            answers.append((True, not meeting_pairs(vertices, faces)))
        except CertificateError:
            answers.append((False, not meeting_pairs(vertices, faces)))
    assert set(answers) == {(True, True), (False, False)}


# Solids


def solid(vertices, faces, thickness, tip=None):
    """The surface moved up and down, and walls along its boundary; a tip is not moved."""
    n = len(vertices)
    up = np.array([0.0, 0.0, thickness / 2])
    both = np.concatenate([vertices + up, vertices - up])
    sides = {(a, b) for face in faces for a, b in zip(face, [*face[1:], face[0]], strict=True)}
    walls = [w for a, b in sides if (b, a) not in sides for w in ([a + n, b + n, b], [a + n, b, a])]
    mesh = np.concatenate([faces, np.array(faces)[:, ::-1] + n, walls])
    if tip is not None:
        both[tip] = vertices[tip]
        mesh = np.where(mesh == tip + n, tip, mesh)
        mesh = mesh[(mesh != np.roll(mesh, 1, axis=1)).all(axis=1)]
        both, mesh = np.delete(both, tip + n, axis=0), np.where(mesh > tip + n, mesh - 1, mesh)
    return both, mesh


def test_solid_ring():
    vertices = np.column_stack([SQUARE + HOLE, np.zeros(8)])
    check_solid(*solid(vertices, RING, 0.5), 0.5, pieces=[0])
    with pytest.raises(CertificateError, match=r"\(0, 0\), not \(0, 2\)"):
        check_solid(*solid(vertices, RING, 0.5), 0.5)
    with pytest.raises(CertificateError, match=r"\(0, 2\), not \(0, 0\)"):
        check_solid(*solid(vertices, RING + LID, 0.5), 0.5, pieces=[0])


def stair_solid():
    points, faces, _, height = stair(2)
    vertices = np.column_stack([points, height])
    return vertices, faces


def test_solid_stair_ends_in_a_tip():
    vertices, faces = stair_solid()
    both, mesh = solid(vertices, faces.tolist(), 0.5, tip=0)
    check_solid(both, mesh, 0.5, tips=[0])
    assert meeting_pairs(both, mesh) == []
    with pytest.raises(CertificateError, match="either on the top or on the bottom"):
        check_solid(both, mesh, 0.5)
    with pytest.raises(CertificateError, match="either on the top or on the bottom"):
        check_solid(both, mesh, 0.5, tips=[0, 1])


def test_solid_stair_as_thick_at_its_vertex_as_elsewhere_cuts_itself():
    vertices, faces = stair_solid()
    both, mesh = solid(vertices, faces.tolist(), 0.5)
    assert meeting_pairs(both, mesh)
    with pytest.raises(CertificateError):
        check_solid(both, mesh, 0.5)


@pytest.mark.parametrize("row", [[99], [-1], [0.5]])
def test_vertices_that_do_not_exist(row):
    vertices, faces = stair_solid()
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    with pytest.raises(CertificateError, match="does not name vertices by whole numbers"):
        check_solid(*solid(vertices, faces.tolist(), 0.5, tip=0), 0.5, tips=row)
    with pytest.raises(CertificateError, match="does not name vertices by whole numbers"):
        check_layered(vertices, faces, passing=[(0, 1, 2, *row)])
    with pytest.raises(CertificateError, match="does not name vertices by whole numbers"):
        check_rounded(square, square, [[0, 1, 2], [0, 2, 3]], [0, 1, 2, *row])
