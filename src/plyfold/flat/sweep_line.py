"""The order in which a line that moves over the plane comes to the vertices of a curve and to its crossings."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple, TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops
from plyfold.predicates import exact_parameter, parameter_along_edge

__all__ = ["SkipList", "empty_skip_list", "link_above", "sweep_order", "unlink"]


_Place: TypeAlias = tuple[Fraction, Fraction]

# The line is tilted, so that in drawings along the axes it does not come to many places at once.
_TILT = 0.3
# The rounding error of x + tilt · y, as a part of the sizes of the two, is less than this; the same for interpolation.
_ERROR = 1e-15


def sweep_order(arrangement: Arrangement) -> Ints:
    """Return the vertices and crossings of a drawing by x + 0.3 y, then by y, exactly.

    Parameters
    ----------
    arrangement : Arrangement
        With a drawing of n points.

    Returns
    -------
    (n + k,) int
        Vertices by number; crossings by their first visits, n more than that.

    Notes
    -----
    O((n + k) log n), and some microseconds for each place that rounding leaves unsure.
    """
    assert arrangement.curve is not None
    points = arrangement.curve.points
    n = len(points)
    first = np.flatnonzero(np.arange(len(arrangement.partner)) < arrangement.partner)
    with np.errstate(over="ignore", invalid="ignore"):
        reach, error = _reach(points)
        if len(first):
            edges = arrangement.visit_edge[first], arrangement.visit_edge[arrangement.partner[first]]
            more = _reach_of_crossings(points, reach, error, *edges)
            reach, error = np.concatenate([reach, more[0]]), np.concatenate([error, more[1]])
    order = np.argsort(reach)
    events = np.concatenate([np.arange(n), n + first])[order]
    _sort_unsure(arrangement, events, reach[order], error[order])
    return events


def _reach(points: Floats) -> tuple[Floats, Floats]:
    """Return how far the line has come at each point, and a bound on the error."""
    x, y = points.T
    tilted = _TILT * y
    return x + tilted, _ERROR * (np.abs(x) + np.abs(tilted))


def _reach_of_crossings(points: Floats, reach: Floats, error: Floats, edge: Ints, other: Ints) -> tuple[Floats, Floats]:
    """Return the same for the crossings of some edges with others."""
    start, end = edge, (edge + 1) % len(points)
    parameter, unsure = parameter_along_edge(
        points[start], points[end], points[other], points[(other + 1) % len(points)]
    )
    along = reach[end] - reach[start]
    return reach[start] + parameter * along, unsure * np.abs(along) + 3 * (error[start] + error[end])


def _sort_unsure(arrangement: Arrangement, events: Ints, reach: Floats, error: Floats) -> None:
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
        run[:] = sorted(run.tolist(), key=lambda event: _exact_reach(arrangement, event))


def _exact_reach(arrangement: Arrangement, event: int) -> _Place:
    x, y = _exact_place(arrangement, event)
    return x + Fraction(_TILT) * y, y


def _exact_place(arrangement: Arrangement, event: int) -> _Place:
    assert arrangement.curve is not None
    points = arrangement.curve.points
    if event < len(points):
        x, y = points[event].tolist()
        return Fraction(x), Fraction(y)
    visit = event - len(points)
    edge, other = int(arrangement.visit_edge[visit]), int(arrangement.visit_edge[arrangement.partner[visit]])
    ends = points[[edge, (edge + 1) % len(points), other, (other + 1) % len(points)]]
    share = exact_parameter(*ends)
    (ax, ay), (bx, by) = ((Fraction(x), Fraction(y)) for x, y in ends[:2].tolist())
    return ax + share * (bx - ax), ay + share * (by - ay)


# ---- the edges that meet a vertical line -----------------------------------------------------------------------------
#
# They are a skip list [Pug90]_ that loops can work on. Nodes are numbered; node 0 is both ends. A node of height h is
# linked on levels 0 to h, where a quarter of the nodes on
# each level are on the next one as well. The link of a node on a level is at ``level · nodes + node``.
#
# References
# ----------
# .. [Pug90] W. Pugh, "Skip lists: a probabilistic alternative to balanced trees", Communications of the ACM 33, 1990.

# Multiples of this, without their whole parts, are spread evenly.
_GOLDEN = (5**0.5 - 1) / 2


class SkipList(NamedTuple):
    """Links to the node above and to the node below on every level, and the height of each node."""

    above: Ints
    below: Ints
    height: Ints


def empty_skip_list(nodes: int) -> SkipList:
    """Return a list without nodes that has room for some, numbered from 1 on."""
    levels = max(1, (nodes.bit_length() + 1) // 2)
    scattered = np.arange(1, nodes + 2) * _GOLDEN % 1
    height = np.minimum(-np.log(scattered) / np.log(4), levels - 1).astype(np.int64)
    height[0] = levels - 1
    links = np.zeros((2, levels * (nodes + 1)), dtype=np.int64)
    return SkipList(links[0], links[1], height)


@called_from_loops
def link_above(nodes: SkipList, node: int, place: int) -> None:
    """Put a new node above another one, or at the lower end if that is node 0."""
    size = len(nodes.height)
    for level in range(nodes.height[node] + 1):
        while nodes.height[place] < level:
            place = nodes.below[(level - 1) * size + place]
        base = level * size
        above = nodes.above[base + place]
        nodes.above[base + place] = nodes.below[base + above] = node
        nodes.below[base + node], nodes.above[base + node] = place, above


@called_from_loops
def unlink(nodes: SkipList, node: int) -> None:
    """Take a node out."""
    size = len(nodes.height)
    for level in range(nodes.height[node] + 1):
        base = level * size
        above, below = nodes.above[base + node], nodes.below[base + node]
        nodes.above[base + below] = above
        nodes.below[base + above] = below
