import json

import pytest

from plyfold.errors import CurveError, FileFormatError, InputError, StrokeError
from plyfold.io.json_points import shapes_in_json
from plyfold.io.shapes import outline_of_shapes


def read_json(text):
    return outline_of_shapes(shapes_in_json(text))


TRIANGLE = [[0, 0], [4, 0], [0, 3]]
STROKES = [[[0, 0], [4, 0]], [[0, 3], [4, 0]], [[0, 3], [0, 0]]]
RING = [*TRIANGLE, TRIANGLE[0]]


def polygon(*rings):
    return {"type": "Polygon", "coordinates": list(rings)}


@pytest.mark.parametrize(
    "value",
    [
        TRIANGLE,
        {"points": TRIANGLE},
        STROKES,
        [[], *STROKES],
        {"strokes": STROKES, "name": "loop"},
        polygon(RING),
        {"type": "LineString", "coordinates": RING},
        {"type": "MultiLineString", "coordinates": STROKES},
        {"type": "MultiPolygon", "coordinates": [[RING]]},
        {"type": "Feature", "properties": {}, "geometry": polygon(RING)},
        {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": polygon(RING)}]},
        {"type": "GeometryCollection", "geometries": [polygon(RING)]},
    ],
)
def test_what_is_read(value):
    curve = read_json(json.dumps(value))
    assert curve.points.tolist() == TRIANGLE
    assert curve.repairs == ()


def test_open_lines_are_strokes():
    curve = read_json(json.dumps({"type": "LineString", "coordinates": [*TRIANGLE, [0, 0.25]]}))
    assert [repair.size for repair in curve.repairs] == [0.25]
    for value in ({"type": "LineString", "coordinates": TRIANGLE}, {"strokes": [TRIANGLE]}):
        with pytest.raises(StrokeError):
            read_json(json.dumps(value))


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("[[0, 0],\n[4, 0]\n[0, 3]]", FileFormatError, "line 3: broken JSON"),
        ("{", FileFormatError, "line 1: broken JSON"),
        ("[" * 100_000, FileFormatError, "broken JSON"),
        ("[[" + "9" * 5000 + ", 0]]", FileFormatError, "broken JSON"),
        ("3", FileFormatError, "neither a list nor an object"),
        ('{"loop": []}', FileFormatError, "neither loops nor points nor strokes"),
        ('{"points": 3}', FileFormatError, r"not a list of \[x, y\]"),
        ('[{"x": 1, "y": 2}]', FileFormatError, r"not a list of \[x, y\]"),
        ('{"strokes": 3}', FileFormatError, "not a list of lists"),
        ('{"strokes": [3]}', FileFormatError, "not a list of lists"),
        ("[]", CurveError, "no points"),
        ("[[0, 0], [4, NaN], [0, 3]]", CurveError, "point 1 is not finite"),
        ("[[0, 0], [4, null], [0, 3]]", CurveError, "point 1 is not finite|not real numbers"),
        ("[[0, 0], [1e999, 0], [0, 3]]", CurveError, "point 1 is not finite"),
        ('[[0, 0], ["4", "0"], [0, 3]]', CurveError, "real numbers|text"),
        ("[[true, false], [false, true], [true, true]]", CurveError, "real numbers"),
        ("[[0, 0], [4], [0, 3]]", CurveError, "same length"),
        ('{"strokes": []}', StrokeError, "no stroke"),
        ("[[[0, 0], [1, 1]], 3]", FileFormatError, "not a list of lists"),
    ],
)
def test_broken_points(text, error, message):
    with pytest.raises(error, match=message) as caught:
        read_json(text)
    assert caught.value.hint


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (polygon(), "holds nothing"),
        ({"type": "Point", "coordinates": [0, 0]}, "but points alone"),
        ({"type": ["Polygon"]}, "is no line or polygon"),
        ({"type": "Circle", "coordinates": [0, 0]}, "'Circle' is no line or polygon"),
        ({"type": "Polygon"}, "list is missing"),
        ({"type": "Polygon", "coordinates": 3}, "list is missing"),
        ({"type": "Polygon", "coordinates": [[3, 4]]}, "list is missing"),
        ({"type": "Feature"}, "geometry is missing"),
        ({"type": "FeatureCollection", "features": []}, "the FeatureCollection holds nothing"),
        ({"type": "FeatureCollection", "features": [{}, {}]}, "'None' is no line or polygon"),
        ({"type": "MultiPolygon", "coordinates": []}, "holds nothing"),
    ],
)
def test_broken_geojson(value, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        read_json(json.dumps(value))
    assert caught.value.hint


def test_deeply_nested_geojson():
    text = '{"type": "Feature", "geometry": ' * 900 + "0" + "}" * 900
    with pytest.raises(InputError):
        read_json(text)
