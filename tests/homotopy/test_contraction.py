"""Contractions sweep exactly the area, in one closed curve that stays where it was cut."""

from collections import Counter

import numpy as np
import pytest

import plyfold as pf
from plyfold.homotopy.contraction import contraction_of
from reference.random_curves import random_polygon

TIMES = np.linspace(0, 1, 11).tolist()


def area(polygon):
    x, y = polygon.T
    return (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2


@pytest.fixture(scope="module")
def contraction():
    return contraction_of(pf.least_homotopy(random_polygon(np.random.default_rng(2), 14)), triangles=200)


def test_exactly_the_area_is_swept(contraction):
    swept = [contraction.swept(time) for time in TIMES]
    assert swept[0] == pytest.approx(0, abs=1e-9 * swept[-1])
    assert (np.diff(swept) > 0).all()
    assert swept[-1] == pytest.approx(contraction.homotopy.area, rel=1e-9)
    for number, shrinking in zip(contraction.order, contraction.shrinking, strict=True):
        loop = contraction.homotopy.loops[number]
        assert shrinking.swept_at(0) == pytest.approx(contraction.homotopy.area_of(loop), rel=1e-9)


def test_what_is_swept_and_what_is_left_make_the_disk(contraction):
    for shrinking in contraction.shrinking:
        for size in (0.1, 0.5, 0.93):
            left = sum(map(area, shrinking.rest_at(size)))
            assert left + shrinking.swept_at(size) == pytest.approx(shrinking.swept_at(0), rel=1e-9)


def test_the_loop_stays_closed_and_where_it_was_cut(contraction):
    for shrinking in contraction.shrinking:
        for size in (0.02, 0.2, 0.6, 0.95):
            pieces = np.round(shrinking.curve_at(size), 6).reshape(-1, 2).tolist()
            ends = Counter(map(tuple, pieces))
            assert set(ends.values()) == {2}
            ways = {}
            for one, other in np.round(shrinking.curve_at(size), 6).tolist():
                ways.setdefault(tuple(one), []).append(tuple(other))
                ways.setdefault(tuple(other), []).append(tuple(one))
            reached, waiting = set(), [tuple(np.round(shrinking.points[0], 6).tolist())]
            while waiting:
                if (place := waiting.pop()) not in reached:
                    reached.add(place)
                    waiting += ways[place]
            assert reached == set(ends)
            assert tuple(np.round(shrinking.points[0], 6).tolist()) in ends


def test_loops_contract_after_those_that_are_cut_off_them(contraction):
    done = set()
    for number in contraction.order:
        assert {place for place, loop in enumerate(contraction.homotopy.loops) if loop.parent == number} <= done
        done.add(number)
    assert done == set(range(len(contraction.homotopy.loops)))


def test_times_are_from_nought_to_one(contraction):
    with pytest.raises(pf.errors.InputError, match="from 0 to 1"):
        contraction.moment(1.5)


def test_codes_do_not_move():
    with pytest.raises(pf.errors.InputError, match="needs a drawing"):
        contraction_of(pf.least_homotopy(pf.GaussCode.parse("1+ 1- / outer 0")))
