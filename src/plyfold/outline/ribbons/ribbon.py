"""Ribbons: lines with a width, whose outlines are those of immersed disks and rings by construction."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import NamedTuple, get_args

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import InputError
from plyfold.options import refuse_unless_count, refuse_unless_number
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.ribbons.corners import without_gaps
from plyfold.outline.ribbons.line import LineLike, TightBendError, WideLine, as_line
from plyfold.outline.ribbons.sides import LEFT, RIGHT, CapStyle, JoinStyle, Side, Style, rough_side
from plyfold.outline.ribbons.strip import Strip, strip_between
from plyfold.outline.ribbons.walk import walk_through
from plyfold.predicates import orient

__all__ = ["CapStyle", "Course", "JoinStyle", "LineLike", "Ribbon", "Style", "ribbon", "ribbon_of_line", "style_of"]


# Where half the width is fewer steps between doubles than this, it is rounding that leaves no ribbon, and not a bend.
_LOST = 16


class Course(NamedTuple):
    """A line with heights, and where in its ribbon it runs.

    Parameters
    ----------
    points : (n, 2) float
        Those of a closed line begin and end in the middle of a segment.
    heights : (n,) float
    triangles : (n,) int
        The triangle that each point is in, counted on beyond the first and the last one if the line is closed.
    first, n_triangles : int
        Number of the first triangle of this line's ribbon, and how many there are.
    """

    points: Floats
    heights: Floats
    triangles: Ints
    first: int
    n_triangles: int

    def faces_along(self, segment: int) -> Ints:
        """Return the triangles that a segment passes, as rows of the ribbon's ``faces``."""
        low, high = np.sort(self.triangles[segment : segment + 2])
        return self.first + np.arange(low, high + 1) % self.n_triangles


class Ribbon(NamedTuple):
    """A ribbon with the strip of triangles that it is made of.

    Parameters
    ----------
    outline : Outline
    faces : (t, 3) int
        Triangles on the outline's points, counter-clockwise. They have no other vertices, each is positive, and glued
        along their common edges they are the ribbon.
    heights : (points,) float or None
        Those of the line beside each point, if it has some.
    courses : tuple of Course
        Its line, if that has heights; several, where several ribbons have been put together.
    """

    outline: Outline
    faces: Ints
    heights: Floats | None
    courses: tuple[Course, ...]


def ribbon(  # noqa: PLR0913 - each option is keyword-only and independent
    line: LineLike,
    width: npt.ArrayLike,
    join_style: JoinStyle = "round",
    cap_style: CapStyle = "flat",
    *,
    closed: bool | None = None,
    quad_segs: int = 8,
    mitre_limit: float = 5.0,
) -> Outline:
    """Give a line a width: the outline of the ribbon along it, which is a disk, or a ring if the line is closed.

    The line may cross itself as often as it likes; the ribbon lies over itself there. Where it bends, the inner side
    has no wrong loops. The line never leaves its ribbon.

    Parameters
    ----------
    line : array_like of shape (n, 2) or (n, 3), shapely LineString or Curve
        Points in order. A third column, of heights, makes no difference here: see :func:`~plyfold.ribbon_layering`.
    width : float or array_like of shape (n,)
        The full width, everywhere or at each point; between points it changes evenly. Positive; at the ends of an open
        line it may be 0.
    join_style : {"round", "mitre", "bevel"}
        What the outer side of a bend looks like.
    cap_style : {"flat", "round", "square"}
        What the ends of an open line look like; a square cap reaches half the width beyond the end.
    closed : bool, optional
        Whether the last point is joined to the first. By default, if the last point repeats the first one, and of a
        curve.
    quad_segs : int, optional
        Edges of a quarter of a circle, in round joins and caps. Where the line turns by less than such an edge does, a
        round join is a mitre.
    mitre_limit : float, optional
        The longest mitre, from its inner to its outer corner, in widths; where it would be longer, the join is a bevel.

    Returns
    -------
    Curve or Outline
        Of an open line, the curve that begins at its start, runs along the right side and back along the left one; of a
        closed line two loops, the right side forward and the left side backward. The surface is on the left of both.

    Raises
    ------
    InputError
        If a bend is too tight for the width, whose place it names; or if a width or an option is none.
    CurveError
        If the points make no line.

    Notes
    -----
    A ribbon of a line is a disk or ring, immersed, with three properties. The line runs through it from one cap to the
    other, or once round, and never leaves it, also where it lies over itself. It crosses every edge between the two
    sides. And no corner is farther from the line than the ribbon reaches: half the width, or what mitres and caps have.

    Between the two sides lies a strip of triangles, all positively oriented, whose angles at each point make less than
    a full turn, and the line is walked through it, triangle by triangle. All that is checked exactly. Usually linear;
    more where segments are short for the width, and bends are cut off across many of them.

    Examples
    --------
    >>> from plyfold import bounds_disk
    >>> road = ribbon([(0, 0), (9, 0), (9, 6), (4, 6), (4, -5)], 2, "mitre")
    >>> road.points.tolist()[:4], bounds_disk(road)
    ([[0.0, -1.0], [10.0, -1.0], [10.0, 7.0], [3.0, 7.0]], True)
    >>> ribbon([(0, 0), (9, 0), (9, 6), (0, 0)], 1)
    <Outline of 2 loops, 39 points>
    >>> ribbon([(0, 0), (9, 0), (9, 1), (0, 1)], 3)
    Traceback (most recent call last):
    plyfold.errors.InputError: a bend of the line is too tight for a ribbon 3 wide, at (9, 1)
      hint: make it narrower there, or round off the bend
    """
    style = style_of(join_style, cap_style, quad_segs, mitre_limit)
    return ribbon_of_line(as_line(line, width, closed), style).outline


def style_of(join: str, cap: str, quad_segs: int = 8, mitre_limit: float = 5.0) -> Style:
    """Return how corners and ends are to look; refuse what is no style."""
    for name, value, known in (("join_style", join, get_args(JoinStyle)), ("cap_style", cap, get_args(CapStyle))):
        if value not in known:
            raise InputError(f"{name} is {', '.join(known[:-1])} or {known[-1]}, not {value!r}")
    refuse_unless_count("quad_segs", quad_segs, most=1000)
    refuse_unless_number("mitre_limit", mitre_limit)
    if not mitre_limit >= 1:
        raise InputError(f"a mitre is at least as long as the width, and the limit is {mitre_limit:g} times that")
    return Style(join, cap, quad_segs, mitre_limit)  # type: ignore[arg-type]


def ribbon_of_line(line: WideLine, style: Style) -> Ribbon:
    """Return the ribbon along a line.

    Raises
    ------
    InputError
        If a bend is too tight.
    """
    _refuse_turning_back(line)
    drawn = _opened(line, style) if line.closed else line.longer() if style.cap == "square" else line
    sides: list[Side] = []
    try:
        sides += [_side(drawn, way, style, line.closed) for way in (LEFT, RIGHT)]
        strip, triangles = _strip(drawn, sides, style, line.closed)
    except TightBendError as error:
        raise _too_tight(drawn, _bend(drawn, sides, error.place)) from None
    outline = Outline(strip.loops, repairs=line.repairs) if line.closed else Curve(strip.loops[0], line.repairs)
    course = [] if drawn.heights is None else [Course(drawn.points, drawn.heights, triangles, 0, len(strip.faces))]
    return Ribbon(outline, strip.faces, _heights(drawn, strip), tuple(course))


def _refuse_turning_back(line: WideLine) -> None:
    """Refuse a line that turns straight back somewhere: neither of its sides would be the outer one there."""
    before, after = np.roll(line.points, 1, axis=0), np.roll(line.points, -1, axis=0)
    back = ((line.points - before) * (after - line.points)).sum(axis=1) < 0
    back &= orient(before, line.points, after) == 0
    if not line.closed:
        back[[0, -1]] = False
    if back.any():
        raise _too_tight(line, int(back.argmax()))


def _too_tight(line: WideLine, joint: int) -> InputError:
    width, where = f"a ribbon {2 * line.half_widths[joint]:.6g} wide", line.points[[joint]]
    if line.half_widths[joint] < _LOST * np.spacing(np.abs(where).max()):
        hint = "make it wider, or move the line towards the origin"
        return InputError(
            f"{width} is lost in rounding beside coordinates as large as those here", where=where, hint=hint
        )
    hint = "make it narrower there, or round off the bend"
    return InputError(f"a bend of the line is too tight for {width}", where=where, hint=hint)


def _side(line: WideLine, way: int, style: Style, closed: bool) -> Side:
    """Return one side of an open line, with the tips of the caps; those of a line that was opened stay where it was."""
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(line.points, axis=0).T)))
    side = without_gaps(rough_side(line, way, style), way, along, 2 * line.half_widths)
    if closed and side.low[1] != 0:
        raise TightBendError(float(side.high[1]))
    if closed and side.high[-2] != len(along) - 1:
        raise TightBendError(float(side.low[-2]))
    return side


def _strip(line: WideLine, sides: list[Side], style: Style, closed: bool) -> tuple[Strip, Ints]:
    """Return the strip between two sides, without tips that are no corners, and the triangles of the line's points."""
    if closed:
        left, right = (_inner(side, 2, 2) for side in sides)
        strip = strip_between(left, right, closed)
        return strip, walk_through(strip, line.points, closed, (line.points[:0], line.points[:0]))
    # The middle of a flat cap is a corner only where the line has a hook so short that a side joins it.
    is_tip = (line.half_widths[[0, -1]] == 0) | (style.cap == "round")
    for side in sides:
        is_tip |= [side.low[1] > 0, side.high[-2] < len(line.points) - 1]
    return _first_strip(line, sides, *is_tip.tolist())


def _first_strip(line: WideLine, sides: list[Side], at_start: bool, at_end: bool) -> tuple[Strip, Ints]:
    """Return a strip that has each tip on the right or on the left side, and the triangles of the line's points."""
    tips = sides[0].points[[0, -1]]
    is_beyond = (tips != line.points[[0, -1]]).any(axis=1)
    beyond = tips[:1][is_beyond[:1]], tips[1:][is_beyond[1:]]
    failed = TightBendError(0.0)
    for start, end in product((False, True)[: 1 + at_start], (False, True)[: 1 + at_end]):
        left = _inner(sides[0], int(not start), int(not end))
        right = _inner(sides[1], int(start or not at_start), int(end or not at_end))
        try:
            strip = strip_between(left, right, False)
            return strip, walk_through(strip, line.points, False, beyond)
        except TightBendError as error:
            failed = error
    raise failed


def _inner(side: Side, first: int, last: int) -> Side:
    """Return a side without some of its points at both ends."""
    kept = slice(first, len(side.points) - last)
    return Side(side.points[kept], side.low[kept], side.high[kept], side.gap[kept])


def _heights(line: WideLine, strip: Strip) -> Floats | None:
    """Return the heights of the line beside the points of the strip."""
    if line.heights is None:
        return None
    return np.asarray(np.interp(strip.places, np.arange(len(line.points)), line.heights).mean(axis=1))


def _bend(line: WideLine, sides: list[Side], place: float) -> int:
    """Return the sharpest joint of the part of the line that is cut off at a place, or the joint next to it."""
    last = len(line.points) - 1
    low, high = place, place
    for side in sides:
        around = np.flatnonzero((side.low <= place) & (place <= side.high))
        if len(around):
            longest = around[(side.high - side.low)[around].argmax()]
            low, high = min(low, side.low[longest]), max(high, side.high[longest])
    joints = np.arange(max(int(np.ceil(low)), 1), min(int(high), last - 1) + 1)
    if not len(joints):
        return int(np.clip(round(place), 1, last - 1))
    ahead = line.directions
    return int(joints[(ahead[joints - 1] * ahead[joints]).sum(axis=1).argmin()])


# ---- closed lines ----------------------------------------------------------------------------------------------------


def _opened(line: WideLine, style: Style) -> WideLine:
    """Return a closed line as an open one, from the middle of a segment round to it again, far from tight bends."""
    length = np.hypot(*np.diff(line.points, axis=0, append=line.points[:1]).T)
    start = np.append(0.0, np.cumsum(length))
    bends = start[:-1][_tight_joints(line, style)]
    if not len(bends):
        return _opened_at(line, int(length.argmax()))
    everywhere = np.concatenate([bends - start[-1], bends, bends + start[-1]])
    middle = start[:-1] + length / 2
    after = np.searchsorted(everywhere, middle)
    nearest = np.minimum(everywhere[after] - middle, middle - everywhere[after - 1])
    return _opened_at(line, int(nearest.argmax()))


def _tight_joints(line: WideLine, style: Style) -> Bools:
    """Return at which joints an inner corner does not fit between its neighbours."""
    tight = np.zeros(len(line.points), dtype=bool)
    once_round = _opened_at(line, -1)
    for way in (LEFT, RIGHT):
        side = rough_side(once_round, way, style)
        tight[side.low[side.gap].astype(np.int64) - 1] = True
    return tight


def _opened_at(line: WideLine, segment: int) -> WideLine:
    """Return a closed line as an open one that begins in the middle of a segment."""

    def once_round(values: Floats) -> Floats:
        rolled = np.roll(values, -1 - segment, axis=0)
        middle = (rolled[:1] + rolled[-1:]) / 2
        return np.concatenate([middle, rolled, middle])

    heights = None if line.heights is None else once_round(line.heights)
    rows = np.concatenate([line.rows[[segment]], np.roll(line.rows, -1 - segment), line.rows[[segment]]])
    return replace(
        line,
        points=once_round(line.points),
        half_widths=once_round(line.half_widths),
        heights=heights,
        rows=rows,
        closed=False,
    )
