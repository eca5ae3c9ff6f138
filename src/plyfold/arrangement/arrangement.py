"""The arrangement of closed curves: their crossings, borders and cells (§2.1 of the paper)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal, NamedTuple, cast

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.general_position import in_general_position
from plyfold.arrangement.leftmost import leftmost_crossing
from plyfold.arrangement.nesting import nest
from plyfold.arrangement.planar_map import (
    borders_at_visits,
    cell_boundaries,
    cell_windings,
    checked_code,
    joined_cells,
    left_windings,
    next_darts,
    reversed_code,
    whitney_turning_number,
)
from plyfold.arrangement.polylines import inner_points, polygon_turning_number, total_winding
from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GaussCodeError, InputError, PlyfoldError
from plyfold.graphs import components
from plyfold.outline.curve import Curve
from plyfold.outline.given import Coded, CurveLike, OutlineLike, are_several, as_curve, as_curves
from plyfold.predicates import cross_sign

__all__ = ["Arrangement", "CurveLike", "arrange", "require_one_loop", "watched_arrangement"]


@dataclass(frozen=True, eq=False)
class Arrangement:
    """The planar map of one closed curve or of several, with the surface that they may bound on their left.

    Made by :func:`arrange` from a drawing, or by :meth:`from_gauss` from a signed Gauss code.

    Parameters
    ----------
    partner : (2k,) int
        Visits are numbered in order along the curve, one loop after the other; visit p meets visit ``partner[p]`` at
        the same crossing.
    ccw : (2k,) bool
        True where the other strand crosses from right to left.
    outer : int
        A dart of the unbounded cell. Dart 2i is border i forward, 2i + 1 backward. The cell meant is on the dart's
        left.
    first_visit : (loops + 1,) int
        The number of each loop's first visit; last, the number of visits.
    next_dart, cell_of_dart : (darts,) int
        The dart that follows around the cell on the left, and that cell. Cell 0 is the unbounded one.
    cell_start : (cells + 1,) int
        Where the boundary of each cell starts in ``cell_darts``.
    cell_darts : (darts,) int
        The boundary of cell c is ``cell_darts[cell_start[c]:cell_start[c + 1]]``: its darts in order, walked with the
        cell on the left, the lowest dart first. A cell in which other loops lie has several boundary cycles, one after
        the other by their lowest darts; each ends where ``next_dart`` leads back to its first dart, see
        :attr:`cycle_start`.
    winding : (cells,) int
        Winding number of each cell, all loops added up.
    turning_numbers : tuple of int
        Total rotation of each loop's tangent in full turns.
    crossing_of_visit : (2k,) int
        Crossings are numbered in the order in which the curve first visits them.
    bridges : (b, 2) int
        Where loops do not hang together: two darts, one of a group of loops at its leftmost vertex and the one straight
        to the left of it, with the same cell on their left. Borders and bridges together connect the boundary of every
        bounded cell. A group with nothing on its left has no bridge.
    curves : tuple of Curve
        The loops as they were used, oriented and in general position; empty if only the code is known.
    crossings : (k, 2) float
        Positions, rounded to double precision; (0, 2) if only the code is known.
    visit_edge : (2k,) int
        Edge of its loop on which each visit lies; empty if only the code is known.
    reversed : bool
        True if the input was turned round: all winding numbers were 0 or negative, or a single curve with winding
        numbers of both signs had a negative turning number.
    exact_signs : int
        How many signs and places along edges had to be settled with fractions; 0 if only the code is known.

    Examples
    --------
    >>> from plyfold import arrange
    >>> eight = arrange([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> eight.n_crossings, eight.turning_number, sorted(eight.winding.tolist())
    (1, 0, [-1, 0, 1])
    >>> annulus = arrange([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])
    >>> annulus.winding.tolist(), annulus.turning_numbers, annulus.bridges.tolist()
    ([0, 1, 0], (1, -1), [[2, 0]])
    """

    partner: Ints
    ccw: Bools
    outer: int
    first_visit: Ints
    next_dart: Ints
    cell_of_dart: Ints
    cell_start: Ints
    cell_darts: Ints
    winding: Ints
    turning_numbers: tuple[int, ...]
    crossing_of_visit: Ints
    bridges: Ints = field(default_factory=lambda: np.empty((0, 2), dtype=np.int64))
    curves: tuple[Curve, ...] = ()
    crossings: Floats = field(default_factory=lambda: np.empty((0, 2)))
    visit_edge: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    reversed: bool = False
    exact_signs: int = 0

    def __post_init__(self) -> None:
        freeze(self)

    @classmethod
    def from_gauss(cls, partner: npt.ArrayLike, ccw: npt.ArrayLike, outer: int) -> Arrangement:
        """Build the arrangement of a signed Gauss code.

        Parameters
        ----------
        partner : array_like of int, shape (2k,)
            The other visit to the same crossing.
        ccw : array_like of bool, shape (2k,)
            True where the other strand crosses from right to left.
        outer : int
            A dart whose left cell is to be the unbounded one.

        Returns
        -------
        Arrangement
            Without geometry; turned round as a drawing would be.

        Raises
        ------
        GaussCodeError
            If no closed plane curve has this code.

        Examples
        --------
        >>> limacon = Arrangement.from_gauss([1, 0], [True, False], outer=1)
        >>> limacon.turning_number, limacon.winding.tolist()
        (2, [0, 1, 2])
        """
        return cls._of_code(_oriented(*checked_code(partner, ccw, outer)))

    @classmethod
    def _of_code(cls, code: _OrientedCode, **more: Any) -> Arrangement:
        """Return the arrangement of one curve."""
        visits, following = len(code.partner), next_darts(code.partner, code.ccw)
        boundaries = cell_boundaries(following, code.outer)
        cells = len(boundaries[0]) - 1
        if cells != visits // 2 + 2:
            raise GaussCodeError(
                f"the code draws {cells} cells, and a plane curve with {visits // 2} crossings has {visits // 2 + 2}",
                hint="check partner and ccw: this code belongs to a curve on a surface with handles",
            )
        cell_of_dart = _cell_of_each_dart(*boundaries)
        winding = np.empty(cells, dtype=np.int64)
        winding[cell_of_dart[0::2]] = code.left
        winding[cell_of_dart[1::2]] = code.left - 1
        return cls(
            partner=code.partner,
            ccw=code.ccw,
            outer=code.outer,
            first_visit=np.array([0, visits]),
            next_dart=following,
            cell_of_dart=cell_of_dart,
            cell_start=boundaries[0],
            cell_darts=boundaries[1],
            winding=winding,
            turning_numbers=(code.turning_number,),
            crossing_of_visit=_number_crossings(code.partner),
            reversed=code.reversed,
            **more,
        )

    @classmethod
    def _of_loops(cls, curves: tuple[Curve, ...], watch: Watch) -> Arrangement:
        """Return the arrangement of several curves as they are directed."""
        found = nest(curves, watch)
        visits, outer = found.visits, found.outside[0]
        following = next_darts(visits.partner, visits.ccw, found.first_visit)
        same_cell = np.array([*found.bridges.tolist(), *((outer, other) for other in found.outside)], dtype=np.int64)
        boundaries = joined_cells(*cell_boundaries(following, outer), same_cell)
        cell_of_dart = _cell_of_each_dart(*boundaries)
        return cls(
            partner=visits.partner,
            ccw=visits.ccw,
            outer=outer,
            first_visit=found.first_visit,
            next_dart=following,
            cell_of_dart=cell_of_dart,
            cell_start=boundaries[0],
            cell_darts=boundaries[1],
            winding=cell_windings(cell_of_dart),
            turning_numbers=tuple(polygon_turning_number(curve.points) for curve in curves),
            crossing_of_visit=_number_crossings(visits.partner),
            bridges=found.bridges,
            curves=curves,
            crossings=visits.point[np.arange(len(visits.point)) < visits.partner],
            visit_edge=visits.edge,
            exact_signs=visits.exact_signs,
        )

    def gauss_code(self) -> tuple[list[int], list[bool], int]:
        """Return ``(partner, ccw, outer)`` of one curve as plain lists, ready for :meth:`from_gauss`."""
        require_one_loop(self, "a Gauss code")
        return self.partner.tolist(), self.ccw.tolist(), self.outer

    @property
    def curve(self) -> Curve | None:
        """The curve as it was used, oriented and in general position; None if only the code is known.

        Raises :class:`~plyfold.errors.InputError` if there are several: :attr:`curves` has them all.
        """
        require_one_loop(self)
        return self.curves[0] if self.curves else None

    @property
    def n_loops(self) -> int:
        """Number of closed curves."""
        return len(self.first_visit) - 1

    @property
    def n_crossings(self) -> int:
        """Number of crossings, k."""
        return len(self.partner) // 2

    @property
    def n_borders(self) -> int:
        """Number of borders: 2k, and 1 for each loop that crosses neither itself nor another."""
        return len(self.cell_of_dart) // 2

    @property
    def n_cells(self) -> int:
        """Number of cells, the unbounded one included: k + 1 and 1 for each group of loops that hang together."""
        return len(self.winding)

    @property
    def turning_number(self) -> int:
        """Total rotation of the tangents in full turns, all loops added up."""
        return sum(self.turning_numbers)

    @cached_property
    def border_before(self) -> Ints:
        """The border that ends at each visit, shape (2k,)."""
        return borders_at_visits(self.first_visit)[0]

    @cached_property
    def border_after(self) -> Ints:
        """The border that starts at each visit, shape (2k,). For one curve it has the visit's number."""
        return borders_at_visits(self.first_visit)[1]

    @cached_property
    def start_visit(self) -> Ints:
        """The visit at which each border starts, shape (borders,); −1 for a loop without crossings."""
        visit = np.full(self.n_borders, -1)
        visit[self.border_after] = np.arange(len(self.partner))
        return visit

    @cached_property
    def next_border(self) -> Ints:
        """The border that follows each along its loop, shape (borders,)."""
        following = np.arange(self.n_borders)
        following[self.border_before] = self.border_after
        return following

    @cached_property
    def loop_of_border(self) -> Ints:
        """The loop that each border belongs to, shape (borders,)."""
        return np.repeat(np.arange(self.n_loops), np.maximum(np.diff(self.first_visit), 1))

    @cached_property
    def group_of_loop(self) -> Ints:
        """A number for each loop, shape (loops,): the same for loops that hang together by crossings."""
        loop = self.loop_of_border[self.border_after]
        return components(self.n_loops, loop, loop[self.partner])

    @cached_property
    def cycle_start(self) -> Ints:
        """Where the boundary cycles of cells start in ``cell_darts``, and last its length; some cells have several."""
        darts = self.cell_darts
        begins = np.append(True, self.next_dart[darts[:-1]] != darts[1:])
        begins[self.cell_start[:-1]] = True
        return np.append(np.flatnonzero(begins), len(darts))

    @property
    def left_cell(self) -> Ints:
        """The cell on the left of each border, shape (borders,): the higher of its two cells."""
        return self.cell_of_dart[0::2]

    @property
    def right_cell(self) -> Ints:
        """The cell on the right of each border, shape (borders,): the lower of its two cells."""
        return self.cell_of_dart[1::2]

    @property
    def n_cycles(self) -> Ints:
        """Number of boundary cycles of each cell, shape (cells,)."""
        if self.n_loops == 1:
            return np.ones(self.n_cells, dtype=np.int64)
        return np.bincount(self.cell_of_dart[self.cell_darts[self.cycle_start[:-1]]])

    @cached_property
    def cells(self) -> tuple[tuple[int, ...], ...]:
        """The boundary of each cell: its darts in order, walked with the cell on the left, cycle after cycle."""
        darts = self.cell_darts.tolist()
        return tuple(tuple(darts[low:high]) for low, high in pairwise(self.cell_start.tolist()))

    @cached_property
    def base_visit(self) -> int:
        """The visit that the first of several answers is counted from, so that it belongs to the drawing.

        At the leftmost crossing, the lowest one of several, it is that of the strand which the other crosses from
        right to left. Exact: points added on edges do not change it. 0 for a curve without crossings and where only
        the code is known.

        Examples
        --------
        >>> points = [(0, 0), (4, 0), (4, 3), (1, -1)]
        >>> [arrange(points[i:] + points[:i]).base_visit for i in range(4)]
        [1, 0, 0, 1]
        """
        if self.n_loops > 1 or self.curve is None or not self.n_crossings:
            return 0
        visits = np.flatnonzero(self.ccw)
        edge, other = self.visit_edge[visits], self.visit_edge[self.partner[visits]]
        return int(visits[leftmost_crossing(self.curve.points, edge, other)])

    def border_points(self, border: int) -> Floats:
        """Return the polyline of a border, shape (m, 2), from crossing to crossing with both ends.

        The border of a loop without crossings is all its points, the first one not repeated. Raises
        :class:`~plyfold.errors.PlyfoldError` if only the code is known.
        """
        points: Floats = self._drawn()[self.loop_of_border[border]].points
        visits = self.start_visit[[border, self.next_border[border]]]
        if visits[0] < 0:
            return points
        n = len(points)
        start, end = self.visit_edge[visits]
        inner = points[(start + 1 + np.arange((end - start) % n)) % n]
        ends = self.crossings[self.crossing_of_visit[visits]]
        return np.concatenate([ends[:1], inner, ends[1:]])

    def cell_outline(self, cell: int) -> Floats:
        """Return the boundary polygon of a cell, shape (m, 2), counter-clockwise for bounded cells.

        A cell that touches itself at a crossing passes through that point twice. Raises
        :class:`~plyfold.errors.PlyfoldError` if other loops lie in the cell: see :meth:`cell_outlines`.
        """
        outlines = self.cell_outlines(cell)
        if len(outlines) > 1:
            raise PlyfoldError(
                f"cell {cell} has {len(outlines)} boundary polygons", hint="cell_outlines(cell) returns them"
            )
        return outlines[0]

    def cell_outlines(self, cell: int) -> tuple[Floats, ...]:
        """Return all boundary polygons of a cell, walked with the cell on the left: several if loops lie in it."""
        low, high = np.searchsorted(self.cycle_start, self.cell_start[[cell, cell + 1]])
        cycles = pairwise(self.cycle_start[low : high + 1].tolist())
        return tuple(self._walked(self.cell_darts[start:end]) for start, end in cycles)

    def _walked(self, darts: Ints) -> Floats:
        """Return the points along some darts, each followed by the next."""
        pieces = []
        for dart in darts.tolist():
            points = self.border_points(dart // 2)
            points = points[::-1] if dart % 2 else points
            pieces.append(points if self.start_visit[dart // 2] < 0 else points[:-1])
        return np.concatenate(pieces)

    def cell_point(self, cell: int) -> tuple[float, float]:
        """Return a point inside a cell; for cell 0, one outside all curves.

        The winding number of the point is checked exactly. Of a sliver so thin that no double lies inside, a point on
        its boundary is returned.
        """
        loops = [curve.points for curve in self._drawn()]
        if cell == 0:
            points = np.concatenate(loops)
            low, high = points.min(axis=0), points.max(axis=0)
            x, y = low - 0.05 * (high - low).max()
            return float(x), float(y)
        outlines = self.cell_outlines(cell)
        inside = (place for place in inner_points(outlines) if total_winding(loops, place) == self.winding[cell])
        return next(inside, (float(outlines[0][0, 0]), float(outlines[0][0, 1])))

    def __repr__(self) -> str:
        if self.n_loops > 1:
            kind = f"{self.n_loops} curves"
        else:
            kind = f"a curve of {len(self.curves[0])} points" if self.curves else "a Gauss code"
        exact = f", {self.exact_signs} exact signs" if self.exact_signs else ""
        return f"<Arrangement of {kind}: {self.n_crossings} crossings, turning number {self.turning_number}{exact}>"

    def _drawn(self) -> tuple[Curve, ...]:
        if not self.curves:
            raise PlyfoldError(
                "this arrangement is a Gauss code without a drawing", hint="build it from points to get positions"
            )
        return self.curves

    def check(self) -> None:
        """Check the arrangement against the theorems it must obey.

        Euler's formula, orbits, the winding numbers on both sides of every border, and the turning numbers from the
        crossings, from the winding numbers and from the exterior angles of the polygons.

        Raises
        ------
        PlyfoldError
            Naming the theorem that failed. That would be a mistake in plyfold.
        """
        for theorem, holds in self._theorems():
            if not holds:
                raise PlyfoldError(f"internal check failed: {theorem}")

    def _theorems(self) -> Iterator[tuple[str, bool]]:
        left, right = self.winding[self.left_cell], self.winding[self.right_cell]
        groups = 1 if self.n_loops == 1 else int(self.group_of_loop.max()) + 1
        yield (
            "Euler: as many cells as crossings and groups of loops, and one more",
            (self.n_cells == self.n_crossings + groups + 1),
        )
        yield "every dart belongs to one cell", _same(np.sort(self.cell_darts), np.arange(2 * self.n_borders))
        yield "a dart and the next one have the same cell", _same(self.cell_of_dart, self.cell_of_dart[self.next_dart])
        yield "the unbounded cell winds 0 times", self.winding[self.cell_of_dart[self.outer]] == 0
        yield "left of a border winds once more than right of it", _same(left, right + 1)
        yield (
            "the partner's partner is the visit itself",
            _same(self.partner[self.partner], np.arange(len(self.partner))),
        )
        yield (
            "turning number by crossings and by winding numbers agree",
            self.turning_number == self.turning_by_windings(),
        )
        exterior = tuple(polygon_turning_number(curve.points) for curve in self.curves)
        yield "turning numbers by crossings and by angles agree", exterior in ((), self.turning_numbers)

    def turning_by_windings(self) -> int:
        """Return the turning number, of all loops together, from the winding numbers alone.

        Over a cell lie as many sheets as it is wound round, over the inside of a border and over a crossing as many as
        over the highest cell beside it; the Euler characteristic of all of them is the turning number, also where some
        count as negative.
        """
        visited = self.border_after
        at_crossings = self.winding[self.left_cell[np.where(self.ccw, self.border_before, visited)]].sum() // 2
        along_borders = self.winding[self.left_cell[visited]].sum()
        return int(at_crossings - along_borders + (self.winding * (2 - self.n_cycles)).sum())

    def _repr_svg_(self) -> str | None:
        # Several curves have no picture yet.
        from plyfold.draw.svg import arrangement_svg

        return arrangement_svg(self) if self.n_loops == 1 else None


def _same(first: npt.NDArray[np.int64], second: npt.NDArray[np.int64]) -> bool:
    return bool((first == second).all())


def _number_crossings(partner: Ints) -> Ints:
    visit = np.arange(len(partner))
    first = visit < partner
    return np.asarray((np.cumsum(first) - 1)[np.where(first, visit, partner)], dtype=np.int64)


def arrange(curve: OutlineLike, general_position: Literal["perturb", "raise"] = "perturb") -> Arrangement:
    """Find the crossings, borders and cells of a closed curve, or of several together (§2.1 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry, Arrangement or GaussCode; or a list of such curves
        A closed curve; the last point is joined to the first. An arrangement is returned as it is; that of a code has
        no drawing. A list of curves is an outline: the surface that they bound together is to lie on the left of each,
        so holes run clockwise.
    general_position : {"perturb", "raise"}
        What to do where a vertex lies on another edge, edges overlap or three edges meet in a point: move vertices
        as little as possible (``result.curve.repairs`` says which and by how much), or raise an error naming the
        places. Several curves are never moved.

    Returns
    -------
    Arrangement
        In the direction in which no winding number is negative, if there is one: then a surface can lie on the left.
        With winding numbers of both signs, a curve has a positive turning number, and several curves stay as given.
        (``reversed`` says whether it was turned round.) All its combinatorial data are exact.
        Cost: O((n + k) log n) for drawings whose edges do not crowd, and O(n) more for each group of several curves
        that hang together by crossings.

    Raises
    ------
    CurveError
        If the points do not make a closed curve.
    GeneralPositionError
        With ``general_position="raise"`` or for several curves, at the touching places.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> loop = arrange([(0, 0), (4, 0), (4, 3), (1, -1)])
    >>> loop.n_crossings, loop.crossings.tolist()
    (1, [[1.75, 0.0]])
    """
    return watched_arrangement(curve, general_position, UNWATCHED)


def watched_arrangement(curve: OutlineLike, general_position: Literal["perturb", "raise"], watch: Watch) -> Arrangement:
    """Return the same as :func:`arrange`, or raise TimeLimitError."""
    watch = watch.begin("finding the crossings")
    if isinstance(curve, Arrangement):
        return curve
    if hasattr(curve, "partner"):  # a GaussCode, which a module further on defines
        given = cast("Coded", curve)
        return Arrangement.from_gauss(given.partner, given.ccw, given.outer)
    if not are_several(curve):
        return _of_curve(as_curve(curve), general_position, watch)
    several = cast("Sequence[CurveLike]", curve)
    if len(several) == 1:
        return watched_arrangement(several[0], general_position, watch)
    curves = as_curves(several)
    arranged = Arrangement._of_loops(curves, watch)
    if arranged.winding.max() > 0:
        return arranged
    return replace(Arrangement._of_loops(tuple(loop.reversed() for loop in curves), watch), reversed=True)


def require_one_loop(arranged: Arrangement, what: str = "this") -> None:
    """Refuse an arrangement of several closed curves for what is there for one curve alone."""
    if arranged.n_loops > 1:
        raise InputError(
            f"{what} is there for one curve alone so far, and here are {arranged.n_loops} together",
            hint="find_embedding, embeddings, count_embeddings and embed_cased take them",
        )


def _of_curve(curve: Curve, general_position: Literal["perturb", "raise"], watch: Watch) -> Arrangement:
    separated, visits = in_general_position(curve, general_position, watch)
    watch.step()
    edge, point = visits.edge, visits.point
    code = _oriented(visits.partner, visits.ccw, _outer_dart(separated.points, edge))
    if code.reversed:
        separated, edge, point = separated.reversed(), len(separated) - 1 - edge[::-1], point[::-1]
    return Arrangement._of_code(
        code,
        curves=(separated,),
        crossings=point[np.arange(len(point)) < code.partner],
        visit_edge=edge,
        exact_signs=visits.exact_signs,
    )


class _OrientedCode(NamedTuple):
    """The code of a curve in the direction in which it is used, with its winding numbers left of borders."""

    partner: Ints
    ccw: Bools
    outer: int
    left: Ints
    turning_number: int
    reversed: bool


def _oriented(partner: Ints, ccw: Bools, outer: int) -> _OrientedCode:
    """Turn a curve round if that makes all winding numbers positive; if nothing does, to a positive turning number."""
    left, turning = left_windings(ccw, outer), whitney_turning_number(partner, ccw, outer)
    no_negative, no_positive = left.min() > 0, left.max() <= 0
    if no_negative or (turning >= 0 and not no_positive):
        return _OrientedCode(partner, ccw, outer, left, turning, False)
    partner, ccw, outer = reversed_code(partner, ccw, outer)
    return _OrientedCode(partner, ccw, outer, left_windings(ccw, outer), -turning, True)


def _cell_of_each_dart(cell_start: Ints, cell_darts: Ints) -> Ints:
    cell_of_dart = np.empty_like(cell_darts)
    cell_of_dart[cell_darts] = np.repeat(np.arange(len(cell_start) - 1), np.diff(cell_start))
    return cell_of_dart


def _outer_dart(points: Floats, visit_edge: Ints) -> int:
    """Return a dart with the unbounded cell on its left: at the leftmost vertex, on its convex side."""
    x, y = points.T
    leftmost = np.flatnonzero(x == x.min())
    corner = int(leftmost[y[leftmost].argmin()])
    before, after = points[corner - 1], points[(corner + 1) % len(points)]
    border = (int(np.searchsorted(visit_edge, corner)) - 1) % max(len(visit_edge), 1)
    return 2 * border + int(cross_sign(before, points[corner], points[corner], after) > 0)
