"""Pictures of values for notebooks, as PNG."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from plyfold.colours import INK, PAPER, rgb, sheet_colour
from plyfold.draw.canvas import blank, line, new_axes
from plyfold.draw.depth_buffer import View
from plyfold.draw.immersion_plot import plot_immersion
from plyfold.draw.obstruction_plot import plot_obstruction
from plyfold.draw.placement import closed, middle_and_size
from plyfold.draw.render import Mesh, shade
from plyfold.obstruction import Obstruction

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk
    from plyfold.immersion.immersion import Immersion
    from plyfold.surface.thicken import Solid

__all__ = ["immersion_png", "obstruction_png", "solid_png", "unwound_png"]

_SIZE = (4.0, 4.0)
_PIXELS = 400
_FROM_ABOVE = (-72.0, 52.0)


def obstruction_png(obstruction: Obstruction) -> bytes | None:
    """Return the picture of an obstruction on its drawing, if it knows one."""
    subject = obstruction.subject
    drawn = getattr(subject, "arrangement", subject)
    if drawn is None or drawn.outline is None:
        return None
    axes = new_axes(_SIZE)
    plot_obstruction(subject, obstruction, axes)
    return axes._repr_png_()


def immersion_png(immersion: Immersion) -> bytes:
    """Return an immersed surface as it lies over its drawing."""
    axes = new_axes(_SIZE)
    plot_immersion(immersion, axes)
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
