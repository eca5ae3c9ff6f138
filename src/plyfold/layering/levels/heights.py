"""Layerings of ribbons from the heights of their lines: the higher part passes over, wherever the ribbon overlaps.

The ribbon is a strip of triangles, with a height at each of its points. At a place on its outline, the level of the
border's own sheet is one more than the number of triangles over that place that are lower. These levels make a layering
if they change at each crossing as those of a surface do.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.places import places_of_crossings, places_of_visits
from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import InputError
from plyfold.layering.layering import Layering, borders_beside_top, layering_of_levels
from plyfold.layering.levels.courses import first_disobeyed
from plyfold.layering.levels.laid_strip import LaidStrip, height_on_edge, laid_strip
from plyfold.obstruction import Obstruction
from plyfold.outline.ribbons.line import as_line
from plyfold.outline.ribbons.ribbon import CapStyle, JoinStyle, LineLike, Ribbon, ribbon_of_line, style_of
from plyfold.predicates import Place, exact_cross

__all__ = ["layering_by_heights", "ribbon_layering"]


def ribbon_layering(  # noqa: PLR0913 - each option is keyword-only and independent
    line: LineLike,
    width: npt.ArrayLike,
    join_style: JoinStyle = "round",
    cap_style: CapStyle = "flat",
    *,
    closed: bool | None = None,
    quad_segs: int = 8,
    mitre_limit: float = 5.0,
) -> Layering | Obstruction:
    """Give a line with heights a width, and lay the ribbon over itself as the heights say.

    Parameters
    ----------
    line : array_like of shape (n, 3), or shapely LineString with z
        Points in order and their heights, in any unit. Across the ribbon the height is that of the line.
    width : float or array_like of shape (n,)
    join_style : {"round", "mitre", "bevel"}
    cap_style : {"flat", "round", "square"}
    closed : bool, optional
    quad_segs : int, optional
    mitre_limit : float, optional
        All as for :func:`~plyfold.ribbon`.

    Returns
    -------
    Layering or Obstruction
        A layering of :func:`ribbon(...) <plyfold.ribbon>`: all along its outline, sheets are in the order of their
        heights there, and wherever the line meets itself the higher part of it lies over the lower one. Or the
        obstruction ``"heights"``, if no cloth can follow them: around a crossing of the outline, whose number is its
        ``value``, parts of the ribbon would pass through each other; or where the line meets itself, at the two heights
        that are its ``value``, the higher part would be below, or both would be in one sheet of a ribbon that is wider
        than a bend.

    Raises
    ------
    InputError
        If the line has no heights; if two parts of the ribbon have the same height at a crossing, or where one passes
        over the other's border; and as :func:`~plyfold.ribbon`.
    PrecisionError
        If the ribbon touches itself and is so thin there that doubles cannot keep its parts apart.

    Notes
    -----
    Heights are compared in fractions. The surface that :func:`~plyfold.lift` makes of the layering has the order of the
    heights, not the heights themselves. O(k log n + Σ w), with k crossings of n points.

    Examples
    --------
    A road that passes over itself, and the same road as an underpass:

    >>> road = [(0, 0, 0), (9, 0, 0), (9, 6, 1), (4, 6, 1), (4, -5, 1)]
    >>> above = ribbon_layering(road, 2)
    >>> below = ribbon_layering([(x, y, -z) for x, y, z in road], 2)
    >>> above.level.max(), (above.casing == ~below.casing).all()
    (np.int64(2), np.True_)
    """
    wide = as_line(line, width, closed)
    if wide.heights is None:
        raise InputError("the line has no heights", hint="give a third column, or take pf.ribbon and pf.find_embedding")
    return layering_by_heights(ribbon_of_line(wide, style_of(join_style, cap_style, quad_segs, mitre_limit)))


def layering_by_heights(ribbon: Ribbon) -> Layering | Obstruction:
    """Return the layering of a ribbon whose points have heights; see :func:`ribbon_layering`."""
    strip = laid_strip(ribbon)
    level = _levels(strip)
    fault = _first_fault(strip.arranged, level, _casing(strip))
    if fault is None:
        fault = first_disobeyed(strip, ribbon.courses, level)
    return layering_of_levels(strip.arranged, level) if fault is None else fault


def _casing(strip: LaidStrip) -> Bools:
    """Return at which visits the strand is the higher one; refuse equal heights."""
    arranged = strip.arranged
    height = {v: height_on_edge(strip, int(arranged.visit_edge[v]), share) for v, share in strip.share.items()}
    casing = np.zeros(len(arranged.partner), dtype=bool)
    for visit, mine in height.items():
        other = height[int(arranged.partner[visit])]
        if mine == other:
            raise _same_height(places_of_visits(arranged, [visit])[0])
        casing[visit] = mine > other
    return casing


def _same_height(place: npt.ArrayLike) -> InputError:
    return InputError(
        "two parts of the ribbon overlap at the same height",
        where=[np.asarray(place)],
        hint="give one of them another height there",
    )


# ---- levels ----------------------------------------------------------------------------------------------------------


class _Stretch(NamedTuple):
    """A part of a loop from one crossing to the next, or a whole loop: its borders, and a place on it."""

    borders: Ints
    edge: int
    share: Fraction


def _levels(strip: LaidStrip) -> Ints:
    """Return the level of each border's own sheet: how many sheets there are below it, and 1."""
    level = np.ones(strip.arranged.n_borders, dtype=np.int64)
    stretches = [stretch for stretch in _stretches(strip) if _winding(strip, stretch) > 1]
    places = [_place(strip, stretch) for stretch in stretches]
    for stretch, place, faces in zip(stretches, places, _faces_around(strip, places), strict=True):
        height = height_on_edge(strip, stretch.edge, stretch.share)
        others = [_height_in_face(strip, face, place) for face in faces if face != strip.own_face[stretch.edge]]
        if height in others:
            raise _same_height(_place_as_given(strip, stretch))
        level[stretch.borders] = 1 + sum(other is not None and other < height for other in others)
    return level


def _winding(strip: LaidStrip, stretch: _Stretch) -> int:
    return int(strip.arranged.winding[strip.arranged.left_cell[stretch.borders[0]]])


def _stretches(strip: LaidStrip) -> Iterator[_Stretch]:
    """Yield the parts of the outline between crossings. Marks between them are passed over: no level changes there."""
    arranged = strip.arranged
    loops = arranged.loop_of_border
    assert arranged.outline is not None
    for loop in range(arranged.n_loops):
        borders = np.flatnonzero(loops == loop)
        visits = arranged.crossing_visits
        visits = visits[(visits >= arranged.first_visit[loop]) & (visits < arranged.first_visit[loop + 1])]
        if not len(visits):
            yield _Stretch(borders, int(arranged.outline.first_point[loop]), Fraction(1, 2))
            continue
        last = (np.searchsorted(visits, arranged.start_visit[borders], side="right") - 1) % len(visits)
        for number, (visit, following) in enumerate(zip(visits.tolist(), np.roll(visits, -1).tolist(), strict=True)):
            yield _Stretch(borders[last == number], *_between(strip, visit, following))


def _between(strip: LaidStrip, visit: int, following: int) -> tuple[int, Fraction]:
    """Return an edge and a share of it, past a visit and before the next one."""
    edge, next_edge = strip.arranged.visit_edge[[visit, following]].tolist()
    share, end = strip.share[visit], strip.share[following]
    return edge, (share + (end if edge == next_edge and end > share else 1)) / 2


def _place(strip: LaidStrip, stretch: _Stretch) -> Place:
    start, end = strip.points[[stretch.edge, strip.next_point[stretch.edge]]].tolist()
    x, y = ((1 - stretch.share) * Fraction(a) + stretch.share * Fraction(b) for a, b in zip(start, end, strict=True))
    return x, y


def _place_as_given(strip: LaidStrip, stretch: _Stretch) -> Floats:
    """Return the place on its edge, if points in contact are where they were given."""
    given = strip.arranged.given
    assert given is not None
    start, end = given.points[[stretch.edge, strip.next_point[stretch.edge]]]
    return np.asarray(start + float(stretch.share) * (end - start))


def _faces_around(strip: LaidStrip, places: list[Place]) -> list[list[int]]:
    """Return the triangles whose bounding boxes may hold each place."""
    corners = strip.points[strip.faces].astype(np.float64)
    tree = shapely.STRtree(shapely.box(*corners.min(axis=1).T, *corners.max(axis=1).T))
    # Fractions lie between the doubles next to what they are rounded to.
    rounded = np.array([[float(x), float(y)] for x, y in places]).reshape(-1, 2)
    low, high = np.nextafter(rounded, -np.inf), np.nextafter(rounded, np.inf)
    place, face = tree.query(shapely.box(*low.T, *high.T))
    found: list[list[int]] = [[] for _ in places]
    for number, near in zip(place.tolist(), face.tolist(), strict=True):
        found[number].append(near)
    return found


def _height_in_face(strip: LaidStrip, face: int, place: Place) -> Fraction | None:
    """Return the height of a triangle over a place, or None if it does not lie there.

    Of a place on an edge it is said that it lies a little to the right of it, and above it by much less: so it lies in
    one of the two triangles.
    """
    corners = strip.faces[face].tolist()
    a, b, c = ((Fraction(x), Fraction(y)) for x, y in strip.points[corners].tolist())
    weights = [exact_cross(start, end, start, place) for start, end in ((b, c), (c, a), (a, b))]
    if not all(map(_is_left, weights, ((b, c), (c, a), (a, b)))):
        return None
    heights = [Fraction(float(strip.heights[corner])) for corner in corners]
    return sum((w * z for w, z in zip(weights, heights, strict=True)), Fraction(0)) / sum(weights)


def _is_left(area: Fraction, edge: tuple[Place, Place]) -> bool:
    """Tell whether a place lies left of an edge; if on it, whether it would if it were moved as above."""
    (x, y), (end_x, end_y) = edge
    return area > 0 or (area == 0 and (end_y < y or (end_y == y and end_x > x)))


# ---- crossings -------------------------------------------------------------------------------------------------------


def _first_fault(arranged: Arrangement, level: Ints, casing: Bools) -> Obstruction | None:
    """Return the first crossing around which the levels do not change as those of a surface do, if there is one."""
    visit = np.arange(len(arranged.partner))
    is_mark = arranged.crossing_of_visit < 0
    beside_top = borders_beside_top(arranged)
    top = level[beside_top]
    elsewhere = level[arranged.border_before + arranged.border_after - beside_top]
    passes = top > top[arranged.partner]
    fits = (elsewhere == top - passes) & (passes == casing) & (passes != passes[arranged.partner])
    faults = visit[~fits & ~is_mark]
    if not len(faults):
        return None
    crossing = int(arranged.crossing_of_visit[faults].min())
    # The drawing as given has other crossings where points in contact were moved apart.
    name = f"crossing {crossing}" if arranged.given is arranged.outline else "the crossing there"
    sentence = f"No cloth follows these heights: around {name}, the ribbon would pass through itself."
    return Obstruction("heights", sentence, places_of_crossings(arranged, [crossing]), crossing, arranged)
