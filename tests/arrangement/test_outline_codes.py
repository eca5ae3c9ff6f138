"""Arrangements of outlines with cusps and bridges are codes of planar maps, and bound as many surfaces as in fractions.

Bridges lie elsewhere there, so the numbers of sheets, cells and borders differ, and those of surfaces must not.
"""

from itertools import islice

import numpy as np
import pytest

import plyfold as pf
from bodies import patches
from codes import code_of
from reference.crossings import DegenerateError
from reference.outline_drawings import outline_code
from reference.outline_gluings import surfaces
from reference.outline_levels import level_solutions
from reference.outlines import outline_map
from reference.random_curves import FRAME, small_loops


def assert_same_surfaces(loops, cusps, most=4):
    """The map is planar, its cells have the windings of the arrangement; numbers of surfaces and levels agree."""
    arranged = pf.arrange(pf.Outline(loops, cusps), general_position="raise")
    assert not arranged.reversed
    arranged.check()
    ours, theirs = code_of(arranged), outline_code(loops, cusps)
    planar = outline_map(ours)
    assert (planar.before, planar.after) == (tuple(arranged.border_before), tuple(arranged.border_after))
    borders = range(planar.n_borders)
    assert [planar.winding[planar.left(b)] for b in borders] == arranged.winding[arranged.left_cell].tolist()
    assert [planar.winding[planar.right(b)] for b in borders] == arranged.winding[arranged.right_cell].tolist()
    assert sorted(planar.winding) == sorted(outline_map(theirs).winding) == sorted(arranged.winding.tolist())
    if max(planar.winding) > most:
        return None
    assert len(surfaces(ours)) == len(surfaces(theirs))
    assert len(level_solutions(ours)) == len(level_solutions(theirs))
    return len(surfaces(ours))


def random_outlines(seed):
    """Loops and cusps: small ones on a frame, many of which lie inside others."""
    rng = np.random.default_rng(seed)
    while True:
        loops = [FRAME, *small_loops(rng, 5)]
        rng.shuffle(loops)
        cusps = [(rng.random(len(loop)) < 0.08).astype(int).tolist() for loop in loops]
        yield loops, cusps


def test_random_outlines():
    found = bound = cusped = 0
    for loops, cusps in islice(random_outlines(1), 200):
        try:
            in_fractions = outline_map(outline_code(loops, cusps))
        except DegenerateError:
            continue
        if min(in_fractions.winding) >= 0:
            count = assert_same_surfaces(loops, cusps, most=3)
            found += 1
            bound += bool(count)
            cusped += bool(count) and any(map(sum, cusps))
    assert found > 30
    assert bound > 10
    assert cusped > 1


@pytest.mark.parametrize(
    ("kind", "count", "size", "least"), [("tube", 60, 130, 10), ("ball", 60, 130, 20), ("banded", 25, 250, 8)]
)
def test_patches_of_bodies(kind, count, size, least):
    """All of them bound a surface, with their cusps; those with bands have handles and holes."""
    found = 0
    for patch in islice(patches(31, (kind,)), count):
        if len(patch.faces) < size:
            counted = assert_same_surfaces([loop.tolist() for loop in patch.outline], [c.tolist() for c in patch.cusps])
            assert counted is None or counted > 0
            found += counted is not None
    assert found >= least


def test_large_patches_have_planar_maps():
    for patch in islice(patches(32, ("banded", "tube")), 30):
        arranged = pf.arrange(pf.Outline(patch.outline, patch.cusps))
        assert sorted(outline_map(code_of(arranged)).winding) == sorted(arranged.winding.tolist())
        assert arranged.winding.min() >= 0
        assert arranged.euler_characteristic == patch.chi
