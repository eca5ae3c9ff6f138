"""Pictures as SVG text: the paths that all of them are made of, and drawings in their own units."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from plyfold.arrays import Floats
from plyfold.colours import INK

__all__ = ["drawing_svg", "line_width", "path_data", "polylines_svg"]


def path_data(points: Floats, closed: bool = True) -> str:
    """Return the ``d`` of a path along points, shape (n, 2), in the shortest numbers that are read back exactly.

    Examples
    --------
    >>> path_data(np.array([(0, 0), (0.1, 20.0)]))
    'M0,0L0.1,20Z'
    """
    return "M" + "L".join(_places(points)) + ("Z" if closed else "")


def _places(points: Floats) -> list[str]:
    return [f"{_number(x)},{_number(y)}" for x, y in points.tolist()]


def _number(value: float) -> str:
    return repr(value).removesuffix(".0")


def drawing_svg(corners: Floats, parts: Iterable[str], style: str) -> str:
    """Return elements as a picture in the units of the drawing, with a margin of a twentieth.

    Parameters
    ----------
    corners : (n, 2) float
        Points that the picture holds, y up; of none, it is a unit square.
    parts : iterable of str
        With y down, so that the picture is upright.
    style : str
        Attributes of all parts.
    """
    low, high = (corners.min(axis=0), corners.max(axis=0)) if len(corners) else (np.zeros(2), np.ones(2))
    margin = 0.05 * _side(corners)
    size = (high - low + 2 * margin).tolist()
    box = " ".join(map(_number, [float(low[0]) - margin, -float(high[1]) - margin, *size]))
    start = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">'
    return "\n".join([start, f"<g {style}>", *parts, "</g>", "</svg>\n"])


def line_width(corners: Floats) -> float:
    """Return how wide lines are in a picture of some points: a two-hundredth of the larger side."""
    return 0.005 * _side(corners)


def _side(corners: Floats) -> float:
    return float(np.ptp(corners, axis=0).max()) or 1.0 if len(corners) else 1.0


def polylines_svg(lines: Sequence[Floats]) -> str:
    """Return polylines, each of shape (n, 2), as a picture in their own units, from which every number reads back."""
    corners = np.concatenate([np.empty((0, 2)), *lines])
    style = f'fill="none" stroke="{INK}" stroke-width="{line_width(corners)}" stroke-linejoin="round"'
    return drawing_svg(corners, (f'<polyline points="{" ".join(_places(line * (1, -1)))}"/>' for line in lines), style)
