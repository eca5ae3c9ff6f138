"""The gallery's known answers, against the reference code."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.gallery import CURVES, OUTLINES, NamedCurve, band, named_curve
from reference import crossings, gluings, layerings
from reference.outline_drawings import outline_code
from reference.outline_gluings import surfaces
from reference.outline_levels import layerings as layerings_of_outline

# Enumerating all gluings takes too long for more crossings; tests/hard has other proofs for those curves.
EVERY = {**CURVES, **OUTLINES}
# Euler characteristics, and layerings: two for every place where sheets can lie either way, apart from others.
KNOWN = {
    "ring": (0, 1),
    "linked-rings": (0, 4),
    "letter-b": (0, 4),
    "letter-g": (1, 4),
    "ampersand": (1, 4),
    "disk-with-handle": (-1, 2),
    "limacon-with-cusp": (1, 2),
    "torus-front": (0, 4),
}
# The number of loops and of handles of the pieces.
RING, DISK = (2, 0), (1, 0)
KINDS = {
    "ring": {RING},
    "linked-rings": {RING},
    "letter-b": {RING},
    "letter-g": {RING, DISK},
    "ampersand": {DISK},
    "disk-with-handle": {(1, 1)},
    "limacon-with-cusp": {DISK},
    "torus-front": {RING},
}
# All orders of its sheets take a minute to try.
LONG = ("never-lifts",)
ENUMERABLE = [
    pytest.param(named, marks=[pytest.mark.slow] * (name in LONG), id=name)
    for name, named in CURVES.items()
    if named.crossings <= 30
]


@pytest.mark.parametrize("named", ENUMERABLE)
def test_reference_gives_the_known_answers(named):
    points = named.draw(40).tolist()
    code = crossings.crossings(points)[0]
    assert len(code.partner) // 2 == named.crossings
    assert abs(crossings.turning_number(points)) == named.turning_number
    if crossings.turning_number(points) == -1:
        code = crossings.crossings(points[::-1])[0]
    found = gluings.immersions(*code) if named.turning_number == 1 else []
    assert len(found) == named.immersions
    lifted = sum(bool(layerings.layerings(*code, gluing.own_sheet, gluing.rows)) for gluing in found)
    assert lifted == named.embeddable


@pytest.mark.parametrize("named", OUTLINES.values(), ids=OUTLINES.keys())
def test_reference_gives_the_known_answers_of_outlines(named):
    outline = named.coarse().outline
    step = 4 if named.name == "disk-with-handle" else 1  # the reference takes long for many points
    loops, cusps = ([row[::step].tolist() for row in rows] for rows in (outline.loops, outline.cusps))
    code = outline_code(loops, cusps)
    found = surfaces(code)
    layered = [len(layerings_of_outline(code, *surface)) for surface in found]
    assert (len(found), sum(map(bool, layered)), sum(layered)) == (
        named.immersions,
        named.embeddable,
        KNOWN[named.name][1],
    )


@pytest.mark.parametrize("named", OUTLINES.values(), ids=OUTLINES.keys())
def test_library_gives_the_known_kinds_of_outlines(named):
    euler, layerings = KNOWN[named.name]
    embedding = pf.find_embedding(named.outline)
    assert embedding.euler_characteristic == euler
    assert pf.count_embeddings(named.outline) == layerings
    assert {(len(piece.loops), piece.genus) for piece in embedding.pieces} == KINDS[named.name]
    pf.lift(embedding, triangles=1000).check()


@pytest.mark.parametrize("named", EVERY.values(), ids=EVERY.keys())
def test_library_gives_the_known_answers(named):
    arrangement = pf.arrange(named.outline)
    arrangement.check()
    assert arrangement.n_crossings == named.crossings
    assert arrangement.turning_number == named.turning_number
    assert pf.count_immersions(arrangement) == named.immersions
    lifted = sum(bool(pf.find_layering(immersion)) for immersion in pf.immersions(arrangement))
    assert lifted == named.embeddable


@pytest.mark.parametrize("named", CURVES.values(), ids=CURVES.keys())
def test_the_code_does_not_depend_on_the_number_of_points(named):
    assert pf.GaussCode.of(pf.arrange(named.curve)) == pf.GaussCode.of(pf.arrange(named.coarse().curve))


def test_what_is_no_polygon_looks_smooth():
    """But for the corners at a ribbon's ends and the spikes of the torus, no edge turns so much that one sees it."""
    for named in EVERY.values():
        outline = named.outline
        if len(outline) > len(named.coarse().outline):
            step = (outline.points[outline.next_point] - outline.points) @ (1, 1j)
            turn = np.angle(step[outline.next_point] / step, deg=True)
            assert np.sum(np.abs(turn) > 6) in (0, 4), named.name


@pytest.mark.parametrize("named", OUTLINES.values(), ids=OUTLINES.keys())
def test_an_outline_is_the_same_with_fewer_points(named):
    fine, coarse = pf.arrange(named.outline), pf.arrange(named.coarse().outline)
    assert fine.turning_numbers == coarse.turning_numbers
    assert sorted(fine.winding.tolist()) == sorted(coarse.winding.tolist())
    assert fine.cusp_index.tolist() == coarse.cusp_index.tolist()


def test_the_front_of_a_torus_is_what_faces_the_viewer():
    """Rays down on the torus, 30° above its plane, meet its front as often as the outline winds round there.

    A ray meets the torus where a polynomial of fourth degree is 0, and every other time it comes from outside.
    """
    elevation, wide, tube = np.radians(30), 3.0, 1.3
    outline = pf.arrange(OUTLINES["torus-front"].outline)
    right, up = np.array([1.0, 0, 0]), np.array([0, np.sin(elevation), np.cos(elevation)])
    towards = np.array([0, -np.cos(elevation), np.sin(elevation)])
    for cell in range(outline.n_cells):
        x, y = outline.cell_point(cell)
        foot = x * right + y * up
        # |p|² + R² − r² = 2 R ρ, squared, for p = foot + t towards.
        square = np.polynomial.Polynomial([foot @ foot + wide**2 - tube**2, 2 * foot @ towards, 1.0])
        level = (
            np.polynomial.Polynomial([foot[0], towards[0]]) ** 2 + np.polynomial.Polynomial([foot[1], towards[1]]) ** 2
        )
        roots = (square**2 - 4 * wide**2 * level).roots()
        assert np.sum(np.abs(roots.imag) < 1e-9) == 2 * outline.winding[cell]


def test_a_band_is_as_wide_as_asked_for():
    angle = 2 * np.pi * np.arange(400) / 400
    right, left = band(np.stack([2 * np.cos(angle), 2 * np.sin(angle)], axis=1), 0.6)
    assert np.hypot(*right.T) == pytest.approx(2.3)
    assert np.hypot(*left.T) == pytest.approx(1.7)
    assert pf.arrange([right, left]).turning_numbers == (1, -1)


def test_all_names_are_known():
    assert not set(CURVES) & set(OUTLINES)
    for name, named in EVERY.items():
        assert named_curve(name) is named
        assert isinstance(named, NamedCurve) == (name in CURVES)
        assert pf.arrange(named).n_crossings == named.crossings
