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
from importlib import import_module
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

_steps_so_far = 0
_called: list[Callable[..., Any]] = []


def called_from_loops(function: _Function) -> _Function:
    """Mark a function that loops call, to be translated together with them; it stays as it is."""
    _called.append(function)
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
    translate_with_loops = import_module("numba.extending").register_jitable(**_OPTIONS)
    while _called:
        translate_with_loops(_called.pop())
    translate = import_module("numba").njit
    try:
        translated: Callable[..., Any] = translate(cache=True, **_OPTIONS)(loop)
    except RuntimeError:  # no folder may be written to: it is translated anew in every process
        translated = translate(**_OPTIONS)(loop)
    return translated
