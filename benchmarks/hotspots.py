"""Where the time goes: ``python benchmarks/hotspots.py FAMILY VERTICES`` prints the costliest functions by stage."""

from __future__ import annotations

import argparse
import cProfile
import pstats
from collections.abc import Iterator

import numpy as np
from contenders import SMALL_RAMP, Points, Step, plyfold_steps, triangle_steps
from families import FAMILIES


def all_steps(points: Points) -> Iterator[Step]:
    """Yield the stages: arrangement, sheets, count, triangulation."""
    yield from plyfold_steps(points)
    yield from triangle_steps(points)


def profiled(family: str, vertices: int, seed: int, functions: int) -> None:
    """Run the stages once, each under the profiler, and print the functions that took longest by themselves."""
    list(all_steps(np.array(SMALL_RAMP, dtype=np.float64)))  # loads the modules
    steps = all_steps(FAMILIES[family].draw(vertices, seed))
    while True:
        profile = cProfile.Profile()
        step = profile.runcall(next, steps, None)
        if step is None:
            break
        stage, seconds, facts = step
        print(f"\n=== {stage}: {seconds:.3f} s (slower than without the profiler); {facts}")
        pstats.Stats(profile).strip_dirs().sort_stats("tottime").print_stats(functions)


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("family", choices=FAMILIES)
    parser.add_argument("vertices", type=int)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--functions", type=int, default=12, help="how many to print for each stage")
    options = parser.parse_args()
    profiled(options.family, options.vertices, options.seed, options.functions)


if __name__ == "__main__":
    main()
