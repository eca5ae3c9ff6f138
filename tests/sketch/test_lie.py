"""How the cloth lies, as the page is told: every number of it against the definitions."""

from base64 import b64decode
from dataclasses import asdict
from itertools import combinations

import numpy as np
import pytest
import shapely
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from coarse import CURVES
from plyfold.errors import TimeLimitError
from plyfold.gallery import chain
from plyfold.report import words
from plyfold.sketch import drawings
from plyfold.sketch.lie import lie, lifted
from plyfold.sketch.schema import Lie, Lift, Stroke
from plyfold.surface.gap import fitting_gap
from reference import crossings, gluings
from reference.random_curves import MILNOR_LIKE, SEVERAL_IMMERSIONS


def closed(points):
    return (Stroke(tuple((float(x), float(y)) for x, y in points), closed=True),)


def asked(points, immersion=0, layering=0, before=None):
    return lie(Lie(closed(points), immersion, layering, before))


def code_of(points):
    return crossings.crossings(points)[0]


@pytest.fixture(params=SEVERAL_IMMERSIONS, ids=["milnor", "ten-gon", "bennequin"])
def several(request):
    """A curve, its signed Gauss code, and the numbers of layerings of its immersions."""
    points, _, counts = request.param
    if crossings.turning_number(points) < 0:
        points = points[::-1]
    return points, code_of(points), counts


def test_each_immersion_and_its_layerings(several):
    points, _, counts = several
    answers = [asked(points, number) for number in range(len(counts))]
    assert [answer["immersion"] for answer in answers] == [str(number) for number in range(len(counts))]
    assert {answer["immersions"] for answer in answers} == {str(len(counts))}
    assert sorted(int(answer["layerings"]) for answer in answers) == list(counts)
    assert [answer["layerable"] for answer in answers] == [answer["layerings"] != "0" for answer in answers]


def test_the_groups_of_borders_are_those_of_the_gluings(several):
    points, code, counts = several
    shown = {layout(asked(points, number)) for number in range(len(counts))}
    assert shown == {groups(gluing.own_sheet) for gluing in gluings.immersions(*code)}


def groups(own_sheet):
    return frozenset(
        frozenset(border for border, own in enumerate(own_sheet) if own == sheet) for sheet in set(own_sheet)
    )


def layout(answer):
    return frozenset(frozenset(group["borders"]) for group in answer["layout"]["groups"])


def test_changed_borders_are_those_whose_group_is_another(several):
    points, _, counts = several
    last = len(counts) - 1
    for now, before in [(1, None), (0, 1), (last, 0), (-1, last - 1)]:
        answer = asked(points, now, before=before)
        old = layout(asked(points, now - 1 if before is None else before))
        same = {border for group in layout(answer) & old for border in group}
        assert set(answer["changed_borders"]) == set(range(len(code_of(points).partner))) - same
    assert asked(points, 0)["changed_borders"] == []


def test_all_layerings_are_walked_through_and_come_round_again():
    points = CURVES["knotted-ribbon"].curve.points.tolist()
    count = int(asked(points)["layerings"])
    seen = [tuple(asked(points, 0, number)["levels"]) for number in range(count)]
    assert len(set(seen)) == count
    assert asked(points, 0, count)["levels"] == list(seen[0])
    assert asked(points, 0, -1)["levels"] == list(seen[-1])
    assert asked(points, 0, -1)["layering"] == str(count - 1)


def test_levels_stack_the_sheets_of_every_cell_and_casing_follows(several):
    points, _, counts = several
    for number in range(len(counts)):
        answer = asked(points, number)
        if not answer["layerable"]:
            assert (answer["levels"], answer["casing"]) == (None, None)
            continue
        cell, level = np.array(answer["sheet_cell"]), np.array(answer["levels"])
        for one in set(answer["sheet_cell"]):
            assert sorted(level[cell == one]) == list(range(1, (cell == one).sum() + 1))
        partner = code_of(points).partner
        casing = answer["casing"]
        assert all(casing[visit] != casing[other] for visit, other in enumerate(partner))


def test_what_cannot_be_lifted_names_the_sheets_in_conflict():
    points = CURVES["bennequin"].curve.points.tolist()
    answers = [asked(points, number) for number in range(5)]
    stuck = [answer for answer in answers if not answer["layerable"]]
    assert len(stuck) == 2
    for answer in stuck:
        why = answer["obstruction"]
        assert why["reason"] == "reversed pair"
        assert len(why["sheets"]) >= 2
        assert {answer["sheet_cell"][sheet] for sheet in why["sheets"]} == set(why["cells"])
        assert len(why["where"]) >= 1


def test_no_disk_has_an_obstruction_and_no_more():
    answer = asked(CURVES["limacon"].curve.points.tolist())
    assert set(answer) == {"version", "obstruction", "immersions", "seconds"}
    assert answer["obstruction"]["reason"] == "turning number"
    assert answer["immersions"] == "0"


def test_one_of_very_many_immersions():
    points = chain(MILNOR_LIKE, 60)
    answer = asked(points, 2**60 + 5)
    assert (answer["immersion"], answer["immersions"]) == ("5", str(2**60))
    assert asked(points, -1)["immersion"] == str(2**60 - 1)


def test_regions_of_the_layout_never_overlap(several):
    points, _, _ = several
    answer = asked(points)
    regions = [shapely.Polygon(group["region"]) for group in answer["layout"]["groups"]]
    assert all(a.intersection(b).area < 1e-6 for a, b in combinations(regions, 2))
    for group, region in zip(answer["layout"]["groups"], regions, strict=True):
        for arc in group["arcs"]:
            assert shapely.LineString(arc).difference(region.buffer(0.02)).length < 1e-9
    ends = [place for border in answer["layout"]["borders"] for place in border]
    assert np.hypot(*np.array(ends).T) == pytest.approx(1, abs=1e-3)


@pytest.fixture
def no_time(monkeypatch):
    """Take away the seconds for one of the questions."""
    drawings.layered.cache_clear()
    yield lambda question: monkeypatch.setattr(drawings, f"_SECONDS_TO_{question}", 0.0)
    drawings.layered.cache_clear()


def test_layerings_that_are_not_counted_in_time_are_unknown_but_for_one(no_time):
    no_time("COUNT")
    answer = asked(CURVES["stacked-spiral"].curve.points.tolist(), 0, 1)
    assert (answer["layerable"], answer["layering"], answer["layerings"]) == (True, "0", None)
    assert max(answer["levels"]) == 3


def test_what_is_not_decided_in_time_is_unknown(no_time):
    no_time("DECIDE")
    points = CURVES["knotted-ribbon"].curve.points.tolist()
    answer = asked(points)
    assert (answer["layerable"], answer["layerings"], answer["levels"]) == (None, None, None)
    assert answer["obstruction"] is None
    assert answer["verdict"] == asdict(words(1, decided=False))
    with pytest.raises(TimeLimitError):
        lifted(Lift(closed(points), 0, 0, None, 300))


def test_the_surface_is_that_of_the_layering():
    points = CURVES["exit-ramp"].curve.points.tolist()
    first, second = (lifted(Lift(closed(points), 0, number, None, 300)) for number in (0, 1))
    assert first["layering"] != second["layering"]
    assert first["mesh"]["level"] != second["mesh"]["level"]
    assert first["gap"] == fitting_gap(CURVES["exit-ramp"].curve)
    assert lifted(Lift(closed(points), 0, 0, 2.5, 300))["gap"] == 2.5


def test_the_verdict_is_in_the_words_of_the_report():
    points = CURVES["smallest-unliftable"].curve.points.tolist()
    answers = [asked(points, number) for number in (0, 1)]
    stuck, lifted = sorted(answers, key=lambda answer: answer["layerable"])
    assert lifted["verdict"] == asdict(words(2))
    assert stuck["verdict"] == asdict(words(2, stuck["obstruction"]["sentence"]))
    assert stuck["verdict"]["headline"] == "A disk of cloth, in 2 ways; this one cannot be lifted"


def test_a_surface_that_cuts_itself_only_where_that_is_asked_for():
    points = CURVES["smallest-unliftable"].curve.points.tolist()
    stuck = next(number for number in (0, 1) if not asked(points, number)["layerable"])
    assert "mesh" not in lifted(Lift(closed(points), stuck, 0, None, 300))
    allowed = lifted(Lift(closed(points), stuck, 0, None, 300, allow_intersections=True))
    assert len(allowed["mesh"]["intersections"]) > 0


def test_no_surface_without_a_disk():
    answer = lifted(Lift(closed(CURVES["figure-eight"].curve.points.tolist()), 0, 0, None, 300))
    assert answer["obstruction"]["reason"] == "turning number"


# ---- outlines that touch themselves ----------------------------------------------------------------------------------


def pieces_of(mesh):
    """Return the sets of vertices of a mesh, as the page reads it, that hang together by triangles."""
    faces = np.frombuffer(b64decode(mesh["faces"]), "<u4").reshape(-1, 3)
    joined = csr_array(
        (np.ones(2 * len(faces)), (faces[:, [0, 0]].ravel(), faces[:, 1:].ravel())), (faces.max() + 1,) * 2
    )
    count, piece = connected_components(joined, directed=False)
    return [np.flatnonzero(piece == number) for number in range(count)]


def test_a_surface_is_cut_where_it_touches_itself():
    pinched = closed([(0, 0), (4, 0), (2, 2), (4, 4), (0, 4), (2, 2)])
    answer = lie(Lie(pinched, 0, 0, None))
    assert (answer["touches"], answer["cut"]) == ([[2, 2]], "2 pieces of cloth: 2 disks")
    assert "touches itself" in answer["verdict"]["headline"]
    mesh = lifted(Lift(pinched, 0, 0, None, 100))["mesh"]
    places = (
        np.frombuffer(b64decode(mesh["vertices"]), "<f4").reshape(-1, 3)[:, :2] * mesh["scale"] + mesh["centre"][:2]
    )
    at_pinch = (places == 2).all(axis=1)
    assert [at_pinch[piece].sum() for piece in pieces_of(mesh)] == [1, 1]


def test_a_slit_is_no_place_where_a_surface_touches_itself():
    hole = [(2, 3), (2, 4), (4, 4), (4, 2), (2, 2), (2, 3)]
    slit = closed([(0, 0), (6, 0), (6, 6), (0, 6), (0, 3), *hole, (0, 3)])
    answer = lie(Lie(slit, 0, 0, None))
    assert (answer["touches"], answer["cut"]) == ([], None)
    assert answer["verdict"]["headline"] == "A disk of cloth"
