"""Layered surfaces whose boundary is several closed curves: with holes, handles, and perhaps in several pieces.

The equations between levels (:mod:`plyfold.layering.levels.equations`) hold as for one curve. Each solution glues
sheets to a surface without self-intersections that has the given curves as its boundary and lies to the left of them.
Its Euler characteristic is the sum of their turning numbers, for it lies flat without branch points; the same holds for
each of its pieces, which gives their genus. All this is exact. Nothing demands that the surface be in one piece.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import CurveLike
from plyfold.arrangement.several import Loops, arrange_loops, components
from plyfold.arrays import Bools, Ints, freeze
from plyfold.clock import Clock
from plyfold.errors import InputError
from plyfold.immersion.immersion import count_each
from plyfold.layering.levels.casing import casing_of_visits
from plyfold.layering.levels.clauses import LevelClauses, contradicting_crossings, list_levels, solve_levels
from plyfold.layering.levels.counting import count_level_solutions
from plyfold.layering.levels.equations import level_equations_of_loops
from plyfold.obstruction import Obstruction, Unknown

__all__ = ["LayeredSurface", "Piece", "count_layered_surfaces", "find_layered_surface", "layered_surfaces"]


@dataclass(frozen=True)
class Piece:
    """A connected piece of a surface.

    Parameters
    ----------
    loops : tuple of int
        The curves that are its boundary.
    euler_characteristic : int
        The sum of their turning numbers.
    """

    loops: tuple[int, ...]
    euler_characteristic: int

    @property
    def genus(self) -> int:
        """Number of handles."""
        return (2 - len(self.loops) - self.euler_characteristic) // 2


@dataclass(frozen=True, eq=False)
class LayeredSurface:
    """A surface without self-intersections over the plane, bounded by several closed curves. It is true as a value.

    Parameters
    ----------
    loops : Loops
        The curves with their crossings, borders and cells.
    level : (borders,) int
        The level of each border's own sheet, 1 for the lowest, among the sheets over the cell on the border's left.
        These numbers determine the surface: any sheet on the right of the border is glued to the sheet on its left that
        has the same place among all but the border's own.

    Examples
    --------
    >>> annulus = find_layered_surface([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])
    >>> annulus.level.tolist(), annulus.euler_characteristic
    ([1, 1], 0)
    >>> annulus.pieces
    (Piece(loops=(0, 1), euler_characteristic=0),)
    """

    loops: Loops
    level: Ints

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def euler_characteristic(self) -> int:
        """The sum of the turning numbers of all curves."""
        return int(self.loops.turning_number.sum())

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The connected pieces, in the order of their first curves."""
        own_sheet = self._first_sheet[self.loops.left_cell] + self.level - 1
        first_border = np.unique(self.loops.loop_of_border, return_index=True)[1]
        piece_of_loop = self._piece_of_sheet[own_sheet[first_border]]
        groups = [np.flatnonzero(piece_of_loop == piece) for piece in dict.fromkeys(piece_of_loop.tolist())]
        return tuple(Piece(tuple(g.tolist()), int(self.loops.turning_number[g].sum())) for g in groups)

    @property
    def casing(self) -> Bools:
        """Over and under, shape (2k,): whether at each visit the strand passes over the other one."""
        loops = self.loops
        casing = np.empty(len(loops.border_before), dtype=bool)
        casing[loops.first] = self.level[loops.border_before[loops.first]] > self.level[loops.second]
        casing[loops.second] = ~casing[loops.first]
        return casing

    @property
    def _first_sheet(self) -> Ints:
        return np.asarray(np.cumsum(self.loops.winding) - self.loops.winding)

    @property
    def _piece_of_sheet(self) -> Ints:
        """Glue the sheets along all borders and return the piece that each belongs to. Cost: O(Σ w)."""
        loops, first_sheet = self.loops, self._first_sheet
        sheets = loops.winding[loops.right_cell]
        border, place = np.repeat(np.arange(loops.n_borders), sheets), count_each(sheets)
        right = first_sheet[loops.right_cell[border]] + place
        left = first_sheet[loops.left_cell[border]] + place + (place >= self.level[border] - 1)
        return components(int(loops.winding.sum()), right, left)


def find_layered_surface(
    curves: Iterable[CurveLike], time_limit: float | None = None, over: npt.ArrayLike | None = None
) -> LayeredSurface | Obstruction | Unknown:
    """Find a layered surface that has the given closed curves as its boundary, or prove that there is none.

    Parameters
    ----------
    curves : iterable of Curve, array_like of shape (n, 2) or shapely geometry
        Each in the direction that has the surface on its left: outer boundaries counter-clockwise, holes clockwise.
        They may cross themselves and each other. A single curve may bound a surface with handles.
    time_limit : float, optional
        Seconds after which to give up; none by default.
    over : array_like of bool, shape (2k,) or (k,), optional
        Which strand is to pass over: for each visit, visits numbered along one curve after the other, whether the
        strand passes over the other one; or for each crossing, whether it does so at the first of its two visits.
        A curve that lies in others without crossing them can have several levels with the same casing: then there is
        no answer but an error.

    Returns
    -------
    LayeredSurface or Obstruction or Unknown
        An obstruction has the reason ``"negative winding"`` (``value`` is the winding number) or ``"no embedding"``
        (``value`` is a tuple of crossings at which no levels of the strands fit together).

    Raises
    ------
    InputError
        If there is no curve, or ``over`` has the wrong length or says of both strands the same, or several surfaces
        have this casing; the places are the first points of curves whose level it does not determine.
    GeneralPositionError
        If curves touch or overlap, or three edges meet in a point.

    Notes
    -----
    Exact in both directions; a SAT problem with O(Σ w) variables and clauses, over borders. The Euler characteristic is
    the sum of the turning numbers. The surface may be in several pieces, even if another one is in one piece:
    :func:`layered_surfaces` lists all of them.

    Examples
    --------
    >>> ring = [(0, 0), (9, 0), (0, 9)]
    >>> print(find_layered_surface([ring, [(5, 5), (5, 6), (6, 5)]]))
    The curves wind -1 times around a cell, and cloth cannot cover it a negative number of times.
    """
    clock, loops = Clock(time_limit), arrange_loops(curves)
    obstruction = _negative_winding(loops)
    if obstruction is not None:
        return obstruction
    clauses = _level_clauses(loops, over)
    try:
        level = solve_levels(clauses, clock)
        if level is not None and over is not None:
            _require_only(loops, clauses, level, clock)
    except TimeoutError:
        return _unknown("whether there is a layered surface", clock)
    return _no_surface(loops, clauses, clock) if level is None else LayeredSurface(loops, level)


def layered_surfaces(curves: Iterable[CurveLike], over: npt.ArrayLike | None = None) -> Iterator[LayeredSurface]:
    """List all layered surfaces that have the given closed curves as their boundary, each once, in a stable order.

    Parameters
    ----------
    curves : iterable of Curve, array_like of shape (n, 2) or shapely geometry
        As for :func:`find_layered_surface`.
    over : array_like of bool, shape (2k,) or (k,), optional
        As there; all surfaces with this casing.

    Yields
    ------
    LayeredSurface
        Each takes at most k + Σ w questions to the SAT solver, w added up over curves, most of them easy.

    Examples
    --------
    >>> stacked = [[(0, 0), (9, 0), (0, 9)], [(1, 1), (3, 1), (1, 3)]]
    >>> [surface.level.tolist() for surface in layered_surfaces(stacked)]
    [[1, 2], [1, 1]]
    """
    loops = arrange_loops(curves)
    if _negative_winding(loops) is None:
        for level in list_levels(_level_clauses(loops, over)):
            yield LayeredSurface(loops, level)


def count_layered_surfaces(curves: Iterable[CurveLike], time_limit: float | None = None) -> int | Unknown:
    """Count the layered surfaces that have the given closed curves as their boundary, exactly.

    Parameters
    ----------
    curves : iterable of Curve, array_like of shape (n, 2) or shapely geometry
        As for :func:`find_layered_surface`.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    int or Unknown
        Of any Euler characteristic, in one piece or several. For the cost see
        :func:`plyfold.layering.levels.counting.count_level_solutions`.

    Examples
    --------
    >>> count_layered_surfaces([[(0, 0), (9, 0), (0, 9)], [(1, 1), (3, 1), (1, 3)]])
    2
    """
    clock, loops = Clock(time_limit), arrange_loops(curves)
    if _negative_winding(loops) is not None:
        return 0
    try:
        return count_level_solutions(level_equations_of_loops(loops), clock)
    except TimeoutError:
        return _unknown("how many layered surfaces there are", clock)


def _level_clauses(loops: Loops, over: npt.ArrayLike | None) -> LevelClauses:
    first_is_over = None if over is None else casing_of_visits(loops, over)[loops.first]
    return LevelClauses(level_equations_of_loops(loops), first_is_over)


def _require_only(loops: Loops, clauses: LevelClauses, level: Ints, clock: Clock) -> None:
    """Refuse a casing that other levels have as well. Raises TimeoutError when the time is over."""
    differing = clauses.other_than(level)
    other = solve_levels(clauses, clock, [differing]) if differing else None
    if other is None:
        return
    free = np.unique(loops.loop_of_border[level != other]).tolist()
    raise InputError(
        f"several surfaces have this casing: it does not determine the level of curve {', '.join(map(str, free))}",
        where=[loops.curves[curve].points[0] for curve in free],
        hint="layered_surfaces(curves, over) lists them all",
    )


def _negative_winding(loops: Loops) -> Obstruction | None:
    lowest = int(loops.winding.min())
    if lowest >= 0:
        return None
    border = int(np.flatnonzero(loops.winding[loops.right_cell] == lowest)[0])
    crossed = border < len(loops.crossing_of_visit)
    curve = loops.curves[loops.loop_of_border[border]]
    x, y = loops.crossings[loops.crossing_of_visit[border]] if crossed else curve.points[0]
    sentence = f"The curves wind {lowest} times around a cell, and cloth cannot cover it a negative number of times."
    return Obstruction("negative winding", sentence, ((float(x), float(y)),), lowest)


def _no_surface(loops: Loops, clauses: LevelClauses, clock: Clock) -> Obstruction:
    crossings = tuple(contradicting_crossings(clauses, clock))
    sentence = f"No layered surface: no levels of the strands fit together at {len(crossings)} crossings."
    places = tuple((x, y) for x, y in loops.crossings[list(crossings)].tolist())
    return Obstruction("no embedding", sentence, places, crossings)


def _unknown(question: str, clock: Clock) -> Unknown:
    seconds = clock.spent
    return Unknown("time limit", f"Unknown after {seconds:.3g} s: {question}.", {"seconds": seconds})
