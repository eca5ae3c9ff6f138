"""Several closed curves in one plane: in which cell of the others each group of them lies that hangs together.

Loops that cross hang together in groups. Within a group everything is as for one curve. A group lies in one cell of the
others; exact point location says in which: from its leftmost vertex straight to the left.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.crossings import Visits, edge_ends
from plyfold.arrangement.marks import Mark
from plyfold.arrangement.meetings import JoinedLoops
from plyfold.arrays import Bools, Floats, Ints, Wholes
from plyfold.clock import UNWATCHED, Watch
from plyfold.graphs import components
from plyfold.predicates import Place, exact_cross, orient
from plyfold.ragged import starts_of

if TYPE_CHECKING:
    from shapely import STRtree

__all__ = ["Nest", "nest", "same_nest"]

_EDGES_IN_BOX = 8


@dataclass(frozen=True, eq=False)
class Nest:
    """How several loops lie to each other that do not meet.

    Parameters
    ----------
    first_visit : (loops + 1,) int
        The number of each loop's first visit, and last the number of visits.
    outside : (o,) int
        Darts of the unbounded cell, one of each group that lies in it with nothing on its left; that of the leftmost
        vertex of all first.
    bridges : (b, 2) int
        For each other group the dart at its leftmost vertex, and the dart met to the left of it. Both have the cell
        between them on their left.
    feet : list of pairs of Mark
        Where each bridge starts and ends.
    """

    first_visit: Ints
    outside: Ints
    bridges: Ints
    feet: list[tuple[Mark, Mark]]


def nest(joined: JoinedLoops, visits: Visits, watch: Watch = UNWATCHED, exact: Wholes | None = None) -> Nest:
    """Find which of several closed polylines in general position lies inside which, given their visits.

    Parameters
    ----------
    joined : JoinedLoops
    visits : Visits
    watch : Watch, optional
    exact : (n, 2) object, optional
        Places of its points in whole numbers of some unit, to which ``joined.points`` are near: nearer than doubles
        could tell. By default, those are exact.

    Raises
    ------
    TimeLimitError
        If the time is over.

    Notes
    -----
    O(n) for each group.
    """
    start = np.flatnonzero(~joined.is_jump)
    visits = replace(visits, edge=start[visits.edge])
    loop, n_loops = joined.loop[visits.edge], int(joined.loop[-1]) + 1
    first_visit = np.searchsorted(loop, np.arange(n_loops + 1))
    group = components(n_loops, loop, loop[visits.partner])
    plan = _Plan(joined, visits, first_visit, group[joined.loop], exact)
    outside, bridges, feet = [], [], []
    for number, corner in enumerate(_corners(plan)):
        watch.step()
        dart, beyond = _outer_dart(plan, corner), _met_on_the_left(plan, corner)
        if beyond is None:
            outside.append(dart)
        else:
            foot = _foot_on_edge(plan, beyond, corner, number)
            bridges.append((dart, 2 * plan.border(beyond, foot.at) + _is_upward(plan, beyond)))
            feet.append((_foot_at_vertex(plan, corner), foot))
    return Nest(
        first_visit=first_visit,
        outside=np.array(outside),
        bridges=np.array(bridges, dtype=np.int64).reshape(-1, 2),
        feet=feet,
    )


def same_nest(one: Nest, other: Nest) -> bool:
    """Tell whether loops lie to each other in the same way, as far as bridges from the same vertices tell."""
    marks = [[mark for feet in nest.feet for mark in feet] for nest in (one, other)]
    orders = [sorted(range(len(found)), key=lambda at: found[at][:3]) for found in marks]
    places = [[(mark.edge, mark.tie, mark.at) for mark in found] for found in marks]
    same_darts = np.array_equal(one.outside, other.outside) and np.array_equal(one.bridges, other.bridges)
    return same_darts and places[0] == places[1] and orders[0] == orders[1]


# ---- point location ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Plan:
    """The polyline with its visits, to find the border at a place.

    Loops that hang together by crossings are a group; ``group`` has that of each edge. ``exact`` are places to which
    the points are near, see :func:`nest`.
    """

    joined: JoinedLoops
    visits: Visits
    first_visit: Ints
    group: Ints
    exact: Wholes | None

    def place(self, point: int) -> Place:
        """Return where a point is."""
        x, y = (self.joined.points if self.exact is None else self.exact)[point].tolist()
        return Fraction(x), Fraction(y)

    def is_above(self, points: Ints, other: int) -> Bools:
        """Tell which points lie higher than another one."""
        y = (self.joined.points if self.exact is None else self.exact)[:, 1]
        return np.asarray(y[points] > y[other], dtype=bool)

    @cached_property
    def ends(self) -> Floats:
        """Start and end of each edge."""
        return edge_ends(self.joined.points)

    @cached_property
    def leftmost(self) -> float:
        """The least x of all points."""
        return float(self.joined.points[:, 0].min())

    @cached_property
    def first_border(self) -> Ints:
        """The first border of each loop."""
        return starts_of(np.maximum(np.diff(self.first_visit), 1))

    @cached_property
    def boxes(self) -> STRtree:
        """The bounding boxes of edges, so many at a time that follow each other: as lines from corner to corner."""
        from shapely import STRtree, linestrings

        starts = np.arange(0, len(self.ends), _EDGES_IN_BOX)
        low = np.minimum.reduceat(self.ends.min(axis=1), starts)
        high = np.maximum.reduceat(self.ends.max(axis=1), starts)
        return STRtree(linestrings(np.stack([low, high], axis=1)))

    def near(self, ray: Floats) -> Ints:
        """Return the edges in all boxes that a ray along the x axis meets, given its ends."""
        from shapely import linestrings

        edges = self.boxes.query(linestrings(ray))[:, None] * _EDGES_IN_BOX + np.arange(_EDGES_IN_BOX)
        return np.asarray(edges[edges < len(self.ends)])

    def border(self, edge: int, visits_passed: int) -> int:
        """Return the border at a place on an edge, given how many visits come before it, on earlier loops too."""
        loop = int(self.joined.loop[edge])
        start, count = int(self.first_visit[loop]), int(self.first_visit[loop + 1] - self.first_visit[loop])
        return int(self.first_border[loop]) + (visits_passed - start - 1) % max(count, 1)


def _corners(plan: _Plan) -> list[int]:
    """Return the leftmost vertex of each group, the lowest of several, from left to right."""
    x, y = plan.joined.points.T if plan.exact is None else map(_ranks, plan.exact.T)
    order = np.lexsort([y, x])
    order = order[~plan.joined.is_jump[order]]
    corners: list[int] = order[np.sort(np.unique(plan.group[order], return_index=True)[1])].tolist()
    return corners


def _ranks(numbers: Wholes) -> Ints:
    return np.unique(numbers, return_inverse=True)[1].ravel()


def _outer_dart(plan: _Plan, corner: int) -> int:
    """Return the dart that has the outside of its group on its left at a leftmost vertex."""
    is_first = corner == 0 or plan.joined.is_jump[corner - 1]
    # The first vertex of a loop comes again at its end.
    last = int(np.searchsorted(plan.joined.loop, plan.joined.loop[corner], side="right")) - 1
    before = (last if is_first else corner) - 1
    border = plan.border(corner, int(np.searchsorted(plan.visits.edge, corner)))
    return 2 * border + _turns_left(plan, before, corner, corner + 1)


def _turns_left(plan: _Plan, before: int, here: int, after: int) -> bool:
    if plan.exact is None:
        return bool(orient(*plan.joined.points[[before, here, after]]) > 0)
    p, q, r = (plan.place(point) for point in (before, here, after))
    return exact_cross(p, q, q, r) > 0


def _foot_at_vertex(plan: _Plan, corner: int) -> Mark:
    """Return the foot of the bridge that leaves a leftmost vertex; it comes after a cusp there."""
    x, y = plan.joined.points[corner].tolist()
    loop = int(plan.joined.loop[corner])
    return Mark(corner - loop, Fraction(0), 1, int(np.searchsorted(plan.visits.edge, corner)), loop, (x, y))


def _foot_on_edge(plan: _Plan, edge: int, corner: int, number: int) -> Mark:
    """Return the foot of the bridge from a vertex to an edge on its left: a little higher than the vertex.

    Later ones, which come from further right, are higher if the vertices have one height: they pass above.
    """
    loop, upward = int(plan.joined.loop[edge]), _is_upward(plan, edge)
    (_, height), (_, start), (_, end) = (plan.place(point) for point in (corner, edge, edge + 1))
    share = (height - start) / (end - start)
    tie = 2 + number if upward else -2 - number
    (start_x, _), (end_x, _) = plan.ends[edge].tolist()
    point = (start_x + float(share) * (end_x - start_x), float(plan.joined.points[corner, 1]))
    return Mark(edge - loop, share, tie, _visits_passed(plan, edge, share, upward), loop, point)


def _is_upward(plan: _Plan, edge: int) -> bool:
    return bool(plan.is_above(np.array([edge + 1]), edge)[0])


def _met_on_the_left(plan: _Plan, corner: int) -> int | None:
    """Return the edge of the other groups that a ray from a vertex to the left meets first.

    The ray runs a little higher than the vertex, by less than any other difference in height. So it meets no vertices
    and no crossings.
    """
    x, height = plan.joined.points[corner].tolist()
    near = plan.near(np.array([(plan.leftmost, height), (x, height)]))
    near = near[(plan.group[near] != plan.group[corner]) & ~plan.joined.is_jump[near]]
    met = near[plan.is_above(near, corner) != plan.is_above(near + 1, corner)]
    if plan.exact is None:
        nearest, is_sure = _nearest(plan.ends[met], x, height, met)
        if is_sure:
            return nearest[0]
    else:
        nearest = met.tolist()
    here, level = plan.place(corner)
    places = {edge: _place_and_slope(plan.place(edge), plan.place(edge + 1), level) for edge in nearest}
    passed = [edge for edge, (place, _) in places.items() if place < here]
    return max(passed, key=places.__getitem__, default=None)


def _nearest(ends: Floats, x: float, height: float, edges: Ints) -> tuple[list[int], bool]:
    """Return those of some edges that a ray to the left may meet first, by rounded places; and if it is surely met."""
    (start_x, start_y), (end_x, end_y) = ends.transpose(1, 2, 0)
    place = start_x + (height - start_y) / (end_y - start_y) * (end_x - start_x)
    error = 16 * np.finfo(np.float64).eps * (np.abs(start_x) + np.abs(end_x)) + np.finfo(np.float64).tiny
    left = place + error < x
    nearest = (place + error >= (place - error)[left].max(initial=-np.inf)) & (place - error < x)
    return edges[nearest].tolist(), np.count_nonzero(nearest) == 1 and bool(left[nearest].all())


def _place_and_slope(start: Place, end: Place, height: Fraction) -> tuple[Fraction, Fraction]:
    """Return the x at which an edge passes a height, and the growth of x with the height."""
    (x, y), (end_x, end_y) = start, end
    slope = (end_x - x) / (end_y - y)
    return x + (height - y) * slope, slope


def _visits_passed(plan: _Plan, edge: int, share: Fraction, upward: bool) -> int:
    """Return how many visits come before the place on an edge a little above a share of it."""
    visits, (start, end) = plan.visits, (plan.place(edge), plan.place(edge + 1))
    first, last = np.searchsorted(visits.edge, [edge, edge + 1]).tolist()
    others = visits.edge[visits.partner[first:last]].tolist()
    crossed = [(plan.place(other), plan.place(other + 1)) for other in others]
    places = [exact_cross(start, p, p, q) / exact_cross(start, end, p, q) for p, q in crossed]
    return int(first) + sum(place < share or (upward and place == share) for place in places)
