"""What the gluing of an immersion has to be, looked at seam by seam, crossing by crossing, cusp by cusp."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer
from plyfold.core.cells import join, number_joined

__all__ = [
    "APART",
    "NOT_ONCE",
    "Gluing",
    "add_characteristics",
    "agree_around",
    "find_corners",
    "find_corners_at_feet",
    "first_wrong_seam",
    "number_pieces",
    "wind_round",
]

# In place of the half of a bridge that is not there.
_NO_SEAM = -1

APART, NOT_ONCE = 1, 2
"""What is wrong along a seam: a sheet is glued to one that does not lie on the left; one on the left is glued twice,
or neither glued nor the own sheet."""


class Gluing:
    """How sheets are glued along seams: borders, and then bridges.

    Parameters
    ----------
    own : buffer of int
        The own sheet of each border.
    start : buffer of int
        Where the sheets of each seam start in ``glued_to``, and where the last ones end.
    glued_to : buffer of int
        The sheets on the left that the sheets on the right of each seam are glued to, in order.
    left_sheet, left_sheets : buffer of int
        The first of the sheets on the left of each seam, and how many there are.
    right_sheet : buffer of int
        The first of the sheets on the right.
    """

    def __init__(
        self,
        own: WholeBuffer,
        start: WholeBuffer,
        glued_to: WholeBuffer,
        left_sheet: WholeBuffer,
        left_sheets: WholeBuffer,
        right_sheet: WholeBuffer,
    ) -> None:
        self.own, self.start, self.glued_to = own, start, glued_to
        self.left_sheet, self.left_sheets, self.right_sheet = left_sheet, left_sheets, right_sheet


def first_wrong_seam(gluing: Gluing, mark: WholeBuffer) -> int:
    """Tell what is wrong with the gluing along the first seam that is wrong: 0 for nothing, ``APART`` or ``NOT_ONCE``.

    ``mark`` is room for zeros, one for each sheet.

    Examples
    --------
    Two sheets over the inner cell of a limaçon, one of them glued to that of the outer cell, and then its own sheet:

    >>> from array import array
    >>> own, start, left = array("q", [0, 2]), array("q", [0, 0, 1]), (array("q", [0, 1]), array("q", [1, 2]))
    >>> right, mark = array("q", [0, 0]), array("i", [0, 0, 0])
    >>> first_wrong_seam(Gluing(own, start, array("i", [1]), *left, right), mark)
    0
    >>> first_wrong_seam(Gluing(own, start, array("i", [2]), *left, right), array("i", [0, 0, 0])) == NOT_ONCE
    True
    """
    for seam in range(len(gluing.left_sheet)):
        first, end = gluing.start[seam], gluing.start[seam + 1]
        for pair in range(first, end):
            wrong = _reach(gluing, seam, gluing.glued_to[pair], mark)
            if wrong:
                return wrong
        reached = end - first
        if seam < len(gluing.own):
            wrong = _reach(gluing, seam, gluing.own[seam], mark)
            if wrong:
                return wrong
            reached += 1
        if reached != gluing.left_sheets[seam]:
            return NOT_ONCE
    return 0


def _reach(gluing: Gluing, seam: int, sheet: int, mark: WholeBuffer) -> int:
    """Mark a sheet on the left with the number of a seam, from 1 on; return what is wrong if that cannot be."""
    place = sheet - gluing.left_sheet[seam]
    if not 0 <= place < gluing.left_sheets[seam]:
        return APART
    if mark[sheet] == seam + 1:
        return NOT_ONCE
    mark[sheet] = seam + 1
    return 0


def agree_around(gluing: Gluing, around: WholeBuffer) -> int:
    """Compare the two ways from the bottom cell to the top cell, and follow the own sheets of both strands; 0 if wrong.

    ``around`` has for each crossing or foot of a bridge the seams (a to top, a to bottom, b to top, b to bottom), see
    `immersion.corners`. Where a half of a bridge is not there, −1, every sheet is glued to itself.
    """
    for at in range(len(around) // 4):
        a_top, a_bottom, b_top, b_bottom = around[4 * at], around[4 * at + 1], around[4 * at + 2], around[4 * at + 3]
        seam = max(a_bottom, b_bottom)
        for sheet in range(gluing.right_sheet[seam], gluing.right_sheet[seam] + _count(gluing, seam)):
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


def _count(gluing: Gluing, seam: int) -> int:
    """Return how many sheets lie on the right of a seam."""
    return gluing.start[seam + 1] - gluing.start[seam]


def _up(gluing: Gluing, seam: int, sheet: int) -> int:
    """Return the sheet on the left that is glued to one on the right of a seam."""
    if seam < 0:
        return sheet
    return gluing.glued_to[gluing.start[seam] + sheet - gluing.right_sheet[seam]]


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
    for sheet in range(first, first + _count(gluing, border)):
        if _up(gluing, border, sheet) == upper:
            return sheet
    return -1


def _count_differing(gluing: Gluing, before: int, after: int) -> int:
    """Return how many sheets on the right of two borders are glued to different sheets along them."""
    count, first = 0, gluing.right_sheet[after]
    for sheet in range(first, first + _count(gluing, after)):
        if _up(gluing, before, sheet) != _up(gluing, after, sheet):
            count += 1
    return count


def number_pieces(gluing: Gluing, joined: WholeBuffer, piece: WholeBuffer) -> None:
    """Give numbers to the connected pieces of glued sheets in the order of their first sheets.

    ``joined`` is room for a number, and ``piece`` for that of the piece, for each sheet.
    """
    for sheet in range(len(joined)):
        joined[sheet] = sheet
    for seam in range(len(gluing.left_sheet)):
        shift = gluing.right_sheet[seam] - gluing.start[seam]
        for pair in range(gluing.start[seam], gluing.start[seam + 1]):
            join(joined, pair + shift, gluing.glued_to[pair])
    number_joined(joined, piece)


def add_characteristics(
    gluing: Gluing,
    around: WholeBuffer,
    index: WholeBuffer,
    after: WholeBuffer,
    piece: WholeBuffer,
    total: WholeBuffer,
) -> None:
    """Add up the Euler characteristic of each piece.

    Cells cut open along bridges are disks, so a sheet counts 1, and a bridge −1 on each sheet over its cell. A crossing
    counts 1 on each sheet over its top cell, and the borders that leave it −1 on each sheet on their left. At a mark
    there would be a point and a border more for each of these sheets, which is nothing; but the sheets that wind round
    a cusp have one point there together.

    Parameters
    ----------
    gluing : Gluing
    around : buffer of int
        The seams around each crossing, see `agree_around`.
    index, after : buffer of int
        The index of each cusp, and the border after it.
    piece : buffer of int
        The piece of each sheet.
    total : buffer of int
        A zero for each piece.
    """
    for sheet in range(len(piece)):
        total[piece[sheet]] += 1
    for bridge in range(len(gluing.own), len(gluing.left_sheet)):
        _add_on_left(gluing, bridge, piece, total, -1)
    for at in range(len(around) // 4):
        _add_on_left(gluing, around[4 * at], piece, total, 1)
        _add_on_left(gluing, around[4 * at + 1], piece, total, -1)
        _add_on_left(gluing, around[4 * at + 2], piece, total, -1)
    for cusp in range(len(index)):
        total[piece[gluing.own[after[cusp]]]] -= index[cusp]


def _add_on_left(gluing: Gluing, seam: int, piece: WholeBuffer, total: WholeBuffer, number: int) -> None:
    """Add a number for each sheet on the left of a seam."""
    first = gluing.left_sheet[seam]
    for sheet in range(first, first + gluing.left_sheets[seam]):
        total[piece[sheet]] += number


def find_corners(
    partner: WholeBuffer, ccw: WholeBuffer, before: WholeBuffer, after: WholeBuffer, around: WholeBuffer
) -> None:
    """Write down the borders around each crossing, see `immersion.corners.corners`, given those at each visit."""
    at = 0
    for visit in range(len(partner)):
        if ccw[visit]:
            other = partner[visit]
            around[at], around[at + 1] = before[visit], after[visit]
            around[at + 2], around[at + 3] = after[other], before[other]
            at += 4


def find_corners_at_feet(
    foot: WholeBuffer, dart: WholeBuffer, before: WholeBuffer, after: WholeBuffer, borders: int, around: WholeBuffer
) -> None:
    """Write down the same for the feet of bridges, given their visits and darts: first feet, then second ones."""
    bridges = len(foot) // 2
    for number in range(len(foot)):
        visit, bridge, sets_out = foot[number], borders + number % bridges, number < bridges
        on_left = dart[number] % 2 == 0
        upper, lower = bridge if on_left else _NO_SEAM, _NO_SEAM if on_left else bridge
        here = 4 * number
        if sets_out == on_left:
            around[here], around[here + 1] = before[visit], after[visit]
            around[here + 2], around[here + 3] = upper, lower
        else:
            around[here], around[here + 1] = upper, lower
            around[here + 2], around[here + 3] = after[visit], before[visit]
