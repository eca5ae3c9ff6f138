"""The immersed disk of a curve that was drawn as the outline of polygons glued together.

A curve may bound several immersed disks. Where it was drawn as the outline of one of them, that one is written down
here without a search: the sheets over a cell are the polygons that contain it.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Ints
from plyfold.immersion.immersion import Immersion

__all__ = ["immersion_of_pieces"]


def immersion_of_pieces(arrangement: Arrangement, over: Bools, own_piece: Ints) -> Immersion:
    """Return the immersed disk that is glued from given pieces.

    Parameters
    ----------
    arrangement : Arrangement
        Of the outline of the disk as it was drawn, with at least one crossing.
    over : (cells, pieces) bool
        Whether each piece lies over each cell. Pieces do not overlap themselves, and are glued along borders of the
        arrangement, at most one to one other along each border.
    own_piece : (borders,) int
        The piece on the left of each border that has the border on the boundary of the disk.

    Returns
    -------
    Immersion
        It has been checked. The sheets over each cell are in order of the pieces they are part of: in all, in the order
        of ``np.nonzero(over)``.

    Raises
    ------
    PlyfoldError
        If the pieces do not make an immersed disk with this outline.

    Notes
    -----
    O(k · pieces).
    """
    sheet = np.cumsum(over).reshape(over.shape) - 1
    right, left = over[arrangement.right_cell], over[arrangement.left_cell]
    left[np.arange(arrangement.n_borders), own_piece] = False
    border, right_piece = np.nonzero(right)
    left_piece = _glued_pieces(right, left)[border, right_piece]
    sheet_cell = np.nonzero(over)[0]
    immersion = Immersion(
        arrangement=arrangement,
        sheet_cell=sheet_cell,
        first_sheet=np.searchsorted(sheet_cell, np.arange(arrangement.n_cells)),
        own_sheet=sheet[arrangement.left_cell, own_piece],
        gluing=np.stack(
            [
                border,
                sheet[arrangement.right_cell[border], right_piece],
                sheet[arrangement.left_cell[border], left_piece],
            ],
            axis=1,
        ),
    )
    immersion.check()
    return immersion


def _glued_pieces(right: Bools, left: Bools) -> Ints:
    """Return the piece on the left that each piece (column) on the right of each border (row) goes on as.

    It is the piece itself, except at a seam, where one piece ends on the right and another begins on the left.
    """
    glued = np.tile(np.arange(right.shape[1]), (len(right), 1))
    ends, begins = right & ~left, left & ~right
    seam = np.flatnonzero(ends.any(axis=1))
    glued[seam, ends[seam].argmax(axis=1)] = begins[seam].argmax(axis=1)
    return glued
