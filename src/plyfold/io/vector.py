"""Geometry as geographic tools write it: well-known text (WKT) and GeoJSON."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from plyfold.errors import FileFormatError
from plyfold.io.cusp_notation import cusps_of_loops
from plyfold.io.shapes import Line, Shape, shape_of_strokes
from plyfold.outline.given import left_out_coordinates
from plyfold.outline.points import Repair, as_planar_points

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["shapes_in_geojson", "shapes_in_wkt"]

_HINT = "give LineStrings, Polygons, or MultiLineStrings and MultiPolygons"
# Another geometry on a line of its own; in a collection there would be a comma.
_NEXT_GEOMETRY = re.compile(r"\)\s*\n\s*(?=[A-Za-z])")


def shapes_in_wkt(text: str) -> list[Shape]:
    """Read lines and polygons as well-known text: one geometry, a collection, or several on lines of their own.

    Parameters
    ----------
    text : str
        A leading ``SRID=...;`` is passed over.

    Returns
    -------
    list of Shape
        One for each geometry. A ``LINESTRING`` that ends where it starts is a loop, and a ``MULTILINESTRING`` of such;
        other lines are strokes.

    Raises
    ------
    FileFormatError
        If the text is broken, or there are other geometries.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> [shape] = shapes_in_wkt("POLYGON ((0 0, 9 0, 0 9, 0 0), (1 1, 2 1, 1 2, 1 1))")
    >>> [loop.direction for loop in shape.loops]
    [1, -1]
    """
    if text.upper().count("COLLECTION") > 1:  # the parser would recurse as deep as they are nested
        raise FileFormatError("it holds a collection in a collection", hint=_HINT)
    plain = re.sub(r"^\s*SRID=\d+;", "", text, flags=re.IGNORECASE).strip()
    geometries = list(map(_geometry, _NEXT_GEOMETRY.sub(")\0", plain).split("\0")))
    if len(geometries) == 1 and geometries[0].is_empty:
        raise FileFormatError(f"the {geometries[0].geom_type} is empty", hint="give a ring or line with points")
    return _with_lines_first([shape for geometry in geometries for shape in _shapes_of_geometry(geometry)])


def _geometry(text: str) -> BaseGeometry:
    import shapely

    try:
        with np.errstate(all="ignore"):  # NaN and infinity are refused by the curve
            geometry = shapely.from_wkt(text)
    except shapely.errors.ShapelyError as error:
        raise FileFormatError(f"broken WKT ({error})", hint=_HINT) from error
    return geometry


def _shapes_of_geometry(geometry: BaseGeometry) -> list[Shape]:
    if geometry.is_empty:
        return []
    shapes, said = _shapes_of_parts(geometry), left_out_coordinates(geometry)
    return [shapes[0]._replace(repairs=(*said, *shapes[0].repairs)), *shapes[1:]]


def _shapes_of_parts(geometry: BaseGeometry) -> list[Shape]:
    """Return the shape of a geometry, or those of the parts of a collection."""
    from shapely import get_coordinates

    parts = list(getattr(geometry, "geoms", [geometry]))
    match geometry.geom_type:
        case "GeometryCollection":
            return [shape for part in parts if not part.is_empty for shape in _shapes_of_parts(part)]
        case "Polygon" | "MultiPolygon":
            rings = [[part.exterior, *part.interiors] for part in parts]
            return [Shape(tuple(_rings([list(map(get_coordinates, polygon)) for polygon in rings])))]
        case "Point" | "MultiPoint":
            return [Shape((), "", _points_left_out(get_coordinates(geometry)))]
    shape = shape_of_strokes(map(get_coordinates, parts))
    drawn = [part for part in parts if not (shape.loops[0].closed and part.is_empty)]
    heights = (get_coordinates(part, include_z=True)[:, 2] if part.has_z else None for part in drawn)
    return [shape._replace(loops=tuple(line._replace(heights=z) for line, z in zip(shape.loops, heights, strict=True)))]


def shapes_in_geojson(value: dict[str, Any]) -> list[Shape]:
    """Read a GeoJSON geometry, a feature, or a collection.

    Parameters
    ----------
    value : dict
        The parsed GeoJSON object; altitudes are left out.

    Returns
    -------
    list of Shape
        One for each feature or geometry, named by its ``id``. Shells are to run counter-clockwise and holes clockwise;
        lines are as in :func:`shapes_in_wkt`. Features may have a property ``cusps``.

    Raises
    ------
    FileFormatError
        If it is no GeoJSON, or has neither lines nor polygons. Beside them, points are left out; the repairs say so.

    Notes
    -----
    Linear in the number of points.

    Examples
    --------
    >>> ring = [[0, 0], [4, 0], [0, 3], [0, 0]]
    >>> [shape] = shapes_in_geojson({"type": "Polygon", "coordinates": [ring]})
    >>> shape.loops[0].points
    [[0, 0], [4, 0], [0, 3], [0, 0]]
    """
    try:
        shapes = _shapes(value)
    except RecursionError as error:
        raise _error("it is nested too deep") from error
    if not shapes:
        raise _error(f"the {_kind(value)} holds nothing")
    return _with_lines_first(shapes)


def _with_lines_first(shapes: list[Shape]) -> list[Shape]:
    """Return the shapes that have lines; what is said of the others is said of the first of them."""
    repairs = [repair for shape in shapes if not shape.loops for repair in shape.repairs]
    drawn = [shape for shape in shapes if shape.loops]
    if not drawn:
        raise _error("it holds no line and no polygon, but points alone" if repairs else "it holds nothing")
    first, *others = drawn
    return [first._replace(repairs=(*repairs, *first.repairs)), *others]


def _shapes(value: dict[str, Any], name: str = "", cusps: object = None) -> list[Shape]:
    kind = _kind(value)
    if kind == "FeatureCollection":
        return [shape for feature in _list(value.get("features")) for shape in _shapes(_object(feature))]
    if kind == "GeometryCollection":
        return [shape for part in _list(value.get("geometries")) for shape in _shapes(_object(part), name)]
    if kind == "Feature":
        return _shapes_of_feature(value)
    return [_shape(kind, value.get("coordinates"), name, cusps)]


def _shapes_of_feature(feature: dict[str, Any]) -> list[Shape]:
    properties, name = feature.get("properties"), feature.get("id")
    cusps = properties.get("cusps") if isinstance(properties, dict) else None
    if feature.get("geometry", 0) is None:  # a feature without a place
        return []
    shapes = _shapes(_object(feature.get("geometry")), "" if name is None else str(name), cusps)
    if cusps is not None and len(shapes) != 1:
        raise _error("a feature with cusps holds several geometries")
    return shapes


def _kind(value: dict[str, Any]) -> str:
    return str(value.get("type"))[:40]


def _shape(kind: str, coordinates: object, name: str, cusps: object) -> Shape:
    if kind in ("Point", "MultiPoint"):
        positions = _positions([coordinates] if kind == "Point" else coordinates)
        return Shape((), name, _points_left_out(positions))
    if kind in ("Polygon", "MultiPolygon"):
        polygons = [
            polygon for polygon in ([coordinates] if kind == "Polygon" else _list(coordinates)) if polygon != []
        ]
        rings = _rings([list(map(_positions, _list(polygon))) for polygon in polygons])
        lengths = [len(_list(ring.points)) for ring in rings]
        marks = cusps_of_loops(cusps, lengths)
        return Shape(tuple(ring._replace(cusps=marked) for ring, marked in zip(rings, marks, strict=True)), name)
    if kind in ("LineString", "LinearRing", "MultiLineString"):
        lines = _list(coordinates) if kind == "MultiLineString" else [coordinates]
        shape = shape_of_strokes(map(_positions, lines), name)
        marks = cusps_of_loops(cusps, [len(_list(line.points)) for line in shape.loops])
        marked = zip(shape.loops, marks, strict=True)
        return shape._replace(loops=tuple(line._replace(cusps=cusps_of_line) for line, cusps_of_line in marked))
    raise _error(f"its type {kind!r} is no line or polygon")


def _rings(polygons: Sequence[Sequence[Any]]) -> list[Line]:
    """Return the rings of polygons: of each first its shell, then its holes."""
    return [Line(ring, direction=-1 if number else 1) for polygon in polygons for number, ring in enumerate(polygon)]


def _points_left_out(positions: npt.ArrayLike) -> tuple[Repair, ...]:
    points, _ = as_planar_points(positions)
    return tuple(Repair("point left out", (x, y), 0.0) for x, y in points.tolist())


def _positions(line: object) -> list[Any]:
    """Return [x, y] for each position, or [x, y, z] if some have an altitude; it is NaN where there is none."""
    positions = [_list(position) for position in _list(line)]
    if not any(len(position) > 2 for position in positions):
        return [position[:2] for position in positions]
    return [[*position[:2], _altitude(position)] for position in positions]


def _altitude(position: list[Any]) -> float:
    try:
        return float(position[2]) if type(position[2]) in (int, float) else math.nan
    except (IndexError, OverflowError):
        return math.nan


def _list(value: object) -> list[Any]:
    if not isinstance(value, list):
        raise _error("a list is missing in the GeoJSON")
    return value


def _object(value: object) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise _error("a geometry is missing in the GeoJSON")
    return value


def _error(reason: str) -> FileFormatError:
    return FileFormatError(reason, hint=_HINT)
