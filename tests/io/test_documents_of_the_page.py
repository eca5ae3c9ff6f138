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


def test_closed_strokes_are_loops_with_their_cusps(tmp_path):
    hole = {"points": [[5, 4], [7, 4], [6, 2]], "closed": True, "cusps": {"2": 1}}
    strokes = [{"points": RAMP, "closed": True}, hole]
    outline = read(tmp_path / "drawing.json", {"plyfold": 2, "strokes": strokes})
    assert [loop.tolist() for loop in outline.loops] == [RAMP, hole["points"]]
    assert outline.cusps[1].tolist() == [0, 0, 1]


def test_open_strokes_beside_loops_make_one_loop_more(tmp_path):
    parts = [{"points": RAMP[:6], "closed": False}, {"points": [*RAMP[5:], RAMP[0]], "closed": False}]
    loop = {"points": [[20, 0], [25, 0], [22, 3]], "closed": True}
    outline = read(tmp_path / "drawing.json", {"plyfold": 2, "strokes": [parts[0], loop, parts[1]]})
    assert [len(points) for points in outline.loops] == [3, len(RAMP)]


def test_cusps_at_open_strokes_are_not_dropped_without_a_word(tmp_path):
    stroke = {"points": RAMP, "closed": False, "cusps": {"1": 1}}
    with pytest.raises(FileFormatError, match="cusps at strokes"):
        read(tmp_path / "drawing.json", {"plyfold": 2, "strokes": [stroke]})


def test_documents_of_a_later_version_are_refused(tmp_path):
    with pytest.raises(FileFormatError, match="version 3"):
        read(tmp_path / "drawing.json", {"plyfold": 3, "strokes": []})


@pytest.mark.parametrize("points", [None, 5, "no", {"x": 1}, [1, 2], [[0], [1, 2]], [["a", 1]], [[10**400, 1]]])
def test_strokes_without_points_are_refused(tmp_path, points):
    with pytest.raises(FileFormatError, match=r"points that are not \[x, y\]"):
        read(tmp_path / "drawing.json", {"plyfold": 2, "strokes": [{"points": points, "closed": True}]})


def test_large_doubles_are_written_without_a_point(tmp_path):
    """As JavaScript does: the number is the shortest that means this double."""
    points = [[1000000414370802200, 0], [2000000414370802200, 0], [0, 1e18]]
    document = {"plyfold": 1, "strokes": [{"points": points, "closed": True}]}
    assert read(tmp_path / "drawing.json", document).points[0, 0] == 1000000414370802200.0


@pytest.mark.parametrize("strokes", [None, 3, ["no stroke"]])
def test_what_is_no_document(tmp_path, strokes):
    with pytest.raises(FileFormatError, match="document of the sketching page"):
        read(tmp_path / "drawing.json", {"plyfold": 1, "strokes": strokes})
