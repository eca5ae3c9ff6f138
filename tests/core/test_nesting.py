"""Shares along edges to the nearest double, and rays between more loops than one leaf of the tree of boxes holds."""

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement.polylines import total_winding
from plyfold.core.nesting import share_along

numbers = st.floats(-1e9, 1e9)


@given(numbers, numbers, st.floats(0, 1))
def test_shares_are_rounded_once(start, end, share):
    between = start + share * (end - start)
    if start != end:
        expected = float((Fraction(between) - Fraction(start)) / (Fraction(end) - Fraction(start)))
        assert share_along(start, end, between) == expected


def polygons_in_boxes(rng, low, size, depth):
    """Polygons inside each other and beside each other, most of which do not meet."""
    angle = np.sort(rng.random(int(rng.integers(5, 40)))) * 2 * np.pi
    yield low + size / 2 * (1 + rng.uniform(0.9, 1, (len(angle), 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    for corner in np.ndindex(2, 2) if depth else ():
        yield from polygons_in_boxes(rng, low + size * (0.36 + 0.14 * np.array(corner)), size * 0.12, depth - 1)


def test_loops_inside_many_loops_have_their_winding_numbers():
    rng = np.random.default_rng(15)
    loops = [loop for place in range(2) for loop in polygons_in_boxes(rng, np.array([2.0 * place, 0.1]), 1.5, 2)]
    found = pf.arrange([loop[::-1] if rng.random() < 0.3 else loop for loop in loops])
    found.check()
    assert found.n_loops == 42
    for cell in range(found.n_cells):
        assert total_winding(found.outline.loops, found.cell_point(cell)) == found.winding[cell]
