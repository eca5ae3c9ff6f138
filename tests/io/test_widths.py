"""Lines of files that are given a width, and tracks from GPX."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import plyfold as pf
from plyfold.errors import FileFormatError, InputError
from plyfold.io.gpx import shapes_in_gpx
from plyfold.io.reading import read_contents
from plyfold.io.widths import Wide

LINE = [(0.0, 0.0), (9.0, 0.0), (9.0, 6.0), (4.0, 6.0), (4.0, -5.0)]
HEIGHTS = [0.0, 0.0, 1.0, 1.0, 2.0]
RIBBON = pf.ribbon(LINE, 2).points.tolist()


def npy(points):
    file = io.BytesIO()
    np.save(file, points)
    return file.getvalue()


def rows(separator, points):
    return separator.join(" ".join(map(str, point)) for point in points)


FLAT = {
    "line.csv": rows("\n", LINE),
    "line.npy": npy(LINE),
    "line.wkt": f"LINESTRING ({rows(', ', LINE)})",
    "line.geojson": f'{{"type": "LineString", "coordinates": {list(map(list, LINE))}}}',
    "points.json": str(list(map(list, LINE))),
    "strokes.json": f'{{"strokes": [{list(map(list, LINE))}]}}',
}
RAISED = [(*point, z) for point, z in zip(LINE, HEIGHTS, strict=True)]
WITH_HEIGHTS = {
    "line.csv": rows("\n", RAISED),
    "line.npy": npy(RAISED),
    "line.wkt": f"LINESTRING Z ({rows(', ', RAISED)})",
    "line.geojson": f'{{"type": "LineString", "coordinates": {list(map(list, RAISED))}}}',
    "points.json": str(list(map(list, RAISED))),
}


def written(folder, name, content):
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize("name", FLAT)
def test_lines_of_every_format_become_ribbons(name, tmp_path):
    path = written(tmp_path, name, FLAT[name])
    assert pf.read(path, width=2).points.tolist() == RIBBON
    mitred = pf.ribbon(LINE, 2, "mitre", "square")
    assert pf.read(path, width=2, join_style="mitre", cap_style="square").points.tolist() == mitred.points.tolist()


@pytest.mark.parametrize("name", WITH_HEIGHTS)
def test_heights_are_kept_for_lines_and_left_out_of_outlines(name, tmp_path):
    path = written(tmp_path, name, WITH_HEIGHTS[name])
    outline, ribbon = read_contents(path, wide=Wide(2.0)).outline_and_ribbon()
    assert outline.points.tolist() == RIBBON
    assert outline.repairs == ()
    assert ribbon.heights.min() == 0
    assert ribbon.heights.max() == 2


NO_HEIGHT = "all heights left out, for this point has none"


@pytest.mark.parametrize(
    ("name", "content", "place"),
    [
        ("a.wkt", "LINESTRING Z (0 0 1, 9 0 NaN, 9 9 3, 3 -5 2)", (9, 0)),
        ("a.wkt", "MULTILINESTRING Z ((0 0 1, 9 0 2), (0 5 NaN, 9 5 NaN))", (0, 5)),
        (
            "a.wkt",
            "GEOMETRYCOLLECTION Z (LINESTRING Z (0 0 1, 9 0 2), POLYGON Z ((20 5 1, 9 5 1, 9 7 1, 20 5 1)))",
            (20, 5),
        ),
        ("a.csv", "0 0 1\n9 0 2\n9 9 nan", (9, 9)),
        ("a.geojson", '{"type": "LineString", "coordinates": [[0, 0, 1], [9, 0, 2], [9, 9]]}', (9, 9)),
    ],
)
def test_where_a_height_is_missing_all_are_left_out_and_it_is_said(name, content, place, tmp_path):
    outline, ribbon = read_contents(written(tmp_path, name, content), wide=Wide(1.0)).outline_and_ribbon()
    assert ribbon is None
    assert [repair.where for repair in outline.repairs if repair.kind == NO_HEIGHT] == [place]


@pytest.mark.parametrize(
    ("name", "content"),
    [("a.wkt", "LINESTRING Z (0 0 1, 9 0 inf, 9 9 3)"), ("a.csv", "0 0 1\n9 0 -inf\n9 9 3")],
)
def test_infinite_heights_are_errors(name, content, tmp_path):
    with pytest.raises(InputError, match=r"height of point 1 is not finite, at \(9, 0\)"):
        read_contents(written(tmp_path, name, content), wide=Wide(1.0)).outline_and_ribbon()


@pytest.mark.parametrize(("said", "tips"), [("", 0), ("5", 1), ("1.5", 0), ("0.5", 0), ("many", 0)])
def test_mitres_are_as_long_as_the_svg_lets_them(said, tips, tmp_path):
    """At this bend the mitre is 4.4 widths long; the format's limit is 4, and limits below 1 are none."""
    limit = f'stroke-miterlimit="{said}"' if said else ""
    text = f'<svg><g {limit}><path d="M0 0H30L1 13.5" fill="none" stroke="red" stroke-width="2"/></g></svg>'
    outline = pf.read(written(tmp_path, "mitre.svg", text), width="auto")
    assert (outline.points[:, 0] > 31).sum() == tips


def test_a_line_that_ends_where_it_starts_is_a_ring(tmp_path):
    square = [(0, 0), (9, 0), (9, 9), (0, 9), (0, 0)]
    ring = [loop.tolist() for loop in pf.ribbon(square, 2).loops]
    for name, content in [
        ("a.csv", rows("\n", square)),
        ("a.wkt", f"LINESTRING ({rows(', ', square)})"),
        ("a.svg", '<svg><path d="M0 0H9V-9H0Z" fill="none" stroke="red" stroke-linejoin="round"/></svg>'),
    ]:
        assert [loop.tolist() for loop in pf.read(written(tmp_path, name, content), width=2).loops] == ring


def test_several_lines_are_several_ribbons_and_polygons_stay(tmp_path):
    text = "GEOMETRYCOLLECTION Z (LINESTRING Z (0 0 1, 9 0 1), LINESTRING Z (3 -5 0, 3 5 0))"
    outline, ribbon = read_contents(written(tmp_path, "two.wkt", text), wide=Wide(2.0)).outline_and_ribbon()
    assert outline.n_loops == 2
    assert ribbon.faces.max() == 7
    assert set(ribbon.heights.tolist()) == {0, 1}
    mixed = "LINESTRING (0 0, 9 0)\nPOLYGON ((20 0, 24 0, 20 3, 20 0))"
    contents = read_contents(written(tmp_path, "mixed.wkt", mixed), wide=Wide(2.0))
    outline, ribbon = contents.outline_and_ribbon()
    assert ribbon is None
    assert [len(loop) for loop in outline.loops] == [4, 3]
    assert len(pf.io.read_each(tmp_path / "two.wkt", width=1)) == 2


SVG = """<svg xmlns="http://www.w3.org/2000/svg"><g transform="scale(2)">
<path d="M0 0H10" stroke="red" stroke-width="3" stroke-linecap="square"/>
<path d="M0 20H10" fill="none" stroke="none"/></g>
<path d="M50 0H60V-10Z"/></svg>"""


def test_strokes_of_an_svg_have_their_own_width(tmp_path):
    path = written(tmp_path, "strokes.svg", SVG)
    outline = pf.read(path, width="auto")
    # A square cap at both ends, all of it doubled; the path without a stroke is an open line beside loops.
    assert sorted(outline.loops[0].tolist()) == [[-3, -3], [-3, 3], [23, -3], [23, 3]]
    assert [repair.kind for repair in outline.repairs] == ["open line left out"]
    assert len(outline.loops[1]) == 3
    by_number = pf.read(path, width=1, cap_style="flat")
    assert by_number.n_loops == 3
    assert sorted(by_number.loops[0].tolist()) == [[0, -0.5], [0, 0.5], [20, -0.5], [20, 0.5]]


@pytest.mark.parametrize(
    ("name", "content", "options", "words"),
    [
        ("a.csv", "0 0\n9 0", {"width": "auto"}, "no line in it has a width"),
        ("a.csv", "0 0\n9 0", {"width": "wide"}, "'auto' for that of the file"),
        ("a.csv", "0 0\n9 0", {"width": -1}, "-1 wide"),
        ("a.csv", "0 0\n9 0", {"cap_style": "round"}, "give a width"),
        ("a.csv", "0 0\n9 0", {"width": 1, "join_style": "miter"}, "join_style is"),
        ("a.wkt", "POLYGON ((0 0, 4 0, 0 3, 0 0))", {"width": 1}, "no line that could have a width"),
        ("a.csv", "x,y,loop\n0,0,a\n9,0,a\n0,9,a", {"width": 1}, "no line that could have a width"),
        ("a.csv", "x,y,cusp\n0,0,0\n9,0,1\n0,9,0", {"width": 1}, "cusps at a line"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", {"width": 1}, "has no lines"),
        ("a.csv", "0 0\n9 0\n0 0.1", {"width": 8}, "a.csv: a bend of the line is too tight"),
    ],
)
def test_what_has_no_width_says_so(name, content, options, words, tmp_path):
    with pytest.raises(InputError, match=words):
        pf.read(written(tmp_path, name, content), **options)


# ---- GPX -------------------------------------------------------------------------------------------------------------


def gpx(points, kind="trkpt"):
    """A track of (lat, lon, height or None)."""
    heights = ("" if z is None else f"<ele> {z} </ele>" for _, _, z in points)
    marks = (
        f'<{kind} lat="{lat}" lon="{lon}">{ele}</{kind}>' for (lat, lon, _), ele in zip(points, heights, strict=True)
    )
    inner = "".join(marks)
    inner = f"<trk><name>way home</name><trkseg>{inner}</trkseg></trk>" if kind == "trkpt" else f"<rte>{inner}</rte>"
    return f'<?xml version="1.0"?>\n<gpx xmlns="http://www.topografix.com/GPX/1/1">{inner}</gpx>'.encode()


def on_the_sphere(one, other):
    """The distance along a great circle of a ball as large as the earth."""
    (a, b), (c, d) = np.radians([one, other])
    half = np.sin((c - a) / 2) ** 2 + np.cos(a) * np.cos(c) * np.sin((d - b) / 2) ** 2
    return 2 * 6_371_000 * np.arcsin(np.sqrt(half))


@given(st.floats(-80, 80), st.floats(-180, 180), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2))
def test_metres_are_those_of_the_earth(lat, lon, north, east):
    far = (lat + north, lon + east)
    if np.hypot(north, east) < 1e-3 or abs(far[1]) > 180:
        return
    [shape] = shapes_in_gpx(gpx([(lat, lon, None), (*far, None)]))
    line = np.asarray(shape.loops[0].points)
    # The earth is flattened by a three-hundredth.
    assert np.hypot(*(line[1] - line[0])) == pytest.approx(on_the_sphere((lat, lon), far), rel=0.01)
    assert (line[1] - line[0]) @ [far[1] - lon, far[0] - lat] > 0


def test_tracks_and_routes_with_heights(tmp_path):
    points = [(47.0 + y / 1e4, 8.0 + x / 1e4, 400 + z) for x, y, z in RAISED]
    for kind, name in (("trkpt", "way home"), ("rtept", "")):
        contents = read_contents(written(tmp_path, "a.gpx", gpx(points, kind)), wide=Wide(9.0))
        assert [contents.name(0), len(contents)] == [name, 1]
        _, ribbon = contents.outline_and_ribbon()
        assert ribbon.heights.max() == 402
        assert pf.bounds_disk(ribbon.outline)
    some = [(*points[0][:2], None), *points[1:]]
    outline, ribbon = read_contents(written(tmp_path, "b.gpx", gpx(some)), wide=Wide(9.0)).outline_and_ribbon()
    assert ribbon is None
    assert [repair.kind for repair in outline.repairs if "all" in repair.kind] == [NO_HEIGHT]


def test_without_a_width_a_track_is_a_stroke(tmp_path):
    points = [(0, 0, 5), (0, 0.001, 5), (0.001, 0, 5), (0, 0, 5)]
    curve = pf.read(written(tmp_path, "a.gpx", gpx(points)))
    assert len(curve) == 3
    assert [repair.kind for repair in curve.repairs] == ["z left out"]


def test_the_date_line_is_no_border():
    [shape] = shapes_in_gpx(gpx([(0, 179.999, None), (0, -179.999, None)]))
    line = np.asarray(shape.loops[0].points)
    assert (line[1] - line[0])[0] == pytest.approx(222.6, abs=0.1)


def test_waypoints_are_left_out_and_empty_segments_passed_over():
    text = (
        b'<gpx><wpt lat="0" lon="0"/><trk><trkseg/></trk><trk><trkseg><trkpt lat="0" lon="0"/>'
        b'<trkpt lat="0" lon="0.001"/></trkseg><trkseg><trkpt lat="0.001" lon="0"/><trkpt lat="0.001" lon="0.001"/>'
        b"</trkseg></trk></gpx>"
    )
    [shape] = shapes_in_gpx(text)
    assert len(shape.loops) == 2
    assert [repair.kind for repair in shape.repairs] == ["point left out"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (b'<!DOCTYPE gpx [<!ENTITY a "b">]><gpx/>', "document type"),
        (b'<!DOCTYPE gpx SYSTEM "file:///etc/passwd"><gpx/>', "document type"),
        (b"<gpx><trk>", "line 1: broken XML"),
        (b"<gpx>&nothing;</gpx>", "broken XML"),
        (b'<?xml version="1.0" encoding="klingon"?><gpx/>', "broken XML"),
        (b"<kml/>", "no GPX: its root is <kml>"),
        (b"<gpx/>", "no track and no route"),
        (gpx([(0, "east", None)]), r"^line 2: 'east' is no lon of a point\n  hint: a GPX file has"),
        (gpx([(91, 0, None)]), "line 2: there is no place on a map"),
        (gpx([("nan", 0, None)]), "is no lat"),
        (gpx([(0, 0, "high")]), "'high' is no height"),
        (gpx([(0, 0, None), (0, 90, None)]), "too far for one plane"),
        (b"<gpx>" + b"<a>" * 100_000, "broken XML"),
    ],
)
def test_what_is_no_gpx_says_why(text, words):
    with pytest.raises(FileFormatError, match=words):
        shapes_in_gpx(text)
