"""Points that begin to move: what edges do then is what the moved points say, in fractions."""

from itertools import combinations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from plyfold.arrangement.crossings import distinct_numbers, distinct_pairs, find_contacts
from plyfold.arrangement.infinitesimal import begin_to_move, begun_crossings
from plyfold.predicates import orient


@st.composite
def moving_points(draw):
    """Few places for many points, some far from the origin; velocities alike, much longer than others, or none."""
    places = draw(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), min_size=4, max_size=9))
    size, origin = 2.0 ** draw(st.integers(-400, 400)), draw(st.sampled_from([0, 2**50, 1 - 2**52]))
    speed = st.integers(-3, 3) | st.sampled_from([2**60, 2**60 + 1, 3 * 2**1100, 2**1100 - 1])
    velocities = draw(st.lists(st.tuples(speed, speed), min_size=len(places), max_size=len(places)))
    return (np.array(places, dtype=float) + origin) * size, np.array(velocities, dtype=object)


@settings(deadline=None)
@given(moving_points())
def test_edges_cross_as_the_moved_points_say(drawn):
    points, velocities = drawn
    following = np.roll(np.arange(len(points)), -1)
    motion = begin_to_move(points, velocities, following)
    crossings, undecided = begun_crossings(motion, find_contacts(points))
    expected = set()
    for i, j in combinations(range(len(points)), 2):
        p, q, r, s = motion.places[[i, following[i], j, following[j]], None]
        sides = [int(orient(*three)[0]) for three in [(p, q, r), (p, q, s), (r, s, p), (r, s, q)]]
        if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
            expected.add((i, j, sides[1] > 0))
    found = {
        (*pair, right) for pair, right in zip(crossings.edges.tolist(), crossings.from_right.tolist(), strict=True)
    }
    assert found == expected
    for i, j in undecided.tolist():
        p, q, r, s = motion.places[[i, following[i], j, following[j]], None]
        assert any(orient(*three)[0] == 0 for three in [(p, q, r), (p, q, s), (r, s, p), (r, s, q)])


@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5))))
def test_distinct_numbers_and_pairs(rows):
    pairs = np.array(rows, dtype=np.int64).reshape(-1, 2)
    assert [tuple(pair) for pair in distinct_pairs(pairs, 6).tolist()] == sorted(set(rows))
    assert distinct_numbers(pairs.ravel()).tolist() == sorted(set(pairs.ravel().tolist()))
