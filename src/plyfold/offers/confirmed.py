"""Whether a repaired outline, as it was drawn, covers what the winding numbers say that it should."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.errors import PrecisionError
from plyfold.mesh.refine import drawn_outline
from plyfold.offers.areas import areas_of
from plyfold.offers.greedy import covered
from plyfold.offers.rerouted import Rerouted

__all__ = ["confirm"]


def confirm(left: Rerouted, drawn: Arrangement, opening: Fraction, where: tuple[tuple[float, float], ...]) -> None:
    """Refuse a repaired outline that covers another area than its winding numbers say, or not as often.

    Parameters
    ----------
    left : Rerouted
        What is left of the given outline.
    drawn : Arrangement
        What was drawn of it, arranged anew.
    opening : Fraction
        How much of the ways is cut off at corners where runs were parted.
    where : tuple of (x, y)
        The places of the changes.

    Raises
    ------
    PrecisionError

    Notes
    -----
    O(n + k). Both areas are bounded, and so is all that may lie between what is left and what was drawn.
    """
    expected, found = left.plan.areas, areas_of(drawn)
    scale = 4.0 ** (expected.unit - found.unit)
    between = _most_between(left, drawn, opening)
    pairs = zip(covered(expected, left.winding), covered(found, drawn.winding.tolist()), strict=True)
    for one, other in pairs:
        if abs(one.rounded - scale * other.rounded) > between + one.error + scale * other.error:
            raise PrecisionError(
                "what a repair changes is not what it was to change",
                where=where,
                hint="take out the points around the places that are named",
            )


def _most_between(left: Rerouted, drawn: Arrangement, opening: Fraction) -> float:
    """Return what may lie between what is left and what was drawn, in the unit of areas, where ways are shorter than 2.

    That is what was cut off at two corners of each crossing where runs were parted, what was cut short at hairs and
    beside them, where corners at their ends were cut off, and what lies beside edges of which the ends are rounded, or
    were moved since strands touch.
    """
    plan, n_parted, unit = left.plan, len(left.parted), left.plan.areas.unit
    off = sum(_most_off(each, unit) for each in (plan.drawn, drawn))
    length = sum(_length(each, unit) for each in (plan.drawn, drawn))
    at_corners = n_parted * 2 * (2 * float(opening) ** 2 + plan.narrow(2.0) + off)
    return at_corners + 4 * float(opening) * left.cut_short + 2 * off * length


def _most_off(drawn: Arrangement, unit: int) -> float:
    """Return how far points of a drawing may be from where they were given, or would be if not rounded."""
    outline, given = drawn_outline(drawn).points, drawn.given
    assert given is not None
    rounding = np.spacing(np.abs(outline).max())
    return float(np.ldexp(rounding + np.abs(outline - given.points).max(), unit))


def _length(drawn: Arrangement, unit: int) -> float:
    outline = drawn_outline(drawn)
    points = np.ldexp(outline.points, unit)
    return float(np.hypot(*(points[outline.next_point] - points).T).sum())
