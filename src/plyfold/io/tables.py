"""Plain tables of points: text with two columns, and NumPy's own format."""

from __future__ import annotations

import io
import math
import re
import warnings
from itertools import groupby
from typing import NamedTuple

import numpy as np

from plyfold.errors import FileFormatError
from plyfold.io.shapes import Line, Shape, shape_of_strokes
from plyfold.mistaken import mistaken_code

__all__ = ["shapes_in_npy", "shapes_in_table"]

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")

_X_NAMES = ("x", "lon", "lng", "long", "longitude", "easting")
_Y_NAMES = ("y", "lat", "latitude", "northing")
_MORE_NAMES = (("loop", "loops"), ("cusp", "cusps"))


class _Row(NamedTuple):
    """A point of a table: its coordinates, which loop it belongs to, its index as a cusp, and the line it stands on."""

    place: tuple[float, ...]
    loop: str
    cusp: int
    line: int


class _Columns(NamedTuple):
    """Which columns of a table hold the loop and the cusp of each point, counted from 0; the first two are x and y."""

    loop: int | None = None
    cusp: int | None = None


def shapes_in_table(text: str) -> list[Shape]:
    r"""Read two columns of numbers, and perhaps columns named ``loop`` and ``cusp``.

    Parameters
    ----------
    text : str
        One point per line, x and y separated by comma, semicolon or blanks. ``#`` starts a comment. The first line may
        be a header. A column ``loop`` tells to which loop a point belongs, whose points stand together; a column
        ``cusp`` has its index, mostly 0. Otherwise a third number is left out.

    Returns
    -------
    list of Shape
        One. Of one block, or of loops by name, closing edges are implied. Several blocks between empty lines are loops
        if each of them ends where it starts, and otherwise strokes.

    Raises
    ------
    FileFormatError
        If a line is not a point, or has not as many numbers as the first; it names the line.

    Notes
    -----
    Linear in the length of the text.

    Examples
    --------
    >>> shapes_in_table("0 0\n4 0  # right\n0 3")[0].loops[0].points
    [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)]
    >>> len(shapes_in_table("x,y,loop\n0,0,a\n4,0,a\n0,3,a\n5,5,b\n6,5,b\n5,6,b\n")[0].loops)
    2
    """
    try:
        columns, blocks = _blocks(text)
    except FileFormatError as error:
        if mistake := mistaken_code(text):
            raise FileFormatError(mistake.message, hint=mistake.hint) from error
        raise
    if not blocks:
        raise FileFormatError("it holds no points", hint="write one point per line: x, y")
    if columns.loop is not None:
        blocks = _blocks_by_loop([row for block in blocks for row in block])
    elif len(blocks) > 1:
        return [_shape_of_blocks(blocks)]
    is_line = columns.loop is None
    return [Shape(tuple(_loop(block)._replace(is_line=is_line) for block in blocks))]


def _shape_of_blocks(blocks: list[list[_Row]]) -> Shape:
    shape = shape_of_strokes([row.place for row in block] for block in blocks)
    lines = zip(shape.loops, blocks, strict=True)
    return Shape(tuple(line._replace(cusps=_loop(block).cusps) for line, block in lines))


def _loop(rows: list[_Row]) -> Line:
    cusps = {number: row.cusp for number, row in enumerate(rows) if row.cusp}
    return Line([row.place for row in rows], cusps=cusps)


def _blocks_by_loop(rows: list[_Row]) -> list[list[_Row]]:
    """Return the rows of each loop; refuse one that goes on after another, for its order would be a guess."""
    blocks: dict[str, list[_Row]] = {}
    for name, block in groupby(rows, key=lambda row: row.loop):
        points = list(block)
        if name in blocks:
            line = points[0].line
            raise FileFormatError(
                f"line {line}: loop {name[:40]!r} goes on after another one", hint="write its points together, in order"
            )
        blocks[name] = points
    return list(blocks.values())


def shapes_in_npy(data: bytes) -> list[Shape]:
    """Read an (n, 2) or (n, 3) array, or a stack of such, from the content of an NPY file; pickled objects are refused.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    list of Shape
        One.

    Raises
    ------
    FileFormatError
        If the content is no NPY file, or holds objects.

    Notes
    -----
    Linear in the size of the array.

    Examples
    --------
    >>> file = io.BytesIO()
    >>> np.save(file, [(0, 0), (4, 0), (0, 3)])
    >>> len(shapes_in_npy(file.getvalue())[0].loops)
    1
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
    lines = points if points.ndim == 3 and len(points) else [points]
    return [Shape(tuple(Line(line, is_line=True) for line in lines))]


def _blocks(text: str) -> tuple[_Columns, list[list[_Row]]]:
    """Return the blocks between empty lines; a line with only a comment is not an empty line."""
    blocks: list[list[_Row]] = [[]]
    known, first_line, count = _Columns(), 0, 0
    header_allowed = True
    for number, line in enumerate(re.split(r"\r\n|\r|\n", text), start=1):
        content = line.partition("#")[0].strip()
        if not line.strip() and blocks[-1]:
            blocks.append([])
        if not content:
            continue
        fields = _SEPARATOR.split(content)
        if header_allowed and not any(map(_is_number, fields)):
            known = _named_columns(fields, number)
            first_line, count = (number, len(fields)) if any(known) else (0, 0)
        else:
            first_line, count = first_line or number, count or len(fields)
            _refuse_other_length(len(fields), number, count, first_line)
            blocks[-1].append(_row(content, fields, known, number))
        header_allowed = False
    return known, [block for block in blocks if block]


def _named_columns(names: list[str], line: int) -> _Columns:
    """Return the columns that a header names; refuse one that names x and y, but not as the first two."""
    plain = [name.strip("\"'").lower() for name in names]
    x, y = ([place for place, name in enumerate(plain) if name in known] for known in (_X_NAMES, _Y_NAMES))
    if x and y and (0 not in x or 1 not in y):
        raise FileFormatError(
            f"line {line}: its columns are {', '.join(names)}", hint="put x and y first, in this order"
        )
    loop, cusp = (next((place for place, name in enumerate(plain) if name in known), None) for known in _MORE_NAMES)
    return _Columns(loop, cusp)


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return True


def _refuse_other_length(length: int, line: int, columns: int, first_line: int) -> None:
    if length != columns:
        hint = "write one point per line: x, y"
        raise FileFormatError(f"line {line}: {length} numbers, where line {first_line} has {columns}", hint=hint)


def _row(content: str, fields: list[str], known: _Columns, line: int) -> _Row:
    named = [column for column in known if column is not None]
    if not named:
        return _Row(_point(content, fields, line), "", 0, line)
    plain = [field for column, field in enumerate(fields) if column not in named]
    loop = "" if known.loop is None else fields[known.loop]
    cusp = 0 if known.cusp is None else _index(fields[known.cusp], line)
    return _Row(_point(",".join(plain), plain, line), loop, cusp, line)


def _index(field: str, line: int) -> int:
    if not field.isdecimal():
        hint = "write 0 where there is no cusp, and otherwise by how many full turns the angle is larger"
        raise FileFormatError(f"line {line}: {field[:40]!r} is no index of a cusp", hint=hint)
    return int(field)


def _point(content: str, fields: list[str], line: int) -> tuple[float, ...]:
    """Return x and y, and a third number if there is one: the curve says that it leaves that out."""
    for place, field in enumerate(fields):
        if not _is_number(field) or (place < 2 and not math.isfinite(float(field))):
            hint = "write one point per line: x, y"
            raise FileFormatError(f"line {line}: {field[:40]!r} is not a finite number", hint=hint)
    hint = "write x, y with a point as the decimal sign"
    if len(fields) not in (2, 3):
        raise FileFormatError(f"line {line}: {len(fields)} numbers where x and y were expected", hint=hint)
    # Three numbers may be two with decimal commas: 1;2,5 or 1, 2,5.
    separators = _SEPARATOR.findall(content) if len(fields) > 2 else []
    if len({(separator.strip(), separator.strip() == separator) for separator in separators}) > 1:
        raise FileFormatError(f"line {line}: its numbers are separated in different ways", hint=hint)
    return tuple(map(float, fields))
