"""``plyfold batch``: all outlines of files, in a table."""

import csv
import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
import shapely

import heaps
import plyfold as pf
from plyfold.cli.commands import main
from plyfold.errors import FileFormatError
from plyfold.many import sources
from plyfold.many.batch import batch_job
from plyfold.many.sources import pieces_of_files, rows_of_piece
from plyfold.many.verdicts import DEFAULT_COLUMNS, VERDICT_COLUMNS
from plyfold.tables.parts import write_table

pyarrow = pytest.importorskip("pyarrow")
from pyarrow import parquet  # noqa: E402

TRIANGLE = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]
EIGHT = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]
SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path id="a" d="M0 0h4v3z"/><path id="b" d="M0 0l2 2v-2l-2 2z"/></svg>'


def lines_of(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def feature(coordinates, **more):
    return {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": coordinates}, "properties": {}} | more


@pytest.fixture
def folder(tmp_path):
    """A folder with a file of every kind, some of them spoiled."""
    here = tmp_path / "in"
    (here / "deeper").mkdir(parents=True)
    (here / "a.svg").write_text(SVG)
    (here / "b.svg").write_text("<svg")
    ring = [[*TRIANGLE, TRIANGLE[0]]]
    collection = {"type": "FeatureCollection", "features": [feature(ring, id="x"), feature([], id="y"), 3]}
    (here / "deeper" / "c.geojson").write_text(json.dumps(collection))
    hole = [[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]], [[1, 1], [1, 3], [3, 1], [1, 1]]
    records = [TRIANGLE, EIGHT, {"loops": [TRIANGLE]}, feature(hole, id="hole")]
    text = "\n".join(map(json.dumps, records)) + "\n\nnonsense\n[[0, 0]]\n42"
    (here / "d.jsonl").write_text(text)
    (here / "e.json").write_text(json.dumps(EIGHT))
    table = pyarrow.table({"geom": [shapely.Polygon(TRIANGLE).wkb, None, b"no WKB", shapely.Point(1, 2).wkb]})
    parquet.write_table(table, here / "f.parquet")
    (here / "notes.txt").write_text("no outlines")
    return here


EXPECTED = [
    ("a.svg", 0, "a", "disk"),
    ("a.svg", 1, "b", "none"),
    ("b.svg", None, None, None),
    ("d.jsonl", 0, None, "disk"),
    ("d.jsonl", 1, None, "none"),
    ("d.jsonl", 2, None, "disk"),
    ("d.jsonl", 3, "hole", "surface"),
    ("d.jsonl", 5, None, None),
    ("d.jsonl", 6, None, None),
    ("d.jsonl", 7, None, None),
    ("deeper/c.geojson", 0, "x", "disk"),
    ("deeper/c.geojson", 1, "y", None),
    ("deeper/c.geojson", 2, None, None),
    ("e.json", 0, None, "none"),
    ("f.parquet", 0, None, "disk"),
    ("f.parquet", 1, None, None),
    ("f.parquet", 2, None, None),
    ("f.parquet", 3, None, None),
]


def test_a_folder(folder, tmp_path, capsys):
    out = tmp_path / "out.jsonl"
    assert main(["batch", str(folder), "-o", str(out), "--workers", "1"]) == 0
    rows = lines_of(out)
    assert [*rows[0]] == ["file", "index", "id", *DEFAULT_COLUMNS]
    found = [(os.path.relpath(row["file"], folder), row["index"], row["id"], row["verdict"]) for row in rows]
    assert found == EXPECTED
    assert [bool(row["error"]) for row in rows] == [row["verdict"] is None for row in rows]
    assert "18 outlines: 5 disk, 1 surface, 3 none, 9 with an error\n" in capsys.readouterr().out
    assert not (tmp_path / "out.jsonl.parts").exists()


@pytest.mark.parametrize("ending", [".csv", ".parquet"])
def test_other_tables(folder, tmp_path, ending):
    """All columns, and the output inside the folder that is read, where it is passed over when it is made again."""
    out = folder / f"out{ending}"
    command = [
        "batch",
        str(folder),
        "-o",
        str(out),
        "--workers",
        "1",
        "--columns",
        ",".join(VERDICT_COLUMNS),
        "--force",
    ]
    assert main(command) == 0
    assert main(command) == 0
    if ending == ".parquet":
        rows = parquet.read_table(out).to_pylist()
    else:
        with out.open() as file:
            rows = [*csv.DictReader(file)]
    assert [row["verdict"] or None for row in rows] == [row[3] for row in EXPECTED]
    assert rows[0]["immersions"] == "1"


def test_the_same_as_in_memory(tmp_path):
    outlines = [outline for draw in (heaps.glyphs, heaps.strokes) for outline in draw(30, 1)]
    file = tmp_path / "many.jsonl"
    file.write_text("\n".join(json.dumps(outline.tolist()) for outline in outlines))
    write_table(batch_job([str(file)], VERDICT_COLUMNS), tmp_path / "out.parquet", workers=1)
    found = parquet.read_table(tmp_path / "out.parquet").drop_columns(["file", "index", "id"])
    assert found.equals(pf.verdicts(outlines, VERDICT_COLUMNS).to_arrow())


def test_pieces_are_whole_lines(tmp_path, monkeypatch):
    """However long pieces are, every line is in one of them, under its number."""
    file = tmp_path / "many.jsonl"
    lines = [json.dumps(TRIANGLE), "", json.dumps(EIGHT), "x" * 50, "", json.dumps(TRIANGLE)]
    for text in ("\n".join(lines), "\n".join(lines) + "\n", "\r\n".join(lines)):
        file.write_bytes(text.encode())
        for size in (1, 7, 60, 1000):
            monkeypatch.setattr(sources, "_PIECE", size)
            pieces = pieces_of_files([str(file)])
            assert [row.number for piece in pieces for row in rows_of_piece(piece)] == [0, 2, 3, 5]
            assert (len(pieces) > 1) == (size < 1000)


def test_pieces_of_parquet(tmp_path, monkeypatch):
    monkeypatch.setattr(sources, "_PIECE", 300)
    table = pyarrow.table({"name": [*"abcdefgh"], "shape": shapely.to_wkb(shapely.points(np.arange(8), 0))})
    parquet.write_table(table, file := tmp_path / "many.parquet", row_group_size=2)
    with pytest.raises(FileFormatError, match="no column of geometry"):
        pieces_of_files([str(file)])
    pieces = pieces_of_files([str(file)], column="shape")
    assert len(pieces) > 1
    assert [row.number for piece in pieces for row in rows_of_piece(piece)] == [*range(8)]
    geo = {"geo": json.dumps({"primary_column": "shape"})}
    parquet.write_table(table.replace_schema_metadata(geo), file)
    assert pieces_of_files([str(file)])[0].column == "shape"


def test_what_is_refused(folder, tmp_path, capsys):
    out = str(tmp_path / "out.jsonl")
    for words, said in (
        ([str(tmp_path / "no"), "-o", out], "is not there"),
        ([str(folder), "-o", out, "--columns", "crossing"], "no column 'crossing'"),
        ([str(folder), "-o", str(tmp_path / "out.xls")], "tables are no .xls"),
        ([str(folder / "d.jsonl"), "-o", str(folder / "d.jsonl"), "--force"], "one of the files that are read"),
        ([str(folder / "deeper" / ".."), "-o", str(folder / "d.jsonl")], "exists already"),
        ([str(folder / "f.parquet"), "-o", out, "--column", "nothing"], "no column nothing"),
    ):
        assert main(["batch", *words]) == 2
        assert said in capsys.readouterr().err
    (tmp_path / "empty").mkdir()
    assert main(["batch", str(tmp_path / "empty"), "-o", out]) == 2
    (folder / "f.parquet").write_text("none")
    assert main(["batch", str(folder), "-o", out]) == 2
    assert "is no Parquet file" in capsys.readouterr().err


RUN = """
import sys
from plyfold.many import sources
from plyfold.cli.commands import main
if __name__ == "__main__":
    sources._PIECE = 1 << 17
    import plyfold.many.batch as batch
    batch._BYTES = 1 << 17
    sys.exit(main(sys.argv[1:]))
"""


def test_a_killed_run_goes_on(tmp_path):
    """It is killed when the first part is there; the same command makes the others, and the same table."""
    curves = np.random.default_rng(1).random((6000, 12, 2)).round(3)
    (tmp_path / "many.jsonl").write_text("\n".join(map(json.dumps, curves.tolist())))
    (tmp_path / "run.py").write_text(RUN)
    command = [sys.executable, "run.py", "batch", "many.jsonl", "-o", "out.parquet", "--workers", "1"]
    parts = tmp_path / "out.parquet.parts"
    with subprocess.Popen(command, cwd=tmp_path, start_new_session=True) as run:
        while run.poll() is None and not list(parts.glob("part-*.json")):
            pass
        os.killpg(run.pid, signal.SIGKILL)
    done = {path: path.stat().st_mtime_ns for path in parts.glob("part-*.json")}
    assert done
    assert not (tmp_path / "out.parquet").exists()
    subprocess.run(command, cwd=tmp_path, check=True)
    found = parquet.read_table(tmp_path / "out.parquet")
    assert found["index"].to_pylist() == [*range(6000)]
    assert found.select(DEFAULT_COLUMNS).equals(pf.verdicts(curves).to_arrow())


def test_files_that_change_begin_anew(tmp_path):
    file, out = tmp_path / "many.jsonl", tmp_path / "out.jsonl"
    file.write_text(json.dumps(TRIANGLE))
    before = batch_job([str(file)], DEFAULT_COLUMNS).what
    assert batch_job([str(file)], DEFAULT_COLUMNS, but=str(out)).what == before
    file.write_text(json.dumps(EIGHT))
    assert batch_job([str(file)], DEFAULT_COLUMNS).what != before


@pytest.mark.slow
def test_a_cluster_that_loses_a_machine_makes_the_same_table(tmp_path, monkeypatch):
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(sources, "_PIECE", 1 << 16)
    monkeypatch.setattr("plyfold.many.batch._BYTES", 1 << 16)
    curves = np.random.default_rng(2).random((4000, 12, 2)).round(3)
    (tmp_path / "many.jsonl").write_text("\n".join(map(json.dumps, curves.tolist())))
    job = batch_job([str(tmp_path / "many.jsonl")], DEFAULT_COLUMNS)
    assert len(job.parts) > 5
    done = []
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:

        def kill_one(*_):
            done.append(True)
            if len(done) == 2:
                os.kill(next(iter(cluster.workers.values())).pid, signal.SIGKILL)

        notes = write_table(job, tmp_path / "cluster.parquet", client, progress=kill_one)
    assert sum(note["rows"] for note in notes) == 4000
    found = parquet.read_table(tmp_path / "cluster.parquet")
    assert found["index"].to_pylist() == [*range(4000)]
    assert found.select(DEFAULT_COLUMNS).equals(pf.verdicts(curves).to_arrow())


def test_check_of_several_files(folder, capsys):
    files = [str(folder / name) for name in ("a.svg", "b.svg", "e.json")]
    assert main(["check", *files, "--json"]) == 2
    found = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [row["file"] for row in found] == files
    assert "error" in found[1]
    assert found[2]["immersible"] is False
    assert main(["check", files[0], files[2], "--json", "--each"]) == 1
    found = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [(row["file"], row["index"]) for row in found] == [(files[0], 0), (files[0], 1), (files[2], 0)]
    assert main(["check", files[2], "gallery:circle"]) == 1
    said = capsys.readouterr().out.splitlines()
    assert said[0] == files[2]
    assert "gallery:circle" in said
