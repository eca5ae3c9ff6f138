"""The tree over the cells, the word and the levels, as they are drawn."""

from itertools import pairwise

import numpy as np
import pytest
import shapely

import plyfold as pf
from plyfold import draw
from plyfold.colours import ACCENT, INK
from plyfold.draw.placement import Frame, closed
from plyfold.errors import InputError, PlyfoldError
from plyfold.gallery import CURVES, OUTLINES

DRAWN = ["circle", "limacon", "figure-eight", "exit-ramp", "milnor", "bennequin", "pretzel", "stacked-spiral"]


def ways(ax):
    """The links of the tree: all lines but the curve, which is grey."""
    return [line for line in ax.lines if line.get_color() in (INK, ACCENT)]


@pytest.mark.parametrize("name", DRAWN)
def test_each_link_crosses_the_curve_once(name):
    curve = CURVES[name].curve
    ax = draw.plot_dual_tree(curve)
    ring = shapely.LinearRing(Frame(curve.points)(closed(curve.points)))
    assert len(ways(ax)) == pf.arrange(curve).n_cells - 1
    for way in ways(ax):
        met = shapely.intersection(shapely.LineString(way.get_xydata()).buffer(1e-9), ring)
        assert shapely.get_num_geometries(met) == 1
        assert met.length < 1e-6


def test_links_lead_down_unless_they_are_coloured():
    arranged = pf.arrange(CURVES["pretzel"].curve)
    frame = Frame(arranged.outline.points)
    polygons = [shapely.Polygon(frame(ring[0])) for ring in map(arranged.cell_outlines, range(1, arranged.n_cells))]

    def winding(place):
        return next((int(arranged.winding[i + 1]) for i, p in enumerate(polygons) if p.covers(shapely.Point(place))), 0)

    for way in ways(draw.plot_dual_tree(arranged)):
        start, end = way.get_xydata()[[0, -1]]
        assert winding(end) - winding(start) == (1 if way.get_color() == ACCENT else -1)


def test_cells_from_which_a_way_goes_up_have_the_names_of_the_letters():
    curve = CURVES["bennequin"].curve
    names = [text.get_text() for text in draw.plot_dual_tree(curve).texts]
    assert sorted(names) == sorted({letter.label for letter in pf.blank_word(curve).letters})
    ups = [way for way in ways(draw.plot_dual_tree(curve)) if way.get_color() == ACCENT]
    assert len(ups) == len(names)


def test_trees_of_several_loops_have_no_letters():
    ring = OUTLINES[next(name for name, known in OUTLINES.items() if pf.arrange(known.outline).n_loops > 1)].outline
    ax = draw.plot_dual_tree(ring)
    assert not ax.texts
    assert len(ways(ax)) == pf.arrange(ring).n_cells - 1


def test_codes_alone_have_no_tree_to_draw():
    with pytest.raises(PlyfoldError):
        draw.plot_dual_tree(pf.GaussCode.parse("1+ 1- / outer 1"))


def test_brackets_are_the_groupings():
    word = pf.blank_word(CURVES["milnor"].curve)
    ends = [sorted(patch.get_path().vertices[:, 0].round(6)) for patch in draw.plot_word(word).patches]
    drawn = sorted((x[0], x[-1]) for x in ends)
    assert drawn == sorted(tuple(sorted(pair)) for grouping in word.groupings() for pair in grouping)


def test_words_say_what_they_leave_out():
    bennequin = pf.blank_word(CURVES["bennequin"].curve)
    assert draw.plot_word(bennequin, most=2).texts[-1].get_text() == "2 of more groupings"
    assert "groupings" not in draw.plot_word(bennequin, most=5).texts[-1].get_text()
    assert draw.plot_word(pf.blank_word(CURVES["circle"].curve)).texts[-1].get_text().startswith("The word is empty")
    assert draw.plot_word(pf.blank_word(CURVES["kinked-circle"].curve)).texts[-1].get_text().startswith("No grouping")
    with pytest.raises(InputError):
        draw.plot_word(bennequin, most=0)


@pytest.mark.parametrize("name", ["horseshoe", "exit-ramp", "milnor", "smallest-unliftable"])
def test_round_a_crossing_every_border_ends_one_sheet_and_keeps_the_others_in_order(name):
    layering = pf.find_embedding(CURVES[name].curve)
    arranged = layering.immersion.arrangement
    for crossing in range(arranged.n_crossings):
        ax = draw.plot_levels(layering, crossing)
        windings = [int(text.get_text()[4:]) for text in ax.texts if text.get_text().startswith("w = ")]
        top = windings[0]
        assert windings == [top, top - 1, top - 2, top - 1, top]
        glued = [line.get_xydata() for line in ax.lines if line.get_linewidth() == 1.6]
        assert len(glued) == sum(min(pair) for pair in pairwise(windings))
        for x in np.arange(4) + 0.5:
            at = sorted(sorted(way.tolist()) for way in glued if way[:, 0].min() < x < way[:, 0].max())
            assert sorted(right[1] for _, right in at) == [right[1] for _, right in at]
        assert len(ax.collections) == 4


def test_other_crossings_are_refused():
    layering = pf.find_embedding(CURVES["exit-ramp"].curve)
    for crossing in (-1, 4):
        with pytest.raises(InputError, match="no crossing"):
            draw.plot_levels(layering, crossing)
