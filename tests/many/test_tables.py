"""Tables: their files, and parts that are made by several processes and gone on with."""

import csv
import io
import json
import os
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from numbered import a_table, failing_part, make_part
from plyfold.census.job import census_job
from plyfold.errors import InputError
from plyfold.tables.files import TABLE_ENDINGS, require_writer, table_bytes
from plyfold.tables.parts import Job, count_parts, write_table
from plyfold.tables.table import DataTable, joined

pyarrow = pytest.importorskip("pyarrow")


def rows_of(path):
    if path.suffix == ".parquet":
        return pyarrow.parquet.read_table(path).to_pylist()
    if path.suffix == ".jsonl":
        return [json.loads(line) for line in path.read_text().splitlines()]
    rows = csv.DictReader(io.StringIO(path.read_text()))
    return [
        {
            "number": int(row["number"]),
            "even": row["even"] == "True",
            "name": row["name"],
            "large": row["large"] or None,
        }
        for row in rows
    ]


def expected(n):
    return [
        {"number": i, "even": i % 2 == 0, "name": f"n{i}", "large": None if i % 2 else str(2**80 + i)} for i in range(n)
    ]


@pytest.mark.parametrize("ending", TABLE_ENDINGS)
@pytest.mark.parametrize("workers", [1, 2])
def test_parts_are_joined_in_order(tmp_path, ending, workers):
    job, out = Job({"what": "numbers"}, range(4), partial(make_part, str(tmp_path))), tmp_path / f"out{ending}"
    told = []
    notes = write_table(job, out, workers, progress=lambda *done: told.append(done))
    assert notes == [{"first": 3 * number} for number in range(4)]
    assert rows_of(out) == expected(12)
    assert told[-1] == ("parts", 1.0)
    assert len(told) == 4
    assert sorted(path.name for path in tmp_path.iterdir()) == ["made", out.name]


def test_what_is_done_is_not_done_again(tmp_path):
    job, out = Job({"what": "numbers"}, range(4), partial(failing_part, str(tmp_path))), tmp_path / "out.jsonl"
    with pytest.raises(ValueError, match="no part 2"):
        write_table(job, out, workers=1)
    assert not out.exists()
    (tmp_path / "mended").touch()
    write_table(job, out, workers=1)
    assert rows_of(out) == expected(12)
    assert sorted((tmp_path / "made").read_text().split()) == ["0", "1", "2", "3"]


def test_parts_of_something_else_are_not_taken(tmp_path):
    out = tmp_path / "out.jsonl"
    with pytest.raises(ValueError, match="no part 2"):
        write_table(Job({"what": "numbers"}, range(4), partial(failing_part, str(tmp_path))), out, workers=1)
    for other in (Job({"what": "others"}, range(4), make_part), Job({"what": "numbers"}, range(5), make_part)):
        with pytest.raises(InputError, match="something else"):
            write_table(other, out, workers=1)


def test_existing_files_are_not_overwritten(tmp_path):
    job, out = Job({}, range(1), partial(make_part, str(tmp_path))), tmp_path / "out.csv"
    out.write_text("mine")
    with pytest.raises(FileExistsError):
        write_table(job, out)
    assert out.read_text() == "mine"
    write_table(job, out, force=True)
    assert rows_of(out) == expected(3)


def test_notes_alone(tmp_path):
    job = Job({}, range(3), partial(make_part, str(tmp_path)))
    assert count_parts(job, workers=1) == [{"first": 0}, {"first": 3}, {"first": 6}]


KILLED = """
import sys
from functools import partial
from pathlib import Path
sys.path.insert(0, {tests!r})
from numbered import slow_part
from plyfold.tables.parts import Job, write_table
if __name__ == "__main__":
    job = Job({{"what": "numbers"}}, range(8), partial(slow_part, {folder!r}))
    write_table(job, {out!r}, workers=2, progress=lambda *_: print("part", flush=True))
"""


def test_a_killed_run_goes_on(tmp_path):
    """The whole group of processes is killed after the first part; a second run makes the others alone."""
    script, out = tmp_path / "run.py", tmp_path / "out.jsonl"
    tests = str(Path(__file__).parent.parent)
    script.write_text(KILLED.format(tests=tests, folder=str(tmp_path), out=str(out)))
    command = [sys.executable, str(script)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, start_new_session=True) as run:
        assert run.stdout is not None
        run.stdout.readline()
        os.killpg(run.pid, signal.SIGKILL)
    folder = tmp_path / "out.jsonl.parts"
    done = len(list(folder.glob("part-*.json")))
    assert not out.exists()
    assert 0 < done < 8
    again = subprocess.run(command, check=True, capture_output=True, text=True)
    assert len(again.stdout.splitlines()) == 8 - done
    assert rows_of(out) == expected(24)
    assert not folder.exists()


def test_columns_of_different_lengths_are_no_table():
    with pytest.raises(InputError, match="one length"):
        DataTable({"a": np.arange(2), "b": np.arange(3)})


def test_as_pandas_and_arrow():
    pandas = pytest.importorskip("pandas")
    table = joined([a_table(0, 1), a_table(1, 2)])
    assert isinstance(table.to_pandas(), pandas.DataFrame)
    assert table.to_pandas()["large"][0] == 2**80
    assert table.to_arrow().to_pylist() == expected(3)
    assert table.to_numpy()["number"].tolist() == [0, 1, 2]


def test_tables_have_endings():
    with pytest.raises(InputError, match="choose"):
        require_writer(".xls")
    assert table_bytes(a_table(n=1), ".csv") == b"number,even,name,large\n0,True,n0,1208925819614629174706176\n"


def test_a_cluster_that_loses_a_machine_makes_the_same_table(tmp_path):
    """One of three processes is killed when the second part comes back; nothing is lost, and nothing is there twice."""
    distributed = pytest.importorskip("distributed")
    job, out, here = census_job(7, 12), tmp_path / "cluster.jsonl", tmp_path / "here.jsonl"
    done = []
    options = {"n_workers": 3, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:

        def kill_one(*_):
            done.append(True)
            if len(done) == 2:
                os.kill(next(iter(cluster.workers.values())).pid, signal.SIGKILL)

        notes = write_table(job, out, client, progress=kill_one)
    assert write_table(job, here, workers=1) == notes
    assert out.read_bytes() == here.read_bytes()
