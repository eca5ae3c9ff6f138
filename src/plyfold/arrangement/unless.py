"""The arrangement of an outline, unless the points as given tell enough: moving them apart takes most of the time."""

from __future__ import annotations

from collections.abc import Callable

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.drawn import drawn_map
from plyfold.arrangement.general_position import InContact, moved_apart, without_contacts
from plyfold.clock import UNWATCHED
from plyfold.outline.given import OutlineLike, are_several, as_outline

__all__ = ["arrangement_unless"]


def arrangement_unless(curve: OutlineLike, is_enough: Callable[[InContact], bool]) -> Arrangement | None:
    """Return what :func:`~plyfold.arrange` does; None if an outline touches itself and what is known of it is enough.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry, Arrangement or GaussCode; or a list of curves
    is_enough : callable
        Told what is left of an outline in contact, before its points move.

    Examples
    --------
    >>> triangles = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
    >>> arrangement_unless(triangles, lambda found: found.noding.winding.min() < 0)
    <Arrangement of a curve of 6 points: 0 crossings, turning number 1>
    >>> print(arrangement_unless(triangles, lambda found: found.noding.winding.max() < 2))
    None
    """
    if isinstance(curve, Arrangement) or hasattr(curve, "partner") or are_several(curve):
        return arrange(curve)
    found = without_contacts(as_outline(curve), "perturb")
    if isinstance(found, InContact):
        if is_enough(found):
            return None
        found = moved_apart(found)
    return Arrangement.of_drawing(drawn_map(found, UNWATCHED))
