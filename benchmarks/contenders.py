"""What is timed, each in a process of its own: ``python contenders.py NAME POINTS.npy [--plain]``.

It prints one JSON line per stage. With ``--plain`` the hot loops run as plain Python.

A line has "stage" and "seconds" (the best of the runs so far), facts about the curve, and "megabytes": how much the
peak of memory has grown since a small curve was worked through, which loads all modules.
"""

from __future__ import annotations

import gc
import json
import os
import resource
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float64]
Step = tuple[str, float, dict[str, Any]]
"""A stage, its seconds, and facts learnt."""

REPEATS = 10
REPEAT_FOR_SECONDS = 1.0


def timed(action: Callable[[], Any]) -> tuple[float, Any]:
    """Run once; return the seconds of the processor and the result."""
    gc.collect()
    start = time.process_time()
    result = action()
    return time.process_time() - start, result


def plyfold_steps(points: Points) -> Iterator[Step]:
    """Arrangement; verdict with all sheets and their gluing; the count, on a fresh arrangement."""
    import plyfold as pf

    seconds, drawn = timed(lambda: pf.arrange(points))
    facts = {"k": drawn.n_crossings, "w": int(drawn.winding.max()), "moved": len(drawn.curve.repairs)}
    yield "arrangement", seconds, facts
    seconds, verdict = timed(lambda: pf.find_immersion(drawn))
    glued = len(verdict.gluing) if isinstance(verdict, pf.Immersion) else None
    yield "sheets", seconds, {"disk": bool(verdict), "reason": getattr(verdict, "reason", ""), "glued": glued}
    fresh = pf.arrange(points)
    seconds, count = timed(lambda: pf.count_immersions(fresh))
    yield "count", seconds, {"immersions": str(count)}


def triangle_steps(points: Points) -> Iterator[Step]:
    """Triangulation, from the immersion."""
    import plyfold as pf

    drawn = pf.arrange(points)
    immersion = pf.find_immersion(drawn)
    if isinstance(immersion, pf.Immersion):
        seconds, faces = timed(lambda: pf.triangulate(drawn, immersion))
        yield "triangulate", seconds, {"triangles": len(faces)}


def lift_steps(points: Points) -> Iterator[Step]:
    """Layering, and the lifted surface."""
    import plyfold as pf

    immersion = pf.find_immersion(points)
    if isinstance(immersion, pf.Immersion):
        seconds, layering = timed(lambda: pf.find_layering(immersion))
        yield "layering", seconds, {}
        if isinstance(layering, pf.Layering):
            seconds, surface = timed(lambda: pf.lift(layering))
            yield "lift", seconds, {"faces": len(surface.faces)}


def geos_steps(points: Points) -> Iterator[Step]:
    """Node the closed line, and make its cells."""
    import shapely

    seconds, _ = timed(lambda: shapely.polygonize([shapely.unary_union(shapely.LinearRing(points))]))
    yield "GEOS", seconds, {"version": shapely.geos_version_string}


def reference_steps(points: Points) -> Iterator[Step]:
    """Run the O(n³) dynamic program over the vertices of the polygon, from the tests."""
    sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
    from reference import shor_van_wyk

    polygon = [(int(x), int(y)) for x, y in points]
    if shor_van_wyk.turning_number(polygon) < 0:
        polygon.reverse()
    seconds, triangles = timed(lambda: shor_van_wyk.triangulation(polygon))
    yield "reference", seconds, {"disk": triangles is not None}


CONTENDERS: dict[str, Callable[[Points], Iterator[Step]]] = {
    "plyfold": plyfold_steps,
    "GEOS": geos_steps,
    "triangles": triangle_steps,
    "reference": reference_steps,
    "lift": lift_steps,
}

SMALL_RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]


def peak_megabytes() -> float:
    """Return the largest memory of this process so far."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)


def measure(steps: Callable[[Points], Iterator[Step]], points: Points) -> Iterator[dict[str, Any]]:
    """Yield the stages as they finish, then again better times while repeats are cheap."""
    for _ in steps(np.array(SMALL_RAMP, dtype=np.float64)):
        pass
    # The collector need not walk through all modules before every run, which would empty the processor's caches.
    gc.freeze()
    best: dict[str, float] = {}
    idle, begun = peak_megabytes(), time.perf_counter()
    for _ in range(REPEATS):
        for stage, seconds, facts in steps(points):
            best[stage] = min(seconds, best.get(stage, seconds))
            yield {"stage": stage, "seconds": best[stage], "megabytes": peak_megabytes() - idle, **facts}
        if time.perf_counter() - begun > REPEAT_FOR_SECONDS:
            return


def main() -> None:
    """Print the lines; what a contender raises becomes its last line."""
    name, file, *options = sys.argv[1:]
    if "--plain" in options:
        os.environ["PLYFOLD_PURE"] = "1"
    try:
        for line in measure(CONTENDERS[name], np.load(file)):
            print(json.dumps(line), flush=True)
    except Exception as error:  # a benchmark reports failures of what it measures, of any kind
        print(json.dumps({"failed": f"{type(error).__name__}: {error}"}), flush=True)


if __name__ == "__main__":
    main()
