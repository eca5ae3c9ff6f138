"""Lines of a file that are given a width: ribbons in their place, and the layering that their heights ask for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from plyfold.arrays import Floats
from plyfold.errors import FileFormatError, InputError
from plyfold.io.shapes import Line, Shape, outline_of_shapes
from plyfold.outline.curve import Outline
from plyfold.outline.points import Repair, as_planar_points
from plyfold.outline.ribbons.line import as_line
from plyfold.outline.ribbons.ribbon import CapStyle, JoinStyle, Ribbon, ribbon_of_line, style_of

__all__ = ["Wide", "Width", "outline_and_ribbon", "wide_lines"]

Width: TypeAlias = float | Literal["auto"]
"""The width of lines, in the units of the file (of a GPX in metres), or that which an SVG gives to their strokes."""


class Wide(NamedTuple):
    """How lines are to be widened; what is None is as the file says, or else as in :func:`~plyfold.ribbon`."""

    width: Width
    join: JoinStyle | None = None
    cap: CapStyle | None = None


def wide_lines(width: Width | None, join_style: JoinStyle | None, cap_style: CapStyle | None) -> Wide | None:
    """Return how lines are to be widened, or None if they are not; refuse styles without a width."""
    if width is None:
        if join_style or cap_style:
            raise InputError("joins and caps are those of lines with a width", hint="give a width")
        return None
    if isinstance(width, str) and width != "auto":
        raise InputError(f"a width is a number, or 'auto' for that of the file, not {width!r}")
    style_of(join_style or "round", cap_style or "flat")
    return Wide(width, join_style, cap_style)


def outline_and_ribbon(shapes: Sequence[Shape], wide: Wide) -> tuple[Outline, Ribbon | None]:
    """Return shapes as one outline in which lines have become ribbons.

    Parameters
    ----------
    shapes : sequence of Shape
    wide : Wide

    Returns
    -------
    Outline
    Ribbon or None
        All of it as one ribbon, if there is nothing else, and all lines have heights.

    Raises
    ------
    InputError
        If a bend is too tight, or no line has a width.

    Examples
    --------
    >>> line = Line([[0, 0, 5], [9, 0, 7]], closed=False, is_line=True)
    >>> outline, ribbon = outline_and_ribbon([Shape((line,))], Wide(2.0))
    >>> outline.points.tolist(), ribbon.heights.tolist()
    ([[0.0, -1.0], [9.0, -1.0], [9.0, 1.0], [0.0, 1.0]], [5.0, 7.0, 7.0, 5.0])
    """
    made = [[_ribbon(line, wide) for line in shape.loops] for shape in shapes]
    ribbons = [ribbon for row in made for ribbon in row if ribbon is not None]
    if not ribbons:
        raise FileFormatError(*_no_line(wide))
    widened = [_with_ribbons(shape, row) for shape, row in zip(shapes, made, strict=True)]
    lacking = _first_without_height(shapes, made)
    if lacking is not None and any(_heights(line) is not None for shape in shapes for line in shape.loops):
        widened[0] = widened[0]._replace(repairs=(*widened[0].repairs, lacking))
    outline = outline_of_shapes(widened)
    return outline, _together(outline, ribbons) if lacking is None else None


def _no_line(wide: Wide) -> tuple[str, tuple[()], str]:
    if wide.width == "auto":
        return "no line in it has a width", (), "give the width as a number; only strokes of an SVG have their own"
    return "it has no line that could have a width", (), "polygons and filled paths are outlines as they are"


def _ribbon(line: Line, wide: Wide) -> Ribbon | None:
    """Return the ribbon along a line; None of what is no line, or has no width."""
    pen = line.pen
    if not line.is_line or (wide.width == "auto" and pen is None):
        return None
    if line.cusps:
        raise FileFormatError("it has cusps at a line, and a ribbon has other points", hint="leave out the cusps")
    width = pen.width if wide.width == "auto" and pen else wide.width
    style = style_of(wide.join or (pen.join if pen else "round"), wide.cap or (pen.cap if pen else "flat"))
    if pen:
        style = style._replace(mitre_limit=pen.mitre_limit)
    return ribbon_of_line(as_line(_with_heights(line), width), style)


def _heights(line: Line) -> Floats | None:
    """Return the heights of a line, NaN where there is none; None if it has none at all."""
    _, in_a_column = as_planar_points(line.points)
    heights = np.asarray(line.points)[:, 2] if in_a_column else line.heights
    z = None if heights is None else np.asarray(heights, dtype=np.float64)
    return None if z is None or np.isnan(z).all() else z


def _with_heights(line: Line) -> Floats:
    """Return the points of a line with their heights, if all of them have some."""
    points, z = as_planar_points(line.points)[0], _heights(line)
    return points if z is None or np.isnan(z).any() else np.column_stack([points, z])


def _first_without_height(shapes: Sequence[Shape], made: Sequence[Sequence[Ribbon | None]]) -> Repair | None:
    """Return a record of the first point without a height, if there is one: those of all others are left out, too."""
    for shape, row in zip(shapes, made, strict=True):
        for line, ribbon in zip(shape.loops, row, strict=True):
            if ribbon is None or ribbon.heights is None:
                z = _heights(line)
                first = int(np.isnan(z).argmax()) if z is not None and ribbon is not None else 0
                x, y = as_planar_points(line.points)[0][first].tolist()
                return Repair("all heights left out, for this point has none", (x, y), 0.0)
    return None


def _with_ribbons(shape: Shape, ribbons: Sequence[Ribbon | None]) -> Shape:
    loops: list[Line] = []
    repairs = list(shape.repairs)
    for line, ribbon in zip(shape.loops, ribbons, strict=True):
        if ribbon is None:
            loops.append(line)
        else:
            loops += [Line(points) for points in ribbon.outline.loops]
            repairs += ribbon.outline.repairs
            # The heights are not left out.
            repairs = [repair for repair in repairs if repair.kind != "z left out" or ribbon.heights is None]
    return shape._replace(loops=tuple(loops), repairs=tuple(repairs))


def _together(outline: Outline, ribbons: Sequence[Ribbon]) -> Ribbon:
    """Return several ribbons as one in several pieces; ``outline`` has their loops in order."""
    first = np.cumsum([0, *(len(ribbon.outline) for ribbon in ribbons)])
    faces = [ribbon.faces + start for ribbon, start in zip(ribbons, first, strict=False)]
    heights = [ribbon.heights for ribbon in ribbons if ribbon.heights is not None]
    first_face = np.cumsum([0, *map(len, faces)]).tolist()
    courses = [
        course._replace(first=start)
        for ribbon, start in zip(ribbons, first_face, strict=False)
        for course in ribbon.courses
    ]
    return Ribbon(outline, np.concatenate(faces), np.concatenate(heights), tuple(courses))
