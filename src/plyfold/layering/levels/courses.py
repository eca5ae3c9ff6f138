"""Lines over their own ribbons: where they meet, the layering must have the higher strand on top.

The heights of a ribbon are those of its points, and between them they are the line's only nearly. So where a line meets
itself, or another one, the sheets of both strands are looked up: from the side of the triangle that a strand is in, the
level of whose own sheet is known, straight to the place, up and down where other borders are passed.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from typing import NamedTuple, TypeAlias

import numpy as np
import shapely

from plyfold.arrays import Floats, Ints, Reals
from plyfold.errors import PrecisionError
from plyfold.layering.levels.laid_strip import LaidStrip
from plyfold.obstruction import Obstruction
from plyfold.outline.ribbons.ribbon import Course
from plyfold.predicates import Place, exact_cross

__all__ = ["first_disobeyed"]

# A place that is on an edge, or the way to it through a corner, is moved by such parts of its triangle, one after the
# other; and it is looked at from such places on the triangle's side.
_FIRST_MOVE, _LAST_MOVE = 20, 80
_ASIDE = ((3, 1), (-1, 3), (-3, -1), (1, -3), (2, 5), (-5, 2), (-2, -5), (5, -2))
_FROM = tuple(Fraction(*share) for share in ((1, 2), (1, 3), (2, 3), (2, 5), (4, 7), (1, 9)))


_Edge: TypeAlias = tuple[Place, Place]


class _Strand(NamedTuple):
    """A segment of a line at a place: its height there, and the triangles with the place that it passes."""

    height: Fraction
    faces: list[int]


class _Meeting(NamedTuple):
    place: Place
    one: _Strand
    other: _Strand


def first_disobeyed(strip: LaidStrip, courses: tuple[Course, ...], level: Ints) -> Obstruction | None:
    """Return the first place where lines meet and not the higher one is on top, if there is one.

    Parameters
    ----------
    strip : LaidStrip
    courses : tuple of Course
    level : (borders,) int
        Of the own sheet of each border, as in a layering.

    Notes
    -----
    Exact. O((n + m) log n + m l), with m meetings on n segments and l borders on the way to a place.
    """
    borders = _borders(strip, level)
    for place, *strands in _meetings(strip, courses):
        lower, higher = sorted(strands, key=lambda strand: strand.height)
        if lower.height < higher.height and not _is_above(borders, higher, lower, place):
            return _obstruction(strip, place, higher, lower)
    return None


def _obstruction(strip: LaidStrip, place: Place, higher: _Strand, lower: _Strand) -> Obstruction:
    x, y = map(float, place)
    heights = float(higher.height), float(lower.height)
    sentence = (
        f"No cloth follows these heights: where the line meets itself at ({x:.6g}, {y:.6g}), "
        f"the part at height {heights[0]:g} would not lie over the one at {heights[1]:g}."
    )
    return Obstruction("heights", sentence, ((x, y),), heights, strip.arranged)


# ---- where lines meet ------------------------------------------------------------------------------------------------


def _meetings(strip: LaidStrip, courses: tuple[Course, ...]) -> Iterator[_Meeting]:
    """Yield where two segments have a point in common, and the ends of what they have in common if that is more.

    Segments next to each other are passed over: they have one height in common, and nothing else.
    """
    owner = [(course, segment) for course in courses for segment in range(len(course.points) - 1)]
    if not owner:
        return
    ends = np.concatenate([np.stack([course.points[:-1], course.points[1:]], axis=1) for course in courses])
    boxes = shapely.box(*ends.min(axis=1).T, *ends.max(axis=1).T)
    one, other = shapely.STRtree(boxes).query(boxes)
    last_ones = np.cumsum([len(course.points) - 1 for course in courses]) - 1
    apart = (one + 1 < other) | ((one + 1 == other) & np.isin(one, last_ones))
    for a, b in sorted(zip(one[apart].tolist(), other[apart].tolist(), strict=True)):
        for place in _common_places(_edge(ends[a]), _edge(ends[b])):
            yield _Meeting(place, _strand(strip, owner[a], place), _strand(strip, owner[b], place))


def _edge(ends: Floats) -> _Edge:
    (x, y), (end_x, end_y) = ends.tolist()
    return (Fraction(x), Fraction(y)), (Fraction(end_x), Fraction(end_y))


def _sides(line: _Edge, other: _Edge) -> tuple[Fraction, Fraction]:
    """Return on which sides of a line the ends of another one lie; positive to the left."""
    start, end = line
    return exact_cross(start, end, start, other[0]), exact_cross(start, end, start, other[1])


def _common_places(one: _Edge, other: _Edge) -> list[Place]:
    """Return where two segments cross, or the ends of one that are on the other."""
    sides, other_sides = _sides(one, other), _sides(other, one)
    if sides[0] * sides[1] < 0 and other_sides[0] * other_sides[1] < 0:
        return [_between(other, sides[0] / (sides[0] - sides[1]))]
    touching = [end for end, side in zip(other, sides, strict=True) if side == 0 and _is_within(end, one)]
    touching += [end for end, side in zip(one, other_sides, strict=True) if side == 0 and _is_within(end, other)]
    return list(dict.fromkeys(touching))


def _is_within(place: Place, segment: _Edge) -> bool:
    """Tell whether a place on the line of a segment is on the segment."""
    return all(min(axis) <= x <= max(axis) for x, axis in zip(place, zip(*segment, strict=True), strict=True))


def _between(edge: _Edge, share: Fraction) -> Place:
    start, end = edge
    return start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])


def _strand(strip: LaidStrip, owner: tuple[Course, int], place: Place) -> _Strand:
    course, segment = owner
    start, end = _edge(course.points[segment : segment + 2])
    axis = int(start[0] == end[0])
    share = (place[axis] - start[axis]) / (end[axis] - start[axis])
    low, high = map(Fraction, course.heights[segment : segment + 2].tolist())
    passed = course.faces_along(segment).tolist()
    around = [face for face in passed if _is_in(place, strip.given[strip.faces[face]])]
    # In the middle of a flat cap the line is in its triangle but for rounding.
    return _Strand(low + share * (high - low), around or passed)


def _is_in(place: Place, triangle: Floats, strictly: bool = False) -> bool:
    corners = [(Fraction(x), Fraction(y)) for x, y in triangle.tolist()]
    sides = [exact_cross(corners[k - 1], corners[k], corners[k - 1], place) for k in range(3)]
    return min(sides) > 0 if strictly else min(sides) >= 0


# ---- sheets ----------------------------------------------------------------------------------------------------------


class _Borders(NamedTuple):
    """The borders of a layering, as places on the edges of the outline with the levels of their own sheets.

    Parameters
    ----------
    strip : LaidStrip
    level : (borders,) int
    ends : (n, 2, 2) float, or object
        Of the edges.
    tree : STRtree
        Of their boxes.
    side : (t,) int
        An edge of each triangle.
    """

    strip: LaidStrip
    level: Ints
    ends: Reals
    tree: shapely.STRtree
    side: Ints


def _borders(strip: LaidStrip, level: Ints) -> _Borders:
    edges = np.stack([np.arange(len(strip.next_point)), strip.next_point], axis=1)
    ends = strip.points[edges]
    side = np.empty(len(strip.faces), dtype=np.int64)
    side[strip.own_face] = np.arange(len(ends))
    rounded = ends.astype(np.float64)
    tree = shapely.STRtree(shapely.box(*rounded.min(axis=1).T, *rounded.max(axis=1).T))
    return _Borders(strip, level, ends, tree, side)


def _is_above(borders: _Borders, higher: _Strand, lower: _Strand, place: Place) -> bool:
    for near in _places_near(place, _size(borders.strip, higher.faces[0])):
        levels = [_level_over(borders, strand.faces, near) for strand in (higher, lower)]
        if levels[0] is not None and levels[1] is not None:
            return levels[0] > levels[1]
    raise PrecisionError("the ribbon touches itself where it is too thin", where=[np.array(place, dtype=np.float64)])


def _size(strip: LaidStrip, face: int) -> Fraction:
    return Fraction(float(np.ptp(strip.points[strip.faces[face]], axis=0).max()))


def _places_near(place: Place, size: Fraction) -> Iterator[Place]:
    """Yield a place, and others that are nearer and nearer to it, on all sides."""
    yield place
    for power, (x, y) in product(range(_FIRST_MOVE, _LAST_MOVE), _ASIDE):
        yield place[0] + size * x / 2**power, place[1] + size * y / 2**power


def _level_over(borders: _Borders, faces: list[int], place: Place) -> int | None:
    """Return the level at a place of the sheet that has some triangles; None if the place is not within one of them."""
    strip = borders.strip
    within = (face for face in faces if _is_in(place, strip.points[strip.faces[face]], strictly=True))
    levels = (_level_by_way(borders, int(borders.side[face]), share, place) for face in within for share in _FROM)
    return next((level for level in levels if level is not None), None)


class _Passed(NamedTuple):
    """An edge that is passed: where on the way, on which edge and where on that, and whether to its left."""

    way_share: Fraction
    share: Fraction
    edge: int
    leftward: bool


def _level_by_way(borders: _Borders, edge: int, share: Fraction, place: Place) -> int | None:
    """Return the level at a place of the sheet that goes straight on from an edge; None if that is through corners."""
    way = _between(_edge(borders.ends[edge]), share), place
    passed = _passed(borders, way, edge)
    if passed is None:
        return None
    level = _level_at(borders, edge, share)
    for border in sorted(passed):
        own = _level_at(borders, border.edge, border.share)
        level += int(level >= own) if border.leftward else -int(level > own)
    return level


def _passed(borders: _Borders, way: _Edge, own: int) -> list[_Passed] | None:
    """Return the edges but for one's own that a way passes; None if it touches one, or passes two at the same place."""
    passed = []
    for edge in _edges_near(borders, way):
        ends = _edge(borders.ends[edge])
        of_ends, of_way = (
            [exact_cross(*line, line[0], end) for end in other] for line, other in ((way, ends), (ends, way))
        )
        if edge == own or of_ends[0] * of_ends[1] > 0 or of_way[0] * of_way[1] > 0:
            continue
        if 0 in of_ends or 0 in of_way:
            return None
        way_share, share = (sides[0] / (sides[0] - sides[1]) for sides in (of_way, of_ends))
        passed.append(_Passed(way_share, share, edge, of_way[1] > 0))
    return passed if len({border.way_share for border in passed}) == len(passed) else None


def _edges_near(borders: _Borders, way: _Edge) -> list[int]:
    """Return the edges whose boxes may have something in common with a straight way."""
    rounded = np.array(way, dtype=np.float64)
    low, high = np.nextafter(rounded.min(axis=0), -np.inf), np.nextafter(rounded.max(axis=0), np.inf)
    return list(borders.tree.query(shapely.box(*low, *high)).tolist())


def _level_at(borders: _Borders, edge: int, share: Fraction) -> int:
    """Return the level of the own sheet at a place on an edge: that past the last crossing before the place."""
    arranged = borders.strip.arranged
    assert arranged.outline is not None
    loop = int(np.searchsorted(arranged.outline.first_point, edge, side="right")) - 1
    visits = arranged.crossing_visits
    first, stop = np.searchsorted(visits, arranged.first_visit[loop : loop + 2])
    if first == stop:
        return int(borders.level[arranged.loop_of_border == loop][0])
    low, high = first + np.searchsorted(arranged.visit_edge[visits[first:stop]], [edge, edge + 1])
    before = low + sum(borders.strip.share[visit] < share for visit in visits[low:high].tolist())
    # Before the first crossing of a loop comes its last one.
    return int(borders.level[arranged.border_after[visits[before - 1 if before > first else stop - 1]]])
