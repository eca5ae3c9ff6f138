"""The boundary of a flat triangle mesh, such as a UV chart or a patch of a body seen from one side, with its cusps.

The triangles at a vertex that hang together by their edges are a *fan*. Each triangle runs counter-clockwise, so it
turns by less than half a turn about each of its corners, and how often a fan turns round is counted by signs alone.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import CurveError
from plyfold.graphs import components
from plyfold.halfedges import before, ends_of, following, twins_of
from plyfold.outline.points import Repair
from plyfold.predicates import orient

__all__ = ["MeshBoundary", "boundary_of_mesh"]


class MeshBoundary(NamedTuple):
    """The boundary of a flat mesh.

    Parameters
    ----------
    loops : list of (b,) int
        The vertices along each loop, with the mesh on the left.
    cusps : list of (b,) int
        By how many full turns the triangles at each of them turn more than one sees.
    repairs : tuple of Repair
        Where the mesh was cut, and what was left out.
    """

    loops: list[Ints]
    cusps: list[Ints]
    repairs: tuple[Repair, ...]


class _Fans(NamedTuple):
    """The fans of a mesh: the one at each corner; the half-edges that go out from and come in to each, −1 inside."""

    of_corner: Ints
    outgoing: Ints
    incoming: Ints

    @property
    def vertex(self) -> Ints:
        """The corner of each fan that comes first; it stands for its vertex."""
        return np.unique(self.of_corner, return_index=True)[1]


def boundary_of_mesh(points: Floats, faces: npt.ArrayLike) -> MeshBoundary:
    """Return the boundary of a mesh in the plane; see :meth:`plyfold.Outline.from_mesh`.

    Examples
    --------
    >>> boundary_of_mesh(np.array([(0.0, 0), (1, 0), (1, 1), (0, 1)]), [(0, 1, 2), (0, 2, 3)]).loops
    [array([0, 1, 2, 3])]
    """
    triangles = _as_triangles(faces, points)
    _refuse_crowded_edges(points, triangles)
    _refuse_turned_over(points, triangles)
    _refuse_doubled_sides(points, triangles)
    twins = twins_of(triangles)
    fans = _fans(triangles, twins)
    turns = _turns(points, triangles, fans)
    loops = _loops(triangles, np.flatnonzero(twins < 0), fans)
    start = ends_of(triangles)[0]
    repairs = (*_unused(points, triangles), *_cuts(points, start[fans.vertex]))
    return MeshBoundary([start[loop] for loop in loops], [turns[fans.of_corner[loop]] for loop in loops], repairs)


# ---- what is refused -------------------------------------------------------------------------------------------------


def _as_triangles(faces: npt.ArrayLike, points: Floats) -> Ints:
    given = np.asarray(faces)
    if not given.size:
        raise CurveError("the mesh has no triangles", hint="give three vertex numbers for each")
    if given.ndim != 2 or given.shape[1] != 3 or given.dtype.kind not in "iu":
        raise CurveError(
            f"the triangles have the shape {given.shape} and the type {given.dtype}",
            hint="give three vertex numbers for each; split larger polygons first",
        )
    triangles = given.astype(np.int64)
    wrong = np.flatnonzero(((triangles < 0) | (triangles >= len(points))).any(axis=1))
    if len(wrong):
        raise CurveError(
            f"triangle {wrong[0]} names a vertex that does not exist: {given[wrong[0]].tolist()}",
            hint=f"there are vertices 0 to {len(points) - 1}",
        )
    return triangles


def _refuse_crowded_edges(points: Floats, triangles: Ints) -> None:
    """Refuse edges of three triangles, and a mesh all of whose edges have two."""
    edges = np.sort(np.stack(ends_of(triangles), axis=1), axis=1)
    order = np.lexsort(edges.T)
    fresh = np.append(True, (edges[order][1:] != edges[order][:-1]).any(axis=1))
    begin = np.flatnonzero(fresh)
    count = np.diff(np.append(begin, len(order)))
    if count.max() > 2:
        at = begin[count.argmax()]
        where = points[edges[order[at]]].mean(axis=0)
        here = sorted((order[at : at + count.max()] // 3).tolist())
        named = ", ".join(map(str, here[:-1]))
        raise CurveError(
            f"triangles {named} and {here[-1]} share one edge", where=[where], hint="an edge has at most two triangles"
        )
    if count.min() == 2:
        raise CurveError("the mesh is closed: it has no boundary", hint="give the part of it that lies flat")


def _refuse_turned_over(points: Floats, triangles: Ints) -> None:
    sign = orient(*points[triangles].swapaxes(0, 1))
    wrong = np.flatnonzero(sign <= 0)
    if not len(wrong):
        return
    first = wrong[0]
    what = "is flat" if sign[first] == 0 else "runs clockwise"
    more = f" (and {len(wrong) - 1} more that are flat or run clockwise)" if len(wrong) > 1 else ""
    hint = "all of them run clockwise: turn them round" if (sign < 0).all() else "a flat mesh has no folds"
    raise CurveError(f"triangle {first} {what}{more}", where=[points[triangles[first]].mean(axis=0)], hint=hint)


def _refuse_doubled_sides(points: Floats, triangles: Ints) -> None:
    """Refuse two triangles on the same side of an edge."""
    start, end = ends_of(triangles)
    key = start * len(points) + end
    order = np.argsort(key, kind="stable")
    same = np.flatnonzero(np.diff(key[order]) == 0)
    if len(same):
        one, other = order[same[0] : same[0] + 2]
        raise CurveError(
            f"triangles {one // 3} and {other // 3} lie on the same side of their common edge",
            where=[points[[start[one], end[one]]].mean(axis=0)],
            hint="neighbours lie on different sides, so that the mesh is not folded",
        )


# ---- fans, loops and cusps -------------------------------------------------------------------------------------------


def _fans(triangles: Ints, twins: Ints) -> _Fans:
    """Return the fans, numbered by their first corners; corner h is the one at which half-edge h starts."""
    half_edges = np.arange(len(twins))
    beside = twins[before(half_edges)]
    glued = np.flatnonzero(beside >= 0)
    of_corner = components(len(twins), glued, beside[glued])
    alone = np.flatnonzero(twins < 0)
    outgoing, incoming = np.full((2, of_corner.max() + 1), -1)
    outgoing[of_corner[alone]] = alone
    incoming[of_corner[following(alone)]] = alone
    return _Fans(of_corner, outgoing, incoming)


def _turns(points: Floats, triangles: Ints, fans: _Fans) -> Ints:
    """Return for each fan by how many full turns it turns too often, compared with what one sees.

    Full turns are counted as passages to the directions in [0, π) from the others.
    """
    start, end = ends_of(triangles)
    last = start[before(np.arange(len(start)))]
    passing = ~_upward(points, start, end) & _upward(points, start, last)
    passages = np.bincount(fans.of_corner[passing], minlength=len(fans.outgoing))
    seen = np.ones_like(passages)
    rim = np.flatnonzero(fans.outgoing >= 0)
    vertex, after, back = start[fans.outgoing[rim]], end[fans.outgoing[rim]], start[fans.incoming[rim]]
    upward, back_upward = _upward(points, vertex, after), _upward(points, vertex, back)
    to_left = orient(points[vertex], points[after], points[back]) > 0
    seen[rim] = np.where(upward == back_upward, ~to_left, back_upward)
    turns = passages - seen
    _refuse_branch_points(points[start[fans.vertex]], np.where(fans.outgoing < 0, turns, 0), start[fans.vertex])
    return turns


def _upward(points: Floats, start: Ints, end: Ints) -> Bools:
    """Tell which directions have an angle in [0, π): by comparing coordinates, which is exact."""
    (x, y), (x_end, y_end) = points[start].T, points[end].T
    return np.asarray((y_end > y) | ((y_end == y) & (x_end > x)))


def _refuse_branch_points(places: Floats, turns: Ints, vertices: Ints) -> None:
    wrong = np.flatnonzero(turns)
    if len(wrong):
        first = wrong[0]
        raise CurveError(
            f"the triangles around vertex {vertices[first]}, inside the mesh, turn round it {turns[first] + 1} times",
            where=[places[first]],
            hint="a mesh that lies flat turns once; cut it open from the boundary to there",
        )


def _loops(triangles: Ints, alone: Ints, fans: _Fans) -> list[Ints]:
    """Return the loops of half-edges along the boundary, each from its lowest vertex on, by these vertices."""
    start = ends_of(triangles)[0]
    onward = dict(zip(alone.tolist(), fans.outgoing[fans.of_corner[following(alone)]].tolist(), strict=True))
    loops = []
    for first in alone[np.argsort(start[alone], kind="stable")].tolist():
        loop, half_edge = [], first
        while half_edge in onward:
            loop.append(half_edge)
            half_edge = onward.pop(half_edge)
        if loop:
            loops.append(np.array(loop))
    return loops


# ---- what was changed ------------------------------------------------------------------------------------------------


def _cuts(points: Floats, vertex_of_fan: Ints) -> list[Repair]:
    """Return a record of each vertex with several fans, which touch there and no more."""
    vertices, fans = np.unique(vertex_of_fan, return_counts=True)
    return [
        Repair("cut where triangles touch in a vertex", (x, y), 0.0) for x, y in points[vertices[fans > 1]].tolist()
    ]


def _unused(points: Floats, triangles: Ints) -> list[Repair]:
    """Return a record of the vertices that have no triangle, at the first of them."""
    unused = np.setdiff1d(np.arange(len(points)), triangles)
    if not len(unused):
        return []
    x, y = points[unused[0]].tolist()
    what = "vertex" if len(unused) == 1 else "vertices"
    return [Repair(f"{len(unused)} {what} of no triangle left out", (x, y), 0.0)]
