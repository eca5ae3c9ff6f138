"""Which way round closed polylines run, and which way they should where a drawing says "inside" by even and odd."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.predicates import orient

__all__ = ["bounds_nothing", "even_odd_directions", "sense"]

# Each of the n products and sums of the area is rounded by at most 2^-53 of its size.
_AREA_ERROR = 4 * 2.0**-53


def sense(points: Floats) -> int:
    """Return 1 if a closed polyline runs counter-clockwise, −1 if clockwise, 0 if its signed area is zero. Exact.

    Examples
    --------
    >>> sense(np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]))
    1
    """
    with np.errstate(under="ignore"):
        x, y = (points - points[0]).T
        products = x * np.roll(y, -1), y * np.roll(x, -1)
        area = float((products[0] - products[1]).sum())
        bound = _AREA_ERROR * (len(points) + 4) * float(np.abs(products).sum())
    # Differences from the first point are rounded too, by as much again, and tiny products to nothing.
    return (area > 0) - (area < 0) if abs(area) > 4 * bound + 1e-290 else _exact_sense(points)


def _exact_sense(points: Floats) -> int:
    places = [(Fraction(x), Fraction(y)) for x, y in points.tolist()]
    following = [*places[1:], *places[:1]]
    area = sum((a * d - b * c for (a, b), (c, d) in zip(places, following, strict=True)), Fraction(0))
    return (area > 0) - (area < 0)


def bounds_nothing(points: Floats) -> bool:
    """Tell whether a closed polyline runs back all the way that it comes, so that it winds round no place. Exact.

    Examples
    --------
    >>> bounds_nothing(np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 0.0)]))
    True
    >>> bounds_nothing(np.array([(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]))
    False
    """
    return sense(points) == 0 and len(_without_straight_points(points.tolist())) < 3


def _without_straight_points(points: list[list[float]]) -> list[list[float]]:
    """Leave out points on one line with their neighbours, at which the polyline goes straight on or turns back."""
    kept: list[list[float]] = []
    for point in points:
        kept.append(point)
        while len(kept) > 1 and _is_straight(kept, -3, -2, -1):
            del kept[-2]
    while len(kept) > 2:
        straight = next((at for at in (-1, 0) if _is_straight(kept, at - 1, at, at + 1)), None)
        if straight is None:
            break
        del kept[straight]
    return kept


def _is_straight(points: list[list[float]], before: int, at: int, after: int) -> bool:
    """Tell whether a point says nothing: it repeats the next one, or lies on one line with both neighbours."""
    if points[at] == points[after]:
        return True
    return len(points) > 2 and not orient(points[before], points[at], points[after])


def even_odd_directions(loops: Sequence[Floats]) -> list[int]:
    """Return the direction in which each loop has the painted side on its left, where every second ring is painted.

    Parameters
    ----------
    loops : sequence of (n, 2) arrays

    Returns
    -------
    list of int
        1 for a loop that lies inside an even number of others and −1 inside an odd one; 0 for one that meets others.

    Notes
    -----
    O(n log n) for finding loops that meet, and O(n) for each loop.

    Examples
    --------
    >>> square = np.array([(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)])
    >>> even_odd_directions([square, square / 3 + 1, square / 3 + (20.0, 0.0), square / 3 + (22.0, 1.0)])
    [1, -1, 0, 0]
    """
    if len(loops) == 1:
        return [1]
    start = np.concatenate(loops)
    end = np.concatenate([np.roll(points, -1, axis=0) for points in loops])
    owner = np.repeat(np.arange(len(loops)), [len(points) for points in loops])
    meeting = _loops_that_meet(start, end, owner)
    inside = [_is_inside(points[0], start[owner != loop], end[owner != loop]) for loop, points in enumerate(loops)]
    return [0 if loop in meeting else 1 - 2 * inside[loop] for loop in range(len(loops))]


def _is_inside(place: Floats, start: Floats, end: Floats) -> bool:
    """Tell whether a ray to the left crosses the edges an odd number of times; the place is on none of them."""
    across = (start[:, 1] > place[1]) != (end[:, 1] > place[1])
    low, high = start[across], end[across]
    upward = high[:, 1] > low[:, 1]
    return bool(((orient(low, high, place) < 0) == upward).sum() % 2)


def _loops_that_meet(start: Floats, end: Floats, owner: Ints) -> set[int]:
    """Return the loops that cross or touch another one."""
    import shapely

    boxes = shapely.box(*np.minimum(start, end).T, *np.maximum(start, end).T)
    first, second = shapely.STRtree(boxes).query(boxes)
    near = owner[first] < owner[second]
    first, second = first[near], second[near]
    meet = _edges_meet(start[first], end[first], start[second], end[second])
    return {*owner[first[meet]].tolist(), *owner[second[meet]].tolist()}


def _edges_meet(a: Floats, b: Floats, c: Floats, d: Floats) -> Bools:
    """Tell which edges a → b and c → d have a point in common, given that their boxes have."""
    apart: Bools = (orient(a, b, c) * orient(a, b, d) > 0) | (orient(c, d, a) * orient(c, d, b) > 0)
    return ~apart
