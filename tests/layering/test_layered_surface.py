"""Surfaces with several boundary curves, holes and handles: known shapes, and brute force over levels."""

from itertools import product

import numpy as np
import pytest

import plyfold as pf
from coarse import CURVES
from plyfold.arrangement.arrangement import arrange
from plyfold.clock import Clock
from plyfold.errors import GeneralPositionError, InputError
from plyfold.layering.embedding import count_embeddings, embeddings, find_embedding
from plyfold.layering.levels.clauses import LevelClauses, solve_levels
from plyfold.layering.levels.equations import level_equations
from plyfold.layering.levels.layered_surface import (
    LayeredSurface,
    count_layered_surfaces,
    find_layered_surface,
    layered_surfaces,
)
from plyfold.obstruction import Unknown
from plyfold.outline.curve import Curve
from reference import random_curves
from reference.crossings import DegenerateError
from reference.loops import level_solutions, loop_borders


def rectangle(left, bottom, right, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def shapes(surface):
    return [(piece.loops, piece.euler_characteristic, piece.genus) for piece in surface.pieces]


def levels(curves):
    return {tuple(surface.level.tolist()) for surface in layered_surfaces(curves)}


OUTER = rectangle(0, 0, 9, 9)
HOLE = rectangle(1, 2, 3, 4)[::-1]
OTHER_HOLE = rectangle(5, 3, 8, 5)[::-1]

# A base with two bands whose feet alternate; one of them passes over or under the other.
TORUS_WITH_A_HOLE = [
    (0, 0), (7, 0), (7, 5), (2, 5), (2, 1), (1, 1), (1, 2), (4, 2),
    (4, 1), (3, 1), (3, 4), (6, 4), (6, 1), (5, 1), (5, 3), (0, 3),
]  # fmt: skip


# Curves that all cross something: over and under determine every level.
CASED = [
    [TORUS_WITH_A_HOLE],
    [rectangle(0, 0, 4, 4), rectangle(2, 1, 6, 3)],
    [rectangle(0, 0, 4, 4), rectangle(2, 1, 6, 3), rectangle(3, -1, 5, 2)],
]


def test_annulus():
    assert shapes(find_layered_surface([OUTER, HOLE])) == [((0, 1), 0, 0)]
    assert count_layered_surfaces([OUTER, HOLE]) == 1


def test_disk_with_two_holes():
    surface = find_layered_surface([HOLE, OUTER, OTHER_HOLE])
    assert surface.level.tolist() == [1, 1, 1]
    assert shapes(surface) == [((0, 1, 2), -1, 0)]


def test_torus_with_a_hole():
    found = list(layered_surfaces([TORUS_WITH_A_HOLE]))
    assert [shapes(surface) for surface in found] == [[((0,), -1, 1)]] * 2
    assert find_layered_surface([TORUS_WITH_A_HOLE]).euler_characteristic == -1
    assert not find_embedding(TORUS_WITH_A_HOLE)


def test_torus_with_two_holes():
    surface = find_layered_surface([rectangle(0.25, 0.25, 0.75, 0.75)[::-1], TORUS_WITH_A_HOLE])
    assert shapes(surface) == [((0, 1), -2, 1)]


def test_two_rings_linked_or_apart():
    """Two flat rings that cross in four squares, each with either ring above: the rings stay two pieces."""
    rings = [
        rectangle(0, 0, 6, 6),
        rectangle(1, 1, 5, 5)[::-1],
        rectangle(3, 2, 9, 4),
        rectangle(3.5, 2.5, 8, 3.5)[::-1],
    ]
    found = list(layered_surfaces(rings))
    assert len(found) == 2**2
    assert all(shapes(surface) == [((0, 1), 0, 0), ((2, 3), 0, 0)] for surface in found)


def test_disk_upon_a_disk_and_a_hole_in_either():
    """The hole in a stack of two disks is one of the lower or one of the upper disk."""
    stack = [rectangle(0, 0, 9, 9), rectangle(1, 1, 8, 8), rectangle(2, 2, 3, 3)[::-1]]
    found = list(layered_surfaces(stack))
    assert count_layered_surfaces(stack) == len(found) == 4
    assert {surface.pieces[0].loops for surface in found} == {(0,), (0, 2)}
    assert all(len(surface.pieces) == 2 for surface in found)


@pytest.mark.parametrize("polygon", [random_curves.MILNOR_LIKE, random_curves.TEN_GON, random_curves.BENNEQUIN_LIKE])
def test_one_curve_in_a_list_has_its_embeddings(polygon):
    expected = {tuple(layering.border_level.tolist()) for layering in embeddings(polygon)}
    assert levels([polygon]) == expected
    assert count_layered_surfaces([polygon]) == len(expected)


def random_families(count):
    """Disks on each other, with some holes; all winding numbers are brought to be positive by a large disk below."""
    rng = np.random.default_rng(12)
    for _ in range(count):
        disks = [random_curves.glued_disk(rng, int(rng.integers(1, 7)), 30) for _ in range(int(rng.integers(1, 3)))]
        triangle = np.array([(0, 0), (40, 3), (7, 30)]) + rng.integers(-20, 20, 2)
        yield [*disks, triangle[::-1].tolist(), rectangle(-500, -501, 502, 503)]


def test_random_families_against_brute_force():
    compared = solved = 0
    for curves in random_families(40):
        try:
            borders = loop_borders(curves)
        except DegenerateError:
            with pytest.raises(GeneralPositionError):
                find_layered_surface(curves)
            continue
        if np.prod([float(w) for w in borders.left_winding]) > 1e9:
            continue
        expected = set(level_solutions(borders))
        assert levels(curves) == expected
        assert count_layered_surfaces(curves) == len(expected)
        found = find_layered_surface(curves)
        assert bool(found) == bool(expected)
        compared, solved = compared + 1, solved + bool(expected)
    assert compared >= 15
    assert solved >= 5


def test_pieces_are_surfaces():
    """Every curve bounds one piece, and no number of handles is negative or half a number."""
    for curves in random_families(40):
        try:
            surface = find_layered_surface(curves)
        except GeneralPositionError:
            continue
        if surface:
            assert sorted(loop for piece in surface.pieces for loop in piece.loops) == list(range(len(curves)))
            assert sum(piece.euler_characteristic for piece in surface.pieces) == surface.euler_characteristic
            for piece in surface.pieces:
                assert 2 - 2 * piece.genus - len(piece.loops) == piece.euler_characteristic
                assert piece.genus >= 0


def test_no_surface_says_where():
    obstruction = find_layered_surface([OUTER, rectangle(20, 2, 21, 3)[::-1]])
    assert (obstruction.reason, obstruction.value) == ("negative winding", -1)
    assert obstruction.where[0] in rectangle(20, 2, 21, 3)
    eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
    assert find_layered_surface([eight]).where == ((1, 1),)
    assert count_layered_surfaces([eight]) == 0
    assert list(layered_surfaces([eight])) == []


def test_a_loop_that_winds_twice_bounds_nothing_alone():
    """Pascal's limaçon: all winding numbers are right, but past the crossing both strands would be on one sheet."""
    limacon = CURVES["limacon"].curve
    obstruction = find_layered_surface([limacon])
    assert (obstruction.reason, obstruction.value) == ("no embedding", (0,))
    assert np.allclose(obstruction.where, arrange(limacon).crossings)
    assert count_layered_surfaces([limacon]) == 0


def test_lists_of_curves_are_told_from_lists_of_points():
    for curves in ([OUTER, HOLE], (Curve(OUTER), HOLE), [np.array(OUTER), np.array(HOLE)], np.array([OUTER, HOLE])):
        assert isinstance(find_embedding(curves), LayeredSurface)
        assert count_embeddings(curves) == len(list(embeddings(curves))) == 1
    assert not isinstance(find_embedding(OUTER), LayeredSurface)
    assert not isinstance(find_embedding([tuple(point) for point in OUTER]), LayeredSurface)
    with pytest.raises(InputError, match="no curve"):
        find_layered_surface([])


def test_time_is_limited():
    many = [rectangle(3 * i, 2 * i, 3 * i + 60, 2 * i + 51) for i in range(15)]
    assert isinstance(count_layered_surfaces(many, time_limit=0), Unknown)
    assert find_layered_surface(many, time_limit=60)
    assert solve_levels(LevelClauses(level_equations(arrange(OUTER))), Clock(None)).tolist() == [1]


@pytest.mark.parametrize("curves", CASED)
def test_cased_curves_give_exactly_the_surfaces_with_that_casing(curves):
    """Among all casings, one by one, those that lift are those of the surfaces, and give them back."""
    surfaces = {tuple(surface.casing[surface.loops.first]): surface for surface in layered_surfaces(curves)}
    loops = next(iter(surfaces.values())).loops
    k = len(loops.first)
    lifted = 0
    for choice in product([False, True], repeat=k):
        over = np.empty(2 * k, dtype=bool)
        over[loops.first], over[loops.second] = choice, np.logical_not(choice)
        found = pf.embed_cased(curves, over)
        assert bool(found) == (choice in surfaces)
        if found:
            lifted += 1
            assert found.level.tolist() == surfaces[choice].level.tolist()
            assert found.casing.tolist() == over.tolist()
        else:
            assert found.value
            assert set(found.value) <= set(range(k))
    assert lifted == len(surfaces)


def test_casings_of_several_curves_are_checked():
    with pytest.raises(InputError, match="truth values"):
        pf.embed_cased(CASED[0], [True])
