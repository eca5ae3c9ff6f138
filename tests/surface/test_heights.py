"""Heights: as smooth as another solver makes them, and exactly apart."""

import numpy as np
import pytest
from scipy.optimize import nnls

from cloths import energy_matrix
from coarse import CURVES
from plyfold import find_layering, immersions
from plyfold.clock import Watch
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface.glue import stack_sheets
from plyfold.surface.heights import smooth_heights
from plyfold.surface.lift import lift
from reference import random_curves

RAMP = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], dtype=np.float64)


def glued(points, triangles=150):
    layering = next(filter(None, map(find_layering, immersions(points))))
    planar = triangulate_cells(layering.immersion.arrangement, triangles=triangles)
    return planar.points, stack_sheets(layering, planar)


def helix(turns, per_turn=60):
    """A band that winds around and around, ever a little further out; sheets lie on each other everywhere."""
    t = np.linspace(0, 2 * np.pi * turns + 0.3, per_turn * turns)
    direction = np.column_stack([np.cos(t), np.sin(t)])
    return np.vstack([(3 + 0.01 * t)[:, None] * direction, ((2 + 0.01 * t)[:, None] * direction)[::-1]])


def kept_apart(z, mesh, gap):
    lower, upper = mesh.stacked.T
    return (z[lower] + gap <= z[upper]).all()


def dual_energy(energy, rows, least):
    """The same quadratic program by its dual, with non-negative least squares.

    Least ½ zᵀKz with Dz ≥ a: z = K⁺Dᵀf for the forces f ≥ 0 that make ½ fᵀDK⁺Dᵀf − aᵀf least. With K = RᵀR and
    the columns A = R⁻ᵀDᵀ that is ½ |Af|² − aᵀf; adding a row of large ones turns it into least squares. No heights
    that keep the distances have less energy than the value for any f.
    """
    root = np.linalg.cholesky(energy[1:, 1:])
    columns = np.linalg.solve(root, rows[:, 1:].T)
    # The least distance of the cone {Af, aᵀf} from a point far up the last axis has the direction of the solution.
    shares, _ = nnls(np.vstack([columns, least]), np.append(np.zeros(len(columns)), 1.0))
    force = shares * (least @ shares) / ((columns @ shares) ** 2).sum()
    return least @ force - ((columns @ force) ** 2).sum() / 2


def differences(mesh):
    rows = np.zeros((len(mesh.stacked), len(mesh.level)))
    rows[np.arange(len(rows)), mesh.stacked[:, 0]] = -1
    rows[np.arange(len(rows)), mesh.stacked[:, 1]] = 1
    return rows


@pytest.mark.parametrize("name", ["horseshoe", "exit-ramp", "two-loops", "stacked-spiral", "milnor", "bennequin"])
@pytest.mark.parametrize("options", [{}, {"stiffness": 2.0}, {"flat": 30.0}], ids=str)
def test_least_energy(name, options):
    points, mesh = glued(CURVES[name].curve.points)
    energy = energy_matrix(points, mesh, **options)
    z = smooth_heights(points, mesh, 1.0, **options)
    assert kept_apart(z, mesh, 1.0)
    assert z @ energy @ z / 2 == pytest.approx(
        dual_energy(energy, differences(mesh), np.ones(len(mesh.stacked))), rel=3e-6
    )


@pytest.mark.parametrize("turns", [2, 3, 5])
def test_least_energy_of_long_stacks(turns):
    points, mesh = glued(helix(turns, 16))
    z = smooth_heights(points, mesh, 1.0)
    assert kept_apart(z, mesh, 1.0)
    assert mesh.level.max() >= turns - 1
    energy = energy_matrix(points, mesh)
    least = dual_energy(energy, differences(mesh), np.ones(len(mesh.stacked)))
    assert z @ energy @ z / 2 == pytest.approx(least, rel=3e-6)


@pytest.mark.parametrize("turns", [5, 8])
def test_long_stacks_take_few_triangles_and_rounds(turns):
    """Good angles take at most about three times the triangles of the curve alone; contacts need a few dozen rounds."""
    (points, mesh), (_, plain) = glued(helix(turns), triangles=4000), glued(helix(turns), triangles=0)
    assert 4000 <= len(mesh.faces) <= 1.5 * max(4000, 3 * len(plain.faces))
    told = []
    z = smooth_heights(points, mesh, 1.0, watch=Watch(progress=lambda stage, done: told.append(done)))
    assert kept_apart(z, mesh, 1.0)
    assert len(told) <= 60


@pytest.mark.parametrize("gap", [1e-12, 0.1, 1.0, 1e5])
def test_heights_grow_with_the_gap(gap):
    points, mesh = glued(CURVES["exit-ramp"].curve.points)
    z, unit = smooth_heights(points, mesh, gap), smooth_heights(points, mesh, 1.0)
    assert kept_apart(z, mesh, gap)
    assert z.min() == 0
    assert z == pytest.approx(gap * unit, rel=1e-9, abs=1e-9 * gap)


@pytest.mark.parametrize("turn", [0.3, 2.0])
@pytest.mark.parametrize("scale", [1e-6, 1e4])
def test_heights_do_not_depend_on_the_frame(turn, scale):
    """Same mesh, turned, moved and scaled."""
    points, mesh = glued(CURVES["exit-ramp"].curve.points)
    rotation = scale * np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    plain, moved = smooth_heights(points, mesh, 1.0), smooth_heights(points @ rotation + 3 * scale, mesh, 1.0)
    assert moved == pytest.approx(plain, abs=1e-6)
    assert kept_apart(moved, mesh, 1.0)


def test_nothing_overlaps():
    points, mesh = glued(CURVES["circle"].curve.points)
    assert not smooth_heights(points, mesh, 1.0).any()


def test_progress_goes_up():
    points, mesh = glued(RAMP)
    told = []
    smooth_heights(points, mesh, 1.0, watch=Watch(progress=lambda stage, done: told.append((stage, done))))
    assert {stage for stage, _ in told} == {"smoothing heights"}
    done = [share for _, share in told]
    assert done == sorted(done)
    assert all(0 <= share <= 1 for share in done)


@pytest.mark.parametrize("width", [1e-4, 1e-8, 1e-11, 1e-13])
@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_strips_as_thin_as_rounding_errors(width, turn):
    """Triangles may have next to no area; the heights are proven all the same, and go no higher than for wide ones."""
    thin = RAMP.copy()
    thin[8:, 1] = width
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    surface = lift(thin @ rotation, triangles=200, gap=1.0)
    surface.check()
    assert np.ptp(surface.vertices[:, 2]) < 10


@pytest.mark.parametrize("width", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
@pytest.mark.parametrize("needle", ["strip", "cells"])
def test_needles(needle, width):
    """A strip, or cells, as thin as rounding errors: the certificate holds and the heights are those of cloth."""
    strip = [(3, -3), (3 + width, -3), (3 + 2 * width, 5)]
    cells = [(3, -width), (4, -0.7 * width), (4, 5)]
    ramp = [(0, 0), (9, 0), (9, 6), (3, 6), *(strip if needle == "strip" else cells), (8, 5), (8, 1), (0, 1)]
    surface = lift(ramp)
    surface.check()
    # In the thinnest ones the last digits decide how far the loose ends swing; nothing is nearly flat or endless.
    most = 4 if width > 1e-8 else 100
    assert surface.gap <= np.ptp(surface.vertices[:, 2]) < most * surface.gap


@pytest.mark.parametrize("seed", [1006, 1017, 1048])
def test_narrow_ribbons_do_not_tower(seed):
    """Where narrow strips touch they bend locally, instead of climbing dozens of gaps."""
    surface = lift(random_curves.ribbon_outline(np.random.default_rng(seed), 60), triangles=1000)
    levels = surface.layering.level.max()
    assert np.ptp(surface.vertices[:, 2]) < 5 * levels * surface.gap


def test_energy_of_a_plane():
    """A plane is in balance away from its boundary, whatever the triangles are like there."""
    points, mesh = glued(CURVES["stacked-spiral"].curve.points, triangles=2000)
    x, y = points[mesh.planar_vertex].T
    size = max(np.ptp(x), np.ptp(y))
    energy = energy_matrix(points, mesh)
    boundary_free = np.setdiff1d(np.arange(len(x)), _two_rings(mesh))
    pull = energy @ ((3 * x - 4 * y) / size)
    assert np.abs(pull[boundary_free]).max() < 1e-2 * np.abs(pull).max()


def _two_rings(mesh):
    """Vertices on the boundary, or with a neighbour on it, or with a neighbour of that kind."""
    ring = mesh.boundary
    for _ in range(2):
        ring = np.unique(mesh.faces[np.isin(mesh.faces, ring).any(axis=1)])
    return ring


def test_interrupted_from_the_keyboard():
    def interrupt(stage, done):
        raise KeyboardInterrupt

    points, mesh = glued(RAMP)
    with pytest.raises(KeyboardInterrupt):
        smooth_heights(points, mesh, 1.0, watch=Watch(progress=interrupt))


def heights_at(surface, points):
    """The heights of all sheets over some points, from below."""
    of_point = {}
    for x, y, z in surface.vertices.tolist():
        of_point.setdefault((x, y), []).append(z)
    return np.array([z for point in map(tuple, points.tolist()) for z in sorted(of_point[point])])


@pytest.mark.parametrize("name", ["exit-ramp", "pretzel", "stacked-spiral", "milnor"])
@pytest.mark.parametrize("backward", [False, True])
def test_the_starting_point_does_not_matter(name, backward):
    points = np.array(CURVES[name].curve.points)
    changed = np.roll(points, len(points) // 3, axis=0)[:: -1 if backward else 1]
    first, second = lift(points, triangles=2000), lift(changed, triangles=2000)
    difference = heights_at(first, points) - heights_at(second, points)
    assert np.ptp(difference) < 0.05 * first.gap
