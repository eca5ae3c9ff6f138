"""Half-edges of a triangle mesh: half-edge 3t + i runs along the side of triangle t that starts at its corner i."""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.planar_map import Ints

__all__ = ["HalfEdges", "following"]


class HalfEdges:
    """The sides of triangles, to be looked up by their two ends.

    Parameters
    ----------
    triangles : (t, 3) int
        Counter-clockwise, so that no two triangles have a side from the same vertex to the same vertex.

    Attributes
    ----------
    start, end : (3t,) int
        The vertices that each half-edge runs from and to.

    Notes
    -----
    O(t log t) to build, O(log t) for each look-up.

    Examples
    --------
    >>> import numpy as np
    >>> sides = HalfEdges(np.array([[0, 1, 2], [2, 1, 3]]))
    >>> sides.find(np.array([1, 2, 3]), np.array([2, 1, 0])).tolist()
    [1, 3, -1]
    >>> sides.twin.tolist()
    [-1, 3, -1, 1, -1, -1]
    """

    def __init__(self, triangles: Ints) -> None:
        self.start = triangles.ravel()
        self.end = triangles[:, [1, 2, 0]].ravel()
        self._base = int(triangles.max(initial=0)) + 1
        key = self.start * self._base + self.end
        self._order = np.argsort(key)
        self._sorted_key = key[self._order]

    def find(self, start: Ints, end: Ints) -> Ints:
        """Return the half-edge from each start to each end, -1 where there is none."""
        key = start * self._base + end
        place = np.minimum(np.searchsorted(self._sorted_key, key), len(self._sorted_key) - 1)
        known = (self._sorted_key[place] == key) & (np.maximum(start, end) < self._base)
        return np.where(known, self._order[place], -1)

    @property
    def twin(self) -> Ints:
        """The half-edge on the other side of each half-edge, -1 where there is no triangle."""
        return self.find(self.end, self.start)


def following(half_edge: Ints) -> Ints:
    """Return the half-edge that follows within the same triangle; its start is the end of the given one."""
    return np.where(half_edge % 3 == 2, half_edge - 2, half_edge + 1)
