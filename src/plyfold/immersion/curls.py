"""Cusps drawn out as curls: a planar map without cusps that has the same immersions (§2.3 of the paper goes on there).

A *cusp* of index m is a point of the boundary round which the surface turns m times more than one sees. Cut off a small
disk round it: the boundary then winds m times clockwise around the point and leaves straight, through m crossings
x₁ … x_m, x_m … x₁ that it meets in this order. At the first visits the other strand crosses from right to left. At x₁
the cell on the left is the top one, that on the right lies on both sides, and inside are m new cells, each wound round
once less than the one before it.

So every question about sheets can be asked of curves without cusps. The curl is only a way to speak: it has no place in
the drawing, and what comes back has the borders and cells of the drawing alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.maps import numbered_crossings
from plyfold.arrangement.planar_map import cell_boundaries, cycles_by_cell, next_darts
from plyfold.arrays import Bools, Ints
from plyfold.immersion.immersion import Immersion, loop_characteristics
from plyfold.ragged import count_each, starts_of

__all__ = ["DrawnOut", "draw_out_cusps", "without_curls"]


@dataclass(frozen=True, eq=False)
class DrawnOut:
    """A planar map with curls in place of cusps.

    Parameters
    ----------
    arrangement : Arrangement
        Without a drawing. The cells of the drawing keep their numbers, those inside curls follow.
    border : (borders,) int
        The number that each border of the drawing has there.
    """

    arrangement: Arrangement
    border: Ints

    def border_at(self, borders: Ints) -> Ints:
        """Return the borders of the drawing at which some borders are: for those of a curl, the one after the cusp."""
        return np.searchsorted(self.border, borders)


def draw_out_cusps(arrangement: Arrangement) -> DrawnOut:
    """Draw all cusps out as curls. Cost: O(k + Σ m); nothing where there is no cusp."""
    if not arrangement.cusp_index.any():
        return DrawnOut(arrangement, np.arange(arrangement.n_borders))
    copies = np.maximum(2 * arrangement.cusp_index, 1)
    more = np.zeros(arrangement.n_borders, dtype=np.int64)
    more[arrangement.border_after] = copies - 1
    border = np.arange(arrangement.n_borders) + np.cumsum(more)
    partner, ccw = _visits(arrangement, copies)
    first_visit = np.append(0, np.cumsum(copies))[arrangement.first_visit]
    cell_of_dart, winding = _cells(arrangement, border)
    following, outer = next_darts(partner, ccw, first_visit), _renumbered(arrangement.outer, border)
    cell_start, cell_darts = _boundaries(following, int(outer), cell_of_dart)
    drawn_out = replace(
        arrangement,
        partner=partner,
        ccw=ccw,
        outer=int(outer),
        first_visit=first_visit,
        next_dart=following,
        cell_of_dart=cell_of_dart,
        cell_start=cell_start,
        cell_darts=cell_darts,
        winding=winding,
        turning_numbers=tuple(loop_characteristics(arrangement)),
        crossing_of_visit=numbered_crossings(partner),
        bridges=_renumbered(arrangement.bridges, border),
        cusp_index=np.zeros(len(partner), dtype=np.int64),
        outline=None,
        given=None,
        crossings=np.empty((0, 2)),
        marks=np.empty((0, 2)),
        visit_edge=np.empty(0, dtype=np.int64),
    )
    return DrawnOut(drawn_out, border)


def _visits(arrangement: Arrangement, copies: Ints) -> tuple[Ints, Bools]:
    """Return partners and signs, with 2 m visits in place of each cusp: to x₁, …, x_m and back."""
    first = starts_of(copies)
    index, step = np.repeat(arrangement.cusp_index, copies), count_each(copies)
    here = np.repeat(first, copies)
    partner = np.where(index > 0, here + 2 * index - 1 - step, np.repeat(first[arrangement.partner], copies))
    return partner, np.where(index > 0, step < index, np.repeat(arrangement.ccw, copies))


def _cells(arrangement: Arrangement, border: Ints) -> tuple[Ints, Ints]:
    """Return the cell on the left of each dart, and the winding numbers of all cells.

    Between the visits of a cusp are 2 m − 1 new borders; the i-th of them lies ``depth`` = min(i, 2m − i) turns deep,
    between the new cell number ``depth`` on its right and the one before it on its left.
    """
    cusps = np.flatnonzero(arrangement.cusp_index)
    index, after = arrangement.cusp_index[cusps], arrangement.border_after[cusps]
    borders = 2 * index - 1
    i = 1 + count_each(borders)
    depth = np.minimum(i, 2 * np.repeat(index, borders) - i)
    right = np.repeat(arrangement.n_cells - 1 + starts_of(index), borders) + depth
    left = np.where(depth > 1, right - 1, np.repeat(arrangement.right_cell[after], borders))
    new = np.repeat(border[after] - 2 * index, borders) + i
    cell_of_dart = np.empty(2 * (arrangement.n_borders + int(borders.sum())), dtype=np.int64)
    cell_of_dart[2 * border], cell_of_dart[2 * border + 1] = arrangement.left_cell, arrangement.right_cell
    cell_of_dart[2 * new], cell_of_dart[2 * new + 1] = left, right
    above = np.repeat(arrangement.winding[arrangement.left_cell[after]], index)
    return cell_of_dart, np.append(arrangement.winding, above - 2 - count_each(index))


def _boundaries(following: Ints, outer: int, cell_of_dart: Ints) -> tuple[Ints, Ints]:
    """Return the boundaries of cells that have numbers already, cycles by their lowest darts."""
    start, darts, _ = cell_boundaries(following, outer)
    return cycles_by_cell(start, darts, cell_of_dart[darts[start[:-1]]])


def _renumbered(darts: Ints | int, border: Ints) -> Ints:
    return np.asarray(2 * border[np.asarray(darts) // 2] + np.asarray(darts) % 2)


def without_curls(immersion: Immersion, drawn_out: DrawnOut, arrangement: Arrangement) -> Immersion:
    """Return an immersion of the map with curls as one of the drawing: what lies inside curls is left out.

    Sheets over the cells of the drawing have the same numbers in both.
    """
    if drawn_out.arrangement is arrangement:
        return immersion
    own_map, first = drawn_out.arrangement, immersion.first_pair
    kept = np.append(drawn_out.border, np.arange(own_map.n_borders, len(first) - 1))
    size = np.diff(first)[kept]
    pairs = np.repeat(first[kept], size) + count_each(size)
    return Immersion(arrangement, immersion.own_sheet[drawn_out.border], immersion.glued_to[pairs])
