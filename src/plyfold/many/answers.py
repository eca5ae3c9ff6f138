"""Answers of different lengths to many outlines, such as the triangles of each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Ints, freeze
from plyfold.errors import PlyfoldError
from plyfold.many.given import ManyOutlines

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["ManyAnswers", "answers_of_rows", "in_batches", "joined_answers"]

_Answer = TypeVar("_Answer")
Array: TypeAlias = npt.NDArray[Any]

# So many outlines keep the memory that they take beside the answers small, and calls between them few.
_BATCH = 5000


@dataclass(frozen=True)
class ManyAnswers:
    """What a call answers to each of many outlines, one after the other in one array.

    ``answers[i]`` is what the call returns for outline i, and raises the error that the call raises.

    Parameters
    ----------
    values : array
        Triangles, (n, 3) int; or polygons, (n,) objects.
    first : (m + 1,) int
        Outline i has the values ``first[i]`` up to ``first[i + 1]``.
    errors : mapping of int to PlyfoldError
        Those outlines that have no answer, and therefore no values.

    Examples
    --------
    >>> from plyfold import triangulate_many
    >>> found = triangulate_many([[(0, 0), (4, 0), (4, 4), (0, 4)], [(0, 0), (2, 2), (2, 0), (0, 2)]])
    >>> found[0].tolist(), found.first.tolist()
    ([[0, 1, 3], [3, 1, 2]], [0, 2, 2])
    >>> found.errors[1].obstruction.reason
    'turning number'
    """

    values: Array
    first: Ints
    errors: Mapping[int, PlyfoldError]

    def __post_init__(self) -> None:
        freeze(self)

    def __len__(self) -> int:
        return len(self.first) - 1

    def __getitem__(self, row: int) -> Array:
        row = range(len(self))[row]
        if row in self.errors:
            raise self.errors[row]
        return self.values[self.first[row] : self.first[row + 1]]


def answers_of_rows(outlines: ManyOutlines, call: Callable[[int], Array], empty: Array) -> ManyAnswers:
    """Call a function for each row, and return its answers and errors."""
    values, errors = [empty] * len(outlines), {}
    for row in range(len(outlines)):
        try:
            values[row] = call(row)
        except PlyfoldError as error:
            # Where it was raised is of no use, and would hold on to all that is there.
            errors[row] = error.with_traceback(None)
    return ManyAnswers(np.concatenate([empty, *values]), _starts(values), errors)


def _starts(values: list[Array]) -> Ints:
    return np.concatenate([[0], np.cumsum([len(array) for array in values], dtype=np.int64)])


def joined_answers(parts: list[ManyAnswers], empty: Array) -> ManyAnswers:
    """Return the answers of parts that follow each other."""
    rows = np.cumsum([0, *map(len, parts)]).tolist()
    values = np.cumsum([0, *(len(part.values) for part in parts)]).tolist()
    errors = {row + at: error for part, at in zip(parts, rows, strict=False) for row, error in part.errors.items()}
    first = [part.first[1:] + at for part, at in zip(parts, values, strict=False)]
    return ManyAnswers(
        np.concatenate([empty, *(part.values for part in parts)]),
        np.concatenate([np.zeros(1, dtype=np.int64), *first]),
        errors,
    )


def in_batches(
    outlines: ManyOutlines, call: Callable[[ManyOutlines], _Answer], client: Client | None
) -> Iterator[_Answer]:
    """Call a function for batches of outlines, here or on a cluster, and yield what comes back in their order."""
    batches = outlines.batches(_BATCH)
    if client is None:
        yield from map(call, batches)
        return
    from plyfold.tables.cluster import in_order

    yield from in_order(client, call, batches)
