"""Seconds per stage on growing ribbons, beside what GEOS needs to node and polygonize the same loop.

``make benchmark`` prints a table; all figures are from one run, so the ratios hold on any machine.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import shapely

import plyfold as pf
from plyfold.gallery import ribbon

STEPS = (60, 200, 600, 2000)
REPEATS = 3


def coil(steps: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return the outline of a ribbon along a chain of loops, about one crossing of the ribbon for 20 steps."""
    t = np.linspace(0, 2 * np.pi * steps / 20, steps)
    return ribbon(np.stack([1.4 * t - 3 * np.sin(t), -3 * np.cos(t)], axis=1), 0.8)


def best(action: Callable[[], Any]) -> tuple[float, Any]:
    """Return the least time of a few runs, and the result."""
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        result = action()
        seconds.append(time.perf_counter() - start)
    return min(seconds), result


def geos(points: np.ndarray[Any, np.dtype[np.float64]]) -> Any:
    """Node the closed line and make its cells."""
    noded = shapely.unary_union(shapely.LinearRing(points))
    return shapely.polygonize([noded])


def main() -> None:
    """Print the table."""
    heads = (
        "vertices",
        "crossings",
        "cells s",
        "immersion s",
        "layering s",
        "lift s",
        "GEOS s",
        "(cells+immersion)/GEOS",
    )
    print(" | ".join(heads))
    for steps in STEPS:
        points = coil(steps)
        cells, drawn = best(lambda points=points: pf.arrangement(points))
        immersing, immersion = best(lambda drawn=drawn: pf.find_immersion(drawn))
        layering, layers = best(lambda immersion=immersion: pf.find_layering(immersion))
        lifting, _ = best(lambda layers=layers: pf.lift(layers))
        noding, _ = best(lambda points=points: geos(points))
        seconds = (f"{x:.4f}" for x in (cells, immersing, layering, lifting, noding))
        print(len(points), drawn.n_crossings, *seconds, f"{(cells + immersing) / noding:.1f}", sep=" | ")


if __name__ == "__main__":
    main()
