"""Check that lifted triangles are stacked and do not meet one another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from plyfold.certify.exact import Bools, Floats, Ints, as_faces, as_vertices, different, finite, pair_keys
from plyfold.certify.places import ExactPlaces, doubles, require_positive
from plyfold.errors import CertificateError

__all__ = ["check_layered", "from_lowest_corner", "require_gap", "require_layered", "require_no_overlap"]

# Pairs of triangles that are filtered by their boxes at a time, and that are looked at: what of these fits into caches.
_PAIRS_AT_A_TIME, _PAIRS_LOOKED_AT = 1 << 20, 1 << 12


def check_layered(
    vertices: npt.ArrayLike,
    faces: npt.ArrayLike,
    gap: float = 0.0,
    passing: npt.ArrayLike = (),
    *,
    touching: bool = False,
) -> None:
    """Check that lifted triangles are stacked and do not meet except in common vertices and edges.

    Parameters
    ----------
    vertices : array_like, shape (v, 3)
        Positions; vertices with exactly equal x and y lie over one another.
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, counter-clockwise seen from above.
    gap : float, optional
        Least vertical distance; ``lower + gap <= upper`` must hold in floating point.
    passing : array_like of int, shape (e, 4), optional
        Rows (a, b, c, d): the edge from a to b and the one from c to d lie over one another, and the sheets may pass
        through each other along them: the heights of a and c, and of b and d, are not compared.
    touching : bool, optional
        Whether parts of the surface may touch with their boundaries where, seen from above, they are beside one
        another: vertices and edges are compared only as far as triangles at them lie over one another.

    Raises
    ------
    CertificateError
        If the gap is negative or not finite, a row of ``passing`` does not name edges over one another, two other
        vertices over one place are equal in height or nearer than the gap, triangles or edges over one another are not
        in the same order at all their corners, or the flat triangles below overlap other than as exact copies. It names
        the place.

    Notes
    -----
    Why this proves it: seen from above, two triangles either coincide or meet in a common corner or edge or not at
    all. Over a common corner, different vertices have different heights; over a common edge, two different edges have
    the same order at both ends, hence all along; over a common triangle likewise. Where things over one another have a
    vertex in common, as those that wind round a cusp have, the order is strict at their other corners.

    With ``passing``, the order is open at the corners that it names and the same at all others, of which every triangle
    has one, and every edge that is not named. So two triangles over one another meet at most in a segment that cuts
    off named corners, and sheets pass through each other only in triangles at the named edges.

    With ``touching``, the surface may meet itself in vertices and edges of its boundary, as the outline does.

    The flat triangles are compared in pairs whose boxes meet, found by a sweep: about p^1.5 steps for p different
    flat triangles of similar size, p^2 if they are all long. 1e5 triangles, three deep, take about a second.

    Examples
    --------
    >>> import numpy as np
    >>> two_sheets = [(x, y, z) for z in (0, 1) for x, y in [(0, 0), (1, 0), (0, 1)]]
    >>> check_layered(two_sheets, [[0, 1, 2], [3, 4, 5]], gap=1.0)
    >>> two_sheets[3] = (0, 0, -1)
    >>> check_layered(two_sheets, [[0, 1, 2], [3, 4, 5]])
    Traceback (most recent call last):
    plyfold.errors.CertificateError: two triangles over one another change their order, at (0, 0), (1, 0), (0, 1)
    """
    require_gap(gap)
    positions = finite(vertices, 3)
    triangles = as_faces(faces, len(positions))
    places = doubles(positions[:, :2])
    require_positive(places, triangles)
    require_layered(positions, triangles, places, gap, passing, touching=touching)


def require_gap(gap: float) -> None:
    """Check that the gap is a distance."""
    if isinstance(gap, bool) or not isinstance(gap, int | float | np.number) or not 0 <= gap < np.inf:
        raise CertificateError(f"the gap must be a number from 0 on, not {gap!r}")


def require_layered(  # noqa: PLR0913 - a mesh at exact places, and what it shall be
    positions: Floats, triangles: Ints, exact: ExactPlaces, gap: float, passing: npt.ArrayLike, *, touching: bool
) -> None:
    """Check that positive triangles are stacked, both as they are given and with their vertices at exact places.

    Vertices at one place as they are given have one exact place.
    """
    places, first, below = different(positions[:, :2])
    height = positions[:, 2]
    flat = from_lowest_corner(below, triangles)
    edges = _different_edges(below, triangles)
    named = _named_pairs(passing, edges, below)
    stacks = _Stacks(below, height, places, pair_keys(edges[named].swapaxes(1, 2).reshape(-1, 2), len(positions)))
    stacks.require_gap(gap, flat if touching else np.arange(len(positions))[:, None])
    stacks.require_one_order("triangles", flat)
    if not touching:
        stacks.require_one_order("edges", edges, pair_keys(named, len(edges)))
    require_no_overlap(np.unique(below[flat], axis=0), exact.of(first))


@dataclass(frozen=True, eq=False)
class _Stacks:
    """The place below each vertex, its height, the places, and keys of the pairs of vertices that are not compared."""

    below: Ints
    height: Floats
    places: Floats
    open_pairs: Ints

    def require_gap(self, gap: float, things: Ints) -> None:
        """Check that the corners of things over the same places are at least so far apart."""
        first, second = self._compared(things)
        a, b = things[first], things[second]
        lower, upper = np.sort([self.height[a], self.height[b]], axis=0)
        near = ~((lower < upper) & (lower + gap <= upper)) & (a != b) & ~self._is_open(a, b)
        if near.any():
            raise CertificateError(
                f"vertices over one another are less than {gap:g} apart, or equal",
                where=self.places[self.below[a[near]]],
            )

    def require_one_order(self, name: str, things: Ints, named: Ints | None = None) -> None:
        """Check that things over the same places have strictly the same order at all corners that are compared.

        There must be such corners, unless the two things are named by the key of their numbers.
        """
        first, second = self._compared(things)
        a, b = things[first], things[second]
        compared = ~self._is_open(a, b)
        compared &= a != b
        rises, falls = (
            compared & sides for sides in (self.height[a] < self.height[b], self.height[a] > self.height[b])
        )
        same = (rises == compared).all(axis=1) | (falls == compared).all(axis=1)
        decided: Bools = np.asarray(compared.any(axis=1))
        if named is not None:
            decided |= np.isin(pair_keys(np.stack([first, second], axis=1), len(things)), named)
        if len(wrong := np.flatnonzero(~(same & decided))):
            what = "change their order" if decided[wrong[0]] else "have no order"
            raise CertificateError(f"two {name} over one another {what}", where=self.places[self.below[a[wrong[0]]]])

    def _is_open(self, a: Ints, b: Ints) -> Bools:
        if not len(self.open_pairs):
            return np.zeros(a.shape, dtype=bool)
        return np.isin(pair_keys(np.stack([a, b], axis=-1), len(self.below)), self.open_pairs)

    def _compared(self, things: Ints) -> tuple[Ints, Ints]:
        """Return numbers of things over the same places, the one with the lower first corner first.

        Neighbours are enough; but where an order is open, all pairs.
        """
        below = self.below[things]
        order = np.lexsort((self.height[things[:, 0]], *below.T[::-1]))
        new = np.concatenate([[True], (below[order[1:]] != below[order[:-1]]).any(axis=1)])
        if (~new[1:] & (things[order[1:], 0] == things[order[:-1], 0])).any():
            # Those with their first corner in common have the order of the other ones.
            order = np.lexsort((*self.height[things].T[::-1], *below.T[::-1]))
        stack = np.cumsum(new) - 1
        size = np.bincount(stack)
        followers = np.cumsum(size)[stack] - np.arange(len(order)) - 1
        has_open = np.unique(stack[np.flatnonzero(np.isin(things[order], self._open_vertices())) // things.shape[1]])
        followers = np.where(np.isin(stack, has_open), followers, np.minimum(followers, 1))
        first = np.repeat(np.arange(len(order)), followers)
        second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(followers) - followers, followers)
        return order[first], order[second]

    def _open_vertices(self) -> Ints:
        return np.unique(np.divmod(self.open_pairs, len(self.below)))


def _named_pairs(passing: npt.ArrayLike, edges: Ints, below: Ints) -> Ints:
    """Return the pairs of edges that may pass through each other, as numbers of edges."""
    rows = as_vertices(passing, len(below), "what may pass through each other").reshape(-1, 2, 2)
    backwards = below[rows[:, 0, 0]] > below[rows[:, 0, 1]]
    rows = np.where(backwards[:, None, None], rows[:, :, ::-1], rows)
    # The edges are sorted.
    key, wanted = (ends[..., 0] * len(below) + ends[..., 1] for ends in (edges, rows))
    pairs = np.minimum(np.searchsorted(key, wanted), len(key) - 1)
    over = (below[rows[:, 0]] == below[rows[:, 1]]).all(axis=1) & (rows[:, 0] != rows[:, 1]).all(axis=1)
    if len(bad := np.flatnonzero(~(over & (key[pairs] == wanted).all(axis=1)))):
        raise CertificateError(f"passing sheets, row {bad[0]}: these are not two edges over one another")
    return np.asarray(pairs)


def from_lowest_corner(below: Ints, triangles: Ints) -> Ints:
    """Return the triangles, each turned so that the place with the lowest number comes first."""
    first = np.argmin(below[triangles], axis=1)
    return np.take_along_axis(triangles, (first[:, None] + np.arange(3)) % 3, axis=1)


def _different_edges(below: Ints, triangles: Ints) -> Ints:
    """Return every edge once, as its two vertices, the one over the place with the lower number first."""
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    swapped = below[ends[:, 0]] > below[ends[:, 1]]
    ends[swapped] = ends[swapped, ::-1]
    return np.unique(ends, axis=0)


def require_no_overlap(triangles: Ints, places: ExactPlaces) -> None:
    """Check that flat triangles meet at most in common corners and edges, and as well if their corners are doubles."""
    corners, off = places.near[triangles], places.off[triangles].max(axis=1)
    low, high = corners.min(axis=1) - off[:, None], corners.max(axis=1) + off[:, None]
    as_given = doubles(places.near)
    for first, second in _pairs_with_common_boxes(low, high):
        doubt = _require_apart(triangles[first], triangles[second], places)
        again = doubt & ((off[first] > 0) | (off[second] > 0))
        _require_apart(triangles[first[again]], triangles[second[again]], as_given)


def _require_apart(a: Ints, b: Ints, places: ExactPlaces) -> Bools:
    """Check that the triangles of each pair meet at most in common corners and edges; return where doubles may not.

    Two convex polygons without common inner points are separated by the line of a side of one of them. If moreover
    neither has a corner in the other, except common ones, they have nothing in common but these and what is between.
    Where b is clear of a side of a, that is so at once.
    """
    clear, apart, entered, doubt = _separated(a, b, places)
    near = np.flatnonzero(~clear)
    _, apart_ba, entered_ba, doubt_ba = _separated(b[near], a[near], places)
    bad = ~(apart[near] | apart_ba) | entered[near] | entered_ba
    if bad.any():
        raise CertificateError("seen from above, triangles overlap in part", where=places.near[a[near[np.argmax(bad)]]])
    doubt[near] |= doubt_ba
    return doubt & ~clear


def _pairs_with_common_boxes(low: Floats, high: Floats) -> Iterator[tuple[Ints, Ints]]:
    """Yield all pairs of boxes that meet, in portions, by a sweep along the longer axis."""
    along = int(np.argmax(high.max(axis=0) - low.min(axis=0)))
    order = np.argsort(low[:, along])
    low, high = low[order], high[order]
    count = np.searchsorted(low[:, along], high[:, along], side="right") - np.arange(1, len(low) + 1)
    portion = np.cumsum(count) // _PAIRS_AT_A_TIME
    for rows in np.split(np.arange(len(low)), np.flatnonzero(np.diff(portion)) + 1):
        times = count[rows]
        first = np.repeat(rows, times)
        second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(times) - times, times)
        across = 1 - along
        meet = (low[first, across] <= high[second, across]) & (low[second, across] <= high[first, across])
        first, second = order[first[meet]], order[second[meet]]
        for start in range(0, len(first), _PAIRS_LOOKED_AT):
            some = slice(start, start + _PAIRS_LOOKED_AT)
            yield first[some], second[some]


def _separated(a: Ints, b: Ints, places: ExactPlaces) -> tuple[Bools, Bools, Bools, Bools]:
    """Tell whether a side of triangle a has all of b on its right, and whether a corner of b alone lies in a.

    Before that, whether b is clear of a side: all its corners but the side's own ends lie beyond the line, and as well
    if they are the doubles near by. Last, where anything may be otherwise for these.
    """
    start, end = a[:, :, None], np.roll(a, -1, axis=1)[:, :, None]
    corner = b[:, None, :]
    sign, doubt = np.zeros((len(a), 3, 3), dtype=np.int8), np.zeros((len(a), 3, 3), dtype=bool)
    is_other = (corner != start) & (corner != end)
    pair, side, which = np.nonzero(is_other)
    p, q, r = a[pair, side], end[pair, side, 0], b[pair, which]
    sign[pair, side, which], doubt[pair, side, which] = places.cross_sign_and_doubt(p, q, p, r)
    common = (corner == start).any(axis=1)
    clear: Bools = np.all(((sign < 0) & ~doubt) | ~is_other, axis=2)
    on_right: Bools = np.all(sign <= 0, axis=2)
    entered: Bools = np.all(sign >= 0, axis=1) & ~common
    doubtful: Bools = np.any(doubt, axis=2)
    return _any_side(clear), _any_side(on_right), _any_side(entered), _any_side(doubtful)


def _any_side(found: Bools) -> Bools:
    return np.asarray(found.any(axis=1))
