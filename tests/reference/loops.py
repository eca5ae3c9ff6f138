"""Several closed polygons in exact fractions: crossings, borders, winding numbers, and all levels by trying.

Borders are numbered by the visits at which they start, along the first polygon, then the second and so on; those of
polygons that cross nothing come last.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from reference.crossings import DegenerateError, Point, cross, edges, exact, minus, on_segment, side


class LoopBorders(NamedTuple):
    """Winding number on the left of each border, and the four borders (a_top, a_bottom, b_top, b_bottom) of crossings.

    Strand b crosses strand a from right to left.
    """

    left_winding: tuple[int, ...]
    crossings: tuple[tuple[int, int, int, int], ...]


class Place(NamedTuple):
    """A place on a loop: the edge, and the fraction of the edge."""

    loop: int
    edge: int
    along: Fraction


def refuse_touching(loops: Sequence[Sequence[Point]]) -> None:
    """Raise DegenerateError if a vertex lies on an edge that is not one of its own two."""
    for i, loop in enumerate(loops):
        for v, vertex in enumerate(loop):
            for j, other in enumerate(loops):
                for e, (p, q) in enumerate(edges(other)):
                    own = i == j and v in (e, (e + 1) % len(other))
                    if not own and on_segment(p, q, vertex):
                        raise DegenerateError([("vertex on edge", vertex)])


def meetings(loops: Sequence[Sequence[Point]]) -> list[tuple[Place, Place]]:
    """All crossings: the place on strand a, and the place on strand b that crosses it from right to left."""
    every = [(i, e, p, q) for i, loop in enumerate(loops) for e, (p, q) in enumerate(edges(loop))]
    found, points = [], set()
    for (i, e, p, q), (j, f, r, s) in combinations(every, 2):
        if side(p, q, r) * side(p, q, s) < 0 and side(r, s, p) * side(r, s, q) < 0:
            along, across = minus(q, p), minus(s, r)
            turn = cross(along, across)
            first = Place(i, e, cross(minus(r, p), across) / turn)
            second = Place(j, f, cross(minus(r, p), along) / turn)
            found.append((first, second) if turn > 0 else (second, first))
            point = (p[0] + first.along * along[0], p[1] + first.along * along[1])
            if point in points:
                raise DegenerateError([("more than two edges", point)])
            points.add(point)
    return found


def winding(loop: Sequence[Point], place: Point) -> int:
    """How often a polygon winds round a point that is not on it."""
    total = 0
    for p, q in edges(loop):
        if (p[1] <= place[1]) != (q[1] <= place[1]):
            turn = side(p, q, place)
            total += (turn > 0) if q[1] > p[1] else -(turn < 0)
    return total


def meet(p: Point, q: Point, r: Point, s: Point) -> bool:
    """Whether two segments have a point in common."""
    proper = side(p, q, r) * side(p, q, s) < 0 and side(r, s, p) * side(r, s, q) < 0
    return proper or any(on_segment(p, q, end) for end in (r, s)) or any(on_segment(r, s, end) for end in (p, q))


def left_of(loops: Sequence[Sequence[Point]], start: Place, end: Fraction) -> int:
    """Winding number of all loops on the left of an edge between a place on it and the fraction `end` of it."""
    p, q = edges(loops[start.loop])[start.edge]
    along = minus(q, p)
    middle = (start.along + end) / 2
    point = (p[0] + middle * along[0], p[1] + middle * along[1])
    step = Fraction(1)
    while True:  # go to the left, half as far as before until no edge lies between or on the way
        place = (point[0] - step * along[1], point[1] + step * along[0])
        others = [(r, s) for i, loop in enumerate(loops) for e, (r, s) in enumerate(edges(loop)) if (i, e) != start[:2]]
        if not any(meet(point, place, r, s) for r, s in others):
            return sum(winding(loop, place) for loop in loops)
        step /= 2


def loop_borders(polygons: Sequence[Sequence[Sequence[float]]]) -> LoopBorders:
    """The borders of several polygons, or DegenerateError."""
    loops = [exact(polygon) for polygon in polygons]
    refuse_touching(loops)
    pairs = meetings(loops)
    visits = sorted(place for pair in pairs for place in pair)
    number = {place: index for index, place in enumerate(visits)}
    before, starts, ends = {}, list(visits), []
    for i in range(len(loops)):
        own = [place for place in visits if place.loop == i]
        for previous, place in zip([*own[-1:], *own[:-1]], own, strict=True):
            before[place] = number[previous]
        starts += [] if own else [Place(i, 0, Fraction(0))]
    for place in starts:
        later = [other.along for other in visits if other[:2] == place[:2] and other.along > place.along]
        ends.append(min(later, default=Fraction(1)))
    return LoopBorders(
        tuple(left_of(loops, place, end) for place, end in zip(starts, ends, strict=True)),
        tuple((before[a], number[a], number[b], before[b]) for a, b in pairs),
    )


def level_solutions(borders: LoopBorders) -> Iterator[tuple[int, ...]]:
    """All levels of the borders that obey the rule at every crossing."""
    n = len(borders.left_winding)
    if min(borders.left_winding, default=1) < 1:
        return

    def extend(level: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        if len(level) == n:
            yield level
            return
        for choice in range(1, borders.left_winding[len(level)] + 1):
            more = (*level, choice)
            if all(agrees(more, four) for four in borders.crossings if max(four) == len(level)):
                yield from extend(more)

    yield from extend(())


def agrees(level: Sequence[int], four: tuple[int, int, int, int]) -> bool:
    """The rule at a crossing: two levels of the top cell, of which the higher one is one lower past the crossing."""
    a, a_past, b, b_past = (level[border] for border in four)
    return a != b and a_past == a - (b < a) and b_past == b - (a < b)


def casing(borders: LoopBorders, level: Sequence[int]) -> tuple[bool, ...]:
    """Over and under by visits, which have the numbers of the borders that start at them."""
    over = {}
    for a_top, a_past, b_top, _ in borders.crossings:
        over[a_past] = level[a_top] > level[b_top]
        over[b_top] = not over[a_past]
    return tuple(over[visit] for visit in range(len(over)))
