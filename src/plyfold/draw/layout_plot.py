"""The disk layout: the disk unwound to a circle, its sheets as regions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import INK, PAPER, mix, sheet_colour, winding_colour
from plyfold.draw.arrangement_plot import MOST_NUMBERS
from plyfold.draw.canvas import blank, line, line_weight, note_below, polygon, write

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.immersion.immersion import Group, Immersion

__all__ = ["BorderCircle", "geodesic", "plot_layout"]


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
