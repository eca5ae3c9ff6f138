"""Simple polygons that add up to the winding numbers of any closed curves: layer by layer, holes cut open."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrangement.noding import Noding, node_outline
from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import PrecisionError
from plyfold.flat.regions import regions
from plyfold.outline.curve import Outline
from plyfold.outline.points import refuse_tiny

if TYPE_CHECKING:
    from shapely import Polygon

__all__ = ["signed_layers"]

# Triangles of a polygon fill it but for roundings of this share of its area.
_AREA_ERROR = 1e-9
# Numbers between 2 to the power of this and its inverse have a fourth power, with room for sums.
_EXPONENTS = 240


def signed_layers(outline: Outline) -> tuple[list[Polygon], list[Polygon]]:
    """Return simple polygons that add up to the winding numbers: those that count once, and those that count −1 times.

    Raises
    ------
    PrecisionError
        If a polygon with holes is too thin to be cut into triangles.

    Examples
    --------
    >>> from plyfold.outline.curve import Curve
    >>> eight = Curve([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> [[part.area for part in parts] for parts in signed_layers(eight)]
    [[1.0], [1.0]]
    """
    refuse_tiny(outline.points, "polygons")
    noding = node_outline(outline)
    return _layers(noding, 1), _layers(noding, -1)


def _layers(noding: Noding, sign: int) -> list[Polygon]:
    """Return pieces of all places with winding number 1 or more, 2 or more, and so on, times a sign."""
    most = int((sign * noding.winding).max())
    found = (regions(noding, partial(_is_in_layer, sign, number)) for number in range(1, most + 1))
    return [piece for layer in found for region in layer for piece in _simple_pieces(region.polygon)]


def _is_in_layer(sign: int, number: int, winding: Ints) -> Ints:
    return (sign * winding >= number).astype(np.int64)


def _simple_pieces(polygon: Polygon) -> list[Polygon]:
    """Cut a polygon into simple ones, in a unit in which its size has a fourth power, as the library takes it."""
    exponent = math.frexp(max(map(abs, polygon.bounds)))[1]
    if -_EXPONENTS < exponent < _EXPONENTS:
        return _without_holes(polygon)
    return [_times_power(exponent, piece) for piece in _without_holes(_times_power(-exponent, polygon))]


def _times_power(exponent: int, polygon: Polygon) -> Polygon:
    return shapely.transform(polygon, lambda places: np.ldexp(places, exponent))


def _without_holes(polygon: Polygon) -> list[Polygon]:
    """Cut a polygon along chords into simple polygons without holes; each cut passes through a hole, if it can."""
    pieces, uncut = [], [polygon]
    while uncut:
        part = uncut.pop()
        if len(part.interiors) == 0:
            pieces.append(part)
            continue
        try:
            uncut += _cut_between_triangles(part)
        except (PrecisionError, shapely.errors.GEOSException):
            uncut += _cut_across(part)
    return pieces


def _cut_between_triangles(polygon: Polygon) -> list[Polygon]:
    """Cut a polygon along chords between its corners."""
    triangles = _triangles(polygon)
    beyond = _beyond(polygon, shapely.get_coordinates(shapely.centroid(triangles)))
    halves = (triangles[beyond], triangles[~beyond])
    return [part for half in halves for part in shapely.get_parts(shapely.coverage_union_all(half)).tolist()]


def _cut_across(polygon: Polygon) -> list[Polygon]:
    """Cut a polygon too thin for triangles, straight through its first hole."""
    left, bottom, right, top = polygon.bounds
    low_x, low_y, high_x, high_y = polygon.interiors[0].bounds
    x, y = (low_x + high_x) / 2, (low_y + high_y) / 2
    if high_x - low_x > high_y - low_y:
        halves = (left, bottom, x, top), (x, bottom, right, top)
    else:
        halves = (left, bottom, right, y), (left, y, right, top)
    parts = shapely.get_parts([shapely.intersection(polygon, shapely.box(*half)) for half in halves])
    found: list[Polygon] = parts[shapely.area(parts) > 0].tolist()
    if sum(len(part.interiors) for part in found) >= len(polygon.interiors):
        raise PrecisionError("a polygon with a hole is too thin to be cut", where=polygon.exterior.coords[:1])
    return found


def _triangles(polygon: Polygon) -> npt.NDArray[np.object_]:
    found = shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
    if not abs(shapely.area(found).sum() - polygon.area) <= _AREA_ERROR * polygon.area:
        raise PrecisionError("a polygon with a hole is too thin to be cut", where=polygon.exterior.coords[:1])
    return np.asarray(found)


def _beyond(polygon: Polygon, centres: Floats) -> Bools:
    """Divide the triangles of a polygon by an upright line through its first hole, or else into two halves."""
    low, _, high, _ = polygon.interiors[0].bounds
    beyond: Bools = centres[:, 0] > (low + high) / 2
    if beyond.all() or not beyond.any():
        beyond = np.argsort(np.argsort(centres[:, 0])) >= len(centres) // 2
    return beyond
