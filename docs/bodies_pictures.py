"""Rebuild the pictures of bodies.md: round bodies and their profiles."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from panels import save_small

import plyfold as pf
from plyfold.colours import layer_colour, rgb
from plyfold.draw.depth_buffer import View
from plyfold.draw.placement import middle_and_size
from plyfold.draw.render import Mesh, shade
from plyfold.gallery import CURVES, OUTLINES
from plyfold.surface.inflate import Profile
from plyfold.surface.thicken import Solid

HERE = Path(__file__).parent
BODIES = ("pretzel", "ring", "letter-b", "limacon-with-cusp", "torus-front", "exit-ramp")
FROM_ABOVE, FROM_ASIDE = (-72.0, 52.0), (-80.0, 22.0)
PARABOLAS = "lambda bulge: bulge**2"


def show(solid: Solid, ax: Axes, title: str, view: tuple[float, float] = FROM_ABOVE) -> None:
    """Draw a solid in its true height, in the colours of its layers."""
    middle, size = middle_and_size(solid.vertices)
    surface = solid.surface
    paint = np.array([rgb(layer_colour(level, surface.n_layers)) for level in surface.layering.level])[solid.sheet]
    image = shade(Mesh((solid.vertices - middle) / size, solid.faces), View.of(*view), 620, paint)
    ax.imshow(image.colours, origin="lower", extent=image.extent, interpolation="antialiased")
    ax.set_title(title, fontsize=11)
    ax.axis("off")


def bodies() -> None:
    """Draw round bodies of the gallery."""
    figure = Figure(figsize=(12, 7.6), layout="tight")
    for ax, name in zip(figure.subplots(2, 3).ravel(), BODIES, strict=True):
        named = {**CURVES, **OUTLINES}[name]
        show(pf.lift(named.outline).inflate(), ax, name)
    save_small(figure, "bodies", 128)


def profiles() -> None:
    """Draw one letter in three profiles, from the side."""
    chosen: dict[str, Profile] = {'"round"': "round", '"flat"': "flat", PARABOLAS: np.square}
    surface = pf.lift(OUTLINES["letter-b"].outline)
    figure = Figure(figsize=(12, 3.4), layout="tight")
    for ax, (title, profile) in zip(figure.subplots(1, 3), chosen.items(), strict=True):
        show(surface.inflate(0.5, profile), ax, f"profile={title}", FROM_ASIDE)
    save_small(figure, "bodies-profiles", 128)


if __name__ == "__main__":
    (HERE / "images").mkdir(exist_ok=True)
    bodies()
    profiles()
