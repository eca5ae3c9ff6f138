"""The distance of sheets that lie over each other: as it is asked for, or one that fits the cloth."""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.polylines import signed_areas
from plyfold.errors import InputError, PlyfoldError
from plyfold.mesh.refine import given_outline
from plyfold.options import refuse_unless_number
from plyfold.outline.curve import Outline
from plyfold.ragged import next_in_rows

__all__ = ["fitting_gap", "gap_over"]

# Of the drawing's larger side, and of the mean width of the cloth: where cloth turns back over itself, it climbs a gap
# on a way of some widths, and so narrow cloth would be steep.
_OF_SIZE, _OF_WIDTH = 0.05, 0.2
_LARGEST_OF_SIZE = 1000.0


def gap_over(drawn: Arrangement, gap: float | None) -> float:
    """Return the gap over a drawing: as given, InputError if that is out of range, or else one that fits its cloth."""
    if drawn.outline is None:
        raise PlyfoldError(
            "a surface needs a drawing, and this is a Gauss code alone", hint="build it from points to lift it"
        )
    outline = given_outline(drawn)
    if gap is None:
        return fitting_gap(outline)
    refuse_unless_number("gap", gap)
    largest = _LARGEST_OF_SIZE * float(np.ptp(outline.points, axis=0).max())
    if not 0 < gap <= largest:
        raise InputError(f"the gap must be positive and at most {largest:g}, not {gap!r}")
    return float(gap)


def fitting_gap(outline: Outline) -> float:
    """Return the gap that fits the cloth: 1/20 of the drawing's larger side, or 1/5 of the mean width, if that is less.

    The mean width is twice the area of the cloth, which is what the loops wind round, by the length of the outline.

    Parameters
    ----------
    outline : Outline
        With the surface on the left.

    Returns
    -------
    float
        In units of the drawing. Cost: linear.

    Examples
    --------
    >>> from plyfold import Curve
    >>> fitting_gap(Curve([(0, 0), (4, 0), (4, 4), (0, 4)]))
    0.2
    >>> round(fitting_gap(Curve([(0, 0), (99, 0), (99, 1), (0, 1)])), 3)
    0.198
    """
    size = float(np.ptp(outline.points, axis=0).max())
    places, first = outline.points / size, outline.first_point
    length = np.hypot(*(places[next_in_rows(first)] - places).T).sum()
    width = 2 * float(signed_areas(places, first).sum() / length)
    # Where the outline touches itself all along, there may be no cloth, and rounding errors may leave less than that.
    return size * (min(_OF_SIZE, _OF_WIDTH * width) if width > 0 else _OF_SIZE)
