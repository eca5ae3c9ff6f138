"""Marks on the loops of a planar map, inserted among the visits: all numbers anew, in one pass."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer

__all__ = ["Marked", "insert_marks"]


class Marked:
    """Room for a code with marks inserted.

    Parameters
    ----------
    partner, ccw, edge, first_visit, left
        As in a code, with the marks counted.
    moved, visit : buffer of int
        The new number of each old visit, and that of each mark.
    border : buffer of int
        The new number of each old border, or of the first of the pieces that marks cut it into.
    """

    def __init__(
        self,
        partner: WholeBuffer,
        ccw: WholeBuffer,
        first_visit: WholeBuffer,
        left: WholeBuffer,
        moved: WholeBuffer,
        visit: WholeBuffer,
        border: WholeBuffer,
    ) -> None:
        self.partner, self.ccw, self.first_visit, self.left = partner, ccw, first_visit, left
        self.moved, self.visit, self.border = moved, visit, border


def insert_marks(
    partner: WholeBuffer,
    ccw: WholeBuffer,
    first_visit: WholeBuffer,
    left: WholeBuffer,
    loop: WholeBuffer,
    at: WholeBuffer,
    marked: Marked,
) -> int:
    """Insert marks into a code, and return how many borders there are then.

    Parameters
    ----------
    partner, ccw, first_visit, left
        A code without marks.
    loop, at : buffer of m int
        The loop of each mark, and the visit before which it comes, in the order of the marks.
    marked : Marked
    """
    mark = border = new_border = shift = 0
    for number in range(len(first_visit) - 1):
        start, end = first_visit[number], first_visit[number + 1]
        borders = max(end - start, 1)
        marked.first_visit[number] = start + shift
        marked.border[border] = first = new_border
        for visit in range(start, end + 1):
            while mark < len(at) and loop[mark] == number and (at[mark] <= visit or visit == end):
                # It cuts the border that comes before its visit, which is the last one before the first visit.
                marked.left[new_border] = left[border + (visit - start if visit > start else borders) - 1]
                marked.visit[mark] = visit + shift
                mark, new_border, shift = mark + 1, new_border + 1, shift + 1
            if visit < end:
                marked.moved[visit] = visit + shift
                marked.border[border + visit - start] = new_border
                marked.left[new_border] = left[border + visit - start]
                new_border += 1
        if new_border == first:
            marked.left[new_border] = left[border]
            new_border += 1
        border += borders
    marked.first_visit[len(first_visit) - 1] = len(partner) + shift
    _join_visits(partner, ccw, marked)
    return new_border


def _join_visits(partner: WholeBuffer, ccw: WholeBuffer, marked: Marked) -> None:
    """Write the partners of visits, and how they cross; marks are their own partners."""
    for visit in range(len(partner)):
        moved = marked.moved[visit]
        marked.partner[moved] = marked.moved[partner[visit]]
        marked.ccw[moved] = ccw[visit]
    for mark in range(len(marked.visit)):
        visit = marked.visit[mark]
        marked.partner[visit] = visit
        marked.ccw[visit] = 0
