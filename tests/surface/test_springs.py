"""Where forces cannot be found, springs give the same heights; and wrong heights are an error, not an answer."""

from dataclasses import replace

import numpy as np
import pytest
from families import glued_disk

from cloths import energy_matrix
from plyfold import find_layering, immersions
from plyfold.errors import PrecisionError
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface import contact, heights
from plyfold.surface.glue import stack_sheets
from plyfold.surface.heights import smooth_heights


@pytest.fixture(scope="module")
def dense():
    """Sheets piled on each other; the contact forces at its re-entrant corners are thousands of times the others."""
    layering = next(filter(None, map(find_layering, immersions(glued_disk(60)))))
    planar = triangulate_cells(layering.immersion.arrangement, triangles=300)
    return planar.points, stack_sheets(layering, planar)


def energy_of(case, z):
    return z @ energy_matrix(*case) @ z / 2


def test_springs_agree_with_forces(dense, monkeypatch):
    gap = 0.05 * np.ptp(dense[0], axis=0).max()
    forced = smooth_heights(*dense, gap)
    monkeypatch.setattr(contact, "_MOST_PLACES", 5)
    sprung = smooth_heights(*dense, gap)
    lower, upper = dense[1].stacked.T
    assert (sprung[lower] + gap <= sprung[upper]).all()
    assert energy_of(dense, sprung) == pytest.approx(energy_of(dense, forced), rel=1e-5)


def test_springs_that_have_not_come_to_an_end_are_an_error(dense, monkeypatch):
    monkeypatch.setattr(contact, "_MOST_PLACES", 5)
    monkeypatch.setattr(contact, "_SPRING_ROUNDS", 2)
    with pytest.raises(PrecisionError, match=r"the heights of least energy were not found.*more than needed"):
        smooth_heights(*dense, 1e5)


def test_wrong_forces_are_an_error(dense, monkeypatch):
    """Forces that are a little too large keep all distances, and more."""
    right = heights.forced_heights

    def wrong(*arguments):
        found = right(*arguments)
        return replace(found, heights=1.01 * found.heights, force=1.01 * found.force)

    monkeypatch.setattr(heights, "forced_heights", wrong)
    with pytest.raises(PrecisionError, match="were not found"):
        smooth_heights(*dense, 1e5)


@pytest.mark.parametrize("stiffness", [0.1, 0.5, 30.0])
def test_the_bound_is_a_bound(dense, stiffness, monkeypatch):
    """Forces of any size prove a bound, and those found prove the energy of the heights."""
    seen = []
    require = heights._require_least
    monkeypatch.setattr(heights, "_require_least", lambda *given: (seen.append(given), require(*given)))
    smooth_heights(*dense, 1.0, stiffness=stiffness)
    z, found, problem, _ = seen[0]
    energy = problem.cloth.energy(z)
    assert found.least_energy(problem) == pytest.approx(energy, rel=1e-5)
    for factor in (0.5, 0.9, 1.1, 2.0):
        other = contact.Balance(factor * found.heights, factor * found.force)
        assert other.least_energy(problem) < energy
