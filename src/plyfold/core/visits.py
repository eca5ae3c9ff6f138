"""The order of crossings along the edges of an outline."""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer, WholeBuffer
from plyfold.core.numbers import Numbers

__all__ = ["VisitsAlong"]

# See `predicates.parameter_along_edge`: the quotient of two sums, each within 8 u of its magnitude.
_PARAMETER_ERROR = 4e-15
_UNDERFLOW = 1e-290
_FAR = float("inf")


class VisitsAlong:
    """The visits of an outline to its crossings, sorted along its edges as far as doubles tell.

    Visits c and k + c are at crossing c, the first on its one edge and the second on its other one.

    Attributes
    ----------
    unsure : Numbers
        Two for each edge on which rounding leaves the order open: from where to where it is in ``order``.

    Notes
    -----
    O(n + k), and O(m log² m) or so for each edge with m visits.
    """

    def __init__(self) -> None:
        self.k, self.unsure = 0, Numbers()

    def sort(
        self,
        points: RealBuffer,
        following: WholeBuffer,
        edge: WholeBuffer,
        order: WholeBuffer,
        real: RealBuffer,
        whole: WholeBuffer,
    ) -> None:
        """Sort the visits.

        Parameters
        ----------
        points : buffer of 2n float
            Coordinates, point after point.
        following : buffer of n int
            Edge i runs from point i to point ``following[i]``.
        edge : buffer of 2k int
            The edge that each visit is on.
        order : buffer of 2k int
            Room for the visits in order. Where doubles do not tell, they are to be sorted on before :meth:`join`.
        real : buffer of 4k float
            Room for how far along its edge each visit is, from 0 to 1, and then for how wrong that may be.
        whole : buffer of int
            Room for n + 2 and 2k numbers.
        """
        self.points, self.following, self.edge, self.order = points, following, edge, order
        self.k, n = len(edge) // 2, len(following)
        self.place, self.error = real[: 2 * self.k], real[2 * self.k : 4 * self.k]
        self.first, self.rank = whole[: n + 2], whole[n + 2 : n + 2 + 2 * self.k]
        for crossing in range(self.k):
            self._find_place(crossing, self.edge[crossing], self.edge[self.k + crossing])
            self._find_place(self.k + crossing, self.edge[self.k + crossing], self.edge[crossing])
        self._sort()

    def _find_place(self, visit: int, edge: int, other: int) -> None:
        """Find where an edge a → b crosses another one c → d: at (c − a) × (d − c) / (b − a) × (d − c)."""
        end, other_end = self.following[edge], self.following[other]
        x, y = self.points[2 * edge], self.points[2 * edge + 1]
        across_x = self.points[2 * other_end] - self.points[2 * other]
        across_y = self.points[2 * other_end + 1] - self.points[2 * other + 1]
        above = (self.points[2 * other] - x) * across_y
        above_minus = (self.points[2 * other + 1] - y) * across_x
        below = (self.points[2 * end] - x) * across_y
        below_minus = (self.points[2 * end + 1] - y) * across_x
        size = abs(above) + abs(above_minus) + _UNDERFLOW + 2 * (abs(below) + abs(below_minus) + _UNDERFLOW)
        self._note_place(visit, above - above_minus, below - below_minus, _PARAMETER_ERROR * size)

    def _note_place(self, visit: int, above: float, below: float, error: float) -> None:
        """Note a quotient as a place, and the bound of its error; where both are no numbers, nothing is known."""
        self.place[visit], self.error[visit] = 0.5, _FAR
        if below != 0.0:
            place, bound = above / below, error / abs(below)
            place = 0.0 if place < 0.0 else 1.0 if place > 1.0 else place
            if bound < _FAR and place - place == 0.0:
                self.place[visit], self.error[visit] = place, bound

    def _sort(self) -> None:
        """Sort the visits by their edges, counting how many there are on each; and then along each edge."""
        n = len(self.following)
        for edge in range(n + 2):
            self.first[edge] = 0
        for visit in range(2 * self.k):
            self.first[self.edge[visit] + 2] += 1
        for edge in range(n):
            self.first[edge + 2] += self.first[edge + 1]
        for visit in range(2 * self.k):
            self._put(visit, self.edge[visit] + 1)
        for edge in range(n):
            if self.first[edge + 1] - self.first[edge] > 1:
                self._sort_edge(self.first[edge], self.first[edge + 1])

    def _put(self, visit: int, edge: int) -> None:
        """Put a visit behind those before it on its edge."""
        self.order[self.first[edge]] = visit
        self.first[edge] += 1

    def _sort_edge(self, low: int, high: int) -> None:
        """Sort the visits on one edge (Shell), and note if their order is unsure."""
        gap = 1
        while gap < (high - low) // 3:
            gap = 3 * gap + 1
        while gap > 0:
            for at in range(low + gap, high):
                self._sink(low, at, gap)
            gap //= 3
        for at in range(low, high - 1):
            if not self._is_apart(self.order[at], self.order[at + 1]):
                self.unsure.append(low)
                self.unsure.append(high)
                break

    def _sink(self, low: int, at: int, gap: int) -> None:
        """Move a visit back past those that lie further along, in steps of a gap."""
        visit = self.order[at]
        place = self.place[visit]
        while at - gap >= low and self.place[self.order[at - gap]] > place:
            self.order[at] = self.order[at - gap]
            at -= gap
        self.order[at] = visit

    def _is_apart(self, visit: int, other: int) -> bool:
        return self.place[other] - self.place[visit] > self.error[other] + self.error[visit]

    def join(
        self,
        from_right: WholeBuffer,
        visit_edge: WholeBuffer,
        partner: WholeBuffer,
        ccw: WholeBuffer,
        point: RealBuffer,
    ) -> None:
        """Find the edge of each visit, the other one to its crossing, how it crosses, and where, in order.

        Parameters
        ----------
        from_right : buffer of k bool
            Whether the other edge of each crossing crosses the first from right to left.
        visit_edge, partner, ccw, point : buffer of 2k int, 2k int, 2k bool and 4k float
            Room for the results.
        """
        for at in range(2 * self.k):
            self.rank[self.order[at]] = at
        for at in range(2 * self.k):
            visit = self.order[at]
            is_first = visit < self.k
            crossing = visit if is_first else visit - self.k
            visit_edge[at] = self.edge[visit]
            partner[at] = self.rank[visit + self.k if is_first else crossing]
            ccw[at] = from_right[crossing] if is_first else 1 - from_right[crossing]
            start, end = self.edge[crossing], self.following[self.edge[crossing]]
            for axis in range(2):
                coordinate = self.points[2 * start + axis]
                reach = self.points[2 * end + axis] - coordinate
                point[2 * at + axis] = coordinate + self.place[crossing] * reach
