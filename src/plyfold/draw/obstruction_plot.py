"""Pictures of the reasons why an immersed disk has no layering: which cells, which sheets, in which order."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from matplotlib.patches import FancyArrowPatch

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.arrangement import arrange as arrangement_of
from plyfold.arrays import Floats
from plyfold.colours import OBSTRUCTION, PAPER, mix, sheet_colour, text_colour, winding_colour
from plyfold.draw.arrangement_plot import plot_arrangement
from plyfold.draw.canvas import polygon, region, write, write_below
from plyfold.draw.placement import Frame, border_line, border_middle, cell_rings, drawn_points, label_circle
from plyfold.errors import InputError
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import find_immersion
from plyfold.layering.orders.search import find_layering
from plyfold.obstruction import Obstruction
from plyfold.outline.given import OutlineLike

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_obstruction"]

Step: TypeAlias = tuple[int, tuple[int, ...]]
"""A cell, and sheets over it from below."""

_CHIP = 0.05
_STEPS_IN_A_ROW = 15
_MOST_STEPS = 60
_NUMBER: dict[str, Any] = {"ha": "center", "va": "center", "color": OBSTRUCTION, "weight": "bold", "zorder": 8}
_BACK = {"above": -1, "below": 1}


def plot_obstruction(
    subject: OutlineLike | Immersion, obstruction: Obstruction | None = None, ax: Axes | None = None
) -> Axes:
    """Draw why there is no immersion or no layering, on the drawing.

    Parameters
    ----------
    subject : Outline, Curve, array_like of shape (n, 2), shapely geometry, Arrangement or Immersion, or some curves
        What the obstruction is about; an immersion for obstructions to a layering.
    obstruction : Obstruction, optional
        By default that of ``find_immersion(curve)`` or ``find_layering(immersion)``. Of a pair of sheets that returns
        reversed, the cells are numbered in order, arrows cross the borders from one to the next, and below the drawing
        the two sheets are shown at every step, the upper one above. Of sheets in a circle and of fixed orders, the
        cells are numbered and the sheets shown likewise. Of cells with a negative winding number, the cells. Other
        places are marked by crosses.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    InputError
        If nothing is in the way.

    Examples
    --------
    >>> ax = plot_obstruction([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> " ".join(ax.texts[-1].get_text().split())
    'The curve turns 0 times; what bounds a surface turns once, or less by an even number.'
    """
    why = _found(subject) if obstruction is None else obstruction
    if isinstance(subject, Immersion):
        return _plot_steps(subject, why, ax)
    return _plot_places(arrangement_of(subject), why, ax)


def _found(subject: OutlineLike | Immersion) -> Obstruction:
    found = find_layering(subject) if isinstance(subject, Immersion) else find_immersion(subject)
    if not isinstance(found, Obstruction):
        raise InputError(f"nothing is in the way: {found!r}", hint="give an immersion to see why it has no layering")
    return found


def _plot_steps(subject: Immersion, obstruction: Obstruction, ax: Axes | None) -> Axes:
    steps = _steps(obstruction)
    if not steps:
        return _plot_places(subject.arrangement, obstruction, ax)
    axes = plot_arrangement(subject.arrangement, ax)
    points = drawn_points(subject.arrangement)
    frame = Frame(points)
    _number_cells(axes, subject.arrangement, [cell for cell, _ in steps], frame)
    if obstruction.reason == "reversed pair":
        _arrows_between(axes, subject, steps, frame)
    _chips(axes, steps, float(frame(points)[:, 1].min()))
    write_below(axes, str(obstruction))
    return axes


def _steps(obstruction: Obstruction) -> list[Step]:
    """Return the cells and sheets that an obstruction to a layering names; none for other obstructions."""
    if obstruction.reason == "reversed pair":
        return [(cell, (lower, upper)) for cell, lower, upper in obstruction.value]
    if obstruction.reason == "cyclic order":
        return [(cell, tuple(sheets)) for cell, sheets in obstruction.value]
    if obstruction.reason == "fixed orders":
        return [(cell, (first, second)[:: _BACK[order]]) for cell, first, second, order in obstruction.value]
    return []


def _plot_places(arrangement: Arrangement, obstruction: Obstruction, ax: Axes | None) -> Axes:
    axes = plot_arrangement(arrangement, ax, obstruction=obstruction)
    if obstruction.reason == "negative winding":
        frame = Frame(drawn_points(arrangement))
        for cell in np.flatnonzero(arrangement.winding < 0).tolist():
            _highlight(axes, arrangement, cell, frame)
    return axes


def _highlight(axes: Axes, arrangement: Arrangement, cell: int, frame: Frame) -> None:
    colour = mix(winding_colour(int(arrangement.winding[cell])), OBSTRUCTION, 0.25)
    region(axes, cell_rings(arrangement, cell, frame), colour, edgecolor=OBSTRUCTION, linewidth=1.2, zorder=1.5)


def _number_cells(axes: Axes, arrangement: Arrangement, cells: Sequence[int], frame: Frame) -> None:
    """Highlight the cells, and write into each at which steps it is visited."""
    visits: defaultdict[int, list[str]] = defaultdict(list)
    for number, cell in enumerate(cells, 1):
        visits[cell].append(str(number))
    box = {"boxstyle": "round,pad=0.2", "facecolor": PAPER, "edgecolor": OBSTRUCTION, "linewidth": 0.8}
    for cell, numbers in visits.items():
        _highlight(axes, arrangement, cell, frame)
        rows = [" ".join(numbers[i : i + 4]) for i in range(0, len(numbers), 4)]
        (place,) = frame(label_circle(arrangement, cell)[:2])
        write(axes, place, "\n".join(rows), 6.0, bbox=box, **_NUMBER)


def _arrows_between(axes: Axes, immersion: Immersion, steps: Sequence[Step], frame: Frame) -> None:
    """Draw a short arrow across the border from each step to the next; each once, there and back side by side."""
    crossed = {_border_between(immersion, step, following): None for step, following in pairwise(steps)}
    for border, leftward in crossed:
        middle, (dx, dy) = border_middle(frame(border_line(immersion.arrangement, border)))
        forward = np.array([-dy, dx]) if leftward else np.array([dy, -dx])
        keep_right = 0.014 * np.array([forward[1], -forward[0]])
        (x0, y0), (x1, y1) = ((middle + keep_right + length * forward).tolist() for length in (-0.025, 0.025))
        style: dict[str, Any] = {"arrowstyle": "-|>", "mutation_scale": 8, "shrinkA": 0, "shrinkB": 0}
        axes.add_patch(FancyArrowPatch((x0, y0), (x1, y1), color=OBSTRUCTION, linewidth=1.2, zorder=7, **style))


def _border_between(immersion: Immersion, step: Step, following: Step) -> tuple[int, bool]:
    """Return the border over which the sheets of one step are glued to those of the next, and whether towards left."""
    for leftward, (right, left) in ((True, (step, following)), (False, (following, step))):
        carried = [
            immersion.gluing[(immersion.gluing[:, 1:] == glued).all(axis=1), 0]
            for glued in zip(right[1], left[1], strict=True)
        ]
        common = np.intersect1d(*carried)
        if len(common):
            return int(common[0]), leftward
    raise AssertionError("the sheets of a chain are glued to one another")


def _chips(axes: Axes, steps: Sequence[Step], below: float) -> None:
    """Draw the sheets of each step as a pile of numbered chips, in rows below the drawing."""
    pile = max(len(sheets) for _, sheets in steps)
    floor = below
    for row in range(0, min(len(steps), _MOST_STEPS), _STEPS_IN_A_ROW):
        shown = steps[row : row + _STEPS_IN_A_ROW]
        floor -= (pile + 2.0) * _CHIP
        left = -1.3 * _CHIP * (len(shown) - 1) / 2
        for place, (_, sheets) in enumerate(shown):
            foot = (left + 1.3 * _CHIP * place, floor)
            axes.annotate(str(row + place + 1), foot, (0, -6), textcoords="offset points", fontsize=6.5, **_NUMBER)
            _pile(axes, sheets, foot)


def _pile(axes: Axes, sheets: Sequence[int], foot: tuple[float, float]) -> None:
    x, floor = foot
    half = np.array([(-0.5, 0.06), (0.5, 0.06), (0.5, 0.94), (-0.5, 0.94)])
    for level, sheet in enumerate(sheets):
        colour = sheet_colour(sheet)
        corners: Floats = (half + np.array([0.0, level])) * _CHIP + np.array([x, floor])
        polygon(axes, corners, colour, zorder=3)
        write(axes, (x, floor + (level + 0.5) * _CHIP), str(sheet), 6.5, color=text_colour(colour), zorder=4)
