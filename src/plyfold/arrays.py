"""Names for the arrays that everything here is made of."""

from __future__ import annotations

from typing import TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

__all__ = [
    "Bools",
    "Complexes",
    "Floats",
    "Fractions",
    "Ints",
    "Reals",
    "Shorts",
    "Signs",
    "Wholes",
    "freeze",
    "read_only",
]

Scalar = TypeVar("Scalar", bound=np.generic)

Floats: TypeAlias = npt.NDArray[np.float64]
Ints: TypeAlias = npt.NDArray[np.int64]
Shorts: TypeAlias = npt.NDArray[np.int32]
Bools: TypeAlias = npt.NDArray[np.bool_]
Signs: TypeAlias = npt.NDArray[np.int8]
Wholes: TypeAlias = npt.NDArray[np.object_]
"""Whole numbers, however large."""
Fractions: TypeAlias = npt.NDArray[np.object_]
"""Fractions by powers of two: for places that are no doubles."""
Reals: TypeAlias = Floats | Fractions
Complexes: TypeAlias = npt.NDArray[np.complex128]


def read_only(array: npt.NDArray[Scalar]) -> npt.NDArray[Scalar]:
    """Return an array that cannot be written to as it is, and a view of another one, which stays as it was."""
    if array.flags.writeable:
        array = array.view()
        array.setflags(write=False)
    return array


def freeze(value: object) -> None:
    """Make the arrays of a new value read-only, also those in tuples; whoever gave them keeps them as they were.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> given = np.zeros(2)
    >>> value = SimpleNamespace(array=given)
    >>> freeze(value)
    >>> value.array.flags.writeable, given.flags.writeable
    (False, True)
    """
    members = vars(value)
    for name, member in members.items():
        if isinstance(member, np.ndarray):
            members[name] = read_only(member)
        elif isinstance(member, tuple) and any(isinstance(part, np.ndarray) for part in member):
            members[name] = tuple(map(read_only, member))
