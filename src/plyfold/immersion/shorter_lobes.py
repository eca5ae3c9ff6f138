"""Lobes that could be left out of a curve: at each crossing the shorter one of the two into which it falls apart there.

They are where a curve turns too often, or not often enough. What is left without one need not bound a disk; here it is
only asked whether the numbers allow it: what bounds a disk turns once, and once more for each full turn too many that
the disk makes at a cusp.
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
    """The part of the curve from one visit to a crossing on to the other: how often it turns, and should at cusps."""

    length: float
    first: int
    last: int
    turning: int
    cusps: int


class _Lobes(NamedTuple):
    """Lobes as arrays, the shortest first."""

    length: Floats
    first: Ints
    last: Ints
    turning: Ints
    cusps: Ints


def _lobes_to_leave_out(drawn: Arrangement) -> Iterator[list[_Lobe]]:
    """Yield lobes, or two of them, without which the curve may bound a disk, as far as its numbers tell.

    Of the 64 shortest lobes, and then of pairs of the 24 shortest, those that leave a curve which turns once, but for
    its cusps, winds one way only, and has sheets enough at them. None for more than 4,000 crossings.
    """
    if not 0 < drawn.n_crossings <= _MOST_CROSSINGS:
        return
    columns = (column[:_MOST_LOBES].tolist() for column in _shorter_lobes(drawn))
    lobes = [_Lobe(*row) for row in zip(*columns, strict=True)]
    inside = np.array([_is_inside(drawn, lobe) for lobe in lobes])
    winding = _windings(drawn, inside)
    for chosen in _choices(lobes, inside):
        turning = drawn.turning_number - sum(lobes[i].turning for i in chosen)
        cusps = np.where(inside[chosen].any(axis=0), 0, drawn.cusp_index)
        if _off(turning, cusps.sum()) == 0:
            left = drawn.winding - winding[chosen].sum(axis=0)
            if _may_wind(drawn, np.sign(turning) * left, cusps):
                yield [lobes[i] for i in chosen]


def _may_wind(drawn: Arrangement, winding: Ints, cusps: Ints) -> bool:
    """Tell whether a part of the curve winds around no cell the wrong way, and around cells at its cusps often enough.

    A cusp of index m lies m + 1 times on itself, on that side of the curve round which it winds more often.
    """
    at = np.flatnonzero(cusps)
    border = drawn.border_after[at]
    sheets = np.maximum(winding[drawn.left_cell[border]], winding[drawn.right_cell[border]])
    return bool((winding >= 0).all() and (sheets > cusps[at]).all())


def place_of_turning(drawn: Arrangement) -> tuple[tuple[float, float], ...]:
    """Return where a drawing turns too often, or not often enough; for a code without a drawing nothing.

    The first cusp that would be one of a disk, or none, with a smaller index, as far as the numbers tell; else the
    crossing of the shortest lobe, or of two, without which the curve may bound a disk; else of the shortest one without
    which it would turn nearer to once, apart from its cusps; else of the one that itself is the nearest to that.

    Cost: O(k log k), and some milliseconds up to 4,000 crossings.

    Examples
    --------
    >>> from plyfold import arrange
    >>> place_of_turning(arrange([(0, 0), (2, 2), (2, 0), (0, 2)]))
    ((1.0, 1.0),)
    """
    if drawn.n_loops > 1 or drawn.outline is None or not drawn.n_crossings:
        return ()
    wrong = _cusps_to_leave_out(drawn)
    if len(wrong):
        return places_of_visits(drawn, wrong[:1].tolist())
    chosen = next(_lobes_to_leave_out(drawn), None)
    return places_of_visits(drawn, [lobe.first for lobe in chosen] if chosen else [_nearer_to_once(drawn)])


def _cusps_to_leave_out(drawn: Arrangement) -> Ints:
    """Return the visits at cusps with indices so large that the curve may bound a disk if one of them is smaller."""
    lacking = 1 - drawn.euler_characteristic
    if lacking <= 0 or drawn.winding.min() < 0:
        return np.empty(0, dtype=np.int64)
    return np.flatnonzero(drawn.cusp_index >= lacking)


def _off(turning: Ints | int, cusps: Ints | int) -> Ints:
    """Return by how much a curve, walked in the better direction, does not turn once, and as often as at its cusps."""
    return np.abs(np.abs(turning) - 1 - cusps)


def _nearer_to_once(drawn: Arrangement) -> int:
    """Return the first visit of the shortest lobe that leaves what turns nearer to once; else that is the nearest."""
    lobes = _shorter_lobes(drawn)
    turning, cusps = drawn.turning_number, int(drawn.cusp_index.sum())
    nearer = np.flatnonzero(_off(turning - lobes.turning, cusps - lobes.cusps) < _off(turning, cusps))
    return int(lobes.first[nearer[0] if len(nearer) else np.argmin(_off(lobes.turning, lobes.cusps))])


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
    inner_turning, outer_turning = lobe_turning_numbers(drawn).T
    passed = np.cumsum(drawn.cusp_index)
    inner_cusps = passed[second] - passed[first]
    length = np.where(shorter, inner, whole - inner)
    order = np.argsort(length, kind="stable")
    return _Lobes(
        length=length[order],
        first=np.where(shorter, first, second)[order],
        last=np.where(shorter, second, first)[order],
        turning=np.where(shorter, inner_turning, outer_turning)[order],
        cusps=np.where(shorter, inner_cusps, drawn.cusp_index.sum() - inner_cusps)[order],
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
