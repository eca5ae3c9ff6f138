"""Lifted surfaces and solids of outlines that touch themselves, on the given points."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings

import plyfold as pf
from plyfold.certify import check_boundary, check_layered, check_solid, check_surface
from plyfold.errors import CertificateError, GeneralPositionError, InputError
from plyfold.gallery import CURVES
from plyfold.mesh.refine import is_moved
from plyfold.surface.left import kinds_of, loops_of
from touching import grown_outlines, rectangles

TRIANGLES = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
KEYHOLE = [(0, 0), (6, 0), (6, 6), (0, 6), (0, 2), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2), (0, 2)]
NECK = [(0, 0), (2, 0), (2, 1), (4, 1), (4, 0), (6, 0), (6, 2), (4, 2), (4, 1), (2, 1), (2, 2), (0, 2)]
# A ribbon that passes over itself, all of whose crossings are at vertices.
RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (5, -3), (5, 0), (5, 5), (8, 5), (8, 1), (5, 1), (3, 1), (0, 1)]


@pytest.mark.parametrize(
    ("outline", "kinds", "layers"),
    [(TRIANGLES, [(1, 1)] * 2, 1), (KEYHOLE, [(1, 1)], 1), (NECK, [(1, 1)] * 2, 1), (RAMP, [(1, 1)], 2)],
)
def test_lifted_on_the_given_points(outline, kinds, layers):
    surface = pf.lift(outline, triangles=200)
    surface.check()
    solid = surface.thicken(surface.gap / 3)
    solid.check()
    assert kinds_of(surface) == kinds
    assert surface.n_layers == layers
    assert set(map(tuple, outline)) <= set(map(tuple, surface.vertices[:, :2].tolist()))


# Most touch nowhere, and another seed may bring many of these first.
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(grown_outlines())
def test_grown_disks(points):
    arrangement = pf.arrange(points)
    assume(is_moved(arrangement))
    assume(pf.find_embedding(arrangement))
    surface = pf.lift(arrangement, triangles=30)
    surface.check()
    surface.thicken(surface.gap / 3).check()
    assert all(kind == (1, 1) for kind in kinds_of(surface))


@settings(max_examples=25, deadline=None)
@given(rectangles())
def test_several_loops(outline):
    arrangement = pf.arrange(outline)
    assume(is_moved(arrangement))
    assume(pf.find_embedding(arrangement))
    surface = pf.lift(arrangement, triangles=30)
    surface.check()
    surface.thicken(surface.gap / 3).check()


@pytest.mark.parametrize(
    ("outline", "cusp", "loops"),
    [
        # A pinch goes through the cusp, and leaves none.
        ([(0, 1), (1, 0), (2, 1), (3, 3), (0, 2), (0, 0), (1, 0), (3, 3)], 1, 2),
        # The curl of a limaçon, with a corner on an edge.
        ([(0, 0), (8, 0), (8, 8), (0, 8), (0, 2), (4, 2), (4, 0), (6, 2), (6, 6), (2, 6), (2, 3)], 9, 1),
    ],
)
def test_cusps(outline, cusp, loops):
    marked = pf.Outline([outline], {(0, cusp): 1})
    surface = pf.lift(marked, triangles=100)
    surface.check()
    assert len(surface.first_boundary) == loops + 1
    assert sum(index.sum() for index in loops_of(surface)[1]) == (loops == 1)


def test_given_points_stay_in_every_loop():
    surface = pf.lift(NECK, triangles=100)
    assert [sorted(map(tuple, loop.tolist())) for loop in loops_of(surface)[0]] == [
        [(0, 0), (0, 2), (2, 0), (2, 1), (2, 2)],
        [(4, 0), (4, 1), (4, 2), (6, 0), (6, 2)],
    ]


def test_pieces_have_no_round_disk():
    surface = pf.lift(TRIANGLES, triangles=50)
    with pytest.raises(InputError, match="2 pieces"):
        surface.unwrap()
    with pytest.raises(InputError, match="2 pieces"):
        pf.map_disk(TRIANGLES)


def test_one_piece_is_unwound(tmp_path):
    surface = pf.lift(KEYHOLE, triangles=50)
    surface.unwrap().check()
    pf.unwrap(KEYHOLE, triangles=50).check()
    with pytest.raises(InputError, match="borders"):
        _ = surface.unwrap().border_start


@pytest.mark.parametrize("ending", ["glb", "obj", "ply", "stl", "3mf", "html"])
def test_pieces_are_exported(tmp_path, ending):
    surface = pf.lift(TRIANGLES, triangles=50)
    surface.export(tmp_path / f"pieces.{ending}")
    assert (tmp_path / f"pieces.{ending}").stat().st_size > 0


# Three edges through one point, each pair of triangles over each other beside it.
THREE = [[(-6, 0), (6, 0), (1, 5)], [(3, -6), (-3, 6), (-6, -1)], [(3, 6), (-3, -6), (5, -4)]]


def test_sheets_in_a_circle_round_one_point():
    apart = pf.Outline([[(x, y + 1e-3) for x, y in THREE[0]], *THREE[1:]])
    arrangement = replace(pf.arrange(apart, "raise"), given=pf.Outline(THREE))
    refused = [layering for layering in pf.layerings(pf.find_immersion(arrangement)) if not lifts(layering)]
    assert len(refused) == 2
    for layering in refused:
        with pytest.raises(GeneralPositionError, match="in a circle") as caught:
            pf.lift(layering, triangles=50)
        assert caught.value.where == ((0.0, 0.0),)


def lifts(layering):
    try:
        pf.lift(layering, triangles=50).check()
    except GeneralPositionError:
        return False
    return True


def test_a_surface_that_passes_through_itself_may_not_touch():
    curve = CURVES["smallest-unliftable"].curve
    drawn = pf.arrange(curve)
    moved = curve.points.copy()
    moved[0] = np.nextafter(moved[0], np.inf)
    immersions = pf.immersions(replace(drawn, given=pf.Curve(moved)))
    stuck = next(each for each in immersions if not pf.find_layering(each))
    with pytest.raises(InputError, match="does not touch itself") as caught:
        pf.lift(stuck, allow_intersections=True)
    assert caught.value.where == (tuple(moved[0].tolist()),)


# ---- the certificate -------------------------------------------------------------------------------------------------


def test_what_touches_must_be_allowed_to():
    surface = pf.lift(KEYHOLE, triangles=50)
    loops, _ = loops_of(surface)
    mesh = surface.vertices, surface.faces, surface.boundary
    check_surface(loops, *mesh, touching=True)
    with pytest.raises(CertificateError, match="less than 0 apart, or equal"):
        check_surface(loops, *mesh)
    solid = surface.thicken(0.1)
    check_solid(solid.vertices, solid.faces, 0.1, touching=True)
    with pytest.raises(CertificateError):
        check_solid(solid.vertices, solid.faces, 0.1)


def test_what_lies_over_each_other_may_not_touch():
    two = np.array([(x, y, z) for z in (0, 1) for x, y in [(0, 0), (1, 0), (0, 1)]], dtype=float)
    faces = [[0, 1, 2], [3, 4, 5]]
    check_layered(two, faces, 1.0, touching=True)
    two[3, 2] = 0.0
    with pytest.raises(CertificateError, match="or equal"):
        check_layered(two, faces, touching=True)
    two[3, 2] = 0.5
    with pytest.raises(CertificateError, match="less than 1 apart"):
        check_layered(two, faces, 1.0, touching=True)


def test_tops_of_touching_solids_belong_to_their_triangles():
    surface = pf.lift(TRIANGLES, triangles=2)
    solid = surface.thicken(0.5)
    check_solid(solid.vertices, solid.faces, 0.5, pieces=(1, 1), touching=True)
    spoiled = solid.vertices.copy()
    spoiled[:, 2] *= 2
    with pytest.raises(CertificateError, match="top and bottom are not"):
        check_solid(spoiled, solid.faces, 0.5, pieces=(1, 1), touching=True)
    with pytest.raises(CertificateError, match="alternate"):
        check_solid(solid.vertices, solid.faces[:, ::-1], 0.5, pieces=(1, 1), touching=True)


def test_a_strand_across_a_double_edge():
    # It crosses the slit at x = 1/3, which is no double.
    surface = pf.lift(pf.Outline([KEYHOLE, [(0, 1), (1, 4), (-2, 4)]]), triangles=100)
    surface.check()
    assert surface.n_layers == 2


def test_the_pieces_together_are_the_outline():
    surface = pf.lift(NECK, triangles=50)
    loops, _ = loops_of(surface)
    check_boundary([NECK], loops)
    with pytest.raises(CertificateError, match="not the outline"):
        check_boundary([NECK], loops[:1])
    with pytest.raises(CertificateError, match="not the outline"):
        check_boundary([NECK], [loops[0], loops[1][::-1]])
