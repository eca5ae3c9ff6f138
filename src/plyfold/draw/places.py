"""Where to put things in a picture: the middle and size of a drawing, places for numbers and arrows."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = ["Frame", "arrows", "border_middle", "label_circle", "line_weight", "middle_and_size", "natural_stretch"]


class Frame:
    """The drawing moved to the origin and scaled to size 1, so that drawings of any size and place look alike."""

    def __init__(self, points: Floats) -> None:
        self.middle, self.size = middle_and_size(points)

    def __call__(self, points: npt.ArrayLike) -> Floats:
        """Return places of the drawing in the picture, shape (n, 2)."""
        return np.asarray((np.asarray(points, dtype=float).reshape(-1, 2) - self.middle) / self.size)


def middle_and_size(points: Floats) -> tuple[Floats, float]:
    """Return the middle of the bounding box and its longer side, without overflow or loss for far-away drawings."""
    low, high = points.min(axis=0), points.max(axis=0)
    return low + (high - low) / 2, float((high - low).max())


def line_weight(crossings: int) -> float:
    """Return how heavy lines and dots should be: 1 for simple curves, less for those with many crossings."""
    return min(1.0, math.sqrt(40 / max(crossings, 1)))


def natural_stretch(vertices: Floats) -> float:
    """Return a vertical scale that makes a surface at least a quarter as high as wide, so that layers stand apart."""
    _, width = middle_and_size(vertices[:, :2])
    height = float(np.ptp(vertices[:, 2]))
    return max(1.0, 0.25 * width / height) if height > 0 else 1.0


def label_circle(arrangement: Arrangement, cell: int, tolerance: float = 0.005) -> tuple[float, float, float]:
    """Return the middle and radius of a large circle inside a bounded cell: the room for its label.

    It is the largest inscribed circle to a tolerance, in parts of the cell's size; 0.02 takes a third of the time.
    """
    import shapely

    outline = arrangement.cell_outline(cell)
    middle, size = middle_and_size(outline)
    polygon = shapely.Polygon((outline - middle) / size)
    try:
        radius = shapely.maximum_inscribed_circle(polygon, tolerance=tolerance)
    except shapely.GEOSException:
        return (*arrangement.cell_point(cell), 0.0)
    x, y = middle + size * np.array(radius.coords[0])
    return float(x), float(y), size * float(radius.length)


def border_middle(points: Floats) -> tuple[Floats, Floats]:
    """Return a point about half-way along a polyline, in the middle of an edge, and the unit direction there."""
    step = np.diff(points, axis=0)
    length = np.hypot(step[:, 0], step[:, 1])
    travelled = np.cumsum(length)
    edge = min(int(np.searchsorted(travelled, travelled[-1] / 2, side="right")), len(step) - 1)
    return points[edge] + step[edge] / 2, step[edge] / length[edge]


def arrows(arrangement: Arrangement, most: int = 6) -> list[tuple[Floats, Floats]]:
    """Return places and unit directions for arrows along the curve: the middles of its longest borders."""
    lines = [arrangement.border_points(i) for i in range(arrangement.n_borders)]
    if arrangement.n_crossings == 0:
        lines = [np.concatenate([lines[0], lines[0][:1]])]
    lengths = [float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in lines]
    longest = sorted(range(len(lines)), key=lambda i: -lengths[i])[:most]
    return [border_middle(lines[i]) for i in longest if lengths[i] > 0.25 * lengths[longest[0]]]
