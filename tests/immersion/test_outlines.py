"""Immersions of every outline against references from the definition: cusps, several loops, handles, pieces."""

from collections import Counter
from itertools import islice

import numpy as np
import pytest

import plyfold as pf
from codes import code_of
from nightly.outlines import judge_immersions, random_outline
from plyfold.arrangement.arrangement import Arrangement
from plyfold.errors import CurveError, GeneralPositionError, InputError
from plyfold.immersion import outlines, solve
from plyfold.immersion.cutting import irreducible_kernels
from plyfold.immersion.peeling import outline_seams, peel
from plyfold.immersion.solve import nth_immersion
from reference.outline_gluings import fits, key_of, one_of_each_class, surfaces
from reference.outlines import outline_map
from reference.planar_maps import border_count, census
from reference.random_curves import HANDLE, LIMACON

TRIANGLE, HOLE = [(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]
FRAME = [(-2, -2), (20, -2), (-2, 20)]
OTHER_HOLE, THIRD_HOLE = [(4, 1), (4, 2), (5, 1)], [(6, 0.5), (6, 1), (6.5, 0.5)]
NEST = [FRAME, [(-1, -1), (-1, 17), (17, -1)], TRIANGLE, HOLE]
"""A ring in the hole of a ring."""
TWO_OVER_TWO_HOLES = [FRAME, TRIANGLE, HOLE, OTHER_HOLE]
LIDS = [
    [(-300, -300), (400, -301), (50, 500)],
    [(-100, -80), (200, -81), (50, 150)],
    [(0, -80), (130, -60), (120, 100), (-10, 70)],
]
"""Curves over the disk with a handle: far around it, or across it."""
CUSP_IN_THE_WRONG_PLACE = [(15, -16), (-1, 17), (2, -12), (11, 0), (8, -18), (16, 16), (7, -6), (7, -20)]
"""Point 4 as a cusp leaves no disk, though the number of turns is right."""
ONE_PART = [*([(x - i, y - i) for x, y in FRAME] for i in range(3)), TRIANGLE, HOLE]
"""The hole may be in any of four sheets."""
SMALLEST_THREE = ([3, 2, 1, 0, 5, 4, 9, 8, 7, 6, 11, 10], [1, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0], 15)
"""A curve that bounds a disk with a handle in three ways."""


def moved(loops, right, up):
    return [[(x + right, y + up) for x, y in loop] for loop in loops]


def key(immersion):
    return key_of(code_of(immersion.arrangement), immersion.own_sheet, immersion.gluing)


def with_cusp(code, border, index):
    return Arrangement.from_gauss(*code, cusps={border: index})


class TestAgainstReferences:
    @pytest.mark.parametrize("k", [1, 2, 3, 4])
    def test_a_cusp_on_each_border_of_every_curve(self, k):
        counts = Counter()
        for code in census(k):
            for border in range(border_count(code)):
                for index in (1, 2):
                    arranged = with_cusp(code, border, index)
                    if arranged.winding.min() >= 0:
                        counts[judge_immersions(arranged), arranged.euler_characteristic] += 1
        assert k < 3 or counts[1, 1]
        assert k < 4 or counts[1, -1]

    def test_random_outlines(self):
        counts = Counter()
        for seed in range(250):
            loops, cusps = random_outline(np.random.default_rng(seed))
            try:
                arranged = pf.arrange(pf.Outline(loops, cusps), general_position="raise")
            except (CurveError, GeneralPositionError):
                continue
            if arranged.winding.min() >= 0 and arranged.winding.max() <= 3:
                counts[judge_immersions(arranged), len(arranged.bridges) > 0, bool(arranged.cusp_index.any())] += 1
        assert counts[1, True, False] > 5
        assert sum(counts.values()) > 50

    def test_handles(self):
        assert judge_immersions(pf.arrange(HANDLE)) == 1
        assert pf.find_immersion(HANDLE).genus == 1
        assert judge_immersions(Arrangement.from_gauss(*SMALLEST_THREE)) == 3

    def test_the_first_immersion_belongs_to_the_drawing_whatever_its_first_point(self):
        """So that of a disk with handles, and of one with a cusp."""
        for points, cusps in ((HANDLE, {}), (LIMACON, {6: 1})):
            drawn = set()
            for start in range(len(points)):
                turned = {(vertex - start) % len(points): index for vertex, index in cusps.items()}
                found = pf.find_immersion(pf.Curve(points[start:] + points[:start], cusps=turned))
                arranged = found.arrangement
                sides = [arranged.cell_point(cell) for cell in arranged.left_cell]
                group = [frozenset(np.flatnonzero(found.own_sheet == own).tolist()) for own in found.own_sheet]
                middle = [tuple(np.round(arranged.border_points(b).mean(axis=0), 9)) for b in range(len(sides))]
                drawn.add(frozenset(frozenset(middle[b] for b in borders) for borders in group))
            assert len(drawn) == 1


class TestSeveralLoops:
    def test_two_sheets_share_two_holes(self):
        found = list(pf.immersions(TWO_OVER_TWO_HOLES))
        assert pf.count_immersions(TWO_OVER_TWO_HOLES) == len(found) == len(surfaces(code_of(found[0].arrangement)))
        assert len({key(immersion) for immersion in found}) == len(found) == 4

    def test_groups_apart_multiply(self):
        several = [*TWO_OVER_TWO_HOLES, *moved(TWO_OVER_TWO_HOLES, 100, 3), *moved([TRIANGLE, HOLE], 0, 100)]
        one = pf.count_immersions(TWO_OVER_TWO_HOLES)
        assert pf.count_immersions(several) == one**2
        listed = [immersion.own_sheet.tobytes() + immersion.gluing.tobytes() for immersion in pf.immersions(several)]
        assert len(set(listed)) == len(listed) == one**2
        for number in (0, 1, one, one**2 - 1):
            found = nth_immersion(several, number)
            assert found.own_sheet.tobytes() + found.gluing.tobytes() == listed[number]
        with pytest.raises(InputError, match="no immersion"):
            nth_immersion(several, one**2)

    def test_samples_are_uniform(self):
        one = pf.count_immersions(TWO_OVER_TWO_HOLES)
        dice = np.random.default_rng(5)
        drawn = Counter(key(pf.sample_immersion(TWO_OVER_TWO_HOLES, dice)) for _ in range(40 * one))
        assert len(drawn) == one
        assert min(drawn.values()) > 15

    def test_lists_are_lazy_and_stable(self):
        many = [loop for i in range(12) for loop in moved(TWO_OVER_TWO_HOLES, 60 * i, i)]
        first = [immersion.gluing.tobytes() for immersion in islice(pf.immersions(many), 30)]
        assert len(set(first)) == 30
        assert [immersion.gluing.tobytes() for immersion in islice(pf.immersions(many), 30)] == first
        assert pf.count_immersions(many) == pf.count_immersions(TWO_OVER_TWO_HOLES) ** 12

    def test_a_hole_in_the_bounded_cell_of_a_ring(self):
        assert [piece.loops for piece in pf.find_immersion(NEST).pieces] == [(0, 1), (2, 3)]
        assert pf.count_immersions(NEST) == 1


class TestInOnePiece:
    @pytest.mark.parametrize(("lid", "ways"), [(LIDS[0], (3, 2)), (LIDS[1], (3, 2)), (LIDS[2], (2, 1))])
    def test_a_disk_under_a_disk_with_a_handle_or_a_ring(self, lid, ways):
        """The two curves bound two disks, one with a handle, or one ring."""
        loops = [HANDLE, lid]
        in_pieces = Counter(len(immersion.pieces) for immersion in pf.immersions(loops))
        assert in_pieces == {1: ways[1], 2: ways[0] - ways[1]}
        assert pf.count_immersions(loops) == ways[0]
        whole = {key(immersion) for immersion in pf.immersions(loops) if len(immersion.pieces) == 1}
        assert {key(immersion) for immersion in pf.immersions(loops, connected=True)} == whole
        assert pf.count_immersions(loops, connected=True) == len(whole) == ways[1]
        found = pf.find_immersion(loops, connected=True)
        assert [(piece.loops, piece.genus) for piece in found.pieces] == [((0, 1), 0)]
        assert judge_immersions(found.arrangement) == ways[0]

    def test_loops_apart(self):
        rings = [TRIANGLE, HOLE, *moved([TRIANGLE, HOLE, OTHER_HOLE, THIRD_HOLE], 50, 0)]
        found = pf.find_immersion(rings, connected=True)
        assert (found.reason, found.value) == ("pieces", 2)
        assert pf.count_immersions(rings, connected=True) == 0 < pf.count_immersions(rings)
        assert list(pf.immersions(rings, connected=True)) == []

    def test_a_ring_in_the_hole_of_a_ring(self):
        found = pf.find_immersion(NEST, connected=True)
        assert (found.reason, found.value) == ("turning number", 0)
        assert str(found).startswith("The 4 curves together turn 0 times; what bounds a surface in one piece turns -2")

    def test_time_that_ends_while_the_reason_is_looked_for(self, monkeypatch):
        """The solver has its own error for that."""

        def late(*_):
            raise TimeoutError

        crossing = [
            [(2, 22), (12, 7), (30, 0), (25, 19)],
            [(17, 14), (30, 20), (34, 36), (6, 33)],
            [(7, 16), (32, 33), (21, 23), (19, 17)],
        ]
        assert pf.find_immersion(crossing).reason == "no gluing"
        monkeypatch.setattr(solve, "no_gluing", late)
        assert pf.find_immersion(crossing, time_limit=60).reason == "time limit"

    def test_pieces_that_no_gluing_joins(self):
        """A disk with a handle in the hole of a ring: as many turns as a single piece could have."""
        hole = [(-200, -201), (0, 300), (260, -199)]
        apart = [LIDS[0], hole, HANDLE]
        assert pf.arrange(apart).euler_characteristic == 2 - len(apart)
        assert [(piece.loops, piece.genus) for piece in pf.find_immersion(apart).pieces] == [((0, 1), 0), ((2,), 1)]
        assert pf.find_immersion(apart, connected=True).reason == "pieces"


def can_be_glued(code, vertices):
    """Whether gluings exist that fit at some crossings and marks, whatever happens at others."""
    found = outline_map(code)
    choices = one_of_each_class(found)
    edges = sorted({dart // 2 for vertex in vertices for dart in found.around[vertex]})
    last = {vertex: max(edges.index(dart // 2) for dart in found.around[vertex]) for vertex in vertices}

    def extend(phi, depth):
        if depth == len(edges):
            return True
        ready = [vertex for vertex in vertices if last[vertex] == depth]
        for choice in choices[edges[depth]]:
            phi[edges[depth]] = choice
            if all(fits(found, phi, vertex) for vertex in ready) and extend(phi, depth + 1):
                return True
        return False

    return extend({}, 0)


def assert_minimal(found, arranged):
    code = code_of(arranged)
    vertices = [next(i for i, at in enumerate(outline_map(code).at) if visit in at) for visit in found.value]
    assert not can_be_glued(code, vertices)
    assert all(can_be_glued(code, [v for v in vertices if v != left_out]) for left_out in vertices)


class TestObstructions:
    def test_a_cusp_with_too_few_sheets(self):
        found = pf.find_immersion(pf.Curve(TRIANGLE, cusps=[0, 1, 0]))
        assert (found.reason, found.where, found.value) == ("cusp", ((9.0, 0.0),), 1)
        assert "point 1" in str(found)
        assert not pf.bounds_disk(pf.Curve(TRIANGLE, cusps=[0, 1, 0]))
        assert pf.count_immersions(pf.Curve(TRIANGLE, cusps=[0, 1, 0])) == 0

    def test_the_turning_number_of_a_group_apart(self):
        eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
        twice = [TRIANGLE, [(0.5, 0.5), (9.5, 0), (0, 9.5)], *moved([eight], 50, 0)]
        found = pf.find_immersion(twice)
        assert (found.reason, found.value) == ("turning number", 0)
        assert "1 of 3 curves" in str(found)

    def test_several_curves_bound_no_disk(self):
        assert not pf.bounds_disk([TRIANGLE, HOLE])
        assert not pf.bounds_disk(HANDLE)

    def test_crossings_that_contradict_each_other_cannot_be_fewer(self):
        seen = 0
        for code in census(5):
            for border in range(0, border_count(code), 3):
                arranged = with_cusp(code, border, 1)
                if arranged.winding.max() > 3:
                    continue
                found = pf.find_immersion(arranged)
                if not found and found.reason == "no gluing":
                    seen += 1
                    assert_minimal(found, arranged)
        assert seen > 5

    def test_bridges_and_crossings_that_contradict_each_other_cannot_be_fewer(self):
        seen = 0
        for seed in range(400):
            loops, cusps = random_outline(np.random.default_rng(seed))
            try:
                arranged = pf.arrange(pf.Outline(loops, cusps))
            except (CurveError, GeneralPositionError):
                continue
            found = pf.find_immersion(arranged)
            if not found and found.reason == "no gluing" and arranged.winding.max() < 4:
                seen += 1
                places = arranged.visit_point[list(found.value)]
                # Moved points are given back where they were, which is nearer than any other place.
                assert np.abs(np.array(found.where) - places).max() <= (1e-3 if len(arranged.contacts) else 0)
                assert_minimal(found, arranged)
        assert seen > 5

    def test_a_time_limit_leaves_it_open(self):
        many = [loop for i in range(6) for loop in moved(TWO_OVER_TWO_HOLES, 0.01 * i, 0.013 * i)]
        assert pf.count_immersions(many, time_limit=0).reason == "time limit"
        assert pf.find_immersion(many, time_limit=0).reason == "time limit"

    def test_cells_inside_curls_are_at_their_cusps(self):
        """A word without grouping, of a curve with cusps: its obstruction names borders and places of the drawing."""
        seen = 0
        for code in census(5):
            for border in range(0, border_count(code), 2):
                arranged = with_cusp(code, border, 1)
                found = pf.find_immersion(arranged)
                if not found and found.reason == "no grouping":
                    seen += 1
                    assert set(found.value) <= set(range(arranged.n_borders))
        assert seen > 10
        drawn = pf.Curve(CUSP_IN_THE_WRONG_PLACE, cusps={4: 1})
        found = pf.find_immersion(drawn)
        assert (found.reason, len(found.where)) == ("no grouping", len(found.value))
        assert CUSP_IN_THE_WRONG_PLACE[4] in found.where

    def test_words_and_kernels_say_what_they_are_there_for(self):
        cusped = pf.Curve(LIMACON, cusps={6: 1})
        assert pf.bounds_disk(cusped)
        for ask in (pf.blank_word, irreducible_kernels):
            with pytest.raises(InputError, match="without cusps") as caught:
                ask(cusped)
            assert caught.value.where == (LIMACON[6],)
            with pytest.raises(InputError, match="one closed curve"):
                ask([TRIANGLE, HOLE])
        with pytest.raises(InputError, match="disks alone"):
            irreducible_kernels(HANDLE)

    def test_what_is_too_much_to_list_is_not_sampled(self, monkeypatch):
        monkeypatch.setattr(outlines, "_MOST_LISTED", 3)
        assert pf.sample_immersion([FRAME, TRIANGLE, HOLE], 1)
        for ask in (pf.sample_immersion, nth_immersion):
            with pytest.raises(InputError, match="more than 3 immersions"):
                ask(ONE_PART, 1)


def test_ports_and_sheets_that_peeling_pairs_know_each_other():
    for loops in (TWO_OVER_TWO_HOLES, NEST, HANDLE, [HANDLE, LIDS[2]]):
        seams = outline_seams(pf.arrange(loops))
        known = peel(seams)
        once = peel(seams, {int(np.flatnonzero(seams.in_tree & (seams.own < 0))[-1]): 0})
        for found in (known, once):
            pairs = np.flatnonzero(found.upper >= 0)
            seam = np.repeat(np.arange(len(seams.size)), seams.size)[pairs]
            back = seams.start[seam] + found.port[seams.start[seam] + found.upper[pairs]]
            assert back.tolist() == pairs.tolist()
        assert not known.is_contradiction
        assert set(np.flatnonzero(known.upper >= 0)) <= set(np.flatnonzero(once.upper >= 0)) or once.is_contradiction
