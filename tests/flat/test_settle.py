"""Outlines that touch themselves: triangles and pieces on the points as given, by the definition and in fractions."""

from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.certify import check_pieces
from plyfold.errors import CurveError, GeneralPositionError, InputError, NotImmersibleError
from plyfold.flat.settle import Settled, settle, settled_triangles
from plyfold.halfedges import GluedTriangles, twins_of
from plyfold.mesh.refine import given_outline
from reference import random_curves
from reference.certificates import is_immersed_disk
from reference.settled import (
    are_among,
    are_the_same,
    boundary_of,
    double_area,
    pieces_of,
    rational,
    sides,
)

PINCH = [(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)]
NECK = [(0, 0), (1, 1), (2, 1), (3, 0), (3, 2), (2, 1), (1, 1), (0, 2)]
KEYHOLE = [(-4, -4), (4, -4), (4, 0), (1, 0), (0, -1), (-1, 0), (0, 1), (1, 0), (4, 0), (4, 4), (-4, 4)]
TOUCHED_EDGE = [(0, 0), (4, 0), (4, 2), (3, 2), (2, 0), (1, 2), (0, 2)]


def has_spikes(points):
    """Whether the closed polyline turns back somewhere the way that it came."""
    points = pf.Curve(points).points
    (ax, ay), (bx, by) = (points - np.roll(points, 1, axis=0)).T, (np.roll(points, -1, axis=0) - points).T
    return bool(((ax * by == ay * bx) & (ax * bx + ay * by < 0)).any())


def check(points):
    """Check all that is claimed; return the number of pieces, or None if the outline bounds no disk."""
    immersion = pf.find_immersion(points)
    if not immersion:
        return None
    settled, drawn = settled_triangles(immersion), given_outline(immersion.arrangement)
    outline = sides(rational(drawn.points.tolist()))
    places = rational(drawn.points[settled.point].tolist())
    faces = settled.faces.tolist()
    assert all(double_area([places[corner] for corner in face]) > 0 for face in faces)
    assert are_the_same([side for face in faces for side in sides([places[corner] for corner in face])], outline)
    pieces = pieces_of(faces)
    boundaries = [boundary_of(piece) for piece in pieces]
    assert sorted(corner for boundary in boundaries for corner in boundary) == list(range(len(settled.point)))
    assert len(faces) == len(settled.point) - 2 * len(pieces)
    # Nothing is cut but at points: all that is left of the boundary is outline.
    assert are_among([side for b in boundaries for side in sides([places[corner] for corner in b])], outline)
    for piece, boundary in zip(pieces, boundaries, strict=True):
        assert boundary == sorted(boundary)
        assert is_disk([places[corner] for corner in boundary], boundary, piece)
    return len(pieces)


def is_disk(polygon, boundary, piece):
    number = {corner: at for at, corner in enumerate(boundary)}
    faces = [[number[corner] for corner in face] for face in piece]
    return is_immersed_disk(polygon, polygon, faces, list(range(len(polygon))))


def check_polygons(points):
    """Check the pieces of decompose: simple, and together the outline."""
    polygons = pf.decompose(points)
    assert all(polygon.is_valid and not polygon.interiors for polygon in polygons)
    around = [side for polygon in polygons for side in sides(rational(polygon.exterior.coords[:-1]))]
    assert are_the_same(around, sides(rational(given_outline(pf.arrange(points)).points.tolist())))
    return polygons


def check_refined(points, share):
    """Check triangles with more points: they are positive, and together the outline; pieces have nothing in common."""
    outline = rational(pf.arrange(points).given.points.tolist())
    places, faces = pf.triangulate(points, refine=share * float(double_area(outline)) / 2)
    corners = [[rational(places.tolist())[corner] for corner in face] for face in faces.tolist()]
    assert all(double_area(triangle) > 0 for triangle in corners)
    assert are_the_same([side for triangle in corners for side in sides(triangle)], sides(outline))
    assert places[: len(points)].tolist() == np.asarray(points, dtype=np.float64).tolist()
    return pieces_of(faces.tolist())


def test_two_triangles_that_meet_in_a_point():
    assert check(PINCH) == 2
    assert sorted(polygon.area for polygon in check_polygons(PINCH)) == [1, 1]
    assert list(map(list, pf.find_immersion(PINCH).touches)) == [[1, 1]]
    assert [frozenset(face) for face in pf.triangulate(PINCH).tolist()] == [{0, 4, 5}, {1, 2, 3}]


def test_a_neck_drops_out():
    assert check(NECK) == 2
    assert sorted(polygon.area for polygon in check_polygons(NECK)) == [1, 1]
    assert list(map(list, pf.find_immersion(NECK).touches)) == [[1, 1], [2, 1]]


@pytest.mark.parametrize("lower", [[], [1.5], [1.25, 1.5], [1.125, 1.25, 1.75]])
@pytest.mark.parametrize("upper", [[], [1.5], [1.75, 1.5]])
def test_a_neck_with_vertices(lower, upper):
    neck = [*NECK[:2], *((x, 1) for x in lower), *NECK[2:6], *((x, 1) for x in upper), *NECK[6:]]
    assert check(neck) == 2
    assert len(pf.triangulate(neck)) == 2


def test_a_cut_walked_twice_is_no_neck():
    """The surface lies on both sides of it: nothing is cut."""
    assert check(KEYHOLE) == 1
    assert pf.find_immersion(KEYHOLE).touches == ()
    assert sum(polygon.area for polygon in check_polygons(KEYHOLE)) == 62


def test_a_point_inside_an_edge():
    """It is a corner of both pieces, and has two numbers where points are added."""
    assert check(TOUCHED_EDGE) == 2
    assert {frozenset(polygon.exterior.coords) for polygon in check_polygons(TOUCHED_EDGE)} == {
        frozenset({(0, 0), (2, 0), (1, 2), (0, 2)}),
        frozenset({(2, 0), (4, 0), (4, 2), (3, 2)}),
    }
    assert len(pf.triangulate(TOUCHED_EDGE)) == 4
    assert list(map(list, pf.find_immersion(TOUCHED_EDGE).touches)) == [[2, 0]]
    places, fine = pf.triangulate(TOUCHED_EDGE, refine=0.25)
    assert places[7].tolist() == [2, 0]
    assert len(pieces_of(fine.tolist())) == 2


@pytest.mark.parametrize("turn", [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1)])
def test_many_points_inside_an_edge(turn):
    """They are corners in the order in which the edge comes to them, wherever it runs."""
    c, s = turn
    comb = [(0, 0), (8, 0), (8, 2), (7, 2), (6, 0), (5, 2), (4, 0), (3, 2), (2, 0), (1, 2), (0, 2), (-1, 1)]
    there = [(c * x - s * y, s * x + c * y) for x, y in comb]
    assert check(there) == 4
    assert len(pf.find_immersion(there).touches) == 3
    settled = settled_triangles(pf.find_immersion(there))
    assert settled.point[settled.inside].tolist() == [8, 6, 4]
    with_spike = [*there[:3], (9 * c - 3 * s, 9 * s + 3 * c), *there[2:]]
    places, faces = pf.triangulate(with_spike, refine=0.5)
    assert places[:14].tolist() == [list(place) for place in with_spike]
    assert len(pieces_of(faces.tolist())) == 4


def test_many_pieces_at_one_point():
    blades = [((0, 0), (np.round(9 * np.cos(a)), np.round(9 * np.sin(a)))) for a in np.arange(12) * np.pi / 6]
    fan = [
        tuple(map(float, place))
        for (hub, one), (_, other) in zip(blades[::2], blades[1::2], strict=True)
        for place in (hub, one, other)
    ]
    assert check(fan) == 6
    assert list(map(list, pf.find_immersion(fan).touches)) == [[0, 0]]
    assert len(check_polygons(fan)) == 6


@pytest.mark.parametrize("points", [PINCH, NECK, KEYHOLE, TOUCHED_EDGE])
def test_numbers_are_those_of_the_points_as_given(points):
    """Whichever way the outline runs, and from whichever point."""
    for start, step in product(range(len(points)), (1, -1)):
        turned = np.roll(points, start, axis=0)[::step]
        doubled = np.repeat(turned, 2, axis=0)
        for given_points in (turned, doubled):
            faces = pf.triangulate(given_points)
            corners = [rational(given_points[face].tolist()) for face in faces]
            assert all(double_area(triangle) > 0 for triangle in corners)
            assert are_the_same(
                [side for triangle in corners for side in sides(triangle)], sides(rational(np.array(points).tolist()))
            )


def test_an_arrangement_has_triangles_of_the_points_as_given():
    drawn = pf.arrange(PINCH)
    assert drawn.outline.points.tolist() != drawn.given.points.tolist()
    assert pf.triangulate(drawn).tolist() == pf.triangulate(PINCH).tolist()
    assert pf.triangulate(PINCH, pf.find_immersion(drawn)).tolist() == pf.triangulate(PINCH).tolist()


def test_nothing_changes_where_nothing_touches():
    ramp = pf.find_immersion(pf.gallery.CURVES["exit-ramp"].curve)
    settled = settled_triangles(ramp)
    assert settled.point.tolist() == list(range(len(ramp.arrangement.curve)))
    assert not settled.inside.any()
    assert len(settled.cuts) == 0


@pytest.mark.parametrize("diagonals", [[(1, 4), (1, 5), (2, 4)], [(2, 5), (1, 5), (2, 4)], [(1, 4), (0, 4), (1, 3)]])
def test_whatever_the_triangles_were(diagonals):
    """The same pieces from all triangulations."""
    hexagon = {frozenset((i, (i + 1) % 6)) for i in range(6)} | set(map(frozenset, diagonals))
    faces = [
        (a, b, c)
        for a, b, c in product(range(6), repeat=3)
        if a < b < c and {frozenset((a, b)), frozenset((b, c)), frozenset((a, c))} <= hexagon
    ]
    settled = settle(pf.Curve(PINCH), GluedTriangles(np.array(faces), twins_of(np.array(faces))))
    assert isinstance(settled, Settled)
    assert {frozenset(settled.point[face].tolist()) for face in settled.faces} == {
        frozenset({0, 4, 5}),
        frozenset({1, 2, 3}),
    }
    assert settled.cuts.tolist() == [1]


def test_spikes_are_no_corners():
    """They keep their numbers, and no triangle has them."""
    points = [(0, 0), (4, 0), (4, 4), (6, 6), (4, 4), (0, 4), (0, 2), (-1, 2), (0, 2)]
    for given_points in (points, points[::-1]):
        faces = pf.triangulate(given_points)
        corners = [rational([given_points[corner] for corner in face]) for face in faces.tolist()]
        assert all(double_area(triangle) > 0 for triangle in corners)
        assert sum(double_area(triangle) for triangle in corners) == 32
        places, fine = pf.triangulate(given_points, refine=3.0)
        assert places[:9].tolist() == [list(place) for place in given_points]
        assert sum(double_area(rational(places[face].tolist())) for face in fine) == 32
        assert pf.triangulate(pf.Curve(given_points), pf.find_immersion(given_points)).tolist() == faces.tolist()
        drawn = pf.arrange(given_points)
        left = drawn.given.points[np.argsort(drawn.numbers)]
        for named, rows in ((left, pf.triangulate(drawn)), pf.triangulate(drawn, refine=3.0)):
            assert sum(double_area(rational(named[face].tolist())) for face in rows) == 32


def random_loops(seed, count):
    """One to three loops on a small grid, mostly in a square, and a cusp on some."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        size, n_loops = int(rng.integers(2, 6)), int(rng.integers(1, 4))
        loops = [rng.integers(0, size + 1, (int(rng.integers(3, 7)), 2)).tolist() for _ in range(n_loops)]
        if rng.random() < 0.7:
            loops[0] = [(0, 0), (size // 2, 0), (size, 0), (size, size), (0, size)]
        yield loops, {(int(rng.integers(n_loops)), 0): 1} if rng.random() < 0.4 else {}


def test_loops_and_cusps():
    """Several loops that touch each other, too; by the checker of pieces, which knows nothing of all this."""
    cut = {False: 0, True: 0}
    for loops, cusps in random_loops(seed=5, count=500):
        try:
            immersion = pf.find_immersion(pf.Outline(loops, cusps))
        except (CurveError, GeneralPositionError):  # an edge that runs over a cusp that stays
            continue
        if immersion:
            drawn, settled = immersion.arrangement.given, settled_triangles(immersion)
            check_pieces(
                drawn.loops, drawn.points[settled.point], settled.faces, drawn.cusps, twins=settled.triangles.twin
            )
            places = [rational(drawn.points[settled.point[face]].tolist()) for face in settled.faces]
            outlines = [side for loop in drawn.loops for side in sides(rational(loop.tolist()))]
            assert are_the_same([side for triangle in places for side in sides(triangle)], outlines)
            cut[drawn.has_cusps] += len(settled.cuts) > 0
    assert cut[False] > 20
    assert cut[True] > 2


def shapes(points):
    """The pieces of an outline, each by the places of its corners; straight ones are left out."""
    immersion = pf.find_immersion(points)
    settled, drawn = settled_triangles(immersion), immersion.arrangement.given
    polygons = [drawn.points[settled.point[boundary_of(piece)]] for piece in pieces_of(settled.faces.tolist())]
    return [[tuple(place) for place in polygon.tolist()] for polygon in polygons]


def as_one_sees(polygons):
    """Without corners of 180 degrees, from the lowest corner on, in order."""
    seen = []
    for polygon in polygons:
        ends = zip(polygon[-1:] + polygon[:-1], polygon, polygon[1:] + polygon[:1], strict=True)
        corners = [here for before, here, after in ends if double_area(rational([before, here, after]))]
        least = corners.index(min(corners))
        seen.append(corners[least:] + corners[:least])
    return sorted(seen)


def test_the_same_pieces_in_every_position_and_from_every_start():
    found = 0
    for points in random_grid_polygons(seed=8, count=400):
        try:
            if has_spikes(points) or pf.count_immersions(points) != 1:
                continue
        except CurveError:
            continue
        pieces = shapes(points)
        if len(pieces) > 1:
            found += 1
            for start, (turn, mirror) in enumerate(product(range(4), (1, -1))):
                there = np.array([[1, 0], [0, mirror]]) @ np.linalg.matrix_power(np.array([[0, -1], [1, 0]]), turn)
                moved = np.roll(np.array(points) @ there, start, axis=0)
                back = [[tuple(place) for place in np.array(piece) @ there.T] for piece in shapes(moved)]
                back = [piece[::mirror] for piece in back]
                assert as_one_sees(back) == as_one_sees(pieces)
    assert found > 5


def random_grid_polygons(seed, count):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        size = int(rng.integers(2, 6))
        yield rng.integers(0, size + 1, (int(rng.integers(4, 11)), 2)).tolist()


def random_crowded_outlines(seed, count):
    """Outlines of disks, put on a coarse grid: many still are, and touch themselves."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        ribbon = random_curves.ribbon_outline(rng, int(rng.integers(4, 20)))
        points = np.array(ribbon if rng.random() < 0.5 else random_curves.glued_disk(rng, int(rng.integers(4, 25))))
        size = np.ptp(points, axis=0).max()
        yield np.round((points - points.min(axis=0)) / size * rng.integers(4, 14)).tolist()


@pytest.mark.parametrize(("outlines", "count"), [(random_grid_polygons, 400), (random_crowded_outlines, 120)])
def test_random_outlines(outlines, count):
    pieces = []
    for points in outlines(seed=3, count=count):
        try:
            if not has_spikes(points) and (found := check(points)):
                pieces.append(found)
                check_polygons(points)
        except CurveError:
            continue
    assert len(pieces) > 40
    assert max(pieces) > 1


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), min_size=4, max_size=9), st.floats(0.02, 1))
def test_refined(points, share):
    try:
        assume(not has_spikes(points))
        pieces = check(points)
    except CurveError:
        return
    if pieces is None:
        with pytest.raises(NotImmersibleError):
            pf.triangulate(points, refine=1.0)
    else:
        assert len(check_refined(pf.Curve(points).points.tolist(), share)) == pieces


def noisy_keyhole(rng):
    """A cut walked twice whose vertices are on a line but for rounding, which is less than any move."""
    along = [0.9, *np.sort(rng.uniform(1, 3, int(rng.integers(1, 12)))), 3.1]
    angle = np.linspace(0, -2 * np.pi, int(rng.integers(4, 8)), endpoint=False)[1:]
    hole = [(0.9 * np.cos(a), 0.9 * np.sin(a)) for a in angle]
    cut = [(x, 0.0) for x in along]
    points = np.array([(4, -4), cut[-1], *cut[-2::-1], *hole, *cut, (4, 4), (-4, 4), (-4, -4)])
    turn = rng.uniform(0, 2 * np.pi)
    x, y = points.T
    return np.stack([np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y], axis=1).tolist()


@pytest.mark.usefixtures("way")
def test_lines_that_are_straight_but_for_rounding():
    rng = np.random.default_rng(4)
    assert all(check(noisy_keyhole(rng)) == 1 for _ in range(15))


def test_a_surface_without_any_width_has_no_triangles_and_no_mesh():
    square = [(1, 1), (2, 1), (2, 2), (1, 2)]
    twice = [square, square[::-1]]
    assert pf.find_immersion(twice)
    assert len(pf.triangulate(twice)) == 0
    assert pf.decompose(twice) == []
    assert len(pf.triangulate(twice, refine=0.1)[1]) == 0
    with pytest.raises(InputError, match=r"no width anywhere.*at \(1, 1\)"):
        pf.lift(twice)
