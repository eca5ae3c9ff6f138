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
from plyfold.arrays import Floats, Fractions, Ints
from plyfold.immersion.corners import feet
from plyfold.outline.curve import Outline, outline_of_points
from plyfold.predicates import exact_crossings

__all__ = ["drawings_of"]


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
        yield _as_begun(arrangement, arrangement.begun)


def _as_begun(arrangement: Arrangement, begun: Fractions) -> Arrangement:
    outline, given = cast("Outline", arrangement.outline), cast("Outline", arrangement.given)
    cusps = np.concatenate(outline.cusps)
    drawn = outline_of_points(given.points, given.loop_of_point, cusps, given.rows, outline.repairs)
    crossings, marks = _crossings(arrangement, begun, outline.next_point), _marks(arrangement, begun, drawn)
    return replace(arrangement, outline=drawn, crossings=crossings, marks=marks)


def _crossings(arrangement: Arrangement, begun: Fractions, next_point: Ints) -> Floats:
    """Return where edges cross that have begun to move, rounded."""
    first = np.flatnonzero(np.arange(len(arrangement.partner)) < arrangement.partner)
    edge, other = arrangement.visit_edge[first], arrangement.visit_edge[arrangement.partner[first]]
    ends = begun[np.stack([edge, next_point[edge], other, next_point[other]])]
    return np.array([exact_crossings(ends, axis) for axis in (0, 1)], dtype=np.float64).reshape(2, -1).T


def _marks(arrangement: Arrangement, begun: Fractions, drawn: Outline) -> Floats:
    """Return where cusps and the feet of bridges are when points have begun to move, rounded."""
    is_mark = arrangement.crossing_of_visit < 0
    point = drawn.points[arrangement.visit_edge]
    corner, foot = feet(arrangement).reshape(2, -1)
    edge = arrangement.visit_edge[foot]
    start, end, height = begun[edge], begun[drawn.next_point[edge]], begun[arrangement.visit_edge[corner], 1]
    point[foot, 0] = start[:, 0] + (height - start[:, 1]) / (end[:, 1] - start[:, 1]) * (end[:, 0] - start[:, 0])
    point[foot, 1] = height
    return np.asarray(point[is_mark])
