"""Polygons as codes of an outline, in exact fractions: crossings, cusps, and bridges between loops that lie apart."""

from collections.abc import Sequence
from typing import NamedTuple

from reference.crossings import DegenerateError, Point, cross, dot, edges, exact, minus, side
from reference.loops import Place, meetings, refuse_touching
from reference.outlines import OutlineCode

TOWARDS: Point = exact([(1_000_003, 17)])[0]
"""The direction in which bridges run: two points on a moderate grid are never on one line with it."""


class Foot(NamedTuple):
    """Where a bridge starts or ends, and whether it lies on the left of the loop."""

    place: Place
    on_left: bool


class Drawing(NamedTuple):
    """The code of an outline, and the place of each visit."""

    code: OutlineCode
    places: tuple[Place, ...]


def outline_code(polygons: Sequence[Sequence[Sequence[float]]], cusps: Sequence[Sequence[int]] = ()) -> OutlineCode:
    """The code of several polygons, or DegenerateError; `cusps` has the index of each vertex, loop by loop."""
    return drawing(polygons, cusps).code


def drawing(polygons: Sequence[Sequence[Sequence[float]]], cusps: Sequence[Sequence[int]] = ()) -> Drawing:
    """The code of several polygons and the places of its visits.

    A bridge starts at the last vertex of each group of loops that hang together, in a fixed direction, and ends at the
    first edge that it meets. Groups of which it meets none lie on the outside.
    """
    return drawing_between([exact(polygon) for polygon in polygons], cusps)


def drawing_between(loops: Sequence[Sequence[Point]], cusps: Sequence[Sequence[int]] = ()) -> Drawing:
    """The code of several polygons with these vertices, which need be no doubles."""
    refuse_touching(loops)
    pairs = meetings(loops)
    bridges, outside = bridges_of(loops, groups_of(len(loops), pairs))
    index = {Place(i, v, 0 * loops[i][0][0]): m for i, of_loop in enumerate(cusps) for v, m in enumerate(of_loop) if m}
    crossing = [place for pair in pairs for place in pair]
    feet = [foot.place for bridge in bridges for foot in bridge]
    if len(set(feet)) < len(feet) or set(crossing) & {*feet, *index}:
        raise DegenerateError([])
    places = sorted({*crossing, *index, *feet, *(foot.place for foot in outside)})
    number = {place: visit for visit, place in enumerate(places)}
    other = dict(pairs) | {b: a for a, b in pairs}
    counts = tuple(sum(place.loop == i for place in places) for i in range(len(loops)))
    code = OutlineCode(
        counts,
        tuple(number[other.get(place, place)] for place in places),
        tuple(place in dict(pairs) for place in places),
        tuple(index.get(place, 0) for place in places),
        tuple((dart(counts, number, first), dart(counts, number, second)) for first, second in bridges),
        tuple(dart(counts, number, foot) for foot in outside),
    )
    return Drawing(code, tuple(places))


def places_on_borders(found: Drawing) -> list[Place]:
    """A place inside each border: on the edge on which it starts, half way to where it or the edge ends."""
    middles = []
    for start in found.places:
        later = [p.along for p in found.places if p[:2] == start[:2] and p.along > start.along]
        middles.append(start._replace(along=(start.along + min(later, default=1)) / 2))
    return middles


def dart(counts: Sequence[int], number: dict[Place, int], foot: Foot) -> int:
    """The dart that starts at a foot, with the corner on its left in which the bridge lies.

    Every loop has a visit here but loops with no crossing, cusp or foot, which come as one border each.
    """
    loop = foot.place.loop
    first_visit, first_border = sum(counts[:loop]), sum(max(1, count) for count in counts[:loop])
    step = number[foot.place] - first_visit
    if foot.on_left:
        return 2 * (first_border + step)
    return 2 * (first_border + (step - 1) % counts[loop]) + 1


def groups_of(count: int, pairs: Sequence[tuple[Place, Place]]) -> list[set[int]]:
    """The loops that hang together by crossings."""
    group = list(range(count))
    for a, b in pairs:
        joined = {group[a.loop], group[b.loop]}
        group = [min(joined) if g in joined else g for g in group]
    return [{loop for loop in range(count) if group[loop] == g} for g in sorted(set(group))]


def bridges_of(
    loops: Sequence[Sequence[Point]], groups: Sequence[set[int]]
) -> tuple[list[tuple[Foot, Foot]], list[Foot]]:
    """A bridge from each group, or a foot on the outside."""
    bridges, outside = [], []
    for group in groups:
        _, loop, v = max((dot(TOWARDS, p), loop, v) for loop in group for v, p in enumerate(loops[loop]))
        polygon = loops[loop]
        turns_left = side(polygon[v - 1], polygon[v], polygon[(v + 1) % len(polygon)]) > 0
        start = Foot(Place(loop, v, 0 * polygon[v][0]), not turns_left)
        met = first_met(loops, polygon[v], [i for i in range(len(loops)) if i not in group])
        if met is None:
            outside.append(start)
        else:
            bridges.append((start, met))
    return bridges, outside


def first_met(loops: Sequence[Sequence[Point]], start: Point, others: Sequence[int]) -> Foot | None:
    """Where the ray from a point meets one of the other loops first."""
    found = []
    for i in others:
        for e, (p, q) in enumerate(edges(loops[i])):
            at_p, at_q = (cross(TOWARDS, minus(end, start)) for end in (p, q))
            if at_p * at_q > 0:
                continue
            turn = cross(TOWARDS, minus(q, p))
            far = cross(minus(p, start), minus(q, p)) / turn
            if far > 0:
                if at_p * at_q == 0:
                    raise DegenerateError([("bridge at a vertex", p)])
                found.append((far, Foot(Place(i, e, at_p / (at_p - at_q)), turn > 0)))
    return min(found)[1] if found else None
