"""Whole numbers of which nobody knows beforehand how many there will be."""

from __future__ import annotations

import numpy as np

from plyfold.arrays import Ints
from plyfold.core.buffers import flat

__all__ = ["Numbers"]


class Numbers:
    """Whole numbers, to which others are appended.

    Examples
    --------
    >>> squares = Numbers(2)
    >>> for number in range(5):
    ...     squares.append(number * number)
    >>> squares.as_array().tolist()
    [0, 1, 4, 9, 16]
    """

    def __init__(self, room: int) -> None:
        self.array = np.empty(room, dtype=np.int64)
        self.data = flat(self.array)
        self.room = room
        self.size = 0

    def append(self, number: int) -> None:
        """Append a number."""
        if self.size == self.room:
            self._grow()
        self.data[self.size] = number
        self.size += 1

    def _grow(self) -> None:
        self.room *= 2
        self.array = np.concatenate([self.array, np.empty_like(self.array)])
        self.data = flat(self.array)

    def as_array(self) -> Ints:
        """Return them, shape (size,)."""
        return self.array[: self.size]
