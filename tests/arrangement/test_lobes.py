"""Turning numbers of the lobes at crossings, against the exterior angles of the lobes as polygons."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.arrangement.lobes import lobe_turning_numbers
from reference.crossings import crossings, turning_number
from reference.random_curves import SEVERAL_IMMERSIONS, random_polygon, ribbon_outline, smooth_curve


def lobes_as_polygons(polygon):
    """For each crossing the lobe from its first visit to its second and the rest, as polygons in exact fractions."""
    drawn = crossings(polygon)
    n = len(polygon)
    for first, second in enumerate(drawn.code.partner):
        if first < second:
            start, end = drawn.edges[first], drawn.edges[second]
            inside = [polygon[(start + 1 + i) % n] for i in range(end - start)]
            outside = [polygon[(end + 1 + i) % n] for i in range(n - end + start)]
            yield [drawn.points[first], *inside], [drawn.points[first], *outside]


def check(polygon):
    drawn = pf.arrange(polygon, "raise")
    walked = [tuple(point) for point in drawn.curve.points.tolist()]
    expected = [[turning_number(lobe) for lobe in pair] for pair in lobes_as_polygons(walked)]
    found = lobe_turning_numbers(drawn)
    assert found.tolist() == expected
    assert (found.sum(axis=1) == drawn.turning_number).all()


@pytest.mark.parametrize("polygon", [polygon for polygon, *_ in SEVERAL_IMMERSIONS])
def test_known_curves(polygon):
    check(polygon)


@pytest.mark.parametrize("seed", range(20))
def test_random_curves(seed):
    rng = np.random.default_rng(seed)
    check(random_polygon(rng, int(rng.integers(4, 14))))
    check(smooth_curve(rng, int(rng.integers(2, 5)), samples=30))


def test_ribbon():
    check(ribbon_outline(np.random.default_rng(3), 40))


def test_code_without_a_drawing():
    drawn = pf.arrange(ribbon_outline(np.random.default_rng(3), 60))
    code = pf.Arrangement.from_gauss(*drawn.gauss_code())
    assert np.array_equal(lobe_turning_numbers(code), lobe_turning_numbers(drawn))


def test_circle_has_no_lobes():
    assert lobe_turning_numbers([(0, 0), (1, 0), (0, 1)]).shape == (0, 2)
