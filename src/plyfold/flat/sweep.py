"""Triangles on the points of an immersed disk, found by a line that sweeps over the disk and not over the plane.

On the disk, the points below a sweeping line are intervals that end on two edges of the boundary: an edge that runs to
the right below, one that runs to the left above. They are known by their edges, so a vertex on the line is found at
once, however many sheets lie over it. Only a vertex from which both edges lead ahead begins something new. If it is a
convex corner that is an interval of its own; if it is reflex, it splits an interval, and which one is seen by walking
up from the vertex through the gluing: from its own sheet over every border to the sheet beyond, until one ends there.

The part of the disk that was swept is cut into monotone polygons, whose triangles are found on the way [GJPT78]_.

References
----------
.. [GJPT78] M. R. Garey, D. S. Johnson, F. P. Preparata, R. E. Tarjan, "Triangulating a simple polygon", Information
   Processing Letters 7, 1978.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops, run_loop
from plyfold.errors import PlyfoldError
from plyfold.flat.sweep_line import SkipList, empty_skip_list, link_above, sweep_order, unlink
from plyfold.immersion.immersion import Immersion
from plyfold.mesh.sheets import seams_of
from plyfold.predicates import Coordinates, as_coordinates, turn

__all__ = ["sweep_triangles"]


class _Drawing(NamedTuple):
    """What is swept: the order of events, and the gluing.

    ``order`` is that of :func:`sweep_order`, and ``rank`` the place of each vertex in it. ``border`` is the one that
    each vertex is on. The sheet beyond a dart, seen from a sheet on its left, is ``beyond[row[dart] + sheet]``, or −1.
    """

    order: Ints
    rank: Ints
    partner: Ints
    visit_edge: Ints
    border: Ints
    own_sheet: Ints
    row: Ints
    beyond: Ints


class _Strands(NamedTuple):
    """The edges on the line: the node of each in the skip list, the border that it is on now; the edge of each node."""

    node: Ints
    border: Ints
    edge: Ints


class _Intervals(NamedTuple):
    """The interval that each edge on the line bounds; of each interval the upper edge, and the polygons it closes.

    They are two, ``bottom`` and ``top``, after a vertex at which two intervals have become one: the next vertex of the
    interval sees it.
    """

    of_edge: Ints
    upper_edge: Ints
    bottom: Ints
    top: Ints


class _Polygons(NamedTuple):
    """Monotone polygons, as far as they are not cut into triangles yet: a vertex, and a chain of others on one side.

    They are stacks whose entries hold a vertex and the entry before, or −1. The chain is above, ``side`` 1, or below,
    −1; there is none, 0, beside a single vertex. It bends inward: no triangle can be cut off.
    """

    last: Ints
    side: Ints
    vertex: Ints
    before: Ints


class _Output(NamedTuple):
    """The triangles, and how many there are of: nodes, intervals, polygons, entries, triangles."""

    faces: Ints
    counts: Ints


class _Sweep(NamedTuple):
    """Everything."""

    places: Coordinates
    drawing: _Drawing
    nodes: SkipList
    strands: _Strands
    intervals: _Intervals
    polygons: _Polygons
    output: _Output


_NODES, _INTERVALS, _POLYGONS, _ENTRIES, _TRIANGLES = range(5)


def sweep_triangles(immersion: Immersion) -> Ints:
    """Return triangles on the points of an immersion's curve, by number, that make the immersed disk.

    Parameters
    ----------
    immersion : Immersion
        Of a drawing.

    Returns
    -------
    (n − 2, 3) int
        Counter-clockwise, exactly.

    Notes
    -----
    O((n + k) log n), and for each vertex that splits an interval the number of strands above it in the disk.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> sweep_triangles(find_immersion([(0, 0), (4, 0), (1, 1), (0, 4)])).tolist()
    [[0, 2, 3], [0, 1, 2]]
    """
    assert immersion.arrangement.curve is not None
    points = immersion.arrangement.curve.points
    drawing = _drawing(immersion, points)
    n = len(points)
    ahead = np.diff(drawing.rank, append=drawing.rank[:1]) > 0
    starts = int((ahead[1:] > ahead[:-1]).sum()) + int(ahead[0] > ahead[-1])
    given = (as_coordinates(points), drawing, *_room(n, starts))
    output = _Output(np.empty((n - 2, 3), dtype=np.int64), np.zeros(5, dtype=np.int64))
    output = run_loop(_swept, len(drawing.order), given, output)
    if output.counts[_TRIANGLES] != n - 2:
        raise PlyfoldError("internal check failed: the triangles make the disk", where=points[:1])
    return output.faces


def _drawing(immersion: Immersion, points: Floats) -> _Drawing:
    arrangement, n = immersion.arrangement, len(points)
    order = sweep_order(arrangement)
    rank = np.empty(n + len(arrangement.partner), dtype=np.int64)
    rank[order] = np.arange(len(order))
    seams = seams_of(immersion)
    return _Drawing(
        order=order,
        rank=rank[:n],
        partner=arrangement.partner,
        visit_edge=arrangement.visit_edge,
        # Visits on an edge come after its first point.
        border=(np.searchsorted(arrangement.visit_edge, np.arange(n)) - 1) % arrangement.n_borders,
        own_sheet=immersion.own_sheet,
        row=seams.row,
        beyond=seams.table,
    )


def _room(n: int, starts: int) -> tuple[SkipList, _Strands, _Intervals, _Polygons]:
    """Return empty tables for a curve of n vertices, at some of which the line first meets it."""

    def rows(count: int, size: int) -> Ints:
        return np.empty((count, size), dtype=np.int64)

    return (
        empty_skip_list(2 * starts),
        _Strands(*rows(2, n), *rows(1, 2 * starts + 1)),
        _Intervals(*rows(1, n), *rows(3, starts)),
        _Polygons(*rows(2, starts), *rows(2, 3 * n)),
    )


def _swept(given: tuple[Coordinates, _Drawing, SkipList, _Strands, _Intervals, _Polygons], output: _Output) -> int:
    """Sweep; return how many triangles there are."""
    places, drawing, nodes, strands, intervals, polygons = given
    sweep = _Sweep(places, drawing, nodes, strands, intervals, polygons, output)
    rank, n = drawing.rank, len(drawing.rank)
    for event in drawing.order:
        if event >= n:
            _cross(sweep, event - n)
            continue
        before, after = (event if event > 0 else n) - 1, event + 1 if event < n - 1 else 0
        comes, goes = rank[before] < rank[event], rank[event] < rank[after]
        if comes and goes:
            _replace(sweep, before, event, event)
            _meet(sweep, intervals.of_edge[event], event, -1)
        elif not comes and not goes:
            _replace(sweep, event, before, event)
            intervals.upper_edge[intervals.of_edge[before]] = before
            _meet(sweep, intervals.of_edge[before], event, 1)
        elif goes:
            _begin(sweep, event, turn(places, before, event, after) > 0)
        else:
            _end(sweep, event, turn(places, before, event, after) > 0)
    triangles: int = output.counts[_TRIANGLES]
    return triangles


@called_from_loops
def _cross(sweep: _Sweep, visit: int) -> None:
    """Swap two edges on the line; each comes to its next border."""
    drawing, strands = sweep.drawing, sweep.strands
    other = drawing.partner[visit]
    one_edge, other_edge = drawing.visit_edge[visit], drawing.visit_edge[other]
    node, other_node = strands.node[one_edge], strands.node[other_edge]
    strands.node[one_edge], strands.node[other_edge] = other_node, node
    strands.edge[node], strands.edge[other_node] = other_edge, one_edge
    strands.border[one_edge] = _border_behind(drawing, visit, one_edge)
    strands.border[other_edge] = _border_behind(drawing, other, other_edge)


@called_from_loops
def _runs_ahead(drawing: _Drawing, edge: int) -> bool:
    """Tell whether an edge runs in the direction in which the line moves."""
    return bool(drawing.rank[edge] < drawing.rank[edge + 1 if edge < len(drawing.rank) - 1 else 0])


@called_from_loops
def _border_behind(drawing: _Drawing, visit: int, edge: int) -> int:
    """Return the border that the line comes to behind a visit."""
    if _runs_ahead(drawing, edge):
        return visit
    return (visit if visit > 0 else len(drawing.partner)) - 1


@called_from_loops
def _replace(sweep: _Sweep, old: int, new: int, vertex: int) -> None:
    """Replace an edge on the line by the one beyond the vertex at which it ends."""
    strands, intervals = sweep.strands, sweep.intervals
    node = strands.node[old]
    strands.node[new] = node
    strands.edge[node] = new
    strands.border[new] = sweep.drawing.border[vertex]
    intervals.of_edge[new] = intervals.of_edge[old]


@called_from_loops
def _begin(sweep: _Sweep, vertex: int, convex: bool) -> None:
    """Put both edges of a vertex on the line: they bound a new interval, or split one that the vertex is in."""
    intervals = sweep.intervals
    arriving, leaving = (vertex if vertex > 0 else len(sweep.drawing.rank)) - 1, vertex
    place = _place_below(sweep, vertex)
    fresh = _count_up(sweep, _INTERVALS)
    if convex:
        intervals.bottom[fresh] = intervals.top[fresh] = _new_polygon(sweep, vertex)
        intervals.upper_edge[fresh] = arriving
        intervals.of_edge[leaving] = intervals.of_edge[arriving] = fresh
        _insert(sweep, arriving, vertex, _insert(sweep, leaving, vertex, place))
    else:
        split = _interval_around(sweep, vertex, place)
        upper = intervals.upper_edge[split]
        _split(sweep, split, fresh, vertex)
        intervals.upper_edge[split], intervals.upper_edge[fresh] = arriving, upper
        intervals.of_edge[arriving], intervals.of_edge[leaving], intervals.of_edge[upper] = split, fresh, fresh
        _insert(sweep, leaving, vertex, _insert(sweep, arriving, vertex, place))


@called_from_loops
def _place_below(sweep: _Sweep, vertex: int) -> int:
    """Return the node of the edge on the line just below a vertex, or 0."""
    nodes, edge = sweep.nodes, sweep.strands.edge
    size, place = len(nodes.height), 0
    for level in range(nodes.height[0], -1, -1):
        above = nodes.above[level * size + place]
        while above != 0 and _is_above(sweep, vertex, edge[above]):
            place = above
            above = nodes.above[level * size + place]
    return place


@called_from_loops
def _is_above(sweep: _Sweep, vertex: int, edge: int) -> bool:
    """Tell whether a vertex is above an edge on the line."""
    drawing = sweep.drawing
    end = edge + 1 if edge < len(drawing.rank) - 1 else 0
    side = turn(sweep.places, edge, end, vertex)
    return side > 0 if drawing.rank[edge] < drawing.rank[end] else side < 0


@called_from_loops
def _interval_around(sweep: _Sweep, vertex: int, place: int) -> int:
    """Walk up from a vertex above a given place, from sheet to sheet, to the edge at which the disk ends."""
    drawing, strands, above = sweep.drawing, sweep.strands, sweep.nodes.above
    sheet = drawing.own_sheet[drawing.border[vertex]]
    edge = 0
    while sheet >= 0:
        place = above[place]
        edge = strands.edge[place]
        # Out of the sheet on the left of a dart: below an edge that runs ahead, that is of the backward one.
        dart = 2 * strands.border[edge] + (1 if _runs_ahead(drawing, edge) else 0)
        sheet = drawing.beyond[drawing.row[dart] + sheet]
    interval: int = sweep.intervals.of_edge[edge]
    return interval


@called_from_loops
def _insert(sweep: _Sweep, edge: int, vertex: int, place: int) -> int:
    """Put an edge that begins at a vertex on the line, above a given node; return its own node."""
    node = _count_up(sweep, _NODES) + 1
    sweep.strands.node[edge] = node
    sweep.strands.edge[node] = edge
    sweep.strands.border[edge] = sweep.drawing.border[vertex]
    link_above(sweep.nodes, node, place)
    return node


@called_from_loops
def _count_up(sweep: _Sweep, what: int) -> int:
    """Return the number of a new node, interval, polygon, entry or triangle."""
    number: int = sweep.output.counts[what]
    sweep.output.counts[what] = number + 1
    return number


@called_from_loops
def _end(sweep: _Sweep, vertex: int, convex: bool) -> None:
    """Take both edges of a vertex off the line: they bounded an interval, or two that become one."""
    intervals = sweep.intervals
    arriving, leaving = (vertex if vertex > 0 else len(sweep.drawing.rank)) - 1, vertex
    lower, upper = intervals.of_edge[leaving], intervals.of_edge[arriving]
    if convex:
        _cut_off(sweep, intervals.bottom[lower], vertex)
        if intervals.top[lower] != intervals.bottom[lower]:
            _cut_off(sweep, intervals.top[lower], vertex)
    else:
        _meet(sweep, lower, vertex, 1)
        _meet(sweep, upper, vertex, -1)
        intervals.top[lower] = intervals.top[upper]
        intervals.upper_edge[lower] = intervals.upper_edge[upper]
        intervals.of_edge[intervals.upper_edge[upper]] = lower
    unlink(sweep.nodes, sweep.strands.node[arriving])
    unlink(sweep.nodes, sweep.strands.node[leaving])


@called_from_loops
def _meet(sweep: _Sweep, interval: int, vertex: int, side: int) -> None:
    """Add a vertex on the upper (1) or lower (−1) edge of an interval to its polygon; of two it finishes one."""
    intervals = sweep.intervals
    bottom, top = intervals.bottom[interval], intervals.top[interval]
    near, far = (top, bottom) if side > 0 else (bottom, top)
    if near != far:
        _cut_off(sweep, near, vertex)
        intervals.bottom[interval] = intervals.top[interval] = far
    _add(sweep, far, vertex, side)


@called_from_loops
def _split(sweep: _Sweep, interval: int, fresh: int, vertex: int) -> None:
    """Split an interval at a vertex inside, which sees the last one that the interval has met."""
    intervals, polygons = sweep.intervals, sweep.polygons
    bottom, top = intervals.bottom[interval], intervals.top[interval]
    if bottom == top:
        seen = _new_polygon(sweep, polygons.vertex[polygons.last[top]])
        if polygons.side[top] < 0:
            bottom = seen
        else:
            top = seen
    _add(sweep, bottom, vertex, 1)
    _add(sweep, top, vertex, -1)
    intervals.bottom[interval] = intervals.top[interval] = bottom
    intervals.bottom[fresh] = intervals.top[fresh] = top


@called_from_loops
def _new_polygon(sweep: _Sweep, vertex: int) -> int:
    """Return a polygon that begins at a vertex."""
    polygon = _count_up(sweep, _POLYGONS)
    sweep.polygons.side[polygon] = 0
    _push(sweep, polygon, vertex, -1)
    return polygon


@called_from_loops
def _push(sweep: _Sweep, polygon: int, vertex: int, before: int) -> None:
    entry = _count_up(sweep, _ENTRIES)
    sweep.polygons.vertex[entry] = vertex
    sweep.polygons.before[entry] = before
    sweep.polygons.last[polygon] = entry


@called_from_loops
def _add(sweep: _Sweep, polygon: int, vertex: int, side: int) -> None:
    """Add a vertex to a polygon, on its upper (1) or lower (−1) side, and cut off all triangles that can be."""
    polygons = sweep.polygons
    last = polygons.last[polygon]
    left = _cut_off(sweep, polygon, vertex)
    if polygons.side[polygon] == -side:
        polygons.before[last] = -1
        left = last
    polygons.side[polygon] = side
    _push(sweep, polygon, vertex, left)


@called_from_loops
def _cut_off(sweep: _Sweep, polygon: int, vertex: int) -> int:
    """Cut triangles with a new vertex off the end of a polygon's chain; return the entry up to which it is left."""
    polygons, faces = sweep.polygons, sweep.output.faces
    above = polygons.side[polygon] > 0
    entry: int = polygons.last[polygon]
    while polygons.before[entry] >= 0:
        near, far = polygons.vertex[entry], polygons.vertex[polygons.before[entry]]
        second, third = (vertex, near) if above else (near, vertex)
        if turn(sweep.places, far, second, third) <= 0:
            break
        triangle = _count_up(sweep, _TRIANGLES)
        faces[triangle][0], faces[triangle][1], faces[triangle][2] = far, second, third
        entry = polygons.before[entry]
    return entry
