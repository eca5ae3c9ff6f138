"""Small pictures as SVG text, for notebooks: outlines, arrangements and disk layouts. They need no drawing library."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats
from plyfold.colours import ACCENT, CUSP, INK, PAPER, mix, sheet_colour, text_colour, winding_colour
from plyfold.draw.placement import (
    MOST_NUMBERS,
    BorderCircle,
    arrows,
    border_middle,
    closed,
    cusps_drawn,
    label_circle,
    line_weight,
    mark_weight,
    middle_and_size,
)
from plyfold.io.svg_writing import path_data

if TYPE_CHECKING:
    from plyfold.arrangement.arrangement import Arrangement
    from plyfold.immersion.immersion import Group, Immersion
    from plyfold.outline.curve import Outline

__all__ = ["SvgPicture", "arrangement_svg", "layout_svg", "outline_svg"]

_STROKE = 2.2
# The radius of the sign of a cusp, in pixels.
_CUSP = 6.5
_FONT = "font-family='system-ui, sans-serif' text-anchor='middle' dominant-baseline='central'"


class SvgPicture:
    """A picture with its map from the drawing to pixels: y down, a margin, and a given longer side.

    Parameters
    ----------
    points : (n, 2) float
        What it has room for.
    size, margin : float
        Of the longer side with both margins, and of one margin, in pixels.
    """

    def __init__(self, points: Floats, size: float = 400.0, margin: float = 16.0) -> None:
        self.middle, longer = middle_and_size(points)
        self.scale = (size - 2 * margin) / longer
        self.half = np.abs(points - self.middle).max(axis=0) * self.scale + margin

    def pixels(self, points: npt.ArrayLike) -> Floats:
        """Return where points of the drawing are, to a hundredth of a pixel."""
        return np.asarray(((np.asarray(points) - self.middle) * self.scale * (1, -1) + self.half).round(2))

    def path(self, points: Floats, closed: bool = True) -> str:
        """Return the ``d`` of a path, without repeated points."""
        return _path(self.pixels(points), closed)

    def area(self, rings: Iterable[Floats], colour: str, inside: str = "") -> str:
        """Return what polygons bound together, which lies on the left of each, filled: holes run clockwise."""
        outline = "".join(map(self.path, rings))
        return f"<path d='{outline}' fill='{colour}'" + (f">{inside}</path>" if inside else "/>")

    def line(self, points: Floats, colour: str, width: float, closed: bool = False) -> str:
        """Return a polyline of some width in pixels."""
        style = f"fill='none' stroke='{colour}' stroke-width='{width:.3g}' stroke-linejoin='round'"
        return f"<path d='{self.path(points, closed)}' {style}/>"

    def dot(self, place: npt.ArrayLike, radius: float, style: str) -> str:
        """Return a circle with a radius in pixels."""
        x, y = self.pixels(place).tolist()
        return f"<circle cx='{x:g}' cy='{y:g}' r='{radius:.4g}' {style}/>"

    def text(self, place: npt.ArrayLike, words: str, size: float, colour: str = INK) -> str:
        """Return words in the middle of a place."""
        x, y = self.pixels(place).tolist()
        words = words.replace("-", "−")
        return f"<text x='{x:g}' y='{y:g}' {_FONT} font-size='{size:.3g}' fill='{colour}'>{words}</text>"

    def cusps(self, places: Floats, indices: Iterable[int], radius: float) -> Iterator[str]:
        """Yield the signs of cusps, with a radius in pixels: small disks with their indices."""
        for place, index in zip(places, indices, strict=True):
            disk = self.dot(place, radius, f"fill='{CUSP}' stroke='{PAPER}' stroke-width='{radius / 8:.2g}'")
            number = self.text(place, str(index), 1.35 * radius, PAPER)
            yield f"<g font-weight='bold'><title>cusp of index {index}</title>{disk}{number}</g>"

    def arrow(self, place: npt.ArrayLike, direction: npt.ArrayLike) -> str:
        """Return the head of an arrow in a direction of the drawing."""
        tip, forward = self.pixels(place), np.asarray(direction) * (1, -1)
        side = np.array([-forward[1], forward[0]])
        corners = np.array([tip + 5.5 * forward, tip - 4 * forward + 4 * side, tip - 4 * forward - 4 * side])
        return f"<path d='{_path(corners.round(2))}' fill='{INK}'/>"

    def element(self, parts: Iterable[str], namespaces: str = "") -> str:
        """Return the picture."""
        width, height = (f"{2 * half:.0f}" for half in self.half)
        head = f"<svg xmlns='http://www.w3.org/2000/svg'{namespaces} width='{width}' height='{height}' "
        return "\n".join([f"{head}viewBox='0 0 {width} {height}'>", *parts, "</svg>"])


def _path(pixels: Floats, closed: bool = True) -> str:
    repeats = np.concatenate([[False], np.all(pixels[1:] == pixels[:-1], axis=1)])
    kept = pixels[~repeats]
    return path_data(kept[:-1] if closed and len(kept) > 1 and np.array_equal(kept[0], kept[-1]) else kept, closed)


# ---- arrangements ----------------------------------------------------------------------------------------------------


def arrangement_svg(arrangement: Arrangement) -> str:
    """Return a picture of the arrangement as SVG.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing: its cells, shaded by winding number, the loops with their directions, the crossings, and cusps
        with their indices. Without one (a Gauss code): the code as a chord diagram, visits in order round a circle, and
        a chord for each crossing.

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
    if arrangement.outline is None:
        return _chord_diagram(arrangement)
    picture, weight = SvgPicture(arrangement.outline.points), line_weight(arrangement.n_crossings)
    loops = (picture.line(loop, INK, _STROKE * weight, closed=True) for loop in arrangement.outline.loops)
    parts = [*_cells(arrangement, picture), *loops]
    parts += [picture.arrow(place, direction) for place, direction in arrows(arrangement)]
    rim = f"fill='{ACCENT}' stroke='{PAPER}' stroke-width='0.8'"
    parts += [picture.dot(crossing, 3 * weight, rim) for crossing in arrangement.crossings]
    parts += picture.cusps(*cusps_drawn(arrangement), _CUSP * mark_weight(arrangement.n_crossings))
    return picture.element([*parts, *_labels(arrangement, picture)])


def outline_svg(outline: Outline) -> str:
    """Return a picture of an outline as SVG: its loops, their directions and cusps. They may touch themselves."""
    picture, index = SvgPicture(outline.points), np.concatenate(outline.cusps)
    parts = [picture.line(loop, INK, _STROKE, closed=True) for loop in outline.loops]
    parts += [picture.arrow(*border_middle(closed(loop))) for loop in outline.loops]
    return picture.element([*parts, *picture.cusps(outline.points[index > 0], index[index > 0].tolist(), _CUSP)])


def _cells(arrangement: Arrangement, picture: SvgPicture) -> Iterator[str]:
    for cell in range(1, arrangement.n_cells):
        winding = int(arrangement.winding[cell])
        title = f"<title>cell {cell}, winding number {winding}</title>"
        yield picture.area(arrangement.cell_outlines(cell), winding_colour(winding), title)


def _labels(arrangement: Arrangement, picture: SvgPicture) -> Iterator[str]:
    for cell in range(1, arrangement.n_cells):
        x, y, radius = label_circle(arrangement, cell)
        size = min(16.0, 1.3 * radius * picture.scale)
        if size >= 5:
            winding = int(arrangement.winding[cell])
            yield picture.text((x, y), str(winding), size, text_colour(winding_colour(winding)))


def _chord_diagram(arrangement: Arrangement) -> str:
    """Return the Gauss code as a chord diagram: + where the other strand crosses from right to left, else −."""
    visits = len(arrangement.partner)
    places = np.array([_at_visit(1.0, visit, visits) for visit in range(visits)]).reshape(-1, 2)
    picture = SvgPicture(np.array([(-1.25, -1.25), (1.25, 1.25)]))
    ring = picture.dot((0.0, 0.0), picture.scale, f"fill='none' stroke='{INK}' stroke-width='{_STROKE}'")
    signs = np.where(arrangement.crossing_of_visit < 0, "", np.where(arrangement.ccw, "+", "-")).tolist()
    cusps = np.flatnonzero(arrangement.cusp_index)
    partners = enumerate(arrangement.partner.tolist())
    chords = [picture.line(places[[visit, partner]], ACCENT, 1.6) for visit, partner in partners if visit < partner]
    size = min(14.0, 600.0 / max(visits, 1))
    labels = [
        picture.text(_at_visit(1.13, visit, visits), f"{visit}{sign}", size)
        for visit, sign in enumerate(signs)
        if size >= 5
    ]
    x, y = top = _at_visit(1.0, -0.5, max(visits, 1))
    marks = picture.cusps(places[cusps], arrangement.cusp_index[cusps].tolist(), _CUSP)
    return picture.element([ring, *chords, picture.arrow(top, (-y, x)), *labels, *marks])


def _at_visit(radius: float, visit: float, visits: int) -> tuple[float, float]:
    angle = 2 * math.pi * (visit + 0.5) / visits
    return radius * math.cos(angle), radius * math.sin(angle)


# ---- disk layouts ----------------------------------------------------------------------------------------------------


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
    borders, weight = immersion.arrangement.n_borders, line_weight(immersion.arrangement.n_crossings)
    circle, picture = BorderCircle(borders), SvgPicture(np.array([(-1.0, -1.0), (1.0, 1.0)]), 320.0, 24.0)
    parts = [picture.dot((0.0, 0.0), picture.scale, f"fill='{mix(winding_colour(1), PAPER, 0.45)}'")]
    for group in immersion.disk_layout():
        title = f"<title>sheet {group.sheet} over cell {group.cell}</title>"
        parts += ["<g>", title, *_group(picture, circle, group, weight), "</g>"]
    if borders <= MOST_NUMBERS:
        parts += [picture.text(circle.middle(border, 1.1), str(border), 11.0) for border in range(borders)]
    return picture.element(parts)


def _group(picture: SvgPicture, circle: BorderCircle, group: Group, weight: float) -> Iterator[str]:
    colour = sheet_colour(group.sheet)
    yield picture.area([circle.region(group.borders)], mix(colour, PAPER, 0.62))
    for border, other in group.arcs:
        yield picture.line(circle.join(border, other), mix(colour, INK, 0.15), 1.6 * weight)
    for border in group.borders:
        yield picture.line(circle.arc(border, 1.02), colour, 5.0)
