"""A line that sweeps over an immersed surface and cuts it into triangles. See `flat.sweep`."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer, whole_room
from plyfold.core.monotone import MonotonePolygons
from plyfold.core.pauses import pause
from plyfold.core.skip_list import SkipList
from plyfold.core.turns import ExactPoints, turn

__all__ = ["Drawing", "sweep_over"]

# After so many events there is a pause.
_AT_A_TIME = 4096


class Drawing:
    """What is swept: the order of events, and the gluing.

    Parameters
    ----------
    order, rank : buffer of int
        The order of `sweep_order`, and the place of each vertex in it.
    following, preceding : buffer of int
        The neighbours of each vertex on its loop. Bridges have edges and ends of their own, numbered after all
        vertices.
    partner, visit_edge, before, after : buffer of int
        Of each visit; ``before`` and ``after`` are the borders there.
    arriving, leaving : buffer of int
        The borders that end and begin at each vertex, or the one that it is on.
    cusp : buffer of int
        The index of each vertex.
    bridge_of_foot, bridge_at : buffer of int
        The bridge whose second foot is at each visit, and the one whose first foot is at each vertex, or −1.
    above, before_bridge, bridge_border : buffer of int
        Of each bridge: whether it begins above the edge that its second foot is on; to how many edges of its first foot
        one turns from right above there, counter-clockwise, before one turns to the bridge; its border.
    own_sheet, row, beyond : buffer of int
        The own sheet of each border. The sheet beyond a dart, seen from a sheet on its left, is
        ``beyond[row[dart] + sheet]``, or −1.
    """

    def __init__(
        self,
        order: WholeBuffer,
        rank: WholeBuffer,
        following: WholeBuffer,
        preceding: WholeBuffer,
        partner: WholeBuffer,
        visit_edge: WholeBuffer,
        before: WholeBuffer,
        after: WholeBuffer,
        arriving: WholeBuffer,
        leaving: WholeBuffer,
        cusp: WholeBuffer,
        bridge_of_foot: WholeBuffer,
        bridge_at: WholeBuffer,
        above: WholeBuffer,
        before_bridge: WholeBuffer,
        bridge_border: WholeBuffer,
        own_sheet: WholeBuffer,
        row: WholeBuffer,
        beyond: WholeBuffer,
    ) -> None:
        self.order, self.rank = order, rank
        self.following, self.preceding = following, preceding
        self.partner, self.visit_edge, self.before, self.after = partner, visit_edge, before, after
        self.arriving, self.leaving, self.cusp = arriving, leaving, cusp
        self.bridge_of_foot, self.bridge_at = bridge_of_foot, bridge_at
        self.above, self.before_bridge, self.bridge_border = above, before_bridge, bridge_border
        self.own_sheet, self.row, self.beyond = own_sheet, row, beyond


class StrandsOnLine:
    """The edges on the line: the node of each in the skip list, the border that it is on now; the edge of each node.

    ``made`` is the number of nodes so far.
    """

    def __init__(self, edges: int, nodes: int) -> None:
        self.made = 0
        self.room = whole_room(2 * edges + nodes + 1)
        self.node, self.border, self.edge = self.room[:edges], self.room[edges : 2 * edges], self.room[2 * edges :]


class IntervalsOnLine:
    """The interval that each edge on the line bounds; of each interval the upper edge, and the polygons it closes.

    They are two, ``bottom`` and ``top``, after a vertex at which two intervals have become one: the next vertex of the
    interval sees it. ``made`` is the number of intervals so far.
    """

    def __init__(self, edges: int, most: int) -> None:
        self.made = 0
        self.room = whole_room(edges + 3 * most)
        self.of_edge, self.upper_edge = self.room[:edges], self.room[edges : edges + most]
        self.bottom, self.top = self.room[edges + most : edges + 2 * most], self.room[edges + 2 * most :]

    def begin(self) -> int:
        """Return a new interval."""
        self.made += 1
        return self.made - 1


class Sweep:
    """Everything."""

    def __init__(
        self,
        drawing: Drawing,
        points: ExactPoints,
        given: ExactPoints,
        is_flat: bool,
        faces: WholeBuffer,
        sides: WholeBuffer,
    ) -> None:
        self.drawing, self.points = drawing, points
        self.n, bridges = len(self.drawing.cusp), len(self.drawing.above)
        starts, turns = _count_starts(drawing, self.n), _count_turns(drawing, self.n)
        self.nodes = SkipList(2 * starts + bridges)
        self.strands = StrandsOnLine(self.n + bridges, 2 * starts + bridges)
        self.intervals = IntervalsOnLine(self.n + bridges, starts)
        self.polygons = MonotonePolygons(given, is_flat, starts + turns, 3 * (self.n + turns), faces, sides)


def _count_starts(drawing: Drawing, n: int) -> int:
    """Return at how many vertices the line first meets something."""
    starts = 0
    for vertex in range(n):
        before, after = drawing.preceding[vertex], drawing.following[vertex]
        if drawing.rank[vertex] < drawing.rank[after] and drawing.rank[vertex] < drawing.rank[before]:
            starts += 1
    return starts


def _count_turns(drawing: Drawing, n: int) -> int:
    """Return how often the surface lies round cusps, at most."""
    turns = 0
    for vertex in range(n):
        if drawing.cusp[vertex] > 0:
            turns += drawing.cusp[vertex] + 1
    return turns


def sweep_over(
    drawing: Drawing, points: ExactPoints, given: ExactPoints, is_flat: bool, faces: WholeBuffer, sides: WholeBuffer
) -> int:
    """Sweep; return how many triangles there are.

    Parameters
    ----------
    drawing : Drawing
    points, given : ExactPoints
        What is swept, and the points on which triangles are cut off.
    is_flat : bool
        Whether triangles may be flat.
    faces, sides : buffer of int
        Room for triangles, and for the numbers of edges at their sides, three numbers each.

    Raises
    ------
    IndexError
        Only if moved strands confuse the line.
    """
    sweep = Sweep(drawing, points, given, is_flat, faces, sides)
    for place in range(len(drawing.order)):
        if place % _AT_A_TIME == _AT_A_TIME - 1:
            pause()
        event = drawing.order[place]
        if event < sweep.n:
            _pass_vertex(sweep, event)
        elif drawing.partner[event - sweep.n] == event - sweep.n:
            _begin_bridge(sweep, event - sweep.n)
        else:
            _cross(sweep, event - sweep.n)
    return sweep.polygons.n_triangles


def _pass_vertex(sweep: Sweep, vertex: int) -> None:
    """Pass a vertex."""
    drawing = sweep.drawing
    if drawing.bridge_at[vertex] >= 0:
        sweep.nodes.unlink(sweep.strands.node[sweep.n + drawing.bridge_at[vertex]])
    before, after = drawing.preceding[vertex], drawing.following[vertex]
    comes, goes = drawing.rank[before] < drawing.rank[vertex], drawing.rank[vertex] < drawing.rank[after]
    if drawing.cusp[vertex] > 0:
        _wind(sweep, vertex, comes, goes)
    elif comes and goes:
        _replace(sweep, before, vertex, vertex)
        _meet(sweep, sweep.intervals.of_edge[vertex], vertex, -1)
    elif not comes and not goes:
        _replace(sweep, vertex, before, vertex)
        sweep.intervals.upper_edge[sweep.intervals.of_edge[before]] = before
        _meet(sweep, sweep.intervals.of_edge[before], vertex, 1)
    elif goes:
        _begin(sweep, vertex, _is_convex(sweep, vertex))
    else:
        _end(sweep, vertex, _is_convex(sweep, vertex))


def _begin_bridge(sweep: Sweep, foot: int) -> None:
    """Put a bridge on the line, beside the edge on which its second foot stands, that comes to its next border."""
    drawing, strands = sweep.drawing, sweep.strands
    edge, bridge = drawing.visit_edge[foot], drawing.bridge_of_foot[foot]
    strands.border[edge] = _border_behind(drawing, foot, edge)
    place = strands.node[edge]
    if drawing.above[bridge] == 0:
        place = sweep.nodes.below[place]
    _link(sweep, sweep.n + bridge, drawing.bridge_border[bridge], place)


def _cross(sweep: Sweep, visit: int) -> None:
    """Swap two edges on the line; each comes to its next border."""
    drawing, strands = sweep.drawing, sweep.strands
    other = drawing.partner[visit]
    one_edge, other_edge = drawing.visit_edge[visit], drawing.visit_edge[other]
    node, other_node = strands.node[one_edge], strands.node[other_edge]
    strands.node[one_edge], strands.node[other_edge] = other_node, node
    strands.edge[node], strands.edge[other_node] = other_edge, one_edge
    strands.border[one_edge] = _border_behind(drawing, visit, one_edge)
    strands.border[other_edge] = _border_behind(drawing, other, other_edge)


def _runs_ahead(drawing: Drawing, edge: int) -> bool:
    """Tell whether an edge runs in the direction in which the line moves."""
    return drawing.rank[edge] < drawing.rank[drawing.following[edge]]


def _border_behind(drawing: Drawing, visit: int, edge: int) -> int:
    """Return the border that the line comes to behind a visit."""
    return drawing.after[visit] if _runs_ahead(drawing, edge) else drawing.before[visit]


def _replace(sweep: Sweep, old: int, new: int, vertex: int) -> None:
    """Replace an edge on the line by the one beyond the vertex at which it ends, also as a bound of its interval."""
    _take_over(sweep, old, new, vertex)
    sweep.intervals.of_edge[new] = sweep.intervals.of_edge[old]


def _take_over(sweep: Sweep, old: int, new: int, vertex: int) -> None:
    """Replace an edge on the line by the one beyond the vertex at which it ends."""
    strands = sweep.strands
    node = strands.node[old]
    strands.node[new] = node
    strands.edge[node] = new
    strands.border[new] = _border_at(sweep.drawing, new, vertex)


def _border_at(drawing: Drawing, edge: int, vertex: int) -> int:
    """Return the border that an edge is on at a vertex where it starts or ends."""
    return drawing.leaving[vertex] if edge == vertex else drawing.arriving[vertex]


def _begin(sweep: Sweep, vertex: int, convex: bool) -> None:
    """Put both edges of a vertex on the line: they bound a new interval, or split one that the vertex is in."""
    intervals = sweep.intervals
    arriving, leaving = sweep.drawing.preceding[vertex], vertex
    place = _place_below(sweep, vertex)
    fresh = intervals.begin()
    if convex:
        intervals.bottom[fresh] = intervals.top[fresh] = sweep.polygons.begin(vertex)
        intervals.upper_edge[fresh] = arriving
        intervals.of_edge[leaving] = intervals.of_edge[arriving] = fresh
        _insert(sweep, arriving, vertex, _insert(sweep, leaving, vertex, place))
    else:
        split = _interval_around(sweep, sweep.drawing.own_sheet[sweep.drawing.leaving[vertex]], place)
        upper = intervals.upper_edge[split]
        _split(sweep, split, fresh, vertex)
        intervals.upper_edge[split], intervals.upper_edge[fresh] = arriving, upper
        intervals.of_edge[arriving] = split
        intervals.of_edge[leaving] = intervals.of_edge[upper] = fresh
        _insert(sweep, leaving, vertex, _insert(sweep, arriving, vertex, place))


def _place_below(sweep: Sweep, vertex: int) -> int:
    """Return the node of the edge on the line just below a vertex, or 0."""
    nodes, strands = sweep.nodes, sweep.strands
    place = 0
    for level in range(nodes.height[0], -1, -1):
        base = level * nodes.size
        above = nodes.above[base + place]
        while above != 0 and _is_above(sweep, vertex, strands.edge[above]):
            place = above
            above = nodes.above[base + place]
    return place


def _is_above(sweep: Sweep, vertex: int, edge: int) -> bool:
    """Tell whether a vertex is above an edge on the line."""
    drawing = sweep.drawing
    end = drawing.following[edge]
    side = turn(sweep.points, edge, end, vertex)
    return side > 0 if drawing.rank[edge] < drawing.rank[end] else side < 0


def _interval_around(sweep: Sweep, sheet: int, place: int) -> int:
    """Walk up in a sheet from above a given place, from sheet to sheet, to the edge at which the surface ends."""
    drawing, strands, nodes = sweep.drawing, sweep.strands, sweep.nodes
    edge = 0
    while sheet >= 0:
        place = nodes.above[place]
        edge = strands.edge[place]
        # Out of the sheet on the left of a dart: below an edge that runs ahead, that is of the backward one.
        dart = 2 * strands.border[edge] + (1 if _runs_ahead(drawing, edge) else 0)
        sheet = drawing.beyond[drawing.row[dart] + sheet]
    return sweep.intervals.of_edge[edge]


def _insert(sweep: Sweep, edge: int, vertex: int, place: int) -> int:
    """Put an edge that begins at a vertex on the line, above a given node; return its own node."""
    return _link(sweep, edge, _border_at(sweep.drawing, edge, vertex), place)


def _link(sweep: Sweep, edge: int, border: int, place: int) -> int:
    """Put an edge that is on some border on the line, above a given node; return its own node."""
    strands = sweep.strands
    strands.made += 1
    node = strands.made
    strands.node[edge] = node
    strands.edge[node] = edge
    strands.border[edge] = border
    sweep.nodes.link(node, place)
    return node


def _end(sweep: Sweep, vertex: int, convex: bool) -> None:
    """Take both edges of a vertex off the line: they bounded an interval, or two that become one."""
    intervals, polygons = sweep.intervals, sweep.polygons
    arriving, leaving = sweep.drawing.preceding[vertex], vertex
    lower, upper = intervals.of_edge[leaving], intervals.of_edge[arriving]
    if convex:
        bottom, top = intervals.bottom[lower], intervals.top[lower]
        edge = polygons.new_edge()
        polygons.close(bottom, vertex, edge, polygons.new_edge())
        if top != bottom:
            polygons.close(top, vertex, edge, polygons.new_edge())
    else:
        _meet(sweep, lower, vertex, 1)
        _meet(sweep, upper, vertex, -1)
        intervals.top[lower] = intervals.top[upper]
        intervals.upper_edge[lower] = intervals.upper_edge[upper]
        intervals.of_edge[intervals.upper_edge[upper]] = lower
    sweep.nodes.unlink(sweep.strands.node[arriving])
    sweep.nodes.unlink(sweep.strands.node[leaving])


def _wind(sweep: Sweep, vertex: int, comes: bool, goes: bool) -> None:
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


def _is_convex(sweep: Sweep, vertex: int) -> bool:
    drawing = sweep.drawing
    return turn(sweep.points, drawing.preceding[vertex], vertex, drawing.following[vertex]) > 0


def _place_at_cusp(sweep: Sweep, vertex: int, comes: bool, goes: bool) -> int:
    """Return the node on the line above which everything is above a cusp."""
    if not comes and goes:
        return _place_below(sweep, vertex)
    is_below = comes and (goes or not _is_convex(sweep, vertex))
    return sweep.strands.node[sweep.drawing.preceding[vertex] if is_below else vertex]


def _first_at_cusp(sweep: Sweep, vertex: int, comes: bool, goes: bool) -> int:
    """Return the interval that the leaving edge of a cusp bounds; if that runs ahead, still without polygons."""
    intervals = sweep.intervals
    if not goes:
        _meet(sweep, intervals.of_edge[vertex], vertex, 1)
        return intervals.of_edge[vertex]
    fresh = intervals.of_edge[sweep.drawing.preceding[vertex]] if comes else intervals.begin()
    intervals.of_edge[vertex] = fresh
    intervals.bottom[fresh] = -1
    return fresh


def _sheet_above(drawing: Drawing, vertex: int, sheet: int, whole: bool, on_left: bool) -> int:
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


def _join(sweep: Sweep, interval: int, polygon: int, upper_edge: int) -> None:
    """Let an interval go on, above a cusp, with a polygon and up to an edge."""
    intervals = sweep.intervals
    if intervals.bottom[interval] < 0:
        intervals.bottom[interval] = polygon
    intervals.top[interval], intervals.upper_edge[interval] = polygon, upper_edge
    intervals.of_edge[upper_edge] = interval


def _move_edges(sweep: Sweep, vertex: int, place: int, comes: bool, goes: bool) -> None:
    """Take the edges of a cusp that end there off the line, and put those that begin there on it."""
    arriving, convex = sweep.drawing.preceding[vertex], _is_convex(sweep, vertex)
    if comes and goes:
        _take_over(sweep, arriving, vertex, vertex)
    elif comes:
        sweep.nodes.unlink(sweep.strands.node[arriving])
        sweep.nodes.unlink(sweep.strands.node[vertex])
    elif goes:
        lower, upper = vertex if convex else arriving, arriving if convex else vertex
        _insert(sweep, upper, vertex, _insert(sweep, lower, vertex, place))
    else:
        _take_over(sweep, vertex, arriving, vertex)


def _meet(sweep: Sweep, interval: int, vertex: int, side: int) -> None:
    """Add a vertex on the upper (1) or lower (−1) edge of an interval to its polygon; of two it finishes one."""
    intervals, polygons = sweep.intervals, sweep.polygons
    bottom, top = intervals.bottom[interval], intervals.top[interval]
    near, far = top if side > 0 else bottom, bottom if side > 0 else top
    edge = polygons.new_edge()
    if near != far:
        polygons.close(near, vertex, edge, polygons.new_edge())
        intervals.bottom[interval] = intervals.top[interval] = far
    polygons.add(far, vertex, side, edge)


def _split(sweep: Sweep, interval: int, fresh: int, vertex: int) -> None:
    """Split an interval at a vertex inside."""
    intervals = sweep.intervals
    _cut(sweep, interval, vertex)
    intervals.bottom[fresh] = intervals.top[fresh] = intervals.top[interval]
    intervals.top[interval] = intervals.bottom[interval]


def _cut(sweep: Sweep, interval: int, vertex: int) -> None:
    """Cut the polygon of an interval at a vertex inside, which sees the last one that the interval has met.

    Afterwards the interval has one polygon below the vertex and one above it.
    """
    intervals, polygons = sweep.intervals, sweep.polygons
    bottom, top = intervals.bottom[interval], intervals.top[interval]
    if bottom == top:
        seen = polygons.begin_behind(top)
        if polygons.side[top] < 0:
            bottom = seen
        else:
            top = seen
    edge = polygons.new_edge()
    polygons.add(bottom, vertex, 1, edge)
    polygons.add(top, vertex, -1, edge)
    intervals.bottom[interval], intervals.top[interval] = bottom, top
