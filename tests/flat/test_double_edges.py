"""Triangulations in which several edges join the same two cusps, round which the surface winds."""

import sys
from itertools import permutations

import numpy as np
import pytest
import shapely

import plyfold as pf
from plyfold.certify import check_immersed_surface, check_limit, check_pieces
from plyfold.errors import CertificateError, InputError
from plyfold.flat.sweep import sweep_triangles
from plyfold.flat.sweep_line import TILTS
from plyfold.mesh.sheets import twisted_bridges
from plyfold.surface.left import kinds_of
from reference.contacts import positions, random_rectangles_with_cusps

# Two triangles, each with a corner inside the other one: cut along the way from corner to corner and glued crosswise
# they are a ring. At the corner (0, 0) no other diagonal is possible.
RING = pf.Outline([[(0, 0), (2, -20), (2, 20)], [(1, 0), (-5, 20), (-5, -20)]], {(0, 0): 1, (1, 0): 1})
# The same with rectangles, each with the corner on an edge of the other.
TOUCHING = pf.Outline([[(1, 0), (5, 0), (5, 1), (1, 1)], [(0, 0), (3, 0), (3, 1), (0, 1)]], {(0, 3): 1, (1, 1): 1})
# A corner with a cusp where a bridge begins over which sheets change places.
AT_BRIDGES = [
    ([[(0, 0), (2, 0), (2, 2), (0, 2)], [(0, 1), (1, 2), (1, 1)], [(2, 2), (0, 2), (0, 0)]], {(1, 0): 1, (2, 0): 1}),
    (
        [[(0, 0), (2, 0), (2, 2), (0, 2)], [(2, 1), (1, 1), (0, 1), (0, 2)], [(0, 2), (0, 0), (2, 1)]],
        {(0, 3): 1, (1, 2): 1},
    ),
]


def everywhere(outline):
    """An outline in all positions of the page, each time with other starts and another order, some turned round."""
    for number, placed in enumerate(zip(*map(positions, outline.loops), strict=True)):
        loops = []
        for loop, cusps in zip(placed, outline.cusps, strict=True):
            start = number % len(loop)
            loops.append(pf.Curve(np.roll(loop, -start, axis=0), cusps=np.roll(cusps, -start)))
        changed = pf.Outline(list(permutations(loops))[number % len(loops)])
        yield changed.reversed() if number % 3 == 1 else changed


def certified(outline):
    """Check all triangles of an outline; return what its surfaces are, and whether edges joined the same cusps."""
    drawn = pf.arrange(outline)
    loops, cusps = list(drawn.given.loops), list(drawn.given.cusps)
    area = sum(cell.winding * cell.polygon.area for cell in pf.coverage(outline))
    found, double = [], False
    for immersion in pf.immersions(drawn):
        faces, twins = pf.triangulate(outline, immersion, twins=True)
        check_pieces(loops, outline.points, faces, cusps, twins=twins)
        check_limit(*pf.limit_of(immersion))
        check_pieces(loops, *pf.triangulate(outline, immersion, refine=0.3), cusps)
        assert sum(piece.area for piece in pf.decompose(outline, immersion)) == pytest.approx(abs(area))
        kinds = sorted((len(piece.loops), piece.euler_characteristic) for piece in immersion.pieces)
        found.append((kinds, len(immersion.touches), len(faces)))
        double |= bool(sweep_triangles(immersion).doubles)
    return sorted(found), double


def test_a_ring_has_two_edges_between_its_cusps():
    faces, twins = pf.triangulate(RING, twins=True)
    assert len(faces) == len(RING)
    check_immersed_surface(RING.loops, RING.points, faces, np.arange(6), RING.cusps, twins=twins)
    with pytest.raises(CertificateError, match="two triangles lie on the same side"):
        check_immersed_surface(RING.loops, RING.points, faces, np.arange(6), RING.cusps)
    (edges,) = sweep_triangles(pf.find_immersion(RING)).doubles
    crossed = twins.copy()
    one, other = edges.tolist()
    crossed[[one, twins[other]]], crossed[[other, twins[one]]] = twins[[other, one]], [other, one]
    crossed[[twins[one], twins[other]]] = [other, one]
    with pytest.raises(CertificateError):
        check_immersed_surface(RING.loops, RING.points, faces, np.arange(6), RING.cusps, twins=crossed)


def test_meshes_have_a_vertex_in_the_middle_of_one_of_them():
    points, faces = pf.triangulate(RING, refine=np.inf)
    assert points[6:].tolist() == [[0.5, 0]]
    check_immersed_surface(RING.loops, points, faces, np.arange(6), RING.cusps)
    with pytest.raises(InputError, match="leave out twins"):
        pf.triangulate(RING, refine=1.0, twins=True)


def test_polygons_are_glued_crosswise():
    """Both go on from one triangle to the other where these are cut, and only there."""
    pieces = pf.decompose(RING)
    assert len(pieces) == 2
    assert all(piece.is_valid and not piece.interiors for piece in pieces)
    assert sum(piece.area for piece in pieces) == 160
    assert not any(piece.within(shapely.Polygon(loop)) for piece in pieces for loop in RING.loops)


def test_the_same_answers_in_all_positions():
    found = [certified(changed) for changed in everywhere(TOUCHING)]
    assert all(answers == found[0][0] for answers, _ in found)
    assert {double for _, double in found} == {False, True}
    ((kinds, touches, _),) = found[0][0]
    assert (kinds, touches) == (sorted(kinds_of(pf.lift(TOUCHING))), 2)


@pytest.mark.parametrize("outline", [pf.Outline(*given) for given in AT_BRIDGES])
def test_cusps_at_bridges_in_contact(outline):
    found = [certified(changed)[0] for changed in list(everywhere(outline))[::3]]
    assert found == [found[0]] * 3
    assert len(found[0]) == 2


@pytest.mark.parametrize(("loops", "cusps"), AT_BRIDGES)
def test_cusps_at_bridges_whatever_the_tilt(loops, cusps, monkeypatch):
    """In general position: the moved outlines."""
    module, twisted = sys.modules["plyfold.flat.sweep"], 0
    for changed in everywhere(pf.Outline(loops, cusps)):
        moved = pf.arrange(changed).outline
        for immersion in pf.immersions(moved):
            twisted += len(twisted_bridges(immersion))
            for tilt in TILTS:
                monkeypatch.setattr(module, "TILTS", (tilt,))
                faces, twins = sweep_triangles(immersion)
                check_immersed_surface(
                    moved.loops, moved.points, faces, np.arange(len(moved)), moved.cusps, twins=twins
                )
    assert twisted


@pytest.mark.parametrize("seed", [*range(4), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(4, 200))])
def test_random_rectangles_with_cusps_in_contact(seed):
    outline = pf.Outline(*random_rectangles_with_cusps(np.random.default_rng(seed)))
    if pf.find_immersion(outline):
        found = [certified(changed)[0] for changed in list(everywhere(outline))[seed % 4 :: 4]]
        assert found == [found[0]] * 2
