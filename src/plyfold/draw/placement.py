"""Where things are put in a picture, whatever it is painted with: frames, labels, arrows, and the round disk layout."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrays import Floats

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = [
    "MOST_NUMBERS",
    "BorderCircle",
    "Frame",
    "arrows",
    "border_middle",
    "closed",
    "drawn_points",
    "geodesic",
    "label_circle",
    "line_weight",
    "middle_and_size",
    "natural_stretch",
]

T = TypeVar("T", bound=np.generic)

# Borders are numbered if they are not more.
MOST_NUMBERS = 60


def closed(points: npt.NDArray[T]) -> npt.NDArray[T]:
    """Return points with the first one repeated at the end."""
    return np.concatenate([points, points[:1]])


def drawn_points(arrangement: Arrangement) -> Floats:
    """Return the points of the curve; raises the arrangement's own error if there is no drawing."""
    return arrangement.border_points(0) if arrangement.curve is None else arrangement.curve.points


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


# ---- arcs in a round disk that never cross unless their ends interleave ----------------------------------------------


def geodesic(start: float, end: float, points: int = 48) -> Floats:
    """Return the circular arc inside the unit disk that meets the unit circle at right angles at two angles.

    A straight chord of the Klein model becomes that arc of the Poincaré model, so straight diameters need no special
    case, and chords that do not cross become arcs that do not cross.

    Examples
    --------
    >>> middle = geodesic(0.0, np.pi / 2, points=3)[1]
    >>> bool(np.allclose(middle, 1 - np.sqrt(0.5)))
    True
    """
    share = ((1 - np.cos(np.linspace(0, np.pi, points))) / 2)[:, None]
    chord = (1 - share) * _on_circle(np.array(start)) + share * _on_circle(np.array(end))
    inner = np.sqrt((1 - (chord**2).sum(axis=1, keepdims=True)).clip(0))
    return np.asarray(chord / (1 + inner))


def _on_circle(angle: Floats) -> Floats:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


class BorderCircle:
    """The unit circle cut into equal parts, one for each border, counter-clockwise from the top.

    Parameters
    ----------
    borders : int
        Number of borders.
    inset : float
        Share of each part that is left free at either end.
    """

    def __init__(self, borders: int, inset: float = 0.07) -> None:
        self.part = 2 * np.pi / borders
        self.inset = 0.0 if borders == 1 else inset

    def angle(self, border: int, share: float) -> float:
        """Return the angle a share of the way along the visible part of a border."""
        return float(np.pi / 2 + self.part * (border + self.inset + share * (1 - 2 * self.inset)))

    def middle(self, border: int, radius: float = 1.0) -> tuple[float, float]:
        """Return the point at the middle of a border, or beyond it."""
        angle = self.angle(border, 0.5)
        return radius * np.cos(angle), radius * np.sin(angle)

    def arc(self, border: int, radius: float = 1.0) -> Floats:
        """Return the border's part of the circle."""
        steps = max(int(np.ceil(self.part / 0.02)), 2)
        return radius * _on_circle(np.linspace(self.angle(border, 0.0), self.angle(border, 1.0), steps))

    def region(self, borders: Sequence[int]) -> Floats:
        """Return the polygon of a sheet: its borders in order, joined inside the disk."""
        following = [*borders[1:], borders[0]]
        pieces = []
        for border, after in zip(borders, following, strict=True):
            pieces += [self.arc(border), geodesic(self.angle(border, 1.0), self.angle(after, 0.0))]
        return np.concatenate(pieces)

    def join(self, border: int, other: int) -> Floats:
        """Return the arc between two borders' middles; for one border with itself, a small arc over its middle."""
        start, end = self.angle(border, 0.5), self.angle(other, 0.5)
        loop = min(0.25 * self.part, 0.3) if border == other else 0.0
        return geodesic(start - loop, end + loop)
