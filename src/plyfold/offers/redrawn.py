"""An outline that goes other ways along the borders of a drawing, as points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints
from plyfold.offers.rerouted import Effect, Move, Rerouted, Run
from plyfold.outline.curve import Curve, Outline
from plyfold.predicates import cross_sign, exact_crossings, exact_parameter
from plyfold.ragged import count_each

__all__ = ["Pen", "pen_for", "redrawn", "traced"]

_Place: TypeAlias = tuple[Fraction, Fraction]


class _Points(NamedTuple):
    """Points along a way, and the number of each that was given; −1 for corners at crossings."""

    places: Floats
    number: Ints


@dataclass(frozen=True, eq=False)
class Pen:
    """Draws ways along the borders of a drawing: through the points as they were given, with corners at crossings.

    Parameters
    ----------
    drawn : Arrangement
    given : Outline
    first, count : (borders,) int
        The first of the vertices inside each border, and how many there are.
    opening : Fraction
        How much of the way from a crossing to what is next is cut off where runs are parted.
    """

    drawn: Arrangement
    given: Outline
    first: Ints
    count: Ints
    opening: Fraction
    _known: dict[int, _Place] = field(default_factory=dict)

    @cached_property
    def previous_border(self) -> list[int]:
        """The border before each along its loop."""
        before: list[int] = np.argsort(self.drawn.next_border).tolist()
        return before

    def along(self, darts: Sequence[int], parted: set[int], is_closed: bool) -> _Points:
        """Return the points along some darts, each followed by the next; of a closed way, in the end by the first."""
        border, back = np.divmod(np.array(darts, dtype=np.int64), 2)
        count = self.count[border]
        turned = np.repeat(back, count) == 1
        within = count_each(count)
        ahead = np.where(turned, np.repeat(count, count) - 1 - within, within)
        loop = np.repeat(self.drawn.loop_of_border[border], count)
        low, length = self.given.first_point[loop], np.diff(self.given.first_point)[loop]
        number = low + (np.repeat(self.first[border], count) + ahead - low) % length
        corners = [
            (int(end), place)
            for at, end in zip(*self._turns(border, back, count, is_closed), strict=True)
            for place in self._corner(darts[at], darts[(at + 1) % len(darts)], parted)
        ]
        at, places = np.array([at for at, _ in corners], dtype=np.int64), [place for _, place in corners]
        return _Points(
            np.insert(self.given.points[number], at, np.array(places).reshape(-1, 2), axis=0), np.insert(number, at, -1)
        )

    def crossing(self, visit: int) -> tuple[float, float]:
        """Return the double next to the crossing at a visit."""
        return _rounded(self._crossing(visit))

    def _turns(self, border: Ints, back: Ints, count: Ints, is_closed: bool) -> tuple[list[int], list[int]]:
        """Return after which darts the way does not go on straight, and how many vertices come before the corner."""
        following, goes_back = np.roll(border, -1), np.roll(back, -1)
        ahead = self.drawn.next_border
        straight = (back == goes_back) & np.where(back == 1, ahead[following] == border, ahead[border] == following)
        turns = np.flatnonzero(~straight)
        turns = turns if is_closed else turns[turns < len(border) - 1]
        return turns.tolist(), np.cumsum(count)[turns].tolist()

    def _corner(self, dart: int, following: int, parted: set[int]) -> list[tuple[float, float]]:
        """Return the corner where a dart ends and another one goes on: two points if it is cut off."""
        visit = self._end_visit(dart)
        if int(self.drawn.crossing_of_visit[visit]) not in parted:
            return [_rounded(self._crossing(visit))]
        ends = (dart, following ^ 1)
        return [
            _rounded(_between(self._crossing(self._end_visit(end)), self._last_place(end), self.opening))
            for end in ends
        ]

    def _end_visit(self, dart: int) -> int:
        border = dart // 2
        return int(self.drawn.start_visit[border if dart % 2 else self.drawn.next_border[border]])

    def _last_place(self, dart: int) -> _Place:
        """Return what comes last before the end of a dart: a vertex, or the crossing where it starts."""
        border = dart // 2
        if not self.count[border]:
            return self._crossing(self._end_visit(dart ^ 1))
        loop = int(self.drawn.loop_of_border[border])
        low, length = int(self.given.first_point[loop]), len(self.given.loops[loop])
        number = int(self.first[border]) + (0 if dart % 2 else int(self.count[border]) - 1)
        return _exact(self.given.points[low + (number - low) % length])

    def _crossing(self, visit: int) -> _Place:
        """Return where two edges cross as they were given; where they do not any more, where they were moved to."""
        number = int(self.drawn.crossing_of_visit[visit])
        if number < 0:  # the foot of a bridge
            return _exact(self.drawn.visit_point[visit])
        if number not in self._known:
            self._known[number] = self._crossing_of(self.drawn.visit_edge[[visit, self.drawn.partner[visit]]], number)
        return self._known[number]

    def _crossing_of(self, edges: Ints, number: int) -> _Place:
        ends = np.concatenate([[edge, self.given.next_point[edge]] for edge in edges])
        given, drawn_outline = self.given.points[ends], self.drawn.outline
        assert drawn_outline is not None
        if not self.drawn.is_begun and np.array_equal(given, drawn_outline.points[ends]):
            x, y = (exact_crossings(given[:, None], axis)[0] for axis in (0, 1))
            return x, y
        return _meeting(given[:2], given[2:]) or _exact(self.drawn.crossings[number])


def _meeting(one: Floats, other: Floats) -> _Place | None:
    """Return the place where two edges meet, given their ends; None if they do not, or not in one point."""
    if cross_sign(one[0], one[1], other[0], other[1]) == 0:
        return None
    along = exact_parameter(one[0], one[1], other[0], other[1])
    across = exact_parameter(other[0], other[1], one[0], one[1])
    if not (0 <= along <= 1 and 0 <= across <= 1):
        return None
    return _between(_exact(one[0]), _exact(one[1]), along)


def _exact(point: Floats) -> _Place:
    x, y = point.tolist()
    return Fraction(x), Fraction(y)


def _between(start: _Place, end: _Place, share: Fraction) -> _Place:
    (x, y), (u, v) = start, end
    return x + share * (u - x), y + share * (v - y)


def _rounded(place: _Place) -> tuple[float, float]:
    return float(place[0]), float(place[1])


def pen_for(drawn: Arrangement, opening: Fraction) -> Pen:
    """Return a pen for the ways along a drawing."""
    given = drawn.given
    assert given is not None
    start, end = drawn.start_visit, drawn.start_visit[drawn.next_border]
    length = np.diff(given.first_point)[drawn.loop_of_border]
    edge = np.append(drawn.visit_edge, 0)
    is_whole = start < 0
    first = np.where(is_whole, given.first_point[drawn.loop_of_border], edge[start] + 1)
    count = np.where(is_whole, length, edge[end] - edge[start] + np.where(end <= start, length, 0))
    return Pen(drawn, given, first, count, opening)


def redrawn(pen: Pen, left: Rerouted) -> Outline:
    """Return an outline after all moves. Each loop starts with the first of its points that is left.

    It runs as it was given, also where the arrangement turned it round. A loop of which nothing is left is dropped.
    """
    loops, cusps = [], []
    index = np.append(np.concatenate(pen.given.cusps), 0)
    for loop in range(pen.drawn.n_loops):
        points = _without_repeats(pen.along(_darts_of_loop(left, loop), left.parted, True))
        if len(points.number):
            points = _from_first(points)
            loops.append(points.places)
            cusps.append(index[points.number])
    outline = Curve(loops[0], cusps=cusps[0]) if len(loops) == 1 else Outline(loops, cusps)
    return outline.reversed() if pen.drawn.reversed else outline


def _darts_of_loop(left: Rerouted, loop: int) -> list[int]:
    return [dart for place in _places_of_loop(left, loop) for dart in left.path[place]]


def _places_of_loop(left: Rerouted, loop: int) -> list[int]:
    places: list[int] = np.flatnonzero(left.plan.drawn.loop_of_border == loop).tolist()
    return places


def _without_repeats(points: _Points) -> _Points:
    """Leave out corners that are where the point before or the point after them is."""
    while len(points.number) > 1:
        same = (points.places == np.roll(points.places, -1, axis=0)).all(axis=1)
        is_corner = points.number < 0
        repeated = is_corner & (same | (np.roll(same, 1) & ~np.roll(is_corner, 1)))
        if not repeated.any():
            break
        points = _Points(points.places[~repeated], points.number[~repeated])
    return points


def _from_first(points: _Points) -> _Points:
    number = np.where(points.number < 0, np.iinfo(np.int64).max, points.number)
    start = int(number.argmin())
    return _Points(np.roll(points.places, -start, axis=0), np.roll(points.number, -start))


# ---- where it changed ------------------------------------------------------------------------------------------------


def traced(pen: Pen, left: Rerouted, move: Move, effect: Effect) -> tuple[Floats, ...]:
    """Make a move; return what it went round: the way that runs take after it, and back the way they took before.

    How often these polygons wind round a place is by how much its winding number changes, exactly, also where corners
    are rounded.
    """
    stretches, is_closed = _stretches(pen, left, move), False
    if not stretches:
        stretches, is_closed = [_places_of_loop(left, loop) for loop in _loops(left, move)], True
    before = [_way(pen, left, places, is_closed) for places in stretches]
    left.make(move, effect)
    after = [_way(pen, left, places, is_closed) for places in stretches]
    polygons = tuple(map(_round, before, after))
    return tuple(polygon[::-1] for polygon in polygons) if pen.drawn.reversed else polygons


def _loops(left: Rerouted, move: Move) -> list[int]:
    return list(dict.fromkeys(left.plan.loop[strand.start] for strand in move.runs))


def _way(pen: Pen, left: Rerouted, places: Sequence[int], is_closed: bool) -> Floats:
    points = pen.along([dart for place in places for dart in left.path[place]], left.parted, is_closed).places
    return np.concatenate([points, points[:1]]) if is_closed else points


def _stretches(pen: Pen, left: Rerouted, move: Move) -> list[list[int]]:
    """Return the places along each strand, and on to vertices before and after it; none where these are not apart."""
    stretches = [_stretch(pen, left, run) for run in move.runs]
    inside = [place for stretch in stretches for place in stretch[1:-1]]
    ends = {place for stretch in stretches for place in (*stretch[:1], *stretch[-1:])}
    return stretches if all(stretches) and len(set(inside)) == len(inside) and not ends & set(inside) else []


def _stretch(pen: Pen, left: Rerouted, strand: Run) -> list[int]:
    """Return the places along a strand, and on to where there is a vertex before and after it; none if there is not."""
    places = list(left.plan.places(strand))
    before = _up_to_vertex(pen, left, places[0], pen.previous_border)
    after = _up_to_vertex(pen, left, places[-1], left.plan.next_border)
    return [*reversed(before), *places, *after] if before and after else []


def _up_to_vertex(pen: Pen, left: Rerouted, start: int, onward: Sequence[int]) -> list[int]:
    """Return the places that follow one, up to the first that has a vertex; none if there is no such place."""
    places, place = [], onward[start]
    while place != start:
        places.append(place)
        if any(pen.count[dart // 2] for dart in left.path[place]):
            return places
        place = onward[place]
    return []


def _round(before: Floats, after: Floats) -> Floats:
    """Return the polygon from the last place that two ways have in common first to the first one they have last."""
    head = _common(before, after)
    before, after = before[max(head - 1, 0) :], after[max(head - 1, 0) :]
    tail = _common(before[:0:-1], after[:0:-1])
    cut = slice(None, len(before) - max(tail - 1, 0)), slice(None, len(after) - max(tail - 1, 0))
    return np.concatenate([after[cut[1]], before[cut[0]][-2:0:-1] if tail and head else before[cut[0]][::-1]])


def _common(one: Floats, other: Floats) -> int:
    """Return with how many equal points two ways begin."""
    size = min(len(one), len(other))
    differs = (one[:size] != other[:size]).any(axis=1)
    return int(differs.argmax()) if differs.any() else size
