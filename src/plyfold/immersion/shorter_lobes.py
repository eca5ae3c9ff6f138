"""Lobes that could be left out of a curve: at each crossing the shorter one of the two into which it falls apart there.

They are where a curve turns too often, or not often enough. What is left without one need not bound a disk; here it is
only asked whether the numbers allow it.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.lobes import lobe_turning_numbers
from plyfold.arrangement.places import places_of_visits
from plyfold.arrays import Bools, Floats, Ints
from plyfold.graphs import spanning_tree

__all__ = ["place_of_turning"]

# Curves with more crossings are not asked what would be left of them.
_MOST_CROSSINGS = 4000
# How many of the shortest lobes are looked at, one or two at a time.
_MOST_LOBES = 64
_MOST_IN_PAIRS = 24


class _Lobe(NamedTuple):
    """The part of the curve from one visit to a crossing on to the other, and how often it turns."""

    length: float
    first: int
    last: int
    turning: int


class _Lobes(NamedTuple):
    """Lobes as arrays, the shortest first, and how often the rest of the curve turns without each of them."""

    length: Floats
    first: Ints
    last: Ints
    turning: Ints
    rest: Ints


def _lobes_to_leave_out(drawn: Arrangement) -> Iterator[list[_Lobe]]:
    """Yield lobes, or two of them, without which the curve may bound a disk, as far as its numbers tell.

    Of the 64 shortest lobes, and then of pairs of the 24 shortest, those that leave a curve which turns once and winds
    one way only. None for more than 4,000 crossings.
    """
    if not 0 < drawn.n_crossings <= _MOST_CROSSINGS:
        return
    columns = (column[:_MOST_LOBES].tolist() for column in _shorter_lobes(drawn)[:4])
    lobes = [_Lobe(*row) for row in zip(*columns, strict=True)]
    inside = np.array([_is_inside(drawn, lobe) for lobe in lobes])
    winding = _windings(drawn, inside)
    for chosen in _choices(lobes, inside):
        left = drawn.turning_number - sum(lobes[i].turning for i in chosen)
        if abs(left) == 1 and (left * (drawn.winding - winding[chosen].sum(axis=0)) >= 0).all():
            yield [lobes[i] for i in chosen]


def place_of_turning(drawn: Arrangement) -> tuple[tuple[float, float], ...]:
    """Return where a drawing turns too often, or not often enough; for a code without a drawing nothing.

    The crossing of the shortest lobe, or of two, without which it may bound a disk; else of the shortest one without
    which it would turn nearer to once; else of the shortest one that does itself. One of these there always is: what
    lies between the two visits to a crossing, and crosses itself nowhere else, turns once.

    Cost: O(k log k), and some milliseconds up to 4,000 crossings.

    Examples
    --------
    >>> from plyfold import arrange
    >>> place_of_turning(arrange([(0, 0), (2, 2), (2, 0), (0, 2)]))
    ((1.0, 1.0),)
    """
    if drawn.n_loops > 1 or drawn.outline is None or not drawn.n_crossings:
        return ()
    chosen = next(_lobes_to_leave_out(drawn), None)
    return places_of_visits(drawn, [lobe.first for lobe in chosen] if chosen else [_nearer_to_once(drawn)])


def _nearer_to_once(drawn: Arrangement) -> int:
    """Return the first visit of the shortest lobe that leaves, or else is, a curve that turns nearer to once."""
    lobes = _shorter_lobes(drawn)
    off = abs(drawn.turning_number - 1)
    for turning in (lobes.rest, lobes.turning):
        nearer = np.flatnonzero(np.abs(np.abs(turning) - 1) < off)
        if len(nearer):
            return int(lobes.first[nearer[0]])
    raise AssertionError("a closed curve has a simple lobe at one of its crossings")


def _is_inside(drawn: Arrangement, lobe: _Lobe) -> Bools:
    """Tell of each border whether the lobe has it."""
    along = (np.arange(drawn.n_borders) - lobe.first) % drawn.n_borders
    return np.asarray(along < (lobe.last - lobe.first) % drawn.n_borders)


def _shorter_lobes(drawn: Arrangement) -> _Lobes:
    """Return the shorter one of the two lobes at each crossing, the shortest first."""
    first = drawn.first_visits
    second = drawn.partner[first]
    along, whole = _places_along(drawn)
    inner = along[second] - along[first]
    shorter = inner <= whole - inner
    turning = np.take_along_axis(lobe_turning_numbers(drawn), np.stack([~shorter, shorter], axis=1).astype(int), axis=1)
    length = np.where(shorter, inner, whole - inner)
    order = np.argsort(length, kind="stable")
    return _Lobes(
        length=length[order],
        first=np.where(shorter, first, second)[order],
        last=np.where(shorter, second, first)[order],
        turning=turning[order, 0],
        rest=turning[order, 1],
    )


def _places_along(drawn: Arrangement) -> tuple[Floats, float]:
    """Return how far along the curve each visit is, and the length of the curve."""
    assert drawn.curve is not None
    points = drawn.curve.points
    edges = np.hypot(*np.diff(points, axis=0, append=points[:1]).T)
    ends = np.cumsum(edges)
    start = drawn.visit_edge
    since_start = np.hypot(*(drawn.crossings[drawn.crossing_of_visit] - points[start]).T)
    return (ends - edges)[start] + since_start, float(ends[-1])


def _choices(lobes: list[_Lobe], inside: Bools) -> Iterator[list[int]]:
    """Yield the numbers of what may be left out: each lobe, then pairs without a common border, the shortest first."""
    yield from ([i] for i in range(len(lobes)))
    pairs = [list(pair) for pair in combinations(range(len(lobes))[:_MOST_IN_PAIRS], 2)]
    apart = [pair for pair in pairs if not inside[pair].all(axis=0).any()]
    yield from sorted(apart, key=lambda pair: sum(lobes[i].length for i in pair))


def _windings(drawn: Arrangement, inside: Bools) -> Ints:
    """Return how often lobes wind around each cell, shape (lobes, cells): left of their borders once more."""
    parent, border, order = spanning_tree(drawn.n_cells, drawn.left_cell, drawn.right_cell)
    more = np.where(drawn.left_cell[border] == np.arange(drawn.n_cells), 1, -1) * inside[:, border]
    winding = np.zeros((len(inside), drawn.n_cells), dtype=np.int64)
    for cell in order[1:].tolist():
        winding[:, cell] = winding[:, parent[cell]] + more[:, cell]
    return winding
