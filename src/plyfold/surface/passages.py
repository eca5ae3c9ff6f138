"""Where sheets pass through each other: which vertices have no order there, and how sheets come together.

Over the points of a border along which two sheets pass through each other their order is open, and strict over all
other points. So between them, seen from above near the border, they meet in a curve.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.layering.orders.intersections import IntersectingLayering
from plyfold.mesh.cells import CellTriangulation
from plyfold.mesh.sheets import SheetMesh, following

if TYPE_CHECKING:
    from plyfold.surface.glue import LiftedMesh

__all__ = ["copies_over_each_other", "intersection_curves", "passing_edges", "shares_of_gap", "stacked_but_passing"]

# Sheets that pass through each other part by one unit of height on so many along them.
_WAY_PER_HEIGHT = 2.0
# They keep at least this share of the gap, wherever their order is strict.
_LEAST_SHARE = 1e-6


def passing_edges(layering: IntersectingLayering, mesh: CellTriangulation, glued: SheetMesh) -> Ints:
    """Return rows (a, b, c, d): edges a → b and c → d of two sheets that pass through each other along them."""
    border, lower, upper = layering.intersections.T
    rank = np.argsort(mesh.chain_border, kind="stable")
    first, last = (np.searchsorted(mesh.chain_border[rank], border, side=side) for side in ("left", "right"))
    row = np.repeat(np.arange(len(border)), last - first)
    step = np.arange(len(row)) - np.repeat(np.cumsum(last - first) - (last - first), last - first)
    beside = mesh.twin[mesh.left[rank[first[row] + step]]]
    vertex = glued.faces.ravel()
    sides = (glued.lifted(beside, sheet[row]) for sheet in (lower, upper))
    return np.column_stack([vertex[end] for side in sides for end in (side, following(side))])


def stacked_but_passing(stacked: Ints, level: Ints, planar_vertex: Ints, passing: Ints) -> Ints:
    """Return the stacked vertices; over passing points all pairs but the passing ones, in place of neighbours."""
    open_points = np.unique(planar_vertex[passing])
    kept = stacked[~np.isin(planar_vertex[stacked[:, 0]], open_points)]
    members = np.flatnonzero(np.isin(planar_vertex, open_points))
    members = members[np.lexsort((level[members], planar_vertex[members]))]
    pairs = _pairs_in_groups(members, planar_vertex[members])
    key, open_key = (np.sort(rows, axis=1) @ [len(level), 1] for rows in (pairs, _open_pairs(passing)))
    return np.concatenate([kept, pairs[~np.isin(key, open_key)]])


def shares_of_gap(points: Floats, mesh: LiftedMesh, gap: float) -> Floats:
    """Return which share of the gap the stacked vertices must keep, shape (c,): 1 but near intersections.

    There it is half the way along the two sheets to the place where they pass through each other, as long as this is
    less than the gap.
    """
    if not len(mesh.passing):
        return np.ones(len(mesh.stacked))
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    here, there = _sides_of_pairs(mesh)
    rows = (here, there, mesh.stacked, _open_pairs(mesh.passing))
    keys = [np.sort(pairs, axis=1) @ [len(mesh.level), 1] for pairs in rows]
    known, node = np.unique(np.concatenate(keys), return_inverse=True)
    start, end, stacked, sources = np.split(node, np.cumsum(list(map(len, keys)))[:-1])
    length = np.hypot(*(points[mesh.planar_vertex[here[:, 0]]] - points[mesh.planar_vertex[there[:, 0]]]).T)
    one_each = np.unique(start * len(known) + end, return_index=True)[1]
    ways = coo_array((length[one_each], (start[one_each], end[one_each])), shape=(len(known), len(known))).tocsr()
    reach = _WAY_PER_HEIGHT * gap
    way = dijkstra(ways, directed=False, indices=np.unique(sources), min_only=True, limit=reach)
    return np.asarray(np.clip(way[stacked] / reach, _LEAST_SHARE, 1.0))


def intersection_curves(vertices: Floats, mesh: LiftedMesh) -> tuple[Floats, ...]:
    """Return the polylines, each of shape (m, 3), along which sheets pass through each other.

    Cost: linear in the number of pairs of triangles over each other.
    """
    if not len(mesh.passing):
        return ()
    here, there = _sides_of_pairs(mesh)
    crossed = np.flatnonzero(_above(vertices, here) != _above(vertices, there))
    edges, edge = np.unique(_as_keys(here[crossed], there[crossed]), axis=0, return_inverse=True)
    places = _meeting_places(vertices, edges)
    # Every pair of triangles has three sides in a row, of which none or two are crossed.
    return tuple(places[chain] for chain in _chains(edge.reshape(-1, 2)))


def copies_over_each_other(mesh: LiftedMesh) -> Ints:
    """Return all pairs of triangles over the same triangle of the drawing, shape (q, 2)."""
    below = mesh.planar_vertex[mesh.faces]
    first = np.concatenate([[True], (below[1:] != below[:-1]).any(axis=1)])
    return _pairs_in_groups(np.arange(len(below)), np.cumsum(first))


def _pairs_in_groups(members: Ints, group: Ints) -> Ints:
    """Return all pairs of members of the same group, in order; the groups follow each other."""
    place = np.arange(len(members))
    end = np.searchsorted(group, group, side="right")
    beyond = end - place - 1
    first = np.repeat(place, beyond)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(beyond) - beyond, beyond)
    return np.column_stack([members[first], members[second]])


def _open_pairs(passing: Ints) -> Ints:
    """Return the pairs of vertices whose order is open."""
    return np.unique(np.sort(np.concatenate([passing[:, [0, 2]], passing[:, [1, 3]]]), axis=1), axis=0)


def _sides_of_pairs(mesh: LiftedMesh) -> tuple[Ints, Ints]:
    """Return the pairs of vertices at the starts and at the ends of the sides of triangles over each other.

    Three rows follow each other for each pair of triangles.
    """
    first, second = copies_over_each_other(mesh).T
    here = np.stack([mesh.faces[first], mesh.faces[second]], axis=2)
    return here.reshape(-1, 2), np.roll(here, -1, axis=1).reshape(-1, 2)


def _above(vertices: Floats, pairs: Ints) -> Ints:
    """Tell whether the first vertex of each pair lies above the second; of equal ones that with the larger number."""
    a, b = vertices[pairs, 2].T
    return np.where(a == b, pairs[:, 0] > pairs[:, 1], a > b).astype(np.int64)


def _as_keys(here: Ints, there: Ints) -> Ints:
    """Return rows (a, b, c, d), the same for a pair of edges a → b and c → d in any order and direction."""
    edges = np.stack([here, there], axis=2)
    swapped = edges[:, 0].min(axis=1) > edges[:, 1].min(axis=1)
    edges[swapped] = edges[swapped, ::-1]
    turned = edges[:, 0, 0] > edges[:, 0, 1]
    edges[turned] = edges[turned, :, ::-1]
    return edges.reshape(-1, 4)


def _meeting_places(vertices: Floats, edges: Ints) -> Floats:
    """Return where the edges a → b and c → d, one over the other, meet."""
    a, b, c, d = vertices[edges].swapaxes(0, 1)
    start, end = a[:, 2] - c[:, 2], b[:, 2] - d[:, 2]
    apart = start - end
    share = np.divide(start, apart, out=np.full(len(apart), 0.5), where=apart != 0)[:, None]
    return np.asarray((1 - share) * a + share * b)


def _chains(links: Ints) -> Iterator[list[int]]:
    """Yield links between nodes, of which each has one or two, as rows of nodes; the first one again at a loop's end.

    Examples
    --------
    >>> list(_chains(np.array([(3, 4), (0, 1), (5, 3), (2, 1), (4, 5)])))
    [[0, 1, 2], [3, 4, 5, 3]]
    """
    beside: dict[int, list[int]] = {}
    for a, b in links.tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    ends = [node for node, others in beside.items() if len(others) == 1]
    for end in ends:
        if end in beside:
            yield list(_walk(beside, end))
    while beside:
        start = next(iter(beside))
        yield [*_walk(beside, start), start]


def _walk(beside: dict[int, list[int]], start: int) -> Iterator[int]:
    """Yield nodes, each beside the one before, as far as they are left; they are taken out."""
    ahead = [start]
    while ahead:
        yield ahead[0]
        ahead = [node for node in beside.pop(ahead[0]) if node in beside]
