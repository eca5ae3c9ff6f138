"""The checker of solids: right ones pass, and every kind of spoiled one is refused."""

from contextlib import suppress

import numpy as np
import pytest

from plyfold.certify import check_ball_mesh, check_solid
from plyfold.errors import CertificateError

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]


def prism(points, triangles, height, low=0.0):
    """Vertices and triangles of a prism; the points go round it counter-clockwise."""
    n = len(points)
    vertices = [(*point, z) for z in (low + height, low) for point in points]
    faces = [*triangles, *([c + n, b + n, a + n] for a, b, c in triangles)]
    for i in range(n):
        j = (i + 1) % n
        faces += [[n + i, n + j, j], [n + i, j, i]]
    return np.array(vertices, dtype=float), np.array(faces)


def tile(height=0.5):
    return prism(SQUARE, [[0, 1, 2], [0, 2, 3]], height)


def refused(vertices, faces, thickness=0.5, match=None):
    with pytest.raises(CertificateError, match=match) as caught:
        check_solid(vertices, faces, thickness)
    return caught.value


def test_a_tile():
    check_solid(*tile(), 0.5)


@pytest.mark.parametrize("scale", [1e-150, 1e-8, 1e8, 1e100])
def test_any_size(scale):
    vertices, faces = tile()
    check_solid(scale * vertices, faces, scale * 0.5)


@pytest.mark.parametrize("shift", [(1e6, -1e6, 0), (0, 0, 1e6), (1e9, 0, -1e3)])
def test_any_place(shift):
    vertices, faces = tile()
    check_solid(vertices + shift, faces, 0.5)


def test_a_slope():
    vertices, faces = tile()
    vertices[:, 2] += 3 * vertices[:, 0] - vertices[:, 1]
    check_solid(vertices, faces, 0.5)


def test_inside_out():
    vertices, faces = tile()
    refused(vertices, faces[:, ::-1])


@pytest.mark.parametrize("face", range(12))
def test_a_hole(face):
    vertices, faces = tile()
    refused(vertices, np.delete(faces, face, axis=0), match="not closed")


@pytest.mark.parametrize("face", range(12))
def test_a_triangle_turned_over(face):
    vertices, faces = tile()
    faces[face] = faces[face, ::-1]
    refused(vertices, faces, match="same side")


@pytest.mark.parametrize("vertex", range(8))
@pytest.mark.parametrize("axis", range(3))
def test_a_vertex_moved(vertex, axis):
    vertices, faces = tile()
    vertices[vertex, axis] += 1e-9
    refused(vertices, faces)


def test_wrong_thickness():
    vertices, faces = tile()
    refused(vertices, faces, 0.5 + 1e-12, match="apart")
    refused(vertices, faces, -0.5, match="apart")


def test_two_parts():
    vertices, faces = tile()
    refused(np.concatenate([vertices, vertices + 5]), np.concatenate([faces, faces + 8]), match="several parts")


def test_other_diagonal_above_than_below():
    vertices, faces = tile()
    refused(vertices, [[0, 1, 3], [1, 2, 3], *faces[2:].tolist()], match="right above")


def test_a_box_has_no_top_that_is_cut_otherwise():
    """The same body with a point in the middle of the top only."""
    vertices, faces = tile()
    vertices = np.concatenate([vertices, [[1.0, 1.0, 0.5]]])
    top = [[0, 1, 8], [1, 2, 8], [2, 3, 8], [3, 0, 8]]
    refused(vertices, np.array([*top, *faces[2:].tolist()]), match="alternate")


def fin():
    """A tile with a thin fold of wall inside, from corner to corner, that encloses nothing."""
    vertices, faces = tile()
    two_sides = [[4, 6, 2], [4, 2, 0], [6, 4, 0], [6, 0, 2]]
    return vertices, np.concatenate([faces, two_sides])


def test_walls_elsewhere_than_along_the_rim():
    refused(*fin())


def test_walls_that_span_several_edges():
    """A peak on a straight side: walls from the side's one end to its other end would pass through each other."""
    points = [(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)]
    vertices, faces = prism(points, [[1, 2, 3], [1, 3, 4], [0, 1, 4]], 0.5)
    vertices[[1, 6], 2] += 10.0
    check_solid(vertices, faces, 0.5)
    kept = [face for face in faces.tolist() if not {*face} <= {0, 1, 5, 6} and not {*face} <= {1, 2, 6, 7}]
    refused(vertices, np.array([*kept, [5, 6, 7], [5, 7, 2], [5, 2, 0], [0, 2, 1]]), match="wall")


@pytest.mark.parametrize("thickness", [0.1, 0.3, 1e-6, 7.7])
@pytest.mark.parametrize("height", [0.0, 0.1, 1e9, -1234.56789])
def test_as_thick_as_rounding_allows(height, thickness):
    """Heights that half the thickness is added to and taken from are right; two doubles further, they are not."""
    vertices, faces = tile()
    vertices[:, 2] = np.repeat([height + thickness / 2, height - thickness / 2], 4)
    check_solid(vertices, faces, thickness)
    further = 2 * np.spacing(np.abs(vertices[:, 2]).max())
    for vertex, way in ((0, further), (0, -further), (4, further), (4, -further)):
        spoiled = vertices.copy()
        spoiled[vertex, 2] += way
        refused(spoiled, faces, thickness, match="apart")


@pytest.mark.parametrize("exponent", [-1060, -300, 0, 300])
def test_thickness_is_exact(exponent):
    """Against rational numbers, for heights of a few units each way."""
    unit = 2.0**exponent
    _, faces = tile()
    rng = np.random.default_rng(1)
    answers = []
    for high, low, thickness in rng.integers(1, 40, (300, 3)) * [1, -1, 2]:
        vertices = np.column_stack([np.tile(SQUARE, (2, 1)), np.repeat([high * unit, low * unit], 4)])
        with suppress(CertificateError):
            check_solid(vertices, faces, thickness * unit)
            answers.append(high - low == thickness)
    assert answers
    assert all(answers)


@pytest.mark.parametrize("thickness", [np.nan, np.inf])
def test_thickness_that_is_none(thickness):
    refused(*tile(), thickness, match="finite")


def test_errors_name_the_place():
    vertices, faces = tile()
    vertices = np.concatenate([vertices, [[1.0, 1.0, 0.5]]])
    top = [[0, 1, 8], [1, 2, 8], [2, 3, 8], [3, 0, 8]]
    assert refused(vertices, np.array([*top, *faces[2:].tolist()])).where == ((1.0, 1.0),)
    assert refused(*tile(), 0.25).where == ((0.0, 0.0),)


def test_overhanging_wall():
    """Sides that lean outwards are no walls."""
    vertices, faces = tile()
    vertices[:4, :2] = 1 + 1.2 * (vertices[:4, :2] - 1)
    refused(vertices, faces)


def spiral(turns, pitch, thickness, corners=8):
    """A spiral ramp round a tower, as thick as given, that climbs by the pitch at each turn."""
    steps = turns * corners + 2
    angle = 2 * np.pi * (np.arange(steps) % corners) / corners
    rim = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    middle = pitch * np.arange(steps) / corners
    outline = np.concatenate([2 * rim, rim[::-1]])
    height = np.concatenate([middle, middle[::-1]])
    n = len(outline)
    triangles = []
    for i in range(steps - 1):
        triangles += [[i, i + 1, n - 2 - i], [i, n - 2 - i, n - 1 - i]]
    vertices, faces = prism(outline, triangles, thickness, -thickness / 2)
    vertices[:, 2] += np.tile(height, 2)
    return vertices, faces


def test_a_ramp_over_itself():
    check_solid(*spiral(3, 1.0, 0.9), 0.9)


def test_a_ramp_that_is_too_thick():
    refused(*spiral(3, 1.0, 1.0), 1.0)
    refused(*spiral(3, 1.0, 1.1), 1.1, match="alternate")
    refused(*spiral(3, 1.0, 2.3), 2.3)


def test_a_ramp_that_comes_down_through_itself():
    vertices, faces = spiral(2, 1.0, 0.3)
    n = len(vertices) // 2
    steps = n // 2
    for vertex in (steps - 1, steps, n + steps - 1, n + steps):
        vertices[vertex, 2] -= 3.0
    refused(vertices, faces, 0.3)


def test_a_sphere_is_a_ball_mesh_and_a_torus_is_not():
    _, faces = tile()
    check_ball_mesh(faces, 8)
    ring = np.arange(9).reshape(3, 3)
    torus = []
    for i in range(3):
        for j in range(3):
            a, b = ring[i, j], ring[(i + 1) % 3, j]
            c, d = ring[(i + 1) % 3, (j + 1) % 3], ring[i, (j + 1) % 3]
            torus += [[a, b, c], [a, c, d]]
    with pytest.raises(CertificateError, match="Euler characteristic 0; a sphere has 2"):
        check_ball_mesh(torus, 9)
