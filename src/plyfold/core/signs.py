"""The sign of a cross product, exactly, one at a time: what ``predicates.cross_sign`` tells of many at once."""

from __future__ import annotations

__all__ = ["exact_sign", "quick_sign", "rest_of_difference", "rest_of_product", "sign_of_fractions"]

# What is neither sign, nor zero: it takes fractions to tell.
_OPEN = 2

# See `predicates`, which has the same bounds.
_ORIENT_ERROR = 6.7e-16
_UNDERFLOW = 1e-290
_SMALL_PRODUCT = 1e-250
_LARGE_PRODUCT = 1e250
_SPLITTER = 134217729.0


def quick_sign(ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float) -> int:
    """Return the sign of the cross product of a → b and c → d, or 2 where it takes fractions to tell.

    Examples
    --------
    >>> quick_sign(0.0, 0.0, 1.0, 0.0, 7.0, 7.0, 7.0, 8.0), quick_sign(0.1, 0.1, 0.7, 0.7, 0.1, 0.1, 1e9, 1e9)
    (1, 2)
    """
    left, right = (bx - ax) * (dy - cy), (by - ay) * (dx - cx)
    bound = _ORIENT_ERROR * (abs(left) + abs(right)) + _UNDERFLOW
    if left - right > bound:
        return 1
    if right - left > bound:
        return -1
    return _sign_of_products(ax, ay, bx, by, cx, cy, dx, dy)


def exact_sign(ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float) -> int:
    """Return the sign of the cross product of a → b and c → d.

    Examples
    --------
    >>> exact_sign(0.1, 0.1, 0.7, 0.7, 0.1, 0.1, 1e9, 1e9)
    0
    """
    sign = quick_sign(ax, ay, bx, by, cx, cy, dx, dy)
    return sign_of_fractions(ax, ay, bx, by, cx, cy, dx, dy) if sign == _OPEN else sign


def sign_of_fractions(ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float) -> int:
    """Return the sign of the cross product of a → b and c → d, at some microseconds."""
    # Most drawings never need them, and importing them takes longer than deciding a small drawing.
    from fractions import Fraction

    from plyfold.predicates import exact_cross

    a, b = (Fraction(ax), Fraction(ay)), (Fraction(bx), Fraction(by))
    c, d = (Fraction(cx), Fraction(cy)), (Fraction(dx), Fraction(dy))
    product = exact_cross(a, b, c, d)
    return (product > 0) - (product < 0)


def _sign_of_products(ax: float, ay: float, bx: float, by: float, cx: float, cy: float, dx: float, dy: float) -> int:
    """Compare the two products without rounding, where the differences are exact: on grids and between close points."""
    if not (_is_exact_product(ax, bx, cy, dy) and _is_exact_product(ay, by, cx, dx)):
        return _OPEN
    left, right = _product(bx - ax, dy - cy), _product(by - ay, dx - cx)
    # Rounding is monotone: products that round to different numbers differ in the same sense.
    if left != right:
        return 1 if left > right else -1
    left_rest, right_rest = rest_of_product(bx - ax, dy - cy), rest_of_product(by - ay, dx - cx)
    return 1 if left_rest > right_rest else -1 if left_rest < right_rest else 0


def _is_exact_product(a: float, b: float, c: float, d: float) -> bool:
    """Tell whether (b − a)(d − c) is the sum of two doubles, its product and its rest."""
    if a == b or c == d:
        return True
    size, rest = abs(_product(b - a, d - c)), rest_of_product(b - a, d - c)
    is_safe = _SMALL_PRODUCT < size < _LARGE_PRODUCT and rest - rest == 0.0
    return is_safe and rest_of_difference(a, b) == 0.0 == rest_of_difference(c, d)


def rest_of_difference(a: float, b: float) -> float:
    """Return what rounding takes off b − a (the error term of Knuth's two-sum)."""
    difference = b - a
    minus_a = difference - b
    return (b - (difference - minus_a)) - (a + minus_a)


def _product(one: float, other: float) -> float:
    """Return a product, 0 of zero and of what overflowed."""
    return 0.0 if one == 0.0 or other == 0.0 else one * other


def rest_of_product(one: float, other: float) -> float:
    """Return what rounding takes off a product (Dekker); both numbers are split into two of 26 bits (Veltkamp)."""
    if one == 0.0 or other == 0.0:
        return 0.0
    shifted, other_shifted = _SPLITTER * one, _SPLITTER * other
    high, other_high = shifted - (shifted - one), other_shifted - (other_shifted - other)
    low, other_low = one - high, other - other_high
    return low * other_low - (((one * other - high * other_high) - low * other_high) - high * other_low)
