"""Planar maps of one loop or of several: their code, how they lie to each other, and the walk round their cells."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np

from plyfold.arrangement.planar_map import (
    cell_boundaries,
    joined_cells,
    next_darts,
)
from plyfold.arrays import Bools, Floats, Ints, Reals
from plyfold.core.buffers import all_flat, flat
from plyfold.core.direction import CurveDirection, outer_dart_of_points
from plyfold.predicates import cross_sign

__all__ = [
    "CellWalk",
    "Code",
    "Map",
    "numbered_crossings",
    "oriented",
    "outer_dart",
    "walked_round",
]


CellWalk: TypeAlias = tuple[Ints, Ints, Ints, Ints]
"""The dart after each dart, where the boundary of each cell starts, the darts cell by cell, and the cell of each."""


class Code(NamedTuple):
    """The visits of some loops, numbered loop after loop, and the winding number left of each border."""

    partner: Ints
    ccw: Bools
    first_visit: Ints
    left: Ints
    edge: Ints
    cusp_index: Ints


class Map(NamedTuple):
    """A code, and how its loops lie to each other.

    ``outside`` are darts of the unbounded cell. ``same_cell`` are pairs of darts that have one cell on their left,
    where the crossings do not tell. ``bridges`` are darts that start at the feet of bridges, ``places`` of marks.
    """

    code: Code
    outside: Ints
    same_cell: Ints
    bridges: Ints = np.empty((0, 2), dtype=np.int64)
    places: Floats = np.empty((0, 2))


def oriented(partner: Ints, ccw: Bools, outer: int, is_directed: bool = False) -> tuple[Map, int, bool]:
    """Return the map of one curve in the direction in which it is used, its turning number, and if it was turned round.

    That is done, if its direction is not settled, if it makes all winding numbers positive; if nothing does, for a
    positive turning number.
    """
    found, partner, ccw = CurveDirection(), partner.copy(), ccw.copy()
    left = np.empty(max(len(partner), 1), dtype=np.int64)
    found.settle(flat(partner), flat(ccw.view(np.uint8)), outer, is_directed, flat(left))
    none = np.zeros(len(partner), dtype=np.int64)
    code = Code(partner, ccw, np.array([0, len(partner)]), left, none[:0], none)
    drawn = Map(code, np.array([found.outer]), np.empty((0, 2), dtype=np.int64))
    return drawn, found.turning, found.turned_round


def walked_round(drawn: Map) -> CellWalk:
    """Return the dart after each, where the boundary of each cell starts, their darts, and the cell of each dart."""
    following = next_darts(drawn.code.partner, drawn.code.ccw, drawn.code.first_visit)
    if len(drawn.outside) + len(drawn.same_cell) == 1:
        return following, *cell_boundaries(following, int(drawn.outside[0]))
    return following, *joined_cells(following, drawn.outside, drawn.same_cell)


def numbered_crossings(partner: Ints) -> Ints:
    """Return the crossing of each visit, in the order of first visits; −1 at marks."""
    visit = np.arange(len(partner))
    number = np.cumsum(visit < partner) - 1
    return np.where(visit == partner, -1, number[np.minimum(visit, partner)])


def outer_dart(points: Reals, visit_edge: Ints) -> int:
    """Return a dart with the unbounded cell on its left: at the leftmost vertex, on its convex side."""
    if points.dtype == np.float64:
        return outer_dart_of_points(*all_flat(points, visit_edge))
    x, y = points.T
    leftmost = np.flatnonzero(x == x.min())
    corner = int(leftmost[y[leftmost].argmin()])
    before, here, after = (points[at].tolist() for at in (corner - 1, corner, (corner + 1) % len(points)))
    border = (int(visit_edge.searchsorted(corner)) - 1) % max(len(visit_edge), 1)
    return 2 * border + int(cross_sign(before, here, here, after) > 0)
