"""The layers of a layering pulled apart, and the cased outline seen from above."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import INK, PAPER, mix, sheet_colour
from plyfold.draw.arrangement_plot import mark_cusps
from plyfold.draw.canvas import blank, cusp_signs, line, region, write
from plyfold.draw.casing_gaps import cased_strands
from plyfold.draw.over_under import OverUnder, over_under
from plyfold.draw.placement import (
    Frame,
    border_line,
    cell_rings,
    closed,
    drawn_loops,
    drawn_points,
    line_weight,
    mark_weight,
)
from plyfold.mesh.strips import cells_left

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.layering.layering import Layering
    from plyfold.layering.orders.intersections import IntersectingLayering

__all__ = ["plot_casing", "plot_layers"]

_SHEAR = np.array([[1.0, 0.0], [0.42, 0.46]])
_GAP = 0.014


def plot_layers(layering: Layering | IntersectingLayering, ax: Axes | None = None) -> Axes:
    """Draw the layers one above the other, pulled apart and seen at a slant.

    Each layer holds one sheet over every cell it covers, coloured as in :func:`plot_layout`; the strands of the
    outline that lie in the layer are dark, and lines where the cloth goes on, here or to the next layer, are white.
    A cusp is marked in the layers of both strands that end there.

    Parameters
    ----------
    layering : Layering or IntersectingLayering
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> from plyfold import find_immersion, find_layering
    >>> ax = plot_layers(find_layering(find_immersion([(0, 0), (1, 0), (0, 1)])))
    >>> [text.get_text() for text in ax.texts]
    ['layer 1']
    """
    axes = blank(ax)
    points = drawn_points(layering.immersion.arrangement)
    frame = Frame(points)
    flat = frame(points) @ _SHEAR
    spacing = 0.08 + 0.74 * float(np.ptp(flat[:, 1]))
    loops = [closed(frame(loop)) @ _SHEAR for loop in drawn_loops(layering.immersion.arrangement)]
    there = cells_left(layering.immersion.arrangement)[layering.immersion.sheet_cell]
    levels = int(layering.level[there].max(initial=1))
    for level in range(1, levels + 1):
        lift = np.array([0.0, spacing * (level - 1)])
        for loop in loops:
            line(axes, loop + lift, mix(INK, PAPER, 0.78), 0.7)
        _layer(axes, layering, level, frame, lift)
        write(axes, (flat[:, 0].min() - 0.03, lift[1]), f"layer {level}", 9.0, ha="right")
    return axes


def _layer(axes: Axes, layering: Layering | IntersectingLayering, level: int, frame: Frame, lift: Floats) -> None:
    immersion = layering.immersion
    arrangement = immersion.arrangement
    for sheet in np.flatnonzero(layering.level == level).tolist():
        rings = [ring @ _SHEAR + lift for ring in cell_rings(arrangement, int(immersion.sheet_cell[sheet]), frame)]
        region(axes, rings, mix(sheet_colour(sheet), PAPER, 0.25), edgecolor=PAPER, linewidth=0.7)
    own_level = layering.level[immersion.own_sheet]
    for border in np.flatnonzero(own_level == level).tolist():
        flat = frame(border_line(arrangement, border)) @ _SHEAR
        line(axes, flat + lift, INK, 1.6 * line_weight(arrangement.n_crossings))
    ends = (own_level[arrangement.border_before] == level) | (own_level[arrangement.border_after] == level)
    cusps = np.flatnonzero(ends & (arrangement.cusp_index > 0))
    places = frame(arrangement.visit_point[cusps]) @ _SHEAR + lift
    cusp_signs(axes, places, arrangement.cusp_index[cusps].tolist(), mark_weight(arrangement.n_crossings))


def plot_casing(layering: Layering, ax: Axes | None = None, *, cloth: bool = True) -> Axes:
    """Draw what passes over and under: the outline with a gap wherever it passes under itself.

    Parameters
    ----------
    layering : Layering
        Of a drawing.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    cloth : bool, optional
        Fill the sheets from below to above, in the colours of :func:`plot_layout`; the outline is dashed where cloth
        hides it. Otherwise, draw the outline alone, as a knot is drawn.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    InputError
        If it is no layering.

    Examples
    --------
    >>> from plyfold import find_embedding
    >>> ramp = find_embedding([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> len(plot_casing(ramp, cloth=False).lines)
    4
    """
    axes = blank(ax)
    drawn = over_under(layering, colours="sheets", hidden="dashed")
    arrangement = layering.immersion.arrangement
    width, frame = 1.6 * line_weight(arrangement.n_crossings), Frame(drawn_points(arrangement))
    if cloth:
        _cloth(axes, drawn, width)
    else:
        for strand in cased_strands(layering, frame, _GAP * width / 1.6):
            line(axes, strand, INK, 1.25 * width)
    mark_cusps(axes, arrangement, frame)
    return axes


def _cloth(axes: Axes, drawn: OverUnder, width: float) -> None:
    for piece in drawn.pieces:
        region(axes, piece.rings, mix(piece.colour, PAPER, 0.25))
    for strand in drawn.strands:
        points = closed(strand.points) if strand.closed else strand.points
        if strand.hidden:
            line(axes, points, INK, 0.5 * width, alpha=0.6, linestyle=(0, (4, 2.5)))
        else:
            line(axes, points, INK, width, zorder=3)
