"""Flat metrics: sides of triangles, rescaled at the vertices until they fit together in the plane.

Of a mesh only the lengths of its sides are given. Around an inner vertex the angles of its triangles may then add up to
more or less than a full turn. A factor at each inner vertex, for all sides that end there, makes them add up: Newton's
method finds these factors, for they are where a convex energy is least ([SSP08]_).

References
----------
.. [SSP08] B. Springborn, P. Schröder, U. Pinkall, "Conformal equivalence of triangle meshes", ACM Transactions on
   Graphics 27, 2008.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.graphs import spanning_tree
from plyfold.halfedges import ends_of, twins_of
from plyfold.matrices import factorised, laplacian

__all__ = ["Layout", "angles_of", "flattened", "thin"]


# How far from a full turn the angles around a vertex may be in the end, in radians.
_TOLERANCE = 1e-10
_MOST_STEPS, _MOST_HALVINGS = 16, 12
# The same factors serve while the gaps shrink to less than this share at each step.
_SLOWLY = 0.1
# Triangles whose longest side is, but for this share, as long as the two others have no angles that count.
_THIN = 1e-14


def flattened(lengths: Floats, faces: Ints, inner: Ints) -> Floats:
    """Rescale the sides of triangles so that the angles around each inner vertex add up to a full turn.

    Parameters
    ----------
    lengths : (m, 3) float
        Of the sides of each triangle, from corner i to i + 1; the same for both triangles at a side.
    faces : (m, 3) int
    inner : array of int
        The vertices that get a factor; those of the boundary keep theirs.

    Returns
    -------
    (m, 3) float
        Lengths; where there are no such factors, those that come closest on the way. Cost: a sparse
        factorisation or two, and some ten solutions with it.

    Examples
    --------
    Around the top of a flat pyramid there is less than a full turn; in the square the way to the middle is shorter:

    >>> faces = np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
    >>> flattened(np.tile([2.0, 1.5, 1.5], (4, 1)), faces, np.array([4])).round(9)[0].tolist()
    [2.0, 1.414213562, 1.414213562]
    """
    factor, solve = np.zeros(int(faces.max()) + 1), None
    sides, gap = lengths, _gaps(lengths, faces, inner)
    for _ in range(_MOST_STEPS):
        if np.abs(gap).max(initial=0.0) < _TOLERANCE:
            break
        fresh = solve is None
        solve = solve or _newton_steps(sides, faces, inner)
        step = np.zeros_like(factor)
        step[inner] = solve(gap)
        for halving in range(_MOST_HALVINGS if fresh else 1):
            there = factor - step / 2**halving
            shorter = lengths * np.exp(there[faces] / 2 + there[np.roll(faces, -1, axis=1)] / 2)
            left = _gaps(shorter, faces, inner)
            if better := np.linalg.norm(left) < np.linalg.norm(gap):
                break
        if np.linalg.norm(left) > _SLOWLY * np.linalg.norm(gap):
            solve = None
        if better:
            factor, sides, gap = there, shorter, left
        elif fresh:
            break
    return sides


def angles_of(sides: Floats) -> Floats:
    """Return the angle at each corner, (m, 3); if a side is too long for the two others, half a turn opposite it."""
    room, around = _room(sides).clip(0), sides.sum(axis=1)
    corners = [2 * np.arctan2(np.sqrt(room[:, i - 2] * room[:, i - 1]), np.sqrt(room[:, i] * around)) for i in range(3)]
    return np.stack(corners, axis=1)


def thin(sides: Floats) -> Bools:
    """Tell which triangles have a side that is as long as the two others, or longer."""
    return np.asarray((_room(sides) <= _THIN * sides.sum(axis=1)[:, None]).any(axis=1))


def _room(sides: Floats) -> Floats:
    """Return, at each corner, by how much the two sides there are longer than the one opposite."""
    opposite = np.roll(sides, -1, axis=1)
    return np.asarray(sides.sum(axis=1)[:, None] - 2 * opposite)


def _gaps(sides: Floats, faces: Ints, inner: Ints) -> Floats:
    around = np.bincount(faces.ravel(), angles_of(sides).ravel())
    return np.asarray(2 * np.pi - around[inner])


def _newton_steps(sides: Floats, faces: Ints, inner: Ints) -> Callable[[Floats], Floats]:
    """Return what gives the change of factors that fills gaps to first order: by the cotangent Laplacian."""
    angle, flat = angles_of(sides), thin(sides)
    cotangent = np.where(flat[:, None], 0.0, 1 / np.tan(np.where(flat[:, None], 1.0, angle)))
    start, end = ends_of(np.roll(faces, -1, axis=1))
    try:
        factors = factorised(laplacian(start, end, cotangent.ravel() / 2)[inner][:, inner])
    except RuntimeError:  # singular: only triangles without angles around some vertex
        return np.zeros_like
    return lambda gap: np.asarray(factors.solve(gap))


# ---- triangles of which only the lengths of the sides are given ------------------------------------------------------


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
        triangle, before, side, twin = self._tree
        step = within.ravel()[side] - within.ravel()[twin] - np.pi
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
        twin = twins_of(self.faces)
        side = np.flatnonzero(twin >= 0)
        before, tie, order = spanning_tree(len(self.faces), side // 3, twin[side] // 3)
        triangle = order[1:]
        shared = side[tie[triangle]]
        return triangle, before[triangle], shared, twin[shared]

    @cached_property
    def _factors(self) -> Any:
        """The factors of the Laplacian of the graph, without its first row and column."""
        start, end = ends_of(self.faces)
        return factorised(laplacian(start, end, np.ones(len(start)))[1:, 1:].astype(np.complex128))
