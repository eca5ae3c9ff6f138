"""Answers do not depend on scale, place, starting point, direction, or the side one looks from."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.gallery import chain
from reference.crossings import base_visit
from reference.random_curves import MILNOR_LIKE, SEVERAL_IMMERSIONS, glued_disk, random_polygon, ribbon_outline


def answers(points):
    drawn = pf.arrange(points, general_position="raise")
    return drawn.n_crossings, drawn.turning_number, sorted(drawn.winding.tolist()), pf.count_immersions(drawn)


def layerable(points):
    return [bool(pf.find_layering(immersion)) for immersion in pf.immersions(points)]


def frames(points):
    yield points * 1e8
    yield points * 1e-8
    yield np.roll(points, 3, axis=0)
    yield points[::-1]
    if pf.arrange(points).turning_number != 0:  # reflected and turned round again: the same windings
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


def counted_from_base(immersion, layerings):
    """The borders that share a sheet, and the visits that pass over, numbered from the base visit on."""
    n = immersion.arrangement.n_borders
    base = base_visit(immersion.arrangement.curve.points) if immersion.arrangement.curve else 0
    groups = {frozenset((border - base) % n for border in group.borders) for group in immersion.disk_layout()}
    return groups, [np.roll(layering.casing, -base).tolist() for layering in layerings]


def all_answers(curve):
    """All immersions and all layerings of each, in the order in which they are listed."""
    return [counted_from_base(immersion, pf.layerings(immersion)) for immersion in pf.immersions(curve)]


def divided(points, parts):
    """The polygon with every edge cut into so many parts, exactly."""
    step = (np.roll(points, -1, axis=0) - points) / parts
    return np.stack([points + part * step for part in range(parts)], axis=1).reshape(-1, 2)


AFFINE_MAPS = [
    ((1, 0), (0, 1)), ((0, -1), (1, 0)), ((1, 1), (0, 1)), ((1, 0), (1, 1)), ((2, 1), (1, 1)),
    ((1, -1), (1, 1)), ((3, 1), (-1, 2)), ((-1, 0), (0, -1)), ((0, 1), (-1, 0)), ((-2, 1), (-1, -1)),
]  # fmt: skip
SEVERAL = [
    12.0 * np.array(polygon, dtype=float) @ np.array(rows, dtype=float).T
    for polygon, *_ in SEVERAL_IMMERSIONS
    for rows in AFFINE_MAPS
]


def test_points_in_the_middle_of_edges_change_no_order_of_answers():
    expected = [all_answers(points) for points in SEVERAL]
    for parts in (2, 3, 4):
        assert [all_answers(divided(points, parts)) for points in SEVERAL] == expected


def test_the_order_of_answers_is_that_of_the_gauss_code_from_the_base_visit():
    for points in SEVERAL:
        drawn = pf.arrange(points)
        code = pf.GaussCode.of(drawn).rotated(base_visit(drawn.curve.points))
        assert all_answers(code) == all_answers(drawn)


def test_the_order_of_embeddings_over_many_immersions_belongs_to_the_drawing():
    points = chain(MILNOR_LIKE, 7)
    assert pf.count_immersions(points) == 128

    def first_embeddings(changed):
        return [counted_from_base(found.immersion, [found]) for found in islice(pf.embeddings(changed), 3)]

    expected = first_embeddings(points)
    for start in (5, 44):
        assert first_embeddings(np.roll(points, start, axis=0)) == expected
        assert first_embeddings(np.roll(points, start, axis=0)[::-1]) == expected


def test_the_nicest_layering_belongs_to_the_drawing():
    for seed in range(100, 106):
        points = np.array(glued_disk(np.random.default_rng(seed), 60), dtype=float)
        drawn = [pf.nicest_layering(pf.find_immersion(np.roll(points, start, axis=0))) for start in (0, 11, 25)]
        first, *others = [counted_from_base(found.immersion, [found]) for found in drawn]
        assert others == [first, first]
