"""How thin a solid really is: the shortest way through it from its upper to its lower side.

The thickness of a solid is vertical, so where it is steep it is thinner across. Its *wall* is the least distance of a
point of the upper side from one of the lower side, such that the straight line between them, seen from above, stays on
the cloth: neither the air between two sheets nor a slit in the cloth is a wall. The pair is found among all pairs of
triangles, so it is as exact as floating point.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.graphs import ways_from
from plyfold.halfedges import ends_of, neighbours_of

if TYPE_CHECKING:
    from plyfold.surface.thicken import Solid

__all__ = ["Wall", "thinnest_wall"]

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
    """The triangles of both sides that count, over the same triangles of the cloth: corners, (t, 3, 3) each."""

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
    faces = solid.surface.faces
    counted = np.flatnonzero(_away_from_tips(solid)[faces].all(axis=1))
    if not len(counted):
        return None
    number = np.full(len(faces) + 1, -1)
    number[counted] = np.arange(len(counted))
    upper, lower = solid.vertices[faces[counted]], solid.vertices[solid.below[faces[counted]]]
    sides = _Sides(upper, lower, number[neighbours_of(faces)[counted]])
    own = np.arange(len(counted))
    nearest = _features(sides, own, own)[2].min()
    pairs = _near_pairs(sides, nearest)
    return _first_seen(sides, *pairs)


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


def _near_pairs(sides: _Sides, reach: float) -> tuple[Ints, Ints]:
    """Return the pairs of an upper and a lower triangle that may be as near as that, and are joined by others that are.

    All triangles under a line of sight of this length come as near to its upper end, seen from above.
    """
    first = second = np.arange(len(sides.upper))
    known = first * len(first) + second
    fresh = known
    low, high = (find(sides.upper[..., :2], axis=1) for find in (np.min, np.max))
    while len(fresh):
        a, b = np.divmod(fresh, len(first))
        beside = sides.neighbours[b].ravel()
        a = np.repeat(a, 3)[beside >= 0]
        b = beside[beside >= 0]
        apart = np.maximum(np.maximum(low[a] - high[b], low[b] - high[a]), 0.0)
        near = np.hypot(*apart.T) <= reach
        fresh = np.setdiff1d(a[near] * len(first) + b[near], known)
        known = np.concatenate([known, fresh])
    a, b = np.divmod(np.sort(known), len(first))
    close = _least_distance(sides, a, b) <= reach
    return a[close], b[close]


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


def _first_seen(sides: _Sides, a: Ints, b: Ints) -> Wall:
    """Return the nearest pair of points that see each other along the cloth."""
    above, below, distance = _features(sides, a, b)
    rows = [np.flatnonzero(np.isfinite(distance)), distance.ravel()]
    order = rows[0][np.argsort(rows[1][rows[0]], kind="stable")]
    above, below, pair = above.reshape(-1, 3), below.reshape(-1, 3), np.tile(np.arange(len(a)), 15)
    for start in range(0, len(order), _AT_ONCE):
        some = order[start : start + _AT_ONCE]
        seen = np.flatnonzero(_is_seen(sides, a[pair[some]], b[pair[some]], above[some, :2], below[some, :2]))
        if len(seen):
            best = some[seen[0]]
            return Wall(float(distance.ravel()[best]), np.stack([above[best], below[best]]))
    raise AssertionError("a point is seen from the one right below it")


def _is_seen(sides: _Sides, a: Ints, b: Ints, p: Floats, q: Floats) -> Bools:
    """Tell whether the line from p in triangle a to q in triangle b, seen from above, stays on the cloth."""
    flat = sides.upper[..., :2]
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
