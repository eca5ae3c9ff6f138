"""Layerings and the reasons why there is none, checked step by step."""

from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plyfold as pf
from coarse import CURVES
from plyfold.errors import InputError, NotEmbeddableError, TimeLimitError
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.search import first_layering
from plyfold.obstruction import Unknown
from plyfold.sat import minimal_core, solve
from reference.random_curves import glued_disk

# The lines of the Fano plane: however seven points get two colours, one of the seven lines has only one.
FANO = [(1, 2, 3), (1, 4, 5), (1, 6, 7), (2, 4, 6), (2, 5, 7), (3, 4, 7), (3, 5, 6)]


def bennequin():
    return list(pf.immersions(CURVES["bennequin"].curve))


def test_a_reversed_pair_is_a_chain_of_glued_pairs():
    refused = [(i, found) for i in bennequin() if not (found := pf.find_layering(i))]
    assert len(refused) == 2
    for immersion, obstruction in refused:
        assert obstruction.reason == "reversed pair"
        glued = {}
        for border, right, left in immersion.gluing.tolist():
            glued.setdefault(border, set()).add((right, left))
        chain = obstruction.value
        assert chain[0][1:] == chain[-1][:0:-1]
        for (cell, lower, upper), (next_cell, next_lower, next_upper) in pairwise(chain):
            assert lower in immersion.sheets[cell]
            assert upper in immersion.sheets[cell]
            assert next_lower in immersion.sheets[next_cell]
            assert any(
                {(lower, next_lower), (upper, next_upper)} <= pairs
                or {(next_lower, lower), (next_upper, upper)} <= pairs
                for pairs in glued.values()
            )


def test_places_of_a_reversed_pair_lie_in_its_cells():
    for immersion in bennequin():
        found = pf.find_layering(immersion)
        if not found:
            cells = list(dict.fromkeys(cell for cell, _, _ in found.value))
            assert list(found.where) == [immersion.arrangement.cell_point(cell) for cell in cells]


def both_ways(cycles):
    """Clauses that forbid the literals of each cycle to be all true or all false."""
    return [clause for cycle in cycles for clause in (list(cycle), [-x for x in cycle])]


def test_demands_that_contradict_each_other_are_made_minimal():
    cycles = [(1, 2, -4), (-3, 5, 6), (2, 3, 4), *FANO]
    assert solve(both_ways(cycles)) is None
    core = [cycles[i] for i in minimal_core([both_ways([cycle]) for cycle in cycles])]
    assert solve(both_ways(core)) is None
    for left_out in core:
        assert solve(both_ways(cycle for cycle in core if cycle != left_out)) is not None


@settings(max_examples=100, deadline=None)
@given(st.lists(st.tuples(*[st.sampled_from([x for x in range(-4, 5) if x])] * 3), max_size=9))
def test_solver_against_all_assignments(cycles):
    def satisfied(colours):
        return all(len({colours[abs(x)] == (x > 0) for x in cycle}) == 2 for cycle in cycles)

    every = ({v: bool(n >> v & 1) for v in range(5)} for n in range(32))
    found = solve(both_ways(cycles))
    assert (found is not None) == any(map(satisfied, every))
    assert found is None or satisfied({v: v in found for v in range(5)})


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32))
def test_layerings_of_random_disks(seed):
    """Every gluing keeps every pair of sheets in order; read straight from the table of gluings."""
    immersion = pf.find_immersion(glued_disk(np.random.default_rng(seed), 60))
    level = pf.find_layering(immersion).level
    for border in range(immersion.arrangement.n_borders):
        rows = immersion.gluing[immersion.gluing[:, 0] == border]
        for (_, a, b), (_, c, d) in combinations(rows.tolist(), 2):
            assert (level[a] < level[c]) == (level[b] < level[d])


def test_the_first_immersion_that_lifts_is_taken():
    immersions = bennequin()
    lifts = [bool(pf.find_layering(immersion)) for immersion in immersions]
    order = sorted(range(5), key=lambda i: lifts[i])
    found, examined = first_layering(immersions[i] for i in order)
    assert examined == 3
    assert found.immersion is immersions[order[2]]
    found, examined = first_layering(immersions[i] for i in order[:2])
    assert not found
    assert examined == 2
    with pytest.raises(NotEmbeddableError) as caught:
        pf.lift(immersions[order[0]])
    assert caught.value.obstruction.reason == "reversed pair"


def test_time_is_limited():
    for immersion in bennequin():
        unknown = pf.find_layering(immersion, time_limit=0)
        assert isinstance(unknown, Unknown)
        assert not unknown
        assert "whether there is a layering" in str(unknown)
        with pytest.raises(TimeLimitError, match="unknown"):
            first_layering([immersion], time_limit=0)
        with pytest.raises(TimeLimitError, match="unknown"):
            pf.lift(immersion, time_limit=0)
    assert any(pf.find_layering(immersion, time_limit=60) for immersion in bennequin())


def test_what_is_known_when_the_search_is_stopped(monkeypatch):
    def never(clauses, time_limit):
        raise TimeoutError

    monkeypatch.setitem(pf.find_layering.__globals__, "solve", never)
    immersion = next(i for i in bennequin() if count_layerings(i))
    unknown = pf.find_layering(immersion, time_limit=7)
    assert isinstance(unknown, Unknown)
    assert unknown.established["pair classes"] == 1
    assert unknown.established["triples"] == 0
    assert "No pair of sheets returns reversed" in str(unknown)


def test_time_limits_are_numbers_of_seconds():
    immersion = next(filter(pf.find_layering, bennequin()))
    assert pf.find_layering(immersion, time_limit=float("inf"))
    for limit in (-1, float("nan"), "a"):
        with pytest.raises(InputError, match="time limit"):
            pf.find_layering(immersion, time_limit=limit)
