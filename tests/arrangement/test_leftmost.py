"""The base visit is exactly at the leftmost crossing, the lowest of several, at every place and scale."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import plyfold as pf
from reference import crossings as reference


def both(points):
    """The base visit that is found, and the one in fractions, of a curve in general position."""
    try:
        drawn = pf.arrange(points, general_position="raise")
    except pf.errors.PlyfoldError:
        assume(False)
    return drawn.base_visit, reference.base_visit(drawn.curve.points)


SMALL_GRID = st.lists(st.tuples(st.integers(-6, 6), st.integers(-6, 6)), min_size=5, max_size=12, unique=True)


@settings(max_examples=150, deadline=None)
@given(SMALL_GRID, st.sampled_from([1.0, 1e-160, 1e150, 0.1]), st.sampled_from([0.0, 2.0**50]))
def test_is_the_reference_where_many_crossings_lie_above_each_other(points, scale, shift):
    found, expected = both(np.array(points, dtype=float) * scale + shift * scale)
    assert found == expected


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 2**32))
def test_is_the_reference_on_random_polygons(seed):
    rng = np.random.default_rng(seed)
    found, expected = both(rng.normal(size=(10, 2)) * 10.0 ** rng.integers(-3, 4, (10, 1)))
    assert found == expected


def tower(storeys, moved, to_right):
    """A zigzag up and one down that cross once on each storey, straight above each other.

    One vertex is moved by one rounding.
    """
    up = [(3.0 if storey % 2 else -3.0, 8.0 * storey) for storey in range(storeys + 1)]
    points = np.array(up + [(-x, y) for x, y in reversed(up)])
    points[moved, 0] = np.nextafter(points[moved, 0], np.inf if to_right else -np.inf)
    return np.concatenate([points, [(50.0, 4.0 * storeys)]])


@pytest.mark.parametrize("moved", [0, 1, 4, 9])
@pytest.mark.parametrize("to_right", [True, False])
def test_of_crossings_nearer_than_rounding_the_leftmost(moved, to_right):
    found, expected = both(tower(10, moved, to_right))
    assert found == expected


def test_of_strands_across_an_upright_edge_the_lowest():
    comb = [(x, y) for y in range(0, 40, 4) for x, y in ((9, y), (-1, y + 1), (-1, y + 3), (9, y + 4))]
    found, expected = both(np.array([*comb, (20, 42), (0, 50), (0, -5), (20, -5)], dtype=float))
    assert found == expected
