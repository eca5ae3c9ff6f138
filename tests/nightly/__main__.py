"""``python -m nightly`` (in tests/): judge the curves of many seeds, in several processes.

A curve that fails is printed and saved to a file; ``--replay FILE`` judges it again. The exit code is 1 if any failed.
"""

import argparse
import json
import math
import signal
import sys
import time
import traceback
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

from nightly.curves import Drawn, draw
from nightly.judge import judge
from reference.random_curves import Polygon

SEEDS_AT_ONCE = 25


class Failure(NamedTuple):
    """A curve that was judged wrong, and the traceback."""

    drawn: Drawn
    problem: str


def judged(drawn: Drawn) -> Failure | None:
    """What is wrong with the answers about a curve, if anything."""
    try:
        judge(drawn)
    except Exception:  # an error of any kind is a finding
        return Failure(drawn, traceback.format_exc())
    return None


def judge_seeds(seeds: range) -> list[Failure]:
    """The failures among some seeds."""
    return [failure for failure in (judged(draw(seed)) for seed in seeds) if failure]


def batches(first: int, curves: int) -> Iterator[range]:
    """All seeds, a few at once."""
    for start in range(first, first + curves, SEEDS_AT_ONCE):
        yield range(start, min(start + SEEDS_AT_ONCE, first + curves))


def ignore_interrupts() -> None:
    """Leave Ctrl-C to the parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def results(options: argparse.Namespace) -> Iterator[tuple[range, list[Failure]]]:
    """Every batch with its failures, in order, until the seeds or the time are used up."""
    end = time.monotonic() + options.seconds
    remaining = (batch for batch in batches(options.first, options.curves) if time.monotonic() < end)
    if options.processes == 1:
        yield from ((batch, judge_seeds(batch)) for batch in remaining)
        return
    with ProcessPoolExecutor(options.processes, initializer=ignore_interrupts) as pool:
        waiting: deque[tuple[range, Future[list[Failure]]]] = deque()
        for batch in remaining:
            waiting.append((batch, pool.submit(judge_seeds, batch)))
            if len(waiting) > 2 * options.processes:
                done, future = waiting.popleft()
                yield done, future.result()
        yield from ((done, future.result()) for done, future in waiting)


def save(failure: Failure, folder: Path) -> Path:
    """Write a failed curve where `load` finds it."""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{failure.drawn.kind.replace(' ', '-')}-{failure.drawn.seed}.json"
    file.write_text(json.dumps(failure.drawn._asdict() | {"problem": failure.problem}, indent=1), encoding="utf-8")
    return file


def load(file: Path) -> Drawn:
    """Read a curve that failed."""
    data = json.loads(file.read_text(encoding="utf-8"))
    return Drawn(data["seed"], data["kind"], with_tuples(data["points"]))


def with_tuples(points: list) -> Polygon | list[Polygon]:
    """The points of a curve, or of a list of curves, which JSON knows as lists."""
    return [with_tuples(item) if isinstance(item[0], list) else (item[0], item[1]) for item in points]


def complain(failure: Failure, folder: Path) -> None:
    """Print a failure and how to see it again."""
    print(f"\n{failure.drawn.kind}, seed {failure.drawn.seed}:\n{failure.problem}\nreplay: {save(failure, folder)}")


def show(done: int, failed: int, seconds: float, wanted: int) -> None:
    """Show progress on one line."""
    line = f"\r{done:,} of {wanted:,} curves, {failed} failed, {done / seconds:.0f}/s "
    print(line, end="", file=sys.stderr, flush=True)


def run(options: argparse.Namespace) -> int:
    """Judge the seeds, showing progress; return the number of failures."""
    begun, failed, done = time.monotonic(), 0, 0
    try:
        for batch, failures in results(options):
            done = batch.stop - options.first
            failed += len(failures)
            show(done, failed, time.monotonic() - begun, options.curves)
            for failure in failures:
                complain(failure, options.out)
    except KeyboardInterrupt:
        print("\nstopped by Ctrl-C", file=sys.stderr)
    print(f"\n{done:,} curves judged, {failed} failed; go on with --first {options.first + done}")
    return failed


def replay(file: Path) -> int:
    """Judge a saved curve again; return the number of failures."""
    failure = judged(load(file))
    print(failure.problem if failure else "nothing is wrong any more")
    return int(failure is not None)


def arguments(words: list[str] | None) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="nightly", description=__doc__)
    parser.add_argument("--curves", type=int, default=100_000)
    parser.add_argument("--seconds", type=float, default=math.inf, help="stop after so long; default: never")
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed; default 0")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--out", type=Path, default=Path("out", "nightly"), help="folder for curves that failed")
    parser.add_argument("--replay", type=Path, metavar="FILE", help="judge a curve that was saved")
    return parser.parse_args(words)


def main(words: list[str] | None = None) -> int:
    """Return 0 if all is well, 1 if anything failed."""
    options = arguments(words)
    return int((replay(options.replay) if options.replay else run(options)) > 0)


if __name__ == "__main__":
    sys.exit(main())
