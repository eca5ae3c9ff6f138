"""The arrangement of closed curves: their crossings, borders and cells (§2.1 of the paper)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal, cast

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.as_given import crossings_as_given
from plyfold.arrangement.drawn import DrawnMap, drawn_map
from plyfold.arrangement.general_position import in_general_position, touching_points
from plyfold.arrangement.leftmost import leftmost_crossing
from plyfold.arrangement.maps import (
    CellWalk,
    Map,
    numbered_crossings,
    oriented,
    walked_round,
)
from plyfold.arrangement.marks import cusps_on_borders, with_marks
from plyfold.arrangement.planar_map import (
    borders_at_visits,
    checked_code,
)
from plyfold.arrangement.polylines import inner_points, total_winding
from plyfold.arrangement.theorems import theorems_of
from plyfold.arrays import Bools, Floats, Fractions, Ints, Reals, freeze
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GaussCodeError, InputError, PlyfoldError
from plyfold.graphs import components
from plyfold.outline.curve import Curve, Outline
from plyfold.outline.given import Coded, CurveLike, OutlineLike, are_several, as_outline

__all__ = ["Arrangement", "CurveLike", "arrange", "require_one_loop", "watched_arrangement"]


@dataclass(frozen=True, eq=False)
class Arrangement:
    """The planar map of one closed curve or of several, with the surface that they may bound on their left.

    Made by :func:`arrange` from a drawing, or by :meth:`from_gauss` from a signed Gauss code.

    Parameters
    ----------
    partner : (visits,) int
        Visits are numbered in order along the curve, one loop after the other; visit p meets visit ``partner[p]`` at
        the same crossing. A *mark*, which is a cusp or the foot of a bridge, counts as a visit that is its own partner.
    ccw : (visits,) bool
        True where the other strand crosses from right to left; not at marks.
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
    crossing_of_visit : (visits,) int
        Crossings are numbered in the order in which the curve first visits them; −1 at marks.
    cusp_index : (visits,) int
        By how many full turns the surface's angle is larger than the one that is seen: 0 but at cusps.
    bridges : (b, 2) int
        Where loops do not hang together, bridges join them: each has two darts that start at its feet, with the cell on
        their left in which it runs. The first foot is at the leftmost vertex of a group of loops, the second one
        straight to the left of it. Borders and bridges together connect the boundary of every bounded cell.
    outline : Outline
        The loops as used: oriented, without spikes, and with points in contact moved, as far as doubles tell; None if
        only the code is known.
    given : Outline
        The same points in the same order where they were given; None if only the code is known.
    numbers : (points,) int
        The number that each point of them has in the outline that came in: another one if the outline was turned round,
        or if spikes were taken out.
    crossings : (k, 2) float
        Positions, rounded to double precision; (0, 2) if only the code is known.
    visit_edge : (visits,) int
        Edge of the outline on which each visit lies, counted over all loops; a cusp lies on the edge that starts there.
        Empty if only the code is known.
    marks : (m, 2) float
        Positions of the marks in order, rounded; (0, 2) if only the code is known.
    reversed : bool
        True if the input was turned round: all winding numbers were 0 or negative, or a single curve with winding
        numbers of both signs had a negative turning number.
    exact_signs : int
        How many signs and places along edges had to be settled with fractions; 0 if only the code is known.
    begun : (points, 2) object or None
        Where the points of ``given`` are when those in contact have begun to move: in fractions, infinitely near. None
        without contacts. Where doubles have room, ``outline`` shows the same in these; else it has the given points.

    Examples
    --------
    >>> from plyfold import arrange
    >>> eight = arrange([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> eight.n_crossings, eight.turning_number, sorted(eight.winding.tolist())
    (1, 0, [-1, 0, 1])
    >>> annulus = arrange([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])
    >>> annulus.winding.tolist(), annulus.turning_numbers, annulus.bridges.tolist(), annulus.partner.tolist()
    ([0, 1, 0], (1, -1), [[2, 0]], [0, 1])
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
    cusp_index: Ints
    bridges: Ints = field(default_factory=lambda: np.empty((0, 2), dtype=np.int64))
    outline: Outline | None = None
    given: Outline | None = None
    numbers: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    crossings: Floats = field(default_factory=lambda: np.empty((0, 2)))
    visit_edge: Ints = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    marks: Floats = field(default_factory=lambda: np.empty((0, 2)))
    reversed: bool = False
    exact_signs: int = 0
    begun: Fractions | None = None

    def __post_init__(self) -> None:
        freeze(self)

    @classmethod
    def from_gauss(
        cls, partner: npt.ArrayLike, ccw: npt.ArrayLike, outer: int, cusps: Mapping[int, int] | None = None
    ) -> Arrangement:
        """Build the arrangement of a signed Gauss code.

        Parameters
        ----------
        partner : array_like of int, shape (2k,)
            The other visit to the same crossing.
        ccw : array_like of bool, shape (2k,)
            True where the other strand crosses from right to left.
        outer : int
            A dart whose left cell is to be the unbounded one.
        cusps : mapping from border to int, optional
            Borders of the code that have a cusp, and its index.

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
        >>> Arrangement.from_gauss([1, 0], [True, False], outer=1, cusps={0: 1}).euler_characteristic
        1
        """
        used, turning, turned_round = oriented(*checked_code(partner, ccw, outer))
        marks = cusps_on_borders(used.code, cusps or {}, turned_round)
        marked = with_marks(used, marks)
        arranged = cls._of_map(marked, walked_round(marked), (turning,), None, reversed=turned_round)
        cells = 2 + arranged.n_crossings
        if arranged.n_cells != cells:
            raise GaussCodeError(
                f"the code draws {arranged.n_cells} cells, and a plane curve with {cells - 2} crossings has {cells}",
                hint="check partner and ccw: this code belongs to a curve on a surface with handles",
            )
        return arranged

    @classmethod
    def of_drawing(cls, found: DrawnMap) -> Arrangement:
        """Return the arrangement of the map that an outline draws."""
        return cls._of_map(found.drawn, found.walked, found.turning, found.outline, **found.more)

    @classmethod
    def _of_map(
        cls, drawn: Map, walked: CellWalk, turning: tuple[int, ...], outline: Outline | None, **more: Any
    ) -> Arrangement:
        """Return the arrangement of loops whose cells have been walked round."""
        code, (following, cell_start, cell_darts, cell_of_dart) = drawn.code, walked
        winding = np.empty(len(cell_start) - 1, dtype=np.int64)
        winding[cell_of_dart[0::2]] = code.left
        winding[cell_of_dart[1::2]] = code.left - 1
        return cls(
            partner=code.partner,
            ccw=code.ccw,
            outer=int(drawn.outside[0]),
            first_visit=code.first_visit,
            next_dart=following,
            cell_of_dart=cell_of_dart,
            cell_start=cell_start,
            cell_darts=cell_darts,
            winding=winding,
            turning_numbers=turning,
            crossing_of_visit=numbered_crossings(code.partner),
            cusp_index=code.cusp_index,
            bridges=drawn.bridges,
            outline=outline,
            visit_edge=code.edge if outline else code.edge[:0],
            marks=drawn.places if outline else drawn.places[:0],
            **more,
        )

    def gauss_code(self) -> tuple[list[int], list[bool], int]:
        """Return ``(partner, ccw, outer)`` of one curve as plain lists, ready for :meth:`from_gauss`.

        Raises :class:`~plyfold.errors.InputError` for several curves and for cusps, which codes have not.
        """
        require_one_loop(self, "a Gauss code")
        if self.cusp_index.any():
            raise InputError("a Gauss code has no cusps", self.marks, hint="take the code of the outline without them")
        return self.partner.tolist(), self.ccw.tolist(), self.outer

    @property
    def curve(self) -> Curve | None:
        """The curve as it was used, oriented and in general position; None if only the code is known.

        Raises :class:`~plyfold.errors.InputError` if there are several: :attr:`outline` has them all.
        """
        require_one_loop(self)
        return cast("Curve | None", self.outline)

    @property
    def n_loops(self) -> int:
        """Number of closed curves."""
        return len(self.first_visit) - 1

    @property
    def n_crossings(self) -> int:
        """Number of crossings, k."""
        return int(np.count_nonzero(self.ccw))

    @property
    def n_borders(self) -> int:
        """Number of borders: 2k, 1 more for each mark, and 1 for each loop that has no visit."""
        return len(self.cell_of_dart) // 2

    @property
    def n_cells(self) -> int:
        """Number of cells, the unbounded one included: k + 1 and 1 for each group of loops that hang together."""
        return len(self.winding)

    @property
    def turning_number(self) -> int:
        """Total rotation of the tangents in full turns, all loops added up."""
        return sum(self.turning_numbers)

    @property
    def euler_characteristic(self) -> int:
        """That of every surface bounded by the outline: its full turns, less those that are too many at cusps."""
        return self.turning_number - int(self.cusp_index.sum())

    @property
    def loop_characteristics(self) -> Ints:
        """What each loop adds to that: how often it turns, less the indices of its cusps, shape (loops,)."""
        passed = np.append(0, self.cusp_index.cumsum())[self.first_visit]
        return np.asarray(np.array(self.turning_numbers) - passed[1:] + passed[:-1])

    @property
    def is_begun(self) -> bool:
        """Whether points have only begun to move, so that doubles do not tell them from the given ones."""
        return self.begun is not None and np.array_equal(self._drawn().points, cast("Outline", self.given).points)

    @property
    def exact_points(self) -> Reals:
        """The points of :attr:`outline` exactly: doubles, or :attr:`begun` where these do not tell."""
        return cast("Fractions", self.begun) if self.is_begun else self._drawn().points

    @cached_property
    def first_visits(self) -> Ints:
        """The first visit to each crossing, shape (k,), in the order of crossings."""
        return np.flatnonzero(np.arange(len(self.partner)) < self.partner)

    @cached_property
    def crossing_visits(self) -> Ints:
        """The visits to crossings, shape (2k,): all but the marks."""
        return np.flatnonzero(self.partner != np.arange(len(self.partner)))

    @cached_property
    def visit_point(self) -> Floats:
        """Where each visit is, rounded, shape (visits, 2). It needs a drawing."""
        point = np.empty((len(self.partner), 2))
        is_mark = self.crossing_of_visit < 0
        point[~is_mark], point[is_mark] = self.crossings[self.crossing_of_visit[~is_mark]], self.marks
        return point

    @cached_property
    def border_before(self) -> Ints:
        """The border that ends at each visit, shape (visits,)."""
        return borders_at_visits(self.first_visit)[0]

    @cached_property
    def border_after(self) -> Ints:
        """The border that starts at each visit, shape (visits,). For one curve it has the visit's number."""
        return borders_at_visits(self.first_visit)[1]

    @cached_property
    def start_visit(self) -> Ints:
        """The visit at which each border starts, shape (borders,); −1 for a loop without visits."""
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
    def contacts(self) -> Ints:
        """The points of :attr:`given` that lie on other edges or on each other.

        Examples
        --------
        >>> arrange([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]).contacts.tolist()
        [2, 5]
        """
        if self.given is None or self.given is self.outline:
            return np.empty(0, dtype=np.int64)
        return touching_points(self.given)

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
        return int(visits[leftmost_crossing(self.curve.points if self.begun is None else self.begun, edge, other)])

    def border_points(self, border: int) -> Floats:
        """Return the polyline of a border, shape (m, 2), from visit to visit with both ends.

        The border of a loop without visits is all its points, the first one not repeated. Raises
        :class:`~plyfold.errors.PlyfoldError` if only the code is known.
        """
        outline = self._drawn()
        start, end = self.start_visit[[border, self.next_border[border]]].tolist()
        loop = int(self.loop_of_border[border])
        if start < 0:
            return outline.loops[loop]
        first, n = outline.first_point[loop], len(outline.loops[loop])
        edge, last = self.visit_edge[[start, end]].tolist()
        inner = np.arange(edge + 1, last + 1 + n * (end <= start))
        if len(inner) and self._is_vertex[end]:
            inner = inner[:-1]
        points = outline.loops[loop][(inner - first) % n]
        return np.concatenate([self.visit_point[[start]], points, self.visit_point[[end]]])

    @cached_property
    def _is_vertex(self) -> Bools:
        """Which visits are marks at vertices."""
        there = self.visit_point == self._drawn().points[self.visit_edge]
        return np.asarray(there.all(axis=1) & (self.crossing_of_visit < 0))

    def cell_outline(self, cell: int) -> Floats:
        """Return the boundary polygon of a cell, shape (m, 2), counter-clockwise for bounded cells.

        It passes twice through a crossing where the cell touches itself. Raises PlyfoldError if other loops lie in the
        cell: see :meth:`cell_outlines`.
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
            start = self.start_visit[self.next_border[dart // 2] if dart % 2 else dart // 2]
            # A foot in the middle of an edge is no corner.
            is_corner = start < 0 or self.partner[start] != start or self._is_vertex[start]
            pieces.append(points[not is_corner : len(points) - (start >= 0)])
        return np.concatenate(pieces)

    def cell_point(self, cell: int) -> tuple[float, float]:
        """Return a point inside a cell; for cell 0, one outside all curves.

        The winding number of the point is checked exactly. Of a sliver so thin that no double lies inside, a point on
        its boundary is returned.
        """
        loops = self._drawn().loops
        if cell == 0:
            points = self._drawn().points
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
            kind = f"a curve of {len(self.outline)} points" if self.outline else "a Gauss code"
        cusps = f", {np.count_nonzero(self.cusp_index)} cusps" if self.cusp_index.any() else ""
        exact = f", {self.exact_signs} exact signs" if self.exact_signs else ""
        turning = f"turning number {self.turning_number}"
        return f"<Arrangement of {kind}: {crossings_as_given(self)} crossings, {turning}{cusps}{exact}>"

    def _drawn(self) -> Outline:
        if self.outline is None:
            raise PlyfoldError(
                "this arrangement is a Gauss code without a drawing", hint="build it from points to get positions"
            )
        return self.outline

    def check(self) -> None:
        """Check the arrangement against the theorems it must obey.

        Euler's formula, orbits, the winding numbers on both sides of every border, and the turning numbers from the
        crossings, from the winding numbers and from the exterior angles of the polygons.

        Raises
        ------
        PlyfoldError
            Naming the theorem that failed. That would be a mistake in plyfold.
        """
        for theorem, holds in theorems_of(self):
            if not holds:
                raise PlyfoldError(f"internal check failed: {theorem}")

    def turning_by_windings(self) -> int:
        """Return the turning number, of all loops together, from the winding numbers alone.

        Over a cell lie as many sheets as it is wound round, over the inside of a border and over a crossing as many as
        over the highest cell beside it; the Euler characteristic of all of them is the turning number, also where some
        count as negative.
        """
        visits = self.crossing_visits
        visited, ccw = self.border_after[visits], self.ccw[visits]
        at_crossings = self.winding[self.left_cell[np.where(ccw, self.border_before[visits], visited)]].sum() // 2
        along_borders = self.winding[self.left_cell[visited]].sum()
        return int(at_crossings - along_borders + (self.winding * (2 - self.n_cycles)).sum())

    def _repr_svg_(self) -> str:
        from plyfold.draw.svg import arrangement_svg

        return arrangement_svg(self)


def arrange(curve: OutlineLike, general_position: Literal["perturb", "raise"] = "perturb") -> Arrangement:
    """Find the crossings, borders and cells of a closed curve, or of several together (§2.1 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry, Arrangement or GaussCode; or a list of such curves
        A closed curve; the last point is joined to the first. An arrangement is returned as it is; that of a code has
        no drawing. A list of curves is an outline: the surface that they bound together is to lie on the left of each,
        so holes run clockwise.
    general_position : {"perturb", "raise"}
        What to do where a vertex lies on another edge, edges overlap or three edges meet in a point: take spikes out
        and move vertices by infinitely little, outward (``result.outline.repairs`` says which, and by how much), or
        raise an error naming the places.

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
        With ``general_position="raise"``, at the touching places; else where cusps that stay hold edges together.

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
    if are_several(curve) and len(several := cast("Sequence[CurveLike]", curve)) == 1:
        return watched_arrangement(several[0], general_position, watch)
    placed = in_general_position(as_outline(curve), general_position, watch)
    return Arrangement.of_drawing(drawn_map(placed, watch))


def require_one_loop(arranged: Arrangement, what: str = "this") -> None:
    """Refuse an arrangement of several closed curves for what is there for one curve alone."""
    if arranged.n_loops > 1:
        raise InputError(
            f"{what} is there for one closed curve alone, and the outline has {arranged.n_loops} loops",
            hint="give one of its loops",
        )
