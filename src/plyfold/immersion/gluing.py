"""Sheets and their gluing, from the chords of a grouping.

Over a border the sheets of the lower cell (right) are glued one-to-one to sheets of the higher cell (left); the one
left over there is the border's own sheet, which has the border on the boundary of the disk.

Sheets get their names for free: a sheet is called by the border through which it leaves the disk when one walks along
the dual tree to the outside. Across a descending link the names stay and the link's border is added; across an
ascending link the name of the partner is taken away. The borders off the tree follow, for at every crossing three
gluings give the fourth.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from plyfold.arrangement import Arrangement
from plyfold.immersion.dual_tree import DualTree
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.word import Chord

__all__ = ["glue_sheets"]


@dataclass
class _Seam:
    """What happens over one border: which lower sheet is glued to which upper one, and the sheet left over."""

    upper_of: dict[int, int]
    own: int

    @property
    def lower_of(self) -> dict[int, int]:
        return {upper: lower for lower, upper in self.upper_of.items()}


def glue_sheets(arrangement: Arrangement, tree: DualTree, chords: Iterable[Chord]) -> Immersion:
    """Build the immersion that a grouping describes.

    Parameters
    ----------
    arrangement : Arrangement
        Turning number 1, no negative winding number.
    tree : DualTree
        The tree whose word was grouped.
    chords : iterable of Chord
        One chord for every ascending link.

    Returns
    -------
    Immersion
        Cost: O(Σ w), the number of sheets counted once per border.
    """
    first_sheet = np.concatenate([[0], np.cumsum(arrangement.winding)])
    names = _name_sheets(arrangement, tree, {chord.border: chord.partner for chord in chords}, first_sheet.tolist())
    seams = _seams_on_tree(tree, names)
    _seams_off_tree(arrangement, seams)
    rows = [
        (border, lower, upper)
        for border in range(arrangement.n_borders)
        for lower, upper in sorted(seams[border].upper_of.items())
    ]
    return Immersion(
        arrangement=arrangement,
        sheet_cell=np.repeat(np.arange(arrangement.n_cells), arrangement.winding),
        first_sheet=first_sheet[:-1],
        own_sheet=np.array([seams[border].own for border in range(arrangement.n_borders)], dtype=np.int64),
        gluing=np.array(rows, dtype=np.int64).reshape(-1, 3),
    )


def _name_sheets(
    arrangement: Arrangement, tree: DualTree, partner: dict[int, int], first_sheet: list[int]
) -> list[dict[int, int]]:
    """Return for each cell its sheets by name; the name is a descending border, the value the sheet's number."""
    names: list[dict[int, int]] = [{} for _ in tree.order]
    for cell in tree.order[1:]:
        link = tree.link[cell]
        of_parent = names[tree.parent[cell]]
        mine = set(of_parent) - {partner[link]} if tree.ascends[cell] else {*of_parent, link}
        names[cell] = {name: first_sheet[cell] + place for place, name in enumerate(sorted(mine))}
    return names


def _seams_on_tree(tree: DualTree, names: list[dict[int, int]]) -> dict[int, _Seam]:
    seams = {}
    for cell in tree.order[1:]:
        inner, outer = names[cell], names[tree.parent[cell]]
        lower, upper = (inner, outer) if tree.ascends[cell] else (outer, inner)
        (own,) = set(upper) - set(lower)
        seams[tree.link[cell]] = _Seam({lower[name]: upper[name] for name in lower}, upper[own])
    return seams


def _seams_off_tree(arrangement: Arrangement, seams: dict[int, _Seam]) -> None:
    """Complete the seams, crossing by crossing: the borders off the dual tree form a tree of crossings."""
    around: list[tuple[int, int, int, int]] = corners(arrangement)
    meeting: dict[int, list[int]] = {}
    for crossing, borders in enumerate(around):
        for border in borders:
            meeting.setdefault(border, []).append(crossing)
    ready = list(range(len(around)))
    while ready:
        borders = around[ready.pop()]
        missing = [border for border in borders if border not in seams]
        if len(missing) == 1:
            seams[missing[0]] = _fourth_seam(*(seams.get(border) for border in borders))
            ready.extend(meeting[missing[0]])


def corners(arrangement: Arrangement) -> list[tuple[int, int, int, int]]:
    """Return for each crossing its borders (a to top, a to bottom, b to top, b to bottom).

    Strand b crosses strand a from right to left; the top cell is left of both strands, the bottom cell right of
    both. So a comes along the top and leaves along the bottom, and b comes along the bottom and leaves along the top.
    """
    n = arrangement.n_borders
    a = np.flatnonzero(arrangement.ccw)
    b = arrangement.partner[a]
    return [tuple(row) for row in np.stack([(a - 1) % n, a, b, (b - 1) % n], axis=1).tolist()]


def _fourth_seam(a_top: _Seam | None, a_bottom: _Seam | None, b_top: _Seam | None, b_bottom: _Seam | None) -> _Seam:
    """Return the missing one of the four seams around a crossing.

    Going from the bottom cell to the top one around either side is the same: b_top ∘ a_bottom = a_top ∘ b_bottom,
    and each strand has one own sheet on both sides of the crossing.
    """
    if b_bottom is None and a_top and a_bottom and b_top:
        return _lower_seam(a_bottom, b_top, a_top)
    if a_bottom is None and a_top and b_top and b_bottom:
        return _lower_seam(b_bottom, a_top, b_top)
    if b_top is None and a_top and a_bottom and b_bottom:
        return _upper_seam(a_bottom, a_top, b_bottom)
    if a_top is None and b_top and a_bottom and b_bottom:
        return _upper_seam(b_bottom, b_top, a_bottom)
    raise ValueError("exactly one of the four seams is to be found")


def _lower_seam(bottom: _Seam, top: _Seam, other_top: _Seam) -> _Seam:
    """Return the seam below ``other_top``, given the way round the other side: ``bottom``, then ``top``."""
    back = other_top.lower_of
    return _Seam({low: back[top.upper_of[side]] for low, side in bottom.upper_of.items()}, back[top.own])


def _upper_seam(bottom: _Seam, other_top: _Seam, other_bottom: _Seam) -> _Seam:
    """Return the seam above ``bottom``, given the way round the other side: ``other_bottom``, then ``other_top``."""
    upper_of = {side: other_top.upper_of[other_bottom.upper_of[low]] for low, side in bottom.upper_of.items()}
    upper_of[bottom.own] = other_top.own
    return _Seam(upper_of, other_top.upper_of[other_bottom.own])
