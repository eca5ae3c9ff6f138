"""The planar map of several closed curves, which may cross themselves and each other, lie apart or inside each other.

Everything is as for one curve (:mod:`plyfold.arrangement.arrangement`), but for two things. The borders are not
numbered through: each loop closes on itself. And a cell may have several boundaries: where loops do not hang together,
exact point location says in which cell of the others they lie.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from plyfold.arrangement.arrangement import CurveLike, polygon_turning_number
from plyfold.arrangement.crossings import Contacts, Visits, edge_ends, find_contacts, order_visits
from plyfold.arrangement.general_position import touching_places
from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.errors import GeneralPositionError, InputError
from plyfold.outline.curve import Curve, as_curve
from plyfold.predicates import cross_sign, exact_parameter

__all__ = ["Loops", "are_several", "arrange_loops", "components"]


@dataclass(frozen=True, eq=False)
class Loops:
    """The arrangement of several closed curves, each in the direction in which it was given.

    Made by :func:`arrange_loops`.

    Parameters
    ----------
    curves : tuple of Curve
    crossings : (k, 2) float
        Positions, rounded, in the order of their first visits.
    crossing_of_visit : (2k,) int
        Visits are numbered along the first curve, then along the second one, and so on.
    border_before : (2k,) int
        The border that ends at each visit; the one that starts there has the visit's number.
    first, second : (k,) int
        The two visits to each crossing; the second strand crosses the first one from right to left.
    loop_of_border : (borders,) int
        The curve that each border belongs to. Curves that cross nothing have one border each, after all others.
    cell_of_dart : (2 borders,) int
        The cell on the left of each dart: border i forward is dart 2i, backward 2i + 1. Cell 0 is the unbounded one.
    winding : (cells,) int
        Winding number of each cell, all curves added up.
    turning_number : (curves,) int
        Of each curve.

    Examples
    --------
    >>> annulus = arrange_loops([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])
    >>> annulus.winding.tolist(), annulus.turning_number.tolist()
    ([0, 1, 0], [1, -1])
    """

    curves: tuple[Curve, ...]
    crossings: Floats
    crossing_of_visit: Ints
    border_before: Ints
    first: Ints
    second: Ints
    loop_of_border: Ints
    cell_of_dart: Ints
    winding: Ints
    turning_number: Ints

    @property
    def partner(self) -> Ints:
        """The other visit to the crossing of each visit, shape (2k,)."""
        partner = np.empty(2 * len(self.first), dtype=np.int64)
        partner[self.first], partner[self.second] = self.second, self.first
        return partner

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        return f"<Loops: {len(self.curves)} curves, {len(self.crossings)} crossings>"

    @property
    def n_borders(self) -> int:
        """Number of borders."""
        return len(self.loop_of_border)

    @property
    def left_cell(self) -> Ints:
        """The cell on the left of each border, shape (borders,)."""
        return self.cell_of_dart[0::2]

    @property
    def right_cell(self) -> Ints:
        """The cell on the right of each border, shape (borders,)."""
        return self.cell_of_dart[1::2]


def arrange_loops(curves: Iterable[CurveLike]) -> Loops:
    """Find crossings, borders, cells and winding numbers of several closed curves.

    Parameters
    ----------
    curves : iterable of Curve, array_like of shape (n, 2) or shapely geometry
        Each keeps its direction: the surface that they bound is to lie on the left, so an outer boundary runs
        counter-clockwise and that of a hole clockwise.

    Returns
    -------
    Loops
        Exact.

    Raises
    ------
    InputError
        If there is no curve.
    GeneralPositionError
        If a vertex lies on another edge or three edges meet in a point. Nothing is moved.

    Notes
    -----
    As for one curve, plus O(n) for each group of curves that hang together by crossings.
    """
    drawn = tuple(as_curve(curve) for curve in curves)
    if not drawn:
        raise InputError("there is no curve", hint="give a list of closed curves")
    polyline = _one_after_the_other(drawn)
    visits = _visits(polyline)
    borders = _borders(polyline, visits)
    cell_of_dart = _cells(polyline, visits, borders)
    crossing = np.unique(np.minimum(np.arange(len(visits.partner)), visits.partner), return_inverse=True)[1]
    first = np.flatnonzero(visits.ccw)
    first = first[np.argsort(crossing[first])]
    return Loops(
        curves=drawn,
        crossings=visits.point[np.arange(len(visits.point)) < visits.partner],
        crossing_of_visit=crossing,
        border_before=borders.before,
        first=first,
        second=visits.partner[first],
        loop_of_border=borders.loop,
        cell_of_dart=cell_of_dart,
        winding=_windings(cell_of_dart),
        turning_number=np.array([polygon_turning_number(curve.points) for curve in drawn]),
    )


def are_several(value: object) -> bool:
    """Tell a collection of closed curves from a single one.

    Examples
    --------
    >>> triangle = [(0, 0), (1, 0), (0, 1)]
    >>> are_several(triangle), are_several([triangle]), are_several([Curve(triangle), triangle])
    (False, True, True)
    """
    return isinstance(value, list | tuple | np.ndarray) and len(value) > 0 and all(map(_is_curve, value))


def _is_curve(value: object) -> bool:
    if isinstance(value, list | tuple | np.ndarray):
        return len(value) > 0 and np.ndim(value[0]) == 1
    return isinstance(value, Curve) or hasattr(value, "geom_type") or hasattr(value, "curve")


# ---- crossings -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Polyline:
    """All loops as one polyline: each ends with a copy of its first point, and a *bridge* leads from there to the next.

    Parameters
    ----------
    points : (n, 2) float
    loop : (n,) int
        The loop of each point and of the edge that starts there.
    vertex : (n,) int
        The first point of the loop for the copies of it, and each other point itself.
    is_bridge : (n,) bool
        True where the edge that starts at a point is a bridge.
    """

    points: Floats
    loop: Ints
    vertex: Ints
    is_bridge: Bools


def _one_after_the_other(curves: tuple[Curve, ...]) -> _Polyline:
    lengths = np.array([len(curve) + 1 for curve in curves])
    last = np.cumsum(lengths) - 1
    vertex = np.arange(int(lengths.sum()))
    vertex[last] -= lengths - 1
    return _Polyline(
        points=np.concatenate([points for curve in curves for points in (curve.points, curve.points[:1])]),
        loop=np.repeat(np.arange(len(curves)), lengths),
        vertex=vertex,
        is_bridge=np.isin(np.arange(len(vertex)), last),
    )


def _visits(polyline: _Polyline) -> Visits:
    """Return the visits to all crossings along one loop after the other; refuse loops that touch."""
    found = find_contacts(polyline.points)
    edges, touches = found.edges, _own_touches_left_out(polyline, found.touches)
    real = ~polyline.is_bridge[edges].any(axis=1)
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
    """Leave out the touches of bridges, and those of edges that share the point with which a loop begins and ends."""
    vertex, edge = polyline.vertex[touches[:, 0]], touches[:, 1]
    following = polyline.vertex[(edge + 1) % len(polyline.vertex)]
    kept = ~polyline.is_bridge[edge] & (vertex != edge) & (vertex != following)
    return np.stack([vertex[kept], edge[kept]], axis=1)


# ---- borders and cells ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Borders:
    """The borders of all loops.

    Parameters
    ----------
    before : (2k,) int
        The border that ends at each visit.
    loop : (borders,) int
    start : (loops + 1,) int
        The number of each loop's first visit.
    alone : (loops,) int
        The border of each loop without visits; meaningless for the others.
    """

    before: Ints
    loop: Ints
    start: Ints
    alone: Ints

    def at(self, loop: int, visits_passed: int) -> int:
        """Return the border of a loop after a number of visits, those on earlier loops counted too."""
        low, high = self.start[loop], self.start[loop + 1]
        if low == high:
            return int(self.alone[loop])
        return int(visits_passed if visits_passed > low else high) - 1


def _borders(polyline: _Polyline, visits: Visits) -> _Borders:
    n_loops = int(polyline.loop[-1]) + 1
    loop_of_visit = polyline.loop[visits.edge]
    start = np.searchsorted(loop_of_visit, np.arange(n_loops + 1))
    without = np.diff(start) == 0
    before = np.arange(len(loop_of_visit)) - 1
    before[start[:-1][~without]] = start[1:][~without] - 1
    return _Borders(
        before=before,
        loop=np.concatenate([loop_of_visit, np.flatnonzero(without)]),
        start=start,
        alone=len(loop_of_visit) + np.cumsum(without) - 1,
    )


def _cells(polyline: _Polyline, visits: Visits, borders: _Borders) -> Ints:
    """Return the cell on the left of each dart: boundaries that follow each other, joined where loops lie in a cell."""
    darts = np.arange(2 * len(borders.loop))
    boundary = 1 + components(len(darts), darts, _next_darts(visits, borders))
    group = components(len(borders.start) - 1, borders.loop[: len(visits.edge)], borders.loop[visits.partner])
    inside, around = [], []
    for number in range(int(group.max()) + 1):
        own = group[polyline.loop] == number
        corner = _leftmost(polyline, own)
        inside.append(boundary[_outer_dart(polyline, visits, borders, corner)])
        host = _dart_on_the_left(polyline, visits, borders, corner, own)
        around.append(0 if host is None else boundary[host])
    return components(int(boundary.max()) + 1, np.array(inside), np.array(around))[boundary]


def _next_darts(visits: Visits, borders: _Borders) -> Ints:
    """Return the dart that follows each dart around the cell on its left; see planar_map.next_darts for the rule."""
    following = np.arange(2 * len(borders.loop))
    outgoing, incoming = 2 * visits.partner, 2 * borders.before[visits.partner] + 1
    following[2 * borders.before] = np.where(visits.ccw, outgoing, incoming)
    following[2 * np.arange(len(visits.edge)) + 1] = np.where(visits.ccw, incoming, outgoing)
    return following


def components(n: int, start: Ints, end: Ints) -> Ints:
    """Return the connected component of each of n nodes, given edges between them; that of node 0 has number 0."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(start)), (start, end)), shape=(n, n))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _leftmost(polyline: _Polyline, own: Bools) -> int:
    """Return the leftmost vertex of some loops, the lowest of several."""
    candidates = np.flatnonzero(own & ~polyline.is_bridge)
    x, y = polyline.points[candidates].T
    return int(candidates[np.lexsort([y, x])[0]])


def _outer_dart(polyline: _Polyline, visits: Visits, borders: _Borders, corner: int) -> int:
    """Return the dart that has the outside on its left at a leftmost vertex."""
    copies = np.flatnonzero(polyline.vertex == corner)
    before, here, after = polyline.points[[copies[-1] - 1, corner, corner + 1]]
    border = borders.at(int(polyline.loop[corner]), int(np.searchsorted(visits.edge, corner)))
    return 2 * border + int(cross_sign(before, here, here, after) > 0)


def _dart_on_the_left(polyline: _Polyline, visits: Visits, borders: _Borders, corner: int, own: Bools) -> int | None:
    """Return the dart of the other loops that a ray from a vertex to the left meets first, on the side that it meets.

    The ray runs a little higher than the vertex, by less than any other difference in height. So it meets no vertices
    and no crossings.
    """
    height = polyline.points[corner, 1]
    ends = edge_ends(polyline.points)
    low = ends[:, :, 1] <= height
    met = (
        ~own & ~polyline.is_bridge & (low[:, 0] != low[:, 1]) & (ends[:, :, 0].min(axis=1) < polyline.points[corner, 0])
    )
    places = {edge: _place_and_slope(ends[edge], height) for edge in np.flatnonzero(met).tolist()}
    here = Fraction(float(polyline.points[corner, 0]))
    passed = [edge for edge, (x, _) in places.items() if x < here]
    if not passed:
        return None
    edge = max(passed, key=places.__getitem__)
    upward = bool(low[edge, 0])
    border = borders.at(int(polyline.loop[edge]), _visits_passed(visits, ends, edge, height, upward))
    return 2 * border + upward


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


def _windings(cell_of_dart: Ints) -> Ints:
    """Return the winding numbers: none in the unbounded cell, one more on the left of each border than on its right."""
    neighbours: dict[int, list[tuple[int, int]]] = defaultdict(list)
    for left, right in cell_of_dart.reshape(-1, 2).tolist():
        neighbours[right].append((left, 1))
        neighbours[left].append((right, -1))
    winding = {0: 0}
    waiting = [0]
    while waiting:
        cell = waiting.pop()
        for other, step in neighbours[cell]:
            if other not in winding:
                winding[other] = winding[cell] + step
                waiting.append(other)
    return np.array([winding[cell] for cell in range(len(winding))], dtype=np.int64)
