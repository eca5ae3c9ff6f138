"""Each layering, lifted: by a test of all pairs of triangles that knows nothing of layers, no two of them meet."""

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from reference.random_curves import glued_disk
from reference.triangles import meeting_pairs

DISKS = [name for name, known in CURVES.items() if known.embeddable]


def assert_every_layering_lifts(curve, triangles, most):
    found = [layering for immersion in pf.immersions(curve) for layering in pf.layerings(immersion)]
    assert found
    for layering in found[:most]:
        surface = pf.lift(layering, triangles=triangles)
        assert meeting_pairs(surface.vertices, surface.faces) == []


@pytest.mark.parametrize("name", DISKS)
def test_curves_of_the_gallery(name):
    assert_every_layering_lifts(CURVES[name].curve, triangles=150, most=6)


@pytest.mark.parametrize("seed", range(6))
def test_dense_disks(seed):
    assert_every_layering_lifts(glued_disk(np.random.default_rng(seed), 12), triangles=100, most=8)


@pytest.mark.parametrize("shift", [0, 5])
def test_embeddings_of_bennequin(shift):
    """The six layerings over three of the five immersions, found straight from the curve."""
    curve = pf.Curve(np.roll(CURVES["bennequin"].curve.points, shift, axis=0))
    embeddings = list(pf.embeddings(curve))
    assert len(embeddings) == 6
    for layering in embeddings:
        surface = pf.lift(layering, triangles=100)
        assert meeting_pairs(surface.vertices, surface.faces) == []
