"""The verdict from points alone, with no value between, is that of the values, with the same words for errors."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement.crossings import find_contacts, order_visits
from plyfold.core.buffers import flat
from plyfold.core.verdict import NO, NOT_TOLD, YES, PlainCurve, decide
from plyfold.immersion.dual_tree import grow_dual_tree
from plyfold.immersion.propagation import narrow
from plyfold.immersion.solve import bounds_disk_by_values
from plyfold.immersion.word import write_word
from reference import random_curves
from touching import grown_outlines

RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
SEEDS = st.integers(0, 2**32)
LATTICE = st.lists(st.tuples(st.integers(-4, 4), st.integers(-4, 4)), max_size=16)


def go_on():
    """Nothing stops these curves."""


def told(points):
    return decide(flat(np.array(points, dtype=float).reshape(-1, 2)), go_on)


def said(question, *arguments, **options):
    """The answer, or the error and all its words."""
    try:
        return question(*arguments, **options)
    except pf.errors.PlyfoldError as error:
        return type(error), str(error), error.where, error.hint


def assert_same_verdict(points):
    for touching in (True, False):
        expected = said(bounds_disk_by_values, points, touching)
        assert said(pf.bounds_disk, points, touching) == expected
        assert said(pf.bounds_disk, np.asfortranarray(points), touching) == expected
    return expected


def curves_of_all_kinds(seed):
    rng = np.random.default_rng(seed)
    disk = np.array(random_curves.glued_disk(rng, int(rng.integers(2, 60))), dtype=float)
    yield disk * 10.0 ** float(rng.integers(-140, 140))
    yield disk[::-1] + 1e6 * rng.random(2)
    yield np.array(random_curves.random_polygon(rng, int(rng.integers(3, 30))), dtype=float)
    yield np.array(random_curves.ribbon_outline(rng, int(rng.integers(5, 40))), dtype=float)
    yield rng.normal(size=(int(rng.integers(3, 20)), 2))


@settings(deadline=None, max_examples=40)
@given(SEEDS)
def test_random_curves(seed):
    for points in curves_of_all_kinds(seed):
        assert_same_verdict(points)


@settings(deadline=None, max_examples=150)
@given(st.one_of(LATTICE, grown_outlines()))
def test_curves_in_contact_and_what_is_none(points):
    assert_same_verdict(np.array(points, dtype=float).reshape(-1, 2))
    assert said(pf.bounds_disk, points) == said(bounds_disk_by_values, points)


@settings(deadline=None, max_examples=40)
@given(SEEDS)
def test_stages_are_those_of_the_values(seed):
    for points in curves_of_all_kinds(seed):
        curve, expected = PlainCurve(go_on), pf.arrange(points)
        if not curve.draw(flat(points)):
            continue
        visits = order_visits(points, find_contacts(points))
        assert np.asarray(curve.visit_edge).tolist() == visits.edge.tolist()
        assert np.asarray(curve.point).tobytes() == visits.point.tobytes()
        curve.find_direction()
        curve.find_cells()
        assert (curve.direction.turning, curve.direction.outer) == (expected.turning_number, expected.outer)
        assert curve.direction.turned_round == expected.reversed
        for name in ("partner", "ccw", "next_dart", "cell_of_dart", "cell_darts", "winding"):
            assert np.asarray(getattr(curve, name)).tolist() == getattr(expected, name).astype(int).tolist()
        assert np.asarray(curve.cell_start)[: curve.cells + 1].tolist() == expected.cell_start.tolist()
        assert_same_word(curve, expected)


def assert_same_word(curve, expected):
    if curve.direction.turning != 1 or curve.direction.lowest < 1:
        return
    curve.write_word()
    tree = grow_dual_tree(expected)
    for name in ("parent", "link", "along", "turning", "bend"):
        assert np.asarray(getattr(curve.tree, name)).tolist() == getattr(tree, name).tolist()
    answer, word = curve.has_grouping(), write_word(tree)
    assert curve.letters == len(word)
    assert answer != NOT_TOLD or len(narrow(word).regions)
    if len(word):
        for name in ("border", "label", "block", "minus"):
            assert np.asarray(getattr(curve.word, name)).tolist() == getattr(word, name).tolist()


@pytest.mark.parametrize(
    "points",
    [
        [],
        [(0, 0)],
        [(0, 0), (1, 1)],
        [(0, 0), (1, 1), (2, 2)],
        [(0, 0), (1, 1), (0, 0)],
        [(0, 0), (np.nan, 1), (2, 0)],
        [(0, 0), (np.inf, 1), (2, 0)],
        [(0, 0), (1e151, 1), (2, 0)],
        [(0, 0, 0), (1, 1, 0), (2, 0, 0)],
        [(0, 0), (2**53 + 1, 1), (2, 0)],
        [(0, 0), (1, 1), (2,)],
        [(0, "a"), (1, 1), (2, 0)],
        [(0, 0), (1j, 1), (2, 0)],
        [(True, False), (False, False), (True, True)],
        [[(0, 0), (1, 0), (0, 1)], [(5, 5), (6, 5), (5, 6)]],
        np.zeros((0, 2)),
        np.zeros((2, 5)),
        np.zeros((3, 2), dtype=bool),
        np.ma.masked_array(np.eye(3)[:, :2], np.eye(3)[:, :2] > 0),
        np.eye(3, 2, dtype=np.float32),
        "0 1 2",
        {(0, 0), (1, 0), (0, 1)},
        None,
    ],
    ids=repr,
)
def test_errors_have_the_same_words(points):
    assert said(pf.bounds_disk, points) == said(bounds_disk_by_values, points)


def test_what_is_told_and_what_is_left_to_values():
    ramp = np.array(RAMP, dtype=float)
    assert told(ramp) == told([*RAMP, RAMP[0]]) == told(ramp[::-1]) == YES
    assert told([(0, 0), (2, 2), (2, 0), (0, 2)]) == NO
    assert told([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]) == NOT_TOLD
    assert told([*RAMP, RAMP[-1]]) == told(ramp * 1e-130) == NOT_TOLD


def test_points_are_left_as_they_are():
    points = np.array(RAMP, dtype=float)
    points.setflags(write=False)
    assert pf.bounds_disk(points)
    assert points.tolist() == [list(point) for point in np.array(RAMP, dtype=float)]


def test_ctrl_c_is_heard_while_crossings_are_looked_for():
    def step():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        decide(flat(np.random.default_rng(0).random((2000, 2))), step)


def test_small_curves_are_decided_with_numpy_alone():
    program = (
        "import sys, numpy\n"
        "before = set(sys.modules)\n"
        "import plyfold as pf\n"
        f"assert pf.bounds_disk(numpy.array({RAMP}, dtype=float))\n"
        "own = {name for name in sys.modules if name.startswith('plyfold')}\n"
        "print(len(own), *sorted({name.split('.')[0] for name in set(sys.modules) - before - own}))"
    )
    count, *others = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    ).stdout.split()
    assert not {"scipy", "shapely", "pysat", "fractions", "decimal", "threading"} & set(others)
    assert int(count) < 25
