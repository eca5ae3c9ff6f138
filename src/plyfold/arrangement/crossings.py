"""Where a closed polyline crosses itself, in exact order along it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from plyfold.arrangement.edge_pairs import near_pairs
from plyfold.arrays import Bools, Floats, Ints, Signs
from plyfold.clock import UNWATCHED, Watch
from plyfold.predicates import counted_cross_sign, exact_parameter, parameter_along_edge

__all__ = ["Contacts", "Visits", "edge_ends", "find_contacts", "order_visits"]


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
    exact_signs : int
        How many signs had to be settled with fractions.
    """

    edges: Ints
    from_right: Bools
    touches: Ints
    exact_signs: int


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
    exact_signs : int
        How many signs and places along edges had to be settled with fractions.
    """

    edge: Ints
    partner: Ints
    ccw: Bools
    point: Floats
    triple: Ints
    exact_signs: int


def find_contacts(points: Floats, watch: Watch = UNWATCHED) -> Contacts:
    """Find all pairs of edges of a closed polyline that cross or touch.

    Parameters
    ----------
    points : (n, 2) float
        Vertices; edge i runs from point i to point i + 1, the last one back to point 0.
    watch : Watch, optional

    Returns
    -------
    Contacts
        Exact. Cost: O(n log n) plus the number of pairs of edges whose bounding boxes meet.
    """
    # Neighbours need no look: where one runs back over the other, the edge beyond touches too.
    ends = edge_ends(points)
    parts = []
    for first, second in near_pairs(points):
        watch.step()
        parts.append(_meetings(ends, first, second))
    touches = np.concatenate([part.touches for part in parts])
    return Contacts(
        edges=np.concatenate([part.edges for part in parts]),
        from_right=np.concatenate([part.from_right for part in parts]),
        touches=np.unique(touches, axis=0) if len(touches) else touches,
        exact_signs=sum(part.exact_signs for part in parts),
    )


def edge_ends(points: Floats) -> Floats:
    """Return start and end of each edge of a closed polyline, shape (n, 2, 2)."""
    ends = np.empty((len(points), 2, 2))
    ends[:, 0], ends[:-1, 1], ends[-1, 1] = points, points[1:], points[0]
    return ends


def _meetings(ends: Floats, first: Ints, second: Ints) -> Contacts:
    """Return the contacts of edges that are no neighbours, shape (m,) each."""
    side, exact = _sides(ends, first, second)
    # Edges keep apart if one of them lies on one side of the other.
    met = side[:, 0] * side[:, 1] <= 0
    first, second, side = first[met], second[met], side[met]
    other_side, other_exact = _sides(ends, second, first)
    proper = (side[:, 0] * side[:, 1] < 0) & (other_side[:, 0] * other_side[:, 1] < 0)
    touches = np.concatenate([_touches(ends, second, first, side), _touches(ends, first, second, other_side)])
    edges = np.stack([first[proper], second[proper]], axis=1)
    return Contacts(edges, side[proper, 1] > 0, touches, exact + other_exact)


def _sides(ends: Floats, edge: Ints, other: Ints) -> tuple[Signs, int]:
    """Return on which side of each edge the other edge starts and ends, shape (m, 2)."""
    start, end = ends[edge, 0, None], ends[edge, 1, None]
    return counted_cross_sign(start, end, start, ends[other])


def _touches(ends: Floats, edge: Ints, other: Ints, side: Signs) -> Ints:
    """Return the rows (vertex, other edge) where an edge starts or ends on the other; ``side`` is that of its ends."""
    on_line, end = np.nonzero(side == 0)
    if len(on_line) == 0:
        return np.empty((0, 2), dtype=np.int64)
    edge, other = edge[on_line], other[on_line]
    place, line = ends[edge, end], ends[other]
    hit = ((line.min(axis=1) <= place) & (place <= line.max(axis=1))).all(axis=1)
    vertex = (edge + end) % len(ends)
    return np.stack([vertex[hit], other[hit]], axis=1)


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
        Exact: visits whose order rounding could change are sorted again with fractions.
        Cost: O(k log k).
    """
    k = len(contacts.edges)
    edge, other = contacts.edges.T.ravel(), contacts.edges[:, ::-1].T.ravel()
    start, end = points[edge], points[(edge + 1) % len(points)]
    across = np.arange(2 * k) - k  # the other visit to the same crossing
    parameter, error = parameter_along_edge(start, end, start[across], end[across])
    order = np.argsort(_sorting_key(edge, parameter, len(points)))
    runs = _unsure_runs(edge[order], parameter[order], error[order])
    triple = [three for run in runs for three in _sort_exactly(points, order[run], edge, other)]
    rank = np.empty(2 * k, dtype=np.int64)
    rank[order] = np.arange(2 * k)
    crossing = start[:k] + parameter[:k, None] * (end[:k] - start[:k])
    return Visits(
        edge=edge[order],
        partner=rank[np.where(order < k, order + k, order - k)],
        ccw=np.concatenate([contacts.from_right, ~contacts.from_right])[order],
        point=np.concatenate([crossing, crossing])[order],
        triple=np.array(triple, dtype=np.int64).reshape(-1, 3),
        exact_signs=contacts.exact_signs + sum(run.stop - run.start for run in runs),
    )


def _sorting_key(edge: Ints, parameter: Floats, n: int) -> Ints:
    """Return edge and parameter as one whole number, which sorts ten times as fast as the two.

    It may confuse parameters nearer than some 1e-12; they count as unsure then.
    """
    bits = min(52, 62 - n.bit_length())
    return np.asarray((edge << bits) + (parameter * (2.0**bits - 1)).astype(np.int64))


def _unsure_runs(edge: Ints, parameter: Floats, error: Floats) -> list[slice]:
    """Return the runs of visits, sorted by edge and parameter, whose order is left open by rounding errors."""
    apart = parameter[1:] - parameter[:-1] > error[1:] + error[:-1]
    unsure = np.unique(edge[1:][~(apart | (edge[1:] != edge[:-1]))])
    bounds = np.searchsorted(edge, [unsure, unsure + 1]).T.tolist()
    return [run for low, high in bounds for run in _runs(low, parameter[low:high], error[low:high])]


def _runs(start: int, parameter: Floats, error: Floats) -> Iterator[slice]:
    """Yield the runs of visits on one edge that must be sorted together, as slices from ``start`` on."""
    reached = np.maximum.accumulate(parameter + error)
    ahead = np.minimum.accumulate((parameter - error)[::-1])[::-1]
    cuts = [0, *(np.flatnonzero(reached[:-1] < ahead[1:]) + 1).tolist(), len(parameter)]
    return (slice(start + low, start + high) for low, high in pairwise(cuts) if high - low > 1)


def _sort_exactly(points: Floats, visits: Ints, edge: Ints, other: Ints) -> list[tuple[int, int, int]]:
    """Sort some visits on one edge in place; return the triples of edges that meet."""
    e, n = int(edge[visits[0]]), len(points)
    own = points[e], points[(e + 1) % n]
    place = {v: exact_parameter(*own, points[other[v]], points[(other[v] + 1) % n]) for v in visits.tolist()}
    visits[:] = sorted(place, key=lambda v: (place[v], other[v]))
    return [(e, int(other[v]), int(other[w])) for v, w in pairwise(visits.tolist()) if place[v] == place[w]]
