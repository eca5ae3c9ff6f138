"""The planar map of a closed curve from its signed Gauss code alone: darts, cells, winding and turning numbers.

Geometry ends here. A code is ``partner`` (2k), ``ccw`` (2k) and one dart ``outer`` of the unbounded cell; see
CONVENTIONS.md. The cells are the orbits of *turn left at every crossing*.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

__all__ = ["label_cells", "left_windings", "next_darts", "reversed_code", "whitney_turning_number"]

Ints: TypeAlias = npt.NDArray[np.int64]
Bools: TypeAlias = npt.NDArray[np.bool_]


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


def label_cells(following: Ints, outer: int) -> Ints:
    """Return the cell on the left of each dart; the unbounded cell is 0, the others follow by their lowest dart."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    n = len(following)
    graph = coo_array((np.ones(n, dtype=np.int8), (np.arange(n), following)), shape=(n, n))
    label = connected_components(graph, directed=False)[1].astype(np.int64)
    unbounded = label[outer]
    return np.where(label == unbounded, 0, label + (label < unbounded))


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
