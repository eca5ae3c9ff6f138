"""The small loop that keeps a curve from being the outline of a disk, and the curve without it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from plyfold.arrangement import Arrangement
from plyfold.arrangement.loops import loop_turning_numbers
from plyfold.arrays import Floats, Ints
from plyfold.curve import Curve
from plyfold.errors import PlyfoldError
from plyfold.immersion import bounds_disk

__all__ = ["Kink", "find_kink", "place_of_turning"]

_MOST_TRIED = 24
_MOST_CROSSINGS_DECIDED = 4000  # by all tries together


@dataclass(frozen=True, eq=False)
class Kink:
    """A loop of the curve, from a crossing back to it.

    Parameters
    ----------
    where : (x, y)
        The crossing.
    loop : (m, 2) float
        The loop, from the crossing on, closed implicitly.
    rest : (n, 2) float
        The curve without it, with a corner at the crossing.
    """

    where: tuple[float, float]
    loop: Floats
    rest: Floats


def find_kink(drawn: Arrangement) -> Kink | None:
    """Return the shortest loop of at most half the curve's length that can be left out to leave a disk.

    Parameters
    ----------
    drawn : Arrangement
        With a drawing; it bounds no disk.

    Returns
    -------
    Kink or None
        What is left has been decided anew. None if no single loop is the cause, or none of the 24 shortest ones that
        leave a curve which turns once; fewer are tried where the curve has hundreds of crossings.

    Examples
    --------
    >>> from plyfold.arrangement import arrangement
    >>> curl = arrangement([(0, 0), (6, 0), (6, 3), (5, 3), (5, -1), (7, -1), (7, 6), (0, 6)])
    >>> curl.turning_number, find_kink(curl).where
    (2, (5.0, 0.0))
    """
    tried = min(_MOST_TRIED, _MOST_CROSSINGS_DECIDED // max(drawn.n_crossings, 1))
    turning = loop_turning_numbers(drawn)
    candidates = [(a, b) for _, a, b, turns in _loops(drawn, turning) if abs(drawn.turning_number - turns) == 1]
    kinks = (_kink(drawn, a, b) for a, b in candidates[:tried])
    return next((kink for kink in kinks if _is_disk(kink.rest)), None)


def place_of_turning(drawn: Arrangement) -> tuple[tuple[float, float], ...]:
    """Return the crossing of the shortest loop without which the turning number would be nearer to 1, if any."""
    turning = drawn.turning_number
    loops = _loops(drawn, loop_turning_numbers(drawn))
    nearer = (first for _, first, _, turns in loops if abs(turning - turns - 1) < abs(turning - 1))
    visit = next(nearer, None)
    return () if visit is None else (_crossing(drawn, visit),)


def _loops(drawn: Arrangement, turning: Ints) -> Iterator[tuple[float, int, int, int]]:
    """Yield the shorter loop at each crossing, shortest first: length, first and last visit, turning number."""
    first = np.flatnonzero(np.arange(len(drawn.partner)) < drawn.partner)
    second = drawn.partner[first]
    along, whole = _places_along(drawn)
    length = along[second] - along[first]
    found = [
        (inner, p, q, turns[0]) if inner <= whole - inner else (whole - inner, q, p, turns[1])
        for inner, p, q, turns in zip(length.tolist(), first.tolist(), second.tolist(), turning.tolist(), strict=True)
    ]
    yield from sorted(found)


def _places_along(drawn: Arrangement) -> tuple[Floats, float]:
    """Return how far along the curve each visit is, and the length of the curve."""
    lengths = [float(np.hypot(*np.diff(drawn.border_points(b), axis=0).T).sum()) for b in range(drawn.n_borders)]
    ends = np.cumsum(lengths)
    return np.concatenate([[0.0], ends[:-1]]), float(ends[-1])


def _kink(drawn: Arrangement, first: int, last: int) -> Kink:
    return Kink(_crossing(drawn, first), _between(drawn, first, last), _between(drawn, last, first))


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
