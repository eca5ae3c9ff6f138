"""Fills, winding numbers and masks, against rays and slabs in fractions."""

from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.errors import InputError
from reference.fills import cells_by_slabs, is_on, winding_by_ray
from touching import touching_outlines

RULES = {
    "nonzero": lambda w: w != 0,
    "evenodd": lambda w: w % 2 != 0,
    "positive": lambda w: w > 0,
    "negative": lambda w: w < 0,
}
SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]


@settings(max_examples=150, deadline=None)
@given(touching_outlines(), st.sampled_from([1, 0.1, 1e5 + 0.3]))
def test_fills_have_the_areas_of_slabs(outline, scale):
    drawn = pf.Outline([loop * scale for loop in outline.loops])
    cells = cells_by_slabs(drawn.loops)
    for rule, paints in RULES.items():
        found = pf.fill(drawn, rule)
        assert found.is_valid
        assert found.area == pytest.approx(float(sum(size for w, size in cells if paints(w))), abs=1e-12 * scale**2)


@settings(max_examples=100, deadline=None)
@given(touching_outlines())
def test_layers_add_up(outline):
    cells = cells_by_slabs(outline.loops)
    most = max((w for w, _ in cells), default=0)
    layers = [pf.fill(outline, at_least=j).area for j in range(1, most + 2)]
    assert layers[-1:] == ([0] if most >= 0 else [])
    assert sum(layers) == pytest.approx(float(sum(max(w, 0) * size for w, size in cells)))


@settings(max_examples=100, deadline=None)
@given(touching_outlines())
def test_fills_cut_nothing_inside(outline):
    """They are the union of themselves, and no two parts have a side in common."""
    found = pf.fill(outline)
    merged = shapely.unary_union(found)
    assert merged.equals(found)
    assert shapely.get_num_geometries(found) == shapely.get_num_geometries(merged) or merged.is_empty


def test_a_crowd_is_filled_like_the_union_of_its_cells():
    points = np.random.default_rng(3).integers(0, 10, (300, 2))
    found = pf.fill(points)
    cells = [cell.polygon for cell in pf.coverage(points)]
    assert found.is_valid
    assert found.area == pytest.approx(sum(cell.area for cell in cells))
    assert len(shapely.get_coordinates(found)) < len(shapely.get_coordinates(cells)) / 4


def test_what_a_rule_and_a_layer_may_be():
    with pytest.raises(InputError, match="no fill rule"):
        pf.fill(SQUARE, "odd")
    for wrong in (0, -1, 1.5, True):
        with pytest.raises(InputError, match="at_least"):
            pf.fill(SQUARE, at_least=wrong)
    assert pf.fill(SQUARE, at_least=2).is_empty
    assert pf.fill(SQUARE, at_least=np.int64(1)).area == 4


def test_a_pinch_and_a_neck():
    pinch = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
    assert [part.area for part in pf.fill(pinch).geoms] == [1, 1]
    keyhole = [(0, 0), (9, 0), (9, 9), (4, 9), (4, 6), (6, 3), (3, 3), (4, 6), (4, 9), (0, 9)]
    (ring,) = pf.fill(keyhole).geoms
    assert len(ring.interiors) == 1
    assert ring.area == 81 - 4.5


# ---- winding numbers -------------------------------------------------------------------------------------------------

HALVES = [(x / 2, y / 2) for x in range(-1, 10) for y in range(-1, 10)]


@settings(max_examples=100, deadline=None)
@given(touching_outlines())
def test_winding_numbers_are_those_of_rays(outline):
    expected = [winding_by_ray(outline.loops, *place) for place in HALVES]
    assert pf.winding_at(outline, HALVES, on_outline="right").tolist() == expected
    off = [not is_on(outline.loops, *place) for place in HALVES]
    places = np.array(HALVES)
    assert pf.winding_at(outline, places[off]).tolist() == np.array(expected)[off].tolist()
    with pytest.raises(InputError) as caught:
        pf.winding_at(outline, places)
    assert set(caught.value.where) == set(map(tuple, places[~np.array(off)].tolist()))


def test_winding_numbers_beyond_rounding():
    """Places one ulp from an edge on either side."""
    drawn = [(0, 0), (3, 1), (0, 1)]
    x = np.nextafter(0.3, [0, 1])
    places = np.stack([x, [0.1, 0.1]], axis=1)
    expected = [winding_by_ray([drawn], *place) for place in places.tolist()]
    assert pf.winding_at(drawn, places).tolist() == expected == [1, 0]


def test_one_place_and_many_dimensions():
    assert pf.winding_at(SQUARE, (1, 1)).shape == ()
    assert pf.winding_at(SQUARE, (1, 1)) == 1
    assert pf.winding_at(SQUARE, np.empty((0, 2))).shape == (0,)
    with pytest.raises(InputError, match="on_outline"):
        pf.winding_at(SQUARE, (1, 1), on_outline="left")


# ---- masks -----------------------------------------------------------------------------------------------------------

TRANSFORMS = [
    None,
    (0.5, 0, -0.5, 0, 0.5, -0.25),
    (1, 0, -0.5, 0, -1, 4.5),
    (-0.5, 0, 5, 0, 0.25, 0.125),
    (0.5, -0.5, 2, 0.5, 0.5, -1.5),
    (1 / 3, 0, -1 / 3, 0, 1 / 3, 0.1),
]


@settings(max_examples=120, deadline=None)
@given(touching_outlines(), st.sampled_from(TRANSFORMS))
def test_masks_are_those_of_rays(outline, transform):
    mask = pf.coverage_mask(outline, (9, 11), transform)
    assert mask.dtype == np.int32
    a, b, c, d, e, f = transform or (1, 0, 0, 0, 1, 0)
    for row in range(9):
        for column in range(11):
            u, v = column + 0.5, row + 0.5
            place = (a * u + (b * v + c), d * u + (e * v + f)) if b or d else (a * u + c, e * v + f)
            assert mask[row, column] == winding_by_ray(outline.loops, *place)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(1, 8), st.integers(1, 8)), min_size=1, max_size=5, unique=True))
def test_neighbours_share_no_pixel_and_leave_none_out(inner):
    """A rectangle cut into triangles, with corners at the centres of pixels."""
    corners = np.array([(0, 0), (9, 0), (9, 9), (0, 9), *inner]) + 0.5
    triangles = shapely.get_parts(shapely.delaunay_triangles(shapely.multipoints(corners)))
    masks = [pf.coverage_mask(triangle, (10, 10)) for triangle in triangles]
    expected = np.zeros((10, 10), dtype=int)
    expected[:9, :9] = 1
    assert (sum(masks) == expected).all()


def test_a_mask_is_the_picture_of_an_affine_map():
    top_down = pf.coverage_mask([(0, 0), (3, 0), (0, 3)], (3, 4), (1, 0, 0, 0, -1, 3, 0, 0, 1))
    assert top_down.tolist() == [[0, 0, 0, 0], [1, 0, 0, 0], [1, 1, 0, 0]]
    assert pf.coverage_mask(SQUARE, (0, 3)).shape == (0, 3)


@pytest.mark.parametrize("transform", [(1, 0, 0, 0, 1), (1, 0, 0, 1, 0, 0), (1, 0, np.nan, 0, 1, 0), range(9)])
def test_transforms_that_are_none(transform):
    with pytest.raises(InputError, match="transform"):
        pf.coverage_mask(SQUARE, (2, 2), transform)


def test_shapes_that_are_none():
    for shape in [(2,), (2, -1), (2.5, 2)]:
        with pytest.raises(InputError, match="shape"):
            pf.coverage_mask(SQUARE, shape)


def test_rays_in_fractions_know_a_square():
    """The reference itself, by hand."""
    assert [winding_by_ray([SQUARE], *place) for place in [(1, 1), (0, 0), (2, 1), (1, 2), (0, 1), (1, 0)]] == [
        1, 1, 0, 0, 1, 1,
    ]  # fmt: skip
    assert cells_by_slabs([SQUARE, SQUARE[::-1]]) == []
    assert cells_by_slabs([SQUARE, SQUARE]) == [(2, Fraction(4))]


def test_a_rule_and_a_least_winding_number_exclude_each_other():
    with pytest.raises(InputError, match="in the place of a rule"):
        pf.fill([(0, 0), (2, 0), (1, 1)], "evenodd", at_least=1)
