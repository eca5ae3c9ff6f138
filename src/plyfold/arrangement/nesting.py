"""Several closed curves in one plane: in which cell of the others each group of them lies that hangs together.

Loops that cross hang together in groups. Within a group everything is as for one curve. A group lies in one cell of the
others; exact point location says in which: from its leftmost vertex straight to the left.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from plyfold.arrangement.crossings import Visits
from plyfold.arrangement.marks import AT_VERTEX, Mark
from plyfold.arrangement.meetings import JoinedLoops
from plyfold.arrays import Bools, Floats, Ints, Wholes
from plyfold.clock import UNWATCHED, Watch
from plyfold.graphs import components
from plyfold.predicates import Place, exact_cross, orient, whole_numbers
from plyfold.ragged import count_each, starts_of

if TYPE_CHECKING:
    from shapely import STRtree

__all__ = ["Nest", "nest", "same_nest"]

_EDGES_IN_BOX = 8
# Rays that meet nothing are made so many times longer; this many are looked at together.
_LONGER = 4
_RAYS = 1024
# So few pairs of rays and loops, or of rays and edges, are looked at without boxes.
_ALL_PAIRS = 2**17


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
    What rays from all groups meet on the left, which is O(n) for each at worst.
    """
    start = np.flatnonzero(~joined.is_jump)
    visits = replace(visits, edge=start[visits.edge])
    loop, n_loops = joined.loop[visits.edge], int(joined.loop[-1]) + 1
    first_visit = np.searchsorted(loop, np.arange(n_loops + 1))
    other = loop[visits.partner]
    group = components(n_loops, loop[loop < other], other[loop < other])
    plan = _Plan(joined, visits, first_visit, group, exact)
    corner = _corners(plan)
    dart, beyond = _outer_darts(plan, corner), _met_on_the_left(plan, corner, watch)
    is_free, number = beyond < 0, np.flatnonzero(beyond >= 0)
    corner, beyond = corner[number], beyond[number]
    passed = _visits_passed(plan, beyond, corner)
    met = 2 * plan.border(beyond, passed) + plan.is_upward(beyond)
    feet = zip(_feet_at_vertices(plan, corner), _feet_on_edges(plan, beyond, passed, corner, number), strict=True)
    return Nest(
        first_visit=first_visit,
        outside=dart[is_free],
        bridges=np.stack([dart[number], met], axis=1),
        feet=list(feet),
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

    Loops that hang together by crossings are a group; ``group`` has that of each loop. ``exact`` are places to which
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

    @cached_property
    def height(self) -> Floats | Ints:
        """The heights of the points, or numbers in the same order."""
        return self._along(1)

    @cached_property
    def across(self) -> Floats | Ints:
        """How far right the points are, or numbers in the same order."""
        return self._along(0)

    def _along(self, axis: int) -> Floats | Ints:
        return self.joined.points[:, axis].copy() if self.exact is None else _ranks(self.exact[:, axis])

    @cached_property
    def first(self) -> Ints:
        """The first point of each loop, and last the number of points."""
        return self.joined.first_point + np.arange(len(self.joined.first_point))

    @cached_property
    def left(self) -> Floats | Ints:
        """How far right the leftmost point of each loop is."""
        return np.asarray(np.minimum.reduceat(self.across, self.first[:-1]))

    def ends(self, edge: Ints) -> Floats:
        """Return start and end of some edges."""
        return self.joined.points[np.stack([edge, edge + 1], axis=1)]

    @cached_property
    def first_border(self) -> Ints:
        """The first border of each loop."""
        return starts_of(np.maximum(np.diff(self.first_visit), 1))

    def border(self, edge: Ints, visits_passed: Ints) -> Ints:
        """Return the borders at places on edges, given how many visits come before them, on earlier loops too."""
        loop = self.joined.loop[edge]
        start, end = self.first_visit[loop], self.first_visit[loop + 1]
        return np.asarray(self.first_border[loop] + (visits_passed - start - 1) % np.maximum(end - start, 1))

    def is_upward(self, edge: Ints) -> Bools:
        """Tell which edges end higher than they start."""
        return np.asarray(self.height[edge] < self.height[edge + 1])


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

        n_edges = plan.joined.first_point[1:] - plan.joined.first_point[:-1]
        boxes = -(-n_edges // _EDGES_IN_BOX)
        place = _EDGES_IN_BOX * count_each(boxes)
        first = np.repeat(starts_of(n_edges + 1), boxes) + place
        size = np.minimum(np.repeat(n_edges, boxes) - place, _EDGES_IN_BOX)
        low, high = _extremes(plan.joined.points[:, 1], first, size)
        order = np.sort(heights)
        kept = np.searchsorted(order, low) < np.searchsorted(order, high, side="right")
        left, right = _extremes(plan.joined.points[:, 0], first, size)
        corners = np.stack([left, low, right, high], axis=1)[kept]
        return cls(STRtree(linestrings(corners.reshape(-1, 2, 2))), first[kept], size[kept])

    def near(self, start: Floats, end: Floats, height: Floats) -> tuple[Ints, Ints]:
        """Return the edges in all boxes that level rays meet: (place among the rays, edge) of each."""
        from shapely import linestrings

        rays = np.stack([start, height, end, height], axis=1).reshape(-1, 2, 2)
        ray, box = self.tree.query(linestrings(rays))
        size = self.size[box]
        return np.repeat(ray, size), np.repeat(self.first[box], size) + count_each(size)


def _extremes(values: Floats, first: Ints, size: Ints) -> tuple[Floats, Floats]:
    """Return the least and the largest value at the ends of so many edges from each first one on."""
    end = values[first + size]
    return (
        np.minimum(np.minimum.reduceat(values, first), end),
        np.maximum(np.maximum.reduceat(values, first), end),
    )


def _corners(plan: _Plan) -> Ints:
    """Return the leftmost vertex of each group, the lowest of several, from left to right."""
    x, y, loop = plan.across, plan.height, plan.joined.loop
    leftmost = np.full(plan.group.max() + 1, np.inf)
    np.minimum.at(leftmost, plan.group, plan.left)
    corner = np.flatnonzero(x == leftmost[plan.group].repeat(plan.first[1:] - plan.first[:-1]))
    corner = corner[~plan.joined.is_jump[corner]]
    corner = corner[np.lexsort([y[corner], x[corner]])]
    return np.asarray(corner[np.sort(np.unique(plan.group[loop[corner]], return_index=True)[1])])


def _ranks(numbers: Wholes) -> Ints:
    return np.unique(numbers, return_inverse=True)[1].ravel()


def _outer_darts(plan: _Plan, corner: Ints) -> Ints:
    """Return the darts that have the outside of their groups on their left at leftmost vertices."""
    is_first = (corner == 0) | plan.joined.is_jump[corner - 1]
    # The first vertex of a loop comes again at its end.
    last = np.searchsorted(plan.joined.loop, plan.joined.loop[corner], side="right") - 1
    before = np.where(is_first, last, corner) - 1
    border = plan.border(corner, np.searchsorted(plan.visits.edge, corner))
    return np.asarray(2 * border + _turn_left(plan, before, corner, corner + 1))


def _turn_left(plan: _Plan, before: Ints, here: Ints, after: Ints) -> Bools:
    if plan.exact is None:
        return np.asarray(orient(*(plan.joined.points[point] for point in (before, here, after))) > 0)
    p, q, r = (plan.exact[point].T for point in (before, here, after))
    return np.asarray((q[0] - p[0]) * (r[1] - q[1]) > (q[1] - p[1]) * (r[0] - q[0]), dtype=bool)


def _feet_at_vertices(plan: _Plan, corner: Ints) -> Iterator[Mark]:
    """Yield the feet of the bridges that leave leftmost vertices; they come after cusps there."""
    loop, at = plan.joined.loop[corner], np.searchsorted(plan.visits.edge, corner)
    columns = (corner - loop, at, loop, plan.joined.points[corner])
    for edge, passed, number, (x, y) in zip(*(column.tolist() for column in columns), strict=True):
        yield Mark(edge, AT_VERTEX, 1, passed, number, (x, y))


def _feet_on_edges(plan: _Plan, edge: Ints, passed: Ints, corner: Ints, number: Ints) -> Iterator[Mark]:
    """Yield the feet of the bridges from vertices to edges on their left: a little higher than the vertices.

    Later ones, which come from further right, are higher if the vertices have one height: they pass above.
    """
    height, loop = plan.joined.points[corner, 1], plan.joined.loop[edge]
    (start, _), (end, _) = plan.ends(edge).transpose(1, 2, 0)
    x = start + _shares(plan, edge, corner) * (end - start)
    upward = np.where(plan.is_upward(edge), 1, -1)
    columns = (edge - loop, upward * plan.height[corner], upward * (2 + number), passed, loop, x, height)
    for at_edge, along, tie, at, on, *place in zip(*(column.tolist() for column in columns), strict=True):
        yield Mark(at_edge, along, tie, at, on, tuple(place))


def _shares(plan: _Plan, edge: Ints, corner: Ints) -> Floats:
    """Return how far along edges the heights of vertices are, each share to the nearest double."""
    points = np.stack([edge, edge + 1, corner])
    whole = plan.exact[points, 1] if plan.exact is not None else whole_numbers(plan.joined.points[points, 1])[0]
    start, end, between = whole
    return np.asarray((between - start) / (end - start), dtype=np.float64)


def _met_on_the_left(plan: _Plan, corner: Ints, watch: Watch) -> Ints:
    """Return the edge of the other groups that a ray from each vertex to the left meets first; −1 if it meets none.

    The rays run a little higher than the vertices, by less than any other difference in height. So they meet no
    vertices and no crossings. They are short at first: most meet something soon.
    """
    if (few := _few_at_heights(plan, corner)) is not None:
        return _first_met(plan, corner, *few)[0]
    x, y = plan.joined.points.T
    boxes = _Boxes.at(plan, y[corner])
    leftmost, rightmost = float(x.min()), float(x.max())
    met = np.full(len(corner), -1)
    waiting, reach = np.arange(len(corner)), (rightmost - leftmost) / len(corner)
    if plan.exact is not None:  # places are not compared with the ends of rays, which are doubles
        reach = np.inf
    while len(waiting):
        reach *= _LONGER
        with np.errstate(over="ignore"):
            end = np.maximum(x[corner[waiting]] - reach, leftmost)
        is_known = end == leftmost
        for start in range(0, len(waiting), _RAYS):
            watch.step()
            some = slice(start, start + _RAYS)
            here = corner[waiting[some]]
            met[waiting[some]], nearest = _first_met(plan, here, *_near_at_heights(plan, boxes, here, end[some]))
            is_known[some] |= nearest >= end[some]
        waiting = waiting[~is_known]
    return met


def _few_at_heights(plan: _Plan, corner: Ints) -> tuple[Ints, Ints] | None:
    """Return edges that pass heights of vertices, among them the first that each ray meets; None if they are many."""
    if len(corner) * len(plan.left) <= _ALL_PAIRS:
        ray, loop = _loops_perhaps_met(plan, corner)
        if (plan.first[loop + 1] - plan.first[loop]).sum() <= 2 * len(plan.height):
            return _of_loops_at_heights(plan, corner, ray, loop)
    return _all_at_heights(plan, corner) if len(corner) * len(plan.height) <= _ALL_PAIRS else None


def _loops_perhaps_met(plan: _Plan, corner: Ints) -> tuple[Ints, Ints]:
    """Return the loops of other groups that rays from vertices to the left may meet first: (place among these, loop).

    A ray meets every loop on the left of it that comes as high and as low, and so none that lies further left than all
    of such a loop.
    """
    x, level, first = plan.across[corner, None], plan.height[corner, None], plan.first[:-1]
    low, high = np.minimum.reduceat(plan.height, first), np.maximum.reduceat(plan.height, first)
    right = np.maximum.reduceat(plan.across, first)
    is_met = (low <= level) & (level < high) & (plan.left < x)
    is_met &= plan.group != plan.group[plan.joined.loop[corner], None]
    beyond = np.where(is_met & (right < x), plan.left, -np.inf).max(axis=1, keepdims=True)
    ray, loop = (is_met & (right >= beyond)).nonzero()
    return ray, loop


def _all_at_heights(plan: _Plan, corner: Ints) -> tuple[Ints, Ints]:
    """Return all edges that pass heights of vertices: (place among these, edge) of each."""
    is_low = plan.height <= plan.height[corner, None]
    ray, edge = (is_low[:, :-1] != is_low[:, 1:]).nonzero()
    return ray, edge


def _of_loops_at_heights(plan: _Plan, corner: Ints, ray: Ints, loop: Ints) -> tuple[Ints, Ints]:
    """Return all edges of some loops that pass heights of vertices: (place among these, edge) of each."""
    size = plan.first[loop + 1] - plan.first[loop] - 1
    edge = plan.first[loop].repeat(size) + count_each(size)
    level = plan.height[corner[ray]].repeat(size)
    passing = np.flatnonzero((plan.height[edge] <= level) != (plan.height[edge + 1] <= level))
    return ray.repeat(size)[passing], edge[passing]


def _near_at_heights(plan: _Plan, boxes: _Boxes, corner: Ints, end: Floats) -> tuple[Ints, Ints]:
    """Return those in the boxes on the way from vertices to ends on their left."""
    x, height = plan.joined.points[corner].T
    ray, edge = boxes.near(end, x, height)
    level = plan.height[corner[ray]]
    met = (plan.height[edge] <= level) != (plan.height[edge + 1] <= level)
    return ray[met], edge[met]


def _first_met(plan: _Plan, corner: Ints, ray: Ints, edge: Ints) -> tuple[Ints, Floats]:
    """Return the edge that each ray meets first, −1 for none, of some that pass its height; and where, about.

    It is not further to the left than that place, which is −∞ if the ray met nothing.
    """
    group = plan.group[plan.joined.loop[np.stack([edge, corner[ray]])]]
    others = (group[0] != group[1]) & ~plan.joined.is_jump[edge]
    ray, edge = ray[others], edge[others]
    if plan.exact is not None:
        return _exactly_first(plan, corner, ray, edge, np.arange(len(corner))), np.full(len(corner), np.inf)
    x, height = plan.joined.points[corner].T
    place, error = _rounded_places(plan.ends(edge), height[ray])
    surely = place + error < x[ray]
    least = np.full(len(corner), -np.inf)
    np.maximum.at(least, ray[surely], (place - error)[surely])
    nearest = (place + error >= least[ray]) & (place - error < x[ray])
    ray, edge, surely = ray[nearest], edge[nearest], surely[nearest]
    is_open = np.bincount(ray, minlength=len(corner)) > 1
    is_open[ray[~surely]] = True
    first = _exactly_first(plan, corner, ray, edge, np.flatnonzero(is_open))
    first[ray[~is_open[ray]]] = edge[~is_open[ray]]
    return first, least


def _rounded_places(ends: Floats, height: Floats) -> tuple[Floats, Floats]:
    """Return the x at which edges pass heights, and bounds of the errors."""
    (start_x, start_y), (end_x, end_y) = ends.transpose(1, 2, 0)
    place = start_x + (height - start_y) / (end_y - start_y) * (end_x - start_x)
    return place, 16 * np.finfo(np.float64).eps * (np.abs(start_x) + np.abs(end_x)) + np.finfo(np.float64).tiny


def _exactly_first(plan: _Plan, corner: Ints, ray: Ints, edge: Ints, asked: Ints) -> Ints:
    """Return which edge some rays to the left meet first, in whole numbers; −1 of all others, and if none is there.

    ``ray`` and ``edge`` are what the rays may meet.
    """
    first = np.full(len(corner), -1)
    is_asked = np.isin(ray, asked)
    ray, edge = ray[is_asked], edge[is_asked]
    met: dict[int, _Meeting] = {}
    for number, other, meeting in zip(ray.tolist(), edge.tolist(), _meetings(plan, corner[ray], edge), strict=True):
        if meeting.is_passed and (number not in met or meeting.is_beyond(met[number])):
            met[number], first[number] = meeting, other
    return first


class _Meeting(NamedTuple):
    """Where a ray meets an edge: so far right, and by how much further a little higher, both divided by a number."""

    place: int
    slope: int
    below: int
    is_passed: bool

    def is_beyond(self, other: _Meeting) -> bool:
        """Tell whether it is further to the right than another one."""
        here, there = self.place * other.below, other.place * self.below
        return here > there or (here == there and self.slope * other.below > other.slope * self.below)


def _meetings(plan: _Plan, corner: Ints, edge: Ints) -> Iterator[_Meeting]:
    """Yield where rays from vertices to the left meet edges, in whole numbers; they pass those that are on the left."""
    needed, which = np.unique(np.stack([corner, edge, edge + 1]), return_inverse=True)
    places = whole_numbers((plan.joined.points if plan.exact is None else plan.exact)[needed])[0]
    (here, level), (x, y), (end_x, end_y) = places[which.reshape(3, -1)].transpose(0, 2, 1)
    below, slope = end_y - y, end_x - x
    sign = np.where(below > 0, 1, -1)
    below, slope = sign * below, sign * slope
    place = x * below + (level - y) * slope
    yield from map(_Meeting, place.tolist(), slope.tolist(), below.tolist(), (place < here * below).tolist())


def _visits_passed(plan: _Plan, edge: Ints, corner: Ints) -> Ints:
    """Return how many visits come before the places on edges a little above the heights of vertices."""
    first, last = (np.searchsorted(plan.visits.edge, edge, side) for side in ("left", "right"))
    passed = first.copy()
    for i in np.flatnonzero(first < last).tolist():
        (_, start), (_, end), (_, height) = (plan.place(point) for point in (edge[i], edge[i] + 1, corner[i]))
        bisect = bisect_right if start < end else bisect_left
        share = (height - start) / (end - start)
        passed[i] = bisect(range(last[i]), share, int(first[i]), key=partial(_share_of_visit, plan))
    return passed


def _share_of_visit(plan: _Plan, visit: int) -> Fraction:
    """Return how far along its edge a visit is."""
    edge, other = plan.visits.edge[[visit, plan.visits.partner[visit]]].tolist()
    start, end, p, q = map(plan.place, (edge, edge + 1, other, other + 1))
    return exact_cross(start, p, p, q) / exact_cross(start, end, p, q)
