"""How often a closed curve covers each part of the plane."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.noding import node_outline
from plyfold.arrangement.outward import winds_backward
from plyfold.arrangement.polylines import signed_areas
from plyfold.arrays import Floats, Ints
from plyfold.errors import GeneralPositionError, PrecisionError
from plyfold.flat.regions import refuse_invalid, regions
from plyfold.mesh.refine import chain_of, drawn_outline, given_outline
from plyfold.outline.curve import Outline
from plyfold.outline.given import OutlineLike, as_outline
from plyfold.outline.points import refuse_tiny
from plyfold.ragged import count_each, previous_in_rows

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
        Pairs (polygon, winding); those with winding number 0 are left out. An outline in general position has its
        cells in the order of the arrangement's. Nothing is moved: of a drawing that is not in general position, cells
        with one winding number that are parted by strands run to and fro are one cell, and there is no other cell than
        those drawn. The polygons are valid and do not overlap; one that touches itself at a point has a hole that
        touches its outline there. Crossings are rounded to double precision.

        The signs are those of the points as given or of the curve turned round, whichever has no negative winding
        number; if both have some, that in which the turning number is not negative; and of several curves that of the
        points as given. ``arrange(curve).reversed`` says which, where vertices need not be moved.

    Raises
    ------
    PrecisionError
        If rounding its crossings makes the drawing cross itself ever more, or it is so small that areas have no double.

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
    given = curve if isinstance(curve, Arrangement) else as_outline(curve)
    refuse_tiny((given_outline(given) if isinstance(given, Arrangement) else given).points, "polygons")
    drawn = given if isinstance(given, Arrangement) else _in_general_position(given)
    if isinstance(drawn, Arrangement):
        with suppress(PrecisionError):
            return _cells_of_arrangement(drawn), drawn.reversed
    outline = as_outline(drawn)
    noding = node_outline(outline)
    turned = winds_backward(outline, noding)
    found = regions(noding, np.negative if turned else np.positive)
    # An arrangement that was turned round has an outline that is.
    return [Covered(*region) for region in found], turned or (isinstance(drawn, Arrangement) and drawn.reversed)


def _in_general_position(outline: Outline) -> Arrangement | Outline:
    """Return the arrangement of an outline in general position, and any other outline as it is."""
    # Where points are equal there is no need to look for crossings, of which crowds have many.
    if _has_equal_points(outline.points):
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
    """Return the cells by their borders; they may be spoiled where rounding merges crossings."""
    wound = np.flatnonzero(drawn.winding).tolist()
    polygons = outlined(drawn, wound)
    return [Covered(*pair) for pair in zip(polygons, drawn.winding[wound].tolist(), strict=True)]


# ---- polygons from the borders around them ---------------------------------------------------------------------------


def outlined(arrangement: Arrangement, cells: Sequence[int]) -> list[Polygon]:
    """Return the polygons of some bounded cells.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing.
    cells : sequence of int

    Returns
    -------
    list of shapely.Polygon
        Valid, counter-clockwise. Where other loops lie in a cell, the polygon has holes; where its boundary passes
        through a crossing twice, a hole that touches its outline there.

    Raises
    ------
    PrecisionError
        If a polygon is no longer valid with its crossings rounded to doubles.
    """
    loops, owner = _without_pinches(arrangement, cells)
    coordinates, start = _coordinates(arrangement, loops)
    lines = shapely.linearrings(coordinates, indices=np.repeat(np.arange(len(loops)), np.diff(start)))
    hole = signed_areas(coordinates, start) < 0
    polygons = np.full(len(cells), None, dtype=object)
    polygons[owner[~hole]] = shapely.polygons(lines[~hole])
    for ring in np.unique(owner[hole]).tolist():
        own = slice(*np.searchsorted(owner, [ring, ring + 1]))
        if polygons[ring]:
            polygons[ring] = shapely.Polygon(polygons[ring].exterior, lines[own][hole[own]])
    refuse_invalid(polygons, coordinates[start[np.searchsorted(owner, np.arange(len(cells)))]])
    return list(polygons)


def _without_pinches(arrangement: Arrangement, cells: Sequence[int]) -> tuple[list[Sequence[int]], Ints]:
    """Return the boundary cycles of cells, split where they pass through a crossing twice, and their cells' places."""
    cycles, owner = _cycles(arrangement, cells)
    number = np.repeat(np.arange(len(cycles)), [len(cycle) for cycle in cycles])
    crossing = _start_crossing(arrangement, np.fromiter(chain.from_iterable(cycles), np.int64, len(number)))
    most = arrangement.n_crossings + len(arrangement.partner) + 1
    key = np.sort(number * most + crossing)
    pinched = set((key[1:][np.diff(key) == 0] // most).tolist())
    loops: list[Sequence[int]] = []
    owners: list[int] = []
    for cycle, ring in enumerate(cycles):
        parts = _simple_loops(arrangement, ring) if cycle in pinched else [ring]
        loops += parts
        owners += [owner[cycle]] * len(parts)
    return loops, np.array(owners, dtype=np.int64)


def _cycles(arrangement: Arrangement, cells: Sequence[int]) -> tuple[list[Sequence[int]], list[int]]:
    """Return the darts along each boundary cycle of some cells, and the place of its cell among them."""
    if arrangement.n_loops == 1:
        return [arrangement.cells[cell] for cell in cells], list(range(len(cells)))
    cycles, owner = [], []
    darts, start = arrangement.cell_darts.tolist(), arrangement.cycle_start.tolist()
    bounds = np.searchsorted(arrangement.cycle_start, arrangement.cell_start)
    for place, cell in enumerate(cells):
        for cycle in range(bounds[cell], bounds[cell + 1]):
            cycles.append(darts[start[cycle] : start[cycle + 1]])
            owner.append(place)
    return cycles, owner


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
    """Return the crossing at which each dart starts; for a mark a number of its own, and for no visit at all 0."""
    border, backward = np.divmod(dart, 2)
    visit = arrangement.start_visit[np.where(backward == 1, arrangement.next_border[border], border)]
    crossing = np.append(arrangement.crossing_of_visit, 0)[visit]
    return np.asarray(np.where(crossing < 0, arrangement.n_crossings + visit, crossing))


def _coordinates(arrangement: Arrangement, loops: Sequence[Sequence[int]]) -> tuple[Floats, Ints]:
    """Return the points of all loops after each other, and where each loop starts (and the last one ends)."""
    outline = drawn_outline(arrangement)
    points, chain_border, first_piece = chain_of(arrangement)
    dart = np.array(list(chain.from_iterable(loops)), dtype=np.int64)
    border, backward = dart // 2, dart % 2
    begin = _first_pieces(arrangement, chain_border, first_piece)
    count = np.bincount(chain_border, minlength=arrangement.n_borders)[border]
    first = begin[border] + backward * count
    last = np.cumsum(count)
    position = np.repeat(first, count) + np.repeat(1 - 2 * backward, count) * count_each(count)
    loop = np.repeat(arrangement.loop_of_border[border], count)
    low, length = first_piece[loop], np.diff(first_piece)[loop]
    darts_before = np.cumsum([0, *map(len, loops)])
    places = np.concatenate([outline.points, arrangement.crossings])[points]
    return places[low + (position - low) % length], np.concatenate([[0], last])[darts_before]


def _first_pieces(arrangement: Arrangement, chain_border: Ints, first_piece: Ints) -> Ints:
    """Return the first piece of the chain that is on each border."""
    begin = np.empty(arrangement.n_borders, dtype=np.int64)
    begin[chain_border[first_piece[:-1]]] = first_piece[:-1]
    change = np.flatnonzero(chain_border != chain_border[previous_in_rows(first_piece)])
    begin[chain_border[change]] = change
    return begin
