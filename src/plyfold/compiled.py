"""Machine code for hot loops, where numba is installed: the extra ``fast``.

A loop is written once, in plain Python, over lists or arrays alike: it indexes them and does arithmetic, no more. As it
stands it runs on lists. With numba it is translated to machine code and runs on arrays, some fifty times as fast;
numba keeps the translation in a file, so that takes seconds once and some tenths of a second in each later process.

To load numba pays from about a second of work on. So it is loaded when the loops have taken
:data:`STEPS_BEFORE_NUMBA` steps in this process, the next ones included, and used from the start where it is imported
already.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from functools import cache
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from threading import Lock
from types import FunctionType
from typing import Any, TypeAlias, TypeVar

import numpy as np

__all__ = ["STEPS_BEFORE_NUMBA", "called_from_loops", "run_in_python", "run_loop"]

_Function = TypeVar("_Function", bound=Callable[..., Any])
_Group: TypeAlias = tuple[Any, ...]
_Results = TypeVar("_Results", bound=_Group)
_Loop: TypeAlias = Callable[[Any, _Results], int]

# A step is a few microseconds of plain Python: a second in all.
STEPS_BEFORE_NUMBA = 300_000

# Nothing is allocated in a loop, so no references need be counted, which takes longer than all the rest.
_OPTIONS = {"_nrt": False}

_lock = Lock()
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
    if not _machine_code_pays(steps):
        return run_in_python(loop, given, results)
    _machine_code(loop)(given, results)
    return results


def run_in_python(loop: _Loop[_Results], given: tuple[_Group, ...], results: _Results) -> _Results:
    """Run a loop in plain Python, which can calculate with any kind of number; otherwise as :func:`run_loop`."""
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
    return sys.modules.get("numba") is not None or (_steps_so_far > STEPS_BEFORE_NUMBA and _can_be_imported())


@cache
def _can_be_imported() -> bool:
    """Import numba. It refuses versions of numpy newer than it knows; then it is as if it were not installed."""
    try:
        import_module("numba")
    except ImportError:
        return False
    return True


@cache
def _machine_code(loop: Callable[..., Any]) -> Callable[..., Any]:
    register = import_module("numba.extending").register_jitable(**_OPTIONS)
    with _lock:
        parts = _reached(loop)
        for function in parts & _waiting:
            register(function)
        _waiting.difference_update(parts)
    translate = import_module("numba").njit
    try:
        translated: Callable[..., Any] = translate(cache=True, **_OPTIONS)(_named_after_sources(loop, parts))
    except (OSError, RuntimeError):  # nowhere to keep a translation: it is made anew in every process
        translated = translate(**_OPTIONS)(loop)
    return translated


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
    """Return a copy of a loop whose name changes with all files that it comes from.

    numba looks for its translation by this name, and at the loop's own file alone.
    """
    code, names = loop.__code__, loop.__globals__
    sources = sorted({code.co_filename, *(function.__code__.co_filename for function in parts)})
    digest = sha256(b"".join(Path(source).read_bytes() for source in sources)).hexdigest()
    copy = FunctionType(code, names, loop.__name__)
    copy.__qualname__ = f"{loop.__name__}_{digest[:16]}"
    return copy
