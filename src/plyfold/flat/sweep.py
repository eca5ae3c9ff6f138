"""Triangles on the points of an immersed surface, found by a line that sweeps over the surface and not over the plane.

On the surface, the points below a sweeping line are intervals that end on two edges of the boundary: an edge that runs
to the right below, one that runs to the left above. They are known by their edges, so a vertex on the line is found at
once, however many sheets lie over it. Only a vertex from which both edges lead ahead begins something new. If it is a
convex corner that is an interval of its own; if it is reflex, it splits an interval, and which one is seen by walking
up from the vertex through the gluing: from its own sheet over every border to the sheet beyond, until one ends there.
Bridges by which the gluing changes sheets lie on the line as well.

At a cusp, the line meets the surface several times: the vertex is inside of intervals, on sheets all around it. There,
what is above it of one goes on with what is below it of the one next to it, round the cusp.

The part of the surface that was swept is cut into monotone polygons, whose triangles are found on the way
(:mod:`plyfold.flat.monotone`).

If touching strands were moved apart, the line sweeps over the moved ones; but triangles are cut off as is right on the
points as given, for what is a corner of little more than no angle here may be one of a little less there.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.compiled import called_from_loops, run_loop
from plyfold.errors import PlyfoldError, PrecisionError
from plyfold.flat.monotone import (
    TRIANGLES,
    MonotonePolygons,
    Stacks,
    Triangles,
    add_vertex,
    close,
    count_up,
    empty_triangles,
    new_edge,
    new_polygon,
)
from plyfold.flat.sweep_line import TILTS, SkipList, empty_skip_list, link_above, sweep_plan, unlink
from plyfold.flat.swept_drawing import SweptDrawing, swept_drawing
from plyfold.halfedges import GluedTriangles, twins_of_edges
from plyfold.immersion.immersion import Immersion
from plyfold.mesh.begun import drawings_of
from plyfold.mesh.refine import given_outline, is_moved
from plyfold.mesh.sheets import twisted_bridges
from plyfold.predicates import Coordinates, as_coordinates, orient, turn

__all__ = ["sweep_as_drawn", "sweep_triangles"]


class _Strands(NamedTuple):
    """The edges on the line: the node of each in the skip list, the border that it is on now; the edge of each node.

    ``made`` has the number of nodes so far.
    """

    made: Ints
    node: Ints
    border: Ints
    edge: Ints


class _Intervals(NamedTuple):
    """The interval that each edge on the line bounds; of each interval the upper edge, and the polygons it closes.

    They are two, ``bottom`` and ``top``, after a vertex at which two intervals have become one: the next vertex of the
    interval sees it. ``made`` has the number of intervals so far.
    """

    made: Ints
    of_edge: Ints
    upper_edge: Ints
    bottom: Ints
    top: Ints


class _Sweep(NamedTuple):
    """Everything."""

    places: Coordinates
    drawing: SweptDrawing
    nodes: SkipList
    strands: _Strands
    intervals: _Intervals
    polygons: MonotonePolygons


def sweep_triangles(immersion: Immersion) -> GluedTriangles:
    """Return triangles on the points of an immersion's outline, by number, that make the immersed surface.

    Parameters
    ----------
    immersion : Immersion
        Of a drawing.

    Returns
    -------
    GluedTriangles
        n − 2χ triangles, where χ is the Euler characteristic; counter-clockwise, exactly, where the outline's points
        were given; only if strands touch there, some may have no area. Several edges may join two cusps.

    Notes
    -----
    O((n + k) log n), and for each vertex that splits an interval the number of strands above it in the surface.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> found = sweep_triangles(find_immersion([(0, 0), (4, 0), (1, 1), (0, 4)]))
    >>> found.faces.tolist(), found.twin.tolist()
    ([[0, 2, 3], [0, 1, 2]], [5, -1, -1, -1, -1, 0])
    """
    if not is_moved(immersion.arrangement):
        return sweep_as_drawn(immersion)
    given = given_outline(immersion.arrangement).points
    for drawn in drawings_of(immersion.arrangement):
        for tilt in TILTS:
            found = _swept_triangles(replace(immersion, arrangement=drawn), tilt, given)
            if len(found.faces) == _expected(immersion) and (orient(*given[found.faces].swapaxes(0, 1)) >= 0).all():
                return found
    raise PrecisionError(
        "touching strands were moved apart by more than there is room for",
        where=given[(given != immersion.arrangement.exact_points).any(axis=1)][:1],
        hint="move these points by hand",
    )


def sweep_as_drawn(immersion: Immersion) -> GluedTriangles:
    """Return triangles on the points that an immersion's outline is drawn with, by number: moved ones if any were.

    They are counter-clockwise there, exactly.
    """
    found = _swept_triangles(immersion, TILTS[0], None)
    if len(found.faces) == _expected(immersion):
        return found
    where = given_outline(immersion.arrangement).points[:1]
    raise PlyfoldError("internal check failed: the triangles make the surface", where=where)


def _expected(immersion: Immersion) -> int:
    """Return the number of triangles on the points of an outline."""
    return len(given_outline(immersion.arrangement)) - 2 * immersion.arrangement.euler_characteristic


def _swept_triangles(immersion: Immersion, tilt: float, given: Floats | None) -> GluedTriangles:
    """Return the triangles that are found by a line of some tilt, as is right on the points that are drawn, or given.

    They are all, unless moved strands confuse the line.
    """
    plan = sweep_plan(immersion.arrangement, twisted_bridges(immersion), tilt)
    drawing = swept_drawing(immersion, plan, given is not None)
    n = len(drawing.cusp)
    ahead = drawing.rank[:n] < drawing.rank[drawing.following[:n]]
    starts = int((ahead > ahead[drawing.preceding]).sum())
    turns = int((drawing.cusp + 1)[drawing.cusp > 0].sum())
    places = as_coordinates(plan.exact)
    corners = places if given is None else as_coordinates(given)
    told = (places, corners, drawing, *_room(n, starts, turns, len(plan.bridges)))
    # Room for one more: if there were more, that would be seen.
    output = run_loop(_swept, len(drawing.order), told, empty_triangles(_expected(immersion) + 1))
    found = output.counts[TRIANGLES]
    return GluedTriangles(output.faces[:found], twins_of_edges(output.sides[:found].ravel()))


def _room(n: int, starts: int, turns: int, bridges: int) -> tuple[SkipList, _Strands, _Intervals, Stacks]:
    """Return empty tables for an outline of n vertices, at some of which the line first meets it, and of some cusps."""

    def rows(count: int, size: int) -> Ints:
        return np.empty((count, size), dtype=np.int64)

    none = np.zeros((2, 1), dtype=np.int64)
    return (
        empty_skip_list(2 * starts + bridges),
        _Strands(none[0], *rows(2, n + bridges), *rows(1, 2 * starts + bridges + 1)),
        _Intervals(none[1], *rows(1, n + bridges), *rows(3, starts)),
        Stacks(*rows(2, starts + turns), *rows(3, 3 * (n + turns))),
    )


def _swept(
    given: tuple[Coordinates, Coordinates, SweptDrawing, SkipList, _Strands, _Intervals, Stacks], output: Triangles
) -> int:
    """Sweep; return how many triangles there are."""
    places, given_places, drawing, nodes, strands, intervals, stacks = given
    polygons = MonotonePolygons(given_places, drawing.flat, stacks, output)
    sweep = _Sweep(places, drawing, nodes, strands, intervals, polygons)
    rank, n = drawing.rank, len(drawing.cusp)
    for event in drawing.order:
        if event >= n:
            if drawing.partner[event - n] == event - n:
                _begin_bridge(sweep, event - n)
            else:
                _cross(sweep, event - n)
            continue
        if drawing.bridge_at[event] >= 0:
            unlink(nodes, strands.node[n + drawing.bridge_at[event]])
        before, after = drawing.preceding[event], drawing.following[event]
        comes, goes = rank[before] < rank[event], rank[event] < rank[after]
        if drawing.cusp[event] > 0:
            _wind(sweep, event, comes, goes)
        elif comes and goes:
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
    triangles: int = output.counts[TRIANGLES]
    return triangles


@called_from_loops
def _begin_bridge(sweep: _Sweep, foot: int) -> None:
    """Put a bridge on the line, beside the edge on which its second foot stands, that comes to its next border."""
    drawing, strands = sweep.drawing, sweep.strands
    edge, bridge = drawing.visit_edge[foot], drawing.bridge_of_foot[foot]
    strands.border[edge] = _border_behind(drawing, foot, edge)
    place = strands.node[edge]
    if drawing.above[bridge] == 0:
        place = sweep.nodes.below[place]
    own = len(drawing.cusp) + bridge
    _link(sweep, own, drawing.bridge_border[bridge], place)


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
def _runs_ahead(drawing: SweptDrawing, edge: int) -> bool:
    """Tell whether an edge runs in the direction in which the line moves."""
    return bool(drawing.rank[edge] < drawing.rank[drawing.following[edge]])


@called_from_loops
def _border_behind(drawing: SweptDrawing, visit: int, edge: int) -> int:
    """Return the border that the line comes to behind a visit."""
    border: int = drawing.after[visit] if _runs_ahead(drawing, edge) else drawing.before[visit]
    return border


@called_from_loops
def _replace(sweep: _Sweep, old: int, new: int, vertex: int) -> None:
    """Replace an edge on the line by the one beyond the vertex at which it ends, also as a bound of its interval."""
    _take_over(sweep, old, new, vertex)
    sweep.intervals.of_edge[new] = sweep.intervals.of_edge[old]


@called_from_loops
def _take_over(sweep: _Sweep, old: int, new: int, vertex: int) -> None:
    """Replace an edge on the line by the one beyond the vertex at which it ends."""
    strands = sweep.strands
    node = strands.node[old]
    strands.node[new] = node
    strands.edge[node] = new
    strands.border[new] = _border_at(sweep.drawing, new, vertex)


@called_from_loops
def _border_at(drawing: SweptDrawing, edge: int, vertex: int) -> int:
    """Return the border that an edge is on at a vertex where it starts or ends."""
    border: int = drawing.leaving[vertex] if edge == vertex else drawing.arriving[vertex]
    return border


@called_from_loops
def _begin(sweep: _Sweep, vertex: int, convex: bool) -> None:
    """Put both edges of a vertex on the line: they bound a new interval, or split one that the vertex is in."""
    intervals = sweep.intervals
    arriving, leaving = sweep.drawing.preceding[vertex], vertex
    place = _place_below(sweep, vertex)
    fresh = count_up(sweep.intervals.made, 0)
    if convex:
        intervals.bottom[fresh] = intervals.top[fresh] = new_polygon(sweep.polygons, vertex)
        intervals.upper_edge[fresh] = arriving
        intervals.of_edge[leaving] = intervals.of_edge[arriving] = fresh
        _insert(sweep, arriving, vertex, _insert(sweep, leaving, vertex, place))
    else:
        split = _interval_around(sweep, sweep.drawing.own_sheet[sweep.drawing.leaving[vertex]], place)
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
    end = drawing.following[edge]
    side = turn(sweep.places, edge, end, vertex)
    return side > 0 if drawing.rank[edge] < drawing.rank[end] else side < 0


@called_from_loops
def _interval_around(sweep: _Sweep, sheet: int, place: int) -> int:
    """Walk up in a sheet from above a given place, from sheet to sheet, to the edge at which the surface ends."""
    drawing, strands, above = sweep.drawing, sweep.strands, sweep.nodes.above
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
    return _link(sweep, edge, _border_at(sweep.drawing, edge, vertex), place)


@called_from_loops
def _link(sweep: _Sweep, edge: int, border: int, place: int) -> int:
    """Put an edge that is on some border on the line, above a given node; return its own node."""
    node = count_up(sweep.strands.made, 0) + 1
    sweep.strands.node[edge] = node
    sweep.strands.edge[node] = edge
    sweep.strands.border[edge] = border
    link_above(sweep.nodes, node, place)
    return node


@called_from_loops
def _end(sweep: _Sweep, vertex: int, convex: bool) -> None:
    """Take both edges of a vertex off the line: they bounded an interval, or two that become one."""
    intervals = sweep.intervals
    arriving, leaving = sweep.drawing.preceding[vertex], vertex
    lower, upper = intervals.of_edge[leaving], intervals.of_edge[arriving]
    if convex:
        bottom, top = intervals.bottom[lower], intervals.top[lower]
        edge = new_edge(sweep.polygons)
        close(sweep.polygons, bottom, vertex, edge, new_edge(sweep.polygons))
        if top != bottom:
            close(sweep.polygons, top, vertex, edge, new_edge(sweep.polygons))
    else:
        _meet(sweep, lower, vertex, 1)
        _meet(sweep, upper, vertex, -1)
        intervals.top[lower] = intervals.top[upper]
        intervals.upper_edge[lower] = intervals.upper_edge[upper]
        intervals.of_edge[intervals.upper_edge[upper]] = lower
    unlink(sweep.nodes, sweep.strands.node[arriving])
    unlink(sweep.nodes, sweep.strands.node[leaving])


@called_from_loops
def _wind(sweep: _Sweep, vertex: int, comes: bool, goes: bool) -> None:
    """Pass a cusp, round which the surface goes from the leaving edge to the arriving one.

    In this sense of rotation, what lies ahead of the line goes from below the cusp to above it, again and again: the
    first time from the leaving edge if that runs ahead, the last time to the arriving edge if that lies ahead. In
    between, it goes from what was below the cusp in one interval to what was above it in the next.
    """
    drawing, intervals = sweep.drawing, sweep.intervals
    arriving, convex = drawing.preceding[vertex], _is_convex(sweep, vertex)
    place = _place_at_cusp(sweep, vertex, comes, goes)
    last_polygon, last_edge = -1, arriving
    if comes:
        last = intervals.of_edge[arriving]
        _meet(sweep, last, vertex, -1)
        last_polygon, last_edge = intervals.bottom[last], intervals.upper_edge[last]
    current = _first_at_cusp(sweep, vertex, comes, goes)
    # Whether the outline has on its left what is right above the cusp.
    on_left = comes if comes == goes else not convex
    around = drawing.cusp[vertex]
    if comes != goes:
        around += (0 if convex else 1) - (1 if comes else 0)
    sheet = drawing.own_sheet[drawing.leaving[vertex]]
    for turn_number in range(around):
        sheet = _sheet_above(drawing, vertex, sheet, turn_number > 0, on_left)
        interval = _interval_around(sweep, sheet, place)
        _cut(sweep, interval, vertex)
        _join(sweep, current, intervals.top[interval], intervals.upper_edge[interval])
        current = interval
    _join(sweep, current, last_polygon if comes else intervals.bottom[current], last_edge)
    _move_edges(sweep, vertex, place, comes, goes)


@called_from_loops
def _is_convex(sweep: _Sweep, vertex: int) -> bool:
    drawing = sweep.drawing
    return bool(turn(sweep.places, drawing.preceding[vertex], vertex, drawing.following[vertex]) > 0)


@called_from_loops
def _place_at_cusp(sweep: _Sweep, vertex: int, comes: bool, goes: bool) -> int:
    """Return the node on the line above which everything is above a cusp."""
    node, arriving = sweep.strands.node, sweep.drawing.preceding[vertex]
    if not comes and goes:
        return _place_below(sweep, vertex)
    place: int = node[arriving] if comes and (goes or not _is_convex(sweep, vertex)) else node[vertex]
    return place


@called_from_loops
def _first_at_cusp(sweep: _Sweep, vertex: int, comes: bool, goes: bool) -> int:
    """Return the interval that the leaving edge of a cusp bounds; if that runs ahead, still without polygons."""
    intervals = sweep.intervals
    if not goes:
        below: int = intervals.of_edge[vertex]
        _meet(sweep, below, vertex, 1)
        return below
    fresh: int = intervals.of_edge[sweep.drawing.preceding[vertex]] if comes else count_up(sweep.intervals.made, 0)
    intervals.of_edge[vertex] = fresh
    intervals.bottom[fresh] = -1
    return fresh


@called_from_loops
def _sheet_above(drawing: SweptDrawing, vertex: int, sheet: int, whole: bool, on_left: bool) -> int:
    """Return the sheet right above a cusp to which one comes from its leaving edge, or by a whole turn from above.

    A turn leads over the arriving edge to the right side, over the leaving edge to the left side, and over a bridge
    that begins there. First comes the arriving edge if the outline has on its left what is right above.
    """
    bridge = drawing.bridge_at[vertex]
    at_bridge = drawing.before_bridge[bridge] if bridge >= 0 else -1
    underway = whole
    for passed in range(3):
        if underway and passed == at_bridge:
            sheet = drawing.beyond[drawing.row[2 * drawing.bridge_border[bridge] + 1] + sheet]
        if passed < 2:
            leaves = on_left == (passed == 1)
            if underway:
                dart = 2 * drawing.leaving[vertex] + 1 if leaves else 2 * drawing.arriving[vertex]
                sheet = drawing.beyond[drawing.row[dart] + sheet]
            underway = underway or leaves
    return sheet


@called_from_loops
def _join(sweep: _Sweep, interval: int, polygon: int, upper_edge: int) -> None:
    """Let an interval go on, above a cusp, with a polygon and up to an edge."""
    intervals = sweep.intervals
    if intervals.bottom[interval] < 0:
        intervals.bottom[interval] = polygon
    intervals.top[interval], intervals.upper_edge[interval] = polygon, upper_edge
    intervals.of_edge[upper_edge] = interval


@called_from_loops
def _move_edges(sweep: _Sweep, vertex: int, place: int, comes: bool, goes: bool) -> None:
    """Take the edges of a cusp that end there off the line, and put those that begin there on it."""
    arriving, convex = sweep.drawing.preceding[vertex], _is_convex(sweep, vertex)
    if comes and goes:
        _take_over(sweep, arriving, vertex, vertex)
    elif comes:
        unlink(sweep.nodes, sweep.strands.node[arriving])
        unlink(sweep.nodes, sweep.strands.node[vertex])
    elif goes:
        lower, upper = (vertex, arriving) if convex else (arriving, vertex)
        _insert(sweep, upper, vertex, _insert(sweep, lower, vertex, place))
    else:
        _take_over(sweep, vertex, arriving, vertex)


@called_from_loops
def _meet(sweep: _Sweep, interval: int, vertex: int, side: int) -> None:
    """Add a vertex on the upper (1) or lower (−1) edge of an interval to its polygon; of two it finishes one."""
    intervals = sweep.intervals
    bottom, top = intervals.bottom[interval], intervals.top[interval]
    near, far = (top, bottom) if side > 0 else (bottom, top)
    edge = new_edge(sweep.polygons)
    if near != far:
        close(sweep.polygons, near, vertex, edge, new_edge(sweep.polygons))
        intervals.bottom[interval] = intervals.top[interval] = far
    add_vertex(sweep.polygons, far, vertex, side, edge)


@called_from_loops
def _split(sweep: _Sweep, interval: int, fresh: int, vertex: int) -> None:
    """Split an interval at a vertex inside."""
    intervals = sweep.intervals
    _cut(sweep, interval, vertex)
    intervals.bottom[fresh] = intervals.top[fresh] = intervals.top[interval]
    intervals.top[interval] = intervals.bottom[interval]


@called_from_loops
def _cut(sweep: _Sweep, interval: int, vertex: int) -> None:
    """Cut the polygon of an interval at a vertex inside, which sees the last one that the interval has met.

    Afterwards the interval has one polygon below the vertex and one above it.
    """
    intervals, stacks = sweep.intervals, sweep.polygons.stacks
    bottom, top = intervals.bottom[interval], intervals.top[interval]
    if bottom == top:
        seen = new_polygon(sweep.polygons, stacks.vertex[stacks.last[top]])
        if stacks.side[top] < 0:
            bottom = seen
        else:
            top = seen
    edge = new_edge(sweep.polygons)
    add_vertex(sweep.polygons, bottom, vertex, 1, edge)
    add_vertex(sweep.polygons, top, vertex, -1, edge)
    intervals.bottom[interval], intervals.top[interval] = bottom, top
