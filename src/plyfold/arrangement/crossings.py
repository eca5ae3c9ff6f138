"""Where a closed polyline crosses itself, in exact order along it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Floats, Fractions, Ints, Numbers, Signs
from plyfold.clock import UNWATCHED, Watch
from plyfold.predicates import counted_cross_sign, exact_parameter, parameter_along_edge

__all__ = ["Contacts", "Visits", "edge_ends", "find_contacts", "near_pairs", "order_visits"]

Bytes: TypeAlias = npt.NDArray[np.uint8]
_Number = TypeVar("_Number", np.float64, np.uint8)

_NONE = np.empty(0, dtype=np.int64)

# Consecutive edges are looked at in groups of this size, unless a group meets more others than this on average.
_GROUP = 8
_CROWD = 24
# How many boxes are looked up at a time, and how many pairs of groups are taken apart at a time.
_LOOKUPS = 2**8
_PORTION = 2**14


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


def find_contacts(points: Floats, watch: Watch = UNWATCHED, absent: Ints = _NONE) -> Contacts:
    """Find all pairs of edges of a closed polyline that cross or touch.

    Parameters
    ----------
    points : (n, 2) float
        Vertices; edge i runs from point i to point i + 1, the last one back to point 0.
    watch : Watch, optional
    absent : (a,) int, optional
        Edges that are left out.

    Returns
    -------
    Contacts
        Exact. Cost: O(n log n) plus the number of pairs of edges whose bounding boxes meet.
    """
    # Neighbours need no look: where one runs back over the other, the edge beyond touches too.
    ends = edge_ends(points)
    parts = []
    for first, second in near_pairs(points, absent):
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
    # To take rows is several times as fast as to index them.
    start, end = ends.take(edge, axis=0).swapaxes(0, 1)[:, :, None]
    return counted_cross_sign(start, end, start, ends.take(other, axis=0))


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


def order_visits(points: Floats, contacts: Contacts, exact: Fractions | None = None) -> Visits:
    """Sort the crossings of a closed polyline along it.

    Parameters
    ----------
    points : (n, 2) float
        Vertices of the polyline.
    contacts : Contacts
        Its crossings, from :func:`find_contacts`.
    exact : (n, 2) object, optional
        Where the vertices are exactly, if they are no doubles, but infinitely near ``points``.

    Returns
    -------
    Visits
        Exact: visits whose order rounding could change are sorted again with fractions.
        Cost: O(k log k).
    """
    k = len(contacts.edges)
    edge, other = contacts.edges.T.ravel(), contacts.edges[:, ::-1].T.ravel()
    start, end = points.take(edge, axis=0), points.take((edge + 1) % len(points), axis=0)
    across = np.arange(2 * k) - k  # the other visit to the same crossing
    parameter, error = parameter_along_edge(start, end, start.take(across, axis=0), end.take(across, axis=0))
    if exact is not None:
        _find_unknown(exact, edge, other, parameter, error)
    order = np.argsort(_sorting_key(edge, parameter, len(points)))
    runs = _unsure_runs(edge[order], parameter[order], error[order])
    places = points if exact is None else exact
    triple = [three for run in runs for three in _sort_exactly(places, order[run], edge, other)]
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


def _find_unknown(exact: Fractions, edge: Ints, other: Ints, parameter: Floats, error: Floats) -> None:
    """Put in how far along edges crossings are of which doubles tell nothing, for the edges lie on each other."""
    for visit in np.flatnonzero(np.isinf(error)).tolist():
        ends = ((one, (one + 1) % len(exact)) for one in (edge[visit], other[visit]))
        parameter[visit] = exact_parameter(*(exact[end] for one in ends for end in one))
        error[visit] = np.finfo(np.float64).eps


def _sorting_key(edge: Ints, parameter: Floats, n: int) -> Ints:
    """Return edge and parameter as one whole number, which sorts ten times as fast as the two.

    It may confuse parameters nearer than some 1e-12; they count as unsure then.
    """
    bits = min(52, 62 - n.bit_length())
    return np.asarray((edge << bits) + (parameter * (2.0**bits - 1)).astype(np.int64))


def _unsure_runs(edge: Ints, parameter: Floats, error: Floats) -> list[slice]:
    """Return the runs of visits, sorted by edge and parameter, whose order is left open by rounding errors."""
    apart = parameter[1:] - parameter[:-1] > error[1:] + error[:-1]
    near = ~(apart | (edge[1:] != edge[:-1]))
    if not near.any():
        return []
    unsure = np.unique(edge[1:][near])
    bounds = np.searchsorted(edge, [unsure, unsure + 1]).T.tolist()
    return [run for low, high in bounds for run in _runs(low, parameter[low:high], error[low:high])]


def _runs(start: int, parameter: Floats, error: Floats) -> Iterator[slice]:
    """Yield the runs of visits on one edge that must be sorted together, as slices from ``start`` on."""
    reached = np.maximum.accumulate(parameter + error)
    ahead = np.minimum.accumulate((parameter - error)[::-1])[::-1]
    cuts = [0, *(np.flatnonzero(reached[:-1] < ahead[1:]) + 1).tolist(), len(parameter)]
    return (slice(start + low, start + high) for low, high in pairwise(cuts) if high - low > 1)


def _sort_exactly(points: Numbers, visits: Ints, edge: Ints, other: Ints) -> list[tuple[int, int, int]]:
    """Sort some visits on one edge in place; return the triples of edges that meet."""
    e, n = int(edge[visits[0]]), len(points)
    own = points[e], points[(e + 1) % n]
    place = {v: exact_parameter(*own, points[other[v]], points[(other[v] + 1) % n]) for v in visits.tolist()}
    visits[:] = sorted(place, key=lambda v: (place[v], other[v]))
    return [(e, int(other[v]), int(other[w])) for v, w in pairwise(visits.tolist()) if place[v] == place[w]]


# ---- candidates: edges that come near each other -------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Groups:
    """Bounding boxes of consecutive edges and of groups of them.

    ``low`` holds x and y of the lower corner of each box and −x, −y of the upper one, ``high`` the opposite corners in
    the same way: two boxes meet if no entry of one's ``low`` exceeds that of the other's ``high``.

    Parameters
    ----------
    edge_low : (4, size, groups) float
    edge_high : (4, edges) float
        The last group is filled up with boxes that meet nothing.
    low, high : (4, groups) float
    heading : (groups,) uint8
        A bit for each of eight directions, those of the axes and the diagonals, in which all edges of the group get
        ahead. Consecutive groups with a bit in common make one strand that runs steadily in that direction.
    """

    edge_low: Floats
    edge_high: Floats
    low: Floats
    high: Floats
    heading: Bytes


def near_pairs(points: Floats, absent: Ints = _NONE) -> Iterator[tuple[Ints, Ints]]:
    """Yield, portion by portion, the pairs of edges that may cross or touch.

    Parameters
    ----------
    points : (n, 2) float
        Vertices of a closed polyline; edge i runs from point i to point i + 1.
    absent : (a,) int, optional
        Edges that are left out.

    Yields
    ------
    first, second : (m,) int
        Edges, first < second, no neighbours. Every pair whose bounding boxes meet comes once, but for edges of a
        strand that runs steadily in some direction and so cannot meet itself. At least one portion comes.

    Notes
    -----
    O(n log n) plus the number of pairs. Memory for a portion does not grow with their number.
    """
    groups = _grouped(points, _GROUP, absent)
    pairs = _few_pairs(groups)
    if pairs is None:  # long edges: a box round several of them holds too much
        groups = _grouped(points, 1, absent)
        portions = _group_pairs(groups)
    else:
        portions = _portions(pairs)
    for first, second in portions:
        yield _edge_pairs(groups, first, second, len(points))


def _grouped(points: Floats, size: int, absent: Ints) -> _Groups:
    x, y = points.T
    # Rounding the sums keeps their order, or makes them equal.
    start = np.array([x, y, x + y, x - y])
    end = np.concatenate([start[:, 1:], start[:, :1]], axis=1)
    ahead = np.packbits(np.concatenate([start < end, start > end]), axis=0)
    heading = np.bitwise_and.reduce(_in_groups(ahead, size, 255)[0], axis=0)
    lower, upper = np.minimum(start[:2], end[:2]), np.maximum(start[:2], end[:2])
    edge_low, edge_high = np.concatenate([lower, -upper]), np.concatenate([upper, -lower])
    edge_low[:, absent], edge_high[:, absent] = np.inf, -np.inf
    low = _in_groups(edge_low, size, np.inf)
    high = _in_groups(edge_high, size, -np.inf)
    return _Groups(low, edge_high, low.min(axis=1), high.max(axis=1), heading)


def _in_groups(rows: npt.NDArray[_Number], size: int, filling: float) -> npt.NDArray[_Number]:
    """Cut rows (r, n) into groups (r, size, groups), the last one filled up."""
    height, n = rows.shape
    filled = np.full((height, -(-n // size) * size), filling, dtype=rows.dtype)
    filled[:, :n] = rows
    return np.ascontiguousarray(filled.reshape(height, -1, size).transpose(0, 2, 1))


def _few_pairs(groups: _Groups) -> tuple[Ints, Ints] | None:
    """Return the pairs of groups that meet, or None if there are too many."""
    found, total = [], 0
    for first, second in _group_pairs(groups):
        found.append((first, second))
        total += len(first)
        if total > _CROWD * len(groups.heading):
            return None
    firsts, seconds = zip(*found, strict=True)
    return np.concatenate(firsts), np.concatenate(seconds)


def _group_pairs(groups: _Groups) -> Iterator[tuple[Ints, Ints]]:
    """Yield the pairs i ≤ j of groups whose boxes meet, those left out whose edges run steadily in one direction."""
    from shapely import STRtree, linestrings

    # Diagonals have the same bounding boxes, and are made faster.
    corners = np.array([groups.low[:2], groups.high[:2]])
    # Those of absent edges alone meet nothing, wherever they are said to be.
    corners[:, :, np.isinf(groups.low[0])] = 0
    boxes = linestrings(corners.transpose(2, 0, 1))
    tree = STRtree(boxes)
    for start in range(0, len(boxes), _LOOKUPS):
        first, second = tree.query(boxes[start : start + _LOOKUPS])
        first += start
        gap = second - first
        unsteady = groups.heading[first] & groups.heading[second] == 0
        wanted = (gap > 1) | ((gap >= 0) & unsteady)
        yield first[wanted], second[wanted]


def _portions(pairs: tuple[Ints, Ints]) -> Iterator[tuple[Ints, Ints]]:
    first, second = pairs
    for start in range(0, len(first) or 1, _PORTION):
        yield first[start : start + _PORTION], second[start : start + _PORTION]


def _edge_pairs(groups: _Groups, first: Ints, second: Ints, n: int) -> tuple[Ints, Ints]:
    """Return the pairs of edges that meet: of each first group those that meet the second, with its edges they meet."""
    size = groups.edge_low.shape[1]
    member, pair = _meeting(groups.edge_low, first, groups.high, second)
    first, second = first[pair] * size + member, second[pair]
    member, pair = _meeting(groups.edge_low, second, groups.edge_high, first)
    first, second = first[pair], second[pair] * size + member
    gap = second - first
    apart = (gap > 1) & (gap < n - 1)
    return first[apart], second[apart]


def _meeting(low: Floats, group: Ints, high: Floats, box: Ints) -> tuple[Ints, Ints]:
    """Return which members of each group meet the box beside it: (member, place in ``group``) of all that do."""
    low, high = low.take(group, axis=2), high.take(box, axis=1)
    near = (low[0] <= high[0]) & (low[1] <= high[1]) & (low[2] <= high[2]) & (low[3] <= high[3])
    member, place = near.nonzero()
    return member, place
