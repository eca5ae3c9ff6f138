"""Every check is seen to pass on good meshes and to refuse each kind of spoiled one."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial import Delaunay

import plyfold as pf
from plyfold import gallery
from plyfold.certify import check_disk_mesh, check_immersed_disk, check_layered, check_surface
from plyfold.errors import CertificateError, PlyfoldError
from reference.triangles import meeting_pairs

SQUARE = [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)]
HALVES = [[0, 1, 2], [0, 2, 3]]
RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]


def hand_glued_ramp(steps=14, per_turn=12):
    """A ramp of quadrilaterals; after a full turn it runs exactly over itself, `per_turn` higher."""
    corner = np.arange(steps + 1)
    angle = 2 * np.pi * (corner % per_turn) / per_turn
    direction = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    right = np.column_stack([2 * direction, corner])
    left = np.column_stack([direction, corner])
    vertices = np.concatenate([right, left[::-1]])
    r, s = corner[:-1], 2 * steps + 1 - corner[:-1]
    faces = np.concatenate([np.stack([r, r + 1, s], axis=1), np.stack([r + 1, s - 1, s], axis=1)])
    return vertices, faces, np.arange(len(vertices))


@pytest.fixture
def ramp():
    return hand_glued_ramp()


def fan(points):
    """Triangles from the first point to all edges."""
    i = np.arange(1, len(points) - 1)
    return np.stack([np.zeros_like(i), i, i + 1], axis=1)


def circle(n=40):
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def test_error_is_of_the_library():
    assert issubclass(CertificateError, PlyfoldError)


# Good meshes


@pytest.mark.parametrize("scale", [1.0, 1e-200, 1e200, 1e-8])
def test_circle(scale):
    points = scale * circle()
    check_immersed_disk(points, points, fan(points), np.arange(40))


def test_circle_round_a_hub():
    points = circle()
    i = np.arange(40)
    faces = np.stack([i, (i + 1) % 40, np.full(40, 40)], axis=1)
    check_immersed_disk(points, np.concatenate([points, [(0.1, 0.2)]]), faces, i)


def test_ramp(ramp):
    vertices, faces, boundary = ramp
    check_surface(vertices[:, :2], vertices, faces, boundary, gap=12.0)
    assert meeting_pairs(vertices, faces) == []


def test_reflex_corner():
    arrow = [(0, 0), (4, -2), (1, 0), (4, 2)]
    check_immersed_disk(arrow, arrow, [[0, 1, 2], [0, 2, 3]], [0, 1, 2, 3])


# Meshes that are no disks


@pytest.mark.parametrize(
    ("message", "faces", "n_vertices"),
    [
        ("same side of the edge from vertex 0 to vertex 1", [[0, 1, 2], [0, 1, 3], [3, 1, 2]], 4),
        ("vertex 3 belongs to no triangle", [[0, 1, 2]], 4),
        ("runs through vertex 0 more than once", [[0, 1, 2], [0, 3, 4]], 5),
        ("several parts", [[0, 1, 2], [3, 4, 5]], 6),
        ("0 loops", [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]], 4),
        ("twice", [[0, 1, 1]], 2),
        ("does not exist", [[0, 1, 3]], 3),
        ("does not exist", [[0, 1, -1]], 3),
        ("shape", [], 0),
        ("integers", [[0.0, 1.0, 2.0]], 3),
    ],
)
def test_not_a_disk(message, faces, n_vertices):
    with pytest.raises(CertificateError, match=message):
        check_disk_mesh(faces, n_vertices)


def annulus(n=6):
    """Vertices 0 to n - 1 outside, n to 2n - 1 inside."""
    i = np.arange(n)
    j = (i + 1) % n
    return np.concatenate([np.stack([i, j, n + i], axis=1), np.stack([j, n + j, n + i], axis=1)])


def test_annulus_has_two_loops():
    with pytest.raises(CertificateError, match="2 loops"):
        check_disk_mesh(annulus(), 12)


def torus(n=4):
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n), np.arange(n)))
    a, b, c, d = (n * ((i + s) % n) + (j + t) % n for s, t in [(0, 0), (1, 0), (1, 1), (0, 1)])
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def test_torus_with_a_hole():
    """One part, one loop, all vertices fine: only the Euler characteristic tells."""
    with pytest.raises(CertificateError, match="Euler characteristic -1"):
        check_disk_mesh(torus()[1:], 16)


def test_disk_beside_a_torus():
    """Euler characteristic 1 and one loop, but two parts."""
    with pytest.raises(CertificateError, match="several parts"):
        check_disk_mesh(np.concatenate([torus(), [[16, 17, 18]]]), 19)


def test_inner_vertices_joined():
    """Two vertices inside a disk become one: two closed fans."""
    i = np.arange(6)
    j = (i + 1) % 6
    hubs = np.concatenate(
        [np.stack([12 + i, 12 + j, 18 + 0 * i], axis=1), np.stack([6 + i, 6 + j, 18 + 0 * i], axis=1)]
    )
    with pytest.raises(CertificateError, match="vertex 18 are not one fan"):
        check_disk_mesh(np.concatenate([annulus(), hubs]), 19)


# Disks that are not immersed, or not over the curve


def limacon():
    """From the tip of its inner loop; it turns left everywhere, twice in all."""
    points = gallery.CURVES["limacon"].draw()
    return np.roll(points, -int(np.argmin(np.hypot(points[:, 0] - 0.4, points[:, 1]))), axis=0)


def test_limacon():
    """All triangles positive, a disk, the right boundary; but one fan turns once too often."""
    points = limacon()
    faces = fan(points)
    with pytest.raises(CertificateError, match="turn round it too often") as caught:
        check_immersed_disk(points, points, faces, np.arange(len(points)))
    assert caught.value.where == (tuple(points[0]),)
    a, b, c = points[faces].swapaxes(0, 1)
    assert (np.cross(np.pad(b - a, ((0, 0), (0, 1))), np.pad(c - a, ((0, 0), (0, 1))))[:, 2] > 0).all()


def test_hub_of_a_doubled_circle():
    points = np.concatenate([circle(12), circle(12)])
    i = np.arange(24)
    faces = np.stack([i, (i + 1) % 24, np.full(24, 24)], axis=1)
    with pytest.raises(CertificateError, match="too often, at \\(0, 0\\)"):
        check_immersed_disk(points, np.concatenate([points, [(0.0, 0.0)]]), faces, i)


@pytest.mark.parametrize("quarters", range(4))
def test_slit(quarters):
    """The triangles at the end of a slit turn exactly once: the curve runs back on itself there."""
    turned = np.linalg.matrix_power(np.array([[0, 1], [-1, 0]]), quarters)
    points = np.array([(0, 0), (2, 0), (2, 2), (-2, 2), (-2, -2), (2, -2), (2, 0)]) @ turned
    with pytest.raises(CertificateError, match="too often"):
        check_immersed_disk(points, points, fan(points), np.arange(7))


def test_folded_triangle(ramp):
    vertices, faces, boundary = ramp
    vertices[3, :2] *= 0.3
    with pytest.raises(CertificateError, match="flat or turned over"):
        check_immersed_disk(vertices[:, :2], vertices[:, :2], faces, boundary)


def test_positive_exactly():
    """A triangle passes if and only if it is counter-clockwise in rational numbers."""
    rng = np.random.default_rng(3)
    answers = set()
    for _ in range(300):
        a, b = (0.5, 0.5), (12.0, 12.0)
        c = tuple(24 + int(k) * 2.0**-49 for k in rng.integers(-2, 3, 2))
        points = np.array([a, b, c])
        (ax, ay), (bx, by), (cx, cy) = ((Fraction(x), Fraction(y)) for x, y in (a, b, c))
        positive = (bx - ax) * (cy - ay) > (by - ay) * (cx - ax)
        try:
            check_immersed_disk(points, points, [[0, 1, 2]], [0, 1, 2])
        except CertificateError:
            answers.add((positive, False))
        else:
            answers.add((positive, True))
    assert answers == {(True, True), (False, False)}


def with_vertex_on_first_edge(*added):
    """A square with further vertices, meant to lie on its first edge, in front of the others."""
    points = np.array([SQUARE[0], *added, *SQUARE[1:]])
    hub = len(points)
    i = np.arange(hub)
    return np.concatenate([points, [(1.5, 1.5)]]), np.stack([i, (i + 1) % hub, np.full(hub, hub)], axis=1), i


@pytest.mark.parametrize("height", [0.0, 5e-324, 1e-16, -1e-15, 1e-9, -1e-3])
@pytest.mark.parametrize("scale", [1.0, 2.0**-500, 2.0**300])
def test_vertices_stand_for_points_of_edges(height, scale):
    vertices, faces, boundary = with_vertex_on_first_edge((1.0, height), (2.0, 0.0))
    check_immersed_disk(scale * np.array(SQUARE), scale * vertices, faces, boundary)


def test_a_corner_that_stands_for_the_middle_of_a_side():
    """Between (3, 0) and (0, 3) a vertex at (3, 3) stands for (3/2, 3/2); one at (4, 0) for a point beyond the side."""
    triangle = [SQUARE[0], SQUARE[1], SQUARE[3]]
    check_immersed_disk(triangle, SQUARE, HALVES, [0, 1, 2, 3])
    with pytest.raises(CertificateError, match="runs backwards along the curve, at \\(3, 0\\)"):
        check_immersed_disk(triangle, [*SQUARE[:2], (4.0, 0.5), SQUARE[3]], HALVES, [0, 1, 2, 3])


def test_vertices_must_advance():
    """A sliver of an ear: the boundary runs along the edge, back by a third, and on."""
    vertices, faces, _ = with_vertex_on_first_edge((1.0, 1e-15))
    vertices = np.insert(vertices, 1, (2.0, 0.0), axis=0)
    faces = np.concatenate([np.where(faces > 0, faces + 1, 0), [[0, 1, 2]]])
    with pytest.raises(CertificateError, match="runs backwards along the curve, at \\(2, 0\\)"):
        check_immersed_disk(SQUARE, vertices, faces, np.arange(6))


@pytest.mark.parametrize(
    ("message", "curve", "boundary"),
    [
        ("does not start", np.roll(SQUARE, 1, axis=0), [0, 1, 2, 3]),
        ("does not start", SQUARE, [1, 2, 3, 0]),
        ("does not start", [(0.0, 1e-300), *SQUARE[1:]], [0, 1, 2, 3]),
        ("misses a point of the curve, at \\(1, 0\\)", [SQUARE[0], (1.0, 0.0), *SQUARE[1:]], [0, 1, 2, 3]),
        ("misses", [*SQUARE, (0.0, 1.0)], [0, 1, 2, 3]),
        ("misses", [SQUARE[0], (np.nextafter(3, 4), 0.0), *SQUARE[2:]], [0, 1, 2, 3]),
        ("twice in a row", [SQUARE[0], *SQUARE], [0, 1, 2, 3]),
        ("leaves the boundary", SQUARE, [0, 3, 2, 1]),
        ("leaves the boundary", SQUARE, [0, 1, 2, 2]),
        ("not a row of all", SQUARE, [0, 1, 2]),
        ("does not exist", SQUARE, [0, 1, 2, 7]),
    ],
)
def test_wrong_boundary(message, curve, boundary):
    with pytest.raises(CertificateError, match=message):
        check_immersed_disk(curve, SQUARE, HALVES, boundary)


def test_not_finite():
    with pytest.raises(CertificateError, match="vertex 1 is not finite"):
        check_layered([(0, 0, 0), (1, 0, np.nan), (0, 1, 0)], [[0, 1, 2]])


EIGHT = np.array([(0.0, 0.0), (40.0, 40.0), (40.0, 0.0), (0.0, 40.0)])
BESIDE = np.array([(0.0, 0.0), (50.0, -10.0), (40.0, 40.0), (40.0, 0.0), (0.0, 40.0)])
THREE = [[0, 1, 3], [1, 2, 3], [0, 3, 4]]


@pytest.mark.parametrize("far", [0.0, 2.0**52, 2.0**60])
def test_vertex_beside_its_edge_where_doubles_are_sparse(far):
    """The second vertex stands for the middle of the first edge, and there the first triangle is turned over."""
    curve, vertices = (points + min(far, 2.0**52) for points in (EIGHT, BESIDE))
    if far > 2.0**52:
        curve, vertices = EIGHT.copy(), BESIDE.copy()
        curve[3, 1] = vertices[4, 1] = far
    with pytest.raises(CertificateError, match="turned over"):
        check_immersed_disk(curve, vertices, THREE, np.arange(5))


@pytest.mark.parametrize("unit", [5e-324, 1e-310])
def test_subnormal_square(unit):
    square = unit * np.array(SQUARE)
    check_immersed_disk(square, square, HALVES, [0, 1, 2, 3])
    check_surface(square, np.pad(square, ((0, 0), (0, 1))), HALVES, [0, 1, 2, 3])


# Layers


@pytest.mark.parametrize("gap", [-1.0, -5e-324, np.nan, -np.inf])
def test_gaps_that_are_none(gap):
    square = np.pad(SQUARE, ((0, 0), (0, 1)))
    for check in (check_layered, lambda *mesh: check_surface(SQUARE, mesh[0], mesh[1], [0, 1, 2, 3], mesh[2])):
        with pytest.raises(CertificateError, match="gap"):
            check(square, HALVES, gap)


@pytest.mark.parametrize("gap", [np.nextafter(12, 13), 100.0])
def test_gap(ramp, gap):
    vertices, faces, _ = ramp
    with pytest.raises(CertificateError, match="apart, or equal"):
        check_layered(vertices, faces, gap)


def test_equal_heights(ramp):
    vertices, faces, _ = ramp
    vertices[13, 2] = vertices[1, 2]
    with pytest.raises(CertificateError, match="apart, or equal"):
        check_layered(vertices, faces)
    assert meeting_pairs(vertices, faces)


def test_swapped_heights(ramp):
    vertices, faces, boundary = ramp
    vertices[[1, 13], 2] = vertices[[13, 1], 2]
    with pytest.raises(CertificateError, match="change their order"):
        check_surface(vertices[:, :2], vertices, faces, boundary)
    assert meeting_pairs(vertices, faces)


def test_edges_over_one_another():
    """Each triangle is alone over its place, but their edges cross."""
    vertices = [(0, 0, 0), (1, 0, 1), (0, 1, 0), (1, 0, 0), (0, 0, 1), (0, -1, 0)]
    faces = [[0, 1, 2], [3, 4, 5]]
    with pytest.raises(CertificateError, match="two edges over one another change their order"):
        check_layered(vertices, faces)
    assert meeting_pairs(np.array(vertices), np.array(faces)) == [(0, 1)]


def test_twice_the_same_triangle():
    with pytest.raises(CertificateError, match="two triangles over one another"):
        check_layered([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2], [1, 2, 0]])


@pytest.mark.parametrize("third", [(2, 2), (1, 0)])
def test_layers_need_positive_triangles(third):
    """Flat from above, or turned over."""
    with pytest.raises(CertificateError, match="flat or turned over"):
        check_layered([(0, 0, 0), (1, 1, 0), (*third, 0)], [[0, 1, 2]])


def test_one_order_if_and_only_if_nothing_meets():
    """Two copies of a random mesh with random heights, compared with the generic intersection test."""
    rng = np.random.default_rng(5)
    answers = []
    for _ in range(40):
        places = rng.random((12, 2))
        faces = Delaunay(places).simplices
        corners = places[faces]
        flipped = np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0
        faces[flipped] = faces[flipped, ::-1]
        height = rng.random((2, 12)) + np.array([[0.0], [0.5]])
        vertices = np.column_stack([np.tile(places, (2, 1)), height.ravel()])
        both = np.concatenate([faces, faces + 12])
        answers.append((passes(vertices, both), not meeting_pairs(vertices, both)))
    assert set(answers) == {(True, True), (False, False)}


def passes(vertices, faces):
    try:
        check_layered(vertices, faces)
    except CertificateError:
        return False
    return True


def test_overlap_in_the_plane():
    """Pairs of flat triangles on a small grid, with every kind of touching, against the generic test."""
    rng = np.random.default_rng(8)
    answers = []
    while len(answers) < 1500:
        corners = rng.integers(0, 4, (2, 3, 2))
        if (np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0.5).any():
            continue
        places, faces = np.unique(corners.reshape(-1, 2), axis=0, return_inverse=True)
        faces = faces.reshape(2, 3)
        if len({frozenset(face) for face in faces.tolist()}) < 2:
            continue
        vertices = np.pad(places, ((0, 0), (0, 1)))
        answers.append((passes(vertices, faces), not meeting_pairs(vertices, faces)))
    assert set(answers) == {(True, True), (False, False)}
    assert sum(passed for passed, _ in answers) > 100


def test_a_dent_does_not_hide_an_overlap():
    """A flat C with a tip over its own start, where a vertex is given beside its edge so that the tip is over nothing.

    The vertices as they are given lie flat and apart, and on their edges they are an immersed disk; but not a flat one.
    """
    curve = [(0, 0), (10, 0), (10, 10), (0.5, 10), (1, 1), (1.5, 8), (8, 8), (8, 2), (0, 2)]
    places = np.insert(np.array(curve, dtype=float), 8, (1.0, 0.5), axis=0)
    faces = [[0, 1, 8], [1, 7, 8], [0, 8, 9], [1, 2, 6], [1, 6, 7], [2, 3, 6], [3, 5, 6], [3, 4, 5]]
    vertices = np.pad(places, ((0, 0), (0, 1)))
    check_immersed_disk(curve, places, faces, np.arange(10))
    check_layered(vertices, faces)
    with pytest.raises(CertificateError, match="overlap in part"):
        check_surface(curve, vertices, faces, np.arange(10))


def test_vertices_over_one_another_are_where_their_edges_cross():
    """They may be given beside it, but as one double."""
    steps = pf.lift(RAMP, triangles=100)
    check_surface(RAMP, steps.vertices, steps.faces, steps.boundary)
    crossing = np.array(steps.layering.immersion.arrangement.crossings[0])
    moved = steps.vertices.copy()
    over = (moved[:, :2] == crossing).all(axis=1)
    moved[over, :2] += 1e-9
    check_surface(RAMP, moved, steps.faces, steps.boundary)
    moved[np.flatnonzero(over)[0], 0] += 1e-9
    with pytest.raises(CertificateError):
        check_surface(RAMP, moved, steps.faces, steps.boundary)


def test_vertices_over_one_another_on_edges_that_do_not_cross():
    """A strip round three sides of a square that comes back beside its start, and two vertices given in between."""
    curve = [(0, 0), (9, 0), (9, 9), (0, 9), (0, 3), (2, 3), (2, 7), (7, 7), (7, 2), (0, 2)]
    places = np.array([*curve[:5], (1, 2.5), *curve[5:9], (1, 2.5), *curve[9:]])
    faces = [
        [0, 1, 10], [1, 9, 10], [0, 10, 11], [1, 2, 9], [2, 8, 9], [2, 3, 8],
        [3, 7, 8], [3, 4, 5], [3, 5, 7], [5, 6, 7],
    ]  # fmt: skip
    check_immersed_disk(curve, places, faces, np.arange(12))
    height = np.array([0, 1, 2, 4, 6, 6, 6, 4, 2, 1, 0, 0])
    with pytest.raises(CertificateError, match=r"do not cross there, at \(1, 2.5\)"):
        check_surface(curve, np.column_stack([places, height]), faces, np.arange(12))


# The reference: triangles in space whose intersection is known


@pytest.mark.parametrize(
    ("second", "meets"),
    [
        ([(1, 1, -1), (1, 1, 1), (5, 5, 0)], True),  # through the first
        ([(1, 1, 0), (1, 1, 1), (2, 2, 1)], True),  # touches it with a corner
        ([(2, -1, 0), (2, 1, 1), (2, 5, 1)], False),  # passes below an edge's end
        ([(-1, 2, 0), (1, -2, 0), (0, 0, 5)], True),  # an edge through a corner
        ([(1, 1, 0), (9, 1, 0), (1, 9, 0)], True),  # in the same plane
        ([(4, 4, 0), (9, 4, 0), (4, 9, 0)], False),  # in the same plane, apart
        ([(0, 0, 1), (4, 0, 1), (0, 4, 1)], False),  # above
    ],
)
def test_reference_without_common_vertices(second, meets):
    vertices = np.array([(0, 0, 0), (4, 0, 0), (0, 4, 0), *second])
    assert bool(meeting_pairs(vertices, np.array([[0, 1, 2], [3, 4, 5]]))) is meets


@pytest.mark.parametrize(
    ("second", "others", "meets"),
    [
        ([0, 1, 3], [(2, -2, 0)], False),  # unfolded
        ([0, 1, 3], [(1, 1, 0)], True),  # folded flat on the first
        ([0, 1, 3], [(1, 1, 1)], False),  # folded, but not flat
        ([0, 3, 4], [(-1, 0, 0), (0, -1, 0)], False),  # meets in the common vertex alone
        ([0, 3, 4], [(1, 1, 1), (1, 1, -1)], True),  # common vertex, and through the first
        ([0, 3, 4], [(-2, 3, 0), (3, -2, 0)], True),  # in the same plane round the common vertex
    ],
)
def test_reference_with_common_vertices(second, others, meets):
    vertices = np.array([(0, 0, 0), (4, 0, 0), (0, 4, 0), *others])
    assert bool(meeting_pairs(vertices, np.array([[0, 1, 2], second]))) is meets
