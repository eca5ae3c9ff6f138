"""Small curves: ``python benchmarks/small.py [--against DIR]`` times calls warm, first in a process, and in a cold one.

All are seconds of the processor, the least of several runs. With ``--against`` another source tree of plyfold takes
turns with this one, such as a git worktree of an older commit with its core compiled.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from contenders import SMALL_RAMP
from families import FAMILIES

SOURCE = Path(__file__).resolve().parent.parent / "src"
CURVES = {
    "ramp, n = 10": lambda: np.array(SMALL_RAMP, dtype=np.float64),
    "wild-ribbon, n = 50": lambda: FAMILIES["wild-ribbon"].draw(50, 0),
    "wild-ribbon, n = 200": lambda: FAMILIES["wild-ribbon"].draw(200, 0),
    "coil, n = 1,600": lambda: FAMILIES["coil"].draw(1600, 0),
}
CALLS = ("bounds_disk", "arrange", "find_immersion")

WARM = """
import json, sys, time
import numpy as np
import plyfold as pf

call, points = getattr(pf, sys.argv[1]), np.load(sys.argv[2])
call(points)
least, size, end = 1.0, 1, time.process_time() + 1.0
while time.process_time() < end:
    start = time.process_time()
    for _ in range(size):
        call(points)
    seconds = time.process_time() - start
    least = min(least, seconds / size)
    size = size if seconds > 2e-3 else 2 * size
print(least)
"""

FIRST = """
import sys, time
import numpy as np
import plyfold as pf

points, call = np.load(sys.argv[2]), getattr(pf, sys.argv[1])
start = time.process_time()
call(points)
print(time.process_time() - start)
"""

COLD = """
import sys
import numpy as np
points = np.load(sys.argv[2])
"""

WHOLE = """
import plyfold as pf
getattr(pf, sys.argv[1])(points)
"""


def run(source: Path, program: str, *words: str) -> tuple[str, float]:
    """Run a program with a source tree; return what it printed, and the seconds of the processor that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = os.environ | {"PYTHONPATH": str(source)}
    done = subprocess.run(
        [sys.executable, "-c", program, *words], capture_output=True, text=True, check=True, env=environment
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def cold(source: Path, call: str, points: str, rounds: int) -> float:
    """Return the seconds of a process that makes one call, beyond those of one that imports numpy alone."""
    alone = min(run(source, COLD, call, points)[1] for _ in range(rounds))
    return min(run(source, COLD + WHOLE, call, points)[1] for _ in range(rounds)) - alone


def printed(program: str) -> Callable[[Path, str, str, int], float]:
    """Return how the least of the seconds that a program prints are measured."""
    return lambda source, *words: min(float(run(source, program, *words[:2])[0]) for _ in range(words[2]))


def rows(sources: list[Path], rounds: int) -> Iterator[tuple[str, list[float]]]:
    """Yield each measurement, and its seconds with each source tree."""
    measures = {"warm": printed(WARM), "first call": printed(FIRST), "cold process beyond numpy": cold}
    with tempfile.TemporaryDirectory() as folder:
        points = str(Path(folder, "points.npy"))
        for number, (curve, draw) in enumerate(CURVES.items()):
            np.save(points, draw())
            for call in CALLS:
                for name, measure in measures.items() if number == 0 else [("warm", measures["warm"])]:
                    yield f"{call}, {curve}: {name}", [measure(source, call, points, rounds) for source in sources]


def main() -> None:
    """Read the command line, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--against", type=Path, metavar="DIR", help="another source tree of plyfold")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", action="store_true", help="print lines of JSON")
    options = parser.parse_args()
    sources = [SOURCE, *([options.against / "src"] if options.against else [])]
    for name, seconds in rows(sources, options.rounds):
        shown = [f"{1e6 * second:,.1f}" for second in seconds]
        print(json.dumps([name, *seconds]) if options.json else f"| {name} | {' | '.join(shown)} |", flush=True)


if __name__ == "__main__":
    main()
