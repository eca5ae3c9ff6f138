"""From an outline in general position to the planar map that it draws."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from plyfold.arrangement.general_position import GeneralPosition, in_general_position
from plyfold.arrangement.maps import CellWalk, Code, Map, oriented, outer_dart, walked_round
from plyfold.arrangement.marks import cusps_of_outline, with_marks
from plyfold.arrangement.nesting import nest
from plyfold.clock import Watch
from plyfold.outline.curve import Outline, backward_numbers

__all__ = ["DrawnMap", "drawn_map"]


class DrawnMap(NamedTuple):
    """A planar map, the walk round its cells, the turning number of each loop, the loops, and where they came from."""

    drawn: Map
    walked: CellWalk
    turning: tuple[int, ...]
    outline: Outline
    more: dict[str, Any]


def drawn_map(placed: GeneralPosition, watch: Watch) -> DrawnMap:
    """Return the planar map that an outline draws: turned round, if that is not settled and the surface asks for it."""
    watch.step()
    if placed.outline.n_loops == 1:
        return _drawn_curve(placed)
    found = _drawn_loops(placed, watch)
    if placed.turned_round is not None or found.drawn.code.left.max() > 0:
        return found
    backward = in_general_position(placed.outline.reversed(), "raise", watch)
    numbers = placed.numbers[backward_numbers(placed.outline.first_point)]
    return _drawn_loops(replace(backward, numbers=numbers, turned_round=True), watch)


def _drawn_curve(placed: GeneralPosition) -> DrawnMap:
    outline, given, numbers, visits = placed.outline, placed.given, placed.numbers, placed.visits
    edge, point = visits.edge, visits.point
    outer = outer_dart(outline.points if placed.exact is None else placed.exact, edge)
    is_directed = placed.turned_round is not None
    used, turning, turned_round = oriented(visits.partner, visits.ccw, outer, is_directed)
    if turned_round:
        outline = given = outline.reversed()
        numbers = numbers[backward_numbers(outline.first_point)]
        edge, point = len(outline) - 1 - edge[::-1], point[::-1]
    drawn = used._replace(code=used.code._replace(edge=edge))
    crossings = point[np.arange(len(point)) < used.code.partner]
    marked = with_marks(drawn, cusps_of_outline(outline, edge))
    settled = {"exact_signs": visits.exact_signs, "reversed": turned_round or bool(placed.turned_round)}
    more = {"given": given, "numbers": numbers, "crossings": crossings, "begun": placed.begun} | settled
    return DrawnMap(marked, walked_round(marked), (turning,), outline, more)


def _drawn_loops(placed: GeneralPosition, watch: Watch) -> DrawnMap:
    """Return the map of several loops as they are directed."""
    outline, visits = placed.outline, placed.visits
    found = nest(outline.points, outline.first_point, visits, watch, placed.exact)
    none = np.zeros(len(visits.partner), dtype=np.int64)
    code = Code(visits.partner, visits.ccw, found.first_visit, found.left, visits.edge, none)
    plain = Map(code, found.outside, found.bridges)
    inner = found.is_bounded.nonzero()[0]
    feet = found.feet.taken(np.concatenate([inner, len(found.bridges) + inner]))
    drawn = with_marks(plain, cusps_of_outline(outline, visits.edge), feet, found.bridges[inner] % 2 == 0)
    crossings = visits.point[np.arange(len(visits.point)) < visits.partner]
    settled = {"exact_signs": visits.exact_signs, "reversed": bool(placed.turned_round)}
    more = {"given": placed.given, "numbers": placed.numbers, "crossings": crossings, "begun": placed.begun} | settled
    turning = tuple(found.turning.tolist())
    return DrawnMap(drawn, walked_round(drawn), turning, outline, more)
