"""Arrangements of several loops against exact fractions, on polygons whose heights and places coincide often."""

import numpy as np
import pytest

from plyfold.arrangement.arrangement import arrange
from plyfold.arrangement.several import arrange_loops
from plyfold.errors import CurveError, GeneralPositionError, InputError
from reference.crossings import DegenerateError
from reference.loops import loop_borders
from reference.random_curves import random_polygon, without_repeats


def random_loops(rng, size):
    """Loops of up to six vertices, some of them shrunk, which makes many of them lie apart or inside others."""
    for _ in range(int(rng.integers(1, 5))):
        scale = int(rng.choice([1, 1, 3, 8]))
        shift = rng.integers(-size // 2, size // 2 + 1, 2)
        polygon = random_polygon(rng, int(rng.integers(3, 7)), max(1, size // scale))
        yield without_repeats([(x + int(shift[0]), y + int(shift[1])) for x, y in polygon])


def assert_as_in_fractions(polygons):
    expected = loop_borders(polygons)
    found = arrange_loops(polygons)
    assert tuple(found.winding[found.left_cell].tolist()) == expected.left_winding
    assert tuple((found.winding[found.right_cell] + 1).tolist()) == expected.left_winding
    before = found.border_before
    four = np.stack([before[found.first], found.first, found.second, before[found.second]], axis=1)
    assert set(map(tuple, four.tolist())) == set(expected.crossings)
    return found


@pytest.mark.parametrize(("size", "seed"), [(1000, 1), (9, 2), (6, 3)])
def test_random_loops(size, seed):
    rng = np.random.default_rng(seed)
    nested, degenerate = 0, 0
    for _ in range(100):
        polygons = [polygon for polygon in random_loops(rng, size) if is_curve(polygon)]
        if not polygons:
            continue
        try:
            found = assert_as_in_fractions(polygons)
        except DegenerateError:
            degenerate += 1
            with pytest.raises(GeneralPositionError) as caught:
                arrange_loops(polygons)
            assert caught.value.where
        else:
            outside = found.cell_of_dart.reshape(-1, 2).min(axis=1) == 0
            nested += len(set(found.loop_of_border.tolist()) - set(found.loop_of_border[outside].tolist()))
            assert len(found.winding) == 1 + euler_cells(found)
    assert nested >= 2, "some loops lie inside others"
    assert size > 100 or degenerate > 10


def euler_cells(loops):
    """Bounded cells, by Euler's formula: V − E + F = 1 + C, where loops without crossings count with one vertex."""
    groups = list(range(len(loops.curves)))
    for visits in zip(loops.first.tolist(), loops.second.tolist(), strict=True):
        a, b = (groups[loops.loop_of_border[visit]] for visit in visits)
        groups = [a if group == b else group for group in groups]
    return len(loops.crossings) + len(set(groups))


def is_curve(polygon):
    try:
        arrange(polygon)
    except (CurveError, GeneralPositionError):
        return False
    return True


def test_one_loop_is_the_arrangement_of_the_curve():
    rng = np.random.default_rng(6)
    for _ in range(20):
        polygon = random_polygon(rng, 9)
        alone = arrange(polygon)
        if not alone.reversed:
            loops = arrange_loops([polygon])
            assert loops.crossings.tolist() == alone.crossings.tolist()
            assert loops.crossing_of_visit.tolist() == alone.crossing_of_visit.tolist()
            expected = alone.winding[alone.cell_of_dart]
            assert loops.winding[loops.cell_of_dart].tolist() == expected.tolist()
            assert loops.turning_number.tolist() == [alone.turning_number]


def diamond(radius):
    return [(radius, 0), (0, radius), (-radius, 0), (0, -radius)]


def test_diamonds_inside_each_other_have_their_corners_at_one_height():
    found = arrange_loops([diamond(radius) for radius in (3, 1, 5, 2, 4)])
    assert sorted(found.winding.tolist()) == [0, 1, 2, 3, 4, 5]
    assert found.winding[found.left_cell].tolist() == [3, 5, 1, 4, 2]


def test_a_crossing_at_the_height_of_a_loop_inside():
    """A ray to the left from the corner of the small loop meets a crossing."""
    small = [(2, 0), (3, 0), (3, 1)]
    for bow_tie in ([(-4, -4), (4, 4), (4, -4), (-4, 4)], [(4, 4), (-4, -4), (-4, 4), (4, -4)]):
        for start in range(4):
            turned = bow_tie[start:] + bow_tie[:start]
            for polygons in ([turned, small], [turned[::-1], small[::-1]], [small, turned]):
                assert_as_in_fractions(polygons)


def test_copies_and_touching_loops_are_refused():
    for other in (diamond(4), [(4, 0), (9, 0), (9, 9)], [(2, 2), (9, 9), (9, 0)]):
        with pytest.raises(GeneralPositionError, match="vertices on other edges"):
            arrange_loops([diamond(4), other])
    with pytest.raises(GeneralPositionError, match=r"three edges: [1-9]") as caught:
        arrange_loops([[(-2, 0), (2, 0), (0, 5)], [(-1, -1), (1, 1), (0, 3)], [(-1, 1), (1, -1), (9, -5), (9, 9)]])
    assert (0, 0) in caught.value.where
    with pytest.raises(InputError, match="no curve"):
        arrange_loops([])
