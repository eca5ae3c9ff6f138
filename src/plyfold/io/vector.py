"""Geometry as geographic tools write it: well-known text (WKT) and GeoJSON."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from plyfold.errors import FileFormatError
from plyfold.outline.curve import Curve
from plyfold.outline.given import as_curve

__all__ = ["read_geojson", "read_wkt"]

_HINT = "give one LineString, MultiLineString or Polygon without holes"
_CONTAINERS = {"FeatureCollection": "features", "GeometryCollection": "geometries", "MultiPolygon": "coordinates"}


def read_wkt(text: str) -> Curve:
    """Read a ``LINESTRING``, ``MULTILINESTRING`` (strokes) or ``POLYGON`` without holes.

    Parameters
    ----------
    text : str
        Well-known text; a leading ``SRID=...;`` is passed over.

    Returns
    -------
    Curve

    Raises
    ------
    FileFormatError
        If the text is broken.
    CurveError
        If the geometry is not one closed curve.
    StrokeError
        If the ends of open lines are too far apart.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> len(read_wkt("POLYGON ((0 0, 4 0, 0 3, 0 0))"))
    3
    """
    import shapely

    if text.upper().count("COLLECTION") > 1:  # the parser would recurse as deep as they are nested
        raise FileFormatError("it holds a collection in a collection", hint=_HINT)
    try:
        with np.errstate(all="ignore"):  # NaN and infinity are refused by the curve
            geometry = shapely.from_wkt(re.sub(r"^\s*SRID=\d+;", "", text, flags=re.IGNORECASE).strip())
    except shapely.errors.ShapelyError as error:
        raise FileFormatError(f"broken WKT ({error})", hint=_HINT) from error
    return as_curve(geometry)


def read_geojson(value: dict[str, Any]) -> Curve:
    """Read a GeoJSON geometry, a feature, or a collection of one.

    Parameters
    ----------
    value : dict
        The parsed GeoJSON object; altitudes are left out.

    Returns
    -------
    Curve

    Raises
    ------
    FileFormatError
        If it is no GeoJSON, or not exactly one geometry without holes.
    StrokeError
        If the ends of open lines are too far apart.

    Notes
    -----
    Linear in the number of points.

    Examples
    --------
    >>> len(read_geojson({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [0, 3], [0, 0]]]}))
    3
    """
    kind = str(value.get("type"))
    if kind == "Feature":
        return read_geojson(_object(value.get("geometry")))
    if kind in _CONTAINERS:
        only = _only(value.get(_CONTAINERS[kind]), f"the {kind} holds")
        return _curve_of_rings(only) if kind == "MultiPolygon" else read_geojson(_object(only))
    if kind == "Polygon":
        return _curve_of_rings(value.get("coordinates"))
    if kind == "LineString":
        return Curve.from_strokes([_positions(value.get("coordinates"))])
    if kind == "MultiLineString":
        return Curve.from_strokes([_positions(line) for line in _list(value.get("coordinates"))])
    raise _error(f"its type {kind[:40]!r} is not one closed curve")


def _curve_of_rings(rings: object) -> Curve:
    return Curve(_positions(_only(rings, "the rings of the polygon are")))


def _positions(line: object) -> list[Any]:
    """Return [x, y] for each position, or [x, y, 0] if some have an altitude, so that the curve says it is left out."""
    positions = [_list(position) for position in _list(line)]
    altitude = [0.0] if any(len(position) > 2 for position in positions) else []
    return [position[:2] + altitude for position in positions]


def _only(items: object, what: str) -> object:
    found = _list(items)
    if len(found) != 1:
        raise _error(f"{what} {len(found)}, not one")
    return found[0]


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
