"""The planar map of a closed curve from its signed Gauss code alone: darts, cells, winding and turning numbers.

Geometry ends here. A code is ``partner`` (2k), ``ccw`` (2k) and one dart ``outer`` of the unbounded cell; see
CONVENTIONS.md. The cells are the orbits of *turn left at every crossing*.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Ints
from plyfold.compiled import run_loop
from plyfold.errors import GaussCodeError

__all__ = ["cell_boundaries", "checked_code", "left_windings", "next_darts", "reversed_code", "whitney_turning_number"]


def checked_code(partner: npt.ArrayLike, ccw: npt.ArrayLike, outer: int) -> tuple[Ints, Bools, int]:
    """Return a code as arrays if it is one, of whatever surface; raise a GaussCodeError that says why not."""
    visits, signs = _whole_numbers("partner", partner), _whole_numbers("ccw", ccw)
    if not np.isin(signs, [0, 1]).all():
        raise GaussCodeError("ccw holds something that is neither true nor false")
    n = len(visits)
    if len(signs) != n:
        raise GaussCodeError(f"partner has {n} visits and ccw has {len(signs)}")
    visit = np.arange(n)
    there = visits.clip(0, n - 1) if n else visits
    if (lonely := (visits != there) | (visits == visit) | (visits[there] != visit)).any():
        first = int(lonely.argmax())
        raise GaussCodeError(f"visit {first} and visit {visits[first]} are not each other's partner")
    if (same := signs == signs[visits]).any():
        first = int(same.argmax())
        raise GaussCodeError(f"visits {first} and {visits[first]} say that both strands cross from the same side")
    outer = whole_number("outer", outer)
    if not 0 <= outer < max(2 * n, 2):
        raise GaussCodeError(f"dart {outer} does not exist: there are {max(2 * n, 2)}")
    return visits, signs.astype(bool), outer


def whole_number(name: str, value: object) -> int:
    """Return a value as an int if it is a whole number, or refuse it by name."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise GaussCodeError(f"{name} must be a whole number, not {value!r}")
    return int(value)


def _whole_numbers(name: str, values: npt.ArrayLike) -> Ints:
    array = np.array(values)
    if array.ndim != 1 or (array.size and array.dtype.kind not in "biu"):
        raise GaussCodeError(f"{name} is not a list of whole numbers")
    return array.astype(np.int64)


def next_darts(partner: Ints, ccw: Bools) -> Ints:
    """Return the dart that follows each dart around the cell on its left.

    On arrival at a visit, turn left: onto the other strand's outgoing border if that strand crosses ours from right
    to left, back along its incoming border otherwise.
    """
    n = len(partner)
    if n == 0:
        return np.array([0, 1])
    arrival = np.arange(n)
    outgoing, incoming = 2 * partner, 2 * ((partner - 1) % n) + 1
    following = np.empty(2 * n, dtype=np.int64)
    following[2 * ((arrival - 1) % n)] = np.where(ccw, outgoing, incoming)
    following[2 * arrival + 1] = np.where(ccw, incoming, outgoing)
    return following


def cell_boundaries(following: Ints, outer: int) -> tuple[Ints, Ints]:
    """Return the boundaries of all cells, the unbounded one first, the others by their lowest darts.

    Parameters
    ----------
    following : (darts,) int
        The dart after each dart around the cell on its left.
    outer : int
        A dart of the unbounded cell.

    Returns
    -------
    cell_start : (cells + 1,) int
    cell_darts : (darts,) int
        The boundary of cell c is ``cell_darts[cell_start[c]:cell_start[c + 1]]``: its darts in order, the lowest first.

    Notes
    -----
    O(darts).
    """
    walked, darts, start = np.zeros((3, len(following)), dtype=np.int64)
    room = _Cells(darts, start, counted=np.zeros(1, dtype=np.int64))
    cells = run_loop(_walked, len(following), (_Map(following, np.array([outer]), walked),), room)
    return np.append(cells.start[: cells.counted[0]], len(following)), cells.darts


class _Map(NamedTuple):
    """The dart after each dart, one of the unbounded cell, and which have been walked."""

    following: Ints
    outer: Ints
    walked: Ints


class _Cells(NamedTuple):
    """The darts cell by cell, where each cell starts, and the number of cells."""

    darts: Ints
    start: Ints
    counted: Ints


def _walked(given: tuple[_Map], cells: _Cells) -> int:
    """Walk round every cell from its lowest dart, round the unbounded one first; return how many there are."""
    following, walked, outer = given[0].following, given[0].walked, given[0].outer[0]
    darts, start = cells.darts, cells.start
    lowest, dart = outer, following[outer]
    while dart != outer:
        lowest = min(lowest, dart)
        dart = following[dart]
    size = count = 0
    for place in range(-1, len(following)):
        dart = lowest if place < 0 else place
        if walked[dart] == 0:
            start[count] = size
            count += 1
            while walked[dart] == 0:
                walked[dart] = 1
                darts[size] = dart
                size += 1
                dart = following[dart]
    cells.counted[0] = count
    return count


def left_windings(ccw: Bools, outer: int) -> Ints:
    """Return the winding number on the left of each border.

    Past a crossing the curve leaves the left side of the other strand if that one crosses from right to left (one
    less), and enters it otherwise (one more).
    """
    relative = np.cumsum(np.where(ccw, -1, 1)) if len(ccw) else np.zeros(1, dtype=np.int64)
    border, backward = divmod(outer, 2)
    return np.asarray(relative - relative[border] + backward, dtype=np.int64)


def whitney_turning_number(partner: Ints, ccw: Bools, outer: int) -> int:
    """Return the turning number from the crossings alone.

    Start on a border of the unbounded cell. With that cell on the right, each crossing counts −1 if the strand met
    first is crossed from right to left, +1 otherwise, and τ is one more than the sum; with that cell on the left,
    everything is mirrored [Whi37]_.

    References
    ----------
    .. [Whi37] H. Whitney, "On regular closed curves in the plane", Compositio Mathematica 4, 1937.
    """
    border, backward = divmod(outer, 2)
    n = len(partner)
    since_start = (np.arange(n) - border - 1) % max(n, 1)
    met_first = since_start < since_start[partner]
    total = int(np.where(ccw[met_first], -1, 1).sum())
    return 1 + total if backward else total - 1


def reversed_code(partner: Ints, ccw: Bools, outer: int) -> tuple[Ints, Bools, int]:
    """Return the code of the same curve run the other way, from the same starting point."""
    n = len(partner)
    border, backward = divmod(outer, 2)
    return n - 1 - partner[::-1], ccw[::-1].copy(), 2 * ((-2 - border) % max(n, 1)) + (1 - backward)
