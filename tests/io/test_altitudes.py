"""A third coordinate is left out, and the repairs say so, wherever points come from."""

import json

import numpy as np
import pytest
import shapely

import plyfold as pf
from plyfold.errors import FileFormatError

FLAT = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]]
HIGH = [[0.0, 0.0, 7.0], [4.0, 0.0, 8.0], [4.0, 3.0, 9.0]]
RING = [*HIGH, HIGH[0]]
SAID = ["z left out at (0, 0)"]


def wkt(kind, rows):
    return f"{kind} (({', '.join(' '.join(map(str, row)) for row in rows)}))"


FILES = {
    "polygon.wkt": wkt("POLYGON Z", RING),
    "untagged.wkt": wkt("POLYGON", RING),
    "line.wkt": wkt("MULTILINESTRING Z", RING),
    "polygon.geojson": json.dumps({"type": "Polygon", "coordinates": [RING]}),
    "line.geojson": json.dumps({"type": "LineString", "coordinates": RING}),
    "lines.geojson": json.dumps({"type": "MultiLineString", "coordinates": [RING[:2], RING[1:]]}),
    "some.geojson": json.dumps({"type": "Polygon", "coordinates": [[*FLAT[:2], HIGH[2], FLAT[0]]]}),
    "more.geojson": json.dumps({"type": "LineString", "coordinates": [[*row, 1.0] for row in RING]}),
    "feature.geojson": json.dumps(
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [RING]}}
    ),
    "points.json": json.dumps(HIGH),
    "named.json": json.dumps({"points": HIGH}),
    "strokes.json": json.dumps({"strokes": [RING[:2], RING[1:]]}),
    "commas.csv": "0,0,7\n4,0,8\n4,3,9\n",
    "header.csv": "x,y,z\n0, 0, 7\n4, 0, 8\n4, 3, 9\n",
    "semicolons.csv": "x;y;ele\n0;0;7\n4;0;8\n4;3;nan\n",
    "blanks.txt": "0 0 7\n4 0 8\n4  3  9  # the last\n",
    "blocks.txt": "0 0 7\n4 0 8\n\n4 0 8\n4 3 9\n0 0 7\n",
}


@pytest.mark.parametrize("name", FILES)
def test_files(name, tmp_path):
    (tmp_path / name).write_text(FILES[name])
    curve = pf.read(tmp_path / name)
    assert [str(repair) for repair in curve.repairs] == SAID
    assert curve.points.tolist() == FLAT


@pytest.mark.parametrize("kind", [float, int, object])
def test_npy(kind, tmp_path):
    np.save(tmp_path / "high.npy", np.array(HIGH, dtype=float if kind is object else kind))
    assert [str(repair) for repair in pf.read(tmp_path / "high.npy").repairs] == SAID


@pytest.mark.parametrize(
    "value",
    [
        HIGH,
        RING,
        np.array(HIGH),
        np.array(HIGH, dtype=object),
        np.array([[0, 0, np.nan], [4, 0, np.inf], [4, 3, 1e300]]),
        [(0, 0, None), (4, 0, None), (4, 3, None)],
        np.ma.masked_array(HIGH, mask=[[0, 0, 1], [0, 0, 0], [0, 0, 0]]),
        shapely.Polygon(HIGH),
        shapely.LinearRing(HIGH),
        shapely.LineString(RING),
        shapely.MultiLineString([RING[:2], RING[1:]]),
        shapely.GeometryCollection([shapely.Polygon(HIGH)]),
    ],
)
def test_arrays_and_geometries(value):
    curve = pf.arrange(value).curve
    assert [str(repair) for repair in curve.repairs] == SAID
    assert curve.points.tolist() == FLAT


def test_strokes_say_it_once_and_first():
    strokes = [[*FLAT[:1], FLAT[1]], [HIGH[1], [4, 3, 0]], [[4, 2.9, 1], HIGH[0]]]
    repairs = pf.Curve.from_strokes(strokes).repairs
    assert [repair.kind for repair in repairs] == ["z left out", "gap bridged"]
    assert repairs[0].where == (4.0, 0.0)


def test_several_curves():
    surface = pf.find_embedding([HIGH, [[10.0, 10.0], [20.0, 10.0], [10.0, 20.0]]])
    assert surface


@pytest.mark.parametrize("words", ["POLYGON M", "POLYGON ZM"])
def test_measures(words, tmp_path):
    rows = [[*row[: len(words) - 7], 5.0] if "Z" in words else [*row[:2], 5.0] for row in RING]
    (tmp_path / "measured.wkt").write_text(wkt(words, rows))
    kinds = [repair.kind for repair in pf.read(tmp_path / "measured.wkt").repairs]
    assert kinds == (["z left out", "m left out"] if "Z" in words else ["m left out"])


def test_nothing_is_said_of_what_has_no_third_coordinate():
    assert pf.Curve(FLAT).repairs == ()
    assert pf.arrange(shapely.Polygon(FLAT)).curve.repairs == ()


def test_the_command_line_says_it(tmp_path, capsys):
    from plyfold.cli.commands import main

    (tmp_path / "high.csv").write_text(FILES["commas.csv"])
    assert main(["check", str(tmp_path / "high.csv")]) == 0
    assert "note: z left out at (0, 0)" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        ("1;2,5\n4,5;6\n7;8,5\n", "line 1: its numbers are separated in different ways"),
        ("0, 1,5\n2, 3,5\n4, 1,5\n", "line 1: its numbers are separated in different ways"),
        ("0,0,1\n4,0\n4,3,1\n", "line 2: 2 numbers, where line 1 has 3"),
        ("0,0\n4,0,1\n4,3,1\n", "line 2: 3 numbers, where line 1 has 2"),
        ("t,x,y\n0,0,0\n1,4,0\n2,4,3\n", "line 1: its columns are t, x, y"),
        ("y,x\n0,0\n4,0\n4,3\n", "line 1: its columns are y, x"),
        ("lat,lon,ele\n0,0,1\n4,0,1\n4,3,1\n", "line 1: its columns are lat, lon, ele"),
    ],
)
def test_tables_that_could_mean_something_else(content, complaint, tmp_path):
    (tmp_path / "table.csv").write_text(content)
    with pytest.raises(FileFormatError) as caught:
        pf.read(tmp_path / "table.csv")
    assert complaint in str(caught.value)
    assert caught.value.hint


@pytest.mark.parametrize("header", ["x,y,z", "X, Y, Z", "lon,lat,ele", "a,b,c"])
def test_headers_that_fit(header, tmp_path):
    (tmp_path / "table.csv").write_text(f"{header}\n0,0,1\n4,0,1\n4,3,1\n")
    assert pf.read(tmp_path / "table.csv").points.tolist() == FLAT
