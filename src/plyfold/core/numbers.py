"""Whole numbers of which nobody knows beforehand how many there will be."""

from __future__ import annotations

import numpy as np

from plyfold.arrays import Ints
from plyfold.core.buffers import WholeBuffer, whole_room

__all__ = ["Numbers"]

_LEAST = 8


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

    def __init__(self, room: int = 0) -> None:
        self.room = self.size = 0
        if room > 0:
            self.begin(whole_room(room), room)

    def begin(self, data: WholeBuffer, room: int) -> None:
        """Begin anew, in a buffer with room for so many; where that does not do, another one is made."""
        self.data, self.room, self.size = data, room, 0

    def append(self, number: int) -> None:
        """Append a number."""
        if self.size == self.room:
            self._grow()
        self.data[self.size] = number
        self.size += 1

    def _grow(self) -> None:
        self.room = max(2 * self.room, _LEAST)
        larger = whole_room(self.room)
        for place in range(self.size):
            larger[place] = self.data[place]
        self.data = larger

    def as_array(self) -> Ints:
        """Return them, shape (size,)."""
        return np.asarray(self.data[: self.size]) if self.size > 0 else np.empty(0, dtype=np.int64)
