"""Questions to the SAT solver: one solution or all, within a time limit, and which demands contradict each other.

A clause is a list of literals of which one must be true; a literal is a variable 1, 2, … or its negative.

Nothing here holds up Ctrl-C or a time limit. Clauses are handed over a few at a time, and questions are asked in
another thread, in which the solver lets go of the interpreter and can be stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from itertools import chain
from threading import Event, Thread
from typing import Any, TypeAlias, TypeVar

from plyfold.clock import NO_LIMIT, Clock, make_call

__all__ = [
    "Clauses",
    "StoppableSolver",
    "in_time",
    "minimal_core",
    "search_in_time",
    "solutions_by_choice",
    "solve",
    "solver_of",
]

Clauses: TypeAlias = Iterable[Sequence[int]]
Answer = TypeVar("Answer")


class StoppableSolver:
    """A SAT solver that can be stopped for good, from another thread.

    The question that it works on, and every later one, raises TimeoutError. A plain solver is interrupted in one
    question, if that was asked the right way, and answers the next one.

    Examples
    --------
    >>> with solver_of([[1, 2], [-1]]) as solver:
    ...     solver.ask(), solver.ask([-2])
    (True, False)
    """

    def __init__(self, solver: Any) -> None:
        self._solver = solver
        self._stopped = False

    def __getattr__(self, name: str) -> Any:
        return getattr(self._solver, name)

    def solve_limited(self, assumptions: Sequence[int] = (), expect_interrupt: bool = True) -> bool | None:
        """Tell whether there is a solution; None if that is open at the end of the solver's budget."""
        self._check()
        answer: bool | None = self._solver.solve_limited(assumptions=list(assumptions), expect_interrupt=True)
        self._check()
        return answer

    # Libraries ask in either way.
    solve = solve_limited

    def ask(self, assumptions: Sequence[int] = (), clock: Clock = NO_LIMIT) -> bool | None:
        """Tell the same; Ctrl-C and the time limit end the search."""
        return in_time(clock.left, self, partial(self.solve_limited, assumptions))

    def add_clause(self, clause: Sequence[int], no_return: bool = True) -> bool | None:
        """Add a clause that solutions have to meet."""
        self._check()
        added: bool | None = self._solver.add_clause(clause, no_return)
        return added

    def propagate(self, *args: Any, **options: Any) -> Any:
        """Return what follows at once."""
        self._check()
        return self._solver.propagate(*args, **options)

    def interrupt(self) -> None:
        """Stop."""
        self._stopped = True
        self._solver.interrupt()

    def _check(self) -> None:
        if self._stopped:
            raise TimeoutError


@contextmanager
def solver_of(clauses: Clauses, clock: Clock = NO_LIMIT) -> Iterator[StoppableSolver]:
    """Make a solver that knows some clauses. Raises TimeoutError if the time is over before it knows them."""
    from pysat.solvers import Glucose4

    with Glucose4() as solver:
        solver.append_formula(clock.while_time(clauses))
        yield StoppableSolver(solver)


def solve(clauses: Clauses, clock: Clock = NO_LIMIT) -> list[int] | None:
    """Return the literals of a solution, or None if there is none. Raises TimeoutError at the time limit."""
    with solver_of(clauses, clock) as solver:
        return list(solver.get_model()) if solver.ask(clock=clock) else None


def solutions_by_choice(
    clauses: Clauses,
    choices: Sequence[int],
    clock: Clock = NO_LIMIT,
    lacking: Callable[[list[int]], Sequence[int] | None] = lambda model: None,
) -> Iterator[list[int]]:
    """Yield the literals of all solutions, each once, given variables that determine a solution.

    The solver is asked for one; then the last choice whose opposite has not been tried, under the choices before it, is
    turned round, and the solver is asked for the rest. Nothing is remembered but the way back.

    Parameters
    ----------
    clauses : clauses
    choices : sequence of int
    clock : Clock, optional
        Raises TimeoutError at the time limit.
    lacking : callable, optional
        Returns a clause that all solutions wanted meet, and this one does not; None if it is wanted.
    """
    with solver_of(clauses, clock) as solver:
        tried: list[tuple[int, bool]] = []
        model = _wanted(solver, [], clock, lacking)
        while True:
            if model is not None:
                yield model
                tried += [(model[variable - 1], False) for variable in choices[len(tried) :]]
            while tried and tried[-1][1]:
                tried.pop()
            if not tried:
                return
            tried[-1] = (-tried[-1][0], True)
            model = _wanted(solver, [literal for literal, _ in tried], clock, lacking)


def _wanted(
    solver: StoppableSolver,
    assumptions: Sequence[int],
    clock: Clock,
    lacking: Callable[[list[int]], Sequence[int] | None],
) -> list[int] | None:
    """Return a solution that lacks nothing, or None."""
    while solver.ask(assumptions, clock):
        model: list[int] = solver.get_model()
        clause = lacking(model)
        if clause is None:
            return model
        solver.add_clause(clause)
    return None


def in_time(time_limit: float | None, solver: StoppableSolver, question: Callable[[], Answer]) -> Answer:
    """Ask a question of a solver, and stop the solver when the time is over or Ctrl-C is pressed.

    The question is asked in another thread, since signals have to wait for as long as this one is in foreign code.
    Raises TimeoutError when the time is over, unless the question answers all the same.
    """
    outcome: list[Callable[[], Answer]] = []
    # Not Thread.join: interrupted by a signal, it takes the thread for finished.
    done = Event()
    try:
        Thread(target=make_call, args=(question, outcome, done), daemon=True).start()
        done.wait(time_limit)
    finally:
        if not done.is_set():
            solver.interrupt()
            done.wait()
    return outcome[0]()


def search_in_time(clauses: Clauses, clock: Clock, search: Callable[[StoppableSolver], Answer]) -> Answer:
    """Give a solver that knows some clauses to a search; as :func:`in_time`."""
    with solver_of(clauses, clock) as solver:
        return in_time(clock.left, solver, partial(search, solver))


def minimal_core(
    demands: Sequence[Clauses],
    given: Clauses = (),
    clock: Clock = NO_LIMIT,
    effort: int | None = None,
    most: int | None = None,
) -> list[int]:
    """Return the indices of demands that contradict each other and the given clauses, none of which can be left out.

    Where the solver does not know soon enough, a demand stays; and when the time is over, so do all the others.

    Parameters
    ----------
    demands : sequence of clauses
        Not all of them can be met together.
    given : clauses
        What holds anyway.
    clock : Clock, optional
    effort : int, optional
        Conflicts after which the solver gives up when it is asked whether one demand less is a contradiction too.
    most : int, optional
        Of more demands than this none is tried to be left out, once the solver has said which it needed.
    """
    given = list(given)
    first = 1 + max(abs(x) for clauses in [*demands, given] for clause in clauses for x in clause)
    core = list(range(first, first + len(demands)))
    selected = ([*clause, -selector] for selector, demand in enumerate(demands, first) for clause in demand)
    with suppress(TimeoutError):
        core = search_in_time(chain(given, selected), clock, partial(_reduced, core, effort, most))
    return [selector - first for selector in core]


def _reduced(core: list[int], effort: int | None, most: int | None, solver: StoppableSolver) -> list[int]:
    """Leave out selectors one after the other, as long as the others contradict each other, until the solver stops."""
    with suppress(TimeoutError):
        if solver.solve(core) is False:
            core = sorted(solver.get_core() or [])
        for selector in list(core) if most is None or len(core) <= most else ():
            rest = [other for other in core if other != selector]
            if effort is not None:
                solver.conf_budget(effort)
            if len(rest) < len(core) and solver.solve(rest) is False:
                core = sorted(solver.get_core() or [])
    return core
