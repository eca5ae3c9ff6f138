"""What stands in a file, before it is one outline: shapes, each with its loops, and open lines."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from plyfold.errors import CurveError, FileFormatError, StrokeError
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.direction import bounds_nothing, sense
from plyfold.outline.given import outline_of_curves, outline_with
from plyfold.outline.points import Repair, as_planar_points
from plyfold.outline.ribbons.sides import CapStyle, JoinStyle
from plyfold.outline.strokes import join_strokes
from plyfold.outline.vertices import naming_the_curve, no_area

__all__ = ["Line", "Shape", "StrokeStyle", "outline_of_shapes", "shape_of_strokes"]

_FEWEST_ROWS_OF_A_LOOP = 4


class StrokeStyle(NamedTuple):
    """What a file says of the strokes along a line: their width, and how their corners and ends look.

    The mitre limit is in widths, as :func:`~plyfold.ribbon` takes it and SVG has it, too.
    """

    width: float
    join: JoinStyle
    cap: CapStyle
    mitre_limit: float = 4.0


class Line(NamedTuple):
    """A line of a file.

    Parameters
    ----------
    points : array-like, shape (n, 2) or (n, 3)
    closed : bool
        Whether the last point is to be joined to the first; open lines are strokes.
    direction : int
        1 if it is to run counter-clockwise, −1 if clockwise, 0 as it stands; of a loop that is alone that does not
        matter.
    cusps : mapping from point to index
    is_line : bool
        Whether it may be given a width: it is no ring of a polygon and no loop by name. Then it is closed if its last
        point repeats the first.
    heights : array-like, shape (n,), optional
        Those of its points, where they are no third column.
    pen : StrokeStyle, optional
        The strokes along it.
    """

    points: npt.ArrayLike
    closed: bool = True
    direction: int = 0
    cusps: Mapping[int, int] = {}
    is_line: bool = False
    heights: npt.ArrayLike | None = None
    pen: StrokeStyle | None = None


class Shape(NamedTuple):
    """What belongs together in a file: an element of an SVG, a feature, all loops of a table."""

    loops: tuple[Line, ...]
    name: str = ""
    repairs: tuple[Repair, ...] = ()


def shape_of_strokes(strokes: Iterable[Sequence[Any] | npt.NDArray[Any]], name: str = "") -> Shape:
    """Return lines as a shape: loops if each of them ends where it starts, and otherwise strokes to be joined.

    Examples
    --------
    >>> triangle = [[0, 0], [4, 0], [0, 3], [0, 0]]
    >>> [loop.closed for loop in shape_of_strokes([triangle, triangle[1:]]).loops]
    [False, False]
    """
    lines = [*strokes]
    drawn = [line for line in lines if len(line)]
    closed = bool(drawn) and all(map(_ends_where_it_starts, drawn))
    return Shape(tuple(Line(line, closed, is_line=True) for line in (drawn if closed else lines)), name)


def _ends_where_it_starts(line: Sequence[Any] | npt.NDArray[Any]) -> bool:
    if len(line) < _FEWEST_ROWS_OF_A_LOOP:
        return False
    try:
        ends, _ = as_planar_points([line[0], line[-1]])
    except CurveError:  # whoever makes a curve of the line says what is wrong
        return False
    return np.array_equal(*ends)


def outline_of_shapes(shapes: Sequence[Shape]) -> Outline:
    """Return the loops of shapes as one outline; of open lines alone, the loop that they make as strokes.

    Beside loops, open lines are left out, and so are loops whose points all lie on one line; the repairs say so.

    Parameters
    ----------
    shapes : sequence of Shape

    Returns
    -------
    Outline
        A :class:`Curve`, if there is one loop.

    Raises
    ------
    StrokeError
        If there are strokes alone, and they do not make a loop.
    CurveError
        If a loop is none.

    Examples
    --------
    >>> line, loop = Line([[0, 0], [9, 9]], closed=False), Line([[0, 0], [4, 0], [0, 3]])
    >>> [str(repair) for repair in outline_of_shapes([Shape((line, loop))]).repairs]
    ['open line left out at (0, 0), size 12.7279']
    """
    lines = [line for shape in shapes for line in shape.loops]
    repairs = [repair for shape in shapes for repair in shape.repairs]
    loops = [line for line in lines if line.closed]
    if not loops:
        return _joined(lines, repairs)
    repairs += [_open_line(line) for line in lines if not line.closed]
    if len(loops) == 1:
        return Curve(loops[0].points, repairs, loops[0].cusps or None)
    return _outline_of_loops(loops, repairs)


def _joined(strokes: Sequence[Line], repairs: Sequence[Repair]) -> Curve:
    if any(stroke.cusps for stroke in strokes):
        raise FileFormatError("it has cusps at strokes, whose points are not those of the loop", hint="join them first")
    try:
        points, gaps = join_strokes([stroke.points for stroke in strokes])
    except StrokeError as error:
        loops = "where each line is a loop of its own, repeat its first point at its end"
        hint = f"{error.hint}; or, {loops}" if len(strokes) > 1 else error.hint
        raise StrokeError(error.message, error.where, hint) from error
    return Curve(points, (*repairs, *gaps))


def _open_line(line: Line) -> Repair:
    points, _ = as_planar_points(line.points)
    x, y = points[0].tolist()
    return Repair("open line left out", (x, y), float(np.hypot(*(points[-1] - points[0]))))


def _outline_of_loops(loops: Sequence[Line], repairs: Sequence[Repair]) -> Outline:
    found = []
    for number, loop in enumerate(loops):
        with naming_the_curve(number, len(loops)):
            found.append(_curve_or_nothing(loop))
    curves = [curve for curve in found if isinstance(curve, Curve)]
    flat = [repair for repair in found if isinstance(repair, Repair)]
    if not curves:
        places = [repair.where for repair in flat]
        raise CurveError(f"none of the {len(loops)} loops has an area", places, "draw one that goes round something")
    outline = outline_of_curves(curves)
    return outline_with(outline, repairs=(*repairs, *flat, *outline.repairs)) if flat or repairs else outline


def _curve_or_nothing(loop: Line) -> Curve | Repair:
    """Return a loop as a curve in its direction; if it goes round nothing, the record that it is left out.

    A loop that is no ring of a polygon and has points beside a line stays: to leave it out would be a guess.
    """
    try:
        curve = Curve(loop.points)
    except CurveError:
        points, _ = as_planar_points(loop.points)  # raises what else may be wrong
        if loop.cusps or not len(points):
            raise
        return no_area(points)
    if loop.direction and not loop.cusps and bounds_nothing(curve.points):
        return no_area(curve.points)
    marked = Curve(loop.points, (), loop.cusps) if loop.cusps else curve
    return marked.reversed() if loop.direction and sense(curve.points) == -loop.direction else marked
