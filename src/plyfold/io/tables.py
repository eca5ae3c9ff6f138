"""Plain tables of points: text with two columns, and NumPy's own format."""

from __future__ import annotations

import io
import math
import re
import warnings
from collections.abc import Iterator

import numpy as np

from plyfold.curve import Curve
from plyfold.errors import FileFormatError

__all__ = ["read_npy", "read_table"]

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")

_Stroke = list[tuple[float, float]]


def read_table(text: str) -> Curve:
    r"""Read two columns of numbers; empty lines separate strokes.

    Parameters
    ----------
    text : str
        One point per line, x and y separated by comma, semicolon or blanks. ``#`` starts a comment. The first line may
        be a header.

    Returns
    -------
    Curve
        Of one block, the closing edge is implied; several blocks are joined as strokes.

    Raises
    ------
    FileFormatError
        If a line is not a point; it names the line.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> read_table("0 0\n4 0  # right\n0 3").points.tolist()
    [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]
    """
    strokes = list(_strokes(text))
    if not strokes:
        raise FileFormatError("it holds no points", hint="write one point per line: x, y")
    return Curve(strokes[0]) if len(strokes) == 1 else Curve.from_strokes(strokes)


def read_npy(data: bytes) -> Curve:
    """Read an (n, 2) array from the content of an NPY file; pickled objects are refused.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    Curve

    Raises
    ------
    FileFormatError
        If the content is no NPY file, or holds objects.
    CurveError
        If the array is no usable curve.

    Notes
    -----
    Linear in the size of the array.

    Examples
    --------
    >>> file = io.BytesIO()
    >>> np.save(file, [(0, 0), (4, 0), (0, 3)])
    >>> len(read_npy(file.getvalue()))
    3
    """
    try:
        with warnings.catch_warnings():  # of headers written by Python 2
            warnings.simplefilter("ignore")
            points = np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    except Exception as error:  # numpy lets through whatever a broken header runs into
        reason = str(error).split("\n")[0]
        raise FileFormatError(
            f"it is no plain NPY array ({reason})", hint="save an (n, 2) array with numpy.save"
        ) from error
    return Curve(points)


def _strokes(text: str) -> Iterator[_Stroke]:
    """Yield the blocks between empty lines; a line with only a comment is not an empty line."""
    stroke: _Stroke = []
    header_allowed = True
    for number, line in enumerate(re.split(r"\r\n|\r|\n", text), start=1):
        content = line.partition("#")[0].strip()
        if not line.strip() and stroke:
            yield stroke
            stroke = []
        if not content:
            continue
        fields = _SEPARATOR.split(content)
        if not (header_allowed and not any(map(_is_number, fields))):
            stroke.append(_point(fields, number))
        header_allowed = False
    if stroke:
        yield stroke


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return True


def _point(fields: list[str], line: int) -> tuple[float, float]:
    for field in fields:
        if not _is_number(field) or not math.isfinite(float(field)):
            hint = "write one point per line: x, y"
            raise FileFormatError(f"line {line}: {field[:40]!r} is not a finite number", hint=hint)
    if len(fields) != 2:
        hint = "write x, y with a point as the decimal sign"
        raise FileFormatError(f"line {line}: {len(fields)} numbers where x and y were expected", hint=hint)
    return float(fields[0]), float(fields[1])
