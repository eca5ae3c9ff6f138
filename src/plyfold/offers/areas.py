"""The areas of cells, as doubles with bounds and as fractions: what a repair changes is compared exactly.

Bounds decide nearly always. Where two sums of areas are equal, or too near for doubles, fractions do.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints, Reals
from plyfold.mesh.refine import chain_of, drawn_outline
from plyfold.predicates import crossing_bounds, exact_crossings, whole_numbers
from plyfold.ragged import next_in_rows

__all__ = ["CellAreas", "Measure", "areas_of"]

_ROUNDING = float(np.finfo(np.float64).eps)
_UNDERFLOW = float(np.finfo(np.float64).tiny)
# Points that have begun to move are by less than this part of a rounding off.
_BEGUN = 2.0**-60


@dataclass(frozen=True, eq=False)
class CellAreas:
    """The area of each cell, rounded and in a unit of its own, with a bound on its error; the unbounded one has none.

    Parameters
    ----------
    drawn : Arrangement
        With a drawing.
    rounded, error : (cells,) float
    moment : (borders,) float
        The area between each border and the middle of the drawing, rounded; negative if it is passed clockwise.
    places : (points + crossings, 2) float
        Where they are, in the unit whose square is that of the areas.
    unit : int
        The power of two by which coordinates are taken.
    grain : float
        How far the greatest coordinate of a crossing is from the next double, in this unit.
    """

    drawn: Arrangement
    rounded: list[float]
    error: list[float]
    moment: Floats
    places: Floats
    unit: int
    grain: float
    _exact: dict[int, Fraction] = field(default_factory=dict)
    _moments: dict[int, Fraction] = field(default_factory=dict)
    _crossings: dict[int, tuple[Fraction, Fraction]] = field(default_factory=dict)

    def exact(self, cell: int) -> Fraction:
        """Return twice the area of a bounded cell, exactly."""
        if cell not in self._exact:
            darts = self.drawn.cell_darts[self.drawn.cell_start[cell] : self.drawn.cell_start[cell + 1]].tolist()
            self._exact[cell] = sum(
                (-self._moment(dart // 2) if dart % 2 else self._moment(dart // 2) for dart in darts), Fraction(0)
            )
        return self._exact[cell]

    def _moment(self, border: int) -> Fraction:
        if border not in self._moments:
            self._moments[border] = self._crosses_along(self.chain(border))
        return self._moments[border]

    def chain(self, border: int) -> Ints:
        """Return the points along a border, from crossing to crossing, numbered as in :meth:`place`."""
        points, following, border_of = self._pieces
        low, high = np.searchsorted(border_of, [border, border + 1])
        return np.append(points[low:high], following[low:high][-1:])

    def swept(self, darts: Iterable[int]) -> float:
        """Return the area that a ray from the start of a way to places along it sweeps over, whichever way it turns."""
        chain = np.concatenate([self.chain(dart // 2)[:: -1 if dart % 2 else 1] for dart in darts])
        (x, y), (u, v) = ((self.places[each] - self.places[chain[0]]).T for each in (chain[:-1], chain[1:]))
        return float(np.abs(x * v - y * u).sum()) / 2

    def _crosses_along(self, chain: Ints) -> Fraction:
        """Return the sum of the cross products of points and the next ones; whole numbers do but beside crossings."""
        vertices = self.drawn.exact_points
        inside = chain[chain < len(vertices)]
        whole, unit = whole_numbers(vertices[inside])
        total = ((whole[:-1, 0] * whole[1:, 1]).sum() - (whole[:-1, 1] * whole[1:, 0]).sum()) * unit**2
        for start, end in zip(chain[:-1].tolist(), chain[1:].tolist(), strict=True):
            if max(start, end) >= len(vertices):
                (x, y), (u, v) = self.place(start), self.place(end)
                total += x * v - y * u
        return Fraction(total)

    def place(self, number: int) -> tuple[Fraction, Fraction]:
        """Return a point of the outline, or a crossing, which are numbered after the points, exactly."""
        vertices = self.drawn.exact_points
        if number < len(vertices):
            x, y = vertices[number].tolist()
            return Fraction(x), Fraction(y)
        if number not in self._crossings:
            ends = self._edges_that_cross[:, [number - len(vertices)]]
            self._crossings[number] = exact_crossings(ends, 0)[0], exact_crossings(ends, 1)[0]
        return self._crossings[number]

    @cached_property
    def _edges_that_cross(self) -> Reals:
        return _edges_that_cross(self.drawn, self.drawn.exact_points)

    @cached_property
    def _pieces(self) -> tuple[Ints, Ints, Ints]:
        """Start and end of the pieces of edges between crossings, and their borders, in the order of these."""
        points, border, first = chain_of(self.drawn)
        order = np.argsort(border, kind="stable")
        return points[order], points[next_in_rows(first)][order], border[order]


@dataclass(frozen=True, eq=False)
class Measure:
    """A sum of areas, each taken some number of times.

    Parameters
    ----------
    areas : CellAreas
    times : mapping from cell to int
    rounded, error : float
        The sum, and a bound on its error.
    """

    areas: CellAreas
    times: Mapping[int, int]
    rounded: float
    error: float

    @classmethod
    def of(cls, areas: CellAreas, times: Mapping[int, int]) -> Measure:
        """Return the sum of the areas of some cells."""
        rounded, error = areas.rounded, areas.error
        total = bound = size = 0.0
        for cell, count in times.items():
            part = count * rounded[cell]
            total += part
            size += abs(part)
            bound += abs(count) * error[cell]
        return cls(areas, times, total, bound + len(times) * _ROUNDING * size)

    @property
    def least(self) -> float:
        """It is not less than this."""
        return self.rounded - self.error

    @property
    def most(self) -> float:
        """It is not more than this."""
        return self.rounded + self.error

    @cached_property
    def exact(self) -> Fraction:
        """Twice the sum."""
        return sum((count * self.areas.exact(cell) for cell, count in self.times.items()), Fraction(0))


def _edges_that_cross(drawn: Arrangement, points: Reals) -> Reals:
    """Return the ends of the two edges at each crossing, shape (4, k, 2), given the points of the outline."""
    edge, other = (drawn.visit_edge[visits] for visits in (drawn.first_visits, drawn.partner[drawn.first_visits]))
    following = drawn_outline(drawn).next_point
    return points[np.stack([edge, following[edge], other, following[other]])]


def areas_of(drawn: Arrangement) -> CellAreas:
    """Return the areas of all cells of a drawing.

    Notes
    -----
    O(n + k). Each cell is measured from a place of its own, so that small ones far away come out right.
    """
    places, error, unit = _places(drawn)
    points, border, first = chain_of(drawn)
    start, end = points, points[next_in_rows(first)]
    area, bound = np.zeros((2, drawn.n_cells))
    count, sides = np.zeros(drawn.n_cells), ((drawn.left_cell[border], 1), (drawn.right_cell[border], -1))
    centre = np.zeros((drawn.n_cells, 2))
    for cells, _ in sides:
        centre[cells] = places[points]
    for cells, sign in sides:
        cross, wrong = _crosses(places, error, start, end, centre[cells])
        area += sign * np.bincount(cells, cross, drawn.n_cells)
        bound += np.bincount(cells, wrong, drawn.n_cells)
        count += np.bincount(cells, minlength=drawn.n_cells)
    # Adding up loses less than an eighth of what each product may be wrong, times their number.
    bound *= 2 + count / 4
    middle = places.min(axis=0) / 2 + places.max(axis=0) / 2
    moment = np.bincount(border, _crosses(places, error, start, end, middle)[0], drawn.n_borders)
    grain = float(np.ldexp(np.spacing(np.abs(drawn.crossings).max(initial=0.0)), unit))
    return CellAreas(drawn, (area / 2).tolist(), (bound / 2).tolist(), moment / 2, places, unit, grain)


def _places(drawn: Arrangement) -> tuple[Floats, Floats, int]:
    """Return all points and crossings, how far these may be from where they are said to be, and the power of two.

    The unit is a power of two in which the drawing has size one: so areas of the smallest drawings are doubles, too.
    """
    outline = drawn_outline(drawn)
    places = np.concatenate([outline.points, drawn.crossings])
    error = np.full(len(places), _BEGUN * np.spacing(np.abs(places).max()) if drawn.is_begun else 0.0)
    if drawn.n_crossings:
        low, high = crossing_bounds(*_edges_that_cross(drawn, outline.points))
        off = np.maximum(high - drawn.crossings, drawn.crossings - low)
        error[len(outline) :] = off.max(axis=1) + _UNDERFLOW
    unit = -int(np.frexp(np.ptp(outline.points, axis=0).max())[1])
    return np.ldexp(places, unit), np.ldexp(error, unit), unit


def _crosses(places: Floats, error: Floats, start: Ints, end: Ints, centre: Floats) -> tuple[Floats, Floats]:
    """Return the cross products of the ways from a centre to places that may be off, and bounds on their errors."""
    (x, y), (u, v) = (places[start] - centre).T, (places[end] - centre).T
    left, right = x * v, y * u
    off = error[start] * (np.abs(u) + np.abs(v) + error[end]) + error[end] * (np.abs(x) + np.abs(y))
    return left - right, 8 * _ROUNDING * (np.abs(left) + np.abs(right)) + off + _UNDERFLOW
