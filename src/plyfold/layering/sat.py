"""Questions to the SAT solver: within a time limit, and which demands contradict each other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from threading import Event, Thread
from typing import Any, TypeAlias, TypeVar

__all__ = ["Clauses", "in_time", "minimal_core", "solve"]

Clauses: TypeAlias = Sequence[Sequence[int]]
Answer = TypeVar("Answer")


def solve(clauses: Clauses, time_limit: float | None = None) -> list[int] | None:
    """Return the literals of a solution, or None if there is none. Raises TimeoutError at the time limit."""
    from pysat.solvers import Glucose4

    with Glucose4(bootstrap_with=clauses) as solver:
        answer = in_time(time_limit, solver, partial(solver.solve_limited, expect_interrupt=True))
        if answer is None:
            raise TimeoutError
        return list(solver.get_model()) if answer else None


def in_time(time_limit: float | None, solver: Any, question: Callable[[], Answer]) -> Answer:
    """Ask a question of a solver, and interrupt the solver when the time is over or Ctrl-C is pressed.

    The question is asked in another thread, since signals have to wait for as long as this one is in foreign code.
    """
    answers: list[Answer] = []
    errors: list[BaseException] = []
    # Not Thread.join: interrupted by a signal, it takes the thread for finished.
    done = Event()

    def ask() -> None:
        try:
            answers.append(question())
        except BaseException as error:  # it is raised again below
            errors.append(error)
        finally:
            done.set()

    try:
        Thread(target=ask, daemon=True).start()
        done.wait(time_limit)
    finally:
        if not done.is_set():
            solver.interrupt()
            done.wait()
    if errors:
        raise errors[0]
    return answers[0]


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
