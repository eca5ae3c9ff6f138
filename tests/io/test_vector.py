import pytest

from plyfold.errors import CurveError, FileFormatError, StrokeError
from plyfold.io.shapes import outline_of_shapes
from plyfold.io.vector import shapes_in_wkt


def read_wkt(text):
    return outline_of_shapes(shapes_in_wkt(text))


TRIANGLE = [[0, 0], [4, 0], [0, 3]]


@pytest.mark.parametrize(
    "text",
    [
        "POLYGON ((0 0, 4 0, 0 3, 0 0))",
        "polygon((0 0,4 0,0 3,0 0))\n",
        " SRID=4326; POLYGON ((0 0, 4 0, 0 3, 0 0))",
        "POLYGON Z ((0 0 7, 4 0 8, 0 3 9, 0 0 7))",
        "LINEARRING (0 0, 4 0, 0 3, 0 0)",
        "LINESTRING (0 0, 4 0, 0 3, 0 0)",
        "MULTILINESTRING ((0 0, 4 0), (0 3, 4 0), (0 0, 0 3))",
        "MULTIPOLYGON (((0 0, 4 0, 0 3, 0 0)))",
        "GEOMETRYCOLLECTION (POLYGON ((0 0, 4 0, 0 3, 0 0)))",
    ],
)
def test_what_is_read(text):
    assert read_wkt(text).points.tolist() == TRIANGLE


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("POLYGON ((0 0, 4 0", FileFormatError, "broken WKT"),
        ("POLYGON ((0 0, 4 0, 0 3))", FileFormatError, "broken WKT"),
        ("LINESTRING (0 0)", FileFormatError, "broken WKT"),
        ("POLYGON ((0 0, 4 0, 0 3, 0 0)) and more", FileFormatError, "broken WKT"),
        ("GEOMETRYCOLLECTION (" * 100_000, FileFormatError, "collection in a collection"),
        ("POLYGON EMPTY", FileFormatError, "empty"),
        ("POINT (1 2)", FileFormatError, "points alone"),
        ("LINESTRING (0 0, 4 0, 0 3)", StrokeError, "largest gap"),
        ("LINESTRING (0 0, 4 0, 0 1e999, 0 0)", CurveError, "point 2 is not finite"),
        ("LINESTRING (0 0, 4 0, 0 1e308, 0 0)", CurveError, "point 2 has a coordinate beyond"),
        ("LINESTRING (0 0, 4 0, 0 nan, 0 0)", CurveError, "point 2 is not finite"),
    ],
)
def test_unusable_text(text, error, message):
    with pytest.raises(error, match=message):
        read_wkt(text)
