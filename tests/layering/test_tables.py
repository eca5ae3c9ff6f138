"""Solutions counted by joining tables: against all combinations of values."""

from itertools import product
from math import prod

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plyfold.clock import Clock
from plyfold.layering import elimination, tables
from plyfold.layering.elimination import elimination_order
from plyfold.layering.tables import Relation, Table, TooLargeError, count_solutions

LARGE = 10**15


@st.composite
def some_tables(draw):
    """Tables between some of eight variables, with values up to 2 and numbers of ways of all sizes."""
    variables = tuple(draw(st.lists(st.integers(0, 7), min_size=1, max_size=3, unique=True)))
    every = list(product(range(3), repeat=len(variables)))
    rows = draw(st.lists(st.sampled_from(every), unique=True, max_size=len(every)))
    ways = [draw(st.sampled_from([1, 1, 2, 6, LARGE])) for _ in rows]
    return Table(variables, Relation(tuple(rows), tuple(ways)))


def counted_by_trying_all(given):
    variables = sorted({variable for table in given for variable in table.variables})
    ways = [dict(zip(table.relation.rows, table.relation.ways, strict=True)) for table in given]
    return sum(
        prod(number.get(tuple(value[v] for v in table.variables), 0) for number, table in zip(ways, given, strict=True))
        for value in (dict(zip(variables, row, strict=True)) for row in product(range(3), repeat=len(variables)))
    )


@settings(max_examples=150, deadline=None)
@given(st.lists(some_tables(), max_size=8))
def test_counted_as_by_trying_all(given):
    assert count_solutions(given, Clock(None)) == counted_by_trying_all(given)


def test_numbers_larger_than_those_of_machines():
    choice = Relation(((0, 1), (1, 0), (1, 1)), (LARGE, 1, LARGE + 2))
    given = [Table((i, i + 1), choice) for i in range(40)]
    zero, one = 1, 1
    for _ in range(40):
        zero, one = LARGE * one, zero + (LARGE + 2) * one
    assert count_solutions(given, Clock(None)) == zero + one


def test_a_join_that_would_be_too_large_is_not_made(monkeypatch):
    monkeypatch.setattr(tables, "_MOST_ROWS", 100)
    anything = Relation(tuple(product(range(3), repeat=2)), (1,) * 9)
    tree = [Table((0, i), anything) for i in range(1, 9)]
    assert count_solutions(tree, Clock(None)) == 3**9
    ring_of_all = [Table((i, j), anything) for i in range(6) for j in range(i)]
    with pytest.raises(TooLargeError):
        count_solutions(ring_of_all, Clock(None))


def test_all_members_are_taken_out_however_many_there_are_together(monkeypatch):
    monkeypatch.setattr(elimination, "_MANY", 3)
    groups = [tuple(range(8)), (7, 8), (9, 8), (10,)]
    order = elimination_order(groups, Clock(None))
    assert sorted(order) == list(range(11))
    assert set(order[:3]) == {8, 9, 10}


@pytest.mark.parametrize("groups", [[], [(3,)], [(1, 2), (2, 1)]])
def test_few_members(groups):
    assert elimination_order(groups, Clock(None)) == sorted({member for group in groups for member in group})
