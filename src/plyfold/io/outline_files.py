"""Outlines as files that are read back exactly: JSON, GeoJSON, WKT, SVG and CSV."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import INK
from plyfold.errors import InputError
from plyfold.io.cusp_notation import cusp_marks, written_cusp
from plyfold.io.own_version import OWN_VERSION, SVG_MARK
from plyfold.io.saving import refuse_existing, save_bytes
from plyfold.io.svg_writing import drawing_svg, line_width, path_data
from plyfold.outline.curve import Outline
from plyfold.outline.direction import sense
from plyfold.outline.given import OutlineLike, as_outline

__all__ = ["OUTLINE_WRITERS", "save"]


def save(outline: OutlineLike, path: str | os.PathLike[str], *, force: bool = False) -> None:
    """Write an outline to a file, from which :func:`~plyfold.read` gives the same points, loops and cusps.

    Parameters
    ----------
    outline : Outline or whatever stands for one
    path : path
        The ending chooses the format: ``.json``, ``.geojson``, ``.wkt``, ``.svg`` or ``.csv``.
    force : bool, optional
        Replace an existing file.

    Raises
    ------
    InputError
        If the ending is none of these, or the outline has cusps and the format is WKT, which has no place for them.
    FileExistsError
        If the file exists and ``force`` is not set.

    Notes
    -----
    What was changed in the outline before, its ``repairs``, is not written. Linear in the number of points.

    GeoJSON and WKT have a LineString, if one loop crosses itself; a Polygon or MultiPolygon, if the loops are what
    these formats take for one: shells counter-clockwise, each followed by its holes; and a MultiLineString of closed
    lines otherwise. Cusps are a property ``cusps`` in GeoJSON, an attribute ``data-cusps`` in SVG, and a column in CSV.

    Examples
    --------
    >>> import tempfile
    >>> from plyfold import read
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "ring.json"
    ...     save([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]], file)
    ...     print(file.read_text(), read(file))
    {"version": 2, "loops": [[[0.0, 0.0], [9.0, 0.0], [0.0, 9.0]], [[1.0, 1.0], [1.0, 3.0], [3.0, 1.0]]]}
     <Outline of 2 loops, 6 points>
    """
    ending = Path(path).suffix.lower()
    if ending not in OUTLINE_WRITERS:
        hint = f"use one of {' '.join(OUTLINE_WRITERS)}"
        raise InputError(f"an outline cannot be written as {ending or 'a file without ending'}", hint=hint)
    refuse_existing(path, force)
    save_bytes(path, OUTLINE_WRITERS[ending](as_outline(outline)).encode(), force)


def _as_json(outline: Outline) -> str:
    content = {"version": OWN_VERSION, "loops": [loop.tolist() for loop in outline.loops]}
    return json.dumps(content | _cusps(outline)) + "\n"


def _cusps(outline: Outline) -> dict[str, dict[str, int]]:
    """Return the cusps as they stand in JSON, if there are any."""
    marks = {f"{mark.loop}:{mark.point}": mark.turns for mark in cusp_marks(outline.cusps)}
    return {"cusps": marks} if marks else {}


def _as_csv(outline: Outline) -> str:
    """Return a table, with columns ``loop`` and ``cusp`` where they say something."""
    loop = np.repeat(np.arange(outline.n_loops), [len(points) for points in outline.loops])
    more = {"loop": loop} if outline.n_loops > 1 else {}
    more |= {"cusp": np.concatenate(outline.cusps)} if outline.has_cusps else {}
    numbers = [[repr(value) for value in column.tolist()] for column in (*outline.points.T, *more.values())]
    return "\n".join([",".join(["x", "y", *more]), *map(",".join, zip(*numbers, strict=True))]) + "\n"


def _as_svg(outline: Outline) -> str:
    """Return a picture in which one path is the outline; its view box is for viewers."""
    marks = " ".join(map(written_cusp, cusp_marks(outline.cusps)))
    data = "".join(path_data(loop * (1, -1)) for loop in outline.loops)
    cusps = f' data-cusps="{marks}"' if marks else ""
    style = f'fill="{INK}" fill-opacity="0.1" stroke="{INK}" stroke-width="{line_width(outline.points)}"'
    picture = drawing_svg(outline.points, [f'<path d="{data}"{cusps}/>'], f'{style} stroke-linejoin="round"')
    return picture.replace("<svg ", f'<svg {SVG_MARK}="{OWN_VERSION}" ', 1)


# ---- geometries ------------------------------------------------------------------------------------------------------


def _as_geojson(outline: Outline) -> str:
    kind, coordinates = _geometry(outline)
    properties = _cusps(outline)
    geometry = {"type": kind, "coordinates": coordinates}
    return json.dumps({"type": "Feature", "properties": properties, "geometry": geometry}) + "\n"


def _as_wkt(outline: Outline) -> str:
    if outline.has_cusps:
        hint = "save it as .json, .geojson, .svg or .csv"
        raise InputError("WKT has no place for the cusps of the outline", hint=hint)
    kind, coordinates = _geometry(outline)
    return f"{kind.upper()} {_in_brackets(coordinates)}\n"


def _in_brackets(coordinates: Sequence[object]) -> str:
    """Return nested lists of positions as WKT has them.

    Examples
    --------
    >>> _in_brackets([[0.0, 0.5], [1.0, 2.0]])
    '(0.0 0.5, 1.0 2.0)'
    """
    return "(" + ", ".join(map(_item, coordinates)) + ")"


def _item(item: object) -> str:
    assert isinstance(item, list)
    return " ".join(map(repr, item)) if isinstance(item[0], float) else _in_brackets(item)


def _geometry(outline: Outline) -> tuple[str, list[object]]:
    """Return the type and the coordinates of a geometry that is read as the same outline."""
    rings: list[object] = [_ring(loop) for loop in outline.loops]
    polygons = _polygons(outline.loops)
    if polygons is None:
        return ("LineString", _ring(outline.loops[0])) if outline.n_loops == 1 else ("MultiLineString", rings)
    if len(polygons) == 1:
        return "Polygon", rings
    return "MultiPolygon", [[rings[loop] for loop in polygon] for polygon in polygons]


def _ring(points: Floats) -> list[object]:
    return [*points.tolist(), points[0].tolist()]


def _polygons(loops: Sequence[Floats]) -> list[list[int]] | None:
    """Return the loops of each polygon, the shell first; None if they are not polygons in this order."""
    import shapely

    ways = [sense(loop) for loop in loops]
    if (len(loops) > 1 and ways[0] <= 0) or 0 in ways:
        return None
    polygons: list[list[int]] = []
    for loop, way in enumerate(ways):
        if way > 0 or not polygons:
            polygons.append([])
        polygons[-1].append(loop)
    parts = [shapely.Polygon(loops[first], [loops[hole] for hole in holes]) for first, *holes in polygons]
    return polygons if shapely.MultiPolygon(parts).is_valid else None


OUTLINE_WRITERS: dict[str, Callable[[Outline], str]] = {
    ".json": _as_json,
    ".geojson": _as_geojson,
    ".wkt": _as_wkt,
    ".svg": _as_svg,
    ".csv": _as_csv,
}
