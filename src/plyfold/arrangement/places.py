"""Places on the points as they were given, of what is known of the moved outline: for people, never to decide."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.polylines import inner_points, total_winding
from plyfold.arrays import Floats
from plyfold.outline.curve import Outline
from plyfold.predicates import orient, parameter_along_edge

__all__ = ["place_in_cell", "places_of_crossings", "places_of_visits"]


def places_of_visits(arranged: Arrangement, visits: Iterable[int]) -> tuple[tuple[float, float], ...]:
    """Return where visits are, if points in contact are where they were given; none if there is no drawing.

    Examples
    --------
    >>> from plyfold import arrange
    >>> crossing = arrange([(0, 0), (4, 0), (4, 4), (2, 4), (2, 0), (2, -2), (1, -2), (1, 4), (0, 4)])
    >>> places_of_visits(crossing, range(crossing.n_crossings))
    ((1.0, 0.0), (2.0, 0.0))
    """
    if arranged.outline is None:
        return ()
    if arranged.given is None or arranged.given is arranged.outline:
        return tuple((x, y) for x, y in arranged.visit_point[list(visits)].tolist())
    return tuple(_place_of_visit(arranged, arranged.given, visit) for visit in visits)


def places_of_crossings(arranged: Arrangement, crossings: Iterable[int]) -> tuple[tuple[float, float], ...]:
    """Return where crossings are, if points in contact are where they were given; none if there is no drawing."""
    return places_of_visits(arranged, arranged.first_visits[list(crossings)].tolist())


def place_in_cell(arranged: Arrangement, cell: int) -> tuple[float, float]:
    """Return a place in a cell, also of the points as given; of a cell that moves opened, a given point on its edge."""
    place, given = arranged.cell_point(cell), arranged.given
    if given is None or given is arranged.outline:
        return place
    within = (arranged.outline or given).loops, given.loops
    for x, y in (place, *(inner_points(arranged.cell_outlines(cell)) if cell else ())):
        if all(total_winding(loops, (x, y)) == arranged.winding[cell] for loops in within):
            return x, y
    return _on_edge_of_cell(arranged, given, cell)


def _on_edge_of_cell(arranged: Arrangement, given: Outline, cell: int) -> tuple[float, float]:
    """Return a crossing on the boundary of a cell, or the first point of a loop."""
    borders = arranged.cell_darts[arranged.cell_start[cell] : arranged.cell_start[cell + 1]] // 2
    starts = arranged.start_visit[borders]
    crossings = [visit for visit in starts.tolist() if visit >= 0 and arranged.partner[visit] != visit]
    if crossings:
        return places_of_visits(arranged, crossings[:1])[0]
    x, y = given.points[given.first_point[arranged.loop_of_border[borders[0]]]].tolist()
    return x, y


def _place_of_visit(arranged: Arrangement, given: Outline, visit: int) -> tuple[float, float]:
    """Return where a cusp is; and where two edges cross, or touch nearest to where they cross when moved."""
    edge, other = (int(arranged.visit_edge[at]) for at in (visit, arranged.partner[visit]))
    place = arranged.visit_point[visit]
    if arranged.cusp_index[visit]:
        place = given.points[edge]
    elif edge != other:
        ends = given.points[[[edge, given.next_point[edge]], [other, given.next_point[other]]]]
        touching = _touching(ends[0], ends[1]) + _touching(ends[1], ends[0])
        place = min(touching, key=lambda end: float(np.hypot(*(end - place)))) if touching else _crossing(*ends)
    x, y = place.tolist()
    return x, y


def _touching(edge: Floats, other: Floats) -> list[Floats]:
    """Return the ends of an edge that lie on another one."""
    on_line = orient(other[0], other[1], edge) == 0
    within = ((other.min(axis=0) <= edge) & (edge <= other.max(axis=0))).all(axis=1)
    return list(edge[on_line & within])


def _crossing(edge: Floats, other: Floats) -> Floats:
    share, _ = parameter_along_edge(*(end[None] for end in (*edge, *other)))
    return np.asarray(edge[0] + share[0] * (edge[1] - edge[0]))
