"""Cusps that lie on each other. A cusp that touches something stays where it is, but there one has to give way.

A cusp has no outside, and no rule says where to; so there are several ways to move it, into all the sectors between the
directions of the edges at its place. Further in or out in a sector nothing changes.

First come the ways after which the sheets round the place still have one order, as over a single point. And a cusp
gives way by so little that it stays inside all that moves outward there.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrangement.crossings import Contacts
from plyfold.arrangement.outward import canonical_rank
from plyfold.arrangement.spikes import tips
from plyfold.arrays import Bools, Floats, Ints, Reals
from plyfold.outline.curve import Outline
from plyfold.predicates import orient

__all__ = ["CrowdedCusps", "crowded_cusps", "cusps_that_stay", "lie_inside", "stay_inside"]

_MOST_WAYS = 256
# How far the first cusp at a place gives way, as a part of a unit of moves outward; and the next so many times more.
_LITTLE = 2.0**-12
_TIMES = 8.0


class CrowdedCusps(NamedTuple):
    """Cusps that give way, and the vectors along which each may move."""

    points: Ints
    vectors: list[Floats]

    @property
    def n_ways(self) -> int:
        """In how many ways all of them may move together; no more than are tried."""
        return min(int(np.prod(self._shape, dtype=object)), _MOST_WAYS)

    @property
    def _shape(self) -> list[int]:
        return [len(vectors) for vectors in self.vectors]

    def way(self, number: int) -> Floats:
        """Return the vector of each in one of these ways, shape (m, 2)."""
        chosen = []
        for vectors in self.vectors:
            number, at = divmod(number, len(vectors))
            chosen.append(vectors[at])
        return np.array(chosen).reshape(-1, 2)


def crowded_cusps(given: Outline, contacts: Contacts) -> CrowdedCusps:
    """Return the cusps that give way: of several at one place all but one, and those on edges between cusps that stay.

    Parameters
    ----------
    given : Outline
    contacts : Contacts
        Its crossings and touches.
    """
    vertex, edge = contacts.touches.T
    stays = cusps_that_stay(given, contacts)
    if not stays.any():
        return CrowdedCusps(vertex[:0], [])
    held = stays[vertex] & stays[edge] & stays[given.next_point[edge]] & lie_inside(given, contacts)
    before = _others_before(given, np.intersect1d(np.flatnonzero(stays), vertex))
    points = np.union1d(vertex[held], [point for point, others in before.items() if len(others)]).astype(np.int64)
    of_point = [(point, edge[vertex == point], edge[held & (vertex == point)]) for point in points.tolist()]
    return CrowdedCusps(points, [_ways_out(given, *touched, before[touched[0]]) for touched in of_point])


def cusps_that_stay(given: Outline, contacts: Contacts) -> Bools:
    """Tell which points stay, as far as there is room: cusps in contact, and at tips, which have no outside either."""
    is_cusp = np.concatenate(given.cusps) > 0
    if not is_cusp.any():
        return is_cusp
    return np.asarray(is_cusp & (np.isin(np.arange(len(given)), contacts.touches[:, 0]) | tips(given)))


def stay_inside(given: Outline, contacts: Contacts, points: Reals, crowded: Ints, sense: int) -> bool:
    """Tell whether cusps that gave way are still inside all that moved outward, or outside what moved inward. Exact.

    Parameters
    ----------
    given : Outline
    contacts : Contacts
    points : (n, 2) float, or object
        The outline's points when they have moved.
    crowded : (m,) int
        The cusps that gave way.
    sense : int
    """
    vertex, edge = contacts.touches[np.isin(contacts.touches[:, 0], crowded)].T
    end = given.next_point[edge]
    stays = cusps_that_stay(given, contacts)
    held = stays[edge] & stays[end]
    at_cusp = [stays[point] & (given.points[point] == given.points[vertex]).all(axis=1) for point in (edge, end)]
    edge, end, vertex = (rows[~(held | at_cusp[0] | at_cusp[1])] for rows in (edge, end, vertex))
    return bool((sense * orient(points[edge], points[end], points[vertex]) > 0).all())


def lie_inside(given: Outline, contacts: Contacts) -> Bools:
    """Tell which of the vertices that touch edges lie inside them, and not on their ends."""
    vertex, edge = contacts.touches.T
    ends = given.points[np.stack([edge, given.next_point[edge]])]
    return np.asarray((given.points[vertex] != ends).any(axis=2).all(axis=0))


def _others_before(given: Outline, points: Ints) -> dict[int, Ints]:
    """Return for each of some points those others at its place that come before it in the order of the drawing."""
    ordered = points[np.argsort(canonical_rank(given)[points])]
    place = np.unique(given.points[ordered], axis=0, return_inverse=True)[1].ravel()
    return {point: ordered[:i][place[:i] == place[i]] for i, point in enumerate(ordered.tolist())}


def _ways_out(given: Outline, point: int, touched: Ints, held: Ints, before: Ints) -> Floats:
    """Return a vector into each sector between the lines through a point along its own edges and others there.

    First those to the left of the edges that hold it, and then those that leave one order with the cusps before it.
    """
    edges = np.union1d(touched, [given.previous_point[point], point])
    angle = np.unique(_directions(given, edges) % np.pi)
    angle = angle[_apart(angle)]
    middle = np.concatenate([angle, angle + np.pi]) + np.tile(np.diff(angle, append=angle[0] + np.pi) / 2, 2)
    inside = (np.sin(middle - _directions(given, held)[:, None]) > 0).sum(axis=0)
    own, others = _stair(given, point, middle), [_stair(given, other, middle) for other in before.tolist()]
    ways = range(len(middle))
    in_order = [sum(_is_in_order(own, other, way, len(middle)) for other in others) for way in ways]
    middle = middle[np.lexsort((np.negative(in_order), -inside))]
    return _LITTLE * _TIMES ** len(before) * np.stack([np.cos(middle), np.sin(middle)], axis=1)


class _Stair(NamedTuple):
    """Where the turns of a surface round a cusp begin and end, in sectors from the first one on."""

    start: int
    end: int


def _stair(given: Outline, cusp: int, middle: Floats) -> _Stair:
    """Return the stair round a cusp, from the edge that leaves it to the one that arrives."""
    leaving, arriving = _directions(given, np.array([cusp, given.previous_point[cusp]]))
    start, end = np.searchsorted(middle, np.array([leaving, arriving + np.pi]) % (2 * np.pi)).tolist()
    seen = (end - start) % len(middle) or len(middle)
    return _Stair(start, start + seen + len(middle) * int(np.concatenate(given.cusps)[cusp]))


def _is_in_order(own: _Stair, other: _Stair, way: int, turn: int) -> bool:
    """Tell whether all sheets of two stairs have one order after the first one moves into a sector.

    Between the two cusps they do, so the whole stair of each lies above or below what lies at its cusp of the other.
    Sheets of both that turn together round both are in this order, if they come there: from a sector where they are,
    straight, so less than half a turn round the other cusp. Where one ends at an edge of the other, both move over it.
    """
    half = turn // 2
    for turns in range((other.start - own.end) // turn, (other.end - own.start) // turn + 1):
        start, end = own.start + turns * turn, own.end + turns * turn
        first, last = max(start, other.start), min(end, other.end)
        at_other = _comes_by(way + half, turn, max(start, first - half), min(end, last + half))
        at_own = _comes_by(way, turn, max(other.start, first - half), min(other.end, last + half))
        if first <= last and not (at_other or at_own):
            return False
    return True


def _comes_by(sector: int, turn: int, first: int, end: int) -> bool:
    """Tell whether going round from one number of sectors to another one comes through a sector."""
    return first + (sector - first) % turn < end


def _directions(given: Outline, edges: Ints) -> Floats:
    """Return the angles in which edges run."""
    x, y = (given.points[given.next_point[edges]] - given.points[edges]).T
    return np.asarray(np.arctan2(y, x))


def _apart(angle: Floats) -> Bools:
    """Tell which angles are not the same as the one before but for rounding: that would only be one try more."""
    return np.append(True, np.diff(angle) > 1e-12)
