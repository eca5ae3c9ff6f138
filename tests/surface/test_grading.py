"""The mesh that heights are solved on: it halves the right triangles, and then solutions no longer depend on it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse.linalg import splu

import plyfold as pf
from plyfold import gallery
from plyfold.halfedges import ends_of, twins_of
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface import grading
from plyfold.surface.energy import cloth_of
from plyfold.surface.glue import LiftedMesh
from plyfold.surface.grading import cloth_mesh, double_areas, graded

NONE = np.empty((0, 2), dtype=np.int64)


def disk_of(places, faces):
    """A disk of triangles, over which nothing lies."""
    start, end = ends_of(faces)
    ahead = dict(zip(start[twins_of(faces) < 0].tolist(), end[twins_of(faces) < 0].tolist(), strict=True))
    boundary = [next(iter(ahead))]
    while (step := ahead[boundary[-1]]) != boundary[0]:
        boundary.append(step)
    n, ends = np.arange(len(places)), (np.array(boundary), np.array([0, len(boundary)]))
    return LiftedMesh(n, faces, np.zeros(len(faces), dtype=np.int64), *ends, NONE[:, 0], 0 * n, NONE, NONE)


def square(n, slit=False):
    """The unit square in 2n² triangles, which may be slit from the middle of the left side to the centre."""
    x, y = np.meshgrid(np.arange(n + 1), np.arange(n + 1))
    corner = (x + (n + 1) * y)[:-1, :-1].reshape(-1, 1)
    faces = (corner + np.array([0, 1, n + 2, 0, n + 2, n + 1])).reshape(-1, 3)
    places = np.stack([x, y], axis=2).reshape(-1, 2) / n
    if slit:
        lower = n // 2 * (n + 1) + np.arange(n // 2)
        upper = np.arange(len(places))
        upper[lower] = len(places) + np.arange(n // 2)
        is_above = places[faces, 1].mean(axis=1) > 0.5
        faces[is_above] = upper[faces[is_above]]
        places = np.concatenate([places, places[lower]])
    return places, disk_of(places, faces)


def smallest_sines(places, faces):
    """Return the sine of the smallest angle of each triangle: the double area by the longer two sides."""
    sides = places[faces] - places[np.roll(faces, -1, axis=1)]
    _, middle, longest = np.sort(np.hypot(sides[..., 0], sides[..., 1]), axis=1).T
    return double_areas(places, faces) / (middle * longest)


def answers(cloth, force):
    """Heights that balance forces whose sum is 0, the first one 0."""
    return np.append(0.0, splu(cloth.stiffness.tocsc()[1:, 1:]).solve(force[1:]))


def test_borders_are_level():
    """Cloth pulled up at one side and down at the other one: with level ends, less yields than in a plane."""
    places, mesh = square(64)
    length = 0.2
    cloth = cloth_of(cloth_mesh(places, mesh, 2 * length), mesh, 2 * length, 1.0)
    ends = np.where(places[:, 0] == 1, 1.0, 0.0) - np.where(places[:, 0] == 0, 1.0, 0.0)
    force = ends * np.where(np.isin(places[:, 1], (0, 1)), 0.5, 1.0) / 64
    assert force @ answers(cloth, force) == pytest.approx(1 - 2 * length * np.tanh(1 / (2 * length)), rel=1e-3)


@pytest.mark.parametrize("n", [32, 48])
def test_slit_square(n, monkeypatch):
    """The lips of a slit, forced apart by 1 near its end, have the energy that finer and finer meshes lead to."""
    places, mesh = square(n, slit=True)
    force = np.zeros(len(places))
    force[[n // 2 * (n + 1) + n // 2 - n // 16, (n + 1) ** 2 + n // 2 - n // 16]] = -1, 1

    def energy():
        fine = cloth_mesh(places, mesh, 0.5)
        cloth = cloth_of(fine, mesh, 0.5, 1.0)
        assert cloth.bending == pytest.approx(0.2**2)
        pull = np.append(force, np.zeros(fine.added))
        return 0.5 / (pull @ answers(cloth, pull))

    assert energy() == pytest.approx(1.027, rel=0.01)
    monkeypatch.setattr(grading, "_WIDEST", 10.0)
    assert energy() > 1.1 * 1.027


@pytest.mark.parametrize("name", ["milnor", "bennequin", "ten-gon"])
def test_heights_do_not_depend_on_the_mesh(name):
    coarse, fine = (pf.lift(gallery.CURVES[name].curve, triangles=n) for n in (4000, 16000))
    assert np.ptp(fine.vertices[:, 2]) == pytest.approx(np.ptp(coarse.vertices[:, 2]), rel=5e-3)


def test_points_in_the_middle_of_edges_change_little():
    points = gallery.CURVES["milnor"].curve.points
    middles = (points + np.roll(points, -1, axis=0)) / 2
    finer = np.stack([points, middles], axis=1).reshape(-1, 2)
    plain, halved = (np.ptp(pf.lift(curve).vertices[:, 2]) for curve in (points, finer))
    assert halved == pytest.approx(plain, rel=5e-3)


class TestHalving:
    """Meshes of random needle-like drawings, graded towards random vertices."""

    @staticmethod
    def drawn(seed):
        rng = np.random.default_rng(seed)
        angle = 2 * np.pi / 12 * (np.arange(12) + rng.uniform(0, 0.9, 12))
        star = rng.uniform(0.1, 1.0, 12)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        cells = triangulate_cells(pf.arrange(star), triangles=300)
        mesh = disk_of(cells.points, cells.triangles)
        return cells.points, mesh, rng.choice(mesh.boundary, 2, replace=False)

    @staticmethod
    def graded(places, mesh, corners, finest):
        follower = np.full(len(places), -1)
        follower[mesh.boundary] = np.roll(mesh.boundary, -1)
        return graded(places, mesh.faces, corners, follower, finest)

    @settings(max_examples=25, deadline=None)
    @given(st.integers(0, 2**32))
    def test_same_surface(self, seed):
        """Triangles are parts of those they say, none hangs, and added vertices are in the middle of edges."""
        places, mesh, corners = self.drawn(seed)
        finer, faces, origin, ends = self.graded(places, mesh, corners, 1e-3)
        assert finer[: len(places)].tobytes() == places.tobytes()
        assert len(mesh.faces) < len(faces) <= 2 * len(mesh.faces) + 10
        assert np.allclose(finer[len(places) :], finer[ends].mean(axis=1), rtol=0, atol=1e-15)
        parts = np.bincount(origin, double_areas(finer, faces))
        assert np.allclose(parts, double_areas(places, mesh.faces), rtol=1e-9)
        assert (double_areas(finer, faces) > 0).all()
        start, end = ends_of(faces)
        start, end = start[twins_of(faces) < 0], end[twins_of(faces) < 0]
        halves = np.isin(np.stack([start, end]), mesh.boundary) | (np.stack([start, end]) >= len(places))
        assert halves.all()
        length = np.hypot(*(finer[start] - finer[end]).T).sum()
        outline = places[mesh.boundary]
        assert length == pytest.approx(np.hypot(*(np.roll(outline, -1, axis=0) - outline).T).sum(), rel=1e-12)

    @settings(max_examples=25, deadline=None)
    @given(st.integers(0, 2**32))
    def test_small_at_corners(self, seed):
        """Where there is room for all, sides at corners are as short as is asked for, and angles not too small."""
        places, mesh, corners = self.drawn(seed)
        finer, faces, origin, _ = self.graded(places, mesh, corners, 0.01)
        sides = finer[faces] - finer[np.roll(faces, -1, axis=1)]
        at_corner = np.isin(faces, corners).any(axis=1)
        longest = np.hypot(sides[..., 0], sides[..., 1]).max(axis=1)
        assert longest[at_corner].max() <= 0.01 or len(faces) > 1.3 * len(mesh.faces)
        assert (smallest_sines(finer, faces) >= 0.45 * smallest_sines(places, mesh.faces)[origin]).all()

    def test_nothing_to_do(self):
        places, mesh, _ = self.drawn(1)
        finer, faces, _, ends = self.graded(places, mesh, NONE[:, 0], 0.01)
        assert finer is places
        assert faces is mesh.faces
        assert not len(ends)
