"""A depth buffer: the triangle that each pixel sees.

matplotlib sorts whole triangles, which goes wrong where sheets lie close above each other. Here every pixel finds its
nearest triangle. The eye is infinitely far away (parallel projection), as in an axonometric drawing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.depths import DepthBuffer, count_hidden, fill_depths

__all__ = ["Pixels", "Seen", "View", "look"]


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

    def doubled(self) -> Pixels:
        """Return the grid of pixels half as large: four in each."""
        return Pixels(self.origin, self.size / 2, 2 * self.columns, 2 * self.rows)

    def part(self, low: Floats, high: Floats) -> Pixels:
        """Return the pixels of this grid that meet a box; at least one."""
        most = np.array([self.columns, self.rows])
        first = np.floor((low - self.origin) / self.size).clip(0, most - 1)
        last = np.ceil((high - self.origin) / self.size).clip(first + 1, most)
        columns, rows = (last - first).astype(int).tolist()
        return Pixels(self.origin + self.size * first, self.size, columns, rows)

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

    def add_hidden(self, view: View, points: Floats, slack: float, hidden: Ints) -> None:
        """Add one for each point, shape (n, 3), that lies behind what is seen from this view by more than the slack."""
        axes, size = view.axes, self.pixels.size
        plane = np.column_stack([axes[:2] / size, -self.pixels.origin / size - 0.5])
        projection = np.vstack([plane, [*axes[2], slack]])
        buffer = DepthBuffer(self.pixels.columns, self.pixels.rows, *all_flat(self.depth, self.triangle))
        count_hidden(buffer, flat(projection), flat(points), flat(hidden))


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
    shape = (pixels.rows, pixels.columns)
    depth, triangle = np.full(shape, -np.inf), np.full(shape, -1, dtype=np.int64)
    corners = np.concatenate([pixels.coordinates(projected), projected[:, 2:]], axis=1)[faces]
    fill_depths(DepthBuffer(pixels.columns, pixels.rows, *all_flat(depth, triangle)), flat(corners))
    return Seen(triangle, depth, pixels)
