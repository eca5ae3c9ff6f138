"""Rebuild the pictures of the README: ``make pictures``."""

from __future__ import annotations

from pathlib import Path
from textwrap import fill

from matplotlib.figure import Figure
from outlines_pictures import linked, torus_layering
from panels import save_small

import plyfold as pf
from plyfold.colours import OBSTRUCTION
from plyfold.draw import plot_arrangement, plot_surface
from plyfold.draw.canvas import write
from plyfold.draw.figures import summary
from plyfold.gallery import CURVES, OUTLINES, NamedOutline

HERE = Path(__file__).parent
COLUMNS = 4


def overview() -> None:
    """Draw every stage for the example of ``make demo``."""
    surface = pf.lift(pf.read(HERE.parent / "examples" / "ramp.svg"))
    summary(surface, HERE / "images" / "overview.png", force=True)


def gallery() -> None:
    """Draw each named curve and outline with its cells, and its surface beside it where there is one."""
    everything = [*CURVES.values(), *OUTLINES.values()]
    rows = -(-len(everything) // COLUMNS)
    figure = Figure(figsize=(4.6 * COLUMNS, 2.9 * rows), layout="tight")
    axes = figure.subplots(rows, 2 * COLUMNS).ravel()
    for ax in axes:
        ax.axis("off")
    for place, named in enumerate(everything):
        flat, lifted = axes[2 * place : 2 * place + 2]
        plot_arrangement(pf.arrange(named.outline), ax=flat)
        flat.set_title(named.name, loc="left", fontsize=12, weight="bold")
        if named.embeddable:
            plot_surface(pf.lift(layered(named)), ax=lifted, pixels=450)
        else:
            reason = fill(f"No disk. {pf.find_embedding(named.outline)}".replace("No disk. No ", "No "), 26)
            write(lifted, (0.5, 0.5), reason, 10.0, va="center", color=OBSTRUCTION, transform=lifted.transAxes)
    save_small(figure, "gallery", 160)


def layered(named: NamedOutline) -> pf.Outline | pf.Layering:
    """Return what to lift: of the two rings a layering that links them, of the torus's front that of the torus."""
    if named.name == "linked-rings":
        return linked(named.outline)
    return torus_layering(named.outline) if named.name == "torus-front" else named.outline


if __name__ == "__main__":
    (HERE / "images").mkdir(exist_ok=True)
    overview()
    gallery()
