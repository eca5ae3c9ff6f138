"""The canvas of all pictures with matplotlib: empty axes, lines, fills, dots, words, and small axes inside large ones.

New figures are not registered with pyplot: nothing pops up, and nothing has to be closed. A notebook shows them as the
last line of a cell: Jupyter asks a value for ``_repr_png_``, and matplotlib's figures have none unless its inline
backend is on. That one shows the figures that pyplot knows; it does not know those made here, so none is shown twice.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from io import BytesIO
from textwrap import fill
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from plyfold.arrays import Floats
from plyfold.colours import CUSP, INK, OBSTRUCTION, PAPER
from plyfold.draw.placement import closed

__all__ = [
    "ShownFigure",
    "blank",
    "cusp_signs",
    "dots",
    "grid",
    "line",
    "new_axes",
    "note_below",
    "polygon",
    "region",
    "write",
    "write_below",
]


# The width of a letter, as a fraction of its size; and so many letters are in a line at least.
_LETTER = 0.53
_SHORTEST_LINE = 24
_DOTS_PER_INCH = 80
# A hyphen that stands before a number.
_HYPHEN = re.compile(r"(?<!\w)-(?=[\d.])")


class ShownFigure(Figure):
    """A figure that a notebook shows."""

    def _repr_png_(self) -> bytes:
        drawn = BytesIO()
        self.savefig(drawn, format="png", dpi=_DOTS_PER_INCH, facecolor=PAPER)
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


def polygon(axes: Axes, points: Floats, colour: str, **style: Any) -> None:
    """Fill a polygon."""
    region(axes, [points], colour, **style)


def region(axes: Axes, rings: Sequence[Floats], colour: str, **style: Any) -> PathPatch:
    """Fill what polygons bound together, which lies on the left of each, and return it: holes run clockwise."""
    outline = Path.make_compound_path(*(Path(closed(ring), closed=True) for ring in rings))
    filled = PathPatch(outline, **{"facecolor": colour, "edgecolor": "none", "zorder": 1, **style})
    axes.add_patch(filled)
    axes.autoscale_view()
    return filled


def line(axes: Axes, points: Floats, colour: str, width: float, **style: Any) -> None:
    """Draw a polyline of some width in points."""
    joined = {"solid_joinstyle": "round", "solid_capstyle": "butt", "zorder": 2}
    axes.plot(points[:, 0], points[:, 1], color=colour, linewidth=width, **{**joined, **style})


def dots(axes: Axes, points: Floats, colour: str, size: float, **style: Any) -> None:
    """Draw dots, or other markers, of some area in square points."""
    axes.scatter(points[:, 0], points[:, 1], s=size, color=colour, **style)


def cusp_signs(axes: Axes, places: Floats, indices: Sequence[int], weight: float, alpha: float = 1.0) -> None:
    """Mark cusps at some places in the picture: small disks with their indices."""
    if not indices:
        return
    dots(axes, places, CUSP, 95 * weight**2, edgecolors=PAPER, linewidths=0.8 * weight, zorder=6, alpha=alpha)
    for place, index in zip(places, indices, strict=True):
        write(axes, place, str(index), 7.0 * weight, color=PAPER, weight="bold", zorder=7)


def write(axes: Axes, place: Iterable[float], text: str, size: float, **style: Any) -> None:
    """Write words of some size in points; numbers below zero get a true minus sign, which a hyphen is not."""
    x, y = place
    text = _HYPHEN.sub("−", text)
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
