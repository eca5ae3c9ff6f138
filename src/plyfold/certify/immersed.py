"""Check that a flat mesh is an immersed disk, or another surface, with an outline as its boundary."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from plyfold.certify.disk import Sides, disk_sides, surface_sides
from plyfold.certify.exact import Bools, Floats, Ints, Loops, as_loops, different, finite, next_along_loops
from plyfold.certify.places import ExactPlaces, are_crossing, on_edges, require_positive
from plyfold.errors import CertificateError

__all__ = [
    "Walk",
    "check_immersed_disk",
    "check_immersed_surface",
    "common_places",
    "require_along_curve",
    "require_immersed",
    "turns_too_many",
    "walk_along",
    "walked",
]


def check_immersed_disk(
    curve_points: npt.ArrayLike,
    vertices_xy: npt.ArrayLike,
    faces: npt.ArrayLike,
    boundary: npt.ArrayLike,
    cusps: npt.ArrayLike | None = None,
) -> None:
    """Check that a flat mesh is an immersed disk with the curve as its boundary.

    Parameters
    ----------
    curve_points : array_like, shape (n, 2)
        The closed curve with the disk on its left; the last point joins the first.
    vertices_xy : array_like, shape (v, 2)
        Positions; several vertices may lie at one place.
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, counter-clockwise.
    boundary : array_like of int, shape (b,)
        Vertices along the curve; the first one lies at the curve's first point.
    cusps : array_like of int, shape (n,), optional
        How many full turns the disk's angle at each point of the curve has more than one sees; none by default.

    Raises
    ------
    CertificateError
        If the mesh is no disk (see :func:`check_disk_mesh`), a triangle is not strictly counter-clockwise, the
        boundary does not run along the curve or the triangles at a vertex turn too often. It names the place.

    Notes
    -----
    The boundary must hold the curve's points exactly. A vertex between two of them stands for the exact point of their
    edge that is next to it: it is put there in rational numbers. These points must follow each other along the edge,
    and every triangle must be strictly counter-clockwise both there and as it is given. So the disk that is proved to
    be immersed has the very curve as its boundary. There is no tolerance: how far from its edge a vertex is given is
    not limited, as nothing depends on it.

    The triangles at an inner vertex must turn round it exactly once; those at a boundary vertex must fill the angle
    between its two boundary edges and, but for cusps, less than a full turn. Both are counted by signs: triangles are
    counter-clockwise, so each sweeps less than half a turn. This condition is needed: without it a curve with turning
    number 2, the limaçon, passes. O(m log m); 1e5 triangles take about 0.3 s.

    Examples
    --------
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> check_immersed_disk(square, square, [[0, 1, 2], [0, 2, 3]], boundary=[0, 1, 2, 3])
    >>> check_immersed_disk(square, square, [[0, 1, 2], [0, 2, 3]], boundary=[1, 2, 3, 0])
    Traceback (most recent call last):
    plyfold.errors.CertificateError: the boundary does not start at the curve's first point, at (0, 0)
    """
    near = finite(vertices_xy, 2)
    sides = disk_sides(faces, len(near))
    require_on_edges(sides, walked(as_loops([curve_points], None if cusps is None else [cusps]), near, sides, boundary))


def check_immersed_surface(  # noqa: PLR0913 - an outline, a mesh, where it is on the outline, and how it is glued
    loops: npt.ArrayLike | Sequence[npt.ArrayLike],
    vertices_xy: npt.ArrayLike,
    faces: npt.ArrayLike,
    boundary: npt.ArrayLike,
    cusps: npt.ArrayLike | Sequence[npt.ArrayLike] | None = None,
    *,
    twins: npt.ArrayLike | None = None,
) -> None:
    """Check that a flat mesh is an immersed surface with an outline as its boundary.

    Parameters
    ----------
    loops : array_like, shape (n, 2), or a sequence of such
        The points of one closed curve or of several, with the surface on the left of each.
    vertices_xy : array_like, shape (v, 2)
    faces : array_like of int, shape (m, 3)
    boundary : array_like of int, shape (b,)
        Vertices along the loops, one loop after the other, each from the loop's first point.
    cusps : array_like of int, shape (n,), or a sequence of such, optional
        How many full turns the angle at each point of each loop has more than one sees; none by default.
    twins : array_like of int, shape (3 m,), optional
        The side beyond each side of each triangle, −1 on the boundary, for surfaces on which several edges join the
        same two cusps: side i of triangle t, from its corner i to the next, is 3 t + i. By default corners tell it.

    Raises
    ------
    CertificateError
        If the mesh is no surface, its boundary does not consist of the loops, or otherwise as
        :func:`check_immersed_disk`. It names the place.

    Notes
    -----
    Nothing more is needed to know what surface it is. As it is flat inside and has the angles of the outline at its
    boundary, its Euler characteristic is the sum of the loops' turning numbers, less the cusps (Gauss–Bonnet), also
    for each connected piece; and no piece is without boundary.

    Examples
    --------
    >>> square, hole = [(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 3), (3, 6), (6, 6), (6, 3)]
    >>> faces = [[0, 1, 7], [0, 7, 4], [1, 2, 6], [1, 6, 7], [2, 3, 5], [2, 5, 6], [3, 0, 4], [3, 4, 5]]
    >>> check_immersed_surface([square, hole], square + hole, faces, range(8))
    >>> check_immersed_surface([square], square, [[0, 1, 2], [0, 2, 3]], range(4))
    >>> check_immersed_surface([square, hole], square + hole, [*faces, [4, 7, 6], [4, 6, 5]], range(8))
    Traceback (most recent call last):
    plyfold.errors.CertificateError: the given boundary is not a row of all boundary vertices of the mesh
    """
    near = finite(vertices_xy, 2)
    sides = surface_sides(faces, len(near), twins)
    require_on_edges(sides, walked(as_loops(loops, cusps), near, sides, boundary))


@dataclass(frozen=True, eq=False)
class Walk:
    """Closed ways along the edges of a mesh that go through the points of an outline, loop after loop.

    Parameters
    ----------
    outline : Loops
    near : (v, 2) float
        The vertices as they are given.
    loop : (b,) int
        The vertices along the curve; several times where it crosses itself in a vertex.
    after : (b,) int
        For each of them the place in this row of the one that follows along its loop.
    edge : (b,) int
        The edge of the curve that the way goes along from each of them.
    at : (n,) int
        The places in this row of the points of the outline.
    """

    outline: Loops
    near: Floats
    loop: Ints
    after: Ints
    edge: Ints
    at: Ints

    @property
    def is_point(self) -> Bools:
        """Which vertices are at points of the curve."""
        is_point = np.zeros(len(self.near), dtype=bool)
        is_point[self.loop[self.at]] = True
        return is_point

    @property
    def edges(self) -> Ints:
        """The edges of the curve that each vertex is on: two at its points, one between them; −1 for none."""
        edges = np.full((len(self.near), 2), -1)
        edges[self.loop, 0] = self.edge
        arriving = np.empty_like(self.edge)
        arriving[self.after] = self.edge
        edges[self.loop, 1] = np.where(arriving == self.edge, -1, arriving)
        return edges


def walked(outline: Loops, near: Floats, sides: Sides, boundary: npt.ArrayLike) -> Walk:
    """Return the boundary of a mesh as a walk along an outline."""
    loop = np.asarray(boundary)
    first = _require_boundary_loops(sides, loop, near)
    if len(first) != len(outline.first):
        raise CertificateError(
            f"the boundary of the mesh has {len(first) - 1} loops, and the outline has {len(outline.first) - 1}"
        )
    return walk_along(outline, near, loop, first)


def walk_along(outline: Loops, near: Floats, loop: Ints, first: Ints) -> Walk:
    """Return rows of vertices, which begin at ``first``, as a walk along an outline, through all its points."""
    at = _positions_of(outline, near[loop], first)
    edge = np.repeat(np.arange(len(at)), np.diff(np.append(at, len(loop))))
    return Walk(outline, near, loop, next_along_loops(first), edge, at)


def common_places(walk: Walk) -> ExactPlaces:
    """Return exact places on the curve's edges that are the same for all vertices given as the same doubles.

    Where there are vertices between the points of two edges that are not parallel, the place is where these cross.
    """
    near, _, place = different(walk.near)
    is_point = walk.is_point
    points = np.flatnonzero(is_point)
    between = ~is_point[walk.loop]
    given, edges = np.zeros(len(near), dtype=bool), np.full((len(near), 2), -1)
    given[place[points]] = True
    edges[place[points]] = walk.edges[points]
    at, edge = np.unique(np.stack([place[walk.loop], walk.edge], axis=1)[between], axis=0).T
    first = np.searchsorted(at, at)
    later = np.flatnonzero(first < np.arange(len(at)))
    crossing = later[are_crossing(walk.outline.edges, edge[first[later]], edge[later])]
    # Of those that cross the first edge the first one.
    crossing = crossing[np.unique(at[crossing], return_index=True)[1]]
    rank = np.zeros_like(at)
    rank[later] = 1
    used = rank == 0
    used[crossing] = True
    used &= ~given[at]
    edges[at[used], rank[used]] = edge[used]
    places = on_edges(near, edges, walk.outline.edges, given)
    _require_on(places, *(numbers[~used | np.isinf(places.off[at])] for numbers in (at, edge)))
    return places.of(place)


def _require_on(places: ExactPlaces, at: Ints, edge: Ints) -> None:
    """Check that places are on edges that have not led to them, or perhaps not."""
    for one, other in zip(at.tolist(), edge.tolist(), strict=True):
        if not places.is_on(one, other):
            raise CertificateError(
                "vertices over one another are on edges of the curve that do not cross there",
                where=places.near[one : one + 1],
            )


def require_on_edges(sides: Sides, walk: Walk) -> None:
    """Check that with each vertex on its own edges of the curve the surface is immersed, with that as its boundary."""
    require_immersed(sides, walk, on_edges(walk.near, walk.edges, walk.outline.edges, walk.is_point))


def require_immersed(sides: Sides, walk: Walk, places: ExactPlaces) -> None:
    """Check that with the vertices at some places the surface is immersed, with the outline as its boundary."""
    require_along_curve(walk, places)
    require_positive(places, sides.start.reshape(-1, 3))
    _require_turns(sides, walk, places)


def _require_boundary_loops(sides: Sides, loop: Ints, places: Floats) -> Ints:
    """Check that a row is the boundary of the mesh, walked with the mesh on the left; return where its loops begin."""
    if loop.ndim != 1 or loop.dtype.kind not in "iu" or len(loop) != np.count_nonzero(sides.twin < 0):
        raise CertificateError("the given boundary is not a row of all boundary vertices of the mesh")
    if loop.min() < 0 or loop.max() >= len(places):
        raise CertificateError("the given boundary names a vertex that does not exist")
    side = sides.boundary_side[loop]
    following = sides.end[side]
    last = np.append(np.flatnonzero(following[:-1] != loop[1:]), len(loop) - 1)
    first = np.append(0, last + 1)
    wrong = np.flatnonzero(side < 0)
    wrong = np.append(wrong, last[following[last] != loop[first[:-1]]])
    wrong = np.append(wrong, np.flatnonzero(np.bincount(loop)[loop] > 1))
    if len(wrong):
        raise CertificateError("the given boundary leaves the boundary of the mesh", where=places[loop[wrong[:1]]])
    return first


def require_along_curve(walk: Walk, places: ExactPlaces) -> None:
    """Check that a walk advances along every edge of the curve.

    Of points on one line, the order along it is that of their coordinates.
    """
    start, end = walk.outline.edges.swapaxes(0, 1)
    with np.errstate(over="ignore"):
        step = end - start
    axis = np.argmax(np.abs(step), axis=1)
    sign = np.sign(step[np.arange(len(step)), axis])[walk.edge]
    advance = sign * places.step_sign(walk.loop, walk.loop[walk.after], axis[walk.edge])
    if len(back := np.flatnonzero(advance <= 0)):
        raise CertificateError("the boundary stops or runs backwards along the curve", where=walk.near[walk.loop[back]])


def _positions_of(outline: Loops, walk: Floats, first: Ints) -> Ints:
    """Return where the points of the outline occur along the boundary, in order."""
    at: list[int] = []
    for loop, start in enumerate(first[:-1].tolist()):
        points = outline.points[outline.first[loop] : outline.first[loop + 1]]
        at += [start + place for place in _positions_in_loop(points, walk[start : first[loop + 1]])]
    return np.array(at)


def _positions_in_loop(points: Floats, walk: Floats) -> list[int]:
    if not len(walk) or (walk[0] != points[0]).any():
        raise CertificateError("the boundary does not start at the curve's first point", where=points[:1])
    points_left = iter(points.tolist())
    at: list[int] = []
    wanted = next(points_left)
    for position, place in enumerate(walk.tolist()):
        if place == wanted:
            at.append(position)
            wanted = next(points_left, None)
    if len(at) < len(points):
        raise CertificateError("the boundary misses a point of the curve", where=points[len(at) : len(at) + 1])
    return at


def _require_turns(sides: Sides, walk: Walk, places: ExactPlaces) -> None:
    """Check that the triangles turn once round each inner vertex, and fill the angle at each boundary vertex.

    The fan at a boundary vertex turns less than once, and once more for each cusp.
    """
    loop = walk.loop
    turns, spikes = turns_too_many(sides, loop, loop[walk.after], places)
    turns[loop[walk.at]] -= walk.outline.cusps
    wrong = turns != 0
    wrong[spikes] = True
    if wrong.any():
        how = "not often enough" if (turns < 0)[np.argmax(wrong)] else "too often"
        raise CertificateError(f"the triangles at a vertex turn round it {how}", where=places.near[wrong])


def turns_too_many(sides: Sides, loop: Ints, after: Ints, places: ExactPlaces) -> tuple[Ints, Ints]:
    """Return how many full turns too many the triangles make round each vertex; and the tips of spikes on the boundary.

    Too many are more than one turn at an inner vertex. At those on the boundary, which are given with the vertices that
    follow, the fan goes from the outgoing edge to the incoming one, and too many are the full turns that it makes
    besides. At the tip of a spike, where these edges lie on one another, one full turn is due. Full turns are counted
    as passages through the direction of +x: from a direction in [π, 2π) to one in [0, π).
    """
    upward = _upward(places, sides.start, sides.end)
    # A triangle's corner sweeps from the side that leaves it to the one that arrives, reversed.
    passages = np.bincount(sides.start[~upward & ~upward[sides.previous]], minlength=len(places.near))
    before = np.empty(len(places.near), dtype=np.int64)
    before[after] = loop
    before = before[loop]
    outgoing, incoming = _upward(places, loop, after), _upward(places, loop, before)
    same = np.flatnonzero(outgoing == incoming)
    turn = places.cross_sign(loop[same], after[same], loop[same], before[same])
    expected = np.ones(len(places.near), dtype=np.int64)
    expected[loop] = incoming
    expected[loop[same]] = turn <= 0
    return passages - expected, loop[same[turn == 0]]


def _upward(places: ExactPlaces, start: Ints, end: Ints) -> Bools:
    """Tell which directions have an angle in [0, π)."""
    upward: Bools = places.step_sign(start, end, np.ones_like(start)) > 0
    level = np.flatnonzero(~upward)
    level = level[places.step_sign(start[level], end[level], np.ones_like(level)) == 0]
    upward[level] = places.step_sign(start[level], end[level], np.zeros_like(level)) > 0
    return upward
