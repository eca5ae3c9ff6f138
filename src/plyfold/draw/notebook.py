"""Pictures for notebooks: figures that show themselves as the last line of a cell, and pictures of values as PNG.

Jupyter asks a value for ``_repr_png_``, and matplotlib's figures have none unless its inline backend is on. That one
shows the figures that pyplot knows, at the end of a cell; it does not know those made here, so none is shown twice.
"""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from plyfold.colours import INK, PAPER, rgb, sheet_colour
from plyfold.draw.canvas import blank, closed, line
from plyfold.draw.depth_buffer import View
from plyfold.draw.obstruction_plot import plot_obstruction
from plyfold.draw.places import middle_and_size
from plyfold.draw.render import Mesh, shade
from plyfold.obstruction import Obstruction

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk
    from plyfold.surface.thicken import Solid

__all__ = ["ShownFigure", "new_axes", "obstruction_png", "solid_png", "unwound_png"]

_DOTS_PER_INCH = 80
_SIZE = (4.0, 4.0)
_PIXELS = 400
_FROM_ABOVE = (-72.0, 52.0)


class ShownFigure(Figure):
    """A figure that a notebook shows."""

    def _repr_png_(self) -> bytes:
        drawn = BytesIO()
        self.savefig(drawn, format="png", dpi=_DOTS_PER_INCH, facecolor="white")
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


def obstruction_png(obstruction: Obstruction) -> bytes | None:
    """Return the picture of an obstruction on its drawing, if it knows one."""
    subject = obstruction.subject
    drawn = getattr(subject, "arrangement", subject)
    if drawn is None or drawn.curve is None:
        return None
    axes = new_axes(_SIZE)
    plot_obstruction(subject, obstruction, axes)
    return axes._repr_png_()


def unwound_png(unwound: UnwoundDisk) -> bytes:
    """Return the unwound disk with its sheets in their colours and the seams between them."""
    axes = new_axes(_SIZE)
    blank(axes)
    palette = np.array([rgb(sheet_colour(sheet)) for sheet in range(unwound.immersion.n_sheets)])
    colours = palette[unwound.sheet]
    corners, ends = list(unwound.disk[unwound.faces]), list(unwound.disk[unwound.seams])
    axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors="none", antialiaseds=False))
    axes.add_collection(LineCollection(ends, colors=PAPER, linewidths=0.8))
    line(axes, closed(unwound.disk[unwound.boundary]), INK, 1.6)
    return axes._repr_png_()


def solid_png(solid: Solid) -> bytes:
    """Return the solid from above, in its true height, with its sheets in their colours."""
    middle, size = middle_and_size(solid.vertices)
    palette = np.array([rgb(sheet_colour(sheet)) for sheet in range(int(solid.sheet.max()) + 1)])
    mesh = Mesh((solid.vertices - middle) / size, solid.faces)
    image = shade(mesh, View.of(*_FROM_ABOVE), _PIXELS, palette[solid.sheet])
    axes = new_axes(_SIZE)
    blank(axes)
    axes.imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased")
    return axes._repr_png_()
