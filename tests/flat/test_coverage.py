"""Cells with their winding numbers, against what GEOS makes of the same loop."""

import math
from collections import Counter

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.errors import PrecisionError
from plyfold.flat.coverage import _has_equal_points as has_equal_points
from plyfold.flat.coverage import coverage, directed_coverage
from plyfold.flat.regions import refuse_invalid
from reference import random_curves
from reference.fills import cells_by_slabs
from touching import are_loops, touching_outlines


def winding_number(points, place):
    """By adding up angles."""
    z = (np.asarray(points) - place) @ np.array([1, 1j])
    return round(np.angle(np.roll(z, -1) / z).sum() / (2 * math.pi))


def by_geos(points):
    """Area, perimeter and winding number of every cell that does not wind 0 times, by noding and polygonizing."""
    noded = shapely.unary_union(shapely.LinearRing(points))
    cells = shapely.get_parts(shapely.polygonize([noded]))
    wound = [(cell.area, cell.length, winding_number(points, cell.point_on_surface().coords[0])) for cell in cells]
    return sorted(row for row in wound if row[2] != 0)


def curves():
    yield from (pytest.param(named.curve.points, id=name) for name, named in CURVES.items())
    for seed in range(10):
        rng = np.random.default_rng(seed)
        yield pytest.param(random_curves.random_polygon(rng, 20), id=f"polygon {seed}")
        yield pytest.param(random_curves.smooth_curve(rng, 6), id=f"smooth {seed}")
        yield pytest.param(random_curves.glued_disk(rng, 30), id=f"disk {seed}")


@pytest.mark.parametrize("points", list(curves()))
def test_cells_of_geos(points):
    points = np.array(points, dtype=np.float64)
    drawn = pf.arrange(points)
    found = coverage(drawn)
    assert all(cell.polygon.is_valid and cell.polygon.exterior.is_ccw for cell in found)
    expected = by_geos(drawn.curve.points)
    rows = sorted((cell.polygon.area, cell.polygon.length, cell.winding) for cell in found)
    assert [row[2] for row in rows] == [row[2] for row in expected]
    np.testing.assert_allclose([row[:2] for row in rows], [row[:2] for row in expected], rtol=1e-6)


def test_a_cell_that_touches_itself():
    """Small loops inside and outside of a big one: the ring between has holes that touch its outline."""
    big = [(0, 0), (10, 0), (10, 10), (0, 10)]
    inward = [*big[:1], (6, 0), (6, 2), (4, 2), (4, -1), (3, -1), (3, 0.5), *big[1:]]
    found = coverage(inward)
    assert [cell.polygon.is_valid for cell in found] == [True] * len(found)
    x, y = np.array(inward, dtype=np.float64).T
    total = sum(cell.winding * cell.polygon.area for cell in found)
    assert total == pytest.approx((x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)


def test_loops_in_a_row_touch_from_inside():
    """A flower: eight inner loops hang on the outline of one cell, which passes through eight crossings twice."""
    t = 2 * np.pi * (np.arange(800) + 0.5) / 800
    z = 4 * np.exp(1j * t) + 0.6 * np.exp(9j * t)
    points = np.stack([z.real, z.imag], axis=1)
    found = coverage(points)
    assert sorted((len(cell.polygon.interiors), cell.winding) for cell in found) == [(0, 2)] * 8 + [(8, 1)]
    rows = sorted((cell.polygon.area, cell.polygon.length, cell.winding) for cell in found)
    np.testing.assert_allclose(rows, by_geos(pf.arrange(points).curve.points), rtol=1e-6)


def test_needles_are_kept():
    """Cells nearly as thin as rounding errors."""
    strip = np.array([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1e-17), (0, 1e-17)])
    found = coverage(strip)
    assert [cell.winding for cell in found] == [1, 1, 2, 1]
    assert sorted(cell.polygon.area for cell in found) == pytest.approx([1e-17, 3e-17, 3, 16])


def test_nothing_to_cover_but_one_cell():
    (only,) = coverage([(0, 0), (1, 0), (0, 1)])
    assert (only.polygon.area, only.winding) == (0.5, 1)


def as_turned(cells, turned):
    return sorted((-winding if turned else winding, float(size)) for winding, size in cells)


@settings(max_examples=150, deadline=None)
@given(touching_outlines())
def test_cells_of_drawings_that_touch(outline):
    found, turned = directed_coverage(outline)
    assert all(cell.polygon.is_valid for cell in found)
    rows = sorted((cell.winding, cell.polygon.area) for cell in found)
    expected = as_turned(cells_by_slabs(outline.loops), turned)
    assert [row[0] for row in rows] == [row[0] for row in expected]
    np.testing.assert_allclose([row[1] for row in rows], [row[1] for row in expected], rtol=1e-9)
    whole = shapely.union_all([cell.polygon for cell in found])
    assert whole.area == pytest.approx(sum(row[1] for row in rows))


@settings(max_examples=100, deadline=None)
@given(touching_outlines(), st.sampled_from([1 / 3, 0.1, 1e5 + 0.3]))
def test_no_area_is_lost_where_contacts_are_nearly_broken(outline, scale):
    """Scaled by what is no power of two, crossings fall apart by less than rounding errors."""
    drawn = pf.Outline([loop * scale for loop in outline.loops])
    found, turned = directed_coverage(drawn)
    total = Counter()
    for winding, size in as_turned(cells_by_slabs(drawn.loops), turned):
        total[winding] += size
    for cell in found:
        assert cell.polygon.is_valid
        total[cell.winding] -= cell.polygon.area
    assert max(map(abs, total.values()), default=0) < 1e-12 * scale * scale


NEAR = 1 + 2**-52
# Strands so near to each other that rounding their crossings makes ever more of them.
CROWDED = [
    [[(3, 0), (1, 3 * NEAR), (1, 1), (4, 5 * NEAR)], [(1, NEAR), (4, 5), (1, 1)]],
    [[(1e-16, 3 * NEAR), (-1e-17, 3), (4, 4), (1, 0)], [(4, 2), (-1e-17, 3 * NEAR), (4, 1)]],
]


@st.composite
def nearly_coincident(draw):
    """One to three loops on a small grid, whose coordinates are the doubles beside whole numbers, too."""
    numbers = st.integers(0, 5).flatmap(lambda n: st.sampled_from([n, n, np.nextafter(n, 9), np.nextafter(n, -9)]))
    return draw(st.lists(st.lists(st.tuples(numbers, numbers), min_size=3, max_size=6), min_size=1, max_size=3))


@settings(max_examples=100, deadline=None)
@example(CROWDED[0])
@example(CROWDED[1])
@given(nearly_coincident())
def test_no_area_is_lost_between_strands_a_few_roundings_apart(loops):
    assume(are_loops(loops))
    wound = sum(map(polygon_area, loops))
    cells, turned = directed_coverage(pf.Outline(loops))
    positive, negative = pf.decompose(pf.Outline(loops), signed=True)
    assert all(polygon.is_valid for polygon in [*positive, *negative, *(cell.polygon for cell in cells)])
    assert sum(cell.winding * cell.polygon.area for cell in cells) == pytest.approx(
        -wound if turned else wound, abs=1e-9
    )
    assert sum(p.area for p in positive) - sum(p.area for p in negative) == pytest.approx(wound, abs=1e-9)
    assert pf.fill(pf.Outline(loops)).area == pytest.approx(sum(cell.polygon.area for cell in cells), abs=1e-9)


def polygon_area(points):
    x, y = np.array(points, dtype=float).T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


@pytest.mark.parametrize("kind", ["turned", "mirrored", "shifted start"])
def test_crowds_have_the_same_cells_in_every_position(kind):
    points = np.random.default_rng(5).integers(0, 6, (60, 2))
    moved = {"turned": points @ [(0, 1), (-1, 0)], "mirrored": points * (-1, 1), "shifted start": np.roll(points, 7, 0)}
    cells, others = (directed_coverage(drawn) for drawn in (points, moved[kind]))
    flip = (cells[1] != others[1]) != (kind == "mirrored")
    rows, other_rows = (
        sorted((cell.winding * sign, round(cell.polygon.area, 9)) for cell in found)
        for found, sign in ((cells[0], 1), (others[0], -1 if flip else 1))
    )
    assert rows == other_rows


def test_a_polygon_that_is_spoiled_is_named():
    bow = shapely.Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
    with pytest.raises(PrecisionError) as caught:
        refuse_invalid(np.array([bow], dtype=object), np.zeros((1, 2)))
    assert caught.value.where == ((0.5, 0.5),)


def test_the_position_of_a_drawing_decides_about_the_order_of_its_cells_alone():
    """Equal points are seen before crossings are looked for; without them cells come in the order of arrangements."""
    general = random_curves.random_polygon(np.random.default_rng(3), 12)
    assert not has_equal_points(np.array(general, dtype=np.float64))
    assert has_equal_points(np.array([(0.5, 1), (2, 3), (0.5, 1)]))
    drawn = pf.arrange(general)
    assert [cell.winding for cell in coverage(general)] == [w for w in drawn.winding.tolist() if w]
