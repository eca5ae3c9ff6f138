"""Exact noding of closed polylines as they are given, however they touch, overlap or crowd: nodes, faces and windings.

Nothing is moved. A node is a vertex or a crossing: a rational point, known by the two edges that define it. All nodes
are ranked once, exactly, from left to right and those above each other from below; so are the directions of all edges.
From then on there are whole numbers alone: the order of nodes along an edge is that of their ranks, and the order of
edges around a node that of their directions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple, TypeAlias

import numpy as np

from plyfold.arrangement.crossings import distinct_numbers
from plyfold.arrays import Bools, Floats, Ints, Signs, freeze
from plyfold.errors import PrecisionError
from plyfold.graphs import components, spanning_tree
from plyfold.outline.curve import Outline
from plyfold.predicates import cross_sign, crossing_bounds, exact_crossings
from plyfold.ragged import count_each

__all__ = ["Noding", "Strands", "exact_ranks", "node_outline", "node_rounded", "strands_of"]

# How many boxes are looked up at a time.
_LOOKUPS = 2**8
# Crossings of edges between whole numbers from 0 up to this one are at least 2^-40 apart in x or in y, and rounded by
# less: they are equal if and only if their rounded places are.
_SMALL_GRID = 2**9
# Noding rounded nodes is given up after so many rounds, two or three are the rule, or with so many times the parts.
_ROUNDS = 8
_MOST_GROWTH = 8
# A slope is a quotient of differences and their sum, each rounded.
_SLOPE_ERROR = 2e-15


_Rounded: TypeAlias = Callable[[Floats, Floats, Floats], Floats]
"""Returns rounded crossings, given bounds of each and the ends of its two edges."""


@dataclass(frozen=True, eq=False)
class Noding:
    """Closed polylines cut at all places where they meet, as a plane graph: parts that cancel each other are left out.

    Half-edge 2i runs along part i from its lower node to its higher one, half-edge 2i + 1 back. Nodes are numbered from
    left to right, those above each other from below.

    Parameters
    ----------
    points : (nodes, 2) float
        Vertices as given, and crossings rounded.
    is_vertex : (nodes,) bool
        Whether a vertex of the polylines is there.
    ends : (parts, 2) int
        The nodes at the ends of each part, the lower number first.
    times : (parts,) int
        How often the polylines run from the first to the second of them, less the times they run back. Never 0.
    line : (parts,) int
        The rank of the direction from the first to the second, from straight down, which is none, up to straight up.
    following : (2 · parts,) int
        The half-edge after each with the same face on its left: where a face touches itself, its boundary stays on one
        side.
    face : (2 · parts,) int
        The face on the left of each half-edge. Face 0 is the unbounded one.
    winding : (faces,) int
        How often the polylines wind round each face, counter-clockwise as they are given.
    """

    points: Floats
    is_vertex: Bools
    ends: Ints
    times: Ints
    line: Ints
    following: Ints
    face: Ints
    winding: Ints

    def __post_init__(self) -> None:
        freeze(self)


def node_outline(outline: Outline) -> Noding:
    """Return the nodes, parts and faces of any closed polylines. Exact.

    Notes
    -----
    O((n + k) log (n + k)) for n edges and k pairs of them that meet, and the pairs whose boxes meet; and O(n + k)
    with a small factor for each group of polylines that hang together.

    Examples
    --------
    Two triangles that meet in a point:

    >>> from plyfold.outline.curve import Curve
    >>> found = node_outline(Curve([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]))
    >>> len(found.points), len(found.ends), found.winding.tolist()
    (5, 6, [0, 1, 1])
    """
    points = outline.points
    return _node_edges(points, points[outline.next_point], np.ones(len(points), dtype=np.int64), _middles)


@dataclass(frozen=True, eq=False)
class Strands:
    """An outline as ways along the parts of its noding, also along those that cancel each other.

    Parameters
    ----------
    noding : Noding
        With all parts: here ``times`` may be 0.
    half_edge : (s,) int
        The half-edges of the noding that the outline runs along, in order, edge after edge.
    first : (n + 1,) int
        Those along edge i begin at ``first[i]`` and end before ``first[i + 1]``.
    """

    noding: Noding
    half_edge: Ints
    first: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def start(self) -> Ints:
        """The node at which each half-edge of the outline starts."""
        return np.asarray(self.noding.ends.ravel()[self.half_edge])


def strands_of(outline: Outline) -> Strands:
    """Return the noding of an outline with all of its parts, and the way of the outline through it. Exact.

    Examples
    --------
    A square with a way to a point outside and back:

    >>> from plyfold.outline.curve import Curve
    >>> found = strands_of(Curve([(0, 0), (2, 0), (3, -1), (4, 0), (3, -1), (2, 0), (2, 2), (0, 2)]))
    >>> found.noding.times.tolist(), found.half_edge.tolist()
    ([-1, 1, -1, 1, 0, 0], [2, 8, 10, 11, 9, 6, 5, 1])
    """
    points = outline.points
    start, end = points, points[outline.next_point]
    lines, line = _distinct_edges(start, end, np.ones(len(points), dtype=np.int64), all_parts=True)
    graph, along = _cut_at_nodes(lines, _meetings(lines), _middles)
    backward = _runs_backward(start, end)
    count = np.bincount(along.edge, minlength=len(lines.low))[line]
    place = count_each(count)
    place[np.repeat(backward, count)] = (np.repeat(count, count) - 1 - place)[np.repeat(backward, count)]
    part = along.part[np.repeat(np.searchsorted(along.edge, line), count) + place]
    first = np.append(0, np.cumsum(count))
    return Strands(_noding(lines, graph), 2 * part + np.repeat(backward, count), first)


def node_rounded(noding: Noding) -> Noding:
    """Return the graph of the same parts between rounded nodes, all of whose nodes are doubles.

    Rounding makes parts cross or meet that did not; where it did, they are noded again, until nothing is rounded.

    Raises
    ------
    PrecisionError
        If there is no end to that after some rounds: strands a few roundings apart can cross again and again.
    """
    most = _MOST_GROWTH * len(noding.ends)
    for _ in range(_ROUNDS):
        start, end = noding.points[noding.ends].swapaxes(0, 1)
        # Between doubles next to each other there is no room for errors.
        noding = _node_edges(start, end, noding.times, _nearest_doubles)
        if noding.is_vertex[noding.ends].all():
            return noding
        if len(noding.ends) > most:
            break
    raise PrecisionError(
        "strands are so crowded that rounding their crossings makes ever more of them",
        where=noding.points[~noding.is_vertex][:5],
        hint="move the strands apart there",
    )


def _node_edges(start: Floats, end: Floats, times: Ints, rounded: _Rounded) -> Noding:
    """Return the graph of edges that are run some number of times, its crossings rounded as given."""
    lines, _ = _distinct_edges(start, end, times)
    graph, _ = _cut_at_nodes(lines, _meetings(lines), rounded)
    return _noding(lines, _without_cancelled(graph))


def _noding(lines: _Lines, graph: _Graph) -> Noding:
    """Return the noding of a graph, with its faces."""
    following, last_around = _around_nodes(graph)
    face = _faces(lines, graph, following, last_around)
    winding = _windings(face, graph.times)
    points = graph.points * lines.unit + lines.origin
    return Noding(points, graph.is_vertex, graph.ends, graph.times, graph.line, following, face, winding)


# ---- edges ---------------------------------------------------------------------------------------------------------


class _Lines(NamedTuple):
    """The distinct edges, from the lower of their ends to the higher (by x, then y), in units from an origin.

    Parameters
    ----------
    low, high : (n, 2) float
    times : (n,) int
        How often they are run from low to high, less the times they are run back; 0 only if all parts are kept.
    direction : (n,) int
        The rank of each one's direction.
    is_small_grid : bool
        Whether all ends are whole numbers from 0 to ``_SMALL_GRID``.
    unit, origin : float and (2,) float
        The places in the drawing are the given ones times the unit, and from the origin on.
    """

    low: Floats
    high: Floats
    times: Ints
    direction: Ints
    is_small_grid: bool
    unit: float
    origin: Floats


def _distinct_edges(start: Floats, end: Floats, times: Ints, all_parts: bool = False) -> tuple[_Lines, Ints]:
    """Return the distinct edges with a length, and which of them each edge is.

    Those that are run back as often are left out, but with ``all_parts``.
    """
    (start, end), unit, origin, is_small_grid = _in_units(np.stack([start, end]))
    backward = _runs_backward(start, end)
    rows = np.where(backward[:, None], np.hstack([end, start]), np.hstack([start, end]))
    distinct, which = np.unique(rows, axis=0, return_inverse=True)
    total = np.zeros(len(distinct), dtype=np.int64)
    np.add.at(total, which.ravel(), np.where(backward, -times, times))
    kept = ((total != 0) | all_parts) & (distinct[:, :2] != distinct[:, 2:]).any(axis=1)
    low, high = distinct[kept, :2], distinct[kept, 2:]
    direction = _directions(low, high, is_small_grid)
    lines = _Lines(low, high, total[kept], direction, is_small_grid, unit, origin)
    return lines, (np.cumsum(kept) - 1)[which.ravel()]


def _runs_backward(start: Floats, end: Floats) -> Bools:
    return np.asarray((end[:, 0] < start[:, 0]) | ((end[:, 0] == start[:, 0]) & (end[:, 1] < start[:, 1])))


def _in_units(points: Floats) -> tuple[Floats, float, Floats, bool]:
    """Return points on a small grid as its whole numbers, with unit and origin; all others as they are."""
    if points.size == 0:
        return points, 1.0, np.zeros(2), True
    low = points.min(axis=(0, 1))
    size = float((points.max(axis=(0, 1)) - low).max())
    unit = float(np.ldexp(1.0, np.frexp(size)[1])) / _SMALL_GRID
    whole = points / unit if unit > np.finfo(np.float64).tiny else np.full_like(points, np.inf)
    # The differences of whole numbers of this size are exact.
    if (np.abs(whole) < 2.0**52).all() and (whole == np.rint(whole)).all():
        return whole - low / unit, unit, low, True
    return points, 1.0, np.zeros(2), False


def _directions(low: Floats, high: Floats, is_small_grid: bool) -> Ints:
    """Return the ranks of the directions from low to high, in the right half-plane, from down to up."""
    x, y = (high - low).T
    slope = y / (x + np.abs(y))
    error = 0.0 if is_small_grid else _SLOPE_ERROR

    def exact(which: Ints) -> list[Fraction]:
        ends = np.hstack([low[which], high[which]]).tolist()
        return [_exact_slope(*map(Fraction, row)) for row in ends]

    return exact_ranks(slope - error, slope + error, exact)


def _exact_slope(x: Fraction, y: Fraction, end_x: Fraction, end_y: Fraction) -> Fraction:
    return (end_y - y) / (end_x - x + abs(end_y - y))


# ---- exact order -----------------------------------------------------------------------------------------------------


def exact_ranks(low: Floats, high: Floats, exact: Callable[[Ints], list[Fraction]]) -> Ints:
    """Return the rank of each of some numbers among all that differ, the smallest first.

    Parameters
    ----------
    low, high : (m,) float
        Bounds of each number; those that are equal are the number itself.
    exact : callable
        Returns the numbers at some places; asked only for those that the bounds leave open.

    Examples
    --------
    >>> third = Fraction(1, 3)
    >>> numbers = [1, third, third + Fraction(1, 10**30), third]
    >>> bounds = np.array([float(number) for number in numbers])
    >>> error = np.array([0, 1e-15, 1e-15, 1e-15])
    >>> exact_ranks(bounds - error, bounds + error, lambda which: [numbers[i] for i in which]).tolist()
    [2, 0, 1, 0]
    """
    order = np.argsort(low, kind="stable")
    lowest, reached = low[order], np.maximum.accumulate(high[order])
    run = np.cumsum(np.concatenate([np.zeros(min(len(low), 1), dtype=bool), lowest[1:] > reached[:-1]]))
    within = np.zeros(len(low), dtype=np.int64)
    vague = np.bincount(run, low[order] != high[order]) > 0
    unsure = np.flatnonzero(vague[run] & (np.bincount(run)[run] > 1))
    within[unsure] = _ranks_in_runs(run[unsure].tolist(), exact(order[unsure]) if len(unsure) else [])
    key = run * (within.max(initial=0) + 1) + within
    ranks = np.empty(len(low), dtype=np.int64)
    ranks[order] = np.unique(key, return_inverse=True)[1]
    return ranks


def _ranks_in_runs(run: list[int], numbers: list[Fraction]) -> list[int]:
    """Return the rank of each number among all, those of an earlier run first."""
    place = {pair: at for at, pair in enumerate(sorted(set(zip(run, numbers, strict=True))))}
    return [place[pair] for pair in zip(run, numbers, strict=True)]


# ---- where edges meet ------------------------------------------------------------------------------------------------


class _Meetings(NamedTuple):
    """Pairs of edges that cross inside both, and ends of edges on other ones.

    Parameters
    ----------
    crossing : (k, 2) int
    edge, other, other_end : (t,) int
        End 0 or 1 of the other edge lies on the edge.
    """

    crossing: Ints
    edge: Ints
    other: Ints
    other_end: Ints


def _meetings(lines: _Lines) -> _Meetings:
    none = np.empty(0, dtype=np.int64)
    parts = [_Meetings(np.empty((0, 2), dtype=np.int64), none, none, none)]
    parts += [_meetings_of_pairs(lines, first, second) for first, second in _near_pairs(lines)]
    crossing, edge, other, other_end = map(np.concatenate, zip(*parts, strict=True))
    return _Meetings(crossing, edge, other, other_end)


def _near_pairs(lines: _Lines) -> Iterator[tuple[Ints, Ints]]:
    """Yield the pairs of edges whose bounding boxes meet, portion by portion."""
    from shapely import STRtree, linestrings

    boxes = linestrings(np.stack([lines.low, lines.high], axis=1))
    tree = STRtree(boxes)
    for start in range(0, len(boxes), _LOOKUPS):
        first, second = tree.query(boxes[start : start + _LOOKUPS])
        first += start
        once = first < second
        yield first[once], second[once]


def _meetings_of_pairs(lines: _Lines, first: Ints, second: Ints) -> _Meetings:
    side = _sides(lines, first, second)
    met = side[:, 0] * side[:, 1] <= 0
    first, second, side = first[met], second[met], side[met]
    other_side = _sides(lines, second, first)
    proper = (side[:, 0] * side[:, 1] < 0) & (other_side[:, 0] * other_side[:, 1] < 0)
    touches = zip(_touches(lines, first, second, side), _touches(lines, second, first, other_side), strict=True)
    edge, other, end = map(np.concatenate, touches)
    return _Meetings(np.stack([first[proper], second[proper]], axis=1), edge, other, end)


def _sides(lines: _Lines, edge: Ints, other: Ints) -> Signs:
    """Return on which side of each edge the other one starts and ends, shape (m, 2)."""
    start, end = lines.low[edge, None], lines.high[edge, None]
    return cross_sign(start, end, start, np.stack([lines.low[other], lines.high[other]], axis=1))


def _touches(lines: _Lines, edge: Ints, other: Ints, side: Signs) -> tuple[Ints, Ints, Ints]:
    """Return edge, other edge and its end where that lies on the edge."""
    on_line, end = np.nonzero(side == 0)
    edge, other = edge[on_line], other[on_line]
    place = np.where(end[:, None] == 0, lines.low[other], lines.high[other])
    ends = np.stack([lines.low[edge], lines.high[edge]])
    hit = ((ends.min(axis=0) <= place) & (place <= ends.max(axis=0))).all(axis=1)
    return edge[hit], other[hit], end[hit]


# ---- the graph -------------------------------------------------------------------------------------------------------


class _Graph(NamedTuple):
    """Nodes and the parts of edges between them, see :class:`Noding`.

    Nodes with the same ``column`` lie above each other; ``edge`` is one on which each part lies.
    """

    points: Floats
    column: Ints
    is_vertex: Bools
    ends: Ints
    times: Ints
    line: Ints
    edge: Ints


class _Along(NamedTuple):
    """Rows (edge, part that it runs along), edge after edge, from each one's lower end to its higher one."""

    edge: Ints
    part: Ints


def _cut_at_nodes(lines: _Lines, meetings: _Meetings, rounded: _Rounded) -> tuple[_Graph, _Along]:
    n, crossing = len(lines.low), meetings.crossing
    node, points, column, is_vertex = _nodes(lines, crossing, rounded)
    number = max(len(points), 1)
    edge = np.concatenate([np.arange(n), np.arange(n), meetings.edge, *crossing.T])
    at = np.concatenate(
        [np.arange(2 * n), meetings.other + n * meetings.other_end, *[2 * n + np.arange(len(crossing))] * 2]
    )
    edge, place = np.divmod(distinct_numbers(edge * number + node[at]), number)
    inside = np.flatnonzero(edge[1:] == edge[:-1])
    part, first, which = np.unique(place[inside] * number + place[inside + 1], return_index=True, return_inverse=True)
    times = np.zeros(len(part), dtype=np.int64)
    np.add.at(times, which, lines.times[edge[inside]])
    on_edge = edge[inside][first]
    ends = np.stack(np.divmod(part, number), axis=1)
    graph = _Graph(points, column, is_vertex, ends, times, lines.direction[on_edge], on_edge)
    return graph, _Along(edge[inside], which)


def _without_cancelled(graph: _Graph) -> _Graph:
    """Return a graph without the parts that cancel each other."""
    kept = graph.times != 0
    return graph._replace(ends=graph.ends[kept], times=graph.times[kept], line=graph.line[kept], edge=graph.edge[kept])


def _nodes(lines: _Lines, crossing: Ints, rounded: _Rounded) -> tuple[Ints, Floats, Ints, Bools]:
    """Return the node of each lower end, each higher end and each crossing.

    And the nodes' places, the ranks of their x, and which of them are vertices.
    """
    given = np.concatenate([lines.low, lines.high])
    quarters = np.stack([lines.low[crossing[:, 0]], lines.high[crossing[:, 0]]])
    quarters = np.concatenate([quarters, [lines.low[crossing[:, 1]], lines.high[crossing[:, 1]]]])
    low, high = _small_grid_crossings(quarters) if lines.is_small_grid else crossing_bounds(*quarters)
    place = np.concatenate([given, low if lines.is_small_grid else rounded(low, high, quarters)])
    low, high = np.concatenate([given, low]), np.concatenate([given, high])

    def exact(axis: int) -> Callable[[Ints], list[Fraction]]:
        return lambda which: _exact_coordinates(given, quarters, which, axis)

    x, y = (exact_ranks(low[:, axis], high[:, axis], exact(axis)) for axis in (0, 1))
    _, first, node = np.unique(x * (y.max(initial=0) + 1) + y, return_index=True, return_inverse=True)
    return node, place[first], x[first], first < len(given)


def _middles(low: Floats, high: Floats, ends: Floats) -> Floats:
    """Return crossings between bounds of them, within a few rounding errors."""
    return low + (high - low) / 2


def _nearest_doubles(low: Floats, high: Floats, ends: Floats) -> Floats:
    """Return crossings as the doubles next to them."""
    columns = [list(map(float, exact_crossings(ends, axis))) for axis in (0, 1)] if len(low) else [[], []]
    return np.array(columns).T


def _small_grid_crossings(ends: Floats) -> tuple[Floats, Floats]:
    """Return places that are equal if and only if the crossings are, and in the same order, as both bounds of them."""
    p, q, r, s = ends
    along, across, between = q - p, s - r, r - p
    below = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]
    above = between[:, 0] * across[:, 1] - between[:, 1] * across[:, 0]
    # Whole numbers up to here, so there is one rounding.
    place = (p * below[:, None] + above[:, None] * along) / below[:, None]
    return place, place


def _exact_coordinates(given: Floats, ends: Floats, which: Ints, axis: int) -> list[Fraction]:
    """Return one coordinate of some given points and, numbered after them, crossings."""
    numbers: list[Fraction] = [Fraction(0)] * len(which)
    crosses = which >= len(given)
    for at in np.flatnonzero(~crosses).tolist():
        numbers[at] = Fraction(float(given[which[at], axis]))
    places = np.flatnonzero(crosses)
    found = exact_crossings(ends[:, which[places] - len(given)], axis) if len(places) else []
    for at, number in zip(places.tolist(), found, strict=True):
        numbers[at] = number
    return numbers


# ---- faces -----------------------------------------------------------------------------------------------------------


def _around_nodes(graph: _Graph) -> tuple[Ints, Ints]:
    """Return the half-edge that follows each one, and the last half-edge around the node at which each starts."""
    start = graph.ends.ravel()
    upper = int(graph.line.max(initial=0)) + 1
    # Those that run on point to the right or straight up, and those that run back to the left or straight down.
    angle = np.stack([graph.line, graph.line + upper], axis=1).ravel()
    order = np.argsort(start * (2 * upper) + angle)
    around = start[order]
    is_first = np.concatenate([np.ones(min(len(start), 1), dtype=bool), around[1:] != around[:-1]])
    first = np.flatnonzero(is_first)
    last = np.concatenate([first[1:], [len(start)]])[: len(first)] - 1
    group = np.cumsum(is_first) - 1
    before = np.where(is_first, last[group], np.arange(len(start)) - 1)
    clockwise, last_around = np.empty_like(order), np.empty_like(order)
    clockwise[order], last_around[order] = order[before], order[last[group]]
    return clockwise[np.arange(len(start)) ^ 1], last_around


def _faces(lines: _Lines, graph: _Graph, following: Ints, last_around: Ints) -> Ints:
    """Return the face on the left of each half-edge: rings around one face are put together."""
    if len(following) == 0:
        return np.empty(0, dtype=np.int64)
    cycle = components(len(following), np.arange(len(following)), following)
    outer = _outer_half_edges(graph, last_around)
    below = [_part_below(lines, graph, int(graph.ends[half_edge // 2, 0])) for half_edge in outer.tolist()]
    # The first group has the leftmost node of all, and nothing below it.
    beyond = [outer[0] if part is None else 2 * part for part in below]
    face = components(int(cycle.max()) + 1, cycle[outer], cycle[np.array(beyond)])[cycle]
    outside = face[outer[0]]
    return np.where(face == outside, 0, np.where(face == 0, outside, face))


def _outer_half_edges(graph: _Graph, last_around: Ints) -> Ints:
    """Return for each group of parts that hang together the half-edge at its lowest node with its outside on the left.

    All half-edges run from that node to the right or straight up; left of the last one comes the outside.
    """
    group = components(len(graph.points), *graph.ends.T)[graph.ends[:, 0]]
    order = np.lexsort([graph.ends[:, 0], group])
    first = order[np.unique(group[order], return_index=True)[1]]
    first = first[np.argsort(graph.ends[first, 0])]
    return last_around[2 * first]


def _part_below(lines: _Lines, graph: _Graph, corner: int) -> int | None:
    """Return the part that lies next below a little to the left of a group's lowest node, if there is one.

    That node is a vertex: where parts of an edge cancel others, they do so between vertices.
    """
    start, end = graph.column[graph.ends].T
    beside = np.flatnonzero((start < graph.column[corner]) & (graph.column[corner] <= end))
    place, edge = graph.points[corner], graph.edge[beside]
    below = beside[cross_sign(lines.low[edge], lines.high[edge], lines.low[edge], place) > 0]
    x = float(place[0])
    highest = _highest(lines, graph.edge[below], x)
    # Of parts that meet above the node the flattest upward one was the highest before.
    heights = {part: _height(lines, int(graph.edge[part]), x) for part in below[highest].tolist()}
    return max(heights, key=lambda part: (heights[part], -int(graph.line[part])), default=None)


def _highest(lines: _Lines, edge: Ints, x: float) -> Bools:
    """Tell which of some edges may be the highest at some x, as far as rounded heights tell."""
    (start_x, start_y), (end_x, end_y) = lines.low[edge].T, lines.high[edge].T
    height = start_y + (x - start_x) / (end_x - start_x) * (end_y - start_y)
    error = 16 * np.finfo(np.float64).eps * (np.abs(start_y) + np.abs(end_y)) + np.finfo(np.float64).tiny
    return np.asarray(height + error >= (height - error).max(initial=-np.inf))


def _height(lines: _Lines, edge: int, x: float) -> Fraction:
    (start_x, start_y), (end_x, end_y) = (map(Fraction, ends[edge].tolist()) for ends in (lines.low, lines.high))
    return start_y + (Fraction(x) - start_x) / (end_x - start_x) * (end_y - start_y)


# ---- winding numbers -------------------------------------------------------------------------------------------------


def _windings(face: Ints, times: Ints) -> Ints:
    """Return the winding number of each face: left of a part it is larger, by the times that the part is run."""
    count = int(face.max(initial=0)) + 1
    if count == 1:
        return np.zeros(1, dtype=np.int64)
    sides = face.reshape(-1, 2)
    # Two faces may have many parts between them; one is enough.
    one = np.unique(sides.min(axis=1) * count + sides.max(axis=1), return_index=True)[1]
    (left, right), times = sides[one].T, times[one]
    parent, edge, _ = spanning_tree(count, left, right)
    growth = np.where(left[edge] == np.arange(count), times[edge], -times[edge])
    parent[0] = growth[0] = 0
    return _summed_to_root(parent, growth)


def _summed_to_root(parent: Ints, growth: Ints) -> Ints:
    """Add up what grows on the way from each node of a tree to the root, number 0, in steps twice as long each time."""
    while parent.any():
        growth, parent = growth + growth[parent], parent[parent]
    return growth
