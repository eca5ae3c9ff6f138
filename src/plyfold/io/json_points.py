"""Points, loops and strokes as JSON, and GeoJSON, which is JSON too."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from plyfold.errors import FileFormatError
from plyfold.io.cusp_notation import cusps_of_loops
from plyfold.io.own_version import refuse_later_version
from plyfold.io.shapes import Line, Shape, outline_of_shapes, shape_of_strokes
from plyfold.io.vector import shapes_in_geojson
from plyfold.mistaken import mistaken_code

__all__ = ["parsed_json", "shapes_in_json", "shapes_of_value"]

_HINT = 'write [[x, y], ...], {"loops": [[[x, y], ...], ...]} or {"strokes": [[[x, y], ...], ...]}'


def shapes_in_json(text: str) -> list[Shape]:
    """Read a list of points, loops, strokes, or GeoJSON.

    Parameters
    ----------
    text : str
        ``{"version": 2, "loops": [[[x, y], ...], ...], "cusps": {"LOOP:POINT": INDEX}}``, all but the loops optional;
        ``[[x, y], ...]`` or ``{"points": [[x, y], ...]}``, whose closing edge is implied;
        ``[[[x, y], ...], ...]`` or ``{"strokes": [[[x, y], ...], ...]}``, joined as strokes, or loops, if each of them
        ends where it starts; a document that the sketching page has saved, whose closed strokes are loops; or GeoJSON.
        A third coordinate is left out.

    Returns
    -------
    list of Shape
        One; of GeoJSON as :func:`~plyfold.io.vector.shapes_in_geojson` says.

    Raises
    ------
    FileFormatError
        If the text is not JSON or none of these, or is of a later version; broken JSON is named by line.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> [shape] = shapes_in_json('{"loops": [[[0, 0], [4, 0], [0, 3]]], "cusps": {"0:2": 1}}')
    >>> shape.loops[0].cusps
    {2: 1}
    """
    return shapes_of_value(parsed_json(text))


def shapes_of_value(value: Any) -> list[Shape]:
    """Return the same of parsed JSON."""
    if isinstance(value, list):
        return [shape_of_strokes(_lines(value, "strokes")) if any(map(_is_line, value)) else _points(value)]
    if not isinstance(value, dict):
        raise _error("it is neither a list nor an object")
    if "type" in value:
        return shapes_in_geojson(value)
    if "plyfold" in value:
        return [_document(value)]
    if "strokes" in value:
        return [shape_of_strokes(_lines(value["strokes"], "strokes"))]
    if "points" in value:
        return [_points(value["points"], value.get("cusps"))]
    refuse_later_version(value.get("version"))
    if "loops" in value:
        return [_loops(_lines(value["loops"], "loops"), value.get("cusps"))]
    raise _error("it has neither loops nor points nor strokes")


def parsed_json(text: str | bytes) -> Any:
    """Return what a text says; broken JSON is an error that names the line."""
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise FileFormatError(f"line {error.lineno}: broken JSON ({error.msg.lower()})", hint=_HINT) from error
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"broken JSON ({error})", hint=_HINT) from error


def _is_line(item: object) -> bool:
    return isinstance(item, list) and bool(item) and isinstance(item[0], list)


def _lines(lines: object, what: str) -> list[list[Any]]:
    if not isinstance(lines, list) or not all(isinstance(line, list) for line in lines):
        raise _error(f"the {what} are not a list of lists of points")
    return lines


def _points(points: object, cusps: object = None) -> Shape:
    if not isinstance(points, list) or not all(isinstance(point, list) for point in points):
        raise _code_error(points) or _error("the points are not a list of [x, y]")
    shape = _loops([points], cusps)
    return shape._replace(loops=tuple(line._replace(is_line=True) for line in shape.loops))


def _loops(lines: Sequence[Any], cusps: object) -> Shape:
    if not lines:
        raise _error("it has no loop")
    marks = cusps_of_loops(cusps, [len(line) for line in lines])
    return Shape(tuple(Line(line, cusps=marked) for line, marked in zip(lines, marks, strict=True)))


def _document(document: dict[str, Any]) -> Shape:
    """Return what is drawn in a document of the sketching page: loops, and the loop that its open strokes make."""
    refuse_later_version(document["plyfold"])
    strokes = document.get("strokes")
    if not isinstance(strokes, list) or not all(isinstance(stroke, dict) for stroke in strokes):
        raise _error("it is a document of the sketching page without strokes")
    lines = [line for line in map(_stroke, strokes) if len(np.asarray(line.points))]
    loops, parts = [line for line in lines if line.closed], [line for line in lines if not line.closed]
    if not (loops and parts):
        return Shape(tuple(lines))
    joined = outline_of_shapes([Shape(tuple(parts))])
    return Shape((*loops, Line(joined.points)), repairs=joined.repairs)


def _stroke(stroke: dict[str, Any]) -> Line:
    """Return a stroke of the page, which writes doubles, large ones without a point."""
    try:
        points = np.array(stroke.get("points", []), dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        points = np.empty(())
    if points.size and points.ndim != 2:
        raise _error("a stroke of the document has points that are not [x, y]")
    (cusps,) = cusps_of_loops(stroke.get("cusps"), [len(points)])
    closed = bool(stroke.get("closed"))
    return Line(points, closed, cusps=cusps, is_line=not closed)


def _code_error(numbers: object) -> FileFormatError | None:
    """Return the error for a list of whole numbers that is the code of a curve."""
    if not isinstance(numbers, list) or not all(type(number) is int for number in numbers):
        return None
    mistake = mistaken_code(np.array(numbers))
    return mistake and FileFormatError(mistake.message, hint=mistake.hint)


def _error(reason: str) -> FileFormatError:
    return FileFormatError(reason, hint=_HINT)
