"""Every closed curve on the sphere, drawn crossing by crossing: each with its start and direction exactly once.

Cut a curve at one of its points, its *start*, and draw it from there: what has been drawn is an *open curve*, whose
*tip* lies inside a cell. It goes on by crossing one of the darts of that cell. Cells are disks, so it does not matter
how it gets there, and every open curve arises once. It closes, in one way, when its tip lies in the cell of its start.

An open curve with i crossings is a row of 2i visits, ``partner`` and ``ccw`` as everywhere, and has 2i + 1 borders:
border j ends at visit j, border 0 begins at the start, and border 2i ends at the tip. Many are drawn at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from plyfold.arrays import Bools, Ints, Signs

__all__ = ["OpenCurves", "closed_curves", "every_way_on", "one_crossing"]

# So many rows at once keep everything in the caches of a processor.
_MOST_ROWS = 1 << 13


@dataclass(frozen=True)
class OpenCurves:
    """Open curves with the same number of crossings, one in every row.

    Attributes
    ----------
    partner, ccw : (n, 2i) int8, bool
        As in Gauss codes.
    """

    partner: Signs
    ccw: Bools

    @property
    def n_visits(self) -> int:
        """Number of visits of each."""
        return int(self.partner.shape[1])

    def __len__(self) -> int:
        return len(self.partner)

    def rows(self, rows: Ints | Bools | slice) -> OpenCurves:
        """Return some of them."""
        return OpenCurves(self.partner[rows], self.ccw[rows])


def one_crossing() -> OpenCurves:
    """Return the open curve with one crossing, of two mirror images the one that turns left."""
    return OpenCurves(np.array([[1, 0]], dtype=np.int8), np.array([[False, True]]))


def every_way_on(curves: OpenCurves) -> OpenCurves:
    """Return all open curves that begin with given ones and have one crossing more."""
    return _crossed(curves, *_ways(curves))


def closed_curves(begun: OpenCurves, n_crossings: int) -> Iterator[OpenCurves]:
    """Yield, batch by batch, the closed curves on the sphere that begin with given open curves.

    Parameters
    ----------
    begun : OpenCurves
        With at most ``n_crossings`` crossings.
    n_crossings : int
        Of the closed curves. Their last border joins their first.

    Yields
    ------
    OpenCurves
    """
    if begun.n_visits == 2 * n_crossings:
        yield begun.rows(_closes(begun))
        return
    for first in range(0, len(begun), _MOST_ROWS):
        batch = begun.rows(slice(first, first + _MOST_ROWS))
        rows, darts = _ways(batch)
        if begun.n_visits == 2 * n_crossings - 2:
            homeward = _in_cell(_next_darts(batch), 0)[rows, darts ^ 1]
            rows, darts = rows[homeward], darts[homeward]
        yield from closed_curves(_crossed(batch, rows, darts), n_crossings)


def _next_darts(curves: OpenCurves) -> Ints:
    """Return for every dart the next one of its cell: at crossings turn left, at both ends turn round."""
    partner, ccw = curves.partner.astype(np.int64), curves.ccw
    following = np.empty((len(curves), 2 * curves.n_visits + 2), dtype=np.int64)
    out, back = 2 * partner + 2, 2 * partner + 1
    following[:, 0:-2:2] = np.where(ccw, out, back)
    following[:, 3::2] = np.where(ccw, back, out)
    following[:, 1], following[:, -2] = 0, 2 * curves.n_visits + 1
    return following


def _ways(curves: OpenCurves) -> tuple[Ints, Ints]:
    """Return the rows and darts of all ways to go on: the darts round the tips."""
    rows, darts = np.nonzero(_in_cell(_next_darts(curves), 2 * curves.n_visits))
    return rows, darts


def _in_cell(following: Ints, dart: int) -> Bools:
    """Tell of every dart whether it belongs to the same cell as a given one."""
    inside = np.zeros(following.shape, dtype=bool)
    rows, walked = np.arange(len(following)), np.full(len(following), dart)
    while len(rows):
        inside[rows, walked] = True
        walked = following[rows, walked]
        on = walked != dart
        rows, walked = rows[on], walked[on]
    return inside


def _closes(curves: OpenCurves) -> Bools:
    """Tell which tips lie in the cell of the start."""
    return _in_cell(_next_darts(curves), 2 * curves.n_visits)[:, 0]


def _crossed(curves: OpenCurves, rows: Ints, darts: Ints) -> OpenCurves:
    """Return the open curves after one more crossing, out of the cell on the left of a dart."""
    n = curves.n_visits
    place, forward = (darts >> 1)[:, None], darts & 1 == 0
    partner = np.empty((len(rows), n + 2), dtype=np.int8)
    ccw = np.empty((len(rows), n + 2), dtype=bool)
    old = curves.partner[rows]
    old += old >= place
    columns = np.arange(n + 1)
    is_new = columns == place
    kept = np.broadcast_to(~is_new, is_new.shape)
    partner[:, :-1][kept], ccw[:, :-1][kept] = old.ravel(), curves.ccw[rows].ravel()
    partner[:, :-1][is_new], ccw[:, :-1][is_new] = n + 1, ~forward
    partner[:, -1], ccw[:, -1] = place[:, 0], forward
    return OpenCurves(partner, ccw)
