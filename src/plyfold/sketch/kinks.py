"""The small loop that keeps a curve from being the outline of a disk, and the curve without it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, islice
from typing import NamedTuple

import numpy as np

from plyfold.arrangement import Arrangement
from plyfold.arrangement.loops import loop_turning_numbers
from plyfold.arrays import Bools, Floats, Ints
from plyfold.curve import Curve
from plyfold.errors import PlyfoldError
from plyfold.immersion import bounds_disk

__all__ = ["Kink", "find_kink", "place_of_turning"]

# How many of the shortest loops are looked at, and how many are left out in earnest, one or two at a time.
_MOST_LOOPS = 64
_MOST_IN_PAIRS = 24
_MOST_TRIED = 16
_MOST_CROSSINGS_DECIDED = 4000  # by all tries together


@dataclass(frozen=True, eq=False)
class Kink:
    """Loops of the curve, each from a crossing back to it: one as a rule, two if only both can be the cause.

    Parameters
    ----------
    places : tuple of (x, y)
        The crossings.
    loops : tuple of (m, 2) float
        The loops, each from its crossing on, closed implicitly.
    rest : (n, 2) float
        The curve without them, with corners at the crossings.
    """

    places: tuple[tuple[float, float], ...]
    loops: tuple[Floats, ...]
    rest: Floats


def find_kink(drawn: Arrangement) -> Kink | None:
    """Return the shortest loop of at most half the curve's length that can be left out to leave a disk, or two of them.

    Parameters
    ----------
    drawn : Arrangement
        With a drawing; it bounds no disk.

    Returns
    -------
    Kink or None
        What is left has been decided anew. Of the 64 shortest loops, and then of pairs of the 24 shortest, those come
        in question that leave a curve which turns once and has no negative winding number. The first sixteen of them
        are tried, fewer where the curve has hundreds of crossings.

    Notes
    -----
    A few milliseconds for 30 crossings.

    Examples
    --------
    >>> from plyfold.arrangement import arrangement
    >>> curl = arrangement([(0, 0), (6, 0), (6, 3), (5, 3), (5, -1), (7, -1), (7, 6), (0, 6)])
    >>> curl.turning_number, find_kink(curl).places
    (2, ((5.0, 0.0),))
    """
    loops = _loops(drawn)[:_MOST_LOOPS]
    inside = np.array([_is_inside(drawn, loop) for loop in loops]).reshape(len(loops), drawn.n_borders)
    winding = _windings(drawn, inside)
    kinks = (
        _without(drawn, [loops[i] for i in chosen], np.logical_not(inside[chosen].any(axis=0)))
        for chosen in _choices(loops, inside)
        if _may_leave_disk(drawn, sum(loops[i].turning for i in chosen), winding[chosen].sum(axis=0))
    )
    tried = islice(kinks, min(_MOST_TRIED, _MOST_CROSSINGS_DECIDED // max(drawn.n_crossings, 1)))
    return next((kink for kink in tried if _is_disk(kink.rest)), None)


def _choices(loops: list[_Loop], inside: Bools) -> Iterator[list[int]]:
    """Yield the numbers of what may be left out: each loop, then pairs without a common border, the shortest first."""
    yield from ([i] for i in range(len(loops)))
    pairs = [list(pair) for pair in combinations(range(len(loops))[:_MOST_IN_PAIRS], 2)]
    apart = [pair for pair in pairs if not inside[pair].all(axis=0).any()]
    yield from sorted(apart, key=lambda pair: sum(loops[i].length for i in pair))


def _may_leave_disk(drawn: Arrangement, turning: int, winding: Ints) -> bool:
    """Tell whether the curve without loops, given how often these turn and wind, turns once and winds one way only."""
    left = drawn.turning_number - turning
    return abs(left) == 1 and bool((left * (drawn.winding - winding) >= 0).all())


def place_of_turning(drawn: Arrangement) -> tuple[tuple[float, float], ...]:
    """Return the crossing of the shortest loop without which the turning number would be nearer to 1, if any."""
    turning = drawn.turning_number
    nearer = (loop for loop in _loops(drawn) if abs(turning - loop.turning - 1) < abs(turning - 1))
    return tuple(_crossing(drawn, loop.first) for loop in islice(nearer, 1))


class _Loop(NamedTuple):
    """The part of the curve between two visits to the same crossing."""

    length: float
    first: int
    last: int
    turning: int


def _loops(drawn: Arrangement) -> list[_Loop]:
    """Return the shorter one of the two loops at each crossing, the shortest first."""
    if drawn.n_crossings == 0:
        return []
    first = np.flatnonzero(np.arange(len(drawn.partner)) < drawn.partner)
    second = drawn.partner[first]
    along, whole = _places_along(drawn)
    inner = along[second] - along[first]
    rows = zip(first.tolist(), second.tolist(), inner.tolist(), loop_turning_numbers(drawn).tolist(), strict=True)
    return sorted(
        _Loop(length, p, q, turning[0]) if length <= whole - length else _Loop(whole - length, q, p, turning[1])
        for p, q, length, turning in rows
    )


def _places_along(drawn: Arrangement) -> tuple[Floats, float]:
    """Return how far along the curve each visit is, and the length of the curve."""
    lengths = [float(np.hypot(*np.diff(drawn.border_points(b), axis=0).T).sum()) for b in range(drawn.n_borders)]
    ends = np.cumsum(lengths)
    return np.concatenate([[0.0], ends[:-1]]), float(ends[-1])


def _is_inside(drawn: Arrangement, loop: _Loop) -> Bools:
    """Tell of each border whether the loop has it."""
    along = (np.arange(drawn.n_borders) - loop.first) % drawn.n_borders
    return np.asarray(along < (loop.last - loop.first) % drawn.n_borders)


def _windings(drawn: Arrangement, inside: Bools) -> Ints:
    """Return how often loops wind around each cell, shape (loops, cells): left of their borders once more."""
    winding = np.zeros((len(inside), drawn.n_cells), dtype=np.int64)
    reached, waiting = {0}, [0]
    cell_of = drawn.cell_of_dart.tolist()
    while waiting:
        cell = waiting.pop()
        for dart in drawn.cells[cell]:
            beyond = cell_of[dart ^ 1]
            if beyond not in reached:
                reached.add(beyond)
                waiting.append(beyond)
                winding[:, beyond] = winding[:, cell] + (1 if dart % 2 else -1) * inside[:, dart // 2]
    return winding


def _without(drawn: Arrangement, loops: list[_Loop], kept: Bools) -> Kink:
    places = tuple(_crossing(drawn, loop.first) for loop in loops)
    left_out = tuple(
        _along(drawn, (loop.first + np.arange(drawn.n_borders)), _is_inside(drawn, loop)) for loop in loops
    )
    return Kink(places, left_out, _along(drawn, np.arange(drawn.n_borders), kept))


def _along(drawn: Arrangement, order: Ints, kept: Bools) -> Floats:
    """Return the curve along the borders that are kept, with corners where others are left out.

    Of the crossings only these corners stay: the others are rounded, and would bend the edges they lie on.
    """
    pieces = []
    for border in (order % drawn.n_borders).tolist():
        if kept[border]:
            points = drawn.border_points(border)
            pieces.append(points[1 if kept[border - 1] else 0 : -1])
    return np.concatenate(pieces)


def _crossing(drawn: Arrangement, visit: int) -> tuple[float, float]:
    x, y = drawn.crossings[drawn.crossing_of_visit[visit]].tolist()
    return x, y


def _is_disk(points: Floats) -> bool:
    try:
        return bounds_disk(Curve(points))
    except PlyfoldError:  # what is left is no curve at all
        return False
