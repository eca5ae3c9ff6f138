"""How often a closed curve covers each part of the plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import CurveLike, arrange
from plyfold.flat.polygons import outlined

if TYPE_CHECKING:
    from shapely import Polygon

__all__ = ["Covered", "coverage"]


class Covered(NamedTuple):
    """A cell, and how often the curve goes round it, counter-clockwise in the direction of its arrangement."""

    polygon: Polygon
    winding: int


def coverage(curve: CurveLike) -> list[Covered]:
    """Return the cells that a closed curve winds round, with their winding numbers.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
        Any closed curve, whether it bounds a disk or not.

    Returns
    -------
    list of Covered
        Pairs (polygon, winding), in the order of the arrangement's cells; those with winding number 0 are left out.
        The polygons are valid and do not overlap; one that touches itself at a crossing has a hole that touches its
        outline there. Crossings are rounded to double precision.

        The signs are those of the direction in which the turning number is not negative: of the points as given, or,
        if ``arrangement(curve).reversed``, of the curve turned round. In the other direction they are the opposite.

    Raises
    ------
    PrecisionError
        If a polygon is no longer valid with its crossings rounded; it names the place.

    Notes
    -----
    O((n + k) log n) for n points and k crossings.

    Examples
    --------
    >>> eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
    >>> [(cell.polygon.area, cell.winding) for cell in coverage(eight)]
    [(1.0, -1), (1.0, 1)]
    >>> clockwise = [(0, 0), (0, 1), (1, 1), (1, 0)]
    >>> coverage(clockwise)[0].winding, arrange(clockwise).reversed
    (1, True)
    """
    drawn = arrange(curve)
    wound = np.flatnonzero(drawn.winding).tolist()
    polygons = outlined(drawn, [drawn.cells[cell] for cell in wound])
    return [Covered(*pair) for pair in zip(polygons, drawn.winding[wound].tolist(), strict=True)]
