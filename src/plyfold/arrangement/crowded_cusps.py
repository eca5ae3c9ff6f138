"""Cusps that lie on each other. A cusp that touches something stays where it is, but there one has to give way.

A cusp has no outside, and no rule says where to; so there are several ways to move it, into all the sectors between the
directions of the edges at its place. Further in or out in a sector nothing changes.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrangement.crossings import Contacts
from plyfold.arrangement.outward import canonical_rank
from plyfold.arrays import Bools, Floats, Ints
from plyfold.outline.curve import Outline

__all__ = ["CrowdedCusps", "crowded_cusps", "lie_inside"]

_MOST_WAYS = 256


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
    is_cusp = np.concatenate(given.cusps) > 0
    stays = is_cusp & np.isin(np.arange(len(given)), vertex)
    if not stays.any():
        return CrowdedCusps(vertex[:0], [])
    held = vertex[stays[vertex] & stays[edge] & stays[given.next_point[edge]] & lie_inside(given, contacts)]
    points = np.union1d(held, _later_ones(given, np.flatnonzero(stays)))
    return CrowdedCusps(points, [_into_sectors(given, point, edge[vertex == point]) for point in points.tolist()])


def lie_inside(given: Outline, contacts: Contacts) -> Bools:
    """Tell which of the vertices that touch edges lie inside them, and not on their ends."""
    vertex, edge = contacts.touches.T
    ends = given.points[np.stack([edge, given.next_point[edge]])]
    return np.asarray((given.points[vertex] != ends).any(axis=2).all(axis=0))


def _later_ones(given: Outline, points: Ints) -> Ints:
    """Return those of some points that are not the first ones at their places, in the order of the drawing."""
    ordered = points[np.argsort(canonical_rank(given)[points])]
    first = np.unique(given.points[ordered], axis=0, return_index=True)[1]
    return np.delete(ordered, first)


def _into_sectors(given: Outline, point: int, touched: Ints) -> Floats:
    """Return a vector into each sector between the lines through a point along its own edges and others there."""
    edges = np.union1d(touched, [given.previous_point[point], point])
    x, y = (given.points[given.next_point[edges]] - given.points[edges]).T
    angle = np.unique(np.arctan2(y, x) % np.pi)
    angle = angle[_apart(angle)]
    middle = np.concatenate([angle, angle + np.pi]) + np.tile(np.diff(angle, append=angle[0] + np.pi) / 2, 2)
    return np.stack([np.cos(middle), np.sin(middle)], axis=1)


def _apart(angle: Floats) -> Bools:
    """Tell which angles are not the same as the one before but for rounding: that would only be one try more."""
    return np.append(True, np.diff(angle) > 1e-12)
