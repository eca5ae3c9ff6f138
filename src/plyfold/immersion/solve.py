"""Decide, count and list the immersions of a curve (§2.3 and §2.4 of the paper, after Blank)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from plyfold.arrangement import Arrangement, arrangement
from plyfold.arrangement.core import CurveLike
from plyfold.immersion.dual_tree import DualTree, grow_dual_tree
from plyfold.immersion.gluing import glue_sheets
from plyfold.immersion.grouping import count_groupings, list_groupings
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.word import ascending_cells, write_word
from plyfold.obstruction import Obstruction

__all__ = ["bounds_disk", "count_immersions", "find_immersion", "immersions"]

# Above this many ascending links, the conflict that an obstruction names is not made minimal.
_MINIMISE_UP_TO = 60


def find_immersion(curve: CurveLike) -> Immersion | Obstruction:
    """Find an immersed disk that has the curve as its boundary, or say why there is none (§2.3 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    Immersion or Obstruction
        The result is true if there is an immersion. An immersion has been checked against the definition. An
        obstruction names the theorem that fails: the turning number is not ±1, a cell has a negative winding number,
        or the exhausted word has no grouping.

    Raises
    ------
    CurveError
        If the input is not a closed curve.

    Notes
    -----
    Exact. After the crossings are known the cost is polynomial in their number; the decision follows [Bla67]_.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.
    .. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967.

    Examples
    --------
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> print(find_immersion(limacon))
    The curve turns 2 times, and the outline of a disk turns once.
    """
    arranged = arrangement(curve)
    obstruction = _visible_obstruction(arranged)
    if obstruction is not None:
        return obstruction
    return next(_immersions(arranged), None) or _no_grouping(arranged)


def immersions(curve: CurveLike) -> Iterator[Immersion]:
    """List all immersions of a curve, each once, in a stable order; nothing if there is none.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Yields
    ------
    Immersion
        There can be exponentially many; they are made one at a time, each in polynomial time.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> [len(immersion.disk_layout()) for immersion in immersions(milnor)]
    [9, 9]
    """
    arranged = arrangement(curve)
    if _visible_obstruction(arranged) is None:
        yield from _immersions(arranged)


def count_immersions(curve: CurveLike) -> int:
    """Count the immersions of a curve, exactly.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    int
        0 if the curve bounds no disk. Immersions that differ by a deformation of the disk count once. Cost: polynomial
        in the number of crossings, however large the answer.

    Examples
    --------
    >>> count_immersions([(0, 0), (1, 0), (0, 1)])
    1
    """
    arranged = arrangement(curve)
    if _visible_obstruction(arranged) is not None:
        return 0
    return count_groupings(write_word(grow_dual_tree(arranged)))[0]


def bounds_disk(curve: CurveLike) -> bool:
    """Tell whether a curve is the outline of a disk of cloth laid flat on a table.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    bool
        Exact. See :func:`find_immersion` for the reason.

    Examples
    --------
    >>> bounds_disk([(0, 0), (2, 2), (2, 0), (0, 2)])
    False
    """
    return count_immersions(curve) > 0


def _immersions(arranged: Arrangement) -> Iterator[Immersion]:
    tree = grow_dual_tree(arranged)
    word = write_word(tree)
    _, counts = count_groupings(word)
    for chords in list_groupings(word, counts):
        immersion = glue_sheets(arranged, tree, chords)
        immersion.check()
        yield immersion


def _visible_obstruction(arranged: Arrangement) -> Obstruction | None:
    """Return the obstruction that numbers alone show, if there is one: the turning number or a winding number."""
    turning = arranged.turning_number
    if turning != 1:
        sentence = f"The curve turns {turning} times, and the outline of a disk turns once."
        return Obstruction("turning number", sentence, value=turning)
    lowest = int(np.argmin(arranged.winding))
    winding = int(arranged.winding[lowest])
    if winding < 0:
        sentence = (
            f"The curve winds {winding} times around a cell, and cloth cannot cover it a negative number of times."
        )
        return Obstruction("negative winding", sentence, _places(arranged, [lowest]), winding)
    return None


def _places(arranged: Arrangement, cells: list[int]) -> tuple[tuple[float, float], ...]:
    return () if arranged.curve is None else tuple(arranged.cell_point(cell) for cell in cells)


def _no_grouping(arranged: Arrangement) -> Obstruction:
    tree = grow_dual_tree(arranged)
    cells = _conflict(tree)
    if len(cells) == 1:
        sentence = "No grouping: the way out of a cell can be joined to no border that would cut off a disk."
    else:
        sentence = f"No grouping: the ways out of {len(cells)} cells cannot be joined to borders without crossing."
    return Obstruction("no grouping", sentence, _places(arranged, cells), tuple(tree.link[cell] for cell in cells))


def _conflict(tree: DualTree) -> list[int]:
    """Return cells whose ascending links cannot all be joined; as few as leaving out one at a time can reach."""
    cells = ascending_cells(tree)
    for cell in cells if len(cells) <= _MINIMISE_UP_TO else ():
        fewer = [other for other in cells if other != cell]
        if count_groupings(write_word(tree, fewer))[0] == 0:
            cells = fewer
    return cells
