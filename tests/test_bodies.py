"""The generator of patches itself: closed meshes, exact cusps, and levels that obey the rules."""

from itertools import islice

import numpy as np
import pytest

import bodies
from bodies import KINDS, levels_beside, patches
from reference.crossings import DegenerateError, turning_number
from reference.outline_drawings import drawing, places_on_borders
from reference.outline_gluings import pieces, surfaces
from reference.outline_levels import agrees, level_solutions
from reference.outlines import outline_map
from reference.triangles import meeting_pairs


def some(seed, count, kinds=tuple(KINDS)):
    return list(islice(patches(seed, kinds), count))


@pytest.mark.parametrize("kind", KINDS)
def test_bodies_are_closed_and_run_counter_clockwise_seen_from_outside(kind):
    rng = np.random.default_rng(1)
    for _ in range(10):
        vertices, faces = bodies.seen(rng, kind)
        start, end, _ = bodies.sides_of(faces)
        assert len(bodies.boundary_sides(start, end)) == 0
        assert len(np.unique(start * len(vertices) + end)) == len(start)
        a, b, c = vertices[faces].swapaxes(0, 1)
        assert bodies.volume(np.zeros(3, dtype=int), a, b, c).sum() > 0


@pytest.mark.parametrize("kind", KINDS)
def test_turning_numbers_less_cusps_are_the_euler_characteristic(kind):
    for patch in some(2, 60, (kind,)):
        turns = sum(turning_number(loop.tolist()) for loop in patch.outline)
        cusps = np.concatenate(patch.cusps)
        assert turns - cusps.sum() == patch.chi
        assert cusps.min() >= 0
        assert [len(cusp) for cusp in patch.cusps] == list(map(len, patch.loops))


def test_patches_are_of_all_sorts():
    found = some(3, 150)
    several = [patch for patch in found if len(patch.loops) > 1]
    handles = [patch for patch in found if 2 - len(patch.loops) - patch.chi > 0]
    cusped = [patch for patch in found if any(cusps.any() for cusps in patch.cusps)]
    assert {patch.kind for patch in found} == set(KINDS)
    assert min(map(len, (several, handles, [patch for patch in found if patch.cuts_itself]))) > 15
    assert len(cusped) > 120
    assert {1, 2, 3} <= {index for patch in found for cusps in patch.cusps for index in cusps.tolist()}
    again = some(3, 150)
    assert all((one.vertices == other.vertices).all() for one, other in zip(found, again, strict=True))


def test_angles_add_up():
    """Floating point says the same of the angles at the boundary."""
    for patch in some(4, 40):
        a, b, c = (np.roll(patch.vertices[patch.faces, :2], -i, axis=1).astype(float) for i in range(3))
        sweep = np.angle(((c - a) @ [1, 1j]) / ((b - a) @ [1, 1j]))
        angle = np.bincount(patch.faces.ravel(), sweep.ravel())
        for loop, cusps in zip(patch.loops, patch.cusps, strict=True):
            assert (np.ceil(angle[loop] / (2 * np.pi)) - 1).tolist() == cusps.tolist()
        inner = np.setdiff1d(np.arange(len(patch.vertices)), np.concatenate(patch.loops))
        assert np.allclose(angle[inner], 2 * np.pi)


def test_patches_that_cut_themselves_are_found():
    small = [patch for patch in some(5, 40) if len(patch.faces) < 300]
    for patch in small:
        assert bool(meeting_pairs(patch.vertices, patch.faces)) == patch.cuts_itself
    assert {patch.cuts_itself for patch in small} == {True, False}


def test_levels_obey_the_rules_where_a_patch_does_not_cut_itself():
    """At crossings, cusps and feet; and the surface over the outline is found, with its Euler characteristic."""
    compared = counted = 0
    for patch in some(6, 120):
        if len(patch.faces) > 120 or not any(cusps.any() for cusps in patch.cusps):
            continue
        loops = [loop.tolist() for loop in patch.outline]
        try:
            found = drawing(loops, [cusps.tolist() for cusps in patch.cusps])
        except DegenerateError:
            continue
        first = np.cumsum([0, *map(len, loops)])
        places = places_on_borders(found)
        edges = np.array([first[place.loop] + place.edge for place in places])
        ends = np.concatenate([np.stack([loop, np.roll(loop, -1, axis=0)], axis=1) for loop in patch.outline])[edges]
        along = np.array([[float(place.along)] for place in places])
        level, winding = levels_beside(patch, edges, (1 - along) * ends[:, 0] + along * ends[:, 1])
        planar = outline_map(found.code)
        assert winding.tolist() == [planar.winding[planar.left(border)] for border in range(planar.n_borders)]
        if patch.cuts_itself:
            continue
        own = dict(enumerate(level.tolist()))
        assert all(agrees(planar, vertex, own) for vertex in range(len(planar.around)))
        compared += 1
        if max(planar.winding) < 4:
            assert tuple(level.tolist()) in level_solutions(found.code)
            assert any(sum(chi for _, chi in pieces(found.code, *one)) == patch.chi for one in surfaces(found.code))
            counted += 1
    assert compared > 30
    assert counted > 20
