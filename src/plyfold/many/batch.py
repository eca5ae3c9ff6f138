"""Verdicts on all outlines in files, as one long table that is made in parts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from plyfold.many.sources import Chunk, FoundOutline, chunks_of, outlines_in
from plyfold.many.verdicts import DEFAULT_COLUMNS, verdicts
from plyfold.tables.parts import Job
from plyfold.tables.table import DataTable, joined

__all__ = ["batch_job"]

# So many outlines are in memory at once, however many rows a part has.
_ROWS_AT_ONCE = 10_000


def batch_job(files: Sequence[str], columns: Sequence[str] = DEFAULT_COLUMNS, time_limit: float | None = None) -> Job:
    """Return the table of verdicts on all outlines in files, in parts.

    Parameters
    ----------
    files : sequence of str
    columns : sequence of str, optional
    time_limit : float, optional
        Both as for :func:`~plyfold.verdicts`. Columns ``file``, ``index`` (of the outline in its file, from 0 on; −1
        if the file cannot be read) and ``id`` come first.

    Returns
    -------
    Job
        The note of a part counts its verdicts; bad rows count as ``"error"``.
    """
    chunks = chunks_of(files)
    found = [[path, Path(path).stat().st_size, Path(path).stat().st_mtime_ns] for path in files]
    what = {"batch": found, "columns": list(columns), "time_limit": time_limit}
    return Job(what, chunks, partial(_made, tuple(columns), time_limit))


def _made(columns: Sequence[str], time_limit: float | None, chunk: Chunk) -> tuple[DataTable, dict[str, Any]]:
    asked = tuple(dict.fromkeys((*columns, "verdict")))
    found, tables = outlines_in(chunk), [_judged([], asked, time_limit)]
    while some := list(islice(found, _ROWS_AT_ONCE)):
        tables.append(_judged(some, asked, time_limit))
    told = joined(tables)
    counts = Counter(verdict or "error" for verdict in told["verdict"].tolist())
    kept = {name: column for name, column in told.columns.items() if name != "verdict" or name in columns}
    return DataTable(kept), dict(counts)


def _judged(found: Sequence[FoundOutline], asked: Sequence[str], time_limit: float | None) -> DataTable:
    named = {
        "file": np.array([row.file for row in found], dtype=object),
        "index": np.array([row.number for row in found], dtype=np.int64),
        "id": np.array([row.id for row in found], dtype=object),
    }
    told = verdicts([outline for *_, outline in found], asked, time_limit=time_limit)
    return DataTable({**named, **told.columns})
