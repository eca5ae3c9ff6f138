"""What the gluing of an immersion has to be, looked at seam by seam, crossing by crossing, cusp by cusp."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer, whole_room

__all__ = ["Gluing", "agree_around", "first_wrong_seam", "wind_round"]


class Gluing:
    """How sheets are glued along seams: borders, and then bridges.

    Parameters
    ----------
    own : buffer of int
        The own sheet of each border.
    rows : buffer of 3r int
        The seam, the sheet on its right and the sheet on its left that are glued; by seams and sheets on the right.
    left_sheet, left_sheets : buffer of int
        The first of the sheets on the left of each seam, and how many there are.
    right_sheet, right_sheets : buffer of int
        The same on the right.
    """

    def __init__(
        self,
        own: WholeBuffer,
        rows: WholeBuffer,
        left_sheet: WholeBuffer,
        left_sheets: WholeBuffer,
        right_sheet: WholeBuffer,
        right_sheets: WholeBuffer,
    ) -> None:
        self.own, self.rows = own, rows
        self.left_sheet, self.left_sheets = left_sheet, left_sheets
        self.right_sheet, self.right_sheets = right_sheet, right_sheets
        self.first_row = whole_room(len(left_sheet) + 1)
        for seam in range(len(left_sheet)):
            self.first_row[seam + 1] = self.first_row[seam] + right_sheets[seam]


def first_wrong_seam(gluing: Gluing, is_reached: WholeBuffer) -> int:
    """Tell what is wrong with the gluing along some seam: 0 for nothing.

    1 where not every sheet on the right is glued once, 2 where one is glued to a sheet that is not on the left, and 3
    where two are glued to one, or to the own sheet. As there are as many sheets on the left as there are on the right
    and own sheets, each is reached once then. ``is_reached`` is room for zeros, one for each sheet on the left of some
    seam, all counted.
    """
    if 3 * gluing.first_row[len(gluing.left_sheet)] != len(gluing.rows):
        return 1
    start = 0
    for seam in range(len(gluing.left_sheet)):
        first, reached = gluing.first_row[seam], gluing.right_sheets[seam]
        for place in range(gluing.right_sheets[seam]):
            row = 3 * (first + place)
            if gluing.rows[row] != seam or gluing.rows[row + 1] != gluing.right_sheet[seam] + place:
                return 1
            wrong = _reach(gluing, seam, gluing.rows[row + 2], is_reached, start)
            if wrong > 0:
                return wrong
        if seam < len(gluing.own):
            reached += 1
            wrong = _reach(gluing, seam, gluing.own[seam], is_reached, start)
            if wrong > 0:
                return wrong
        if reached != gluing.left_sheets[seam]:
            return 3
        start += reached
    return 0


def _reach(gluing: Gluing, seam: int, sheet: int, is_reached: WholeBuffer, start: int) -> int:
    """Reach a sheet on the left of a seam; return 2 if it is not there, and 3 if it was reached before."""
    place = sheet - gluing.left_sheet[seam]
    if not 0 <= place < gluing.left_sheets[seam]:
        return 2
    if is_reached[start + place] == 1:
        return 3
    is_reached[start + place] = 1
    return 0


def agree_around(gluing: Gluing, around: WholeBuffer) -> int:
    """Compare the two ways from the bottom cell to the top cell, and follow the own sheets of both strands; 0 if wrong.

    ``around`` has for each crossing or foot of a bridge the seams (a to top, a to bottom, b to top, b to bottom), see
    `immersion.corners`. Where a half of a bridge is not there, −1, every sheet is glued to itself.
    """
    for at in range(len(around) // 4):
        a_top, a_bottom, b_top, b_bottom = around[4 * at], around[4 * at + 1], around[4 * at + 2], around[4 * at + 3]
        seam = max(a_bottom, b_bottom)
        for sheet in range(gluing.right_sheet[seam], gluing.right_sheet[seam] + gluing.right_sheets[seam]):
            if _up(gluing, b_top, _up(gluing, a_bottom, sheet)) != _up(gluing, a_top, _up(gluing, b_bottom, sheet)):
                return 0
        if not (_carries_own(gluing, a_bottom, a_top, b_top) and _carries_own(gluing, b_bottom, b_top, a_top)):
            return 0
    return 1


def _carries_own(gluing: Gluing, bottom: int, top: int, across: int) -> bool:
    """Tell whether the own sheet of a strand goes on as such across the other one; bridges have none."""
    if max(bottom, top) >= len(gluing.own):
        return True
    return _up(gluing, across, gluing.own[bottom]) == gluing.own[top]


def _up(gluing: Gluing, seam: int, sheet: int) -> int:
    """Return the sheet on the left that is glued to one on the right of a seam."""
    if seam < 0:
        return sheet
    return gluing.rows[3 * (gluing.first_row[seam] + sheet - gluing.right_sheet[seam]) + 2]


def wind_round(gluing: Gluing, index: WholeBuffer, before: WholeBuffer, after: WholeBuffer) -> int:
    """Tell whether the sheets wind round every cusp as often as its index says; 0 if not.

    Turn counter-clockwise from the border after each cusp to the border before it. That begins on the own sheet of the
    one, goes down over the other and up again as often as the index says, and ends on the own sheet of the other. All
    other sheets on the right go on to the same sheet on the left over both.
    """
    for cusp in range(len(index)):
        sheet = gluing.own[after[cusp]]
        for _ in range(index[cusp]):
            down = _sheet_below(gluing, before[cusp], sheet)
            if down < 0:
                return 0
            sheet = _up(gluing, after[cusp], down)
        if sheet != gluing.own[before[cusp]] or _count_differing(gluing, before[cusp], after[cusp]) != index[cusp]:
            return 0
    return 1


def _sheet_below(gluing: Gluing, border: int, upper: int) -> int:
    """Return the sheet on the right that is glued to one on the left of a border, −1 if that is the own sheet."""
    first = gluing.right_sheet[border]
    for sheet in range(first, first + gluing.right_sheets[border]):
        if _up(gluing, border, sheet) == upper:
            return sheet
    return -1


def _count_differing(gluing: Gluing, before: int, after: int) -> int:
    """Return how many sheets on the right of two borders are glued to different sheets along them."""
    count, first = 0, gluing.right_sheet[after]
    for sheet in range(first, first + gluing.right_sheets[after]):
        if _up(gluing, before, sheet) != _up(gluing, after, sheet):
            count += 1
    return count
