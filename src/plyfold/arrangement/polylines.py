"""Closed polylines: how often they turn, how often they wind round a place, and places inside."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from plyfold.arrays import Floats, Ints, Numbers
from plyfold.predicates import orient

__all__ = ["inner_points", "polygon_turning_number", "polygon_turning_numbers", "total_winding", "winding_number"]


def polygon_turning_number(points: Numbers) -> int:
    """Return the turning number of a closed polyline from its exterior angles, exactly.

    It counts how often the direction of the edges passes through that of the positive x axis: only signs of
    coordinates and of turns are needed, so nothing is rounded.

    Examples
    --------
    >>> polygon_turning_number(np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]))
    1
    """
    return polygon_turning_numbers(points, np.array([0, len(points)]))[0]


def polygon_turning_numbers(points: Numbers, first: Ints) -> tuple[int, ...]:
    """Return the turning numbers of several closed polylines; polyline l has points ``first[l]:first[l + 1]``."""
    following = np.arange(1, len(points) + 1)
    following[first[1:] - 1] = first[:-1]
    previous = np.empty_like(following)
    previous[following] = np.arange(len(points))
    turn = orient(points[previous], points, points[following])
    step = points[following] - points
    upper = (step[:, 1] > 0) | ((step[:, 1] == 0) & (step[:, 0] > 0))
    upper_before = upper[previous]
    passed = ((turn > 0) & ~upper_before & upper).astype(np.int64) - ((turn < 0) & upper_before & ~upper)
    return tuple(np.add.reduceat(passed, first[:-1]).tolist())


def winding_number(points: Floats, place: tuple[float, float]) -> int | None:
    """Return how often a closed polyline winds around a place, exactly; None if the place lies on it.

    Parameters
    ----------
    points : (n, 2) float
        Vertices of the polyline.
    place : (x, y)

    Examples
    --------
    >>> winding_number(np.array([(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)]), (1, 1))
    1
    """
    following = np.roll(points, -1, axis=0)
    low, high = np.minimum(points, following), np.maximum(points, following)
    side = orient(points, following, np.asarray(place, dtype=np.float64))
    if ((side == 0) & (low <= place).all(axis=1) & (place <= high).all(axis=1)).any():
        return None
    below, below_next = points[:, 1] <= place[1], following[:, 1] <= place[1]
    return int((below & ~below_next & (side > 0)).sum()) - int((~below & below_next & (side < 0)).sum())


def total_winding(loops: Sequence[Floats], place: tuple[float, float]) -> int | None:
    """Return how often some polylines wind around a place in all, exactly; None if it lies on one of them."""
    numbers = [winding_number(points, place) for points in loops]
    return None if None in numbers else sum(number for number in numbers if number is not None)


def inner_points(outlines: Sequence[Floats]) -> Iterator[tuple[float, float]]:
    """Yield places that should lie between the outlines of a cell, the most central first."""
    import shapely

    shell, *holes = sorted(outlines, key=lambda outline: -np.ptp(outline[:, 0]))
    point = shapely.point_on_surface(shapely.Polygon(shell, holes))
    yield float(point.x), float(point.y)
    for outline in outlines:
        for corner in range(len(outline)):
            ear = outline[[corner - 1, corner, (corner + 1) % len(outline)]]
            x, y = ear[1] + (ear - ear[1]).sum(axis=0) / 3
            yield float(x), float(y)
