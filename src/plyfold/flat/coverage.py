"""How often a closed curve covers each part of the plane."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrays import Floats, Ints
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.mesh.cells import chain_of
from plyfold.outline.given import CurveLike
from plyfold.ragged import count_each

if TYPE_CHECKING:
    from shapely import Polygon

__all__ = ["Covered", "coverage", "outlined"]


class Covered(NamedTuple):
    """A cell, and how often the curve goes round it, counter-clockwise in the direction of its arrangement.

    Parameters
    ----------
    polygon : shapely.Polygon
    winding : int

    Examples
    --------
    >>> [cell.winding for cell in coverage([(0, 0), (1, 0), (0, 1)])]
    [1]
    """

    polygon: Polygon
    winding: int


def coverage(curve: CurveLike) -> list[Covered]:
    """Return the cells that a closed curve winds round, with their winding numbers.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
        Any closed curve, whether it bounds a disk or not.

    Returns
    -------
    list of Covered
        Pairs (polygon, winding), in the order of the arrangement's cells; those with winding number 0 are left out.
        The polygons are valid and do not overlap; one that touches itself at a crossing has a hole that touches its
        outline there. Crossings are rounded to double precision.

        The signs are those of the direction in which the turning number is not negative: of the points as given, or,
        if ``arrange(curve).reversed``, of the curve turned round. In the other direction they are the opposite.

    Raises
    ------
    PrecisionError
        If a polygon is no longer valid with its crossings rounded; it names the place.

    Notes
    -----
    O((n + k) log n) for n points and k crossings.

    Examples
    --------
    >>> eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
    >>> [(cell.polygon.area, cell.winding) for cell in coverage(eight)]
    [(1.0, -1), (1.0, 1)]
    >>> clockwise = [(0, 0), (0, 1), (1, 1), (1, 0)]
    >>> coverage(clockwise)[0].winding, arrange(clockwise).reversed
    (1, True)
    """
    drawn = arrange(curve)
    wound = np.flatnonzero(drawn.winding).tolist()
    polygons = outlined(drawn, [drawn.cells[cell] for cell in wound])
    return [Covered(*pair) for pair in zip(polygons, drawn.winding[wound].tolist(), strict=True)]


# ---- polygons from the borders around them ---------------------------------------------------------------------------


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
    position = np.repeat(first, count) + np.repeat(1 - 2 * backward, count) * count_each(count)
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
