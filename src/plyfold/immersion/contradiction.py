"""Why no gluing of the sheets fits: crossings, cusps and bridges whose conditions contradict each other."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.places import places_of_visits
from plyfold.arrays import Ints
from plyfold.clock import NO_LIMIT, Clock
from plyfold.immersion.corners import feet
from plyfold.immersion.gluings import OpenPart, open_around, open_parts
from plyfold.immersion.peeling import OutlineSeams, Peeled, outline_seams, peel, reasons
from plyfold.immersion.search_map import SearchMap, search_map_of
from plyfold.obstruction import Obstruction
from plyfold.sat import minimal_core, solve

__all__ = ["no_gluing"]

# Conflicts after which the solver may give up when it is asked whether one crossing less is a contradiction too.
_EFFORT = 5000
# Above this many crossings, the contradiction that an obstruction names is not made minimal.
_MINIMISE_UP_TO = 300


def no_gluing(arranged: Arrangement, clock: Clock = NO_LIMIT) -> Obstruction:
    """Return the obstruction of an outline whose sheets cannot be glued.

    Its value are visits: at crossings, cusps and feet of bridges around which gluings do not agree, whatever they are.
    They are as few as leaving out one after the other can reach with little effort, and in time.
    """
    search_map = search_map_of(arranged)
    seams = outline_seams(search_map.map)
    visits = sorted({*_visits(search_map, _contradicting(seams, clock)).tolist()})
    where = places_of_visits(arranged, visits)
    sentence = f"No immersion: {_in_words(arranged, visits)} contradict each other."
    return Obstruction("no gluing", sentence, where, tuple(visits), arranged)


def _contradicting(seams: OutlineSeams, clock: Clock) -> Ints:
    """Return crossings and feet that contradict each other, given the names of the sheets alone."""
    known = peel(seams)
    first = [known.failed] if known.is_contradiction else _contradicting_where_open(seams, known, clock)
    concerned = reasons(seams, known, first)
    named = peel(replace(seams, around=seams.around[:0], bottom=seams.bottom[:0]))
    return np.array(_core(open_around(seams, named, concerned), clock))


def _contradicting_where_open(seams: OutlineSeams, known: Peeled, clock: Clock) -> list[int]:
    """Return crossings and feet that contradict each other, given all that is known."""
    part = next(part for part in open_parts(seams, known) if solve(part.clauses(), clock) is None)
    return _core(part, clock)


def _core(part: OpenPart, clock: Clock) -> list[int]:
    """Return crossings and feet of a part whose conditions contradict each other, as few as possible."""
    fresh = count(part.n_variables + 1)
    given = list(part.of_seams(fresh))
    demands = [list(part.of_meeting(number, fresh)) for number in part.meetings.tolist()]
    core: list[int] = part.meetings[minimal_core(demands, given, clock, _EFFORT, _MINIMISE_UP_TO)].tolist()
    return core


def _visits(search_map: SearchMap, meetings: Ints) -> Ints:
    """Return a visit of the outline at each crossing or foot of the search map: at crossings the first one."""
    visits = search_map.visits_at(np.append(np.flatnonzero(search_map.map.ccw), feet(search_map.map))[meetings])
    return np.minimum(visits, search_map.arrangement.partner[visits])


def _in_words(arranged: Arrangement, visits: list[int]) -> str:
    marks = [visit for visit in visits if arranged.partner[visit] == visit]
    cusps = sum(bool(arranged.cusp_index[visit]) for visit in marks)
    numbers = {"crossing": len(visits) - len(marks), "cusp": cusps, "foot of a bridge": len(marks) - cusps}
    plural = {"foot of a bridge": "feet of bridges"}
    named = [f"{n} {what if n == 1 else plural.get(what, what + 's')}" for what, n in numbers.items() if n]
    return "the gluings around " + " and ".join(named)
