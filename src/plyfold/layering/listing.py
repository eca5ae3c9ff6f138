"""All layerings, one at a time: solutions of the parts of the problem that have nothing in common, combined."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from plyfold.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders import OrderProblem, order_problem
from plyfold.layering.sat import solve

__all__ = ["layerings", "solutions"]

Clauses = list[frozenset[int]]


def layerings(immersion: Immersion) -> Iterator[Layering]:
    """List all layerings of an immersed disk, each once, in a stable order; nothing if there is none.

    Parameters
    ----------
    immersion : Immersion

    Yields
    ------
    Layering
        Checked. There can be exponentially many; they are made one at a time, each in time proportional to the number
        of pairs of sheets, as long as no part of the problem is hard.

    Examples
    --------
    >>> from plyfold.immersion import find_immersion
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> [layering.level.tolist() for layering in layerings(find_immersion(ramp))]
    [[1, 2, 1, 1, 1], [2, 1, 1, 1, 1]]
    """
    problem = order_problem(immersion)
    if isinstance(problem, OrderProblem) and solve(problem.clauses) is not None:
        for literals in _combinations(_parts(problem)):
            yield problem.layering(literals)


def solutions(variables: Sequence[int], clauses: Clauses) -> Iterator[set[int]]:
    """Yield the true literals of each solution; the first variable that is not decided is tried true, then false.

    Examples
    --------
    >>> [sorted(true) for true in solutions([1, 2], [frozenset({1, 2})])]
    [[1, 2], [-2, 1], [-1, 2]]
    """
    waiting: list[tuple[set[int], Clauses]] = [(set(), clauses)]
    while waiting:
        true, rest = waiting.pop()
        variable = next((x for x in variables if x not in true and -x not in true), None)
        if variable is None:
            yield true
            continue
        for literal in (-variable, variable):
            assumed = _assume(rest, literal)
            if assumed is not None:
                waiting.append((true | assumed[0], assumed[1]))


def _assume(clauses: Clauses, literal: int) -> tuple[set[int], Clauses] | None:
    """Make a literal true and draw what follows from clauses of one literal.

    Return all literals that are true then, and what remains of the clauses; None if there is a contradiction.
    """
    true, fresh, rest = {literal}, {literal}, clauses
    while fresh:
        false = {-x for x in fresh}
        if not false.isdisjoint(true):
            return None
        rest = [clause - false for clause in rest if clause.isdisjoint(fresh)]
        if not all(rest):
            return None
        fresh = {x for clause in rest if len(clause) == 1 for x in clause}
        true |= fresh
    return true, rest


def _parts(problem: OrderProblem) -> list[tuple[list[int], Clauses]]:
    """Return the variables and clauses of each component; a free variable is one by itself."""
    components = problem.components()
    component_of = {variable: number for number, variables in enumerate(components) for variable in variables}
    clauses: list[Clauses] = [[] for _ in components]
    for clause in problem.clauses:
        clauses[component_of[abs(clause[0])]].append(frozenset(clause))
    return list(zip(components, clauses, strict=True))


def _combinations(parts: Sequence[tuple[list[int], Clauses]]) -> Iterator[list[int]]:
    """Yield all combinations of solutions of the parts, the last part's changing first.

    Each part has at least one solution. Only one of each is held at a time.
    """
    running = [solutions(*part) for part in parts]
    current = [next(part) for part in running]
    while True:
        yield [literal for literals in current for literal in literals]
        for i in reversed(range(len(parts))):
            following = next(running[i], None)
            if following is not None:
                current[i] = following
                break
            running[i] = solutions(*parts[i])
            current[i] = next(running[i])
        else:
            return
