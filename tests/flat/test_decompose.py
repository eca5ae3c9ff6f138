"""Simple pieces: valid, and together they cover every place as often as the curve winds round it."""

import math
import sys

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

import plyfold as pf
from coarse import CURVES
from plyfold.errors import InputError, NotImmersibleError, PrecisionError
from plyfold.flat.decompose import decompose
from plyfold.gallery import ribbon
from reference import random_curves
from reference.fills import cells_by_slabs
from touching import touching_outlines

# Found to be the least by hand: one more than the places where the ribbon must be cut, or what a deep cell needs.
PIECES = {"circle": 1, "horseshoe": 2, "exit-ramp": 2, "two-loops": 3, "knotted-ribbon": 2, "pentagram": 2}


def winding_numbers(points, places):
    """By adding up angles."""
    z = (np.asarray(points)[None] - places[:, None]) @ np.array([1, 1j])
    return np.round(np.angle(np.roll(z, -1, axis=1) / z).sum(axis=1) / (2 * math.pi)).astype(int)


def signed_area(points):
    x, y = np.asarray(points, dtype=np.float64).T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def disks():
    for name, named in CURVES.items():
        if named.immersions:
            yield pytest.param(named.curve.points, id=name)
    for seed in range(8):
        rng = np.random.default_rng(seed)
        yield pytest.param(np.array(random_curves.glued_disk(rng, 40), dtype=np.float64), id=f"glued disk {seed}")
        yield pytest.param(np.array(random_curves.ribbon_outline(rng, 150), dtype=np.float64), id=f"ribbon {seed}")


@pytest.mark.parametrize("points", list(disks()))
def test_covers_the_disk_once(points):
    drawn = pf.arrange(points)
    places = np.random.default_rng(1).uniform(points.min(axis=0), points.max(axis=0), (400, 2))
    for immersion in list(pf.immersions(drawn))[:3]:
        pieces = decompose(drawn, immersion)
        for piece in pieces:
            assert piece.is_valid
            assert piece.exterior.is_simple
            assert piece.exterior.is_ccw
            assert len(piece.interiors) == 0
        covered = sum(shapely.contains_xy(piece, places) for piece in pieces)
        assert covered.tolist() == np.abs(winding_numbers(points, places)).tolist()
        assert sum(piece.area for piece in pieces) == pytest.approx(abs(signed_area(points)))
        corners = {corner for piece in pieces for corner in piece.exterior.coords}
        assert corners == set(map(tuple, drawn.curve.points.tolist()))


@pytest.mark.parametrize("name", PIECES)
def test_few_pieces(name):
    assert len(decompose(CURVES[name].curve)) == PIECES[name]


def test_never_fewer_than_the_depth_nor_as_many_as_triangles():
    for name in ("stacked-spiral", "milnor", "ten-gon", "bennequin"):
        drawn = pf.arrange(CURVES[name].curve)
        assert drawn.winding.max() <= len(decompose(drawn)) <= drawn.winding.max() + 2


def test_overlaps_that_no_crossing_sides_show(monkeypatch):
    """Sides of triangles that are no edges of the curve cross here: they are looked for, and the pieces are simple."""
    points = [(0, 0), (-776, 256), (-495, -467), (1000, 0), (500, 1000), (-987, 197), (-987, 106), (-538, 294)]
    module = sys.modules["plyfold.flat.decompose"]
    found = []
    look = module._overlaps
    monkeypatch.setattr(module, "_overlaps", lambda *given: found.append(look(*given)) or found[-1])
    pieces = decompose(points)
    assert len(found) == 1
    assert len(pieces) == 2
    assert all(piece.is_valid for piece in pieces)
    assert sum(piece.area for piece in pieces) == pytest.approx(signed_area(points))


def test_thousands_of_crossings():
    """A long ribbon, with crossings between far parts of it."""
    points = np.array(random_curves.ribbon_outline(np.random.default_rng(5), 3000, wildness=0.1), dtype=np.float64)
    drawn = pf.arrange(points)
    assert drawn.n_crossings > 1000
    pieces = decompose(drawn)
    assert all(piece.is_valid for piece in pieces)
    assert sum(piece.area for piece in pieces) == pytest.approx(signed_area(points))
    assert len(pieces) < drawn.n_crossings / 4


def test_a_spiral_of_many_turns_is_settled_at_once(monkeypatch):
    """Cuts move on from turn to turn, but overlaps with the next turn are looked for at the same time."""
    t = np.linspace(0, 10 * math.pi, 800)
    radius = 4 + 0.2 * t / t[-1] + 0.1 * np.sin((6 + 5**0.5) * t)
    points = ribbon(np.stack([radius * np.cos(t), radius * np.sin(t)], axis=1), 1.2)
    module = sys.modules["plyfold.flat.decompose"]
    look, found = module._overlaps, []
    monkeypatch.setattr(module, "_overlaps", lambda *given: found.append(look(*given)) or found[-1])
    pieces = decompose(points)
    assert len(found) <= 2
    assert len(pieces) == 6
    assert all(piece.is_valid for piece in pieces)
    assert sum(piece.area for piece in pieces) == pytest.approx(abs(signed_area(points)))


def test_polygons_that_cannot_be_mended_are_refused(monkeypatch):
    """None is valid, though no two triangles of one piece overlap; those of neighbouring pieces do."""
    monkeypatch.setattr(shapely, "is_valid", lambda polygons: np.zeros(len(polygons), dtype=bool))
    with pytest.raises(PrecisionError):
        decompose(CURVES["exit-ramp"].curve)


def test_bow_ties_are_no_disks():
    with pytest.raises(NotImmersibleError):
        decompose([(0, 0), (2, 2), (2, 0), (0, 2)])


def test_a_triangle_is_one_piece():
    (only,) = decompose([(0, 0), (1, 0), (0, 1)])
    assert only.equals(shapely.Polygon([(0, 0), (1, 0), (0, 1)]))


def test_clockwise():
    points = CURVES["exit-ramp"].curve.points
    assert all(piece.exterior.is_ccw for piece in decompose(points[::-1]))


# ---- any closed curve: signed ----------------------------------------------------------------------------------------


@settings(max_examples=80, deadline=None)
@given(touching_outlines())
def test_signed_polygons_add_up_to_winding_numbers(outline):
    lists = pf.decompose(outline, signed=True)
    for parts in lists:
        assert all(part.is_valid and len(part.interiors) == 0 for part in parts)
    places = np.random.default_rng(0).random((60, 2)) * 4
    covered = [sum(shapely.contains_xy(part, *places.T).astype(int) for part in parts) for parts in lists]
    assert (covered[0] - covered[1] == pf.winding_at(outline, places)).all()
    cells = cells_by_slabs(outline.loops)
    for parts, sign in zip(lists, (1, -1), strict=True):
        expected = float(sum(max(sign * winding, 0) * size for winding, size in cells))
        assert sum(part.area for part in parts) == pytest.approx(expected)


def test_signed_polygons_of_strands_that_cross_at_a_vertex():
    eight = [(0, 0), (2, 2), (4, 2), (4, 4), (2, 4), (2, 2), (2, 0)]
    positive, negative = pf.decompose(eight, signed=True)
    assert [part.area for part in positive] == [4]
    assert [part.area for part in negative] == [2]
    square = eight[1:-1]
    with pytest.raises(InputError, match="signed"):
        pf.decompose(square, pf.find_immersion(square), signed=True)


def test_holes_are_cut():
    """A ring with two holes, of which one touches the outline in a point."""
    plate = shapely.Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (4, 2), (3, 4)], [(9, 5), (7, 6), (7, 4)]])
    positive, negative = pf.decompose(plate, signed=True)
    assert all(part.is_valid and len(part.interiors) == 0 for part in positive)
    assert shapely.union_all(positive).equals(plate)
    assert sum(part.area for part in positive) == pytest.approx(plate.area)
    assert 2 <= len(positive) <= 6
    assert negative == []
