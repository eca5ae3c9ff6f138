"""Files with several loops: what belongs together, which way round it runs, and what is left out, with a word."""

import io
import json

import numpy as np
import pytest

import plyfold as pf
from plyfold.errors import CurveError, FileFormatError, StrokeError

SQUARE = [[0, 0], [9, 0], [9, 9], [0, 9]]
HOLE = [[2, 2], [4, 2], [4, 4], [2, 4]]
FAR = [[20, 0], [29, 0], [25, 9]]


def ring(points):
    return [*points, points[0]]


def loops(outline):
    return [loop.astype(int).tolist() for loop in outline.loops]


def said(outline):
    return [str(repair) for repair in outline.repairs]


# ---- GeoJSON and WKT -------------------------------------------------------------------------------------------------

TURNED = [HOLE[0], *HOLE[:0:-1]]


def geometry(kind, coordinates):
    return json.dumps({"type": kind, "coordinates": coordinates})


@pytest.mark.parametrize("shell", [SQUARE, [SQUARE[0], *SQUARE[:0:-1]]])
@pytest.mark.parametrize("hole", [HOLE, TURNED])
def test_shells_run_counter_clockwise_and_holes_clockwise_whatever_the_file_says(read, shell, hole):
    outline = read("ring.geojson", geometry("Polygon", [ring(shell), ring(hole)]))
    assert loops(outline) == [SQUARE, TURNED]
    text = ", ".join("(" + ", ".join(f"{x} {y}" for x, y in ring(points)) + ")" for points in (shell, hole))
    assert loops(read("ring.wkt", f"POLYGON ({text})")) == loops(outline)
    assert said(outline) == []


@pytest.mark.parametrize("points", [SQUARE, SQUARE[::-1]])
def test_a_polygon_alone_runs_as_it_stands(read, points):
    assert isinstance(read("one.geojson", geometry("Polygon", [ring(points)])), pf.Curve)
    assert read("one.geojson", geometry("Polygon", [ring(points)])).points.tolist() == points
    assert read("one.wkt", f"POLYGON (({', '.join(f'{x} {y}' for x, y in ring(points))}))").points.tolist() == points


def test_a_multipolygon_is_one_outline(read):
    outline = read("multi.geojson", geometry("MultiPolygon", [[ring(SQUARE), ring(HOLE)], [ring(FAR[::-1])]]))
    assert loops(outline) == [SQUARE, TURNED, [FAR[2], FAR[0], FAR[1]]]
    with pytest.raises(FileFormatError, match="no shape 1 in it"):
        read("multi.geojson", geometry("MultiPolygon", [[ring(SQUARE)], [ring(FAR)]]), index=1)


def feature(coordinates, **more):
    return {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": coordinates}, **more}


COLLECTION = json.dumps(
    {
        "type": "FeatureCollection",
        "features": [
            feature([ring(SQUARE), ring(HOLE)], id="house"),
            feature([ring(FAR)], id=7, properties={"cusps": {"0:2": 1}}),
        ],
    }
)


def test_a_collection_is_one_outline_or_one_of_it_is_chosen(read, tmp_path):
    assert loops(read("all.geojson", COLLECTION)) == [SQUARE, TURNED, FAR]
    assert loops(read("all.geojson", COLLECTION, index=0)) == [SQUARE, TURNED]
    assert loops(read("all.geojson", COLLECTION, id="7")) == [FAR]
    assert [outline.n_loops for outline in pf.io.read_each(tmp_path / "all.geojson")] == [2, 1]
    with pytest.raises(FileFormatError, match="nothing in it has the id 'barn'") as caught:
        read("all.geojson", COLLECTION, id="barn")
    assert caught.value.hint == "it has house, 7"
    assert [index.tolist() for index in read("all.geojson", COLLECTION).cusps][2] == [0, 0, 1]


def test_points_beside_polygons_are_left_out_with_a_word(read):
    content = {"type": "GeometryCollection", "geometries": [{"type": "MultiPoint", "coordinates": [[1, 2], [3, 4]]}]}
    content["geometries"].append({"type": "Polygon", "coordinates": [ring(SQUARE)]})
    outline = read("points.geojson", json.dumps(content))
    assert said(outline) == ["point left out at (1, 2)", "point left out at (3, 4)"]
    assert loops(outline) == [SQUARE]


def test_lines_are_loops_if_they_end_where_they_start(read):
    assert loops(read("lines.geojson", geometry("MultiLineString", [ring(SQUARE), ring(HOLE)]))) == [SQUARE, HOLE]
    mixed = {"type": "GeometryCollection", "geometries": [json.loads(geometry("LineString", [[0, 0], [50, 0]]))]}
    mixed["geometries"].append(json.loads(geometry("LineString", ring(SQUARE))))
    outline = read("mixed.geojson", json.dumps(mixed))
    assert loops(outline) == [SQUARE]
    assert said(outline) == ["open line left out at (0, 0), size 50"]
    with pytest.raises(StrokeError) as caught:
        read("open.geojson", geometry("MultiLineString", [SQUARE, HOLE]))
    assert "where each line is a loop of its own, repeat its first point" in caught.value.hint


@pytest.mark.parametrize("hole", [[[2, 2], [4, 4], [3, 3]], [[2, 2], [2, 2], [2, 2]], [[2, 2], [4, 2], [4, 4], [4, 2]]])
def test_holes_without_area_are_left_out_with_a_word(read, hole):
    outline = read("flat.geojson", geometry("Polygon", [ring(SQUARE), ring(hole)]))
    assert loops(outline) == [SQUARE]
    assert said(outline) == ["loop without area left out at (2, 2)"]


def test_a_file_with_nothing_but_flat_loops_says_what_is_wrong(read):
    with pytest.raises(CurveError, match=r"flat\.geojson: none of the 2 loops has an area"):
        read("flat.geojson", geometry("MultiPolygon", 2 * [[ring([[2, 2], [4, 4], [3, 3]])]]))


def test_several_geometries_on_lines_of_their_own(read):
    text = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))\nPOLYGON ((20 0, 29 0, 25 9, 20 0))\n"
    assert loops(read("two.wkt", text)) == [SQUARE, FAR]
    assert loops(read("two.wkt", text, index=1)) == [FAR]
    folded = "GEOMETRYCOLLECTION (\n POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0)),\n POLYGON ((20 0, 29 0,\n 25 9, 20 0))\n)"
    assert loops(read("two.wkt", folded)) == [SQUARE, FAR]


@pytest.mark.parametrize(
    "cusps", [{"1:1": 2}, ["1:1x2"], [[0, 0, 0, 0], [0, 2, 0, 0]], [[0, 0, 0, 0, 0], [0, 2, 0, 0, 0]]]
)
def test_cusps_of_rings_are_counted_as_the_file_has_them_and_turned_with_them(read, cusps):
    """The hole is turned, and its point 1 is then the last."""
    content = feature([ring(SQUARE), ring(HOLE)], properties={"cusps": cusps})
    outline = read("cusp.geojson", json.dumps(content))
    assert [index.tolist() for index in outline.cusps] == [[0, 0, 0, 0], [0, 0, 0, 2]]
    assert outline.loops[1][3].tolist() == HOLE[1]


# ---- JSON ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("cusps", [{"0:2": 1}, ["2"], [0, 0, 1], [[0, 0, 1]]])
@pytest.mark.parametrize("content", [{"loops": [FAR]}, {"points": FAR}])
def test_cusps_in_json(read, content, cusps):
    curve = read("cusp.json", json.dumps(content | {"cusps": cusps}))
    assert curve.cusps[0].tolist() == [0, 0, 1]


@pytest.mark.parametrize(
    ("cusps", "complaint"),
    [
        ({"1:0": 1}, "no point 1:0 in its 1 loop"),
        ({"0:3": 1}, "no point 0:3"),
        ({"0:1": 1.5}, "whole number from 0 up, not 1.5"),
        ({"0:1": -1}, "whole number from 0 up, not -1"),
        ({"0:1": True}, "whole number from 0 up, not True"),
        ({"-1": 1}, "'-1' is no cusp"),
        (["one"], "'one' is no cusp"),
        ([[0, 0, 1], [1]], "not understood"),
        ([0, 0, 0, 0, 1], "no point 0:4"),
        (3, "not understood: 3"),
    ],
)
def test_cusps_that_are_none(refused, cusps, complaint):
    refused("cusp.json", json.dumps({"loops": [FAR], "cusps": cusps}), complaint)


def test_closed_strokes_are_loops(read):
    for content in ([ring(SQUARE), ring(HOLE)], {"strokes": [ring(SQUARE), ring(HOLE)]}, {"loops": [SQUARE, HOLE]}):
        assert loops(read("two.json", json.dumps(content))) == [SQUARE, HOLE]
    # Of strokes that make one loop together, some may be closed, as before.
    petals = {"strokes": [[[0, 0], [4, 0]], [[4, 0], [8, -1], [8, 1], [4, 0]], [[4, 0], [2, 5], [0, 0]]]}
    assert isinstance(read("one.json", json.dumps(petals)), pf.Curve)


def test_documents_of_the_page(read):
    strokes = [{"points": SQUARE, "closed": True}, {"points": FAR, "closed": True}, {"points": [], "closed": False}]
    strokes[1]["cusps"] = {"0": 1}
    outline = read("page.json", json.dumps({"plyfold": 2, "strokes": strokes}))
    assert loops(outline) == [SQUARE, FAR]
    assert outline.cusps[1].tolist() == [1, 0, 0]
    strokes[1] = {"points": FAR, "closed": False}
    with pytest.raises(StrokeError, match="the end of stroke"):
        read("page.json", json.dumps({"plyfold": 2, "strokes": strokes[:2]}))


@pytest.mark.parametrize("lines", [[], 3, [3]])
def test_loops_that_are_none(read, lines):
    with pytest.raises(FileFormatError, match=r"no loop|not a list of lists"):
        read("none.json", json.dumps({"loops": lines}))


# ---- tables ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "0 0\n9 0\n9 9\n0 9\n0 0\n\n20 0\n29 0\n25 9\n20 0\n",
        "x,y,loop\n0,0,0\n9,0,0\n9,9,0\n0,9,0\n20,0,1\n29,0,1\n25,9,1\n",
        "x;y;loop\n0;0;outer\n9;0;outer\n9;9;outer\n0;9;outer\n20;0;b\n29;0;b\n25;9;b\n",
        "X, Y, Loop, cusp\n0,0,a,0\n9,0,a,0\n9,9,a,0\n\n0,9,a,0\n20,0,b,0\n29,0,b,0\n25,9,b,0\n",
    ],
)
def test_tables_of_several_loops(read, text):
    assert loops(read("two.csv", text)) == [SQUARE, FAR]


def test_cusps_in_tables(read):
    curve = read("cusp.csv", "x,y,cusp\n0,0,0\n9,0,2\n9,9,0\n")
    assert curve.cusps[0].tolist() == [0, 2, 0]
    blocks = "x,y,cusp\n0,0,0\n9,0,0\n9,9,1\n0,0,0\n\n20,0,0\n29,0,3\n25,9,0\n20,0,0\n"
    assert [index.tolist() for index in read("cusps.csv", blocks).cusps] == [[0, 0, 1], [0, 3, 0]]
    altitude = read("high.csv", "x,y,z,cusp\n0,0,5,0\n9,0,5,2\n9,9,5,0\n")
    assert altitude.cusps[0].tolist() == [0, 2, 0]
    assert said(altitude) == ["z left out at (0, 0)"]


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("x,y,loop\n0,0,a\n9,0,a\n9,9,b\n0,9,a\n", "line 5: loop 'a' goes on after another one"),
        ("x,y,cusp\n0,0,0\n9,0,-1\n9,9,0\n", "line 3: '-1' is no index of a cusp"),
        ("x,y,cusp\n0,0,0\n9,0,0.5\n9,9,0\n", "line 3: '0.5' is no index"),
        ("x,y,loop\n0,0,0\n9,0\n9,9,0\n", "line 3: 2 numbers, where line 1 has 3"),
        ("x,y,loop\n0;5,0,0\n", "line 2: 4 numbers, where line 1 has 3"),
        ("x,y,cusp\n0,0,1\n9,0,0\n\n9,0,0\n9,9,0\n\n9,9,0\n0,0,0\n", "cusps at strokes"),
    ],
)
def test_tables_that_are_broken(refused, text, complaint):
    refused("broken.csv", text, complaint)


def test_a_stack_of_arrays(read):
    file = io.BytesIO()
    np.save(file, np.array([SQUARE, HOLE]))
    assert loops(read("stack.npy", file.getvalue())) == [SQUARE, HOLE]


# ---- SVG -------------------------------------------------------------------------------------------------------------


def svg(body, attributes=""):
    return f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{body}</svg>'


def d(*parts):
    return "".join("M" + "L".join(f"{x},{-y}" for x, y in points) + "Z" for points in parts)


def test_all_shapes_are_one_outline_or_one_of_them_is_chosen(read, tmp_path):
    content = svg(f'<path id="a" d="{d(SQUARE, HOLE)}"/><g id="g"><path d="{d(FAR)}"/></g>')
    assert loops(read("all.svg", content)) == [SQUARE, HOLE, FAR]
    assert loops(read("all.svg", content, id="a")) == [SQUARE, HOLE]
    assert loops(read("all.svg", content, id="g")) == [FAR]
    assert loops(read("all.svg", content, index=1)) == [FAR]
    assert [loops(outline) for outline in pf.io.read_each(tmp_path / "all.svg")] == [[SQUARE, HOLE], [FAR]]
    for index in (2, -1, True, 0.5):
        with pytest.raises(FileFormatError, match=r"all\.svg: there is no shape .* in it"):
            read("all.svg", content, index=index)


def test_open_paths_are_left_out_with_a_word(read):
    content = svg(f'<path d="{d(SQUARE)} M0 0 L30 40"/><line x1="5" y1="5" x2="8" y2="9"/>')
    outline = read("open.svg", content)
    assert loops(outline) == [SQUARE]
    assert said(outline) == ["open line left out at (0, 0), size 50", "open line left out at (5, -5), size 5"]


def test_texts_and_pictures_are_left_out_with_a_word(read):
    inside = f'<text x="3" y="4">hello</text><image href="x.png" width="3" height="4"/><path id="p" d="{d(SQUARE)}"/>'
    content = svg(f'<g transform="translate(10 20)">{inside}</g><path id="far" d="{d(FAR)}"/>')
    outline = read("text.svg", content)
    assert outline.n_loops == 2
    assert said(outline) == ["text left out at (13, -24)", "picture left out at (10, -20)"]
    assert said(read("text.svg", content, id="far")) == []


@pytest.mark.parametrize("attributes", ['fill-rule="evenodd"', 'style="fill-rule: evenodd"'])
@pytest.mark.parametrize("where", ["path", "svg"])
def test_even_odd_loops_are_turned_by_their_depth(read, attributes, where):
    island = [[25, 25], [35, 25], [35, 35], [25, 35]]
    big, middle = ((np.array(SQUARE) * size + shift).tolist() for size, shift in ((10, 0), (5, 10)))
    path = f'<path {attributes if where == "path" else ""} d="{d(big[::-1], middle, island)}"/>'
    outline = read("depth.svg", svg(path, attributes if where == "svg" else ""))
    assert [plane_area(loop) > 0 for loop in outline.loops] == [True, False, True]
    assert said(outline) == [
        "loop turned round (even-odd) at (0, 90)",
        "loop turned round (even-odd) at (10, 10)",
    ]
    assert pf.arrange(outline).winding.min() == 0


@pytest.mark.parametrize("far", [FAR, FAR[::-1]])
@pytest.mark.parametrize("hole", [HOLE, HOLE[::-1]])
def test_even_odd_loops_run_as_the_other_shapes_do(read, far, hole):
    """A rectangle runs clockwise in a picture whose y points up, and is painted the same by both rules."""
    paths = f'<path fill-rule="evenodd" d="{d(SQUARE, hole)}"/><path d="{d(far)}"/>'
    outline = read("beside.svg", svg(paths))
    way = np.sign(plane_area(np.array(far)))
    assert [np.sign(plane_area(loop)) for loop in outline.loops] == [way, -way, way]
    assert pf.arrange(outline).winding.min() == 0
    assert loops(outline)[2] == far


def plane_area(points):
    x, y = points.T
    return x @ np.roll(y, -1) - y @ np.roll(x, -1)


def test_even_odd_loops_that_cross_keep_their_direction_and_the_repairs_say_so(read):
    outer, one = [[0, 0], [200, 0], [200, 200], [0, 200]], [[50, 50], [100, 50], [100, 100], [50, 100]]
    other = [[80, 80], [150, 80], [150, 150], [80, 150]]
    outline = read("cross.svg", svg(f'<path fill-rule="evenodd" d="{d(outer[::-1], one, other[::-1])}"/>'))
    assert [plane_area(loop) > 0 for loop in outline.loops] == [True, True, False]
    kept = "direction kept (even-odd loops that meet)"
    assert said(outline) == ["loop turned round (even-odd) at (0, 200)", f"{kept} at (50, 50)", f"{kept} at (80, 150)"]


def test_nonzero_loops_and_single_ones_run_as_in_the_file(read):
    outline = read("nonzero.svg", svg(f'<path fill-rule="nonzero" d="{d(SQUARE[::-1], HOLE)}"/>'))
    assert loops(outline) == [SQUARE[::-1], HOLE]
    assert said(outline) == []
    alone = read("one.svg", svg(f'<path fill-rule="evenodd" d="{d(SQUARE[::-1])}"/>'))
    assert loops(alone) == [SQUARE[::-1]]
    assert said(alone) == []


def test_cusps_are_at_the_nodes_of_a_path(read):
    path = f'<path d="M0 0 C 60 90 -30 90 30 0 L 40 40 Z {d(FAR)}" data-cusps="2, 1:0x3"/>'
    for tolerance in (None, 0.001):
        outline = read("cusps.svg", svg(path), tolerance=tolerance)
        [place] = np.flatnonzero(outline.cusps[0])
        assert outline.loops[0][place].tolist() == [40, -40]
        assert outline.cusps[1].tolist() == [3, 0, 0]


def test_cusps_turn_with_even_odd_loops(read):
    path = f'<path fill-rule="evenodd" d="{d(SQUARE, HOLE)}" data-cusps="1:1"/>'
    outline = read("cusps.svg", svg(path))
    assert outline.loops[1][outline.cusps[1] > 0].tolist() == [HOLE[1]]
    assert plane_area(outline.loops[1]) < 0


@pytest.mark.parametrize(
    ("cusps", "complaint"), [("3", "has no node 0:3"), ("1:0", "no node 1:0"), ("x", "is no cusp")]
)
def test_cusps_that_a_path_does_not_have(read, cusps, complaint):
    with pytest.raises(FileFormatError, match=complaint):
        read("cusps.svg", svg(f'<path id="p" d="{d(FAR)}" data-cusps="{cusps}"/>'))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("place.geojson", {"type": "Feature", "geometry": None, "properties": {}}),
        ("empty.geojson", {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": []}, "properties": {}}),
        ("parts.geojson", {"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[]]}}),
    ],
)
def test_a_feature_that_draws_nothing_harms_no_other(read, name, text):
    content = {"type": "FeatureCollection", "features": [text, feature([ring(FAR)])]}
    assert loops(read(name, json.dumps(content))) == [FAR]


def test_lines_of_wkt_that_draw_nothing_harm_no_other(read):
    triangle = "POLYGON ((0 0, 4 0, 0 3, 0 0))"
    assert len(read("empty.wkt", f"{triangle}\nPOLYGON EMPTY")) == 3
    outline = read("point.wkt", f"POINT (7 7)\n{triangle}")
    assert said(outline) == ["point left out at (7, 7)"]
