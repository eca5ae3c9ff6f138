"""Tables as Parquet files, by pyarrow."""

from __future__ import annotations

import io
from collections.abc import Iterable
from pathlib import Path

from pyarrow import parquet

from plyfold.tables.table import DataTable

__all__ = ["join_parquet", "parquet_bytes"]


def parquet_bytes(table: DataTable) -> bytes:
    """Return the table as a Parquet file."""
    written = io.BytesIO()
    parquet.write_table(table.to_arrow(), written, compression="zstd")
    return written.getvalue()


def join_parquet(parts: Iterable[Path], path: Path) -> None:
    """Write the rows of Parquet files with the same columns into one, in memory for one of them at a time."""
    writer = None
    for part in parts:
        rows = parquet.read_table(part)
        writer = writer or parquet.ParquetWriter(path, rows.schema, compression="zstd")
        writer.write_table(rows)
    if writer is not None:
        writer.close()
