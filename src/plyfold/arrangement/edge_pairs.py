"""Which edges of a closed polyline come near each other: the candidates for its crossings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints

__all__ = ["near_pairs"]

Bytes: TypeAlias = npt.NDArray[np.uint8]
_Number = TypeVar("_Number", np.float64, np.uint8)

# Consecutive edges are looked at in groups of this size, unless a group meets more others than this on average.
_GROUP = 8
_CROWD = 24
# How many boxes are looked up at a time, and how many pairs of groups are taken apart at a time.
_LOOKUPS = 2**8
_PORTION = 2**14


@dataclass(frozen=True, eq=False)
class _Groups:
    """Bounding boxes of consecutive edges and of groups of them.

    ``low`` holds x and y of the lower corner of each box and −x, −y of the upper one, ``high`` the opposite corners in
    the same way: two boxes meet if no entry of one's ``low`` exceeds that of the other's ``high``.

    Parameters
    ----------
    edge_low : (4, size, groups) float
    edge_high : (4, edges) float
        The last group is filled up with boxes that meet nothing.
    low, high : (4, groups) float
    heading : (groups,) uint8
        A bit for each of eight directions, those of the axes and the diagonals, in which all edges of the group get
        ahead. Consecutive groups with a bit in common make one strand that runs steadily in that direction.
    """

    edge_low: Floats
    edge_high: Floats
    low: Floats
    high: Floats
    heading: Bytes


def near_pairs(points: Floats) -> Iterator[tuple[Ints, Ints]]:
    """Yield, portion by portion, the pairs of edges that may cross or touch.

    Parameters
    ----------
    points : (n, 2) float
        Vertices of a closed polyline; edge i runs from point i to point i + 1.

    Yields
    ------
    first, second : (m,) int
        Edges, first < second, no neighbours. Every pair whose bounding boxes meet comes once, but for edges of a
        strand that runs steadily in some direction and so cannot meet itself. At least one portion comes.

    Notes
    -----
    O(n log n) plus the number of pairs. Memory for a portion does not grow with their number.
    """
    groups = _grouped(points, _GROUP)
    pairs = _few_pairs(groups)
    if pairs is None:  # long edges: a box round several of them holds too much
        groups = _grouped(points, 1)
        portions = _group_pairs(groups)
    else:
        portions = _portions(pairs)
    for first, second in portions:
        yield _edge_pairs(groups, first, second, len(points))


def _grouped(points: Floats, size: int) -> _Groups:
    x, y = points.T
    # Rounding the sums keeps their order, or makes them equal.
    start = np.array([x, y, x + y, x - y])
    end = np.concatenate([start[:, 1:], start[:, :1]], axis=1)
    ahead = np.packbits(np.concatenate([start < end, start > end]), axis=0)
    heading = np.bitwise_and.reduce(_in_groups(ahead, size, 255)[0], axis=0)
    lower, upper = np.minimum(start[:2], end[:2]), np.maximum(start[:2], end[:2])
    edge_high = np.concatenate([upper, -lower])
    low = _in_groups(np.concatenate([lower, -upper]), size, np.inf)
    high = _in_groups(edge_high, size, -np.inf)
    return _Groups(low, edge_high, low.min(axis=1), high.max(axis=1), heading)


def _in_groups(rows: npt.NDArray[_Number], size: int, filling: float) -> npt.NDArray[_Number]:
    """Cut rows (r, n) into groups (r, size, groups), the last one filled up."""
    height, n = rows.shape
    filled = np.full((height, -(-n // size) * size), filling, dtype=rows.dtype)
    filled[:, :n] = rows
    return np.ascontiguousarray(filled.reshape(height, -1, size).transpose(0, 2, 1))


def _few_pairs(groups: _Groups) -> tuple[Ints, Ints] | None:
    """Return the pairs of groups that meet, or None if there are too many."""
    found, total = [], 0
    for first, second in _group_pairs(groups):
        found.append((first, second))
        total += len(first)
        if total > _CROWD * len(groups.heading):
            return None
    firsts, seconds = zip(*found, strict=True)
    return np.concatenate(firsts), np.concatenate(seconds)


def _group_pairs(groups: _Groups) -> Iterator[tuple[Ints, Ints]]:
    """Yield the pairs i ≤ j of groups whose boxes meet, those left out whose edges run steadily in one direction."""
    from shapely import STRtree, linestrings

    # Diagonals have the same bounding boxes, and are made faster.
    boxes = linestrings(np.array([groups.low[:2], groups.high[:2]]).transpose(2, 0, 1))
    tree = STRtree(boxes)
    for start in range(0, len(boxes), _LOOKUPS):
        first, second = tree.query(boxes[start : start + _LOOKUPS])
        first += start
        gap = second - first
        unsteady = groups.heading[first] & groups.heading[second] == 0
        wanted = (gap > 1) | ((gap >= 0) & unsteady)
        yield first[wanted], second[wanted]


def _portions(pairs: tuple[Ints, Ints]) -> Iterator[tuple[Ints, Ints]]:
    first, second = pairs
    for start in range(0, len(first) or 1, _PORTION):
        yield first[start : start + _PORTION], second[start : start + _PORTION]


def _edge_pairs(groups: _Groups, first: Ints, second: Ints, n: int) -> tuple[Ints, Ints]:
    """Return the pairs of edges that meet: of each first group those that meet the second, with its edges they meet."""
    size = groups.edge_low.shape[1]
    member, pair = _meeting(groups.edge_low, first, groups.high, second)
    first, second = first[pair] * size + member, second[pair]
    member, pair = _meeting(groups.edge_low, second, groups.edge_high, first)
    first, second = first[pair], second[pair] * size + member
    gap = second - first
    apart = (gap > 1) & (gap < n - 1)
    return first[apart], second[apart]


def _meeting(low: Floats, group: Ints, high: Floats, box: Ints) -> tuple[Ints, Ints]:
    """Return which members of each group meet the box beside it: (member, place in ``group``) of all that do."""
    low, high = low.take(group, axis=2), high.take(box, axis=1)
    near = (low[0] <= high[0]) & (low[1] <= high[1]) & (low[2] <= high[2]) & (low[3] <= high[3])
    member, place = near.nonzero()
    return member, place
