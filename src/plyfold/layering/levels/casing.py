"""Layerings from a cased curve: over and under given at every crossing, the surface follows in one pass.

Over each cell, number the sheets 1 … w from below. Every gluing keeps the order, so it is determined by the level that
it misses: that of the border's own sheet. Past a crossing the strand below keeps its level, for the one above it does
not matter; the strand above loses a level if it leaves the other one's left side, and gains one if it enters it. So
walking along the curve gives all levels, from a border of the unbounded cell, where there is only one. At a cusp the
casing does not say whether the surface climbs or falls, and of several loops not where each begins: then the equations
are solved all together.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement, watched_arrangement
from plyfold.arrangement.base_visit import borders_numbered_back
from plyfold.arrangement.places import places_of_crossings, places_of_visits
from plyfold.arrays import Bools, Ints
from plyfold.clock import Clock, Watch
from plyfold.errors import InputError, TimeLimitError
from plyfold.immersion.obstructions import visible_obstruction
from plyfold.layering.layering import Layering, borders_beside_top, layering_of_levels
from plyfold.layering.levels.equations import (
    LevelClauses,
    level_clauses,
    no_levels,
    solve_levels,
)
from plyfold.layering.orders.search import undecided
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.given import OutlineLike
from plyfold.wording import counted

__all__ = ["casing_of_visits", "embed_cased"]

_QUESTION = "whether there is a layered surface with this casing"


def embed_cased(
    curve: OutlineLike, over: npt.ArrayLike, time_limit: float | None = None
) -> Layering | Obstruction | Unknown:
    """Lift a cased curve: over and under are given at every crossing, as in a picture of a knot with gaps.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such
        One curve bounds a disk, perhaps with handles; several loops bound one surface, with holes and handles, perhaps
        in several pieces.
    over : array_like of bool, shape (k,), (2k,) or (visits,)
        For each crossing of ``arrange(curve)``, whether the strand passes over the other one at the first of its two
        visits; or for each visit to a crossing, whether it does so there; or for each visit, false at cusps and at the
        feet of bridges, as :attr:`Layering.casing <plyfold.Layering.casing>` has it.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    Layering or Obstruction or Unknown
        The only layered surface with this casing, over an immersion of its own; or the reason why there is none: the
        turning number, a negative winding number, an impossible cusp, or ``"casing"``: the first crossing (``value``)
        along the curve, from a border of the unbounded cell, at which the levels do not agree with what is given. Of
        several loops, or with cusps, ``value`` names crossings and cusps at which no levels fit together, as in
        :func:`~plyfold.find_embedding`, and the reason is ``"no embedding"``.

    Raises
    ------
    InputError
        If ``over`` has the wrong length, or both strands or none are to pass over at some crossing; or if several
        surfaces have this casing: it does not determine the level of a loop that lies in others without crossing them,
        nor whether the surface climbs or falls at a cusp. Where the rest leaves only one choice, that is the answer;
        ``embeddings(curve, over)`` lists them all.

    Notes
    -----
    One pass, O(k), and O(Σ w) to write down the immersion [EM09]_ (theorem 1). Of several loops, or with cusps, a SAT
    problem.

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
    obstruction = visible_obstruction(arranged)
    if obstruction is not None:
        return obstruction
    if arranged.n_loops > 1 or len(arranged.crossing_visits) < len(casing):
        return _embed_by_equations(arranged, casing, clock)
    start = int(np.flatnonzero(arranged.winding[arranged.left_cell] == 1)[0])
    level = _levels_along(arranged, casing, start)
    obstruction = _first_fault(arranged, casing, level, start)
    return layering_of_levels(arranged, level) if obstruction is None else obstruction


def _embed_by_equations(arranged: Arrangement, casing: Bools, clock: Clock) -> Layering | Obstruction | Unknown:
    clauses = level_clauses(arranged, casing)
    try:
        level = solve_levels(clauses, clock)
        other = None if level is None else _other_solution(clauses, level, clock)
    except TimeoutError:
        return undecided("time limit", _QUESTION, clock)
    if level is None:
        return no_levels(arranged, clauses, clock)
    level = borders_numbered_back(arranged, level)
    if other is not None:
        raise _not_determined(arranged, level, borders_numbered_back(arranged, other))
    return layering_of_levels(arranged, level)


def _other_solution(clauses: LevelClauses, level: Ints, clock: Clock) -> Ints | None:
    """Return other levels with the same casing, if there are any. Raises TimeoutError when the time is over."""
    differing = clauses.other_than(level)
    return solve_levels(clauses, clock, [differing]) if differing else None


def _not_determined(arranged: Arrangement, level: Ints, other: Ints) -> InputError:
    """Return the error that other levels have the same casing: at some cusps they climb or fall the other way."""
    change, other_change = (found[arranged.border_after] - found[arranged.border_before] for found in (level, other))
    cusps = np.flatnonzero((arranged.cusp_index > 0) & (change != other_change))
    loops = np.unique(arranged.loop_of_border[level != other]).tolist()
    if len(cusps):
        open_choice = f"whether the surface climbs or falls at {counted(len(cusps), 'cusp')}"
        places = places_of_visits(arranged, cusps.tolist())
    else:
        open_choice = f"the level of curve {', '.join(map(str, loops))}"
        given = arranged.given
        places = tuple((x, y) for x, y in given.points[given.first_point[loops]].tolist()) if given else ()
    return InputError(
        f"several surfaces have this casing: it does not determine {open_choice}",
        where=places,
        hint="embeddings(curves, over) lists them all",
    )


def casing_of_visits(arranged: Arrangement, over: npt.ArrayLike) -> Bools:
    """Return over and under by visits, from any form; refuse anything else."""
    given = np.array(over, ndmin=1)
    visits, at_crossings, k = len(arranged.partner), arranged.crossing_visits, arranged.n_crossings
    if given.ndim != 1 or len(given) not in (k, 2 * k, visits) or not np.isin(given, [0, 1]).all():
        raise InputError(
            f"over and under must be {k} truth values, one for each crossing, or {visits}, one for each visit"
        )
    casing = given.astype(bool)
    if len(casing) < visits:
        by_visit = np.zeros(visits, dtype=bool)
        first_visit = (np.arange(visits) < arranged.partner)[at_crossings]
        passes = casing if len(casing) == 2 * k else casing[arranged.crossing_of_visit[at_crossings]] == first_visit
        by_visit[at_crossings] = passes
        casing = by_visit
    _refuse_ambiguous(arranged, casing)
    return casing


def _refuse_ambiguous(arranged: Arrangement, casing: Bools) -> None:
    is_mark = arranged.crossing_of_visit < 0
    if casing[is_mark].any():
        raise InputError(
            f"visit {int(np.flatnonzero(casing & is_mark)[0])} is to pass over, and is a cusp or the foot of a bridge",
            hint="give false there",
        )
    same = np.flatnonzero((casing == casing[arranged.partner]) & ~is_mark)
    if len(same):
        crossing = int(arranged.crossing_of_visit[same[0]])
        raise InputError(
            f"at crossing {crossing} {'both strands pass' if casing[same[0]] else 'no strand passes'} over",
            where=places_of_crossings(arranged, [crossing]),
            hint="one of the two visits must be over, and the other one under",
        )


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
    return Obstruction("casing", sentence, places_of_crossings(arranged, [crossing]), crossing, arranged)
