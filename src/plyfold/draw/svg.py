"""A small picture of an arrangement as SVG text, for notebooks; no drawing library needed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from plyfold.colours import ACCENT, INK, text_colour, winding_colour
from plyfold.draw.canvas import arrows, border_middle, label_circle, line_weight, middle_and_size

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement

__all__ = ["arrangement_svg", "curve_svg"]

_SIZE = 400.0
_MARGIN = 16.0
_STROKE = 2.2
_FONT = "font-family='system-ui, sans-serif' text-anchor='middle' dominant-baseline='central'"


def arrangement_svg(arrangement: Arrangement) -> str:
    """Return a picture of the arrangement as SVG.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing: its cells, shaded by winding number, the curve with its direction, and the crossings.
        Without one (a Gauss code): the code as a chord diagram, visits in order round a circle and a chord for each
        crossing.

    Returns
    -------
    str
        One ``<svg>`` element, y flipped so that the picture is upright, in pixels of its own: drawings of any size
        and place look alike.

    Examples
    --------
    >>> from plyfold import arrange
    >>> picture = arrangement_svg(arrange([(0, 0), (2, 2), (2, 0), (0, 2)]))
    >>> picture.startswith("<svg"), picture.count("<path"), picture.count("<circle")
    (True, 5, 1)
    """
    if arrangement.curve is None:
        return _chord_diagram(arrangement)
    sheet = _Sheet(arrangement.curve.points)
    parts = [*_cells(arrangement, sheet), _curve(arrangement, sheet), *_arrows(arrangement, sheet)]
    parts += [*_crossings(arrangement, sheet), *_labels(arrangement, sheet)]
    return sheet.element(parts)


def curve_svg(points: npt.NDArray[np.float64]) -> str:
    """Return a picture of a closed polyline, shape (n, 2), as SVG: the line and its direction. It may touch itself."""
    sheet = _Sheet(points)
    place, (dx, dy) = border_middle(np.concatenate([points, points[:1]]))
    return sheet.element([_outline(points, sheet, _STROKE), _arrow(sheet.pixels(place), np.array([dx, -dy]))])


class _Sheet:
    """The map from the drawing to pixels: y down, a margin, the longer side always the same."""

    def __init__(self, points: npt.NDArray[np.float64]) -> None:
        self.middle, size = middle_and_size(points)
        self.scale = (_SIZE - 2 * _MARGIN) / size
        self.half = np.abs(points - self.middle).max(axis=0) * self.scale + _MARGIN

    def pixels(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        return np.asarray((np.asarray(points) - self.middle) * self.scale * (1, -1) + self.half)

    def element(self, parts: list[str]) -> str:
        width, height = (f"{2 * half:.0f}" for half in self.half)
        head = f"<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}' "
        return f"{head}viewBox='0 0 {width} {height}'>\n" + "\n".join(parts) + "\n</svg>"


def _path(pixels: npt.NDArray[np.float64]) -> str:
    """Return the ``d`` of a closed path, to a hundredth of a pixel and without repeated points."""
    rounded = np.round(pixels, 2)
    kept = rounded[np.any(rounded != np.roll(rounded, 1, axis=0), axis=1)]
    points = kept if len(kept) else rounded[:1]
    return "M" + "L".join(f"{x:g},{y:g}" for x, y in points.tolist()) + "Z"


def _cells(arrangement: Arrangement, sheet: _Sheet) -> Iterator[str]:
    for cell in range(1, arrangement.n_cells):
        winding = int(arrangement.winding[cell])
        outline = _path(sheet.pixels(arrangement.cell_outline(cell)))
        title = f"<title>cell {cell}, winding number {winding}</title>"
        yield f"<path d='{outline}' fill='{winding_colour(winding)}'>{title}</path>"


def _curve(arrangement: Arrangement, sheet: _Sheet) -> str:
    assert arrangement.curve is not None
    return _outline(arrangement.curve.points, sheet, _STROKE * line_weight(arrangement.n_crossings))


def _outline(points: npt.NDArray[np.float64], sheet: _Sheet, width: float) -> str:
    style = f"fill='none' stroke='{INK}' stroke-width='{width:.3g}' stroke-linejoin='round'"
    return f"<path d='{_path(sheet.pixels(points))}' {style}/>"


def _arrows(arrangement: Arrangement, sheet: _Sheet) -> Iterator[str]:
    for place, direction in arrows(arrangement):
        yield _arrow(sheet.pixels(place), direction * (1, -1))


def _arrow(tip: npt.NDArray[np.float64], forward: npt.NDArray[np.float64]) -> str:
    side = np.array([-forward[1], forward[0]])
    corners = np.array([tip + 5.5 * forward, tip - 4 * forward + 4 * side, tip - 4 * forward - 4 * side])
    return f"<path d='{_path(corners)}' fill='{INK}'/>"


def _crossings(arrangement: Arrangement, sheet: _Sheet) -> Iterator[str]:
    radius = 3 * line_weight(arrangement.n_crossings)
    for x, y in sheet.pixels(arrangement.crossings).round(2).tolist():
        yield f"<circle cx='{x:g}' cy='{y:g}' r='{radius:.3g}' fill='{ACCENT}' stroke='white' stroke-width='0.8'/>"


def _labels(arrangement: Arrangement, sheet: _Sheet) -> Iterator[str]:
    for cell in range(1, arrangement.n_cells):
        x, y, radius = label_circle(arrangement, cell)
        size = min(16.0, 1.3 * radius * sheet.scale)
        if size >= 5:
            winding = int(arrangement.winding[cell])
            yield _text(sheet.pixels((x, y)), str(winding), size, text_colour(winding_colour(winding)))


def _text(place: npt.NDArray[np.float64], text: str, size: float, colour: str) -> str:
    x, y = place.round(2).tolist()
    return f"<text x='{x:g}' y='{y:g}' {_FONT} font-size='{size:.3g}' fill='{colour}'>{text.replace('-', '−')}</text>"


def _chord_diagram(arrangement: Arrangement) -> str:
    """Return the Gauss code as a chord diagram: + where the other strand crosses from right to left, else −."""
    visits = len(arrangement.partner)
    places = [_on_circle(1.0, visit, visits) for visit in range(visits)]
    sheet = _Sheet(np.array([(-1.25, -1.25), (1.25, 1.25)]))
    cx, cy = sheet.pixels((0.0, 0.0)).tolist()
    ring = (
        f"<circle cx='{cx:g}' cy='{cy:g}' r='{sheet.scale:.4g}' fill='none' stroke='{INK}' stroke-width='{_STROKE}'/>"
    )
    chords = [_chord(sheet, places[p], places[q]) for p, q in enumerate(arrangement.partner.tolist()) if p < q]
    size = min(14.0, 600.0 / max(visits, 1))
    labels = [
        _text(sheet.pixels(_on_circle(1.13, visit, visits)), f"{visit}{'+' if ccw else '-'}", size, INK)
        for visit, ccw in enumerate(arrangement.ccw.tolist())
        if size >= 5
    ]
    top = _on_circle(1.0, -0.5, max(visits, 1))
    arrow = _arrow(sheet.pixels(top), np.array([-top[1], -top[0]]))
    return sheet.element([ring, *chords, arrow, *labels])


def _on_circle(radius: float, visit: float, visits: int) -> tuple[float, float]:
    angle = 2 * math.pi * (visit + 0.5) / visits
    return radius * math.cos(angle), radius * math.sin(angle)


def _chord(sheet: _Sheet, start: tuple[float, float], end: tuple[float, float]) -> str:
    (x1, y1), (x2, y2) = sheet.pixels([start, end]).round(2).tolist()
    return f"<line x1='{x1:g}' y1='{y1:g}' x2='{x2:g}' y2='{y2:g}' stroke='{ACCENT}' stroke-width='1.6'/>"
