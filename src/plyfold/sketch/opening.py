"""From files to documents: saved ones as they were, drawings as loops, pictures to draw after."""

from __future__ import annotations

import base64
import re
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import unquote

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.errors import FileFormatError, InputError, StrokeError
from plyfold.gallery import CURVES, OUTLINES, named_curve
from plyfold.io.masks import PNG_START
from plyfold.io.reading import Contents, read_contents
from plyfold.outline.curve import Outline, Repair
from plyfold.sketch.pictures import png_document, svg_document
from plyfold.sketch.schema import (
    DOCUMENT_VERSION,
    MOST_BYTES,
    MOST_POINTS,
    VERSION,
    Backdrop,
    Document,
    Stroke,
    document_data,
    parse,
    read_document,
)

__all__ = ["gallery", "open_file", "opened", "start"]

_PICTURES = ((PNG_START, "png"), (b"\xff\xd8\xff", "jpeg"), (b"GIF8", "gif"), (b"RIFF", "webp"))
_LARGEST_PICTURE = 8 * 2**20
_STRANGE = re.compile(r"[^\w .()+-]")
_LONGEST_NAME = 100
_MOST_SHAPES = 200


def open_file(name: str, content: bytes) -> Document:
    r"""Return the document that a file holds, or one made of the drawing or the picture in it.

    Parameters
    ----------
    name : str
        The file's name; its ending tells formats apart that look alike.
    content : bytes

    Returns
    -------
    Document
        Of a drawing with several shapes, all of them.

    Raises
    ------
    InputError
        If the file is broken, too large, or of a kind that is not read.

    Examples
    --------
    >>> open_file("loop.csv", b"x,y\n0,0\n4,0\n0,3\n").strokes
    (Stroke(points=((0.0, 0.0), (4.0, 0.0), (0.0, 3.0)), closed=True, cusps=()),)
    """
    return _shapes(name, content)[0].document


def opened(content: bytes, headers: Mapping[str, str]) -> dict[str, Any]:
    """Return the answer to the question what a file holds."""
    name = unquote(headers.get("X-File-Name", "")) or "drawing"
    whole, *shapes = _shapes(name, content)
    whole = whole._replace(name=Path(name).stem[:_LONGEST_NAME])
    return {"version": VERSION, **_opened_data(whole, shapes)}


class _Shape(NamedTuple):
    """What a file holds, or a part of it."""

    name: str
    document: Document
    repairs: tuple[Repair, ...] = ()


def _opened_data(whole: _Shape, shapes: Sequence[_Shape]) -> dict[str, Any]:
    return {**_shape_data(whole), "shapes": list(map(_shape_data, shapes))}


def _shape_data(shape: _Shape) -> dict[str, Any]:
    repairs = [{"kind": r.kind, "where": list(r.where), "size": r.size} for r in shape.repairs]
    return {"name": shape.name, "document": document_data(shape.document), "repairs": repairs}


def _shapes(name: str, content: bytes) -> list[_Shape]:
    """Return the whole that a file holds, and then its shapes, if it is a drawing with several."""
    if len(content) > MOST_BYTES:
        raise FileFormatError(f"{name} is larger than {MOST_BYTES // 2**20} MiB", hint="thin out the points")
    carried = _carried(content)
    if carried is not None:
        return [_Shape("", read_document(carried))]
    kind = next((kind for start, kind in _PICTURES if content.startswith(start)), None)
    return [_Shape("", _tracing(content, kind))] if kind else _drawn(name, content)


def gallery() -> dict[str, Any]:
    """Return the named curves and outlines, ready for JSON."""
    curves = [
        {
            "name": curve.name,
            "title": curve.title,
            "crossings": str(curve.crossings),
            "turning_number": curve.turning_number,
            "immersions": str(curve.immersions),
            "embeddable": str(curve.embeddable),
            "document": document_data(_document_of(curve.outline)),
        }
        for curve in (*CURVES.values(), *OUTLINES.values())
    ]
    return {"version": VERSION, "curves": curves}


def start(file: str | None) -> dict[str, Any]:
    """Return what the page begins with.

    Parameters
    ----------
    file : str or None
        A path, ``"-"`` for standard input, ``"gallery:NAME"``, or None for an empty page.

    Raises
    ------
    InputError
        If the file cannot be opened.
    """
    limits = {"bytes": MOST_BYTES, "points": MOST_POINTS}
    if file is None:
        return {"version": VERSION, "document": None, "name": None, "limits": limits}
    whole, *shapes = _started_with(file)
    return {"version": VERSION, "limits": limits, **_opened_data(whole._replace(name=_title(file)), shapes)}


def _started_with(file: str) -> list[_Shape]:
    if file.startswith("gallery:"):
        return [_shape_of("", named_curve(file.removeprefix("gallery:")).outline)]
    if file == "-":
        return _shapes("standard input", sys.stdin.buffer.read(MOST_BYTES + 1))
    try:
        with Path(file).open("rb") as opened_file:
            return _shapes(Path(file).name, opened_file.read(MOST_BYTES + 1))
    except OSError as error:
        raise FileFormatError(f"{file} cannot be read ({error.strerror})", hint="check the path") from error


def _title(file: str) -> str:
    return "drawing" if file == "-" else Path(file.removeprefix("gallery:")).stem


def _carried(content: bytes) -> Any:
    """Return the data of the document that a file carries, if it was saved by the page."""
    if content.startswith(PNG_START):
        return png_document(content)
    beginning = content[:1000].removeprefix(b"\xef\xbb\xbf").lstrip()
    if beginning.startswith(b"<"):
        return svg_document(content)
    if beginning.startswith(b"{"):
        data = parse(content.removeprefix(b"\xef\xbb\xbf"))
        return data if "plyfold" in data else None
    return None


def _tracing(content: bytes, kind: str) -> Document:
    if len(content) > _LARGEST_PICTURE:
        raise InputError(f"the picture is larger than {_LARGEST_PICTURE // 2**20} MiB", hint="make it smaller")
    return Document((), Backdrop(f"data:image/{kind};base64,{base64.b64encode(content).decode()}"))


def _drawn(name: str, content: bytes) -> list[_Shape]:
    """Return the loops of a file, together and by shape; strokes that do not join as they are, to be gone on with."""
    contents = _contents(name, content)
    try:
        whole = _shape_of("", contents.outline())
    except StrokeError:
        strokes = _json_strokes(content)
        if strokes is None:
            raise
        data = [{"points": points, "closed": False} for points in strokes]
        return [_Shape("", read_document({"plyfold": DOCUMENT_VERSION, "strokes": data}))]
    return [whole, *_each(contents)]


def _each(contents: Contents) -> Iterator[_Shape]:
    """Yield the shapes of a drawing with several, those that are outlines."""
    for index in range(min(len(contents), _MOST_SHAPES) if len(contents) > 1 else 0):
        try:
            outline = contents.outline(index)
        except InputError:  # a lone line beside loops, for example
            continue
        yield _shape_of(contents.name(index)[:_LONGEST_NAME], outline)


def _json_strokes(content: bytes) -> Any:
    """Return the strokes of a JSON file that can be read; None for other files."""
    if not content.lstrip().startswith((b"{", b"[")):
        return None
    value = parse(content)
    return value.get("strokes") if isinstance(value, dict) else value


def _contents(name: str, content: bytes) -> Contents:
    safe = _STRANGE.sub("_", Path(name).name)[-_LONGEST_NAME:].lstrip(".") or "drawing"
    with tempfile.TemporaryDirectory(prefix="plyfold-") as folder:
        path = Path(folder) / safe
        path.write_bytes(content)
        return read_contents(path)


def _shape_of(name: str, outline: Outline) -> _Shape:
    return _Shape(name, _document_of(outline), outline.repairs)


def _document_of(outline: Outline) -> Document:
    if len(outline) > MOST_POINTS:
        raise InputError(f"the drawing has {len(outline):,} points, more than {MOST_POINTS:,}", hint="thin them out")
    return Document(tuple(map(_stroke, outline.loops, outline.cusps)))


def _stroke(points: Floats, index: Ints) -> Stroke:
    marks = tuple((int(point), int(index[point])) for point in np.flatnonzero(index))
    return Stroke(tuple((x, y) for x, y in points.tolist()), closed=True, cusps=marks)
