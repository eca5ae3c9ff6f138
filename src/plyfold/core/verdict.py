"""From the points of a closed curve to the verdict whether it bounds a disk, with no value between.

The stages are those that values are made by: crossings, visits, direction, cells, dual tree, word, propagation. Where
one of them meets with something that takes more than its loops, be it a contact or points to clean, nothing is told.
"""

from __future__ import annotations

from collections.abc import Callable

from plyfold.core.buffers import RealBuffer, WholeBuffer, byte_room, real_room, rough_room
from plyfold.core.cell_tree import CellTree, room_for_tree
from plyfold.core.cells import follow_darts, walk_cells
from plyfold.core.direction import CurveDirection, outer_dart_of_points
from plyfold.core.letters import Letters, room_for_arcs, room_for_letters
from plyfold.core.meetings import Meetings, count_groups
from plyfold.core.propagation import Propagation, room_for_propagation
from plyfold.core.vertices import count_vertices, is_tiny
from plyfold.core.visits import VisitsAlong

__all__ = ["NO", "NOT_TOLD", "YES", "PlainCurve", "decide"]

NO, YES, NOT_TOLD = 0, 1, -1
_NO, _YES, _NOT_TOLD = NO, YES, NOT_TOLD
# Room is asked for in blocks of so many numbers at least: one of each kind is all that small curves take.
_BLOCK = 8192


class PlainCurve:
    """One closed curve in general position, stage by stage; each stage takes those before it.

    Parameters
    ----------
    step : callable
        Called now and then; it may raise.

    Attributes
    ----------
    n, k : int
        How many points and crossings there are.
    direction : CurveDirection
        If it was turned round, the map is that of the curve turned round, and ``visit_edge`` and ``point`` are not.
    tree : CellTree
    word : Letters
    propagation : Propagation
    visit_edge, partner, ccw, point : buffer
        Of the visits in order.
    left, next_dart, cell_of_dart, cell_darts, cell_start, winding : buffer of int
        See `Arrangement`; ``left`` is the winding number left of each border.
    """

    def __init__(self, step: Callable[[], None]) -> None:
        self.n = self.k = self.borders = self.cells = self.letters = 0
        self.n_whole = self.n_real = self.n_bytes = 0
        self.meetings, self.visits, self.direction = Meetings(step), VisitsAlong(), CurveDirection()
        self.tree, self.word, self.propagation = CellTree(), Letters(), Propagation(step)

    def draw(self, points: RealBuffer) -> bool:
        """Find the crossings of a curve in order along it; tell whether it is in general position, as doubles tell."""
        self.n = count_vertices(points)
        if self.n == 0 or is_tiny(points):
            return False
        self.points = points[: 2 * self.n]
        self._find_crossings(count_groups(self.n))
        return self.meetings.touches.size == 0 and self._sort_visits()

    def _find_crossings(self, groups: int) -> None:
        n = self.n
        self.following, self.scratch = self.take_whole(n), self.take_whole(3 * n + 2 * groups + 34)
        for point in range(n):
            self.following[point] = point + 1 if point < n - 1 else 0
        self.meetings.find(self.points, self.following, self.take_real(4 * n + 8 * groups), self.scratch)
        self.k = self.meetings.crossings.size // 2

    def _sort_visits(self) -> bool:
        """Sort the visits; tell whether doubles tell their order."""
        k = self.k
        edge, order, from_right = self.take_whole(2 * k), self.take_whole(2 * k), self.take_bytes(k)
        self.visit_edge, self.partner, self.ccw = self.take_whole(2 * k), self.take_whole(2 * k), self.take_bytes(2 * k)
        self.point = self.take_real(4 * k)
        for crossing in range(k):
            edge[crossing] = self.meetings.crossings.data[2 * crossing]
            other = self.meetings.crossings.data[2 * crossing + 1]
            edge[k + crossing], from_right[crossing] = other // 2, other % 2
        places, whole = self.take_real(4 * k), self.take_whole(self.n + 2 + 2 * k)
        self.visits.sort(self.points, self.following, edge, order, places, whole)
        if self.visits.unsure.size > 0:
            return False
        self.visits.join(from_right, self.visit_edge, self.partner, self.ccw, self.point)
        return True

    # ---- room --------------------------------------------------------------------------------------------------------

    def take_whole(self, size: int) -> WholeBuffer:
        """Return room for so many whole numbers, with anything in it."""
        if self.n_whole <= size:
            self.n_whole = max(size, _BLOCK)
            self.whole = rough_room(self.n_whole)
        room, self.whole = self.whole[:size], self.whole[size:]
        self.n_whole -= size
        return room

    def take_real(self, size: int) -> RealBuffer:
        """Return room for so many doubles."""
        if self.n_real <= size:
            self.n_real = max(size, _BLOCK)
            self.real = real_room(self.n_real)
        room, self.real = self.real[:size], self.real[size:]
        self.n_real -= size
        return room

    def take_bytes(self, size: int) -> WholeBuffer:
        """Return room for so many truth values."""
        if self.n_bytes <= size:
            self.n_bytes = max(size, _BLOCK)
            self.bytes = byte_room(self.n_bytes)
        room, self.bytes = self.bytes[:size], self.bytes[size:]
        self.n_bytes -= size
        return room

    # ---- the map, and its word ---------------------------------------------------------------------------------------

    def find_direction(self) -> None:
        """Find how the curve turns and winds, and turn the map round if need be."""
        self.borders, self.cells = max(2 * self.k, 1), self.k + 2
        self.left = self.take_whole(self.borders)
        outer = outer_dart_of_points(self.points, self.visit_edge)
        self.direction.settle(self.partner, self.ccw, outer, False, self.left)

    def find_cells(self) -> None:
        """Walk round the cells."""
        darts = 2 * self.borders
        self.next_dart, self.cell_of_dart, self.cell_darts = (
            self.take_whole(darts),
            self.take_whole(darts),
            self.take_whole(darts),
        )
        self.cell_start, self.winding = self.take_whole(darts + 1), self.take_whole(self.cells)
        whole_curve = self.take_whole(2)
        whole_curve[0], whole_curve[1] = 0, 2 * self.k
        follow_darts(self.partner, self.ccw, whole_curve, self.next_dart, self.take_whole(4 * self.k))
        for dart in range(darts):
            self.cell_of_dart[dart] = -1
        walk_cells(self.next_dart, self.direction.outer, self.cell_darts, self.cell_start, self.cell_of_dart)
        self.cell_start[self.cells] = darts
        for border in range(self.borders):
            self.winding[self.cell_of_dart[2 * border]] = self.left[border]
            self.winding[self.cell_of_dart[2 * border + 1]] = self.left[border] - 1

    def write_word(self) -> None:
        """Grow the dual tree, and write the word of the ways out of its pits."""
        cells, borders = self.cells, self.borders
        self.tree.begin(self.cell_of_dart, self.next_dart, self.winding, self.take_whole(room_for_tree(cells, borders)))
        self.tree.flood()
        self.tree.measure()
        room = self.take_whole(room_for_arcs(cells, borders) + 2 * borders)
        self.letters = self.word.walk(self.tree, self.tree.ascends, room)
        self.word.sort(self.take_whole(room_for_letters(self.letters)))

    def has_grouping(self) -> int:
        """Return whether the word has a grouping, if propagation tells."""
        word, room = self.word, self.take_whole(room_for_propagation(self.letters, self.word.labels))
        self.propagation.begin(
            word.border, word.label, word.block, word.minus, word.first[: word.labels + 1], word.partner, room
        )
        if self.propagation.narrow() >= 0:
            return _NO
        return _YES if self.propagation.letters_in_play() == 0 else _NOT_TOLD


def decide(points: RealBuffer, step: Callable[[], None]) -> int:
    """Tell whether a closed curve bounds a disk: :data:`YES` or :data:`NO`, or :data:`NOT_TOLD`.

    Parameters
    ----------
    points : buffer of 2n float
        Coordinates, point after point.
    step : callable
        Called now and then; it may raise.

    Examples
    --------
    >>> from array import array
    >>> decide(memoryview(array("d", [0, 0, 1, 0, 0, 1])), lambda: None)
    1
    >>> decide(memoryview(array("d", [0, 0, 2, 2, 2, 0, 0, 2])), lambda: None)
    0
    >>> decide(memoryview(array("d", [0, 0, 2, 0, 1, 1, 2, 2, 0, 2, 1, 1])), lambda: None)
    -1
    """
    curve = PlainCurve(step)
    if not curve.draw(points):
        return _NOT_TOLD
    curve.find_direction()
    if curve.direction.turning != 1 or curve.direction.lowest < 1:
        return _NO
    curve.find_cells()
    curve.write_word()
    return curve.has_grouping()
