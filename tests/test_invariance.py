"""Answers do not depend on scale, place, starting point, direction, or the side one looks from."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.gallery import CURVES
from reference.random_curves import glued_disk, random_polygon, ribbon_outline


def answers(points):
    drawn = pf.arrangement(points, general_position="raise")
    return drawn.n_crossings, drawn.turning_number, sorted(drawn.winding.tolist()), pf.count_immersions(drawn)


def layerable(points):
    return [bool(pf.find_layering(immersion)) for immersion in pf.immersions(points)]


def frames(points):
    yield points * 1e8
    yield points * 1e-8
    yield np.roll(points, 3, axis=0)
    yield points[::-1]
    if pf.arrangement(points).turning_number != 0:  # reflected and turned round again: the same windings
        yield points * [-1, 1]


@pytest.mark.parametrize("name", CURVES)
def test_gallery(name):
    points = np.array(CURVES[name].curve.points)
    for changed in frames(points):
        assert answers(changed)[0] == answers(points)[0]
        assert answers(changed)[3] == answers(points)[3]
        assert sorted(layerable(changed)) == sorted(layerable(points))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.sampled_from(["polygon", "ribbon", "disk"]))
def test_random_curves(seed, family):
    rng = np.random.default_rng(seed)
    draw = {
        "polygon": lambda: random_polygon(rng, 12),
        "ribbon": lambda: ribbon_outline(rng, 25),
        "disk": lambda: glued_disk(rng, 25),
    }
    points = np.array(draw[family](), dtype=float)
    expected = answers(points)
    for changed in frames(points):
        found = answers(changed)
        if expected[1] == 0:  # no direction is the positive one, so windings may change sign
            assert found[:2] == expected[:2]
        else:
            assert found == expected


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(-40, 40), st.integers(-40, 40)), min_size=5, max_size=12, unique=True))
def test_large_integer_shifts(points):
    points = np.array(points, dtype=float)
    try:
        expected = answers(points)
    except pf.errors.PlyfoldError:
        return
    assert answers(points + np.array([2**40, -(2**35)])) == expected


def lying(layering):
    """How the cloth lies, in coordinates: the edges that pass over others, and the borders that share a sheet."""
    immersion = layering.immersion
    drawn = immersion.arrangement
    points = drawn.curve.points
    edges = [frozenset((tuple(points[e]), tuple(points[(e + 1) % len(points)]))) for e in drawn.visit_edge.tolist()]
    crossed = [(edges[visit], edges[partner]) for visit, partner in enumerate(drawn.partner.tolist())]
    over = {crossed[visit] for visit in np.flatnonzero(layering.casing)}
    borders = [frozenset(ends) for ends in zip(crossed, crossed[1:] + crossed[:1], strict=True)] or [frozenset()]
    return over, {frozenset(borders[b] for b in group.borders) for group in immersion.disk_layout()}


@pytest.mark.parametrize("name", CURVES)
def test_the_first_answer_belongs_to_the_drawing(name):
    points = np.array(CURVES[name].curve.points)
    expected = [lying(found) for found in map(pf.find_layering, pf.immersions(points)) if found]
    for start in range(1, len(points), -(-len(points) // 7)):
        for changed in (np.roll(points, start, axis=0), np.roll(points, start, axis=0)[::-1]):
            assert [lying(found) for found in map(pf.find_layering, pf.immersions(changed)) if found] == expected


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 200), st.booleans())
def test_the_first_answer_of_random_disks_belongs_to_the_drawing(seed, start, backward):
    points = np.array(glued_disk(np.random.default_rng(seed), 40), dtype=float)
    changed = np.roll(points, start, axis=0)[:: -1 if backward else 1]
    assert lying(pf.find_layering(pf.find_immersion(changed))) == lying(pf.find_layering(pf.find_immersion(points)))
