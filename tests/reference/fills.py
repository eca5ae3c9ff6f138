"""Winding numbers by exact rays, and exact areas and cells of drawings that touch, by cutting them into slabs.

Slow and by definition, in fractions; nothing is moved and nothing is noded.
"""

from collections import defaultdict
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

Point = tuple[Fraction, Fraction]
Edge = tuple[Point, Point]


def edges_of(loops: Sequence[Sequence[Sequence[float]]]) -> list[Edge]:
    """All edges, as given."""
    found = []
    for loop in loops:
        points = [(Fraction(float(x)), Fraction(float(y))) for x, y in loop]
        found += list(zip(points, [*points[1:], points[0]], strict=True))
    return found


def winding_by_ray(loops: Sequence[Sequence[Sequence[float]]], x: float, y: float) -> int:
    """How often the loops wind round a place a little to the right of the given one, and by far less above it.

    Along a ray to the right of it at its height, edges count that pass the height upwards or downwards.
    """
    px, py = Fraction(x), Fraction(y)
    total = 0
    for (ax, ay), (bx, by) in edges_of(loops):
        if (ay <= py) != (by <= py):
            met = ax + (py - ay) / (by - ay) * (bx - ax)
            total += ((by > ay) - (by < ay)) * (met > px)
    return total


def is_on(loops: Sequence[Sequence[Sequence[float]]], x: float, y: float) -> bool:
    """Whether a place lies on the loops."""
    px, py = Fraction(x), Fraction(y)
    return any(
        (bx - ax) * (py - ay) == (by - ay) * (px - ax)
        and min(ax, bx) <= px <= max(ax, bx)
        and min(ay, by) <= py <= max(ay, by)
        for (ax, ay), (bx, by) in edges_of(loops)
    )


class Trapezoid(NamedTuple):
    """A part of a slab between two heights on its left and two on its right, with its winding number."""

    left: tuple[Fraction, Fraction]
    right: tuple[Fraction, Fraction]
    winding: int


def cells_by_slabs(loops: Sequence[Sequence[Sequence[float]]]) -> list[tuple[int, Fraction]]:
    """Winding number and area of every connected cell whose winding number is not 0, sorted.

    Between the x of neighbouring vertices and crossings no edges cross. Cells hang together where trapezoids of
    neighbouring slabs with one winding number have more than a point in common.
    """
    edges = edges_of(loops)
    cuts = sorted({end[0] for edge in edges for end in edge} | set(_crossings(edges)))
    slabs = [(_trapezoids(edges, low, high), high - low) for low, high in pairwise(cuts)]
    area: dict[int, Fraction] = defaultdict(Fraction)
    joined: list[int] = []
    winding: list[int] = []

    def root(number: int) -> int:
        while joined[number] != number:
            number = joined[number]
        return number

    before: list[tuple[int, Trapezoid]] = []
    sizes: list[Fraction] = []
    for trapezoids, width in slabs:
        here = []
        for part in trapezoids:
            number = len(joined)
            joined.append(number)
            winding.append(part.winding)
            sizes.append((part.left[1] - part.left[0] + part.right[1] - part.right[0]) * width / 2)
            here.append((number, part))
            for other, beside in before:
                common = min(beside.right[1], part.left[1]) - max(beside.right[0], part.left[0])
                if beside.winding == part.winding and common > 0:
                    joined[root(number)] = root(other)
        before = here
    for number, size in enumerate(sizes):
        area[root(number)] += size
    return sorted((winding[number], size) for number, size in area.items())


def _crossings(edges: Sequence[Edge]) -> list[Fraction]:
    """The x of all places where two edges that are not parallel cross."""
    found = []
    for i, ((ax, ay), (bx, by)) in enumerate(edges):
        for (cx, cy), (dx, dy) in edges[:i]:
            below = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
            if below:
                t = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / below
                s = ((cx - ax) * (by - ay) - (cy - ay) * (bx - ax)) / below
                if 0 <= t <= 1 and 0 <= s <= 1:
                    found.append(ax + t * (bx - ax))
    return found


def _trapezoids(edges: Sequence[Edge], low: Fraction, high: Fraction) -> list[Trapezoid]:
    """The trapezoids of a slab that are wound round, from below; edges in one place count together."""
    passing: dict[tuple[Fraction, Fraction], int] = defaultdict(int)
    for (ax, ay), (bx, by) in edges:
        if min(ax, bx) <= low and high <= max(ax, bx) and ax != bx:
            heights = tuple(ay + (x - ax) / (bx - ax) * (by - ay) for x in (low, high))
            passing[heights[0], heights[1]] += 1 if ax < bx else -1
    lines = sorted((line for line, times in passing.items() if times), key=sum)
    found, winding = [], 0
    for below, above in pairwise(lines):
        # Above an edge that runs to the right the winding number is larger.
        winding += passing[below]
        if winding:
            found.append(Trapezoid((below[0], above[0]), (below[1], above[1]), winding))
    return found
