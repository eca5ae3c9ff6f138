"""Disks of formulas lift exactly if the formula is satisfiable, decided here by trying all values."""

from itertools import combinations, combinations_with_replacement, product

import numpy as np
import pytest

import plyfold as pf
from plyfold.errors import InputError
from plyfold.hard.formulas import formula_disk

FANO = [(1, 2, 3), (1, 4, 5), (1, 6, 7), (2, 4, 6), (2, 5, 7), (3, 4, 7), (3, 5, 6)]
CLAUSES = [(1, *(sign * v for sign, v in zip(signs, (2, 3), strict=True))) for signs in product([1, -1], repeat=2)]
SHORT = [(1, 2), (1, -2), (1, 3), (2, 3), (-2, 3)]


def holds(values, clauses):
    return all(len({values[abs(literal)] == (literal > 0) for literal in clause}) == 2 for clause in clauses)


def satisfiable(clauses):
    names = sorted({abs(literal) for clause in clauses for literal in clause})
    every = (dict(zip(names, values, strict=True)) for values in product([False, True], repeat=len(names)))
    return any(holds(values, clauses) for values in every)


def check_verdict(clauses):
    made = formula_disk(clauses)
    found = pf.find_layering(made.disk.immersion)
    assert bool(found) == satisfiable(clauses)
    if found:
        assert holds(made.assignment(found), clauses)
    return made


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_every_formula_with_three_variables(count):
    """Up to a clause negated as a whole, there are four clauses of three literals."""
    for clauses in combinations_with_replacement(CLAUSES, count):
        check_verdict(list(clauses))


def test_the_four_clauses_together_are_not_satisfiable():
    assert not satisfiable(CLAUSES)
    assert satisfiable(CLAUSES[:3])


@pytest.mark.parametrize("count", [1, 2, 3])
def test_short_clauses_with_longer_ones(count):
    for clauses in combinations(SHORT + CLAUSES[1:3], count):
        check_verdict(list(clauses))


@pytest.mark.parametrize("seed", range(20))
def test_random_formulas(seed):
    rng = np.random.default_rng(seed)
    names = int(rng.integers(4, 7))
    clauses = [
        tuple((1 + rng.choice(names, 3, replace=False)) * rng.choice([-1, 1], 3)) for _ in range(rng.integers(3, 14))
    ]
    check_verdict([tuple(map(int, clause)) for clause in clauses])


@pytest.mark.parametrize("clauses", [FANO, list(combinations(range(1, 6), 3))], ids=["fano", "five points"])
def test_known_unsatisfiable(clauses):
    made = check_verdict(clauses)
    assert not pf.find_layering(made.disk.immersion)
    assert made.disk.immersion.arrangement.n_crossings <= 100 * len(clauses)
    assert check_verdict(clauses[1:]).disk.covers


def test_a_literal_and_its_negation_make_a_clause_true():
    assert pf.find_layering(formula_disk([(1, -1, 2)]).disk.immersion)


@pytest.mark.parametrize("clauses", [[], [(1,)], [(1, 1, 1)], [(1, 2, 3, 4)], [(0, 1, 2)], [(1, 1.5)]])
def test_refuses(clauses):
    with pytest.raises(InputError):
        formula_disk(clauses)
