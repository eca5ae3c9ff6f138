"""The arrangement of a closed curve: its crossings, borders and cells (§2.1 of the paper)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal, cast

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.general_position import in_general_position
from plyfold.arrangement.leftmost import leftmost_crossing
from plyfold.arrangement.planar_map import (
    cell_boundaries,
    checked_code,
    left_windings,
    next_darts,
    reversed_code,
    whitney_turning_number,
)
from plyfold.arrays import Bools, Floats, Ints, freeze
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GaussCodeError, PlyfoldError
from plyfold.outline.curve import Coded, Curve, CurveLike, as_curve
from plyfold.predicates import cross_sign, orient

__all__ = [
    "Arrangement",
    "CurveLike",
    "arrange",
    "polygon_turning_number",
    "watched_arrangement",
    "winding_number",
]


def _no_points() -> Floats:
    return np.empty((0, 2))


def _no_edges() -> Ints:
    return np.empty(0, dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Arrangement:
    """The planar map of a closed curve, oriented so that its turning number is not negative.

    Made by :func:`arrange` from a drawing, or by :meth:`from_gauss` from a signed Gauss code.

    Parameters
    ----------
    partner : (2k,) int
        Visits are numbered in order along the curve; visit p meets visit ``partner[p]`` at the same crossing.
    ccw : (2k,) bool
        True where the other strand crosses from right to left.
    outer : int
        A dart of the unbounded cell. Dart 2i is border i forward, 2i + 1 backward; border i runs from visit i to
        visit i + 1. The cell meant is on the dart's left.
    next_dart, cell_of_dart : (darts,) int
        The dart that follows around the cell on the left, and that cell. Cell 0 is the unbounded one.
    cell_start : (cells + 1,) int
        Where the boundary of each cell starts in ``cell_darts``.
    cell_darts : (darts,) int
        The boundary of cell c is ``cell_darts[cell_start[c]:cell_start[c + 1]]``: its darts in order, walked with the
        cell on the left, the lowest dart first.
    winding : (cells,) int
        Winding number of each cell.
    turning_number : int
        Total rotation of the tangent in full turns.
    crossing_of_visit : (2k,) int
        Crossings are numbered in the order in which the curve first visits them.
    curve : Curve or None
        The curve as it was used, oriented and in general position; None if only the code is known.
    crossings : (k, 2) float
        Positions, rounded to double precision; (0, 2) if only the code is known.
    visit_edge : (2k,) int
        Edge of the curve on which each visit lies; empty if only the code is known.
    reversed : bool
        True if the input ran clockwise and was turned round.
    exact_signs : int
        How many signs and places along edges had to be settled with fractions; 0 if only the code is known.

    Examples
    --------
    >>> from plyfold import arrange
    >>> eight = arrange([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> eight.n_crossings, eight.turning_number, sorted(eight.winding.tolist())
    (1, 0, [-1, 0, 1])
    """

    partner: Ints
    ccw: Bools
    outer: int
    next_dart: Ints
    cell_of_dart: Ints
    cell_start: Ints
    cell_darts: Ints
    winding: Ints
    turning_number: int
    crossing_of_visit: Ints
    curve: Curve | None = None
    crossings: Floats = field(default_factory=_no_points)
    visit_edge: Ints = field(default_factory=_no_edges)
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
            Without geometry; turned round if its turning number was negative.

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
        code = checked_code(partner, ccw, outer)
        turning = whitney_turning_number(*code)
        code = reversed_code(*code) if turning < 0 else code
        return cls._from_code(*code, turning_number=abs(turning), reversed=turning < 0)

    @classmethod
    def _from_code(cls, partner: Ints, ccw: Bools, outer: int, **more: Any) -> Arrangement:
        following = next_darts(partner, ccw)
        cell_start, cell_darts = cell_boundaries(following, outer)
        cells = len(cell_start) - 1
        if cells != len(partner) // 2 + 2:
            raise GaussCodeError(
                f"the code draws {cells} cells, and a plane curve with {len(partner) // 2} crossings has "
                f"{len(partner) // 2 + 2}",
                hint="check partner and ccw: this code belongs to a curve on a surface with handles",
            )
        cell_of_dart = np.empty_like(cell_darts)
        cell_of_dart[cell_darts] = np.repeat(np.arange(cells), np.diff(cell_start))
        left = left_windings(ccw, outer)
        winding = np.empty(cells, dtype=np.int64)
        winding[cell_of_dart[0::2]] = left
        winding[cell_of_dart[1::2]] = left - 1
        return cls(
            partner=partner,
            ccw=ccw,
            outer=int(outer),
            next_dart=following,
            cell_of_dart=cell_of_dart,
            cell_start=cell_start,
            cell_darts=cell_darts,
            winding=winding,
            crossing_of_visit=_number_crossings(partner),
            **more,
        )

    def gauss_code(self) -> tuple[list[int], list[bool], int]:
        """Return ``(partner, ccw, outer)`` as plain lists, ready for :meth:`from_gauss`."""
        return self.partner.tolist(), self.ccw.tolist(), self.outer

    @property
    def n_crossings(self) -> int:
        """Number of crossings, k."""
        return len(self.partner) // 2

    @property
    def n_borders(self) -> int:
        """Number of borders: 2k, or 1 for a curve that does not cross itself."""
        return len(self.cell_of_dart) // 2

    @property
    def n_cells(self) -> int:
        """Number of cells, k + 2, the unbounded one included."""
        return len(self.winding)

    @property
    def left_cell(self) -> Ints:
        """The cell on the left of each border, shape (borders,): the higher of its two cells."""
        return self.cell_of_dart[0::2]

    @property
    def right_cell(self) -> Ints:
        """The cell on the right of each border, shape (borders,): the lower of its two cells."""
        return self.cell_of_dart[1::2]

    @cached_property
    def cells(self) -> tuple[tuple[int, ...], ...]:
        """The boundary of each cell: its darts in order, walked with the cell on the left."""
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
        if self.curve is None or not self.n_crossings:
            return 0
        visits = np.flatnonzero(self.ccw)
        edge, other = self.visit_edge[visits], self.visit_edge[self.partner[visits]]
        return int(visits[leftmost_crossing(self.curve.points, edge, other)])

    def border_points(self, border: int) -> Floats:
        """Return the polyline of a border, shape (m, 2), from crossing to crossing with both ends.

        A curve without crossings has one border: all its points, the first one not repeated. Raises
        :class:`~plyfold.errors.PlyfoldError` if only the code is known.
        """
        curve = self._drawn()
        if self.n_crossings == 0:
            return curve.points
        following = (border + 1) % self.n_borders
        n = len(curve.points)
        start, end = self.visit_edge[border], self.visit_edge[following]
        inner = curve.points[(start + 1 + np.arange((end - start) % n)) % n]
        ends = self.crossings[self.crossing_of_visit[[border, following]]]
        return np.concatenate([ends[:1], inner, ends[1:]])

    def cell_outline(self, cell: int) -> Floats:
        """Return the boundary polygon of a cell, shape (m, 2), counter-clockwise for bounded cells.

        A cell that touches itself at a crossing passes through that point twice.
        """
        pieces = []
        for dart in self.cell_darts[self.cell_start[cell] : self.cell_start[cell + 1]].tolist():
            points = self.border_points(dart // 2)
            points = points[::-1] if dart % 2 else points
            pieces.append(points if self.n_crossings == 0 else points[:-1])
        return np.concatenate(pieces)

    def cell_point(self, cell: int) -> tuple[float, float]:
        """Return a point inside a cell; for cell 0, one outside the curve.

        The winding number of the point is checked exactly. Of a sliver so thin that no double lies inside, a point on
        its boundary is returned.
        """
        points = self._drawn().points
        if cell == 0:
            low, high = points.min(axis=0), points.max(axis=0)
            x, y = low - 0.05 * (high - low).max()
            return float(x), float(y)
        outline = self.cell_outline(cell)
        candidates = _inner_points(outline)
        inside = (place for place in candidates if winding_number(points, place) == self.winding[cell])
        return next(inside, (float(outline[0, 0]), float(outline[0, 1])))

    def __repr__(self) -> str:
        kind = "a Gauss code" if self.curve is None else f"a curve of {len(self.curve)} points"
        exact = f", {self.exact_signs} exact signs" if self.exact_signs else ""
        return f"<Arrangement of {kind}: {self.n_crossings} crossings, turning number {self.turning_number}{exact}>"

    def _drawn(self) -> Curve:
        if self.curve is None:
            raise PlyfoldError(
                "this arrangement is a Gauss code without a drawing", hint="build it from points to get positions"
            )
        return self.curve

    def check(self) -> None:
        """Check the arrangement against the theorems it must obey.

        Euler's formula, orbits, the winding numbers on both sides of every border and around every crossing, and
        the turning number by Whitney's formula and by the exterior angles of the polygon.

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
        yield "Euler: there are two cells more than crossings", self.n_cells == self.n_crossings + 2
        yield "every dart belongs to one cell", _same(np.sort(self.cell_darts), np.arange(2 * self.n_borders))
        yield "a dart and the next one have the same cell", _same(self.cell_of_dart, self.cell_of_dart[self.next_dart])
        yield "the unbounded cell winds 0 times", self.winding[self.cell_of_dart[self.outer]] == 0
        yield "left of a border winds once more than right of it", _same(left, right + 1)
        yield (
            "the partner's partner is the visit itself",
            _same(self.partner[self.partner], np.arange(len(self.partner))),
        )
        if self.curve is not None:
            exterior = polygon_turning_number(self.curve.points)
            yield "turning number by crossings and by angles agree", self.turning_number == exterior

    def _repr_svg_(self) -> str:
        from plyfold.draw.svg import arrangement_svg

        return str(arrangement_svg(self))


def _same(first: npt.NDArray[np.int64], second: npt.NDArray[np.int64]) -> bool:
    return bool((first == second).all())


def _number_crossings(partner: Ints) -> Ints:
    visit = np.arange(len(partner))
    first = visit < partner
    return np.asarray((np.cumsum(first) - 1)[np.where(first, visit, partner)], dtype=np.int64)


def polygon_turning_number(points: Floats) -> int:
    """Return the turning number of a closed polyline from its exterior angles, exactly.

    It counts how often the direction of the edges passes through that of the positive x axis: only signs of
    coordinates and of turns are needed, so nothing is rounded.

    Examples
    --------
    >>> polygon_turning_number(np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]))
    1
    """
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    turn = orient(before, points, after)
    step = after - points
    upper = (step[:, 1] > 0) | ((step[:, 1] == 0) & (step[:, 0] > 0))
    upper_before = np.roll(upper, 1)
    return int(((turn > 0) & ~upper_before & upper).sum()) - int(((turn < 0) & upper_before & ~upper).sum())


def winding_number(points: Floats, place: tuple[float, float]) -> int | None:
    """Return how often a closed polyline winds around a place, exactly; None if the place lies on it.

    Parameters
    ----------
    points : (n, 2) float
        Vertices of the polyline.
    place : (x, y)

    Examples
    --------
    >>> winding_number(np.array([(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)]), (1, 1))
    1
    """
    following = np.roll(points, -1, axis=0)
    low, high = np.minimum(points, following), np.maximum(points, following)
    side = orient(points, following, np.asarray(place, dtype=np.float64))
    if ((side == 0) & (low <= place).all(axis=1) & (place <= high).all(axis=1)).any():
        return None
    below, below_next = points[:, 1] <= place[1], following[:, 1] <= place[1]
    return int((below & ~below_next & (side > 0)).sum()) - int((~below & below_next & (side < 0)).sum())


def _inner_points(outline: Floats) -> Iterator[tuple[float, float]]:
    """Yield places that should lie inside a polygon, the most central first."""
    import shapely

    polygon = shapely.Polygon(outline)
    point = shapely.point_on_surface(polygon)
    yield float(point.x), float(point.y)
    for corner in range(len(outline)):
        ear = outline[[corner - 1, corner, (corner + 1) % len(outline)]]
        x, y = ear[1] + (ear - ear[1]).sum(axis=0) / 3
        yield float(x), float(y)


def arrange(curve: CurveLike, general_position: Literal["perturb", "raise"] = "perturb") -> Arrangement:
    """Find the crossings, borders and cells of a closed curve (§2.1 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry, Arrangement or GaussCode
        A closed curve; the last point is joined to the first. An arrangement is returned as it is; that of a code has
        no drawing.
    general_position : {"perturb", "raise"}
        What to do where a vertex lies on another edge, edges overlap or three edges meet in a point: move vertices
        as little as possible (``result.curve.repairs`` says which and by how much), or raise an error naming the
        places.

    Returns
    -------
    Arrangement
        Oriented to a positive turning number (``reversed`` says whether that turned it round). All its
        combinatorial data are exact. Cost: O((n + k) log n) for drawings whose edges do not crowd.

    Raises
    ------
    CurveError
        If the points do not make a closed curve.
    GeneralPositionError
        With ``general_position="raise"``, at the touching places.

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


def watched_arrangement(curve: CurveLike, general_position: Literal["perturb", "raise"], watch: Watch) -> Arrangement:
    """Return the same as :func:`arrange`, or raise TimeLimitError."""
    watch = watch.begin("finding the crossings")
    if isinstance(curve, Arrangement):
        return curve
    if hasattr(curve, "partner"):  # a GaussCode, which a module further on defines
        given = cast("Coded", curve)
        return Arrangement.from_gauss(given.partner, given.ccw, given.outer)
    separated, visits = in_general_position(as_curve(curve), general_position, watch)
    watch.step()
    edge, point = visits.edge, visits.point
    code = visits.partner, visits.ccw, _outer_dart(separated.points, edge)
    turning = whitney_turning_number(*code)
    if turning < 0:
        code, separated = reversed_code(*code), separated.reversed()
        edge, point = len(separated) - 1 - edge[::-1], point[::-1]
    return Arrangement._from_code(
        *code,
        turning_number=abs(turning),
        reversed=turning < 0,
        curve=separated,
        crossings=point[np.arange(len(point)) < code[0]],
        visit_edge=edge,
        exact_signs=visits.exact_signs,
    )


def _outer_dart(points: Floats, visit_edge: Ints) -> int:
    """Return a dart with the unbounded cell on its left: at the leftmost vertex, on its convex side."""
    x, y = points.T
    leftmost = np.flatnonzero(x == x.min())
    corner = int(leftmost[y[leftmost].argmin()])
    before, after = points[corner - 1], points[(corner + 1) % len(points)]
    border = (int(np.searchsorted(visit_edge, corner)) - 1) % max(len(visit_edge), 1)
    return 2 * border + int(cross_sign(before, points[corner], points[corner], after) > 0)
