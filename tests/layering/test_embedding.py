"""Embeddings straight from the curve, against brute force over levels and against the search by immersions."""

import os
import signal
import subprocess
import sys
from itertools import islice

import numpy as np
import pytest

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.gauss import GaussCode
from plyfold.clock import Clock
from plyfold.gallery import chain
from plyfold.immersion.solve import count_immersions, immersions
from plyfold.layering.embedding import count_embeddings, embeddings, find_embedding
from plyfold.layering.levels.counting import count_level_solutions
from plyfold.layering.levels.equations import LevelClauses, level_equations, list_levels, solve_levels
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.listing import layerings
from plyfold.layering.orders.search import find_layering
from plyfold.obstruction import Unknown
from reference import gluings, loops, random_curves
from reference.layerings import level_solutions, level_solutions_by_immersion, levels_agree
from reference.level_subsets import ending_outside, joined, levels_fit
from reference.planar_maps import census, corners, gauss_code, left_and_right, may_bound_disk, windings

SMALLEST_WITHOUT_LAYERING = [
    ([9, 4, 3, 2, 1, 10, 7, 6, 11, 0, 5, 8, 13, 12, 15, 14], [1, 1, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0], 5),
    ([1, 0, 3, 2, 7, 14, 11, 4, 9, 8, 15, 6, 13, 12, 5, 10], [1, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0], 25),
    ([1, 0, 3, 2, 7, 10, 15, 4, 9, 8, 5, 14, 13, 12, 11, 6], [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 0, 0], 25),
    ([1, 0, 5, 14, 11, 2, 9, 8, 7, 6, 15, 4, 13, 12, 3, 10], [1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0], 25),
]
"""Eight crossings, two immersions, of which one does not lift."""

WITHOUT_EMBEDDING = gauss_code(
    [1, 0, 9, 12, 5, 4, 15, 20, 27, 2, 17, 16, 3, 22, 21, 6, 11, 10, 19, 18, 7, 14, 13, 26, 25, 24, 23, 8],
    [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 0, 0],
    49,
)
"""A curve with eight crossings that has one immersion which does not lift, with three fingers pushed over borders that
take the other immersion away."""


def code_of(arranged):
    return gauss_code(arranged.partner, arranged.ccw, arranged.outer)


def levels_of(layering):
    return tuple(layering.level[layering.immersion.own_sheet].tolist())


def straight_from(arranged):
    return LevelClauses(level_equations(arranged))


def borders_of(code):
    """The borders as the reference for several loops has them, which asks for no turning number."""
    four = tuple((c.a_top, c.a_bottom, c.b_top, c.b_bottom) for c in corners(code))
    return loops.LoopBorders(tuple(windings(code)[left] for left, _ in left_and_right(code)), four)


def assert_all_found(arranged):
    """All three functions agree with brute force over levels; both ways of listing and counting do."""
    code = code_of(arranged)
    expected = set(level_solutions(code) if may_bound_disk(code) else loops.level_solutions(borders_of(code)))
    found = list(embeddings(arranged))
    assert len(found) == len(expected)
    assert set(map(levels_of, found)) == expected
    assert count_embeddings(arranged) == len(expected)
    first = find_embedding(arranged)
    assert bool(first) == bool(expected)
    assert not first or levels_of(first) in expected
    if may_bound_disk(code):
        listed = [tuple(level.tolist()) for level in list_levels(straight_from(arranged))]
        assert len(listed) == len(expected)
        assert set(listed) == expected
        assert count_level_solutions(level_equations(arranged)) == len(expected)
        assert (solve_levels(straight_from(arranged), Clock(None)) is not None) == bool(expected)
    return found


@pytest.mark.parametrize("k", [0, 1, 2, 3, 4, 5, pytest.param(6, marks=pytest.mark.slow)])
def test_every_curve(k):
    for code in census(k):
        assert_all_found(Arrangement.from_gauss(*code))


@pytest.mark.parametrize(
    ("k", "curves", "embeddable"), [(2, 0, 0), (4, 1, 1), pytest.param(6, 37, 27, marks=pytest.mark.slow)]
)
def test_disks_with_a_handle(k, curves, embeddable):
    """One loop that turns −1 times bounds a disk with a handle, or nothing."""
    candidates = [Arrangement.from_gauss(*code) for code in census(k)]
    handles = [arranged for arranged in candidates if arranged.turning_number == -1]
    assert len(handles) == curves
    found = [find_embedding(arranged) for arranged in handles]
    assert sum(map(bool, found)) == embeddable
    assert all(surface.genus == 1 for surface in found if surface)


@pytest.mark.parametrize(("polygon", "_", "layering_counts"), random_curves.SEVERAL_IMMERSIONS)
def test_known_answers(polygon, _, layering_counts):
    arranged = arrange(polygon)
    by_immersion = {}
    for layering in assert_all_found(arranged):
        immersion = layering.immersion
        key = gluings.key_of(*code_of(arranged), immersion.own_sheet, immersion.gluing)
        by_immersion.setdefault(key, set()).add(levels_of(layering))
    assert by_immersion == level_solutions_by_immersion(code_of(arranged))
    assert sorted(map(len, by_immersion.values())) == [count for count in layering_counts if count]


@pytest.mark.parametrize("code", SMALLEST_WITHOUT_LAYERING)
def test_smallest_curves_with_an_immersion_that_does_not_lift(code):
    arranged = Arrangement.from_gauss(*code)
    found = assert_all_found(arranged)
    lifting = [immersion for immersion in immersions(arranged) if find_layering(immersion)]
    assert (count_immersions(arranged), len(lifting)) == (2, 1)
    assert {tuple(layering.immersion.own_sheet) for layering in found} == {tuple(lifting[0].own_sheet)}


def random_disks():
    rng = np.random.default_rng(4)
    yield from (random_curves.ribbon_outline(rng, int(rng.integers(20, 200))) for _ in range(15))
    yield from (random_curves.glued_disk(rng, int(rng.integers(20, 140))) for _ in range(15))


def test_levels_of_random_disks_satisfy_the_rule_at_every_crossing():
    for polygon in random_disks():
        arranged = arrange(polygon)
        for level in (
            solve_levels(straight_from(arranged), Clock(None)),
            find_embedding(arranged).border_level,
            *islice(list_levels(straight_from(arranged)), 3),
        ):
            assert all(levels_agree(corner, dict(enumerate(level.tolist()))) for corner in corners(code_of(arranged)))


def test_solutions_of_random_disks_are_as_many_as_layerings():
    for polygon in random_disks():
        arranged = arrange(polygon)
        expected = sum(count_layerings(immersion) for immersion in immersions(arranged))
        assert count_embeddings(arranged) == expected
        if arranged.n_crossings < 150:
            assert count_level_solutions(level_equations(arranged)) == expected


def test_chains_multiply():
    """Too many immersions to try: 2^100, 5^60 of which 3^60 lift, each of them in 2^60 ways."""
    for polygon, links, each in ((random_curves.MILNOR_LIKE, 100, 4), (random_curves.BENNEQUIN_LIKE, 60, 6)):
        arranged = arrange(chain(polygon, links))
        assert count_embeddings(arranged) == each**links
        assert find_embedding(arranged)
        listed = [levels_of(layering) for layering in islice(embeddings(arranged), 20)]
        assert len(set(listed)) == 20


def test_all_embeddings_of_a_chain_are_listed_once():
    arranged = arrange(chain(random_curves.MILNOR_LIKE, 4))
    assert count_immersions(arranged) == 16
    listed = [levels_of(layering) for layering in embeddings(arranged)]
    assert len(listed) == len(set(listed)) == 4**4
    one_by_one = {levels_of(layering) for immersion in immersions(arranged) for layering in layerings(immersion)}
    assert set(listed) == one_by_one
    assert listed[:10] == [levels_of(layering) for layering in islice(embeddings(arranged), 10)]


def assert_minimal_core(code, obstruction):
    assert obstruction.reason == "no embedding"
    core = obstruction.value
    assert not levels_fit(code, core)
    assert all(levels_fit(code, set(core) - {crossing}) for crossing in core)


def test_crossings_that_allow_no_levels():
    arranged = Arrangement.from_gauss(*WITHOUT_EMBEDDING)
    assert assert_all_found(arranged) == []
    assert count_immersions(arranged) == 1
    assert_minimal_core(code_of(arranged), find_embedding(arranged))


def test_crossings_that_allow_no_levels_among_many_immersions():
    milnor = ending_outside(code_of(arrange(random_curves.MILNOR_LIKE)))
    code = ending_outside(WITHOUT_EMBEDDING)
    for _ in range(4):
        code = joined(code, milnor)
    arranged = Arrangement.from_gauss(*code)
    assert count_immersions(arranged) == 2**4
    obstruction = find_embedding(arranged)
    assert_minimal_core(code, obstruction)
    assert max(obstruction.value) < 14, "these are the crossings of the first part"
    assert "none of the 16 immersions lifts" in str(obstruction)
    assert count_embeddings(arranged) == 0
    assert next(embeddings(arranged), None) is None


def test_places_are_those_of_the_crossings():
    arranged = arrange(GaussCode(*WITHOUT_EMBEDDING).to_curve())
    obstruction = find_embedding(arranged)
    assert obstruction.where == tuple(map(tuple, arranged.crossings[list(obstruction.value)].tolist()))


def test_curves_without_immersion_say_why():
    eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
    assert find_embedding(eight).reason == "turning number"
    assert count_embeddings(eight) == 0
    assert list(embeddings(eight)) == []


def test_time_is_limited():
    milnor = random_curves.MILNOR_LIKE
    for curve in (milnor, chain(milnor, 5)):
        for answer in (find_embedding(curve, time_limit=0), count_embeddings(curve, time_limit=0)):
            assert isinstance(answer, Unknown)
            assert "Unknown after" in str(answer)
        assert find_embedding(curve, time_limit=60)


PROGRAM = """
import threading
from types import SimpleNamespace
from plyfold.sat import in_time

stopped = threading.Event()

def question():
    print("asked", flush=True)
    return stopped.wait(30)

try:
    in_time(None, SimpleNamespace(interrupt=stopped.set), question)
except KeyboardInterrupt:
    print("interrupted" if stopped.is_set() else "left alone")
"""


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_the_solver_is_interrupted_by_ctrl_c():
    with subprocess.Popen([sys.executable, "-c", PROGRAM], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "asked\n"
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n"
