"""One thread for small matrices.

The threads of BLAS wait for each other by turning round and round, several times for each row of a matrix. Where there
are more of them than idle processors, matrices of a few hundred rows take a hundred times as long.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from importlib import import_module
from threading import Lock
from typing import Any

__all__ = ["one_thread"]

_lock = Lock()
# Gives the threads back, once for each who wants one thread: the numbers that the first one found come first.
_limits: list[Any] = []


@contextmanager
def one_thread() -> Iterator[None]:
    """Keep BLAS to one thread, in the whole process, as long as anybody wants it; without threadpoolctl, do nothing.

    Examples
    --------
    >>> with one_thread():
    ...     pass
    """
    threads = _threads()
    if threads is None:
        yield
        return
    with _lock:
        _limits.append(threads.limit(limits=1, user_api="blas"))
    try:
        yield
    finally:
        with _lock:
            # They go in any order; the last to go is left with what the first one found.
            found = _limits.pop()
            if not _limits:
                found.restore_original_limits()


@cache
def _threads() -> Any:
    """Return what sets the numbers of threads. It knows the libraries that are loaded now: numpy's and scipy's."""
    import_module("scipy.linalg")
    with suppress(ImportError):
        return import_module("threadpoolctl").ThreadpoolController()
    return None
