"""Which edges of an outline cross or touch.

Eight consecutive edges make a *group*, two groups that follow each other a larger one, and so on: a binary tree of
bounding boxes, as deep as the logarithm of the number of edges. Two groups are taken apart, and their halves looked at,
if their boxes meet; down to edges, whose sides decide.
"""

from __future__ import annotations

from collections.abc import Callable

from plyfold.core.buffers import RealBuffer, WholeBuffer
from plyfold.core.numbers import Numbers
from plyfold.core.signs import quick_sign, sign_of_fractions

__all__ = ["Meetings", "count_groups"]

# So many consecutive edges make a group, and after so many pairs of groups it is asked whether there is time left.
_GROUP = 8
_PAIRS = 4096
_FAR = float("inf")


class Meetings:
    """The pairs of edges of an outline that cross, and the points that lie on edges they do not belong to.

    Point i of the outline is where edge i starts.

    Parameters
    ----------
    step : callable
        Called now and then; it may raise.

    Attributes
    ----------
    crossings : Numbers
        Two for each pair of edges that cross: the lower edge, and twice the other one, and one more if that crosses
        from right to left.
    touches : Numbers
        Two for each contact, which may come several times: the point, and the edge.
    exact_signs : int
        How many signs took fractions.

    Notes
    -----
    Exact. O(n log n) for outlines whose edges do not crowd, and at most the number of pairs whose bounding boxes meet
    besides. Pairs of a strand that runs steadily in one direction, which cannot meet, are passed over.

    Examples
    --------
    >>> from array import array
    >>> eight, real, whole = Meetings(lambda: None), memoryview(array("d", [0.0] * 24)), array("q", [0] * 16)
    >>> eight.find(array("d", [0, 0, 2, 2, 2, 0, 0, 2]), array("q", [1, 2, 3, 0]), real, memoryview(whole))
    >>> eight.crossings.as_array().tolist(), eight.touches.size
    ([0, 5], 0)
    """

    def __init__(self, step: Callable[[], None]) -> None:
        self.step = step
        self.crossings, self.touches = Numbers(), Numbers()
        self.n = self.leaves = self.exact_signs = self.pairs = 0

    def find(self, points: RealBuffer, following: WholeBuffer, real: RealBuffer, whole: WholeBuffer) -> None:
        """Find all that meets.

        Parameters
        ----------
        points : buffer of 2n float
            The coordinates, point after point.
        following : buffer of n int
            Edge i runs from point i to point ``following[i]``.
        real, whole : buffer of float and int
            Room for 4n and eight numbers for each group of edges; for two for each group, and for crossings. See
            :func:`count_groups`.
        """
        self.n, self.following = len(following), following
        self.leaves = count_groups(self.n)
        self.ends, self.box = real[: 4 * self.n], real[4 * self.n : 4 * self.n + 8 * self.leaves]
        self.heading, rest = whole[: 2 * self.leaves], whole[2 * self.leaves :]
        self.crossings.begin(rest, len(rest))
        self._fill_edges(points)
        self._fill_groups()
        self._within(1)

    def _fill_edges(self, points: RealBuffer) -> None:
        """Note where each edge starts and ends."""
        for edge in range(self.n):
            end = self.following[edge]
            for axis in range(2):
                self.ends[4 * edge + axis] = points[2 * edge + axis]
                self.ends[4 * edge + 2 + axis] = points[2 * end + axis]

    # ---- groups: the root is 1, the halves of node i are 2i and 2i + 1 -----------------------------------------------

    def _fill_groups(self) -> None:
        """Find the box of each node, as low and high corner, and in which directions all its edges get ahead."""
        for node in range(2 * self.leaves - 1, 0, -1):
            if node >= self.leaves:
                self._fill_leaf(node)
            else:
                self._join(node)

    def _fill_leaf(self, node: int) -> None:
        box, ends = self.box, self.ends
        low_x, low_y, high_x, high_y, heading = _FAR, _FAR, -_FAR, -_FAR, 255
        start = _GROUP * (node - self.leaves)
        for edge in range(start, min(start + _GROUP, self.n)):
            x, y, end_x, end_y = ends[4 * edge], ends[4 * edge + 1], ends[4 * edge + 2], ends[4 * edge + 3]
            low_x, low_y = min(low_x, x, end_x), min(low_y, y, end_y)
            high_x, high_y = max(high_x, x, end_x), max(high_y, y, end_y)
            heading &= self._heading(edge)
        box[4 * node], box[4 * node + 1], box[4 * node + 2], box[4 * node + 3] = low_x, low_y, high_x, high_y
        self.heading[node] = heading

    def _heading(self, edge: int) -> int:
        """Return a bit for each of eight directions, those of the axes and the diagonals, in which an edge gets ahead.

        Groups with a bit in common that follow each other make one strand. There is none past the end of a loop.
        """
        if edge < self.n - 1 and self.following[edge] != edge + 1:
            return 0
        x, y, end_x, end_y = (
            self.ends[4 * edge],
            self.ends[4 * edge + 1],
            self.ends[4 * edge + 2],
            self.ends[4 * edge + 3],
        )
        along_axes = _way(x, end_x) + 4 * _way(y, end_y)
        # Rounding the sums keeps their order, or makes them equal.
        return along_axes + 16 * _way(x + y, end_x + end_y) + 64 * _way(x - y, end_x - end_y)

    def _join(self, node: int) -> None:
        one, other, here = 8 * node, 8 * node + 4, 4 * node
        for side in range(2):
            self.box[here + side] = min(self.box[one + side], self.box[other + side])
            self.box[here + 2 + side] = max(self.box[one + 2 + side], self.box[other + 2 + side])
        self.heading[node] = self.heading[2 * node] & self.heading[2 * node + 1]

    def _within(self, node: int) -> None:
        """Find what meets among the edges of a node."""
        is_steady = self.heading[node] != 0
        if node >= self.leaves and not is_steady:
            self._meet_edges(node, node)
        elif not is_steady:
            self._within(2 * node)
            self._within(2 * node + 1)
            self._between(2 * node, 2 * node + 1)

    def _between(self, node: int, other: int) -> None:
        """Find what meets between the edges of two nodes of one size, the lower one first."""
        apart = self._are_apart(node, other) or self._are_one_strand(node, other)
        if node >= self.leaves and not apart:
            self._meet_edges(node, other)
        elif not apart:
            for half in range(2):
                self._between(2 * node + half, 2 * other)
                self._between(2 * node + half, 2 * other + 1)

    def _are_apart(self, node: int, other: int) -> bool:
        one, two = 4 * node, 4 * other
        return (
            self.box[one] > self.box[two + 2]
            or self.box[two] > self.box[one + 2]
            or self.box[one + 1] > self.box[two + 3]
            or self.box[two + 1] > self.box[one + 3]
        )

    def _are_one_strand(self, node: int, other: int) -> bool:
        return other == node + 1 and self.heading[node] & self.heading[other] != 0

    # ---- edges -------------------------------------------------------------------------------------------------------

    def _meet_edges(self, node: int, other: int) -> None:
        """Find what meets between the edges of two leaves, or of one."""
        self.pairs += 1
        if self.pairs % _PAIRS == 0:
            self.step()
        start, start_other = _GROUP * (node - self.leaves), _GROUP * (other - self.leaves)
        stop_other = min(start_other + _GROUP, self.n)
        for edge in range(start, min(start + _GROUP, self.n)):
            self._meet_one(edge, other, max(start_other, edge + 1), stop_other)

    def _meet_one(self, edge: int, node: int, start: int, stop: int) -> None:
        """Find what meets between an edge and some edges of a leaf."""
        here = 4 * node
        x, y, end_x, end_y = (
            self.ends[4 * edge],
            self.ends[4 * edge + 1],
            self.ends[4 * edge + 2],
            self.ends[4 * edge + 3],
        )
        low_x, low_y, high_x, high_y = min(x, end_x), min(y, end_y), max(x, end_x), max(y, end_y)
        if (
            low_x > self.box[here + 2]
            or low_y > self.box[here + 3]
            or high_x < self.box[here]
            or high_y < self.box[here + 1]
        ):
            stop = start
        for other in range(start, stop):
            x, y, end_x, end_y = (
                self.ends[4 * other],
                self.ends[4 * other + 1],
                self.ends[4 * other + 2],
                self.ends[4 * other + 3],
            )
            if low_x > max(x, end_x) or low_y > max(y, end_y) or high_x < min(x, end_x) or high_y < min(y, end_y):
                continue
            # Neighbours need no look: where one runs back over the other, the edge beyond touches too.
            if self.following[edge] != other and self.following[other] != edge:
                self._meet(edge, other)

    def _meet(self, edge: int, other: int) -> None:
        """Note if two edges cross or touch."""
        start, end = self._side(edge, other, 0), self._side(edge, other, 2)
        # Edges keep apart if one of them lies on one side of the other.
        if start * end <= 0:
            start_edge, end_edge = self._side(other, edge, 0), self._side(other, edge, 2)
            if start * end < 0 and start_edge * end_edge < 0:
                self.crossings.append(edge)
                self.crossings.append(2 * other + 1 if end > 0 else 2 * other)
            if start * end * start_edge * end_edge == 0:
                self._touch(edge, other, start, 0)
                self._touch(edge, other, end, 2)
                self._touch(other, edge, start_edge, 0)
                self._touch(other, edge, end_edge, 2)

    def _side(self, edge: int, other: int, end: int) -> int:
        """Return on which side of an edge another one starts (``end`` 0) or ends (2)."""
        at = 4 * other + end
        x, y, end_x, end_y = (
            self.ends[4 * edge],
            self.ends[4 * edge + 1],
            self.ends[4 * edge + 2],
            self.ends[4 * edge + 3],
        )
        sign = quick_sign(x, y, end_x, end_y, x, y, self.ends[at], self.ends[at + 1])
        if sign > 1:
            self.exact_signs += 1
            return sign_of_fractions(x, y, end_x, end_y, x, y, self.ends[at], self.ends[at + 1])
        return sign

    def _touch(self, edge: int, other: int, side: int, end: int) -> None:
        """Note if an edge starts or ends on another one; ``side`` is where it does so, or 0 if on its line."""
        at = 4 * other + end
        is_between = _is_between(self.ends[4 * edge], self.ends[at], self.ends[4 * edge + 2])
        if (
            side == 0
            and is_between
            and _is_between(self.ends[4 * edge + 1], self.ends[at + 1], self.ends[4 * edge + 3])
        ):
            self.touches.append(other if end == 0 else self.following[other])
            self.touches.append(edge)


def count_groups(edges: int) -> int:
    """Return into how many groups so many edges are taken: a power of two.

    Examples
    --------
    >>> count_groups(3), count_groups(50)
    (1, 8)
    """
    groups = 1
    while groups * _GROUP < edges:
        groups *= 2
    return groups


def _way(start: float, end: float) -> int:
    """Return 1 if numbers grow, 2 if they fall, 0 if they stay."""
    return 1 if start < end else 2 if start > end else 0


def _is_between(start: float, number: float, end: float) -> bool:
    return min(start, end) <= number <= max(start, end)
