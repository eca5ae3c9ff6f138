"""The small loop that keeps a curve from being the outline of a disk, and the curve without it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import NamedTuple

import numpy as np

from plyfold.arrangement import Arrangement, arrangement
from plyfold.arrangement.loops import loop_turning_numbers
from plyfold.arrays import Floats
from plyfold.curve import Curve
from plyfold.errors import PlyfoldError
from plyfold.immersion import bounds_disk

__all__ = ["Kink", "find_kink", "place_of_turning"]

_MOST_TRIED = 24
_MOST_TRIED_IN_PAIRS = 5
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
        What is left has been decided anew. The 24 shortest loops are tried that leave a curve which turns once, and, if
        none of them will do, pairs of the five shortest ones; fewer where the curve has hundreds of crossings.

    Examples
    --------
    >>> from plyfold.arrangement import arrangement
    >>> curl = arrangement([(0, 0), (6, 0), (6, 3), (5, 3), (5, -1), (7, -1), (7, 6), (0, 6)])
    >>> curl.turning_number, find_kink(curl).places
    (2, ((5.0, 0.0),))
    """
    return _single(drawn, _MOST_TRIED) or _pair(drawn)


def _single(drawn: Arrangement, most: int) -> Kink | None:
    tried = min(most, _MOST_CROSSINGS_DECIDED // max(drawn.n_crossings, 1))
    loops = (loop for loop in _loops(drawn) if abs(drawn.turning_number - loop.turning) == 1)
    kinks = (_without(drawn, loop) for loop in islice(loops, tried))
    return next((kink for kink in kinks if _is_disk(kink.rest)), None)


def _pair(drawn: Arrangement) -> Kink | None:
    """Leave out one of the shortest loops, whatever is left, and look for another one."""
    tried = min(_MOST_TRIED_IN_PAIRS, _MOST_CROSSINGS_DECIDED // (5 * max(drawn.n_crossings, 1)))
    for loop in islice(_loops(drawn), tried):
        first = _without(drawn, loop)
        second = _single_of(first.rest)
        if second is not None:
            return Kink(first.places + second.places, first.loops + second.loops, second.rest)
    return None


def _single_of(points: Floats) -> Kink | None:
    try:
        return _single(arrangement(Curve(points)), _MOST_TRIED_IN_PAIRS)
    except PlyfoldError:  # what is left is no curve at all
        return None


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


def _without(drawn: Arrangement, loop: _Loop) -> Kink:
    rest = _between(drawn, loop.last, loop.first)
    return Kink((_crossing(drawn, loop.first),), (_between(drawn, loop.first, loop.last),), rest)


def _between(drawn: Arrangement, start: int, end: int) -> Floats:
    """Return the curve from one visit to a crossing to the other, which closes there."""
    count = (end - start) % drawn.n_borders
    borders = [drawn.border_points((start + i) % drawn.n_borders) for i in range(count)]
    # Of the crossings on the way only the first stays: the others are rounded, and would bend the edges they lie on.
    return np.concatenate([borders[0][:1], *(border[1:-1] for border in borders)])


def _crossing(drawn: Arrangement, visit: int) -> tuple[float, float]:
    x, y = drawn.crossings[drawn.crossing_of_visit[visit]].tolist()
    return x, y


def _is_disk(points: Floats) -> bool:
    try:
        return bounds_disk(Curve(points))
    except PlyfoldError:  # what is left is no curve at all
        return False
