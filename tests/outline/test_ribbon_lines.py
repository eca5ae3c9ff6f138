"""Ribbons follow their lines: the walk through the strip, beside the slow one from the definition."""

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from outline.test_ribbons import CAPS, JOINS, KINDS
from plyfold.outline.ribbons import ribbon as ribbons
from plyfold.outline.ribbons.line import TightBendError, as_line
from plyfold.outline.ribbons.ribbon import Style, ribbon_of_line
from plyfold.outline.ribbons.walk import walk_through
from reference.ribbons import Surface, as_walked, farthest_corner, lift

# Edges of a quarter of a circle, and by how much the mitres of round joins reach farther than the width.
QUAD_SEGS = 3
MITRE_OF_ARC = 1 / math.cos(math.pi / 4 / QUAD_SEGS)


def tight_on_a_grid(rng, n):
    """Hairpins and corners that a ribbon of width 2 is too wide for."""
    points = rng.integers(0, 7, (n, 2)).astype(float)
    return points[np.append(True, (np.diff(points, axis=0) != 0).any(axis=1))]


@st.composite
def wide_lines(draw):
    """A line with a width, often too wide for its bends, open or closed."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    points = draw(st.sampled_from((*KINDS, tight_on_a_grid)))(rng, draw(st.integers(3, 9)))
    width = draw(st.sampled_from((2.0, float(rng.uniform(0.1, 4)))))
    closed = draw(st.booleans()) and len(points) > 2 and (points[0] != points[-1]).any()
    if len(points) < 2:
        points = np.array([(0.0, 0), (3, 1)])
    return as_line(points, width * rng.uniform(0.6, 1, len(points)) if draw(st.booleans()) else width, closed)


def surface_of(ribbon):
    return Surface(ribbon.outline.points, ribbon.faces)


def reach(line, cap):
    """How far the ribbon goes beyond the ends of its line."""
    return line.half_widths[[0, -1]] * (cap != "flat")


def halves(line):
    """Half the widths at the points of the walk."""
    ends = max(line.half_widths[[0, -1]])
    return [ends, *line.half_widths, ends] if line.closed else line.half_widths


def made(line, join, cap):
    """The ribbon, or None if a bend is too tight."""
    try:
        return ribbon_of_line(line, Style(join, cap, QUAD_SEGS))
    except pf.errors.InputError as error:
        refused = error
    assert "too tight" in str(refused)
    assert tuple(refused.where[0]) in set(map(tuple, line.points.tolist()))
    return None


def is_ribbon_of(line, ribbon, join, cap):
    """Whether a surface is a ribbon of its line, by the definition."""
    surface, outline = surface_of(ribbon), ribbon.outline
    loops = [list(range(*ends)) for ends in zip(outline.first_point, outline.first_point[1:], strict=False)]
    faces = lift(surface, line.points, line.closed, reach(line, cap))
    if not surface.is_laid_flat(loops) or len(loops) != 1 + line.closed or faces is None:
        return False
    farthest = farthest_corner(surface, line.points, faces, line.closed, halves(line))
    mitres = {"round": MITRE_OF_ARC, "bevel": 1, "mitre": 5}[join]
    square = math.sqrt(2) if cap == "square" and not line.closed else 1
    return farthest <= max(mitres, square) * (1 + 1e-5)


@settings(deadline=None, max_examples=150)
@given(wide_lines(), st.sampled_from(JOINS), st.sampled_from(CAPS))
def test_a_ribbon_is_one_of_its_line_by_the_definition(line, join, cap):
    ribbon = made(line, join, cap)
    assert ribbon is None or is_ribbon_of(line, ribbon, join, cap)


def test_all_lines_of_four_points_on_a_small_grid_from_a_corner():
    """Most of them have a bend that is too tight; of the others, every one is right."""
    places = [(float(x), float(y)) for x, y in product(range(3), repeat=2)]
    judged = 0
    for others in product(places, repeat=3):
        points = [places[0], *others]
        if all(a != b for a, b in zip(points, others, strict=False)):
            line = as_line(points, 1, False)
            ribbon = made(line, "bevel", "flat")
            judged += ribbon is not None
            assert ribbon is None or is_ribbon_of(line, ribbon, "bevel", "flat")
    assert judged > 150


@pytest.mark.parametrize("factor", [2.0**-300, 2.0**-20, 2.0**40, 2.0**300])
@settings(deadline=None, max_examples=20)
@given(wide_lines(), st.sampled_from(JOINS), st.sampled_from(CAPS))
def test_at_any_scale_the_same_lines_have_ribbons(factor, line, join, cap):
    """In the mirror and backward, corners may be rounded otherwise; by powers of two they are the same."""
    scaled = as_line(line.points * factor, 2 * line.half_widths * factor, line.closed)
    assert (made(scaled, join, cap) is None) == (made(line, join, cap) is None)


@pytest.mark.parametrize("cap", CAPS)
@pytest.mark.parametrize("join", JOINS)
def test_hairpins_narrower_than_the_ribbon_are_refused_or_right(join, cap):
    for points in (
        [(1, 1), (5, 2), (2, 1), (4, 0), (0, 5)],
        [(4, 5), (0, 6), (3, 1), (4, 3), (5, 2), (2, 4), (6, 1)],
        [(6, 4), (3, 1), (1, 6), (2, 1), (6, 6), (6, 3), (0, 6)],
        [(2, 2), (3, 5), (3, 3), (0, 6), (0, 5), (4, 1)],
        [(6, 3), (2, 2), (3, 0), (5, 4), (6, 1), (1, 1)],
        [(3, 12), (6, 9), (0, 12), (3, 9), (9, 0), (0, 12)],
    ):
        line = as_line(points, 2, False)
        ribbon = made(line, join, cap)
        assert ribbon is None or is_ribbon_of(line, ribbon, join, cap)


def test_an_end_in_a_hairpin_is_refused_with_the_bend():
    with pytest.raises(pf.errors.InputError, match=r"too tight for a ribbon 2 wide, at \(5, 2\)"):
        pf.ribbon([(1, 1), (5, 2), (2, 1), (4, 0), (0, 5)], 2)


def test_a_zigzag_within_its_own_ribbon_is_drawn():
    """The line goes back and forth in it, and the ribbon is not laid double."""
    line = as_line([(0, 0), (10, 0), (5, 0.25), (15, 0.5)], 2, False)
    ribbon = ribbon_of_line(line, Style())
    assert is_ribbon_of(line, ribbon, "round", "flat")
    assert pf.arrange(ribbon.outline).winding.max() == 1


# ---- the walk by itself ----------------------------------------------------------------------------------------------


@st.composite
def strips_and_lines(draw):
    """A strip, and a line like the one that it was made for, which need not stay in it."""
    line, join, cap = draw(wide_lines()), draw(st.sampled_from(JOINS)), draw(st.sampled_from(CAPS))
    walks = []

    def remember(strip, points, closed, tips):
        walks.append((strip, points, closed, tips))
        return walk_through(strip, points, closed, tips)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ribbons, "walk_through", remember)
        made(line, join, cap)
    if not walks:
        return None
    strip, points, closed, tips = draw(st.sampled_from(walks))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    moved = points.copy()
    inner = slice(2, -2)  # caps are straight on from the first and the last segment
    moved[inner] += rng.normal(0, draw(st.sampled_from((0.0, 0.3, 1.0))) * line.half_widths.max(), moved[inner].shape)
    return strip, moved, closed, tips


@settings(deadline=None, max_examples=200)
@given(strips_and_lines())
def test_the_walk_is_the_one_of_the_slow_reference(given_strip):
    if given_strip is None:
        return
    strip, points, closed, tips = given_strip
    surface = Surface(np.concatenate(strip.loops), strip.faces)
    beyond = [math.dist(tip[0], points[end]) if len(tip) else 0 for tip, end in zip(tips, (0, -1), strict=True)]
    expected = lift(surface, points[1:-1] if closed else points, closed, beyond)
    if expected is None:
        with pytest.raises(TightBendError) as caught:
            walk_through(strip, points, closed, tips)
        assert 0 < caught.value.place < len(points)
        return
    found = walk_through(strip, points, closed, tips)
    assert len(found) == len(points)
    walked = as_walked(points[1:-1], True) if closed else as_walked(points, False)
    for k in range(1, len(points) - 1):
        assert surface.is_same(int(found[k]) % len(strip.faces), expected[k], walked[k])
