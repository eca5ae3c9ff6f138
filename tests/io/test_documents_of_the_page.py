"""Documents that the sketching page has saved are drawings for everybody."""

import json

import pytest

import plyfold as pf
from plyfold.errors import FileFormatError

RAMP = [[0, 0], [9, 0], [9, 6], [3, 6], [3, -3], [4, -3], [4, 5], [8, 5], [8, 1], [0, 1]]


def read(path, document):
    path.write_text(json.dumps(document))
    return pf.read(path)


def test_a_loop(tmp_path):
    document = {"plyfold": 1, "strokes": [{"points": RAMP, "closed": True}]}
    assert read(tmp_path / "drawing.json", document).points.tolist() == RAMP


def test_strokes_are_joined(tmp_path):
    strokes = [{"points": RAMP[:6], "closed": False}, {"points": [*RAMP[5:], RAMP[0]], "closed": False}]
    assert len(read(tmp_path / "drawing.json", {"plyfold": 1, "strokes": strokes})) == len(RAMP)


def test_large_doubles_are_written_without_a_point(tmp_path):
    """As JavaScript does: the number is the shortest that means this double."""
    points = [[1000000414370802200, 0], [2000000414370802200, 0], [0, 1e18]]
    document = {"plyfold": 1, "strokes": [{"points": points, "closed": True}]}
    assert read(tmp_path / "drawing.json", document).points[0, 0] == 1000000414370802200.0


@pytest.mark.parametrize("strokes", [None, 3, ["no stroke"]])
def test_what_is_no_document(tmp_path, strokes):
    with pytest.raises(FileFormatError, match="document of the sketching page"):
        read(tmp_path / "drawing.json", {"plyfold": 1, "strokes": strokes})
