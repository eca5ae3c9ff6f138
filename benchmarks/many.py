"""What many outlines take: ``python benchmarks/many.py`` prints seconds of one core for a million of each kind.

The kinds: simple star-shaped 30-gons; and outlines of 40 points, half of them disks glued together of triangles, half
of them random. A smaller ``--count`` is measured and scaled.
"""

from __future__ import annotations

import argparse
import sys
import time

import numpy as np
from families import UNIT, Points, glued_disk

import plyfold as pf

MILLION = 1_000_000


def simple(count: int, points: int = 30) -> Points:
    """Return star-shaped polygons."""
    rng = np.random.default_rng(1)
    angle = 2 * np.pi * np.sort(rng.random((count, points)), axis=1)
    return rng.uniform(0.5, 1, (count, points, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def mixed(count: int, points: int = 40) -> Points:
    """Return outlines that are glued disks and random curves by turns; of the disks, 1000 are turned and stretched."""
    rng = np.random.default_rng(2)
    found = rng.random((count, points, 2))
    disks = np.stack([glued_disk(points, seed) for seed in range(min(count, 1000))]) / UNIT
    turn = np.exp(2j * np.pi * rng.random(count))
    place = (disks @ (1, 1j))[rng.integers(len(disks), size=count)] * turn[:, None]
    found[::2] = np.stack([place.real, place.imag * rng.uniform(0.5, 2, (count, 1))], axis=-1)[::2]
    return found


def measure(name: str, outlines: Points) -> None:
    """Print what the verdicts on some outlines take."""
    started = time.process_time()
    table = pf.verdicts(outlines)
    seconds = time.process_time() - started
    disks = np.count_nonzero(table["verdict"] == "disk")
    print(
        f"{name}: {len(table):,} outlines, {disks:,} disks, {seconds:.1f} s of one core; "
        f"for a million {seconds * MILLION / len(table):.1f} s"
    )


def main() -> int:
    """Measure what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=MILLION, help="how many outlines of each kind")
    count = parser.parse_args().count
    measure("simple 30-gons", simple(count))
    measure("40 points, half glued disks, half random", mixed(count))
    return 0


if __name__ == "__main__":
    sys.exit(main())
