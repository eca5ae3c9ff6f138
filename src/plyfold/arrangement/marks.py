"""Marks on the loops of a planar map: cusps, and the feet of bridges. They cut the loops as crossings do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.maps import Code, Map
from plyfold.arrangement.planar_map import borders_at_visits
from plyfold.arrays import Bools, Ints
from plyfold.errors import GaussCodeError
from plyfold.outline.curve import Outline
from plyfold.ragged import starts_of

__all__ = ["AT_VERTEX", "Mark", "cusps_of_outline", "cusps_on_borders", "with_marks"]


# Where on an edge the vertex is that it starts from.
AT_VERTEX = -inf
# By what marks are sorted; no two have the same.
_PLACE = itemgetter(0, 1, 2)
_NO_FEET = np.empty((0, 2), dtype=bool)


class Mark(NamedTuple):
    """A place on a loop.

    Parameters
    ----------
    edge : int
        Counted over all loops; of a vertex, the edge that starts there.
    along : float
        Any number that grows along the edge.
    tie : int
        What comes first of several marks at one place.
    at : int
        The visit before which it comes, without other marks; past the loop's last one for those behind it.
    loop : int
    point : (float, float)
        Rounded.
    cusp_index : int
        0 for the foot of a bridge.
    """

    edge: int
    along: float
    tie: int
    at: int
    loop: int
    point: tuple[float, float]
    cusp_index: int = 0


def cusps_of_outline(outline: Outline, visit_edge: Ints) -> list[Mark]:
    """Return the cusps of an outline as marks: each comes before all visits on the edge that starts there."""
    if not outline.has_cusps:
        return []
    index = np.concatenate(outline.cusps)
    vertex = np.flatnonzero(index)
    at = np.searchsorted(visit_edge, vertex)
    loop = np.searchsorted(outline.first_point, vertex, side="right") - 1
    columns = (vertex, at, loop, outline.points[vertex], index[vertex])
    return [
        Mark(edge, AT_VERTEX, 0, at, loop, (x, y), turns)
        for edge, at, loop, (x, y), turns in zip(*(column.tolist() for column in columns), strict=True)
    ]


def cusps_on_borders(code: Code, cusps: Mapping[int, int], turned_round: bool) -> list[Mark]:
    """Return cusps on borders of a code of one loop as marks, borders numbered as before it was turned round."""
    n = len(code.left)
    for border, turns in cusps.items():
        if not 0 <= border < n or turns < 1:
            raise GaussCodeError(
                f"there is no border {border} for a cusp of index {turns}: {n} borders, indices from 1"
            )
    borders = {(-2 - border) % n if turned_round else border: turns for border, turns in cusps.items()}
    start = 1 if len(code.partner) else 0
    return [Mark(border, AT_VERTEX, 0, border + start, 0, (0.0, 0.0), turns) for border, turns in borders.items()]


def with_marks(plain: Map, marks: Sequence[Mark], feet: Sequence[Mark] = (), is_left: Bools = _NO_FEET) -> Map:
    """Return the map with marks inserted, which are visits that are their own partners.

    ``feet`` are those of bridges, two for each, and ``is_left`` tells on which side of the loop the bridge is.
    """
    if not marks and not feet:
        return plain
    everything = sorted([*marks, *feet], key=_PLACE)
    inserted = _Inserted.of(plain.code, everything)
    code = _with_inserted(plain.code, inserted, everything)
    place = dict(zip(map(_PLACE, everything), inserted.visit.tolist(), strict=True)) if feet else {}
    before, after = borders_at_visits(code.first_visit)
    foot = np.array([place[_PLACE(mark)] for mark in feet], dtype=np.int64).reshape(-1, 2)
    return Map(
        code,
        outside=_moved(plain.code, inserted, plain.outside),
        same_cell=_moved(plain.code, inserted, plain.same_cell),
        bridges=np.where(is_left, 2 * after[foot], 2 * before[foot] + 1),
        places=np.array([mark.point for mark in everything]),
    )


class _Inserted(NamedTuple):
    """Where marks are inserted, their loops and new numbers; the new number of each visit, and of each loop's first."""

    at: Ints
    loop: Ints
    visit: Ints
    moved: Ints
    first_visit: Ints

    @classmethod
    def of(cls, code: Code, marks: Sequence[Mark]) -> _Inserted:
        at, loop = np.array([mark.at for mark in marks]), np.array([mark.loop for mark in marks])
        visit = np.arange(len(code.partner))
        count = np.bincount(loop, minlength=len(code.first_visit) - 1)
        return cls(
            at=at,
            loop=loop,
            visit=at + np.arange(len(at)),
            moved=visit + np.searchsorted(at, visit, side="right"),
            first_visit=code.first_visit + np.concatenate([[0], np.cumsum(count)]),
        )


def _with_inserted(code: Code, inserted: _Inserted, marks: Sequence[Mark]) -> Code:
    old, new = inserted.moved, inserted.visit
    partner, ccw = np.arange(len(old) + len(new)), np.zeros(len(old) + len(new), dtype=bool)
    edge, index = np.zeros((2, len(partner)), dtype=np.int64)
    partner[old], ccw[old] = old[code.partner], code.ccw
    if len(code.edge) == len(old):
        edge[old] = code.edge
    edge[new], index[new] = [mark.edge for mark in marks], [mark.cusp_index for mark in marks]
    left = np.empty(int(np.maximum(np.diff(inserted.first_visit), 1).sum()), dtype=np.int64)
    left[_moved(code, inserted, np.arange(0, 2 * len(code.left), 2)) // 2] = code.left
    left[borders_at_visits(inserted.first_visit)[1][new]] = code.left[_border_cut(code, inserted)]
    return Code(partner, ccw, inserted.first_visit, left, edge, index)


def _moved(code: Code, inserted: _Inserted, darts: Ints) -> Ints:
    """Return the darts of the first pieces of borders, where marks have cut them."""
    border, backward = np.divmod(darts, 2)
    if not darts.size:
        return darts
    visits, new_visits = (first[1:] - first[:-1] for first in (code.first_visit, inserted.first_visit))
    base, new_base = starts_of(np.maximum(visits, 1)), starts_of(np.maximum(new_visits, 1))
    loop = np.searchsorted(base, border, side="right") - 1
    piece = np.zeros_like(border)
    crossed = visits[loop] > 0
    start = (code.first_visit[loop] + border - base[loop])[crossed]
    piece[crossed] = inserted.moved[start] - inserted.first_visit[loop[crossed]]
    return np.asarray(2 * (new_base[loop] + piece) + backward)


def _border_cut(code: Code, inserted: _Inserted) -> Ints:
    """Return the border that each mark lies on."""
    first, visits = code.first_visit[inserted.loop], np.diff(code.first_visit)
    base = starts_of(np.maximum(visits, 1))[inserted.loop]
    return np.asarray(base + (inserted.at - first - 1) % np.maximum(visits[inserted.loop], 1))
