"""What many outlines take: ``python benchmarks/many.py`` prints seconds of one core for a million of each kind.

The kinds: simple star-shaped 30-gons; and outlines of 40 points, half of them disks glued together of triangles, half
of them random. A smaller ``--count`` is measured and scaled. ``--batch`` has ``plyfold batch`` make a table of 10,000,
100,000 and so on up to so many simple 30-gons in a Parquet file instead, and prints seconds, and the memory of the
largest of its processes.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
import pyarrow
import shapely
from families import UNIT, Points, glued_disk
from pyarrow import parquet

import plyfold as pf

MILLION = 1_000_000
_ROWS_IN_GROUP = 50_000


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


def measure_batch(count: int, folder: Path) -> None:
    """Print what ``plyfold batch`` takes for some outlines in a file."""
    source, out = folder / "outlines.parquet", folder / "verdicts.parquet"
    with parquet.ParquetWriter(source, pyarrow.schema([("geometry", pyarrow.binary())])) as file:
        for start in range(0, count, _ROWS_IN_GROUP):
            wkb = shapely.to_wkb(shapely.polygons(simple(min(_ROWS_IN_GROUP, count - start))))
            file.write_table(pyarrow.table({"geometry": wkb}))
    started, largest = time.monotonic(), 0.0
    command = [sys.executable, "-m", "plyfold", "batch", source, "-o", out, "--force"]
    with subprocess.Popen(command, start_new_session=True, stdout=subprocess.DEVNULL) as process:
        while process.poll() is None:
            largest = max([largest, *map(peak, members(process.pid))])
            time.sleep(0.1)
    seconds = time.monotonic() - started
    print(f"{count:,} outlines: {seconds:.1f} s, largest process {largest:.0f} MB, exit code {process.returncode}")


def members(session: int) -> list[Path]:
    """Return the folders in which Linux tells of the processes of a session."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError, ProcessLookupError):
            if os.getsid(int(folder.name)) == session:
                found.append(folder)
    return found


def peak(process: Path) -> float:
    """Return the most memory that a process has had, in megabytes; 0 if it is gone."""
    with suppress(OSError):
        for line in (process / "status").read_text().splitlines():
            if line.startswith("VmHWM"):
                return int(line.split()[1]) / 1024
    return 0.0


def main() -> int:
    """Measure what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=MILLION, help="how many outlines of each kind")
    parser.add_argument("--batch", action="store_true", help="measure the command")
    options = parser.parse_args()
    count = options.count
    if options.batch:
        with tempfile.TemporaryDirectory() as folder:
            for size in (10**digits for digits in range(4, len(str(count)))):
                measure_batch(size, Path(folder))
        return 0
    measure("simple 30-gons", simple(count))
    measure("40 points, half glued disks, half random", mixed(count))
    return 0


if __name__ == "__main__":
    sys.exit(main())
