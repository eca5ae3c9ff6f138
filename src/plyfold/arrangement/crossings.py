"""Where a closed polyline crosses itself, in exact order along it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.predicates import Floats, Signs, exact_parameter, orient, parameter_along_edge

__all__ = ["Contacts", "Visits", "find_contacts", "order_visits"]

Ints: TypeAlias = npt.NDArray[np.int64]
Bools: TypeAlias = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Contacts:
    """The pairs of edges that cross, and the vertices that lie on edges they do not belong to.

    Parameters
    ----------
    edges : (k, 2) int
        Crossing edges, the one that comes first along the curve in column 0.
    from_right : (k,) bool
        True where the second edge crosses the first from right to left.
    touches : (t, 2) int
        Rows (vertex, edge): the vertex lies exactly on the edge. Empty in general position.
    """

    edges: Ints
    from_right: Bools
    touches: Ints


@dataclass(frozen=True, eq=False)
class Visits:
    """The visits of the curve to its crossings, in order along the curve.

    Parameters
    ----------
    edge : (2k,) int
        Edge that each visit lies on.
    partner : (2k,) int
        The other visit to the same crossing.
    ccw : (2k,) bool
        True where the other strand crosses from right to left.
    point : (2k, 2) float
        The crossing, rounded; the same for both visits.
    triple : (t, 3) int
        Triples of edges that meet in one point. Empty in general position.
    """

    edge: Ints
    partner: Ints
    ccw: Bools
    point: Floats
    triple: Ints


def find_contacts(points: Floats) -> Contacts:
    """Find all pairs of edges of a closed polyline that cross or touch.

    Parameters
    ----------
    points : (n, 2) float
        Vertices; edge i runs from point i to point i + 1, the last one back to point 0.

    Returns
    -------
    Contacts
        Exact. Cost: O(n log n) plus the number of pairs of edges whose bounding boxes meet.
    """
    n = len(points)
    following = np.roll(points, -1, axis=0)
    first, second = _overlapping_boxes(points, following)
    apart = (second - first > 1) & (second - first < n - 1)
    first, second = first[apart], second[apart]
    a, b, c, d = points[first], following[first], points[second], following[second]
    side_c, side_d, side_a, side_b = orient(a, b, c), orient(a, b, d), orient(c, d, a), orient(c, d, b)
    proper = (side_c * side_d < 0) & (side_a * side_b < 0)
    touches = [
        _touches(points, second, first, side_c),
        _touches(points, (second + 1) % n, first, side_d),
        _touches(points, first, second, side_a),
        _touches(points, (first + 1) % n, second, side_b),
        *_spikes(points, following),
    ]
    edges = np.stack([first[proper], second[proper]], axis=1)
    return Contacts(edges, side_d[proper] > 0, np.unique(np.concatenate(touches), axis=0))


def _overlapping_boxes(start: Floats, end: Floats) -> tuple[Ints, Ints]:
    """Return the pairs of edges i < j whose bounding boxes meet."""
    from shapely import STRtree, linestrings

    segments = linestrings(np.stack([start, end], axis=1))
    first, second = STRtree(segments).query(segments)
    keep = first < second
    return first[keep].astype(np.int64), second[keep].astype(np.int64)


def _touches(points: Floats, vertex: Ints, edge: Ints, side: Signs) -> Ints:
    """Return the rows (vertex, edge) where a vertex on the line of an edge lies on the edge itself."""
    a, b, v = points[edge], points[(edge + 1) % len(points)], points[vertex]
    hit = (side == 0) & ((np.minimum(a, b) <= v) & (v <= np.maximum(a, b))).all(axis=1)
    return np.stack([vertex[hit], edge[hit]], axis=1)


def _spikes(points: Floats, following: Floats) -> list[Ints]:
    """Return the rows (vertex, edge) of edges that run straight back over the edge before them."""
    n = len(points)
    edge = np.arange(n)
    after = np.roll(following, -1, axis=0)
    side = orient(points, following, after)
    return [_touches(points, edge, (edge + 1) % n, side), _touches(points, (edge + 2) % n, edge, side)]


def order_visits(points: Floats, contacts: Contacts) -> Visits:
    """Sort the crossings of a closed polyline along it.

    Parameters
    ----------
    points : (n, 2) float
        Vertices of the polyline.
    contacts : Contacts
        Its crossings, from :func:`find_contacts`.

    Returns
    -------
    Visits
        Exact: wherever rounding could change the order on an edge, that edge is sorted again with fractions.
        Cost: O(k log k).
    """
    k = len(contacts.edges)
    edge = contacts.edges.T.ravel()
    other = contacts.edges[:, ::-1].T.ravel()
    ends = np.stack([points, np.roll(points, -1, axis=0)], axis=1)
    parameter, error = parameter_along_edge(ends[edge, 0], ends[edge, 1], ends[other, 0], ends[other, 1])
    order = np.lexsort((parameter, edge))
    triple = _resort_exactly(order, edge, other, ends, _unsure_edges(edge[order], parameter[order], error[order]))
    rank = np.empty(2 * k, dtype=np.int64)
    rank[order] = np.arange(2 * k)
    start, end = ends[edge[:k], 0], ends[edge[:k], 1]
    crossing = start + parameter[:k, None] * (end - start)
    return Visits(
        edge=edge[order],
        partner=rank[np.roll(np.arange(2 * k), -k)][order],
        ccw=np.concatenate([contacts.from_right, ~contacts.from_right])[order],
        point=np.concatenate([crossing, crossing])[order],
        triple=np.array(triple, dtype=np.int64).reshape(-1, 3),
    )


def _unsure_edges(edge: Ints, parameter: Floats, error: Floats) -> Ints:
    """Return the edges on which two neighbouring parameters are closer than their rounding errors."""
    close = ~(parameter[1:] - parameter[:-1] > error[1:] + error[:-1])
    return np.unique(edge[1:][close & (edge[1:] == edge[:-1])])


def _resort_exactly(order: Ints, edge: Ints, other: Ints, ends: Floats, unsure: Ints) -> list[tuple[int, int, int]]:
    """Sort the visits on the unsure edges again, in place and exactly; return the triples of edges that meet."""
    triple = []
    sorted_edge = edge[order]
    for e in unsure.tolist():
        low, high = np.searchsorted(sorted_edge, [e, e + 1])
        exact = {v: exact_parameter(*ends[e], *ends[other[v]]) for v in order[low:high].tolist()}
        order[low:high] = sorted(exact, key=exact.__getitem__)
        triple += [(e, int(other[v]), int(other[w])) for v, w in _pairs(order[low:high]) if exact[v] == exact[w]]
    return triple


def _pairs(items: Ints) -> Iterator[tuple[int, int]]:
    return zip(items[:-1].tolist(), items[1:].tolist(), strict=True)
