"""Curves drawn from their codes: the code read back is the same, and the pictures are round and even."""

import numpy as np
import pytest
import shapely

import plyfold as pf
from plyfold.arrangement.drawing import smooth
from plyfold.arrangement.drawing.flips import flipped
from plyfold.arrangement.drawing.relaxation import energy, relaxed
from plyfold.arrangement.drawing.skeleton import Kind, skeleton
from plyfold.arrangement.drawing.straight_lines import grid_drawing, tutte_drawing
from plyfold.arrangement.gauss import GaussCode
from plyfold.errors import GaussCodeError, PrecisionError
from reference import planar_maps
from reference.crossings import crossings, turning_number
from reference.random_curves import glued_disk, random_polygon, ribbon_outline, star_polygon


def read_back(curve):
    """The code of a drawing, in its own direction, by the library's arrangement."""
    drawn = pf.arrange(curve, "raise")
    return GaussCode.of(drawn).reversed() if drawn.reversed else GaussCode.of(drawn)


def both_directions(code):
    oriented = GaussCode(*code)
    return oriented, oriented.reversed()


def crossing_angles(drawn):
    """The angles between the strands in degrees, at most 90."""
    along = np.roll(drawn.curve.points, -1, axis=0) - drawn.curve.points
    u, v = along[drawn.visit_edge], along[drawn.visit_edge[drawn.partner]]
    return np.degrees(np.arctan2(np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]), np.abs((u * v).sum(axis=1))))


def smallest_cell(drawn):
    """The diameter of the largest circle in the narrowest cell, as a part of the size of the drawing."""
    size = np.ptp(drawn.curve.points, axis=0).max()
    cells = (shapely.Polygon(drawn.cell_outline(cell)) for cell in range(1, drawn.n_cells))
    return min(2 * shapely.maximum_inscribed_circle(cell, tolerance=size / 5000).length for cell in cells) / size


def test_reference_reads_the_code_of_small_curves():
    codes = [*planar_maps.census(1), *planar_maps.census(2)[::4]]
    for code in (both_directions(code)[number % 2] for number, code in enumerate(codes)):
        points = code.to_curve().points.tolist()
        found = planar_maps.with_smallest_outer_dart(crossings(points).code)
        assert found == (code.partner, code.ccw, code.outer)
        assert turning_number(points) == planar_maps.turning_number(found)


@pytest.mark.parametrize(("k", "every"), [(1, 1), (2, 1), (3, 1), (4, 6)])
def test_curves_are_drawn_well(k, every):
    for census_code in planar_maps.census(k)[::every]:
        code = GaussCode(*census_code)
        curve = code.to_curve()
        drawn = pf.arrange(curve, "raise")
        assert read_back(curve) == code
        assert crossing_angles(drawn).min() > 50
        assert smallest_cell(drawn) > 1 / 25


def test_some_curves_with_five_crossings_in_both_directions():
    for census_code in planar_maps.census(5)[::40]:
        for code in both_directions(census_code):
            assert read_back(code.to_curve()) == code


@pytest.mark.slow
@pytest.mark.parametrize("k", [4, 5, 6])
def test_every_larger_curve_is_drawn_well(k):
    for census_code in planar_maps.census(k):
        curve = GaussCode(*census_code).to_curve()
        drawn = pf.arrange(curve, "raise")
        assert read_back(curve) == GaussCode(*census_code)
        assert crossing_angles(drawn).min() > 40
        assert smallest_cell(drawn) > 1 / 50


RNG = np.random.default_rng(4)
LARGE = {
    "ribbon": ribbon_outline(RNG, 150),
    "disk": glued_disk(RNG, 100),
    "star": star_polygon(25, 7),
    "polygon": random_polygon(RNG, 30),
    "coil": [(t * np.cos(t), t * np.sin(t)) for t in np.linspace(6, 60 * np.pi, 900)],
}


@pytest.mark.parametrize("name", LARGE)
def test_large_curves(name):
    code = GaussCode.of(LARGE[name])
    assert 25 <= code.n_crossings <= 300
    assert read_back(code.to_curve()) == code


@pytest.mark.slow
def test_a_coil_too_deep_to_be_rounded():
    code = GaussCode.of([(t * np.cos(t), t * np.sin(t)) for t in np.linspace(6, 400 * np.pi, 4000)])
    assert read_back(code.to_curve()) == code


def test_straight_strands_have_the_code_too():
    for census_code in planar_maps.census(3):
        code = GaussCode(*census_code)
        used = pf.Arrangement.from_gauss(code.partner, code.ccw, code.outer)
        disk = skeleton(used)
        *_, straight = smooth._candidates(tutte_drawing(disk.triangles, disk.rim)[disk.path], disk.path)
        assert len(straight) == len(disk.path)
        assert GaussCode.of(np.column_stack([straight.real, straight.imag])) == GaussCode.of(used)


def test_arguments_may_be_lists():
    limacon = pf.arrange(GaussCode([1, 0], [True, False], 1).to_curve())
    assert (limacon.gauss_code(), limacon.reversed) == (([1, 0], [True, False], 1), False)
    with pytest.raises(GaussCodeError):
        GaussCode([2, 3, 0, 1], [True, True, False, False], 0)


def test_a_drawing_with_another_code_is_never_returned(monkeypatch):
    code = GaussCode.of(LARGE["star"])
    monkeypatch.setattr(smooth, "_has_code", lambda curve, wanted: False)
    with pytest.raises(PrecisionError, match=f"{code.n_crossings} crossings"):
        code.to_curve()


@pytest.mark.parametrize(("outer", "turns"), [(1, 1), (0, -1)])
def test_circles(outer, turns):
    points = GaussCode([], [], outer).to_curve().points
    assert turning_number(points.tolist()) == turns
    assert np.hypot(*points.T) == pytest.approx(1.0)


def test_a_drawing_fills_its_frame():
    for census_code in planar_maps.census(3)[::4]:
        points = GaussCode(*census_code).to_curve().points
        assert np.ptp(points, axis=0).max() == pytest.approx(2.0)
        assert points.max(axis=0) + points.min(axis=0) == pytest.approx(0.0, abs=1e-12)


def disks():
    codes = [*planar_maps.census(3), *(GaussCode.of(LARGE[name]) for name in ("ribbon", "coil"))]
    for code in codes:
        known = GaussCode(*code) if isinstance(code, tuple) else code
        yield skeleton(pf.Arrangement.from_gauss(known.partner, known.ccw, known.outer))


def doubled_areas(places, triangles):
    """Exact for integer places of moderate size."""
    a, b, c = places[triangles].T
    return ((b - a).conjugate() * (c - a)).imag


def check_is_a_disk_without_double_edges(disk):
    sides = [side for a, b, c in disk.triangles.tolist() for side in ((a, b), (b, c), (c, a))]
    once = set(sides)
    assert len(once) == len(sides)
    edges = {frozenset(side) for side in sides}
    assert disk.n_vertices - len(edges) + len(disk.triangles) == 1
    open_sides = {(a, b) for a, b in sides if (b, a) not in once}
    assert open_sides == set(zip(disk.rim.tolist(), np.roll(disk.rim, -1).tolist(), strict=True))
    along = zip(disk.path.tolist(), np.roll(disk.path, -1).tolist(), strict=True)
    assert {frozenset(side) for side in along} <= edges


def test_skeletons_are_triangulated_disks_that_carry_the_curve():
    for disk in disks():
        check_is_a_disk_without_double_edges(disk)


def test_borders_get_the_beads_they_ask_for_or_more():
    drawn = pf.Arrangement.from_gauss([1, 0], [True, False], 1)
    few, many = skeleton(drawn), skeleton(drawn, [9, 0])
    assert len(many.path) - len(few.path) == 4
    assert np.flatnonzero(many.path == 0).tolist() == [5, 15]
    check_is_a_disk_without_double_edges(many)


def test_flips_keep_the_disk_and_turn_no_triangle_over():
    for disk in disks():
        places = relaxed(grid_drawing(disk.triangles, disk.rim), disk, 1e-2)
        better = flipped(places, disk)
        check_is_a_disk_without_double_edges(better)
        assert doubled_areas(places, better.triangles).min() > 0
        changed = (better.triangles != disk.triangles).any(axis=1)
        assert (disk.kind[changed] == Kind.CELL).all()
        assert flipped(places, better) is better


def test_grid_drawings_are_exact():
    for disk in disks():
        places = grid_drawing(disk.triangles, disk.rim)
        assert (places == np.round(places.real) + 1j * np.round(places.imag)).all()
        assert np.abs(places).max() <= 3 * disk.n_vertices
        assert doubled_areas(places, disk.triangles).min() >= 1


def test_tutte_drawings_put_vertices_between_their_neighbours():
    disk = next(disks())
    places = tutte_drawing(disk.triangles, disk.rim)
    inner = np.setdiff1d(np.arange(disk.n_vertices), disk.rim)
    for vertex in inner.tolist():
        around = np.unique(disk.triangles[(disk.triangles == vertex).any(axis=1)])
        assert places[vertex] == pytest.approx(places[around[around != vertex]].mean(), abs=1e-12)


def test_relaxing_lowers_the_energy_and_turns_no_triangle_over():
    for disk in disks():
        start = grid_drawing(disk.triangles, disk.rim)
        places = relaxed(start, disk)
        assert energy(places, disk) < energy(start, disk)
        assert doubled_areas(places, disk.triangles).min() > 0
        rim = places[disk.rim]
        assert shapely.LinearRing(np.column_stack([rim.real, rim.imag])).is_simple


def test_energy_has_the_gradient_that_newton_uses():
    from plyfold.arrangement.drawing.relaxation import _newton

    disk = next(disks())
    places = tutte_drawing(disk.triangles, disk.rim) * 5
    direction, slope = _newton(places, disk)
    step = 1e-6
    change = energy(places + step * direction, disk) - energy(places - step * direction, disk)
    assert change / (2 * step) == pytest.approx(slope, rel=1e-5)


def test_flat_and_overturned_triangles_cost_infinitely_much():
    disk = next(disks())
    places = tutte_drawing(disk.triangles, disk.rim)
    assert np.isfinite(energy(places, disk))
    assert energy(places.conjugate(), disk) == np.inf
    assert energy(places * 0, disk) == np.inf
