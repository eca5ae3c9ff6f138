"""Files with many outlines, in pieces of a handy size: folders of drawings, JSON lines, and Parquet with WKB."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from plyfold.errors import FileFormatError, PlyfoldError
from plyfold.immersion.verdict import plain_points
from plyfold.io.json_points import parsed_json, shapes_of_value
from plyfold.io.reading import SIZE_LIMIT, naming_the_file, read_contents
from plyfold.io.shapes import outline_of_shapes

if TYPE_CHECKING:
    from pyarrow import parquet

__all__ = ["FilePiece", "OutlineRow", "pieces_of_files", "rows_of_piece"]

_DRAWINGS = (".svg", ".json", ".geojson", ".wkt", ".csv", ".txt", ".npy", ".gpx", ".obj", ".ply")
_JSON_LINES = (".jsonl", ".ndjson", ".geojsonl", ".geojsons")
_PARQUET = (".parquet", ".geoparquet")
# What a folder is looked through for: a text can be anything.
_IN_FOLDERS = (*(ending for ending in _DRAWINGS if ending != ".txt"), *_JSON_LINES, *_PARQUET)
# Bytes in a piece of a file that has pieces, and rows that are read at once.
_PIECE = 8 * 2**20
_ROWS = 5000
# Columns in which geometry is found, where the file does not say so itself.
_GEOMETRY_COLUMNS = ("geometry", "geom", "wkb_geometry", "wkb", "the_geom")


@dataclass(frozen=True)
class FilePiece:
    """A part of a file.

    Parameters
    ----------
    path, name : str
        Where the file is, and what it was called.
    size : int
        About how many bytes.
    start, stop : int
        Of JSON lines, the first byte, and the first one after them; of Parquet, the row groups.
    first : int
        The number of the first row.
    column : str
        Of Parquet, where the geometry is.
    """

    path: str
    name: str
    size: int
    start: int = 0
    stop: int = 0
    first: int = 0
    column: str = ""


class OutlineRow(NamedTuple):
    """Whatever stands for an outline, or the error that is there in its place, and where it comes from."""

    file: str
    number: int | None
    id: str | None
    outline: Any


def pieces_of_files(paths: Iterable[str], column: str | None = None, but: str = "") -> list[FilePiece]:
    """Return the pieces of files, and of all files in folders, in the order of their names.

    Parameters
    ----------
    paths : iterable of str
    column : str, optional
        Of Parquet files: where the WKB is.
    but : str, optional
        A file that is none of them, even if it is in one of the folders.

    Returns
    -------
    list of FilePiece

    Raises
    ------
    FileFormatError
        If there is no such file or folder, or nothing to read in it; or a Parquet file has no such column.
    """
    files = [(file, name) for path in paths for file, name in _files(path) if not _is_same(file, but)]
    if not files:
        raise FileFormatError("there is no file with outlines", hint=f"in folders, {' '.join(_IN_FOLDERS)} are read")
    return [piece for file, name in files for piece in _pieces(file, name, column)]


def _files(path: str) -> Iterator[tuple[Path, str]]:
    """Yield the file of a name, or the files of a folder, with their names."""
    given = Path(path)
    if not given.exists():
        raise FileFormatError(f"{path} is not there", hint="check the path")
    if not given.is_dir():
        yield given, path
        return
    for file in sorted(given.rglob("*")):
        # Parts of a table that is being made are no drawings.
        if file.suffix.lower() in _IN_FOLDERS and file.parent.suffix != ".parts" and file.is_file():
            yield file, str(file)


def _is_same(file: Path, other: str) -> bool:
    return bool(other) and os.path.realpath(file) == os.path.realpath(other)


def _pieces(file: Path, name: str, column: str | None) -> Iterator[FilePiece]:
    ending, path = file.suffix.lower(), str(file.absolute())
    if ending in _PARQUET:
        yield from _row_groups(path, name, column)
    elif ending in _JSON_LINES:
        yield from _runs_of_lines(path, name)
    else:
        yield FilePiece(path, name, file.stat().st_size)


def rows_of_piece(piece: FilePiece) -> Iterator[OutlineRow]:
    """Yield the outlines of a piece; what cannot be read is a row with its error."""
    ending = Path(piece.path).suffix.lower()
    try:
        if ending in _PARQUET:
            yield from _parquet_rows(piece)
        elif ending in _JSON_LINES:
            yield from _json_lines(piece)
        elif ending in (".json", ".geojson"):
            yield from _json_rows(piece)
        else:
            yield from _rows_of_drawing(piece)
    except PlyfoldError as error:
        yield OutlineRow(piece.name, None, None, error)


# ---- files of one drawing, or of few -----------------------------------------------------------------------------


def _rows_of_drawing(piece: FilePiece) -> Iterator[OutlineRow]:
    contents = read_contents(piece.path)
    for index in range(len(contents)):
        try:
            outline: Any = contents.outline(index)
        except PlyfoldError as error:
            outline = error
        yield OutlineRow(piece.name, index, contents.name(index) or None, outline)


def _json_rows(piece: FilePiece) -> Iterator[OutlineRow]:
    """Yield the features of a collection, each with its own errors; of other JSON what is drawn."""
    if piece.size > SIZE_LIMIT:
        raise FileFormatError(
            f"{piece.name}: it is larger than {SIZE_LIMIT // 2**20} MiB", hint="write features as JSON lines"
        )
    with naming_the_file(piece.name):
        value = parsed_json(Path(piece.path).read_bytes())
    if not isinstance(value, dict) or not isinstance(features := value.get("features"), list):
        yield from _rows_of_drawing(piece)
        return
    for index, feature in enumerate(features):
        yield OutlineRow(piece.name, index, *_outline_of_value(feature))


def _outline_of_value(value: Any) -> tuple[str | None, Any]:
    """Return the name of what parsed JSON draws, and its outline or the error."""
    points = plain_points(value)
    if points is not None:
        return None, points
    try:
        shapes = shapes_of_value(value)
        return shapes[0].name or None, outline_of_shapes(shapes)
    except PlyfoldError as error:
        return _name(value), error


def _name(value: Any) -> str | None:
    """Return the id of a feature that could not be read."""
    name = value.get("id") if isinstance(value, dict) else None
    return None if name is None else str(name)


# ---- JSON lines --------------------------------------------------------------------------------------------------


def _runs_of_lines(path: str, name: str) -> Iterator[FilePiece]:
    """Yield runs of whole lines, each begun where the one before ends."""
    with Path(path).open("rb") as file:
        start = first = 0
        while chunk := file.read(_PIECE):
            rest = b"" if chunk.endswith(b"\n") else file.readline()
            stop = file.tell()
            yield FilePiece(path, name, stop - start, start, stop, first)
            start, first = stop, first + chunk.count(b"\n") + rest.count(b"\n")


def _json_lines(piece: FilePiece) -> Iterator[OutlineRow]:
    with Path(piece.path).open("rb") as file:
        file.seek(piece.start)
        index = piece.first
        while file.tell() < piece.stop:
            # Sequences of GeoJSON begin each record with this character.
            line = file.readline().strip(b"\x1e \t\r\n")
            if line:
                yield OutlineRow(piece.name, index, *_outline_of_line(line))
            index += 1


def _outline_of_line(line: bytes) -> tuple[str | None, Any]:
    try:
        return _outline_of_value(json.loads(line))
    except (ValueError, RecursionError) as error:
        return None, FileFormatError(f"broken JSON ({str(error).lower()})")


# ---- Parquet -----------------------------------------------------------------------------------------------------


def _open_parquet(path: str, name: str) -> parquet.ParquetFile:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise FileFormatError("Parquet files need pyarrow", hint='pip install "plyfold[tables]"') from error
    try:
        return parquet.ParquetFile(path)
    except (OSError, pyarrow.ArrowException) as error:
        raise FileFormatError(f"{name} is no Parquet file ({error})") from error


def _row_groups(path: str, name: str, column: str | None) -> Iterator[FilePiece]:
    """Yield runs of row groups."""
    with _open_parquet(path, name) as file:
        column = _geometry_column(file, name, column)
        start = first = rows = size = 0
        for group in range(file.num_row_groups):
            found = file.metadata.row_group(group)
            rows, size = rows + found.num_rows, size + found.total_byte_size
            if size >= _PIECE or group + 1 == file.num_row_groups:
                yield FilePiece(path, name, size, start, group + 1, first, column)
                start, first, rows, size = group + 1, first + rows, 0, 0


def _geometry_column(file: parquet.ParquetFile, name: str, column: str | None) -> str:
    """Return the column that is named, or that the file says has its geometry, or that is called so."""
    names = file.schema_arrow.names
    told = json.loads((file.schema_arrow.metadata or {}).get(b"geo", b"{}")).get("primary_column")
    wanted = (column,) if column else (told, *_GEOMETRY_COLUMNS)
    found = next((one for one in wanted if one in names), None)
    if found is None:
        raise FileFormatError(
            f"{name} has no column {column or 'of geometry'}", hint=f"it has {', '.join(names)}: name one with --column"
        )
    return found


def _parquet_rows(piece: FilePiece) -> Iterator[OutlineRow]:
    with _open_parquet(piece.path, piece.name) as file:
        groups = range(piece.start, piece.stop)
        batches = file.iter_batches(_ROWS, row_groups=groups, columns=[piece.column])
        values = chain.from_iterable(batch.column(0).to_pylist() for batch in batches)
        for index, value in enumerate(values, start=piece.first):
            yield OutlineRow(piece.name, index, None, value)
