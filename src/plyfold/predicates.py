"""Exact signs: on which side of a line a point lies; and exact places of crossings.

Coordinates are doubles, and doubles are rational numbers, so every sign below has an exact value. It is computed in
floating point with a bound on the rounding error; where the bound does not decide, it is computed again without
rounding, in pairs of doubles or with :class:`fractions.Fraction`. Nothing here depends on the scale of the drawing.

Places that are no doubles, for they lie infinitely close to each other, may come as arrays of fractions, the first one
of those that a function takes among them: then all is calculated in whole numbers, a hundred times as slowly.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Floats, Ints, Reals, Signs, Wholes

__all__ = [
    "Place",
    "counted_cross_sign",
    "cross_sign",
    "crossing_bounds",
    "exact_cross",
    "exact_crossings",
    "exact_parameter",
    "orient",
    "parameter_along_edge",
    "signs_of",
    "whole_numbers",
]


Place: TypeAlias = tuple[Fraction, Fraction]
"""A point, exactly."""

# Shewchuk's bound for orient2d is (3 + 16 u) u with u = 2^-53; doubled here, which costs a few exact calls more.
_ORIENT_ERROR = 6.7e-16
# Below this size a product of two differences may have underflowed, and the bound above does not hold.
_UNDERFLOW = 1e-290
# Products of smaller directions are too near to that to tell much.
_TINY_PRODUCT = 1e-250
# Between these sizes nothing in Dekker's product of two doubles under- or overflows.
_SMALL_PRODUCT, _LARGE_PRODUCT = 1e-250, 1e250
_SPLITTER = 2**27 + 1
# The parameter of a crossing is a quotient of two sums, each within 8 u of its magnitude.
_PARAMETER_ERROR = 4e-15
# A place on an edge takes a difference, a product and a sum more, and its bounds one each; these are some 9 u.
_PLACE_ERROR = 1e-15


def orient(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike) -> Signs:
    """Tell on which side of the line through a and b the point c lies.

    Parameters
    ----------
    a, b, c : array_like, shape (..., 2)
        Points, broadcast against each other.

    Returns
    -------
    ndarray of int8, shape (...)
        +1 if a, b, c turn counter-clockwise (c is left of a → b), −1 if clockwise, 0 if they are on one line. Exact.

    Notes
    -----
    Linear in the number of triples; about 1e7 triples a second where the floating-point filter decides.

    Examples
    --------
    >>> orient([0, 0], [1, 0], [[0, 1], [5, 0], [0, -1]])
    array([ 1,  0, -1], dtype=int8)
    """
    return cross_sign(a, b, a, c)


def _sign(number: Fraction) -> int:
    return (number > 0) - (number < 0)


def cross_sign(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike) -> Signs:
    """Return the sign of the cross product of the directions a → b and c → d.

    Parameters
    ----------
    a, b, c, d : array_like, shape (..., 2)
        Points, broadcast against each other.

    Returns
    -------
    ndarray of int8, shape (...)
        +1 if c → d points to the left of a → b, −1 if to the right, 0 if they are parallel. Exact.

    Examples
    --------
    >>> cross_sign([0, 0], [1, 0], [7, 7], [7, 8])
    array(1, dtype=int8)
    """
    return counted_cross_sign(a, b, c, d)[0]


def counted_cross_sign(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike) -> tuple[Signs, int]:
    """Return the signs of :func:`cross_sign`, and how many of them had to be settled with fractions.

    Parameters
    ----------
    a, b, c, d : array_like, shape (..., 2)
        Points, broadcast against each other: doubles, or fractions by powers of two.

    Returns
    -------
    signs : ndarray of int8, shape (...)
    count : int

    Notes
    -----
    Three stages, each for what the one before leaves open: one rounded determinant with a bound on its error; the two
    products compared without rounding, where the differences are exact, as on grids and between close points
    [She97]_; fractions, at some microseconds each.

    References
    ----------
    .. [She97] J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
       Discrete & Computational Geometry 18, 1997.

    Examples
    --------
    >>> counted_cross_sign([0, 0], [[1, 3], [0.1, 0.1]], [0, 0], [[1, 3], [1e20, 1e20]])
    (array([0, 0], dtype=int8), 0)
    >>> counted_cross_sign([0.1, 0.1], [0.7, 0.7], [0.1, 0.1], [1e9, 1e9])
    (array(0, dtype=int8), 1)
    """
    places = [np.asarray(place) for place in (a, b, c, d)]
    if any(place.dtype.hasobject for place in places):
        return _whole_cross_sign(*places)
    a, b, c, d = (place.astype(np.float64, copy=False) for place in places)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        along, across = b - a, d - c
        left = np.asarray(along[..., 0] * across[..., 1])
        right = np.asarray(along[..., 1] * across[..., 0])
        determinant = left - right
        bound = _ORIENT_ERROR * (np.abs(left) + np.abs(right)) + _UNDERFLOW
        # Written so that NaN and infinity, the marks of overflow, count as undecided.
        undecided = np.asarray(~(np.abs(determinant) > bound))
        signs = np.asarray(np.sign(determinant)).astype(np.int8)
    if not undecided.any():
        return signs, 0
    open_rows = (np.broadcast_to(p, (*signs.shape, 2))[undecided] for p in (a, b, c, d))
    signs[undecided], count = _settle(*open_rows)
    return signs, count


def _whole_cross_sign(*places: Reals) -> tuple[Signs, int]:
    """Return the same of fractions, or of some doubles and some fractions."""
    a, b, c, d = (whole_numbers(place) for place in places)
    along, across = _difference(a, b), _difference(c, d)
    signs = signs_of(along[..., 0] * across[..., 1] - along[..., 1] * across[..., 0])
    return signs, signs.size


def _difference(one: tuple[Wholes, Fraction], other: tuple[Wholes, Fraction]) -> Wholes:
    """Return other − one, in whole numbers of the smaller of their units, which are powers of two."""
    unit = min(one[1], other[1])
    start, end = (numbers * int(scale / unit) for numbers, scale in (one, other))
    return np.asarray(end - start)


def signs_of(numbers: Wholes) -> Signs:
    """Return the signs of whole numbers, however large, or of fractions."""
    return np.asarray(np.asarray(numbers > 0).astype(np.int8) - np.asarray(numbers < 0).astype(np.int8))


def _settle(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Signs, int]:
    """Return the signs of the cross products of (m, 2) points beyond rounding, and how many took fractions."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        left, left_rest, left_exact = _exact_product(a[:, 0], b[:, 0], c[:, 1], d[:, 1])
        right, right_rest, right_exact = _exact_product(a[:, 1], b[:, 1], c[:, 0], d[:, 0])
        # Rounding is monotone: products that round to different numbers differ in the same sense.
        signs = np.where(left == right, np.sign(left_rest - right_rest), np.sign(left - right)).astype(np.int8)
    unsettled = np.flatnonzero(~(left_exact & right_exact)).tolist()
    for row in unsettled:
        signs[row] = _sign(exact_cross(*(_exact(p[row]) for p in (a, b, c, d))))
    return signs, len(unsettled)


def _exact_product(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Floats, Floats, Bools]:
    """Return (b − a)(d − c) as a rounded product and the rest that rounding took off, and where they are exact.

    Dekker's product; its rest is exact unless something over- or underflows.
    """
    first, second = b - a, d - c
    product = first * second
    rest = _rest_of_product(first, second, product)
    zero = (first == 0) | (second == 0)
    size = np.abs(product)
    safe = (size > _SMALL_PRODUCT) & (size < _LARGE_PRODUCT) & np.isfinite(rest)
    exact = zero | (safe & _is_exact_difference(a, b, first) & _is_exact_difference(c, d, second))
    return np.where(zero, 0.0, product), np.where(zero, 0.0, rest), exact


def _rest_of_product(one: Floats, other: Floats, product: Floats) -> Floats:
    """Return what rounding took off a product (Dekker).

    Both numbers are split into two of 26 bits each, whose products are exact (Veltkamp).
    """
    shifted, other_shifted = _SPLITTER * one, _SPLITTER * other
    high, other_high = shifted - (shifted - one), other_shifted - (other_shifted - other)
    low, other_low = one - high, other - other_high
    return low * other_low - (((product - high * other_high) - low * other_high) - high * other_low)


def _is_exact_difference(a: Floats, b: Floats, difference: Floats) -> Bools:
    """Tell where b − a was not rounded (the error term of Knuth's two-sum is zero)."""
    minus_a = difference - b
    return np.asarray((b - (difference - minus_a)) - (a + minus_a) == 0)


def _exact(point: Reals) -> Place:
    x, y = point.tolist()
    return Fraction(x), Fraction(y)


def exact_cross(a: Place, b: Place, c: Place, d: Place) -> Fraction:
    """Return the cross product of the directions a → b and c → d."""
    return (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])


def parameter_along_edge(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Floats, Floats]:
    """Return where the edges a → b cross the edges c → d, as a fraction of a → b, with a bound on its error.

    All four have shape (m, 2); each pair of edges is known to cross.
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        ab, cd, ac = b - a, d - c, c - a
        (above, above_size), (below, below_size) = _crossed(ac, cd), _crossed(ab, cd)
        if len(tiny := np.flatnonzero(below_size < _TINY_PRODUCT)):
            along, across = _exponents(ab[tiny]), _exponents(cd[tiny])
            ab, cd, ac = np.ldexp(ab[tiny], along), np.ldexp(cd[tiny], across), np.ldexp(ac[tiny], along)
            (above[tiny], above_size[tiny]), (below[tiny], below_size[tiny]) = _crossed(ac, cd), _crossed(ab, cd)
        error = _PARAMETER_ERROR * (above_size + 2 * below_size) / np.abs(below)
        parameter = np.minimum(np.maximum(above / below, 0.0), 1.0)
    known = np.isfinite(error) & np.isfinite(parameter)
    return np.where(known, parameter, 0.5), np.where(known, error, np.inf)


def _exponents(directions: Floats) -> Ints:
    """Return the powers of two that make directions, shape (m, 2), as long as one or so."""
    return np.asarray(-np.frexp(np.abs(directions).max(axis=1, keepdims=True))[1], dtype=np.int64)


def _crossed(one: Floats, other: Floats) -> tuple[Floats, Floats]:
    """Return the cross products of directions, shape (m, 2), and how large the products are that they are made of."""
    left, right = one[:, 0] * other[:, 1], one[:, 1] * other[:, 0]
    return left - right, np.abs(left) + np.abs(right) + _UNDERFLOW


def exact_parameter(a: Reals, b: Reals, c: Reals, d: Reals) -> Fraction:
    """Return where the edge a → b crosses the edge c → d, as an exact fraction of a → b."""
    p, q, r, s = map(_exact, (a, b, c, d))
    return exact_cross(p, r, r, s) / exact_cross(p, q, r, s)


def crossing_bounds(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Floats, Floats]:
    """Return the lower left and the upper right corner of a box in which each edge a → b crosses its edge c → d.

    All have shape (m, 2); each pair of edges is known to cross. The box is as small as rounding allows, and as narrow
    or as flat as an edge that is upright or level.
    """
    parameter, error = parameter_along_edge(a, b, c, d)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        along = b - a
        place = a + parameter[:, None] * along
        reach = (error[:, None] + _PLACE_ERROR) * np.abs(along) + _PLACE_ERROR * np.abs(place) + _UNDERFLOW
        # What overflowed is not a number, and leaves the choice to the ends of the edges.
        low = np.fmax(np.maximum(np.minimum(a, b), np.minimum(c, d)), place - reach)
        high = np.fmin(np.minimum(np.maximum(a, b), np.maximum(c, d)), place + reach)
    return low, high


def exact_crossings(ends: Reals, axis: int) -> list[Fraction]:
    """Return one exact coordinate of the places where the edges a → b cross the edges c → d; ``ends`` are (4, m, 2).

    In whole numbers of one unit up to the last step, which takes a tenth of the time that fractions would.

    Examples
    --------
    >>> exact_crossings(np.array([[[0.0, 0.0]], [[3.0, 1.0]], [[0.5, 0.0]], [[0.5, 9.0]]]), axis=1)
    [Fraction(1, 6)]
    """
    (p, q, r, s), unit = whole_numbers(ends)
    along, across, between = q - p, s - r, r - p
    below = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]
    above = between[:, 0] * across[:, 1] - between[:, 1] * across[:, 0]
    numerator = p[:, axis] * below + above * along[:, axis]
    return [Fraction(n, m) * unit for n, m in zip(numerator.tolist(), below.tolist(), strict=True)]


def whole_numbers(numbers: Reals) -> tuple[Wholes, Fraction]:
    """Return doubles, or fractions by powers of two, as whole numbers, however large, of a power of two.

    Examples
    --------
    >>> whole_numbers(np.array([1.5, Fraction(1, 8)], dtype=object))
    (array([12, 1], dtype=object), Fraction(1, 8))
    """
    if numbers.dtype == object:
        ratios = [number.as_integer_ratio() for number in numbers.ravel().tolist()]
        least = max((below for _, below in ratios), default=1)
        whole = np.array([above * (least // below) for above, below in ratios], dtype=object)
        return whole.reshape(numbers.shape), Fraction(1, least)
    mantissa, exponent = np.frexp(numbers)
    least = int(exponent.min(initial=0))
    doubled = np.ldexp(mantissa, 53).astype(np.int64).astype(object)
    return doubled << (exponent - least).astype(object), Fraction(2) ** (least - 53)
