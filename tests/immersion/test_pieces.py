"""The pieces that an immersion states are those of its triangles and of the lifted mesh, counted by the definition."""

from itertools import product

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings

import plyfold as pf
from plyfold.errors import CurveError
from plyfold.graphs import components
from plyfold.halfedges import ends_of
from plyfold.immersion.immersion import Piece
from plyfold.mesh.refine import is_moved
from reference.contacts import random_touching, random_touching_loops, random_touching_with_cusps
from reference.pieces import kinds_of_triangles
from touching import grown_outlines, rectangles, touching_outlines

DISK = (1, 1)
BOW = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
NECK = [(0, 0), (1, 0), (1, 1), (3, 1), (3, 0), (4, 0), (4, 1), (3, 1), (1, 1), (0, 1)]
KEYHOLE = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]
# Two holes that touch each other, one of which touches the rim.
HOLES = [[(0, 0), (6, 0), (6, 6), (0, 6)], [(1, 1), (1, 5), (3, 3)], [(3, 3), (5, 5), (6, 3), (5, 1)]]
TWO_HOLES = [HOLES[0], HOLES[1], [(3, 3), (5, 5), (5, 1)]]
NOTHING = [[(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 0), (0, 1), (1, 1), (1, 0)]]


def kinds(surface):
    return sorted((len(piece.loops), piece.euler_characteristic) for piece in surface.pieces)


def judge(outline, lift=True):
    """Compare some immersions with their triangles, and one with a lifted mesh; return what the pieces are, if any."""
    drawn = pf.arrange(outline)
    if not len(drawn.contacts):
        return None
    found = [immersion for immersion, _ in zip(pf.immersions(drawn), range(4), strict=False)]
    for immersion in found:
        stated = kinds(immersion)
        assert stated == kinds_of_triangles(pf.triangulate(drawn, immersion).tolist())
        assert immersion.euler_characteristic == sum(euler for _, euler in stated)
        assert 2 * immersion.genus == sum(2 - loops - euler for loops, euler in stated)
        assert_same_uncut(immersion)
    if found and lift and kinds(found[0]) and (layering := pf.find_layering(found[0])):
        judge_lifted(layering)
    return kinds(found[0]) if found else None


def assert_same_uncut(immersion):
    assert (
        sum(piece.euler_characteristic for piece in immersion.uncut_pieces)
        == immersion.arrangement.euler_characteristic
    )
    if not immersion.touches:
        assert immersion.pieces == immersion.uncut_pieces


def judge_lifted(layering):
    """The loops of each piece have the same numbers, too."""
    surface = pf.lift(layering, triangles=20)
    assert kinds(layering) == kinds_of_triangles(surface.faces.tolist())
    piece = components(len(surface.vertices), *ends_of(surface.faces))
    piece_of_loop = piece[surface.boundary[surface.first_boundary[:-1]]].tolist()
    loops = {number: [] for number in piece_of_loop}
    for loop, number in enumerate(piece_of_loop):
        loops[number].append(loop)
    assert list(loops.values()) == [list(piece.loops) for piece in layering.pieces]


@pytest.mark.parametrize(
    ("outline", "expected"),
    [
        (BOW, [DISK, DISK]),
        (NECK, [DISK, DISK]),
        (KEYHOLE, [DISK]),
        (HOLES, [DISK]),
        (TWO_HOLES, [(2, 0)]),
        (NOTHING, []),
    ],
)
def test_known_outlines(outline, expected):
    assert judge(outline) == expected


def test_before_the_cuts():
    immersion = pf.find_immersion(BOW)
    assert immersion.uncut_pieces == (Piece((0,), 1),)
    assert immersion.pieces == (Piece((0,), 1), Piece((1,), 1))
    assert (immersion.is_disk, immersion.euler_characteristic, immersion.genus) == (True, 2, 0)
    layering = pf.find_layering(immersion)
    assert (layering.pieces, layering.euler_characteristic, layering.genus) == (immersion.pieces, 2, 0)


def polygons(width, height, n):
    """All polygons of n points on a grid, each from its lowest start, without repeated points side by side."""
    for numbers in product(range(width * height), repeat=n):
        starts = (numbers[i:] + numbers[:i] for i in range(n))
        if numbers == min(starts) and all(a != b for a, b in zip(numbers, numbers[1:] + numbers[:1], strict=True)):
            yield [divmod(number, height) for number in numbers]


def judge_all(outlines, lift=True):
    """Judge those that are outlines; return what the pieces of each are."""
    found = []
    for outline in outlines:
        try:
            found.append(judge(outline, lift))
        except CurveError:  # nothing is left without spikes
            continue
    return found


def test_all_polygons_on_a_small_grid():
    assert [DISK, DISK] in judge_all(polygons(3, 2, 6), lift=False)


@pytest.mark.slow
@pytest.mark.parametrize(("width", "height", "n"), [(3, 3, 5), (3, 2, 6), (3, 3, 6), (3, 2, 7)])
def test_all_polygons_on_larger_grids(width, height, n):
    assert [DISK, DISK] in judge_all(polygons(width, height, n))


def test_random_polygons_loops_and_cusps():
    found = []
    for seed in range(60):
        rng = np.random.default_rng(seed)
        polygon, cusps = random_touching_with_cusps(rng, 1)
        outlines = [[random_touching(rng)], random_touching_loops(rng), pf.Outline([polygon], [cusps])]
        found += judge_all(outlines, lift=seed % 4 == 0)
    assert {1, 2, 3} <= {len(pieces) for pieces in found if pieces}


# Most touch nowhere, and another seed may bring many of these first.
@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(grown_outlines())
def test_grown_disks(points):
    assume(is_moved(pf.arrange(points)))
    found = judge(points)
    assume(found is not None)
    assert set(found) == {DISK}


@settings(max_examples=30, deadline=None)
@given(rectangles(4))
def test_rectangles(outline):
    judge(outline)


@settings(max_examples=40, deadline=None)
@given(touching_outlines())
def test_any_outline(outline):
    judge_all([outline])
