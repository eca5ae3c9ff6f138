"""Arrangements of several loops against exact fractions, on polygons whose heights and places coincide often."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.arrangement.arrangement import arrange
from plyfold.arrangement.polylines import winding_number
from plyfold.errors import CurveError, GeneralPositionError, InputError, PlyfoldError
from reference.crossings import DegenerateError
from reference.loops import loop_borders
from reference.random_curves import random_polygon, without_repeats

NUMBERS = [
    "partner", "ccw", "outer", "first_visit", "next_dart", "cell_of_dart", "cell_start", "cell_darts", "winding",
    "turning_numbers", "crossing_of_visit", "bridges", "crossings", "visit_edge", "reversed", "border_before",
    "border_after", "next_border", "start_visit", "loop_of_border", "cycle_start", "cusp_index", "marks",
]  # fmt: skip


def random_loops(rng, size):
    """Loops of up to six vertices, some of them shrunk, which makes many of them lie apart or inside others."""
    for _ in range(int(rng.integers(1, 5))):
        scale = int(rng.choice([1, 1, 3, 8]))
        shift = rng.integers(-size // 2, size // 2 + 1, 2)
        polygon = random_polygon(rng, int(rng.integers(3, 7)), max(1, size // scale))
        yield without_repeats([(x + int(shift[0]), y + int(shift[1])) for x, y in polygon])


def begins_at_crossing(found, borders):
    """Whether each of some borders begins at a crossing: not at a mark, and not nowhere."""
    return np.isin(found.start_visit[borders], found.crossing_visits)


def whole_borders(found):
    """For each border, the one of its pieces between crossings that begins at the crossing, or the loop's first."""
    is_whole = begins_at_crossing(found, np.arange(found.n_borders))
    whole = np.arange(found.n_borders)
    for loop in range(found.n_loops):
        borders = np.flatnonzero(found.loop_of_border == loop)
        first = borders[is_whole[borders]]
        if len(first) == 0:
            whole[borders] = borders[0]
        for border in borders[~is_whole[borders]] if len(first) else ():
            earlier = first[first < border]
            whole[border] = (earlier if len(earlier) else first)[-1]
    return whole


def as_in_reference(found):
    """The whole borders in the order of the reference, where those of loops without crossings come last."""
    whole = np.unique(whole_borders(found))
    alone = ~begins_at_crossing(found, whole)
    return np.concatenate([whole[~alone], whole[alone]])


def assert_as_in_fractions(polygons):
    given = loop_borders(polygons)
    turned = max(given.left_winding) <= 0
    expected = loop_borders([polygon[:1] + polygon[:0:-1] for polygon in polygons]) if turned else given
    found = arrange(polygons)
    if len(polygons) == 1:
        assert_same(found, arrange(polygons[0]))
        expected = loop_borders([found.curve.points.tolist()])
    else:
        assert found.reversed == turned
    found.check()
    order, whole = as_in_reference(found), whole_borders(found)
    assert (found.winding[found.left_cell] == found.winding[found.left_cell[whole]]).all()
    assert tuple(found.winding[found.left_cell][order].tolist()) == expected.left_winding
    assert tuple((found.winding[found.right_cell] + 1)[order].tolist()) == expected.left_winding
    first = np.flatnonzero(found.ccw)
    second, before, after = found.partner[first], found.border_before, found.border_after
    four = np.stack([before[first], after[first], after[second], before[second]], axis=1)
    place = {border: number for number, border in enumerate(order.tolist())}
    rows = {tuple(place[border] for border in row) for row in whole[four].tolist()}
    assert rows == set(expected.crossings)
    assert_marks_are_where_they_are(found)
    return found


def assert_marks_are_where_they_are(found):
    """Visits come in order along their edges, and the feet of bridges face each other at one height."""
    is_mark = found.crossing_of_visit < 0
    assert not found.ccw[is_mark].any()
    assert (np.diff(found.visit_edge) >= 0).all()
    assert found.n_crossings == (~is_mark).sum() // 2
    for pair in found.bridges.tolist():
        feet = [foot_of(found, dart) for dart in pair]
        assert all(found.partner[foot] == foot for foot in feet)
        (x, y), (beyond, height) = found.visit_point[feet]
        assert height == y
        assert beyond < x


def foot_of(found, dart):
    """The visit at which a dart starts."""
    border, backward = divmod(dart, 2)
    return int(found.start_visit[found.next_border[border] if backward else border])


def assert_same(first, second):
    """All numbers of two arrangements are the same."""
    for name in NUMBERS:
        assert np.array_equal(getattr(first, name), getattr(second, name)), name


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
                arrange(polygons, general_position="raise")
            assert caught.value.where
        else:
            outside = found.cell_of_dart.reshape(-1, 2).min(axis=1) == 0
            nested += len(set(found.loop_of_border.tolist()) - set(found.loop_of_border[outside].tolist()))
            assert len(found.winding) == 1 + euler_cells(found)
            assert_cells_are_walked_round(found)
    assert nested >= 2, "some loops lie inside others"
    assert size > 100 or degenerate > 10


def euler_cells(found):
    """Bounded cells, by Euler's formula: V − E + F = 1 + C, where loops without crossings count with one vertex."""
    groups = list(range(found.n_loops))
    for visit, partner in enumerate(found.partner.tolist()):
        a, b = (groups[found.loop_of_border[found.border_after[v]]] for v in (visit, partner))
        groups = [a if group == b else group for group in groups]
    return found.n_crossings + len(set(groups))


def assert_cells_are_walked_round(found):
    """Cycles follow each other by their lowest darts, cells too; bridges join all cycles of bounded cells."""
    bridges = found.bridges.tolist()
    assert found.n_cells == found.n_crossings + 1 + found.group_of_loop.max() + 1
    assert all(found.cell_of_dart[dart] > 0 for pair in bridges for dart in pair)
    lowest = []
    for cell, darts in enumerate(found.cells):
        assert {found.cell_of_dart[dart] for dart in darts} == {cell}
        cycles = cycles_of(found, cell)
        assert [dart for cycle in cycles for dart in cycle] == list(darts)
        assert [cycle[0] for cycle in cycles] == sorted(min(cycle) for cycle in cycles)
        lowest.append(cycles[0][0])
        here = [pair for pair in bridges if found.cell_of_dart[pair[0]] == cell]
        assert all(found.cell_of_dart[other] == cell for _, other in here)
        assert cell == 0 or len(here) == len(cycles) - 1
        assert len(found.cell_outlines(cell)) == len(cycles)
    assert lowest[1:] == sorted(lowest[1:])


def cycles_of(found, cell):
    """The boundary cycles of a cell, by walking."""
    left, cycles = set(found.cells[cell]), []
    while left:
        cycle = [min(left)]
        while (following := int(found.next_dart[cycle[-1]])) != cycle[0]:
            cycle.append(following)
        cycles.append(cycle)
        left -= set(cycle)
    return cycles


def is_curve(polygon):
    try:
        arrange(polygon)
    except (CurveError, GeneralPositionError):
        return False
    return True


def test_a_list_of_one_curve_is_that_curve():
    rng = np.random.default_rng(6)
    for _ in range(20):
        polygon = random_polygon(rng, 9)
        assert_same(arrange([polygon]), arrange(polygon))
        assert arrange([pf.Curve(polygon)]).curve.points.tolist() == arrange(polygon).curve.points.tolist()


def diamond(radius):
    return [(radius, 0), (0, radius), (-radius, 0), (0, -radius)]


def test_diamonds_inside_each_other_have_their_corners_at_one_height():
    found = arrange([diamond(radius) for radius in (3, 1, 5, 2, 4)])
    found.check()
    inner = found.loop_of_border != 2
    assert set(found.cell_of_dart[found.bridges[:, 0]].tolist()) == set(found.right_cell[inner].tolist())
    assert [found.winding[found.cell_of_dart[dart]] for dart, _ in found.bridges.tolist()] == [1, 2, 3, 4]
    assert sorted(found.winding.tolist()) == [0, 1, 2, 3, 4, 5]
    assert found.loop_of_border.tolist() == [0, 0, 1, 2, 3, 3, 4, 4]
    assert found.winding[found.left_cell].tolist() == [3, 3, 5, 1, 4, 4, 2, 2]


def test_a_crossing_at_the_height_of_a_loop_inside():
    """A ray to the left from the corner of the small loop meets a crossing."""
    small = [(2, 0), (3, 0), (3, 1)]
    for bow_tie in ([(-4, -4), (4, 4), (4, -4), (-4, 4)], [(4, 4), (-4, -4), (-4, 4), (4, -4)]):
        for start in range(4):
            turned = bow_tie[start:] + bow_tie[:start]
            for polygons in ([turned, small], [turned[::-1], small[::-1]], [small, turned]):
                assert_as_in_fractions(polygons)


@pytest.mark.parametrize("other", [diamond(4), [(4, 0), (9, 0), (9, 9)], [(2, 2), (9, 9), (9, 0)]])
def test_copies_and_touching_loops(other):
    """They are refused with their places, or moved apart."""
    with pytest.raises(GeneralPositionError, match="vertices on other edges"):
        arrange([diamond(4), other], general_position="raise")
    found = arrange([diamond(4), other])
    found.check()
    assert {repair.kind for repair in found.outline.repairs} == {"vertex moved"}
    assert_as_in_fractions([loop.tolist() for loop in found.outline.loops])


def test_three_edges_of_several_loops_through_a_point():
    loops = [[(-2, 0), (2, 0), (0, 5)], [(-1, -1), (1, 1), (0, 3)], [(-1, 1), (1, -1), (9, -5), (9, 9)]]
    with pytest.raises(GeneralPositionError, match=r"three edges: [1-9]") as caught:
        arrange(loops, general_position="raise")
    assert (0, 0) in caught.value.where
    found = arrange(loops)
    found.check()
    assert_as_in_fractions([loop.tolist() for loop in found.outline.loops])


def test_no_loop():
    with pytest.raises(InputError):
        arrange([])


def test_touching_loops_nested_in_a_touching_one():
    """Inside a square that touches its copy, small loops that touch each other and one of its corners."""
    square = [(0, 0), (9, 0), (9, 9), (0, 9)]
    inside = [[(0, 0), (2, 1), (1, 2)], [(1, 2), (2, 1), (3, 3)], [(5, 5), (6, 5), (6, 6)], [(6, 6), (6, 5), (7, 5)]]
    found = arrange([square, square, *inside])
    found.check()
    assert_as_in_fractions([loop.tolist() for loop in found.outline.loops])


OUTER = [(0, 0), (9, 0), (9, 9), (0, 9)]
HOLE = [(1, 2), (1, 4), (3, 4), (3, 2)]
EIGHT = [(20, 0), (22, 2), (22, 0), (20, 2)]


def test_numbers_of_several_loops():
    """Visits and borders loop by loop; a loop without crossings has one border, in its place."""
    found = arrange([HOLE, EIGHT, OUTER])
    assert found.first_visit.tolist() == [0, 1, 3, 4]
    assert found.loop_of_border.tolist() == [0, 1, 1, 2]
    assert found.start_visit.tolist() == [0, 1, 2, 3]
    assert found.partner.tolist() == [0, 2, 1, 3]
    assert found.next_border.tolist() == [0, 2, 1, 3]
    assert (found.border_before.tolist(), found.border_after.tolist()) == ([0, 2, 1, 3], [0, 1, 2, 3])
    assert found.visit_edge.tolist() == [0, 4, 6, 11]
    assert found.visit_point[[0, 3]].tolist() == [[1, 2], [0, 2]]
    assert arrange([EIGHT, [(0, 0), (1, 0), (0, 1)]]).start_visit.tolist() == [0, 1, -1]
    assert found.turning_numbers == (-1, 0, 1)
    assert found.turning_number == 0
    assert found.n_cells == 1 + 3 + 1
    ring = found.cell_of_dart[6]
    assert found.cells[ring] == (0, 6)
    assert [len(outline) for outline in found.cell_outlines(ring)] == [4, 4]
    assert found.bridges.tolist() == [[0, 6]]
    assert len(found.cell_outlines(0)) == 2
    with pytest.raises(PlyfoldError, match="2 boundary polygons"):
        found.cell_outline(ring)


@pytest.mark.parametrize("loops", [[OUTER, HOLE], [OUTER, [*OUTER[:1], (9, 1), (8, 9)]], [HOLE, EIGHT, OUTER]])
def test_points_of_cells_lie_in_them(loops):
    moved = [[(x + 0.1 * i, y + 0.2 * i) for x, y in loop] for i, loop in enumerate(loops)]
    found = arrange(moved)
    for cell in range(found.n_cells):
        around = sum(winding_number(loop, found.cell_point(cell)) for loop in found.outline.loops)
        assert around == found.winding[cell]


OUTER_FLOATS, EIGHT_FLOATS = np.array(OUTER, float).tolist(), np.array(EIGHT, float).tolist()


def test_outlines_are_turned_round_together_or_not_at_all():
    """All loops turn if no winding number is positive; with both signs, nothing turns."""
    kept, turned = arrange([OUTER, HOLE]), arrange([OUTER[::-1], HOLE[::-1]])
    assert (kept.reversed, turned.reversed) == (False, True)
    assert sorted(turned.winding.tolist()) == sorted(kept.winding.tolist()) == [0, 0, 1]
    assert turned.outline.points[0].tolist() == [0, 9]
    assert [loop.tolist() for loop in arrange([OUTER, EIGHT]).outline.loops] == [OUTER_FLOATS, EIGHT_FLOATS]
    assert not arrange([OUTER[::-1], EIGHT]).reversed


def test_what_is_there_for_one_curve_alone_says_so():
    several = [OUTER, HOLE]
    for ask in (pf.blank_word, pf.GaussCode.of, pf.lobe_turning_numbers, pf.irreducible_kernels):
        with pytest.raises(InputError, match="for one closed curve alone, and the outline has 2 loops"):
            ask(several)
    with pytest.raises(InputError, match="one closed curve alone"):
        _ = arrange(several).curve
    assert repr(arrange(several)) == "<Arrangement of 2 curves: 0 crossings, turning number 0>"


def test_marks_on_one_edge_come_in_order():
    """Small loops whose leftmost corners see the same edge, some at one height and some beside a crossing."""
    low, high = [(1, 3), (2, 3), (2, 2)], [(4, 3), (5, 3), (5, 2)]
    other = [(7, 3), (8, 4), (8, 3)]
    for outer, more in ((OUTER, []), (OUTER[::-1], [EIGHT])):
        found = assert_as_in_fractions([outer, low, high, other, *more])
        assert found.first_visit[1] == 3
        assert found.visit_point[:3].tolist() == [[0, 3]] * 3
        # Bridges that leave one edge at one height keep the order of their loops, the one from further right above.
        feet = [foot_of(found, dart) for _, dart in found.bridges.tolist()]
        assert feet == ([0, 1, 2] if more else [2, 1, 0])


def test_a_cusp_at_the_foot_of_a_bridge_comes_first():
    outline = pf.Outline([OUTER, HOLE], {(1, 0): 1, (0, 2): 2})
    found = arrange(outline)
    found.check()
    assert found.cusp_index.tolist() == [2, 0, 1, 0]
    assert found.visit_edge.tolist() == [2, 3, 4, 4]
    assert found.euler_characteristic == -3
    assert [points.tolist()[0] for points in map(found.border_points, range(4))] == [[9, 9], [0, 2], [1, 2], [1, 2]]
