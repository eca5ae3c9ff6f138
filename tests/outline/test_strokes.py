from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plyfold.errors import CurveError, InputError, StrokeError
from plyfold.outline.curve import Curve
from plyfold.outline.strokes import MOST_STROKES, join_strokes

ANYTHING = 1e9
"""A gap limit that never matters."""


def loop_of(points):
    """A form shared by all starts and directions of the same closed polyline."""
    points = [tuple(point) for point in np.asarray(points).tolist()]
    ways = [way[i:] + way[:i] for way in (points, points[::-1]) for i in range(len(points))]
    return min(ways)


def closing_length(points):
    points = np.asarray(points, dtype=float)
    return float(np.hypot(*(points - np.roll(points, 1, axis=0)).T).sum())


def least_total_gap(strokes):
    """Try every order and direction of the strokes after the first."""
    best = np.inf
    for order in permutations(range(1, len(strokes))):
        for turns in product((1, -1), repeat=len(order)):
            pieces = [strokes[0], *(strokes[i][::turn] for i, turn in zip(order, turns, strict=True))]
            gaps = [np.hypot(*(b[0] - a[-1])) for a, b in zip(pieces, pieces[1:] + pieces[:1], strict=True)]
            best = min(best, sum(gaps))
    return best


@st.composite
def cut_loops(draw):
    """A closed polyline with distinct corners and the pieces it is cut into, shuffled and turned."""
    count = draw(st.integers(3, 30))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    points = rng.random((count, 2))
    cuts = np.sort(rng.choice(count, size=draw(st.integers(1, count)), replace=False))
    ring = np.concatenate([points, points, points])
    ends = [*cuts[1:], cuts[0] + count]
    pieces = [ring[a : b + 1] for a, b in zip(cuts, ends, strict=True)]
    turned = [piece[::-1] if rng.random() < 0.5 else piece for piece in pieces]
    return points, [turned[i] for i in rng.permutation(len(turned))]


@settings(deadline=None)
@given(cut_loops())
def test_a_loop_cut_into_strokes_comes_back(cut):
    points, strokes = cut
    joined, repairs = join_strokes(strokes)
    assert repairs == ()
    assert loop_of(joined) == loop_of(points)


@settings(deadline=None)
@given(cut_loops())
def test_the_loop_starts_with_the_first_stroke_in_its_given_direction(cut):
    _, strokes = cut
    joined, _ = join_strokes(strokes)
    length = len(strokes[0]) - 1
    assert joined[:length].tolist() == strokes[0][:-1].tolist()


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5])
def test_up_to_nine_strokes_are_joined_best(count):
    rng = np.random.default_rng(count)
    for _ in range(15):
        strokes = [rng.random((2, 2)) for _ in range(count)]
        _, repairs = join_strokes(strokes, ANYTHING)
        assert sum(repair.size for repair in repairs) == pytest.approx(least_total_gap(strokes))


def test_many_strokes_of_a_sketch_with_gaps_are_joined_in_order():
    rng = np.random.default_rng(3)
    angle = np.linspace(0, 4 * np.pi, 800, endpoint=False)
    spiral = np.column_stack([np.cos(angle), np.sin(angle)]) * (2 + np.cos(angle / 2))[:, None]
    pieces = [piece[:-1] for piece in np.split(np.roll(spiral, 7, axis=0), 40)]
    shuffled = [pieces[i][:: rng.choice([-1, 1])] for i in rng.permutation(40)]
    points, repairs = join_strokes(shuffled)
    assert len(repairs) == 40
    assert loop_of(points) == loop_of(np.concatenate(pieces))


@pytest.mark.parametrize("count", [4, 9, 10, 25])
def test_order_and_directions_of_the_strokes_do_not_matter(count):
    rng = np.random.default_rng(count)
    strokes = [rng.integers(0, 4, (2, 2)) for _ in range(count)]  # many equal distances, so many equal choices
    expected = join_strokes(strokes, ANYTHING)[0]
    for _ in range(20):
        order = rng.permutation(count)
        shuffled = [strokes[i][:: rng.choice([-1, 1])] for i in order]
        assert loop_of(join_strokes(shuffled, ANYTHING)[0]) == loop_of(expected)


def test_improving_nearest_ends_never_lengthens_the_loop():
    rng = np.random.default_rng(11)
    for count in (10, 30, 60):
        strokes = [rng.random((1, 2)) for _ in range(count)]
        points, _ = join_strokes(strokes, ANYTHING)
        assert sorted(map(tuple, points.tolist())) == sorted(tuple(stroke[0].tolist()) for stroke in strokes)
        # a 2-optimal tour has no two edges that cross, for an exchange would shorten it
        following = np.roll(points, -1, axis=0)
        for i in range(count):
            others = [j for j in range(count) if j not in ((i - 1) % count, i, (i + 1) % count)]
            assert not any(cross(points[i], following[i], points[j], following[j]) for j in others)


def cross(a, b, c, d):
    def side(p, q, r):
        return np.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


@pytest.mark.parametrize("turns", list(product((1, -1), repeat=3)))
@pytest.mark.parametrize("petals", [2, 3])
def test_strokes_that_end_in_one_place_run_straight_on(petals, turns):
    lobe = np.array([(0, 0), (2, 1), (3, 0), (2, -1), (0, 0)])
    angles = np.arange(petals) * 2 * np.pi / petals
    lobes = [lobe @ [[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]] for a in angles]
    points, _ = join_strokes([way[::turn] for way, turn in zip(lobes, turns, strict=False)])
    at_centre = np.flatnonzero((points == 0).all(axis=1))
    assert len(at_centre) == petals
    for i in at_centre:
        arriving, leaving = points[i] - points[i - 1], points[(i + 1) % len(points)] - points[i]
        assert arriving @ leaving > 0.7 * 5


def test_gaps_are_recorded_along_the_loop_with_midpoint_and_length():
    points, repairs = join_strokes([[(0, 0), (10, 0)], [(10, 10), (10, 1)], [(9, 10), (0, 1)]], max_gap=1)
    assert points.tolist() == [[0, 0], [10, 0], [10, 1], [10, 10], [9, 10], [0, 1]]
    assert [(repair.kind, repair.where, repair.size) for repair in repairs] == [
        ("gap bridged", (10, 0.5), 1),
        ("gap bridged", (9.5, 10), 1),
        ("gap bridged", (0, 0.5), 1),
    ]


def test_a_wide_gap_names_both_ends():
    with pytest.raises(StrokeError, match="the end of stroke 0 is 5 away from the start of stroke 2") as caught:
        join_strokes([[(0, 0), (10, 0)], [], [(10, 5), (0, 0)]])
    assert sorted(caught.value.where) == [(10, 0), (10, 5)]
    assert "max_gap" in caught.value.hint


def test_max_gap_decides_alone_when_given():
    strokes = [[(0, 0), (10, 0)], [(10, 5), (0, 0)]]
    assert len(join_strokes(strokes, max_gap=5)[1]) == 1
    with pytest.raises(StrokeError):
        join_strokes(strokes, max_gap=4.999)
    assert join_strokes([[(0, 0), (1, 0), (0, 1), (0, 0)]], max_gap=0)[1] == ()


def test_the_default_gap_limit_is_a_tenth_of_the_diagonal():
    def open_by(gap):
        return [[(0, 0), (30, 0), (30, 40), (0, 40), (0, gap)]]  # diagonal 50

    assert join_strokes(open_by(5))[1][0].size == 5
    with pytest.raises(StrokeError):
        join_strokes(open_by(5.001))


def test_empty_strokes_are_ignored_and_single_points_are_passed_through():
    points, repairs = join_strokes([[], [(0, 0), (4, 0)], [(4, 0)], [(4, 3)], []], ANYTHING)
    assert points.tolist() == [[0, 0], [4, 0], [4, 3]]
    assert sum(repair.size for repair in repairs) == 3 + 5


@pytest.mark.parametrize("strokes", [[], [[]], [[], []]])
def test_no_strokes(strokes):
    with pytest.raises(StrokeError, match="no stroke"):
        join_strokes(strokes)


@pytest.mark.parametrize("max_gap", [-1, np.nan])
def test_a_senseless_gap_limit(max_gap):
    with pytest.raises(InputError, match="max_gap"):
        join_strokes([[(0, 0), (1, 0), (0, 1)]], max_gap)


def test_too_many_strokes():
    with pytest.raises(StrokeError, match="more than"):
        join_strokes([[(i, 0)] for i in range(MOST_STROKES + 1)])


def test_a_bad_point_in_a_stroke():
    with pytest.raises(CurveError, match="point 1 is not finite"):
        join_strokes([[(0, 0), (1, np.nan)]])


def test_curve_from_strokes_keeps_the_record():
    curve = Curve.from_strokes([[(0, 0), (0, 0), (10, 0)], [(0, 10), (10, 0.5)], [(0, 10), (0, 0)]])
    assert curve.points.tolist() == [[0, 0], [10, 0], [10, 0.5], [0, 10]]
    assert [repair.kind for repair in curve.repairs] == ["gap bridged", "repeated point dropped"]


def test_a_single_point_is_not_a_curve():
    with pytest.raises(CurveError, match="only 1"):
        Curve.from_strokes([[(2, 2)]])
