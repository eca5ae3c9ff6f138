"""numba is loaded and translates while threads work and Ctrl-C is pressed: every answer after that is right."""

import os
import subprocess
import sys
from typing import NamedTuple

import numpy as np
import pytest

from plyfold import compiled
from plyfold.compiled import run_loop

pytest.importorskip("numba")

COMMON = """
import _thread, sys, threading
import numpy as np
import plyfold as pf
from plyfold import compiled
from reference.random_curves import ribbon_outline

compiled.STEPS_BEFORE_NUMBA = 0
curves = [np.array(ribbon_outline(np.random.default_rng(seed), 100), dtype=np.float64) for seed in range(4)]

def answers():
    return [(pf.count_immersions(curve), len(pf.triangulate(curve))) for curve in curves]
"""

THREADS = """
found = []
threads = [threading.Thread(target=lambda: found.append(answers())) for _ in range(6)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
print(len(found), all(one == answers() for one in found), "numba" in sys.modules)
"""

INTERRUPTED = """
pressed = []

def press(event, words):
    if not pressed and event == {event!r} and {place!r} in str(words[0]):
        pressed.append(True)
        _thread.interrupt_main()

sys.addaudithook(press)
try:
    answers()
except KeyboardInterrupt:
    print("interrupted")
found = answers()
print(found == [(1, len(curve) - 2) for curve in curves], "numba" in sys.modules)
"""


class Found(NamedTuple):
    place: np.ndarray


def untranslatable(given, results):
    results.place[0] = len(str(sys.maxsize)[:3])
    return open is None and compiled


def shown(program, **environment):
    done = subprocess.run(
        [sys.executable, "-c", COMMON + program],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)} | environment,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout.split()


def test_threads_that_need_numba_at_once():
    assert shown(THREADS) == ["6", "True", "True"]


@pytest.mark.parametrize("module", ["numba.core.types", "numba.core.extending", "numba.np.ufunc"])
def test_interrupts_while_numba_is_imported(module):
    assert shown(INTERRUPTED.format(event="import", place=module)) == ["interrupted", "True", "True"]


def test_interrupts_while_loops_are_translated(tmp_path):
    """The first translation is broken off where its machine code is kept."""
    program = INTERRUPTED.format(event="open", place=".nbc")
    assert shown(program, NUMBA_CACHE_DIR=str(tmp_path)) == ["interrupted", "True", "True"]


def test_a_broken_import_of_numba_elsewhere():
    """It leaves numba useless in the process; loops go on in plain Python."""
    program = """
from importlib import import_module
try:
    sys.addaudithook(lambda event, words: event == "import" and words[0] == "numba.core.extending" and 1 / 0)
    import_module("numba")
except ZeroDivisionError:
    print("broken")
print([count for count, _ in answers()])
"""
    assert shown(program) == ["broken", "[1,", "1,", "1,", "1]"]


def test_a_loop_that_cannot_be_translated_runs_in_plain_python(monkeypatch):
    monkeypatch.setattr(compiled, "_machine_code_pays", lambda steps: True)
    with pytest.warns(RuntimeWarning, match="numba could not translate untranslatable"):
        assert run_loop(untranslatable, 1, (), Found(np.zeros(1, dtype=np.int64))).place.tolist() == [3]
    assert run_loop(untranslatable, 1, (), Found(np.zeros(1, dtype=np.int64))).place.tolist() == [3]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks")
def test_processes_that_are_forked_while_numba_is_loaded():
    """A child would inherit half of an import, and wait for ever for a thread that it has not."""
    program = """
import os, time
worker = threading.Thread(target=answers)
worker.start()
while "numba" not in sys.modules:
    time.sleep(0)
if os.fork() == 0:
    print(answers() == [(1, len(curve) - 2) for curve in curves], flush=True)
    os._exit(0)
os.wait()
worker.join()
"""
    assert shown(program) == ["True"]
