"""Drawings of any size: the same answers, or an error that says that it is too small or too large."""

import numpy as np
import pytest
import shapely

import plyfold as pf
from plyfold.errors import CurveError, InputError, PrecisionError

RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
BOW = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
# A ring of cloth, whose hole is cut open where it is made of simple polygons.
FRAME = [[(0, 0), (6, 0), (6, 6), (0, 6)], [(1, 1), (1, 4), (5, 3)]]
DRAWINGS = [RAMP, BOW, EIGHT, FRAME]
EXPONENTS = [-1000, -520, -500, -300, 300, 480]


def scaled(outline, exponent):
    loops = outline if isinstance(outline[0], list) else [outline]
    return [np.ldexp(np.array(loop, dtype=float), exponent) for loop in loops]


def polygons_of(outline):
    """All that functions make polygons of."""
    positive, negative = pf.decompose(outline, signed=True)
    return [
        [cell.polygon for cell in pf.coverage(outline)],
        list(pf.fill(outline, "evenodd").geoms),
        positive,
        negative,
    ]


def areas(polygons, exponent=0):
    """Areas of polygons, made larger, in order."""
    larger = [shapely.transform(polygon, lambda places: np.ldexp(places, -exponent)) for polygon in polygons]
    assert all(polygon.is_valid for polygon in larger)
    return sorted(polygon.area for polygon in larger)


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("outline", DRAWINGS)
def test_polygons(outline, exponent):
    if exponent < -505:
        for function in (pf.coverage, pf.fill, lambda drawing: pf.decompose(drawing, signed=True)):
            with pytest.raises(PrecisionError, match="too small for polygons") as refused:
                function(scaled(outline, exponent))
            assert refused.value.where
            assert "scale it up" in refused.value.hint
        return
    for found, expected in zip(polygons_of(scaled(outline, exponent)), polygons_of(outline), strict=True):
        # How a hole is cut open may depend on the unit.
        assert sum(areas(found, exponent)) == pytest.approx(sum(areas(expected)), rel=1e-12)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_pieces_of_disks(exponent):
    for outline in (RAMP, BOW):
        if exponent < -505:
            with pytest.raises(PrecisionError, match="too small for polygons"):
                pf.decompose(scaled(outline, exponent))
        else:
            assert areas(pf.decompose(scaled(outline, exponent)), exponent) == areas(pf.decompose(outline))


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("outline", DRAWINGS)
def test_what_is_not_measured_is_told_of_any_size(outline, exponent):
    places = np.random.default_rng(0).uniform(0, 6, (40, 2))
    larger, pixels = scaled(outline, exponent), np.array([0.75, 0.25, 0, -0.25, 0.75, 1])
    assert pf.winding_at(larger, np.ldexp(places, exponent)).tolist() == pf.winding_at(outline, places).tolist()
    mask = pf.coverage_mask(larger, (8, 8), np.ldexp(pixels, exponent))
    assert mask.tolist() == pf.coverage_mask(outline, (8, 8), pixels).tolist()
    if pf.find_immersion(outline):
        assert pf.triangulate(larger).tolist() == pf.triangulate(outline).tolist()


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_repairs(exponent):
    """Shares of areas, also of those that are no doubles."""
    tiny_loop = [(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)]
    found, expected = pf.repair(scaled(tiny_loop, exponent)), pf.repair(tiny_loop)
    assert (found.region_change, found.layer_change) == (expected.region_change, expected.layer_change)
    assert pf.repair(scaled(EIGHT, exponent)).value == {"region": 0.5, "layers": 0.5}


@pytest.mark.parametrize("size", [2.0**1000, 1e300])
@pytest.mark.parametrize(
    "function",
    [pf.coverage, pf.fill, pf.decompose, pf.triangulate, pf.lift, pf.repair, pf.map_disk, pf.find_immersion],
)
def test_too_large(function, size):
    with pytest.raises(CurveError, match="has a coordinate beyond") as refused:
        function(size * np.array(RAMP))
    assert refused.value.where


@pytest.mark.parametrize("size", [2.0**-1000, 1e-300])
@pytest.mark.parametrize("function", [pf.lift, pf.map_disk])
def test_too_small_for_meshes(function, size):
    with pytest.raises(PrecisionError, match="too small for a mesh"):
        function(size * np.array(RAMP))


def test_flat_pixels_are_told_exactly():
    with pytest.raises(InputError, match="flattens"):
        pf.coverage_mask(BOW, (2, 2), (1e-200, 2e-200, 0, 3e-200 / 3, 2e-200, 0))
    assert pf.coverage_mask(BOW, (2, 2), (1e-200, 0, 0, 0, 1e-200, 0)).shape == (2, 2)


@pytest.mark.parametrize("exponent", [-300, -540, -700, -1000])
def test_places_of_crossings(exponent):
    for outline in (RAMP, EIGHT):
        places = np.ldexp(pf.arrange(scaled(outline, exponent)).crossings, -exponent)
        assert places.tolist() == pf.arrange(outline).crossings.tolist()
