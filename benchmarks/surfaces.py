"""Time of surfaces, stage by stage, their angles and heights: ``python benchmarks/surfaces.py``, a few minutes.

Sketches of up to 30 crossings with the usual number of triangles, from points, the best of five; and the pretzel with
ten thousand, a hundred thousand and a million triangles. Then the ranges of heights of the first layering, the nicest
one, and the one that stays low, with the time of the processor for lifting the first and the last. With ``--docs`` the
tables are written into docs/surfaces.md.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple, get_args

import numpy as np
from families import FAMILIES, chain, glued_disk, ribbon_disk
from tables import machine, markdown, number

import plyfold as pf
from plyfold.gallery import CURVES
from plyfold.mesh.cells import CellTriangulation, triangulate_cells
from plyfold.surface.choose import LayeringChoice
from plyfold.surface.glue import stack_sheets
from plyfold.surface.heights import smooth_heights
from plyfold.surface.lift import layering_of

PAGE = Path(__file__).parent.parent / "docs" / "surfaces.md"
PICTURE = "![Meshes of three drawings, and the smallest angles over the gallery](images/mesh.png)"
MOST_CROSSINGS = 30
STAGES = ("verdict", "mesh", "gluing", "heights")
LARGE = {
    "chain": (370, 1500),
    "coil": (400,),
    "ribbon": (300, 1000, 3000),
    "wild-ribbon": (100, 300, 1000),
    "dense-disk": (60, 100, 200),
    "piled-disk": (100,),
    "spiral": (1000,),
    "band": (720,),
}
ANGLES = (0, 5, 15, 25, 30, 40, 50, 60)


class Case(NamedTuple):
    """A curve, and how many triangles its surface shall have."""

    name: str
    points: Any
    triangles: int
    repeats: int


def between_radii(t: Any, outer: Any, inner: Any) -> Any:
    """Return the outline of a strip around the origin, of two radii at each angle."""
    direction = np.column_stack([np.cos(t), np.sin(t)])
    return np.vstack([outer[:, None] * direction, (inner[:, None] * direction)[::-1]])


def helix(turns: int) -> Any:
    """Return a band of 60 points a side and turn that winds ever a little further out: two crossings for each turn."""
    t = np.linspace(0, 2 * np.pi * turns + 0.3, 60 * turns)
    return between_radii(t, 3 + 0.01 * t, 2 + 0.01 * t)


def kiss(height: float) -> Any:
    """Return a band whose ends lie on each other for a sixth of a turn, with strands so close."""
    t = np.linspace(0, 2 * np.pi + 0.8, 260)
    sway = height * np.sin(6 * np.pi * np.clip((t - 2 * np.pi + 0.9) / 1.7, 0, 1))
    return between_radii(t, 3 + sway, 2 + 0.7 * sway)


def strip(width: float) -> Any:
    """Return a frame whose ends overlap: between them is a strip of this width, and half a unit long."""
    outer = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 5), (1, 5), (1, 9), (9, 9), (9, 1)]
    return np.array([*outer, (1.5, 1), (1.5, 5 + width), (0.5, 5 + width), (0.5, 2)])


def cases(largest: int) -> Iterator[Case]:
    """Yield sketches, and then one curve with ever more triangles."""
    sketches = {name: named.coarse().curve.points for name, named in CURVES.items() if named.embeddable}
    sketches |= {"ribbon of 300": ribbon_disk(300), "dense disk of 60": glued_disk(60), "chain of 370": chain(370)}
    sketches |= {f"helix of {turns} turns": helix(turns) for turns in (5, 10, 15)}
    sketches |= {f"strands {height:g} apart": kiss(height) for height in (1e-2, 1e-3)}
    sketches |= {f"strip of {width:g}": strip(width) for width in (1e-4, 1e-9)}
    for name, points in sketches.items():
        if pf.arrange(points).n_crossings <= MOST_CROSSINGS:
            yield Case(name, points, 4_000, 5)
    for triangles in (10_000, 100_000, 1_000_000):
        if triangles <= largest:
            yield Case("pretzel", CURVES["pretzel"].draw(40), triangles, 1)


def once(case: Case) -> tuple[list[float], pf.Layering, CellTriangulation, int]:
    """Lift a curve; return the seconds of each stage, and what it made."""
    seconds: list[float] = []

    def timed(stage: Callable[[], Any]) -> Any:
        start = time.perf_counter()
        made = stage()
        seconds.append(time.perf_counter() - start)
        return made

    layering = timed(lambda: layering_of(case.points, False))
    drawn = layering.immersion.arrangement
    mesh = timed(lambda: triangulate_cells(drawn, triangles=case.triangles))
    lifted = timed(lambda: stack_sheets(layering, mesh))
    timed(lambda: smooth_heights(mesh.points, lifted, 0.05 * float(np.ptp(drawn.curve.points, axis=0).max())))
    return seconds, layering, mesh, len(lifted.faces)


def smallest_angles(mesh: CellTriangulation) -> Any:
    """Return the smallest angle of each triangle, in degrees."""
    corner = mesh.points[mesh.triangles]
    to_next, to_last = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
    sine = to_next[..., 0] * to_last[..., 1] - to_next[..., 1] * to_last[..., 0]
    return np.degrees(np.arctan2(sine, (to_next * to_last).sum(axis=2))).min(axis=1)


def rows(case: Case) -> tuple[list[str], list[str]]:
    """Measure a curve: its line in the table of times, and in that of angles."""
    runs = [once(case) for _ in range(case.repeats)]
    _, layering, mesh, faces = runs[0]
    best = np.min([run[0] for run in runs], axis=0)
    crossings = layering.immersion.arrangement.n_crossings
    times = [case.name, str(crossings), f"{faces:,}", *map(number, 1000 * best), number(1000 * best.sum())]
    angles = smallest_angles(mesh)
    # A hair's breadth of rounding below a bound still meets it.
    count = np.histogram(angles + 1e-6, ANGLES)[0]
    return times, [case.name, f"{faces:,}", f"{angles.min():.1f}", *(f"{part:,}" for part in count)]


def choices() -> Iterator[tuple[str, Any]]:
    """Yield the curves that leave a choice between layerings."""
    yield from ((name, CURVES[name].curve) for name in ("pretzel", "knotted-ribbon", "pentagram"))
    for family, sizes in LARGE.items():
        yield from ((f"{family} of {size:,}", FAMILIES[family].draw(size, 0)) for size in sizes)


def chosen(name: str, points: Any) -> list[str]:
    """Lift a curve in three ways: its line in the table of heights."""
    drawn = pf.arrange(points)
    heights, seconds = {}, {}
    for choose in get_args(LayeringChoice):
        times = []
        for _ in range(3):
            start = time.process_time()
            surface = pf.lift(drawn, choose=choose)
            times.append(time.process_time() - start)
        heights[choose], seconds[choose] = np.ptp(surface.vertices[:, 2]) / surface.gap, 1000 * min(times)
    ranges = [f"{heights[choose]:.3f}" for choose in ("first", "nicest", "low")]
    return [name, str(drawn.n_crossings), *ranges, number(seconds["first"]), number(seconds["low"])]


def main() -> None:
    """Measure, print, and write the tables if asked to."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--largest", type=int, default=1_000_000, metavar="TRIANGLES")
    parser.add_argument("--docs", action="store_true", help="write the tables into docs/surfaces.md")
    options = parser.parse_args()
    measured = [rows(case) for case in cases(options.largest)]
    times = markdown(
        ["curve", "k", "triangles", *(f"{stage} ms" for stage in STAGES), "all ms"], [a for a, _ in measured]
    )
    between = [f"{low}–{high}°" for low, high in pairwise(ANGLES)]
    angles = markdown(["curve", "triangles", "least", *between], [b for _, b in measured])
    heights = markdown(
        ["curve", "k", "first", "nicest", "low", "first ms", "low ms"], [chosen(*case) for case in choices()]
    )
    where = machine([]).replace(", GEOS ?", "")
    text = f"# Surfaces: time and angles\n\nMade by `python benchmarks/surfaces.py --docs`. {where}\n\n"
    text += f"## Time\n\n{times}\n\n## The smallest angle of each triangle\n\n{PICTURE}\n\n{angles}\n\n"
    text += f"## The range of heights by the choice of the layering, in gaps\n\n{heights}\n"
    print(text)
    if options.docs:
        PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
