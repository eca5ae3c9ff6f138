"""Closed polylines: how often they turn, how often they wind round a place, and places inside."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from plyfold.arrays import Floats, Ints, Reals
from plyfold.predicates import orient
from plyfold.ragged import next_in_rows, previous_in_rows

__all__ = [
    "inner_points",
    "polygon_turning_number",
    "polygon_turning_numbers",
    "signed_areas",
    "total_winding",
    "winding_number",
]


def polygon_turning_number(points: Reals) -> int:
    """Return the turning number of a closed polyline from its exterior angles, exactly.

    It counts how often the direction of the edges passes through that of the positive x axis: only signs of
    coordinates and of turns are needed, so nothing is rounded.

    Examples
    --------
    >>> polygon_turning_number(np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]))
    1
    """
    return polygon_turning_numbers(points, np.array([0, len(points)]))[0]


def polygon_turning_numbers(points: Reals, first: Ints) -> tuple[int, ...]:
    """Return the turning numbers of several closed polylines; polyline l has points ``first[l]:first[l + 1]``."""
    following, previous = next_in_rows(first), previous_in_rows(first)
    x, y = points.T
    next_x, next_y = x.take(following), y.take(following)
    upper = (next_y > y) | ((next_y == y) & (next_x > x))
    # The direction passes that of the x axis, or the opposite one, at few points.
    place = np.flatnonzero(upper != upper.take(previous))
    turn = orient(points[previous[place]], points[place], points[following[place]])
    passed = np.where(upper[place], turn > 0, -(turn < 0).astype(np.int64))
    since_start = np.append(0, passed.cumsum())[np.searchsorted(place, first)]
    return tuple((since_start[1:] - since_start[:-1]).tolist())


def signed_areas(coordinates: Floats, start: Ints) -> Floats:
    """Return the signed area of each loop, measured from its first point."""
    x, y = (coordinates - np.repeat(coordinates[start[:-1]], np.diff(start), axis=0)).T
    following = next_in_rows(start)
    return np.asarray(np.add.reduceat(x * y[following] - y * x[following], start[:-1]) / 2)


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
