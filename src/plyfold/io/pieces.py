"""Pieces of a drawing out: polygons as GeoJSON, WKT or SVG, triangles as OBJ or CSV."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.colours import sheet_colour

if TYPE_CHECKING:
    from shapely import Polygon


__all__ = ["POLYGON_WRITERS", "TRIANGLE_WRITERS"]


def as_geojson(polygons: Sequence[Polygon], properties: Sequence[dict[str, Any]]) -> str:
    """Return a collection of features, each a polygon with its properties."""
    import shapely

    features = [
        {"type": "Feature", "properties": told, "geometry": json.loads(shapely.to_geojson(polygon))}
        for polygon, told in zip(polygons, properties, strict=True)
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}) + "\n"


def as_wkt(polygons: Sequence[Polygon], properties: Sequence[dict[str, Any]]) -> str:
    """Return one polygon on a line; what is told of it is left out."""
    import shapely

    return "".join(shapely.to_wkt(polygon, rounding_precision=-1) + "\n" for polygon in polygons)


def as_svg(polygons: Sequence[Polygon], properties: Sequence[dict[str, Any]]) -> str:
    """Return a picture in the drawing's own units, y down: translucent polygons, what is told of them as titles."""
    left, low, right, high = _bounds(polygons)
    margin = 0.05 * max(right - left, high - low)
    box = f"{left - margin} {-high - margin} {right - left + 2 * margin} {high - low + 2 * margin}"
    parts = [
        f'<path fill="{sheet_colour(number)}" fill-opacity="0.6" stroke="#1d2638" stroke-width="{margin / 20}" '
        f'fill-rule="evenodd" d="{_path(polygon)}"><title>{_title(told)}</title></path>'
        for number, (polygon, told) in enumerate(zip(polygons, properties, strict=True))
    ]
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">\n' + "\n".join(parts) + "\n</svg>\n"


def _bounds(polygons: Sequence[Polygon]) -> tuple[float, float, float, float]:
    corners = np.array([polygon.bounds for polygon in polygons]).reshape(-1, 4)
    if not len(corners):
        return 0.0, 0.0, 1.0, 1.0
    return (*corners[:, :2].min(axis=0).tolist(), *corners[:, 2:].max(axis=0).tolist())


def _path(polygon: Polygon) -> str:
    rings = [polygon.exterior, *polygon.interiors]
    return "".join("M" + "L".join(f"{x!r},{-y!r}" for x, y in ring.coords[:-1]) + "Z" for ring in rings)


def _title(told: dict[str, Any]) -> str:
    return ", ".join(f"{name} {json.dumps(value)}" for name, value in told.items())


def as_obj(points: Floats, faces: Ints) -> str:
    """Return a flat mesh at height 0."""
    rows = [f"v {x!r} {y!r} 0\n" for x, y in points.tolist()]
    return "".join([*rows, *(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces.tolist())])


def as_csv(points: Floats, faces: Ints) -> str:
    """Return the triangles alone, as numbers of points counted from 0."""
    return "a,b,c\n" + "".join(f"{a},{b},{c}\n" for a, b, c in faces.tolist())


POLYGON_WRITERS = {".geojson": as_geojson, ".wkt": as_wkt, ".svg": as_svg}
TRIANGLE_WRITERS = {".obj": as_obj, ".csv": as_csv}
