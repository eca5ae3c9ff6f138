"""Pieces of a drawing out: polygons as GeoJSON, WKT or SVG, triangles as OBJ or CSV."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.colours import INK, sheet_colour
from plyfold.io.svg_writing import drawing_svg, line_width, path_data

if TYPE_CHECKING:
    from shapely import Polygon


__all__ = ["POLYGON_WRITERS", "as_csv", "as_obj"]


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
    rings = [[np.array(ring.coords[:-1]) for ring in (polygon.exterior, *polygon.interiors)] for polygon in polygons]
    corners = np.concatenate([np.empty((0, 2)), *(ring for around in rings for ring in around)])
    parts = (
        f'<path fill="{sheet_colour(number)}" d="{"".join(path_data(ring * (1, -1)) for ring in around)}">'
        f"<title>{_title(told)}</title></path>"
        for number, (around, told) in enumerate(zip(rings, properties, strict=True))
    )
    style = f'fill-opacity="0.6" stroke="{INK}" stroke-width="{line_width(corners) / 2}" fill-rule="evenodd"'
    return drawing_svg(corners, parts, style)


def _title(told: dict[str, Any]) -> str:
    return ", ".join(f"{name} {json.dumps(value)}" for name, value in told.items())


def as_obj(points: Floats, faces: Ints) -> str:
    """Return a flat mesh at height 0."""
    rows = [f"v {x!r} {y!r} 0\n" for x, y in points.tolist()]
    return "".join([*rows, *(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces.tolist())])


def as_csv(faces: Ints) -> str:
    """Return the triangles alone, as numbers of points counted from 0."""
    return "a,b,c\n" + "".join(f"{a},{b},{c}\n" for a, b, c in faces.tolist())


POLYGON_WRITERS = {".geojson": as_geojson, ".wkt": as_wkt, ".svg": as_svg}
