"""The order in which a line that moves over the plane comes to the vertices of a curve and to its crossings."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple, TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints, Reals
from plyfold.immersion.corners import feet
from plyfold.mesh.refine import drawn_outline
from plyfold.predicates import cross_sign, exact_parameter, parameter_along_edge

__all__ = ["TILTS", "SweepPlan", "sweep_order", "sweep_plan"]

_Place: TypeAlias = tuple[Fraction, Fraction]

# The line is tilted, so that in drawings along the axes it does not come to many places at once. It takes another tilt
# where touching strands that were moved apart lie along it.
TILTS = 0.3, -0.4, 0.7, -1.1, 1.9
# The rounding error of x + tilt · y, as a part of the sizes of the two, is less than this; the same for interpolation.
_ERROR = 1e-15


class SweepPlan(NamedTuple):
    """The points and edges of a drawing, and the places that the line comes to.

    Edge i runs from point i to ``following[i]``. After the ``n_vertices`` of the outline come the first feet of some
    bridges, then their second feet. ``first_foot`` are vertices, ``second_foot`` visits; ``above`` tells which bridges
    begin above the edge with their second foot, as seen along the line. ``visit`` are the visits that the line comes
    to: the first ones to crossings, and second feet. There ``edge`` and ``other`` cross, of which one may be a bridge.
    The line is where x + ``tilt`` · y is some number. ``points`` are rounded if ``exact`` has fractions.
    """

    points: Floats
    exact: Reals
    following: Ints
    n_vertices: int
    bridges: Ints
    first_foot: Ints
    second_foot: Ints
    above: Ints
    visit: Ints
    edge: Ints
    other: Ints
    tilt: float


def sweep_plan(arrangement: Arrangement, bridges: Ints, tilt: float = TILTS[0]) -> SweepPlan:
    """Return what a line sweeps over: a drawing, and some of its bridges."""
    outline = drawn_outline(arrangement)
    n, count = len(outline), len(bridges)
    first, second = feet(arrangement).reshape(2, -1)[:, bridges]
    start, place = arrangement.visit_edge[first], arrangement.visit_point[second]
    points, exact = outline.points, arrangement.exact_points
    if count:
        points = np.concatenate([points, points[start], np.column_stack([place[:, 0], points[start, 1]])])
        exact = np.concatenate([exact, exact[start], _ends_of_bridges(exact[start], place)])
    following = np.concatenate([outline.next_point, n + count + np.arange(count), n + np.arange(count)])
    visit = arrangement.first_visits
    edge, other = arrangement.visit_edge[visit], arrangement.visit_edge[arrangement.partner[visit]]
    return SweepPlan(
        points=points,
        exact=exact,
        following=following,
        n_vertices=n,
        bridges=bridges,
        first_foot=start,
        second_foot=second,
        above=_leave_above(exact, outline.next_point, arrangement.visit_edge[second], tilt),
        visit=np.concatenate([visit, second]),
        edge=np.concatenate([edge, arrangement.visit_edge[second]]),
        other=np.concatenate([other, n + np.arange(count)]),
        tilt=tilt,
    )


def _ends_of_bridges(start: Reals, end: Floats) -> Reals:
    """Return where bridges end, or other places on the same level: they run to the left, however short they are."""
    x, y = start.T
    return np.column_stack([end[:, 0] if start.dtype != object else x - 1, y])


def _leave_above(points: Reals, next_point: Ints, edge: Ints, tilt: float) -> Ints:
    """Tell whether what leaves edges to the right is above them on the line: they fall as the line comes along them."""
    start, end = points[edge], points[next_point[edge]]
    along = cross_sign(start, end, np.zeros(2), np.array([-tilt, 1.0]))
    rises = (end[:, 1] > start[:, 1]).astype(np.int64) - (end[:, 1] < start[:, 1])
    return (rises * along < 0).astype(np.int64)


def sweep_order(plan: SweepPlan) -> Ints:
    """Return the vertices and crossings of a drawing by x + tilt · y, then by y, exactly.

    Parameters
    ----------
    plan : SweepPlan
        With n vertices.

    Returns
    -------
    (n + k + bridges,) int
        Vertices by number; crossings by their first visits, and feet by theirs, n more than that.

    Notes
    -----
    O((n + k) log n), and some microseconds for each place that rounding leaves unsure.
    """
    n = plan.n_vertices
    with np.errstate(over="ignore", invalid="ignore"):
        reach, error = _reach(plan.points, plan.tilt)
        if len(plan.visit):
            more = _reach_of_crossings(plan, reach, error)
            reach, error = np.concatenate([reach[:n], more[0]]), np.concatenate([error[:n], more[1]])
    order = np.argsort(reach)
    events = np.arange(len(reach))[order]
    _sort_unsure(plan, events, reach[order], error[order])
    return np.concatenate([np.arange(n), n + plan.visit])[events]


def _reach(points: Floats, tilt: float) -> tuple[Floats, Floats]:
    """Return how far the line has come at each point, and a bound on the error."""
    x, y = points.T
    tilted = tilt * y
    return x + tilted, _ERROR * (np.abs(x) + np.abs(tilted))


def _reach_of_crossings(plan: SweepPlan, reach: Floats, error: Floats) -> tuple[Floats, Floats]:
    """Return the same for the crossings of some edges with others."""
    points, start, end = plan.points, plan.edge, plan.following[plan.edge]
    parameter, unsure = parameter_along_edge(
        points[start], points[end], points[plan.other], points[plan.following[plan.other]]
    )
    along = reach[end] - reach[start]
    return reach[start] + parameter * along, unsure * np.abs(along) + 3 * (error[start] + error[end])


def _sort_unsure(plan: SweepPlan, events: Ints, reach: Floats, error: Floats) -> None:
    """Sort runs of events again, in place, whose order rounding leaves open."""
    sure = reach[1:] - reach[:-1] > error[1:] + error[:-1]
    if sure.all():
        return
    furthest = np.maximum.accumulate(reach + error)
    nearest = np.minimum.accumulate((reach - error)[::-1])[::-1]
    # Written so that NaN and infinity, the marks of overflow, count as unsure.
    joined = np.concatenate([[False], ~(furthest[:-1] < nearest[1:]), [False]])
    bounds = np.flatnonzero(joined[1:] != joined[:-1])
    for low, high in bounds.reshape(-1, 2).tolist():
        run = events[low : high + 1]
        run[:] = sorted(run.tolist(), key=lambda event: _exact_reach(plan, event))


def _exact_reach(plan: SweepPlan, event: int) -> tuple[Fraction, Fraction, int]:
    x, y = _exact_place(plan, event)
    return x + Fraction(plan.tilt) * y, y, _behind(plan, event)


def _behind(plan: SweepPlan, event: int) -> int:
    """Return −1, 1 or 0 for events before, behind or at the place where they are: feet are a little higher."""
    foot = event - plan.n_vertices - len(plan.visit) + len(plan.bridges)
    if foot < 0:
        return 0
    start = plan.edge[event - plan.n_vertices]
    (x, y), (end_x, end_y) = (map(Fraction, plan.exact[point].tolist()) for point in (start, plan.following[start]))
    reaches = end_x - x + Fraction(plan.tilt) * (end_y - y) > 0
    return 1 if reaches == (end_y > y) else -1


def _exact_place(plan: SweepPlan, event: int) -> _Place:
    points = plan.exact
    if event < plan.n_vertices:
        x, y = points[event].tolist()
        return Fraction(x), Fraction(y)
    edge, other = int(plan.edge[event - plan.n_vertices]), int(plan.other[event - plan.n_vertices])
    ends = points[[edge, plan.following[edge], other, plan.following[other]]]
    share = exact_parameter(*ends)
    (ax, ay), (bx, by) = ((Fraction(x), Fraction(y)) for x, y in ends[:2].tolist())
    return ax + share * (bx - ax), ay + share * (by - ay)
