"""Immersed disks as they lie in the plane, one or several side by side."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import PolyCollection

from plyfold.arrays import Floats
from plyfold.colours import INK, PAPER, mix, sheet_colour
from plyfold.draw.canvas import blank, grid, line, note_below, polygon
from plyfold.draw.layout_plot import plot_layout
from plyfold.draw.placement import Frame, closed, drawn_points, label_circle, line_weight
from plyfold.immersion.immersion import Immersion, require_immersion
from plyfold.immersion.solve import count_immersions, find_immersion, immersions
from plyfold.options import refuse_unless_count
from plyfold.outline.curve import CurveLike

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Polygon

__all__ = ["plot_immersion", "plot_immersions"]

_BAND = 9.0
_WIDEST_STRIPE = 0.022
_MOST_STRIPES = 400


def plot_immersion(immersion: Immersion, ax: Axes | None = None) -> Axes:
    """Draw the disk as it lies over the drawing: every cell in the colours of its sheets, striped if it has several.

    Along each border runs a band, strong in colour, of the sheet that ends there: the border is its own. Sheets have
    the colours of :func:`plot_layout`.

    Parameters
    ----------
    immersion : Immersion
        Of a drawing.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    PlyfoldError
        If there is no drawing.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ax = plot_immersion(find_immersion([(0, 0), (1, 0), (0, 1)]))
    >>> len(ax.lines)
    2
    """
    axes = blank(ax)
    arrangement = require_immersion(immersion).arrangement
    frame = Frame(drawn_points(arrangement))
    weight = line_weight(arrangement.n_crossings)
    cells = {cell: _fill(axes, immersion, cell, frame) for cell in np.unique(immersion.sheet_cell).tolist()}
    for border, sheet in enumerate(immersion.own_sheet.tolist()):
        points = frame(arrangement.border_points(border))
        points = points if arrangement.n_crossings else closed(points)
        line(axes, points, sheet_colour(sheet), _BAND * weight)
        axes.lines[-1].set_clip_path(cells[int(immersion.sheet_cell[sheet])])
        line(axes, points, INK, 1.4 * weight, zorder=3, solid_capstyle="round")
    return axes


def _fill(axes: Axes, immersion: Immersion, cell: int, frame: Frame) -> Polygon:
    """Fill a cell in stripes of the colours of its sheets, and return its outline."""
    arrangement, sheets = immersion.arrangement, immersion.sheets[cell]
    outline = frame(arrangement.cell_outline(cell))
    polygon(axes, outline, _pale(sheets[0]))
    patch: Polygon = axes.patches[-1]  # type: ignore[assignment]
    if len(sheets) > 1:
        room = label_circle(arrangement, cell)[2] / frame.size
        stripes = _stripes(outline, len(sheets), float(np.clip(0.8 * room / len(sheets), 0.001, _WIDEST_STRIPE)))
        for number, sheet in enumerate(sheets[1:], 1):
            _draw_stripes(axes, stripes[number :: len(sheets)], _pale(sheet), patch)
    return patch


def _pale(sheet: int) -> str:
    return mix(sheet_colour(sheet), PAPER, 0.5)


def _stripes(outline: Floats, kinds: int, width: float) -> list[Floats]:
    """Return slanted stripes side by side that cover a polygon, of several kinds in turn."""
    across = outline @ np.sqrt([0.5, 0.5])
    low, high = float(across.min()), float(across.max())
    width = max(width, (high - low) / (_MOST_STRIPES * kinds))
    along = outline @ np.array([-np.sqrt(0.5), np.sqrt(0.5)])
    ends = np.array([along.min(), along.max()])
    starts = np.arange(low, high, width).tolist()
    to_plane = np.array([[np.sqrt(0.5), np.sqrt(0.5)], [-np.sqrt(0.5), np.sqrt(0.5)]])
    box = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return [np.array([(start + width * i, ends[j]) for i, j in box]) @ to_plane for start in starts]


def _draw_stripes(axes: Axes, stripes: list[Floats], colour: str, clip: Polygon) -> None:
    drawn = PolyCollection(stripes, facecolor=colour, edgecolor="none", zorder=1.2)
    axes.add_collection(drawn, autolim=False)
    drawn.set_clip_path(clip)


def plot_immersions(curve: CurveLike, ax: Axes | None = None, *, most: int = 4) -> Axes:
    """Draw the immersions of a curve side by side, each as it lies in the plane, with its disk layout below.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure. Each picture gets axes of its own inside these (``ax.child_axes``).
    most : int, optional
        How many to draw; if there are more, a note says so.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    NotImmersibleError
        If there is none.

    Examples
    --------
    >>> from plyfold.gallery import CURVES
    >>> ax = plot_immersions(CURVES["milnor"].curve)
    >>> len(ax.child_axes)
    4
    """
    refuse_unless_count("most", most)
    shown = list(islice(immersions(curve), most))
    if not shown:
        require_immersion(find_immersion(curve))
    axes = blank(ax, (3.2 * len(shown), 6.4))
    for above, below, immersion in zip(*grid(axes, 2, len(shown)), shown, strict=True):
        plot_immersion(immersion, above)
        plot_layout(immersion, below)
    total = count_immersions(curve)
    if total > len(shown):
        note_below(axes, f"{len(shown)} of {total:,} immersions")
    return axes
