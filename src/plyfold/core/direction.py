"""Which way a curve runs: where the unbounded cell is, how often it turns and winds, and whether it is turned round."""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer, WholeBuffer
from plyfold.core.signs import exact_sign

__all__ = ["CurveDirection", "outer_dart_of_points"]


def outer_dart_of_points(points: RealBuffer, visit_edge: WholeBuffer) -> int:
    """Return a dart with the unbounded cell on its left: at the leftmost vertex, on its convex side.

    Parameters
    ----------
    points : buffer of 2n float
        Of one curve.
    visit_edge : buffer of int
        The edge that each visit lies on, in order.

    Examples
    --------
    >>> from array import array
    >>> outer_dart_of_points(array("d", [0, 0, 1, 0, 0, 1]), array("q"))
    1
    """
    n, corner = len(points) // 2, 0
    for point in range(1, n):
        x, y = points[2 * point], points[2 * point + 1]
        if x < points[2 * corner] or (x == points[2 * corner] and y < points[2 * corner + 1]):
            corner = point
    before = corner - 1 if corner > 0 else n - 1
    after = corner + 1 if corner < n - 1 else 0
    x, y = points[2 * corner], points[2 * corner + 1]
    turn = exact_sign(points[2 * before], points[2 * before + 1], x, y, x, y, points[2 * after], points[2 * after + 1])
    return 2 * _border_at(visit_edge, corner) + (1 if turn > 0 else 0)


def _border_at(visit_edge: WholeBuffer, point: int) -> int:
    """Return the border that a point lies on: it starts at the last visit before the point."""
    low, high = 0, len(visit_edge)
    while low < high:
        middle = (low + high) // 2
        if visit_edge[middle] < point:
            low = middle + 1
        else:
            high = middle
    return low - 1 if low > 0 else max(len(visit_edge), 1) - 1


class CurveDirection:
    """The code of one curve in the direction in which it is used.

    Attributes
    ----------
    outer : int
        A dart of the unbounded cell.
    turning : int
        The turning number.
    lowest : int
        The lowest winding number on the left of a border.
    turned_round : bool
        Whether the code was turned round.
    """

    def __init__(self) -> None:
        self.outer = self.turning = self.lowest = 0
        self.turned_round = False

    def settle(self, partner: WholeBuffer, ccw: WholeBuffer, outer: int, is_directed: bool, left: WholeBuffer) -> None:
        """Find the winding number left of each border, and turn the code round if no surface lies on its left.

        That is done, if its direction is not settled, if it makes all winding numbers positive; if nothing does, for
        a positive turning number.

        Parameters
        ----------
        partner, ccw : buffer of int and of bool
            The code, which is turned round in place.
        outer : int
        is_directed : bool
            Whether its direction is settled.
        left : buffer of int
            Room for the winding number of each border.

        Examples
        --------
        >>> from array import array
        >>> triangle, left = CurveDirection(), array("q", [0])
        >>> _ = triangle.settle(array("q"), array("B"), 0, False, left)
        >>> triangle.turning, triangle.turned_round, triangle.outer, left.tolist()
        (1, True, 1, [1])
        """
        self.outer, self.turned_round = outer, False
        self.turning = _whitney_turning_number(partner, ccw, outer)
        highest = self._wind(ccw, left)
        self.turned_round = not (is_directed or self.lowest > 0 or (self.turning >= 0 and highest > 0))
        if self.turned_round:
            self._turn_round(partner, ccw)
            self._wind(ccw, left)

    def _wind(self, ccw: WholeBuffer, left: WholeBuffer) -> int:
        """Find the winding number on the left of each border; return the highest.

        Past a crossing the curve leaves the left side of the other strand if that one crosses from right to left (one
        less), and enters it otherwise (one more).
        """
        border, winding = self.outer // 2, 0
        highest = left[border] = self.lowest = self.outer % 2
        winding = highest
        for step in range(1, len(ccw)):
            at = border + step if border + step < len(ccw) else border + step - len(ccw)
            winding += -1 if ccw[at] else 1
            left[at] = winding
            self.lowest, highest = min(self.lowest, winding), max(highest, winding)
        return highest

    def _turn_round(self, partner: WholeBuffer, ccw: WholeBuffer) -> None:
        """Run a code the other way, from the same starting point."""
        n = len(partner)
        for one in range((n + 1) // 2):
            other = n - 1 - one
            partner[one], partner[other] = n - 1 - partner[other], n - 1 - partner[one]
            ccw[one], ccw[other] = ccw[other], ccw[one]
        border = (2 * n - 2 - self.outer // 2) % n if n > 0 else 0
        self.outer, self.turning = 2 * border + 1 - self.outer % 2, -self.turning


def _whitney_turning_number(partner: WholeBuffer, ccw: WholeBuffer, outer: int) -> int:
    """Return the turning number from the crossings alone.

    Start on a border of the unbounded cell. With that cell on the right, each crossing counts −1 if the strand met
    first is crossed from right to left, +1 otherwise, and τ is one more than the sum; with that cell on the left,
    everything is mirrored [Whi37]_.

    References
    ----------
    .. [Whi37] H. Whitney, "On regular closed curves in the plane", Compositio Mathematica 4, 1937.
    """
    n, first, total = len(partner), outer // 2 + 1, 0
    for visit in range(n):
        since, other = visit - first, partner[visit] - first
        since = since if since >= 0 else since + n
        other = other if other >= 0 else other + n
        if since < other:
            total += -1 if ccw[visit] else 1
    return total + 1 if outer % 2 else total - 1
