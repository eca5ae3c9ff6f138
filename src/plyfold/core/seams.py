"""Whether the sheets over all cells are glued as those of a surface are. See `immersion.checks`."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer

__all__ = ["AGREE", "APART", "ONCE", "GluedSeams", "first_fault"]

AGREE, ONCE, APART = 1, 2, 3
"""The faults: the seams around a crossing do not agree; a sheet on the left is glued twice or not at all; a sheet is
glued to one that does not lie on the left."""


class GluedSeams:
    """What happens over each border, and then over each bridge.

    Parameters
    ----------
    start : buffer of int
        Where the sheets of each seam start in ``glued_to``, and where the last ones end.
    glued_to : buffer of int
        The sheets on the left that the sheets on the right of each seam are glued to, in order.
    own : buffer of int
        The sheet on the left of each border that is left over.
    first_left, first_right : buffer of int
        The first sheets on both sides of each seam.
    sheets_left : buffer of int
        How many sheets lie on the left of each seam.
    """

    def __init__(
        self,
        start: WholeBuffer,
        glued_to: WholeBuffer,
        own: WholeBuffer,
        first_left: WholeBuffer,
        first_right: WholeBuffer,
        sheets_left: WholeBuffer,
    ) -> None:
        self.start, self.glued_to, self.own = start, glued_to, own
        self.first_left, self.first_right, self.sheets_left = first_left, first_right, sheets_left


def first_fault(seams: GluedSeams, around: WholeBuffer, taken: WholeBuffer) -> int:
    """Return the first fault, 0 if there is none.

    Parameters
    ----------
    seams : GluedSeams
    around : buffer of 4k int
        The borders at each crossing: a to top, a to bottom, b to top, b to bottom.
    taken : buffer of int
        A zero for each sheet.

    Examples
    --------
    Two sheets over the inner cell of a limaçon, one of them glued to that of the outer cell:

    >>> from array import array
    >>> start, around, taken = array("q", [0, 0, 1]), array("q", [1, 0, 1, 0]), array("i", [0, 0, 0])
    >>> sides = array("q", [0, 1]), array("q", [0, 0]), array("q", [1, 2])
    >>> own, none = array("q", [0, 2]), array("q")
    >>> first_fault(GluedSeams(start, array("i", [1]), own, *sides), none, taken)
    0
    >>> first_fault(GluedSeams(start, array("i", [2]), own, *sides), none, array("i", [0, 0, 0])) == ONCE
    True
    """
    for seam in range(len(seams.first_left)):
        fault = _fault_along(seams, seam, taken)
        if fault:
            return fault
    for place in range(0, len(around), 4):
        if not _agree(seams, around[place], around[place + 1], around[place + 2], around[place + 3]):
            return AGREE
    return 0


def _fault_along(seams: GluedSeams, seam: int, taken: WholeBuffer) -> int:
    """Return the fault of a seam: every sheet on the left is to be taken once, with a mark of the seam on it."""
    glued_to = seams.glued_to
    low, mark, left = seams.first_left[seam], seam + 1, seams.sheets_left[seam]
    high = low + left
    for pair in range(seams.start[seam], seams.start[seam + 1]):
        sheet = glued_to[pair]
        if sheet < low or sheet >= high:
            return APART
        if taken[sheet] == mark:
            return ONCE
        taken[sheet] = mark
        left -= 1
    if seam < len(seams.own):
        sheet = seams.own[seam]
        if sheet < low or sheet >= high:
            return APART
        if taken[sheet] == mark:
            return ONCE
        left -= 1
    return ONCE if left else 0


def _agree(seams: GluedSeams, a_top: int, a_bottom: int, b_top: int, b_bottom: int) -> bool:
    """Tell whether both ways from the bottom to the top of a crossing are the same, and own sheets go on as such."""
    glued_to, first, other = seams.glued_to, seams.start[a_bottom], seams.start[b_bottom]
    past_a = seams.start[b_top] - seams.first_right[b_top]
    past_b = seams.start[a_top] - seams.first_right[a_top]
    for lower in range(seams.start[a_bottom + 1] - first):
        if glued_to[past_a + glued_to[first + lower]] != glued_to[past_b + glued_to[other + lower]]:
            return False
    along_a = glued_to[past_a + seams.own[a_bottom]] == seams.own[a_top]
    return along_a and glued_to[past_b + seams.own[b_bottom]] == seams.own[b_top]
