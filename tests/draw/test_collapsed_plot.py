import numpy as np
import pytest
import shapely
from matplotlib.colors import to_hex

from painted import painted
from plyfold import arrange, find_layering, immersions
from plyfold.colours import INK, OBSTRUCTION, sheet_colour
from plyfold.draw import plot_collapsed_graph, plot_marked_cell
from plyfold.errors import InputError
from reference.random_curves import BENNEQUIN_LIKE

RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]


@pytest.fixture(params=range(5))
def immersion(request):
    return list(immersions(arrange(BENNEQUIN_LIKE)))[request.param]


def deepest(immersion):
    return int(immersion.arrangement.winding.argmax())


def dark_lines(ax):
    return [line.get_xydata() for line in ax.lines if to_hex(line.get_color()) == INK]


def own_sheets(immersion, cell):
    return immersion.own_sheet[immersion.arrangement.left_cell == cell].tolist()


def nodes(ax):
    return np.concatenate([dots.get_offsets() for dots in ax.collections])


def test_four_sheets_are_four_nodes_in_their_colours(immersion):
    ax = plot_collapsed_graph(immersion, deepest(immersion))
    assert len(nodes(ax)) == 4
    drawn = {to_hex(dots.get_facecolor()[0]) for dots in ax.collections}
    assert drawn == {sheet_colour(sheet) for sheet in own_sheets(immersion, deepest(immersion))}


def test_lines_join_nodes_whose_borders_follow_each_other(immersion):
    ax = plot_collapsed_graph(immersion, deepest(immersion))
    colours = {tuple(d.get_offsets()[0]): to_hex(d.get_facecolor()[0]) for d in ax.collections}
    drawn = {frozenset(colours[tuple(end)] for end in line) for line in dark_lines(ax)}
    sheets = own_sheets(immersion, deepest(immersion))
    pairs = zip(sheets, sheets[1:] + sheets[:1], strict=True)
    assert drawn == {frozenset(map(sheet_colour, pair)) for pair in pairs if len(set(pair)) == 2}


def test_lines_of_these_graphs_do_not_cross(immersion):
    ax = plot_collapsed_graph(immersion, deepest(immersion))
    lines = [shapely.LineString(line) for line in dark_lines(ax)]
    assert not any(a.crosses(b) for i, a in enumerate(lines) for b in lines[:i])


def test_own_borders_stand_round_it(immersion):
    ax = plot_collapsed_graph(immersion, deepest(immersion))
    borders = np.flatnonzero(immersion.arrangement.left_cell == deepest(immersion))
    outside = {text.get_text() for text in ax.texts if np.hypot(*text.get_position()) > 1}
    assert outside == set(map(str, borders.tolist()))


def test_levels_of_a_layering():
    immersion = next(i for i in immersions(arrange(BENNEQUIN_LIKE)) if find_layering(i))
    ax = plot_collapsed_graph(immersion, deepest(immersion), layering=find_layering(immersion))
    inside = [text.get_text() for text in ax.texts if np.hypot(*text.get_position()) < 1]
    assert sorted(inside) == ["1", "2", "3", "4"]


def test_tree_is_heavy_and_other_edges_are_pale():
    (ramp,) = immersions(arrange(RAMP))
    ax = plot_collapsed_graph(ramp, deepest(ramp), tree=[(0, 1)])
    assert [line.get_linewidth() for line in ax.lines if to_hex(line.get_color()) == INK] == [4.0]
    pale = plot_collapsed_graph(ramp, deepest(ramp), tree=[(7, 8)])
    assert dark_lines(pale) == []


def test_no_such_cell():
    (ramp,) = immersions(arrange(RAMP))
    with pytest.raises(InputError, match="no cell 17"):
        plot_collapsed_graph(ramp, 17)


def test_marked_cell_is_red():
    """The cell with winding number 2 is the unit square from (3, 0) to (4, 1), in a drawing 9 units wide and high."""
    arranged = arrange(RAMP)
    ax = plot_marked_cell(arranged, int(arranged.winding.argmax()))
    (red,) = [patch for patch in ax.patches if to_hex(patch.get_facecolor()) == OBSTRUCTION]
    drawn = shapely.affinity.affine_transform(painted(red), (9, 0, 0, 9, 4.5, 1.5))
    assert drawn.symmetric_difference(shapely.box(3, 0, 4, 1)).area == pytest.approx(0, abs=1e-9)
