"""Check that a triangle mesh is a disk, a sphere, or a surface of another kind."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from plyfold.certify.exact import Ints, as_faces
from plyfold.errors import CertificateError

__all__ = [
    "Sides",
    "check_ball_mesh",
    "check_disk_mesh",
    "check_surface_mesh",
    "closed_sides",
    "corners_of_fans",
    "disk_sides",
    "require_pieces",
    "surface_sides",
]


def check_disk_mesh(faces: npt.ArrayLike, n_vertices: int) -> None:
    """Check that triangles make a disk.

    Parameters
    ----------
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, all in the same sense of rotation.
    n_vertices : int
        Number of vertices; each must occur.

    Raises
    ------
    CertificateError
        If a triangle names a vertex twice, an edge has three triangles or two that disagree in orientation, the
        triangles at a vertex are not one fan, the mesh has several parts, its Euler characteristic is not 1 or its
        boundary is not one loop.

    Notes
    -----
    Coordinates play no part. O(m log m); 1e5 triangles take about 0.1 s.

    Examples
    --------
    >>> check_disk_mesh([[0, 1, 2], [0, 2, 3]], n_vertices=4)
    >>> check_disk_mesh([[0, 1, 2], [0, 1, 3]], n_vertices=4)
    Traceback (most recent call last):
    plyfold.errors.CertificateError: two triangles lie on the same side of the edge from vertex 0 to vertex 1
    """
    disk_sides(faces, n_vertices)


def check_ball_mesh(faces: npt.ArrayLike, n_vertices: int) -> None:
    """Check that triangles make a sphere, the boundary of a ball.

    Parameters
    ----------
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, all in the same sense of rotation.
    n_vertices : int
        Number of vertices; each must occur.

    Raises
    ------
    CertificateError
        If the mesh has a boundary, its Euler characteristic is not 2, or it fails as in :func:`check_disk_mesh`.

    Examples
    --------
    >>> check_ball_mesh([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]], n_vertices=4)
    >>> check_ball_mesh([[0, 1, 2], [0, 2, 3], [0, 3, 1]], n_vertices=4)
    Traceback (most recent call last):
    plyfold.errors.CertificateError: the mesh is not closed: nothing is beyond the edge from vertex 1 to vertex 2
    """
    sides = closed_sides(faces, n_vertices)
    _require_connected(sides, n_vertices)
    _require_euler(sides, n_vertices, "a sphere", 2)


def check_surface_mesh(faces: npt.ArrayLike, n_vertices: int, pieces: Iterable[tuple[int, int]]) -> None:
    """Check that triangles make surfaces with so many boundary loops, holes and handles.

    Parameters
    ----------
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, all in the same sense of rotation.
    n_vertices : int
        Number of vertices; each must occur.
    pieces : iterable of (int, int)
        The number of boundary loops and the Euler characteristic of each connected piece, in any order.

    Raises
    ------
    CertificateError
        If a triangle names a vertex twice, an edge has three triangles or two that disagree in orientation, the
        triangles at a vertex are not one fan, or the pieces are others.

    Notes
    -----
    Coordinates play no part. O(m log m).

    Examples
    --------
    >>> ring = [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4], [2, 0, 5], [0, 3, 5]]
    >>> check_surface_mesh(ring, 6, [(2, 0)])
    >>> check_surface_mesh(ring, 6, [(1, 1)])
    Traceback (most recent call last):
    plyfold.errors.CertificateError: the pieces have (boundary loops, Euler characteristic) (2, 0), not (1, 1)
    """
    require_pieces(surface_sides(faces, n_vertices), n_vertices, pieces)


@dataclass(frozen=True, eq=False)
class Sides:
    """The sides 3t, 3t + 1, 3t + 2 of each triangle t: their ends, and the same edge's side in the next triangle.

    ``twin`` is −1 on the boundary, and ``boundary_side`` is the side on the boundary that starts at a vertex, or −1.
    """

    start: Ints
    end: Ints
    twin: Ints
    boundary_side: Ints

    @property
    def previous(self) -> Ints:
        """The side before each side in its triangle."""
        side = np.arange(len(self.start))
        return np.where(side % 3 == 0, side + 2, side - 1)


def disk_sides(faces: npt.ArrayLike, n_vertices: int) -> Sides:
    """Return the sides of a mesh that is a disk."""
    sides = surface_sides(faces, n_vertices)
    _require_connected(sides, n_vertices)
    _require_one_loop(sides)
    _require_euler(sides, n_vertices, "a disk", 1)
    return sides


def closed_sides(faces: npt.ArrayLike, n_vertices: int) -> Sides:
    """Return the sides of a mesh that is a surface without boundary."""
    sides = surface_sides(faces, n_vertices)
    if len(rim := np.flatnonzero(sides.twin < 0)):
        ends = f"from vertex {sides.start[rim[0]]} to vertex {sides.end[rim[0]]}"
        raise CertificateError(f"the mesh is not closed: nothing is beyond the edge {ends}")
    return sides


def corners_of_fans(faces: npt.ArrayLike, n_vertices: int, twins: npt.ArrayLike | None = None) -> tuple[Ints, Ints]:
    """Cut triangles apart at vertices where only these meet, no sides; return them with numbers for the new vertices.

    Also the old number of each of these.
    """
    triangles = as_faces(faces, n_vertices)
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    twin = _twins(start, end, n_vertices) if twins is None else _as_twins(twins, start, end)
    corner = np.arange(len(start))
    across = twin[np.where(corner % 3 == 0, corner + 2, corner - 1)]
    inner = np.flatnonzero(across >= 0)
    _, first, fan = np.unique(_parts(inner, across[inner], len(start)), return_index=True, return_inverse=True)
    return fan.reshape(-1, 3), start[first]


def require_pieces(sides: Sides, n_vertices: int, pieces: Iterable[tuple[int, int]]) -> None:
    """Check the numbers of boundary loops and the Euler characteristics of the connected pieces."""
    wanted = sorted((int(loops), int(euler)) for loops, euler in pieces)
    if len(wanted) == 1:
        _require_connected(sides, n_vertices)
    if (found := _pieces(sides, n_vertices)) != wanted:
        given, asked = (", ".join(map(str, kinds)) for kinds in (found, wanted))
        raise CertificateError(f"the pieces have (boundary loops, Euler characteristic) {given}, not {asked}")


def _pieces(sides: Sides, n_vertices: int) -> list[tuple[int, int]]:
    """Return the number of boundary loops and the Euler characteristic of each connected piece, in order."""
    part = np.unique(_parts(sides.start, sides.end, n_vertices), return_inverse=True)[1]
    count = int(part.max()) + 1
    of_side = np.bincount(part[sides.start], minlength=count)
    on_boundary = np.bincount(part[sides.start[sides.twin < 0]], minlength=count)
    # Three sides for each triangle, two for each edge inside and one on the boundary.
    euler = np.bincount(part, minlength=count) - (of_side + on_boundary) // 2 + of_side // 3
    loops = np.bincount(part[sides.start[_boundary_loops(sides)]], minlength=count)
    return sorted(zip(loops.tolist(), euler.tolist(), strict=True))


def surface_sides(faces: npt.ArrayLike, n_vertices: int, twins: npt.ArrayLike | None = None) -> Sides:
    """Return the sides of a mesh that is a surface, with or without boundary; by their ends, or as they are glued."""
    triangles = as_faces(faces, n_vertices)
    start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    twin = _twins(start, end, n_vertices) if twins is None else _as_twins(twins, start, end)
    sides = Sides(start, end, twin, _boundary_sides(start, twin, n_vertices))
    _require_one_fan_each(sides, n_vertices)
    return sides


def _require_euler(sides: Sides, n_vertices: int, name: str, expected: int) -> None:
    edges = (len(sides.twin) + np.count_nonzero(sides.twin < 0)) // 2
    if (euler := n_vertices - edges + len(sides.start) // 3) != expected:
        raise CertificateError(f"the mesh has Euler characteristic {euler}; {name} has {expected}")


def _twins(start: Ints, end: Ints, n_vertices: int) -> Ints:
    key = start * n_vertices + end
    order = np.argsort(key)
    same = np.flatnonzero(np.diff(key[order]) == 0)
    if len(same):
        side = order[same[0]]
        message = f"two triangles lie on the same side of the edge from vertex {start[side]} to vertex {end[side]}"
        raise CertificateError(message)
    wanted = end * n_vertices + start
    found = order[np.minimum(np.searchsorted(key[order], wanted), len(order) - 1)]
    return np.where(key[found] == wanted, found, -1)


def _as_twins(twins: npt.ArrayLike, start: Ints, end: Ints) -> Ints:
    """Return how sides are glued, if it is in pairs that run along each other in opposite directions."""
    twin = np.asarray(twins)
    if twin.shape != start.shape or twin.dtype.kind not in "iu" or twin.min() < -1 or twin.max() >= len(start):
        raise CertificateError(f"twins are not one number for each of {len(start)} sides, from -1 on")
    inner = np.flatnonzero(twin >= 0)
    other = twin[inner]
    wrong = (twin[other] != inner) | (start[other] != end[inner]) | (end[other] != start[inner])
    if wrong.any():
        side = inner[np.argmax(wrong)]
        raise CertificateError(
            f"side {side}, from vertex {start[side]} to vertex {end[side]}, and its twin do not match"
        )
    return twin.astype(np.int64)


def _boundary_sides(start: Ints, twin: Ints, n_vertices: int) -> Ints:
    on_boundary = np.flatnonzero(twin < 0)
    at_vertex = np.bincount(start[on_boundary], minlength=n_vertices)
    if at_vertex.max() > 1:
        raise CertificateError(f"the boundary runs through vertex {np.argmax(at_vertex)} more than once")
    boundary_side = np.full(n_vertices, -1)
    boundary_side[start[on_boundary]] = on_boundary
    return boundary_side


def _require_one_fan_each(sides: Sides, n_vertices: int) -> None:
    """Check that the corners at every vertex follow each other; the last one at a boundary vertex leads to the first.

    A corner is named by the side that leaves it.
    """
    if len(unused := np.flatnonzero(np.bincount(sides.start, minlength=n_vertices) == 0)):
        raise CertificateError(f"vertex {unused[0]} belongs to no triangle")
    counter_clockwise = sides.twin[sides.previous]
    following = np.where(counter_clockwise >= 0, counter_clockwise, sides.boundary_side[sides.start])
    fans = np.bincount(sides.start[np.unique(_least_of_cycle(following))], minlength=n_vertices)
    if fans.max() > 1:
        raise CertificateError(f"the triangles at vertex {np.argmax(fans)} are not one fan")


def _least_of_cycle(following: Ints) -> Ints:
    """Return the least member of each element's cycle, for a permutation.

    Each round doubles how far ahead an element has looked. When a round changes nothing, all have looked all round:
    a cycle's least member lies in only one of several disjoint stretches.
    """
    least, ahead = np.arange(len(following)), following
    while (least[ahead] < least).any():
        least, ahead = np.minimum(least, least[ahead]), ahead[ahead]
    return least


def _parts(start: Ints, end: Ints, count: int) -> Ints:
    """Return for each of so many things the least one that links lead to, in either direction."""
    part = np.arange(count)
    while True:
        a, b = part[start], part[end]
        if (a == b).all():
            return part
        np.minimum.at(part, np.maximum(a, b), np.minimum(a, b))
        while (part != part[part]).any():
            part = part[part]


def _require_connected(sides: Sides, n_vertices: int) -> None:
    if len(apart := np.flatnonzero(_parts(sides.start, sides.end, n_vertices))):
        raise CertificateError(f"the mesh has several parts: no path of edges leads from vertex 0 to vertex {apart[0]}")


def _boundary_loops(sides: Sides) -> Ints:
    """Return one side of each loop of the boundary."""
    on_boundary = np.flatnonzero(sides.twin < 0)
    number = np.full(len(sides.start), -1)
    number[on_boundary] = np.arange(len(on_boundary))
    following = number[sides.boundary_side[sides.end[on_boundary]]]
    return on_boundary[np.unique(_least_of_cycle(following))]


def _require_one_loop(sides: Sides) -> None:
    loops = len(_boundary_loops(sides))
    if loops != 1:
        raise CertificateError(f"the boundary of the mesh has {loops} loops, not one")
