"""Ctrl-C on the command line: exit code 130, one sentence, no half file, whatever is going on at that moment."""

import os
import signal
import subprocess
import sys

import pytest

from nightly.disturbed import COMMAND, SENTENCE

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals")

IN_FOREIGN_CODE = """
import hashlib, sys
import plyfold.surface.making as making
def forever(*_, **__):
    print("working", flush=True)
    hashlib.pbkdf2_hmac("sha1", b"", b"", 2**31 - 1)
making.smooth_heights = forever
sys.argv = {words}
from plyfold_command import main
main()
"""


def started(program, *words):
    return subprocess.Popen(
        [sys.executable, "-c", program.replace("{words}", repr(["plyfold", *words]))],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


@pytest.mark.parametrize("moment", [200, 1_000, 20_000, 100_000, 300_000])
def test_an_interrupt_while_python_runs(moment, tmp_path):
    """The first of these moments are imports."""
    words = ("lift", "gallery:pretzel", "-o", str(tmp_path / "a.glb"), "-o", str(tmp_path / "a.obj"))
    with started(COMMAND.replace("{moment}", str(moment)), *words) as process:
        said, errors = process.communicate()
    assert (process.returncode, said, errors) == (130, b"", SENTENCE)
    assert list(tmp_path.iterdir()) == []


def test_an_interrupt_while_foreign_code_runs(tmp_path):
    with started(IN_FOREIGN_CODE, "lift", "gallery:exit-ramp", "-o", str(tmp_path / "a.glb")) as process:
        assert process.stdout.readline() == b"working\n"
        process.send_signal(signal.SIGINT)
        try:
            _, errors = process.communicate(timeout=60)
        finally:
            process.kill()
    assert (process.returncode, errors) == (130, SENTENCE)


def test_a_file_that_is_being_written_goes(tmp_path):
    program = f"""
import signal, sys
from pathlib import Path
from plyfold.io import saving
write = Path.replace
Path.replace = lambda self, target: signal.raise_signal(signal.SIGINT)
sys.argv = ["plyfold", "gallery", "circle", "-o", {str(tmp_path / "circle.csv")!r}]
from plyfold_command import main
main()
"""
    with started(program) as process:
        assert process.communicate() == (b"", SENTENCE)
    assert process.returncode == 130
    assert list(tmp_path.iterdir()) == []


def test_an_interrupt_while_python_looks_for_the_package(tmp_path):
    """`python -m plyfold` imports the library before the first line of its program."""
    (tmp_path / "sitecustomize.py").write_text(
        "import signal, sys\n"
        "def press(event, words):\n"
        "    if event == 'import' and words[0] == 'numpy':\n"
        "        signal.raise_signal(signal.SIGINT)\n"
        "sys.addaudithook(press)\n"
    )
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    for name in (["-m", "plyfold"], ["-mplyfold"]):
        words = [sys.executable, *name, "check", "gallery:circle"]
        done = subprocess.run(words, capture_output=True, check=False, env=environment)
        assert (done.returncode, done.stdout, done.stderr) == (130, b"", SENTENCE)


def test_interrupts_of_other_programs_are_left_alone(tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "__init__.py").write_text("import plyfold\n")
    (tmp_path / "other" / "__main__.py").write_text(
        "import signal\nprint(signal.getsignal(signal.SIGINT) is signal.default_int_handler)\n"
    )
    words = [sys.executable, "-m", "other", "plyfold"]
    assert subprocess.run(words, capture_output=True, check=True, cwd=tmp_path).stdout == b"True\n"


def test_an_ignored_interrupt_stays_ignored():
    """So does the shell start what goes on in the background."""
    program = "import signal; signal.signal(signal.SIGINT, signal.SIG_IGN)" + COMMAND.replace("{moment}", "1000")
    with started(program, "check", "gallery:circle") as process:
        process.communicate()
    assert process.returncode == 0
