"""Several closed curves in one plane: their visits to all crossings, and in which cell of the others each group lies.

Loops that cross hang together in groups. Within a group everything is as for one curve. A group lies in one cell of the
others; exact point location says in which: from its leftmost vertex straight to the left.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from plyfold.arrangement.crossings import Contacts, Visits, edge_ends, find_contacts, order_visits
from plyfold.arrangement.general_position import touching_places
from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GeneralPositionError
from plyfold.graphs import components
from plyfold.outline.curve import Curve
from plyfold.predicates import cross_sign, exact_parameter
from plyfold.ragged import starts_of

__all__ = ["Nest", "nest"]


@dataclass(frozen=True, eq=False)
class Nest:
    """Where several loops meet, and how those lie to each other that do not.

    Parameters
    ----------
    visits : Visits
        Along one loop after the other; each edge is one of its own loop.
    first_visit : (loops + 1,) int
        The number of each loop's first visit, and last the number of visits.
    outside : tuple of int
        Darts of the unbounded cell, one of each group that lies in it with nothing on its left; that of the leftmost
        vertex of all first.
    bridges : (b, 2) int
        For each other group the dart at its leftmost vertex, and the dart met to the left of it. Both have the cell
        between them on their left.
    """

    visits: Visits
    first_visit: Ints
    outside: tuple[int, ...]
    bridges: Ints


def nest(curves: Sequence[Curve], watch: Watch = UNWATCHED) -> Nest:
    """Find the crossings of several closed curves with themselves and each other, and which lies inside which.

    Raises
    ------
    GeneralPositionError
        If a vertex lies on another edge or three edges meet in a point. Nothing is moved.
    TimeLimitError
        If the time is over.

    Notes
    -----
    As for one curve, plus O(n) for each group.
    """
    polyline = _one_after_the_other(curves)
    visits = _visits(polyline, watch)
    first_visit = np.searchsorted(polyline.loop[visits.edge], np.arange(len(curves) + 1))
    plan = _Plan(polyline, visits, first_visit)
    loop = polyline.loop[visits.edge]
    group = components(len(curves), loop, loop[visits.partner])
    outside, bridges = [], []
    for corner, own in sorted(_corners(polyline, group), key=lambda found: tuple(polyline.points[found[0]])):
        watch.step()
        dart, beyond = _outer_dart(plan, corner), _dart_on_the_left(plan, corner, own)
        if beyond is None:
            outside.append(dart)
        else:
            bridges.append((dart, beyond))
    return Nest(
        visits=replace(visits, edge=visits.edge - polyline.first_edge[loop]),
        first_visit=first_visit,
        outside=tuple(outside),
        bridges=np.array(bridges, dtype=np.int64).reshape(-1, 2),
    )


# ---- one polyline --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Polyline:
    """All loops as one polyline: each ends with a copy of its first point, and a *jump* leads from there to the next.

    Parameters
    ----------
    points : (n, 2) float
    first_edge : (loops,) int
        Where each loop starts.
    loop : (n,) int
        The loop of each point and of the edge that starts there.
    vertex : (n,) int
        The first point of the loop for the copies of it, and each other point itself.
    is_jump : (n,) bool
        True where the edge that starts at a point is a jump.
    """

    points: Floats
    first_edge: Ints
    loop: Ints
    vertex: Ints
    is_jump: Bools


def _one_after_the_other(curves: Sequence[Curve]) -> _Polyline:
    lengths = np.array([len(curve) + 1 for curve in curves])
    last = np.cumsum(lengths) - 1
    vertex = np.arange(int(lengths.sum()))
    vertex[last] -= lengths - 1
    return _Polyline(
        points=np.concatenate([points for curve in curves for points in (curve.points, curve.points[:1])]),
        first_edge=starts_of(lengths),
        loop=np.repeat(np.arange(len(curves)), lengths),
        vertex=vertex,
        is_jump=np.isin(np.arange(len(vertex)), last),
    )


def _visits(polyline: _Polyline, watch: Watch) -> Visits:
    """Return the visits to all crossings along one loop after the other; refuse loops that touch."""
    found = find_contacts(polyline.points, watch)
    edges, touches = found.edges, _own_touches_left_out(polyline, found.touches)
    real = ~polyline.is_jump[edges].any(axis=1)
    contacts = Contacts(edges[real], found.from_right[real], touches, found.exact_signs)
    visits = order_visits(polyline.points, contacts)
    if len(touches) or len(visits.triple):
        raise GeneralPositionError(
            f"the curves are not in general position (vertices on other edges: {len(np.unique(touches[:, 0]))}, "
            f"meetings of three edges: {len(visits.triple)})",
            where=touching_places(polyline.points, contacts, visits),
            hint="move these vertices",
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
    """The polyline with its visits, to find the border at a place."""

    polyline: _Polyline
    visits: Visits
    first_visit: Ints

    def border(self, edge: int, visits_passed: int) -> int:
        """Return the border at a place on an edge, given how many visits come before it, on earlier loops too."""
        loop = int(self.polyline.loop[edge])
        start, count = int(self.first_visit[loop]), np.diff(self.first_visit)
        return int(starts_of(np.maximum(count, 1))[loop] + (visits_passed - start - 1) % max(int(count[loop]), 1))


def _corners(polyline: _Polyline, group: Ints) -> list[tuple[int, Bools]]:
    """Return the leftmost vertex of each group, the lowest of several, and which edges are the group's."""
    group_of_edge = group[polyline.loop]
    x, y = polyline.points.T
    order = np.lexsort([y, x])
    order = order[~polyline.is_jump[order]]
    corner = order[np.unique(group_of_edge[order], return_index=True)[1]]
    return [(int(vertex), group_of_edge == number) for number, vertex in enumerate(corner)]


def _outer_dart(plan: _Plan, corner: int) -> int:
    """Return the dart that has the outside of its group on its left at a leftmost vertex."""
    polyline = plan.polyline
    copies = np.flatnonzero(polyline.vertex == corner)
    before, here, after = polyline.points[[copies[-1] - 1, corner, corner + 1]]
    border = plan.border(corner, int(np.searchsorted(plan.visits.edge, corner)))
    return 2 * border + int(cross_sign(before, here, here, after) > 0)


def _dart_on_the_left(plan: _Plan, corner: int, own: Bools) -> int | None:
    """Return the dart of the other groups that a ray from a vertex to the left meets first, on the side that it meets.

    The ray runs a little higher than the vertex, by less than any other difference in height. So it meets no vertices
    and no crossings.
    """
    polyline = plan.polyline
    x, height = polyline.points[corner]
    ends = edge_ends(polyline.points)
    low = ends[:, :, 1] <= height
    met = ~own & ~polyline.is_jump & (low[:, 0] != low[:, 1]) & (ends[:, :, 0].min(axis=1) < x)
    places = {edge: _place_and_slope(ends[edge], height) for edge in np.flatnonzero(met).tolist()}
    here = Fraction(float(x))
    passed = [edge for edge, (place, _) in places.items() if place < here]
    if not passed:
        return None
    edge = max(passed, key=places.__getitem__)
    upward = bool(low[edge, 0])
    return 2 * plan.border(edge, _visits_passed(plan.visits, ends, edge, height, upward)) + upward


def _place_and_slope(edge: Floats, height: float) -> tuple[Fraction, Fraction]:
    """Return the x at which an edge passes a height, and the growth of x with the height."""
    (x, y), (end_x, end_y) = [[Fraction(value) for value in point] for point in edge.tolist()]
    slope = (end_x - x) / (end_y - y)
    return x + (Fraction(float(height)) - y) * slope, slope


def _visits_passed(visits: Visits, ends: Floats, edge: int, height: float, upward: bool) -> int:
    """Return how many visits come before the place at which an edge passes a little above a height."""
    (_, y), (_, end_y) = [[Fraction(value) for value in point] for point in ends[edge].tolist()]
    here = (Fraction(float(height)) - y) / (end_y - y)
    first, last = np.searchsorted(visits.edge, [edge, edge + 1]).tolist()
    other = visits.edge[visits.partner[first:last]].tolist()
    places = [exact_parameter(*ends[edge], *ends[crossing]) for crossing in other]
    return int(first) + sum(place < here or (upward and place == here) for place in places)
