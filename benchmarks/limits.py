"""How punctual ``lift`` is: ``python benchmarks/limits.py``, bands wound round and round with several time limits.

Prints the seconds that were allowed and those it took, of the clock and of the processor; and how it ended.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator

from families import band

import plyfold as pf
from plyfold.errors import TimeLimitError

LIMITS = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0)


def ends(turns: int, limit: float) -> str:
    """Lift a band, and tell how it ends."""
    try:
        return repr(pf.lift(band(120 * turns), time_limit=limit))
    except TimeLimitError as error:
        return f"while {error.stage}"


def lines(turns: list[int], limits: list[float]) -> Iterator[str]:
    """Yield a line for each band and limit."""
    yield f"{'turns':>5} {'limit':>8} {'seconds':>8} {'cpu':>8}"
    for number in turns:
        for limit in limits:
            began, busy = time.perf_counter(), time.process_time()
            how = ends(number, limit)
            took, cpu = time.perf_counter() - began, time.process_time() - busy
            yield f"{number:5} {limit:8.2f} {took:8.2f} {cpu:8.2f}  {how}"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--turns", type=int, nargs="+", default=[24, 60])
    parser.add_argument("--limits", type=float, nargs="+", default=LIMITS, metavar="SECONDS")
    options = parser.parse_args()
    for line in lines(options.turns, options.limits):
        print(line, flush=True)


if __name__ == "__main__":
    main()
