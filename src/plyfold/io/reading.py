"""Outlines from a file or from standard input, whatever the format."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

from plyfold.errors import FileFormatError, InputError
from plyfold.io.flat_meshes import components_of_mesh, mesh_in_obj, mesh_in_ply, outline_of_meshes
from plyfold.io.gpx import shapes_in_gpx
from plyfold.io.json_points import shapes_in_json
from plyfold.io.shapes import Shape, outline_of_shapes
from plyfold.io.tables import shapes_in_npy, shapes_in_table
from plyfold.io.vector import shapes_in_wkt
from plyfold.io.widths import Wide, Width, outline_and_ribbon, wide_lines
from plyfold.outline.curve import Outline
from plyfold.outline.ribbons.ribbon import CapStyle, JoinStyle, Ribbon

__all__ = ["SIZE_LIMIT", "Contents", "naming_the_file", "read", "read_contents", "read_each"]

SIZE_LIMIT = 256 * 2**20
"""Largest file that is read, in bytes: 256 MiB."""

_FORMAT_OF_SUFFIX = {
    ".svg": "SVG",
    ".npy": "NPY",
    ".json": "JSON",
    ".geojson": "JSON",
    ".wkt": "WKT",
    ".gpx": "GPX",
    ".csv": "table",
    ".obj": "OBJ",
    ".ply": "PLY",
}
_FORMATS = "SVG, CSV or TXT, NPY, JSON, GeoJSON, WKT, GPX, and flat meshes as OBJ and PLY are read"
_STARTS = {
    "NPY": re.compile(rb"\x93NUMPY"),
    "PLY": re.compile(rb"ply[ \t]*\r?\n"),
    "GPX": re.compile(rb"(<\?[^>]*>|<!--.*?-->|\s)*<gpx\b", re.DOTALL),
    "SVG": re.compile(rb"<"),
    "JSON": re.compile(rb"[{\[]"),
    "WKT": re.compile(rb"(SRID=\d+;\s*)?(POINT|LINE|POLYGON|MULTI|GEOMETRY|CIRCULAR|COMPOUND|CURVE)", re.IGNORECASE),
    "OBJ": re.compile(rb"(?:\s*(?:#|o |g |s |mtllib )[^\n]*\n)*\s*v[ \t]+[-+.\d]"),
}
_OTHER_STARTS = (b"\x1f\x8b", b"\x89PNG", b"\xff\xd8", b"%PDF", b"PK\x03\x04")


@dataclass(frozen=True, eq=False)
class Contents:
    """What a file holds: shapes, each an outline of its own, or some of them one outline together.

    Parameters
    ----------
    file : str
        What it is called in errors.
    shapes : sequence
        Whatever the reader of the format made of them; all have a ``name``, which may be empty.
    outline_of : callable
        Makes one outline of some of the shapes.
    ribbon_of : callable, optional
        Makes one outline of some of them and one ribbon, where lines are to have a width; the ribbon is None if some of
        it is none, or has no heights.
    """

    file: str
    shapes: Sequence[Any]
    outline_of: Callable[[Sequence[Any]], Outline]
    ribbon_of: Callable[[Sequence[Any]], tuple[Outline, Ribbon | None]] | None = None

    def __len__(self) -> int:
        return len(self.shapes)

    def outline(self, index: int | None = None) -> Outline:
        """Return one of the shapes as an outline, counted from 0, or all of them as one."""
        return self.outline_and_ribbon(index)[0]

    def outline_and_ribbon(self, index: int | None = None) -> tuple[Outline, Ribbon | None]:
        """Return the same, and as a ribbon with heights, if it is one."""
        with naming_the_file(self.file):
            shapes = self.shapes if index is None else [self.shapes[self._checked(index)]]
            return (self.outline_of(shapes), None) if self.ribbon_of is None else self.ribbon_of(shapes)

    def name(self, index: int) -> str:
        """Return what a shape is called in the file; empty if it has no name."""
        return getattr(self.shapes[index], "name", "")

    def _checked(self, index: int) -> int:
        if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(self):
            last = f"0 to {len(self) - 1}" if len(self) > 1 else "0 alone"
            raise FileFormatError(f"there is no shape {index} in it", hint=f"they are counted from 0: there is {last}")
        return index


def read(  # noqa: PLR0913 - each option is keyword-only and independent
    path: str | Path,
    *,
    id: str | None = None,
    index: int | None = None,
    tolerance: float | None = None,
    uv: bool = False,
    width: Width | None = None,
    join_style: JoinStyle | None = None,
    cap_style: CapStyle | None = None,
) -> Outline:
    r"""Read an outline from a file: all that it holds as one, or one of its shapes.

    Parameters
    ----------
    path : str or Path
        An SVG, CSV, TXT, NPY, JSON, GeoJSON, WKT, GPX, OBJ or PLY file, at most ``SIZE_LIMIT`` bytes; ``"-"`` reads
        standard input. Suffixes that say nothing, such as ``.txt``, and standard input are told apart by content.
    id : str, optional
        The element of an SVG to read, a shape or a group, or the ``id`` of a feature in GeoJSON; by default all.
    index : int, optional
        Which shape to read, counted from 0 in the order of the file; by default all.
    tolerance : float, optional
        The farthest that a Bézier curve or an arc of an SVG may be from the polyline that stands for it, in the units
        of the result; by default 1/2000 of the diagonal of the bounding box. Other formats have no curved parts.
    uv : bool, optional
        Of an OBJ or PLY, take the texture coordinates as the flat mesh, instead of x and y.
    width : float or "auto", optional
        Make ribbons of this width out of all lines, as :func:`~plyfold.ribbon` does: in the units of the result, which
        are metres for GPX. ``"auto"`` takes the widths of strokes in an SVG. By default, lines are as below.
    join_style : {"round", "mitre", "bevel"}, optional
    cap_style : {"flat", "round", "square"}, optional
        How they look; by default as the file says, else round and flat.

    Returns
    -------
    Outline
        A :class:`Curve`, where there is one loop. In the file's own coordinates, except that an SVG is turned to y up,
        so that it looks the same. Whatever was left out or changed is in its ``repairs``.

    Raises
    ------
    InputError
        If what is given is not the path of a file.
    FileFormatError
        If the file is missing, empty, broken, too large, of an unknown format or a later version, or holds no curve.
    StrokeError
        If open pieces leave a gap too wide to be meant.
    CurveError
        If the points are no usable curve, or the triangles no flat mesh.

    Notes
    -----
    A list of points (CSV, TXT, NPY, JSON) and a polygon are closed by an edge from the last point to the first. Open
    lines (an open path or polyline, a LINESTRING, several blocks or strokes) are pen strokes instead: they are joined
    by their nearest ends, gaps are recorded in ``repairs``, and a gap above a tenth of the diagonal of the bounding box
    is an error. Lines that all end where they start are loops. Beside loops, open lines are left out, and so are loops
    whose points lie on one line; ``repairs`` says so.

    With a width, each line is a ribbon by itself, a ring if it ends where it starts: open paths, and closed ones that
    are stroked and not filled, in SVG; LineStrings; lists of points without names of loops; tracks and routes. All else
    is as it is without.

    * SVG: path, polygon, polyline, line, rect, circle, ellipse, with transforms, groups, ``use`` and viewBox. Subpaths
      are loops, which run as in the file; but where ``fill-rule`` is ``evenodd``, loops of a shape that meet no other
      one are turned so that the painted side is on their left, or on their right if the other shapes run clockwise.
      ``data-cusps="0:12 1:3x2"`` names cusps by subpath, node and index.
    * CSV, TXT: two columns separated by comma, semicolon or blanks; an optional header line; ``#`` starts a comment; an
      empty line ends a block. Columns named ``loop`` and ``cusp`` tell the loop of a point and its index as a cusp.
    * NPY: an (n, 2) array of numbers, or a stack of them.
    * JSON: ``{"version": 2, "loops": [[[x, y], ...], ...], "cusps": {"LOOP:POINT": INDEX}}``; ``[[x, y], ...]``,
      ``{"points": [[x, y], ...]}``, a list of such lists as strokes, or ``{"strokes": [[[x, y], ...], ...]}``.
    * WKT, GeoJSON: LineString, MultiLineString, Polygon, MultiPolygon, and collections of them. Shells run
      counter-clockwise and holes clockwise, whatever the file says, but a polygon without holes that is alone runs as
      it stands. A property ``cusps`` is as in JSON.
    * GPX: each segment of a track and each route is a line, in metres east and north of the middle of all points.
    * OBJ, PLY: the boundary of a flat mesh, with its cusps, see :meth:`Outline.from_mesh`.

    A third coordinate, in any of them, is left out, and ``repairs`` says so; but not that of a line with a width, for
    which ``plyfold lift`` has use.

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
    wide = wide_lines(width, join_style, cap_style)
    return read_contents(path, id=id, tolerance=tolerance, uv=uv, wide=wide).outline(index)


def read_each(  # noqa: PLR0913 - each option is keyword-only and independent
    path: str | Path,
    *,
    id: str | None = None,
    tolerance: float | None = None,
    uv: bool = False,
    width: Width | None = None,
    join_style: JoinStyle | None = None,
    cap_style: CapStyle | None = None,
) -> list[Outline]:
    r"""Read every shape of a file as an outline of its own: elements of an SVG, features, or parts of a mesh.

    Parameters
    ----------
    path : str or Path
    id : str, optional
    tolerance : float, optional
    uv : bool, optional
    width : float or "auto", optional
    join_style : {"round", "mitre", "bevel"}, optional
    cap_style : {"flat", "round", "square"}, optional
        All as for :func:`read`.

    Returns
    -------
    list of Outline

    Raises
    ------
    InputError
        As :func:`read`, for the first shape that is no outline.

    Notes
    -----
    Linear in the size of the file.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "two.wkt"
    ...     _ = file.write_text("POLYGON ((0 0, 4 0, 0 3, 0 0))\nPOLYGON ((9 0, 9 1, 8 1, 9 0))")
    ...     read_each(file)
    [<Curve of 3 points>, <Curve of 3 points>]
    """
    wide = wide_lines(width, join_style, cap_style)
    contents = read_contents(path, id=id, tolerance=tolerance, uv=uv, wide=wide)
    return [contents.outline(index) for index in range(len(contents))]


def read_contents(
    path: str | Path,
    *,
    id: str | None = None,
    tolerance: float | None = None,
    uv: bool = False,
    wide: Wide | None = None,
) -> Contents:
    """Return what a file holds, before it is made one outline; see :func:`read`."""
    if not isinstance(path, str | os.PathLike):
        hint = "points go to pf.Curve; a curve or a geometry can be given as it is wherever a curve can"
        raise InputError(f"a {type(path).__name__} is not the path of a file", hint=hint)
    name = "standard input" if str(path) == "-" else Path(path).name or repr(str(path))
    with naming_the_file(name):
        shapes, flat = _decoded(_content(path), _format_of_path(path), id, tolerance, uv)
        if flat is None and wide is not None:
            raise FileFormatError("it is a mesh, and its outline has no lines", hint="leave out the width")
        if flat is None:
            return Contents(name, shapes, outline_of_meshes)
        ribbon_of = None if wide is None else lambda chosen: outline_and_ribbon(flat(chosen), wide)
        return Contents(name, shapes, lambda chosen: outline_of_shapes(flat(chosen)), ribbon_of)


@contextmanager
def naming_the_file(name: str) -> Iterator[None]:
    """Say in an error which file it is about."""
    try:
        yield
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


_Flatten: TypeAlias = Callable[[Sequence[Any]], Sequence[Shape]]


def _decoded(
    data: bytes, kind: str | None, id: str | None, tolerance: float | None, uv: bool
) -> tuple[Sequence[Any], _Flatten | None]:
    """Return what is in a file, and what makes shapes of some of it; None for parts of a mesh."""
    if not data.strip():
        raise FileFormatError("it is empty", hint=_FORMATS)
    kind = kind or _sniffed(data)
    if kind == "SVG":
        from plyfold.io.svg import flattened_shapes, shapes_in_svg  # its library takes a while to load

        return shapes_in_svg(data, id), partial(flattened_shapes, tolerance=tolerance)
    if kind in ("OBJ", "PLY"):
        if id is not None:
            raise FileFormatError("parts of a mesh have no id", hint="choose one by its index, counted from 0")
        mesh = mesh_in_obj(_text(data), uv) if kind == "OBJ" else mesh_in_ply(data, uv)
        return components_of_mesh(mesh), None
    if uv:
        raise FileFormatError("only a mesh has texture coordinates", hint="leave out uv")
    binary = _BINARY_READERS.get(kind)
    shapes = binary(data) if binary else _READERS[kind](_text(data))
    return _named(shapes, id), list


_BINARY_READERS: dict[str, Callable[[bytes], list[Shape]]] = {"NPY": shapes_in_npy, "GPX": shapes_in_gpx}
_READERS: dict[str, Callable[[str], list[Shape]]] = {
    "JSON": shapes_in_json,
    "WKT": shapes_in_wkt,
    "table": shapes_in_table,
}


def _named(shapes: list[Shape], id: str | None) -> list[Shape]:
    found = shapes if id is None else [shape for shape in shapes if shape.name == id]
    if not found:
        names = ", ".join(shape.name for shape in shapes[:20] if shape.name)
        hint = f"it has {names}" if names else "leave the id out: only elements of an SVG, features and tracks have one"
        raise FileFormatError(f"nothing in it has the id {id!r}", hint=hint)
    return found


def _sniffed(data: bytes) -> str:
    start = data[:1000].removeprefix(b"\xef\xbb\xbf").lstrip()
    known = next((kind for kind, pattern in _STARTS.items() if pattern.match(start)), None)
    if known is None and (b"\0" in start or start.startswith(_OTHER_STARTS)):
        raise FileFormatError("its format is not known", hint=_FORMATS)
    return known or "table"


def _text(data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        hint = f"save it as UTF-8; {_FORMATS}"
        raise FileFormatError(f"it is not text in UTF-8: byte {error.start} is not", hint=hint) from error
