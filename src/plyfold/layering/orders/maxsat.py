"""Solutions in which failures weigh least, by cores of them [IMM19]_; within a time limit.

References
----------
.. [IMM19] A. Ignatiev, A. Morgado, J. Marques-Silva, "RC2: an efficient MaxSAT solver", Journal on Satisfiability,
   Boolean Modeling and Computation 11, 2019.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from plyfold.clock import Clock
from plyfold.sat import Clauses, StoppableSolver, in_time, solve

__all__ = ["equal_or_failing", "fewest_failures"]


def equal_or_failing(pairs: Iterable[Sequence[int]], failures: Iterable[int]) -> Iterator[list[int]]:
    """Yield the clauses that both literals of each pair are true or both false, or else its failure is true."""
    for (first, second), failure in zip(pairs, failures, strict=True):
        yield [-first, second, failure]
        yield [first, -second, failure]


def fewest_failures(
    clauses: Clauses, n_variables: int, weight: Mapping[int, int], clock: Clock, stratified: bool = False
) -> tuple[list[int] | None, int]:
    """Find a solution of the clauses in which variables that are true weigh least.

    Parameters
    ----------
    clauses : iterable of clauses
        They have a solution.
    n_variables : int
    weight : mapping of int to int
        The variables that ought to be false, and how much each weighs if it is true.
    clock : Clock
    stratified : bool, optional
        Whether to take heavy variables first. Otherwise those of which at most one can be false are taken together.

    Returns
    -------
    list of int or None
        The literals of the solution; None if the time was over before it was found.
    int
        What it weighs; or else a bound for what all solutions weigh.
    """
    try:
        if not weight:
            return solve(clauses, clock), 0
        formula = _wishes(n_variables, weight, clock)
    except TimeoutError:
        return None, 0
    with _solver(formula, stratified) as solver:
        return _solution(solver, clauses, clock), int(solver.cost)


def _wishes(n_variables: int, weight: Mapping[int, int], clock: Clock) -> Any:
    """Return the formula that the variables with weights are all false, as far as possible."""
    from pysat.formula import WCNF

    formula = WCNF()
    # This clause says nothing; it makes all variables known.
    formula.append([n_variables, -n_variables])
    for variable in clock.while_time(weight):
        formula.append([-variable], weight=weight[variable])
    return formula


def _solver(formula: Any, stratified: bool) -> Any:
    from pysat.examples.rc2 import RC2, RC2Stratified

    solver = (RC2Stratified if stratified else RC2)(formula, exhaust=True, minz=True, adapt=not stratified)
    # Core minimisation does not ask so that it can be interrupted, and holds the interpreter meanwhile.
    solver.oracle = StoppableSolver(solver.oracle)
    return solver


def _solution(solver: Any, clauses: Clauses, clock: Clock) -> list[int] | None:
    try:
        solver.oracle.append_formula(clock.while_time(clauses))
        return list(in_time(clock.left, solver.oracle, solver.compute))
    except TimeoutError:
        return None
