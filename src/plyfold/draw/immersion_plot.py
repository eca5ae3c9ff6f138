"""Immersed surfaces as they lie in the plane, one or several side by side."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import PolyCollection

from plyfold.arrays import Floats
from plyfold.colours import INK, PAPER, mix, sheet_colour
from plyfold.draw.arrangement_plot import mark_cusps
from plyfold.draw.canvas import blank, grid, line, note_below, region
from plyfold.draw.layout_plot import plot_layout
from plyfold.draw.placement import Frame, border_line, cell_rings, drawn_points, label_circle, line_weight
from plyfold.immersion.immersion import Immersion, require_immersion
from plyfold.immersion.solve import count_immersions, find_immersion, immersions
from plyfold.options import refuse_unless_count
from plyfold.outline.given import OutlineLike

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import PathPatch

__all__ = ["plot_immersion", "plot_immersions"]

_BAND = 9.0
_WIDEST_STRIPE = 0.022
_MOST_STRIPES = 400


def plot_immersion(immersion: Immersion, ax: Axes | None = None) -> Axes:
    """Draw the surface as it lies over the drawing: every cell in the colours of its sheets, striped if it has several.

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
        points = frame(border_line(arrangement, border))
        line(axes, points, sheet_colour(sheet), _BAND * weight)
        axes.lines[-1].set_clip_path(cells[int(immersion.sheet_cell[sheet])])
        line(axes, points, INK, 1.4 * weight, zorder=3, solid_capstyle="round")
    mark_cusps(axes, arrangement, frame)
    return axes


def _fill(axes: Axes, immersion: Immersion, cell: int, frame: Frame) -> PathPatch:
    """Fill a cell in stripes of the colours of its sheets, and return its outline."""
    arrangement, sheets = immersion.arrangement, immersion.sheets[cell]
    rings = cell_rings(arrangement, cell, frame)
    patch = region(axes, rings, _pale(sheets[0]))
    if len(sheets) > 1:
        room = label_circle(arrangement, cell)[2] / frame.size
        stripes = _stripes(
            np.concatenate(rings), len(sheets), float(np.clip(0.8 * room / len(sheets), 0.001, _WIDEST_STRIPE))
        )
        for number, sheet in enumerate(sheets[1:], 1):
            _draw_stripes(axes, stripes[number :: len(sheets)], _pale(sheet), patch)
    return patch


def _pale(sheet: int) -> str:
    return mix(sheet_colour(sheet), PAPER, 0.5)


def _stripes(points: Floats, kinds: int, width: float) -> list[Floats]:
    """Return slanted stripes side by side that cover some points, of several kinds in turn."""
    across = points @ np.sqrt([0.5, 0.5])
    low, high = float(across.min()), float(across.max())
    width = max(width, (high - low) / (_MOST_STRIPES * kinds))
    along = points @ np.array([-np.sqrt(0.5), np.sqrt(0.5)])
    ends = np.array([along.min(), along.max()])
    starts = np.arange(low, high, width).tolist()
    to_plane = np.array([[np.sqrt(0.5), np.sqrt(0.5)], [-np.sqrt(0.5), np.sqrt(0.5)]])
    box = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return [np.array([(start + width * i, ends[j]) for i, j in box]) @ to_plane for start in starts]


def _draw_stripes(axes: Axes, stripes: list[Floats], colour: str, clip: PathPatch) -> None:

    drawn = PolyCollection(stripes, facecolor=colour, edgecolor="none", zorder=1.2)
    axes.add_collection(drawn, autolim=False)
    drawn.set_clip_path(clip)


def plot_immersions(curve: OutlineLike, ax: Axes | None = None, *, most: int = 4) -> Axes:
    """Draw the immersions of an outline side by side, each as it lies in the plane; of disks, with the layout below.

    Parameters
    ----------
    curve : Outline, Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
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
    plots = (plot_immersion, plot_layout) if shown[0].is_disk else (plot_immersion,)
    axes = blank(ax, (3.2 * len(shown), 3.2 * len(plots)))
    for plot, row in zip(plots, grid(axes, len(plots), len(shown)), strict=True):
        for small, immersion in zip(row, shown, strict=True):
            plot(immersion, small)
    total = count_immersions(curve)
    if total > len(shown):
        note_below(axes, f"{len(shown)} of {total:,} immersions")
    return axes
