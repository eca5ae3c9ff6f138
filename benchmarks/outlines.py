"""Outlines with cusps and with several loops, beside plain curves: ``python benchmarks/outlines.py``.

Cusps: a chain of limaçons, each with a cusp on its inner loop; the same chain with every cusp drawn out as a curl; and
a ribbon with as many vertices. Loops: many ribbons side by side, and one ribbon; rings inside rings, and one spiral
whose strands lie as close. Prints milliseconds of the processor, the least of some runs, also for each vertex and
crossing compared with the ribbon.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt
from families import ribbon_disk

import plyfold as pf
from plyfold.gallery import chain

Points = npt.NDArray[np.float64]

STAGES: dict[str, Callable[[pf.Arrangement], object]] = {
    "arrange": lambda arranged: pf.arrange(arranged.outline),
    "immersion": pf.find_immersion,
    "embedding": pf.find_embedding,
}
CURL_STEPS = 9


def limacon(vertices: int) -> Points:
    """Return a limaçon: its inner loop lies to the left, and outermost points left and right are corners."""
    angle = (np.arange(vertices) + 0.25) * 2 * np.pi / vertices
    radius = 1 + 1.7 * np.cos(angle)
    return np.stack([radius * np.cos(angle), 1.3 * radius * np.sin(angle)], axis=1)


def cusped_chain(links: int, vertices: int) -> pf.Outline:
    """Return a chain of limaçons with a cusp on each inner loop, where it comes nearest to the left."""
    link = limacon(vertices)
    points = chain(link, links)
    tip = link[np.abs(link - [0.7, 0.0]).sum(axis=1).argmin()]
    step = 1.25 * np.ptp(link[:, 0])
    places = np.stack([tip[0] + step * np.arange(links), np.full(links, tip[1])], axis=1)
    cusps = [int(np.hypot(*(points - place).T).argmin()) for place in places]
    return pf.Curve(points, cusps=dict.fromkeys(cusps, 1))


def drawn_out(outline: pf.Outline) -> pf.Curve:
    """Return the same outline with every cusp of index 1 as a curl: once round it, inward, and straight out."""
    points, index = outline.points, outline.cusps[0]
    size = 0.2 * np.hypot(*np.diff(points, axis=0).T).min()
    pieces = []
    for vertex in range(len(points)):
        before, here, after = points[vertex - 1], points[vertex], points[(vertex + 1) % len(points)]
        pieces.append(curl(before - here, after - here, size) + here if index[vertex] else here[None])
    return pf.Curve(np.concatenate(pieces))


def curl(coming: Points, leaving: Points, size: float) -> Points:
    """Return a spiral inward, clockwise from one direction round to the other and once more."""
    start, end = np.arctan2(coming[1], coming[0]), np.arctan2(leaving[1], leaving[0])
    angle = start - np.linspace(0, (start - end) % (2 * np.pi) + 2 * np.pi, CURL_STEPS)
    radius = size * np.linspace(1, 0.5, CURL_STEPS)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


def side_by_side(count: int, vertices: int) -> pf.Outline:
    """Return ribbons that do not touch each other."""
    ribbons = [ribbon_disk(vertices // count, seed) for seed in range(count)]
    width = max(np.ptp(points, axis=0).max() for points in ribbons) * 1.1
    side = int(np.ceil(np.sqrt(count)))
    return pf.Outline(
        [points - points.min(axis=0) + width * np.array(divmod(i, side)) for i, points in enumerate(ribbons)]
    )


def rings(count: int, vertices: int) -> pf.Outline:
    """Return rings inside rings: loops that cross nothing, in turn counter-clockwise and clockwise."""
    angle = 2 * np.pi * np.arange(vertices // (2 * count)) / (vertices // (2 * count)) + 0.1
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return pf.Outline([(2 * count - i) * (circle[::-1] if i % 2 else circle) for i in range(2 * count)])


def spiral(turns: int, vertices: int) -> pf.Curve:
    """Return one curve that runs inward in a spiral and back beside itself, as crowded as so many pairs of rings."""
    share = np.linspace(0, 1, vertices // 2, endpoint=False)
    angle, radius = 2 * np.pi * turns * share + 0.1, 2 * turns * (1 - share) + 1.5
    direction = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return pf.Curve(np.concatenate([radius[:, None] * direction, (radius[::-1, None] - 1) * direction[::-1]]))


def cases(vertices: int) -> Iterator[tuple[str, pf.Outline]]:
    """Yield outlines of about so many vertices."""
    cusped = cusped_chain(max(vertices // 100, 1), 100)
    yield "ribbon", pf.Curve(ribbon_disk(vertices))
    yield "cusps", cusped
    yield "curls", drawn_out(cusped)
    yield "loops", side_by_side(max(vertices // 1000, 2), vertices)
    yield "rings", rings(max(vertices // 500, 1), vertices)
    yield "spiral", spiral(max(vertices // 500, 1), vertices)


def least(action: Callable[[], object], runs: int) -> float:
    """Return the milliseconds of the processor that an action takes at least."""
    took = []
    for _ in range(runs):
        began = time.process_time()
        action()
        took.append(time.process_time() - began)
    return 1000 * min(took)


def lines(sizes: list[int], runs: int) -> Iterator[str]:
    """Yield a line for each outline."""
    yield f"{'outline':8} {'n':>7} {'k':>7} " + " ".join(f"{stage:>16}" for stage in STAGES)
    for vertices in sizes:
        ribbon: dict[str, float] = {}
        for name, outline in cases(vertices):
            arranged = pf.arrange(outline)
            size = len(outline) + arranged.n_crossings
            cells = []
            for stage, action in STAGES.items():
                took = least(lambda act=action, given=arranged: act(given), runs)
                each = took / size
                ribbon.setdefault(stage, each)
                cells.append(f"{took:9.2f} ({each / ribbon[stage]:4.2f})")
            yield f"{name:8} {len(outline):7} {arranged.n_crossings:7} " + " ".join(cells)
    patch = cusped_chain(10, 40)
    decided, lifted = least(lambda: pf.bounds_disk(patch), 5 * runs), least(lambda: pf.lift(patch), runs)
    yield f"a patch of {len(patch)} points with 10 cusps: decided in {decided:.2f} ms, lifted in {lifted:.2f} ms"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vertices", type=int, nargs="+", default=[1000, 10000, 100000])
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    for line in lines(options.vertices, options.runs):
        print(line, flush=True)


if __name__ == "__main__":
    main()
