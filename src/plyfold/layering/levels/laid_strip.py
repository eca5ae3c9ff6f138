"""The strip of a ribbon with heights, over the arrangement of its outline."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrays import Floats, Ints, Reals
from plyfold.errors import PrecisionError
from plyfold.outline.ribbons.ribbon import Ribbon
from plyfold.predicates import exact_parameter, orient

__all__ = ["LaidStrip", "height_on_edge", "laid_strip"]


class LaidStrip(NamedTuple):
    """The strip of a ribbon in the plane, with its points in general position.

    Parameters
    ----------
    arranged : Arrangement
    points, given : (n, 2) float
        As moved, in doubles or fractions, and as they were given.
    next_point : (n,) int
        Where the edge ends that starts at each point.
    heights : (n,) float
    faces : (t, 3) int
    own_face : (n,) int
        The triangle at the edge that starts at each point.
    share : dict
        Of each visit to a crossing, where on its edge it is.
    """

    arranged: Arrangement
    points: Reals
    given: Floats
    next_point: Ints
    heights: Floats
    faces: Ints
    own_face: Ints
    share: dict[int, Fraction]


def laid_strip(ribbon: Ribbon) -> LaidStrip:
    """Return the strip of a ribbon with heights; refuse one that infinitely small moves would fold."""
    arranged = arrange(ribbon.outline)
    assert arranged.outline is not None
    assert arranged.given is not None
    assert ribbon.heights is not None
    points, following = arranged.exact_points, arranged.outline.next_point
    folded = ribbon.faces[orient(*points[ribbon.faces].transpose(1, 0, 2)) <= 0]
    if len(folded):
        raise PrecisionError("the ribbon touches itself where it is too thin", where=points[folded[0, :1]])
    start, end = ribbon.faces.ravel(), np.roll(ribbon.faces, -1, axis=1).ravel()
    on_outline = following[start] == end
    own_face = np.empty(len(points), dtype=np.int64)
    own_face[start[on_outline]] = np.flatnonzero(on_outline) // 3
    share = _shares(arranged, points, following)
    return LaidStrip(arranged, points, arranged.given.points, following, ribbon.heights, ribbon.faces, own_face, share)


def _shares(arranged: Arrangement, points: Reals, following: Ints) -> dict[int, Fraction]:
    visits = arranged.crossing_visits
    edge, other = arranged.visit_edge[visits], arranged.visit_edge[arranged.partner[visits]]
    ends = zip(points[edge], points[following[edge]], points[other], points[following[other]], strict=True)
    return {visit: exact_parameter(*four) for visit, four in zip(visits.tolist(), ends, strict=True)}


def height_on_edge(strip: LaidStrip, edge: int, share: Fraction) -> Fraction:
    """Return the height at a place on an edge of the outline."""
    start, end = strip.heights[[edge, strip.next_point[edge]]].tolist()
    return (1 - share) * Fraction(start) + share * Fraction(end)
