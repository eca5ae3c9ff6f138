"""On which side a point lies, exactly, one at a time; :func:`plyfold.predicates.orient` is for many at once."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from plyfold.arrays import Floats
from plyfold.compiled import called_from_loops

__all__ = ["Places", "as_places", "turn"]

# Twice Shewchuk's bound for orient2d, as in plyfold.predicates.
_ERROR = 6.7e-16
# Below this size a product may have underflowed, and the bound above does not hold.
_UNDERFLOW = 1e-290
_SPLITTER = 2**27 + 1
# Between these sizes no product of two coordinates over- or underflows, nor what rounding takes off it.
_LEAST, _LARGEST = 1e-130, 1e140


def is_within_range(points: Floats) -> bool:
    """Tell whether :func:`turn` is exact for points with such coordinates: zero, or neither tiny nor huge."""
    size = np.abs(points)
    return bool(size.max() < _LARGEST and ((size > _LEAST) | (size == 0)).all())


class Places(NamedTuple):
    """Coordinates of points, as arrays or lists, and room for twelve numbers to calculate with."""

    x: Any
    y: Any
    scratch: Any


def as_places(points: Floats) -> Places:
    """Return points for :func:`turn`, as arrays of doubles if it is exact for those, of fractions otherwise."""
    size = np.abs(points)
    if size.max() < _LARGEST and ((size > _LEAST) | (size == 0)).all():
        x, y = np.ascontiguousarray(points.T)
        return Places(x, y, np.zeros(12))
    largest = Fraction(float(size.max()))
    exact = [[Fraction(number) / largest for number in column] for column in points.T.tolist()]
    return Places(np.array(exact[0]), np.array(exact[1]), np.zeros(12, dtype=object))


@called_from_loops
def turn(places: Places, a: int, b: int, c: int) -> int:
    """Return the sign of the turn at b from a to c: 1 if counter-clockwise, −1 if clockwise, 0 if straight. Exact."""
    x, y = places.x, places.y
    left, right = (x[b] - x[a]) * (y[c] - y[a]), (y[b] - y[a]) * (x[c] - x[a])
    bound = _ERROR * (abs(left) + abs(right)) + _UNDERFLOW
    if left - right > bound:
        return 1
    if right - left > bound:
        return -1
    return _exact_turn(places, a, b, c)


@called_from_loops
def _exact_turn(places: Places, a: int, b: int, c: int) -> int:
    """Add up the six products of the determinant without rounding, as numbers that do not overlap [She97]_.

    References
    ----------
    .. [She97] J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
       Discrete & Computational Geometry 18, 1997.
    """
    x, y, total = places
    size = 0
    for one, other in ((x[a], y[b]), (-y[a], x[b]), (x[b], y[c]), (-y[b], x[c]), (x[c], y[a]), (-y[c], x[a])):
        product = one * other
        size = _add(total, size, _rest_of_product(one, other, product))
        size = _add(total, size, product)
    for place in range(11, -1, -1):
        if total[place] != 0:
            return 1 if total[place] > 0 else -1
    return 0


@called_from_loops
def _rest_of_product(one: float, other: float, product: float) -> float:
    """Return what rounding took off a product (Dekker)."""
    shifted, other_shifted = _SPLITTER * one, _SPLITTER * other
    high, other_high = shifted - (shifted - one), other_shifted - (other_shifted - other)
    low, other_low = one - high, other - other_high
    return low * other_low - (((product - high * other_high) - low * other_high) - high * other_low)


@called_from_loops
def _add(total: Any, size: int, number: float) -> int:
    """Add a number to a sum of ``size`` numbers that do not overlap, the smallest first; return the new size."""
    for place in range(size):
        rounded = number + total[place]
        part = rounded - number
        total[place] = (number - (rounded - part)) + (total[place] - part)
        number = rounded
    total[size] = number
    return size + 1
