"""Half-edges of triangles, one at a time, and lengths; see ``halfedges``, which has the first two for many at once."""

from __future__ import annotations

from math import sqrt

__all__ = ["distance", "next_side", "previous_side"]


def next_side(side: int) -> int:
    """Return the next half-edge of the same triangle: it starts where the given one ends.

    Examples
    --------
    >>> next_side(4), next_side(5)
    (5, 3)
    """
    return side - 2 if side % 3 == 2 else side + 1


def previous_side(side: int) -> int:
    """Return the half-edge of the same triangle that ends where this one starts.

    Examples
    --------
    >>> previous_side(4), previous_side(3)
    (3, 5)
    """
    return side + 2 if side % 3 == 0 else side - 1


def distance(x: float, y: float) -> float:
    """Return the length of a vector, of which no square over- or underflows; the same on all machines.

    Examples
    --------
    >>> distance(3.0, 4.0)
    5.0
    """
    return sqrt(x * x + y * y)
