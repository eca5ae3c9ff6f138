"""Buffers of numbers: what compiled code and plain Python index alike, and quickly. They are views of arrays."""

from __future__ import annotations

from typing import Any, Protocol, TypeAlias, TypeVar, cast, overload

import numpy as np
import numpy.typing as npt

__all__ = [
    "Buffer",
    "RealBuffer",
    "WholeBuffer",
    "all_flat",
    "byte_room",
    "flat",
    "real_room",
    "rough_room",
    "short_room",
    "whole_room",
]

_Number = TypeVar("_Number")


class Buffer(Protocol[_Number]):
    """Numbers in a row, with places from 0 on: a memoryview of an array is one. A slice is a view of some of them."""

    def __len__(self) -> int: ...

    @overload
    def __getitem__(self, place: int, /) -> _Number: ...

    @overload
    def __getitem__(self, places: slice, /) -> Buffer[_Number]: ...

    @overload
    def __setitem__(self, place: int, number: _Number, /) -> None: ...

    @overload
    def __setitem__(self, places: slice, numbers: Buffer[_Number], /) -> None: ...


RealBuffer: TypeAlias = Buffer[float]
WholeBuffer: TypeAlias = Buffer[int]


def flat(array: npt.NDArray[Any]) -> Buffer[Any]:
    """Return the numbers of an array in a row, without copying them if they are in one already."""
    return cast("Buffer[Any]", array.ravel().data)


def all_flat(*arrays: npt.NDArray[Any]) -> list[Buffer[Any]]:
    """Return the same of several arrays."""
    return [flat(array) for array in arrays]


def real_room(size: int) -> RealBuffer:
    """Return room for so many doubles, with anything in it."""
    return flat(np.empty(size))


def whole_room(size: int) -> WholeBuffer:
    """Return so many zeros, for whole numbers of 64 bits."""
    return flat(np.zeros(size, dtype=np.int64))


def byte_room(size: int) -> WholeBuffer:
    """Return room for so many numbers from 0 to 255, such as truth values, with anything in it."""
    return flat(np.empty(size, dtype=np.uint8))


def rough_room(size: int) -> WholeBuffer:
    """Return room for so many whole numbers of 64 bits, with anything in it."""
    return flat(np.empty(size, dtype=np.int64))


def short_room(size: int) -> WholeBuffer:
    """Return so many zeros, for whole numbers of 32 bits: for numbers of sheets, where there are very many."""
    return flat(np.zeros(size, dtype=np.int32))
