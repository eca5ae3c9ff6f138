"""A table: columns of the same length, by their names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import read_only
from plyfold.errors import InputError

if TYPE_CHECKING:
    import pandas
    import pyarrow

__all__ = ["Column", "DataTable", "joined"]

Column: TypeAlias = npt.NDArray[Any]


@dataclass(frozen=True)
class DataTable:
    """Columns of the same length, by their names.

    Parameters
    ----------
    columns : dict of str to (n,) arrays
        Numbers and truth values as numpy has them, in masked arrays if some are missing; text and whole numbers of any
        size as objects, None where they are missing.

    Examples
    --------
    >>> table = DataTable({"crossings": np.array([1, 2]), "reason": np.array(["turning number", None], dtype=object)})
    >>> len(table), table["reason"].tolist()
    (2, ['turning number', None])
    >>> next(table.rows())
    {'crossings': 1, 'reason': 'turning number'}
    """

    columns: Mapping[str, Column]

    def __post_init__(self) -> None:
        lengths = {len(column) for column in self.columns.values()}
        if len(lengths) > 1:
            raise InputError(f"the columns of a table are of one length, not of {sorted(lengths)}")
        object.__setattr__(self, "columns", {name: read_only(column) for name, column in self.columns.items()})

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __getitem__(self, name: str) -> Column:
        return self.columns[name]

    def rows(self) -> Iterator[dict[str, Any]]:
        """Yield the rows as dictionaries of plain Python values."""
        for values in zip(*(column.tolist() for column in self.columns.values()), strict=True):
            yield dict(zip(self.columns, values, strict=True))

    def to_numpy(self) -> dict[str, Column]:
        """Return the columns as a dictionary."""
        return dict(self.columns)

    def to_pandas(self) -> pandas.DataFrame:
        """Return a data frame, for which pandas must be installed."""
        import pandas

        return pandas.DataFrame({name: _for_pandas(column) for name, column in self.columns.items()})

    def to_arrow(self) -> pyarrow.Table:
        """Return an Arrow table, for which pyarrow must be installed: extra ``tables``.

        Whole numbers that 64 bits do not hold are decimal text, as in files.
        """
        import pyarrow

        def array(column: Column) -> pyarrow.Array:
            if column.dtype == object:
                return pyarrow.array([None if value is None else str(value) for value in column], pyarrow.string())
            if isinstance(column, np.ma.MaskedArray):
                return pyarrow.array(column.data, mask=np.ma.getmaskarray(column))
            return pyarrow.array(column.astype(str) if column.dtype.kind == "S" else column)

        return pyarrow.table({name: array(column) for name, column in self.columns.items()})


def joined(tables: Sequence[DataTable]) -> DataTable:
    """Return the rows of tables with the same columns, one table after the other."""
    return DataTable({name: _together([table[name] for table in tables]) for name in tables[0].columns})


def _together(columns: Sequence[Column]) -> Column:
    # numpy's own would forget what is missing.
    if not isinstance(columns[0], np.ma.MaskedArray):
        return np.concatenate(columns)
    found: Column = np.ma.concatenate(columns)  # type: ignore[no-untyped-call]
    return found


def _for_pandas(column: Column) -> Any:
    """Return a column as pandas takes it: whole numbers and truth values of which some are missing as such."""
    import pandas

    if not isinstance(column, np.ma.MaskedArray):
        return column
    missing = np.ma.getmaskarray(column)
    if column.dtype.kind == "f":
        return column.filled(np.nan)
    kind = pandas.arrays.BooleanArray if column.dtype.kind == "b" else pandas.arrays.IntegerArray
    return kind(np.array(column.data), missing)
