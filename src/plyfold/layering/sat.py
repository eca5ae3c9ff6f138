"""Questions to the SAT solver: within a time limit, and which demands contradict each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from threading import Timer
from typing import Any, TypeAlias

__all__ = ["Clauses", "interrupted_after", "minimal_core", "solve"]

Clauses: TypeAlias = Sequence[Sequence[int]]


def solve(clauses: Clauses, time_limit: float | None = None) -> list[int] | None:
    """Return the literals of a solution, or None if there is none. Raises TimeoutError at the time limit."""
    from pysat.solvers import Glucose4

    with Glucose4(bootstrap_with=clauses) as solver:
        with interrupted_after(time_limit, solver):
            answer = solver.solve_limited(expect_interrupt=True)
        if answer is None:
            raise TimeoutError
        return list(solver.get_model()) if answer else None


@contextmanager
def interrupted_after(time_limit: float | None, solver: Any) -> Iterator[None]:
    """Interrupt a solver when the time is over."""
    if time_limit is None:
        yield
        return
    timer = Timer(time_limit, solver.interrupt)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()


def minimal_core(demands: Sequence[Clauses], given: Clauses = ()) -> list[int]:
    """Return the indices of demands that contradict each other and the given clauses, none of which can be left out.

    Parameters
    ----------
    demands : sequence of clauses
        Not all of them can be met together.
    given : clauses
        What holds anyway.
    """
    from pysat.solvers import Glucose4

    every = [clause for demand in demands for clause in demand]
    first = 1 + max(abs(x) for clause in [*every, *given] for x in clause)
    with Glucose4(bootstrap_with=given) as solver:
        for selector, demand in enumerate(demands, first):
            for clause in demand:
                solver.add_clause([*clause, -selector])
        core = list(range(first, first + len(demands)))
        for selector in list(core):
            rest = [other for other in core if other != selector]
            if selector in core and not solver.solve(assumptions=rest):
                core = sorted(solver.get_core() or [])
    return [selector - first for selector in core]
