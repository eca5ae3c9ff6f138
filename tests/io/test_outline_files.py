"""Outlines written and read back: the same loops, in the same directions, with the same cusps."""

import json

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.errors import FileFormatError, InputError

FORMATS = ["json", "geojson", "wkt", "svg", "csv"]
SQUARE = [(0, 0), (9, 0), (9, 9), (0, 9)]
HOLE = [(2, 2), (2, 4), (4, 4), (4, 2)]
BESIDE = [(20, 0), (29, 0), (25, 9)]

coordinates = st.one_of(
    st.integers(-20, 20).map(float), st.floats(-1e150, 1e150), st.floats(-1e-3, 1e-3), st.sampled_from([0.1, 1e-320])
)
polylines = st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=7)


def curve_of(points):
    try:
        return pf.Curve(points)
    except InputError:
        return None


loops = polylines.map(curve_of).filter(lambda curve: curve is not None)


@st.composite
def outlines(draw, cusps=True):
    curves = draw(st.lists(loops, min_size=1, max_size=4))
    index = [draw(st.lists(st.sampled_from([0, 0, 0, 1, 2]), min_size=len(c), max_size=len(c))) for c in curves]
    if len(curves) == 1:
        return pf.Curve(curves[0].points, cusps=index[0] if cusps else None)
    return pf.Outline([curve.points for curve in curves], index if cusps else None)


def assert_same(found, expected):
    assert type(found) is type(expected)
    assert [loop.tolist() for loop in found.loops] == [loop.tolist() for loop in expected.loops]
    assert [index.tolist() for index in found.cusps] == [index.tolist() for index in expected.cusps]
    assert found.repairs == ()


@pytest.mark.parametrize("ending", FORMATS)
@given(outline=outlines(cusps=False))
@settings(max_examples=150, deadline=None)
def test_loops_are_read_back(tmp_path_factory, ending, outline):
    path = tmp_path_factory.mktemp("saved") / f"outline.{ending}"
    pf.save(outline, path)
    assert_same(pf.read(path), outline)


@pytest.mark.parametrize("ending", ["json", "geojson", "svg", "csv"])
@given(outline=outlines())
@settings(max_examples=100, deadline=None)
def test_cusps_are_read_back(tmp_path_factory, ending, outline):
    path = tmp_path_factory.mktemp("saved") / f"outline.{ending}"
    pf.save(outline, path)
    assert_same(pf.read(path), outline)


@pytest.mark.parametrize("ending", FORMATS)
def test_loops_drawn_twice_stay_two(tmp_path, ending):
    outline = pf.Outline([SQUARE, SQUARE])
    pf.save(outline, tmp_path / f"twice.{ending}")
    assert_same(pf.read(tmp_path / f"twice.{ending}"), outline)


def test_wkt_has_no_place_for_cusps(tmp_path):
    with pytest.raises(InputError, match="no place for the cusps") as caught:
        pf.save(pf.Curve(SQUARE, cusps=[0, 1, 0, 0]), tmp_path / "cusp.wkt")
    assert ".geojson" in caught.value.hint
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("given_loops", "kind"),
    [
        ([SQUARE], "Polygon"),
        ([[(0, 0), (9, 9), (9, 0), (0, 9)]], "LineString"),
        ([SQUARE, HOLE], "Polygon"),
        ([SQUARE, HOLE, BESIDE], "MultiPolygon"),
        ([HOLE, SQUARE], "MultiLineString"),
        ([SQUARE, HOLE[::-1]], "MultiLineString"),
        ([SQUARE, [(5, 5), (5, 14), (14, 5)]], "MultiLineString"),
    ],
)
def test_geometries_are_polygons_where_others_take_them_for_some(tmp_path, given_loops, kind):
    pf.save(given_loops, tmp_path / "out.geojson")
    pf.save(given_loops, tmp_path / "out.wkt")
    shape = shapely.geometry.shape(json.loads((tmp_path / "out.geojson").read_text())["geometry"])
    assert shape.geom_type == kind
    assert shape.equals_exact(shapely.from_wkt((tmp_path / "out.wkt").read_text()))
    assert shape.is_valid


def test_shapely_polygons_are_saved(tmp_path):
    ring = shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2)
    pf.save(ring, tmp_path / "ring.json")
    outline = pf.read(tmp_path / "ring.json")
    assert outline.n_loops == 2
    assert pf.arrange(outline).winding.tolist() == [0, 1, 0]


def test_a_picture_shows_all_of_it(tmp_path):
    pf.save([np.array(SQUARE) - 100.0, np.array(HOLE) - 100.0], tmp_path / "far.svg")
    text = (tmp_path / "far.svg").read_text()
    assert 'viewBox="-100.45 90.55 9.9 9.9"' in text
    assert text.count("<path") == 1


@pytest.mark.parametrize("name", ["out", "out.txt", "out.glb", "out.SVGZ"])
def test_unknown_endings(tmp_path, name):
    with pytest.raises(InputError, match="cannot be written as"):
        pf.save(SQUARE, tmp_path / name)


def test_existing_files_stay(tmp_path):
    path = tmp_path / "out.json"
    path.write_text("precious")
    with pytest.raises(FileExistsError):
        pf.save(SQUARE, path)
    assert path.read_text() == "precious"
    pf.save(SQUARE, path, force=True)
    assert len(pf.read(path)) == 4


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("later.json", '{"version": 3, "loops": [[[0, 0], [4, 0], [0, 3]]]}'),
        ("other.json", '{"version": 99, "sheets": []}'),
        ("page.json", '{"plyfold": 3, "strokes": []}'),
        ("later.svg", '<svg data-plyfold="3"><path d="M0 0L4 0L0 3Z"/></svg>'),
    ],
)
def test_files_of_a_version_to_come(tmp_path, name, content):
    (tmp_path / name).write_text(content)
    with pytest.raises(FileFormatError, match=r"of version \d+, and this plyfold reads versions up to 2") as caught:
        pf.read(tmp_path / name)
    assert "newer plyfold" in caught.value.hint


def test_files_without_a_version_are_read_as_before(tmp_path):
    for content in ('{"points": [[0, 0], [4, 0], [0, 3]], "version": 7}', '{"loops": [[[0, 0], [4, 0], [0, 3]]]}'):
        (tmp_path / "old.json").write_text(content)
        assert len(pf.read(tmp_path / "old.json")) == 3
