"""A curve from a file or from standard input, whatever the format."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from plyfold.errors import FileFormatError, InputError
from plyfold.io.json_points import read_json
from plyfold.io.tables import read_npy, read_table
from plyfold.io.vector import read_wkt
from plyfold.outline.curve import Curve

__all__ = ["SIZE_LIMIT", "read"]

SIZE_LIMIT = 256 * 2**20
"""Largest file that is read, in bytes: 256 MiB."""

_FORMAT_OF_SUFFIX = {".svg": "SVG", ".npy": "NPY", ".json": "JSON", ".geojson": "JSON", ".wkt": "WKT", ".csv": "table"}
_FORMATS = "SVG, CSV or TXT, NPY, JSON, GeoJSON and WKT are read"
_WKT_START = re.compile(rb"(SRID=\d+;\s*)?(POINT|LINE|POLYGON|MULTI|GEOMETRY|CIRCULAR|COMPOUND|CURVE)", re.IGNORECASE)


def read(path: str | Path, *, id: str | None = None, tolerance: float | None = None) -> Curve:
    r"""Read a closed curve from a file.

    Parameters
    ----------
    path : str or Path
        An SVG, CSV, TXT, NPY, JSON, GeoJSON or WKT file, at most ``SIZE_LIMIT`` bytes; ``"-"`` reads standard input.
        Suffixes that say nothing, such as ``.txt``, and standard input are told apart by their content.
    id : str, optional
        The element of an SVG to read; needed if the SVG holds several closed shapes.
    tolerance : float, optional
        The farthest that a Bézier curve or an arc of an SVG may be from the polyline that stands for it, in the units
        of the result; by default 1/2000 of the diagonal of the bounding box. Other formats have no curved parts.

    Returns
    -------
    Curve
        In the file's own coordinates, except that an SVG is turned to y up, so that the curve looks the same.

    Raises
    ------
    InputError
        If what is given is not the path of a file.
    FileFormatError
        If the file is missing, empty, broken, too large, of an unknown format, or holds no curve or several.
    StrokeError
        If open pieces leave a gap too wide to be meant.
    CurveError
        If the points are no usable curve.

    Notes
    -----
    A list of points (CSV, TXT, NPY, JSON) and a polygon are closed by an edge from the last point to the first. Open
    lines (an open path or polyline, a LINESTRING, several blocks or strokes) are pen strokes instead: they are joined
    by their nearest ends, gaps are recorded in ``Curve.repairs``, and a gap above a tenth of the diagonal of the
    bounding box is an error.

    * SVG: path, polygon, polyline, line, rect, circle, ellipse, with transforms, groups, ``use`` and viewBox.
    * CSV, TXT: two columns separated by comma, semicolon or blanks; an optional header line; ``#`` starts a comment; an
      empty line ends a stroke.
    * NPY: an (n, 2) array of numbers.
    * JSON: ``[[x, y], ...]``, ``{"points": [[x, y], ...]}``, a list of such lists as strokes, or
      ``{"strokes": [[[x, y], ...], ...]}``.
    * WKT, GeoJSON: LineString, MultiLineString (strokes), Polygon without holes, also as the one feature of a
      collection.

    A third coordinate, in any of them, is left out, and ``Curve.repairs`` says so.

    Linear in the size of the file.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "loop.csv"
    ...     _ = file.write_text("x,y\n0,0\n4,0\n0,3\n")
    ...     read(file).points.tolist()
    [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]
    """
    if not isinstance(path, str | os.PathLike):
        hint = "points go to pf.Curve; a curve or a geometry can be given as it is wherever a curve can"
        raise InputError(f"a {type(path).__name__} is not the path of a file", hint=hint)
    name = "standard input" if str(path) == "-" else Path(path).name or repr(str(path))
    try:
        return _decoded(_content(path), _format_of_path(path), id, tolerance)
    except InputError as error:
        raise type(error)(f"{name}: {error.message}", error.where, error.hint) from error


def _content(path: str | Path) -> bytes:
    if str(path) == "-":
        if sys.stdin is None:
            raise FileFormatError("it is closed", hint="pipe a drawing into it")
        return _limited(sys.stdin.buffer)
    try:
        if Path(path).stat().st_size > SIZE_LIMIT:
            raise _too_large()
        with Path(path).open("rb") as file:
            return _limited(file)
    except FileFormatError:
        raise
    except (OSError, ValueError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise FileFormatError(f"it cannot be read ({reason})", hint=_path_hint(str(path))) from error


def _path_hint(path: str) -> str:
    name = path.removeprefix("gallery:")
    return "check the path" if name == path else f"pf.gallery.named_curve({name!r}) has that curve"


def _limited(file: BinaryIO) -> bytes:
    data = file.read(SIZE_LIMIT + 1)
    if len(data) > SIZE_LIMIT:
        raise _too_large()
    return data


def _too_large() -> FileFormatError:
    return FileFormatError(f"it is larger than {SIZE_LIMIT // 2**20} MiB", hint="thin out the points")


def _format_of_path(path: str | Path) -> str | None:
    return _FORMAT_OF_SUFFIX.get(Path(path).suffix.lower())


def _decoded(data: bytes, kind: str | None, id: str | None, tolerance: float | None) -> Curve:
    if not data.strip():
        raise FileFormatError("it is empty", hint=_FORMATS)
    kind = kind or _sniffed(data)
    if kind == "SVG":
        from plyfold.io.svg import read_svg  # its library takes a while to load

        return read_svg(data, id, tolerance)
    if id is not None:
        raise FileFormatError("only an element of an SVG can be chosen by id", hint="leave the id out")
    if kind == "NPY":
        return read_npy(data)
    readers: dict[str, Callable[[str], Curve]] = {"JSON": read_json, "WKT": read_wkt, "table": read_table}
    return readers[kind](_text(data))


def _sniffed(data: bytes) -> str:
    start = data[:1000].removeprefix(b"\xef\xbb\xbf").lstrip()
    if start.startswith(b"\x93NUMPY"):
        return "NPY"
    if start.startswith(b"<"):
        return "SVG"
    if start.startswith((b"{", b"[")):
        return "JSON"
    if _WKT_START.match(start):
        return "WKT"
    if b"\0" in start or start.startswith((b"\x1f\x8b", b"\x89PNG", b"\xff\xd8", b"%PDF", b"PK\x03\x04")):
        raise FileFormatError("its format is not known", hint=_FORMATS)
    return "table"


def _text(data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        hint = f"save it as UTF-8; {_FORMATS}"
        raise FileFormatError(f"it is not text in UTF-8: byte {error.start} is not", hint=hint) from error
