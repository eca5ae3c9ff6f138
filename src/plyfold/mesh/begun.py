"""An arrangement of an outline that touches itself, drawn with points that have only begun to move.

Whoever puts triangles or sheets over the moved outline back on the given points may find that these lie too far off,
with strands so near each other that they matter. Then the same arrangement is asked again with points that are
infinitely near the given ones. That takes fractions, and longer.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import cast

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Fractions, Ints
from plyfold.immersion.corners import feet
from plyfold.outline.curve import Outline, outline_of_points
from plyfold.predicates import exact_crossings

__all__ = ["drawings_of", "exact_visits"]


def drawings_of(arrangement: Arrangement) -> Iterator[Arrangement]:
    """Yield an arrangement as doubles show it, if they do; and if points were moved, as they have begun to.

    Examples
    --------
    >>> from plyfold import arrange
    >>> pinched = arrange([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)])
    >>> [drawn.is_begun for drawn in drawings_of(pinched)]
    [False, True]
    """
    yield arrangement
    if arrangement.begun is not None and not arrangement.is_begun:
        yield _as_begun(arrangement)


def _as_begun(arrangement: Arrangement) -> Arrangement:
    outline, given = cast("Outline", arrangement.outline), cast("Outline", arrangement.given)
    cusps = np.concatenate(outline.cusps)
    drawn = outline_of_points(given.points, given.loop_of_point, cusps, given.rows, outline.repairs)
    visits = arrangement.first_visits, np.flatnonzero(arrangement.crossing_of_visit < 0)
    crossings, marks = (exact_visits(arrangement, some).astype(np.float64) for some in visits)
    return replace(arrangement, outline=drawn, crossings=crossings, marks=marks)


def exact_visits(arrangement: Arrangement, visits: Ints) -> Fractions:
    """Return where some visits, in order, are when points have begun to move, shape (m, 2).

    Examples
    --------
    >>> from plyfold import arrange
    >>> pinched = arrange([(0, 0), (4, 0), (4, 2), (2, 2), (2, 1), (3, 1), (3, 2), (0, 2)])
    >>> exact_visits(pinched, pinched.crossing_visits).shape == (len(pinched.crossing_visits), 2)
    True
    """
    begun, next_point = cast("Fractions", arrangement.begun), cast("Outline", arrangement.outline).next_point
    edge, other = arrangement.visit_edge[np.stack([visits, arrangement.partner[visits]])]
    places, crosses = begun[edge], edge != other
    ends = begun[np.stack([edge, next_point[edge], other, next_point[other]])[:, crosses]]
    for axis in (0, 1):
        places[crosses, axis] = exact_crossings(ends, axis)
    corner, foot = feet(arrangement).reshape(2, -1)
    corner, foot = (side[np.isin(foot, visits)] for side in (corner, foot))
    start, end = begun[arrangement.visit_edge[foot]], begun[next_point[arrangement.visit_edge[foot]]]
    height, at = begun[arrangement.visit_edge[corner], 1], np.searchsorted(visits, foot)
    places[at, 0] = start[:, 0] + (height - start[:, 1]) / (end[:, 1] - start[:, 1]) * (end[:, 0] - start[:, 0])
    places[at, 1] = height
    return np.asarray(places)
