"""Small changes that make a closed polygon the outline of a disk, by definition: in each step all of them are tried.

A curve is a list of what it passes: borders of the drawing, forward (dart 2i) or backward (2i + 1), and visits, as
negative numbers −1 − p. Leaving out a loop takes out what is between two visits to one crossing; undoing a lens swaps
what is between two crossings. A visit counts as long as its partner is there, too. Areas are fractions.
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from math import inf
from typing import NamedTuple

from reference import gluings
from reference.crossings import Point, PolygonCrossings, cross, crossings, exact, outer_dart, side
from reference.planar_maps import (
    GaussCode,
    cells,
    may_bound_disk,
    outer_cell,
    reversed_code,
)

Curve = list[int]


class Drawing(NamedTuple):
    """A polygon with its crossings; cells with their borders on the left and right, and twice their areas."""

    vertices: list[Point]
    found: PolygonCrossings
    sides: list[tuple[int, int]]
    outside: int
    areas: list[Fraction]


class Move(NamedTuple):
    """Pairs of visits: one between which the curve is left out, or two between which it changes places."""

    runs: tuple[tuple[int, int], ...]


class Tried(NamedTuple):
    """The smallest move comes first: by the region, by all winding numbers, by its place, and lobes before lenses."""

    region: Fraction
    layers: Fraction
    places: list[Point]
    is_lens: bool
    has_leftmost: bool
    move: Move
    curve: Curve


class Outcome(NamedTuple):
    """The moves, and which parts of the areas they change in all."""

    moves: list[Move]
    region: Fraction
    layers: Fraction


# ---- drawings --------------------------------------------------------------------------------------------------------


def drawing(polygon) -> Drawing | None:
    """The drawing of a polygon in general position; None if it has no crossing."""
    vertices, found = exact(polygon), crossings(polygon)
    code = found.code
    if not code.partner:
        return None
    orbits = cells(code.partner, code.ccw)
    cell = {dart: number for number, orbit in enumerate(orbits) for dart in orbit}
    sides = [(cell[2 * border], cell[2 * border + 1]) for border in range(len(code.partner))]
    bare = Drawing(vertices, found, sides, outer_cell(code), [])
    return bare._replace(areas=[doubled_area(points_along(bare, list(orbit))) for orbit in orbits])


def doubled_area(points: list[Point]) -> Fraction:
    """Twice the signed area of a polygon."""
    return sum((cross(p, q) for p, q in pairwise([*points, points[0]])), Fraction(0))


def start(drawn: Drawing, dart: int) -> int:
    """The visit at which a dart starts."""
    return (dart // 2 + dart % 2) % len(drawn.sides)


def inner(drawn: Drawing, dart: int) -> list[Point]:
    """The vertices along a dart."""
    n, edges, border = len(drawn.vertices), drawn.found.edges, dart // 2
    first, last = edges[border], edges[(border + 1) % len(edges)]
    count = last - first + n * (border + 1 == len(edges))
    points = [drawn.vertices[(first + 1 + i) % n] for i in range(count)]
    return points[::-1] if dart % 2 else points


def points_along(drawn: Drawing, curve: Curve) -> list[Point]:
    """The corners of a closed way along darts, crossings that it passes straight among them."""
    return [p for dart in curve if dart >= 0 for p in [drawn.found.points[start(drawn, dart)], *inner(drawn, dart)]]


# ---- curves ----------------------------------------------------------------------------------------------------------


def windings(drawn: Drawing, curve: Curve) -> list[int]:
    """How often a curve winds round each cell: once more on the left of a dart than on its right."""
    jump = [curve.count(2 * border) - curve.count(2 * border + 1) for border in range(len(drawn.sides))]
    known = {drawn.outside: 0}
    while len(known) < len(drawn.areas):
        for more, (left, right) in zip(jump, drawn.sides, strict=True):
            if right in known:
                known.setdefault(left, known[right] + more)
            if left in known:
                known.setdefault(right, known[left] - more)
    return [known[number] for number in range(len(drawn.areas))]


def visits(drawn: Drawing, curve: Curve) -> list[int]:
    """The visits of a curve to crossings, in order."""
    there = {-1 - item for item in curve if item < 0}
    return [-1 - item for item in curve if item < 0 and drawn.found.code.partner[-1 - item] in there]


def code_of(drawn: Drawing, curve: Curve) -> GaussCode:
    """The Gauss code of a curve."""
    order = visits(drawn, curve)
    place = {visit: at for at, visit in enumerate(order)}
    partner = tuple(place[drawn.found.code.partner[visit]] for visit in order)
    vertices, edges = [], []
    begin = curve.index(-1 - order[0]) if order else 0
    for item in curve[begin:] + curve[:begin]:
        if item >= 0:
            vertices += [drawn.found.points[start(drawn, item)], *inner(drawn, item)]
        elif -1 - item in place:
            # The crossing is the first vertex of the dart that comes next.
            edges.append(len(vertices) - 1)
    ccw = tuple(drawn.found.code.ccw[visit] for visit in order)
    return GaussCode(partner, ccw, outer_dart(vertices, edges))


def is_disk(drawn: Drawing, curve: Curve) -> bool:
    """Does a curve bound a disk, on its left or on its right?"""
    code = code_of(drawn, curve)
    return any(
        may_bound_disk(way) and (not way.partner or bool(gluings.immersions(*way)))
        for way in (code, reversed_code(code))
    )


# ---- moves -----------------------------------------------------------------------------------------------------------


def moves(drawn: Drawing, curve: Curve, all_lenses: bool) -> Iterator[Move]:
    """All that can be done to a curve."""
    order = visits(drawn, curve)
    partner = drawn.found.code.partner
    following = dict(pairwise([*order, *order[:1]]))
    yield from (Move(((visit, partner[visit]),)) for visit in order)
    for visit in order:
        end = following[visit]
        one, other = partner[visit], partner[end]
        if len({visit, end, one, other}) < 4:
            continue
        if following[other] == one and visit < other:
            lens = Move(((visit, end), (other, one)))
        elif all_lenses and following[one] == other and visit < one:
            lens = Move(((visit, end), (one, other)))
        else:
            continue
        if is_thin(drawn, curve, lens):
            yield lens


def between(curve: Curve, run: tuple[int, int]) -> tuple[Curve, Curve]:
    """What a curve passes from one visit on to another, and what it passes from there on; without these visits."""
    at = curve.index(-1 - run[0])
    turned = curve[at + 1 :] + curve[:at]
    end = turned.index(-1 - run[1])
    return turned[:end], turned[end + 1 :]


def backward(curve: Curve) -> Curve:
    return [dart ^ 1 for dart in reversed(curve) if dart >= 0]


def runs_back(drawn: Drawing, lens: Move) -> bool:
    """Do the two strands run against each other?"""
    return drawn.found.code.partner[lens.runs[0][0]] == lens.runs[1][1]


def is_thin(drawn: Drawing, curve: Curve, lens: Move) -> bool:
    """Is the corner of what lies between two strands less than half a turn, as at the tip of a lens?"""
    one, other = (between(curve, run)[0] for run in lens.runs)
    way = points_along(drawn, one + (other if runs_back(drawn, lens) else backward(other)))
    here = way.index(drawn.found.points[lens.runs[0][0]])
    return (side(way[here - 1], way[here], way[here + 1]) > 0) == (doubled_area(way) > 0)


def made(drawn: Drawing, curve: Curve, move: Move) -> Curve:
    """A curve after a move."""
    way, rest = between(curve, move.runs[0])
    if len(move.runs) == 1:
        return rest
    other = between(curve, move.runs[1])[0]
    at = rest.index(-1 - move.runs[1][0])
    first, last = rest[:at], rest[rest.index(-1 - move.runs[1][1]) + 1 :]
    way, other = ([dart for dart in part if dart >= 0] for part in (way, other))
    if runs_back(drawn, move):
        way, other = backward(way), backward(other)
    return [*other, *first, *way, *last]


def tried(drawn: Drawing, curve: Curve, move: Move) -> Tried:
    """A move, and what it changes."""
    after = made(drawn, curve, move)
    region, layers = changed(drawn, windings(drawn, curve), windings(drawn, after))
    places = sorted({drawn.found.points[visit] for run in move.runs for visit in run})
    way = points_along(drawn, between(curve, move.runs[0])[0])
    has_leftmost = len(move.runs) == 1 and min(way) == min(drawn.vertices)
    return Tried(region, layers, places, len(move.runs) == 2, has_leftmost, move, after)


def changed(drawn: Drawing, before: list[int], after: list[int]) -> tuple[Fraction, Fraction]:
    """Twice the area that is covered before or after and not both; and all changes times twice their areas."""
    triples = list(zip(before, after, drawn.areas, strict=True))
    region = sum((area for was, now, area in triples if (was != 0) != (now != 0)), Fraction(0))
    return region, sum((abs(now - was) * area for was, now, area in triples if was != now), Fraction(0))


# ---- the search ------------------------------------------------------------------------------------------------------


def whole_curve(drawn: Drawing) -> Curve:
    """The curve of a drawing."""
    return [item for visit in range(len(drawn.sides)) for item in (-1 - visit, 2 * visit)]


def parts_changed(drawn: Drawing, curve: Curve) -> tuple[Fraction, Fraction]:
    """Which parts of the covered area and of all layers a curve has otherwise than the drawing."""
    given = windings(drawn, whole_curve(drawn))
    parts, whole = changed(drawn, given, windings(drawn, curve)), changed(drawn, [0] * len(given), given)
    return parts[0] / whole[0], parts[1] / whole[1]


def is_within(drawn: Drawing, caps: tuple[float, float], curve: Curve) -> bool:
    """Does a curve keep within the caps?"""
    return all(cap == inf or part <= Fraction(cap) for part, cap in zip(parts_changed(drawn, curve), caps, strict=True))


def greedy(
    drawn: Drawing, caps: tuple[float, float], all_lenses: bool, layers_first: bool = False
) -> list[Move] | None:
    """The smallest moves within the caps, until there is a disk."""
    curve = whole_curve(drawn)
    chosen: list[Move] = []
    while not is_disk(drawn, curve):
        possible = []
        for move in moves(drawn, curve, all_lenses):
            one = tried(drawn, curve, move)
            if is_within(drawn, caps, one.curve):
                possible.append(one)
        if not possible:
            return None
        best = min(possible, key=lambda one: (one.layers, *one) if layers_first else one)
        curve = best.curve
        chosen.append(best.move)
    return chosen


def after_all(drawn: Drawing, chosen: list[Move]) -> Curve | None:
    """The curve after some moves, if they are possible one after the other."""
    curve = whole_curve(drawn)
    for move in chosen:
        order = visits(drawn, curve)
        following = dict(pairwise([*order, *order[:1]]))
        if not all(visit in order for run in move.runs for visit in run):
            return None
        if len(move.runs) == 2 and any(following[first] != last for first, last in move.runs):
            return None
        curve = made(drawn, curve, move)
    return curve


def needed(drawn: Drawing, caps: tuple[float, float], chosen: list[Move]) -> list[Move]:
    """The moves without those that turn out not to be needed: half of them at a time, the latest ones first."""
    if all(len(move.runs) == 1 for move in chosen):
        chosen = [move for i, move in enumerate(chosen) if not any(lies_in(drawn, move, m) for m in chosen[i + 1 :])]
    stretch = len(chosen)
    while stretch > 1:
        stretch = -(-stretch // 2)
        for begin in range(0, len(chosen), stretch)[::-1]:
            fewer = chosen[:begin] + chosen[begin + stretch :]
            curve = after_all(drawn, fewer)
            if curve is not None and is_within(drawn, caps, curve) and is_disk(drawn, curve):
                chosen = fewer
    return chosen


def lies_in(drawn: Drawing, lobe: Move, other: Move) -> bool:
    """Does a lobe lie in another one?"""
    size, (first, last) = len(drawn.sides), other.runs[0]
    return all((visit - first) % size <= (last - first) % size for visit in lobe.runs[0])


def beyond(drawn: Drawing, layers_first: bool) -> Outcome | None:
    """The moves that make a disk, whatever they change."""
    chosen = greedy(drawn, (inf, inf), False, layers_first)
    return None if chosen is None else outcome(drawn, needed(drawn, (inf, inf), chosen))


def outcome(drawn: Drawing, kept: list[Move]) -> Outcome:
    """Moves with what they change in all."""
    curve = after_all(drawn, kept)
    assert curve is not None
    return Outcome(kept, *parts_changed(drawn, curve))


def repair(drawn: Drawing, caps: tuple[float, float]) -> Outcome | None:
    """The moves that make a disk within the caps: without lenses of strands in one direction, if that will do."""
    for all_lenses in (False, True):
        chosen = greedy(drawn, caps, all_lenses)
        if chosen is not None:
            return outcome(drawn, needed(drawn, caps, chosen))
    return None
