"""The contraction itself: loop after loop shrinks through its own disk, to the crossing where it is cut off.

In the round disk that a loop's disk is unwound to, circles that touch the boundary at the place of the cut shrink to
it. Their images in the plane are the loop on its way: each place of the disk is passed once, so exactly its area is
swept. On the triangles of the disk the size of the circle is taken as linear.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from heapq import heapify, heappop, heappush
from itertools import pairwise, repeat
from math import inf

import numpy as np

from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.disk.round_map import cross
from plyfold.disk.unwrap import map_disk
from plyfold.errors import InputError
from plyfold.homotopy.homotopy import Homotopy
from plyfold.outline.curve import Curve

__all__ = ["Contraction", "Moment", "Shrinking", "contraction_of"]


@dataclass(frozen=True, eq=False)
class Shrinking:
    """The disk that one loop contracts through.

    Parameters
    ----------
    points : (n, 2) float
        Vertices in the plane; the first is where the loop shrinks to.
    faces : (m, 3) int
        Counter-clockwise triangles.
    size : (n,) float
        The size of the circle through each vertex: 1 on the boundary, 0 at the first.
    beside : (2,) int
        The two vertices beside the first one on the boundary.
    """

    points: Floats
    faces: Ints
    size: Floats
    beside: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def curve_at(self, size: float) -> Floats:
        """Return the loop when the circle has some size, shape (s, 2, 2): a piece for each triangle that it crosses.

        The last two lead along the boundary to where it shrinks to.
        """
        above = self.size[self.faces] >= size
        lone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), above.argmin(axis=1))
        crossed = np.flatnonzero(above.any(axis=1) & ~above.all(axis=1))
        corner = (lone[crossed, None] + np.arange(3)) % 3
        tip, *others = np.take_along_axis(self.faces[crossed], corner, axis=1).T
        arc = np.stack([self._between(tip, other, size) for other in others], axis=1)
        home = self.points[[0, 0]]
        return np.concatenate([arc, np.stack([home, home + size * (self.points[self.beside] - home)], axis=1)])

    def _between(self, one: Ints, other: Ints, size: float) -> Floats:
        share = (size - self.size[one]) / (self.size[other] - self.size[one])
        return np.asarray(self.points[one] + share[:, None] * (self.points[other] - self.points[one]))

    def rest_at(self, size: float) -> list[Floats]:
        """Return what has not been swept yet as polygons: whole triangles, and parts of others."""
        below = (self.size[self.faces] <= size).sum(axis=1)
        return [*self.points[self.faces[below == 3]], *map(self._part, self.faces[below % 3 > 0], repeat(size))]

    def _part(self, triangle: Ints, size: float) -> Floats:
        """Return the part of a triangle in which circles are smaller."""
        corners = []
        for one, other in zip(triangle, np.roll(triangle, -1), strict=True):
            if self.size[one] <= size:
                corners.append(self.points[one])
            if (self.size[one] <= size) != (self.size[other] <= size):
                share = (size - self.size[one]) / (self.size[other] - self.size[one])
                corners.append(self.points[one] + share * (self.points[other] - self.points[one]))
        return np.array(corners)

    def swept_at(self, size: float) -> float:
        """Return the area that has been swept when the circle has some size; that of the whole disk at 0."""
        low, middle, high = np.sort(self.size[self.faces], axis=1).T
        begun = _ratio((size - low) ** 2, (middle - low) * (high - low))
        ended = 1 - _ratio((high - size) ** 2, (high - low) * (high - middle))
        left = np.select([size < low, size >= high, size < middle], [0.0, 1.0, begun], ended)
        return float((self._areas * (1 - (left if size else 0))).sum())

    @cached_property
    def _areas(self) -> Floats:
        one, other = (self.points[self.faces[:, [corner]]][:, 0] - self.points[self.faces[:, 0]] for corner in (1, 2))
        return np.asarray(cross(one, other) / 2)


def _ratio(part: Floats, whole: Floats) -> Floats:
    """Return quotients, and 0 of nothing: of triangles where they are not asked for."""
    return np.asarray(part / np.where(whole > 0, whole, 1))


@dataclass(frozen=True)
class Moment:
    """How far a contraction is: loops before ``loop`` in the order have gone, and its circle has a size."""

    loop: int
    size: float


@dataclass(frozen=True, eq=False)
class Contraction:
    """A least homotopy as a motion: the loops contract one after the other, each after those that are cut off it.

    Parameters
    ----------
    homotopy : Homotopy
    order : tuple of int
        The loops in the order in which they contract.
    shrinking : tuple of Shrinking
        The disk of each, in that order.
    """

    homotopy: Homotopy
    order: tuple[int, ...]
    shrinking: tuple[Shrinking, ...]

    @cached_property
    def starts(self) -> Floats:
        """When each loop begins, and last the end, 1: each takes as long as the root of its area says."""
        areas = [shrinking.swept_at(0) for shrinking in self.shrinking]
        return np.append(0, np.cumsum(np.sqrt(areas)) / np.sqrt(areas).sum())

    def moment(self, time: float) -> Moment:
        """Return what moves at a time from 0 to 1."""
        if not 0 <= time <= 1:
            raise InputError(f"the time must be from 0 to 1, not {time!r}")
        number = min(int(np.searchsorted(self.starts, time, side="right")) - 1, len(self.order) - 1)
        start, end = self.starts[[number, number + 1]]
        share = min((time - start) / (end - start), 1.0)
        return Moment(number, float(1 - share * share * (3 - 2 * share)))

    def swept(self, time: float) -> float:
        """Return the area that has been swept up to a time from 0 to 1; all of it at 1."""
        now = self.moment(time)
        before = sum(shrinking.swept_at(0) for shrinking in self.shrinking[: now.loop])
        return before + self.shrinking[now.loop].swept_at(now.size)


def contraction_of(homotopy: Homotopy, triangles: int = 600) -> Contraction:
    """Return the motion of a least homotopy.

    Parameters
    ----------
    homotopy : Homotopy
        Of a drawing. Loops without area, of points that have only begun to move apart, are left out.
    triangles : int, optional
        Roughly how many triangles the disk of each loop has.

    Raises
    ------
    InputError
        If only the code of the curve is known.

    Examples
    --------
    >>> from plyfold import least_homotopy
    >>> contraction = contraction_of(least_homotopy([(0, 0), (2, 2), (2, 0), (0, 2)]), triangles=50)
    >>> contraction.order, round(contraction.swept(0.5), 9), round(contraction.swept(1.0), 9)
    ((1, 0), 1.0, 2.0)
    """
    if homotopy.arrangement.outline is None:
        raise InputError("a contraction needs a drawing, and this is a Gauss code alone")
    curves = {number: loop.curve for number, loop in reversed(list(enumerate(homotopy.loops)))}
    drawn = {number: curve for number, curve in curves.items() if isinstance(curve, Curve)}
    return Contraction(homotopy, tuple(drawn), tuple(_shrinking(curve, triangles) for curve in drawn.values()))


def _shrinking(curve: Curve, triangles: int) -> Shrinking:
    """Return the disk of a loop, with circles that shrink to its first point."""
    points, faces, uv = map_disk(curve, triangles=triangles)
    rim = _sides_once(faces)
    on_rim = np.zeros(len(points), dtype=bool)
    on_rim[rim] = True
    faces, middles = _with_middles(faces, {(one, other) for one, other in rim.tolist()}, on_rim)
    points, uv = (np.concatenate([each, each[middles].mean(axis=1)]) for each in (points, uv))
    x, y = (2 * uv - 1).T
    inside = np.append(~on_rim, np.ones(len(middles), dtype=bool))
    size = np.ones(len(points))
    size[inside] = (((x - 1) ** 2 + y**2)[inside]) / (2 * (1 - x[inside]))
    size[0] = 0
    size = 1 - _without_pits(1 - _without_pits(size, faces, [0]), faces, np.flatnonzero(size == 1).tolist())
    return Shrinking(points, faces, size, rim[rim[:, 0] == 0, 1])


def _without_pits(heights: Floats, faces: Ints, lowest: list[int]) -> Floats:
    """Return heights with pits filled: from every vertex a way that never climbs leads to one of the lowest.

    On a coarse mesh circles may seem to shrink to other vertices, too.
    """
    ends = np.concatenate([faces, faces[:, ::-1]]).T
    around: list[list[int]] = [[] for _ in heights]
    for one, other in zip(ends.ravel().tolist(), np.roll(ends, -1, axis=0).ravel().tolist(), strict=True):
        around[one].append(other)
    given, filled = heights.tolist(), [inf] * len(heights)
    waiting = [(given[vertex], vertex) for vertex in lowest]
    heapify(waiting)
    while waiting:
        height, vertex = heappop(waiting)
        if filled[vertex] == inf:
            filled[vertex] = height
            for other in around[vertex]:
                if filled[other] == inf:
                    heappush(waiting, (max(height, given[other]), other))
    return np.array(filled)


def _sides_once(faces: Ints) -> Ints:
    """Return the sides of triangles that belong to one alone: the boundary."""
    sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    ends, counts = np.unique(sides, axis=0, return_counts=True)
    return np.asarray(ends[counts == 1])


def _with_middles(faces: Ints, rim: set[tuple[int, int]], on_rim: Bools) -> tuple[Ints, Ints]:
    """Split the sides that lead through the disk from boundary to boundary; return triangles, and the ends of these.

    So that no triangle has all corners on the boundary, where nothing would shrink.
    """
    is_on_rim, size = on_rim.tolist(), len(on_rim)
    middle: dict[tuple[int, int], int] = {}
    split = []
    for triangle in faces.tolist():
        corners = []
        for one, other in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            corners.append(one)
            side = (min(one, other), max(one, other))
            if is_on_rim[one] and is_on_rim[other] and side not in rim:
                corners.append(middle.setdefault(side, size + len(middle)))
        first = next((place for place, corner in enumerate(corners) if corner >= size), 0)
        tip, *rest = corners[first:] + corners[:first]
        split += [(tip, *pair) for pair in pairwise(rest)]
    return np.array(split), np.array([*middle], dtype=np.int64).reshape(-1, 2)
