"""Outlines that touch themselves against the definition: loops and cusps, and every position of the page."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import plyfold as pf
from nightly.contacts import certified, judge_as_placed, without_touches
from plyfold.errors import CurveError
from reference.contacts import (
    answer,
    contacts,
    count_outward,
    count_strict,
    either_direction,
    exact,
    positions,
    random_touching,
    random_touching_loops,
    random_touching_with_cusps,
    starts,
    with_vertices_at_cusps,
    without_spikes,
)
from reference.touching_drawings import touching_drawing
from touching import touching_outlines

MOST_SHEETS = 3
"""Sheets over a face up to which the reference tries all gluings."""

KNOWN = {
    "two triangles in a point": [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)],
    "a hole on a cut": [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)],
    "two squares on a neck": [(0, 0), (1, 0), (1, 1), (3, 1), (3, 0), (4, 0), (4, 1), (3, 1), (1, 1), (0, 1)],
    "two squares in a bow": [(0, 0), (2, 0), (2, 2), (4, 2), (4, 4), (2, 4), (2, 2), (0, 2)],
    "no disk": [(0, 0), (2, 0), (1, 1), (0, 2), (2, 2), (1, 1)],
    "a spike": [(0, 2), (2, 0), (1, 2), (0, 2), (2, 1)],
    "a disk for small moves alone": [(11, 7), (8, 4), (3, 0), (11, 2), (11, 12), (2, 4), (11, 9)],
    "nothing but spikes": [(0, 0), (2, 0), (2, 3), (5, 1), (2, 3), (2, 0)],
}


def reference_counts(outline):
    """How many surfaces an outline bounds, strictly and as a limit.

    None where the reference takes too long, or where nothing is left without spikes.
    """
    left = list(map(without_spikes, map(exact, outline.loops)))
    # Only loops without cusps have spikes here.
    marks = [index if any(index) else [0] * len(loop) for loop, index in zip(left, outline.cusps, strict=True)]
    loops, cusps = [loop for loop in left if loop], [list(index) for index in marks if len(index)]
    for directed, index in either_direction(loops, cusps) if loops else ():
        winding = touching_drawing(directed).winding
        if max(winding) > MOST_SHEETS:
            return None
        if min(winding) >= 0:
            directed, index = with_vertices_at_cusps(directed, index)  # noqa: PLW2901
            return count_strict(directed, index), count_outward(np.random.default_rng(0), directed, index)
    return (0, 0) if loops else None


def judge(outline):
    """The answers about an outline without spikes at cusps; return the numbers of surfaces."""
    counts = reference_counts(outline)
    if counts is not None:
        drawn = pf.arrange(outline)
        assert (without_touches(drawn), pf.count_immersions(drawn)) == counts
        certified(outline)
    return counts


@pytest.mark.parametrize("name", KNOWN)
def test_all_positions_of_the_page_from_some_starts(name):
    expected = answer(KNOWN[name])
    for number, placed in enumerate(positions(KNOWN[name])):
        for changed in list(starts(placed))[number % 4 :: 4]:
            judge_as_placed(changed, expected)


@pytest.mark.slow
@pytest.mark.parametrize("name", KNOWN)
def test_every_start_in_every_position(name):
    expected = answer(KNOWN[name])
    for placed in positions(KNOWN[name]):
        for changed in starts(placed):
            judge_as_placed(changed, expected)


@pytest.mark.parametrize("seed", range(4))
def test_random_polygons_from_many_starts(seed):
    polygon = random_touching(np.random.default_rng(seed), most=7)
    expected = answer(polygon)
    for number, placed in enumerate(positions(polygon)):
        for changed in list(starts(placed))[number % 3 :: 3]:
            judge_as_placed(changed, expected)


@pytest.mark.parametrize("scale", [2.0**-40, 1.0, 2.0**40])
@pytest.mark.parametrize("shift", [(0, 0), (2**30, -(2**20))])
def test_scales_and_places(scale, shift):
    for polygon in KNOWN.values():
        judge_as_placed(scale * (np.array(polygon, dtype=float) + shift), answer(polygon))


def test_several_loops():
    found = [judge(pf.Outline(random_touching_loops(np.random.default_rng(seed)))) for seed in range(18)]
    assert {(0, 0), (0, 1), (1, 1)} <= set(found)


def test_cusps():
    found = []
    for seed in range(30):
        polygon, cusps = random_touching_with_cusps(np.random.default_rng(seed), 1)
        if contacts([exact(polygon)]):
            found.append(judge(pf.Outline([polygon], [cusps])))
    assert {(0, 0), (0, 1)} <= set(found)


def test_a_zigzag_is_a_cusp_only_where_it_is_marked():
    """Both of its tips turn right; unmarked they are spikes, and the limaçon turns twice."""
    limacon = [(2, 0), (0, 2), (-2, 0), (0, -2), (2, 0.5), (0, 1), (-1, 0), (0, -1)]
    zigzag = [*limacon[:6], (-0.75, 0.25), (-0.25, 0.75), *limacon[6:]]
    assert pf.count_immersions(zigzag) == 0
    for tip in (6, 7):
        assert pf.bounds_disk(pf.Curve(zigzag, cusps={tip: 1}))


@settings(max_examples=25, deadline=None)
@given(touching_outlines())
def test_any_outline(outline):
    judge(outline)


@settings(max_examples=20, deadline=None)
@given(touching_outlines(), st.data())
def test_any_outline_with_a_cusp(outline, data):
    assume(all(without_spikes(exact(loop)) == exact(loop) for loop in outline.loops))
    cusps = [np.zeros(len(loop), dtype=np.int64) for loop in outline.loops]
    loop = data.draw(st.sampled_from(cusps))
    loop[data.draw(st.integers(0, len(loop) - 1))] = data.draw(st.integers(1, 2))
    judge(pf.Outline(outline.loops, cusps))


def test_nothing_is_left():
    with pytest.raises(CurveError):
        pf.arrange(KNOWN["nothing but spikes"])


@pytest.mark.slow
@pytest.mark.parametrize("part", range(4))
def test_more_of_all_kinds(part):
    for seed in range(10_000 + part, 11_000, 4):
        rng = np.random.default_rng(seed)
        judge(pf.Outline(random_touching_loops(rng)))
        polygon, cusps = random_touching_with_cusps(rng, 1)
        judge(pf.Outline([polygon], [cusps]))
        judge(pf.Outline([random_touching(rng, most=12)]))
