"""How thin a solid really is: the shortest way through it from its upper to its lower side.

The thickness of a solid is vertical, so where it is steep it is thinner across. Its *wall* is the least distance of a
point of the upper side from one of the lower side, such that the straight line between them, seen from above, stays on
the cloth: neither the air between two sheets nor a slit in the cloth is a wall. The pair is found among all pairs of
triangles, so it is as exact as floating point.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.graphs import ways_from
from plyfold.halfedges import ends_of, neighbours_of

if TYPE_CHECKING:
    from plyfold.surface.thicken import Solid

__all__ = ["Wall", "thinner_places", "thinnest_wall"]

# Lines of sight begin and end so much inside of their triangles, so that they pass no vertices but by chance.
_INSIDE = 1e-6
# So many lines of sight are followed at a time.
_AT_ONCE = 4096


@dataclass(frozen=True, eq=False)
class Wall:
    """The thinnest place of a solid.

    Parameters
    ----------
    length : float
        In units of the drawing.
    ends : (2, 3) float
        The points of the upper and of the lower side.
    """

    length: float
    ends: Floats

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def where(self) -> tuple[float, float]:
        """The place between them, seen from above."""
        x, y = (self.ends[0, :2] + self.ends[1, :2]) / 2
        return float(x), float(y)


@dataclass(frozen=True, eq=False)
class _Sides:
    """The triangles of both sides that count: their numbers in the cloth, corners, (t, 3, 3), and neighbours."""

    number: Ints
    upper: Floats
    lower: Floats
    neighbours: Ints


def thinnest_wall(solid: Solid) -> Wall | None:
    """Return the thinnest place of a solid, away from its tips.

    Parameters
    ----------
    solid : Solid

    Returns
    -------
    Wall or None
        Triangles count whose corners are all, along the edges of the mesh seen from above, at least half as far from
        every tip as the solid is thick there: a round body comes to nothing along its rim. None if there are none, as
        in a body that is higher than wide. Cost: O(n log n) for walls not much longer than edges.
    """
    sides = _sides_of(solid)
    if not len(sides.number):
        return None
    own = np.arange(len(sides.number))
    above, below, distance = _features(sides, own, own)
    # A point sees the one right below it.
    reach = float(distance.min())
    at = np.unravel_index(np.argmin(distance), distance.shape)
    found = next(_seen(sides, reach), (own, reach, above[at][None], below[at][None]))
    return Wall(float(np.min(found[1])), np.stack([found[2][0], found[3][0]]))


def thinner_places(solid: Solid, wall: float) -> tuple[Ints, Floats]:
    """Return triangles of the surface at whose upper or lower ends the wall is less than asked for, and how long it is.

    A triangle may occur several times. Cost: as of :func:`thinnest_wall`, for the longer wall.
    """
    sides = _sides_of(solid)
    found = [(number, length) for number, length, _, _ in _seen(sides, wall)]
    if not found:
        return np.empty(0, dtype=np.int64), np.empty(0)
    triangles, lengths = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return sides.number[triangles].ravel(), np.repeat(lengths, 2)


def _sides_of(solid: Solid) -> _Sides:
    faces = solid.surface.faces
    counted = np.flatnonzero(_away_from_tips(solid)[faces].all(axis=1))
    number = np.full(len(faces) + 1, -1)
    number[counted] = np.arange(len(counted))
    upper, lower = solid.vertices[faces[counted]], solid.vertices[solid.below[faces[counted]]]
    return _Sides(counted, upper, lower, number[neighbours_of(faces)[counted]])


def _away_from_tips(solid: Solid) -> Bools:
    """Tell which vertices are half as far from all tips as the solid is thick there."""
    tips, faces = solid.tips, solid.surface.faces
    if not len(tips):
        return np.ones(len(solid.thickness), dtype=bool)
    places = solid.surface.vertices[:, :2]
    start, end = ends_of(faces)
    length = np.hypot(*(places[end] - places[start]).T)
    way = ways_from(tips, len(places), np.stack([start, end], axis=1), length, solid.height)
    return np.asarray((way >= solid.thickness / 2) & (solid.thickness > 0))


# ---- pairs of triangles ----------------------------------------------------------------------------------------------


def _upper_ends(sides: _Sides, reach: float) -> Ints:
    """Return the upper triangles from which the lower side may be nearer than some length.

    A point of the lower side within sight is as much lower than the one right below as the slope between them allows;
    so it is nearer only where somewhere on the way the cosine of the slope, times the thickness, is less.
    """
    thickness = (sides.upper - sides.lower)[..., 2].min(axis=1)
    cosine = _normals(sides.lower)[:, 2]
    thin = thickness * cosine.min() < reach
    steep = np.flatnonzero(cosine * thickness[thin].min(initial=np.inf) < reach)
    around = np.unique(_within_reach(sides, steep, reach)[1])
    return np.asarray(around[thin[around]])


def _near_pairs(sides: _Sides, first: Ints, reach: float) -> tuple[Ints, Ints]:
    """Return the pairs of an upper triangle, one of the given ones, and a lower one that may be nearer than that."""
    a, b = _within_reach(sides, first, reach)
    close = _least_distance(sides, a, b) < reach
    return a[close], b[close]


def _within_reach(sides: _Sides, first: Ints, reach: float) -> tuple[Ints, Ints]:
    """Return pairs of the given triangles and those that are so near, seen from above, and joined by others that are.

    All triangles under a line of sight of this length are so near to the one where it begins. In steps from each to its
    neighbours: those of one step are beside some of the step before, so known ones are among the last two.
    """
    count = len(sides.upper)
    low, high = (find(sides.upper[..., :2], axis=1) for find in (np.min, np.max))
    last = np.empty(0, dtype=np.int64)
    fresh = first * count + first
    found = [fresh]
    while len(fresh):
        a, b = np.repeat(fresh // count, 3), sides.neighbours[fresh % count].ravel()
        a, b = a[b >= 0], b[b >= 0]
        apart = np.maximum(np.maximum(low[a] - high[b], low[b] - high[a]), 0.0)
        near = np.hypot(*apart.T) < reach
        beside = np.sort(a[near] * count + b[near])
        beside = beside[np.append(True, np.diff(beside) > 0)[: len(beside)]]
        last, fresh = fresh, beside[~_are_among(beside, last) & ~_are_among(beside, fresh)]
        found.append(fresh)
    a, b = np.divmod(np.concatenate(found), count)
    return a, b


def _are_among(numbers: Ints, known: Ints) -> Bools:
    """Tell which numbers are among others; both are in ascending order."""
    if not len(known):
        return np.zeros(len(numbers), dtype=bool)
    return np.asarray(known[np.minimum(np.searchsorted(known, numbers), len(known) - 1)] == numbers)


def _least_distance(sides: _Sides, a: Ints, b: Ints) -> Floats:
    """Return a bound for the distances of pairs: how far apart they are along the normal of either triangle."""
    bound = np.zeros(len(a))
    for normals in (_normals(sides.upper)[a], _normals(sides.lower)[b]):
        above = np.einsum("nij,nj->ni", sides.upper[a], normals).min(axis=1)
        below = np.einsum("nij,nj->ni", sides.lower[b], normals).max(axis=1)
        bound = np.maximum(bound, above - below)
    return bound


def _normals(corners: Floats) -> Floats:
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.asarray(normal / np.linalg.norm(normal, axis=1, keepdims=True))


# ---- the nearest points of two triangles -----------------------------------------------------------------------------


def _features(sides: _Sides, a: Ints, b: Ints) -> tuple[Floats, Floats, Floats]:
    """Return points of the upper triangles a and of the lower ones b that may be their nearest: (15, n, 3) each.

    For each corner the point of the other triangle's plane right beside it, and for two sides their nearest points. And
    their distances, (15, n), infinite where that point is outside of the triangle.
    """
    upper, lower = sides.upper[a], sides.lower[b]
    pairs = [(upper[:, i], *_foot(lower, upper[:, i])) for i in range(3)]
    pairs += [(foot, lower[:, i], inside) for i in range(3) for foot, inside in [_foot(upper, lower[:, i])]]
    for i, j in product(range(3), repeat=2):
        p, q = _nearest_on_sides(upper[:, i], upper[:, i - 2], lower[:, j], lower[:, j - 2])
        pairs.append((p, q, np.ones(len(p), dtype=bool)))
    above, below, inside = (np.stack(parts) for parts in zip(*pairs, strict=True))
    return above, below, np.where(inside, np.linalg.norm(above - below, axis=2), np.inf)


def _foot(corners: Floats, point: Floats) -> tuple[Floats, Bools]:
    """Return the point of each triangle's plane nearest to a point, and whether it is in the triangle."""
    normal = _normals(corners)
    foot = point - np.einsum("ni,ni->n", point - corners[:, 0], normal)[:, None] * normal
    sides = np.roll(corners, -1, axis=1) - corners
    turns = np.einsum("nij,nj->ni", np.cross(sides, foot[:, None] - corners), normal)
    return foot, np.asarray((turns >= 0).all(axis=1))


def _nearest_on_sides(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Floats, Floats]:
    """Return the nearest points of the segments from a to b and from c to d."""
    u, v, w = b - a, d - c, a - c
    uu, uv, vv = (np.einsum("ni,ni->n", x, y) for x, y in ((u, u), (u, v), (v, v)))
    uw, vw = (np.einsum("ni,ni->n", x, w) for x in (u, v))
    size = uu * vv - uv * uv
    # Parallel segments may begin anywhere.
    s = np.divide(uv * vw - vv * uw, size, out=np.zeros(len(size)), where=size > 0).clip(0, 1)
    t = ((uv * s + vw) / vv).clip(0, 1)
    s = ((uv * t - uw) / uu).clip(0, 1)
    return a + s[:, None] * u, c + t[:, None] * v


# ---- lines of sight --------------------------------------------------------------------------------------------------


def _seen(sides: _Sides, reach: float) -> Iterator[tuple[Ints, Floats, Floats, Floats]]:
    """Yield pairs of points nearer than that which see each other along the cloth, a portion at a time, nearest first.

    Their triangles, (n, 2), their distances, and the points of the upper and of the lower side.
    """
    a, b = _near_pairs(sides, _upper_ends(sides, reach), reach)
    above, below, distance = _features(sides, a, b)
    order = np.flatnonzero(distance < reach)
    order = order[np.argsort(distance.ravel()[order], kind="stable")]
    pairs = np.tile(np.stack([a, b], axis=1), (15, 1))
    above, below = above.reshape(-1, 3), below.reshape(-1, 3)
    for start in range(0, len(order), _AT_ONCE):
        some = order[start : start + _AT_ONCE]
        some = some[_is_seen(sides, pairs[some], above[some, :2], below[some, :2])]
        if len(some):
            yield pairs[some], distance.ravel()[some], above[some], below[some]


def _is_seen(sides: _Sides, pairs: Ints, p: Floats, q: Floats) -> Bools:
    """Tell whether the line from p in one triangle to q in the other, seen from above, stays on the cloth."""
    flat, (a, b) = sides.upper[..., :2], pairs.T
    p = p + _INSIDE * (flat[a].mean(axis=1) - p)
    q = q + _INSIDE * (flat[b].mean(axis=1) - q)
    at, came_from = a.copy(), np.full(len(a), -1)
    going = np.flatnonzero(at != b)
    while len(going):
        corners = flat[at[going]]
        after = corners[:, [1, 2, 0]]
        ahead = _turn(corners, after, q[going, None]) < 0
        # The line leaves through the side that has its ends on both sides of it.
        left, right = (_turn(p[going, None], q[going, None], ends) for ends in (after, corners))
        through = ahead & (left >= 0) & (right <= 0)
        side = np.argmax(through, axis=1)
        beyond = sides.neighbours[at[going], side]
        lost = ~through.any(axis=1) | (beyond < 0) | (beyond == came_from[going])
        came_from[going], at[going] = at[going], np.where(lost, -1, beyond)
        going = going[~lost & (at[going] != b[going])]
    return np.asarray(at == b)


def _turn(a: Floats, b: Floats, c: Floats) -> Floats:
    u, v = b - a, c - a
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])
