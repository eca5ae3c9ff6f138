"""Spikes: where a closed polyline runs back over the edge that it came on. They are taken out before anything else.

That is a convention, for an outline with a spike bounds a surface neither more nor less than without it, so every spike
is reported. A vertex that is marked as a cusp is none: there the surface turns, however the strands lie.
"""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from math import dist
from typing import NamedTuple

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import CurveError
from plyfold.outline.curve import Outline, outline_of_points
from plyfold.outline.points import Repair
from plyfold.predicates import orient

__all__ = ["tips", "without_spikes"]


def tips(outline: Outline) -> Bools:
    """Tell at which points a loop turns back the way that it came. Exact."""
    points = outline.points
    return _turns_back(points[outline.previous_point], points, points[outline.next_point])


def without_spikes(outline: Outline) -> tuple[Outline, Ints]:
    """Return what is left of an outline without its spikes, and which of its points these are.

    Returns
    -------
    Outline
        The same one if it has none. Where a spike is taken out, a new one may appear, and goes too. A loop of which
        nothing is left is dropped. All this is in ``repairs``.
    Ints

    Raises
    ------
    CurveError
        If nothing is left of any loop.

    Notes
    -----
    O(n), and O(log n) for each spike. What is left does not depend on where a loop begins and which way it runs.

    Examples
    --------
    >>> from plyfold.outline.curve import Curve
    >>> left, kept = without_spikes(Curve([(0, 0), (2, 0), (2, 2), (2, 5), (2, 2), (0, 2)]))
    >>> kept.tolist(), [str(repair) for repair in left.repairs]
    ([0, 1, 2, 5], ['spike taken out at (2, 5), size 3'])
    """
    first = np.flatnonzero(tips(outline) & (np.concatenate(outline.cusps) == 0))
    if len(first) == 0:
        return outline, np.arange(len(outline))
    chain = _Chain.of(outline)
    repairs = _taken_out(chain, first.tolist())
    loop, is_left = outline.loop_of_point, np.array(chain.is_left)
    stays = np.bincount(loop[is_left], minlength=outline.n_loops) > 2
    gone = outline.points[outline.first_point[:-1][~stays]].tolist()
    if not stays.any():
        hint = "a curve that runs back all the way that it came bounds nothing"
        raise CurveError("nothing is left of the outline without its spikes", where=gone, hint=hint)
    repairs += [Repair("loop of which nothing is left dropped", (x, y), 0.0) for x, y in gone]
    kept = np.flatnonzero(is_left & stays[loop])
    parts = outline.points[kept], loop[kept], np.array(chain.cusps)[kept], outline.rows[kept]
    return outline_of_points(*parts, (*outline.repairs, *repairs)), kept


class _Chain(NamedTuple):
    """The points of an outline, each linked to those before and after it that are left."""

    places: list[tuple[float, float]]
    before: list[int]
    after: list[int]
    cusps: list[int]
    is_left: list[bool]

    @classmethod
    def of(cls, outline: Outline) -> _Chain:
        places = [(x, y) for x, y in outline.points.tolist()]
        cusps = np.concatenate(outline.cusps).tolist()
        return cls(places, outline.previous_point.tolist(), outline.next_point.tolist(), cusps, [True] * len(places))


def _taken_out(chain: _Chain, tips: list[int]) -> list[Repair]:
    """Take out spikes until there are none, the leftmost tip first: so the order belongs to the drawing."""
    queue = [(chain.places[tip], tip) for tip in tips]
    heapify(queue)
    repairs = []
    while queue:
        place, tip = heappop(queue)
        if not _is_spike(chain, tip):
            continue
        sides = chain.places[chain.before[tip]], chain.places[chain.after[tip]]
        repairs.append(Repair("spike taken out", place, min(dist(place, side) for side in sides)))
        for neighbour in _take_out(chain, tip):
            if _is_spike(chain, neighbour):
                heappush(queue, (chain.places[neighbour], neighbour))
    return repairs


def _is_spike(chain: _Chain, tip: int) -> bool:
    if not chain.is_left[tip] or chain.cusps[tip]:
        return False
    ends = np.array([chain.places[point] for point in (chain.before[tip], tip, chain.after[tip])])
    return bool(_turns_back(*ends))


def _take_out(chain: _Chain, tip: int) -> set[int]:
    """Leave out a point, and one of its neighbours if these are at one place; return those on both sides of the gap."""
    first, second = chain.before[tip], chain.after[tip]
    _leave_out(chain, tip)
    if first != second and chain.places[first] == chain.places[second]:
        chain.cusps[first] += chain.cusps[second]
        _leave_out(chain, second)
        second = chain.after[first]
    return {first, second}


def _leave_out(chain: _Chain, point: int) -> None:
    chain.is_left[point] = False
    before, after = chain.before[point], chain.after[point]
    chain.after[before], chain.before[after] = after, before


def _turns_back(before: Floats, tip: Floats, after: Floats) -> Bools:
    """Tell where a polyline leaves a point in the direction from which it came."""
    same_way = ((before > tip) == (after > tip)) & ((before < tip) == (after < tip))
    away = (before != tip).any(axis=-1)
    return np.asarray(same_way.all(axis=-1) & away & (orient(before, tip, after) == 0))
