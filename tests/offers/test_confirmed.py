"""A repaired outline that covers another area than was said, or not as often, is refused."""

from fractions import Fraction

import pytest

import plyfold as pf
from plyfold.errors import PrecisionError
from plyfold.offers.confirmed import confirm
from plyfold.offers.rerouted import Rerouted, plan_of

EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]


@pytest.mark.parametrize("power", [-300, 0, 300])
def test_another_area(power):
    scale = 2.0**power
    left = Rerouted.of(plan_of(pf.arrange([(x * scale, y * scale) for x, y in EIGHT])))
    confirm(left, left.plan.drawn, Fraction(0), ((0, 0),))
    for other in ([(0, 0), (2, 2), (2, 0), (0, 2.001)], [(0, 0), (2, 2), (0, 1)]):
        drawn = pf.arrange([(x * scale, y * scale) for x, y in other])
        with pytest.raises(PrecisionError, match="is not what it was to change") as caught:
            confirm(left, drawn, Fraction(0), ((0, 0),))
        assert caught.value.where
