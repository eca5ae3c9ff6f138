"""Rebuild the picture of the unwound disk: ``make pictures``. A counterpart of figures 2, 4 and 6 of the paper."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

import plyfold as pf
from plyfold.arrays import Floats
from plyfold.draw.canvas import blank, line
from plyfold.draw.colours import INK, rgb, sheet_colour
from plyfold.draw.depth_buffer import View
from plyfold.draw.figures import save
from plyfold.draw.places import natural_stretch
from plyfold.draw.render import Mesh, shade
from plyfold.gallery import CURVES

HERE = Path(__file__).parent
NAMES = ("exit-ramp", "milnor", "stacked-spiral")
SQUARES = 10


def checkered(surface: pf.Surface) -> Floats:
    """Return the colour of each triangle: that of its sheet, darker on every other square of the disk."""
    unwound = surface.unwrap()
    square = np.floor(unwound.uv[unwound.faces].mean(axis=1) * SQUARES).sum(axis=1) % 2
    plain = np.array([rgb(sheet_colour(sheet)) for sheet in range(unwound.immersion.n_sheets)])[unwound.sheet]
    return np.asarray(plain * (1 - 0.22 * square[:, None]))


def flat(ax: Axes, points: Floats, surface: pf.Surface, colours: Floats, opacity: float) -> None:
    """Draw the triangles in the plane, and the curve."""
    blank(ax)
    cloth = PolyCollection(
        list(points[surface.faces]), facecolors=colours, alpha=opacity, linewidths=0, antialiased=False
    )
    ax.add_collection(cloth)
    line(ax, points[np.append(surface.boundary, 0)], INK, 1.6)


def row(axes: list[Axes], surface: pf.Surface) -> None:
    """Draw the disk, the drawing laid flat, and the surface."""
    unwound, colours = surface.unwrap(), checkered(surface)
    flat(axes[0], unwound.disk, surface, colours, 1.0)
    for arc in unwound.arcs:
        line(axes[0], arc.points, INK, 1.2, linestyle=(0, (4, 2)))
    for number in range(unwound.immersion.arrangement.n_borders):
        x, y = unwound.disk[unwound.border(number)[0]]
        line(axes[0], np.array([(0.97 * x, 0.97 * y), (1.05 * x, 1.05 * y)]), INK, 1.6)
    flat(axes[1], unwound.plane, surface, colours, 0.62)
    stretched = surface.vertices * [1, 1, natural_stretch(surface.vertices)]
    image = shade(Mesh(stretched, surface.faces), View.of(-72.0, 52.0), 500, colours)
    blank(axes[2]).imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased")
    for ax in axes:
        ax.set_aspect("equal")
        ax.autoscale_view()


def main() -> None:
    """Draw one row for each curve."""
    figure = Figure(figsize=(12, 4 * len(NAMES)), layout="tight")
    for axes, name in zip(figure.subplots(len(NAMES), 3), NAMES, strict=True):
        row(list(axes), pf.lift(CURVES[name].curve, triangles=80_000))
    save(figure, HERE / "images" / "unwound.png", force=True)


if __name__ == "__main__":
    main()
