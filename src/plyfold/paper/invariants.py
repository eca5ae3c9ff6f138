"""The pairwise invariants of §2.4 of [MGR11]_: winding numbers of cells across a border and around a crossing.

With signed winding numbers they hold for every closed curve in general position. Left of a border the winding number is
one more than right of it, so around a crossing the four cells have, for some w, the winding numbers w (right of both
strands), w + 1, w + 2 (left of both) and w + 1. Hence

* cells across a border differ by 1;
* one diagonal pair, w + 1 and w + 1, differs by 0, the other, w and w + 2, by 2;
* both diagonal sums are 2w + 2.

So signed numbers say nothing about disks. The paper's Figure 8 counts without sign: around the crossing of a figure of
eight the cells are then 1, 0, 1, 0, with the sums 2 and 0. Unsigned sums differ where w = −1 and nowhere else. *They
are equal at all crossings exactly if no two cells have winding numbers of opposite signs*: if w = −1 does not occur,
both neighbours of a cell with winding number 0 at any of its corners have the same sign, so all its neighbours have,
and no way from cell to cell changes sign. A difference thus proves that there is no disk. Equality proves nothing:
Pascal's limaçon passes, as it turns twice, and so do curves that turn once and bound no disk.

References
----------
.. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
   Sketch-Based Interfaces and Modeling, 2011.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints

__all__ = ["border_differences", "cells_around_crossings", "diagonal_differences", "diagonal_sums"]


def cells_around_crossings(arrangement: Arrangement) -> Ints:
    """Return the four cells around each crossing.

    Parameters
    ----------
    arrangement : Arrangement

    Returns
    -------
    (k, 4) int
        Counter-clockwise from the cell on the right of both strands, crossings in the arrangement's order. The first
        and third are opposite each other, and so are the second and fourth.

    Examples
    --------
    >>> limacon = Arrangement.from_gauss([1, 0], [True, False], outer=1)
    >>> limacon.winding[cells_around_crossings(limacon)].tolist()
    [[0, 1, 2, 1]]
    """
    n = arrangement.n_borders
    a = np.flatnonzero(arrangement.ccw)
    a = a[np.argsort(arrangement.crossing_of_visit[a])]
    b = arrangement.partner[a]
    left, right = arrangement.left_cell, arrangement.right_cell
    # Strand b crosses strand a from right to left: a goes out between the bottom cell and the side on its left.
    return np.stack([right[a], left[a], left[(a - 1) % n], left[(b - 1) % n]], axis=1)


def border_differences(arrangement: Arrangement) -> Ints:
    """Return the winding number on the left of each border less that on its right: always 1.

    Parameters
    ----------
    arrangement : Arrangement

    Returns
    -------
    (borders,) int

    Examples
    --------
    >>> border_differences(Arrangement.from_gauss([1, 0], [True, False], outer=1)).tolist()
    [1, 1]
    """
    return np.asarray(arrangement.winding[arrangement.left_cell] - arrangement.winding[arrangement.right_cell])


def diagonal_differences(arrangement: Arrangement, *, unsigned: bool = False) -> Ints:
    """Return by how much opposite cells around each crossing differ: always 2 and 0.

    Parameters
    ----------
    arrangement : Arrangement
    unsigned : bool
        Take the absolute values of the winding numbers first.

    Returns
    -------
    (k, 2) int
        The pair left and right of both strands, and the pair between them; not negative. Unsigned, the first is 0 where
        the lower cell winds −1 times.

    Examples
    --------
    >>> eight = Arrangement.from_gauss([1, 0], [True, False], outer=3)
    >>> diagonal_differences(eight).tolist()
    [[2, 0]]
    """
    bottom, side, top, other_side = _windings(arrangement, unsigned)
    return np.asarray(np.abs(np.stack([top - bottom, side - other_side], axis=1)))


def diagonal_sums(arrangement: Arrangement, *, unsigned: bool = False) -> Ints:
    """Return the sums of the winding numbers of opposite cells around each crossing (§2.4 of [MGR11]_).

    Parameters
    ----------
    arrangement : Arrangement
    unsigned : bool
        Take the absolute values of the winding numbers first, as in the paper's Figure 8.

    Returns
    -------
    (k, 2) int
        The pair left and right of both strands, and the pair between them. They are equal, whether or not the curve
        bounds a disk. Unsigned they differ exactly where the lowest of the four cells winds −1 times, so a difference
        proves that there is no disk, and equality proves nothing.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> from plyfold import arrange
    >>> eight = arrange([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> diagonal_sums(eight).tolist(), diagonal_sums(eight, unsigned=True).tolist()
    ([[0, 0]], [[2, 0]])
    """
    bottom, side, top, other_side = _windings(arrangement, unsigned)
    return np.stack([top + bottom, side + other_side], axis=1)


def _windings(arrangement: Arrangement, unsigned: bool) -> Ints:
    """Return the winding numbers around the crossings, one row for each of the four places."""
    winding = arrangement.winding[cells_around_crossings(arrangement)].T
    return np.asarray(np.abs(winding) if unsigned else winding)
