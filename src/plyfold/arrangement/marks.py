"""Marks on the loops of a planar map: cusps, and the feet of bridges. They cut the loops as crossings do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from math import inf

import numpy as np

from plyfold.arrangement.maps import Code, Map
from plyfold.arrangement.planar_map import borders_at_visits, number_of_borders
from plyfold.arrays import Bools, Floats, Ints
from plyfold.core.buffers import all_flat
from plyfold.core.marks import Marked, insert_marks
from plyfold.errors import GaussCodeError
from plyfold.outline.curve import Outline

__all__ = ["AT_VERTEX", "Marks", "cusps_of_outline", "cusps_on_borders", "with_marks"]


# Where on an edge the vertex is that it starts from.
AT_VERTEX = -inf


@dataclass(frozen=True, eq=False)
class Marks:
    """Places on loops.

    Parameters
    ----------
    edge : (m,) int
        Counted over all loops; of a vertex, the edge that starts there.
    along : (m,) float
        Any number that grows along the edge.
    tie : (m,) int
        What comes first of several marks at one place.
    at : (m,) int
        The visit before which it comes, without other marks; past the loop's last one for those behind it.
    loop : (m,) int
    point : (m, 2) float
        Rounded.
    cusp_index : (m,) int
        0 for the foot of a bridge.
    """

    edge: Ints
    along: Floats
    tie: Ints
    at: Ints
    loop: Ints
    point: Floats
    cusp_index: Ints

    def __len__(self) -> int:
        return len(self.edge)

    @property
    def order(self) -> Ints:
        """The places of the marks in order along the loops."""
        return np.lexsort((self.tie, self.along, self.edge))

    def followed_by(self, other: Marks) -> Marks:
        """Return these marks and others."""
        return Marks(*(np.concatenate([mine, its]) for mine, its in zip(self._columns, other._columns, strict=True)))

    def taken(self, places: Ints) -> Marks:
        """Return some of the marks."""
        return Marks(*(column[places] for column in self._columns))

    @property
    def _columns(self) -> list[Ints | Floats]:
        return [getattr(self, column.name) for column in fields(self)]


def cusps_of_outline(outline: Outline, visit_edge: Ints) -> Marks:
    """Return the cusps of an outline as marks: each comes before all visits on the edge that starts there."""
    index = outline.cusps[0] if outline.n_loops == 1 else np.concatenate(outline.cusps)
    vertex = index.nonzero()[0]
    at, loop = visit_edge.searchsorted(vertex), outline.first_point[1:-1].searchsorted(vertex, side="right")
    return Marks(vertex, *_at_vertices(len(vertex)), at, loop, outline.points[vertex], index[vertex])


def _at_vertices(count: int) -> tuple[Floats, Ints]:
    return np.full(count, AT_VERTEX), np.zeros(count, dtype=np.int64)


def cusps_on_borders(code: Code, cusps: Mapping[int, int], turned_round: bool) -> Marks:
    """Return cusps on borders of a code of one loop as marks, borders numbered as before it was turned round."""
    n = len(code.left)
    for border, turns in cusps.items():
        if not 0 <= border < n or turns < 1:
            raise GaussCodeError(
                f"there is no border {border} for a cusp of index {turns}: {n} borders, indices from 1"
            )
    borders = np.array([(-2 - border) % n if turned_round else border for border in cusps], dtype=np.int64)
    at, none = borders + (1 if len(code.partner) else 0), np.zeros(len(cusps), dtype=np.int64)
    index = np.array([*cusps.values()], dtype=np.int64)
    return Marks(borders, *_at_vertices(len(cusps)), at, none, np.zeros((len(cusps), 2)), index)


def with_marks(plain: Map, marks: Marks, feet: Marks | None = None, is_left: Bools | None = None) -> Map:
    """Return the map with marks inserted, which are visits that are their own partners.

    ``feet`` are those of bridges, first those where they start, and then those where they end; and ``is_left`` tells
    for each bridge and either end on which side of the loop the bridge is.
    """
    if not (len(marks) or feet):
        return plain
    everything = marks.followed_by(feet) if feet and len(marks) else feet or marks
    order = everything.order
    everything = everything.taken(order)
    inserted = _Inserted.into(plain.code, everything)
    marked = plain._replace(
        code=inserted.code,
        outside=inserted.moved(plain.outside),
        same_cell=inserted.moved(plain.same_cell),
        places=everything.point,
    )
    if not feet:
        return marked
    visit = np.empty_like(order)
    visit[order] = inserted.visit
    before, after = borders_at_visits(inserted.code.first_visit)
    foot = visit[len(marks) :].reshape(2, -1).T
    return marked._replace(bridges=np.where(is_left, 2 * after[foot], 2 * before[foot] + 1))


@dataclass(frozen=True, eq=False)
class _Inserted:
    """A code with marks inserted, the visit that each mark is, and the new number of each border's first piece."""

    code: Code
    visit: Ints
    border: Ints

    @classmethod
    def into(cls, code: Code, marks: Marks) -> _Inserted:
        old, new = len(code.partner), len(marks)
        numbers = np.empty(2 * (old + new), dtype=np.int64)
        partner, moved, visit = numbers[: old + new], numbers[old + new : 2 * old + new], numbers[2 * old + new :]
        ccw, first_visit = np.empty(old + new, dtype=bool), np.empty_like(code.first_visit)
        left, border = np.empty(len(code.left) + new, dtype=np.int64), np.empty_like(code.left)
        marked = Marked(*all_flat(partner, ccw.view(np.uint8), first_visit, left, moved, visit, border))
        plain = all_flat(code.partner, code.ccw.view(np.uint8), code.first_visit, code.left)
        borders = insert_marks(*plain, *all_flat(marks.loop, marks.at), marked)
        edge, index = np.zeros((2, old + new), dtype=np.int64)
        if len(code.edge) == old:
            edge[moved] = code.edge
        edge[visit], index[visit] = marks.edge, marks.cusp_index
        return cls(Code(partner, ccw, first_visit, left[:borders], edge, index), visit, border)

    def moved(self, darts: Ints) -> Ints:
        """Return the darts of the first pieces of borders, where marks have cut them."""
        return 2 * self.border[darts // 2] + darts % 2
