"""Heights: as smooth as can be, compared with a dense solution by another method; and sane where cells are needles."""

import numpy as np
import pytest
from scipy.linalg import eigh, solve
from scipy.optimize import nnls

from plyfold import find_immersion, find_layering
from plyfold.gallery import CURVES
from plyfold.surface import lift
from plyfold.surface.glue import glue_sheets
from plyfold.surface.heights import _contact_problem, smooth_heights
from plyfold.surface.triangulation import triangulate
from reference import random_curves


def glued(name, triangles):
    layering = find_layering(find_immersion(CURVES[name].curve))
    cells = triangulate(layering.immersion.arrangement, triangles=triangles)
    return cells, glue_sheets(layering, cells)


def optimal_heights(energy, difference):
    """Least ½ zᵀ E z with D z ≥ 1 and z₀ = 0, by its dual: nonnegative least squares for the contact forces."""
    energy, difference = energy[1:, 1:], difference[:, 1:]
    moved_by = solve(energy, difference.T, assume_a="pos")
    values, vectors = eigh(difference @ moved_by)
    kept = values > 1e-13 * values.max()
    root = np.sqrt(values[kept])
    force, _ = nnls(root[:, None] * vectors[:, kept].T, vectors[:, kept].T.sum(axis=1) / root, maxiter=10_000)
    return np.concatenate([[0.0], moved_by @ force])


@pytest.mark.parametrize("name", ["horseshoe", "exit-ramp", "stacked-spiral", "milnor", "bennequin"])
def test_no_heights_are_smoother(name):
    cells, mesh = glued(name, triangles=100)
    problem = _contact_problem(cells.points, mesh)
    expected = optimal_heights(problem.energy.toarray(), problem.difference.toarray())
    found = smooth_heights(cells.points, mesh, gap=2.0)
    assert found == pytest.approx(2.0 * (expected - expected.min()), abs=1e-5)


def test_energy_of_a_plane():
    """A plane is in balance away from its boundary, whatever the triangles are like there."""
    cells, mesh = glued("stacked-spiral", triangles=2000)
    x, y = cells.points[mesh.planar_vertex].T
    size = max(np.ptp(x), np.ptp(y))
    energy = _contact_problem(cells.points, mesh).energy
    boundary_free = np.setdiff1d(np.arange(len(x)), _two_rings(mesh))
    pull = energy @ ((3 * x - 4 * y) / size)
    assert np.abs(pull[boundary_free]).max() < 1e-2 * np.abs(pull).max()


def _two_rings(mesh):
    """Vertices on the boundary, or with a neighbour on it, or with a neighbour of that kind."""
    ring = mesh.boundary
    for _ in range(2):
        ring = np.unique(mesh.faces[np.isin(mesh.faces, ring).any(axis=1)])
    return ring


@pytest.mark.parametrize("seed", [1006, 1017, 1048])
def test_narrow_ribbons_do_not_tower(seed):
    """Where narrow strips touch they bend locally, instead of climbing dozens of gaps."""
    surface = lift(random_curves.ribbon_outline(np.random.default_rng(seed), 60), triangles=1000)
    levels = surface.layering.level.max()
    assert np.ptp(surface.vertices[:, 2]) < 3 * levels * surface.gap


@pytest.mark.parametrize("width", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
@pytest.mark.parametrize("needle", ["strip", "cells"])
def test_needles(needle, width):
    """A strip, or cells, as thin as rounding errors: the certificate holds and the heights are those of cloth."""
    strip = [(3, -3), (3 + width, -3), (3 + 2 * width, 5)]
    cells = [(3, -width), (4, -0.7 * width), (4, 5)]
    ramp = [(0, 0), (9, 0), (9, 6), (3, 6), *(strip if needle == "strip" else cells), (8, 5), (8, 1), (0, 1)]
    surface = lift(ramp)
    surface.check()
    assert surface.gap <= np.ptp(surface.vertices[:, 2]) < 3 * surface.gap


def test_flat_without_overlap():
    cells, mesh = glued("circle", triangles=300)
    assert not smooth_heights(cells.points, mesh, gap=1.0).any()


def test_progress_rises_and_may_interrupt():
    cells, mesh = glued("exit-ramp", triangles=300)
    done = []
    smooth_heights(cells.points, mesh, 1.0, lambda stage, fraction: done.append(fraction))
    assert done == sorted(done)
    assert 0 <= done[0] < done[-1] <= 1

    def interrupt(stage, fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        smooth_heights(cells.points, mesh, 1.0, interrupt)
