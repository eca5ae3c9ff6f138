"""Files that hold many outlines, in chunks that fit into memory: folders, JSON lines, and Parquet with WKB."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from plyfold.errors import InputError, PlyfoldError
from plyfold.io.json_points import parsed_json, shapes_of_value
from plyfold.io.reading import SIZE_LIMIT, Contents, naming_the_file, read_contents
from plyfold.io.shapes import outline_of_shapes

__all__ = ["Chunk", "FoundOutline", "chunks_of", "files_in", "outlines_in"]

_LINES, _PARQUET = (".jsonl", ".ndjson", ".geojsonl", ".geojsons"), ".parquet"
_DRAWINGS = (".svg", ".json", ".geojson", ".wkt", ".csv", ".npy", ".gpx", ".obj", ".ply", ".txt")
_FILES_AT_ONCE, _BYTES_AT_ONCE, _LINES_AT_ONCE = 200, 2**22, 10_000
_GEOMETRY_COLUMNS = ("geometry", "wkb", "geom")
# Sequences of GeoJSON begin each record with the first of these.
_AROUND_RECORDS = b"\x1e \t\r\n"


class Chunk(NamedTuple):
    """What one part of a batch reads: some files, lines of one, or a group of rows of one.

    Attributes
    ----------
    paths : tuple of str
        One path, unless whole files are read.
    first : int
        The number of the first outline in its file.
    start, stop : int
        Of lines, the bytes; of a Parquet file, the number of the group, and the next; of whole files 0.
    """

    paths: tuple[str, ...]
    first: int = 0
    start: int = 0
    stop: int = 0


class FoundOutline(NamedTuple):
    """An outline in a file: where it stands, and what it is; an error in place of one that cannot be read.

    A file that cannot be read at all is one outline with the number −1.
    """

    file: str
    number: int
    id: str | None
    outline: Any


def files_in(inputs: Iterable[str], without: Path | None = None) -> list[str]:
    """Return the files that are named, and those in folders that are, in order.

    Parameters
    ----------
    inputs : iterable of str
    without : Path, optional
        A file in such a folder that is not to be read, since it is written.

    Raises
    ------
    InputError
        If there is no such file or folder, or nothing in it.
    """
    files: list[str] = []
    for name in inputs:
        if not Path(name).exists():
            raise InputError(f"there is no file or folder {name}")
        files += [name] if Path(name).is_file() else map(str, sorted(_drawings_in(Path(name), without)))
    if not files:
        endings = " ".join((*_DRAWINGS, *_LINES, _PARQUET))
        raise InputError("there is no drawing in it", hint=f"drawings end in {endings}")
    return list(dict.fromkeys(files))


def _drawings_in(folder: Path, without: Path | None) -> Iterator[Path]:
    kept = None if without is None else without.resolve()
    for path in folder.rglob("*"):
        parts = [parent.suffix for parent in path.parents]
        if path.suffix.lower() in (*_DRAWINGS, *_LINES, _PARQUET) and ".parts" not in parts and path.resolve() != kept:
            yield path


def chunks_of(files: Sequence[str]) -> list[Chunk]:
    r"""Cut files into chunks of a handy size, in order.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "many.jsonl")
    ...     _ = path.write_text("[[0, 0], [4, 0], [0, 3]]\n" * 25_000)
    ...     [chunk.first for chunk in chunks_of([str(path)])]
    [0, 10000, 20000]
    """
    chunks: list[Chunk] = []
    whole: list[str] = []
    for path in files:
        ending = Path(path).suffix.lower()
        if ending in _LINES or ending == _PARQUET:
            chunks += _chunks_of_files(whole)
            whole = []
            chunks += _chunks_of_lines(path) if ending in _LINES else _groups(path)
        else:
            whole.append(path)
    return chunks + _chunks_of_files(whole)


def _chunks_of_files(paths: Sequence[str]) -> list[Chunk]:
    chunks: list[Chunk] = []
    kept, size = [], 0
    for path in paths:
        kept.append(path)
        size += Path(path).stat().st_size
        if size > _BYTES_AT_ONCE or len(kept) == _FILES_AT_ONCE:
            chunks.append(Chunk(tuple(kept)))
            kept, size = [], 0
    return chunks + ([Chunk(tuple(kept))] if kept else [])


def _chunks_of_lines(path: str) -> list[Chunk]:
    """Cut a file of lines between lines."""
    chunks: list[Chunk] = []
    first = start = number = stop = 0
    with Path(path).open("rb") as lines:
        for number, line in enumerate(lines, start=1):
            stop += len(line)
            if number - first == _LINES_AT_ONCE or stop - start > _BYTES_AT_ONCE:
                chunks.append(Chunk((path,), first, start, stop))
                first, start = number, stop
    return [*chunks, Chunk((path,), first, start, stop)] if number > first or not chunks else chunks


def _groups(path: str) -> list[Chunk]:
    """Return the groups of rows of a Parquet file; one that cannot be read is a chunk all the same."""
    from plyfold.many.parquet import sizes_of_groups

    first, chunks = 0, []
    try:
        sizes = sizes_of_groups(path)
    except InputError:
        return [Chunk((path,), 0, 0, 1)]
    for number, size in enumerate(sizes):
        chunks.append(Chunk((path,), first, number, number + 1))
        first += size
    return chunks


def outlines_in(chunk: Chunk) -> Iterator[FoundOutline]:
    """Read the outlines of a chunk one after the other; what is wrong with one is no error, but in its place."""
    ending = Path(chunk.paths[0]).suffix.lower()
    if ending in _LINES:
        yield from _on_lines(chunk)
    elif ending == _PARQUET:
        yield from _in_group(chunk)
    else:
        for path in chunk.paths:
            yield from _in_file(path)


def _in_file(path: str) -> Iterator[FoundOutline]:
    try:
        features = _features(path)
        contents = read_contents(path) if features is None else None
    except PlyfoldError as error:
        yield FoundOutline(path, -1, None, error)
        return
    for index, feature in enumerate(features or ()):
        yield FoundOutline(path, index, *_drawn_by(feature))
    if contents is not None:
        for index in range(len(contents)):
            yield FoundOutline(path, index, contents.name(index) or None, _outline_or_error(contents, index))


def _features(path: str) -> list[Any] | None:
    """Return the features of a collection, each of which may be bad for itself; None of all other files."""
    if Path(path).suffix.lower() not in (".json", ".geojson") or Path(path).stat().st_size > SIZE_LIMIT:
        return None
    with naming_the_file(Path(path).name):
        value = parsed_json(Path(path).read_bytes())
    features = value.get("features") if isinstance(value, dict) else None
    return features if isinstance(features, list) and features else None


def _outline_or_error(contents: Contents, index: int) -> Any:
    try:
        return contents.outline(index)
    except PlyfoldError as error:
        return error


def _on_lines(chunk: Chunk) -> Iterator[FoundOutline]:
    """Read lines; empty ones count, and hold nothing."""
    (path,) = chunk.paths
    with Path(path).open("rb") as file:
        file.seek(chunk.start)
        index = chunk.first
        while file.tell() < chunk.stop:
            line = file.readline(SIZE_LIMIT)
            if line.strip(_AROUND_RECORDS):
                yield FoundOutline(path, index, *_on_line(line))
            index += 1


def _on_line(line: bytes) -> tuple[str | None, Any]:
    try:
        return _drawn_by(parsed_json(line.strip(_AROUND_RECORDS)))
    except PlyfoldError as error:
        return None, error


def _drawn_by(value: Any) -> tuple[str | None, Any]:
    """Return the id of what parsed JSON draws, and the outline, or the error."""
    name = value.get("id") if isinstance(value, dict) else None
    try:
        shapes = shapes_of_value(value)
        return shapes[0].name or None, outline_of_shapes(shapes)
    except PlyfoldError as error:
        return None if name is None else str(name), error


def _in_group(chunk: Chunk) -> Iterator[FoundOutline]:
    from plyfold.many.parquet import rows_of_group

    (path,) = chunk.paths
    try:
        for index, (name, row) in enumerate(rows_of_group(path, chunk.start, _GEOMETRY_COLUMNS), start=chunk.first):
            yield FoundOutline(path, index, name, row)
    except InputError as error:
        yield FoundOutline(path, -1, None, error)
