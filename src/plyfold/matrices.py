"""Large sparse matrices, and one thread for small full ones.

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

from plyfold.clock import UNWATCHED, Watch

__all__ = ["factorised", "one_thread"]

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


def factorised(matrix: Any, watch: Watch = UNWATCHED) -> Any:
    """Return the factors of a sparse symmetric matrix, real or complex, with its pivots on the diagonal.

    Raises RuntimeError if one of them is 0, as none is of a positive definite matrix.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.sparse import diags_array
    >>> factorised(diags_array(np.array([1.0, 2.0]))).solve(np.array([3.0, 4.0])).tolist()
    [3.0, 2.0]
    """
    from scipy.sparse.linalg import splu

    columns, options = matrix.tocsc(), {"SymmetricMode": True}
    return watch.wait_for(
        lambda: splu(columns, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options), columns.shape[0]
    )
