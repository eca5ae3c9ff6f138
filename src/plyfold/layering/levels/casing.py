"""Layerings from a cased curve: over and under given at every crossing, the surface follows in one pass.

Over each cell, number the sheets 1 … w from below. Every gluing keeps the order, so it is determined by the level that
it misses: that of the border's own sheet. Past a crossing the strand below keeps its level, for the one above it does
not matter; the strand above loses a level if it leaves the other one's left side, and gains one if it enters it. So
walking along the curve gives all levels, from a border of the unbounded cell, where there is only one.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement, watched_arrangement
from plyfold.arrays import Bools, Ints
from plyfold.clock import Clock, Watch
from plyfold.errors import InputError, TimeLimitError
from plyfold.layering.layering import Layering, borders_beside_top, layering_of_levels
from plyfold.layering.levels.equations import (
    LevelClauses,
    level_clauses,
    no_levels,
    no_surface,
    solve_levels,
)
from plyfold.layering.orders.search import undecided
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.curve import OutlineLike

__all__ = ["casing_of_visits", "embed_cased"]

_QUESTION = "whether there is a layered surface with this casing"


def embed_cased(
    curve: OutlineLike, over: npt.ArrayLike, time_limit: float | None = None
) -> Layering | Obstruction | Unknown:
    """Lift a cased curve: over and under are given at every crossing, as in a picture of a knot with gaps.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such
        One curve bounds a disk, perhaps with handles; several bound one surface, with holes and handles, perhaps in
        several pieces.
    over : array_like of bool, shape (2k,) or (k,)
        For each visit of ``arrange(curve)``, whether the strand passes over the other one; or for each crossing,
        whether it does so at the first of its two visits.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    Layering or Obstruction or Unknown
        The only layered surface with this casing, over an immersion of its own; or the reason why there is none: the
        turning number, a negative winding number, or ``"casing"``: the first crossing (``value``) along the curve,
        from a border of the unbounded cell, at which the levels do not agree with what is given. Of several curves
        ``value`` is a tuple of crossings at which no levels fit together, and the reason ``"no embedding"``.

    Raises
    ------
    InputError
        If ``over`` has the wrong length, or both strands or none are to pass over at some crossing. Of several curves,
        also if several surfaces have this casing: it does not determine the level of a curve that lies in others
        without crossing them. ``embeddings(curves, over)`` lists them all.

    Notes
    -----
    One pass, O(k), and O(Σ w) to write down the immersion [EM09]_ (theorem 1). Of several curves, a SAT problem.

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> layering = embed_cased(ramp, [True, True, False, False])
    >>> layering.casing.tolist()
    [True, True, False, False, False, False, True, True]
    >>> print(embed_cased(ramp, [True, True, False, True]))
    The casing lifts to no surface: past crossing 3, the strand would be on level 0, but there is only level 1.
    """
    clock = Clock(time_limit)
    try:
        return _embed(watched_arrangement(curve, "perturb", Watch(clock)), over, clock)
    except TimeLimitError:
        return undecided("time limit", _QUESTION, clock)


def _embed(arranged: Arrangement, over: npt.ArrayLike, clock: Clock) -> Layering | Obstruction | Unknown:
    casing = casing_of_visits(arranged, over)
    obstruction = no_surface(arranged)
    if obstruction is not None:
        return obstruction
    if arranged.n_loops > 1:
        return _embed_several(arranged, casing, clock)
    start = int(np.flatnonzero(arranged.winding[arranged.left_cell] == 1)[0])
    level = _levels_along(arranged, casing, start)
    obstruction = _first_fault(arranged, casing, level, start)
    return layering_of_levels(arranged, level) if obstruction is None else obstruction


def _embed_several(arranged: Arrangement, casing: Bools, clock: Clock) -> Layering | Obstruction | Unknown:
    clauses = level_clauses(arranged, casing)
    try:
        level = solve_levels(clauses, clock)
        if level is not None:
            _require_only(arranged, clauses, level, clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock)
    return no_levels(arranged, clauses, clock) if level is None else layering_of_levels(arranged, level)


def _require_only(arranged: Arrangement, clauses: LevelClauses, level: Ints, clock: Clock) -> None:
    """Refuse a casing that other levels have as well. Raises TimeoutError when the time is over."""
    differing = clauses.other_than(level)
    other = solve_levels(clauses, clock, [differing]) if differing else None
    if other is not None:
        free = np.unique(arranged.loop_of_border[level != other]).tolist()
        raise InputError(
            f"several surfaces have this casing: it does not determine the level of curve {', '.join(map(str, free))}",
            where=[arranged.curves[loop].points[0] for loop in free],
            hint="embeddings(curves, over) lists them all",
        )


def casing_of_visits(arranged: Arrangement, over: npt.ArrayLike) -> Bools:
    """Return over and under by visits, from either form; refuse anything else."""
    given = np.array(over, ndmin=1)
    visits = len(arranged.partner)
    if given.ndim != 1 or len(given) not in (visits, visits // 2) or not np.isin(given, [0, 1]).all():
        raise InputError(
            f"over and under must be {visits // 2} truth values, one for each crossing, or {visits}, one for each visit"
        )
    casing = given.astype(bool)
    if len(casing) < visits:
        first_visit = np.arange(visits) < arranged.partner
        casing = casing[arranged.crossing_of_visit] == first_visit
    same = np.flatnonzero(casing == casing[arranged.partner])
    if len(same):
        crossing = int(arranged.crossing_of_visit[same[0]])
        raise InputError(
            f"at crossing {crossing} {'both strands pass' if casing[same[0]] else 'no strand passes'} over",
            where=_place(arranged, crossing),
            hint="one of the two visits must be over, and the other one under",
        )
    return casing


def _levels_along(arranged: Arrangement, casing: Bools, start: int) -> Ints:
    """Return the levels of all borders, walking once round from the start border, from level 1.

    The start border has the level at which the walk comes back to it.
    """
    step = np.roll(np.where(casing, np.where(arranged.ccw, -1, 1), 0), -start - 1)
    return np.asarray(np.roll(1 + np.cumsum(step), start + 1) if len(step) else np.ones(1, dtype=np.int64))


def _first_fault(arranged: Arrangement, casing: Bools, level: Ints, start: int) -> Obstruction | None:
    """Return the first crossing along the walk at which the levels are impossible, if there is one."""
    if not len(casing):
        return None
    visit = np.arange(len(casing))
    outside = (level < 1) | (level > arranged.winding[arranged.left_cell])
    at_departure = np.where(visit == start, 1, level)
    top = at_departure[borders_beside_top(arranged)]
    disagree = np.where(casing, top <= top[arranged.partner], top >= top[arranged.partner])
    walked = (visit - start - 1) % len(visit)
    faulty = np.roll(outside | (disagree & (walked > walked[arranged.partner])), -start - 1)
    if not faulty.any():
        return None
    return _fault(arranged, level, (int(faulty.argmax()) + start + 1) % len(visit), outside)


def _fault(arranged: Arrangement, level: Ints, visit: int, outside: Bools) -> Obstruction:
    crossing = int(arranged.crossing_of_visit[visit])
    if outside[visit]:
        most = int(arranged.winding[arranged.left_cell[visit]])
        levels = "is only level 1" if most == 1 else f"are levels 1 to {most}"
        reason = f"past crossing {crossing}, the strand would be on level {level[visit]}, but there {levels}"
    else:
        reason = f"at crossing {crossing}, the strand that is to pass over would not be the higher one"
    sentence = f"The casing lifts to no surface: {reason}."
    return Obstruction("casing", sentence, _place(arranged, crossing), crossing, arranged)


def _place(arranged: Arrangement, crossing: int) -> tuple[tuple[float, float], ...]:
    if not len(arranged.crossings):
        return ()
    x, y = arranged.crossings[crossing].tolist()
    return ((x, y),)
