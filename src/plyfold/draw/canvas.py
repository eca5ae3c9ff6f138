"""The canvas of all pictures with matplotlib: empty axes, lines, fills, dots, words, and small axes inside large ones.

New figures are not registered with pyplot: nothing pops up, and nothing has to be closed. A notebook shows them as the
last line of a cell: Jupyter asks a value for ``_repr_png_``, and matplotlib's figures have none unless its inline
backend is on. That one shows the figures that pyplot knows; it does not know those made here, so none is shown twice.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from io import BytesIO
from textwrap import fill
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plyfold.arrays import Floats
from plyfold.colours import INK, OBSTRUCTION

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = [
    "Frame",
    "ShownFigure",
    "arrows",
    "blank",
    "border_middle",
    "closed",
    "dots",
    "grid",
    "label_circle",
    "line",
    "line_weight",
    "middle_and_size",
    "natural_stretch",
    "new_axes",
    "note_below",
    "polygon",
    "write",
    "write_below",
]


T = TypeVar("T", bound=np.generic)

# The width of a letter, as a fraction of its size; and so many letters are in a line at least.
_LETTER = 0.53
_SHORTEST_LINE = 24
_DOTS_PER_INCH = 80


class ShownFigure(Figure):
    """A figure that a notebook shows."""

    def _repr_png_(self) -> bytes:
        drawn = BytesIO()
        self.savefig(drawn, format="png", dpi=_DOTS_PER_INCH, facecolor="white")
        return drawn.getvalue()


class ShownAxes(Axes):
    """Axes for which a notebook shows their figure."""

    def _repr_png_(self) -> bytes:
        assert isinstance(self.figure, ShownFigure)
        return self.figure._repr_png_()


def new_axes(size: tuple[float, float]) -> ShownAxes:
    """Return the axes of a new figure of some size in inches."""
    figure = ShownFigure(figsize=size, layout="constrained")
    axes = figure.subplots(subplot_kw={"axes_class": ShownAxes})
    assert isinstance(axes, ShownAxes)
    return axes


def blank(ax: Axes | None, size: tuple[float, float] = (5.0, 5.0)) -> Axes:
    """Return empty axes of equal scale without a frame: the given ones, or those of a new figure of some size."""
    if ax is None:
        ax = new_axes(size)
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_axis_off()
    return ax


def closed(points: npt.NDArray[T]) -> npt.NDArray[T]:
    """Return points with the first one repeated at the end."""
    return np.concatenate([points, points[:1]])


def polygon(axes: Axes, points: Floats, colour: str, **style: Any) -> None:
    """Fill a polygon."""
    axes.fill(points[:, 0], points[:, 1], **{"facecolor": colour, "edgecolor": "none", "zorder": 1, **style})


def line(axes: Axes, points: Floats, colour: str, width: float, **style: Any) -> None:
    """Draw a polyline of some width in points."""
    joined = {"solid_joinstyle": "round", "solid_capstyle": "butt", "zorder": 2}
    axes.plot(points[:, 0], points[:, 1], color=colour, linewidth=width, **{**joined, **style})


def dots(axes: Axes, points: Floats, colour: str, size: float, **style: Any) -> None:
    """Draw dots, or other markers, of some area in square points."""
    axes.scatter(points[:, 0], points[:, 1], s=size, color=colour, **style)


def write(axes: Axes, place: Iterable[float], text: str, size: float, **style: Any) -> None:
    """Write words of some size in points."""
    x, y = place
    middle = {"color": INK, "ha": "center", "va": "center_baseline", "zorder": 5}
    axes.text(x, y, text, fontsize=size, **{**middle, **style})


def write_below(axes: Axes, sentence: str) -> None:
    """Write why something does not exist below the drawing."""
    note_below(axes, sentence, 9.5, OBSTRUCTION)


def note_below(axes: Axes, sentence: str, size: float = 8.0, colour: str = INK) -> None:
    """Write a sentence below the drawing, for example what it leaves out, in lines no longer than the axes are wide."""
    width = axes.bbox.width / axes.figure.dpi * 72
    lines = fill(sentence, max(int(width / (_LETTER * size)), _SHORTEST_LINE))
    write(axes, (0.5, -0.02), lines, size, transform=axes.transAxes, color=colour, va="top")


def grid(axes: Axes, rows: int, columns: int, gap: float = 0.04) -> list[list[Axes]]:
    """Return small axes in rows inside large ones, the upper row first."""
    width, height = 1 / columns, 1 / rows
    return [
        [
            axes.inset_axes((column * width, 1 - (row + 1) * height, (1 - gap) * width, (1 - 2 * gap) * height))
            for column in range(columns)
        ]
        for row in range(rows)
    ]


# ---- where to put things in a picture --------------------------------------------------------------------------------


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
