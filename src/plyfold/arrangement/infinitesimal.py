"""What edges do that touch, when points move by infinitely little: which cross, and in what order along an edge.

Each point p moves to p + s · d, and s tends to 0. Every question is the sign of a polynomial in s, and the answer is
that of its lowest term. With whole coordinates and moves below 2^b, the polynomials have whole coefficients of at most
2^(5b + 150) together: the largest compare how far a sweeping line has come at two crossings, where 150 allows for its
tilt. So for s = 2^-(5b + 151) the lowest term outweighs all others. So the points are moved by just that much, in
fractions, and asked as any others. Only what does not follow from the points as given, with a bound on the rounding, is
asked so.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from plyfold.arrangement.crossings import Contacts, Visits, distinct_pairs
from plyfold.arrays import Bools, Floats, Fractions, Ints, Signs, Wholes
from plyfold.predicates import exact_parameter, orient, parameter_along_edge, signs_of, whole_numbers

__all__ = [
    "MovingPoints",
    "begin_to_move",
    "begun_crossings",
    "begun_visits",
    "order_along_edges",
    "same_outside",
    "signed_pairs",
]

_EPSILON, _TINY = float(np.finfo(np.float64).eps), float(np.finfo(np.float64).tiny)


@dataclass(frozen=True, eq=False)
class MovingPoints:
    """Points of closed polylines as they are given, and when they have begun to move.

    Parameters
    ----------
    points : (n, 2) float
    velocity : (n, 2) float
        Along which vectors they move, in any unit in which x and y are at most 1, rounded.
    moved : (n, 2) object
        The points moved by infinitely little, seen from the first one of ``points``, in whole numbers of ``unit``.
    unit : Fraction
    next_point : (n,) int
        Edge i runs from point i to this one.
    """

    points: Floats
    velocity: Floats
    moved: Wholes
    unit: Fraction
    next_point: Ints

    @cached_property
    def places(self) -> Fractions:
        """The points moved by infinitely little, shape (n, 2)."""
        origin = np.array([Fraction(number) for number in self.points[0].tolist()], dtype=object)
        return np.asarray(self.moved * self.unit + origin)


def begin_to_move(points: Floats, vectors: Wholes, next_point: Ints) -> MovingPoints:
    """Return points that have begun to move along some vectors, which are whole numbers of any unit.

    Examples
    --------
    >>> points = np.array([(0.0, 0.0), (4.0, 0.0), (2.0, 0.0)])
    >>> vectors = np.array([(0, 0), (0, 0), (0, 1)], dtype=object)
    >>> moving = begin_to_move(points, vectors, np.array([1, 2, 0]))
    >>> moving.places[2, 0] == 2, 0 < moving.places[2, 1] < 1e-40
    (True, True)
    """
    places, unit = whole_numbers(points)
    (places, cut), (vectors, _) = _without_zeros(places - places[0]), _without_zeros(vectors)
    largest = max(int(np.abs(numbers).max()) for numbers in (places, vectors))
    # Differences of two numbers have a bit more.
    shift = 5 * (largest.bit_length() + 1) + 151
    velocity = (vectors / max(int(np.abs(vectors).max()), 1)).astype(np.float64)
    return MovingPoints(points, velocity, (places << shift) + vectors, unit * Fraction(2) ** (cut - shift), next_point)


def _without_zeros(numbers: Wholes) -> tuple[Wholes, int]:
    """Return whole numbers without the zeros that all have at their ends, in the binary system, and how many."""
    together = int(np.bitwise_or.reduce(np.abs(numbers), axis=None))
    zeros = (together & -together).bit_length() - 1 if together else 0
    return np.asarray(numbers >> zeros), zeros


def signed_pairs(pairs: Ints, from_right: Bools, n: int) -> Ints:
    """Return numbers, in order, for crossing pairs of n edges, shape (k, 2), and the directions in which they cross."""
    return np.sort((pairs[:, 0] * n + pairs[:, 1]) * 2 + from_right)


def begun_crossings(motion: MovingPoints, contacts: Contacts) -> tuple[Contacts, Ints]:
    """Return the pairs of edges that cross when points have begun to move, given what they do before.

    Returns
    -------
    crossings : Contacts
    undecided : (u, 2) int
        Pairs of edges of which an end stays on the other, however far they move.
    """
    pairs = _touching_pairs(contacts.touches, motion.next_point)
    first, second = pairs.T
    side, other_side = _sides(motion, first, second), _sides(motion, second, first)
    undecided = (side == 0).any(axis=1) | (other_side == 0).any(axis=1)
    cross = (side[:, 0] * side[:, 1] < 0) & (other_side[:, 0] * other_side[:, 1] < 0)
    edges = np.concatenate([contacts.edges, pairs[cross]])
    from_right = np.concatenate([contacts.from_right, side[cross, 1] > 0])
    return Contacts(edges, from_right, contacts.touches[:0], contacts.exact_signs), pairs[undecided]


def _touching_pairs(touches: Ints, next_point: Ints) -> Ints:
    """Return the pairs of edges, no neighbours, of which one ends on the other, the lower number first."""
    vertex, edge = touches.T
    previous = np.empty_like(next_point)
    previous[next_point] = np.arange(len(next_point))
    rows = np.concatenate([np.stack([previous[vertex], edge], axis=1), touches])
    rows = rows[(rows[:, 0] != rows[:, 1]) & (next_point[rows] != rows[:, ::-1]).all(axis=1)]
    return distinct_pairs(np.sort(rows, axis=1), len(next_point))


def _sides(motion: MovingPoints, edge: Ints, other: Ints) -> Signs:
    """Return on which side of each edge the other one starts and ends, shape (m, 2)."""
    there = np.stack([other, motion.next_point[other]], axis=1).ravel()
    start, end = np.repeat(np.stack([edge, motion.next_point[edge]]), 2, axis=1)
    place, side = np.ascontiguousarray(motion.points).view(np.complex128).ravel(), np.zeros(len(there), dtype=np.int8)
    # Most that meet in crowded places have an end in common.
    apart = np.flatnonzero((place[there] != place[start]) & (place[there] != place[end]))
    side[apart] = orient(*(motion.points[at[apart]] for at in (start, end, there)))
    touching = np.flatnonzero(side == 0)
    side[touching] = _sides_begun(motion, *(at[touching] for at in (start, end, there)))
    return side.reshape(-1, 2)


def _sides_begun(motion: MovingPoints, a: Ints, b: Ints, c: Ints) -> Signs:
    """Return on which side of edges from a to b the points c come to lie that were on their lines.

    What decides is how the product (b − a) × (c − a) begins to grow; if that is near 0, the points that have moved.
    """
    step, away = (motion.points[to] - motion.points[a] for to in (b, c))
    turn, drift = (motion.velocity[to] - motion.velocity[a] for to in (b, c))
    growth = turn[:, 0] * away[:, 1] - turn[:, 1] * away[:, 0] + step[:, 0] * drift[:, 1] - step[:, 1] * drift[:, 0]
    # No velocity is above 1 in x or y, and they are rounded; so are all sums and products.
    error = 16 * _EPSILON * (np.abs(step) + np.abs(away)).sum(axis=1) + _TINY * (1 + np.abs(motion.points).max())
    side, unsure = np.sign(growth).astype(np.int8), ~(np.abs(growth) > error)
    p, q, r = (motion.moved[at[unsure]] for at in (a, b, c))
    side[unsure] = signs_of(_cross(q - p, r - p))
    return side


def order_along_edges(motion: MovingPoints, visits: Visits) -> tuple[Bools, Ints]:
    """Tell whether consecutive visits on one edge are in order when points have begun to move.

    Returns
    -------
    in_order : (m,) bool
        For each two consecutive visits on one edge.
    together : (t, 3) int
        Triples of edges that go on meeting in one point, however far they move.
    """
    first = np.flatnonzero(visits.edge[1:] == visits.edge[:-1])
    edge, other = visits.edge[first], visits.edge[visits.partner]
    start, end = motion.points[visits.edge], motion.points[motion.next_point[visits.edge]]
    parameter, error = parameter_along_edge(start, end, start[visits.partner], end[visits.partner])
    gap, errors = parameter[first + 1] - parameter[first], error[first + 1] + error[first]
    in_order = np.asarray(gap > errors)
    unsure = np.flatnonzero(~(np.abs(gap) > errors))
    triples = np.stack([edge, other[first], other[first + 1]], axis=1)[unsure]
    order = _order(motion, triples)
    in_order[unsure] = order < 0
    return in_order, triples[order == 0]


def begun_visits(motion: MovingPoints, crossings: Contacts) -> Visits:
    """Return the visits to crossings, from :func:`begun_crossings`, in order when points have begun to move."""
    k = len(crossings.edges)
    edge, other = crossings.edges.T.ravel(), crossings.edges[:, ::-1].T.ravel()
    edges = np.stack([edge, motion.next_point[edge], other, motion.next_point[other]], axis=1)
    ends = motion.places[edges]
    share = np.array([exact_parameter(*four) for four in ends], dtype=object)
    order = np.array(sorted(range(2 * k), key=lambda visit: (edge[visit], share[visit])), dtype=np.int64)
    rank = np.empty_like(order)
    rank[order] = np.arange(2 * k)
    start, end = ends[:, 0], ends[:, 1]
    together = np.flatnonzero((np.diff(edge[order]) == 0) & (share[order][1:] == share[order][:-1]))
    met = order[np.stack([together, together + 1])]
    return Visits(
        edge=edge[order],
        partner=rank[(order + k) % max(2 * k, 1)],
        ccw=np.concatenate([crossings.from_right, ~crossings.from_right])[order],
        point=(start + share[:, None] * (end - start))[order].astype(np.float64),
        triple=np.stack([edge[met[0]], *other[met]], axis=1),
        exact_signs=crossings.exact_signs + 2 * k,
    )


def same_outside(motion: MovingPoints, points: Floats) -> bool:
    """Tell whether a loop has its leftmost vertex, and turns there, as it does when its points have begun to move.

    That says on which side of it the outside is, given its crossings.
    """
    lowest = np.flatnonzero(motion.points[:, 0] == motion.points[:, 0].min()).tolist()
    corner = min(lowest, key=lambda point: motion.moved[point].tolist())
    before = int(np.flatnonzero(motion.next_point == corner)[0])
    around = np.array([before, corner, motion.next_point[corner]])
    a, b, c = motion.moved[around]
    turn = signs_of(_cross(b - a, c - b))
    return corner == int(np.lexsort(points.T[::-1])[0]) and bool(turn == orient(*points[around]))


def _order(motion: MovingPoints, triples: Ints) -> Signs:
    """Return −1 where an edge, the first of each row, crosses the second before the third, 1 where after, 0 where both.

    Edge p → q crosses r → s at the share (r − p) × (s − r) / (q − p) × (s − r).
    """
    start, end = motion.moved[triples], motion.moved[motion.next_point[triples]]
    along, across = end[:, 0] - start[:, 0], end[:, 1:] - start[:, 1:]
    above = _cross(start[:, 1:] - start[:, :1], across)
    below = _cross(along[:, None], across)
    growing = signs_of(below[:, 0]) * signs_of(below[:, 1])
    return np.asarray(growing * signs_of(above[:, 0] * below[:, 1] - above[:, 1] * below[:, 0]))


def _cross(one: Wholes, other: Wholes) -> Wholes:
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])
