"""Several loops: which hang together by crossings, what lies on the left of each group, and how often they wind."""

from __future__ import annotations

from collections.abc import Callable

from plyfold.core.buffers import RealBuffer, WholeBuffer, real_room, whole_room
from plyfold.core.cells import representative
from plyfold.core.numbers import Numbers
from plyfold.core.signs import exact_sign

__all__ = ["Nesting"]

# So many consecutive edges make a leaf of the tree of boxes; after so many rays it is asked whether there is time left.
_GROUP = 8
_RAYS = 1024
_FAR = float("inf")
# 16 times the distance of 1 to the next double, and the least double that is not rounded off.
_PLACE_ERROR = 3.552713678800501e-15
_UNDERFLOW = 2.2250738585072014e-308


class Nesting:
    """How several loops in general position lie to each other.

    Loops that cross are a *group*. From the leftmost vertex of each group, the lowest one of several, a ray runs
    straight to the left, a little higher than the vertex: by less than any other difference in height. So it meets no
    vertices and no crossings.

    Parameters
    ----------
    points : buffer of 2n float
        Coordinates, point after point, loop after loop; or numbers in the same order, which tell no more than that.
    first_point, first_visit : buffers of loops + 1 int
        The first point and the first visit of each loop; last, how many there are.
    edge, partner : buffers of v int
        The edge that each visit to a crossing lies on, and the other visit to the same crossing.
    ccw : buffer of v bool
        Whether there the other strand crosses from right to left.
    step : callable
        Called now and then; it may raise.

    Attributes
    ----------
    corner : Numbers
        The leftmost vertex of each group, in the order of their first loops.
    leftmost, is_convex : buffers of loops int
        The leftmost vertex of each loop, and whether it turns left there, which :meth:`find_turns` tells or the caller.
    unsure : Numbers
        Two for each edge that a ray may meet first, where doubles leave that open: the ray, and the edge.
    """

    def __init__(
        self,
        points: RealBuffer,
        first_point: WholeBuffer,
        first_visit: WholeBuffer,
        edge: WholeBuffer,
        partner: WholeBuffer,
        ccw: WholeBuffer,
        step: Callable[[], None],
    ) -> None:
        self.points, self.first_point, self.first_visit = points, first_point, first_visit
        self.edge, self.partner, self.ccw, self.step = edge, partner, ccw, step
        self.n, self.loops = len(points) // 2, len(first_point) - 1
        self.loop, self.loop_of_visit = whole_room(self.n), whole_room(len(edge))
        self.group, self.leftmost = whole_room(self.loops), whole_room(self.loops)
        self.first_border, self.is_convex = whole_room(self.loops + 1), whole_room(self.loops)
        self.corner, self.unsure, self.near = Numbers(8), Numbers(8), Numbers(8)
        self._number_loops()
        self._find_groups()
        self._find_corners()

    def _number_loops(self) -> None:
        """Note the loop of each point and of each visit, and the first border of each loop."""
        for loop in range(self.loops):
            for point in range(self.first_point[loop], self.first_point[loop + 1]):
                self.loop[point] = loop
            for visit in range(self.first_visit[loop], self.first_visit[loop + 1]):
                self.loop_of_visit[visit] = loop
            visits = self.first_visit[loop + 1] - self.first_visit[loop]
            self.first_border[loop + 1] = self.first_border[loop] + (visits if visits > 0 else 1)

    def _find_groups(self) -> None:
        """Find the first loop of each group, which stands for it."""
        group = self.group
        for loop in range(self.loops):
            group[loop] = loop
        for visit in range(len(self.edge)):
            one = representative(group, self.loop_of_visit[visit])
            other = representative(group, self.loop_of_visit[self.partner[visit]])
            if one != other:
                group[max(one, other)] = min(one, other)
        for loop in range(self.loops):
            group[loop] = representative(group, loop)

    def _find_corners(self) -> None:
        """Find the leftmost vertex of each loop, and that of each group, which stays with its first loop."""
        furthest = whole_room(self.loops)
        for loop in range(self.loops):
            best = self.first_point[loop]
            for point in range(best + 1, self.first_point[loop + 1]):
                if self._is_further_left(point, best):
                    best = point
            self.leftmost[loop] = best
            group = self.group[loop]
            if group == loop or self._is_further_left(best, furthest[group]):
                furthest[group] = best
        for loop in range(self.loops):
            if self.group[loop] == loop:
                self.corner.append(furthest[loop])

    def _is_further_left(self, point: int, other: int) -> bool:
        x, other_x = self.points[2 * point], self.points[2 * other]
        return x < other_x or (x == other_x and self.points[2 * point + 1] < self.points[2 * other + 1])

    def _end(self, edge: int) -> int:
        """Return the point at which an edge ends."""
        loop = self.loop[edge]
        return edge + 1 if edge + 1 < self.first_point[loop + 1] else self.first_point[loop]

    def _before(self, point: int) -> int:
        """Return the point before another one along its loop."""
        loop = self.loop[point]
        return point - 1 if point > self.first_point[loop] else self.first_point[loop + 1] - 1

    # ---- rays: the root of the tree of boxes is 1, the halves of node i are 2i and 2i + 1 ---------------------------

    def meet(self, corner: WholeBuffer, is_rounded: int, met: WholeBuffer) -> None:
        """Find which edge of another group the ray from each of some corners meets first: −1 for none or unsure.

        ``is_rounded`` is 0 where coordinates are no more than numbers in the same order.
        """
        self.is_rounded = is_rounded
        self._fill_boxes()
        for ray in range(len(corner)):
            if ray % _RAYS == 0:
                self.step()
            here = corner[ray]
            self.x, self.y, self.least = self.points[2 * here], self.points[2 * here + 1], -_FAR
            self.own = self.group[self.loop[here]]
            self.near.size = 0
            self._look(1)
            met[ray] = self._first(ray)

    def _fill_boxes(self) -> None:
        """Find the box of each node: its lowest and highest, its leftmost and rightmost coordinate."""
        self.leaves = 1
        while self.leaves * _GROUP < self.n:
            self.leaves *= 2
        self.box = real_room(8 * self.leaves)
        for node in range(2 * self.leaves - 1, 0, -1):
            if node >= self.leaves:
                self._fill_leaf(node)
            else:
                self._join_boxes(node)

    def _fill_leaf(self, node: int) -> None:
        low_x, low_y, high_x, high_y = _FAR, _FAR, -_FAR, -_FAR
        start = _GROUP * (node - self.leaves)
        for edge in range(start, min(start + _GROUP, self.n)):
            end = self._end(edge)
            x, y, end_x, end_y = (
                self.points[2 * edge],
                self.points[2 * edge + 1],
                self.points[2 * end],
                self.points[2 * end + 1],
            )
            low_x, low_y = min(low_x, x, end_x), min(low_y, y, end_y)
            high_x, high_y = max(high_x, x, end_x), max(high_y, y, end_y)
        self._put_box(node, low_x, low_y, high_x, high_y)

    def _join_boxes(self, node: int) -> None:
        box, one, other = self.box, 8 * node, 8 * node + 4
        self._put_box(
            node,
            min(box[one], box[other]),
            min(box[one + 1], box[other + 1]),
            max(box[one + 2], box[other + 2]),
            max(box[one + 3], box[other + 3]),
        )

    def _put_box(self, node: int, low_x: float, low_y: float, high_x: float, high_y: float) -> None:
        box = self.box
        box[4 * node], box[4 * node + 1], box[4 * node + 2], box[4 * node + 3] = low_x, low_y, high_x, high_y

    def _look(self, node: int) -> None:
        """Look for edges that the ray may meet first among those of a node, in the further right half first."""
        box, at = self.box, 4 * node
        if box[at] < self.x and box[at + 2] >= self.least and box[at + 1] <= self.y < box[at + 3]:
            if node >= self.leaves:
                start = _GROUP * (node - self.leaves)
                for edge in range(start, min(start + _GROUP, self.n)):
                    self._pass_edge(edge)
            else:
                first = 2 * node if box[8 * node + 2] > box[8 * node + 6] else 2 * node + 1
                self._look(first)
                self._look(4 * node + 1 - first)

    def _pass_edge(self, edge: int) -> None:
        """Note an edge of another group that the ray may meet first, and about where it surely meets one."""
        is_low, is_low_end = self.points[2 * edge + 1] <= self.y, self.points[2 * self._end(edge) + 1] <= self.y
        if is_low != is_low_end and self.group[self.loop[edge]] != self.own:
            self._find_span(edge)
            if not (self.low >= self.x or self.high < self.least):
                self.near.append(edge)
                if self.high < self.x:
                    self.least = max(self.least, self.low)

    def _find_span(self, edge: int) -> None:
        """Find between which places an edge passes the height of the ray."""
        end = self._end(edge)
        x, y, end_x, end_y = (
            self.points[2 * edge],
            self.points[2 * edge + 1],
            self.points[2 * end],
            self.points[2 * end + 1],
        )
        if self.is_rounded:
            place = x + (self.y - y) / (end_y - y) * (end_x - x)
            error = _PLACE_ERROR * (abs(x) + abs(end_x)) + _UNDERFLOW
            self.low, self.high = place - error, place + error
        else:
            self.low, self.high = min(x, end_x), max(x, end_x)

    def _first(self, ray: int) -> int:
        """Return the edge that the ray meets first, or −1; and note those among which that is unsure."""
        count, first, is_sure = 0, -1, False
        for at in range(self.near.size):
            self._find_span(self.near.data[at])
            if not self.high < self.least:
                count += 1
                first, is_sure = self.near.data[at], self.high < self.x
        if count == 0 or (count == 1 and is_sure):
            return first
        for at in range(self.near.size):
            self._find_span(self.near.data[at])
            if not self.high < self.least:
                self.unsure.append(ray)
                self.unsure.append(self.near.data[at])
        return -1

    # ---- borders, windings and turns ---------------------------------------------------------------------------------

    def find_turns(self) -> None:
        """Find whether each loop turns left at its leftmost vertex, by coordinates."""
        points = self.points
        for loop in range(self.loops):
            here = self.leftmost[loop]
            start, end = self._before(here), self._end(here)
            x, y = points[2 * here], points[2 * here + 1]
            sign = exact_sign(
                points[2 * start], points[2 * start + 1], x, y, x, y, points[2 * end], points[2 * end + 1]
            )
            self.is_convex[loop] = 1 if sign > 0 else 0

    def join(
        self,
        corner: WholeBuffer,
        met: WholeBuffer,
        passed: WholeBuffer,
        dart: WholeBuffer,
        beyond: WholeBuffer,
        left: WholeBuffer,
    ) -> None:
        """Find darts at both ends of the rays, with the cell between them on their left, and the winding numbers.

        Parameters
        ----------
        corner, met : buffer of g int
            The corners of all groups from left to right, and the edges that their rays meet, or −1.
        passed : buffer of g int
            How many visits come before those places, on earlier loops too.
        dart, beyond : buffer of g int
            Room for the darts at the corners, and for those met, or −1.
        left : buffer of int
            Room for the winding number on the left of each border.
        """
        self.is_known, self.stack = whole_room(self.loops), whole_room(self.loops)
        self._wind_along(left)
        for ray in range(len(corner)):
            loop = self.loop[corner[ray]]
            dart[ray] = 2 * self._border(loop, self._visits_before(corner[ray])) + self.is_convex[loop]
            beyond[ray], level = -1, 0
            if met[ray] >= 0:
                border = self._border(self.loop[met[ray]], passed[ray])
                is_upward = self.points[2 * met[ray] + 1] < self.points[2 * self._end(met[ray]) + 1]
                beyond[ray] = 2 * border + (1 if is_upward else 0)
                level = left[border] - (1 if is_upward else 0)
            self._wind_group(loop, level + self.is_convex[loop] - left[dart[ray] // 2], left)

    def _visits_before(self, point: int) -> int:
        """Return how many visits lie on edges before a point."""
        low, high = 0, len(self.edge)
        while low < high:
            middle = (low + high) // 2
            if self.edge[middle] < point:
                low = middle + 1
            else:
                high = middle
        return low

    def _border(self, loop: int, passed: int) -> int:
        """Return the border at a place on a loop, given how many visits come before it, on earlier loops too."""
        start, end = self.first_visit[loop], self.first_visit[loop + 1]
        if end == start:
            return self.first_border[loop]
        return self.first_border[loop] + (end if passed == start else passed) - start - 1

    def _after(self, visit: int) -> int:
        """Return the border that starts at a visit."""
        loop = self.loop_of_visit[visit]
        return self.first_border[loop] + visit - self.first_visit[loop]

    def _wind_along(self, left: WholeBuffer) -> None:
        """Find the winding numbers along each loop, less that of its first border."""
        for loop in range(self.loops):
            height = left[self.first_border[loop]] = 0
            for visit in range(self.first_visit[loop] + 1, self.first_visit[loop + 1]):
                height += -1 if self.ccw[visit] else 1
                left[self._after(visit)] = height

    def _wind_group(self, loop: int, height: int, left: WholeBuffer) -> None:
        """Make the winding numbers along a loop so much higher, and those of its group such that they agree with it."""
        self.is_known[loop] = 1
        self._raise(loop, height, left)
        waiting = 1
        self.stack[0] = loop
        while waiting > 0:
            waiting -= 1
            here = self.stack[waiting]
            for visit in range(self.first_visit[here], self.first_visit[here + 1]):
                partner = self.partner[visit]
                other = self.loop_of_visit[partner]
                if self.is_known[other] == 0:
                    self.is_known[other] = 1
                    self._raise(other, self._rise(visit, partner, left), left)
                    self.stack[waiting] = other
                    waiting += 1

    def _raise(self, loop: int, height: int, left: WholeBuffer) -> None:
        for border in range(self.first_border[loop], self.first_border[loop + 1]):
            left[border] += height

    def _rise(self, visit: int, partner: int, left: WholeBuffer) -> int:
        """Return how much higher the loop of a partner is: the highest cell at a crossing is left of both strands."""
        if self.ccw[visit]:
            return left[self._border_before(visit)] - left[self._after(partner)]
        return left[self._after(visit)] - left[self._border_before(partner)]

    def _border_before(self, visit: int) -> int:
        """Return the border that ends at a visit."""
        return self._border(self.loop_of_visit[visit], visit)

    def count_turns(self, turning: WholeBuffer) -> None:
        """Count how often each loop turns round, see `core.direction`."""
        for loop in range(self.loops):
            start, end = self.first_visit[loop], self.first_visit[loop + 1]
            begin = self._visits_before(self.leftmost[loop])
            total = 1 if self.is_convex[loop] else -1
            for visit in range(start, end):
                partner = self.partner[visit]
                is_early, is_late = visit >= begin, partner >= begin
                # On from the leftmost vertex, the visits behind it come before those from the loop's first point on.
                is_first = visit < partner if is_early == is_late else is_early
                if is_first and self.loop_of_visit[partner] == loop:
                    total += -1 if self.ccw[visit] else 1
            turning[loop] = total
