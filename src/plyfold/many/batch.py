"""Verdicts on all outlines in files, as one long table that is made in parts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from plyfold.many.sources import Chunk, chunks_of, outlines_in
from plyfold.many.verdicts import DEFAULT_COLUMNS, verdicts
from plyfold.tables.parts import Job
from plyfold.tables.table import DataTable

__all__ = ["batch_job"]


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
    return Job(what, len(chunks), partial(_made, chunks, tuple(columns), time_limit))


def _made(
    chunks: Sequence[Chunk], columns: Sequence[str], time_limit: float | None, number: int
) -> tuple[DataTable, dict[str, Any]]:
    found = list(outlines_in(chunks[number]))
    asked = tuple(dict.fromkeys((*columns, "verdict")))
    told = verdicts([outline for *_, outline in found], asked, time_limit=time_limit)
    named = {
        "file": np.array([row.file for row in found], dtype=object),
        "index": np.array([row.number for row in found], dtype=np.int64),
        "id": np.array([row.id for row in found], dtype=object),
    }
    kept = {name: column for name, column in told.columns.items() if name in columns or name.startswith("place")}
    return DataTable(named | kept), dict(Counter(verdict or "error" for verdict in told["verdict"].tolist()))
