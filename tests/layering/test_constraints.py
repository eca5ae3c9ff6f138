"""The problem behind layerings, on constraints that no small curve has: against all assignments of truth values."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.clock import Clock
from plyfold.errors import InputError
from plyfold.gallery import chain
from plyfold.layering.orders.counting import count_layerings, count_orders
from plyfold.layering.orders.listing import layerings, solutions
from plyfold.layering.orders.nicest import nicest_layering
from plyfold.layering.orders.search import order_problem, solve_orders
from plyfold.obstruction import Unknown
from plyfold.paper import layering as paper
from reference.random_curves import MILNOR_LIKE, glued_disk

# The lines of the Fano plane: however seven points get two colours, one of the seven lines has only one.
FANO = [(1, 2, 3), (1, 4, 5), (1, 6, 7), (2, 4, 6), (2, 5, 7), (3, 4, 7), (3, 5, 6)]
RAMP = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]

cycles_up_to = st.integers(3, 8).flatmap(
    lambda n: st.lists(st.tuples(*[st.sampled_from([x for x in range(-n, n + 1) if x])] * 3), max_size=12)
)


def demanding(cycles, sheets=None):
    """The problem of some immersion, with constraints of our own."""
    problem = order_problem(pf.find_immersion(RAMP))
    triples = np.array(cycles, dtype=np.int64).reshape(-1, 3)
    highest = int(np.abs(triples).max(initial=0))
    whose = np.zeros_like(triples) if sheets is None else np.array(sheets)
    return replace(problem, literal=np.arange(1, highest + 1), triples=triples, sheets=whose)


def all_solutions(cycles):
    n = max((abs(x) for cycle in cycles for x in cycle), default=0)
    for values in product([False, True], repeat=n):
        if all(len({values[abs(x) - 1] == (x > 0) for x in cycle}) == 2 for cycle in cycles):
            yield frozenset(i if value else -i for i, value in enumerate(values, 1))


@settings(max_examples=150, deadline=None)
@given(cycles_up_to)
def test_counted_and_listed_as_by_trying_all(cycles):
    expected = set(all_solutions(cycles))
    assert count_orders(demanding(cycles), Clock(None)) == len(expected)
    n = max((abs(x) for cycle in cycles for x in cycle), default=0)
    clauses = [frozenset(sign * x for x in cycle) for cycle in cycles for sign in (1, -1)]
    listed = [frozenset(true) for true in solutions(range(1, n + 1), clauses)]
    assert len(listed) == len(expected)
    assert set(listed) == expected


@settings(max_examples=100, deadline=None)
@given(cycles_up_to)
def test_parts_large_and_small_are_counted_alike(cycles):
    """Whether few variables are tried in all combinations or joined as tables."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("plyfold.layering.orders.counting._FEW", 3)
        patch.setattr("plyfold.layering.tables._FEW_VARIABLES", 3)
        assert count_orders(demanding(cycles), Clock(None)) == len(list(all_solutions(cycles)))


def test_orders_in_a_circle_are_named_by_cell_and_sheets():
    problem = demanding([*FANO, (1, 2, -4)], sheets=[(i % 3, 3, 4) for i in range(8)])
    obstruction = solve_orders(problem, Clock(None))
    assert obstruction.reason == "cyclic order"
    cell = problem.immersion.sheet_cell
    assert obstruction.value == tuple((cell[i % 3], [i % 3, 3, 4]) for i in range(7))
    assert set(obstruction.where) == {problem.immersion.arrangement.cell_point(c) for c, _ in obstruction.value}


def test_a_table_that_would_be_too_large_is_not_made(monkeypatch):
    immersion = pf.find_immersion(glued_disk(np.random.default_rng(3), 400))
    assert count_layerings(immersion) == 10355447604451182452428586876928
    monkeypatch.setattr("plyfold.layering.tables._MOST_ROWS", 100)
    unknown = count_layerings(immersion)
    assert isinstance(unknown, Unknown)
    assert unknown.reason == "size"
    assert "how many" in str(unknown)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32))
def test_random_disks_are_counted_as_they_are_listed(seed):
    """Two methods that share only the statement of the problem; and each is another layering, checked."""
    immersion = pf.find_immersion(glued_disk(np.random.default_rng(seed), 45))
    count = count_layerings(immersion)
    assert count <= 2 ** (immersion.arrangement.n_crossings // 2)
    if count <= 3000:
        found = {tuple(layering.level.tolist()) for layering in layerings(immersion)}
        assert len(found) == sum(1 for _ in layerings(immersion)) == count


class TestFixedOrders:
    def test_over_the_cells_of_a_chain(self):
        """Three links with two layerings each: two orders fixed leave two layerings, and find one of them."""
        immersion = pf.find_immersion(chain(MILNOR_LIKE, 3))
        high = [cell for cell, sheets in enumerate(immersion.sheets) if len(sheets) > 1]
        fix = {(cell, *immersion.sheets[cell][:2]): "above" for cell in (high[0], high[-1])}
        level = pf.find_layering(immersion, fix=fix).level
        assert all(level[a] > level[b] for _, a, b in fix)

    def test_orders_that_contradict_each_other_are_named(self):
        immersion = pf.find_immersion(CURVES["stacked-spiral"].curve)
        (cell,) = [cell for cell, sheets in enumerate(immersion.sheets) if len(sheets) == 3]
        a, b, c = immersion.sheets[cell]
        fix = {(cell, a, b): "above", (cell, b, c): "above", (cell, a, c): "below"}
        obstruction = pf.find_layering(immersion, fix=fix)
        assert obstruction.reason == "fixed orders"
        assert set(obstruction.value) <= {(*key, order) for key, order in fix.items()}
        for left_out in obstruction.value:
            rest = {order[:3]: order[3] for order in obstruction.value if order != left_out}
            assert pf.find_layering(immersion, fix=rest)
        assert obstruction.where == (immersion.arrangement.cell_point(cell),)
        assert f"over cell {cell}" in str(obstruction)

    def test_one_pair_fixed_both_ways(self):
        immersion = pf.find_immersion(RAMP)
        fix = {(1, 0, 1): "above", (1, 1, 0): "above"}
        assert set(pf.find_layering(immersion, fix=fix).value) == {(1, 0, 1, "above"), (1, 1, 0, "above")}
        assert pf.find_layering(immersion, fix={(1, 0, 1): "above", (1, 1, 0): "below"})

    @pytest.mark.parametrize(
        ("order", "words"),
        [
            ({(1, 0, 2): "above"}, "not two sheets over cell 1"),
            ({(1, 0, 0): "above"}, "not two sheets over cell 1"),
            ({(0, 0, 1): "above"}, "no sheet lies over it"),
            ({(17, 0, 1): "above"}, "no cell 17"),
            ({(1, 0, 1): "over"}, "not 'over'"),
            ({(1, 0): "above"}, r"not for \(1, 0\)"),
            ({1: "above"}, "not for 1"),
            ({(1, 0.5, 1): "above"}, r"not for \(1, 0.5, 1\)"),
        ],
    )
    def test_what_is_no_order_is_refused(self, order, words):
        with pytest.raises(InputError, match=words):
            pf.find_layering(pf.find_immersion(RAMP), fix=order)


@pytest.mark.parametrize("options", [{"fix": {(1, 0, 1): "above"}}, {"time_limit": 1.0}])
def test_the_papers_way_takes_no_fixed_orders_and_no_time_limit(options):
    with pytest.raises(TypeError, match="unexpected keyword"):
        paper.find_layering(pf.find_immersion(RAMP), **options)


def test_a_good_layering_and_a_bound_when_the_nicest_is_unknown(monkeypatch):
    immersion = pf.find_immersion(glued_disk(np.random.default_rng(3), 60))
    nicest = nicest_layering(immersion)
    monkeypatch.setitem(nicest_layering.__globals__, "_fewest_changes", lambda problem, over, clock: (None, 2))
    unknown = nicest_layering(immersion)
    assert isinstance(unknown, Unknown)
    good = unknown.established["layering"]
    good.check()
    assert good.changes >= nicest.changes >= unknown.established["changes at least"] == 2
