"""Several loops: which hang together by crossings, what lies on the left of each group, and how often they wind."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from plyfold.core.buffers import RealBuffer, WholeBuffer, real_room, whole_room
from plyfold.core.cells import follow_darts, root_of
from plyfold.core.numbers import Numbers
from plyfold.core.signs import exact_sign, rest_of_difference, rest_of_product

__all__ = ["Bridges", "Nesting", "share_along", "share_of_fractions"]

# So many consecutive edges make a leaf of the tree of boxes; after so many rays it is asked whether there is time left.
_GROUP = 32
_RAYS = 1024
_FAR = float("inf")
# 16 times the distance of 1 to the next double, and the least double that is not rounded off.
_PLACE_ERROR = 3.552713678800501e-15
_UNDERFLOW = 2.2250738585072014e-308
# Between these sizes nothing over- or underflows in a quotient of differences, nor in what is left over.
_LEAST, _LARGEST = 1e-130, 1e130
# More than 24 times the square of half the distance of 1 to the next double.
_SHARE_ERROR = 1e-30


class Bridges:
    """Room for the bridges between loops.

    Parameters
    ----------
    bridges : int
        How many rays meet something.
    dart, beyond, is_bounded : buffer of g int
        For each ray the dart at its corner and the one met, or −1, and whether the cell between them is bounded.
    left : buffer of int
        The winding number on the left of each border.
    whole : buffer of 4 · 2 · bridges int
        The edges of the feet of bridges, what comes first at one place, the visits before which they come, and the
        loops: of all feet at corners, and then of those on edges that are met. See `arrangement.marks.Marks`.
    real : buffer of 3 · 2 · bridges float
        How far along its edge each foot is; and its coordinates, foot after foot.
    """

    def __init__(
        self,
        bridges: int,
        dart: WholeBuffer,
        beyond: WholeBuffer,
        is_bounded: WholeBuffer,
        left: WholeBuffer,
        whole: WholeBuffer,
        real: RealBuffer,
    ) -> None:
        self.bridges, self.count = bridges, 0
        self.dart, self.beyond, self.is_bounded, self.left = dart, beyond, is_bounded, left
        self.whole, self.real = whole, real

    def put(self, foot: int, edge: int, along: float, tie: int, at: int, loop: int, x: float, y: float) -> None:
        """Write down a foot."""
        feet = 2 * self.bridges
        self.whole[foot], self.whole[feet + foot] = edge, tie
        self.whole[2 * feet + foot], self.whole[3 * feet + foot] = at, loop
        self.real[foot] = along
        self.real[feet + 2 * foot], self.real[feet + 2 * foot + 1] = x, y


def share_along(start: float, end: float, between: float) -> float:
    """Return how far a number lies between two others, to the nearest double.

    The quotient of the rounded differences is put right by what is left over. Where that might be rounded either way,
    fractions tell.

    Examples
    --------
    >>> share_along(1.0, 4.0, 2.0)
    0.3333333333333333
    """
    above, below = between - start, end - start
    if _LEAST < abs(above) < _LARGEST and _LEAST < abs(below) < _LARGEST:
        share = above / below
        left_over = (above - share * below) - rest_of_product(share, below)
        more = (left_over + (rest_of_difference(start, between) - share * rest_of_difference(start, end))) / below
        unsure = _SHARE_ERROR * abs(share)
        if share + (more - unsure) == share + (more + unsure):
            return share + more
    return share_of_fractions(Fraction(start), Fraction(end), Fraction(between))


def share_of_fractions(start: Fraction, end: Fraction, between: Fraction) -> float:
    """Return the same of fractions."""
    return float((between - start) / (end - start))


class Nesting:
    """How several loops in general position lie to each other.

    Loops that cross are a *group*. From the leftmost vertex of each group, the lowest one of several, a ray runs
    straight to the left, a little higher than the vertex: by less than any other difference in height. So it meets no
    vertices and no crossings.

    Parameters
    ----------
    step : callable
        Called now and then; it may raise.
    points : buffer of 2n float
        Coordinates, point after point, loop after loop; or numbers in the same order, which tell no more than that.
    first_point, first_visit : buffers of loops + 1 int
        The first point and the first visit of each loop; last, how many there are.
    edge, partner : buffers of v int
        The edge that each visit to a crossing lies on, and the other visit to the same crossing.
    ccw : buffer of v bool
        Whether there the other strand crosses from right to left.

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
        step: Callable[[], None],
        points: RealBuffer,
        first_point: WholeBuffer,
        first_visit: WholeBuffer,
        edge: WholeBuffer,
        partner: WholeBuffer,
        ccw: WholeBuffer,
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
            one = root_of(group, self.loop_of_visit[visit])
            other = root_of(group, self.loop_of_visit[self.partner[visit]])
            if one != other:
                group[max(one, other)] = min(one, other)
        for loop in range(self.loops):
            group[loop] = root_of(group, loop)

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
        """Find the box of each node: its left, lower, right and upper side.

        Each half of a node has the groups of edges whose boxes lie further left, or lower, in turn (a k-d tree).
        """
        self.groups, self.leaves = (self.n + _GROUP - 1) // _GROUP, 1
        while self.leaves < self.groups:
            self.leaves *= 2
        self.box, self.side = real_room(8 * self.leaves), real_room(4 * self.groups)
        self.order = whole_room(self.groups)
        for group in range(self.groups):
            self.order[group] = group
            self._fill_group(group)
        self._halve(0, self.leaves, 0)
        for node in range(2 * self.leaves - 1, 0, -1):
            if node < self.leaves:
                self._join_boxes(node)
            elif node < self.leaves + self.groups:
                at = 4 * self.order[node - self.leaves]
                self._put_box(node, self.side[at], self.side[at + 1], self.side[at + 2], self.side[at + 3])
            else:
                self._put_box(node, _FAR, _FAR, -_FAR, -_FAR)

    def _fill_group(self, group: int) -> None:
        """Find the sides of the box of consecutive edges."""
        low_x, low_y, high_x, high_y = _FAR, _FAR, -_FAR, -_FAR
        start = _GROUP * group
        for edge in range(start, min(start + _GROUP, self.n)):
            end = self._end(edge)
            x, y = self.points[2 * edge], self.points[2 * edge + 1]
            end_x, end_y = self.points[2 * end], self.points[2 * end + 1]
            low_x, low_y = min(low_x, x, end_x), min(low_y, y, end_y)
            high_x, high_y = max(high_x, x, end_x), max(high_y, y, end_y)
        side, at = self.side, 4 * group
        side[at], side[at + 1], side[at + 2], side[at + 3] = low_x, low_y, high_x, high_y

    def _halve(self, low: int, high: int, axis: int) -> None:
        """Sort groups of edges in some places into halves along an axis, and those along the other one."""
        if high - low > 1:
            middle = (low + high) // 2
            if middle < self.groups:
                self._select(low, min(high, self.groups) - 1, middle, axis)
                self._halve(middle, high, 1 - axis)
            self._halve(low, middle, 1 - axis)

    def _select(self, low: int, high: int, place: int, axis: int) -> None:
        """Sort groups in some places until none before one place lies further along than those from it on (Hoare)."""
        order = self.order
        while low < high:
            pivot = self._along(order[(low + high) // 2], axis)
            up, down = low, high
            while up <= down:
                while self._along(order[up], axis) < pivot:
                    up += 1
                while self._along(order[down], axis) > pivot:
                    down -= 1
                if up <= down:
                    order[up], order[down] = order[down], order[up]
                    up, down = up + 1, down - 1
            if place <= down:
                high = down
            elif place >= up:
                low = up
            else:
                low = high

    def _along(self, group: int, axis: int) -> float:
        """Return half of about how far along an axis the box of a group lies: nothing overflows."""
        return self.side[4 * group + axis] / 4 + self.side[4 * group + 2 + axis] / 4

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
                start = _GROUP * self.order[node - self.leaves]
                for edge in range(start, min(start + _GROUP, self.n)):
                    self._pass_edge(edge)
            else:
                first = 2 * node if self._is_nearer(8 * node, 8 * node + 4) else 2 * node + 1
                self._look(first)
                self._look(4 * node + 1 - first)

    def _is_nearer(self, one: int, other: int) -> bool:
        """Tell which of two boxes is to be looked at first: what of it is on the left reaches or begins further."""
        here, there = min(self.box[one + 2], self.x), min(self.box[other + 2], self.x)
        return here > there or (here == there and self.box[one] > self.box[other])

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
        self, found: Bridges, following: WholeBuffer, corner: WholeBuffer, met: WholeBuffer, passed: WholeBuffer
    ) -> None:
        """Find the winding numbers, and the bridges where rays meet something.

        Parameters
        ----------
        found : Bridges
            Room for what is found.
        following : buffer of int
            Room for the dart that follows each around the cell on its left.
        corner, met : buffer of g int
            The corners of all groups from left to right, and the edges that their rays meet, or −1.
        passed : buffer of g int
            How many visits come before those places, on earlier loops too.
        """
        self.is_known, self.stack, self.outer = (
            whole_room(self.loops),
            whole_room(self.loops),
            whole_room(len(following)),
        )
        follow_darts(self.partner, self.ccw, self.first_visit, following, whole_room(2 * len(self.partner)))
        self._wind_along(found.left)
        for ray in range(len(corner)):
            loop = self.loop[corner[ray]]
            visits = self._visits_before(corner[ray])
            dart = 2 * self._border(loop, visits) + self.is_convex[loop]
            beyond, level = -1, 0
            if met[ray] >= 0:
                beyond = 2 * self._border(self.loop[met[ray]], passed[ray]) + self._is_upward(met[ray])
                level = found.left[beyond // 2] - beyond % 2
                self._put_feet(found, ray, corner[ray], visits, met[ray], passed[ray])
            found.dart[ray], found.beyond[ray] = dart, beyond
            self._wind_group(loop, level + self.is_convex[loop] - found.left[dart // 2], found.left)
            found.is_bounded[ray] = 0
            if beyond >= 0:
                around = self.outer[beyond]
                found.is_bounded[ray] = 1 if around == 0 else found.is_bounded[around - 1]
            self._go_round(dart, ray + 1, following)

    def _is_upward(self, edge: int) -> int:
        """Return 1 if an edge ends higher than it starts, and 0 otherwise."""
        return 1 if self.points[2 * edge + 1] < self.points[2 * self._end(edge) + 1] else 0

    def _go_round(self, dart: int, group: int, following: WholeBuffer) -> None:
        """Note that darts go round the outside of a group, from one of them on."""
        while self.outer[dart] == 0:
            self.outer[dart] = group
            dart = following[dart]

    def _put_feet(self, found: Bridges, ray: int, corner: int, visits: int, edge: int, passed: int) -> None:
        """Write down both ends of a bridge; of several at one height, those from further right pass above."""
        upward, end, there = 2 * self._is_upward(edge) - 1, self._end(edge), found.bridges + found.count
        x, y = self.points[2 * corner], self.points[2 * corner + 1]
        start_x, end_x = self.points[2 * edge], self.points[2 * end]
        share = share_along(self.points[2 * edge + 1], self.points[2 * end + 1], y) if self.is_rounded else 0.5
        found.put(found.count, corner, -_FAR, 1, visits, self.loop[corner], x, y)
        found.put(
            there, edge, upward * y, upward * (2 + ray), passed, self.loop[edge], start_x + share * (end_x - start_x), y
        )
        found.count += 1

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
