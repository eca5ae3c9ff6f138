"""The vertices of one closed polyline: cleaned of what says nothing, and refused where they are no curve."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import flat
from plyfold.core.vertices import count_vertices, without_closing_point
from plyfold.errors import CurveError, InputError
from plyfold.outline.points import Repair, as_planar_points
from plyfold.predicates import orient

__all__ = [
    "Vertices",
    "cleaned",
    "cleaned_of_several",
    "marked",
    "naming_the_curve",
    "no_area",
    "whole_turns",
]


MOST_TURNS = 1_000_000
"""No cusp has a larger index: over its left lie more sheets than it has turns."""


class Vertices(NamedTuple):
    """The vertices that are left of the points of a closed polyline.

    Parameters
    ----------
    points : (n, 2) float
        No two consecutive ones equal.
    rows : (n,) int
        The row of each in the array as it was given.
    given : (m, 2) float
        All rows.
    repairs : tuple of Repair
        What was left out.
    cusps : (n,) int
        The index of each vertex as a cusp: 0 unless it is known.
    """

    points: Floats
    rows: Ints
    given: Floats
    repairs: tuple[Repair, ...]
    cusps: Ints


def cleaned(points: npt.ArrayLike) -> Vertices:
    """Return the vertices of a closed polyline; raise CurveError if the points make none."""
    planar, flattened = as_planar_points(points)
    places = flat(planar)
    given = planar[: without_closing_point(places)]
    if count_vertices(places):
        kept, rows = given, np.arange(len(given))
    else:
        rows = _fresh_rows(given)
        kept = given[rows]
        _refuse_degenerate(kept)
    none = np.zeros(len(kept), dtype=np.int64)
    for array in (kept, rows, none):
        array.setflags(write=False)
    return Vertices(kept, rows, planar, (*flattened, *_dropped_points(given, rows)), none)


def cleaned_of_several(points: npt.ArrayLike) -> Vertices:
    """Return the vertices of one loop of several: none, which ``repairs`` tells, if all its points lie on one line."""
    try:
        return cleaned(points)
    except CurveError:
        planar, _ = as_planar_points(points)  # raises what else may be wrong
        if not len(planar):
            raise
        nothing = np.empty((0, 2)), np.empty(0, dtype=np.int64)
        return Vertices(*nothing, planar, (no_area(planar),), nothing[1])


def no_area(points: Floats) -> Repair:
    """Return the record that a loop is left out, for it goes round nothing."""
    x, y = points[0].tolist()
    return Repair("loop without area left out", (x, y), 0.0)


def marked(vertices: Vertices, index: npt.ArrayLike) -> Ints:
    """Return the index of the cusp at each vertex, given one for each row; those of points left out are added up.

    Raises
    ------
    CurveError
        If an index is no whole number from 0 up, or if there are not as many as rows.
    """
    try:
        given = np.asarray(index)
    except ValueError:  # rows of different lengths
        given = np.empty((0, 2))
    n = len(vertices.points)
    if given.ndim != 1 or len(given) not in (len(vertices.given), n):
        raise CurveError(
            f"the cusps of a loop of {n} points have the shape {given.shape}",
            hint="give one whole number for each point, mostly 0",
        )
    for row in np.flatnonzero(given) if given.dtype.kind in "iu" else range(len(given)):
        if whole_turns(given[row], vertices.given[row]) and n == 0:
            raise CurveError("a loop whose points all lie on one line has no cusps", where=[vertices.given[row]])
    given = given.astype(np.int64)
    total = np.zeros(n, dtype=np.int64)
    if n:
        np.add.at(total, _vertex_of_row(vertices, len(given)), given)
    total.setflags(write=False)
    return total


def whole_turns(index: object, place: npt.ArrayLike | None = None) -> int:
    """Return the index of a cusp as an int; refuse what is no whole number from 0 up."""
    if isinstance(index, bool) or not isinstance(index, int | np.integer) or index < 0:
        raise CurveError(
            f"the index of a cusp counts full turns and is a whole number from 0 up, not {index}",
            where=[] if place is None else [np.asarray(place)],
        )
    if index > MOST_TURNS:
        raise CurveError(f"a cusp of index {index} is beyond {MOST_TURNS:,} full turns")
    return int(index)


@contextmanager
def naming_the_curve(number: int, count: int) -> Iterator[None]:
    """Say in an error which of several curves it is about."""
    try:
        yield
    except InputError as error:
        if count == 1:
            raise
        raise type(error)(f"curve {number} of {count}: {error.message}", error.where, error.hint) from error


def _vertex_of_row(vertices: Vertices, count: int) -> Ints:
    """Return the vertex that each row stands for: itself, or the one that it repeats."""
    if count == len(vertices.points):
        return np.arange(count)
    vertex = np.searchsorted(vertices.rows, np.arange(count), side="right") - 1
    # What comes after the last vertex repeats it, or else the first one.
    after = np.arange(count) > vertices.rows[-1]
    vertex[after & (vertices.given == vertices.points[0]).all(axis=1)] = 0
    return vertex


def _fresh_rows(points: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
    """Return the first row of each run of equal points; a run across the end belongs to the first point."""
    fresh = (points != np.roll(points, 1, axis=0)).any(axis=1)
    fresh[:1] = True
    last = np.flatnonzero(fresh)[-1:]
    fresh[last] = (last == 0) | (points[last] != points[:1]).any(axis=1)
    return np.flatnonzero(fresh)


def _dropped_points(points: npt.NDArray[np.float64], kept: npt.NDArray[np.int64]) -> list[Repair]:
    if len(kept) == len(points):
        return []
    places = dict.fromkeys((x, y) for x, y in np.delete(points, kept, axis=0).tolist())
    return [Repair("repeated point dropped", place, 0.0) for place in places]


def _refuse_degenerate(points: npt.NDArray[np.float64]) -> None:
    if _has_a_corner(points):
        return
    distinct = np.unique(points, axis=0)
    if len(distinct) < 3:
        count = "no points" if len(distinct) == 0 else f"only {len(distinct)} different point(s)"
        raise CurveError(f"the curve has {count}", where=distinct, hint="a closed curve needs at least three")
    # In lexicographic order the extreme points differ, and on a line they are its two ends.
    if not orient(distinct[0], distinct[-1], distinct).any():
        hint = "a curve that runs back and forth on one line bounds nothing"
        raise CurveError("all points lie on one line", where=[distinct[0], distinct[-1]], hint=hint)


def _has_a_corner(points: npt.NDArray[np.float64]) -> bool:
    """Tell whether the point that seems farthest is off the line through the first two."""
    if len(points) < 3:
        return False
    x, y = (points - points[0]).T
    farthest = int(np.abs(x[1] * y - y[1] * x).argmax())
    return bool(orient(points[0], points[1], points[farthest]))
