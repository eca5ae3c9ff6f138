"""Lifted surfaces, judged by checkers that know nothing of how they were made."""

import numpy as np
import pytest

from coarse import CURVES
from plyfold import find_immersion, find_layering, immersions
from plyfold.certify import check_surface
from plyfold.errors import InputError, NotEmbeddableError, NotImmersibleError, PlyfoldError, PrecisionError
from plyfold.outline.curve import Curve
from plyfold.surface.lift import lift
from reference import random_curves
from reference.triangles import meeting_pairs

LIFTABLE = {name: named for name, named in CURVES.items() if named.embeddable}


def area(points):
    x, y = (np.asarray(points, dtype=np.float64) - points[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def drawn(surface):
    return surface.layering.immersion.arrangement.curve.points


def assert_right(surface, rounding=1e-9):
    """Proven by the checkers; and the area over the drawing, counted with sheets, is what the outline encloses."""
    check_surface(drawn(surface), surface.vertices, surface.faces, surface.boundary, surface.gap)
    surface.check()
    lifted_area = sum(area(surface.vertices[face, :2]) for face in surface.faces)
    assert lifted_area == pytest.approx(area(drawn(surface)), rel=rounding)


@pytest.mark.parametrize("named", LIFTABLE.values(), ids=LIFTABLE.keys())
def test_gallery(named):
    surface = lift(named.curve, triangles=300)
    assert_right(surface)
    assert meeting_pairs(surface.vertices, surface.faces) == []


@pytest.mark.parametrize("name", ["milnor", "ten-gon", "bennequin"])
def test_every_immersion(name):
    """All immersions of one curve that can be lifted, each as its own surface."""
    lifted = 0
    for immersion in immersions(CURVES[name].curve):
        layering = find_layering(immersion)
        if not layering:
            with pytest.raises(NotEmbeddableError):
                lift(immersion)
            continue
        surface = lift(layering, triangles=100)
        assert_right(surface)
        assert meeting_pairs(surface.vertices, surface.faces) == []
        lifted += 1
    assert lifted == CURVES[name].embeddable


@pytest.mark.parametrize("seed", range(6))
def test_random_ribbons(seed):
    outline = random_curves.ribbon_outline(np.random.default_rng(seed), 40)
    surface = lift(outline, triangles=300)
    assert_right(surface)
    assert meeting_pairs(surface.vertices, surface.faces) == []


@pytest.mark.parametrize("seed", range(12))
def test_random_glued_disks(seed):
    """Sharp corners, thin cells, strands that all but touch."""
    outline = random_curves.glued_disk(np.random.default_rng(seed), 10)
    surface = lift(outline, triangles=200)
    assert_right(surface)
    assert meeting_pairs(surface.vertices, surface.faces) == []


@pytest.mark.parametrize("name", ["exit-ramp", "milnor"])
def test_outline_has_the_points_of_the_input(name):
    """Bit for bit and in order, one boundary vertex at each; the others lie between them."""
    points = CURVES[name].draw()
    surface = lift(points, triangles=300)
    outline = [place.tobytes() for place in surface.vertices[surface.boundary, :2]]
    at = [outline.index(point.tobytes()) for point in points]
    assert at[0] == 0
    assert at == sorted(at)
    assert len(set(at)) == len(points)


def test_clockwise_outline_is_turned_round():
    """The surface lies on the left of the curve, which starts at the same point."""
    points = CURVES["exit-ramp"].draw()
    surface = lift(points[::-1], triangles=300)
    assert_right(surface)
    assert drawn(surface).tolist() == np.roll(points, 1, axis=0).tolist()


@pytest.mark.parametrize("scale", [1e-8, 1e8, 1e-150, 1e120])
def test_scaled(scale):
    surface = lift(scale * CURVES["exit-ramp"].draw(), triangles=300)
    assert_right(surface)
    plain = lift(CURVES["exit-ramp"].draw(), triangles=300)
    assert surface.gap == pytest.approx(scale * plain.gap)
    assert np.ptp(surface.vertices[:, 2]) == pytest.approx(scale * np.ptp(plain.vertices[:, 2]), rel=0.05)


@pytest.mark.parametrize("shift", [(1e6, 0), (1e6, -1e6), (-3e9, 1)])
@pytest.mark.parametrize("name", ["exit-ramp", "stacked-spiral"])
def test_far_from_the_origin(name, shift):
    surface = lift(CURVES[name].draw() + shift, triangles=300)
    assert_right(surface, rounding=1e-6)
    assert meeting_pairs(surface.vertices - [*shift, 0], surface.faces) == []


@pytest.mark.parametrize("gap", [1e-3, 1.0, 30.0, 0.1 + 0.2])
def test_gap(gap):
    """Exactly kept, and reached somewhere: sheets are not further apart than they have to be."""
    surface = lift(CURVES["stacked-spiral"].curve, triangles=300, gap=gap)
    assert surface.gap == gap
    assert_right(surface)
    x, y, z = surface.vertices.T
    order = np.lexsort((z, y, x))
    over = (np.diff(x[order]) == 0) & (np.diff(y[order]) == 0)
    assert np.diff(z[order])[over].min() == pytest.approx(gap, rel=1e-6)


@pytest.mark.parametrize("gap", [0.0, -1.0, np.nan, np.inf])
def test_gap_must_be_positive(gap):
    with pytest.raises(InputError, match="gap"):
        lift(CURVES["circle"].curve, gap=gap)


@pytest.mark.parametrize("name", ["circle", "horseshoe"])
def test_smooth(name):
    """A flat disk stays flat; a horseshoe climbs no higher than its overlap asks for."""
    surface = lift(CURVES[name].curve, triangles=300, gap=1.0)
    height = np.ptp(surface.vertices[:, 2])
    assert height == pytest.approx(0.0, abs=1e-9) if name == "circle" else 1.0 <= height < 1.5


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("limacon", "turning number"),
        ("doubled-circle", "turning number"),
        ("figure-eight", "turning number"),
        ("kinked-circle", None),
    ],
)
def test_no_disk(name, reason):
    with pytest.raises(NotImmersibleError) as caught:
        lift(CURVES[name].curve)
    assert reason in (None, caught.value.obstruction.reason)


def test_no_layering(monkeypatch):
    """A curve whose immersions all fail to lift: the five of a curve, less the three that do."""
    curve = CURVES["bennequin"].curve
    failing = [immersion for immersion in immersions(curve) if not find_layering(immersion)]
    assert len(failing) == 2
    monkeypatch.setattr("plyfold.surface.lift.watched_immersions", lambda *_: iter(failing))
    with pytest.raises(NotEmbeddableError) as caught:
        lift(curve)
    assert caught.value.obstruction.reason == "reversed pair"
    assert caught.value.where


def test_every_form_of_input():
    curve = CURVES["horseshoe"].curve
    immersion = find_immersion(curve)
    forms = [curve, curve.points, immersion.arrangement, immersion, find_layering(immersion)]
    first, *others = [lift(form, triangles=100) for form in forms]
    for other in others:
        assert np.array_equal(first.vertices, other.vertices)
        assert np.array_equal(first.faces, other.faces)


def test_gauss_code_has_no_surface():
    arranged = find_immersion(CURVES["horseshoe"].curve).arrangement
    code = type(arranged).from_gauss(arranged.partner, arranged.ccw, arranged.outer)
    with pytest.raises(PlyfoldError, match="Gauss code"):
        lift(code)


def test_sheets_of_the_triangles():
    """Each sheet is as large as the cell below it."""
    surface = lift(CURVES["exit-ramp"].curve, triangles=300)
    immersion = surface.layering.immersion
    sizes = np.zeros(immersion.n_sheets)
    np.add.at(sizes, surface.sheet, [area(surface.vertices[face, :2]) for face in surface.faces])
    for sheet, cell in enumerate(immersion.sheet_cell):
        darts = np.array(immersion.arrangement.cells[cell])
        pieces = [immersion.arrangement.border_points(dart // 2) for dart in darts]
        border = [piece[::-1] if dart % 2 else piece for dart, piece in zip(darts, pieces, strict=True)]
        assert sizes[sheet] == pytest.approx(area(np.concatenate(border)))


def test_surface_cannot_be_changed():
    surface = lift(Curve([(0, 0), (4, 0), (0, 3)]), max_area=1.0)
    with pytest.raises(ValueError, match="read-only"):
        surface.vertices[0, 0] = 1.0


def test_max_area():
    surface = lift(CURVES["exit-ramp"].curve, max_area=0.2)
    assert max(area(surface.vertices[face, :2]) for face in surface.faces) <= 0.2


def test_drawings_too_small_for_a_mesh_are_refused():
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    lift(square * 1e-150).check()
    with pytest.raises(PrecisionError, match="too small"):
        lift(square * 1e-160)
