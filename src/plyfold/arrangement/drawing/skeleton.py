"""A triangulated disk that carries a closed curve on its edges, made from a signed Gauss code alone.

Every border gets a few *beads* between its two crossings, and every bounded cell a *hub* joined to all the beads around
it; at each corner of a cell the two beads next to the crossing are joined. A ring of triangles around all that keeps
parts from running into each other; it ends in the *rim*. No two edges join the same vertices, so the disk can be drawn
with straight edges, and then the curve on it has the code.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Complexes, Floats, Ints

__all__ = ["Kind", "Skeleton", "skeleton"]


_BEADS = 3
_BEADS_ON_A_LOOP = 5
_RING_RATIO = 2.0


class Kind(IntEnum):
    """Where a triangle of the skeleton lies: at a crossing, inside a cell, or in the ring around all."""

    CORNER = 0
    CELL = 1
    RING = 2


@dataclass(frozen=True, eq=False)
class Skeleton:
    """The triangulated disk.

    Parameters
    ----------
    triangles : (m, 3) int
        Counter-clockwise. Vertices are the crossings, then the beads in order along the curve, the hubs, and the rim.
    shapes : (m, 3) complex
        The corners of each triangle as they would best be: with regular cells, edges of length 1 along the curve, and
        strands that cross at right angles.
    kind : (m,) int
        See :class:`Kind`.
    rim : (b,) int
        The boundary vertices, counter-clockwise.
    path : (p,) int
        The vertices along the curve, starting on the border before the first visit.
    """

    triangles: Ints
    shapes: Complexes
    kind: Ints
    rim: Ints
    path: Ints

    @property
    def n_vertices(self) -> int:
        """Number of crossings, beads, hubs and vertices of the rim."""
        return int(self.triangles.max()) + 1


def skeleton(arrangement: Arrangement, beads: npt.ArrayLike = 0) -> Skeleton:
    """Return the triangulated disk of an arrangement with at least one crossing.

    Parameters
    ----------
    arrangement : Arrangement
    beads : int or (borders,) int
        How many beads each border is to have; it gets more if these are too few.

    Returns
    -------
    Skeleton

    Notes
    -----
    O(k) vertices and time.

    Examples
    --------
    >>> limacon = skeleton(Arrangement.from_gauss([1, 0], [True, False], 1))
    >>> limacon.n_vertices, len(limacon.triangles), len(limacon.rim)
    (18, 29, 5)
    """
    first, last = _beads(arrangement, beads)
    tail, head, cell = _sides_along_borders(arrangement, first, last)
    corners = _corners(arrangement, first, last)
    length = np.repeat([1.0, np.sqrt(2.0)], [len(tail), len(corners)])
    tail, head = np.concatenate([tail, corners[:, 0]]), np.concatenate([head, corners[:, 2]])
    cell = np.concatenate([cell, arrangement.cell_of_dart])
    hub = cell + last[-1]
    bounded = cell > 0
    fans = np.column_stack([tail, head, hub])[bounded]
    boundary = _loop(head[~bounded], tail[~bounded])
    rim = last[-1] + arrangement.n_cells + np.arange(len(boundary))
    ring = _ring(boundary, rim)
    shapes = _corner_shapes(len(corners)), _fan_shapes(cell[bounded], length[bounded]), _ring_shapes(len(rim))
    return Skeleton(
        triangles=np.concatenate([corners, fans, ring]),
        shapes=np.concatenate(shapes),
        kind=np.repeat([Kind.CORNER, Kind.CELL, Kind.RING], [len(corners), len(fans), len(ring)]),
        rim=rim,
        path=_path(arrangement, first, last),
    )


def _beads(arrangement: Arrangement, wanted: npt.ArrayLike) -> tuple[Ints, Ints]:
    """Return the first and last bead of each border. A loop needs at least three, for its ends are joined."""
    border = np.arange(arrangement.n_borders)
    is_loop = arrangement.partner == (border + 1) % len(border)
    count = np.maximum(wanted, np.where(is_loop, _BEADS_ON_A_LOOP, _BEADS))
    last = arrangement.n_crossings + np.cumsum(count) - 1
    return last - count + 1, last


def _sides_along_borders(arrangement: Arrangement, first: Ints, last: Ints) -> tuple[Ints, Ints, Ints]:
    """Return tail, head and cell on the left of each edge between beads of a border, in both directions."""
    border = np.repeat(np.arange(len(first)), last - first)
    bead = np.setdiff1d(np.arange(first[0], last[-1] + 1), last)
    cell = np.concatenate([arrangement.left_cell[border], arrangement.right_cell[border]])
    return np.concatenate([bead, bead + 1]), np.concatenate([bead + 1, bead]), cell


def _corners(arrangement: Arrangement, first: Ints, last: Ints) -> Ints:
    """Return for each dart its last bead, the crossing, and the first bead of the next dart around the cell."""
    start, end = np.column_stack([first, last]).ravel(), np.column_stack([last, first]).ravel()
    at_end = np.column_stack([np.roll(arrangement.crossing_of_visit, -1), arrangement.crossing_of_visit]).ravel()
    return np.column_stack([end, at_end, start[arrangement.next_dart]])


def _corner_shapes(count: int) -> Complexes:
    return np.tile(np.array([0, 1, 1 + 1j]), (count, 1))


def _fan_shapes(cell: Ints, length: Floats) -> Complexes:
    """Return isosceles triangles whose angles at the hub of each cell add up to a full turn."""
    around = np.bincount(cell, length)[cell]
    radius, angle = around / (2 * np.pi), 2 * np.pi * length / around
    base = 2 * radius * np.sin(angle / 2)
    return np.column_stack([np.zeros(len(cell)), base, base / 2 + 1j * radius * np.cos(angle / 2)])


def _ring(inner: Ints, outer: Ints) -> Ints:
    """Return the triangles between two loops of the same length."""
    inner_following, outer_following = np.roll(inner, -1), np.roll(outer, -1)
    outward = np.column_stack([inner, outer, outer_following])
    return np.concatenate([outward, np.column_stack([inner, outer_following, inner_following])])


def _ring_shapes(count: int) -> Complexes:
    """Return the triangles between two regular polygons, the inner one with sides of about length 1."""
    inner = count / (2 * np.pi) * np.exp(2j * np.pi * np.arange(count) / count)
    corners = np.concatenate([inner, _RING_RATIO * inner])
    return np.asarray(corners[_ring(np.arange(count), count + np.arange(count))])


def _loop(tail: Ints, head: Ints) -> Ints:
    following = dict(zip(tail.tolist(), head.tolist(), strict=True))
    loop = [int(tail[0])]
    while (vertex := following[loop[-1]]) != loop[0]:
        loop.append(vertex)
    return np.array(loop)


def _path(arrangement: Arrangement, first: Ints, last: Ints) -> Ints:
    """Return the beads of the last border, the crossing at visit 0, the beads of border 0, and so on."""
    beads = np.arange(first[0], last[-1] + 1)
    along = np.insert(beads, last - first[0] + 1, np.roll(arrangement.crossing_of_visit, -1))
    return np.roll(along, int(last[-1] - first[-1]) + 2)
