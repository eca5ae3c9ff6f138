"""Outlines with strands a few roundings apart: what is returned passes its own check, or an error names the place."""

from collections import Counter

import numpy as np
import pytest

import plyfold as pf
from nightly.meshes import judge_spike, thin_spike
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface.glue import stack_sheets
from plyfold.surface.heights import _require_order

SPIKE = [
    (1.0999537312227226, 1.3024324802324683),
    (1.248266104489822, 1.5219692075896547),
    (1.0999537312227228, 1.3024324802324683),
    (1.374052643115983, 1.6453469887746417),
    (1.0396688371958978, 1.5997962921695523),
]
RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]


@pytest.mark.parametrize("triangles", [50, 400, 4000])
def test_a_spike_one_rounding_wide(triangles):
    """Points are added everywhere but on its sides."""
    surface = pf.lift(SPIKE, triangles=triangles)
    surface.check()
    assert surface.vertices[:1, :2].tolist() == [list(SPIKE[0])]
    assert len(surface.faces) >= triangles / 3
    pf.unwrap(SPIKE, triangles=triangles).check()


def test_random_spikes():
    outcomes = Counter()
    for seed in range(60):
        rng = np.random.default_rng(seed)
        outcomes[judge_spike(thin_spike(rng), rng)] += 1
    assert outcomes["lifted"] > 15
    assert outcomes["refused"] <= 3


def test_a_gap_that_is_lost_in_rounding():
    layering = pf.lift(RAMP, triangles=50).layering
    cells = triangulate_cells(layering.immersion.arrangement, triangles=50)
    mesh = stack_sheets(layering, cells)
    _require_order(mesh.level * 1e-300, cells.points, mesh)
    with pytest.raises(pf.errors.PrecisionError, match="lost in rounding") as caught:
        _require_order(5.0 + mesh.level * 1e-300, cells.points, mesh)
    assert caught.value.where
