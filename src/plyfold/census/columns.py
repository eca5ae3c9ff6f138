"""What every plane curve of the census bounds, as columns of a table."""

from __future__ import annotations

from typing import cast

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools
from plyfold.census.plane_curves import PlaneCurves
from plyfold.homotopy.homotopy import least_homotopy
from plyfold.immersion.solve import immersions
from plyfold.layering.orders.counting import count_layerings
from plyfold.tables.table import Column, DataTable

__all__ = ["census_table"]

_LETTERS = np.frombuffer(b"abcdefghijklmnopqrstuvwxyz", dtype=np.uint8)


def census_table(curves: PlaneCurves, homotopies: bool = False) -> DataTable:
    """Return one row for every curve.

    Parameters
    ----------
    curves : PlaneCurves
    homotopies : bool, optional
        Add the columns of :func:`~plyfold.least_homotopy`, which takes about a millisecond for each curve. False by
        default.

    Returns
    -------
    DataTable
        ``code``, text that :meth:`GaussCode.parse` reads; ``turning``, the turning number without its sign; ``lowest``
        and ``highest``, the least and the greatest winding number; ``symmetries``, how many of the 8k ways to name the
        curve (starts, directions, mirror images) are the same; ``immersions`` of disks; ``lifting``, how many of these
        can be layered; ``layerings`` of all of them together. With ``homotopies`` also ``swept``, how many cells the
        least homotopy sweeps, each as often as it does; ``unavoidable``, the sum of all winding numbers without signs,
        which is never more; and ``branch_points`` of the disk that the curve bounds, missing
        if it bounds none, be it branched or not.

    Notes
    -----
    A curve is oriented so that its turning number is positive, or, if that is 0, as it comes.

    Examples
    --------
    >>> from plyfold.census import plane_curves
    >>> table = census_table(next(plane_curves(2)))
    >>> next(row for row in table.rows() if row["immersions"])["layerings"]
    2
    """
    back = curves.turning < 0
    decided = np.zeros((len(curves), 3), dtype=np.int64)
    for row in np.flatnonzero(_may_bound_disk(curves)):
        decided[row] = _decided(Arrangement.from_gauss(curves.partner[row], curves.ccw[row], curves.outer[row]))
    told = {} if not homotopies else _contracted(curves)
    return DataTable(
        {
            "code": codes_as_text(curves),
            "turning": abs(curves.turning).astype(np.int8),
            "lowest": np.where(back, -curves.highest, curves.lowest).astype(np.int8),
            "highest": np.where(back, -curves.lowest, curves.highest).astype(np.int8),
            "symmetries": curves.n_symmetries.astype(np.int16),
            "immersions": decided[:, 0],
            "lifting": decided[:, 1],
            "layerings": decided[:, 2],
            **told,
        }
    )


def _contracted(curves: PlaneCurves) -> dict[str, Column]:
    """Return what the least homotopies of curves sweep, and the branch points of disks that they bound."""
    swept, branch_points = np.zeros((len(curves), 2), dtype=np.int32), np.full(len(curves), -1, dtype=np.int8)
    for row in range(len(curves)):
        found = least_homotopy(Arrangement.from_gauss(curves.partner[row], curves.ccw[row], curves.outer[row]))
        swept[row] = found.swept.sum(), abs(found.arrangement.winding).sum()
        if found.branch_points is not None:
            branch_points[row] = found.branch_points
    missing = branch_points < 0
    return {
        "swept": swept[:, 0],
        "unavoidable": swept[:, 1],
        "branch_points": np.ma.MaskedArray(branch_points, missing),
    }


def _may_bound_disk(curves: PlaneCurves) -> Bools:
    """Tell which curves turn once and wind nowhere the other way round."""
    forward = (curves.turning == 1) & (curves.lowest == 0)
    backward = (curves.turning == -1) & (curves.highest == 0)
    return np.asarray(forward | backward)


def _decided(arranged: Arrangement) -> tuple[int, int, int]:
    """Count the immersions of a curve, those that lift, and their layerings."""
    # Without a time limit, nothing is unknown.
    layerings = [cast("int", count_layerings(immersion)) for immersion in immersions(arranged)]
    return len(layerings), sum(map(bool, layerings)), sum(layerings)


def codes_as_text(curves: PlaneCurves) -> Column:
    """Return the Gauss codes as text: crossings are letters in the order of the curve, without spaces."""
    n, visits = curves.partner.shape
    first = np.minimum(curves.partner, np.arange(visits))
    label = (first == np.arange(visits)).cumsum(axis=1) - 1
    label = np.take_along_axis(label, first.astype(np.int64), axis=1)
    written = np.empty((n, visits, 2), dtype=np.uint8)
    written[:, :, 0] = _LETTERS[label]
    written[:, :, 1] = np.where(curves.ccw, ord("+"), ord("-"))
    text = written.reshape(n, 2 * visits).view(f"S{2 * visits}")[:, 0] if visits else np.zeros(n, dtype="S1")
    return np.char.add(np.char.add(text, b" / outer "), curves.outer.astype("S"))
