"""Contacts and visits against plain fractions: crowded lattices, near misses, all scales, all sizes of portions."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement.crossings import find_contacts, order_visits
from plyfold.errors import CurveError, GeneralPositionError
from reference import crossings as reference
from reference import loops as loops_reference
from reference.random_curves import random_polygon, ribbon_outline, star_polygon

SCALES = [1.0, 1e8, 1e-8, 1e149, 1e-149]


def curve_points(points):
    """The points as a curve keeps them, or none if they are no curve."""
    try:
        return pf.Curve(points).points
    except CurveError:
        return None


def lattice_polygon(seed, size, vertices):
    return curve_points(np.random.default_rng(seed).integers(-size, size + 1, (vertices, 2)))


def near_miss_polygon(seed, vertices, scale):
    """Random corners; then every other vertex moves onto an edge, to within a few units in the last place."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(vertices, 2))
    for vertex in range(0, vertices, 2):
        start = points[edge := rng.integers(vertices)]
        onto = start + rng.choice([0.0, 0.25, 0.5, rng.random()]) * (points[(edge + 1) % vertices] - start)
        points[vertex] = onto + rng.integers(-2, 3, 2) * np.spacing(onto)
    return points * scale


def assert_contacts_are_right(points):
    """Crossing pairs with their senses, and touching vertices, are those of the reference."""
    found = find_contacts(points)
    vertices = reference.exact(points)
    meetings = [(m.first, m.second, m.ccw) for m in reference.meetings(vertices)]
    assert (
        sorted((*pair, right) for pair, right in zip(found.edges.tolist(), found.from_right, strict=True)) == meetings
    )
    touching = sorted(place for _, place in reference.touching(vertices))
    assert sorted(vertices[vertex] for vertex in found.touches[:, 0]) == touching


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 30), st.integers(4, 34))
def test_contacts_on_lattices(seed, size, vertices):
    points = lattice_polygon(seed, size, vertices)
    assume(points is not None)
    assert_contacts_are_right(points)


@pytest.mark.parametrize("vertices", [*range(5, 20), 31, 32, 33, 34, 65, 129])
def test_contacts_at_the_borders_of_groups(vertices):
    for seed in range(4):
        assert_contacts_are_right(lattice_polygon(seed, vertices, vertices))


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 2**32), st.integers(4, 12), st.sampled_from(SCALES))
def test_contacts_of_near_misses(seed, vertices, scale):
    points = curve_points(near_miss_polygon(seed, vertices, scale))
    assume(points is not None)
    assert_contacts_are_right(points)


def turned_like(points, drawn):
    return reference.reversed_polygon(points.tolist()) if drawn.reversed else points.tolist()


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 2**32), st.integers(4, 14), st.sampled_from(SCALES))
def test_codes_of_near_misses(seed, vertices, scale):
    points = curve_points(near_miss_polygon(seed, vertices, scale))
    assume(points is not None)
    try:
        drawn = pf.arrange(points, general_position="raise")
    except GeneralPositionError:
        with pytest.raises(reference.DegenerateError):
            reference.crossings(points.tolist())
        return
    drawn.check()
    code, _, edges = reference.crossings(turned_like(points, drawn))
    assert drawn.partner.tolist() == list(code.partner)
    assert drawn.ccw.tolist() == list(code.ccw)
    assert drawn.visit_edge.tolist() == list(edges)


def bundle(rng, strands):
    """A polygon whose strands all cross one long edge within some units in the last place of each other."""
    low = [(0.5 + int(rng.integers(-3, 4)) * 2.0**-52, -1.0 - i) for i in range(strands)]
    high = [(0.5 + int(rng.integers(-3, 4)) * 2.0**-52, 1.0 + i + rng.random()) for i in range(strands)]
    zigzag = [place for i in range(strands) for place in ((low[i], high[i]) if i % 2 else (high[i], low[i]))]
    return [(-7.0, 0.0), (7.0, 0.0), (7.0, 60.0), *zigzag, (-7.0, -60.0)]


@pytest.mark.parametrize("seed", range(20))
def test_order_of_crossings_closer_than_rounding(seed):
    polygon = bundle(np.random.default_rng(seed), 6)
    try:
        code, _, edges = reference.crossings(polygon)
    except reference.DegenerateError:
        with pytest.raises(GeneralPositionError):
            pf.arrange(polygon, general_position="raise")
        return
    points = np.array(polygon)
    visits = order_visits(points, find_contacts(points))
    assert (visits.partner.tolist(), visits.ccw.tolist()) == (list(code.partner), list(code.ccw))
    assert visits.edge.tolist() == list(edges)
    assert visits.exact_signs > 0


FAMILIES = {
    "polygon": lambda rng: random_polygon(rng, 60),
    "ribbon": lambda rng: ribbon_outline(rng, 150),
    "star": lambda _: star_polygon(41, 20),
}


def fields(drawn):
    return {name: value for name, value in vars(drawn).items() if isinstance(value, np.ndarray)}


def rotated(drawn, visits):
    """The code with its first ``visits`` visits put last."""
    n = len(drawn.partner)
    moved = np.roll(drawn.partner, -visits)
    border = (drawn.outer // 2 - visits) % n
    return ((moved - visits) % n).tolist(), np.roll(drawn.ccw, -visits).tolist(), 2 * border + drawn.outer % 2


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.integers(0, 59))
def test_another_start_rotates_the_code(seed, start):
    points = np.array(random_polygon(np.random.default_rng(seed), 14), dtype=float)
    drawn = pf.arrange(points, general_position="raise")
    assume(drawn.n_crossings > 0)
    start %= len(points)
    again = pf.arrange(np.roll(drawn.curve.points, -start, axis=0), general_position="raise")
    assert again.gauss_code() == rotated(drawn, int((drawn.visit_edge < start).sum()))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32))
def test_the_other_direction_gives_the_same_code(seed):
    points = np.array(random_polygon(np.random.default_rng(seed), 14), dtype=float)
    drawn = pf.arrange(points, general_position="raise")
    assume(drawn.turning_number > 0)
    there = drawn.curve.points
    back = pf.arrange(np.concatenate([there[:1], there[:0:-1]]), general_position="raise")
    assert back.reversed
    assert back.gauss_code() == drawn.gauss_code()
    assert np.array_equal(back.visit_edge, drawn.visit_edge)
    assert np.array_equal(back.curve.points, there)
    np.testing.assert_allclose(back.crossings, drawn.crossings, rtol=1e-9, atol=1e-6)


def steady_loop(rng, vertices):
    """A thin loop that begins in the middle of its long side, which runs steadily up to the right."""
    there = np.cumsum(rng.uniform(0.1, 1.0, (vertices, 2)), axis=0) * 9 / vertices
    back = there[-2:0:-1] + np.array([0.1, -0.1])
    loop = np.concatenate([there, back[:: max(1, len(back) // 3)]])
    begin = vertices // 2
    return np.roll(loop, -begin, axis=0) - loop[begin] + rng.uniform(-2, 2) + rng.uniform(-0.3, 0.3, 2)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.lists(st.integers(3, 40), min_size=2, max_size=4))
def test_contacts_of_loops_that_follow_each_other(seed, vertices):
    """The strands of loops, one after the other, run the same way and cross: they are not one strand."""
    rng = np.random.default_rng(seed)
    polygons = [steady_loop(rng, count) for count in vertices]
    first = np.cumsum([0, *map(len, polygons)])
    found = find_contacts(np.concatenate(polygons), first_point=first)
    meetings = loops_reference.meetings([reference.exact(points) for points in polygons])
    numbered = [[first[place.loop] + place.edge for place in pair] for pair in meetings]
    assert sorted(found.edges.tolist()) == sorted(map(sorted, numbered))
    assert len(found.touches) == 0
