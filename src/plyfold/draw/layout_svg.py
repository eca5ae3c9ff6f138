"""A small picture of a disk layout as SVG text, for notebooks; no drawing library needed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from plyfold.arrays import Floats
from plyfold.colours import INK, PAPER, mix, sheet_colour, winding_colour
from plyfold.draw.canvas import line_weight
from plyfold.draw.layout_plot import BorderCircle

if TYPE_CHECKING:
    from plyfold.immersion.immersion import Group, Immersion

__all__ = ["layout_svg"]

_SIZE = 320
_RADIUS = 136.0
_FONT = "font-family='system-ui, sans-serif' font-size='11' text-anchor='middle' dominant-baseline='central'"
_MOST_NUMBERS = 60


def layout_svg(immersion: Immersion) -> str:
    """Return the disk layout as SVG, in the colours of :func:`plyfold.draw.plot_layout`.

    Parameters
    ----------
    immersion : Immersion
        It need not have a drawing.

    Returns
    -------
    str
        One ``<svg>`` element with a group for each sheet that has own borders.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> picture = layout_svg(find_immersion([(0, 0), (1, 0), (0, 1)]))
    >>> picture.startswith("<svg"), picture.count("<g>")
    (True, 1)
    """
    borders = immersion.arrangement.n_borders
    circle, weight = BorderCircle(borders), line_weight(immersion.arrangement.n_crossings)
    parts = [f"<circle cx='160' cy='160' r='{_RADIUS}' fill='{mix(winding_colour(1), PAPER, 0.45)}'/>"]
    for group in immersion.disk_layout():
        parts += [
            "<g>",
            f"<title>sheet {group.sheet} over cell {group.cell}</title>",
            *_sheet(circle, group, weight),
            "</g>",
        ]
    if borders <= _MOST_NUMBERS:
        parts += [_number(circle.middle(border, 1.1), border) for border in range(borders)]
    head = f"<svg xmlns='http://www.w3.org/2000/svg' width='{_SIZE}' height='{_SIZE}' viewBox='0 0 {_SIZE} {_SIZE}'>"
    return "\n".join([head, *parts, "</svg>"])


def _sheet(circle: BorderCircle, group: Group, weight: float) -> Iterator[str]:
    colour = sheet_colour(group.sheet)
    yield f"<path d='{_path(circle.region(group.borders))}Z' fill='{mix(colour, PAPER, 0.62)}'/>"
    for border, other in group.arcs:
        yield _line(circle.join(border, other), mix(colour, INK, 0.15), 1.6 * weight)
    for border in group.borders:
        yield _line(circle.arc(border, 1.02), colour, 5.0)


def _line(points: Floats, colour: str, width: float) -> str:
    return f"<path d='{_path(points)}' fill='none' stroke='{colour}' stroke-width='{width:.3g}'/>"


def _path(points: Floats) -> str:
    return "M" + "L".join(f"{x:.6g},{y:.6g}" for x, y in _pixels(points))


def _pixels(points: Floats) -> list[list[float]]:
    pixels: list[list[float]] = (points * (_RADIUS, -_RADIUS) + _SIZE / 2).round(2).tolist()
    return pixels


def _number(place: tuple[float, float], border: int) -> str:
    x, y = (_SIZE / 2 + _RADIUS * place[0], _SIZE / 2 - _RADIUS * place[1])
    return f"<text x='{x:.2f}' y='{y:.2f}' {_FONT} fill='{INK}'>{border}</text>"
