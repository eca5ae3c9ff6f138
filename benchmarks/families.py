"""Families of closed curves for the benchmarks: each draws a curve with about a wanted number of vertices, by seed.

All return (n, 2) floats with whole values, counter-clockwise where that has a meaning, in general position almost
always. The same seed draws the same curve.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.polylines import winding_number
from plyfold.gallery import ribbon

Points = npt.NDArray[np.float64]

UNIT = 1_000_000
"""Grid steps per width of a ribbon, or per triangle: coordinates are whole numbers."""

POINTS_PER_LOOP = 24
CROSSINGS_PER_LOOP = 4


def on_grid(points: Points) -> Points:
    """Round to whole numbers of grid steps."""
    return np.round(points * UNIT)


def turned(points: Points, rng: np.random.Generator) -> Points:
    """Turn the drawing by a random angle: no vertex lies straight above another by design."""
    angle = rng.uniform(0, 2 * np.pi)
    x, y = points.T
    return np.stack([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)], axis=1)


def ribbon_disk(vertices: int, seed: int = 0, wildness: float = 0.05) -> Points:
    """Return the outline of a ribbon of constant width along a wandering line: it bounds an immersed disk.

    The line bends by at most 0.8 radians per step, so the ribbon (width 0.8) never folds over. A wildness of 0.05 gives
    about n / 3 crossings, 0.3 gives more than n.
    """
    rng = np.random.default_rng(seed)
    pushes = wildness * rng.normal(size=vertices // 2)
    bend = np.array(list(accumulate(pushes, lambda old, push: max(-0.8, min(0.8, 0.97 * old + push)))))
    heading = np.cumsum(bend)
    steps = np.exp(1j * (heading + bend / 2))
    place = np.cumsum(steps) - steps
    side = 0.4j * np.exp(1j * heading)
    outline = np.concatenate([place - side, (place + side)[::-1]])
    return on_grid(np.stack([outline.real, outline.imag], axis=1))


def loops(count: float, steps: int) -> Points:
    """Return the centre line of a chain of loops: a prolate cycloid; loops next to each other stay apart."""
    t = np.linspace(-np.pi, (2 * count - 1) * np.pi, steps)
    return np.stack([1.4 * t - 3 * np.sin(t), -3 * np.cos(t)], axis=1)


def coil(vertices: int, seed: int = 0) -> Points:
    """Return a ribbon around a coiled path of 12 loops: 48 crossings, sampled finer as n grows (from n = 400)."""
    rng = np.random.default_rng(seed)
    return on_grid(turned(ribbon(loops(12, vertices // 2), 0.8), rng))


def chain(vertices: int, seed: int = 0) -> Points:
    """Return a ribbon around a path with one loop per 48 vertices: the crossings grow with n, four per loop."""
    rng = np.random.default_rng(seed)
    steps = vertices // 2
    return on_grid(turned(ribbon(loops(steps / POINTS_PER_LOOP, steps), 0.8), rng))


def spiral(vertices: int, seed: int = 0) -> Points:
    """Return a wavy ribbon that winds round √n / 10 times, all turns over one another: winding numbers grow as √n.

    Any two turns cross each other several times on both sides, so k is about n / 7.
    """
    rng = np.random.default_rng(seed)
    turns = max(1.0, np.sqrt(vertices) / 10)
    t = np.linspace(0, 2 * np.pi * turns, vertices // 2)
    radius = 4 + 0.2 * t / t[-1] + 0.1 * np.sin((6 + 5**0.5) * t + rng.uniform(0, 2 * np.pi))
    return on_grid(ribbon(np.stack([radius * np.cos(t), radius * np.sin(t)], axis=1), 1.2))


def band(vertices: int, seed: int = 0) -> Points:
    """Return a wide band wound round and round, 60 points a side and turn; two crossings for each turn but one.

    With each turn the radii, 10 and 5.005 at first, grow by 0.01, so that no two strands coincide before turn 500. Each
    turn lies on all of the others, everywhere: winding numbers grow as n, and the triangles as n².
    """
    rng = np.random.default_rng(seed)
    turn = np.arange(vertices // 2) / 60
    outer = (10 + 0.01 * turn) * np.exp(2j * np.pi * turn)
    # Half a step on, for the ends are not to pass through the points of other turns.
    inner = (5.005 + 0.01 * turn) * np.exp(2j * np.pi * (turn + 1 / 120))
    outline = np.concatenate([outer, inner[::-1]])
    return on_grid(turned(np.stack([outline.real, outline.imag], axis=1), rng))


def random_walk(vertices: int, seed: int = 0) -> Points:
    """Return a random walk closed up: it practically never bounds a disk."""
    steps = np.random.default_rng(seed).normal(size=(vertices, 2))
    return on_grid(np.cumsum(steps - steps.mean(axis=0), axis=0))


def angle_at(middle: Points, before: Points, after: Points) -> npt.NDArray[np.float64]:
    """Return the angle, less than π, at the middle vertex of each triangle."""
    one, other = before - middle, after - middle
    angles = np.arctan2(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0], (one * other).sum(axis=1))
    return np.asarray(np.abs(angles), dtype=np.float64)


def glued_disk(vertices: int, seed: int = 0, pull: float = 0.1) -> Points:
    """Return the outline of a disk glued from random triangles: it bounds an immersed disk.

    In rounds: about a quarter of the boundary edges, no two of them neighbours, get a new positively oriented triangle
    each, with its apex on their right. All vertices stay on the boundary, and the triangles round each add up to less
    than a full turn, so the disk is immersed at its boundary too. `pull` (0 to 1) draws the apexes towards the first
    triangle, which piles them up: with 0.1, n = 3,000 has 54,000 crossings and winding numbers up to 48.
    """
    rng = np.random.default_rng(seed)
    boundary = np.array([(0, 0), (UNIT, 0), (UNIT // 2, UNIT)], dtype=np.float64)
    angles = angle_at(boundary, np.roll(boundary, 1, axis=0), np.roll(boundary, -1, axis=0))
    while len(boundary) < vertices:
        chosen, apex = proposals(rng, boundary, pull)
        following = (chosen + 1) % len(boundary)
        starts, ends = boundary[chosen], boundary[following]
        at_start, at_end = angle_at(starts, apex, ends), angle_at(ends, starts, apex)
        free = (angles[chosen] + at_start < 1.99 * np.pi) & (angles[following] + at_end < 1.99 * np.pi)
        kept = rng.permutation(np.flatnonzero(free))[: vertices - len(boundary)]
        angles[chosen[kept]] += at_start[kept]
        angles[following[kept]] += at_end[kept]
        angles = np.insert(angles, chosen[kept] + 1, angle_at(apex, starts, ends)[kept])
        boundary = np.insert(boundary, chosen[kept] + 1, apex[kept], axis=0)
    return boundary


def proposals(rng: np.random.Generator, boundary: Points, pull: float) -> tuple[npt.NDArray[np.int64], Points]:
    """Return boundary edges, no two of them neighbours, and a random apex to the right of each."""
    wanted = rng.random(len(boundary)) < 0.5
    chosen = np.flatnonzero(wanted & ~np.roll(wanted, 1))
    start, end = boundary[chosen], boundary[(chosen + 1) % len(boundary)]
    apex = np.round((1 - pull) * (start + end) / 2 + rng.uniform(-UNIT, UNIT, start.shape))
    along, across = end - start, apex - start
    outside = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0] < 0
    return chosen[outside], apex[outside]


KINK = 0.2 * UNIT
"""Size of a curl; the edges of a ribbon are at least three times as long."""


def curl(start: Points, end: Points, size: float, side: int) -> Points:
    """Return three points that turn the edge from start to end once round, to its left (side 1) or right (side -1)."""
    middle, along = (start + end) / 2, (end - start) / np.hypot(*(end - start)) * size
    across = side * np.array([-along[1], along[0]])
    return np.stack([middle + along, middle + across, middle - (along + across) / 2])


def covered_edge(outline: Points) -> int:
    """Return an edge of a ribbon's right side that has another part of the ribbon on its right, by trying in order."""
    for edge in range(len(outline) // 2 - 1):
        ahead, tip, _ = curl(outline[edge], outline[edge + 1], 1.2 * KINK, -1)
        middle = (outline[edge] + outline[edge + 1]) / 2
        corners = (tip, ahead + 0.1 * (tip - middle), middle - (ahead - middle) + 0.1 * (tip - middle))
        if all((winding_number(outline, (x, y)) or 0) >= 1 for x, y in corners):
            return edge
    raise ValueError("this ribbon does not lie on itself: try another seed, or more vertices")


def kinked(vertices: int, seed: int = 0, why: str = "no grouping") -> Points:
    """Return a wild ribbon with small flaws, so that it bounds no disk.

    `why`: "turning number" (a curl to the right: it turns 0 times), "negative winding" (curls to the left and to the
    right, where nothing lies), or "no grouping" (the same, with another part of the ribbon on the right, so that no
    cell winds negatively). The last two depend on the place as well: a few seeds give the other.
    """
    outline = ribbon_disk(2 * (vertices // 2) - 6, seed, wildness=0.3)
    lowest = int(np.argmin(outline[:, 1]))
    right = covered_edge(outline) if why == "no grouping" else lowest % (len(outline) - 1)
    flaws = {right: -1} if why == "turning number" else {right: -1, (right + len(outline) // 2) % (len(outline) - 1): 1}
    curls = [curl(outline[edge], outline[edge + 1], KINK, side) for edge, side in flaws.items()]
    return np.round(np.insert(outline, np.repeat([edge + 1 for edge in flaws], 3), np.concatenate(curls), axis=0))


@dataclass(frozen=True)
class Family:
    """A family: what it is, how it is drawn (vertices, seed), whether it bounds a disk, and the sizes to measure."""

    title: str
    draw: Callable[[int, int], Points]
    disk: bool
    sizes: tuple[int, ...]


DECADES = (100, 200, 500, 1_000, 3_000, 10_000, 30_000, 100_000, 300_000, 1_000_000)

FAMILIES: Mapping[str, Family] = {
    "ribbon": Family("a ribbon along a wandering line", ribbon_disk, True, (*DECADES[:7], 60_000, *DECADES[7:])),
    "wild-ribbon": Family(
        "the same, wandering wildly: more crossings than vertices",
        lambda vertices, seed: ribbon_disk(vertices, seed, wildness=0.3),
        True,
        DECADES,
    ),
    "coil": Family("a ribbon of 12 loops, sampled ever finer", coil, True, (400, 1_600, *DECADES[5:])),
    "chain": Family("a ribbon with one loop for 48 vertices", chain, True, DECADES),
    "spiral": Family("a wavy ribbon that lies on itself √n / 10 times", spiral, True, DECADES),
    "band": Family("a wide band wound n / 120 times on itself", band, True, (240, 720, 1_440, 2_880, 7_200)),
    "dense-disk": Family("random triangles glued", glued_disk, True, (100, 200, 500, 1_000, 2_000, 3_000, 4_000)),
    "piled-disk": Family(
        "random triangles glued, all over the same place",
        lambda vertices, seed: glued_disk(vertices, seed, pull=0.8),
        True,
        (100, 200, 400, 800, 2_000),
    ),
    "kinked": Family("a wild ribbon with two small curls: no disk", kinked, False, DECADES[1:]),
    "random-walk": Family("a random walk closed up: no disk", random_walk, False, DECADES),
}


def main() -> None:
    """Draw a curve for other processes: ``python families.py FAMILY VERTICES SEED FILE.npy``, and FILE.txt."""
    name, vertices, seed, file = sys.argv[1:]
    points = FAMILIES[name].draw(int(vertices), int(seed))
    np.save(file, points)
    np.savetxt(Path(file).with_suffix(".txt"), points, fmt="%d")


if __name__ == "__main__":
    main()
