"""Points and strokes as JSON, and GeoJSON, which is JSON too."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from plyfold.errors import FileFormatError
from plyfold.io.vector import read_geojson
from plyfold.mistaken import mistaken_code
from plyfold.outline.curve import Curve

__all__ = ["read_json"]

_HINT = 'write [[x, y], ...] or {"strokes": [[[x, y], ...], ...]}'


def read_json(text: str) -> Curve:
    """Read a list of points, a list of strokes, or GeoJSON.

    Parameters
    ----------
    text : str
        ``[[x, y], ...]`` or ``{"points": [[x, y], ...]}``, whose closing edge is implied;
        ``[[[x, y], ...], ...]`` or ``{"strokes": [[[x, y], ...], ...]}``, joined as strokes; a document that the
        sketching page has saved; or GeoJSON. A third coordinate is left out.

    Returns
    -------
    Curve

    Raises
    ------
    FileFormatError
        If the text is not JSON or none of these; broken JSON is named by line.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> len(read_json('{"strokes": [[[0, 0], [4, 0]], [[0, 3], [4, 0]], [[0, 0], [0, 3]]]}'))
    3
    """
    value = _parsed(text)
    if isinstance(value, list):
        return _curve_of_strokes(value) if any(map(_is_stroke, value)) else _curve_of_points(value)
    if not isinstance(value, dict):
        raise _error("it is neither a list nor an object")
    if "type" in value:
        return read_geojson(value)
    if "plyfold" in value:
        return _curve_of_document(value)
    if "strokes" in value:
        return _curve_of_strokes(value["strokes"])
    if "points" in value:
        return _curve_of_points(value["points"])
    raise _error("it has neither points nor strokes")


def _parsed(text: str) -> Any:
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise FileFormatError(f"line {error.lineno}: broken JSON ({error.msg.lower()})", hint=_HINT) from error
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"broken JSON ({error})", hint=_HINT) from error


def _is_stroke(item: object) -> bool:
    return isinstance(item, list) and bool(item) and isinstance(item[0], list)


def _curve_of_points(points: object) -> Curve:
    if not isinstance(points, list) or not all(isinstance(point, list) for point in points):
        raise _code_error(points) or _error("the points are not a list of [x, y]")
    return Curve(points)


def _curve_of_strokes(strokes: object) -> Curve:
    if not isinstance(strokes, list) or not all(isinstance(stroke, list) for stroke in strokes):
        raise _error("the strokes are not a list of lists of points")
    return Curve.from_strokes(strokes)


def _curve_of_document(document: dict[str, Any]) -> Curve:
    """Return the loop of a document of the sketching page, which writes doubles, large ones without a point."""
    strokes = document.get("strokes")
    if not isinstance(strokes, list) or not all(isinstance(stroke, dict) for stroke in strokes):
        raise _error("it is a document of the sketching page without strokes")
    points = [np.array(stroke.get("points", []), dtype=np.float64) for stroke in strokes]
    return Curve(points[0]) if len(points) == 1 and strokes[0].get("closed") else Curve.from_strokes(points)


def _code_error(numbers: object) -> FileFormatError | None:
    """Return the error for a list of whole numbers that is the code of a curve."""
    if not isinstance(numbers, list) or not all(type(number) is int for number in numbers):
        return None
    mistake = mistaken_code(np.array(numbers))
    return mistake and FileFormatError(mistake.message, hint=mistake.hint)


def _error(reason: str) -> FileFormatError:
    return FileFormatError(reason, hint=_HINT)
