"""Rebuild the pictures of surface.md: smooth heights beside interpolated levels, what options and meshes do."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import numpy as np
from matplotlib.figure import Figure

import plyfold as pf
from plyfold.arrays import Floats
from plyfold.draw import plot_surface
from plyfold.draw.figures import save
from plyfold.gallery import CURVES
from plyfold.surface import grading

HERE = Path(__file__).parent


def interpolated_levels(surface: pf.Surface) -> pf.Surface:
    """Return the surface with each vertex at so many gaps as vertices lie below it, and straight between."""
    vertices: Floats = surface.vertices.copy()
    order = np.lexsort(vertices.T[[2, 1, 0]])
    over = (vertices[order[1:], :2] == vertices[order[:-1], :2]).all(axis=1)
    place = np.arange(len(order))
    lowest = np.maximum.accumulate(np.where(np.concatenate([[True], ~over]), place, 0))
    vertices[order, 2] = surface.gap * (place - lowest)
    return replace(surface, vertices=vertices)


def naive_beside_smooth() -> None:
    """Draw three curves with heights from their levels alone, and with the least energy."""
    names = ["exit-ramp", "stacked-spiral", "bennequin"]
    figure = Figure(figsize=(12, 7), layout="tight")
    axes = figure.subplots(2, len(names))
    for column, name in enumerate(names):
        surface = pf.lift(CURVES[name].curve, triangles=6000)
        for row, shown in enumerate((interpolated_levels(surface), surface)):
            plot_surface(shown, ax=axes[row, column])
            axes[row, column].set_title(f"{name}: {('levels, interpolated', 'least energy')[row]}", fontsize=11)
    save(figure, HERE / "images" / "surface-heights.png", force=True)


def stiffness() -> None:
    """Draw the Milnor-like curve in softer and stiffer cloth."""
    chosen = {0.1: "0.1", 0.5: "0.5, the default", 5.0: "5"}
    figure = Figure(figsize=(12, 3.6), layout="tight")
    for ax, (value, title) in zip(figure.subplots(1, len(chosen)), chosen.items(), strict=True):
        plot_surface(pf.lift(CURVES["milnor"].curve, triangles=6000, stiffness=value), ax=ax)
        ax.set_title(f"stiffness {title}", fontsize=11)
    save(figure, HERE / "images" / "surface-stiffness.png", force=True)


def convergence() -> None:
    """Draw how the range of heights changes with the mesh, with and without smaller triangles at corners."""
    sizes, figure = (4_000, 16_000, 64_000, 256_000), Figure(figsize=(12, 3.6), layout="tight")
    names = ["milnor", "bennequin", "ten-gon"]
    for ax, name in zip(figure.subplots(1, len(names)), names, strict=True):
        with patch.object(grading, "_WIDEST", np.inf):
            made = [_range_of(name, size) for size in sizes]
        graded = [_range_of(name, size) for size in sizes]
        for values, label in ((made, "the surface's own triangles"), (graded, "graded towards corners")):
            ax.semilogx(*zip(*values, strict=True), "o-", label=label)
        ax.axhspan(0.995 * graded[-1][1], 1.005 * graded[-1][1], color="0.9", label="± 0.5 %")
        ax.set(title=name, xlabel="triangles", ylabel="range of heights, in gaps")
    figure.axes[0].legend(fontsize=8)
    save(figure, HERE / "images" / "surface-convergence.png", force=True)


def _range_of(name: str, size: int) -> tuple[int, float]:
    """Return the number of triangles of a lifted curve, and how many gaps lie between its lowest and highest vertex."""
    surface = pf.lift(CURVES[name].curve, triangles=size)
    return len(surface.faces), float(np.ptp(surface.vertices[:, 2]) / surface.gap)


if __name__ == "__main__":
    (HERE / "images").mkdir(exist_ok=True)
    naive_beside_smooth()
    stiffness()
    convergence()
