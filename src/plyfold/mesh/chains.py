"""The curve as a chain of edges of triangles, when points have been added on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats, Ints

if TYPE_CHECKING:
    from plyfold.mesh.constrained import Outline

__all__ = ["left_of_chain", "split_chain"]


def split_chain(outline: Outline, unit_points: Floats, added: Ints) -> tuple[Ints, Ints]:
    """Return the chain along the curve with the points that were added on it, and the borders.

    The added ones are rows (piece of the outline's chain, vertex), in any order.
    """
    starts, ends = outline.chain, np.roll(outline.chain, -1)
    piece, vertex = added.T
    direction = unit_points[ends[piece]] - unit_points[starts[piece]]
    advance = ((unit_points[vertex] - unit_points[starts[piece]]) * direction).sum(axis=1)
    every_piece = np.concatenate([np.arange(len(starts)), piece])
    order = np.lexsort((np.concatenate([np.full(len(starts), -np.inf), advance]), every_piece))
    return np.concatenate([starts, vertex])[order], outline.chain_border[every_piece[order]]


def left_of_chain(triangles: Ints, chain: Ints) -> Ints:
    """Return the half-edge along each piece of a chain, -1 if there is none; a point starts at most two pieces."""
    start, end = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    pieces = np.arange(len(chain))
    left = np.full(len(pieces), -1)
    for order in (pieces, pieces[::-1]):
        piece_from, next_point = np.full((2, max(start.max(), chain.max()) + 1), -1)
        piece_from[chain[order]] = order
        next_point[chain[order]] = np.roll(chain, -1)[order]
        along = np.flatnonzero(next_point[start] == end)
        left[piece_from[start[along]]] = along
    return left
