"""Curves with fewer points and smoother ones, whose codes stay."""

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.errors import InputError
from reference import crossings as reference
from reference.random_curves import random_polygon, smooth_curve


@st.composite
def curves(draw):
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    if draw(st.booleans()):
        return np.array(random_polygon(rng, draw(st.integers(4, 12))), dtype=float), 2000.0
    points = np.array(smooth_curve(rng, 3, 30), dtype=float)
    return points + rng.normal(0, 2000, points.shape), 100_000.0


def code(points):
    """The crossings by the slow reference: of each visit its partner, and from which side it is crossed."""
    found = reference.crossings(points.tolist())
    return list(found.code.partner), list(found.code.ccw)


def is_general(points):
    return not reference.touching(reference.exact(points.tolist()))


@settings(deadline=None, max_examples=15)
@given(curves(), st.floats(0.0001, 0.3))
@example((np.array([(453.0, 887), (763, 23), (881, 953), (941, -839)]), 2000.0), 0.25)  # two points are no curve
def test_a_simplified_curve_has_the_same_code_and_is_near(drawn, share):
    points, size = drawn
    assume(is_general(points))
    simple = pf.Curve(points).simplified(share * size, keep_code=True)
    assert simple.points[0].tolist() == points[0].tolist()
    rows = [points.tolist().index(point) for point in simple.points.tolist()]
    assert rows == sorted(rows)
    for start, end in zip(rows, [*rows[1:], len(points)], strict=True):
        edge = shapely.LineString([points[start], points[end % len(points)]])
        assert shapely.distance(edge, shapely.points(points[start:end])).max() <= share * size * (1 + 1e-9)
    assert code(simple.points) == code(points)


@settings(deadline=None, max_examples=15)
@given(curves(), st.integers(1, 8))
def test_a_smoothed_curve_has_the_same_code(drawn, rounds):
    points, _ = drawn
    assume(is_general(points))
    smooth = pf.Curve(points).smoothed(rounds, keep_code=True)
    assert len(smooth) == len(points)
    assume(is_general(smooth.points))
    assert code(smooth.points) == code(points)


def trembling_limacon():
    t = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    radius = 1 + 2 * np.cos(t) + np.random.default_rng(1).normal(0, 0.01, 300)
    return np.stack([radius * np.cos(t), radius * np.sin(t)], axis=1)


def test_most_points_go_and_the_shape_gets_smoother():
    curve = pf.Curve(trembling_limacon())
    simple = curve.simplified(0.05, keep_code=True)
    assert len(simple) < 40
    rough, smooth = (
        np.hypot(*np.diff(drawn.points, 2, axis=0).T).mean() for drawn in (curve, curve.smoothed(5, keep_code=True))
    )
    assert smooth < rough / 3


def test_without_the_promise_small_lobes_are_lost():
    loop = pf.Curve([(0, 0), (10, 0), (10.4, 0.3), (10, 0.4), (10.2, -0.5), (20, 0), (20, 10), (0, 10)])
    assert pf.arrange(loop).n_crossings > 0
    assert pf.arrange(loop.simplified(1)).n_crossings == 0
    assert pf.arrange(loop.smoothed(4)).n_crossings == 0
    for kept in (loop.simplified(1, keep_code=True), loop.smoothed(4, keep_code=True)):
        assert pf.arrange(kept).gauss_code()[:2] == pf.arrange(loop).gauss_code()[:2]


def test_cusps_stay_where_they_are():
    curve = pf.Curve(trembling_limacon(), cusps={77: 1})
    for tidied in (curve.simplified(0.2, keep_code=True), curve.smoothed(3, keep_code=True), curve.smoothed(3)):
        [cusp] = np.flatnonzero(tidied.cusps[0])
        assert tidied.points[cusp].tolist() == curve.points[77].tolist()


def test_a_curve_is_never_simplified_away():
    triangle = pf.Curve([(0, 0), (1, 0), (2, 0), (1, 1)])
    assert len(triangle.simplified(100)) >= 3
    twice = pf.Curve([(0, 0), (4, 0), (4, 4), (0, 0), (-4, 0), (-4, -4)])
    assert len(twice.simplified(100)) >= 3


def test_several_loops_are_tidied_one_by_one():
    inner = pf.Curve(0.2 * trembling_limacon()[::-1] + (1, 0), cusps={3: 1})
    outline = pf.Outline([trembling_limacon(), inner])
    for tidied in (lambda drawn: drawn.simplified(0.05), lambda drawn: drawn.smoothed(4)):
        each = [tidied(curve) for curve in outline.curves]
        together = tidied(outline)
        assert [loop.tolist() for loop in together.loops] == [curve.points.tolist() for curve in each]
        assert [index.tolist() for index in together.cusps] == [curve.cusps[0].tolist() for curve in each]
        assert together.cusps[1].sum() == 1
    for call in (lambda: outline.simplified(0.05, keep_code=True), lambda: outline.smoothed(keep_code=True)):
        with pytest.raises(InputError, match="keeps the code of one loop, and this outline has 2"):
            call()
    alone = pf.Outline([trembling_limacon()])
    assert (
        alone.smoothed(2, keep_code=True).points.tolist() == alone.curves[0].smoothed(2, keep_code=True).points.tolist()
    )


def test_smoothing_ends_where_nothing_moves_any_more():
    """Between two cusps, the other points end up evenly on the way from one to the other."""
    curve = pf.Curve([(0, 0), (8, 0), (8, 8), (0, 8), (-9, 3)], cusps={0: 1, 2: 1, 3: 1})
    fixed = curve.smoothed(9_999)
    assert fixed.points.tolist() == fixed.smoothed(1).points.tolist()
    assert np.allclose(fixed.points, [(0, 0), (4, 4), (8, 8), (0, 8), (0, 4)])
    with pytest.raises(InputError, match="rounds must be a whole number from 1 to 10,000"):
        curve.smoothed(10**6)


def test_options_that_are_none_are_refused():
    curve = pf.Curve([(0, 0), (4, 0), (0, 4)])
    for call in (lambda: curve.simplified(-1), lambda: curve.simplified("much"), lambda: curve.smoothed(0)):
        with pytest.raises(InputError):
            call()
    with pytest.raises(InputError, match="keep_code"):
        curve.simplified(1, keep_code="yes")
