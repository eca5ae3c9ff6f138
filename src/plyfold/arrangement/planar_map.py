"""Planar maps of closed curves from their crossings alone: darts, cells, winding and turning numbers.

Geometry ends here. The code of one curve is ``partner`` (2k), ``ccw`` (2k) and one dart ``outer`` of the unbounded
cell; of several curves one must know, besides, where each begins, and which lies inside which. See CONVENTIONS.md. The
boundaries of cells are the orbits of *turn left at every crossing*.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Bools, Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.cells import follow_darts, list_darts, walk_cells, walk_joined_cells
from plyfold.errors import GaussCodeError

__all__ = [
    "borders_at_visits",
    "cell_boundaries",
    "checked_code",
    "darts_by_cell",
    "joined_cells",
    "next_darts",
    "number_of_borders",
    "reversed_code",
]


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


def borders_at_visits(first_visit: Ints) -> tuple[Ints, Ints]:
    """Return the borders that end and that start at each visit, given the first visit of each loop and their number.

    Borders are numbered loop by loop. A loop without visits has one all the same.

    Examples
    --------
    >>> [border.tolist() for border in borders_at_visits(np.array([0, 2, 2, 5]))]
    [[1, 0, 5, 3, 4], [0, 1, 3, 4, 5]]
    """
    if len(first_visit) == 2:  # one loop: as below, in a fifth of the time
        after = np.arange(first_visit[1])
        return (after - 1) % max(len(after), 1), after
    first, visits = first_visit[:-1], first_visit[1:] - first_visit[:-1]
    lonely = visits == 0
    after = np.arange(first_visit[-1]) + (lonely.cumsum() - lonely).repeat(visits)
    before, crossed = after - 1, visits > 0
    before[first[crossed]] += visits[crossed]
    return before, after


def number_of_borders(first_visit: Ints) -> int:
    """Return how many borders loops have, given the first visit of each and their number."""
    return int(np.maximum(first_visit[1:] - first_visit[:-1], 1).sum())


def next_darts(partner: Ints, ccw: Bools, first_visit: Ints | None = None) -> Ints:
    """Return the dart that follows each dart around the cell on its left, of one loop or of several.

    On arrival at a visit, turn left: onto the other strand's outgoing border if that strand crosses ours from right
    to left, back along its incoming border otherwise. At a mark, which is its own partner, go on. A loop without visits
    follows itself.
    """
    first_visit = np.array([0, len(partner)]) if first_visit is None else first_visit
    following = np.empty(2 * number_of_borders(first_visit), dtype=np.int64)
    room = np.empty(2 * len(partner), dtype=np.int64)
    follow_darts(*all_flat(partner, ccw.view(np.uint8), first_visit, following, room))
    return following


def cell_boundaries(following: Ints, outer: int) -> tuple[Ints, Ints, Ints]:
    """Return the orbits around all cells, that of the unbounded one first, the others by their lowest darts.

    Where loops hang together they are the boundaries of the cells; otherwise cells have several, which
    :func:`joined_cells` brings together.

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
    cell_of_dart : (darts,) int

    Notes
    -----
    O(darts).
    """
    darts, start = np.empty((2, len(following)), dtype=np.int64)
    cell = np.full(len(following), -1)
    cells = walk_cells(flat(following), outer, flat(darts), flat(start), flat(cell))
    return np.concatenate([start[:cells], [len(following)]]), darts, cell


def joined_cells(following: Ints, outside: Ints, same_cell: Ints) -> tuple[Ints, Ints, Ints]:
    """Return what :func:`cell_boundaries` does, of cells of which some have several orbits.

    Parameters
    ----------
    following : (darts,) int
        The dart after each dart around the cell on its left.
    outside : (o,) int
        Darts of the unbounded cell.
    same_cell : (m, 2) int
        Pairs of darts on the boundary of the same cell.

    Notes
    -----
    O(darts). The orbits of a cell follow each other by their lowest darts.
    """
    darts, start, cell = np.empty((3, len(following)), dtype=np.int64)
    cells = walk_joined_cells(*all_flat(following, outside, same_cell, darts, start, cell))
    return np.concatenate([start[:cells], [len(following)]]), darts, cell


def darts_by_cell(following: Ints, cell_of_dart: Ints, cells: int) -> tuple[Ints, Ints]:
    """Return the boundaries of cells that have numbers already, as :func:`cell_boundaries` does."""
    darts, start = np.empty_like(following), np.empty(cells + 1, dtype=np.int64)
    list_darts(flat(following), flat(cell_of_dart), cells, flat(darts), flat(start))
    start[cells] = len(following)
    return start, darts


def reversed_code(partner: Ints, ccw: Bools, outer: int) -> tuple[Ints, Bools, int]:
    """Return the code of the same curve run the other way, from the same starting point."""
    n = len(partner)
    border, backward = divmod(outer, 2)
    return n - 1 - partner[::-1], ccw[::-1].copy(), 2 * ((-2 - border) % max(n, 1)) + (1 - backward)
