"""The least homotopy of a closed curve: the least area that it sweeps when it contracts to a point."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import fsum

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange, require_one_loop, watched_arrangement
from plyfold.arrangement.gauss import GaussCode
from plyfold.arrays import Floats, Ints, freeze
from plyfold.clock import Clock, Watch
from plyfold.errors import CurveError, InputError, MemoryLimitError, PlyfoldError, TimeLimitError
from plyfold.homotopy.cables import Cables, lay_cables
from plyfold.homotopy.cuts import cut_into_disks, cut_into_simple_loops
from plyfold.homotopy.parts import CutVisits, Part, parts_between
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import find_immersion
from plyfold.offers.areas import areas_of
from plyfold.outline.curve import Curve
from plyfold.wording import counted

__all__ = ["Homotopy", "Loop", "least_homotopy"]


@dataclass(frozen=True, eq=False)
class Loop:
    """One of the loops that a curve is cut into: it bounds a disk, on its left or right, and contracts through it.

    Parameters
    ----------
    whole : Arrangement
        That of the curve.
    sign : int
        +1 if the disk lies on its left, −1 if it lies on its right.
    parent : int
        The loop that it is cut off; −1 for the one with the start of the curve.
    crossing : int
        The crossing of the curve where it is; −1 for that loop.
    borders : (b,) int
        The borders of the curve that it runs along, in order.
    winding : (cells,) int
        How often it winds round each cell of the curve; none has the other sign.
    arrangement : Arrangement
        Its own, as a code, turned round if the sign is −1: what it is asked for immersions.
    """

    whole: Arrangement
    sign: int
    parent: int
    crossing: int
    borders: Ints
    winding: Ints
    arrangement: Arrangement

    def __post_init__(self) -> None:
        freeze(self)

    @cached_property
    def curve(self) -> Curve | GaussCode:
        """The loop in the direction of the curve, from where it was cut off, with corners at crossings.

        Its Gauss code where only that of the curve is known, and where points of the curve have only begun to move
        apart, so that the loop has no area yet.
        """
        if self.whole.outline is not None:
            try:
                return self.whole.outline if self._is_whole else Curve(self._points())  # type: ignore[return-value]
            except CurveError:
                pass
        code = GaussCode(*self.arrangement.gauss_code())  # type: ignore[arg-type]
        return code.reversed() if self.arrangement.reversed else code

    @property
    def _is_whole(self) -> bool:
        return len(self.borders) == self.whole.n_borders

    def _points(self) -> Floats:
        """Return the points along the borders, and crossings where these do not follow each other in the curve."""
        whole, borders = self.whole, self.borders
        following = (borders + 1) % whole.n_borders
        is_first = borders != np.roll(following, 1)
        ends = following[np.roll(is_first, -1)]
        starts = borders[is_first]
        if not is_first[0]:  # the first stretch begins before the start of the curve
            ends = np.roll(ends, -1)
        return np.concatenate([_stretch(whole, *visits) for visits in zip(starts.tolist(), ends.tolist(), strict=True)])


def _stretch(whole: Arrangement, start: int, end: int) -> Floats:
    """Return the points from one visit, which is among them, to another."""
    points = whole.outline.points  # type: ignore[union-attr]
    edge, last = whole.visit_edge[[start, end]].tolist()
    inner = np.arange(edge + 1, last + 1 + len(points) * (end <= start)) % len(points)
    return np.concatenate([whole.visit_point[[start]], points[inner]])


@dataclass(frozen=True, eq=False)
class Homotopy:
    """How a closed curve contracts and sweeps the least area: loop after loop, each through a disk of its own.

    Parameters
    ----------
    arrangement : Arrangement
        That of the curve, which it may have turned round.
    weights : (cells,) float
        What it costs to sweep each cell once: its area, or what was given; 0 for the unbounded one.
    loops : tuple of Loop
        The first one has the start of the curve; each other one comes after the one that it is cut off.
    swept : (cells,) int
        How often each cell is swept: the sum of what loops wind round it, without signs.
    area : float
        The area that is swept, each place counted as often as it is.
    lower : float
        No contraction sweeps less than this: the same as the area, if that is the least.
    winding_area : float
        The sum of |w| times area over all cells with winding number w: no contraction sweeps less, and a disk as much.
    branch_points : int or None
        If the curve bounds a disk that covers each cell as often as the curve winds round it, how many branch points
        that has: 0 for an immersed disk. None if there is none, or if it is not known.
    optimal : bool
        Whether the area is the least; not where the time ended before.

    Examples
    --------
    >>> eight = least_homotopy([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> eight.area, [loop.sign for loop in eight.loops], eight.branch_points
    (2.0, [1, -1], None)
    """

    arrangement: Arrangement
    weights: Floats
    loops: tuple[Loop, ...]
    swept: Ints
    area: float
    lower: float
    winding_area: float
    branch_points: int | None
    optimal: bool

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        most = "" if self.optimal else " at most"
        return f"<Homotopy: {counted(len(self.loops), 'loop')}, sweeps{most} {self.area:.6g}>"

    @property
    def cuts(self) -> tuple[int, ...]:
        """The crossings where the curve is cut into the loops, in the order of these."""
        return tuple(loop.crossing for loop in self.loops[1:])

    def area_of(self, loop: Loop) -> float:
        """Return what one of the loops sweeps."""
        return fsum((self.weights * np.abs(loop.winding)).tolist())

    def check(self) -> None:
        """Check that the loops are what they are said to be, without the search that found them.

        Each bounds a disk, by an immersion that is found anew and checked; joined again at the cuts they are the curve;
        and their winding numbers add up to its own, and without signs to what is swept.

        Raises
        ------
        PlyfoldError
            Naming what failed. That would be a mistake in plyfold.
        """
        for what, holds in _conditions(self):
            if not holds:
                raise PlyfoldError(f"internal check failed: {what}")


def least_homotopy(curve: CurveLike, time_limit: float | None = None, weights: npt.ArrayLike | None = None) -> Homotopy:
    """Find how a closed curve contracts to a point and sweeps the least area, each place counted as often as it is.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry, Arrangement or GaussCode
        Any closed curve. Cusps are left out of account.
    time_limit : float, optional
        Seconds after which the search ends; none by default. The contraction that is returned then is any one, with
        bounds: the least area is between ``lower`` and ``area``, and ``optimal`` is false unless these are the same.
    weights : array_like of float, shape (cells,), optional
        What it costs to sweep each cell of the arrangement once, numbers from 0 on; that of cell 0 is not used. By
        default its area, and 1 where only the code is known.

    Returns
    -------
    Homotopy

    Raises
    ------
    InputError
        If there are several curves, or the weights are not one number from 0 on for each cell.
    TimeLimitError
        If the time ends before the crossings are known.
    MemoryLimitError
        If the costs of all stretches of the word would not fit into memory, and no time limit asks for bounds; or if
        the winding numbers of all loops would not.

    Notes
    -----
    Some contraction that sweeps least cuts the curve at crossings into loops that each bound an immersed disk, and
    contracts one after the other [FKW17]_. What it costs is a question of which letters cancel in a word [Nie14]_, and
    an exact program answers it: O(L² m) time and up to 4 L² bytes for L letters that are left when the word has been
    shortened, of which each may cancel m others. Areas are doubles, and compared as multiples of a unit some 10⁻¹² of
    the whole: contractions that differ by less count as equal. Of a drawing that touches itself they are those of the
    cells that it has when points in contact have moved apart, as ``arrangement.outline.repairs`` says.

    References
    ----------
    .. [FKW17] B. T. Fasy, S. Karakoç, C. Wenk, "On minimum area homotopies of normal curves in the plane",
       arXiv:1707.02251, 2017.
    .. [Nie14] Z. Nie, "On the minimum area of null homotopies of curves traced twice", arXiv:1412.0101, 2014.

    Examples
    --------
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> found = least_homotopy(limacon)
    >>> found.branch_points, found.cuts, found.area == found.winding_area
    (1, (0,), True)
    >>> least_homotopy(GaussCode.parse("1+ 1- / outer 0")).swept.tolist()
    [0, 1, 1]
    """
    clock = Clock(time_limit)
    watch = Watch(clock)
    arranged = curve if isinstance(curve, Arrangement) else watched_arrangement(curve, "perturb", watch)
    arranged = _as_one_curve(arranged)
    costs = _weights(arranged, weights)
    cables = lay_cables(arranged)
    try:
        cuts, optimal = cut_into_disks(arranged, cables, costs, watch), True
    except (TimeLimitError, MemoryLimitError):
        if time_limit is None:
            raise
        cuts, optimal = cut_into_simple_loops(arranged), False
    return _homotopy(arranged, cables, costs, cuts, optimal)


def _as_one_curve(arranged: Arrangement) -> Arrangement:
    """Return the arrangement of one curve, without its cusps."""
    require_one_loop(arranged, "a least homotopy")
    if not arranged.cusp_index.any():
        return arranged
    if arranged.given is None:
        arranged.gauss_code()  # refuses cusps
    return arrange(Curve(arranged.given.points))  # type: ignore[union-attr]


def _weights(arranged: Arrangement, given: npt.ArrayLike | None) -> Floats:
    if given is None:
        weights = np.ones(arranged.n_cells) if arranged.outline is None else _cell_areas(arranged)
    else:
        weights = np.array(given, dtype=np.float64)
        if weights.shape != (arranged.n_cells,) or not (np.isfinite(weights[1:]) & (weights[1:] >= 0)).all():
            raise InputError(f"weights must be {arranged.n_cells} numbers from 0 on, one for each cell")
    weights[0] = 0
    return weights


def _cell_areas(arranged: Arrangement) -> Floats:
    areas = areas_of(arranged)
    return np.asarray(np.maximum(np.ldexp(np.array(areas.rounded), -2 * areas.unit), 0))


def _homotopy(arranged: Arrangement, cables: Cables, weights: Floats, cuts: list[CutVisits], optimal: bool) -> Homotopy:
    parts = parts_between(arranged, cables, cuts)
    loops = _loops(arranged, parts)
    swept = np.abs([loop.winding for loop in loops]).sum(axis=0)
    winds = np.abs(arranged.winding)
    area, winding_area = (fsum((weights * times).tolist()) for times in (swept, winds))
    keeps_sign = bool((swept == winds).all())
    return Homotopy(
        arrangement=arranged,
        weights=weights,
        loops=loops,
        swept=swept,
        area=area,
        lower=area if optimal else winding_area,
        winding_area=winding_area,
        branch_points=arranged.turning_number - 1 if keeps_sign and arranged.winding.min() >= 0 else None,
        optimal=optimal or keeps_sign,
    )


def _loops(arranged: Arrangement, parts: list[Part]) -> tuple[Loop, ...]:
    number = np.empty(arranged.n_borders, dtype=np.int64)
    for place, part in enumerate(parts):
        number[part.borders] = place
    return tuple(
        Loop(
            whole=arranged,
            sign=-1 if part.arrangement.reversed else 1,
            parent=-1 if part.cut is None else int(number[part.cut[1]]),
            crossing=-1 if part.cut is None else int(arranged.crossing_of_visit[part.cut[0]]),
            borders=part.borders,
            winding=part.winding,
            arrangement=part.arrangement,
        )
        for part in parts
    )


# ---- what must hold --------------------------------------------------------------------------------------------------


def _conditions(found: Homotopy) -> Iterator[tuple[str, bool]]:
    """Yield in words what has to hold, and whether it does."""
    arranged, loops = found.arrangement, found.loops
    for loop in loops:
        immersion = find_immersion(loop.arrangement)
        yield "each loop bounds a disk", isinstance(immersion, Immersion) and immersion.is_disk
        immersion.check()  # type: ignore[union-attr]
        yield "each loop winds as its own code says", _winds_as_told(loop)
    yield "each loop is cut off the one that it is said to be", all(_is_cut_off(found, loop) for loop in loops[1:])
    yield "joined again at the cuts, the loops are the curve", _rejoined(found) == list(range(arranged.n_borders))
    winding = np.array([loop.winding for loop in loops])
    yield "the loops wind as the curve does", bool((winding.sum(axis=0) == arranged.winding).all())
    yield "they sweep what is said", bool((np.abs(winding).sum(axis=0) == found.swept).all())
    yield "no cell is swept too rarely", bool((found.swept >= np.abs(arranged.winding)).all())
    swept = fsum((found.swept * found.weights).tolist())
    yield "the area is what they sweep", swept == found.area >= found.lower >= found.winding_area
    yield "a disk is one loop more than branch points", found.branch_points in (None, len(loops) - 1)


def _winds_as_told(loop: Loop) -> bool:
    """Tell whether winding numbers change by one across the loop's borders alone, and are those of its own code."""
    left, right = loop.winding[loop.whole.left_cell], loop.winding[loop.whole.right_cell]
    on_loop = np.zeros(loop.whole.n_borders, dtype=bool)
    on_loop[loop.borders] = True
    same = set(loop.winding.tolist()) == set((loop.sign * loop.arrangement.winding).tolist())
    return same and loop.winding[0] == 0 and bool((left - right == on_loop).all())


def _is_cut_off(found: Homotopy, loop: Loop) -> bool:
    """Tell whether a loop begins at the crossing where it is cut off, and its parent goes on there."""
    visit = int(loop.borders[0])
    is_there = found.arrangement.crossing_of_visit[visit] == loop.crossing
    return is_there and bool((found.loops[loop.parent].borders == found.arrangement.partner[visit]).any())


def _rejoined(found: Homotopy) -> list[int]:
    """Follow the loop with the start, at each cut the loop that is cut off there, and return the borders in order."""
    first, partner = found.arrangement.first_visits, found.arrangement.partner
    visits = {int(visit): int(partner[visit]) for visit in first[list(found.cuts)]}
    crossing = visits | {other: visit for visit, other in visits.items()}
    following: dict[int, int] = {}
    for loop in found.loops:
        following.update(zip(loop.borders.tolist(), np.roll(loop.borders, -1).tolist(), strict=True))
    way: list[int] = []
    border = 0
    while len(way) < found.arrangement.n_borders:
        way.append(border)
        border = following[border]
        border = crossing.get(border, border)
    return way
