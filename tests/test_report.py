"""The figures of the verdict are those of the drawing as given: counted in fractions, by the definitions."""

from collections import Counter
from itertools import combinations

import numpy as np
import pytest

import plyfold as pf
from plyfold.errors import CurveError
from plyfold.report import describe, verdict
from reference.contacts import exact, random_touching, random_touching_loops, without_spikes
from reference.crossings import edges, side
from reference.pieces import Classes
from reference.settled import lies_on
from reference.touching_drawings import touching_drawing

BOW = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
# A ramp that lies over itself, and whose crossings are all at vertices; and the same with one of them beside.
RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (5, -3), (5, 0), (5, 5), (8, 5), (8, 1), (5, 1), (3, 1), (0, 1)]
BESIDE = [point for point in RAMP if point not in [(5, 0), (5, 1), (3, 1)]]
# A square walked twice along one side, on both of which there is cloth: moved apart, there is a cell between.
FLAPS = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 3), (2, 3), (2, 1), (0, 1)]


def crossings_of(loops):
    """How often two edges cross inside both."""
    every = [edge for loop in loops for edge in edges(loop)]
    return sum(
        side(*one, other[0]) * side(*one, other[1]) < 0 and side(*other, one[0]) * side(*other, one[1]) < 0
        for one, other in combinations(every, 2)
    )


def contacts_of(loops):
    """Places of points on other points, or on edges that neither start nor end there."""
    every = [(point, edge) for loop in loops for point, edge in zip(loop, edges(loop), strict=True)]
    ends = [point for point, _ in every]
    return {
        place
        for place in ends
        if ends.count(place) > 1 or any(lies_on(place, edge) and place not in edge for _, edge in every)
    }


def cells_of(loops):
    """How many faces have each winding number; those that are parted by strands run to and fro count once."""
    drawing, cells = touching_drawing(loops), Classes()
    runs = Counter(drawing.strands)
    for part in range(drawing.n_edges):
        if runs[2 * part] == runs[2 * part + 1]:
            cells.join(drawing.left(part), drawing.right(part))
    return Counter(drawing.winding[cell] for cell in {cells.of(cell) for cell in range(len(drawing.winding))})


def judge(outline):
    """Compare all figures that a drawing itself tells."""
    drawn = pf.arrange(outline)
    figures, loops = verdict(drawn), list(map(exact, drawn.given.loops))
    assert figures["crossings"] == crossings_of(loops)
    assert set(map(tuple, figures["contacts"])) == contacts_of(loops)
    assert figures["crossings_moved_apart"] == drawn.n_crossings >= figures["crossings"]
    cells = cells_of(loops)
    assert figures["cells"] == cells
    if figures["immersible"]:
        assert figures["sheets"] == sum(winding * count for winding, count in cells.items())
    if figures["immersible"] and figures["layerable"]:
        assert figures["levels"] == max(cells)
    return figures


@pytest.mark.parametrize(
    ("outline", "crossings", "apart", "levels"),
    [(BOW, 0, 0, 1), (RAMP, 1, 4, 2), (BESIDE, 4, 4, 2), (FLAPS, 0, 0, 1)],
)
def test_known_outlines(outline, crossings, apart, levels):
    figures = judge(outline)
    assert (figures["crossings"], figures["crossings_moved_apart"], figures["levels"]) == (crossings, apart, levels)


def test_random_outlines():
    moved = 0
    for seed in range(70):
        rng = np.random.default_rng(seed)
        for loops in ([random_touching(rng)], random_touching_loops(rng)):
            loops = [without_spikes(exact(loop)) for loop in loops]  # noqa: PLW2901
            try:
                figures = judge([[tuple(map(float, place)) for place in loop] for loop in loops])
            except CurveError:  # nothing is left
                continue
            moved += figures["crossings_moved_apart"] > figures["crossings"]
    assert moved > 10


def test_cells_that_only_the_moves_make_are_not_counted():
    """The cut is run there and back; moved apart it is a cell with two sheets, and two levels."""
    keyhole = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]
    drawn = pf.arrange(keyhole)
    figures = judge(keyhole)
    assert (figures["sheets"], figures["levels"]) == (1, 1)
    assert pf.find_layering(pf.find_immersion(drawn)).level.max() == drawn.winding.max() == 2


def test_in_words():
    said = describe(verdict(pf.arrange(BOW)))
    for line in (
        "  crossings                   0\n",
        "  in contact at               (1, 1)\n",
        "  crossings when moved apart  0\n",
        "  cut there                   2 pieces of cloth: 2 disks; Euler characteristic 2\n",
    ):
        assert line in said


def test_nothing_more_is_said_without_contacts():
    said = describe(verdict(pf.arrange(BESIDE)))
    assert "apart" not in said
    assert "cut" not in said
