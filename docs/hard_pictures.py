"""Rebuild the pictures of docs/hard.md: ``python docs/hard_pictures.py``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import plyfold as pf
from plyfold.draw import plot_arrangement
from plyfold.draw.figures import save
from plyfold.hard.flaps import PALEY, flap_disk
from plyfold.hard.symmetric import search_symmetric

IMAGES = Path(__file__).parent / "images"


def flaps() -> None:
    """Draw three flaps in a circle, three that all cover each other's handles, and Paley's seven."""
    circle = [(0, 1), (1, 2), (2, 0)]
    disks = {
        "a circle of three: both sides are needed": flap_disk(3, circle),
        "all three cover each other: no layering": flap_disk(3, circle + [(j, i) for i, j in circle]),
        "Paley's seven: no layering, and no pair returns reversed": flap_disk(7, PALEY),
    }
    figure = Figure(figsize=(13, 9), layout="constrained")
    upper = figure.add_gridspec(2, 2)
    places = (upper[0, 0], upper[0, 1], upper[1, :])
    for (title, disk), place in zip(disks.items(), places, strict=True):
        draw_curve(figure.add_subplot(place), disk.curve)
        figure.axes[-1].set_title(f"{title} (k = {disk.immersion.arrangement.n_crossings})")
    save(figure, IMAGES / "hard-flaps.png", force=True)


def draw_curve(ax: Axes, curve: pf.Curve) -> None:
    """Draw a curve with its winding numbers as shades."""
    plot_arrangement(pf.arrange(curve), ax=ax)


def symmetric() -> None:
    """Draw finds of the symmetric search, one for each order."""
    figure = Figure(figsize=(13, 4.6), layout="constrained")
    for ax, (order, seed, triangles) in zip(figure.subplots(1, 3), [(3, 62, 5), (5, 1, 10), (2, 0, 24)], strict=True):
        found = list(
            search_symmetric(np.random.default_rng(seed), order, triangles, attempts=60 if order == 3 else 400)
        )
        best = min(found, key=lambda each: each.immersion.arrangement.n_crossings)
        draw_curve(ax, best.curve)
        ax.set_title(f"order {order}, k = {best.immersion.arrangement.n_crossings}")
    save(figure, IMAGES / "hard-symmetric.png", force=True)


if __name__ == "__main__":
    IMAGES.mkdir(exist_ok=True)
    flaps()
    symmetric()
