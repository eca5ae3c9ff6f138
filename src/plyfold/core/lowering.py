# cython: boundscheck=False
"""Long rows of numbers, lowered or copied, several at once: so indices are checked at the ends alone."""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer

__all__ = ["copy_row", "lower_row"]


def lower_row(numbers: RealBuffer, place: int, source: int, size: int, more: float) -> None:
    """Lower numbers to those of another stretch with something added, where these are less.

    Examples
    --------
    >>> from array import array
    >>> numbers = array("d", [1, 2, 3, 9, 1, 9])
    >>> lower_row(numbers, 3, 0, 3, 1.0) or list(numbers)
    [1.0, 2.0, 3.0, 2.0, 1.0, 4.0]
    """
    if place < 0 or source < 0 or place + size > len(numbers) or source + size > len(numbers):
        raise IndexError("a row is not in its buffer")
    for number in range(size):
        lower, here = numbers[source + number] + more, numbers[place + number]
        numbers[place + number] = lower if lower < here else here


def copy_row(numbers: RealBuffer, place: int, source: int, size: int, more: float) -> None:
    """Copy numbers from another stretch with something added.

    Examples
    --------
    >>> from array import array
    >>> numbers = array("d", [1, 2, 0, 0])
    >>> copy_row(numbers, 2, 0, 2, 0.5) or list(numbers)
    [1.0, 2.0, 1.5, 2.5]
    """
    if place < 0 or source < 0 or place + size > len(numbers) or source + size > len(numbers):
        raise IndexError("a row is not in its buffer")
    for number in range(size):
        numbers[place + number] = numbers[source + number] + more
