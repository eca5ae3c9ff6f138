"""Documents inside pictures: a PNG or SVG that carries the drawing it shows, and opens again."""

from __future__ import annotations

import html
import json
import re
import struct
import zlib
from collections.abc import Iterator
from typing import Any

from plyfold.errors import FileFormatError
from plyfold.io.masks import PNG_START, png_chunk
from plyfold.sketch.schema import MOST_BYTES, Document, document_data, parse

__all__ = ["png_document", "png_with", "svg_document", "svg_with"]

_KEYWORD = b"plyfold"
_ROOT = re.compile(r"<svg\b[^>]*>")
_METADATA = re.compile(rb"<(?:\w+:)?metadata\b[^>]*\bid\s*=\s*[\"']plyfold[\"'][^>]*>(.*?)</", re.DOTALL)


def png_with(document: Document, picture: bytes) -> bytes:
    """Return a PNG with a document in an iTXt chunk before its end.

    Parameters
    ----------
    document : Document
    picture : bytes
        A PNG.

    Returns
    -------
    bytes
        The same picture; readers that do not know the chunk pass over it.
    """
    text = zlib.compress(_text(document).encode(), 9)
    chunk = png_chunk(b"iTXt", _KEYWORD + b"\0\1\0\0\0" + text)  # compressed, no language, no translated keyword
    end = picture.rindex(b"IEND") - 4
    return picture[:end] + chunk + picture[end:]


def png_document(picture: bytes) -> Any:
    """Return the data of the document in a PNG, or None if it carries none.

    Raises
    ------
    FileFormatError
        If the document in it is broken.
    """
    for kind, content in _chunks(picture):
        if kind == b"iTXt" and content.startswith(_KEYWORD + b"\0\1\0"):
            packed = content[len(_KEYWORD) + 3 :].split(b"\0", 2)[-1]
            return parse(_unpacked(packed))
    return None


def svg_with(document: Document, picture: str) -> str:
    """Return an SVG with a document in ``<metadata id="plyfold">``.

    Examples
    --------
    >>> svg_with(Document(()), "<svg><g/></svg>")[:46]
    '<svg><metadata id="plyfold">{"plyfold":2,"stro'
    """
    root = _ROOT.search(picture)
    assert root is not None
    text = html.escape(_text(document), quote=False)
    return f'{picture[: root.end()]}<metadata id="plyfold">{text}</metadata>{picture[root.end() :]}'


def svg_document(picture: bytes) -> Any:
    """Return the data of the document in an SVG, or None if it carries none. Raises InputError if it is broken."""
    found = _METADATA.search(picture)
    return None if found is None else parse(html.unescape(found[1].decode(errors="replace")).strip().encode())


def _text(document: Document) -> str:
    return json.dumps(document_data(document), separators=(",", ":"), allow_nan=False)


def _chunks(picture: bytes) -> Iterator[tuple[bytes, bytes]]:
    at = len(PNG_START)
    while at + 8 <= len(picture):
        (length,) = struct.unpack(">I", picture[at : at + 4])
        yield picture[at + 4 : at + 8], picture[at + 8 : at + 8 + length]
        at += length + 12


def _unpacked(packed: bytes) -> bytes:
    """Unpack no more than a question may have: a small chunk can hold very much."""
    unpacker = zlib.decompressobj()
    try:
        text = unpacker.decompress(packed, MOST_BYTES)
    except zlib.error as error:
        raise FileFormatError("the drawing in the picture is broken", hint="export it again") from error
    if not unpacker.eof:
        raise FileFormatError("the drawing in the picture is broken or too large", hint="export it again")
    return text
