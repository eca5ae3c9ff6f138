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

from plyfold.arrays import Floats, Ints
from plyfold.clock import UNWATCHED, Watch

__all__ = ["diagonal_matrix", "factorised", "laplacian", "one_thread", "summed"]

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


def summed(values: Floats, rows: Ints, columns: Ints, shape: tuple[int, int]) -> Any:
    """Return the sparse matrix with some entries; those at the same place are added up.

    Examples
    --------
    >>> import numpy as np
    >>> summed(np.ones(3), np.array([0, 0, 1]), np.array([1, 1, 0]), (2, 2)).toarray().tolist()
    [[0.0, 2.0], [1.0, 0.0]]
    """
    from scipy.sparse import coo_array

    return coo_array((values, (rows, columns)), shape=shape).tocsr()


def diagonal_matrix(values: Floats) -> Any:
    """Return the sparse matrix with some values on its diagonal."""
    from scipy.sparse import diags_array

    return diags_array(values)


def laplacian(start: Ints, end: Ints, weight: Floats) -> Any:
    """Return the Laplacian of a graph whose edges have weights; sparse.

    Examples
    --------
    >>> import numpy as np
    >>> laplacian(np.array([0]), np.array([1]), np.array([2.0])).toarray().tolist()
    [[2.0, -2.0], [-2.0, 2.0]]
    """
    size = int(max(start.max(), end.max())) + 1
    one_way = summed(weight, start, end, (size, size))
    whole = one_way + one_way.T
    return (diagonal_matrix(whole.sum(axis=1)) - whole).tocsr()


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
