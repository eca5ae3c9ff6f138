"""All layerings, one at a time: solutions of the parts of the problem that have nothing in common, combined."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from plyfold.immersion.immersion import Immersion
from plyfold.layering.layering import Layering
from plyfold.layering.orders.search import OrderProblem, order_problem
from plyfold.sat import solve

__all__ = ["layerings", "solutions"]

_Clauses = list[frozenset[int]]


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
    >>> from plyfold import find_immersion
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> [layering.level.tolist() for layering in layerings(find_immersion(ramp))]
    [[1, 2, 1, 1, 1], [2, 1, 1, 1, 1]]
    """
    problem = order_problem(immersion)
    if isinstance(problem, OrderProblem) and solve(problem.clauses) is not None:
        for literals in _combinations(_parts(problem)):
            yield problem.layering(literals)


def solutions(variables: Sequence[int], clauses: _Clauses) -> Iterator[list[int]]:
    """Yield the true literals of each solution; the first variable that is not decided is tried true, then false.

    Examples
    --------
    >>> [sorted(true) for true in solutions([1, 2], [frozenset({1, 2})])]
    [[1, 2], [-2, 1], [-1, 2]]
    """
    touching = defaultdict(list)
    for clause in clauses:
        for x in clause:
            touching[x].append(clause)
    true: dict[int, None] = {}
    decisions: list[tuple[int, int]] = []
    consistent, at = all(_extend(true, x, touching) for clause in clauses if len(clause) == 1 for x in clause), 0
    while True:
        while consistent and at < len(variables):
            variable = variables[at]
            if variable not in true and -variable not in true:
                decisions.append((len(true), at))
                consistent = _extend(true, variable, touching)
            at += 1
        if consistent:
            yield list(true)
        if not decisions:
            return
        known, at = decisions.pop()
        while len(true) > known:
            true.popitem()
        consistent = _extend(true, -variables[at], touching)


def _extend(true: dict[int, None], literal: int, touching: Mapping[int, _Clauses]) -> bool:
    """Add a literal, and what follows from clauses with one open literal, in order; tell whether that is consistent."""
    waiting = [literal]
    while waiting:
        x = waiting.pop()
        if -x in true:
            return False
        if x not in true:
            true[x] = None
            for clause in touching.get(-x, ()):
                if true.keys().isdisjoint(clause):
                    still_open = [y for y in clause if -y not in true]
                    if not still_open:
                        return False
                    waiting += still_open if len(still_open) == 1 else ()
    return True


def _parts(problem: OrderProblem) -> list[tuple[list[int], _Clauses]]:
    """Return the variables and clauses of each component; a free variable is one by itself."""
    components = problem.components()
    component_of = {variable: number for number, variables in enumerate(components) for variable in variables}
    clauses: list[_Clauses] = [[] for _ in components]
    for clause in problem.clauses:
        clauses[component_of[abs(clause[0])]].append(frozenset(clause))
    return list(zip(components, clauses, strict=True))


def _combinations(parts: Sequence[tuple[list[int], _Clauses]]) -> Iterator[list[int]]:
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
