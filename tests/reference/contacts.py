"""Outlines that touch themselves, by definition: which are limits of disks, which are disks, and in how many ways.

*Limit*: some infinitely small moves of the vertices make an outline in general position that bounds a surface. Moves
are tried. They are infinitely small in earnest: `infinitely_small` is a size below the smallest root of everything that
is asked about the moved outline, so that every sign is that of the lowest order. *Strict*: the outline bounds a surface
with the angles that one sees, as it is; see `reference.touching_drawings`. Spikes are removed before.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import lcm
from typing import NamedTuple

import numpy as np

from reference import gluings, outline_gluings, touching_drawings
from reference.crossings import (
    DegenerateError,
    Point,
    cross,
    crossings_between,
    dot,
    edges,
    exact,
    minus,
    on_segment,
    passes_east,
)
from reference.outline_drawings import drawing_between
from reference.planar_maps import windings

Loop = Sequence[Point]
Move = Sequence[Sequence[Point]]
"""A vector for each vertex of each loop."""
Cusps = Sequence[Sequence[int]]


class Answer(NamedTuple):
    """How many surfaces an outline bounds as it is, and when all its vertices move outward."""

    strict: int
    outward: int


# ---- infinitely small moves ------------------------------------------------------------------------------------------


def infinitely_small(loops: Sequence[Loop], move: Move) -> Fraction:
    """A size of the move from which on down nothing changes.

    Everything that is asked is the sign of a polynomial of degree 8 at most in the coordinates: the side of a point on
    a line, the order of crossings along edges and bridges, whether three edges meet. In whole coordinates below 2^b, so
    in whole multiples of a common unit, it is a polynomial in the size of the move with whole coefficients below
    2^(8b + 200), where 200 allows for its number of terms and for the slope of the bridges. Below the inverse of that,
    its lowest term outweighs all others.
    """
    numbers = [x for polygons in (loops, move) for polygon in polygons for point in polygon for x in point]
    unit = lcm(*(x.denominator for x in numbers))
    bits = max(abs(x * unit) for x in numbers).numerator.bit_length()
    return Fraction(1, 2 ** (8 * bits + 202))


def moved(loops: Sequence[Loop], move: Move, halvings: int = 0) -> list[list[Point]]:
    """The loops after an infinitely small move; halved so many times more."""
    size = infinitely_small(loops, move) / 2**halvings
    return [
        [(x + size * dx, y + size * dy) for (x, y), (dx, dy) in zip(loop, along, strict=True)]
        for loop, along in zip(loops, move, strict=True)
    ]


def count_in_general_position(loops: Sequence[Loop], cusps: Cusps = ()) -> int:
    """The number of surfaces that an outline bounds on its left; DegenerateError if it touches itself."""
    if len(loops) == 1 and not any(map(any, cusps)):
        code = crossings_between(loops[0]).code
        return len(list(gluings.families(code))) if min(windings(code)) >= 0 else 0
    code = drawing_between(loops, cusps).code
    return len(outline_gluings.surfaces(code))


def count_moved(loops: Sequence[Loop], move: Move, cusps: Cusps = ()) -> int | None:
    """The number of surfaces after an infinitely small move; None if that leaves contacts."""
    try:
        return count_in_general_position(moved(loops, move), cusps)
    except DegenerateError:
        return None


# ---- moves -----------------------------------------------------------------------------------------------------------


def any_move(rng: np.random.Generator, loops: Sequence[Loop]) -> Move:
    """All vertices somewhere, some much farther than others."""
    return [[small_vector(rng) for _ in loop] for loop in loops]


def small_vector(rng: np.random.Generator) -> Point:
    """A random direction, as long as some power of two."""
    x, y = (Fraction(int(d)) for d in rng.integers(-1000, 1001, 2))
    scale = 2 ** int(rng.integers(0, 12))
    return x * scale, y * scale


def outward_move(rng: np.random.Generator, loops: Sequence[Loop], cusps: Cusps = ()) -> Move:
    """All vertices to the right of both their edges, but for cusps, which stay."""
    return [
        [
            (Fraction(0), Fraction(0)) if cusps and cusps[i][v] else outward_vector(rng, loop[v - 1], loop[v], after)
            for v, after in enumerate([*loop[1:], loop[0]])
        ]
        for i, loop in enumerate(loops)
    ]


def outward_vector(rng: np.random.Generator, before: Point, here: Point, after: Point) -> Point:
    """A vector with positive components to the right of both edges at a vertex.

    The directions that have that lie between the edges' own directions, one of them reversed; or on one side of them.
    """
    u, v = minus(here, before), minus(after, here)
    turn = cross(u, v)
    ends = [u, minus((0, 0), v)] if turn > 0 else [minus((0, 0), u), v]
    a, b = (Fraction(int(d)) * 2 ** int(rng.integers(0, 6)) for d in rng.integers(1, 1000, 2))
    if turn == 0:
        ends = [(u[1], -u[0]), u if rng.random() < 0.5 else minus((0, 0), u)]
    x, y = (a * ends[0][i] + b * ends[1][i] for i in (0, 1))
    assert all(x * d[1] - y * d[0] > 0 for d in (u, v))
    return x, y


def opposite(move: Move) -> Move:
    """The move the other way."""
    return [[(-x, -y) for x, y in loop] for loop in move]


# ---- spikes and contacts ---------------------------------------------------------------------------------------------


def without_spikes(loop: Loop) -> list[Point]:
    """The polygon without tips where it turns straight back, and without repeated vertices; [] if nothing is left."""
    points = list(loop)
    while len(points) > 2:
        tip = next((v for v in range(len(points)) if is_spike(points, v)), None)
        if tip is None:
            return points
        del points[tip]
    return []


def is_spike(points: Loop, v: int) -> bool:
    """Whether a polygon turns straight back at a vertex, or stays where it was before."""
    u, w = minus(points[v], points[v - 1]), minus(points[(v + 1) % len(points)], points[v])
    return u == (0, 0) or (cross(u, w) == 0 and dot(u, w) < 0)


def contacts(loops: Sequence[Loop]) -> set[tuple[int, int]]:
    """The vertices (loop, vertex) that lie on another vertex or on an edge that is not one of their own two."""
    return {
        (i, v)
        for i, loop in enumerate(loops)
        for v, vertex in enumerate(loop)
        for j, other in enumerate(loops)
        for e, (p, q) in enumerate(edges(other))
        if not (i == j and v in (e, (e + 1) % len(other))) and on_segment(p, q, vertex)
    }


def with_vertices_at_cusps(loops: Sequence[Loop], cusps: Cusps) -> tuple[list[list[Point]], list[list[int]]]:
    """The outline with a vertex on every edge where a cusp lies on it: there the edge can move, as the cusp stays."""
    places = {p for loop, index in zip(loops, cusps, strict=True) for p, m in zip(loop, index, strict=True) if m}
    longer, marks = [], []
    for loop, index in zip(loops, cusps, strict=True):
        chains = [touching_drawings.chain(edge, [(p, p) for p in places])[:-1] for edge in edges(loop)]
        longer.append([p for chain in chains for p in chain])
        marks.append([m for i, chain in enumerate(chains) for m in (index[i], *[0] * (len(chain) - 1))])
    return longer, marks


# ---- answers ---------------------------------------------------------------------------------------------------------


def turning(loop: Loop) -> int:
    """The turning number of a polygon without spikes: small moves do not change it."""
    directions = [minus(q, p) for p, q in edges(loop)]
    return sum(passes_east(u, v) for u, v in edges(directions))


def may_bound(loops: Sequence[Loop], cusps: Cusps = ()) -> bool:
    """Conditions that no small move changes: a disk turns once and less its cusps; no face has w < 0."""
    if len(loops) == 1 and turning(loops[0]) - sum(map(sum, cusps)) != 1:
        return False
    return min(touching_drawings.touching_drawing(loops, cusps).winding) >= 0


def count_strict(loops: Sequence[Loop], cusps: Cusps = ()) -> int:
    """The number of surfaces that the outline bounds as it is."""
    return sum(1 for _ in touching_drawings.surfaces(touching_drawings.touching_drawing(loops, cusps)))


def count_outward(rng: np.random.Generator, loops: Sequence[Loop], cusps: Cusps = ()) -> int:
    """The number of surfaces after an outward move."""
    while (count := count_moved(loops, outward_move(rng, loops, cusps), cusps)) is None:
        pass
    return count


def moves_that_bound(rng: np.random.Generator, loops: Sequence[Loop], tries: int, cusps: Cusps = ()) -> Iterator[Move]:
    """Those among some random moves after which the outline bounds something."""
    for _ in range(tries):
        move = any_move(rng, loops)
        if count_moved(loops, move, cusps):
            yield move


def either_direction(loops: Sequence[Loop], cusps: Cusps = ()) -> Iterator[tuple[list[list[Point]], Cusps]]:
    """The outline, and the outline with all loops run backward from their first vertices."""
    yield [list(loop) for loop in loops], cusps
    yield [[loop[0], *loop[:0:-1]] for loop in loops], [[m[0], *m[:0:-1]] for m in cusps]


def answer(polygon: Sequence[Sequence[float]]) -> Answer | None:
    """How many disks a polygon bounds, on its left or on its right; None if spikes are all there is to it."""
    loop = without_spikes(exact(polygon))
    if not loop:
        return None
    rng = np.random.default_rng(1)
    for directed, _ in either_direction([loop]):
        if may_bound(directed):
            return Answer(count_strict(directed), count_outward(rng, directed))
    return Answer(0, 0)


# ---- the page --------------------------------------------------------------------------------------------------------


def positions(polygon: Sequence[Sequence[float]]) -> Iterator[list[tuple[float, float]]]:
    """The polygon in all eight positions of the page: turned by right angles, and mirrored."""
    points = [(float(x), float(y)) for x, y in polygon]
    for _ in range(4):
        points = [(-y, x) for x, y in points]
        yield points
        yield [(y, x) for x, y in points]


def starts(polygon: Sequence[Sequence[float]]) -> Iterator[list[Sequence[float]]]:
    """The polygon from every vertex, in both directions."""
    for points in (list(polygon), list(polygon)[::-1]):
        for start in range(len(points)):
            yield points[start:] + points[:start]


# ---- random outlines -------------------------------------------------------------------------------------------------


def random_touching(rng: np.random.Generator, most: int = 9) -> list[tuple[int, int]]:
    """A polygon on a small grid that touches itself, more often than not.

    Some are random; the others grow from a triangle or from the whole square, by new vertices and by trips: from a
    vertex to a triangle and back, or a triangle right at a vertex.
    """
    size, kind = int(rng.integers(3, 7)), rng.random()
    if kind < 0.2:
        return grid_points(rng, size, int(rng.integers(4, most + 1)))
    polygon = [(0, 0), (size - 1, 0), (size - 1, size - 1), (0, size - 1)]
    while kind < 0.6 and not turns(polygon := grid_points(rng, size, 3), 1):
        pass
    for _ in range(60):
        longer = glued_or_with_trip(rng, polygon, size)
        if len(longer) <= most and turns(longer, 1):
            polygon = longer
    return polygon


def grid_points(rng: np.random.Generator, size: int, count: int) -> list[tuple[int, int]]:
    """Points on a square grid."""
    return [(int(x), int(y)) for x, y in rng.integers(0, size, (count, 2))]


def glued_or_with_trip(rng: np.random.Generator, polygon: list[tuple[int, int]], size: int) -> list[tuple[int, int]]:
    """A polygon with a new vertex on one edge, or with a triangle at one vertex, reached directly or by a way."""
    v = int(rng.integers(len(polygon)))
    start, rest = polygon[v], polygon[v + 1 :] + polygon[:v]
    r, s, t = grid_points(rng, size, 3)
    trips = [[start, r], [start, r, s, start], [start, r, s, t, r, start]]
    return trips[int(rng.choice(3, p=[0.4, 0.2, 0.4]))] + rest


def turns(polygon: Sequence[Sequence[float]], times: int) -> bool:
    """Whether a polygon has no spikes and turns so many times to the left."""
    points = exact(polygon)
    return not any(is_spike(points, v) for v in range(len(points))) and turning(points) == times


def random_touching_with_cusps(
    rng: np.random.Generator, index: int, most: int = 9
) -> tuple[list[tuple[int, int]], list[int]]:
    """A polygon on a small grid that turns too often, and cusps at some of its vertices that make up for it."""
    size = int(rng.integers(3, 6))
    while not turns(polygon := grid_points(rng, size, int(rng.integers(4 + index, 7 + index))), 1 + index):
        pass
    for _ in range(20):
        longer = glued_or_with_trip(rng, polygon, size)
        if len(longer) <= most and turns(longer, 1 + index):
            polygon = longer
    cusps = [0] * len(polygon)
    for _ in range(index):
        cusps[int(rng.integers(len(polygon)))] += 1
    return polygon, cusps


def random_touching_loops(rng: np.random.Generator) -> list[list[tuple[int, int]]]:
    """Two or three loops on a small grid without spikes; often a square, so that something may be bounded."""
    size, loops = int(rng.integers(3, 6)), []
    if rng.random() < 0.8:
        loops.append([(0, 0), (size - 1, 0), (size - 1, size - 1), (0, size - 1)])
    count = int(rng.integers(2, 4))
    while len(loops) < count:
        loop = grid_points(rng, size, int(rng.integers(3, 6)))
        loops += [loop] if any(turns(loop, times) for times in (-1, 1)) else []
    return loops


def random_rectangles_with_cusps(rng: np.random.Generator) -> tuple[list[list[tuple[int, int]]], list[list[int]]]:
    """Two rectangles on a small grid, each with a corner in the other, or on it, which is a cusp."""
    while True:
        loops = [_rectangle(rng) for _ in range(2)]
        inside = [_corners_in(loop, other) for loop, other in zip(loops, loops[::-1], strict=True)]
        if all(inside):
            at = [int(rng.choice(corners)) for corners in inside]
            if loops[0][at[0]] != loops[1][at[1]]:
                return loops, [[int(corner == here) for corner in range(4)] for here in at]


def _rectangle(rng: np.random.Generator) -> list[tuple[int, int]]:
    (left, right), (low, high) = (sorted(map(int, rng.choice(6, 2, replace=False))) for _ in range(2))
    return [(left, low), (right, low), (right, high), (left, high)]


def _corners_in(one: Sequence[tuple[int, int]], other: Sequence[tuple[int, int]]) -> list[int]:
    (left, low), (right, high) = other[0], other[2]
    return [corner for corner, (x, y) in enumerate(one) if left <= x <= right and low <= y <= high]
