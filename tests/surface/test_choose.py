"""Of several layerings the one that stays low is lifted: never higher than the first and the nicest one."""

from dataclasses import replace

import numpy as np
import pytest
from families import FAMILIES

import plyfold as pf
from plyfold.clock import Clock, Watch
from plyfold.errors import InputError, PrecisionError, TimeLimitError
from plyfold.gallery import CURVES, OUTLINES
from plyfold.layering.orders.search import order_problem
from plyfold.mesh.refine import is_moved
from plyfold.surface import choose
from plyfold.surface.glue import stack_sheets
from plyfold.surface.heights import smooth_heights, spread_cloth
from plyfold.surface.low import crossing_cloth, estimated, lowered
from plyfold.surface.making import Making, steps_of
from reference.random_curves import glued_disk

CHOICES = ("low", "first", "nicest")
WITH_CHOICES = ("pretzel", "knotted-ribbon", "pentagram")
BOW_TIES = pf.Curve([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])


def height(surface):
    """The range of heights, in gaps."""
    return float(np.ptp(surface.vertices[:, 2])) / surface.gap


def heights(outline, triangles=1500):
    """The same for each choice."""
    return [height(pf.lift(outline, choose=name, triangles=triangles)) for name in CHOICES]


def random_disks(count, seed):
    """Random disks of some crossings: glued triangles, ribbons, and wild ones."""
    rng = np.random.default_rng(seed)
    draw = [
        lambda: np.array(glued_disk(rng, int(rng.integers(8, 40)))),
        lambda: FAMILIES["ribbon"].draw(int(rng.integers(40, 400)), int(rng.integers(10**6))),
        lambda: FAMILIES["wild-ribbon"].draw(int(rng.integers(30, 150)), int(rng.integers(10**6))),
    ]
    while count:
        points = draw[count % 3]()
        found = pf.find_embedding(points)
        if found and found.immersion.arrangement.n_crossings >= 4:
            count -= 1
            yield points


def assert_lowest(outline, triangles=1500):
    """What is chosen is no higher than the other two, on the same mesh."""
    low, first, nicest = heights(outline, triangles)
    assert low <= min(first, nicest) * (1 + 1e-4)


def test_chains_are_no_towers():
    points = FAMILIES["chain"].draw(1500, 0)
    assert height(pf.lift(points, choose="first")) > 30
    surface = pf.lift(points)
    assert height(surface) < 1.1
    surface.check()


@pytest.mark.parametrize(("name", "vertices", "most"), [("ribbon", 1000, 2.3), ("wild-ribbon", 300, 3.1)])
def test_ribbons_stay_lower_than_either(name, vertices, most):
    points = FAMILIES[name].draw(vertices, 0)
    low, first, nicest = heights(points)
    assert low < most < min(first, nicest)


@pytest.mark.parametrize("name", WITH_CHOICES)
def test_gallery(name):
    assert_lowest(CURVES[name].curve)


@pytest.mark.parametrize("name", sorted(OUTLINES))
def test_outlines_with_loops_holes_handles_and_cusps(name):
    if OUTLINES[name].embeddable:
        assert_lowest(OUTLINES[name].outline)


def test_random_disks():
    for points in random_disks(12, 1):
        assert_lowest(points)


@pytest.mark.slow
def test_a_thousand_random_disks():
    for points in random_disks(1000, 2):
        assert_lowest(points, 4000)


def test_little_is_left_of_what_all_layerings_allow():
    """Against the slow reference: all layerings lifted, one after the other."""
    for points in random_disks(8, 3):
        first = pf.find_embedding(points)
        if pf.count_layerings(first.immersion) <= 64:
            least = min(height(pf.lift(each, triangles=800)) for each in pf.layerings(first.immersion))
            assert least <= height(pf.lift(points, triangles=800)) * (1 + 1e-6) <= 1.35 * least


def test_touching_outlines():
    """Ribbons on so coarse a grid that they touch themselves: contacts are moved apart."""
    seen = 0
    for seed in range(12):
        drawn = pf.arrange(np.round(FAMILIES["wild-ribbon"].draw(60, seed) / 5e5) * 5e5)
        found = pf.find_embedding(drawn) if is_moved(drawn) else None
        if found and found.immersion.arrangement.n_crossings >= 4 and seen < 4:
            assert_lowest(drawn, 500)
            seen += 1
    assert seen == 4


# ---- what is chosen --------------------------------------------------------------------------------------------------


def test_the_first_and_the_nicest():
    drawn = pf.arrange(CURVES["pretzel"].curve)
    first = pf.find_embedding(drawn)
    assert (pf.lift(drawn, choose="first").layering.level == first.level).all()
    nicest = pf.nicest_layering(first.immersion)
    assert (pf.lift(drawn, choose="nicest").layering.level == nicest.level).all()
    assert (pf.lift(first.immersion, choose="nicest").layering.level == nicest.level).all()


def test_layerings_are_taken_as_they_are():
    drawn = pf.arrange(CURVES["pretzel"].curve)
    lowest = pf.lift(drawn).layering
    assert (lowest.level != pf.find_embedding(drawn).level).any()
    other = next(each for each in pf.layerings(lowest.immersion) if (each.level != lowest.level).any())
    for name in CHOICES:
        assert pf.lift(other, choose=name, triangles=100).layering is other


def test_one_layering_and_its_mirror_image_leave_nothing_to_choose():
    first = pf.find_embedding(BOW_TIES)
    assert pf.count_layerings(first.immersion) == 2
    assert (pf.lift(BOW_TIES).layering.level == first.level).all()


def test_what_need_not_pass_through_itself_is_chosen_from():
    lifted = pf.lift(CURVES["pretzel"].curve, allow_intersections=True)
    assert height(lifted) == height(pf.lift(CURVES["pretzel"].curve))


def test_unknown_choices_are_refused():
    with pytest.raises(InputError, match=r"no choice 'best'.*\n.*\"low\""):
        pf.lift(BOW_TIES, choose="best")


@pytest.mark.parametrize("scale", [1e-8, 1.0, 1e8])
def test_it_belongs_to_the_drawing(scale):
    """Other sizes, directions, starting points and senses give the same surface, or its mirror image."""
    points = FAMILIES["ribbon"].draw(300, 0)
    turn = np.array([[0.6, 0.8], [-0.8, 0.6]])
    wanted = height(pf.lift(points))
    for other in (points @ turn, points[::-1], np.roll(points, 17, axis=0), points * [1, -1]):
        assert height(pf.lift(other * scale)) == pytest.approx(wanted, rel=2e-3)


def test_bodies_have_the_same_layering():
    surface = pf.lift(CURVES["pretzel"].curve)
    assert surface.inflate().surface.layering is surface.layering


# ---- pins, meshes, time ----------------------------------------------------------------------------------------------


def test_pins_that_only_some_layerings_allow():
    """What two sheets are pinned at decides which of them is above: others are left out."""
    first = pf.find_embedding(CURVES["pretzel"].curve)
    cell = int(np.argmax(first.immersion.arrangement.winding))
    lower, upper = first.immersion.sheets[cell]
    for pins in ({lower: 0.0, upper: 400.0}, {lower: 400.0, upper: 0.0}):
        surface = pf.lift(first.immersion, pins=pins, gap=1.0)
        above = surface.layering.level[upper] > surface.layering.level[lower]
        assert above == (pins[upper] > pins[lower])
        surface.check()


def test_pins_that_no_layering_allows():
    with pytest.raises(InputError, match="there is no sheet 99"):
        pf.lift(CURVES["pretzel"].curve, pins={99: 1.0})


def test_many_triangles_are_compared_on_fewer(monkeypatch):
    counts = []
    lifted = choose._raised

    def counted(layering, ground, watch):
        made = lifted(layering, ground, watch)
        counts.append(len(made.mesh.faces))
        return made

    monkeypatch.setattr(choose, "_raised", counted)
    fine = pf.lift(CURVES["pretzel"].curve, triangles=30_000)
    assert counts[-1] > 20_000 > max(counts[:-1])
    assert (fine.layering.level == pf.lift(CURVES["pretzel"].curve).layering.level).all()


def test_where_most_heights_cannot_be_solved(monkeypatch):
    """Candidates that fail are left out; if all do, it is an error."""
    lifted, made = choose._raised, []

    def failing(layering, ground, watch):
        if len(made) < failures:
            made.append(layering)
            raise PrecisionError("no heights")
        return lifted(layering, ground, watch)

    monkeypatch.setattr(choose, "_raised", failing)
    failures = 1
    pf.lift(CURVES["pretzel"].curve).check()
    failures = 10
    with pytest.raises(PrecisionError, match="no heights"):
        pf.lift(CURVES["pretzel"].curve)


def test_out_of_time():
    """No surface at all is an error; a time that ends while others are compared is not."""
    first = pf.find_embedding(CURVES["pretzel"].curve)
    steps = steps_of(first, Making())
    with pytest.raises(TimeLimitError):
        choose.raised_as_chosen(first, "low", steps, 1.0, Making(), watch=Watch(Clock(0)))
    with pytest.raises(TimeLimitError, match="choosing"):
        choose.raised_as_chosen(first, "nicest", steps, 1.0, Making(), watch=Watch(Clock(0)))


def test_no_time_to_compare(monkeypatch):
    monkeypatch.setattr(choose, "_TO_FIND", 0.0)
    monkeypatch.setattr(choose, "_TO_COMPARE", 0.0)
    surface = pf.lift(CURVES["pretzel"].curve, time_limit=60)
    assert (surface.layering.level == pf.find_embedding(CURVES["pretzel"].curve).level).all()


def test_progress():
    stages = []
    pf.lift(CURVES["pretzel"].curve, progress=lambda stage, done: stages.append(stage))
    assert "choosing the layering" in stages
    assert stages[-1] == "smoothing heights"


# ---- cloth that touches itself at crossings alone --------------------------------------------------------------------


@pytest.fixture(scope="module", params=["pretzel", "wild-ribbon"])
def crossings(request):
    """A layering with its triangles, its mesh, the cloth, and what of it is over crossings."""
    named = request.param
    outline = CURVES[named].curve if named in CURVES else FAMILIES[named].draw(100, 0)
    layering = pf.find_embedding(outline)
    cells = steps_of(layering, Making()).cells
    mesh = stack_sheets(layering, cells)
    spread = spread_cloth(cells.points, mesh, 0.5, 1.0)
    return layering, cells, mesh, spread, crossing_cloth(order_problem(layering.immersion), mesh, spread)


def heights_of_crossings(cells, mesh, spread, cloth):
    """The range of heights over crossings where distances are kept there alone: the usual solver, on fewer rows."""
    at_crossing = np.isin(mesh.planar_vertex, cloth.point)
    fewer = replace(mesh, stacked=mesh.stacked[at_crossing[mesh.stacked].all(axis=1)])
    return np.ptp(smooth_heights(cells.points, fewer, 1.0, spread=spread)[at_crossing])


def test_all_vertices_over_crossings_are_there(crossings):
    layering, _, _, _, cloth = crossings
    assert len(np.unique(cloth.point)) == layering.immersion.arrangement.n_crossings
    assert len(np.unique(cloth.sheet * len(cloth.sheet) + cloth.point)) == len(cloth.sheet)


def test_estimates_are_those_of_the_usual_solver(crossings):
    layering, cells, _, spread, cloth = crossings
    near = None
    for each in list(pf.layerings(layering.immersion))[:6]:
        near = estimated(cloth, each.level, near)
        assert near.height == pytest.approx(
            heights_of_crossings(cells, stack_sheets(each, cells), spread, cloth), rel=1e-4
        )


def test_spread_cloth_changes_no_heights(crossings):
    _, cells, mesh, spread, _ = crossings
    alone = smooth_heights(cells.points, mesh, 1.0)
    assert smooth_heights(cells.points, mesh, 1.0, spread=spread) == pytest.approx(alone, abs=1e-5)


def test_turning_classes_round_keeps_what_triples_demand(crossings):
    layering, _, _, _, cloth = crossings
    problem = order_problem(layering.immersion)
    lower, estimate = lowered(problem, layering, cloth)
    lower.check()
    assert estimate.height <= estimated(cloth, layering.level).height * (1 + 1e-3)
    assert estimate.height == pytest.approx(estimated(cloth, lower.level).height, rel=1e-9)
