"""Triangles, pieces and multiplicities of outlines with several loops, handles and cusps."""

import numpy as np
import pytest
import shapely

import plyfold as pf
from plyfold.certify import check_immersed_surface
from plyfold.errors import InputError
from plyfold.flat.sweep import sweep_triangles
from plyfold.mesh.cells import triangulate_cells
from plyfold.mesh.sheets import glue_copies, twisted_bridges
from reference.random_curves import HANDLE

SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9)]
HOLE = [(3, 3), (3, 6), (6, 6), (6, 3)]
TRIANGLE = [(5, -2), (12, 5), (4, 12)]


def turned(points, angle):
    return np.asarray(points) @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]


def limacon(n=40):
    """It turns twice."""
    angle = np.linspace(0, 2 * np.pi, n + 1)[:-1]
    radius = 0.45 + np.cos(angle)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def twice_round(radius, wave, n, shift=(0.0, 0.0)):
    """A curve that goes round twice, from one distance to another and back."""
    angle = np.linspace(0, 4 * np.pi, n + 1)[:-1]
    length = radius + wave * np.cos(angle / 2 + 1)
    return np.column_stack([length * np.cos(angle), length * np.sin(angle)]) + shift


def double_ring(n, m, shift):
    """A ring that goes round twice: its sheets change places on the way."""
    return [twice_round(5, 0.7, n), twice_round(2, 0.3, m, shift)[::-1]]


def twice_round_squares(r):
    return [(-r, -r), (r, -r), (r, r), (-r - 1, r), (-r - 1, -r - 1), (r + 1, -r - 1), (r + 1, r + 1), (-r, r + 1)]


OUTLINES = {
    "ring": [SQUARE, HOLE],
    "ring and triangle": [SQUARE, HOLE, TRIANGLE],
    "apart": [SQUARE, [(20, 0), (21, 0), (20, 1)], [(0.5, 1), (8, 1), (8, 8)]],
    "handle": HANDLE,
    **{f"double ring {n}": double_ring(n, 2 * n + 1, shift) for n, shift in ((15, (0, 0)), (40, (0.2, -0.1)))},
    **{f"double ring on a grid {r}": [twice_round_squares(8), twice_round_squares(r)[::-1]] for r in (1, 3, 5)},
    **{f"cusp at {at}": pf.Curve(limacon(), cusps={at: 1}) for at in (15, 17, 20, 22, 25)},
}


def certify(outline, triangles):
    faces, twins = triangles
    assert len(faces) == len(outline) - 2 * pf.arrange(outline).euler_characteristic
    check_immersed_surface(outline.loops, outline.points, faces, np.arange(len(outline)), outline.cusps, twins=twins)


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("name", OUTLINES)
def test_triangles_are_the_surface(name):
    found = 0
    for immersion in pf.immersions(OUTLINES[name]):
        certify(immersion.arrangement.outline, sweep_triangles(immersion))
        found += 1
    assert found


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("angle", np.linspace(0, 6, 13))
def test_cusps_in_all_directions(angle):
    """A spiral stair seen from everywhere: its edges end at the line and begin there, the corner convex or reflex."""
    found = 0
    for at in range(0, 40, 3):
        curve = pf.Curve(turned(limacon(), angle), cusps={at: 1})
        if immersion := pf.find_immersion(curve):
            certify(curve, sweep_triangles(immersion))
            found += 1
    assert found == 5  # the points of the inner loop


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("turns", [1, 2, 3])
@pytest.mark.parametrize("tip", [(0.1, 0.05), (0.1, -0.05), (-0.1, 0.02), (0.0, 0.4), (0.5, -0.6)])
def test_cusps_of_several_turns(turns, tip):
    angle = np.linspace(0, 2 * np.pi * (turns + 1), 12 * (turns + 1))
    spiral = np.column_stack([np.cos(angle), np.sin(angle)]) * (2 - angle / angle[-1])[:, None]
    for direction in np.linspace(0, 6, 9):
        points = turned([*spiral.tolist(), tip], direction)
        curve = pf.Curve(points, cusps={len(spiral): pf.arrange(points).turning_number - 1})
        assert curve.cusps[0].max() in {turns, turns + 1}
        certify(curve, sweep_triangles(pf.find_immersion(curve)))


@pytest.mark.parametrize("name", [name for name in OUTLINES if name.startswith("double ring")])
def test_double_rings_have_bridges_that_change_sheets(name):
    immersion = pf.find_immersion(OUTLINES[name])
    assert len(twisted_bridges(immersion)) == 1
    with pytest.raises(InputError, match="change places"):
        glue_copies(immersion, triangulate_cells(immersion.arrangement, triangles=0))


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("seed", range(20))
def test_random_double_rings(seed):
    rng = np.random.default_rng(seed)
    rings = double_ring(*rng.integers(12, 60, 2), rng.uniform(-0.3, 0.3, 2))
    found = list(pf.immersions([turned(loop, rng.uniform(0, 6)) for loop in rings]))
    assert len(found) == 2
    for immersion in found:
        certify(immersion.arrangement.outline, sweep_triangles(immersion))


def test_numbers_are_those_of_the_input():
    """Clockwise loops are turned round, and points left out; faces have the rows that were given."""
    square, hole = SQUARE[:1] + SQUARE[:0:-1], HOLE[:1] + HOLE[:0:-1]
    points = np.array([*square, square[0], hole[0], *hole])
    faces = pf.triangulate([[*square, square[0]], [hole[0], *hole]])
    assert len(faces) == 8
    a, b, c = points[faces].swapaxes(0, 1)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    assert (ux * vy - uy * vx > 0).all()
    assert (ux * vy - uy * vx).sum() / 2 == 81 - 9


def test_immersion_of_another_outline():
    ring = pf.find_immersion([SQUARE, HOLE])
    assert len(pf.triangulate([SQUARE, HOLE], ring)) == 8
    for other in ([HOLE, SQUARE], [SQUARE, HOLE[1:]], SQUARE, pf.Outline([SQUARE, HOLE], {(0, 1): 1})):
        with pytest.raises(InputError, match="another curve"):
            pf.triangulate(other, ring)


@pytest.mark.parametrize("name", OUTLINES)
def test_refined(name):
    outline = OUTLINES[name]
    drawn = pf.arrange(outline)
    points, faces = pf.triangulate(outline, refine=0.02 * np.prod(np.ptp(drawn.outline.points, axis=0)))
    loops = drawn.outline.reversed() if drawn.reversed else drawn.outline
    assert points[: len(loops)].tolist() == loops.points.tolist()
    check_immersed_surface(loops.loops, points, faces, np.arange(len(loops)), loops.cusps)


@pytest.mark.parametrize("name", OUTLINES)
def test_pieces_cover_as_often_as_the_outline_winds(name):
    drawn, pieces = pf.arrange(OUTLINES[name]), pf.decompose(OUTLINES[name])
    assert all(piece.is_valid and piece.geom_type == "Polygon" for piece in pieces)
    corners = {tuple(point) for point in drawn.outline.points.tolist()}
    assert {tuple(point) for point in shapely.get_coordinates(pieces).tolist()} <= corners
    for cell in np.flatnonzero(drawn.winding >= 0).tolist():
        inside = shapely.Point(drawn.cell_point(cell))
        assert sum(piece.contains(inside) for piece in pieces) == drawn.winding[cell]


def test_few_pieces():
    assert len(pf.decompose([SQUARE, HOLE])) == 1
    assert len(pf.decompose([SQUARE, HOLE, TRIANGLE])) == 2
    assert len(pf.decompose(pf.Curve(limacon(), cusps={20: 1}))) == 2


@pytest.mark.parametrize("name", OUTLINES)
def test_coverage(name):
    drawn, cells = pf.arrange(OUTLINES[name]), pf.coverage(OUTLINES[name])
    assert [cell.winding for cell in cells] == drawn.winding[drawn.winding != 0].tolist()
    assert shapely.coverage_is_valid([cell.polygon for cell in cells])
    for number, cell in zip(np.flatnonzero(drawn.winding), cells, strict=True):
        assert cell.polygon.contains(shapely.Point(drawn.cell_point(int(number))))
    x, y = drawn.outline.points.T
    after = drawn.outline.next_point
    area = (x @ y[after] - y @ x[after]) / 2
    assert sum(cell.winding * cell.polygon.area for cell in cells) == pytest.approx(area)


def test_coverage_has_holes():
    (cell,) = pf.coverage([SQUARE, HOLE])
    assert cell.polygon.equals(shapely.Polygon(SQUARE, [HOLE]))
    outer, inner = pf.coverage([SQUARE, [(1, 1), (2, 1), (1, 2)], [(5, 5), (6, 5), (5, 6)]])[:2]
    assert len(outer.polygon.interiors) == 2
    assert (outer.winding, inner.winding) == (1, 2)
