"""Several closed curves in one plane: their visits to all crossings, and in which cell of the others each group lies.

Loops that cross hang together in groups. Within a group everything is as for one curve. A group lies in one cell of the
others; exact point location says in which: from its leftmost vertex straight to the left.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrangement.crossings import Visits, edge_ends, find_contacts, order_visits
from plyfold.arrangement.general_position import touching_places
from plyfold.arrangement.marks import AT_VERTEX, Mark
from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GeneralPositionError
from plyfold.graphs import components
from plyfold.predicates import cross_sign, exact_parameter, rounded_shares
from plyfold.ragged import count_each, starts_of

if TYPE_CHECKING:
    from shapely import STRtree

__all__ = ["Nest", "nest"]

_EDGES_IN_BOX = 8
# Rays that meet nothing are made so many times longer; this many are looked at together.
_LONGER = 4
_RAYS = 1024


@dataclass(frozen=True, eq=False)
class Nest:
    """Where several loops meet, and how those lie to each other that do not.

    Parameters
    ----------
    visits : Visits
        Along one loop after the other; edges are counted over all loops.
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

    visits: Visits
    first_visit: Ints
    outside: Ints
    bridges: Ints
    feet: list[tuple[Mark, Mark]]


def nest(loops: Sequence[Floats], watch: Watch = UNWATCHED) -> Nest:
    """Find the crossings of several closed polylines with themselves and each other, and which lies inside which.

    Raises
    ------
    GeneralPositionError
        If a vertex lies on another edge or three edges meet in a point. Nothing is moved.
    TimeLimitError
        If the time is over.

    Notes
    -----
    As for one curve, plus what rays from all groups meet on the left, which is O(n) for each at worst.
    """
    polyline = _one_after_the_other(loops)
    visits = _visits(polyline, watch)
    first_visit = np.searchsorted(polyline.loop[visits.edge], np.arange(len(loops) + 1))
    loop = polyline.loop[visits.edge]
    other = loop[visits.partner]
    group = components(len(loops), loop[loop < other], other[loop < other])
    plan = _Plan(polyline, visits, first_visit, group[polyline.loop])
    corner = _corners(plan)
    dart, beyond = _outer_darts(plan, corner), _met_on_the_left(plan, corner, watch)
    is_free, joined = beyond < 0, np.flatnonzero(beyond >= 0)
    corner, beyond = corner[joined], beyond[joined]
    passed = _visits_passed(plan, beyond, polyline.points[corner, 1])
    met = 2 * plan.border(beyond, passed) + plan.is_upward(beyond)
    feet = zip(_feet_at_vertices(plan, corner), _feet_on_edges(plan, beyond, passed, corner, joined), strict=True)
    return Nest(
        visits=replace(visits, edge=visits.edge - loop),
        first_visit=first_visit,
        outside=dart[is_free],
        bridges=np.stack([dart[joined], met], axis=1),
        feet=list(feet),
    )


# ---- one polyline --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Polyline:
    """All loops as one polyline: each ends with a copy of its first point, and a *jump* leads from there to the next.

    Parameters
    ----------
    points : (n, 2) float
    loop : (n,) int
        The loop of each point and of the edge that starts there.
    vertex : (n,) int
        The first point of the loop for the copies of it, and each other point itself.
    is_jump : (n,) bool
        True where the edge that starts at a point is a jump.
    """

    points: Floats
    loop: Ints
    vertex: Ints
    is_jump: Bools


def _one_after_the_other(loops: Sequence[Floats]) -> _Polyline:
    lengths = np.array([len(points) + 1 for points in loops])
    last = np.cumsum(lengths) - 1
    vertex = np.arange(int(lengths.sum()))
    vertex[last] -= lengths - 1
    return _Polyline(
        points=np.concatenate([part for points in loops for part in (points, points[:1])]),
        loop=np.repeat(np.arange(len(loops)), lengths),
        vertex=vertex,
        is_jump=np.isin(np.arange(len(vertex)), last),
    )


def _visits(polyline: _Polyline, watch: Watch) -> Visits:
    """Return the visits to all crossings along one loop after the other; refuse loops that touch."""
    found = find_contacts(polyline.points, watch, np.flatnonzero(polyline.is_jump))
    touches = _own_touches_left_out(polyline, found.touches)
    contacts = replace(found, touches=touches)
    visits = order_visits(polyline.points, contacts)
    if len(touches) or len(visits.triple):
        raise GeneralPositionError(
            f"the curves are not in general position (vertices on other edges: {len(np.unique(touches[:, 0]))}, "
            f"meetings of three edges: {len(visits.triple)})",
            where=touching_places(polyline.points, contacts, visits),
            hint="move these vertices: several loops are not moved apart, as one is",
        )
    return visits


def _own_touches_left_out(polyline: _Polyline, touches: Ints) -> Ints:
    """Leave out the touches of jumps, and those of edges that share the point with which a loop begins and ends."""
    vertex, edge = polyline.vertex[touches[:, 0]], touches[:, 1]
    following = polyline.vertex[(edge + 1) % len(polyline.vertex)]
    kept = ~polyline.is_jump[edge] & (vertex != edge) & (vertex != following)
    return np.stack([vertex[kept], edge[kept]], axis=1)


# ---- point location ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Plan:
    """The polyline with its visits, to find the border at a place.

    Loops that hang together by crossings are a group; ``group`` has that of each edge.
    """

    polyline: _Polyline
    visits: Visits
    first_visit: Ints
    group: Ints

    @cached_property
    def ends(self) -> Floats:
        """Start and end of each edge; jumps go nowhere."""
        ends = edge_ends(self.polyline.points)
        ends[self.polyline.is_jump, 1] = ends[self.polyline.is_jump, 0]
        return ends

    @cached_property
    def first_border(self) -> Ints:
        """The first border of each loop."""
        return starts_of(np.maximum(np.diff(self.first_visit), 1))

    def border(self, edge: Ints, visits_passed: Ints) -> Ints:
        """Return the borders at places on edges, given how many visits come before them, on earlier loops too."""
        loop = self.polyline.loop[edge]
        start, end = self.first_visit[loop], self.first_visit[loop + 1]
        return np.asarray(self.first_border[loop] + (visits_passed - start - 1) % np.maximum(end - start, 1))

    def is_upward(self, edge: Ints) -> Bools:
        """Tell which edges end higher than they start."""
        return np.asarray(self.ends[edge, 0, 1] < self.ends[edge, 1, 1])


@dataclass(frozen=True, eq=False)
class _Boxes:
    """Bounding boxes of edges that follow each other, so many at a time.

    Parameters
    ----------
    tree : STRtree
        The boxes, as lines from corner to corner.
    first, size : (b,) int
        The first edge in each box, and the number of its edges.
    """

    tree: STRtree
    first: Ints
    size: Ints

    @classmethod
    def at(cls, plan: _Plan, heights: Floats) -> _Boxes:
        """Return the boxes of all edges at some heights; no box holds edges of two loops."""
        from shapely import STRtree, linestrings

        lengths = np.diff(np.flatnonzero(plan.polyline.is_jump), prepend=-1)
        first = np.flatnonzero(count_each(lengths) % _EDGES_IN_BOX == 0)
        start, end = plan.ends.swapaxes(0, 1)
        low = np.minimum.reduceat(np.minimum(start, end), first)
        high = np.maximum.reduceat(np.maximum(start, end), first)
        order = np.sort(heights)
        kept = np.searchsorted(order, low[:, 1]) < np.searchsorted(order, high[:, 1], side="right")
        tree = STRtree(linestrings(np.stack([low[kept], high[kept]], axis=1)))
        return cls(tree, first[kept], np.diff(first, append=len(plan.ends))[kept])

    def near(self, start: Floats, end: Floats, height: Floats) -> tuple[Ints, Ints]:
        """Return the edges in all boxes that level rays meet: (place among the rays, edge) of each."""
        from shapely import linestrings

        rays = np.stack([start, height, end, height], axis=1).reshape(-1, 2, 2)
        ray, box = self.tree.query(linestrings(rays))
        size = self.size[box]
        return np.repeat(ray, size), np.repeat(self.first[box], size) + count_each(size)


def _corners(plan: _Plan) -> Ints:
    """Return the leftmost vertex of each group, the lowest of several, from left to right."""
    x, y = plan.polyline.points.T
    leftmost = np.full(plan.group.max() + 1, np.inf)
    first = np.flatnonzero(np.diff(plan.polyline.loop, prepend=-1))
    np.minimum.at(leftmost, plan.group[first], np.minimum.reduceat(x, first))
    corner = np.flatnonzero((x == leftmost[plan.group]) & ~plan.polyline.is_jump)
    corner = corner[np.lexsort([y[corner], x[corner]])]
    return np.asarray(corner[np.sort(np.unique(plan.group[corner], return_index=True)[1])])


def _outer_darts(plan: _Plan, corner: Ints) -> Ints:
    """Return the darts that have the outside of their groups on their left at leftmost vertices."""
    points, is_jump, loop = plan.polyline.points, plan.polyline.is_jump, plan.polyline.loop[corner]
    # The first vertex of a loop comes again at its end, where the jump starts.
    before = np.where(is_jump[corner - 1], np.flatnonzero(is_jump)[loop], corner) - 1
    border = plan.border(corner, np.searchsorted(plan.visits.edge, corner))
    turn = cross_sign(points[before], points[corner], points[corner], points[corner + 1])
    return np.asarray(2 * border + (turn > 0))


def _feet_at_vertices(plan: _Plan, corner: Ints) -> Iterator[Mark]:
    """Yield the feet of the bridges that leave leftmost vertices; they come after cusps there."""
    loop, at = plan.polyline.loop[corner], np.searchsorted(plan.visits.edge, corner)
    columns = (corner - loop, at, loop, plan.polyline.points[corner])
    for edge, passed, number, (x, y) in zip(*(column.tolist() for column in columns), strict=True):
        yield Mark(edge, AT_VERTEX, 1, passed, number, (x, y))


def _feet_on_edges(plan: _Plan, edge: Ints, passed: Ints, corner: Ints, number: Ints) -> Iterator[Mark]:
    """Yield the feet of the bridges from vertices to edges on their left: a little higher than the vertices.

    Later ones, which come from further right, are higher if the vertices have one height: they pass above.
    """
    height, loop = plan.polyline.points[corner, 1], plan.polyline.loop[edge]
    start, end = plan.ends[edge].swapaxes(0, 1)
    x = start[:, 0] + rounded_shares(start[:, 1], end[:, 1], height) * (end[:, 0] - start[:, 0])
    upward = np.where(plan.is_upward(edge), 1, -1)
    columns = (edge - loop, upward * height, upward * (2 + number), passed, loop, x, height)
    for at_edge, along, tie, at, on, *place in zip(*(column.tolist() for column in columns), strict=True):
        yield Mark(at_edge, along, tie, at, on, tuple(place))


def _met_on_the_left(plan: _Plan, corner: Ints, watch: Watch) -> Ints:
    """Return the edge of the other groups that a ray from each vertex to the left meets first; −1 if it meets none.

    The rays run a little higher than the vertices, by less than any other difference in height. So they meet no
    vertices and no crossings. They are short at first: most meet something soon.
    """
    x, y = plan.polyline.points.T
    boxes = _Boxes.at(plan, y[corner])
    leftmost, rightmost = float(x.min()), float(x.max())
    met = np.full(len(corner), -1)
    waiting, reach = np.arange(len(corner)), (rightmost - leftmost) / len(corner)
    while len(waiting):
        reach *= _LONGER
        with np.errstate(over="ignore"):
            end = np.maximum(x[corner[waiting]] - reach, leftmost)
        is_known = end == leftmost
        for start in range(0, len(waiting), _RAYS):
            watch.step()
            some = slice(start, start + _RAYS)
            met[waiting[some]], is_near = _first_met(plan, boxes, corner[waiting[some]], end[some])
            is_known[some] |= is_near
        waiting = waiting[~is_known]
    return met


def _first_met(plan: _Plan, boxes: _Boxes, corner: Ints, end: Floats) -> tuple[Ints, Bools]:
    """Return the edge that each ray meets first, −1 for none, of those in the boxes on its way to an end.

    And for which rays that is before the end, so that no others matter.
    """
    x, height = plan.polyline.points[corner].T
    ray, edge = boxes.near(end, x, height)
    low = plan.ends[edge, :, 1] <= height[ray, None]
    met = (plan.group[edge] != plan.group[corner[ray]]) & (low[:, 0] != low[:, 1])
    ray, edge = ray[met], edge[met]
    place, error = _rounded_places(plan.ends[edge], height[ray])
    surely = place + error < x[ray]
    least = np.full(len(corner), -np.inf)
    np.maximum.at(least, ray[surely], (place - error)[surely])
    nearest = (place + error >= least[ray]) & (place - error < x[ray])
    ray, edge, surely = ray[nearest], edge[nearest], surely[nearest]
    first = np.full(len(corner), -1)
    is_open = np.bincount(ray, minlength=len(corner)) > 1
    is_open[ray[~surely]] = True
    first[ray] = edge
    for number in np.flatnonzero(is_open).tolist():
        first[number] = _exactly_first(plan, corner[number], edge[ray == number])
    return first, least >= end


def _rounded_places(ends: Floats, height: Floats) -> tuple[Floats, Floats]:
    """Return the x at which edges pass heights, and bounds of the errors."""
    (start_x, start_y), (end_x, end_y) = ends.transpose(1, 2, 0)
    place = start_x + (height - start_y) / (end_y - start_y) * (end_x - start_x)
    return place, 16 * np.finfo(np.float64).eps * (np.abs(start_x) + np.abs(end_x)) + np.finfo(np.float64).tiny


def _exactly_first(plan: _Plan, corner: int, edges: Ints) -> int:
    """Return which of some edges a ray to the left meets first, by fractions; −1 if all are on the right."""
    x, height = plan.polyline.points[corner].tolist()
    places = {edge: _place_and_slope(plan.ends[edge], height) for edge in edges.tolist()}
    passed = [edge for edge, (place, _) in places.items() if place < x]
    return max(passed, key=places.__getitem__, default=-1)


def _place_and_slope(edge: Floats, height: float) -> tuple[Fraction, Fraction]:
    """Return the x at which an edge passes a height, and the growth of x with the height."""
    (x, y), (end_x, end_y) = [[Fraction(value) for value in point] for point in edge.tolist()]
    slope = (end_x - x) / (end_y - y)
    return x + (Fraction(height) - y) * slope, slope


def _visits_passed(plan: _Plan, edge: Ints, height: Floats) -> Ints:
    """Return how many visits come before the places on edges a little above some heights."""
    first, last = (np.searchsorted(plan.visits.edge, edge, side) for side in ("left", "right"))
    passed = first.copy()
    for i in np.flatnonzero(first < last).tolist():
        (_, start), (_, end) = plan.ends[edge[i]].tolist()
        share = (Fraction(height[i].item()) - Fraction(start)) / (Fraction(end) - Fraction(start))
        bisect = bisect_right if start < end else bisect_left
        passed[i] = bisect(range(last[i]), share, int(first[i]), key=partial(_share_of_visit, plan))
    return passed


def _share_of_visit(plan: _Plan, visit: int) -> Fraction:
    """Return how far along its edge a visit is."""
    edge = plan.visits.edge[[visit, plan.visits.partner[visit]]]
    return exact_parameter(*plan.ends[edge].reshape(4, 2))
