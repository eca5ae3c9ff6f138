"""``plyfold batch`` and ``plyfold check FILE FILE …``: tables of the outlines in many files."""

import json
import os
import signal
import subprocess
import sys

import pytest
import shapely

from plyfold.cli.commands import main
from plyfold.errors import InputError, PlyfoldError
from plyfold.many.batch import batch_job
from plyfold.many.sources import chunks_of, files_in, outlines_in
from plyfold.tables.parts import write_table

TRIANGLE = [[0, 0], [4, 0], [0, 3]]
EIGHT = [[0, 0], [2, 2], [2, 0], [0, 2]]
FEATURE = {"type": "Feature", "id": "house", "geometry": {"type": "Polygon", "coordinates": [[*TRIANGLE, TRIANGLE[0]]]}}
SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path id="a" d="M0 0H9V9Z"/><path id="b" d="M0 0L2 2V0L0 2Z"/></svg>'


def a_folder(tmp_path):
    """Return a folder with drawings of several kinds, two of which are broken."""
    folder = tmp_path / "in"
    (folder / "deeper").mkdir(parents=True)
    (folder / "a.svg").write_text(SVG)
    (folder / "b.json").write_text(json.dumps(TRIANGLE))
    (folder / "c.json").write_text("[[0, 0], [1")
    (folder / "deeper" / "d.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [FEATURE] * 2}))
    (folder / "e.jsonl").write_text("\n".join(map(json.dumps, (TRIANGLE, EIGHT, FEATURE, [[0, 0], [1, 1]]))) + "\n\n")
    (folder / "notes.md").write_text("no drawing")
    return folder


def rows(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_a_folder_of_drawings_is_a_table(tmp_path, capsys):
    folder, out = a_folder(tmp_path), tmp_path / "out.jsonl"
    assert main(["batch", str(folder), "-o", str(out), "--workers", "1"]) == 2
    found = [(row["file"].removeprefix(f"{folder}/"), row["index"], row["id"], row["verdict"]) for row in rows(out)]
    assert found == [
        ("a.svg", 0, "a", "disk"),
        ("a.svg", 1, "b", "none"),
        ("b.json", 0, None, "disk"),
        ("c.json", -1, None, None),
        ("deeper/d.geojson", 0, "house", "disk"),
        ("deeper/d.geojson", 1, "house", "disk"),
        ("e.jsonl", 0, None, "disk"),
        ("e.jsonl", 1, None, "none"),
        ("e.jsonl", 2, "house", "disk"),
        ("e.jsonl", 3, None, None),
    ]
    assert [row["error"] for row in rows(out) if row["verdict"] is None] == [
        "c.json: line 1: broken JSON (expecting ',' delimiter)",
        "the curve has only 2 different point(s), at (0, 0), (1, 1)",
    ]
    printed = capsys.readouterr().out.split()
    assert printed[:6] == ["disk", "6", "none", "2", "error", "2"]


def test_several_processes_make_the_same_table(tmp_path):
    folder, outs = a_folder(tmp_path), [tmp_path / "one.csv", tmp_path / "two.csv"]
    for out, workers in zip(outs, "12", strict=True):
        main(["batch", str(folder), "-o", str(out), "--workers", workers, "--columns", "verdict,place,immersions"])
    assert outs[0].read_text() == outs[1].read_text()
    assert outs[0].read_text().splitlines()[0] == "file,index,id,verdict,place_x,place_y,immersions"


def test_what_is_written_is_not_read(tmp_path):
    (tmp_path / "b.json").write_text(json.dumps(TRIANGLE))
    out = tmp_path / "out.jsonl"
    for _ in range(2):
        assert main(["batch", str(tmp_path), "-o", str(out), "--workers", "1", "--force"]) == 0
    assert len(rows(out)) == 1


def test_wkb_in_parquet(tmp_path):
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    wkb = [shapely.to_wkb(shapely.Polygon(points)) for points in (TRIANGLE, EIGHT)]
    table = pyarrow.table({"id": [7, 8, 9], "shape": [*wkb, b"broken"]})
    source, out = tmp_path / "many.parquet", tmp_path / "out.parquet"
    parquet.write_table(table, source, row_group_size=2)
    assert main(["batch", str(source), "-o", str(out), "--workers", "1"]) == 2
    found = parquet.read_table(out).to_pylist()
    assert [(row["index"], row["id"], row["verdict"]) for row in found] == [
        (0, "7", "disk"),
        (1, "8", "none"),
        (2, "9", None),
    ]
    assert len(chunks_of([str(source)])) == 2


def test_parquet_without_geometries(tmp_path):
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    parquet.write_table(pyarrow.table({"name": ["a"]}), tmp_path / "a.parquet")
    (tmp_path / "b.parquet").write_bytes(b"broken")
    found = [row for chunk in chunks_of(files_in([str(tmp_path)])) for row in outlines_in(chunk)]
    assert [row.number for row in found] == [-1, -1]
    assert [row.outline.message.rpartition("/")[2][:30] for row in found] == [
        "no column holds geometries as ",
        "b.parquet: this is no Parquet ",
    ]


def test_long_files_of_lines_are_cut_between_lines(tmp_path):
    path = tmp_path / "many.ndjson"
    path.write_text("".join(f"[[0, 0], [{number + 1}, 0], [0, 1]]\n" for number in range(25_000)))
    chunks = chunks_of([str(path)])
    assert [chunk.first for chunk in chunks] == [0, 10_000, 20_000]
    for chunk in chunks:
        first = next(outlines_in(chunk))
        assert first.number == chunk.first
        assert first.outline.points[1, 0] == chunk.first + 1
    assert sum(1 for chunk in chunks for _ in outlines_in(chunk)) == 25_000


def test_features_are_bad_each_for_itself(tmp_path):
    """So are records of a sequence of GeoJSON, which begin with a character of their own."""
    bad = [{**FEATURE, "geometry": None}, {**FEATURE, "id": 7, "geometry": {"type": "Polygon", "coordinates": []}}, 3]
    features = [FEATURE, *bad, FEATURE]
    (tmp_path / "a.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    (tmp_path / "b.geojsons").write_text("".join(f"\x1e{json.dumps(feature)}\n" for feature in features))
    found = [row for chunk in chunks_of(files_in([str(tmp_path)])) for row in outlines_in(chunk)]
    expected = [(0, "house", False), (1, "house", True), (2, "7", True), (3, None, True), (4, "house", False)]
    assert [(row.number, row.id, isinstance(row.outline, PlyfoldError)) for row in found] == expected * 2


def test_a_part_is_judged_some_rows_at_a_time(tmp_path, monkeypatch):
    job = batch_job(files_in([str(a_folder(tmp_path))]))
    expected = [[*job.make(part)[0].rows()] for part in job.parts]
    monkeypatch.setattr("plyfold.many.batch._ROWS_AT_ONCE", 2)
    assert [[*job.make(part)[0].rows()] for part in job.parts] == expected


def test_nothing_to_read_is_an_error(tmp_path, capsys):
    out = str(tmp_path / "out.csv")
    assert main(["batch", str(tmp_path), "-o", out]) == 2
    assert main(["batch", str(tmp_path / "nowhere"), "-o", out]) == 2
    assert main(["batch", str(tmp_path), "-o", str(tmp_path / "out.xls")]) == 2
    assert main(["batch", str(tmp_path), "-o", out, "--columns", "area"]) == 2
    said = capsys.readouterr().err
    for words in ("there is no drawing in it", "there is no file or folder", "tables are no .xls", "no column 'area'"):
        assert words in said


def test_a_killed_batch_goes_on(tmp_path):
    """Killed after its first part, the same command makes the others, and the table is whole."""
    source, out = tmp_path / "many.jsonl", tmp_path / "out.jsonl"
    source.write_text(f"{json.dumps(TRIANGLE)}\n" * 30_000)
    command = [sys.executable, "-m", "plyfold", "batch", str(source), "-o", str(out), "--workers", "1"]
    parts = tmp_path / "out.jsonl.parts"
    with subprocess.Popen(command, start_new_session=True) as run:
        while not (parts / "part-000000.json").exists():
            assert run.poll() is None
        os.killpg(run.pid, signal.SIGKILL)
    assert not out.exists()
    subprocess.run(command, check=True, capture_output=True)
    assert [row["index"] for row in rows(out)] == list(range(30_000))
    assert not parts.exists()


def test_checks_of_several_files_are_lines(tmp_path, capsys):
    folder = a_folder(tmp_path)
    files = [str(folder / name) for name in ("b.json", "c.json", "a.svg")]
    assert main(["check", *files]) == 2
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [line["file"] for line in lines] == files
    assert [line.get("immersible") for line in lines] == [True, None, False]
    assert "broken JSON" in lines[1]["error"]
    assert main(["check", "--each", *files[2:], files[0]]) == 1
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [(line["file"], line["index"]) for line in lines] == [(files[2], 0), (files[2], 1), (files[0], 0)]


def test_files_change_and_their_parts_go(tmp_path):
    """Parts of another state of the files are not taken."""
    source, out = tmp_path / "many.jsonl", tmp_path / "out.jsonl"
    source.write_text(f"{json.dumps(TRIANGLE)}\n")
    before = batch_job([str(source)])
    source.write_text(f"{json.dumps(EIGHT)}\n" * 2)
    assert batch_job([str(source)]).what != before.what
    (tmp_path / "out.jsonl.parts").mkdir()
    (tmp_path / "out.jsonl.parts" / "what.json").write_text(json.dumps(before.what | {"parts": 1}))
    with pytest.raises(InputError, match="something else"):
        write_table(batch_job([str(source)]), out)
