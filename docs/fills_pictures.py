"""Rebuild the table of fills.md, what shapely's repairs lose of drawings that cross themselves: ``make pictures``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely

import plyfold as pf
from plyfold.arrays import Floats
from plyfold.gallery import CURVES

DOCUMENT = Path(__file__).parent / "fills.md"
BEGIN, END = "<!-- losses -->\n", "<!-- end of losses -->\n"


def drawings() -> dict[str, Floats]:
    """Return drawings that cross or touch themselves."""
    random = np.random.default_rng(0)
    return {
        "pentagram": CURVES["pentagram"].curve.points,
        "exit ramp": CURVES["exit-ramp"].curve.points,
        "figure eight": np.array([(0, 0), (4, 4), (4, 0), (0, 4)]),
        "square walked twice": np.array([(0, 0), (2, 0), (2, 2), (0, 2)] * 2),
        "two triangles that meet in a point": np.array([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]),
        "hole on a cut walked twice": np.array(
            [(0, 0), (9, 0), (9, 9), (4, 9), (4, 6), (6, 3), (3, 3), (4, 6), (4, 9), (0, 9)]
        ),
        "30 random points on a 10 × 10 grid": random.integers(0, 10, (30, 2)),
    }


def row(name: str, points: Floats) -> str:
    """Return a line of the table, areas as shares of what the drawing covers, counted as often as it does."""
    covered = sum(abs(cell.winding) * cell.polygon.area for cell in pf.coverage(points))
    positive, negative = pf.decompose(points, signed=True)
    pieces = sum(part.area for part in (*positive, *negative))
    polygon = shapely.Polygon(points)
    areas = (pieces, pf.fill(points).area, shapely.make_valid(polygon).area, polygon.buffer(0).area)
    return f"| {name} | {covered:.6g} | " + " | ".join(f"{100 * area / covered:.0f} %" for area in areas) + " |\n"


def losses() -> None:
    """Write the table between its marks."""
    before, _, rest = DOCUMENT.read_text().partition(BEGIN)
    titles = ["drawing", "Σ \\|w\\| · area", "`decompose`, signed", "`fill`", "`make_valid`", "`buffer(0)`"]
    head = f"| {' | '.join(titles)} |\n|{'---|' * len(titles)}\n"
    table = "".join(row(name, np.asarray(points, dtype=np.float64)) for name, points in drawings().items())
    DOCUMENT.write_text(before + BEGIN + head + table + END + rest.partition(END)[2])


if __name__ == "__main__":
    losses()
