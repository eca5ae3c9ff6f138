"""Lists of curves: all their layered surfaces, found, listed, counted, and told apart by over and under."""

import pytest

import plyfold as pf
from nightly.lists import levels
from plyfold.errors import InputError
from reference.loops import casing, level_solutions, loop_borders

BIG = [(0, 0), (90, 0), (0, 90)]
SMALL = [(5, 5), (25, 5), (5, 25)]

# Two triangles that cross each other lie in a large one; the order of all three is free.
INSIDE = [BIG, SMALL, [(10, 10), (30, 10), (10, 30)]]
# The drawing hangs together, but one triangle crosses the large one only by way of the other.
HANGING_TOGETHER = [BIG, SMALL, [(10, 10), (200, 10), (10, 30)]]
# Nothing crosses anything.
NESTED = [BIG, SMALL, [(6, 6), (9, 6), (6, 9)]]


def levels_by_casing(curves):
    """All levels that the reference finds, by over and under at the crossings."""
    borders = loop_borders(curves)
    found = {}
    for level in level_solutions(borders):
        found.setdefault(casing(borders, level), set()).add(level)
    return found


@pytest.mark.parametrize(("curves", "expected"), [(INSIDE, 6), (HANGING_TOGETHER, 6), (NESTED, 6)])
def test_every_surface_is_listed_once(curves, expected):
    listed = [levels(surface) for surface in pf.embeddings(curves)]
    assert len(listed) == len(set(listed)) == pf.count_embeddings(curves) == expected
    assert set(listed) == set().union(*levels_by_casing(curves).values())
    assert levels(pf.find_embedding(curves)) in listed


@pytest.mark.parametrize(("curves", "refused"), [(INSIDE, 2), (HANGING_TOGETHER, 2), (NESTED, 1)])
def test_a_casing_of_several_surfaces_is_refused(curves, refused):
    """Of those with one surface each, that is the answer."""
    by_casing = levels_by_casing(curves)
    for over, expected in by_casing.items():
        assert {levels(surface) for surface in pf.embeddings(curves, over)} == expected
        if len(expected) == 1:
            assert levels(pf.embed_cased(curves, over)) in expected
            continue
        with pytest.raises(InputError, match="several surfaces") as caught:
            pf.embed_cased(curves, over)
        assert set(caught.value.where) <= {curve[0] for curve in curves}
    assert sum(len(several) > 1 for several in by_casing.values()) == refused


def test_the_curve_that_is_not_determined_is_named():
    with pytest.raises(InputError, match="level of curve 1, at \\(5, 5\\)\n  hint: embeddings"):
        pf.embed_cased([BIG, SMALL], [])
