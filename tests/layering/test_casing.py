"""Cased curves: over and under given at every crossing, on drawings, against brute force over levels."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.errors import InputError
from plyfold.gallery import chain
from plyfold.layering.levels.casing import embed_cased
from plyfold.layering.orders.listing import layerings
from reference import layerings as reference
from reference.planar_maps import gauss_code, windings
from reference.random_curves import MILNOR_LIKE, glued_disk, ribbon_outline

RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]


@cache
def small_disk(seed):
    """A disk of random triangles with few layers, so that trying all levels ends."""
    rng = np.random.default_rng(seed)
    while True:
        arranged = pf.arrange(glued_disk(rng, int(rng.integers(3, 14))))
        code = gauss_code(arranged.partner, arranged.ccw, arranged.outer)
        if 0 < arranged.n_crossings <= 12 and max(windings(code)) <= 4:
            return arranged, frozenset(reference.level_solutions(code))


@settings(max_examples=150, deadline=None)
@given(st.integers(0, 30), st.data())
def test_random_casings(seed, data):
    """A casing lifts if and only if it is that of levels found by brute force, and then to these levels."""
    arranged, solutions = small_disk(seed)
    start = data.draw(st.sampled_from(sorted(solutions)), "a layering to begin with")
    casing = casing_of(arranged, start)
    for crossing in data.draw(st.sets(st.integers(0, arranged.n_crossings - 1), max_size=3), "turned over"):
        casing[arranged.crossing_of_visit == crossing] ^= True
    expected = [levels for levels in solutions if (casing_of(arranged, levels) == casing).all()]
    found = embed_cased(arranged, casing)
    assert [tuple(found.border_level.tolist())] == expected if found else expected == []
    assert found or list(found.where) == [tuple(arranged.crossings[found.value].tolist())]


def casing_of(arranged, levels):
    """Over at a visit if the level beside the top cell is higher; that border comes first where the other goes left."""
    n = len(levels)
    beside_top = [levels[p - 1] if arranged.ccw[p] else levels[p] for p in range(n)]
    return np.array([beside_top[p] > beside_top[arranged.partner[p]] for p in range(n)])


@pytest.mark.parametrize(
    "points",
    [
        CURVES["pretzel"].curve.points,
        CURVES["two-turn-spiral"].curve.points,
        chain(MILNOR_LIKE, 20),
        ribbon_outline(np.random.default_rng(4), 300),
        glued_disk(np.random.default_rng(5), 150),
    ],
)
def test_large_drawings_come_back(points):
    for layering, _ in zip(layerings(pf.find_immersion(points)), range(5), strict=False):
        back = embed_cased(points, layering.casing)
        back.check()
        back.immersion.check()
        assert back.border_level.tolist() == layering.border_level.tolist()


def test_given_by_crossings_or_by_visits():
    by_visits = [True, True, False, False, False, False, True, True]
    first, second = embed_cased(RAMP, by_visits), embed_cased(RAMP, [1, 1, 0, 0])
    assert first.casing.tolist() == second.casing.tolist() == by_visits


def test_the_crossing_at_fault_has_a_place():
    """The upright band is woven through the flat one: over, under, as no cloth can lie."""
    obstruction = embed_cased(RAMP, [True, True, False, True])
    assert obstruction.reason == "casing"
    assert obstruction.where == ((4.0, 1.0),)
    assert "crossing 3" in str(obstruction)


def test_curves_that_bound_no_disk():
    assert embed_cased([(0, 0), (2, 2), (2, 0), (0, 2)], [True]).reason == "turning number"
    assert embed_cased(CURVES["kinked-circle"].curve, [True, True]).reason == "negative winding"


@pytest.mark.parametrize("over", [[True], [True] * 5, [[True] * 4], [2, 0, 1, 1], ["yes"] * 4])
def test_what_is_no_casing_is_refused(over):
    with pytest.raises(InputError, match="4 truth values"):
        embed_cased(RAMP, over)


def test_both_strands_over():
    with pytest.raises(InputError, match="at crossing 2 both strands pass over") as caught:
        embed_cased(RAMP, [True, True, True, False, False, False, True, True])
    assert caught.value.where == ((3.0, 1.0),)
