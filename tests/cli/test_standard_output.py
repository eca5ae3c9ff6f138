"""``-o -``: files to standard output, sentences to standard error."""

import json
import subprocess
import sys

import pytest

COMMAND = [sys.executable, "-m", "plyfold"]


def run(*words):
    return subprocess.run([*COMMAND, *words], capture_output=True, check=False)


def test_a_mesh_goes_to_standard_output_as_into_a_file(tmp_path):
    lift = ("lift", "gallery:exit-ramp", "--triangles", "100")
    piped = run(*lift, "-o", "-", "--format", "stl", "-o", str(tmp_path / "out.stl"))
    assert piped.returncode == 0
    assert piped.stdout == (tmp_path / "out.stl").read_bytes()
    assert b"wrote standard output" in piped.stderr
    assert b"Lifted" in piped.stderr


@pytest.mark.parametrize(
    ("words", "beginning"),
    [
        (("convert", "gallery:ring", "--format", "json"), b"{"),
        (("split", "gallery:exit-ramp", "--format", "wkt"), b"POLYGON"),
        (("draw", "gallery:exit-ramp", "--what", "over-under", "--format", ".svg"), b"<"),
        (("gallery", "exit-ramp", "--format", "csv"), b"x,y"),
    ],
)
def test_other_commands(words, beginning):
    piped = run(*words, "-o", "-")
    assert piped.returncode == 0, piped.stderr
    assert piped.stdout.startswith(beginning)
    assert piped.stdout


def test_json_calls_it_standard_output():
    piped = run("lift", "gallery:exit-ramp", "--triangles", "50", "--json", "-o", "-", "--format", "ply")
    assert piped.stdout.startswith(b"ply")
    assert json.loads(piped.stderr.splitlines()[-1])["written"] == ["standard output"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ((), b"--format"),
        (("--format", "fbx"), b"ending"),
        (("--format", "obj", "--colours", "sheets"), b"two files"),
        (("--format", "glb", "--each"), b"--each"),
    ],
)
def test_what_cannot_go_there(words, sentence):
    piped = run("lift", "gallery:exit-ramp", "--triangles", "50", "-o", "-", *words)
    assert piped.returncode == 2
    assert piped.stdout == b""
    assert sentence in piped.stderr
