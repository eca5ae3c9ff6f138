"""Which way one turns at a point, exactly, for loops: what ``predicates.orient`` tells of many at once."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from plyfold.arrays import Reals
from plyfold.core.buffers import RealBuffer, flat, real_room
from plyfold.core.signs import quick_sign, rest_of_product, sign_of_fractions
from plyfold.predicates import exact_cross

__all__ = ["ExactPoints", "points_for_turns", "turn"]

# Between these sizes no product of two coordinates over- or underflows, nor what rounding takes off it.
_LEAST, _LARGEST = 1e-130, 1e140


class ExactPoints:
    """Points, and where doubles do not show them all, their exact places.

    Parameters
    ----------
    places : buffer of 2n float
        The coordinates, point after point.
    exact : list of 2n Fraction, optional
        The same, if these are what counts.
    """

    scratch: RealBuffer

    def __init__(self, places: RealBuffer, exact: list[Fraction] | None = None) -> None:
        self.places, self.exact = places, exact
        self.has_scratch = False


def points_for_turns(places: Reals) -> ExactPoints:
    """Return places, shape (n, 2), for turns: if they are doubles, as they are."""
    if places.dtype != object:
        return ExactPoints(flat(places))
    return ExactPoints(flat(places.astype(np.float64)), list(map(Fraction, places.ravel().tolist())))


def turn(points: ExactPoints, a: int, b: int, c: int) -> int:
    """Return the sign of the turn at b from a to c: 1 if counter-clockwise, −1 if clockwise, 0 if straight. Exact.

    Examples
    --------
    >>> from array import array
    >>> turn(ExactPoints(array("d", [0, 0, 1, 0, 1, 1])), 0, 1, 2)
    1
    """
    if points.exact is not None:
        return _turn_of_fractions(points.exact, a, b, c)
    ax, ay = points.places[2 * a], points.places[2 * a + 1]
    bx, by = points.places[2 * b], points.places[2 * b + 1]
    cx, cy = points.places[2 * c], points.places[2 * c + 1]
    sign = quick_sign(ax, ay, bx, by, ax, ay, cx, cy)
    if sign <= 1:
        return sign
    if not (_is_moderate(ax, ay) and _is_moderate(bx, by) and _is_moderate(cx, cy)):
        return sign_of_fractions(ax, ay, bx, by, ax, ay, cx, cy)
    return _exact_turn(points, ax, ay, bx, by, cx, cy)


def _turn_of_fractions(exact: list[Fraction], a: int, b: int, c: int) -> int:
    """Return the turn at exact places."""
    p, q, r = ((exact[2 * point], exact[2 * point + 1]) for point in (a, b, c))
    product = exact_cross(p, q, p, r)
    return (product > 0) - (product < 0)


def _is_moderate(x: float, y: float) -> bool:
    """Tell whether products of coordinates can be taken apart."""
    x, y = abs(x), abs(y)
    return x < _LARGEST and y < _LARGEST and (x > _LEAST or x == 0.0) and (y > _LEAST or y == 0.0)


def _exact_turn(points: ExactPoints, ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> int:
    """Add up the six products of the determinant without rounding, as numbers that do not overlap [She97]_.

    References
    ----------
    .. [She97] J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
       Discrete & Computational Geometry 18, 1997.
    """
    if not points.has_scratch:
        points.scratch, points.has_scratch = real_room(12), True
    _add_product(points, 0, ax, by)
    _add_product(points, 2, -ay, bx)
    _add_product(points, 4, bx, cy)
    _add_product(points, 6, -by, cx)
    _add_product(points, 8, cx, ay)
    _add_product(points, 10, -cy, ax)
    for place in range(11, -1, -1):
        if points.scratch[place] != 0.0:
            return 1 if points.scratch[place] > 0.0 else -1
    return 0


def _add_product(points: ExactPoints, size: int, one: float, other: float) -> None:
    """Add a product to a sum of so many numbers: what rounding takes off it first."""
    _add_exactly(points, size, rest_of_product(one, other))
    _add_exactly(points, size + 1, one * other)


def _add_exactly(points: ExactPoints, size: int, number: float) -> None:
    """Add a number to a sum of so many numbers that do not overlap, the smallest first."""
    for place in range(size):
        term = points.scratch[place]
        rounded = number + term
        part = rounded - number
        points.scratch[place] = (number - (rounded - part)) + (term - part)
        number = rounded
    points.scratch[size] = number
