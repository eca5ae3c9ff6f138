"""Files of tables, whole or in parts that are joined: Parquet, CSV, and JSON lines."""

from __future__ import annotations

import csv
import io
import json
import shutil
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from plyfold.errors import InputError
from plyfold.tables.table import DataTable

__all__ = ["TABLE_ENDINGS", "join_tables", "require_writer", "table_bytes"]


def table_bytes(table: DataTable, ending: str) -> bytes:
    r"""Return a table as the bytes of a file.

    Examples
    --------
    >>> import numpy as np
    >>> table_bytes(DataTable({"immersions": np.array([2**70, None], dtype=object)}), ".jsonl")
    b'{"immersions": "1180591620717411303424"}\n{"immersions": null}\n'
    """
    return _WRITERS[ending](table)


def join_tables(parts: Sequence[Path], path: Path, ending: str) -> None:
    """Write the rows of files with the same columns into one file, which is new."""
    if ending == ".parquet":
        from plyfold.tables.arrow import join_parquet

        join_parquet(parts, path)
        return
    with path.open("xb") as joined:
        for number, part in enumerate(parts):
            with part.open("rb") as rows:
                if ending == ".csv" and number:
                    rows.readline()
                shutil.copyfileobj(rows, joined)


def require_writer(ending: str) -> None:
    """Refuse before any work is done what could not be written after it.

    Raises
    ------
    InputError
        If there are no such files, or pyarrow is not installed and they need it.
    """
    if ending not in TABLE_ENDINGS:
        raise InputError(f"tables are no {ending or 'files without ending'}", hint=f"choose {' '.join(TABLE_ENDINGS)}")
    if ending == ".parquet" and find_spec("pyarrow") is None:
        hint = 'pip install "plyfold[tables]", or choose .csv or .jsonl'
        raise InputError("Parquet files need pyarrow", hint=hint)


def _as_parquet(table: DataTable) -> bytes:
    from plyfold.tables.arrow import parquet_bytes

    return parquet_bytes(table)


def _as_csv(table: DataTable) -> bytes:
    written = io.StringIO()
    rows = csv.writer(written, lineterminator="\n")
    rows.writerow(table.columns)
    rows.writerows([_plain(value) for value in row.values()] for row in table.rows())
    return written.getvalue().encode()


def _as_json_lines(table: DataTable) -> bytes:
    objects = {name for name, column in table.columns.items() if column.dtype == object}
    lines = (
        json.dumps({name: _text(value) if name in objects else _plain(value) for name, value in row.items()})
        for row in table.rows()
    )
    return "".join(f"{line}\n" for line in lines).encode()


def _plain(value: Any) -> Any:
    return value.decode() if isinstance(value, bytes) else value


def _text(value: Any) -> str | None:
    """Return a value of an object column: decimal text for whole numbers, whatever their size."""
    return None if value is None else str(value)


_WRITERS: dict[str, Callable[[DataTable], bytes]] = {
    ".parquet": _as_parquet,
    ".csv": _as_csv,
    ".jsonl": _as_json_lines,
}
TABLE_ENDINGS = tuple(_WRITERS)
