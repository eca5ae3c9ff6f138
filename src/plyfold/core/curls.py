"""Cusps drawn out as curls."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer, whole_room

__all__ = ["Curls", "draw_curls"]


class Curls:
    """Room for a map with curls in place of cusps.

    ``partner``, ``ccw`` and ``first_visit`` as in arrangements, the cell on the left of each dart, and the winding
    number of each cell; and the number that each border of the map with cusps has then.
    """

    def __init__(
        self,
        partner: WholeBuffer,
        ccw: WholeBuffer,
        first_visit: WholeBuffer,
        cell: WholeBuffer,
        winding: WholeBuffer,
        border: WholeBuffer,
    ) -> None:
        self.partner, self.ccw, self.first_visit = partner, ccw, first_visit
        self.cell, self.winding, self.border = cell, winding, border
        self.cells = self.borders = self.visits = 0


def draw_curls(
    drawn: Curls,
    partner: WholeBuffer,
    ccw: WholeBuffer,
    index: WholeBuffer,
    first_visit: WholeBuffer,
    cell: WholeBuffer,
    winding: WholeBuffer,
) -> None:
    """Draw all cusps out as curls, see `immersion.curls`.

    Parameters
    ----------
    drawn : Curls
    partner, ccw, first_visit, cell, winding
        The same of the map with cusps.
    index : buffer of int
        The index of the cusp at each visit, 0 elsewhere.
    """
    moved = whole_room(len(index))
    old_border = 0
    for number in range(len(winding)):
        drawn.winding[number] = winding[number]
    drawn.cells = len(winding)
    for loop in range(len(first_visit) - 1):
        drawn.first_visit[loop] = drawn.visits
        start, end = first_visit[loop], first_visit[loop + 1]
        for visit in range(start, max(end, start + 1)):
            if visit < end:
                moved[visit] = drawn.visits
                if index[visit] == 0:
                    drawn.visits += 1
                else:
                    top, bottom = cell[2 * old_border], cell[2 * old_border + 1]
                    _draw_curl(drawn, index[visit], winding[top], bottom)
            drawn.border[old_border] = here = drawn.borders
            drawn.cell[2 * here], drawn.cell[2 * here + 1] = cell[2 * old_border], cell[2 * old_border + 1]
            drawn.borders += 1
            old_border += 1
    drawn.first_visit[len(first_visit) - 1] = drawn.visits
    for visit in range(len(index)):
        if index[visit] == 0:
            drawn.partner[moved[visit]] = moved[partner[visit]]
            drawn.ccw[moved[visit]] = ccw[visit]


def _draw_curl(drawn: Curls, index: int, above: int, bottom: int) -> None:
    """Draw a curl, given the winding number on the left of the border after the cusp, and the cell on its right.

    The i-th of its borders lies ``depth`` = min(i, 2m − i) turns deep, between the new cell number ``depth`` on its
    right and the one before it on its left.
    """
    for step in range(2 * index):
        drawn.partner[drawn.visits + step] = drawn.visits + 2 * index - 1 - step
        drawn.ccw[drawn.visits + step] = 1 if step < index else 0
    for i in range(1, 2 * index):
        depth = min(i, 2 * index - i)
        here = drawn.borders + i - 1
        drawn.cell[2 * here] = drawn.cells + depth - 2 if depth > 1 else bottom
        drawn.cell[2 * here + 1] = drawn.cells + depth - 1
    for depth in range(index):
        drawn.winding[drawn.cells + depth] = above - 2 - depth
    drawn.visits += 2 * index
    drawn.borders += 2 * index - 1
    drawn.cells += index
