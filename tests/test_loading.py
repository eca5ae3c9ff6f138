"""Importing libraries is a stage of its own: no other one that shows its seconds does it."""

import json
import subprocess
import sys

import pytest

PROBE = """
import json, sys
from plyfold.cli import progress
from plyfold.cli.commands import main

imported, known, stop = {}, set(sys.modules), progress.Stopwatch.stop

def stopping(watch):
    fresh = set(sys.modules) - known
    outside = {name for name in fresh if name.split(".")[0] in ("scipy", "pysat", "shapely")}
    imported.setdefault(watch._stage, []).extend(sorted(outside))
    known.update(fresh)
    stop(watch)

progress.Stopwatch.stop = stopping
main(sys.argv[1:])
print(json.dumps(imported))
"""


def imports_by_stage(*words):
    printed = subprocess.run([sys.executable, "-c", PROBE, *words], capture_output=True, text=True, check=True).stdout
    return {stage: names for stage, names in json.loads(printed.splitlines()[-1]).items() if names}


@pytest.mark.parametrize(
    ("command", "ending"),
    [
        ("check", ""),
        ("lift", "obj"),
        ("split", "wkt"),
        ("split --cells", "wkt"),
        ("split --fill nonzero", "wkt"),
        ("draw --mask 9", "npy"),
        ("unwrap", "obj"),
        ("triangulate", "obj"),
    ],
)
def test_no_stage_but_one_imports_libraries(command, ending, tmp_path):
    outputs = ("-o", str(tmp_path / f"out.{ending}")) if ending else ()
    assert imports_by_stage(*command.split(), "gallery:exit-ramp", *outputs).keys() == {"loading libraries"}


def test_in_python_too():
    program = (
        "import sys, json, plyfold as pf\n"
        "stages = []\n"
        "pf.lift([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)],\n"
        "        progress=lambda stage, done: stages.append((stage, 'scipy.sparse' in sys.modules)))\n"
        "print(json.dumps(stages))"
    )
    printed = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    stages = json.loads(printed)
    assert [loaded for stage, loaded in stages if stage == "loading libraries"] == [False]
    assert all(loaded for stage, loaded in stages if "layering" in stage)
