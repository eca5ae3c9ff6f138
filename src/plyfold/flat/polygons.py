"""Polygons from the borders around them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.mesh.cells import chain_of

if TYPE_CHECKING:
    from shapely import Polygon

__all__ = ["outlined"]


def outlined(arrangement: Arrangement, rings: Sequence[Sequence[int]]) -> list[Polygon]:
    """Return the polygons with the given borders around them.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing.
    rings : sequence of sequences of int
        For each polygon the darts around it, in order, with the polygon on their left.

    Returns
    -------
    list of shapely.Polygon
        Valid, counter-clockwise. Where the darts pass through a crossing twice, the polygon has a hole that touches
        its outline there.

    Raises
    ------
    PrecisionError
        If a polygon is no longer valid with its crossings rounded to doubles.
    """
    import shapely

    loops, owner = _without_pinches(arrangement, rings)
    coordinates, start = _coordinates(arrangement, loops)
    lines = shapely.linearrings(coordinates, indices=np.repeat(np.arange(len(loops)), np.diff(start)))
    hole = _signed_areas(coordinates, start) < 0
    polygons = np.full(len(rings), None, dtype=object)
    polygons[owner[~hole]] = shapely.polygons(lines[~hole])
    for ring in np.unique(owner[hole]).tolist():
        own = slice(*np.searchsorted(owner, [ring, ring + 1]))
        if polygons[ring]:
            polygons[ring] = shapely.Polygon(polygons[ring].exterior, lines[own][hole[own]])
    _refuse_invalid(polygons, coordinates[start[np.searchsorted(owner, np.arange(len(rings)))]])
    return list(polygons)


def _without_pinches(arrangement: Arrangement, rings: Sequence[Sequence[int]]) -> tuple[list[Sequence[int]], Ints]:
    """Split rings that pass through a crossing twice; return the loops, and the ring that each comes from."""
    size = np.array([len(ring) for ring in rings], dtype=np.int64)
    owner = np.repeat(np.arange(len(rings)), size)
    crossing = _start_crossing(arrangement, np.fromiter(chain.from_iterable(rings), dtype=np.int64, count=size.sum()))
    key = np.sort(owner * (arrangement.n_crossings + 1) + crossing)
    pinched = set((key[1:][np.diff(key) == 0] // (arrangement.n_crossings + 1)).tolist())
    loops: list[Sequence[int]] = []
    owners: list[int] = []
    for number, ring in enumerate(rings):
        parts = _simple_loops(arrangement, ring) if number in pinched else [ring]
        loops += parts
        owners += [number] * len(parts)
    return loops, np.array(owners, dtype=np.int64)


def _simple_loops(arrangement: Arrangement, ring: Sequence[int]) -> list[Sequence[int]]:
    """Split a ring of darts whenever it comes back to a crossing."""
    loops: list[Sequence[int]] = []
    path: list[int] = []
    place: dict[int, int] = {}
    for dart, crossing in zip(ring, _start_crossing(arrangement, np.array(ring)).tolist(), strict=True):
        if crossing in place:
            first = place[crossing]
            loops.append(path[first:])
            del path[first:]
            place = {other: at for other, at in place.items() if at < first}
        place[crossing] = len(path)
        path.append(dart)
    return [*loops, path]


def _start_crossing(arrangement: Arrangement, dart: Ints) -> Ints:
    """Return the crossing at which each dart starts."""
    if arrangement.n_crossings == 0:
        return np.zeros(len(dart), dtype=np.int64)
    return np.asarray(arrangement.crossing_of_visit[(dart // 2 + dart % 2) % arrangement.n_borders])


def _coordinates(arrangement: Arrangement, loops: Sequence[Sequence[int]]) -> tuple[Floats, Ints]:
    """Return the points of all loops after each other, and where each loop starts (and the last one ends)."""
    curve = arrangement.curve
    if curve is None:
        raise PlyfoldError("polygons need a drawing, and this arrangement is a Gauss code alone")
    visits = len(arrangement.visit_edge)
    points = np.concatenate([curve.points, arrangement.crossings])[chain_of(arrangement)[0]]
    dart = np.array(list(chain.from_iterable(loops)), dtype=np.int64)
    border, backward = dart // 2, dart % 2
    begin = arrangement.visit_edge + np.arange(1, visits + 1) if visits else np.zeros(1, dtype=np.int64)
    length = (np.roll(begin, -1) - begin - 1) % len(points) + 1
    count = length[border]
    first = begin[border] + backward * count
    last = np.cumsum(count)
    step = np.arange(last[-1]) - np.repeat(last - count, count)
    position = np.repeat(first, count) + np.repeat(1 - 2 * backward, count) * step
    darts_before = np.cumsum([0, *map(len, loops)])
    return points[position % len(points)], np.concatenate([[0], last])[darts_before]


def _signed_areas(coordinates: Floats, start: Ints) -> Floats:
    """Return the signed area of each loop, measured from its first point."""
    x, y = (coordinates - np.repeat(coordinates[start[:-1]], np.diff(start), axis=0)).T
    following = np.arange(1, len(x) + 1)
    following[start[1:] - 1] = start[:-1]
    return np.asarray(np.add.reduceat(x * y[following] - y * x[following], start[:-1]) / 2)


def _refuse_invalid(polygons: npt.NDArray[np.object_], corner: Floats) -> None:
    """Raise PrecisionError if a polygon is missing or not valid; it has the given corner."""
    import shapely

    bad = np.flatnonzero(~shapely.is_valid(polygons))
    if len(bad) == 0:
        return
    reasons = " ".join(filter(None, shapely.is_valid_reason(polygons[bad])))
    places = [(float(x), float(y)) for x, y in re.findall(r"\[(\S+) (\S+)\]", reasons)]
    raise PrecisionError(
        "strands are so close that rounding their crossings to double precision spoils a polygon there",
        where=places or corner[bad],
        hint="move the strands apart there",
    )
