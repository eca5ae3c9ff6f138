"""Machine code for hot loops, where numba is installed: the extra ``fast``.

A loop is written once, in plain Python, over lists or arrays alike: it indexes them and does arithmetic, no more. As it
stands it runs on lists. With numba it is translated to machine code and runs on arrays, some fifty times as fast;
numba keeps the translation in a file, so that takes seconds once and some tenths of a second in each later process.

To load numba pays from about a second of work on. So it is loaded when the loops have taken
:data:`STEPS_BEFORE_NUMBA` steps in this process, the next ones included, and used from the start where it is imported
already. Any number of threads may run loops, and Ctrl-C may come at any moment: numba is loaded and translates in
threads of its own, one at a time.
"""

from __future__ import annotations

import logging  # noqa: F401 - its hooks for forks come before ours
import os
import sys
import warnings
from _thread import allocate_lock, start_new_thread
from collections.abc import Callable, Iterable
from functools import cache, partial
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import Any, NoReturn, TypeAlias, TypeVar

import numpy as np

__all__ = ["STEPS_BEFORE_NUMBA", "called_from_loops", "run_in_python", "run_loop"]

_Answer = TypeVar("_Answer")
_Function = TypeVar("_Function", bound=Callable[..., Any])
_Group: TypeAlias = tuple[Any, ...]
_Results = TypeVar("_Results", bound=_Group)
_Translation: TypeAlias = Callable[..., Any] | None
_Loop: TypeAlias = Callable[[Any, _Results], int]

# A step is a few microseconds of plain Python: a second in all.
STEPS_BEFORE_NUMBA = 300_000

# Nothing is allocated in a loop, so no references need be counted, which takes longer than all the rest. Other threads
# run meanwhile, among them the one that ends the process when Ctrl-C is pressed.
_OPTIONS = {"_nrt": False, "nogil": True}

# Whoever works on numba holds it; so does a process while it forks, so that no child inherits half of the work.
# (The last hook is the first to run: with numba's log locked by the hook of `logging`, the work would never end.)
_work = allocate_lock()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_work.acquire, after_in_parent=_work.release, after_in_child=_work.release)
# Machine code by loop and kinds of arrays; none where numba cannot make any.
_translations: dict[_Group, _Translation] = {}
# Threads may lose a few steps of each other: that does not matter.
_steps_so_far = 0
# Functions called from loops, and those of them that numba does not know yet.
_called: set[Callable[..., Any]] = set()
_waiting: set[Callable[..., Any]] = set()


def called_from_loops(function: _Function) -> _Function:
    """Mark a function that loops call, to be translated together with them; it stays as it is."""
    _called.add(function)
    _waiting.add(function)
    return function


def run_loop(loop: _Loop[_Results], steps: int, given: tuple[_Group, ...], results: _Results) -> _Results:
    """Run a loop on groups of arrays, in plain Python or in machine code; the outcome is the same.

    Arrays of other numbers than those of machines, such as fractions, make it plain Python.

    Parameters
    ----------
    loop : callable
        Takes ``given`` and ``results``, and returns a number.
    steps : int
        How much there is to do.
    given : tuple of NamedTuple of ndarray
        What the loop reads, and room to work in.
    results : NamedTuple of ndarray
        What it writes.

    Returns
    -------
    NamedTuple of ndarray
        The results.
    """
    plain = any(array.dtype == object for group in given for array in group)
    if not plain and _machine_code_pays(steps) and (translated := _machine_code(loop, given, results)):
        translated(given, results)
        return results
    return run_in_python(loop, given, results)


def run_in_python(loop: _Loop[_Results], given: tuple[_Group, ...], results: _Results) -> _Results:
    """Run a loop in plain Python; otherwise as :func:`run_loop`."""
    found = _listed(results)
    loop(tuple(_listed(group) for group in given), found)
    arrays = (np.array(values, dtype=array.dtype) for values, array in zip(found, results, strict=True))
    return _regrouped(results, arrays)


def _listed(group: _Results) -> _Results:
    return _regrouped(group, (array.tolist() for array in group))


def _regrouped(group: _Results, members: Iterable[Any]) -> _Results:
    make: Callable[..., _Results] = type(group)
    return make(*members)


def _machine_code_pays(steps: int) -> bool:
    global _steps_so_far  # noqa: PLW0603
    _steps_so_far += steps
    wanted = sys.modules.get("numba") is not None or _steps_so_far > STEPS_BEFORE_NUMBA
    return wanted and _can_be_imported()


@cache
def _can_be_imported() -> bool:
    """Import numba. Where that fails, it is as if it were not installed.

    It refuses versions of numpy newer than it knows; and an import of it elsewhere may have been broken off.
    """
    return _undisturbed(_import_numba)


def _import_numba() -> bool:
    try:
        import_module("numba")
    except Exception:
        return False
    return True


def _machine_code(loop: Callable[..., Any], given: tuple[_Group, ...], results: _Group) -> _Translation:
    """Return the translation of a loop for arrays of these kinds."""
    kinds = (loop, *(_kind(group) for group in (*given, results)))
    if kinds not in _translations:
        _undisturbed(partial(_translate, kinds, loop, (given, results)))
    return _translations[kinds]


def _kind(group: _Group) -> _Group:
    """Return all that machine code for arrays depends on."""
    return type(group), *((array.dtype, array.ndim, array.flags.num) for array in group)


def _undisturbed(work: Callable[[], _Answer]) -> _Answer:
    """Do a piece of work that must not be broken off, one at a time, in a thread that Ctrl-C cannot reach; wait for it.

    An import or a translation that is broken off would leave numba useless in this process. If Ctrl-C ends the
    waiting, the work goes on. The thread and the lock are the plainest there are: those of ``threading`` and
    ``concurrent.futures`` can themselves stay locked when Ctrl-C comes between two of their lines.
    """
    outcome: list[Callable[[], _Answer]] = []
    done = allocate_lock()
    done.acquire()

    def do() -> None:
        try:
            with _work:
                answer = work()
            outcome.append(lambda: answer)
        except BaseException as error:  # it is raised again below
            outcome.append(partial(_raise, error))
        finally:
            done.release()

    start_new_thread(do, ())
    done.acquire()
    return outcome[0]()


def _raise(error: BaseException) -> NoReturn:
    raise error


def _translate(kinds: _Group, loop: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    """Have numba translate a loop, unless another thread did while this one waited."""
    if kinds in _translations:
        return
    try:
        signature = tuple(map(import_module("numba").typeof, arguments))
        _translations[kinds] = _dispatcher(loop).compile(signature)
    except Exception as error:
        reason = f"numba could not translate {loop.__qualname__}, which runs in plain Python: {error!r}"
        warnings.warn(reason, RuntimeWarning, stacklevel=2)
        _translations[kinds] = None


@cache
def _dispatcher(loop: Callable[..., Any]) -> Any:
    """Return what translates a loop, one kind of arrays after the other."""
    register = import_module("numba.extending").register_jitable(**_OPTIONS)
    parts = _reached(loop)
    for function in parts & _waiting:
        register(function)
    _waiting.difference_update(parts)
    translate = import_module("numba").njit
    try:
        return translate(cache=True, **_OPTIONS)(_named_after_sources(loop, parts))
    except (OSError, RuntimeError):  # nowhere to keep a translation: it is made anew in every process
        return translate(**_OPTIONS)(loop)


def _reached(loop: Callable[..., Any]) -> set[FunctionType]:
    """Return the marked functions that a loop calls, by way of others too."""
    found: set[FunctionType] = set()
    waiting: list[Any] = [loop]
    while waiting:
        function = waiting.pop()
        named = [function.__globals__.get(name) for name in function.__code__.co_names]
        fresh = {other for other in named if isinstance(other, FunctionType) and other in _called} - found
        found |= fresh
        waiting += fresh
    return found


def _named_after_sources(loop: Callable[..., Any], parts: set[FunctionType]) -> FunctionType:
    """Return a copy of a loop whose name changes with all files that it comes from, and with the options.

    numba looks for its translation by this name, and at the loop's own file alone.
    """
    code, names = loop.__code__, loop.__globals__
    sources = sorted({code.co_filename, *(function.__code__.co_filename for function in parts)})
    digest = sha256(repr(_OPTIONS).encode() + b"".join(Path(source).read_bytes() for source in sources)).hexdigest()
    copy = FunctionType(code, names, loop.__name__)
    copy.__qualname__ = f"{loop.__name__}_{digest[:16]}"
    return copy
