"""Several loops as one polyline."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Floats, Ints

__all__ = ["JoinedLoops", "joined_loops"]


@dataclass(frozen=True, eq=False)
class JoinedLoops:
    """All loops as one polyline: each ends with a copy of its first point, and a *jump* leads from there to the next.

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

    def edge_ends(self) -> Floats:
        """Return start and end of each edge, shape (n, 2, 2); jumps go nowhere."""
        end = np.roll(self.points, -1, axis=0)
        return np.stack([self.points, np.where(self.is_jump[:, None], self.points, end)], axis=1)


def joined_loops(points: Floats, first_point: Ints) -> JoinedLoops:
    """Return loops as one polyline; loop l has the points ``first_point[l]:first_point[l + 1]``."""
    lengths = np.diff(first_point) + 1
    last = np.cumsum(lengths) - 1
    vertex = np.arange(int(lengths.sum()))
    vertex[last] -= lengths - 1
    loop = np.repeat(np.arange(len(lengths)), lengths)
    return JoinedLoops(points[vertex - loop], loop, vertex, is_jump=np.isin(np.arange(len(vertex)), last))
