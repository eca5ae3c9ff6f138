"""Several closed curves in one plane: in which cell of the others each group of them lies that hangs together.

Loops that cross hang together in groups. Within a group everything is as for one curve. A group lies in one cell of the
others; exact point location says in which: from its leftmost vertex straight to the left.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

import numpy as np

from plyfold.arrangement.crossings import Visits
from plyfold.arrangement.marks import Marks
from plyfold.arrangement.planar_map import number_of_borders
from plyfold.arrays import Bools, Floats, Ints, Reals
from plyfold.clock import UNWATCHED, Watch
from plyfold.core.buffers import all_flat, flat, whole_room
from plyfold.core.nesting import Bridges, Nesting, share_of_fractions
from plyfold.predicates import Place, exact_cross, orient

__all__ = ["Nest", "nest", "same_nest"]


@dataclass(frozen=True, eq=False)
class Nest:
    """How several loops lie to each other that do not meet.

    Parameters
    ----------
    first_visit : (loops + 1,) int
        The number of each loop's first visit, and last the number of visits.
    left : (borders,) int
        The winding number on the left of each border.
    turning : (loops,) int
        The turning number of each loop.
    outside : (o,) int
        Darts of the unbounded cell, one of each group that lies in it with nothing on its left; that of the leftmost
        vertex of all first.
    bridges : (b, 2) int
        For each other group the dart at its leftmost vertex, and the dart met to the left of it. Both have the cell
        between them on their left.
    is_bounded : (b,) bool
        Whether that is a bounded cell.
    feet : Marks
        Where all bridges start, and then where they end.
    """

    first_visit: Ints
    left: Ints
    turning: Ints
    outside: Ints
    bridges: Ints
    is_bounded: Bools
    feet: Marks


@dataclass(frozen=True, eq=False)
class _Plan:
    """Loops with their visits, to find the border at a place; see :func:`nest`.

    ``order`` has the coordinates, or whole numbers in the same order if these are no doubles.
    """

    points: Floats
    first_point: Ints
    visits: Visits
    exact: Reals | None
    order: Floats

    @property
    def reals(self) -> Reals:
        """The places of the points."""
        return self.points if self.exact is None else self.exact

    def place(self, point: int) -> Place:
        """Return where a point is."""
        x, y = self.reals[point].tolist()
        return Fraction(x), Fraction(y)

    def ends(self, edge: int) -> tuple[Place, Place]:
        """Return where an edge starts and ends."""
        return self.place(edge), self.place(int(self.following(edge)))

    def following(self, edge: Ints | int) -> Ints:
        """Return the points at which edges end."""
        loop = np.searchsorted(self.first_point, edge, side="right") - 1
        return np.where(edge + 1 < self.first_point[loop + 1], edge + 1, self.first_point[loop])


def nest(
    points: Floats, first_point: Ints, visits: Visits, watch: Watch = UNWATCHED, exact: Reals | None = None
) -> Nest:
    """Find which of several closed polylines in general position lies inside which, given their visits.

    Parameters
    ----------
    points : (n, 2) float
        Loop after loop; loop l has the points ``first_point[l]:first_point[l + 1]``.
    first_point : (loops + 1,) int
    visits : Visits
    watch : Watch, optional
    exact : (n, 2) object, optional
        Places of the points in fractions, or in whole numbers of some unit, to which ``points`` are near: nearer than
        doubles could tell. By default, those are exact.

    Raises
    ------
    TimeLimitError
        If the time is over.

    Notes
    -----
    O(n log n) for loops that do not crowd: what rays from all groups meet on the left, which is O(n) for each at worst.
    """
    plan = _Plan(points, first_point, visits, exact, points if exact is None else _ranks(exact))
    first_visit, ccw = np.searchsorted(visits.edge, first_point), visits.ccw.view(np.uint8)
    found = Nesting(*all_flat(plan.order, first_point, first_visit, visits.edge, visits.partner, ccw), watch.step)
    _find_turns(plan, found)
    corner = found.corner.as_array()
    corner = corner[np.lexsort(plan.order[corner].T[::-1])]
    met = _met_on_the_left(plan, found, corner)
    passed = _visits_passed(plan, met, corner)
    is_met, n_borders = met >= 0, number_of_borders(first_visit)
    n_bridges = np.count_nonzero(is_met)
    (dart, beyond, is_bounded), left = np.empty((3, len(corner)), dtype=np.int64), np.empty(n_borders, dtype=np.int64)
    whole, real = np.empty(8 * n_bridges, dtype=np.int64), np.empty(6 * n_bridges)
    bridges = Bridges(n_bridges, *all_flat(dart, beyond, is_bounded, left, whole, real))
    found.join(*all_flat(corner, met, passed), bridges, whole_room(2 * n_borders))
    turning = np.empty(len(first_point) - 1, dtype=np.int64)
    found.count_turns(flat(turning))
    (edge, tie, at, loop), along, point = whole.reshape(4, -1), real[: 2 * n_bridges], real[2 * n_bridges :].reshape(-1, 2)
    if exact is not None:
        _place_feet(plan, met[is_met], corner[is_met], point)
    return Nest(
        first_visit,
        left,
        turning,
        outside=dart[~is_met],
        bridges=np.stack([dart[is_met], beyond[is_met]], axis=1),
        is_bounded=is_bounded[is_met] == 1,
        feet=Marks(edge, along, tie, at, loop, point, np.zeros_like(edge)),
    )


def same_nest(one: Nest, other: Nest) -> bool:
    """Tell whether loops lie to each other in the same way, as far as bridges from the same vertices tell."""
    same_darts = np.array_equal(one.outside, other.outside) and np.array_equal(one.bridges, other.bridges)
    orders = [nest.feet.order for nest in (one, other)]
    places = [[nest.feet.edge, nest.feet.tie, nest.feet.at] for nest in (one, other)]
    return same_darts and np.array_equal(*orders) and np.array_equal(*places)


def _ranks(numbers: Reals) -> Floats:
    """Return whole numbers in the same order, for either coordinate."""
    ranks = [np.unique(along, return_inverse=True)[1].ravel() for along in numbers.T]
    return np.stack(ranks, axis=1).astype(np.float64)


def _find_turns(plan: _Plan, found: Nesting) -> None:
    """Let it be found whether loops turn left at their leftmost vertices."""
    if plan.exact is None:
        found.find_turns()
        return
    here = np.asarray(found.leftmost)
    after = plan.following(here)
    before = np.where(here == plan.first_point[:-1], plan.first_point[1:], here) - 1
    p, q, r = (plan.exact[point] for point in (before, here, after))
    np.asarray(found.is_convex)[:] = orient(p, q, r) > 0


def _met_on_the_left(plan: _Plan, found: Nesting, corner: Ints) -> Ints:
    """Return the edge of the other groups that a ray from each vertex to the left meets first; −1 if it meets none."""
    met = np.empty_like(corner)
    found.meet(flat(corner), int(plan.exact is None), flat(met))
    ray, edge = found.unsure.as_array().reshape(-1, 2).T
    for number in dict.fromkeys(ray.tolist()):
        met[number] = _exactly_first(plan, int(corner[number]), edge[ray == number].tolist())
    return met


def _exactly_first(plan: _Plan, corner: int, edges: list[int]) -> int:
    """Return which of some edges the ray from a vertex to the left meets first; −1 if all are on the right."""
    here, level = plan.place(corner)
    places = {edge: _place_and_slope(*plan.ends(edge), level) for edge in edges}
    passed = [edge for edge, (place, _) in places.items() if place < here]
    return max(passed, key=places.__getitem__, default=-1)


def _place_and_slope(start: Place, end: Place, height: Fraction) -> tuple[Fraction, Fraction]:
    """Return the x at which an edge passes a height, and the growth of x with the height."""
    (x, y), (end_x, end_y) = start, end
    slope = (end_x - x) / (end_y - y)
    return x + (height - y) * slope, slope


def _visits_passed(plan: _Plan, edge: Ints, corner: Ints) -> Ints:
    """Return how many visits come before the places on edges a little above the heights of vertices."""
    first, last = np.searchsorted(plan.visits.edge, [edge, edge + 1])
    passed = first.copy()
    for i in np.flatnonzero(first < last).tolist():
        (_, start), (_, end) = plan.ends(int(edge[i]))
        bisect = bisect_right if start < end else bisect_left
        share = (plan.place(int(corner[i]))[1] - start) / (end - start)
        passed[i] = bisect(range(last[i]), share, int(first[i]), key=partial(_share_of_visit, plan))
    return passed


def _share_of_visit(plan: _Plan, visit: int) -> Fraction:
    """Return how far along its edge a visit is."""
    edge, other = plan.visits.edge[[visit, plan.visits.partner[visit]]].tolist()
    (start, end), (p, q) = plan.ends(edge), plan.ends(other)
    return exact_cross(start, p, p, q) / exact_cross(start, end, p, q)


def _place_feet(plan: _Plan, edge: Ints, corner: Ints, point: Floats) -> None:
    """Write down where bridges start and end, rounded, if coordinates are fractions."""
    end = plan.following(edge)
    heights = zip(*(plan.reals[points, 1].tolist() for points in (edge, end, corner)), strict=True)
    share = np.array([share_of_fractions(*map(Fraction, three)) for three in heights])
    point[: len(edge)] = plan.points[corner]
    point[len(edge) :, 0] = plan.points[edge, 0] + share * (plan.points[end, 0] - plan.points[edge, 0])
    point[len(edge) :, 1] = plan.points[corner, 1]
