"""Triangles of points without values between, against those of values; and what is left to these."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.core.buffers import flat
from plyfold.core.cloth import CLOCKWISE, UNTOLD, cut_into_triangles
from reference import random_curves

TURNED = np.array([[0.6, 0.8], [-0.8, 0.6]]) / 3


def cut(points):
    """Return the triangles that loops alone find, or what they say instead."""
    points = np.array(points, dtype=np.float64)
    faces, sides = np.zeros((2, len(points) - 1, 3), dtype=np.int64)
    count = cut_into_triangles(flat(points), lambda: None, flat(faces), flat(sides))
    return faces[:count].tolist() if count >= 0 else count


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.integers(3, 60), st.booleans(), st.booleans())
def test_the_same_triangles_as_of_values(seed, size, is_ribbon, is_turned):
    """On grids the line comes to many places at once; turned, rounding leaves that open."""
    outline = random_curves.ribbon_outline if is_ribbon else random_curves.glued_disk
    points = np.array(outline(np.random.default_rng(seed), size), dtype=np.float64)
    points = points @ TURNED if is_turned else points
    expected = pf.triangulate(pf.Curve(points)).tolist()
    assert cut(points) in (expected, UNTOLD)
    assert pf.triangulate(points).tolist() == expected
    assert pf.triangulate(points[::-1]).tolist() == pf.triangulate(pf.Curve(points[::-1])).tolist()
    closed = np.concatenate([points, points[:1]])
    assert pf.triangulate(closed).tolist() == expected
    assert pf.triangulate(closed[::-1]).tolist() == pf.triangulate(pf.Curve(closed[::-1])).tolist()


def test_loops_tell_of_most_disks():
    """Where the word leaves no choice; or the test above would say little."""
    told = 0
    for seed in range(30):
        points = np.array(random_curves.ribbon_outline(np.random.default_rng(seed), 40), dtype=np.float64)
        told += cut(points) != UNTOLD
    assert told > 20


@pytest.mark.parametrize(
    ("points", "answer"),
    [
        ([(0, 0), (0, 1), (1, 0)], CLOCKWISE),
        ([(0, 0), (2, 2), (2, 0), (0, 2)], UNTOLD),
        ([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)], UNTOLD),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], UNTOLD),
        ([(0, 0), (1, 0), (2, 0)], UNTOLD),
        ([(0, 0), (1, 0), (0, float("nan"))], UNTOLD),
    ],
)
def test_what_loops_do_not_cut(points, answer):
    assert cut(points) == answer


def test_an_error_in_a_step_ends_the_search():
    points = np.array(random_curves.ribbon_outline(np.random.default_rng(1), 3000), dtype=np.float64)

    def step():
        raise KeyboardInterrupt

    room = np.zeros(3 * len(points), dtype=np.int64)
    with pytest.raises(KeyboardInterrupt):
        cut_into_triangles(flat(points @ TURNED), step, flat(room), flat(room.copy()))


def test_room_that_is_too_small_is_an_error():
    points = np.array([[0.0, 0], [4, 0], [1, 1], [0, 5]])
    with pytest.raises(IndexError):
        cut_into_triangles(flat(points), lambda: None, *(flat(np.zeros(3, dtype=int)) for _ in range(2)))
