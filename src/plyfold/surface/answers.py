"""How heights answer to forces: all of them to a few forces, and those of a few vertices to forces on each other.

The cloth's matrix is a product, so its inverse is a product too, or a difference by partial fractions,

    K = L M⁻¹ (M + ℓ² L),    K⁻¹ = (M + ℓ² L)⁻¹ M L⁻¹ = L⁻¹ − (L + M/ℓ²)⁻¹,

of inverses of matrices as sparse as L. The product answers for all heights, the difference for a few. Each matrix is
A = C D Cᵀ with a sparse triangle C, so an entry of its inverse between vertices v and w is the product of two columns,
D^(−½) C⁻¹ e_v and D^(−½) C⁻¹ e_w. These have entries only along the paths from v and from w to the root of the
elimination tree, and need no other entries of C: a few hundred numbers, where heights of all vertices take two
solutions of whole systems. Paths are short where the order of elimination is one of nested dissection: first the
vertices on both sides of a short line across the cloth, then those on the line.

References
----------
J. Liu, "The Role of Elimination Trees in Sparse Factorization", SIAM J. Matrix Anal. Appl. 11, 1990. A. George, "Nested
Dissection of a Regular Finite Element Mesh", SIAM J. Numer. Anal. 10, 1973.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.core.buffers import all_flat, flat
from plyfold.core.elimination import (
    Paths,
    Triangle,
    elimination_tree,
    lengths_of_paths,
    multiply_paths,
    walk_paths,
)
from plyfold.matrices import Factors, diagonal_matrix, dissected_order, factorised, without_empty_columns
from plyfold.surface.energy import Cloth

__all__ = ["Answers", "InverseEntries"]

# Matrices with fewer rows are factorised sooner without a dissection.
_FEW = 5000
# Products of two columns between two looks at the clock.
_PRODUCTS_AT_A_TIME = 200_000


class InverseEntries:
    """Entries of the inverse of a sparse positive definite matrix, between rows that join one after the other.

    Parameters
    ----------
    matrix : (n, n) sparse array
    factors : Factors
        Of this matrix.

    Examples
    --------
    >>> from scipy.sparse import csr_array
    >>> matrix = csr_array(np.array([[2.0, 1.0], [1.0, 2.0]]))
    >>> entries = InverseEntries(matrix, factorised(matrix))
    >>> entries.join(np.array([1, 0]))
    >>> (3 * entries.between(np.array([0, 1]), np.array([0]))).round(9).tolist()
    [[2.0], [-1.0]]
    """

    def __init__(self, matrix: Any, factors: Factors) -> None:
        self._time = factors.time
        self._parent = _parents(matrix.tocsc(), self._time)
        lower, scale = factors.lu.L, 1 / np.sqrt(factors.lu.U.diagonal())
        self._triangle = Triangle(*all_flat(lower.indptr, lower.indices, lower.data, scale, self._parent))
        self._start, self._node = np.zeros(1, dtype=np.int64), np.empty(0, dtype=np.int32)
        self._value = np.empty(0)

    def join(self, rows: Ints) -> None:
        """Let more rows join; −1 stands for a row whose entries are all 0."""
        leaves = np.where(rows < 0, -1, self._time[rows]).astype(np.int64)
        length = np.empty(len(leaves), dtype=np.int64)
        lengths_of_paths(flat(self._parent), flat(leaves), flat(length))
        node, value = np.empty(length.sum(), dtype=np.int32), np.empty(length.sum())
        walk_paths(self._triangle, flat(leaves), flat(node), flat(value))
        self._start = np.append(self._start, self._start[-1] + np.cumsum(length))
        self._node, self._value = np.append(self._node, node), np.append(self._value, value)

    def between(self, some: Ints, others: Ints, watch: Watch = UNWATCHED) -> Floats:
        """Return the entries between rows that have joined, numbered in the order of joining; (some, others)."""
        paths = Paths(*all_flat(self._start, self._node, self._value))
        product = np.empty((len(some), len(others)))
        at_a_time = 1 + _PRODUCTS_AT_A_TIME // len(others)
        for first in range(0, len(some), at_a_time):
            watch.step()
            part = slice(first, first + at_a_time)
            multiply_paths(paths, flat(some[part]), flat(others), flat(product[part]))
        return product


def _parents(columns: Any, time: Ints) -> Any:
    """Return the elimination tree of a matrix whose rows are eliminated in this order, by time; −1 for a root."""
    first, row, when, row_at = (
        np.asarray(part, dtype=np.int32) for part in (columns.indptr, columns.indices, time, np.argsort(time))
    )
    parent, above = np.empty_like(row_at), np.full_like(row_at, -1)
    elimination_tree(*all_flat(first, row, when, row_at, parent, above))
    return parent


@dataclass(frozen=True, eq=False)
class _Part:
    """An inverse that counts with a sign: its factors, and the row of the matrix that belongs to each vertex, or −1."""

    sign: int
    factors: Factors
    row: Ints
    entries: InverseEntries


class Answers:
    """How the heights of a cloth answer to forces; some vertices may be held.

    Parameters
    ----------
    cloth : Cloth
    held : (v,) bool
        Vertices that stay at 0. If there are none, forces whose sum is 0 have answers, up to a constant.
    watch : Watch, optional

    Notes
    -----
    Vertices that are held in whole regions leave no product of sparse matrices: then K itself is factorised.
    """

    def __init__(self, cloth: Cloth, held: Bools, watch: Watch = UNWATCHED) -> None:
        self._cloth, self._watch, self._number = cloth, watch, np.full(len(held), -1)
        if held.any():
            self._parts = [self._part(1, cloth.stiffness, ~held)]
        else:
            # Hold one vertex: heights are known up to a constant.
            order, all_vertices = self._order(cloth.laplacian), np.ones(len(held), dtype=bool)
            but_one = np.arange(len(held)) > 0
            near = cloth.laplacian + diagonal_matrix(cloth.area / cloth.bending)
            self._parts = [self._part(1, cloth.laplacian, but_one, order), self._part(-1, near, all_vertices, order)]

    def _order(self, matrix: Any) -> Ints | None:
        return dissected_order(matrix, self._watch) if matrix.shape[0] >= _FEW else None

    def _part(self, sign: int, matrix: Any, free: Bools, order: Ints | None = None) -> _Part:
        """Return the inverse of the matrix of free vertices."""
        row = np.where(free, np.cumsum(free) - 1, -1)
        inner = matrix if free.all() else matrix.tocsr()[free][:, free]
        order = self._order(inner) if order is None else row[order[free[order]]]
        factors = factorised(inner, self._watch, order)
        return _Part(sign, factors, row, InverseEntries(inner, factors))

    def heights(self, force: Floats) -> Floats:
        """Return the heights that balance forces, (v,) or (v, columns)."""
        if len(self._parts) == 1:
            return self._balance(self._parts[0], force)
        far, near = self._parts
        curved = (self._cloth.area * self._balance(far, force).T).T
        return self._balance(near, curved) / self._cloth.bending

    def _balance(self, part: _Part, force: Floats) -> Floats:
        if (part.row >= 0).all():
            return np.asarray(self._watch.wait_for(lambda: part.factors.solve(force), force.size))
        answer = np.zeros(force.shape)
        free = part.row >= 0
        answer[free] = self._watch.wait_for(lambda: part.factors.solve(force[free]), force.size)
        return answer

    def between(self, some: Any, others: Any) -> Floats:
        """Return how weighted sums of heights answer to forces along others, (some, others).

        Parameters
        ----------
        some, others : (s, v), (o, v) sparse array
            The weights, in rows. Unless vertices are held, those in each row add up to 0.
        """
        (weights, here), (other_weights, there) = without_empty_columns(some), without_empty_columns(others)
        self._join(np.concatenate([here, there]))
        inverse = np.zeros((len(here), len(there)))
        for part in self._parts:
            inverse += part.sign * part.entries.between(self._number[here], self._number[there], self._watch)
        return np.asarray(weights @ (other_weights @ inverse.T).T)

    def _join(self, vertices: Ints) -> None:
        """Let vertices join that have not yet done so."""
        fresh = np.unique(vertices[self._number[vertices] < 0])
        self._number[fresh] = self._number.max(initial=-1) + 1 + np.arange(len(fresh))
        for part in self._parts:
            part.entries.join(part.row[fresh])
