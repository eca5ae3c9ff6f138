"""An outline with its crossings, borders and cells, shaded by winding number."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.arrangement import arrange as arrangement_of
from plyfold.arrays import Floats
from plyfold.colours import ACCENT, INK, OBSTRUCTION, PAPER, mix, text_colour, winding_colour
from plyfold.draw.canvas import blank, cusp_signs, dots, line, note_below, polygon, region, write, write_below
from plyfold.draw.placement import (
    MOST_NUMBERS,
    Frame,
    arrows,
    border_line,
    border_middle,
    cell_rings,
    closed,
    cusps_drawn,
    drawn_loops,
    drawn_points,
    label_circle,
    line_weight,
    mark_weight,
)
from plyfold.outline.given import OutlineLike

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.obstruction import Obstruction

__all__ = ["mark_cusps", "plot_arrangement"]

_Marked = tuple[tuple[float, float], ...]

# How far a border's number is from it, and how much room there must be up to another number; the drawing has size 1.
_BESIDE = 0.026
_ROOM = 0.04


def plot_arrangement(
    curve: OutlineLike,
    ax: Axes | None = None,
    *,
    obstruction: Obstruction | None = None,
    borders: bool = False,
) -> Axes:
    """Draw an outline with its cells shaded by winding number; small disks with numbers mark cusps and their indices.

    Parameters
    ----------
    curve : Outline, Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    obstruction : Obstruction, optional
        Mark its places by red crosses and put its sentence below.
    borders : bool, optional
        Number the borders, up to 60 of them; a note says if there are more.

    Returns
    -------
    matplotlib Axes
        Winding numbers are left out where a cell has no room for them.

    Examples
    --------
    >>> ax = plot_arrangement([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> sorted(text.get_text() for text in ax.texts)
    ['1', '−1']
    """
    arrangement = arrangement_of(curve)
    axes, frame = blank(ax), Frame(drawn_points(arrangement))
    _fill_cells(axes, arrangement, frame)
    weight = line_weight(arrangement.n_crossings)
    for loop in drawn_loops(arrangement):
        line(axes, closed(frame(loop)), INK, 1.6 * weight)
    _arrowheads(axes, arrangement, frame, weight)
    rim = {"edgecolors": PAPER, "linewidths": 0.6 * weight, "zorder": 4}
    dots(axes, frame(arrangement.crossings), ACCENT, 16 * weight**2, **rim)
    mark_cusps(axes, arrangement, frame)
    _winding_numbers(axes, arrangement, frame, () if obstruction is None else obstruction.where)
    if borders:
        _border_numbers(axes, arrangement, frame)
    if obstruction is not None:
        _mark(axes, obstruction, frame)
    return axes


def _fill_cells(axes: Axes, arrangement: Arrangement, frame: Frame) -> None:
    for cell in range(1, arrangement.n_cells):
        winding = int(arrangement.winding[cell])
        if winding:
            region(axes, cell_rings(arrangement, cell, frame), winding_colour(winding))


def mark_cusps(axes: Axes, arrangement: Arrangement, frame: Frame) -> None:
    """Mark the cusps of an outline."""
    places, indices = cusps_drawn(arrangement)
    cusp_signs(axes, frame(places), indices, mark_weight(arrangement.n_crossings))


def _arrowheads(axes: Axes, arrangement: Arrangement, frame: Frame, weight: float) -> None:
    """Draw arrowheads, as large as lines are heavy."""
    for place, (dx, dy) in arrows(arrangement):
        (tip,) = frame(place)
        corners = weight * np.array([(0.018, 0), (-0.012, 0.0135), (-0.012, -0.0135)])
        head = corners @ np.array([(dx, dy), (-dy, dx)])
        polygon(axes, tip + head, INK, zorder=3)


def _winding_numbers(axes: Axes, arrangement: Arrangement, frame: Frame, marked: _Marked) -> None:
    """Write the winding number into every cell that has room for it, unless a marked place takes the room."""
    for cell in range(1, arrangement.n_cells):
        x, y, radius = label_circle(arrangement, cell)
        size = min(12.0, 260 * radius / frame.size)
        if size >= 4 and not any(np.hypot(x - a, y - b) < radius for a, b in marked):
            winding = int(arrangement.winding[cell])
            colour = text_colour(winding_colour(winding))
            write(axes, frame((x, y))[0], str(winding), size, color=colour)


def _border_numbers(axes: Axes, arrangement: Arrangement, frame: Frame) -> None:
    if arrangement.n_borders > MOST_NUMBERS:
        note_below(axes, f"{arrangement.n_borders} borders, too many to number")
    taken = [text.get_position() for text in axes.texts]
    for border in range(arrangement.n_borders if arrangement.n_borders <= MOST_NUMBERS else 0):
        place, (dx, dy) = border_middle(border_line(arrangement, border))
        right, left = (frame(place)[0] + side * np.array([dy, -dx]) for side in (_BESIDE, -_BESIDE))
        x, y = left if _room(left, taken) > _room(right, taken) < _ROOM else right
        taken.append((x, y))
        write(axes, (x, y), str(border), 6.5, color=mix(INK, PAPER, 0.25))


def _room(place: Floats, taken: Iterable[tuple[float, float]]) -> float:
    """Return how far the nearest number is from a place."""
    return min((float(np.hypot(place[0] - x, place[1] - y)) for x, y in taken), default=np.inf)


def _mark(axes: Axes, obstruction: Obstruction, frame: Frame) -> None:
    places = frame(obstruction.where)
    for width, colour in ((5.5, PAPER), (2.6, OBSTRUCTION)):
        dots(axes, places, colour, 130, marker="x", linewidths=width, zorder=6)
    write_below(axes, str(obstruction))
