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
    "border_line",
    "border_middle",
    "cell_rings",
    "closed",
    "cusps_drawn",
    "drawn_loops",
    "drawn_points",
    "geodesic",
    "label_circle",
    "line_weight",
    "mark_weight",
    "middle_and_size",
    "natural_stretch",
    "outer_ring_first",
]

T = TypeVar("T", bound=np.generic)

# Borders are numbered if they are not more.
MOST_NUMBERS = 60

# A loop gets an arrow if its longest border is longer than this part of the longest of all.
_SHORTEST_WITH_ARROW = 0.08

# How far a loop's further arrows are from others at least, as a part of the drawing's size: more than their length.
_ARROWS_APART = 0.04


def closed(points: npt.NDArray[T]) -> npt.NDArray[T]:
    """Return points with the first one repeated at the end."""
    return np.concatenate([points, points[:1]])


def drawn_points(arrangement: Arrangement) -> Floats:
    """Return the points of the outline; raises the arrangement's own error if there is no drawing."""
    return arrangement.border_points(0) if arrangement.outline is None else arrangement.outline.points


def drawn_loops(arrangement: Arrangement) -> tuple[Floats, ...]:
    """Return the points of each loop of a drawing."""
    return () if arrangement.outline is None else arrangement.outline.loops


def border_line(arrangement: Arrangement, border: int) -> Floats:
    """Return the polyline of a border with both ends; of a loop that crosses nothing, closed."""
    points = arrangement.border_points(border)
    return points if arrangement.start_visit[border] >= 0 else closed(points)


def cusps_drawn(arrangement: Arrangement) -> tuple[Floats, list[int]]:
    """Return the places of all cusps, shape (c, 2), and their indices."""
    visits = np.flatnonzero(arrangement.cusp_index)
    return arrangement.visit_point[visits], arrangement.cusp_index[visits].tolist()


class Frame:
    """The drawing moved to the origin and scaled to size 1, so that drawings of any size and place look alike."""

    def __init__(self, points: Floats) -> None:
        self.middle, self.size = middle_and_size(points)

    def __call__(self, points: npt.ArrayLike) -> Floats:
        """Return places of the drawing in the picture, shape (n, 2)."""
        return np.asarray((np.asarray(points, dtype=float).reshape(-1, 2) - self.middle) / self.size)


def cell_rings(arrangement: Arrangement, cell: int, frame: Frame) -> list[Floats]:
    """Return the boundary polygons of a cell in the picture, with the cell on the left of each."""
    return [frame(ring) for ring in arrangement.cell_outlines(cell)]


def middle_and_size(points: Floats) -> tuple[Floats, float]:
    """Return the middle of the bounding box and its longer side, without overflow or loss for far-away drawings."""
    low, high = points.min(axis=0), points.max(axis=0)
    return low + (high - low) / 2, float((high - low).max())


def line_weight(crossings: int) -> float:
    """Return how heavy lines and dots should be: 1 for simple curves, less for those with many crossings."""
    return min(1.0, math.sqrt(40 / max(crossings, 1)))


def mark_weight(crossings: int) -> float:
    """Return how large the signs of cusps should be: as :func:`line_weight`, but so that one can read their numbers."""
    return max(line_weight(crossings), 0.65)


def natural_stretch(vertices: Floats) -> float:
    """Return a vertical scale that makes a surface at least a quarter as high as wide, so that layers stand apart."""
    _, width = middle_and_size(vertices[:, :2])
    height = float(np.ptp(vertices[:, 2]))
    return max(1.0, 0.25 * width / height) if height > 0 else 1.0


def outer_ring_first(arrangement: Arrangement, cell: int) -> Sequence[Floats]:
    """Return the boundary polygons of a bounded cell: the outer one, and then its holes."""
    rings = arrangement.cell_outlines(cell)
    return rings if len(rings) == 1 else sorted(rings, key=lambda ring: -float(np.ptp(ring, axis=0).max()))


def label_circle(
    arrangement: Arrangement, cell: int, tolerance: float = 0.005, rings: Sequence[Floats] | None = None
) -> tuple[float, float, float]:
    """Return the middle and radius of a large circle inside a bounded cell: the room for its label.

    It is the largest inscribed circle to a tolerance, in parts of the cell's size; 0.02 takes a third of the time.
    ``rings`` are those of :func:`outer_ring_first`, where they are known.
    """
    rings = outer_ring_first(arrangement, cell) if rings is None else rings
    middle, size = middle_and_size(rings[0])
    if size == 0:  # strands that have only begun to move apart
        return (*arrangement.cell_point(cell), 0.0)
    shell, *holes = ((ring - middle) / size for ring in rings)
    polygon = shapely.Polygon(shell, holes)
    try:
        radius = shapely.maximum_inscribed_circle(polygon, tolerance=tolerance)
    except shapely.GEOSException:
        return (*arrangement.cell_point(cell), 0.0)
    x, y = middle + size * np.array(radius.coords[0])
    return float(x), float(y), size * float(radius.length)


def border_middle(points: Floats) -> tuple[Floats, Floats]:
    """Return a point about half-way along a polyline, in the middle of an edge, and the unit direction there.

    A border between a cusp and the foot of a bridge at the same point has no length, and then it is to the right.
    """
    step = np.diff(points, axis=0)
    length = np.hypot(step[:, 0], step[:, 1])
    travelled = np.cumsum(length)
    edge = min(int(np.searchsorted(travelled, travelled[-1] / 2, side="right")), len(step) - 1)
    return points[edge] + step[edge] / 2, step[edge] / length[edge] if length[edge] else np.array([1.0, 0.0])


def arrows(arrangement: Arrangement, most: int = 6) -> list[tuple[Floats, Floats]]:
    """Return places and unit directions for arrows: the middles of each loop's longest border and of the longest ones.

    Arrows beside each other would touch: there, one is enough for a loop.
    """
    lines = [border_line(arrangement, border) for border in range(arrangement.n_borders)]
    lengths = [float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in lines]
    longest = sorted(range(len(lines)), key=lambda i: -lengths[i])
    of_loop = dict(zip(arrangement.loop_of_border[longest[::-1]].tolist(), longest[::-1], strict=True))
    least = 0.25 * lengths[longest[0]]
    shown = [border for border in longest[:most] if lengths[border] > least]
    first = [border for border in of_loop.values() if lengths[border] > _SHORTEST_WITH_ARROW * lengths[longest[0]]]
    found = [border_middle(lines[border]) for border in first]
    apart = _ARROWS_APART * middle_and_size(drawn_points(arrangement))[1]
    for border in (border for border in shown if border not in first):
        place, direction = border_middle(lines[border])
        if all(np.hypot(*(place - other)) > apart for other, _ in found):
            found.append((place, direction))
    return found


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
