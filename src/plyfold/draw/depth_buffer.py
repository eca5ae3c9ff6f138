"""A depth buffer in plain numpy: the triangle that each pixel sees.

matplotlib sorts whole triangles, which goes wrong where sheets lie close above each other. Here every pixel finds its
nearest triangle. The eye is infinitely far away (parallel projection), as in an axonometric drawing.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from plyfold.arrays import Floats, Ints

__all__ = ["Pixels", "Seen", "View", "look"]


_BATCH = 1_000_000


@dataclass(frozen=True)
class View:
    """A parallel projection: the rows of ``axes`` point right, up and towards the eye.

    Parameters
    ----------
    axes : (3, 3) float
        Orthonormal.
    """

    axes: Floats

    @classmethod
    def of(cls, azimuth: float, elevation: float) -> View:
        """Return the view from a direction in degrees; azimuth -90 and elevation 90 is the drawing itself."""
        turn, rise = np.radians([azimuth, elevation])
        right = np.array([-np.sin(turn), np.cos(turn), 0.0])
        eye = np.array([np.cos(turn) * np.cos(rise), np.sin(turn) * np.cos(rise), np.sin(rise)])
        return cls(np.stack([right, np.cross(eye, right), eye]))

    def project(self, points: Floats) -> Floats:
        """Return (right, up, towards the eye) of each point, shape (n, 3)."""
        return points @ self.axes.T


@dataclass(frozen=True)
class Pixels:
    """A grid of square pixels over part of the plane of projection; row 0 is the lowest."""

    origin: Floats
    size: float
    columns: int
    rows: int

    @classmethod
    def over(cls, low: Floats, high: Floats, longer_side: int) -> Pixels:
        """Cover a box with pixels, ``longer_side`` of them along its longer side."""
        size = float((high - low).max()) / longer_side
        columns, rows = np.ceil((high - low) / size).astype(int).clip(1).tolist()
        return cls(low, size, columns, rows)

    def halved(self) -> Pixels:
        """Return the grid of pixels twice as large."""
        return Pixels(self.origin, 2 * self.size, (self.columns + 1) // 2, (self.rows + 1) // 2)

    def coordinates(self, points: Floats) -> Floats:
        """Return points of the plane in units of pixels, pixel centres at whole numbers."""
        return (points[..., :2] - self.origin) / self.size - 0.5

    def centres(self) -> Floats:
        """Return the centre of every pixel, shape (rows, columns, 2)."""
        x, y = np.meshgrid(np.arange(self.columns) + 0.5, np.arange(self.rows) + 0.5)
        return self.origin + self.size * np.stack([x, y], axis=-1)

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top, as ``imshow`` wants them."""
        (x, y), size = self.origin.tolist(), self.size
        return x, x + size * self.columns, y, y + size * self.rows


@dataclass(frozen=True)
class Seen:
    """What each pixel sees: its nearest triangle (-1 for none) and the depth there (-inf for none).

    Parameters
    ----------
    triangle, depth : (rows, columns)
        Depth grows towards the eye.
    pixels : Pixels
    """

    triangle: Ints
    depth: Floats
    pixels: Pixels

    def depth_at(self, points: Floats) -> Floats:
        """Return the depth seen at projected points, shape (n,); -inf outside the picture."""
        column, row = np.rint(self.pixels.coordinates(points)).astype(np.int64).T
        inside = (column >= 0) & (column < self.pixels.columns) & (row >= 0) & (row < self.pixels.rows)
        depth = np.full(len(points), -np.inf)
        depth[inside] = self.depth[row[inside], column[inside]]
        return depth


def look(projected: Floats, faces: Ints, pixels: Pixels) -> Seen:
    """Fill a depth buffer.

    Parameters
    ----------
    projected : (n, 3) float
        Vertices, as :meth:`View.project` returns them.
    faces : (m, 3) int
    pixels : Pixels

    Returns
    -------
    Seen
        Cost: the number of pixels that all triangles cover together.
    """
    depth = np.full(pixels.rows * pixels.columns, -np.inf)
    triangle = np.full(pixels.rows * pixels.columns, -1, dtype=np.int64)
    corners = np.concatenate([pixels.coordinates(projected), projected[:, 2:]], axis=1)[faces]
    spans = _spans(corners, pixels)
    for batch in _batches(spans.count):
        where, which, height = _samples(corners, spans, batch, pixels.columns)
        order = np.argsort(height, kind="stable")
        where, which, height = where[order], which[order], height[order]
        nearer = height > depth[where]
        depth[where[nearer]], triangle[where[nearer]] = height[nearer], which[nearer]
    shape = (pixels.rows, pixels.columns)
    return Seen(triangle.reshape(shape), depth.reshape(shape), pixels)


@dataclass(frozen=True)
class _Spans:
    """Runs of pixels: the part of one row that lies in one triangle."""

    triangle: Ints
    row: Ints
    column: Ints
    count: Ints


def _spans(corners: Floats, pixels: Pixels) -> _Spans:
    y = corners[..., 1]
    first = np.ceil(y.min(axis=1)).astype(np.int64).clip(0)
    last = np.floor(y.max(axis=1)).astype(np.int64).clip(max=pixels.rows - 1)
    triangle, row = _ranges(first, (last - first + 1).clip(0))
    left, right = _row_ends(corners[triangle], row)
    column = np.ceil(left.clip(0)).astype(np.int64)
    count = (np.floor(right.clip(max=pixels.columns - 1)).astype(np.int64) - column + 1).clip(0)
    return _Spans(triangle, row, column, count)


def _ranges(start: Ints, count: Ints) -> tuple[Ints, Ints]:
    """Return the ranges start, start + 1, ... (count of them) end to end: whose range it is, and the number."""
    which = np.repeat(np.arange(len(start)), count)
    return which, np.arange(len(which)) - np.repeat(np.cumsum(count) - count - start, count)


def _row_ends(corners: Floats, row: Ints) -> tuple[Floats, Floats]:
    """Return where a horizontal line enters and leaves each triangle: the half-planes of the edges, one by one."""
    left, right = np.full(len(row), -1.0), np.full(len(row), np.inf)
    turn = _doubled_area(corners)
    for i in range(3):
        start, end = corners[:, i], corners[:, (i + 1) % 3]
        rise = turn * (end[:, 1] - start[:, 1])
        at = _edge_at(start, end, row)
        left = np.where(rise < 0, np.maximum(left, at), left)
        right = np.where(rise > 0, np.minimum(right, at), right)
    return left, np.where(np.isfinite(right), right, -1.0)


def _edge_at(start: Floats, end: Floats, row: Ints) -> Floats:
    """Return x where an edge crosses a row; the same from both ends, so that neighbours leave no gap."""
    upward = (start[:, 1] < end[:, 1])[:, None]
    low, high = np.where(upward, start, end), np.where(upward, end, start)
    rise = high[:, 1] - low[:, 1]
    share = (row - low[:, 1]) / np.where(rise > 0, rise, 1.0)
    return np.asarray(low[:, 0] + (high[:, 0] - low[:, 0]) * share)


def _doubled_area(corners: Floats) -> Floats:
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]


def _batches(count: Ints) -> list[slice]:
    """Cut the spans into runs of about the same number of pixels, so that memory stays bounded."""
    ends = np.cumsum(count)
    marks = np.searchsorted(ends, np.arange(0, ends[-1] if len(ends) else 0, _BATCH))
    edges = np.unique(np.concatenate([marks, [0, len(ends)]])).tolist()
    return [slice(a, b) for a, b in pairwise(edges)]


def _samples(corners: Floats, spans: _Spans, batch: slice, columns: int) -> tuple[Ints, Ints, Floats]:
    """Return, for every pixel centre inside a triangle: the pixel, the triangle and the depth."""
    span, column = _ranges(spans.column[batch], spans.count[batch])
    triangle, row = spans.triangle[batch][span], spans.row[batch][span]
    slope_x, slope_y = _slopes(corners)
    origin = corners[:, 0]
    height = (
        origin[triangle, 2]
        + slope_x[triangle] * (column - origin[triangle, 0])
        + slope_y[triangle] * (row - origin[triangle, 1])
    )
    return row * columns + column, triangle, height


def _slopes(corners: Floats) -> tuple[Floats, Floats]:
    """Return how fast depth grows to the right and upwards on each triangle."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        area = _doubled_area(corners)
        right = (first[:, 2] * second[:, 1] - second[:, 2] * first[:, 1]) / area
        up = (second[:, 2] * first[:, 0] - first[:, 2] * second[:, 0]) / area
    return np.nan_to_num(right), np.nan_to_num(up)
