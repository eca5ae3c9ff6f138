"""Rebuild the track of the examples, and the pictures of ribbons.md: ``make pictures``."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from panels import panels, titled

import plyfold as pf
from plyfold.arrays import Floats
from plyfold.colours import INK
from plyfold.draw import plot_casing, plot_surface

EXAMPLES = Path(__file__).parents[1] / "examples"
_METRES_OF_A_DEGREE = 111_195.0


def climbing_loops() -> Floats:
    """Return a road that climbs in three loops: x and y are a prolate cycloid in metres, z rises evenly."""
    t = np.linspace(-0.8 * np.pi, 4.8 * np.pi, 141)
    return np.stack([22 * t - 62 * np.sin(t), -62 * np.cos(t), 6 * (t - t[0])], axis=1)


def write_track() -> None:
    """Write the road as a track near the equator, to the millimetre or so."""
    points = (
        f'<trkpt lat="{y / _METRES_OF_A_DEGREE:.8f}" lon="{x / _METRES_OF_A_DEGREE:.8f}"><ele>{z:.2f}</ele></trkpt>'
        for x, y, z in climbing_loops().tolist()
    )
    segment = "\n".join(points)
    track = f"<trk><name>climbing loops</name><trkseg>\n{segment}\n</trkseg></trk>"
    header = '<?xml version="1.0" encoding="UTF-8"?>\n<gpx version="1.1" creator="plyfold" '
    text = f'{header}xmlns="http://www.topografix.com/GPX/1/1">\n{track}\n</gpx>\n'
    (EXAMPLES / "loops.gpx").write_text(text)


def draw(ax: Axes, outline: pf.Outline, line: Floats, title: str) -> None:
    """Draw a ribbon, darker where it lies over itself, and the line in it."""
    for cell in pf.coverage(outline):
        for ring in [cell.polygon.exterior]:
            ax.fill(*np.array(ring.coords).T, color="#2a78b5", alpha=min(0.25 * cell.winding, 1), lw=0)
    for loop in outline.loops:
        ax.plot(*np.vstack([loop, loop[:1]]).T, color=INK, lw=0.9)
    ax.plot(*line.T, color="#b5462a", lw=0.8, marker=".", ms=3)
    ax.set_aspect("equal")
    titled(ax, title)


def dense_corner() -> Floats:
    """Return a corner whose points are much closer than half the width."""
    corner = np.array([(0.0, 0), (7, 0), (4.2, 4.5)])
    steps = [np.linspace(a, b, 15)[:-1] for a, b in pairwise(corner)]
    return np.vstack([*steps, corner[-1:]])


def ribbons() -> None:
    """Draw joins and caps, an inner corner, widths that change, and the track from above and lifted."""
    zigzag = np.array([(0.0, 0), (4, 0), (3, 2.5), (7, 2.2)])
    road = climbing_loops()
    t = np.linspace(0, 2.2 * math.pi, 60)
    spiral = np.stack([(2 + t) * np.cos(t), (2 + t) * np.sin(t)], axis=1)
    with panels("ribbons", 2, 3, (11, 6.6)) as axes:
        draw(next(axes), pf.ribbon(zigzag, 1, "round", "round"), zigzag, "round joins, round caps")
        draw(next(axes), pf.ribbon(zigzag, 1, "mitre", "square"), zigzag, "mitred joins, square caps")
        draw(next(axes), pf.ribbon(dense_corner(), 2.4), dense_corner(), "points closer than the width")
        draw(
            next(axes), pf.ribbon(spiral, np.linspace(0, 2.4, 60), cap_style="round"), spiral, "a width for each point"
        )
        layering = pf.ribbon_layering(road, 16)
        assert isinstance(layering, pf.Layering)
        above = next(axes)
        plot_casing(layering, above)
        titled(above, "a track whose heights say what passes over")
        raised = next(axes)
        plot_surface(pf.lift(layering, triangles=6000), ax=raised)
        titled(raised, "plyfold lift loops.gpx --width 16")


if __name__ == "__main__":
    write_track()
    ribbons()
