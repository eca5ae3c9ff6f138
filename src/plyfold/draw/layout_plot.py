"""The disk layout: the disk unwound to a circle, its sheets as regions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from plyfold.colours import INK, PAPER, mix, sheet_colour, winding_colour
from plyfold.draw.canvas import blank, line, note_below, polygon, write
from plyfold.draw.placement import MOST_NUMBERS, BorderCircle, line_weight
from plyfold.immersion.immersion import require_disk

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.immersion.immersion import Group, Immersion

__all__ = ["plot_layout"]


def plot_layout(immersion: Immersion, ax: Axes | None = None, *, groups: Iterable[Group] | None = None) -> Axes:
    """Draw the disk layout: the disk unwound to a circle, with the borders in order around it (§2.2 of [MGR11]_).

    Every sheet with borders of its own is a region in its own colour, and the paper's arcs join its borders, or a
    border alone to itself. The arcs are hyperbolic lines, so those of different sheets never meet. Up to 60 borders are
    numbered.

    Parameters
    ----------
    immersion : Immersion
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    groups : iterable of Group, optional
        Draw only some of ``immersion.disk_layout()``; borders of others are grey.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    InputError
        If the surface is no disk, which is bounded by one curve and has Euler characteristic 1.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> ax = plot_layout(find_immersion([(0, 0), (1, 0), (0, 1)]))
    >>> [text.get_text() for text in ax.texts]
    ['0']
    """
    require_disk(immersion)
    axes = blank(ax)
    borders, weight = immersion.arrangement.n_borders, line_weight(immersion.arrangement.n_crossings)
    circle = BorderCircle(borders)
    polygon(axes, BorderCircle(1).arc(0), mix(winding_colour(1), PAPER, 0.45))
    shown = tuple(immersion.disk_layout() if groups is None else groups)
    for group in shown:
        colour = sheet_colour(group.sheet)
        polygon(axes, circle.region(group.borders), mix(colour, PAPER, 0.62))
        for border, other in group.arcs:
            line(axes, circle.join(border, other), mix(colour, INK, 0.15), 1.5 * weight)
    sheets = {group.sheet for group in shown}
    for border, sheet in enumerate(immersion.own_sheet.tolist()):
        line(axes, circle.arc(border, 1.02), sheet_colour(sheet) if sheet in sheets else mix(INK, PAPER, 0.75), 5.0)
        if borders <= MOST_NUMBERS:
            write(axes, circle.middle(border, 1.12), str(border), 8.5 if borders <= 36 else 6.0)
    if borders > MOST_NUMBERS:
        note_below(axes, f"{borders} borders, counter-clockwise from the top, too many to number")
    axes.update_datalim([(-1.15, -1.15), (1.15, 1.15)])
    return axes
