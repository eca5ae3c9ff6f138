"""Outlines of any kind: several loops, holes, handles. Known shapes, and brute force over levels."""

from itertools import product

import numpy as np
import pytest

import plyfold as pf
from nightly.lists import levels as levels_of
from plyfold.arrangement.arrangement import arrange
from plyfold.clock import Clock
from plyfold.errors import GeneralPositionError, InputError
from plyfold.gallery import CURVES
from plyfold.layering.embedding import count_embeddings, embeddings, find_embedding
from plyfold.layering.layering import Layering
from plyfold.layering.levels.equations import LevelClauses, level_equations, solve_levels
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
    return {levels_of(surface) for surface in embeddings(curves)}


OUTER = rectangle(0, 0, 9, 9)
HOLE = rectangle(1, 2, 3, 4)[::-1]
OTHER_HOLE = rectangle(5, 3, 8, 5)[::-1]

# A base with two bands whose feet alternate; one of them passes over or under the other.
TORUS_WITH_A_HOLE = [
    (0, 0), (7, 0), (7, 5), (2, 5), (2, 1), (1, 1), (1, 2), (4, 2),
    (4, 1), (3, 1), (3, 4), (6, 4), (6, 1), (5, 1), (5, 3), (0, 3),
]  # fmt: skip


# The same base with two pairs of bands, which makes two handles.
TWO_HANDLES = [(x, y) for x, y in TORUS_WITH_A_HOLE if (x, y) not in ((0, 0), (7, 0))]
TWO_HANDLES = [(-1, 0), (18, 0), *((x + 11, y) for x, y in TWO_HANDLES), *TWO_HANDLES, (-1, 3)]


# Curves that all cross something: over and under determine every level.
CASED = [
    [TORUS_WITH_A_HOLE],
    [rectangle(0, 0, 4, 4), rectangle(2, 1, 6, 3)],
    [rectangle(0, 0, 4, 4), rectangle(2, 1, 6, 3), rectangle(3, -1, 5, 2)],
]


def test_annulus():
    assert shapes(find_embedding([OUTER, HOLE])) == [((0, 1), 0, 0)]
    assert count_embeddings([OUTER, HOLE]) == 1


def test_disk_with_two_holes():
    surface = find_embedding([HOLE, OUTER, OTHER_HOLE])
    assert set(surface.border_level.tolist()) == {1}
    assert shapes(surface) == [((0, 1, 2), -1, 0)]


def test_torus_with_a_hole():
    found = list(embeddings([TORUS_WITH_A_HOLE]))
    assert [shapes(surface) for surface in found] == [[((0,), -1, 1)]] * 2
    assert find_embedding([TORUS_WITH_A_HOLE]).euler_characteristic == -1
    alone = list(embeddings(TORUS_WITH_A_HOLE))
    assert [surface.border_level.tolist() for surface in alone] == [s.border_level.tolist() for s in found]
    assert find_embedding(TORUS_WITH_A_HOLE).genus == 1
    assert not pf.bounds_disk(TORUS_WITH_A_HOLE)


def test_torus_with_two_holes():
    surface = find_embedding([rectangle(0.25, 0.25, 0.75, 0.75)[::-1], TORUS_WITH_A_HOLE])
    assert shapes(surface) == [((0, 1), -2, 1)]


def test_two_rings_linked_or_apart():
    """Two flat rings that cross in four squares, each with either ring above: the rings stay two pieces."""
    rings = [
        rectangle(0, 0, 6, 6),
        rectangle(1, 1, 5, 5)[::-1],
        rectangle(3, 2, 9, 4),
        rectangle(3.5, 2.5, 8, 3.5)[::-1],
    ]
    found = list(embeddings(rings))
    assert len(found) == 2**2
    assert all(shapes(surface) == [((0, 1), 0, 0), ((2, 3), 0, 0)] for surface in found)


def test_disk_upon_a_disk_and_a_hole_in_either():
    """The hole in a stack of two disks is one of the lower or one of the upper disk."""
    stack = [rectangle(0, 0, 9, 9), rectangle(1, 1, 8, 8), rectangle(2, 2, 3, 3)[::-1]]
    found = list(embeddings(stack))
    assert count_embeddings(stack) == len(found) == 4
    assert {surface.pieces[0].loops for surface in found} == {(0,), (0, 2)}
    assert {surface.genus for surface in found} == {0}
    assert all(len(surface.pieces) == 2 for surface in found)


@pytest.mark.parametrize("polygon", [random_curves.MILNOR_LIKE, random_curves.TEN_GON, random_curves.BENNEQUIN_LIKE])
def test_one_curve_in_a_list_has_its_embeddings(polygon):
    expected = {tuple(layering.border_level.tolist()) for layering in embeddings(polygon)}
    assert levels([polygon]) == expected
    assert count_embeddings([polygon]) == len(expected)


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
                arrange(curves, general_position="raise")
            continue
        if np.prod([float(w) for w in borders.left_winding]) > 1e9:
            continue
        expected = set(level_solutions(borders))
        assert levels(curves) == expected
        assert count_embeddings(curves) == len(expected)
        found = find_embedding(curves)
        assert bool(found) == bool(expected)
        compared, solved = compared + 1, solved + bool(expected)
    assert compared >= 15
    assert solved >= 5


def test_pieces_are_surfaces():
    """Every curve bounds one piece, and no number of handles is negative or half a number."""
    for curves in random_families(40):
        surface = find_embedding(curves)
        if surface:
            assert sorted(loop for piece in surface.pieces for loop in piece.loops) == list(range(len(curves)))
            assert bool(surface) is True
            assert surface.genus == sum(piece.genus for piece in surface.pieces)
            assert sum(piece.euler_characteristic for piece in surface.pieces) == surface.euler_characteristic
            for piece in surface.pieces:
                assert 2 - 2 * piece.genus - len(piece.loops) == piece.euler_characteristic
                assert piece.genus >= 0


def test_no_surface_says_where():
    obstruction = find_embedding([OUTER, rectangle(20, 2, 21, 3)[::-1]])
    assert (obstruction.reason, obstruction.value) == ("negative winding", -1)
    x, y = obstruction.where[0]
    assert 20 < x < 21
    assert 2 < y < 3
    eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
    assert find_embedding([eight, [(9, 0), (9, 2), (8, 2)]]).where == ()
    assert find_embedding([eight]).reason == find_embedding(eight).reason == "turning number"
    assert count_embeddings([eight]) == 0
    assert list(embeddings([eight])) == []


def test_a_loop_that_winds_twice_bounds_nothing_alone():
    """Pascal's limaçon: all winding numbers are right, but past the crossing both strands would be on one sheet."""
    limacon = CURVES["limacon"].curve
    for curve in (limacon, [limacon]):
        obstruction = find_embedding(curve)
        assert (obstruction.reason, obstruction.value) == ("turning number", 2)
        assert count_embeddings(curve) == 0
        assert list(embeddings(curve)) == []
        assert pf.embed_cased(curve, [True]).reason == "turning number"


def test_what_no_levels_fit_says_at_which_crossings():
    """A limaçon with a hole in a place that it covers once: as a number, the turning could be that of an annulus."""
    limacon = CURVES["limacon"].curve
    small = rectangle(-0.02, -0.01, 0.02, 0.02)[::-1]
    for cell in range(1, 3):
        x, y = arrange(limacon).cell_point(cell)
        hole = [(x + a, y + b) for a, b in small]
        second = [(x + a / 9, y + b / 9) for a, b in small]
        obstruction = find_embedding([limacon, hole, second])
        if obstruction.reason == "no embedding":
            assert obstruction.value == (0,)
            assert np.allclose(obstruction.where, arrange(limacon).crossings)
            assert count_embeddings([limacon, hole, second]) == 0


@pytest.mark.parametrize("turning", [-1, -3])
def test_turning_numbers_of_handles_are_no_obstruction(turning):
    """One loop with τ = 1 − 2g may bound a disk with g handles."""
    loop = TORUS_WITH_A_HOLE if turning == -1 else TWO_HANDLES
    assert arrange(loop).turning_number == turning
    assert not arrange(loop).reversed
    surface = find_embedding(loop)
    assert shapes(surface) == [((0,), turning, (1 - turning) // 2)]
    assert pf.find_immersion(loop).genus == surface.genus
    assert find_embedding(loop[::-1]).immersion.arrangement.reversed
    assert count_embeddings(loop[::-1]) == count_embeddings([loop]) == len(list(embeddings(loop)))


def test_lists_of_curves_are_told_from_lists_of_points():
    for curves in ([OUTER, HOLE], (Curve(OUTER), HOLE), [np.array(OUTER), np.array(HOLE)], np.array([OUTER, HOLE])):
        assert isinstance(find_embedding(curves), Layering)
        assert find_embedding(curves).immersion.arrangement.n_loops == 2
        assert count_embeddings(curves) == len(list(embeddings(curves))) == 1
    assert find_embedding(OUTER).immersion.arrangement.n_loops == 1
    assert find_embedding([tuple(point) for point in OUTER]).immersion.arrangement.n_loops == 1
    with pytest.raises(InputError):
        find_embedding([])


def test_time_is_limited():
    many = [rectangle(3 * i, 2 * i, 3 * i + 60, 2 * i + 51) for i in range(15)]
    assert isinstance(count_embeddings(many, time_limit=0), Unknown)
    assert find_embedding(many, time_limit=60)
    assert solve_levels(LevelClauses(level_equations(arrange(OUTER))), Clock(None)).tolist() == [1]


@pytest.mark.parametrize("curves", CASED)
def test_cased_curves_give_exactly_the_surfaces_with_that_casing(curves):
    """Among all casings, one by one, those that lift are those of the surfaces, and give them back."""
    surfaces = {tuple(surface.casing.tolist()): surface for surface in embeddings(curves)}
    arranged = arrange(curves)
    k, first = arranged.n_crossings, np.arange(2 * arranged.n_crossings) < arranged.partner
    lifted = 0
    for choice in product([False, True], repeat=k):
        over = np.array(choice)[arranged.crossing_of_visit] == first
        found = pf.embed_cased(curves, over)
        assert bool(found) == (tuple(over.tolist()) in surfaces)
        if found:
            lifted += 1
            assert found.border_level.tolist() == surfaces[tuple(over.tolist())].border_level.tolist()
            assert found.casing.tolist() == over.tolist()
        elif len(curves) == 1:
            assert (found.reason, found.value in range(k)) == ("casing", True)
        else:
            assert found.value
            assert set(found.value) <= set(range(k))
    assert lifted == len(surfaces)


def test_casings_of_several_curves_are_checked():
    with pytest.raises(InputError, match="truth values"):
        pf.embed_cased(CASED[0], [True])


# A disk with a handle: its turning number is −1, and no winding number is negative.
HANDLE = [
    (0, 0), (8, 0), (8, 2), (7.5, 2), (7.5, 10), (2.5, 10), (2.5, 2), (1.5, 2), (1.5, 6), (4.5, 6),
    (4.5, 2), (3.5, 2), (3.5, 9), (6.5, 9), (6.5, 2), (5.5, 2), (5.5, 7), (0.5, 7), (0.5, 2), (0, 2),
]  # fmt: skip


def test_one_loop_and_a_list_of_it_agree_on_a_handle():
    drawn = arrange(HANDLE)
    assert (drawn.turning_number, drawn.reversed, int(drawn.winding.min())) == (-1, False, 0)
    alone, listed = find_embedding(HANDLE), find_embedding([HANDLE])
    assert alone.border_level.tolist() == listed.border_level.tolist()
    assert (alone.genus, alone.euler_characteristic, len(alone.pieces)) == (1, -1, 1)
    assert count_embeddings(HANDLE) == count_embeddings([HANDLE]) == len(list(embeddings(HANDLE))) > 0
    assert pf.embed_cased(HANDLE, alone.casing).border_level.tolist() == alone.border_level.tolist()
    assert pf.find_immersion(HANDLE).euler_characteristic == -1
    assert not pf.bounds_disk([HANDLE])


def test_what_is_found_can_be_layered_again():
    """The immersion of an embedding is one like any other: its layerings are those of the outline that lie over it."""
    for curves in (HANDLE, [OUTER, HOLE], [rectangle(0, 0, 9, 9), rectangle(1, 1, 8, 8), rectangle(2, 2, 3, 3)[::-1]]):
        found = find_embedding(curves)
        again = {levels_of(layering) for layering in pf.layerings(found.immersion)}
        assert levels_of(found) in again <= levels(curves)
        assert pf.count_layerings(found.immersion) == len(again)
        assert pf.find_layering(found.immersion)
        assert pf.nicest_layering(found.immersion).changes <= found.changes


def test_the_disk_layout_is_there_for_disks_alone():
    for surface in (find_embedding(HANDLE), find_embedding([OUTER, HOLE])):
        with pytest.raises(InputError, match="disks alone"):
            surface.immersion.disk_layout()
        assert surface.immersion._repr_svg_() is None


# ---- loops that lie in others without crossing them ----------------------------------------------------------------

BIG = [(0, 0), (90, 0), (0, 90)]
SMALL = [(5, 5), (25, 5), (5, 25)]
# Two triangles that cross each other lie in a large one; the order of all three is free.
INSIDE = [BIG, SMALL, [(10, 10), (30, 10), (10, 30)]]
# The drawing hangs together, but one triangle crosses the large one only by way of the other.
HANGING_TOGETHER = [BIG, SMALL, [(10, 10), (200, 10), (10, 30)]]
# Nothing crosses anything.
NESTED = [BIG, SMALL, [(6, 6), (9, 6), (6, 9)]]


def levels_by_casing(curves):
    """All levels that the reference finds, by over and under at the crossings."""
    borders = loop_borders(curves)
    found = {}
    for level in level_solutions(borders):
        over = {}
        for a_top, a_past, b_top, _ in borders.crossings:
            over[a_past] = level[a_top] > level[b_top]
            over[b_top] = not over[a_past]
        found.setdefault(tuple(over[visit] for visit in range(len(over))), set()).add(level)
    return found


@pytest.mark.parametrize(("curves", "expected"), [(INSIDE, 6), (HANGING_TOGETHER, 6), (NESTED, 6)])
def test_every_surface_is_listed_once(curves, expected):
    listed = [levels_of(surface) for surface in embeddings(curves)]
    assert len(listed) == len(set(listed)) == count_embeddings(curves) == expected
    assert set(listed) == set().union(*levels_by_casing(curves).values())
    assert levels_of(find_embedding(curves)) in listed


@pytest.mark.parametrize(("curves", "refused"), [(INSIDE, 2), (HANGING_TOGETHER, 2), (NESTED, 1)])
def test_a_casing_of_several_surfaces_is_refused(curves, refused):
    """Of those with one surface each, that is the answer."""
    by_casing = levels_by_casing(curves)
    for over, expected in by_casing.items():
        assert {levels_of(surface) for surface in embeddings(curves, over)} == expected
        if len(expected) == 1:
            assert levels_of(pf.embed_cased(curves, over)) in expected
            continue
        with pytest.raises(InputError, match="several surfaces") as caught:
            pf.embed_cased(curves, over)
        assert set(caught.value.where) <= {curve[0] for curve in curves}
    assert sum(len(expected) > 1 for expected in by_casing.values()) == refused


def test_the_curve_that_is_not_determined_is_named():
    with pytest.raises(InputError, match="level of curve 1, at \\(5, 5\\)\n  hint: embeddings"):
        pf.embed_cased([BIG, SMALL], over=[])


def test_embeddings_of_one_curve_with_a_casing():
    ramp = CURVES["exit-ramp"].curve
    for layering in embeddings(ramp):
        (same,) = embeddings(ramp, layering.casing)
        assert same.border_level.tolist() == layering.border_level.tolist()
