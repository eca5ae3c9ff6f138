"""Pictures of every stage with matplotlib, each on axes of your own or on a new figure.

New figures are not registered with pyplot: nothing pops up, and nothing has to be closed.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats
from plyfold.draw.colours import ACCENT, INK, OBSTRUCTION, mix, sheet_colour, text_colour, winding_colour
from plyfold.draw.depth_buffer import View
from plyfold.draw.hyperbolic import BorderCircle
from plyfold.draw.places import (
    Frame,
    arrows,
    border_middle,
    label_circle,
    line_weight,
    middle_and_size,
    natural_stretch,
)
from plyfold.draw.render import Image, Mesh, shade

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.arrangement import Arrangement
    from plyfold.immersion import Immersion
    from plyfold.layering import Layering
    from plyfold.layering.intersections import IntersectingLayering
    from plyfold.obstruction import Obstruction
    from plyfold.surface import Surface

__all__ = ["plot_arrangement", "plot_disk_layout", "plot_layers", "plot_surface"]

Places = tuple[tuple[float, float], ...]
T = TypeVar("T", bound=np.generic)
Direction = Literal["above", "side"] | tuple[float, float]

_DIRECTIONS: dict[str, tuple[float, float]] = {"above": (-72.0, 52.0), "side": (-60.0, 20.0)}
_MOST_NUMBERS = 60
_SHEAR = np.array([[1.0, 0.0], [0.42, 0.46]])


def plot_arrangement(
    arrangement: Arrangement,
    ax: Axes | None = None,
    *,
    obstruction: Obstruction | None = None,
    borders: bool = False,
) -> Axes:
    """Draw the curve with its cells shaded by winding number.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing.
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    obstruction : Obstruction, optional
        Mark its places by red crosses and put its sentence below.
    borders : bool
        Number the borders.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> from plyfold import arrangement
    >>> ax = plot_arrangement(arrangement([(0, 0), (2, 2), (2, 0), (0, 2)]))
    >>> sorted(text.get_text() for text in ax.texts)
    ['1', '−1']
    """
    axes = _blank(ax)
    frame = Frame(_points(arrangement))
    _fill_cells(axes, arrangement, frame)
    weight = line_weight(arrangement.n_crossings)
    _line(axes, _closed(frame(_points(arrangement))), INK, 1.6 * weight)
    _arrowheads(axes, arrangement, frame)
    rim = {"edgecolors": "white", "linewidths": 0.6 * weight, "zorder": 4}
    _dots(axes, frame(arrangement.crossings), ACCENT, 16 * weight**2, **rim)
    _winding_numbers(axes, arrangement, frame, () if obstruction is None else obstruction.where)
    if borders:
        _border_numbers(axes, arrangement, frame)
    if obstruction is not None:
        _mark(axes, obstruction, frame)
    return axes


def plot_disk_layout(immersion: Immersion, ax: Axes | None = None) -> Axes:
    """Draw the disk layout: the disk unwound to a circle, with the borders in order around it (§2.2 of [MGR11]_).

    Every sheet with borders of its own is a region in its own colour, and the paper's arcs join its borders, or a
    border alone to itself. The arcs are hyperbolic lines, so those of different sheets never meet.

    Parameters
    ----------
    immersion : Immersion
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.

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
    >>> ax = plot_disk_layout(find_immersion([(0, 0), (1, 0), (0, 1)]))
    >>> [text.get_text() for text in ax.texts]
    ['0']
    """
    axes = _blank(ax)
    borders = immersion.arrangement.n_borders
    circle = BorderCircle(borders)
    _polygon(axes, BorderCircle(1).arc(0), mix(winding_colour(1), "#ffffff", 0.45))
    for group in immersion.disk_layout():
        colour = sheet_colour(group.sheet)
        _polygon(axes, circle.region(group.borders), mix(colour, "#ffffff", 0.62))
        for border, other in group.arcs:
            _line(axes, circle.join(border, other), mix(colour, INK, 0.15), 1.5)
    for border, sheet in enumerate(immersion.own_sheet.tolist()):
        _line(axes, circle.arc(border, 1.02), sheet_colour(sheet), 5.0)
        if borders <= _MOST_NUMBERS:
            _text(axes, circle.middle(border, 1.12), str(border), 8.5 if borders <= 36 else 6.0)
    axes.update_datalim([(-1.15, -1.15), (1.15, 1.15)])
    return axes


def plot_layers(layering: Layering | IntersectingLayering, ax: Axes | None = None) -> Axes:
    """Draw the layers one above the other, pulled apart and seen at a slant.

    Each layer holds one sheet over every cell it covers, coloured as in :func:`plot_disk_layout`; the strands of the
    curve that lie in the layer are dark, and lines where the cloth goes on, here or to the next layer, are white.

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
    axes = _blank(ax)
    points = _points(layering.immersion.arrangement)
    frame = Frame(points)
    flat = frame(points) @ _SHEAR
    spacing = 0.08 + 0.74 * float(np.ptp(flat[:, 1]))
    levels = int(layering.level.max(initial=1))
    for level in range(1, levels + 1):
        lift = np.array([0.0, spacing * (level - 1)])
        _line(axes, _closed(flat) + lift, mix(INK, "#ffffff", 0.78), 0.7)
        _layer(axes, layering, level, frame, lift)
        _text(axes, (flat[:, 0].min() - 0.03, lift[1]), f"layer {level}", 9.0, ha="right")
    return axes


def plot_surface(
    surface: Surface,
    ax: Axes | None = None,
    view: Direction = "above",
    *,
    stretch: float | None = None,
    pixels: int = 900,
) -> Axes:
    """Draw the lifted surface, shaded: blue on top, warm below, the curve as a dark line, faint where it is hidden.

    Where sheets pass through each other, there is a red line.

    Parameters
    ----------
    surface : Surface
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    view : {"above", "side"} or (azimuth, elevation)
        Where from, in degrees; ``(-90, 90)`` looks straight down and equals the drawing.
    stretch : float, optional
        Vertical scale; by default chosen so that the layers can be told apart.
    pixels : int
        Along the longer side.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> from plyfold import lift
    >>> ax = plot_surface(lift([(0, 0), (1, 0), (0, 1)]), pixels=60)
    >>> len(ax.images)
    1
    """
    axes = _blank(ax)
    unit = _Unit(surface, stretch)
    mesh = Mesh(unit(surface.vertices), surface.faces)
    image = shade(mesh, View.of(*(_DIRECTIONS[view] if isinstance(view, str) else view)), pixels)
    axes.imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased", zorder=1)
    _line_in_space(axes, mesh.vertices[_closed(surface.boundary)], image, INK)
    for polyline in surface.intersections:
        _line_in_space(axes, unit(polyline), image, OBSTRUCTION)
    return axes


# ---- the parts of an arrangement -----------------------------------------------------------------------------------


def _points(arrangement: Arrangement) -> Floats:
    """Return the points of the curve; raises the arrangement's own error if there is no drawing."""
    return arrangement.border_points(0) if arrangement.curve is None else arrangement.curve.points


def _fill_cells(axes: Axes, arrangement: Arrangement, frame: Frame) -> None:
    for cell in range(1, arrangement.n_cells):
        winding = int(arrangement.winding[cell])
        if winding:
            _polygon(axes, frame(arrangement.cell_outline(cell)), winding_colour(winding))


def _arrowheads(axes: Axes, arrangement: Arrangement, frame: Frame) -> None:
    for place, (dx, dy) in arrows(arrangement):
        (tip,) = frame(place)
        head = np.array([(0.018, 0), (-0.012, 0.0135), (-0.012, -0.0135)]) @ np.array([(dx, dy), (-dy, dx)])
        _polygon(axes, tip + head, INK, zorder=3)


def _winding_numbers(axes: Axes, arrangement: Arrangement, frame: Frame, marked: Places) -> None:
    """Write the winding number into every cell that has room for it, unless a marked place takes the room."""
    for cell in range(1, arrangement.n_cells):
        x, y, radius = label_circle(arrangement, cell)
        size = min(12.0, 260 * radius / frame.size)
        if size >= 4 and not any(np.hypot(x - a, y - b) < radius for a, b in marked):
            winding = int(arrangement.winding[cell])
            colour = text_colour(winding_colour(winding))
            _text(axes, frame((x, y))[0], f"{winding}".replace("-", "−"), size, color=colour)


def _border_numbers(axes: Axes, arrangement: Arrangement, frame: Frame) -> None:
    for border in range(arrangement.n_borders if arrangement.n_borders <= _MOST_NUMBERS else 0):
        place, (dx, dy) = border_middle(arrangement.border_points(border))
        x, y = frame(place)[0] + 0.026 * np.array([dy, -dx])
        _text(axes, (x, y), str(border), 6.5, color=mix(INK, "#ffffff", 0.25))


def _mark(axes: Axes, obstruction: Obstruction, frame: Frame) -> None:
    places = frame(obstruction.where)
    for width, colour in ((5.5, "white"), (2.6, OBSTRUCTION)):
        _dots(axes, places, colour, 130, marker="x", linewidths=width, zorder=6)
    write_below(axes, str(obstruction))


def write_below(axes: Axes, sentence: str) -> None:
    """Write why something does not exist below the drawing."""
    below = {"transform": axes.transAxes, "color": OBSTRUCTION, "va": "top", "wrap": True}
    _text(axes, (0.5, -0.02), sentence, 9.5, **below)


# ---- the parts of a layering ---------------------------------------------------------------------------------------


def _layer(axes: Axes, layering: Layering | IntersectingLayering, level: int, frame: Frame, lift: Floats) -> None:
    immersion = layering.immersion
    arrangement = immersion.arrangement
    for sheet in np.flatnonzero(layering.level == level).tolist():
        outline = frame(arrangement.cell_outline(int(immersion.sheet_cell[sheet]))) @ _SHEAR + lift
        _polygon(axes, outline, mix(sheet_colour(sheet), "#ffffff", 0.25), edgecolor="white", linewidth=0.7)
    for border in np.flatnonzero(layering.level[immersion.own_sheet] == level).tolist():
        points = arrangement.border_points(border)
        line = frame(_closed(points) if arrangement.n_crossings == 0 else points)
        _line(axes, line @ _SHEAR + lift, INK, 1.6)


# ---- the parts of a surface ----------------------------------------------------------------------------------------


class _Unit:
    """A surface scaled to size 1 in the plane, with the heights stretched."""

    def __init__(self, surface: Surface, stretch: float | None) -> None:
        self.middle, _ = middle_and_size(surface.vertices)
        _, self.size = middle_and_size(surface.vertices[:, :2])
        self.stretch = natural_stretch(surface.vertices) if stretch is None else stretch

    def __call__(self, points: Floats) -> Floats:
        return np.asarray((points - self.middle) / self.size * (1.0, 1.0, self.stretch))


def _line_in_space(axes: Axes, corners: Floats, image: Image, colour: str) -> None:
    """Draw a polyline in space over the image: dark where it is seen, faint where something lies before it."""
    points = _resampled(corners, 2 * image.seen.pixels.size)
    hidden = image.hidden(points)
    cuts = np.flatnonzero(hidden[1:] != hidden[:-1]) + 1
    plane = image.view.project(points)[:, :2]
    for start, end in zip([0, *cuts], [*cuts, len(plane)], strict=True):
        if hidden[start]:
            _line(axes, plane[start : end + 1], colour, 0.8, zorder=2, alpha=0.28)
        else:
            _line(axes, plane[start : end + 1], colour, 1.5, zorder=3)


def _resampled(points: Floats, step: float) -> Floats:
    """Return a polyline with extra points, so that no edge is longer than the step."""
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    travelled = np.concatenate([[0.0], np.cumsum(lengths)])
    at = np.union1d(travelled, np.arange(0, travelled[-1], step))
    return np.stack([np.interp(at, travelled, points[:, i]) for i in range(points.shape[1])], axis=1)


# ---- small tools ---------------------------------------------------------------------------------------------------


def _blank(ax: Axes | None) -> Axes:
    """Return empty axes of equal scale without a frame: the given ones, or those of a new figure."""
    if ax is None:
        from matplotlib.figure import Figure

        ax = Figure(figsize=(5, 5), layout="constrained").subplots()
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_axis_off()
    return ax


def _closed(points: npt.NDArray[T]) -> npt.NDArray[T]:
    return np.concatenate([points, points[:1]])


def _polygon(axes: Axes, points: Floats, colour: str, **style: Any) -> None:
    axes.fill(points[:, 0], points[:, 1], **{"facecolor": colour, "edgecolor": "none", "zorder": 1, **style})


def _line(axes: Axes, points: Floats, colour: str, width: float, **style: Any) -> None:
    joined = {"solid_joinstyle": "round", "solid_capstyle": "butt", "zorder": 2}
    axes.plot(points[:, 0], points[:, 1], color=colour, linewidth=width, **{**joined, **style})


def _dots(axes: Axes, points: Floats, colour: str, size: float, **style: Any) -> None:
    axes.scatter(points[:, 0], points[:, 1], s=size, color=colour, **style)


def _text(axes: Axes, place: Iterable[float], text: str, size: float, **style: Any) -> None:
    x, y = place
    middle = {"color": INK, "ha": "center", "va": "center_baseline", "zorder": 5}
    axes.text(x, y, text, fontsize=size, **{**middle, **style})
