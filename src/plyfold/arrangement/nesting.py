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
from plyfold.arrangement.marks import AT_VERTEX, Marks
from plyfold.arrangement.planar_map import number_of_borders
from plyfold.arrays import Floats, Ints, Reals
from plyfold.clock import UNWATCHED, Watch
from plyfold.core.buffers import all_flat, flat
from plyfold.core.nesting import Nesting
from plyfold.predicates import Place, exact_cross, orient, whole_numbers

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
    at_vertices, on_edges : Marks
        Where each bridge starts and ends.
    """

    first_visit: Ints
    left: Ints
    turning: Ints
    outside: Ints
    bridges: Ints
    at_vertices: Marks
    on_edges: Marks


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
    ends, left = np.empty((2, len(corner)), dtype=np.int64), np.empty(number_of_borders(first_visit), dtype=np.int64)
    found.join(*all_flat(corner, met, passed, *ends, left))
    turning = np.empty(len(first_point) - 1, dtype=np.int64)
    found.count_turns(flat(turning))
    number = np.flatnonzero(met >= 0)
    at_vertices = _feet_at_vertices(plan, corner[number])
    on_edges = _feet_on_edges(plan, met[number], passed[number], corner[number], number)
    return Nest(first_visit, left, turning, ends[0, met < 0], ends[:, number].T, at_vertices, on_edges)


def same_nest(one: Nest, other: Nest) -> bool:
    """Tell whether loops lie to each other in the same way, as far as bridges from the same vertices tell."""
    feet = [nest.at_vertices.followed_by(nest.on_edges) for nest in (one, other)]
    same_darts = np.array_equal(one.outside, other.outside) and np.array_equal(one.bridges, other.bridges)
    same_places = all(np.array_equal(getattr(feet[0], name), getattr(feet[1], name)) for name in ("edge", "tie", "at"))
    return same_darts and same_places and np.array_equal(feet[0].order, feet[1].order)


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


def _loops_of(plan: _Plan, point: Ints) -> Ints:
    return np.asarray(np.searchsorted(plan.first_point, point, side="right") - 1)


def _feet_at_vertices(plan: _Plan, corner: Ints) -> Marks:
    """Return the feet of the bridges that leave leftmost vertices; they come after cusps there."""
    along, tie = np.full(len(corner), AT_VERTEX), np.ones_like(corner)
    at = np.searchsorted(plan.visits.edge, corner)
    return Marks(corner, along, tie, at, _loops_of(plan, corner), plan.points[corner], np.zeros_like(corner))


def _feet_on_edges(plan: _Plan, edge: Ints, passed: Ints, corner: Ints, number: Ints) -> Marks:
    """Return the feet of the bridges from vertices to edges on their left: a little higher than the vertices.

    Later ones, which come from further right, are higher if the vertices have one height: they pass above.
    """
    end = plan.following(edge)
    upward = np.where(plan.order[edge, 1] < plan.order[end, 1], 1, -1)
    start_x, end_x = plan.points[edge, 0], plan.points[end, 0]
    x = start_x + _shares(plan, edge, end, corner) * (end_x - start_x)
    return Marks(
        edge,
        along=upward * plan.order[corner, 1],
        tie=upward * (2 + number),
        at=passed,
        loop=_loops_of(plan, edge),
        point=np.stack([x, plan.points[corner, 1]], axis=1),
        cusp_index=np.zeros_like(edge),
    )


def _shares(plan: _Plan, edge: Ints, end: Ints, corner: Ints) -> Floats:
    """Return how far along edges the heights of vertices are, each share to the nearest double."""
    heights = plan.reals[np.stack([edge, end, corner]), 1]
    start, end, between = whole_numbers(heights)[0] if plan.exact is None else heights
    return np.asarray((between - start) / (end - start), dtype=np.float64)
