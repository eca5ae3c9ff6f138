"""Outlines that touch themselves, on the points as they are given: what is left of a surface over the moved outline.

An arrangement is that of the outline with its touching points moved apart, infinitely little. Given back where they
were, strands fall on each other, and the thin cells between them vanish. So the cells of a mesh are the faces of the
exact noding of the given points: each of them is a cell of the arrangement, or a part of one. Its *borders* are the
strands cut at the nodes; along each of them others may run, side by side in an order that the moved points tell. A
sheet on one side goes on in the one on the other side that it leads to through all the thin cells. Where it leads to
none, it ends; and a sheet over thin cells alone is gone.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from fractions import Fraction
from typing import cast

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.noding import Strands, exact_ranks, strands_of
from plyfold.arrays import Bools, Complexes, Floats, Fractions, Ints, Reals, freeze
from plyfold.errors import PrecisionError
from plyfold.mesh.begun import drawings_of, exact_visits
from plyfold.mesh.refine import NodedCurve, borders_passed, is_moved, unit_square
from plyfold.outline.curve import Outline
from plyfold.predicates import exact_crossings

__all__ = ["Strips", "as_numbers", "cells_left", "loop_left", "noded_strips", "strips_of", "turns_unseen"]

# Where on a part strands are compared, as shares of its length: at the first one where all are apart.
_SHARES = [0.4375, 0.59375, 0.296875, 0.71875, 0.515625]
# Where doubles show the moved outline, places of crossings are taken to be known to within so many roundings of
# coordinates. Where that is wrong, the cells along parts do not agree.
_ROUNDINGS = 64.0


@dataclass(frozen=True, eq=False)
class Strips:
    """The borders of a drawing on the given points, and which of them run side by side.

    Parameters
    ----------
    strands : Strands
        Border j runs along half-edge ``strands.half_edge[j]`` of the noding of the given points.
    moved_border : (s,) int
        The border of the arrangement that it is.
    order : (s,) int
        All borders, part after part of the noding, from the right to the left of the part's direction.
    place : (s,) int
        Where in this row each border is.
    cell : (faces,) int
        The cell of the arrangement that each face of the noding is, or is a part of.
    first_border : (loops + 1,) int
        Loop l has the borders from ``first_border[l]`` up to ``first_border[l + 1]``.
    """

    strands: Strands
    moved_border: Ints
    order: Ints
    place: Ints
    cell: Ints
    first_border: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def left_face(self) -> Ints:
        """The face on the left of each border, and of all that run beside it."""
        return np.asarray(self.strands.noding.face[self.strands.half_edge])

    @property
    def right_face(self) -> Ints:
        """The face on the right of each border, and of all that run beside it."""
        return np.asarray(self.strands.noding.face[self.strands.half_edge ^ 1])

    @property
    def backward(self) -> Bools:
        """Which borders run against the direction of their part."""
        return np.asarray(self.strands.half_edge % 2 == 1)

    @property
    def ends_of_parts(self) -> tuple[Ints, Ints]:
        """The places of the rightmost and of the leftmost border along the part of each."""
        part = self.strands.half_edge // 2
        along = part[self.order]
        return np.searchsorted(along, part, side="left"), np.searchsorted(along, part, side="right") - 1


def strips_of(arrangement: Arrangement) -> Strips:
    """Return the borders of a drawing on its given points.

    Raises
    ------
    PrecisionError
        If points have been moved so far that the cells are no longer those of the given points; it names the place.

    Notes
    -----
    The order is exact. O(n log n) for n borders, and rational numbers where strands run side by side.

    Examples
    --------
    >>> from plyfold import arrange
    >>> keyhole = arrange([(0, 0), (6, 0), (6, 6), (0, 6), (0, 2), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2), (0, 2)])
    >>> strips = strips_of(keyhole)
    >>> len(strips.strands.noding.ends), len(strips.order), len(strips.cell)
    (10, 11, 3)
    """
    strands = strands_of(_drawn(arrangement.given))
    drawings = drawings_of(arrangement)
    try:
        return _strips(next(drawings), strands)
    except PrecisionError:
        if (begun := next(drawings, None)) is None:
            raise
        return _strips(begun, strands)


def _strips(arrangement: Arrangement, strands: Strands) -> Strips:
    """Return the borders of a drawing on its given points, told by the points it is drawn with."""
    border, order = _borders_in_order(arrangement, strands)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    cell = _cells_of_faces(arrangement, strands, border, order)
    return Strips(strands, border, order, place, cell, strands.first[_drawn(arrangement.given).first_point])


def cells_left(arrangement: Arrangement) -> Bools:
    """Tell which cells of a drawing are there on its given points, (cells,); all where nothing touches.

    Examples
    --------
    >>> from plyfold import arrange
    >>> keyhole = arrange([(0, 0), (6, 0), (6, 6), (0, 6), (0, 2), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2), (0, 2)])
    >>> sum(cells_left(keyhole).tolist()), keyhole.n_cells
    (3, 4)
    """
    if not is_moved(arrangement):
        return np.ones(arrangement.n_cells, dtype=bool)
    there = np.zeros(arrangement.n_cells, dtype=bool)
    there[strips_of(arrangement).cell] = True
    return there


def loop_left(arrangement: Arrangement, places: Floats, faces: Ints, loop: Ints) -> tuple[Floats, Ints]:
    """Return the given points along a loop of a mesh's boundary, and the index of the cusp at each.

    The mesh lies over the given points; where the outline touches itself in a cusp, it may have less turns left.
    """
    given = _drawn(arrangement.given)
    corners = loop[np.isin(as_numbers(places[loop]), as_numbers(given.points))]
    is_cusp = np.isin(as_numbers(places[corners]), as_numbers(given.points[np.concatenate(given.cusps) > 0]))
    return places[corners], np.where(is_cusp, turns_unseen(places, faces)[corners], 0)


def turns_unseen(places: Floats, faces: Ints) -> Ints:
    """Return how many full turns the angle at each vertex of a mesh has more than one sees.

    Copies of a triangle of the drawing follow each other, and there are so many more of the same at the vertex.
    """
    corners = as_numbers(places)[faces]
    copied = np.append(0, np.cumsum((corners[1:] != corners[:-1]).any(axis=1)))
    key, times = np.unique(faces.ravel() * (copied[-1] + 1) + np.repeat(copied, 3), return_counts=True)
    turns = np.zeros(len(places), dtype=np.int64)
    np.maximum.at(turns, key // (copied[-1] + 1), times - 1)
    return turns


def as_numbers(points: Floats) -> Complexes:
    """Return points as complex numbers, which are compared faster than rows."""
    return np.ascontiguousarray(points).view(np.complex128).ravel()


def noded_strips(strips: Strips) -> NodedCurve:
    """Return the outline of a drawing on its given points, with its crossings."""
    strands, points = strips.strands, strips.strands.noding.points
    borders, faces = np.arange(len(strands.half_edge)), (strips.left_face, strips.right_face)
    return NodedCurve(points, strands.start, borders, strips.first_border, *unit_square(points), *faces, strips)


def _drawn(outline: Outline | None) -> Outline:
    return cast(Outline, outline)


# ---- which borders of the arrangement run along a part, and in which order -------------------------------------------


@dataclass(frozen=True, eq=False)
class _Places:
    """Places on the moved edges of an outline: where a line x = c or y = c meets them.

    Parameters
    ----------
    row : (m,) int
        The borders on the given points that the places are of.
    edge : (m,) int
        The edge of the outline.
    axis : (m,) int
        0 if x is given and 1 if y is; in this direction the edge is longer.
    along : (m,) float or object
        What is given: doubles, or fractions.
    """

    row: Ints
    edge: Ints
    axis: Ints
    along: Reals

    def of(self, which: Ints) -> _Places:
        return _Places(self.row[which], self.edge[which], self.axis[which], self.along[which])


def _borders_in_order(arrangement: Arrangement, strands: Strands) -> tuple[Ints, Ints]:
    """Return the arrangement's border at each half-edge of the outline, and all of them part after part, in order."""
    part, step = strands.half_edge // 2, _steps(strands, _drawn(arrangement.given))
    several = np.bincount(part)[part] > 1
    border, height = np.zeros((2, len(part)), dtype=np.int64)
    left = np.arange(len(part))
    for share in _shares(arrangement):
        places = _places(strands, _drawn(arrangement.given), step, left, share)
        border[left], near = _borders_at(arrangement, places)
        beside = np.flatnonzero(several[left])
        height[left[beside]] = _heights(arrangement, places.of(beside))
        near[beside] |= _equal_in_part(part[left[beside]], height[left[beside]])
        left = np.flatnonzero(np.isin(part, part[left[near]]))
        if not len(left):
            step = step[part]
            # Left of a part that runs up is where x is smaller.
            upward = (np.abs(step[:, 1]) > np.abs(step[:, 0])) & (step[:, 1] > 0)
            return border, np.lexsort((np.where(upward, -height, height), part))
    raise _moved_too_far(strands.noding.points[strands.noding.ends[part[left]]].reshape(-1, 2))


def _shares(arrangement: Arrangement) -> list[float] | list[Fraction]:
    """Return where on parts strands are compared: as fractions, on exact places, where doubles tell too little."""
    return list(map(Fraction, _SHARES)) if arrangement.is_begun else _SHARES


def _steps(strands: Strands, given: Outline) -> Floats:
    """Return how far x and y grow along an edge on which each part lies, from its lower end to its higher one."""
    part, backward = np.divmod(strands.half_edge, 2)
    _, row = np.unique(part, return_index=True)
    edge = _edge_of_rows(strands)[row]
    step = given.points[given.next_point[edge]] - given.points[edge]
    return np.asarray(np.where(backward[row, None] == 1, -step, step))


def _edge_of_rows(strands: Strands) -> Ints:
    """Return the edge of the outline that each border on the given points lies on."""
    return np.repeat(np.arange(len(strands.first) - 1), np.diff(strands.first))


def _places(strands: Strands, given: Outline, step: Floats, row: Ints, share: float | Fraction) -> _Places:
    """Return places on borders, where so much of their parts is behind them."""
    part = strands.half_edge[row] // 2
    axis = (np.abs(step[part, 1]) > np.abs(step[part, 0])).astype(np.int64)
    node, which = np.unique(strands.noding.ends[part], return_inverse=True)
    nodes = _exact_nodes(strands, given, node) if isinstance(share, Fraction) else strands.noding.points[node]
    start, end = nodes[which.reshape(-1, 2).T, axis]
    return _Places(row, _edge_of_rows(strands)[row], axis, start + share * (end - start))


def _exact_nodes(strands: Strands, given: Outline, node: Ints) -> Fractions:
    """Return where some nodes are, shape (m, 2)."""
    noding, part = strands.noding, strands.half_edge // 2
    places = np.array([list(map(Fraction, place)) for place in noding.points[node].tolist()], dtype=object)
    crosses = np.flatnonzero(~noding.is_vertex[node])
    # Of all the edges through a crossing, the first and the last by direction.
    at, line, edge = noding.ends[part].ravel(), np.repeat(noding.line[part], 2), np.repeat(_edge_of_rows(strands), 2)
    order = np.lexsort((line, at))
    found = [np.searchsorted(at[order], node[crosses], side="left")]
    found.append(np.searchsorted(at[order], node[crosses], side="right") - 1)
    one, other = edge[order[found]]
    ends = given.points[np.stack([one, given.next_point[one], other, given.next_point[other]])]
    for axis in (0, 1):
        places[crosses, axis] = exact_crossings(ends, axis)
    return places


def _borders_at(arrangement: Arrangement, places: _Places) -> tuple[Ints, Bools]:
    """Return the borders of the arrangement at places, and which of these are too near a visit to tell."""
    visits_before = _exact_visits_before if places.along.dtype == object else _visits_before
    passed, near = np.zeros_like(places.row), np.zeros(len(places.row), dtype=bool)
    for axis in (0, 1):
        here = np.flatnonzero(places.axis == axis)
        passed[here], near[here] = visits_before(arrangement, axis, places.edge[here], places.along[here])
    return borders_passed(arrangement, passed, places.edge), near


def _visits_before(arrangement: Arrangement, axis: int, edge: Ints, along: Reals) -> tuple[Ints, Bools]:
    """Return how many visits come before places on edges, on earlier edges too, and whether one may be there."""
    outline = _drawn(arrangement.outline)
    sign = np.sign((outline.points[outline.next_point] - outline.points)[:, axis])
    visits = arrangement.visit_edge
    on_edge = np.concatenate([visits, edge])
    value = sign[on_edge] * np.concatenate([arrangement.visit_point[:, axis], along])
    order = np.lexsort((value, on_edge))
    is_visit = order < len(visits)
    close = np.diff(value[order]) <= _ROUNDINGS * np.spacing(np.abs(outline.points).max())
    close &= (np.diff(on_edge[order]) == 0) & (is_visit[1:] != is_visit[:-1])
    passed, near = np.zeros(len(order), dtype=np.int64), np.zeros(len(order), dtype=bool)
    passed[order] = np.cumsum(is_visit)
    near[order[1:]] = close
    near[order[:-1]] |= close
    return passed[len(visits) :], near[len(visits) :]


def _exact_visits_before(arrangement: Arrangement, axis: int, edge: Ints, along: Reals) -> tuple[Ints, Bools]:
    """Return the same for places in fractions, and whether a visit is there. Exact."""
    outline = _drawn(arrangement.outline)
    sign = np.sign((outline.points[outline.next_point] - outline.points)[:, axis]).astype(np.int64).astype(object)
    visits = np.flatnonzero(np.isin(arrangement.visit_edge, edge))
    on_edge = arrangement.visit_edge[visits]
    value = (sign[on_edge] * exact_visits(arrangement, visits)[:, axis]).tolist()
    first, last = (np.searchsorted(on_edge, edge, side).tolist() for side in ("left", "right"))
    wanted = (sign[edge] * along).tolist()
    before = [bisect_left(value, *row) for row in zip(wanted, first, last, strict=True)]
    near = [at < end and value[at] == there for at, end, there in zip(before, last, wanted, strict=True)]
    passed = np.searchsorted(arrangement.visit_edge, edge) + np.array(before, dtype=np.int64) - first
    return passed, np.array(near, dtype=bool)


def _heights(arrangement: Arrangement, places: _Places) -> Ints:
    """Return ranks of y where x is given, or of x where y is. Exact."""
    outline = _drawn(arrangement.outline)
    edges = np.stack([places.edge, outline.next_point[places.edge]])
    a, b, p, q = _along_and_across(outline.points[edges], places.axis)
    along = places.along.astype(np.float64)
    value = p + (along - a) / (b - a) * (q - p)
    error = 16 * np.finfo(np.float64).eps * (np.abs(p) + np.abs(q) + np.abs(along)) + np.finfo(np.float64).tiny

    def exact(which: Ints) -> list[Fraction]:
        ends = _along_and_across(arrangement.exact_points[edges[:, which]], places.axis[which])
        numbers = zip(places.along[which].tolist(), *ends.tolist(), strict=True)
        return [_height(*map(Fraction, row)) for row in numbers]

    return exact_ranks(value - error, value + error, exact)


def _along_and_across(ends: Reals, axis: Ints) -> Reals:
    """Return the coordinates of both ends of edges along some axes, and then their other ones, shape (4, m)."""
    rows = np.arange(len(axis))
    return np.concatenate([ends[:, rows, axis], ends[:, rows, 1 - axis]])


def _height(along: Fraction, a: Fraction, b: Fraction, p: Fraction, q: Fraction) -> Fraction:
    return p + (along - a) / (b - a) * (q - p)


def _equal_in_part(part: Ints, height: Ints) -> Bools:
    """Tell which strands are as high as others of their part."""
    key = part * (height.max(initial=0) + 1) + height
    _, which, count = np.unique(key, return_inverse=True, return_counts=True)
    return np.asarray(count[which] > 1)


def _moved_too_far(places: Floats) -> PrecisionError:
    return PrecisionError(
        "points that touch could not be moved apart so little that nothing else changes",
        where=np.unique(places, axis=0)[:5],
        hint="move the strands there apart, or make them meet exactly",
    )


# ---- cells -----------------------------------------------------------------------------------------------------------


def _cells_of_faces(arrangement: Arrangement, strands: Strands, border: Ints, order: Ints) -> Ints:
    """Return the cell of the arrangement that each face is; the cells along all parts must agree with that."""
    noding, border = strands.noding, border[order]
    part, backward = np.divmod(strands.half_edge[order], 2)
    left, right = arrangement.cell_of_dart[2 * border + backward], arrangement.cell_of_dart[2 * border + 1 - backward]
    last = np.append(part[1:] != part[:-1], True)
    first = np.append(True, last[:-1])
    apart = np.flatnonzero(~last[:-1] & (left[:-1] != right[1:]))
    sides = np.concatenate([2 * part[last], 2 * part[first] + 1])
    face, found = noding.face[sides], np.concatenate([left[last], right[first]])
    cell = np.full(len(noding.winding), -1)
    cell[face] = found
    astray = (cell[face] != found) | (arrangement.winding[found] != noding.winding[face])
    wrong = np.concatenate([part[apart], sides[astray] // 2])
    if len(wrong):
        raise _moved_too_far(noding.points[noding.ends[wrong]].reshape(-1, 2))
    return cell
