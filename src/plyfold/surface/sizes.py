"""Sizes of triangles that make a mesh, and one that a machine can hold."""

from __future__ import annotations

from plyfold.arrays import Floats
from plyfold.errors import InputError
from plyfold.flat.cells import MOST_TRIANGLES, refuse_max_area

__all__ = ["refuse_sizes"]


def refuse_sizes(points: Floats, triangles: int, max_area: float | None) -> None:
    """Raise InputError for sizes that make no mesh, or one that no machine can hold."""
    if not 1 <= triangles <= MOST_TRIANGLES:
        raise InputError(f"the number of triangles must be from 1 to {MOST_TRIANGLES:,}, not {triangles!r}")
    if max_area is not None:
        refuse_max_area(points, max_area)
