"""Where closed polylines cross themselves and each other, in exact order along them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.core.buffers import all_flat, flat
from plyfold.core.meetings import Meetings, count_groups
from plyfold.core.vertices import TINY
from plyfold.core.visits import VisitsAlong
from plyfold.predicates import exact_parameter
from plyfold.ragged import next_in_rows

__all__ = ["Contacts", "Visits", "distinct_numbers", "distinct_pairs", "find_contacts", "order_visits"]

# `core.meetings` packs the sense of a crossing into its second edge, as the last bit.
_PACKED = np.array([0, 1])
# A little room for crossings, beside one number for each edge.
_SOME_CROSSINGS = 32


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


def find_contacts(points: Floats, watch: Watch = UNWATCHED, first_point: Ints | None = None) -> Contacts:
    """Find all pairs of edges of closed polylines that cross or touch.

    Parameters
    ----------
    points : (n, 2) float
        Vertices, loop after loop; edge i runs from point i to the next point of its loop.
    watch : Watch, optional
    first_point : (loops + 1,) int, optional
        The first point of each loop, and last n; one loop by default.

    Returns
    -------
    Contacts
        Exact. Cost: O(n log n) plus the number of pairs of edges whose bounding boxes meet.
    """
    watch.step()
    n, groups = len(points), count_groups(len(points))
    found, whole = Meetings(watch.step), np.empty(2 * groups + n + _SOME_CROSSINGS, dtype=np.int64)
    found.find(flat(points), flat(_following(points, first_point)), flat(np.empty(4 * n + 8 * groups)), flat(whole))
    crossings, touches = (numbers.as_array().reshape(-1, 2) for numbers in (found.crossings, found.touches))
    return Contacts(
        edges=crossings >> _PACKED,
        from_right=crossings[:, 1] % 2 == 1,
        touches=distinct_pairs(touches, len(points)) if len(touches) else touches,
        exact_signs=found.exact_signs,
    )


def distinct_pairs(pairs: Ints, n: int) -> Ints:
    """Return the distinct rows among pairs of numbers below n, in order.

    Examples
    --------
    >>> distinct_pairs(np.array([(2, 0), (1, 2), (2, 0)]), 3).tolist()
    [[1, 2], [2, 0]]
    """
    return np.stack(np.divmod(distinct_numbers(pairs[:, 0] * n + pairs[:, 1]), n), axis=1)


def distinct_numbers(numbers: Ints) -> Ints:
    """Return the distinct ones of some numbers, in order: as `np.unique`, which is ten times as slow where few repeat.

    Examples
    --------
    >>> distinct_numbers(np.array([3, 1, 3])).tolist()
    [1, 3]
    """
    ordered = np.sort(numbers)
    return np.asarray(ordered[np.append(True, ordered[1:] != ordered[:-1])[: len(ordered)]])


def _following(points: Floats, first_point: Ints | None) -> Ints:
    """Return the point that follows each along its loop."""
    return next_in_rows(np.array([0, len(points)]) if first_point is None else first_point)


def order_visits(points: Floats, contacts: Contacts, first_point: Ints | None = None) -> Visits:
    """Sort the crossings of closed polylines along them.

    Parameters
    ----------
    points : (n, 2) float
        Vertices, loop after loop.
    contacts : Contacts
        Their crossings, from :func:`find_contacts`.
    first_point : (loops + 1,) int, optional
        The first point of each loop, and last n; one loop by default.

    Returns
    -------
    Visits
        Exact: visits whose order rounding could change are sorted again with fractions.
        Cost: O(n + k log k).
    """
    k, following, exponent = len(contacts.edges), _following(points, first_point), _exponent_of_tiny(points)
    points = np.ldexp(points, -exponent) if exponent else points
    edge, order = contacts.edges.T.ravel(), np.empty(2 * k, dtype=np.int64)
    real, whole = np.empty((2, 2 * k)), np.empty(len(points) + 2 + 2 * k, dtype=np.int64)
    (place, error), along = real, VisitsAlong()
    along.sort(*all_flat(points, following, edge, order, real, whole))
    runs = [
        run
        for low, high in along.unsure.as_array().reshape(-1, 2).tolist()
        for run in _runs(low, place[order[low:high]], error[order[low:high]])
    ]
    ends, other = np.stack([points, points[following]]) if runs else points, contacts.edges[:, ::-1].T.ravel()
    triple = [three for run in runs for three in _sort_exactly(ends, order[run], edge, other)]
    visit_edge, partner = np.empty((2, 2 * k), dtype=np.int64)
    ccw, point = np.empty(2 * k, dtype=bool), np.empty((2 * k, 2))
    along.join(*all_flat(contacts.from_right.view(np.uint8), visit_edge, partner, ccw.view(np.uint8), point))
    return Visits(
        edge=visit_edge,
        partner=partner,
        ccw=ccw,
        point=np.ldexp(point, exponent) if exponent else point,
        triple=np.array(triple, dtype=np.int64).reshape(-1, 3),
        exact_signs=contacts.exact_signs + sum(run.stop - run.start for run in runs),
    )


def _exponent_of_tiny(points: Floats) -> int:
    """Return the power of two that a drawing is as large as, if products of its sides would be no doubles; else 0."""
    size = float(np.abs(points).max(initial=0.0))
    return math.frexp(size)[1] if size < TINY else 0


def _runs(start: int, parameter: Floats, error: Floats) -> Iterator[slice]:
    """Yield the runs of visits on one edge that must be sorted together, as slices from ``start`` on."""
    reached = np.maximum.accumulate(parameter + error)
    ahead = np.minimum.accumulate((parameter - error)[::-1])[::-1]
    cuts = [0, *(np.flatnonzero(reached[:-1] < ahead[1:]) + 1).tolist(), len(parameter)]
    return (slice(start + low, start + high) for low, high in pairwise(cuts) if high - low > 1)


def _sort_exactly(ends: Floats, visits: Ints, edge: Ints, other: Ints) -> list[tuple[int, int, int]]:
    """Sort some visits on one edge in place; return the triples of edges that meet."""
    e = int(edge[visits[0]])
    place = {v: exact_parameter(*ends[:, e], *ends[:, other[v]]) for v in visits.tolist()}
    visits[:] = sorted(place, key=lambda v: (place[v], other[v]))
    return [(e, int(other[v]), int(other[w])) for v, w in pairwise(visits.tolist()) if place[v] == place[w]]
