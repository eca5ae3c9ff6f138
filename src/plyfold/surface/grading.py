"""The mesh that heights are solved on: the glued disk's own, with ever smaller triangles towards re-entrant corners.

Heights leave every border level, and round a corner of the outline with the interior angle ω they have a part like
r^(π/ω) cos(πθ/ω) in the distance r from it. Where ω is more than 180° that is steep and all bent near the corner, and
triangles of one size miss of its energy a share that falls like size^(2π/ω): near 360°, triangles half
as large miss half as much. If their size is in proportion to r, a few hundred for each corner miss next to nothing.

Only heights of the given vertices are wanted. So it does not matter that the added ones are not stacked over each
other: distances of sheets are kept at the given ones.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, partial
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.halving import HalvedMesh, halve_towards
from plyfold.halfedges import before, ends_of, following, twins_of
from plyfold.mesh.strips import as_numbers
from plyfold.ragged import next_in_rows
from plyfold.surface.glue import LiftedMesh

__all__ = ["ClothMesh", "cloth_mesh", "double_areas", "graded"]

_Number = TypeVar("_Number", np.float64, np.int64)

# Corners with larger interior angles are re-entrant: from here on π/ω is less than 0.8.
_WIDEST = 5 / 4 * np.pi
# Sides of triangles as a fraction of their way to a corner, and where they end: as a fraction of the bending length.
_GROWTH, _FINEST = 0.5, 1e-3
# Triangles so many steps from a corner stay as they are; so far off, they are small enough in any case.
_STEPS = 12
# By how much sides may be too long, squared, where there is no room for more.
_EXCESS = 2.0 ** np.arange(20, -1, -1)


@dataclass(frozen=True, eq=False)
class ClothMesh:
    """A finer mesh of the same surface, in units of the drawing's larger side.

    Parameters
    ----------
    places : (v + m, 2) float
        First those of the surface's own vertices; the first one of all is at 0.
    faces : (f, 3) int
    origin : (f,) int
        The triangle of the surface that each one is a part of.
    ends : (m, 2) int
        Of each further vertex: the vertices that it lies in the middle of.
    width : float
        The mean width of the cloth: twice its area, divided by the length of its outline.
    """

    places: Floats
    faces: Ints
    origin: Ints
    ends: Ints
    width: float

    @property
    def added(self) -> int:
        """How many vertices are no vertices of the surface: the last ones."""
        return len(self.ends)

    def continued(self, values: Floats) -> Floats:
        """Return values of the surface's vertices, and of each further one the mean of those it is the middle of."""
        whole = np.concatenate([values, np.zeros(self.added)])
        for rows in self._generations:
            whole[len(values) + rows] = whole[self.ends[rows]].mean(axis=1)
        return whole

    @cached_property
    def _generations(self) -> list[Ints]:
        """The rows of ``ends``, grouped so that each lies between vertices of the surface and of groups before."""
        own, left, groups = len(self.places) - self.added, np.arange(self.added), []
        known = np.arange(len(self.places)) < own
        while len(left):
            between = known[self.ends[left]].all(axis=1)
            groups.append(left[between])
            known[own + groups[-1]] = True
            left = left[~between]
        return groups


def cloth_mesh(points: Floats, mesh: LiftedMesh, stiffness: float) -> ClothMesh:
    """Return the mesh that heights of a surface are solved on.

    Parameters
    ----------
    points : (p, 2) float
        The points of the planar triangulation.
    mesh : LiftedMesh
    stiffness : float
        The bending length as a fraction of the mean width of the cloth.

    Returns
    -------
    ClothMesh
        Hardly more than twice the surface's triangles; none are added where no corner is re-entrant, a few hundred for
        each one that is. A few milliseconds for some thousands.
    """
    places = points[mesh.planar_vertex]
    places = (places - places[0]) / np.ptp(places, axis=0).max()
    outline = places[mesh.boundary]
    perimeter = np.hypot(*(outline[next_in_rows(mesh.first_boundary)] - outline).T).sum()
    width = float(double_areas(places, mesh.faces).sum() / perimeter)
    finest = _FINEST * min(stiffness, 1.0) * width
    return ClothMesh(*graded(places, mesh.faces, _corners(places, mesh), _followers(mesh), finest), width)


def double_areas(places: Floats, faces: Ints) -> Floats:
    """Return twice the areas of triangles."""
    a, b, c = (as_numbers(places)[corner] for corner in faces.T)
    return np.asarray((np.conj(b - a) * (c - a)).imag)


def _followers(mesh: LiftedMesh) -> Ints:
    """Return the next vertex along the boundary, of each vertex on it; −1 of others."""
    follower = np.full(len(mesh.level), -1)
    follower[mesh.boundary] = mesh.boundary[next_in_rows(mesh.first_boundary)]
    return follower


def _corners(places: Floats, mesh: LiftedMesh) -> Ints:
    """Return the vertices at which the boundary turns back into the cloth; cusps have a hole of their own."""
    is_boundary = np.zeros(len(places), dtype=bool)
    is_boundary[mesh.boundary] = True
    is_boundary[mesh.cusps] = False
    at = np.flatnonzero(is_boundary[mesh.faces.ravel()])
    start = mesh.faces.ravel()
    here, ahead, back = (as_numbers(places)[start[side]] for side in (at, following(at), before(at)))
    angle = np.abs(np.angle((back - here) * np.conj(ahead - here)))
    return np.flatnonzero(np.bincount(start[at], angle, minlength=len(places)) > _WIDEST)


def graded(
    places: Floats, faces: Ints, corners: Ints, follower: Ints, finest: float
) -> tuple[Floats, Ints, Ints, Ints]:
    """Return a mesh with smaller triangles towards some vertices: sides are halved, the longest first [R84]_.

    Parameters
    ----------
    places : (v, 2) float
    faces : (f, 3) int
        Counter-clockwise.
    corners : (c,) int
        The vertices towards which triangles become smaller.
    follower : (v,) int
        The next vertex along the boundary, −1 inside.
    finest : float
        Sides of this length are short enough anywhere; others, if they are at most half their way to a corner.

    Returns
    -------
    places, faces, origin, ends
        As in :class:`ClothMesh`. Angles are at least half of what they were.

    References
    ----------
    .. [R84] M.-C. Rivara, "Algorithms for refining triangular grids suitable for adaptive and multigrid techniques",
       International Journal for Numerical Methods in Engineering 20, 1984.

    Examples
    --------
    >>> square, faces = np.array([(0.0, 0.0), (1, 0), (1, 1), (0, 1)]), np.array([(0, 1, 2), (0, 2, 3)])
    >>> places, finer, origin, ends = graded(square, faces, np.array([0]), np.array([1, 2, 3, 0]), 1.0)
    >>> places[4:].tolist(), finer.tolist(), origin.tolist()
    ([[0.5, 0.5]], [[4, 1, 2], [0, 4, 3], [4, 0, 1], [4, 2, 3]], [0, 1, 0, 1])
    """
    if not len(corners):
        return places, faces, np.arange(len(faces)), np.empty((0, 2), dtype=np.int64)
    target, way = _nearest(places, faces, corners)
    near = np.flatnonzero((target[faces] >= 0).any(axis=1))
    vertices = np.unique(faces[near])
    number = np.full(len(places) + 1, -1)
    number[vertices] = np.arange(len(vertices))
    nearby = number[faces[near]]
    twin = _twins(nearby, number[follower[vertices]])
    fields = (places[vertices, 0], places[vertices, 1], number[target[vertices]], way[vertices] ** 2)
    finer, origin, x, y, ends = _halved(nearby, twin, fields, finest, len(faces))
    known = np.append(vertices, len(places) + np.arange(len(ends)))
    far = np.delete(np.arange(len(faces)), near)
    return (
        np.concatenate([places, np.column_stack([x, y])]),
        np.concatenate([faces[far], known[finer]]),
        np.concatenate([far, near[origin]]),
        known[ends],
    )


def _halved(
    faces: Ints, twin: Ints, fields: tuple[Floats, Floats, Ints, Floats], finest: float, room: int
) -> tuple[Ints, Ints, Floats, Floats, Ints]:
    """Return finer triangles, the one that each is a part of, x and y of added vertices, and what they are between.

    Where there is no room for all, those that would be too many are left out at all corners alike.
    """
    excess, given, wider = _EXCESS, len(fields[0]), partial(_with_room, room=room + 1)
    while True:
        corner, opposite, origin = wider(faces), wider(twin.reshape(-1, 3)), wider(np.arange(len(faces)))
        x, y, target, way = map(wider, fields)
        ends = np.zeros((room + 1, 2), dtype=np.int64)
        mesh = HalvedMesh(len(faces), given, *all_flat(corner, opposite, origin, x, y, target, way, ends))
        reached = halve_towards(mesh, finest**2, _GROWTH**2, flat(excess), len(faces) + room)
        if reached == len(excess):
            break
        excess = excess[:reached]
    there, added = slice(mesh.triangles), slice(given, mesh.vertices)
    return corner[there], origin[there], x[added], y[added], ends[: mesh.vertices - given]


def _with_room(values: npt.NDArray[_Number], room: int) -> npt.NDArray[_Number]:
    """Return values with room for more of them."""
    return np.concatenate([values, np.zeros_like(values, shape=(room, *values.shape[1:]))])


def _twins(faces: Ints, follower: Ints) -> Ints:
    """Return the half-edge on the other side of each, −1 along the boundary and −2 where the mesh goes on."""
    start, end = ends_of(faces)
    twin = twins_of(faces)
    return np.where((twin < 0) & (follower[start] != end), -2, twin)


def _nearest(places: Floats, faces: Ints, corners: Ints) -> tuple[Ints, Floats]:
    """Return the nearest corner of each vertex a few steps from one, as the crow flies, and how far it is.

    Nearest of those at its neighbours: sheets above and below belong to other corners, or to none.
    """
    place, (a, b, c) = as_numbers(places), np.ascontiguousarray(faces.T)
    target, way = np.full(len(places), -1), np.full(len(places), np.inf)
    target[corners], way[corners] = corners, 0.0
    for _ in range(_STEPS):
        known = target >= 0
        near = np.flatnonzero(known[a] | known[b] | known[c])
        ends = ends_of(faces[near])
        start, end = (np.concatenate(pair) for pair in (ends, ends[::-1]))
        distance = np.where(known[start], np.abs(place[end] - place[target[start]]), np.inf)
        better = np.flatnonzero(distance < way[end])
        better = better[np.argsort(-distance[better], kind="stable")]  # the last one written stays: the nearest
        target[end[better]], way[end[better]] = target[start[better]], distance[better]
    return target, way
