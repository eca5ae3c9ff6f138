from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
import shapely
from matplotlib.colors import to_hex
from matplotlib.patches import FancyArrowPatch, PathPatch

import plyfold as pf
from coarse import CURVES
from painted import painted
from plyfold.colours import OBSTRUCTION, sheet_colour
from plyfold.draw import plot_obstruction
from plyfold.errors import InputError
from plyfold.layering.levels.casing import embed_cased
from plyfold.obstruction import Obstruction


@pytest.fixture(scope="module")
def refused():
    """The first immersion of the Bennequin-like curve that does not lift, and why."""
    answers = ((i, pf.find_layering(i)) for i in pf.immersions(CURVES["bennequin"].curve))
    return next((i, found) for i, found in answers if not found)


def unit(points, curve):
    """Places as in the picture: the middle of the drawing's box at the origin, its longer side 1."""
    low, high = curve.points.min(axis=0), curve.points.max(axis=0)
    return (np.asarray(points) - (low + high) / 2) / (high - low).max()


def cells_with(ax, arrangement):
    """The numbers written into each cell."""
    written = {}
    for text in ax.texts:
        if text.get_bbox_patch() is not None:
            for cell in range(1, arrangement.n_cells):
                outline = shapely.Polygon(unit(arrangement.cell_outline(cell), arrangement.curve))
                if outline.contains(shapely.Point(text.get_position())):
                    written[cell] = sorted(map(int, text.get_text().split()))
    return written


def chips(ax):
    """Places and sheets of the small squares below the drawing."""
    small = (t for t in ax.texts if t.get_fontsize() == 6.5 and t.get_fontweight() != "bold")
    return [(t.get_position(), int(t.get_text())) for t in small]


def test_cells_of_a_chain_are_numbered_in_order(refused):
    immersion, obstruction = refused
    expected = {}
    for number, (cell, _, _) in enumerate(obstruction.value, 1):
        expected.setdefault(cell, []).append(number)
    assert cells_with(plot_obstruction(immersion, obstruction), immersion.arrangement) == expected


def test_arrows_cross_borders_from_cell_to_cell(refused):
    immersion, obstruction = refused
    arrangement = immersion.arrangement
    outline = [
        shapely.Polygon(unit(arrangement.cell_outline(c), arrangement.curve)) for c in range(arrangement.n_cells)
    ]
    arrows = [p for p in plot_obstruction(immersion, obstruction).patches if isinstance(p, FancyArrowPatch)]
    steps = {(first[0], second[0]) for first, second in pairwise(obstruction.value)}
    drawn = set()
    for arrow in arrows:
        tail, tip = (shapely.Point(place) for place in arrow._posA_posB)
        drawn.add(tuple(next(c for c in range(1, len(outline)) if outline[c].contains(end)) for end in (tail, tip)))
    assert drawn == steps


def test_sheets_are_shown_at_every_step_the_upper_one_above(refused):
    immersion, obstruction = refused
    ax = plot_obstruction(immersion, obstruction)
    piles = {}
    for (x, y), sheet in chips(ax):
        piles.setdefault(round(x, 6), []).append((y, sheet))
    shown = [tuple(sheet for _, sheet in sorted(pile)) for _, pile in sorted(piles.items())]
    assert shown == [(lower, upper) for _, lower, upper in obstruction.value]
    below = [p for p in ax.patches if isinstance(p, PathPatch) and p.get_path().vertices[:, 1].max() < -0.4]
    expected = Counter(sheet_colour(s) for _, *pair in obstruction.value for s in pair)
    assert Counter(to_hex(p.get_facecolor()) for p in below) == expected
    assert " ".join(ax.texts[-1].get_text().split()) == str(obstruction)


def test_triples_and_fixed_orders_are_shown():
    immersion = pf.find_immersion(CURVES["stacked-spiral"].curve)
    (cell,) = [cell for cell, sheets in enumerate(immersion.sheets) if len(sheets) == 3]
    a, b, c = immersion.sheets[cell]
    circle = Obstruction("cyclic order", "Three sheets in a circle.", (), ((cell, [a, b, c]),))
    ax = plot_obstruction(immersion, circle)
    assert cells_with(ax, immersion.arrangement) == {cell: [1]}
    assert [sheet for _, sheet in chips(ax)] == [a, b, c]
    fixed = Obstruction("fixed orders", "No.", (), ((cell, a, b, "above"), (cell, a, b, "below")))
    ax = plot_obstruction(immersion, fixed)
    assert cells_with(ax, immersion.arrangement) == {cell: [1, 2]}
    (first_a, second_a), (first_b, second_b) = (sorted(p for p, sheet in chips(ax) if sheet == s) for s in (a, b))
    assert first_a[1] > first_b[1]
    assert second_a[1] < second_b[1]


def test_other_obstructions_have_their_places():
    kinked = pf.arrange(CURVES["kinked-circle"].curve)
    ax = plot_obstruction(kinked, pf.find_immersion(kinked))
    (negative,) = [p for p in ax.patches if to_hex(p.get_edgecolor()) == OBSTRUCTION]
    (cell,) = np.flatnonzero(kinked.winding < 0)
    assert painted(negative).equals(shapely.Polygon(unit(kinked.cell_outline(cell), kinked.curve)))
    ramp = pf.find_immersion([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    fault = embed_cased(ramp.arrangement, [True, True, False, True])
    ax = plot_obstruction(ramp, fault)
    place = unit(fault.where, ramp.arrangement.curve)
    assert np.asarray(ax.collections[-1].get_offsets()) == pytest.approx(place)


def test_obstruction_is_found_if_none_is_given():
    eight = CURVES["figure-eight"].curve
    assert " ".join(plot_obstruction(eight).texts[-1].get_text().split()) == str(pf.find_immersion(eight))
    unliftable = next(i for i in pf.immersions(CURVES["bennequin"].curve) if not pf.find_layering(i))
    sentence = " ".join(plot_obstruction(unliftable).texts[-1].get_text().split())
    assert sentence == str(pf.find_layering(unliftable))


def test_nothing_in_the_way_is_refused():
    with pytest.raises(InputError, match="nothing is in the way"):
        plot_obstruction(CURVES["circle"].curve)
