"""Ctrl-C reaches the server and all its workers; these leave it to the server, from their first moment on."""

import os
import subprocess
import sys

import pytest

PRESS = """
import os, signal, sys

def press(event, words):
    if event == "import" and words[0] == "plyfold.sketch.warm" and sys.argv[0] == "-c":
        os.kill(os.getpid(), signal.SIGINT)

sys.addaudithook(press)
"""

PROGRAM = """
from plyfold.sketch.workers import Question, Workers

if __name__ == "__main__":
    workers = Workers()
    question = Question("look", b'{"version": 3, "points": [[0, 0], [1, 0], [0, 1]]}', {}, 300)
    print(workers.ask(question).status)
    workers.close()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the fork server")
def test_an_interrupt_while_workers_are_imported(tmp_path):
    (tmp_path / "sitecustomize.py").write_text(PRESS)
    (tmp_path / "program.py").write_text(PROGRAM)
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    words = [sys.executable, str(tmp_path / "program.py")]
    done = subprocess.run(words, capture_output=True, check=False, env=environment)
    assert (done.returncode, done.stdout.strip(), done.stderr) == (0, b"200", b"")
