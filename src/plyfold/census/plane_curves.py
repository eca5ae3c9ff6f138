"""Plane curves, each once: closed curves on the sphere whose words are least, with every cell as the unbounded one.

Another start, the other direction and the mirror image give a closed curve with k crossings 8k *names*: its words of
one letter for each visit, how many visits later the partner comes and the sign. A curve is kept where it is drawn with
its least word. Names that are equal are its symmetries; they take cells to cells, and of these one is kept as the
unbounded cell.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product, starmap

import numpy as np

from plyfold.arrays import Bools, Ints, Signs
from plyfold.census.open_curves import OpenCurves, closed_curves, every_way_on, one_crossing
from plyfold.errors import InputError

__all__ = ["CIRCLE", "PlaneCurves", "SphereCurves", "least_named", "on_the_plane", "plane_curves"]

# A word has one letter for each visit, which is a byte, and names of crossings are letters.
_MOST_CROSSINGS = 20
_OPEN_CURVES_PER_PART = 32


@dataclass(frozen=True)
class SphereCurves:
    """Closed curves on the sphere, one in every row, no two of them equal.

    Attributes
    ----------
    partner, ccw : (n, 2k) int8, bool
        Their signed Gauss codes.
    same_cell : (n, 4k) int
        For every dart the lowest dart of all cells that symmetries take its cell to.
    n_symmetries : (n, 4k) int
        How many symmetries leave the cell of every dart where it is: at least 1.
    """

    partner: Signs
    ccw: Bools
    same_cell: Ints
    n_symmetries: Ints


@dataclass(frozen=True)
class PlaneCurves:
    """Closed curves in the plane, one in every row: no two are equal up to start, direction and reflection.

    Parameters
    ----------
    partner, ccw : (n, 2k) int8, bool
    outer : (n,) int
        With these, signed Gauss codes; the lowest dart of the unbounded cell.
    turning : (n,) int
        Turning numbers in the direction of the codes.
    lowest, highest : (n,) int
        Least and greatest winding number.
    n_symmetries : (n,) int
        How many of the 8k names of each are the same.

    Examples
    --------
    >>> (curves,) = plane_curves(1)
    >>> sorted(abs(curves.turning).tolist())
    [0, 2]
    """

    partner: Signs
    ccw: Bools
    outer: Ints
    turning: Ints
    lowest: Ints
    highest: Ints
    n_symmetries: Ints

    def __len__(self) -> int:
        return len(self.outer)

    def rows(self, rows: slice) -> PlaneCurves:
        """Return some of them."""
        return PlaneCurves(*(column[rows] for column in vars(self).values()))


CIRCLE = PlaneCurves(
    partner=np.zeros((1, 0), dtype=np.int8),
    ccw=np.zeros((1, 0), dtype=bool),
    outer=np.array([1]),
    turning=np.array([1]),
    lowest=np.array([0]),
    highest=np.array([1]),
    n_symmetries=np.array([1]),
)


@dataclass(frozen=True)
class Name:
    """One of the names of a closed curve: where it starts, whether it runs backward, whether it is a mirror image."""

    start: int
    backward: bool
    mirrored: bool

    def word(self, gaps: Ints, ccw: Bools) -> Ints:
        """Return this name of curves whose own ones are given, with words that compare as the bytes they are."""
        n = gaps.shape[1]
        visits = self._visits(n)
        letters = n - gaps[:, visits] if self.backward else gaps[:, visits]
        # The gap of a curve is odd: a chord of a circle of visits has evenly many on each side.
        letters += ccw[:, visits] != self.mirrored
        return np.ascontiguousarray(letters, dtype=np.uint8).view(f"S{n}")[:, 0]

    def darts(self, n_visits: int) -> Ints:
        """Return for every dart under this name the dart under the own one that has the same cell on its left."""
        borders = self._visits(n_visits)
        if self.backward:
            borders = (borders - 1) % n_visits
        flipped = int(self.backward != self.mirrored)
        return np.stack([2 * borders + flipped, 2 * borders + 1 - flipped], axis=1).ravel()

    def _visits(self, n_visits: int) -> Ints:
        steps = np.arange(n_visits)
        return (self.start + (-steps if self.backward else steps)) % n_visits


def _names(n_visits: int) -> Iterator[Name]:
    return starmap(Name, product(range(n_visits), (False, True), (False, True)))


def least_named(closed: OpenCurves) -> SphereCurves:
    """Return those of the closed curves that are drawn with the least of their names."""
    n = closed.n_visits
    gaps: Ints = np.mod(closed.partner - np.arange(n, dtype=np.int8), np.int8(n))
    # A least word begins with the least gap, run either way, and with the lower sign.
    least = np.minimum(gaps, n - gaps).min(axis=1)
    kept = np.flatnonzero((gaps[:, 0] == least) & ~closed.ccw[:, 0])
    own = Name(0, False, False).word(gaps[kept], closed.ccw[kept])
    for name in _names(n):
        is_least = own <= name.word(gaps[kept], closed.ccw[kept])
        kept, own = kept[is_least], own[is_least]
    return _with_symmetries(closed.partner[kept], closed.ccw[kept], gaps[kept], own)


def _with_symmetries(partner: Signs, ccw: Bools, gaps: Ints, own: Ints) -> SphereCurves:
    """Try all names of curves: those equal to their own are symmetries."""
    n = partner.shape[1]
    cells = _lowest_darts(partner, ccw)
    same_cell, n_symmetries = cells.copy(), np.zeros_like(cells)
    for name in _names(n):
        rows = np.flatnonzero(own == name.word(gaps, ccw))
        moved = cells[rows][:, name.darts(n)]
        n_symmetries[rows] += moved == cells[rows]
        same_cell[rows] = np.minimum(same_cell[rows], moved)
    return SphereCurves(partner, ccw, same_cell, n_symmetries)


def _lowest_darts(partner: Signs, ccw: Bools) -> Ints:
    """Return for every dart the lowest one of its cell."""
    n = partner.shape[1]
    following = np.empty((len(partner), 2 * n), dtype=np.int64)
    # At a crossing turn left: the other strand's way out, or its way in, walked backward.
    out, back = 2 * partner.astype(np.int64), 2 * ((partner.astype(np.int64) - 1) % n) + 1
    following[:, 1::2] = np.where(ccw, back, out)
    following[:, 0::2] = np.roll(np.where(ccw, out, back), -1, axis=1)
    lowest = np.minimum(np.arange(2 * n), following)
    for _ in range((2 * n).bit_length()):
        following = np.take_along_axis(following, following, axis=1)
        lowest = np.minimum(lowest, np.take_along_axis(lowest, following, axis=1))
    return lowest


def on_the_plane(curves: SphereCurves) -> PlaneCurves:
    """Take every cell of curves on the sphere as the unbounded one, of those that symmetries exchange one."""
    n = curves.partner.shape[1]
    rows, outer = np.nonzero(curves.same_cell == np.arange(2 * n))
    partner, ccw = curves.partner[rows], curves.ccw[rows]
    winding = _windings(ccw)
    around = np.take_along_axis(winding, outer[:, None], axis=1)[:, 0]
    # Whitney's formula where the unbounded cell is on the right of the border before visit 0; every time that it moves
    # one border to the left, the turning number falls by 2.
    firsts = partner > np.arange(n)
    turning = 1 + np.where(firsts, np.where(ccw, -1, 1), 0).sum(axis=1) - 2 * (around - winding[:, -1])
    lowest, highest = winding.min(axis=1) - around, winding.max(axis=1) - around
    return PlaneCurves(partner, ccw, outer, turning, lowest, highest, curves.n_symmetries[rows, outer])


def _windings(ccw: Bools) -> Ints:
    """Return the winding number of the cell on the left of every dart, but for a number that is the same for all."""
    left = np.where(ccw, -1, 1).cumsum(axis=1)
    return np.stack([left, left - 1], axis=2).reshape(len(ccw), 2 * ccw.shape[1])


def plane_curves(n_crossings: int, part: int = 0, of: int = 1) -> Iterator[PlaneCurves]:
    """Yield all generic closed curves in the plane with so many crossings, each once, in batches.

    Parameters
    ----------
    n_crossings : int
        From 0 to 20; every crossing more makes about nine times as many.
    part, of : int, optional
        Only part number ``part`` of so many, which together are all curves and do not overlap.

    Yields
    ------
    PlaneCurves
        No two curves are equal up to start, direction and reflection.

    Raises
    ------
    InputError
        If there is no such part, or the number of crossings is out of range.

    Examples
    --------
    >>> [sum(len(batch) for batch in plane_curves(k)) for k in range(6)]
    [1, 2, 5, 20, 82, 435]

    Notes
    -----
    Nothing is stored, and no two curves are compared: a million curves take about 6 s, and little memory.
    """
    _require(n_crossings, part, of)
    if n_crossings == 0:
        if part == 0:
            yield CIRCLE
        return
    begun = _first_open_curves(n_crossings, of)
    for batch in closed_curves(begun.rows(slice(part, None, of)), n_crossings):
        yield on_the_plane(least_named(batch))


def _require(n_crossings: int, part: int, of: int) -> None:
    if not 0 <= n_crossings <= _MOST_CROSSINGS:
        raise InputError(f"the census is of curves with 0 to {_MOST_CROSSINGS} crossings, not {n_crossings}")
    if not 0 <= part < of:
        raise InputError(f"there is no part {part} of {of}", hint="parts are numbered from 0")


def _first_open_curves(n_crossings: int, of: int) -> OpenCurves:
    """Return the open curves of the first level with enough of them to be shared out evenly."""
    begun, crossings = one_crossing(), 1
    while crossings < n_crossings and len(begun) < _OPEN_CURVES_PER_PART * of:
        begun, crossings = every_way_on(begun), crossings + 1
    return begun
