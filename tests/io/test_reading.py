import io
import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from plyfold import arrange, bounds_disk, count_immersions
from plyfold.errors import CurveError, FileFormatError
from plyfold.gallery import CURVES
from plyfold.io import reading
from plyfold.io.reading import read

TRIANGLE = [[0, 0], [4, 0], [0, 3]]
EXAMPLES = Path(__file__).parents[2] / "examples"


def npy():
    file = io.BytesIO()
    np.save(file, TRIANGLE)
    return file.getvalue()


CONTENT = {
    "svg": b'\n <svg><polygon points="0,0 4,0 0,-3"/></svg>',
    "csv": b"x,y\n0,0\n4,0\n0,3\n",
    "txt": b"\xef\xbb\xbf0 0\n4 0\n0 3\n",
    "npy": npy(),
    "json": b"\xef\xbb\xbf [[0, 0], [4, 0], [0, 3]]",
    "geojson": b'{"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [0, 3], [0, 0]]]}',
    "wkt": b"polygon ((0 0, 4 0, 0 3, 0 0))",
}


def standard_input(monkeypatch, data):
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(data)))


@pytest.mark.parametrize("kind", CONTENT)
@pytest.mark.parametrize("suffix", [None, ".txt", ".unknown", ""])
def test_formats_by_suffix_and_by_content(tmp_path, kind, suffix):
    path = tmp_path / f"loop{f'.{kind}' if suffix is None else suffix}"
    path.write_bytes(CONTENT[kind])
    assert read(path).points.tolist() == TRIANGLE
    assert read(str(path)).points.tolist() == TRIANGLE


@pytest.mark.parametrize("kind", CONTENT)
def test_standard_input(monkeypatch, kind):
    standard_input(monkeypatch, CONTENT[kind])
    assert read("-").points.tolist() == TRIANGLE


def test_standard_input_of_a_real_process():
    program = "from plyfold.io import read; print(read('-').points.tolist())"
    done = subprocess.run([sys.executable, "-c", program], input=CONTENT["csv"], capture_output=True, check=True)
    assert done.stdout.decode().strip() == str(np.array(TRIANGLE, dtype=float).tolist())


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("loop.svg", b"", "loop.svg: it is empty"),
        ("loop.txt", b" \n\n ", "loop.txt: it is empty"),
        ("loop.csv", b"0,0\n4,\xe9\n", "loop.csv: it is not text in UTF-8: byte 6"),
        ("loop.json", b"[", "loop.json: line 1: broken JSON"),
        ("loop.svg", b"0,0", "loop.svg: line 1: broken XML"),
        ("loop.npy", b"0,0", "loop.npy: it is no plain NPY"),
        ("loop.wkt", b"0,0", "loop.wkt: broken WKT"),
        ("loop.png", b"\x89PNG\r\n\x1a\n\0\0", "loop.png: its format is not known"),
        ("loop.svgz", b"\x1f\x8b\x08\x00\x00", "loop.svgz: its format is not known"),
        ("loop", b"hello world, this is prose\nof two lines", "loop: line 2"),
    ],
)
def test_unusable_files_are_named(tmp_path, name, data, message):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(FileFormatError, match=f"^{message}") as caught:
        read(tmp_path / name)
    assert caught.value.hint


def test_errors_of_the_curve_keep_their_class_and_place(tmp_path):
    path = tmp_path / "line.csv"
    path.write_text("0,0\n1,1\n2,2\n")
    with pytest.raises(CurveError, match=r"^line\.csv: all points lie on one line") as caught:
        read(path)
    assert caught.value.where == ((0, 0), (2, 2))


@pytest.mark.parametrize("name", ["", "missing.svg", "nul\0.svg", "x" * 5000])
def test_missing_files_and_folders(tmp_path, name):
    with pytest.raises(FileFormatError, match="cannot be read"):
        read(f"{tmp_path}/{name}")


@pytest.mark.parametrize("path", ["", "."])
def test_paths_without_a_name_are_quoted(path):
    with pytest.raises(FileFormatError, match=f"^'{re.escape(path)}': it cannot be read"):
        read(path)


@pytest.mark.skipif(os.name != "posix", reason="named pipes and endless devices")
def test_an_endless_file_is_cut_off(monkeypatch):
    monkeypatch.setattr(reading, "SIZE_LIMIT", 2**20)
    with pytest.raises(FileFormatError, match="larger than 1 MiB"):
        read("/dev/zero")


def test_too_large_files_are_refused_before_they_are_read(tmp_path, monkeypatch):
    path = tmp_path / "large.csv"
    with path.open("wb") as file:
        file.truncate(reading.SIZE_LIMIT + 1)
    monkeypatch.setattr(reading, "_limited", lambda file: pytest.fail("it was read"))
    with pytest.raises(FileFormatError, match=r"large\.csv: it is larger than 256 MiB"):
        read(path)


def test_too_large_standard_input(monkeypatch):
    monkeypatch.setattr(reading, "SIZE_LIMIT", 2**20)
    standard_input(monkeypatch, b"0,0\n" * 2**19)
    with pytest.raises(FileFormatError, match="standard input: it is larger than 1 MiB"):
        read("-")


def test_an_id_is_for_files_that_have_some(tmp_path):
    path = tmp_path / "loop.csv"
    path.write_bytes(CONTENT["csv"])
    with pytest.raises(FileFormatError, match="nothing in it has the id 'a'"):
        read(path, id="a")


def test_id_and_tolerance_reach_the_svg(tmp_path):
    path = tmp_path / "two.svg"
    path.write_text('<svg><circle id="a" r="5"/><circle id="b" r="7"/></svg>')
    coarse, fine = (read(path, id="b", tolerance=tolerance) for tolerance in (0.5, 0.005))
    assert np.hypot(*fine.points.T) == pytest.approx(7)
    assert len(fine) > 5 * len(coarse)


@pytest.mark.parametrize(("name", "crossings"), [("ramp", 4), ("spiral", 8), ("milnor", 6)])
@pytest.mark.parametrize("tolerance", [None, 0.01])
def test_the_examples_cross_themselves_as_often_as_drawn(name, crossings, tolerance):
    curve = read(EXAMPLES / f"{name}.svg", tolerance=tolerance)
    assert curve.repairs == ()
    assert crossing_count(curve.points) == crossings


def test_the_milnor_example_is_the_curve_of_the_gallery():
    """Its code, read from one of its visits on, is that of the gallery's; and it is smooth where that has corners."""
    drawn, known = arrange(read(EXAMPLES / "milnor.svg")), arrange(CURVES["milnor"].curve)
    assert code_from(known, 0) in [code_from(drawn, visit) for visit in range(12)]
    assert count_immersions(drawn) == 2
    edges = np.diff(drawn.curve.points, axis=0, append=drawn.curve.points[:1]) @ (1, 1j)
    assert np.degrees(np.abs(np.angle(np.roll(edges, -1) / edges))).max() < 15


def test_the_spiral_and_the_ramp_are_disks():
    assert bounds_disk(read(EXAMPLES / "spiral.svg"))
    assert bounds_disk(read(EXAMPLES / "ramp.svg"))


def code_from(arranged, start):
    steps = (start + np.arange(len(arranged.partner))) % len(arranged.partner)
    return [
        (int(p - s) % len(steps), bool(c))
        for s, p, c in zip(steps, arranged.partner[steps], arranged.ccw[steps], strict=True)
    ]


def crossing_count(points):
    edges = shapely.linestrings(np.stack([points, np.roll(points, -1, axis=0)], axis=1))
    first, second = shapely.STRtree(edges).query(edges, predicate="crosses")
    return int((first < second).sum())
