"""How often a closed curve covers each part of the plane."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.noding import Noding, node_outline
from plyfold.arrangement.polylines import polygon_turning_number
from plyfold.arrays import Floats, Ints
from plyfold.errors import GeneralPositionError, PlyfoldError, PrecisionError
from plyfold.flat.regions import refuse_invalid, regions, signed_areas
from plyfold.mesh.cells import chain_of
from plyfold.outline.curve import Outline
from plyfold.outline.given import OutlineLike, as_outline
from plyfold.ragged import count_each

if TYPE_CHECKING:
    from shapely import Polygon

__all__ = ["Covered", "coverage", "directed_coverage", "outlined"]


# Any odd number; the fraction of the golden ratio scatters bits well.
_ODD = np.uint64(0x9E3779B97F4A7C15)


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


def coverage(curve: OutlineLike) -> list[Covered]:
    """Return the cells that closed curves wind round, with their winding numbers.

    Parameters
    ----------
    curve : Outline, Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such curves
        Any closed curves, whether they bound a disk or not, and however they touch, overlap or crowd.

    Returns
    -------
    list of Covered
        Pairs (polygon, winding); those with winding number 0 are left out. One curve in general position has its cells
        in the order of the arrangement's. Nothing is moved: of a drawing that is not in general position, cells with
        one winding number that are parted by strands run to and fro are one cell, and there is no other cell than
        those drawn. The polygons are valid and do not overlap; one that touches itself at a point has a hole that
        touches its outline there. Crossings are rounded to double precision.

        The signs are those of the points as given or of the curve turned round, whichever has no negative winding
        number; if both have some, that in which the turning number is not negative; and of several curves that of the
        points as given. ``arrange(curve).reversed`` says which, where vertices need not be moved.

    Raises
    ------
    PrecisionError
        If rounding its crossings makes the drawing cross itself ever more.

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

    Two triangles that meet in a point:

    >>> [cell.polygon.area for cell in coverage([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)])]
    [1.0, 1.0]
    """
    return directed_coverage(curve)[0]


def directed_coverage(curve: OutlineLike) -> tuple[list[Covered], bool]:
    """Return the same as :func:`coverage`, and whether the winding numbers are those of the curve turned round."""
    drawn = curve if isinstance(curve, Arrangement) else _in_general_position(as_outline(curve))
    if isinstance(drawn, Arrangement) and drawn.n_loops == 1:
        with suppress(PrecisionError):
            return _cells_of_arrangement(drawn), drawn.reversed
    outline = as_outline(drawn)
    noding = node_outline(outline)
    turned = _winds_backward(outline, noding)
    found = regions(noding, np.negative if turned else np.positive)
    # An arrangement that was turned round has an outline that is.
    return [Covered(*region) for region in found], turned or (isinstance(drawn, Arrangement) and drawn.reversed)


def _in_general_position(outline: Outline) -> Arrangement | Outline:
    """Return the arrangement of one curve, if it is in general position, and otherwise the outline as it is."""
    # Where points are equal there is no need to look for crossings, of which crowds have many.
    if outline.n_loops > 1 or _has_equal_points(outline.points):
        return outline
    try:
        return arrange(outline, general_position="raise")
    except GeneralPositionError:
        return outline


def _has_equal_points(points: Floats) -> bool:
    """Tell whether some points are equal; mostly none are, and then their hashes, sorted faster, tell it."""
    x, y = np.ascontiguousarray(points).view(np.uint64).T
    high = x * _ODD
    hashes = np.sort(((high ^ (high >> np.uint64(32))) + y) * _ODD)
    return bool((hashes[1:] == hashes[:-1]).any()) and len(np.unique(points, axis=0)) < len(points)


def _cells_of_arrangement(drawn: Arrangement) -> list[Covered]:
    """Return the cells of one curve by its borders; they may be spoiled where rounding merges crossings."""
    wound = np.flatnonzero(drawn.winding).tolist()
    polygons = outlined(drawn, [drawn.cells[cell] for cell in wound])
    return [Covered(*pair) for pair in zip(polygons, drawn.winding[wound].tolist(), strict=True)]


def _winds_backward(outline: Outline, noding: Noding) -> bool:
    """Tell whether an outline is to be turned round, by the same rule as arrangements."""
    least, most = int(noding.winding.min()), int(noding.winding.max())
    if least >= 0 or most <= 0:
        return least < 0
    return outline.n_loops == 1 and polygon_turning_number(outline.points) < 0


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
    hole = signed_areas(coordinates, start) < 0
    polygons = np.full(len(rings), None, dtype=object)
    polygons[owner[~hole]] = shapely.polygons(lines[~hole])
    for ring in np.unique(owner[hole]).tolist():
        own = slice(*np.searchsorted(owner, [ring, ring + 1]))
        if polygons[ring]:
            polygons[ring] = shapely.Polygon(polygons[ring].exterior, lines[own][hole[own]])
    refuse_invalid(polygons, coordinates[start[np.searchsorted(owner, np.arange(len(rings)))]])
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
