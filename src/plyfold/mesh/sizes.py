"""Sizes of triangles that make a mesh, and one that a machine can hold."""

from __future__ import annotations

from math import sqrt

from plyfold.arrays import Floats
from plyfold.errors import InputError
from plyfold.mesh.cells import MOST_TRIANGLES, refuse_max_area
from plyfold.options import refuse_unless_number

__all__ = ["area_of_edge", "refuse_sizes"]

# Of triangles with equal sides to the area allowed: on average, refined ones have 0.6 of that.
_ALLOWED = sqrt(3) / 4 / 0.6


def refuse_sizes(points: Floats, triangles: int, max_area: float | None) -> None:
    """Raise InputError for sizes that make no mesh, or one that no machine can hold."""
    refuse_unless_number("triangles", triangles)
    if not 1 <= triangles <= MOST_TRIANGLES:
        raise InputError(f"the number of triangles must be from 1 to {MOST_TRIANGLES:,}, not {triangles!r}")
    if max_area is not None:
        refuse_unless_number("max_area", max_area)
        refuse_max_area(points, max_area)


def area_of_edge(size: float | None, max_area: float | None) -> float | None:
    """Return the largest area of triangles whose usual edge has the length ``size``, or ``max_area``."""
    if size is None:
        return max_area
    if max_area is not None:
        raise InputError("give the size of triangles by their edges or by their area, not by both")
    refuse_unless_number("size", size)
    if not size > 0:
        raise InputError(f"the usual length of edges must be positive, not {size!r}")
    return _ALLOWED * size * size
