"""Triangles of which only the lengths of the sides are given, laid out in the plane one beside the other."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.disk.flatten import angles_of
from plyfold.disk.locate import twins

__all__ = ["Layout"]


@dataclass(frozen=True, eq=False)
class Layout:
    """A disk of triangles without lengths; what is the same for all lengths is found once.

    Parameters
    ----------
    faces : (m, 3) int
        Counter-clockwise.
    boundary : array of int
        The vertices on the boundary.

    Examples
    --------
    >>> layout = Layout(np.array([(0, 1, 2), (0, 2, 3)]), np.arange(4))
    >>> sides = np.array([(1.0, 1.0, 2**0.5), (2**0.5, 1.0, 1.0)])
    >>> (layout.points(sides, layout.directions(sides)).round(9) + 0.0).tolist()
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
    """

    faces: Ints
    boundary: Ints

    @cached_property
    def inner(self) -> Ints:
        """The vertices that are not on the boundary."""
        return np.setdiff1d(np.arange(int(self.faces.max()) + 1), self.boundary)

    def directions(self, sides: Floats) -> Floats:
        """Return the directions of the sides, (m, 3), for lengths of the same shape; that of the very first is 0.

        They add up from triangle to triangle, so they may be more than a full turn; with the lengths, they change
        without jumps.
        """
        angle = angles_of(sides)
        within = np.stack([np.zeros(len(sides)), np.pi - angle[:, 1], 2 * np.pi - angle[:, 1] - angle[:, 2]], axis=1)
        triangle, before, side, beside = self._tree
        step = within.ravel()[side] - within.ravel()[beside] - np.pi
        first = [0.0] * len(sides)
        for one, previous, more in zip(triangle.tolist(), before.tolist(), step.tolist(), strict=True):
            first[one] = first[previous] + more
        return np.asarray(np.array(first)[:, None] + within)

    def points(self, sides: Floats, directions: Floats) -> Floats:
        """Return the vertices, (n, 2), of triangles with such sides: vertex 0 at (0, 0)."""
        way = sides * np.exp(1j * directions)
        force = np.zeros(int(self.faces.max()) + 1, dtype=np.complex128)
        np.add.at(force, np.roll(self.faces, -1, axis=1).ravel(), way.ravel())
        np.add.at(force, self.faces.ravel(), -way.ravel())
        places = np.zeros_like(force)
        places[1:] = self._factors.solve(force[1:])
        return np.column_stack([places.real, places.imag])

    @cached_property
    def _tree(self) -> tuple[Ints, Ints, Ints, Ints]:
        """Triangles in an order in which each but the first lies beside an earlier one: this one, and their sides."""
        from scipy.sparse import csr_array
        from scipy.sparse.csgraph import breadth_first_order

        beside, count = twins(self.faces), len(self.faces)
        side = np.flatnonzero(beside >= 0)
        key = side // 3 * count + beside[side] // 3
        graph = csr_array((np.ones(len(side)), (side // 3, beside[side] // 3)), shape=(count, count))
        order, before = breadth_first_order(graph, 0)
        triangle, previous = order[1:].astype(np.int64), before[order[1:]].astype(np.int64)
        by_key = np.argsort(key)
        shared = side[by_key[np.searchsorted(key, previous * count + triangle, sorter=by_key)]]
        return triangle, previous, shared, beside[shared]

    @cached_property
    def _factors(self) -> Any:
        """The factors of the Laplacian of the graph, without its first row and column."""
        from scipy.sparse import csr_array, diags_array
        from scipy.sparse.linalg import splu

        start, end = self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel()
        size = int(self.faces.max()) + 1
        one_way = csr_array((np.ones(len(start)), (start, end)), shape=(size, size))
        whole = one_way + one_way.T
        matrix = (diags_array(whole.sum(axis=0)) - whole).tocsc()[1:, 1:].astype(np.complex128)
        return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
