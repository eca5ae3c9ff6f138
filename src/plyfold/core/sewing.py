"""Sheets sewn together: the seams of the dual tree first, and then crossing by crossing. See `immersion.sewing`."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer, short_room, whole_room

__all__ = ["BorderSeams", "Crossings", "NamedTree", "number_sheets", "sew"]


class NamedTree:
    """The dual tree: for each cell its parent, the link to it, the partner chosen for that or −1, and the sheets.

    ``name`` is of each sheet the border through which it leaves the disk on the way along the tree to the outside.
    ``named`` tells which cells have names for their sheets, ``waiting`` is a stack of cells.
    """

    def __init__(
        self,
        sheets: int,
        parent: WholeBuffer,
        link: WholeBuffer,
        partner: WholeBuffer,
        winding: WholeBuffer,
        first_sheet: WholeBuffer,
    ) -> None:
        self.parent, self.link, self.partner = parent, link, partner
        self.winding, self.first_sheet = winding, first_sheet
        self.name, self.named, self.waiting = short_room(sheets), whole_room(len(parent)), whole_room(len(parent))
        self.named[0] = 1


class Crossings:
    """The borders around each crossing, four each, and the crossings at the start and at the end of each border.

    At each crossing ``unknown`` borders have no seam yet, and ``sum_unknown`` is the sum of their numbers; where there
    is one, it is that one. ``scratch`` is room for a seam.
    """

    def __init__(
        self,
        sheets: int,
        around: WholeBuffer,
        at_start: WholeBuffer,
        at_end: WholeBuffer,
        unknown: WholeBuffer,
        sum_unknown: WholeBuffer,
    ) -> None:
        self.around, self.at_start, self.at_end = around, at_start, at_end
        self.unknown, self.sum_unknown = unknown, sum_unknown
        self.ready, self.scratch = whole_room(2 * len(unknown)), short_room(sheets + 1)


class BorderSeams:
    """What happens over each border: the upper sheet that each lower sheet is glued to, and the own one, left over.

    Sheets are counted from the first one of their cell. Those below border e are glued to
    ``upper[start[e]:start[e + 1]]``, and ``own[e]`` is left over.
    """

    def __init__(self, start: WholeBuffer, upper: WholeBuffer, own: WholeBuffer) -> None:
        self.start, self.upper, self.own = start, upper, own


def sew(tree: NamedTree, crossings: Crossings, seams: BorderSeams) -> None:
    """Find the seams of all links, parents first, and then those of the other borders."""
    for start in range(len(tree.parent)):
        cell, size = start, 0
        while tree.named[cell] == 0:
            tree.waiting[size] = cell
            cell, size = tree.parent[cell], size + 1
        while size > 0:
            size -= 1
            _name_sheets(tree, seams, tree.waiting[size])
    _complete(crossings, seams)


def _name_sheets(tree: NamedTree, seams: BorderSeams, cell: int) -> None:
    """Name the sheets over a cell after those over its parent, and write down the seam between them."""
    partner, count = tree.partner[cell], tree.winding[tree.parent[cell]]
    above, first, seam = tree.first_sheet[tree.parent[cell]], tree.first_sheet[cell], seams.start[tree.link[cell]]
    kept = 0
    for sheet in range(count):
        if tree.name[above + sheet] == partner:
            seams.own[tree.link[cell]] = sheet
        else:
            tree.name[first + kept] = tree.name[above + sheet]
            seams.upper[seam + kept] = sheet
            kept += 1
    if partner < 0:
        tree.name[first + count] = tree.link[cell]
        seams.own[tree.link[cell]] = count
    tree.named[cell] = 1


def _complete(crossings: Crossings, seams: BorderSeams) -> None:
    """Complete the seams, crossing by crossing: the borders off the dual tree form a tree of crossings.

    A crossing at which one seam is missing gives it to the crossing at the border's other end.
    """
    size = 0
    for crossing in range(len(crossings.unknown)):
        if crossings.unknown[crossing] == 1:
            crossings.ready[size] = crossing
            size += 1
    while size > 0:
        size -= 1
        crossing = crossings.ready[size]
        if crossings.unknown[crossing] == 0:
            continue
        border = crossings.sum_unknown[crossing]
        _find_seam(crossings, seams, border, crossing)
        size = _note_seam(crossings, border, crossings.at_start[border], size)
        size = _note_seam(crossings, border, crossings.at_end[border], size)


def _note_seam(crossings: Crossings, border: int, crossing: int, size: int) -> int:
    """Note at a crossing that a border has its seam; return how many crossings are ready."""
    crossings.unknown[crossing] -= 1
    crossings.sum_unknown[crossing] -= border
    if crossings.unknown[crossing] == 1:
        crossings.ready[size] = crossing
        size += 1
    return size


def _find_seam(crossings: Crossings, seams: BorderSeams, border: int, crossing: int) -> None:
    """Find the missing one of the four seams around a crossing.

    Going from the bottom cell to the top one around either side is the same: b_top ∘ a_bottom = a_top ∘ b_bottom,
    and each strand has one own sheet on both sides of the crossing.
    """
    a_top, a_bottom = crossings.around[4 * crossing], crossings.around[4 * crossing + 1]
    b_top, b_bottom = crossings.around[4 * crossing + 2], crossings.around[4 * crossing + 3]
    if border == b_bottom:
        _find_lower(seams, crossings, border, a_bottom, b_top, a_top)
    elif border == a_bottom:
        _find_lower(seams, crossings, border, b_bottom, a_top, b_top)
    elif border == b_top:
        _find_upper(seams, border, a_bottom, a_top, b_bottom)
    else:
        _find_upper(seams, border, b_bottom, b_top, a_bottom)


def _find_lower(seams: BorderSeams, crossings: Crossings, border: int, bottom: int, top: int, other_top: int) -> None:
    """Find the seam below ``other_top``, given the way round the other side: ``bottom``, then ``top``."""
    upper, scratch = seams.upper, crossings.scratch
    here, low, high, side = seams.start[border], seams.start[bottom], seams.start[top], seams.start[other_top]
    for lower in range(seams.start[other_top + 1] - side):
        scratch[upper[side + lower]] = lower
    for lower in range(seams.start[border + 1] - here):
        upper[here + lower] = scratch[upper[high + upper[low + lower]]]
    # The strand of ``top`` has an own sheet on the other side of the crossing as well.
    seams.own[border] = scratch[seams.own[top]]


def _find_upper(seams: BorderSeams, border: int, bottom: int, other_top: int, other_bottom: int) -> None:
    """Find the seam above ``bottom``, given the way round the other side: ``other_bottom``, then ``other_top``."""
    upper = seams.upper
    here, low, high, side = seams.start[border], seams.start[bottom], seams.start[other_top], seams.start[other_bottom]
    upper[here + seams.own[bottom]] = seams.own[other_top]
    for lower in range(seams.start[bottom + 1] - low):
        upper[here + upper[low + lower]] = upper[high + upper[side + lower]]
    seams.own[border] = upper[high + seams.own[other_bottom]]


def number_sheets(seams: BorderSeams, first_sheet: WholeBuffer) -> None:
    """Count all sheets from the very first one; ``first_sheet`` has the first one on the left of each border."""
    for border in range(len(first_sheet)):
        first = first_sheet[border]
        seams.own[border] += first
        for pair in range(seams.start[border], seams.start[border + 1]):
            seams.upper[pair] += first
