"""The verdicts on all outlines in files, as a long table that is made in parts."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import astuple
from functools import partial
from itertools import chain, islice
from pathlib import Path

import numpy as np

from plyfold.many.given import as_many
from plyfold.many.sources import FilePiece, OutlineRow, pieces_of_files, rows_of_piece
from plyfold.many.verdicts import checked_columns, verdicts_of_batch
from plyfold.tables.parts import Job, Note
from plyfold.tables.table import Column, DataTable, joined

__all__ = ["batch_job"]

# A part is made of pieces until it has so many bytes or pieces; of its rows so many are in memory as outlines at once.
_BYTES = 8 * 2**20
_PIECES = 1000
_ROWS = 5000


def batch_job(
    paths: Iterable[str],
    columns: Iterable[str],
    *,
    time_limit: float | None = None,
    column: str | None = None,
    but: str = "",
) -> Job:
    """Return the table of verdicts on all outlines of files, in parts.

    Parameters
    ----------
    paths, column, but
        As :func:`~plyfold.many.sources.pieces_of_files` takes them.
    columns, time_limit
        As :func:`~plyfold.verdicts` takes them. The columns ``file``, ``index`` and ``id`` come first.

    Returns
    -------
    Job
    """
    wanted, pieces = checked_columns(columns), pieces_of_files(paths, column, but)
    what = {"batch": _fingerprint(pieces), "columns": list(wanted), "time_limit": time_limit}
    return Job(what, list(_parts(pieces)), partial(_part, wanted, time_limit))


def _fingerprint(pieces: Sequence[FilePiece]) -> str:
    """Return what changes as soon as files do."""
    found = hashlib.sha256()
    for piece in pieces:
        found.update(json.dumps([*astuple(piece), Path(piece.path).stat().st_mtime_ns]).encode())
    return found.hexdigest()


def _parts(pieces: Iterable[FilePiece]) -> Iterator[tuple[FilePiece, ...]]:
    part: list[FilePiece] = []
    size = 0
    for piece in pieces:
        part.append(piece)
        size += piece.size
        if len(part) == _PIECES or size >= _BYTES:
            yield tuple(part)
            part, size = [], 0
    if part:
        yield tuple(part)


def _part(columns: tuple[str, ...], time_limit: float | None, pieces: Sequence[FilePiece]) -> tuple[DataTable, Note]:
    rows = chain.from_iterable(map(rows_of_piece, pieces))
    tables = [_table_of_rows([], columns, time_limit)]
    while batch := list(islice(rows, _ROWS)):
        tables.append(_table_of_rows(batch, columns, time_limit))
    table = joined(tables)
    return table, _note(table)


def _note(table: DataTable) -> Note:
    """Return how many rows there are, how many of these have an error, and each verdict, as far as that is told."""
    told = {name: Counter(table.columns.get(name, np.empty(0)).tolist()) for name in ("verdict", "error")}
    errors = told["error"].total() - told["error"][None]
    return {"rows": len(table), "errors": errors} | {name: n for name, n in told["verdict"].items() if name}


def _table_of_rows(rows: Sequence[OutlineRow], columns: tuple[str, ...], time_limit: float | None) -> DataTable:
    found = verdicts_of_batch(as_many([row.outline for row in rows]), columns, time_limit)
    missing = [row.number is None for row in rows]
    index = np.ma.MaskedArray([0 if row.number is None else row.number for row in rows], missing, dtype=np.int64)
    named = {"file": _objects([row.file for row in rows]), "index": index, "id": _objects([row.id for row in rows])}
    return DataTable(named | dict(found.columns))


def _objects(values: Sequence[str | None]) -> Column:
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column
