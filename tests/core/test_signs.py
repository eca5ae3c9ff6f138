"""Signs of cross products against fractions, at places where rounding tells nothing."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plyfold.core.signs import exact_sign, quick_sign

NEAR_ONE = st.builds(lambda units: 1 + units * 2.0**-52, st.integers(-4, 4))
WILD = st.floats(allow_nan=False, allow_infinity=False)
NUMBERS = st.one_of(NEAR_ONE, WILD, st.integers(-5, 5).map(float))


def sign_in_fractions(*numbers):
    ax, ay, bx, by, cx, cy, dx, dy = map(Fraction, numbers)
    product = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    return (product > 0) - (product < 0)


@settings(max_examples=1000)
@given(st.tuples(*[NUMBERS] * 8))
def test_signs_are_exact(numbers):
    expected = sign_in_fractions(*numbers)
    assert exact_sign(*numbers) == expected
    assert quick_sign(*numbers) in (expected, 2)


@settings(max_examples=1000)
@given(*[NEAR_ONE] * 4)
def test_products_are_not_fused_with_differences(a, b, c, d):
    """Determinants a·d − b·c of numbers near 1: a fused product would round but one of the two."""
    assert quick_sign(0.0, 0.0, a, b, 0.0, 0.0, c, d) == sign_in_fractions(0, 0, a, b, 0, 0, c, d)


@pytest.mark.parametrize(
    "numbers",
    [
        (0.1, 0.1, 0.7, 0.7, 0.1, 0.1, 1e9, 1e9),
        (0.0, 0.0, 1e-200, 1e-200, 0.0, 0.0, 1e-200, 1e-200),
        (-1e308, 0.0, 1e308, 1.0, 0.0, 0.0, 1e308, 1.0),
    ],
)
def test_what_takes_fractions_is_left_open(numbers):
    assert quick_sign(*numbers) == 2
    assert exact_sign(*numbers) == sign_in_fractions(*numbers)
