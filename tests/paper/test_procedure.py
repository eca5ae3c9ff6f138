"""The paper's procedure, compared with the exact answers of the reference; its figures are those of docs/paper.md."""

from collections import Counter

import numpy as np
import pytest

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import find_immersion, immersions
from plyfold.paper import procedure
from plyfold.paper import procedure as paper
from plyfold.paper.gluing import glue_layout
from plyfold.paper.procedure import run_paper
from reference import gluings, random_curves
from reference.planar_maps import (
    census,
    gauss_code,
    left_and_right,
    may_bound_disk,
    symmetric_copies,
    turning_number,
    windings,
)

FIRST_FAILURE = ([3, 2, 1, 0, 5, 4, 7, 6], [1, 1, 0, 0, 1, 0, 1, 0], 3)
"""The first curve in the census that bounds a disk and that the literal reading gets wrong."""

REPAIRED_FAILURE = (
    [9, 6, 7, 8, 19, 10, 1, 2, 3, 0, 5, 18, 15, 16, 17, 12, 13, 14, 11, 4],
    [1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 1],
    17,
)
"""The curve with the fewest crossings, among 6,500 random disks, that the repaired reading gets wrong."""


def code_of(arranged):
    return gauss_code(arranged.partner, arranged.ccw, arranged.outer)


def key_of(immersion):
    return gluings.key_of(*code_of(immersion.arrangement), immersion.own_sheet, immersion.gluing)


def accepts(code, run):
    """Algorithm 1's own verdict, from the definition: no cell has more groups than its winding number."""
    left = [left for left, _ in left_and_right(code)]
    groups = Counter(left[group[0]] for group in run.groups)
    return all(windings(code)[cell] >= count for cell, count in groups.items())


def judge(code, reading):
    """What the procedure says about one curve, and whether that is right; what it builds is in the reference."""
    arranged = Arrangement.from_gauss(*code)
    exact = gluings.keys(*code_of(arranged))
    run, result = run_paper(arranged, reading), procedure.find_immersion(arranged, reading)
    if result:
        assert key_of(result) in exact
        return "found"
    assert result.reason == "paper's procedure"
    assert f"border {result.value};" in result.sentence
    if run.stuck_at is not None:
        return "stuck"
    if accepts(code_of(arranged), run):
        return "wrong groups" if exact else "accepts a curve that bounds no disk"
    return "refuses a disk" if exact else "refuses"


def tally(k, reading):
    return Counter(judge(code, reading) for code in census(k) if may_bound_disk(code))


class TestEveryCurve:
    def test_literal_reading_up_to_four_crossings(self):
        assert [tally(k, "literal") for k in (0, 1, 2, 3, 4)] == [
            {"found": 1},
            {},
            {"found": 1},
            {},
            {"found": 6, "wrong groups": 1, "refuses": 4},
        ]

    def test_repaired_reading_up_to_four_crossings(self):
        assert [tally(k, "repaired") for k in (0, 2, 4)] == [{"found": 1}, {"found": 1}, {"found": 7, "refuses": 4}]

    @pytest.mark.slow
    def test_literal_reading_with_six_crossings(self):
        assert tally(6, "literal") == {
            "found": 58,
            "wrong groups": 26,
            "refuses a disk": 1,
            "stuck": 1,
            "refuses": 140,
            "accepts a curve that bounds no disk": 20,
        }

    @pytest.mark.slow
    def test_repaired_reading_with_six_crossings(self):
        assert tally(6, "repaired") == {"found": 86, "refuses": 160}

    @pytest.mark.slow
    def test_every_start_and_mirror_image_with_six_crossings(self):
        verdicts = {"literal": [], "repaired": []}
        for code in census(6):
            if may_bound_disk(code) and gluings.immersions(*code):
                copies = [copy for copy in symmetric_copies(code) if turning_number(copy) == 1]
                for reading, seen in verdicts.items():
                    seen.append(
                        [bool(procedure.find_immersion(Arrangement.from_gauss(*copy), reading)) for copy in copies]
                    )
        always, never = sum(map(all, verdicts["literal"])), sum(not any(seen) for seen in verdicts["literal"])
        assert (always, never, len(verdicts["literal"])) == (36, 21, 86)
        assert all(map(all, verdicts["repaired"]))

    def test_without_the_turning_number_the_procedure_accepts_curves_that_turn_twice_or_more(self):
        """Algorithm 1 alone, with its own test at the end: Pascal's limaçon is the first that it gets wrong."""
        accepted = Counter()
        for k in range(5):
            for code in census(k):
                run = run_paper(Arrangement.from_gauss(*code))
                accepted[k] += run.stuck_at is None and accepts(code, run) and not may_bound_disk(code)
        assert [accepted[k] for k in range(5)] == [0, 1, 2, 8, 27]
        limacon = Arrangement.from_gauss([1, 0], [True, False], 1)
        assert run_paper(limacon).groups == ((0,), (1,))
        assert not procedure.find_immersion(limacon)


class TestFirstFailure:
    def test_it_is_the_first(self):
        assert next(c for c in census(4) if may_bound_disk(c) and judge(c, "literal") == "wrong groups") == gauss_code(
            *FIRST_FAILURE
        )

    def test_borders_of_two_sheets_are_joined_from_every_start(self):
        for copy in symmetric_copies(gauss_code(*FIRST_FAILURE)):
            if turning_number(copy) == 1:
                assert judge(copy, "literal") == "wrong groups"
                assert judge(copy, "repaired") == "found"
        assert run_paper(Arrangement.from_gauss(*FIRST_FAILURE)).groups == ((0, 2, 4, 6), (1,), (3,), (5,), (7,))

    def test_the_one_immersion_has_two_sheets_there(self):
        (immersion,) = gluings.immersions(*FIRST_FAILURE)
        own = immersion.own_sheet
        assert own[0] == own[6] != own[2] == own[4]


class TestOtherReadings:
    """The pseudo-code read in other ways, on the 86 disks with six crossings: the reading taken is the best of them."""

    @staticmethod
    def found(monkeypatch, name, replacement):
        monkeypatch.setattr(paper, name, replacement)
        codes = [code for code in census(6) if may_bound_disk(code)]
        return sum(bool(procedure.find_immersion(Arrangement.from_gauss(*code))) for code in codes)

    @pytest.mark.slow
    def test_note_5_arcs_count_only_when_recurse_has_ended(self, monkeypatch):
        def recurse(state, m, f):
            while (following := next_between(state, m, f)) is not None:
                yield paper._process(state, following)
            state.arcs[m, f] = None
            paper._remove(state, m)

        assert self.found(monkeypatch, "_recurse", recurse) == 49

    @pytest.mark.slow
    def test_note_6_an_arc_waits_until_f_is_next_in_both_lists(self, monkeypatch):
        def recurse(state, m, f):
            state.arcs[m, f] = None
            while {m, f}.isdisjoint(state.removed) and (
                state.c_list.next(m) != f or (following := state.w_list.next(m)) != f
            ):
                following = next_between(state, m, f)
                yield paper._process(state, state.w_list.next(m) if following is None else following)
            paper._remove(state, m)

        assert self.found(monkeypatch, "_recurse", recurse) == 24

    @pytest.mark.slow
    def test_note_7_the_next_in_the_w_list_is_always_processed(self, monkeypatch):
        def recurse(state, m, f):
            while m not in state.removed and state.w_list.next(m) != m:
                if state.c_list.next(m) == f == state.w_list.next(m):
                    state.arcs[m, f] = None
                    break
                yield paper._process(state, state.w_list.next(m))
            paper._remove(state, m)

        assert self.found(monkeypatch, "_recurse", recurse) == 53

    @pytest.mark.slow
    def test_with_the_turning_condition_but_without_partitions(self, monkeypatch):
        def is_valid(state, m, f, valid=paper._is_valid):
            return valid(state, m, f) and paper._cuts_off_a_disk(state.arranged)(m, f)

        assert self.found(monkeypatch, "_is_valid", is_valid) == 82

    @pytest.mark.slow
    def test_with_partitions_but_without_the_turning_condition(self, monkeypatch):
        monkeypatch.setattr(paper, "_literal", paper._repaired)
        assert self.found(monkeypatch, "_cuts_off_a_disk", lambda arranged: lambda m, f: True) == 49


def next_between(state, m, f):
    """The border that RECURSE(M, F) turns to next in the reading taken; None if there is none left."""
    candidates = (state.w_list.next(m), state.c_list.next(m))
    return next((border for border in candidates if paper._is_left_between(state, m, border, f)), None)


class TestRepairedFailure:
    def test_borders_of_one_sheet_are_not_joined(self):
        arranged = Arrangement.from_gauss(*REPAIRED_FAILURE)
        obstruction = procedure.find_immersion(arranged, "repaired")
        assert obstruction.reason == "paper's procedure"
        assert "does not mean that there is no immersion" in str(obstruction)
        (immersion,) = immersions(arranged)
        assert not gluings.problems(code_of(arranged), immersion.own_sheet.tolist(), immersion.gluing.tolist())

    def test_curves_that_bound_no_disk_are_told_before_it_begins(self):
        limacon = Arrangement.from_gauss([1, 0], [True, False], 1)
        assert procedure.find_immersion(limacon).reason == "turning number"
        assert procedure.find_immersion(Arrangement.from_gauss(*FIRST_FAILURE)).reason == "paper's procedure"
        assert procedure.find_immersion(Arrangement.from_gauss([], [], 1))


class TestRandomDisks:
    @staticmethod
    def verdicts(outline, sizes, reading):
        rng = np.random.default_rng(2011)
        return Counter(bool(procedure.find_immersion(arrange(outline(rng, size)), reading)) for size in sizes)

    def test_ribbons(self):
        """Long ribbons cross their own partitions, where the literal reading goes round in circles."""
        sizes = range(10, 110, 4)
        literal = self.verdicts(random_curves.ribbon_outline, sizes, "literal")
        repaired = self.verdicts(random_curves.ribbon_outline, sizes, "repaired")
        assert literal[True] < repaired[True] < len(sizes)

    def test_dense_disks(self):
        sizes = range(5, 55, 2)
        assert self.verdicts(random_curves.glued_disk, sizes, "repaired") == {True: len(sizes)}

    @pytest.mark.parametrize(("polygon", "k", "layering_counts"), random_curves.SEVERAL_IMMERSIONS)
    def test_curves_with_several_immersions(self, polygon, k, layering_counts):
        arranged = arrange(polygon)
        stuck = procedure.find_immersion(arranged)
        assert not stuck
        assert "round in circles" in stuck.sentence
        assert len(stuck.where) == 1
        assert key_of(procedure.find_immersion(arranged, "repaired")) in gluings.keys(*code_of(arranged))

    def test_calls_grow_linearly_with_the_borders(self):
        rng = np.random.default_rng(3)
        for size in (20, 60, 180):
            arranged = arrange(random_curves.ribbon_outline(rng, size))
            assert run_paper(arranged, "repaired").calls == arranged.n_borders
            literal = run_paper(arranged)
            assert literal.stuck_at is not None or literal.calls <= 3 * arranged.n_borders


class TestGluingOfALayout:
    @pytest.mark.parametrize("k", [0, 2, 4, pytest.param(6, marks=pytest.mark.slow)])
    def test_every_immersion_is_determined_by_its_layout(self, k):
        for code in census(k):
            for immersion in gluings.immersions(*code) if may_bound_disk(code) else ():
                found = glue_layout(Arrangement.from_gauss(*code), groups_of(immersion.own_sheet))
                assert key_of(found) == gluings.key_of(*code, *immersion)

    @pytest.mark.parametrize(("polygon", "k", "layering_counts"), random_curves.SEVERAL_IMMERSIONS)
    def test_curves_with_several_immersions(self, polygon, k, layering_counts):
        arranged = arrange(polygon)
        code = code_of(arranged)
        for immersion in gluings.immersions(*code):
            assert key_of(glue_layout(arranged, groups_of(immersion.own_sheet))) == gluings.key_of(*code, *immersion)

    @pytest.mark.parametrize("outline", [random_curves.ribbon_outline, random_curves.glued_disk])
    def test_random_disks(self, outline):
        """Long ribbons have many sheets without own borders, and several of one cell next to each other."""
        rng = np.random.default_rng(7)
        for size in range(10, 70, 6):
            immersion = find_immersion(arrange(outline(rng, size)))
            found = glue_layout(immersion.arrangement, groups_of(immersion.own_sheet.tolist()))
            assert key_of(found) == key_of(immersion)

    def test_any_other_grouping_is_refused(self):
        """All partitions of the borders of the first failure's middle cell into two sheets; one of them is right."""
        arranged = Arrangement.from_gauss(*FIRST_FAILURE)
        rest = [(1,), (3,), (5,), (7,)]
        splits = [[(0,), (2, 4, 6)], [(0, 2), (4, 6)], [(0, 4), (2, 6)], [(0, 6), (2, 4)], [(0, 2, 6), (4,)]]
        found = [isinstance(glue_layout(arranged, [*split, *rest]), Immersion) for split in splits]
        assert found == [False, False, False, True, False]

    def test_more_groups_than_windings_are_refused(self):
        arranged = Arrangement.from_gauss(*FIRST_FAILURE)
        assert glue_layout(arranged, [(border,) for border in range(8)]) is None


def groups_of(own_sheet):
    groups = {}
    for border, sheet in enumerate(own_sheet):
        groups.setdefault(sheet, []).append(border)
    return list(groups.values())
