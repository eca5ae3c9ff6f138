"""Draw the pictures of docs/homotopy.md, and write its table: ``python docs/homotopy_pictures.py``."""

from __future__ import annotations

import resource
import time
from pathlib import Path

import numpy as np
from panels import panels, titled

import plyfold as pf
from plyfold.draw.homotopy_plot import draw_contraction
from plyfold.homotopy.contraction import contraction_of

DOCUMENT = Path(__file__).parent / "homotopy.md"
BEGIN, END = "<!-- measured -->\n", "<!-- end of measured -->\n"

KITE = [(1, 0), (3, 0), (3, 4), (-3, 4), (-3, 0), (-1, 0), (1, 1), (1, 3), (2.2, 2), (-2, 2), (-1, 3), (-1, 1)]
LIMACON = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
TIMES = (0.0, 0.15, 0.3, 0.5, 0.7, 0.9)


def random_polygon(seed: int, points: int) -> list[tuple[int, int]]:
    """Return points anywhere in a square."""
    return [(int(x), int(y)) for x, y in np.random.default_rng(seed).integers(-1000, 1001, (points, 2))]


def loops() -> None:
    """Draw curves with their winding numbers, and the loops that they are cut into."""
    shown = {"one loop more": KITE, "a branch point": LIMACON, "random": random_polygon(2, 14)}
    with panels("homotopy", 2, len(shown), (11, 7.4)) as axes:
        for name, points in shown.items():
            titled(before := next(axes), f"{name}: w")
            pf.draw.plot_arrangement(points, before)
        for points in shown.values():
            found = pf.least_homotopy(points)
            titled(after := next(axes), f"sweeps {found.area:.6g}, |w| alone {found.winding_area:.6g}")
            pf.draw.plot_homotopy(found, after)


def film() -> None:
    """Draw a contraction at some times."""
    contraction = contraction_of(pf.least_homotopy(random_polygon(2, 14)))
    with panels("contraction", 2, 3, (11, 7.4)) as axes:
        for moment in TIMES:
            titled(ax := next(axes), f"swept: {contraction.swept(moment):.4g}")
            draw_contraction(contraction, moment, ax)


def row(points: int) -> str:
    """Return a line of the table."""
    arranged = pf.arrange(random_polygon(1, points))
    start = time.perf_counter()
    found = pf.least_homotopy(arranged)
    seconds = time.perf_counter() - start
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
    more = 100 * (found.area / found.winding_area - 1)
    return f"| {points} | {arranged.n_crossings:,} | {len(found.loops)} | {more:.0f} % | {seconds:.2g} | {memory} |\n"


def measured() -> None:
    """Write the table between its marks."""
    before, _, rest = DOCUMENT.read_text().partition(BEGIN)
    titles = ["points", "crossings", "loops", "more than the lower bound", "seconds", "MB of the process"]
    head = f"| {' | '.join(titles)} |\n|{'---|' * len(titles)}\n"
    table = "".join(map(row, (20, 40, 60, 80, 100)))
    DOCUMENT.write_text(before + BEGIN + head + table + END + rest.partition(END)[2])


if __name__ == "__main__":
    measured()
    loops()
    film()
