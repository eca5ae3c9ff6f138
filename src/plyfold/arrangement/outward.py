"""Outward: away from the surface on the left of a closed polyline. Vectors along which its points can be moved so.

If touching loops are the limit of loops that bound a surface, then such a surface with a narrow collar round it is
bounded by loops that run a little farther out, wherever in the collar. So points that touch others may move by whatever
vectors have positive components to the right of both edges at the point: all give the same answer.
"""

from __future__ import annotations

import numpy as np

from plyfold.arrangement.noding import Noding
from plyfold.arrangement.polylines import polygon_turning_number
from plyfold.arrays import Bools, Floats, Ints, Wholes
from plyfold.outline.curve import Outline
from plyfold.predicates import cross_sign, orient, whole_numbers

__all__ = ["are_moved", "canonical_rank", "outward_vectors", "whole_vectors", "winds_backward"]

# A vector is a whole multiple of this fraction of a unit, or of a finer one where the way out is so narrow.
_FINENESS = [2.0**12, 2.0**24, 2.0**36, 2.0**48]
_GOLDEN = (5**0.5 - 1) / 2


def winds_backward(outline: Outline, noding: Noding) -> bool:
    """Tell whether an outline, noded as it is given, is to be turned round to have the surface on its left."""
    least, most = int(noding.winding.min()), int(noding.winding.max())
    if least < 0 < most or least == most:
        return outline.n_loops == 1 and polygon_turning_number(outline.points) < 0
    return least < 0


def outward_vectors(outline: Outline, points: Ints, scatter: int = 0) -> Floats:
    """Return a vector for each of some points, shape (m, 2), outward and some units long.

    Parameters
    ----------
    outline : Outline
        Without spikes.
    points : (m,) int
    scatter : int, optional
        Along each loop vectors grow steadily, so that strands which run along each other come to lie side by side. With
        other numbers than 0 their lengths are scattered.

    Notes
    -----
    They depend on the shape of the loops alone, not on where these begin or lie, and grow with them. At tips so sharp
    that no double lies on the way out, they may be wrong: see :func:`whole_vectors`.
    """
    here = outline.points[points]
    before, after = outline.points[outline.previous_point[points]], outline.points[outline.next_point[points]]
    direction = _outward(here - before, after - here)
    vectors = direction * _lengths(canonical_rank(outline), scatter)[points, None]
    rounded = vectors.copy()
    wrong = np.arange(len(points))
    for fineness in _FINENESS:
        rounded[wrong] = np.rint(vectors[wrong] * fineness) / fineness
        ends = before[wrong], here[wrong], after[wrong]
        wrong = wrong[~_is_right_of(*ends, rounded[wrong])]
    return rounded


def whole_vectors(outline: Outline, vectors: Floats, points: Ints, sense: int) -> Wholes:
    """Return a vector for each point in whole numbers of some unit: exactly outward at some points, or inward.

    Parameters
    ----------
    outline : Outline
    vectors : (n, 2) float
        From :func:`outward_vectors` at the points that are to move outward, or the opposite of these.
    points : (m,) int
    sense : int
        1 if these points move outward, −1 if inward.

    Notes
    -----
    Right of two directions u and v, which are not on one line, is a · v − b · u where they turn right, and the opposite
    where they turn left, for any positive a and b.
    """
    whole = whole_numbers(vectors)[0]
    ends = np.stack([outline.previous_point, np.arange(len(outline)), outline.next_point])[:, points]
    before, here, after = outline.points[ends]
    wrong = ~_is_right_of(before, here, after, sense * vectors[points])
    if wrong.any():
        at = points[wrong]
        places = whole_numbers(outline.points[ends[:, wrong]])[0]
        arriving, leaving = np.diff(places, axis=0)
        share = np.rint(np.hypot(*vectors[at].T) * _FINENESS[0]).astype(np.int64).astype(object)[:, None]
        turn = orient(*outline.points[ends[:, wrong]]).astype(object)[:, None]
        whole[at] = sense * turn * (int(_FINENESS[0]) * arriving - share * leaving)
    return whole


def _outward(arriving: Floats, leaving: Floats) -> Floats:
    """Return a direction to the right of two directions, whose lengths do not matter.

    Where they are less than a right angle apart, the sum of what is right of each; else, where such a sum would be
    sensitive to rounding, back out of the corner.
    """
    arriving, leaving = _unit(arriving), _unit(leaving)
    across = arriving[:, 0] * leaving[:, 1] - arriving[:, 1] * leaving[:, 0]
    tip = np.where((across > 0)[:, None], arriving - leaving, leaving - arriving)
    side = arriving + leaving
    right = np.stack([side[:, 1], -side[:, 0]], axis=1)
    return np.where(((arriving * leaving).sum(axis=1) < 0)[:, None], tip, right)


def _unit(vectors: Floats) -> Floats:
    return np.asarray(vectors / np.hypot(*vectors.T)[:, None])


def _lengths(rank: Ints, scatter: int) -> Floats:
    part = (rank * _GOLDEN * scatter) % 1 if scatter else (rank + rank * _GOLDEN % 1) / len(rank)
    return np.asarray(1 + part, dtype=np.float64)


def are_moved(outline: Outline, points: Ints, goals: Floats, sense: int) -> Bools:
    """Tell which of some points have goals strictly to the right of both their edges, to the left if ``sense`` is −1.

    Exact.
    """
    here = outline.points[points]
    before, after = outline.points[outline.previous_point[points]], outline.points[outline.next_point[points]]
    return np.asarray((sense * orient(before, here, goals) < 0) & (sense * orient(here, after, goals) < 0))


def _is_right_of(before: Floats, here: Floats, after: Floats, vector: Floats) -> Bools:
    zero = np.zeros_like(vector)
    return np.asarray((cross_sign(before, here, zero, vector) < 0) & (cross_sign(here, after, zero, vector) < 0))


# ---- an order that does not depend on where loops begin --------------------------------------------------------------


def canonical_rank(outline: Outline) -> Ints:
    """Return the rank of each point in an order of all points that belongs to the drawing.

    Each loop is begun where the list of its points comes first in the alphabet, so to speak, and so are the loops.

    Examples
    --------
    >>> from plyfold.outline.curve import Curve
    >>> canonical_rank(Curve([(5, 5), (9, 0), (0, 7)])).tolist()
    [1, 2, 0]
    """
    columns = np.column_stack([outline.points, np.concatenate(outline.cusps)])
    letters = np.unique(columns, axis=0, return_inverse=True)[1].ravel()
    begun = []
    for first, last in zip(outline.first_point[:-1].tolist(), outline.first_point[1:].tolist(), strict=True):
        word = letters[first:last].tolist()
        start = _least_rotation(word)
        begun.append((word[start:] + word[:start], first + np.roll(np.arange(last - first), -start)))
    order = np.concatenate([numbers for _, numbers in sorted(begun, key=lambda loop: loop[0])])
    rank = np.empty(len(outline), dtype=np.int64)
    rank[order] = np.arange(len(outline))
    return rank


def _least_rotation(word: list[int]) -> int:
    """Return where a cyclic word begins so that it is the first of its rotations in the alphabet. O(n).

    Two beginnings are compared; where they differ, the worse one and all that it has passed are left behind.
    """
    n, one, other, same = len(word), 0, 1, 0
    while one < n and other < n and same < n:
        first, second = word[(one + same) % n], word[(other + same) % n]
        if first == second:
            same += 1
            continue
        if first > second:
            one += same + 1
        else:
            other += same + 1
        other += one == other
        same = 0
    return min(one, other)
