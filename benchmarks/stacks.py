"""Heights of cloth that lies on itself over and over: ``python benchmarks/stacks.py``, minutes.

Bands and helices whose turns all lie on each other, dense disks, outlines with many cusps, and ever more triangles: the
processor's seconds for the heights alone, the least of some runs, each case in a process of its own. ``--against
FOLDER`` measures another checkout of plyfold in turn with this one; ``--busy`` measures again while every processor has
something else to do. Last comes the exponent in triangles on the bands.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
from families import band, glued_disk
from outlines import cusped_chain
from surfaces import helix
from tables import markdown, number

import plyfold as pf
from plyfold.gallery import CURVES
from plyfold.mesh.cells import triangulate_cells
from plyfold.surface.glue import stack_sheets
from plyfold.surface.heights import smooth_heights
from plyfold.surface.lift import layering_of

HERE = Path(__file__).resolve().parent
TURNS = (5, 10, 20, 40)
CASES = ("helix 15", *(f"band {turns}" for turns in TURNS), "dense 500", "dense 1000", "cusps 10", "pretzel 100000")
LONG = ("band 60", "cusps 1000", "pretzel 1000000")


def drawn(case: str) -> tuple[Any, int]:
    """Return the outline of a case, and how many triangles its surface shall have."""
    kind, size = case.split()
    count = int(size)
    if kind == "helix":
        return helix(count), 4000
    if kind == "band":
        return band(120 * count), 4000
    if kind == "dense":
        return glued_disk(count), 4000
    if kind == "cusps":
        return cusped_chain(count, 40 * count if count < 100 else 20 * count), 4000
    return CURVES[kind].draw(40), count


def measured(case: str) -> dict[str, float]:
    """Return the number of triangles, and the least of the processor's seconds for the heights."""
    outline, triangles = drawn(case)
    layering = layering_of(outline, False)
    arrangement = layering.immersion.arrangement
    cells = triangulate_cells(arrangement, triangles=triangles)
    mesh, gap = stack_sheets(layering, cells), 0.05 * float(np.ptp(arrangement.exact_points, axis=0).max())
    seconds: list[float] = []
    begun = time.perf_counter()
    while not seconds or (len(seconds) < 5 and time.perf_counter() - begun < 5):
        start = time.process_time()
        z = smooth_heights(cells.points, mesh, gap)
        seconds.append(time.process_time() - start)
    return {"triangles": len(mesh.faces), "seconds": min(seconds), "gaps": float(np.ptp(z)) / gap}


def in_checkout(case: str, folder: Path, limit: float) -> dict[str, float] | None:
    """Measure a case with the plyfold of a folder, in a process of its own; None if it takes too long."""
    paths = os.pathsep.join([str(folder / "src"), str(HERE)])
    command = [sys.executable, "-W", "ignore", str(HERE / "stacks.py"), "--case", case]
    try:
        done = subprocess.run(
            command, env=os.environ | {"PYTHONPATH": paths}, capture_output=True, text=True, check=True, timeout=limit
        )
    except subprocess.TimeoutExpired:
        return None
    found: dict[str, float] = json.loads(done.stdout)
    return found


def row_of(case: str, folders: list[Path], busy: bool, limit: float) -> tuple[list[str], float, float]:
    """Measure a case; return its line of the table, its triangles and its seconds with the last folder."""
    idle = [in_checkout(case, folder, limit) for folder in folders]
    last = idle[-1] or {"triangles": np.nan, "seconds": np.nan, "gaps": np.nan}
    line = [case, f"{last['triangles']:,.0f}", *(number(one["seconds"]) if one else f"> {limit:g}" for one in idle)]
    line.append(f"{last['gaps']:.3f}")
    if busy:
        with ExitStack() as stack:
            for _ in range(os.cpu_count() or 1):
                neighbour = stack.enter_context(subprocess.Popen([sys.executable, "-c", "while True: pass"]))
                stack.callback(neighbour.kill)
            beside = in_checkout(case, folders[-1], 3 * limit)
        line.append(f"{beside['seconds'] / last['seconds']:.2f}" if beside else "?")
    return line, last["triangles"], last["seconds"]


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--against", type=Path, metavar="FOLDER", help="another checkout, measured first")
    parser.add_argument("--busy", action="store_true", help="once more beside busy neighbours")
    parser.add_argument("--long", action="store_true", help="the largest ones too")
    parser.add_argument("--limit", type=float, default=100.0, metavar="SECONDS", help="for each case")
    parser.add_argument("--only", nargs="*", help="cases")
    parser.add_argument("--case", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.case:
        print(json.dumps(measured(options.case)))
        return
    folders = [*([options.against] if options.against else []), HERE.parent]
    cases = options.only or [*CASES, *(LONG if options.long else ())]
    found = {case: row_of(case, folders, options.busy, options.limit) for case in cases}
    heads = ["case", "triangles", *["s before"][: len(folders) - 1], "s", "height in gaps"]
    print(markdown([*heads, *["busy / idle"][: options.busy]], [line for line, _, _ in found.values()]))
    bands = np.array([found[f"band {turns}"][1:] for turns in TURNS if f"band {turns}" in found])
    if len(bands) > 1:
        print(
            f"\nexponent in triangles on bands: {np.polyfit(*np.log(bands).T, 1)[0]:.2f}, with plyfold {pf.__version__}"
        )


if __name__ == "__main__":
    main()
