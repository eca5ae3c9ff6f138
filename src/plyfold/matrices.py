"""Large sparse matrices, and one thread for small full ones.

The threads of BLAS wait for each other by turning round and round, several times for each row of a matrix. Where there
are more of them than idle processors, matrices of a few hundred rows take a hundred times as long.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from threading import Lock
from typing import Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.clock import UNWATCHED, Watch

__all__ = [
    "Factors",
    "definite_solution",
    "diagonal_matrix",
    "dissected_order",
    "factorised",
    "laplacian",
    "one_thread",
    "summed",
    "without_empty_columns",
]

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


def without_empty_columns(rows: Any) -> tuple[Any, Ints]:
    """Return a sparse matrix in rows without its empty columns, and the numbers of the others.

    Examples
    --------
    >>> kept, columns = without_empty_columns(summed(np.array([5.0]), np.array([0]), np.array([2]), (1, 9)))
    >>> kept.toarray().tolist(), columns.tolist()
    ([[5.0]], [2])
    """
    from scipy.sparse import csr_array

    columns, number = np.unique(rows.indices, return_inverse=True)
    return csr_array((rows.data, number, rows.indptr), shape=(rows.shape[0], len(columns))), columns


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


@dataclass(frozen=True, eq=False)
class Factors:
    """The factors of a sparse symmetric matrix, A = C D Cᵀ with rows in the order of elimination.

    Parameters
    ----------
    lu : scipy.sparse.linalg.SuperLU
        Of the matrix with its rows and columns in ``order``.
    order : (n,) int or None
        None where they are as they were.
    """

    lu: Any
    order: Ints | None = None

    def solve(self, right: Any) -> Any:
        """Return x with Ax = b, for one column b or several."""
        if self.order is None:
            return self.lu.solve(right)
        solution = np.empty_like(right)
        solution[self.order] = self.lu.solve(right[self.order])
        return solution

    @property
    def time(self) -> Ints:
        """When each row of the matrix is eliminated, (n,)."""
        if self.order is None:
            return np.asarray(self.lu.perm_r)
        time = np.empty_like(self.lu.perm_r)
        time[self.order] = self.lu.perm_r
        return np.asarray(time)


def definite_solution(matrix: Floats, right: Floats) -> Floats:
    """Return x with Ax = b for a full symmetric positive definite matrix A, which is overwritten (Cholesky).

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is not positive definite.

    Examples
    --------
    >>> definite_solution(np.array([[4.0, 0.0], [0.0, 1.0]]), np.array([2.0, 3.0])).tolist()
    [0.5, 3.0]
    """
    from scipy.linalg import lapack

    if not len(right):
        return np.empty(0)
    _, solution, info = lapack.dposv(matrix.T, right, lower=1, overwrite_a=1)
    if info:
        raise np.linalg.LinAlgError("the matrix is not positive definite")
    return np.asarray(solution)


def factorised(matrix: Any, watch: Watch = UNWATCHED, order: Ints | None = None) -> Factors:
    """Return the factors of a sparse symmetric matrix, real or complex, with its pivots on the diagonal.

    Rows are eliminated in the given order, nearly, or else in one of least degree. Raises RuntimeError if a pivot is 0,
    as none is of a positive definite matrix.

    Examples
    --------
    >>> import numpy as np
    >>> from scipy.sparse import diags_array
    >>> factorised(diags_array(np.array([1.0, 2.0]))).solve(np.array([3.0, 4.0])).tolist()
    [3.0, 2.0]
    """
    from scipy.sparse.linalg import splu

    columns, options = (
        matrix.tocsc() if order is None else matrix.tocsr()[order][:, order].tocsc(),
        {"SymmetricMode": True},
    )
    kind = "MMD_AT_PLUS_A" if order is None else "NATURAL"
    lu = watch.wait_for(
        lambda: splu(columns, permc_spec=kind, diag_pivot_thresh=0.0, options=options), columns.shape[0]
    )
    return Factors(lu, order)


def dissected_order(matrix: Any, watch: Watch = UNWATCHED) -> Ints | None:
    """Return an order of a sparse symmetric matrix's rows by nested dissection, or None without the library for it.

    All rows on both sides of a short line across the graph come before those on the line; on each side, likewise.
    """
    try:
        pymetis = import_module("pymetis")
    except ImportError:
        return None
    graph = matrix.tocsr(copy=True)
    graph.setdiag(0)
    graph.eliminate_zeros()
    adjacency = pymetis.CSRAdjacency(graph.indptr, graph.indices)
    return np.array(watch.wait_for(lambda: pymetis.nested_dissection(adjacency), graph.shape[0])[0])
