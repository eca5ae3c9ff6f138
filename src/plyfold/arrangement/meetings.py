"""Where the edges of an outline meet: its crossings and touches, in the outline's own numbers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plyfold.arrangement.crossings import Contacts, Visits, find_contacts, order_visits
from plyfold.arrays import Bools, Floats, Ints
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
    first_point : (loops + 1,) int
        The first point of each loop in the outline, and last the number of its points.
    """

    points: Floats
    loop: Ints
    vertex: Ints
    is_jump: Bools
    first_point: Ints

    @property
    def is_one_loop(self) -> bool:
        """Whether there are no jumps."""
        return int(self.loop[-1]) == 0

    @property
    def number(self) -> Ints:
        """The number in the outline that each point has, or the one that it is a copy of."""
        return self.vertex - self.loop

    @cached_property
    def vertices(self) -> Floats:
        """The points of the outline, without the copies, shape (points, 2)."""
        return self.points if self.is_one_loop else self.points.take(np.flatnonzero(~self.is_jump), axis=0)


def joined_loops(points: Floats, first_point: Ints) -> JoinedLoops:
    """Return loops as one polyline; loop l has the points ``first_point[l]:first_point[l + 1]``."""
    if len(first_point) == 2:
        n = len(points)
        return JoinedLoops(points, np.zeros(n, dtype=np.int64), np.arange(n), np.zeros(n, dtype=bool), first_point)
    lengths = np.diff(first_point) + 1
    last = lengths.cumsum() - 1
    vertex = np.arange(int(last[-1]) + 1)
    vertex[last] -= lengths - 1
    loop = np.arange(len(lengths)).repeat(lengths)
    is_jump = np.zeros(len(vertex), dtype=bool)
    is_jump[last] = True
    return JoinedLoops(points.take(vertex - loop, axis=0), loop, vertex, is_jump, first_point)


def meetings(joined: JoinedLoops, watch: Watch = UNWATCHED) -> Contacts:
    """Return the pairs of edges of an outline that cross, and the vertices that lie on foreign edges."""
    return find_contacts(joined.vertices, watch, joined.first_point)


def visits_along(joined: JoinedLoops, contacts: Contacts) -> Visits:
    """Return the visits of an outline to its crossings, in order along one loop after the other."""
    return order_visits(joined.vertices, contacts, joined.first_point)
