"""Small outlines whose loops touch: vertices on edges and vertices, overlapping edges, crossings in one point."""

from hypothesis import strategies as st

import plyfold as pf
from plyfold.errors import CurveError


def touching_outlines(size=4, most=8):
    """One to three loops of few points on a small grid."""
    points = st.tuples(st.integers(0, size), st.integers(0, size))
    loops = st.lists(st.lists(points, min_size=3, max_size=most), min_size=1, max_size=3)
    return loops.filter(are_loops).map(pf.Outline)


def are_loops(loops):
    """Whether each has three points off one line."""
    try:
        pf.Outline(loops)
    except CurveError:
        return False
    return True
