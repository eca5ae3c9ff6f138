"""The command line where standard output cannot take a character, is full, or has gone."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import plyfold as pf

needs_full = pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
FULL = b"plyfold: standard output cannot be written (no space left on device)\n"


def run(*words, shell_end="", **variables):
    """Run the command line by the shell, which redirects the streams."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    command = 'exec "$0" -m plyfold "$@"'
    return subprocess.run(
        ["bash", "-c", f"{command} {shell_end}", sys.executable, *words],
        capture_output=True,
        check=False,
        env=environment | variables,
    )


def assert_tidy(done, code):
    assert b"Traceback" not in done.stderr
    assert b"Exception ignored" not in done.stderr
    assert done.returncode == code


@pytest.mark.parametrize("encoding", ["cp1252", "ascii", "latin-1", "cp437"])
def test_words_have_their_signs_in_every_encoding(encoding):
    done = run("word", "gallery:milnor", PYTHONIOENCODING=encoding)
    assert_tidy(done, 0)
    word, _, _, _, *groupings = done.stdout.decode(encoding).splitlines()
    assert word == "a+ b- a+ b+ a- b+"
    assert groupings == ["  (a+ (b- a+ b+) a-) b+", "  a+ (b- (a+ b+ a-) b+)"]


def test_words_have_raised_signs_where_there_are_such():
    done = run("word", "gallery:milnor", PYTHONIOENCODING="utf-8")
    assert done.stdout.decode().startswith(str(pf.blank_word(pf.gallery.CURVES["milnor"].curve)))
    assert "a⁺ b⁻" in done.stdout.decode()


@pytest.mark.parametrize("words", [["gallery"], ["lift", "--help"]])
def test_accents_are_left_out_where_there_are_none(words):
    done = run(*words, PYTHONIOENCODING="ascii")
    assert_tidy(done, 0)
    text = done.stdout.decode("ascii")
    assert ("Pascal's limacon" if words == ["gallery"] else "how far a Bezier") in " ".join(text.split())


def test_file_names_that_are_no_text(tmp_path):
    path = tmp_path / os.fsdecode(b"\xff.wkt")
    done = run("split", "gallery:milnor", "-o", str(path), PYTHONIOENCODING="utf-8")
    assert_tidy(done, 0)
    assert path.exists()
    assert done.stdout.decode().endswith("\\udcff.wkt\n")


COMMANDS = {
    "check": ["check", "gallery:milnor"],
    "json": ["check", "gallery:milnor", "--json"],
    "an error as json": ["check", "no-such-file", "--json"],
    "help": ["--help"],
    "more than fits a buffer": ["gallery", "pentagram"],
}
# Without a buffer argparse itself prints the help, and says nothing if it cannot.
CASES = [(name, unbuffered) for name in COMMANDS for unbuffered in ("", "1") if (name, unbuffered) != ("help", "1")]


@needs_full
@pytest.mark.parametrize(("name", "unbuffered"), CASES)
def test_a_full_disk(name, unbuffered):
    done = run(*COMMANDS[name], shell_end=">/dev/full", PYTHONUNBUFFERED=unbuffered)
    assert_tidy(done, 2)
    assert done.stderr == FULL


@needs_full
@pytest.mark.parametrize("shell_end", ["2>/dev/full", "2>&-"])
def test_complaints_that_nobody_can_read(shell_end):
    done = run("check", "no-such-file", shell_end=shell_end)
    assert done.returncode == 2
    assert done.stdout == b""


@needs_full
def test_both_streams_full():
    done = run("check", "no-such-file", "--json", shell_end=">/dev/full 2>/dev/full")
    assert done.returncode == 2


@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
def test_a_closed_output(words):
    done = run(*words, shell_end=">&-")
    assert_tidy(done, 2 if "no-such-file" in words else 0)


@pytest.mark.parametrize(("name", "unbuffered"), CASES)
def test_a_reader_that_has_gone(name, unbuffered):
    reader, writer = os.pipe()
    os.close(reader)
    environment = os.environ | {"PYTHONUNBUFFERED": unbuffered}
    command = [sys.executable, "-m", "plyfold", *COMMANDS[name]]
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, check=False, env=environment)
    os.close(writer)
    assert_tidy(done, 141)
    assert done.stderr == b""


def test_a_reader_that_stays_gets_everything():
    done = run("check", "gallery:milnor", "--json", shell_end="| cat")
    assert json.loads(done.stdout)["immersions"] == 2
