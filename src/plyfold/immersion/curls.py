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
from plyfold.arrangement.planar_map import darts_by_cell, next_darts
from plyfold.arrays import Ints
from plyfold.core.buffers import all_flat
from plyfold.core.curls import Curls, draw_curls
from plyfold.immersion.immersion import Immersion
from plyfold.ragged import count_each

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
    cusps, turns = np.count_nonzero(arrangement.cusp_index), int(arrangement.cusp_index.sum())
    visits, borders = (size + 2 * turns - cusps for size in (len(arrangement.partner), arrangement.n_borders))
    partner, ccw, first_visit = (
        np.empty(visits, dtype=np.int64),
        np.empty(visits, dtype=bool),
        arrangement.first_visit.copy(),
    )
    cell_of_dart, winding, border = (
        np.empty(size, dtype=np.int64) for size in (2 * borders, arrangement.n_cells + turns, arrangement.n_borders)
    )
    curls = Curls(*all_flat(partner, ccw.view(np.uint8), first_visit, cell_of_dart, winding, border))
    given = (arrangement.first_visit, arrangement.cell_of_dart, arrangement.winding)
    draw_curls(curls, *all_flat(arrangement.partner, arrangement.ccw.view(np.uint8), arrangement.cusp_index, *given))
    following, outer = next_darts(partner, ccw, first_visit), _renumbered(arrangement.outer, border)
    cell_start, cell_darts = darts_by_cell(following, cell_of_dart, len(winding))
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
        turning_numbers=tuple(arrangement.loop_characteristics.tolist()),
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
