"""Depth buffers: which triangle each pixel sees, and which points lie behind. See `draw.depth_buffer`."""

from __future__ import annotations

from plyfold.core.buffers import RealBuffer, WholeBuffer

__all__ = ["DepthBuffer", "SeenTriangle", "Slope", "count_hidden", "fill_depths"]


class DepthBuffer:
    """Pixels row by row, with the depth and the number of the triangle that each sees: −inf and −1 at first.

    ``left`` and ``right`` are where the row at hand enters and leaves the triangle at hand.
    """

    def __init__(self, columns: int, rows: int, depth: RealBuffer, triangle: WholeBuffer) -> None:
        self.columns, self.rows, self.depth, self.triangle = columns, rows, depth, triangle
        self.left = self.right = 0.0


class Slope:
    """An edge of the triangle at hand: its lower end, how fast x grows upwards, and how far it rises.

    It rises by more than 0 if the triangle lies on its left.
    """

    def __init__(self) -> None:
        self.x = self.y = self.slope = self.rise = 0.0


class SeenTriangle:
    """The triangle at hand: its corners a, b and c, in units of pixels, with centres at whole numbers, and depths.

    ``turn`` is its doubled area, positive if it is counter-clockwise; ``right`` and ``up`` say how fast depth grows.
    """

    def __init__(self) -> None:
        self.ax = self.ay = self.az = self.bx = self.by = self.bz = self.cx = self.cy = self.cz = 0.0
        self.turn = self.right = self.up = self.lowest = self.highest = 0.0
        self.ab, self.bc, self.ca = Slope(), Slope(), Slope()


def fill_depths(buffer: DepthBuffer, corners: RealBuffer) -> None:
    """Let the pixels see triangles, nine coordinates for each; where two are as near, the first stays.

    Parameters
    ----------
    buffer : DepthBuffer
    corners : buffer of float
        Column, row and depth of each corner.

    Examples
    --------
    >>> from array import array
    >>> depth, triangle = array("d", [float("-inf")] * 6), array("q", [-1] * 6)
    >>> corners = array("d", [-0.5, -0.5, 1, 1.8, -0.5, 1, -0.5, 1.8, 1])
    >>> _ = fill_depths(DepthBuffer(3, 2, depth, triangle), corners)
    >>> triangle.tolist()
    [0, 0, -1, 0, -1, -1]
    """
    triangle = SeenTriangle()
    for number in range(len(corners) // 9):
        _read(triangle, corners, 9 * number)
        if triangle.turn != 0:
            _set_edge(triangle.ab, triangle.turn, triangle.ax, triangle.ay, triangle.bx, triangle.by)
            _set_edge(triangle.bc, triangle.turn, triangle.bx, triangle.by, triangle.cx, triangle.cy)
            _set_edge(triangle.ca, triangle.turn, triangle.cx, triangle.cy, triangle.ax, triangle.ay)
            _fill_rows(buffer, triangle, number)


def count_hidden(buffer: DepthBuffer, projection: RealBuffer, points: RealBuffer, hidden: WholeBuffer) -> None:
    """Add one for each point that lies behind what its pixel sees; points outside the picture do not.

    Parameters
    ----------
    buffer : DepthBuffer
    projection : buffer of float
        For column, row and depth alike, by what to multiply x, y and z, and what to add.
    points : buffer of float
        x, y and z of each.
    hidden : buffer of int
        What to add to.
    """
    for number in range(len(hidden)):
        x, y, z = points[3 * number], points[3 * number + 1], points[3 * number + 2]
        column = projection[0] * x + projection[1] * y + projection[2] * z + projection[3] + 0.5
        row = projection[4] * x + projection[5] * y + projection[6] * z + projection[7] + 0.5
        if 0 <= column < buffer.columns and 0 <= row < buffer.rows:
            depth = projection[8] * x + projection[9] * y + projection[10] * z + projection[11]
            if buffer.depth[_whole(row) * buffer.columns + _whole(column)] > depth:
                hidden[number] += 1


def _read(triangle: SeenTriangle, corners: RealBuffer, start: int) -> None:
    triangle.ax, triangle.ay, triangle.az = corners[start], corners[start + 1], corners[start + 2]
    triangle.bx, triangle.by, triangle.bz = corners[start + 3], corners[start + 4], corners[start + 5]
    triangle.cx, triangle.cy, triangle.cz = corners[start + 6], corners[start + 7], corners[start + 8]
    first_x, first_y, first_z = triangle.bx - triangle.ax, triangle.by - triangle.ay, triangle.bz - triangle.az
    second_x, second_y, second_z = triangle.cx - triangle.ax, triangle.cy - triangle.ay, triangle.cz - triangle.az
    triangle.turn = first_x * second_y - first_y * second_x
    if triangle.turn != 0:
        triangle.right = (first_z * second_y - second_z * first_y) / triangle.turn
        triangle.up = (second_z * first_x - first_z * second_x) / triangle.turn
    triangle.lowest = min(triangle.az, triangle.bz, triangle.cz)
    triangle.highest = max(triangle.az, triangle.bz, triangle.cz)


def _fill_rows(buffer: DepthBuffer, triangle: SeenTriangle, number: int) -> None:
    first = _first_above(min(triangle.ay, triangle.by, triangle.cy), buffer.rows)
    for row in range(first, _count_up_to(max(triangle.ay, triangle.by, triangle.cy), buffer.rows)):
        buffer.left, buffer.right = -1.0, buffer.columns
        _narrow(buffer, triangle.ab, row)
        _narrow(buffer, triangle.bc, row)
        _narrow(buffer, triangle.ca, row)
        _fill_row(buffer, triangle, number, row)


def _fill_row(buffer: DepthBuffer, triangle: SeenTriangle, number: int, row: int) -> None:
    """Fill the pixels between left and right; rounding makes no depth that the triangle does not have."""
    first = _first_above(buffer.left, buffer.columns)
    for column in range(first, _count_up_to(buffer.right, buffer.columns)):
        depth = triangle.az + triangle.right * (column - triangle.ax) + triangle.up * (row - triangle.ay)
        depth = max(triangle.lowest, min(triangle.highest, depth))
        if depth > buffer.depth[row * buffer.columns + column]:
            buffer.depth[row * buffer.columns + column] = depth
            buffer.triangle[row * buffer.columns + column] = number


def _set_edge(edge: Slope, turn: float, ax: float, ay: float, bx: float, by: float) -> None:
    """Set an edge; it is the same from both ends, so that neighbours leave no gap."""
    edge.rise = turn * (by - ay)
    if by < ay:
        ax, ay, bx, by = bx, by, ax, ay
    edge.x, edge.y, edge.slope = ax, ay, 0.0
    if ay < by:
        edge.slope = (bx - ax) / (by - ay)


def _narrow(buffer: DepthBuffer, edge: Slope, row: float) -> None:
    """Cut off what lies in a row on the outer side of an edge."""
    if edge.rise < 0:
        buffer.left = max(buffer.left, edge.x + edge.slope * (row - edge.y))
    elif edge.rise > 0:
        buffer.right = min(buffer.right, edge.x + edge.slope * (row - edge.y))


def _first_above(number: float, most: int) -> int:
    """Return the first whole number from 0 on that is not below a number; ``most`` if that would be larger."""
    if number >= most:
        return most
    whole = _whole(number) if number > 0 else _whole(0.0)
    return whole + 1 if whole < number else whole


def _count_up_to(number: float, most: int) -> int:
    """Return how many whole numbers from 0 on are not above a number, at most ``most``."""
    if number < 0:
        return 0
    return _whole(number) + 1 if number < most - 1 else most


def _whole(number: float) -> int:
    """Return the whole part of a number that is not negative."""
    return int(number)
