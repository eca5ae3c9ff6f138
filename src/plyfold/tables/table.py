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

    Attributes
    ----------
    columns : dict of str to (n,) arrays
        Numbers and truth values as numpy has them; text, whole numbers of any size and missing values (None) as
        objects.

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

        return pandas.DataFrame(dict(self.columns))

    def to_arrow(self) -> pyarrow.Table:
        """Return an Arrow table, for which pyarrow must be installed: extra ``tables``.

        Whole numbers that 64 bits do not hold are decimal text, as in files.
        """
        import pyarrow

        def array(column: Column) -> pyarrow.Array:
            if column.dtype == object:
                return pyarrow.array([None if value is None else str(value) for value in column], pyarrow.string())
            return pyarrow.array(column.astype(str) if column.dtype.kind == "S" else column)

        return pyarrow.table({name: array(column) for name, column in self.columns.items()})


def joined(tables: Sequence[DataTable]) -> DataTable:
    """Return the rows of tables with the same columns, one table after the other."""
    return DataTable({name: np.concatenate([table[name] for table in tables]) for name in tables[0].columns})
