"""Outlines in Parquet files, as WKB: GeoParquet, or any column of bytes; by pyarrow."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any

import pyarrow
from pyarrow import parquet

from plyfold.errors import FileFormatError
from plyfold.many.given import as_many

__all__ = ["rows_of_group", "sizes_of_groups"]

_ROWS_AT_ONCE = 10_000


def sizes_of_groups(path: str) -> list[int]:
    """Return how many rows the groups of a file have."""
    known = _opened(path).metadata
    return [known.row_group(number).num_rows for number in range(known.num_row_groups)]


def rows_of_group(path: str, group: int, usual: Sequence[str]) -> Iterator[tuple[str | None, Any]]:
    """Read the rows of a group: the value of a column ``id``, if there is one, and the outline.

    Parameters
    ----------
    path : str
    group : int
    usual : sequence of str
        What columns of geometries are usually called.

    Raises
    ------
    FileFormatError
        If the file cannot be read, or has no column of bytes.
    """
    file = _opened(path)
    column = _geometry_column(file, usual)
    names = [column, *(["id"] if "id" in file.schema_arrow.names else [])]
    for batch in file.iter_batches(_ROWS_AT_ONCE, row_groups=[group], columns=names):
        many = as_many(batch.column(column).to_pylist())
        ids = batch.column("id").to_pylist() if len(names) > 1 else [None] * len(many)
        for number, name in enumerate(ids):
            row = many.others[number] if number in many.others else many.outline(number)
            yield None if name is None else str(name), row


def _opened(path: str) -> parquet.ParquetFile:
    try:
        return parquet.ParquetFile(path)
    except (OSError, pyarrow.ArrowException) as error:
        raise FileFormatError(f"{path}: this is no Parquet file ({error})") from error


def _geometry_column(file: parquet.ParquetFile, usual: Sequence[str]) -> str:
    """Return the column that GeoParquet names, or one with a usual name, or the first one that holds bytes."""
    schema = file.schema_arrow
    told = json.loads((schema.metadata or {}).get(b"geo", b"{}")).get("primary_column")
    of_bytes = [field.name for field in schema if pyarrow.types.is_binary(field.type) or _is_large(field.type)]
    for name in (told, *usual, *of_bytes[:1]):
        if name in of_bytes:
            return str(name)
    raise FileFormatError("no column holds geometries as WKB", hint=f"its columns are {', '.join(schema.names)}")


def _is_large(kind: pyarrow.DataType) -> bool:
    return bool(pyarrow.types.is_large_binary(kind))
