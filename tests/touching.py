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


@st.composite
def grown_outlines(draw):
    """Outlines of disks grown from a square: squares on edges outside, or at the ends of necks and pinches."""
    outline = [(0, 0), (2, 0), (2, 2), (0, 2)]
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(outline) - 1))
        outline[at + 1 : at + 1] = draw(st.sampled_from([_square_on_edge, _square_at_vertex]))(draw, outline, at)
    return outline


def _square_on_edge(draw, outline, at):
    """Return the points of a square, or of a part of one, on the right of an edge."""
    (x, y), (u, v) = outline[at], outline[(at + 1) % len(outline)]
    out = (v - y, x - u)
    return [(x + out[0], y + out[1]), (u + out[0], v + out[1])]


def _square_at_vertex(draw, outline, at):
    """Return the points of a way from a vertex, round a square at its end, and back."""
    x, y = outline[at]
    u, v = x + draw(st.integers(-2, 2)), y + draw(st.integers(-2, 2))
    corners = [(u, v), (u + 1, v), (u + 1, v + 1), (u, v + 1)]
    first = draw(st.integers(0, 3))
    move = (u - corners[first][0], v - corners[first][1])
    turned = [(a + move[0], b + move[1]) for a, b in corners[first:] + corners[:first]]
    return [*turned, (u, v), (x, y)] if (u, v) != (x, y) else [*turned[1:], (x, y)]


@st.composite
def _rectangles(draw):
    x, y, width, height = (draw(st.integers(least, 4)) for least in (0, 0, 1, 1))
    corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
    return draw(st.sampled_from([corners, corners, corners[::-1]]))


def rectangles(most=3):
    """Some rectangles on a small grid; those that run clockwise are holes."""
    return st.lists(_rectangles(), min_size=2, max_size=most).map(pf.Outline)
