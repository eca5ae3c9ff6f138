"""Where the edges of an outline meet: its crossings and touches, in the outline's own numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plyfold.arrangement.crossings import Contacts, Visits, find_contacts, order_visits
from plyfold.arrays import Bools, Floats, Fractions, Ints
from plyfold.clock import UNWATCHED, Watch

__all__ = ["JoinedLoops", "joined_loops", "meetings", "visits_along"]


@dataclass(frozen=True, eq=False)
class JoinedLoops:
    """All loops as one polyline: each ends with a copy of its first point, and a *jump* leads from there to the next.

    Of one loop the polyline is the loop itself.

    Parameters
    ----------
    points : (n, 2) float
    loop : (n,) int
        The loop of each point and of the edge that starts there. It is also how far their numbers lie beyond those in
        the outline.
    vertex : (n,) int
        The first point of the loop for the copies of it, and each other point itself.
    is_jump : (n,) bool
        True where the edge that starts at a point is a jump.
    """

    points: Floats
    loop: Ints
    vertex: Ints
    is_jump: Bools

    @property
    def number(self) -> Ints:
        """The number in the outline that each point has, or the one that it is a copy of."""
        return self.vertex - self.loop

    @property
    def is_one_loop(self) -> bool:
        """Whether there are no jumps."""
        return int(self.loop[-1]) == 0


def joined_loops(points: Floats, first_point: Ints) -> JoinedLoops:
    """Return loops as one polyline; loop l has the points ``first_point[l]:first_point[l + 1]``."""
    if len(first_point) == 2:
        n = len(points)
        return JoinedLoops(points, np.zeros(n, dtype=np.int64), np.arange(n), np.zeros(n, dtype=bool))
    lengths = np.diff(first_point) + 1
    last = np.cumsum(lengths) - 1
    vertex = np.arange(int(lengths.sum()))
    vertex[last] -= lengths - 1
    loop = np.repeat(np.arange(len(lengths)), lengths)
    return JoinedLoops(points[vertex - loop], loop, vertex, is_jump=np.isin(np.arange(len(vertex)), last))


def meetings(joined: JoinedLoops, watch: Watch = UNWATCHED) -> Contacts:
    """Return the pairs of edges of an outline that cross, and the vertices that lie on foreign edges."""
    if joined.is_one_loop:
        return find_contacts(joined.points, watch)
    found = find_contacts(joined.points, watch, np.flatnonzero(joined.is_jump))
    edges = found.edges - joined.loop[found.edges]
    return replace(found, edges=edges, touches=_own_touches_left_out(joined, found.touches))


def _own_touches_left_out(joined: JoinedLoops, touches: Ints) -> Ints:
    """Leave out the touches of jumps, and those of edges that share the point with which a loop begins and ends."""
    vertex, edge = joined.vertex[touches[:, 0]], touches[:, 1]
    following = joined.vertex[(edge + 1) % len(joined.vertex)]
    kept = ~joined.is_jump[edge] & (vertex != edge) & (vertex != following)
    rows = np.stack([vertex[kept], edge[kept]], axis=1)
    return np.unique(rows - joined.loop[rows], axis=0)


def visits_along(joined: JoinedLoops, contacts: Contacts, exact: Fractions | None = None) -> Visits:
    """Return the visits of an outline to its crossings, in order along one loop after the other.

    ``exact`` are the places of its points if they are no doubles, but infinitely near those of ``joined``.
    """
    if joined.is_one_loop:
        return order_visits(joined.points, contacts, exact)
    number = np.flatnonzero(~joined.is_jump)
    contacts = replace(contacts, edges=number[contacts.edges])
    visits = order_visits(joined.points, contacts, None if exact is None else exact[joined.number])
    loop = joined.loop
    return replace(visits, edge=visits.edge - loop[visits.edge], triple=visits.triple - loop[visits.triple])
