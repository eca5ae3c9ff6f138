"""Planar diagrams of knots: read, written, and refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import plyfold as pf
from plyfold.arrangement.planar_diagrams import gauss_of_diagram
from plyfold.errors import GaussCodeError
from reference.planar_maps import census, gauss_code

TREFOIL = [(1, 4, 2, 5), (3, 6, 4, 1), (5, 2, 6, 3)]
FIGURE_EIGHT = [(4, 2, 5, 1), (8, 6, 1, 5), (6, 3, 7, 4), (2, 7, 3, 8)]
CODES = [pf.GaussCode(*gauss_code(*code)) for k in range(1, 6) for code in census(k)]


def test_known_knots():
    for diagram, crossings in ((TREFOIL, 3), (FIGURE_EIGHT, 4)):
        code = pf.GaussCode.from_pd(diagram)
        assert code.n_crossings == crossings
        assert pf.GaussCode.from_pd(str(diagram)) == code
        assert pf.arrange(code.to_curve()).n_crossings == crossings
    assert gauss_of_diagram(FIGURE_EIGHT)[2].tolist() in ([False, True] * 4, [True, False] * 4)


def test_the_outer_cell_is_the_one_with_most_borders():
    code = pf.GaussCode.from_pd(FIGURE_EIGHT)
    arranged = pf.Arrangement.from_gauss(code.partner, code.ccw, code.outer)
    assert len(arranged.cells[0]) == max(map(len, arranged.cells))
    assert pf.GaussCode.from_pd(FIGURE_EIGHT, outer=3) == code.with_outer(3)


@given(st.sampled_from(CODES), st.randoms())
def test_diagrams_read_back(code, random):
    """With any strands above, any order of crossings and any names of edges."""
    over = np.zeros(len(code.partner), dtype=bool)
    for visit, other in enumerate(code.partner):
        if visit < other:
            over[random.choice([visit, other])] = True
    diagram = code.to_pd(over)
    assert sorted(label for labels in diagram for label in labels) == sorted(2 * list(range(1, len(over) + 1)))
    names = random.sample(range(100), len(over) + 1)
    below = next(place for place, labels in enumerate(diagram) if not over[labels[0] - 1])
    renamed = [tuple(names[label] for label in labels) for labels in (diagram[below:] + diagram[:below])]
    partner, ccw, read = gauss_of_diagram(renamed)
    start = diagram[below][0] - 1
    expected = code.rotated(start)
    assert (tuple(partner), tuple(ccw)) == (expected.partner, expected.ccw)
    assert read.tolist() == np.roll(over, -start).tolist()


@pytest.mark.parametrize(
    "diagram",
    [
        [],
        [(1, 2, 3)],
        [(1, 2, 3, 4), (1, 2)],
        [(1, 1, 1, 2)],
        [(1.5, 2, 1.5, 2)],
        "X[1, 2, 3]",
        [(1, 3, 2, 4), (2, 4, 1, 3)],
    ],
)
def test_what_is_no_diagram_of_a_knot(diagram):
    with pytest.raises(GaussCodeError):
        pf.GaussCode.from_pd(diagram)


def test_one_of_two_strands_is_over():
    code = pf.GaussCode.from_pd(TREFOIL)
    for over in ([True] * 6, [True], [True, False, True, True, False, False]):
        with pytest.raises(GaussCodeError):
            code.to_pd(over)
