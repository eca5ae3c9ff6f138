"""Better triangles inside the cells of a drawing.

With a hub, a cell must be seen whole from one point, so what lies in a bay of it has to be small. Once edges between
two triangles of a cell are exchanged for the other diagonal where that is better (Delaunay's criterion), cells may
bend like crescents.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.drawing.skeleton import Kind, Skeleton
from plyfold.arrays import Complexes, Ints

__all__ = ["flipped"]

_EQUILATERAL = np.array([0, 1, 0.5 + 0.75**0.5 * 1j])
_SLACK = 0.2
_MOST_PASSES = 10


def flipped(places: Complexes, skeleton: Skeleton) -> Skeleton:
    """Return a skeleton with better triangles inside the cells for a drawing; the same one if there are none.

    Parameters
    ----------
    places : (n,) complex
        A drawing in which no triangle is turned over.
    skeleton : Skeleton

    Returns
    -------
    Skeleton
        Of the same vertices and the same curve, with no triangle turned over in the drawing. New triangles are to be
        equilateral.

    Notes
    -----
    O(k log k) for each of at most ten passes. Two angles that look at an edge from both sides must exceed half a turn
    by a little before it is flipped, so the quadrilateral is convex with room to spare.
    """
    triangles, shapes = skeleton.triangles.copy(), skeleton.shapes.copy()
    for _ in range(_MOST_PASSES):
        apart = _apart(_wrong_edges(places, triangles, skeleton))
        if not len(apart):
            break
        first, second, tail, head, left, right = apart.T
        triangles[first] = np.column_stack([left, tail, right])
        triangles[second] = np.column_stack([right, head, left])
        shapes[first] = shapes[second] = _EQUILATERAL
    if np.array_equal(triangles, skeleton.triangles):
        return skeleton
    return replace(skeleton, triangles=triangles, shapes=shapes)


def _wrong_edges(places: Complexes, triangles: Ints, skeleton: Skeleton) -> Ints:
    """Return the triangles left and right of each edge to be flipped, its tail and head, and the two opposite corners.

    Edges of the curve stay. Sides are found by a number made of both ends.
    """
    n = len(places)
    inner = np.flatnonzero(skeleton.kind == Kind.CELL)
    tail, head, apex = (np.roll(triangles[inner], -shift, axis=1).ravel() for shift in range(3))
    side, opposite = tail * n + head, head * n + tail
    order = np.argsort(side)
    twin = order[np.searchsorted(side, opposite, sorter=order) % len(order)]
    before, after = skeleton.path, np.roll(skeleton.path, -1)
    on_curve = np.isin(side, np.concatenate([before * n + after, after * n + before]))
    candidate = np.flatnonzero((side[twin] == opposite) & (tail < head) & ~on_curve)
    ends = tail[candidate], head[candidate]
    corners = apex[candidate], apex[twin[candidate]]
    looking = sum(_angle(places[corner], *(places[end] for end in ends)) for corner in corners)
    owner = np.repeat(inner, 3)
    table = np.column_stack([owner[candidate], owner[twin[candidate]], *ends, *corners])
    return table[looking > np.pi + _SLACK]


def _angle(corner: Complexes, first: Complexes, second: Complexes) -> npt.NDArray[np.float64]:
    return np.asarray(np.abs(np.angle((first - corner) / (second - corner))))


def _apart(edges: Ints) -> Ints:
    """Return edges of which no two are on the same triangle."""
    taken: set[int] = set()
    kept = []
    for row, (first, second, *_) in enumerate(edges.tolist()):
        if not taken & {first, second}:
            taken |= {first, second}
            kept.append(row)
    return edges[kept]
