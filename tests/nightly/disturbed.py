"""Interrupts at random moments, and threads: whatever happened, the next answers are right. ``-m nightly.disturbed``.

A moment is a number of calls of Python functions, so a seed means the same on any machine.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import plyfold as pf
from reference.random_curves import glued_disk, ribbon_outline

MOMENTS = 4
"""Interrupts of one drawing, one after the other."""

THREADS = 4

FRESH_EVERY = 5
"""Of so many seeds, one is tried in new processes too: there everything is imported."""

SENTENCE = b"plyfold: interrupted; nothing was left half-written\n"

COMMAND = """
import signal, sys
calls = 0
def count(frame, event, what):
    global calls
    calls += 1
    if calls == {moment}:
        signal.raise_signal(signal.SIGINT)
sys.argv = {words}
from plyfold_command import main
sys.setprofile(count)
main()
"""
"""The command line with some words, interrupted at so many calls."""

Work = Callable[[], Any]


def outline(rng: np.random.Generator) -> np.ndarray:
    """The outline of a disk."""
    make = (ribbon_outline, glued_disk)[int(rng.integers(2))]
    return np.array(make(rng, int(rng.integers(5, 60))), dtype=np.float64)


def answers(arranged: pf.Arrangement) -> tuple[Any, ...]:
    """What is said about a drawing; what it has found out already it remembers."""
    immersion = pf.find_immersion(arranged)
    layering = pf.find_layering(immersion)
    surface = pf.lift(layering, triangles=50).vertices.tolist() if layering else layering.reason
    faces = pf.triangulate(arranged).tolist()
    return pf.count_immersions(arranged), immersion.gluing.tolist(), faces, surface


def is_broken_off(work: Work, moment: int) -> bool:
    """Do some work, but press Ctrl-C at so many calls; tell whether that ended it."""
    calls = 0

    def count(*_: object) -> None:
        nonlocal calls
        calls += 1
        if calls == moment:
            raise KeyboardInterrupt

    before = sys.getprofile()
    try:
        sys.setprofile(count)
        work()
    except KeyboardInterrupt:
        return True
    finally:
        sys.setprofile(before)
    return False


def at_once(work: Work) -> list[Any]:
    """What threads come to that do the same work at the same time; an error is an answer too."""
    found: list[Any] = []

    def do() -> None:
        try:
            found.append(work())
        except Exception:
            found.append(traceback.format_exc())

    threads = [threading.Thread(target=do) for _ in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


def judge_here(rng: np.random.Generator) -> None:
    """Disturb answers in this process."""
    points = outline(rng)
    expected = answers(pf.arrange(points))
    arranged = pf.arrange(points)
    for moment in np.exp(rng.uniform(0, np.log(50_000), MOMENTS)).astype(int).tolist():
        is_broken_off(lambda: answers(arranged), moment)
        assert answers(arranged) == expected, f"interrupted after {moment} calls"
    shared = pf.arrange(points)
    assert at_once(lambda: answers(shared)) == [expected] * THREADS, "in several threads"


def judge_loading(seed: int) -> None:
    """Disturb a process from its first answer on, in which libraries are loaded."""
    rng = np.random.default_rng(seed)
    points = np.array(ribbon_outline(rng, 100), dtype=np.float64)
    moment = int(np.exp(rng.uniform(0, np.log(200_000))))

    def work() -> tuple[int, int]:
        return pf.count_immersions(points), len(pf.triangulate(points))

    others: list[Any] = []
    thread = threading.Thread(target=lambda: others.extend(at_once(work)))
    thread.start()
    is_broken_off(work, moment)
    thread.join()
    right = (1, len(points) - 2)
    assert [work(), *others] == [right] * (1 + THREADS), f"interrupted after {moment} calls"


def judge_new_process(seed: int) -> None:
    """See that nothing fails, and nothing is said, in a process of its own."""
    program = f"from nightly.disturbed import judge_loading; judge_loading({seed})"
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=False, env=environment)
    assert (done.returncode, done.stderr) == (0, b""), done.stderr.decode()


def judge_command(rng: np.random.Generator, folder: Path) -> None:
    """Interrupt the command line; it ends as it should, and leaves a whole file or none."""
    moment, path = int(np.exp(rng.uniform(np.log(200), np.log(1_000_000)))), folder / "a.glb"
    words = ["plyfold", "lift", "gallery:exit-ramp", "--triangles", "500", "-o", str(path)]
    program = COMMAND.format(moment=moment, words=words)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=False)
    where = f"interrupted after {moment} calls: {done.stderr.decode()}"
    assert (done.returncode, done.stderr) in ((130, SENTENCE), (0, b"")), where
    assert done.returncode == 130 or path.exists(), where
    assert [file for file in folder.iterdir() if file != path] == [], where
    if path.exists():
        content = path.read_bytes()
        assert int.from_bytes(content[8:12], "little") == len(content), where


def failures(seeds: range) -> Iterator[str]:
    """What goes wrong, in words."""
    for seed in seeds:
        rng = np.random.default_rng(seed)
        try:
            judge_here(rng)
            if seed % FRESH_EVERY == 0:
                judge_new_process(seed)
                with tempfile.TemporaryDirectory() as folder:
                    judge_command(rng, Path(folder))
        except Exception:  # an error of any kind is a finding
            yield f"seed {seed}:\n{traceback.format_exc()}"


def main(words: list[str] | None = None) -> int:
    """Return 0 if all is well, 1 if anything was broken."""
    parser = argparse.ArgumentParser(prog="nightly.disturbed", description=__doc__)
    parser.add_argument("--rounds", type=int, default=300)
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed; default 0")
    options = parser.parse_args(words)
    found = list(failures(range(options.first, options.first + options.rounds)))
    print("\n".join([*found, f"{options.rounds:,} drawings disturbed, {len(found)} answered wrongly after that"]))
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
