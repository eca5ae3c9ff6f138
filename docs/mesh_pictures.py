"""Rebuild the picture of meshes and their smallest angles: ``make pictures``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import plyfold as pf
from plyfold.draw.figures import save
from plyfold.gallery import CURVES
from plyfold.mesh.cells import CellTriangulation, triangulate_cells

HERE = Path(__file__).parent
DRAWN = ("pretzel", "stacked-spiral", "bennequin")
TRIANGLES = 1500
BOUND = 25


def smallest_angles(mesh: CellTriangulation) -> np.ndarray:
    """Return the smallest angle of each triangle, in degrees."""
    corner = mesh.points[mesh.triangles]
    to_next, to_last = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
    sine = to_next[..., 0] * to_last[..., 1] - to_next[..., 1] * to_last[..., 0]
    return np.degrees(np.arctan2(sine, (to_next * to_last).sum(axis=2))).min(axis=1)


def draw_mesh(name: str, ax: Axes) -> None:
    """Draw the triangles, with those of sharp angles filled."""
    mesh = triangulate_cells(pf.arrange(CURVES[name].curve), triangles=TRIANGLES)
    ax.triplot(*mesh.points.T, mesh.triangles, linewidth=0.3, color="0.35")
    x, y = mesh.points[mesh.chain].T
    ax.plot(np.append(x, x[0]), np.append(y, y[0]), linewidth=1.0, color="black")
    for triangle in mesh.triangles[smallest_angles(mesh) < BOUND - 1e-6]:
        ax.fill(*mesh.points[triangle].T, color="tab:orange")
    ax.set_title(f"{name}: {len(mesh.triangles):,} triangles over the plane")
    ax.set_aspect("equal")
    ax.axis("off")


def draw_histogram(ax: Axes) -> None:
    """Draw how many triangles of the gallery's surfaces have which smallest angle."""
    drawings = [pf.arrange(named.curve) for named in CURVES.values() if named.embeddable]
    angles = np.concatenate([smallest_angles(triangulate_cells(drawn)) for drawn in drawings])
    ax.hist(angles, bins=np.arange(61), color="tab:blue")
    ax.axvline(BOUND, color="tab:orange")
    ax.set_yscale("log")
    ax.set_xlabel("smallest angle of a triangle (degrees)")
    ax.set_title(f"{len(angles):,} triangles of the gallery, {(angles < BOUND - 1e-6).sum()} below {BOUND}°")


def main() -> None:
    """Draw three meshes and the histogram."""
    figure = Figure(figsize=(13, 11), layout="tight")
    axes = figure.subplots(2, 2).ravel()
    for name, ax in zip(DRAWN, axes[:3], strict=True):
        draw_mesh(name, ax)
    draw_histogram(axes[3])
    save(figure, HERE / "images" / "mesh.png", force=True)


if __name__ == "__main__":
    main()
