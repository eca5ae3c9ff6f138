"""Planar diagrams (PD codes) of knots, as KnotTheory, SnapPy and Spherogram write them: four labels for each crossing.

The labels name the edges around a crossing, counter-clockwise, beginning with the one on which the strand below comes
in. Every label stands twice in all.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.planar_map import next_darts
from plyfold.arrays import Bools, Ints
from plyfold.errors import GaussCodeError

__all__ = ["gauss_of_diagram", "largest_cell"]

_HINT = "a planar diagram has four labels for each crossing, each label twice, as in [(1, 4, 2, 5), (3, 6, 4, 1), ...]"
_NUMBER = re.compile(r"\d+")


def gauss_of_diagram(diagram: str | npt.ArrayLike) -> tuple[Ints, Bools, Bools]:
    """Follow the strand through a planar diagram, from the edge that is named first on.

    Parameters
    ----------
    diagram : (k, 4) array_like of int, or text of such

    Returns
    -------
    partner : (2k,) int
    ccw : (2k,) bool
        As in a :class:`~plyfold.GaussCode`.
    over : (2k,) bool
        Whether the strand passes over, by visits.

    Raises
    ------
    GaussCodeError
        If it is no planar diagram, or one of several curves.

    Examples
    --------
    >>> partner, ccw, over = gauss_of_diagram("PD[X[1, 4, 2, 5], X[3, 6, 4, 1], X[5, 2, 6, 3]]")
    >>> partner.tolist(), over.tolist()
    ([3, 4, 5, 0, 1, 2], [False, True, False, True, False, True])
    """
    labels = _labels(diagram)
    entered = _followed(_other_ends(labels.ravel()))
    crossing, side = np.divmod(entered, 4)
    visits = np.argsort(crossing, kind="stable").reshape(-1, 2)
    partner = np.empty(len(entered), dtype=np.int64)
    partner[visits] = visits[:, ::-1]
    # On the right of a strand that comes in on one side is the next side.
    return partner, np.asarray(side[partner] == (side + 1) % 4), np.asarray(side % 2 == 1)


def _labels(diagram: str | npt.ArrayLike) -> Ints:
    if isinstance(diagram, str):
        numbers = [int(number) for number in _NUMBER.findall(diagram)]
        if len(numbers) % 4:
            raise GaussCodeError(f"{len(numbers)} labels are not four for each crossing", hint=_HINT)
        diagram = np.reshape(numbers, (-1, 4))
    try:
        labels = np.asarray(diagram)
    except ValueError as error:
        raise GaussCodeError("not all crossings have four labels", hint=_HINT) from error
    if labels.ndim != 2 or labels.shape[1] != 4 or labels.dtype.kind not in "iu" or not len(labels):
        raise GaussCodeError(f"this is no planar diagram: its shape is {labels.shape}", hint=_HINT)
    return labels.astype(np.int64)


def _other_ends(labels: Ints) -> Ints:
    """Return for each end of an edge at a crossing, four to a crossing, the other end of the edge."""
    names, count = np.unique(labels, return_counts=True)
    if (count != 2).any():
        wrong = int(np.argmax(count != 2))
        raise GaussCodeError(f"label {names[wrong]} stands there {count[wrong]} times, not twice", hint=_HINT)
    ends = np.argsort(labels, kind="stable").reshape(-1, 2)
    other = np.empty(len(labels), dtype=np.int64)
    other[ends] = ends[:, ::-1]
    return other


def _followed(other: Ints) -> Ints:
    """Return the ends at which the strand comes into crossings, in order."""
    entered = [0]
    while True:
        left = entered[-1] ^ 2  # straight on
        following = int(other[left])
        if following == entered[0]:
            break
        entered.append(following)
    if 2 * len(entered) != len(other):
        raise GaussCodeError("the diagram has several curves, and a Gauss code is of one", hint="give one of its knots")
    return np.array(entered)


def largest_cell(partner: Ints, ccw: Bools) -> int:
    """Return a dart of the cell with most borders; of several the one with the lowest dart.

    Examples
    --------
    >>> largest_cell(np.array([3, 4, 5, 0, 1, 2]), np.array([True, False, True, False, True, False]))
    1
    """
    following = next_darts(partner, ccw).tolist()
    cells: list[Sequence[int]] = []
    waiting = dict.fromkeys(range(len(following)))
    while waiting:
        dart = next(iter(waiting))
        cell = []
        while dart in waiting:
            waiting.pop(dart)
            cell.append(dart)
            dart = following[dart]
        cells.append(cell)
    return max(cells, key=len)[0]
