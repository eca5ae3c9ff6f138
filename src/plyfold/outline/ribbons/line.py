"""The line that a ribbon follows: its points, how wide the ribbon is at each, and their heights."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.core.vertices import LARGEST_COORDINATE
from plyfold.errors import CurveError, InputError
from plyfold.outline.curve import Outline
from plyfold.outline.points import Repair, as_planar_points

if TYPE_CHECKING:
    from shapely import LineString

__all__ = ["LineLike", "TightBendError", "WideLine", "as_line"]

LineLike: TypeAlias = "Outline | LineString | npt.ArrayLike"
"""Whatever stands for a line: points of shape (n, 2) or (n, 3), a shapely LineString, or a closed curve."""

_FEWEST_ROWS_OF_A_RING = 4


class TightBendError(Exception):
    """A bend is too tight for the width; ``place`` is along the line, where joints are whole numbers."""

    def __init__(self, place: float) -> None:
        super().__init__(place)
        self.place = place


@dataclass(frozen=True, eq=False)
class WideLine:
    """A polyline with a width at each point, open or closed.

    Parameters
    ----------
    points : (n, 2) float
        No two consecutive ones equal; of a closed line the first one is not repeated.
    half_widths : (n,) float
        Positive, but for the ends of an open line.
    heights : (n,) float or None
    closed : bool
    rows : (n,) int
        The row that each point has in what was given.
    repairs : tuple of Repair
        What was left out.
    """

    points: Floats
    half_widths: Floats
    heights: Floats | None
    closed: bool
    rows: Ints
    repairs: tuple[Repair, ...] = ()

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def directions(self) -> Floats:
        """The unit vector along each segment, shape (segments, 2)."""
        step = np.diff(self.points, axis=0, append=self.points[:1] if self.closed else self.points[:0])
        return np.asarray(step / np.hypot(*step.T)[:, None])

    def longer(self) -> WideLine:
        """Return an open line that goes straight on at both ends, as far as half the width there."""
        points, half = self.points, self.half_widths
        ahead = self.directions[[0, -1]] * half[[0, -1], None]
        first, last = points[0] - ahead[0], points[-1] + ahead[1]
        # Where the width stays the same an end is moved, which needs no point more.
        at_first, at_last = int(half[0] == half[1]), len(points) - int(half[-1] == half[-2])
        kept = [0, *range(at_first, at_last), len(points) - 1]
        moved = np.vstack([[first], points[at_first:at_last], [last]])
        heights = None if self.heights is None else self.heights[kept]
        return replace(self, points=moved, half_widths=half[kept], heights=heights, rows=self.rows[kept])


def as_line(line: LineLike, width: npt.ArrayLike, closed: bool | None = None) -> WideLine:
    """Return what stands for a line, with its width; refuse what is none."""
    given, repairs, is_ring = _points_given(line)
    if closed is None:
        closed = is_ring or (len(given) >= _FEWEST_ROWS_OF_A_RING and np.array_equal(given[0, :2], given[-1, :2]))
    planar, heights = given[:, :2], _heights(given)
    half = _half_widths(width, planar)
    rows = _fresh_rows(planar, closed)
    points, half = planar[rows], half[rows]
    _refuse_short(points, closed)
    _refuse_widths(points, half, closed)
    dropped = tuple(Repair("repeated point dropped", (x, y), 0.0) for x, y in _repeated(planar, rows, closed).tolist())
    return WideLine(points, half, None if heights is None else heights[rows], closed, rows, (*repairs, *dropped))


def _points_given(line: LineLike) -> tuple[Floats, tuple[Repair, ...], bool]:
    """Return the rows as they stand, what was changed in them before, and whether they are known to be closed."""
    if isinstance(line, Outline):
        if line.n_loops > 1:
            raise CurveError(
                f"this outline has {line.n_loops} loops", where=line.loops[1][:1], hint="make a ribbon of each"
            )
        return line.points, line.repairs, True
    kind = getattr(line, "geom_type", None)
    if isinstance(kind, str):
        if kind not in ("LineString", "LinearRing"):
            raise InputError(f"a {kind} is not one line", hint="give a LineString")
        return _with_heights(np.array(cast("Any", line).coords)), (), kind == "LinearRing"
    return _with_heights(cast("npt.ArrayLike", line)), (), False


def _with_heights(values: npt.ArrayLike) -> Floats:
    """Return rows of two or three finite numbers."""
    points, left_out = as_planar_points(values)
    if not left_out:
        return points
    heights = np.asarray(values, dtype=np.float64)[:, 2:]
    bad = np.flatnonzero(~(np.abs(heights[:, 0]) <= LARGEST_COORDINATE))
    if len(bad):
        raise CurveError(f"the height of point {bad[0]} is not finite", where=points[bad[:1]])
    return np.hstack([points, heights])


def _heights(given: Floats) -> Floats | None:
    return given[:, 2] if given.shape[1] > 2 else None


def _half_widths(width: npt.ArrayLike, points: Floats) -> Floats:
    try:
        half = np.asarray(width, dtype=np.float64) / 2
    except (TypeError, ValueError) as error:
        raise InputError("a width is a number, or one for each point", hint="such as width=2.5") from error
    if half.ndim and half.shape != (len(points),):
        hint = "give one number, or as many as the line has points"
        raise InputError(f"there are widths of shape {half.shape} for {len(points)} points", hint=hint)
    return np.broadcast_to(half, len(points))


def _fresh_rows(points: Floats, closed: bool) -> Ints:
    """Return the first row of each run of equal points."""
    fresh = (points != np.roll(points, 1, axis=0)).any(axis=1)
    if not closed:
        fresh[:1] = True
    elif len(points) and not fresh[0]:
        # A run across the end belongs to the first point.
        fresh[np.flatnonzero(fresh)[-1:]] = False
        fresh[0] = True
    return np.flatnonzero(fresh)


def _repeated(points: Floats, rows: Ints, closed: bool) -> Floats:
    """Return the points that were left out, but for the last one of a closed line, which may repeat the first."""
    left_out = np.ones(len(points), dtype=bool)
    left_out[rows] = False
    if closed:
        left_out[-1] = False
    return np.unique(points[left_out], axis=0)


def _refuse_short(points: Floats, closed: bool) -> None:
    least = 3 if closed else 2
    if len(points) < least:
        count = f"only {len(points)} different point(s)" if len(points) else "no points"
        what = "closed line" if closed else "line"
        raise CurveError(f"the line has {count}", where=points, hint=f"a {what} needs at least {least}")


def _refuse_widths(points: Floats, half: Floats, closed: bool) -> None:
    """Refuse widths that are not positive; an open line may end in a tip."""
    good: Bools = (half > 0) & (half <= LARGEST_COORDINATE)
    if not closed:
        good[[0, -1]] |= (half[[0, -1]] == 0) & half.any()
    bad = np.flatnonzero(~good)
    if len(bad) and half[bad[0]] > LARGEST_COORDINATE:
        hint = f"sides have coordinates up to {LARGEST_COORDINATE:g}"
        raise InputError(f"a ribbon {2 * half[bad[0]]:g} wide is too wide", where=points[bad[:1]], hint=hint)
    if len(bad):
        hint = "widths are positive; at ends of an open line they may be 0, but not along all of it"
        raise InputError(f"a ribbon cannot be {2 * half[bad[0]]:g} wide", where=points[bad[:1]], hint=hint)
