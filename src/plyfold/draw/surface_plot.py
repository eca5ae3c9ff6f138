"""The lifted surface, shaded, with its outline: dashed where it is hidden."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import INK, OBSTRUCTION, layer_colour, rgb, sheet_colour
from plyfold.draw.canvas import blank, cusp_signs, line
from plyfold.draw.depth_buffer import View
from plyfold.draw.over_under import ClothColours
from plyfold.draw.placement import closed, cusps_drawn, line_weight, mark_weight, middle_and_size, natural_stretch
from plyfold.draw.render import Image, Mesh, shade
from plyfold.errors import InputError
from plyfold.options import refuse_unless_count, refuse_unless_number

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from plyfold.surface.lift import Surface

__all__ = ["plot_surface"]

Direction = Literal["above", "side"] | tuple[float, float]

_MOST_PIXELS = 20_000
_DIRECTIONS: dict[str, tuple[float, float]] = {"above": (-72.0, 52.0), "side": (-60.0, 20.0)}


def plot_surface(  # noqa: PLR0913 - each option is keyword-only and independent
    surface: Surface,
    ax: Axes | None = None,
    view: Direction = "above",
    *,
    colours: ClothColours = "cloth",
    stretch: float | None = None,
    pixels: int = 900,
) -> Axes:
    """Draw the lifted surface, shaded, the outline as a dark line, dashed where it is hidden, and marks at cusps.

    Light comes from the upper left; sheets darken what lies close below them, and stand out from it by a pale rim.
    Where sheets pass through each other, there is a red line.

    Parameters
    ----------
    surface : Surface
    ax : matplotlib Axes, optional
        Where to draw; by default on a new figure.
    view : {"above", "side"} or (azimuth, elevation)
        Where from, in degrees; ``(-90, 90)`` looks straight down and equals the drawing.
    colours : {"cloth", "layers", "sheets"}
        Blue above and warm below, lighter where it is higher; or a colour for each level; or for each sheet, the same
        as in :func:`plot_layout`, :func:`plot_immersion` and :func:`plot_layers`.
    stretch : float, optional
        Vertical scale; by default chosen so that the layers can be told apart.
    pixels : int, optional
        Along the longer side; 300 for each inch of the printed picture is enough.

    Returns
    -------
    matplotlib Axes
        Cost: about a second for 900 pixels.

    Raises
    ------
    InputError
        If an option is unknown.

    Examples
    --------
    >>> from plyfold import lift
    >>> ax = plot_surface(lift([(0, 0), (1, 0), (0, 1)]), pixels=60)
    >>> len(ax.images)
    1
    """
    if stretch is not None:
        refuse_unless_number("stretch", stretch)
        if not 0 < stretch < np.inf:
            raise InputError(f"stretch must be positive, not {stretch!r}")
    refuse_unless_count("pixels", pixels, _MOST_PIXELS)
    axes = blank(ax)
    unit, mesh = _unit_and_mesh(surface, stretch)
    image = shade(mesh, _view(view), pixels, _paint(surface, colours))
    axes.imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased", zorder=1)
    width = 1.4 * line_weight(surface.layering.immersion.arrangement.n_crossings)
    for loop in np.split(surface.boundary, surface.first_boundary[1:-1]):
        _line_in_space(axes, mesh.vertices[closed(loop)], image, INK, width)
    for polyline in surface.intersections:
        _line_in_space(axes, unit(polyline), image, OBSTRUCTION, width)
    if len(surface.cusps):
        _cusps_in_space(axes, surface, mesh.vertices[surface.cusps], image)
    return axes


@lru_cache(maxsize=2)
def _unit_and_mesh(surface: Surface, stretch: float | None) -> tuple[_Unit, Mesh]:
    """Return a surface scaled to be drawn: the same for every view, so that the lights look at it once."""
    unit = _Unit(surface, stretch)
    return unit, Mesh(unit(surface.vertices), surface.faces)


def _view(view: Direction) -> View:
    if isinstance(view, str) and view not in _DIRECTIONS:
        raise InputError(f"there is no view {view!r}", hint=f"use one of {', '.join(_DIRECTIONS)}, or two angles")
    if not isinstance(view, str) and not (isinstance(view, tuple | list) and len(view) == 2):
        raise InputError(f"a view is a name or two angles, not {view!r}", hint=f"use one of {', '.join(_DIRECTIONS)}")
    azimuth, elevation = _DIRECTIONS[view] if isinstance(view, str) else view
    refuse_unless_number("azimuth", azimuth)
    refuse_unless_number("elevation", elevation)
    return View.of(azimuth, elevation)


def _paint(surface: Surface, colours: ClothColours) -> Floats | None:
    """Return the colour of each triangle, or None for cloth that is coloured by its height."""
    if colours == "cloth":
        return None
    level = surface.layering.level
    if colours == "sheets":
        palette = [rgb(sheet_colour(sheet)) for sheet in range(len(level))]
    elif colours == "layers":
        shown = np.minimum(level, surface.n_layers).tolist()
        palette = [rgb(layer_colour(each, surface.n_layers)) for each in shown]
    else:
        raise InputError(f"there are no colours {colours!r}", hint=f"use one of {', '.join(get_args(ClothColours))}")
    return np.array(palette)[surface.sheet]


class _Unit:
    """A surface scaled to size 1 in the plane, with the heights stretched."""

    def __init__(self, surface: Surface, stretch: float | None) -> None:
        self.middle, _ = middle_and_size(surface.vertices)
        _, self.size = middle_and_size(surface.vertices[:, :2])
        self.stretch = natural_stretch(surface.vertices) if stretch is None else stretch

    def __call__(self, points: Floats) -> Floats:
        return np.asarray((points - self.middle) / self.size * (1.0, 1.0, self.stretch))


def _cusps_in_space(axes: Axes, surface: Surface, places: Floats, image: Image) -> None:
    """Mark the cusps, paler where something lies before them."""
    arrangement, hidden = surface.layering.immersion.arrangement, image.hidden(places)
    plane, (_, indices) = image.view.project(places)[:, :2], cusps_drawn(arrangement)
    for kind, alpha in ((hidden, 0.4), (~hidden, 1.0)):
        shown = [indices[number] for number in np.flatnonzero(kind)]
        cusp_signs(axes, plane[kind], shown, mark_weight(arrangement.n_crossings), alpha)


def _line_in_space(axes: Axes, corners: Floats, image: Image, colour: str, width: float) -> None:
    """Draw a polyline in space over the image: dark where it is seen, dashed where something lies before it."""
    points = _resampled(corners, 2 * image.seen.pixels.size)
    hidden = image.hidden(points)
    cuts = np.flatnonzero(hidden[1:] != hidden[:-1]) + 1
    plane = image.view.project(points)[:, :2]
    for start, end in zip([0, *cuts], [*cuts, len(plane)], strict=True):
        if hidden[start]:
            line(axes, plane[start : end + 1], colour, width / 2, zorder=2, alpha=0.45, linestyle=(0, (4, 2.5)))
        else:
            line(axes, plane[start : end + 1], colour, width, zorder=3, solid_capstyle="round")


def _resampled(points: Floats, step: float) -> Floats:
    """Return a polyline with extra points, so that no edge is longer than the step."""
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    travelled = np.concatenate([[0.0], np.cumsum(lengths)])
    at = np.union1d(travelled, np.arange(0, travelled[-1], step))
    return np.stack([np.interp(at, travelled, points[:, i]) for i in range(points.shape[1])], axis=1)
