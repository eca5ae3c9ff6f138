"""Levels at cusps and at feet of bridges: casings, contradictions, orders over immersions, surfaces in one piece."""

import numpy as np
import pytest

import plyfold as pf
from plyfold.errors import InputError
from plyfold.layering.embedding import count_embeddings, embeddings, find_embedding
from plyfold.layering.levels.equations import level_clauses, list_levels
from plyfold.layering.levels.pieces import not_cut_off, piece_of_each_sheet
from plyfold.sat import solutions_by_choice
from reference.random_curves import LIMACON

# A limaçon that winds round once more.
SPIRAL = [
    (0, -4), (5, 0), (0, 6), (-7, 0), (0, -8), (8.5, 0.5), (0, 9), (-9, 0.4),
    (-9.5, -9), (10, -9.5), (10.5, 10), (-2, 9.6), (-2.5, -0.6),
]  # fmt: skip


def rectangle(left, bottom, right, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def numbers(surface):
    return surface.border_level.tolist()


def spiral(cusps):
    return pf.Curve(SPIRAL, cusps=cusps)


def test_the_surface_climbs_or_falls_by_the_index():
    drawn = pf.arrange(spiral({0: 2}))
    assert (drawn.turning_number, drawn.euler_characteristic) == (3, 1)
    (cusp,) = np.flatnonzero(drawn.cusp_index)
    found = list(embeddings(drawn))
    steps = {int(s.border_level[drawn.border_after[cusp]] - s.border_level[drawn.border_before[cusp]]) for s in found}
    assert steps == {-2, 2}
    assert len(found) == count_embeddings(drawn)
    assert all(surface.immersion.is_disk for surface in found)


def test_casings_come_in_three_lengths():
    found = list(embeddings(spiral({0: 2})))
    assert found
    for surface in found:
        drawn = surface.immersion.arrangement
        casing, k = surface.casing, drawn.n_crossings
        assert len(casing) == 2 * k + 1
        assert not casing[drawn.cusp_index > 0].any()
        at_crossings = casing[drawn.crossing_visits]
        first = np.unique(drawn.crossing_of_visit[drawn.crossing_visits], return_index=True)[1]
        for over in (casing, at_crossings, at_crossings[first]):
            assert numbers(pf.embed_cased(drawn, over)) == numbers(surface)
            assert [numbers(other) for other in embeddings(drawn, over)] == [numbers(surface)]


def test_what_is_no_casing_is_refused():
    drawn = pf.arrange(spiral({0: 2}))
    casing = find_embedding(drawn).casing
    with pytest.raises(InputError, match="truth values"):
        pf.embed_cased(drawn, casing[:-2])
    with pytest.raises(InputError, match="cusp or the foot of a bridge"):
        pf.embed_cased(drawn, casing | (drawn.cusp_index > 0))
    both = casing | (drawn.crossing_of_visit == 0)
    with pytest.raises(InputError, match="both strands pass over"):
        pf.embed_cased(drawn, both)


def test_cusps_that_a_casing_leaves_open_are_named():
    """Where a strip lies between two sheets, it may climb at one of two cusps in a row and fall at the other, or so."""
    loops = [rectangle(0, 0, 30, 30), rectangle(1, -1, 29, 29), rectangle(5, 5, 40, 10)]
    drawn = pf.arrange(pf.Outline(loops, {(2, 3): 1, (2, 0): 1}))
    by_casing = {}
    for surface in embeddings(drawn):
        by_casing.setdefault(tuple(surface.casing.tolist()), []).append(surface)
    assert sum(map(len, by_casing.values())) == count_embeddings(drawn)
    assert max(map(len, by_casing.values())) > 1
    for over, surfaces in by_casing.items():
        assert len(list(embeddings(drawn, over))) == len(surfaces)
        if len(surfaces) == 1:
            assert numbers(pf.embed_cased(drawn, over)) == numbers(surfaces[0])
            continue
        with pytest.raises(InputError, match="climbs or falls at 2 cusps") as caught:
            pf.embed_cased(drawn, over)
        assert set(map(tuple, caught.value.where)) == {(5, 5), (5, 10)}


def test_cusps_among_what_contradicts_itself():
    """Without the cusp, or without one of the two crossings, levels would fit together."""
    loop = [(5, 5), (7, -9), (6, 0), (-7, 6), (7, 1), (-7, 8)]
    outline = pf.Outline([loop, rectangle(-10, -11, 13, 14)], {(0, 4): 1})
    found = find_embedding(outline)
    first, second, (kind, visit) = found.value
    drawn = pf.arrange(outline)
    assert (found.reason, kind, drawn.cusp_index[visit]) == ("no embedding", "cusp", 1)
    assert found.where == (*map(tuple, drawn.crossings[[first, second]].tolist()), (7, 1))
    assert "at 2 crossings and 1 cusp." in str(found)


def test_an_impossible_cusp():
    found = find_embedding(pf.Curve(LIMACON, cusps={0: 1}))
    assert (found.reason, found.where) == ("cusp", ((3, 0),))
    assert count_embeddings(pf.Curve(LIMACON, cusps={0: 1})) == 0
    assert list(embeddings(pf.Curve(LIMACON, cusps={0: 1}))) == []


@pytest.mark.parametrize("outline", [spiral({0: 2}), spiral({0: 1, 1: 1}), pf.Curve(LIMACON, cusps={6: 1})])
def test_orders_over_the_immersions_of_a_disk_with_cusps_are_its_embeddings(outline):
    every = {tuple(numbers(surface)) for surface in embeddings(outline)}
    by_immersion = [list(pf.layerings(immersion)) for immersion in pf.immersions(outline)]
    assert sum(map(len, by_immersion)) == count_embeddings(outline)
    for found in by_immersion:
        assert {tuple(numbers(layering)) for layering in found} <= every
        if found:
            immersion = found[0].immersion
            assert pf.count_layerings(immersion) == len(found)
            assert pf.nicest_layering(immersion).changes == min(layering.changes for layering in found)
            least = pf.least_intersecting_layering(immersion)
            assert (least.total_length, least.optimal) == (0, True)


# ---- bridges and pieces ----------------------------------------------------------------------------------------------

# A tower with two holes: which storey has which hole is free.
TOWER = [rectangle(0, 0, 30, 30), rectangle(1, 1, 29, 28), rectangle(3, 4, 5, 6)[::-1], rectangle(13, 15, 16, 18)[::-1]]


def test_orders_over_the_immersions_of_several_loops_are_its_embeddings():
    every = {tuple(numbers(surface)) for surface in embeddings(TOWER)}
    by_immersion = [list(pf.layerings(immersion)) for immersion in pf.immersions(TOWER)]
    assert sum(map(len, by_immersion)) == len(every) == count_embeddings(TOWER) == 2**3
    assert {tuple(numbers(layering)) for found in by_immersion for layering in found} == every
    for immersion in pf.immersions(TOWER):
        assert pf.count_layerings(immersion) == 2
        assert pf.nicest_layering(immersion).changes == 0
        least = pf.least_intersecting_layering(immersion)
        assert (least.total_length, least.optimal, len(least.intersections)) == (0, True, 0)


def test_changes_are_counted_along_each_loop():
    """A ring woven through a ring: as often as each loop changes, not from the end of one to the start of another."""
    rings = [
        rectangle(0, 0, 6, 6),
        rectangle(1, 1, 5, 5)[::-1],
        rectangle(3, 2, 9, 4),
        rectangle(3.5, 2.5, 8, 3.5)[::-1],
    ]
    for surface in embeddings(rings):
        drawn, casing = surface.immersion.arrangement, surface.casing.tolist()
        expected = 0
        for loop in range(4):
            low, high = drawn.first_visit[loop : loop + 2].tolist()
            over = [casing[visit] for visit in range(low, high) if drawn.crossing_of_visit[visit] >= 0]
            expected += sum(a != b for a, b in zip(over, over[1:] + over[:1], strict=True))
        assert surface.changes == expected
    nicest = pf.nicest_layering(find_embedding(rings).immersion)
    assert nicest.changes == min(surface.changes for surface in pf.layerings(nicest.immersion))


def test_no_surface_in_one_piece():
    found = find_embedding(TOWER, connected=True)
    assert found.reason == "turning number"
    assert list(embeddings(TOWER, connected=True)) == []
    assert count_embeddings(TOWER, connected=True) == 0
    apart = [rectangle(0, 0, 1, 1), rectangle(5, 0, 6, 1)]
    assert find_embedding(apart)
    assert not find_embedding(apart, connected=True)


# The outline of a disk with a handle, and a triangle: two pieces, or an annulus.
HANDLE = [
    (-13, -40), (94, -45), (111, 65), (30, 66), (30, -20), (8, -14), (11, 6), (63, 5),
    (50, -17), (37, -19), (35, 40), (91, 39), (79, -22), (72, -24), (66, 14), (-16, 13),
]  # fmt: skip
TRIANGLE = [(-57, 37), (85, -80), (118, -9)]


def test_some_are_in_one_piece():
    every = list(embeddings([TRIANGLE, HANDLE]))
    whole = [numbers(surface) for surface in every if len(surface.pieces) == 1]
    assert (len(whole), len(every)) == (4, 8)
    assert [(len(surface.pieces), surface.genus) for surface in every if numbers(surface) not in whole] == [(2, 1)] * 4
    listed = list(embeddings([TRIANGLE, HANDLE], connected=True))
    assert sorted(map(numbers, listed)) == sorted(whole)
    assert count_embeddings([TRIANGLE, HANDLE], connected=True) == len(whole)
    assert numbers(find_embedding([TRIANGLE, HANDLE], connected=True)) in whole


def test_all_are_in_several_pieces():
    loops = [HANDLE, [(15, -35), (25, -36), (22, -30)]]
    assert {len(surface.pieces) for surface in embeddings(loops)} == {2}
    found = find_embedding(loops, connected=True)
    assert (found.reason, found.value) == ("pieces", ((0,), (1,)))
    assert list(embeddings(loops, connected=True)) == []
    assert count_embeddings(loops, connected=True) == 0


def partition(drawn, level):
    """Which borders bound the same piece."""
    first_sheet = np.cumsum(drawn.winding) - drawn.winding
    piece = piece_of_each_sheet(drawn, level)[first_sheet[drawn.left_cell] + level - 1].tolist()
    return tuple(piece.index(number) for number in piece)


@pytest.mark.parametrize("loops", [TOWER, [TRIANGLE, HANDLE], [HANDLE, [(15, -35), (25, -36), (22, -30)]]])
def test_what_forbids_a_surface_forbids_none_that_falls_into_other_pieces(loops):
    drawn = pf.arrange(loops)
    clauses = level_clauses(drawn)
    every = {tuple(level.tolist()): partition(drawn, level) for level in list_levels(clauses)}
    for level, pieces in every.items():
        clause = not_cut_off(drawn, clauses, np.array(level))
        assert (clause is None) == (len(set(pieces)) == 1)
        if clause is not None:
            models = solutions_by_choice([*clauses.every, clause], clauses.choices)
            forbidden = every.keys() - {tuple(clauses.levels(model).tolist()) for model in models}
            assert level in forbidden
            assert {every[other] for other in forbidden} == {pieces}
