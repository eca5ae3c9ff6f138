"""The small lobe that keeps a curve from being the outline of a disk, and the curve without it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import PlyfoldError
from plyfold.immersion.shorter_lobes import MOST_CROSSINGS, Lobe, is_inside, lobes_to_leave_out, places_of
from plyfold.immersion.solve import bounds_disk
from plyfold.outline.curve import Curve

__all__ = ["Kink", "find_kink"]

# How many lobes are left out in earnest.
_MOST_TRIED = 16


@dataclass(frozen=True, eq=False)
class Kink:
    """Lobes of the curve, each from a crossing back to it: one as a rule, two if only both can be the cause.

    Parameters
    ----------
    places : tuple of (x, y)
        The crossings.
    lobes : tuple of (m, 2) float
        The lobes, each from its crossing on, closed implicitly.
    rest : (n, 2) float
        The curve without them, with corners at the crossings.
    """

    places: tuple[tuple[float, float], ...]
    lobes: tuple[Floats, ...]
    rest: Floats


def find_kink(drawn: Arrangement) -> Kink | None:
    """Return the shortest lobe of at most half the curve's length that can be left out to leave a disk, or two of them.

    Parameters
    ----------
    drawn : Arrangement
        With a drawing; it bounds no disk.

    Returns
    -------
    Kink or None
        What is left has been decided anew. Of the 64 shortest lobes, and then of pairs of the 24 shortest, those come
        in question that leave a curve which turns once and has no negative winding number. The first sixteen of them
        are tried, fewer where the curve has hundreds of crossings.

    Notes
    -----
    A few milliseconds for 30 crossings.

    Examples
    --------
    >>> from plyfold import arrange
    >>> curl = arrange([(0, 0), (6, 0), (6, 3), (5, 3), (5, -1), (7, -1), (7, 6), (0, 6)])
    >>> curl.turning_number, find_kink(curl).places
    (2, ((5.0, 0.0),))
    """
    tries = min(_MOST_TRIED, MOST_CROSSINGS // max(drawn.n_crossings, 1))
    kinks = (_without(drawn, lobes) for lobes in islice(lobes_to_leave_out(drawn), tries))
    return next((kink for kink in kinks if _is_disk(kink.rest)), None)


def _without(drawn: Arrangement, lobes: list[Lobe]) -> Kink:
    borders = np.arange(drawn.n_borders)
    places = places_of(drawn, [lobe.first for lobe in lobes])
    left_out = tuple(_along(drawn, lobe.first + borders, is_inside(drawn, lobe)) for lobe in lobes)
    kept = ~np.any([is_inside(drawn, lobe) for lobe in lobes], axis=0)
    return Kink(places, left_out, _along(drawn, borders, kept))


def _along(drawn: Arrangement, order: Ints, kept: Bools) -> Floats:
    """Return the curve along the borders that are kept, with corners where others are left out.

    Of the crossings only these corners stay: the others are rounded, and would bend the edges they lie on.
    """
    pieces = []
    for border in (order % drawn.n_borders).tolist():
        if kept[border]:
            points = drawn.border_points(border)
            pieces.append(points[1 if kept[border - 1] else 0 : -1])
    return np.concatenate(pieces)


def _is_disk(points: Floats) -> bool:
    try:
        return bounds_disk(Curve(points))
    except PlyfoldError:  # what is left is no curve at all
        return False
