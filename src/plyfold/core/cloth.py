"""From the points of a closed curve to the triangles of the disk that it bounds, with no value between.

The stages are those that values are made by: verdict, sewing, sweep. Where one of them meets with something that takes
more than its loops, nothing is told.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from plyfold.core.buffers import RealBuffer, WholeBuffer, short_room
from plyfold.core.sewing import BorderSeams, Crossings, NamedTree, sew
from plyfold.core.sweep import Drawing, sweep_over
from plyfold.core.turns import ExactPoints
from plyfold.core.verdict import YES, PlainCurve
from plyfold.predicates import Place, exact_cross

__all__ = ["CLOCKWISE", "UNTOLD", "cut_into_triangles"]

UNTOLD, CLOCKWISE = -1, -2
_UNTOLD, _CLOCKWISE, _YES = UNTOLD, CLOCKWISE, YES
# The line that sweeps is tilted so much, and the rounding error of x + tilt · y less than this part of the two.
_TILT = 0.3
_ERROR = 1e-15
# See `predicates.parameter_along_edge`.
_PARAMETER_ERROR = 4e-15
_UNDERFLOW = 1e-290
_TINY_PRODUCT = 1e-250
_FAR = float("inf")
# More sheets at borders than this are for values, which see to memory.
_MOST_SEAMS = 10_000_000


class CutDisk:
    """A disk with one curve as its boundary, stage by stage."""

    def __init__(self, curve: PlainCurve) -> None:
        self.curve = curve
        self.points = self.curve.points
        self.n, self.k = self.curve.n, self.curve.k
        self.borders, self.cells = self.curve.borders, self.curve.cells
        self.sheets = self.highest = self.seams = self.events = 0

    # ---- sheets ------------------------------------------------------------------------------------------------------

    def count_sheets(self) -> int:
        """Give numbers to the sheets and the seams; return how many seams there are."""
        curve = self.curve
        self.first_sheet, self.start = self.curve.take_whole(self.cells), self.curve.take_whole(self.borders + 1)
        for cell in range(self.cells):
            self.first_sheet[cell] = self.sheets
            self.sheets += curve.winding[cell]
            self.highest = max(self.highest, curve.winding[cell])
        for border in range(self.borders):
            self.start[border] = self.seams
            self.seams += curve.left[border] - 1
        self.start[self.borders] = self.seams
        return self.seams

    def sew(self) -> None:
        """Sew the sheets together as the grouping says."""
        shorts = short_room(self.seams + self.sheets + self.highest + 1)
        self.upper, self.own = shorts[: self.seams], self.curve.take_whole(self.borders)
        self.names, self.scratch = shorts[self.seams : self.seams + self.sheets], shorts[self.seams + self.sheets :]
        seams = BorderSeams.__new__(BorderSeams)
        seams.start, seams.upper, seams.own = self.start, self.upper, self.own
        sew(self._named_tree(), self._crossings(), seams)

    def _named_tree(self) -> NamedTree:
        curve, named = self.curve, NamedTree.__new__(NamedTree)
        named.parent, named.link = curve.tree.parent, curve.tree.link
        named.winding, named.first_sheet = curve.winding, self.first_sheet
        named.name, named.waiting = self.names, self.curve.take_whole(self.cells)
        self.joined, self.is_named = self.curve.take_whole(self.cells), self.curve.take_whole(self.cells)
        for cell in range(self.cells):
            self.joined[cell], self.is_named[cell] = -1, 0
        self.is_named[0] = 1
        for label in range(curve.word.labels):
            self.joined[curve.word.cells[label]] = curve.word.border[curve.propagation.chosen[label]]
        named.partner, named.named = self.joined, self.is_named
        return named

    def _crossings(self) -> Crossings:
        crossings = Crossings.__new__(Crossings)
        self.around, self.at_start, self.at_end = (
            self.curve.take_whole(4 * self.k),
            self._border_row(),
            self._border_row(),
        )
        self.unknown, self.sum_unknown, self.off_tree = (
            self.curve.take_whole(self.k),
            self.curve.take_whole(self.k),
            self._border_row(),
        )
        self._find_corners()
        self._count_unknown()
        crossings.around, crossings.at_start, crossings.at_end = self.around, self.at_start, self.at_end
        crossings.unknown, crossings.sum_unknown = self.unknown, self.sum_unknown
        crossings.ready, crossings.scratch = self.curve.take_whole(2 * self.k), self.scratch
        return crossings

    def _border_row(self) -> WholeBuffer:
        return self.curve.take_whole(self.borders)

    def _find_corners(self) -> None:
        """Find the four borders around each crossing, see `immersion.corners`."""
        last, crossing = self.borders - 1, 0
        for a in range(2 * self.k):
            if self.curve.ccw[a]:
                b, at = self.curve.partner[a], 4 * crossing
                self.around[at], self.around[at + 1] = a - 1 if a > 0 else last, a
                self.around[at + 2], self.around[at + 3] = b, b - 1 if b > 0 else last
                for corner in range(4):
                    border = self.around[at + corner]
                    if corner in (1, 2):
                        self.at_start[border] = crossing
                    else:
                        self.at_end[border] = crossing
                crossing += 1

    def _count_unknown(self) -> None:
        """Count the borders around each crossing that are not in the dual tree, and add up their numbers."""
        for border in range(self.borders):
            self.off_tree[border] = 1
        for cell in range(1, self.cells):
            self.off_tree[self.curve.tree.link[cell]] = 0
        for crossing in range(self.k):
            self.unknown[crossing] = self.sum_unknown[crossing] = 0
            for corner in range(4 * crossing, 4 * crossing + 4):
                if self.off_tree[self.around[corner]]:
                    self.unknown[crossing] += 1
                    self.sum_unknown[crossing] += self.around[corner]

    # ---- the sweep ---------------------------------------------------------------------------------------------------

    def find_order(self) -> None:
        """Find the order in which a line comes to vertices and crossings, exactly, see `sweep_order`."""
        curve, n = self.curve, self.n
        size = n + self.k
        self.reach, self.error, self.order = (
            self.curve.take_real(size),
            self.curve.take_real(size),
            self.curve.take_whole(size),
        )
        self.event, self.rank = self.curve.take_whole(size), self.curve.take_whole(n + 2 * self.k)
        for point in range(n):
            x, tilted = self.points[2 * point], _TILT * self.points[2 * point + 1]
            self._note(point, x + tilted, _ERROR * (abs(x) + abs(tilted)))
        self.events = n
        for visit in range(2 * self.k):
            if visit < curve.partner[visit]:
                self._find_reach(visit, curve.visit_edge[visit], curve.visit_edge[curve.partner[visit]])
                self.event[self.events] = n + visit
                self.events += 1
        self._sort()
        self._settle()

    def _note(self, event: int, reach: float, error: float) -> None:
        self.reach[event], self.error[event], self.event[event], self.order[event] = reach, error, event, event

    def _find_reach(self, visit: int, edge: int, other: int) -> None:
        """Find how far the line has come where two edges cross, and how wrong that may be."""
        n = self.n
        end, other_end = edge + 1 if edge < n - 1 else 0, other + 1 if other < n - 1 else 0
        across_x = self.points[2 * other_end] - self.points[2 * other]
        across_y = self.points[2 * other_end + 1] - self.points[2 * other + 1]
        x, y = self.points[2 * other] - self.points[2 * edge], self.points[2 * other + 1] - self.points[2 * edge + 1]
        above, above_minus = x * across_y, y * across_x
        x, y = self.points[2 * end] - self.points[2 * edge], self.points[2 * end + 1] - self.points[2 * edge + 1]
        below, below_minus = x * across_y, y * across_x
        below_size = abs(below) + abs(below_minus) + _UNDERFLOW
        size = abs(above) + abs(above_minus) + _UNDERFLOW + 2 * below_size
        # What is not known is settled exactly.
        unsure, parameter = 1e300, 0.5
        if below != below_minus and below_size >= _TINY_PRODUCT:
            unsure = _PARAMETER_ERROR * size / abs(below - below_minus)
            parameter = min(max((above - above_minus) / (below - below_minus), 0.0), 1.0)
        along = self.reach[end] - self.reach[edge]
        error = unsure * abs(along) + 3 * (self.error[edge] + self.error[end])
        self._note(self.events, self.reach[edge] + parameter * along, error)

    def _sort(self) -> None:
        """Sort events by reach: a heap of the furthest ones is built, and emptied."""
        size = self.events
        for place in range(size // 2 - 1, -1, -1):
            self._sink(place, size)
        for last in range(size - 1, 0, -1):
            self.order[0], self.order[last] = self.order[last], self.order[0]
            self._sink(0, last)

    def _sink(self, place: int, size: int) -> None:
        """Let an event sink in the heap below those that are further."""
        event = self.order[place]
        child = 2 * place + 1
        while child < size:
            if child + 1 < size and self.reach[self.order[child + 1]] > self.reach[self.order[child]]:
                child += 1
            if not self.reach[self.order[child]] > self.reach[event]:
                child = size
            else:
                self.order[place] = self.order[child]
                place, child = child, 2 * child + 1
        self.order[place] = event

    def _settle(self) -> None:
        """Sort runs of events again whose order rounding leaves open."""
        size, nearest, furthest, start = self.events, _FAR, -_FAR, 0
        self.nearest = self.curve.take_real(size + 1)
        self.nearest[size] = _FAR
        for place in range(size - 1, -1, -1):
            nearest = min(nearest, self.reach[self.order[place]] - self.error[self.order[place]])
            self.nearest[place] = nearest
        for place in range(size):
            furthest = max(furthest, self.reach[self.order[place]] + self.error[self.order[place]])
            if furthest < self.nearest[place + 1]:
                if place > start:
                    self._sort_exactly(start, place + 1)
                start = place + 1

    def _sort_exactly(self, start: int, stop: int) -> None:
        """Sort a run of events by their exact places."""
        rows = [(self._exact_reach(self.order[place]), self.order[place]) for place in range(start, stop)]
        rows.sort()
        for place in range(start, stop):
            self.order[place] = rows[place - start][1]

    def _exact_reach(self, event: int) -> Place:
        """Return how far the line has come at an event, and y."""
        if event < self.n:
            x, y = self._exact_point(event)
        else:
            visit = self.event[event] - self.n
            x, y = self._exact_crossing(self.curve.visit_edge[visit], self.curve.visit_edge[self.curve.partner[visit]])
        return x + Fraction(_TILT) * y, y

    def _exact_point(self, point: int) -> Place:
        return Fraction(self.points[2 * point]), Fraction(self.points[2 * point + 1])

    def _exact_crossing(self, edge: int, other: int) -> Place:
        """Return where two edges cross."""
        a, b = self._exact_point(edge), self._exact_point(self.curve.following[edge])
        c, d = self._exact_point(other), self._exact_point(self.curve.following[other])
        share = exact_cross(a, c, c, d) / exact_cross(a, b, c, d)
        return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])

    def triangles(self, faces: WholeBuffer, sides: WholeBuffer) -> int:
        """Sweep, and return how many triangles there are."""
        points = ExactPoints.__new__(ExactPoints)
        points.places, points.exact, points.has_scratch = self.points, None, False
        return sweep_over(self._drawing(), points, points, False, faces, sides)

    def _drawing(self) -> Drawing:
        curve, drawing = self.curve, Drawing.__new__(Drawing)
        self._find_ranks()
        self._find_neighbours()
        self._find_borders()
        self._find_beyond()
        drawing.order, drawing.rank = self.order, self.rank
        drawing.following, drawing.preceding = curve.following, self.preceding
        drawing.partner, drawing.visit_edge = curve.partner, curve.visit_edge
        drawing.before, drawing.after = self.before, self.after
        drawing.arriving = drawing.leaving = self.border_at
        drawing.cusp, drawing.bridge_at = self.cusp, self.bridge_at
        drawing.bridge_of_foot = drawing.above = drawing.before_bridge = drawing.bridge_border = self.nothing
        drawing.own_sheet, drawing.row, drawing.beyond = self.own, self.row, self.beyond
        return drawing

    def _find_ranks(self) -> None:
        for place in range(self.events):
            event = self.event[self.order[place]]
            self.order[place], self.rank[event] = event, place

    def _find_neighbours(self) -> None:
        n = self.n
        self.preceding, self.cusp, self.bridge_at = (
            self.curve.take_whole(n),
            self.curve.take_whole(n),
            self.curve.take_whole(n),
        )
        self.nothing = self.curve.take_whole(0)
        for point in range(n):
            self.preceding[point] = point - 1 if point > 0 else n - 1
            self.cusp[point], self.bridge_at[point] = 0, -1

    def _find_borders(self) -> None:
        """Find the border at each point, and those before and after each visit."""
        curve, visits = self.curve, 2 * self.k
        self.border_at, self.before, self.after = (
            self.curve.take_whole(self.n),
            self.curve.take_whole(visits),
            self.curve.take_whole(visits),
        )
        visit = 0
        for point in range(self.n):
            while visit < visits and curve.visit_edge[visit] < point:
                visit += 1
            self.border_at[point] = visit - 1 if visit > 0 else self.borders - 1
        for visit in range(visits):
            self.before[visit], self.after[visit] = visit - 1 if visit > 0 else visits - 1, visit

    def _find_beyond(self) -> None:
        """Find the sheet beyond each dart, seen from each sheet on its left, see `mesh.sheets.seams_of`."""
        curve, size = self.curve, 0
        self.row = self.curve.take_whole(2 * self.borders)
        self.beyond = self.curve.take_whole(2 * self.seams + self.borders)
        for dart in range(2 * self.borders):
            cell = curve.cell_of_dart[dart]
            self.row[dart] = size - self.first_sheet[cell]
            size += curve.winding[cell]
        for border in range(self.borders):
            self._cross_border(border)

    def _cross_border(self, border: int) -> None:
        left, right = (
            self.first_sheet[self.curve.cell_of_dart[2 * border]],
            self.first_sheet[self.curve.cell_of_dart[2 * border + 1]],
        )
        for place in range(self.start[border], self.start[border + 1]):
            upper, lower = left + self.upper[place], right + place - self.start[border]
            self.beyond[self.row[2 * border] + upper] = lower
            self.beyond[self.row[2 * border + 1] + lower] = upper
        self.own[border] += left
        self.beyond[self.row[2 * border] + self.own[border]] = -1


def cut_into_triangles(points: RealBuffer, step: Callable[[], None], faces: WholeBuffer, sides: WholeBuffer) -> int:
    """Cut the disk that a closed curve bounds into triangles on its points.

    Parameters
    ----------
    points : buffer of 2n float
        Coordinates, point after point.
    step : callable
        Called now and then; it may raise.
    faces, sides : buffer of int
        Room for n − 1 triangles, three numbers each: their points, and their sides as `sweep_over` numbers them.

    Returns
    -------
    int
        How many there are, n − 2; or :data:`CLOCKWISE` if the curve has to be turned round, or :data:`UNTOLD`: where it
        bounds no disk, or several, or where more than loops must tell.

    Examples
    --------
    >>> from array import array
    >>> faces, sides = array("q", [0] * 9), array("q", [0] * 9)
    >>> points = memoryview(array("d", [0, 0, 4, 0, 1, 1, 0, 5]))
    >>> cut_into_triangles(points, lambda: None, memoryview(faces), memoryview(sides))
    2
    >>> faces[:6].tolist()
    [0, 2, 3, 0, 1, 2]
    """
    curve = PlainCurve(step)
    if not curve.draw(points):
        return _UNTOLD
    curve.find_direction()
    if curve.direction.turning != 1 or curve.direction.lowest < 1:
        return _UNTOLD
    if curve.direction.turned_round:
        return _CLOCKWISE
    curve.find_cells()
    curve.write_word()
    if curve.has_grouping() != _YES:
        return _UNTOLD
    disk = CutDisk(curve)
    if disk.count_sheets() > _MOST_SEAMS:
        return _UNTOLD
    disk.find_order()
    disk.sew()
    found = disk.triangles(faces, sides)
    return found if found == disk.n - 2 else _UNTOLD
