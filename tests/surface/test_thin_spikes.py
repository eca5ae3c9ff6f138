"""Outlines with strands a few roundings apart: what is returned passes its own check, or an error names the place."""

import pytest

import plyfold as pf

SPIKE = [
    (1.0999537312227226, 1.3024324802324683),
    (1.248266104489822, 1.5219692075896547),
    (1.0999537312227228, 1.3024324802324683),
    (1.374052643115983, 1.6453469887746417),
    (1.0396688371958978, 1.5997962921695523),
]


@pytest.mark.xfail(strict=True)
@pytest.mark.parametrize("triangles", [50, 400, 4000])
def test_a_spike_one_rounding_wide(triangles):
    surface = pf.lift(SPIKE, triangles=triangles)
    surface.check()
    assert surface.vertices[:5, :2].tolist() == [list(point) for point in SPIKE]
    pf.unwrap(SPIKE, triangles=triangles).check()
