"""The verdict alone: whether an outline bounds a disk. Small curves are decided before more than numpy is imported."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from plyfold.core.buffers import flat
from plyfold.core.verdict import NOT_TOLD, YES, decide

if TYPE_CHECKING:
    from plyfold.arrays import Floats
    from plyfold.outline.given import OutlineLike

__all__ = ["bounds_disk", "plain_points"]

# Every whole number up to this one is a double.
_LARGEST_EXACT_INTEGER = 2**53


def bounds_disk(curve: OutlineLike, touching: bool = True) -> bool:
    """Tell whether an outline is that of a disk of cloth laid flat on a table.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    touching : bool, optional
        Whether a disk may touch itself, in a point or along a strand that is walked twice: then the outline is a limit
        of outlines of disks, though it may not be one itself.

    Returns
    -------
    bool
        Exact. False for several curves, and for one that bounds a disk with handles. See
        :func:`~plyfold.find_immersion` for the reason and the cost. A "no" about a curve that touches itself comes
        before its points move, where its turning or winding numbers tell.

    Notes
    -----
    Points that draw a curve in general position go through the stages one after the other without a value between,
    and what these leave open, and all that is no such points, goes through values. Either way it is the same stages.

    Examples
    --------
    >>> bounds_disk([(0, 0), (2, 2), (2, 0), (0, 2)])
    False
    >>> two_triangles = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
    >>> bounds_disk(two_triangles), bounds_disk(two_triangles, touching=False)
    (True, False)
    """
    points = plain_points(curve)
    told = NOT_TOLD if points is None else decide(flat(points), _go_on)
    if told != NOT_TOLD:
        return told == YES
    from plyfold.immersion.solve import bounds_disk_by_values

    return bounds_disk_by_values(curve, touching)


def _go_on() -> None:
    """Let Python look for a Ctrl-C, as it does at every call."""


def plain_points(curve: object) -> Floats | None:
    """Return a copy of what plainly are points of shape (n, 2); None for all else, be it an outline or not."""
    if type(curve) is not np.ndarray:
        if not isinstance(curve, list | tuple):
            return None
        try:
            curve = np.asarray(curve)
        except ValueError:
            return None
    return _doubles(curve)


def _doubles(raw: npt.NDArray[Any]) -> Floats | None:
    if raw.ndim != 2 or raw.shape[1] != 2:
        return None
    if raw.dtype == np.float64:
        return raw + 0.0
    is_exact = raw.dtype == np.int64 and len(raw) and max(-raw.min(), raw.max()) < _LARGEST_EXACT_INTEGER
    return raw + 0.0 if is_exact else None
