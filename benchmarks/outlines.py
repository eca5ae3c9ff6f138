"""Outlines with cusps and with several loops, beside plain curves: ``python benchmarks/outlines.py``.

Cusps: a chain of limaçons, each with a cusp on its inner loop; the same chain with every cusp drawn out as a curl; and
a coiled ribbon with as many vertices and crossings. Loops: many ribbons side by side, and the same ones joined to one
loop by narrow bridges; rings inside rings, and one spiral whose strands lie as close. Prints milliseconds of the
processor, the least of some runs in which all outlines take turns: also for each vertex and crossing compared with a
wandering ribbon, and compared with the plain curve beside which an outline stands.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise

import numpy as np
import numpy.typing as npt
from families import loops, on_grid, ribbon_disk, turned

import plyfold as pf
from plyfold.gallery import chain, ribbon

Points = npt.NDArray[np.float64]

STAGES: dict[str, Callable[[pf.Arrangement], object]] = {
    "arrange": lambda arranged: pf.arrange(arranged.outline),
    "immersion": pf.find_immersion,
    "embedding": pf.find_embedding,
}
PEERS = [("cusps", "curls"), ("cusps", "coil"), ("loops", "joined"), ("rings", "spiral")]
CURL_STEPS = 9
# The width of a bridge between two loops, in edges.
BRIDGE = 1e-3


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


def coil(vertices: int, crossings: int) -> pf.Curve:
    """Return a ribbon that coils as often as so many crossings need."""
    line = loops(crossings / 4, vertices // 2)
    return pf.Curve(on_grid(turned(ribbon(line, 0.8), np.random.default_rng(0))))


def side_by_side(count: int, vertices: int) -> list[Points]:
    """Return ribbons that do not touch each other, in columns, up and down in turn."""
    ribbons = [ribbon_disk(vertices // count, seed) for seed in range(count)]
    width = max(np.ptp(points, axis=0).max() for points in ribbons) * 1.1
    side = int(np.ceil(np.sqrt(count)))
    places = [(column, side - 1 - row if column % 2 else row) for column in range(side) for row in range(side)]
    return [
        points - points.min(axis=0) + width * np.array(place) for points, place in zip(ribbons, places, strict=False)
    ]


def joined(ribbons: Sequence[Points]) -> pf.Curve:
    """Return ribbons joined to one loop, each to the next by a narrow bridge between corners that face each other."""
    whole = ribbons[-1]
    for one, other in list(pairwise(ribbons))[::-1]:
        here, there = facing_corners(one, other)
        whole = np.concatenate([opened(one, here), opened(whole, there)])
    return pf.Curve(whole)


def facing_corners(one: Points, other: Points) -> tuple[Points, Points]:
    """Return the outermost corners of two outlines in the direction from one to the other."""
    way = other.mean(axis=0) - one.mean(axis=0)
    axis = int(np.abs(way).argmax())
    towards = np.sign(way[axis])
    return one[(towards * one[:, axis]).argmax()], other[(towards * other[:, axis]).argmin()]


def opened(points: Points, corner: Points) -> Points:
    """Return a closed curve as one that is open at a corner, where it begins and ends."""
    points = np.roll(points, -np.flatnonzero((points == corner).all(axis=1))[0], axis=0)
    start, end = corner + BRIDGE * (points[[1, -1]] - corner)
    return np.concatenate([[start], points[1:], [end]])


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


def cases(vertices: int) -> dict[str, pf.Outline]:
    """Return outlines of about so many vertices."""
    cusped = cusped_chain(max(vertices // 100, 1), 100)
    ribbons = side_by_side(max(vertices // 1000, 2), vertices)
    return {
        "ribbon": pf.Curve(ribbon_disk(vertices)),
        "cusps": cusped,
        "curls": drawn_out(cusped),
        "coil": coil(len(cusped), len(cusped) // 100),
        "loops": pf.Outline(ribbons),
        "joined": joined(ribbons),
        "rings": rings(max(vertices // 500, 1), vertices),
        "spiral": spiral(max(vertices // 500, 1), vertices),
    }


def least(actions: Sequence[Callable[[], object]], runs: int) -> list[float]:
    """Return the milliseconds of the processor that each of some actions takes at least, of runs in turn."""
    took = np.empty((runs, len(actions)))
    for run in took:
        for number, action in enumerate(actions):
            began = time.process_time()
            action()
            run[number] = time.process_time() - began
    return [1000 * float(best) for best in took.min(axis=0)]


def lines(sizes: list[int], runs: int) -> Iterator[str]:
    """Yield tables: a line for each outline, and one for each outline beside its peer."""
    for vertices in sizes:
        arranged = {name: pf.arrange(outline) for name, outline in cases(vertices).items()}
        more = runs * max(1, 10_000 // vertices)
        took = {
            stage: dict(zip(arranged, least([partial(act, given) for given in arranged.values()], more), strict=True))
            for stage, act in STAGES.items()
        }
        yield from table(arranged, took)
    patch = cusped_chain(10, 40)
    decided, lifted = *least([lambda: pf.bounds_disk(patch)], 10 * runs), *least([lambda: pf.lift(patch)], 2 * runs)
    yield f"a patch of {len(patch)} points with 10 cusps: decided in {decided:.2f} ms, lifted in {lifted:.2f} ms"


def table(arranged: dict[str, pf.Arrangement], took: dict[str, dict[str, float]]) -> Iterator[str]:
    """Yield what outlines took, in milliseconds, and compared with each other."""
    size = {name: len(given.numbers) + given.n_crossings for name, given in arranged.items()}
    yield f"{'outline':14} {'n':>7} {'k':>7} " + " ".join(f"{stage:>16}" for stage in took)
    for name, given in arranged.items():
        each = ((times[name], times[name] / size[name] * size["ribbon"] / times["ribbon"]) for times in took.values())
        cells = " ".join(f"{time:9.2f} ({ratio:4.2f})" for time, ratio in each)
        yield f"{name:14} {len(given.numbers):7} {given.n_crossings:7} {cells}"
    for name, peer in PEERS:
        ratios = " ".join(f"{times[name] / times[peer]:16.2f}" for times in took.values())
        yield f"{name + ' / ' + peer:14} {'':15} {ratios}"
    yield ""


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
