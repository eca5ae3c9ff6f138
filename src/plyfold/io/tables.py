"""Plain tables of points: text with two columns, and NumPy's own format."""

from __future__ import annotations

import io
import math
import re
import warnings
from collections.abc import Iterator

import numpy as np

from plyfold.errors import FileFormatError
from plyfold.mistaken import mistaken_code
from plyfold.outline.curve import Curve

__all__ = ["read_npy", "read_table"]

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")

_X_NAMES = ("x", "lon", "lng", "long", "longitude", "easting")
_Y_NAMES = ("y", "lat", "latitude", "northing")

_Stroke = list[tuple[float, ...]]


def read_table(text: str) -> Curve:
    r"""Read two columns of numbers; empty lines separate strokes.

    Parameters
    ----------
    text : str
        One point per line, x and y separated by comma, semicolon or blanks. ``#`` starts a comment. The first line may
        be a header. A third number is left out.

    Returns
    -------
    Curve
        Of one block, the closing edge is implied; several blocks are joined as strokes.

    Raises
    ------
    FileFormatError
        If a line is not a point, or has not as many numbers as the first; it names the line.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> read_table("0 0\n4 0  # right\n0 3").points.tolist()
    [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]
    """
    try:
        strokes = list(_strokes(text))
    except FileFormatError as error:
        if mistake := mistaken_code(text):
            raise FileFormatError(mistake.message, hint=mistake.hint) from error
        raise
    if not strokes:
        raise FileFormatError("it holds no points", hint="write one point per line: x, y")
    return Curve(strokes[0]) if len(strokes) == 1 else Curve.from_strokes(strokes)


def read_npy(data: bytes) -> Curve:
    """Read an (n, 2) or (n, 3) array from the content of an NPY file; pickled objects are refused.

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
    first_line, columns = 0, 0
    header_allowed = True
    for number, line in enumerate(re.split(r"\r\n|\r|\n", text), start=1):
        content = line.partition("#")[0].strip()
        if not line.strip() and stroke:
            yield stroke
            stroke = []
        if not content:
            continue
        fields = _SEPARATOR.split(content)
        if header_allowed and not any(map(_is_number, fields)):
            _refuse_other_columns(fields, number)
        else:
            stroke.append(_point(content, number))
            first_line, columns = first_line or number, columns or len(fields)
            _refuse_other_length(len(fields), number, columns, first_line)
        header_allowed = False
    if stroke:
        yield stroke


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return True


def _refuse_other_columns(names: list[str], line: int) -> None:
    """Refuse a header that names x and y, but not as the first two columns."""
    plain = [name.strip("\"'").lower() for name in names]
    x, y = ([place for place, name in enumerate(plain) if name in known] for known in (_X_NAMES, _Y_NAMES))
    if x and y and (0 not in x or 1 not in y):
        raise FileFormatError(
            f"line {line}: its columns are {', '.join(names)}", hint="put x and y first, in this order"
        )


def _refuse_other_length(length: int, line: int, columns: int, first_line: int) -> None:
    if length != columns:
        hint = "write one point per line: x, y"
        raise FileFormatError(f"line {line}: {length} numbers, where line {first_line} has {columns}", hint=hint)


def _point(content: str, line: int) -> tuple[float, ...]:
    """Return x and y, and a third number if there is one: the curve says that it leaves that out."""
    fields, separators = _SEPARATOR.split(content), _SEPARATOR.findall(content)
    for place, field in enumerate(fields):
        if not _is_number(field) or (place < 2 and not math.isfinite(float(field))):
            hint = "write one point per line: x, y"
            raise FileFormatError(f"line {line}: {field[:40]!r} is not a finite number", hint=hint)
    hint = "write x, y with a point as the decimal sign"
    if len(fields) not in (2, 3):
        raise FileFormatError(f"line {line}: {len(fields)} numbers where x and y were expected", hint=hint)
    # Three numbers may be two with decimal commas: 1;2,5 or 1, 2,5.
    if len({(separator.strip(), separator.strip() == separator) for separator in separators}) > 1:
        raise FileFormatError(f"line {line}: its numbers are separated in different ways", hint=hint)
    return tuple(map(float, fields))
