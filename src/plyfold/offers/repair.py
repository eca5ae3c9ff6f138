"""Small changes that make an outline that of a disk: tiny loops are left out, lenses undone, spikes taken out."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, watched_arrangement
from plyfold.arrays import Floats
from plyfold.clock import Clock, Watch
from plyfold.errors import CurveError, GeneralPositionError, InputError, TimeLimitError
from plyfold.immersion.solve import find_immersion
from plyfold.immersion.verdict import bounds_disk
from plyfold.obstruction import Obstruction, Unknown
from plyfold.offers.areas import Measure
from plyfold.offers.confirmed import confirm
from plyfold.offers.greedy import Aim, Caps, flips, made_until, wholes
from plyfold.offers.redrawn import Pen, pen_for, redrawn, traced
from plyfold.offers.rerouted import Move, Plan, Rerouted, Run, plan_of
from plyfold.offers.unneeded import needed
from plyfold.options import refuse_unless_number
from plyfold.outline.curve import Outline
from plyfold.outline.given import OutlineLike, outline_with
from plyfold.outline.points import Repair, diagonal

__all__ = ["Repaired", "SmallChange", "percent", "repair"]

LOOP, LENS, SPIKE = "loop left out", "lens undone", "spike taken out"

# How much is cut off of the corners of strands that came apart, of the way to what is next: as little as will do, and
# where even rounding is too much, nothing, so that they touch.
_OPENINGS = (Fraction(1, 2**20), Fraction(1, 2**10), Fraction(0))
# Outlines with more crossings are not asked how much would be needed beyond the caps.
_MOST_CROSSINGS = 400
_NO_CAPS = Caps(math.inf, math.inf)


@dataclass(frozen=True)
class SmallChange(Repair):
    """Something that was changed in an outline to make it that of a disk.

    Parameters
    ----------
    kind : str
        ``"loop left out"``, ``"lens undone"`` or ``"spike taken out"``.
    where : (x, y)
        The crossing from which the loop led back to it, the leftmost crossing of the lens, or the tip of the spike.
    size : float
        The diagonal of the box around the loop, the lens or the spike.
    region : float
        The part of the covered area that it covered or uncovered.
    layers : float
        The change of all winding numbers, times the areas, as a part of these.
    polygons : tuple of (m, 2) float
        What it went round: outside of all of them no place has another winding number. How often they wind round a
        place is, exactly, by how much its winding number grew.
    strands : tuple of (m, 2) float
        The loop that was left out, or the two sides of the lens, from crossing to crossing.

    Examples
    --------
    >>> change, = repair([(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)]).changes
    >>> print(change)
    loop left out at (60, 40), size 1.41421
    """

    region: float = 0.0
    layers: float = 0.0
    polygons: tuple[Floats, ...] = field(default=(), repr=False, compare=False)
    strands: tuple[Floats, ...] = field(default=(), repr=False, compare=False)


@dataclass(frozen=True, eq=False)
class Repaired:
    """An outline that was changed a little, and what was changed; true as a truth value.

    Parameters
    ----------
    outline : Outline
        All points stay as they were given, but for those in loops that were left out. Its ``repairs`` name the changes.
    changes : tuple of SmallChange
        In the order in which they were made.
    region_change : float
        The part of the covered area, where the winding number is not 0, that was covered or uncovered.
    layer_change : float
        The change of all winding numbers, each taken times its area, as a part of these.

    Examples
    --------
    >>> found = repair([(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)])
    >>> bool(found), found.outline
    (True, <Curve of 4 points>)
    """

    outline: Outline
    changes: tuple[SmallChange, ...]
    region_change: float
    layer_change: float

    def __repr__(self) -> str:
        done = ", ".join(_counted_changes([change.kind for change in self.changes])) or "nothing changed"
        return f"<Repaired: {done}; {self.region_change:.3g} of the region, {self.layer_change:.3g} of the layers>"

    @property
    def done(self) -> str:
        """What is done, in words: "leaving out 2 loops and undoing 1 lens"."""
        return _doing([change.kind for change in self.changes])

    def __str__(self) -> str:
        done = " and ".join(_counted_changes([change.kind for change in self.changes])) or "nothing changed"
        return f"{done}: {percent(self.region_change)} of the region and {percent(self.layer_change)} of the layers"


def repair(
    outline: OutlineLike, allow: float = 0.01, allow_layers: float = 0.2, time_limit: float | None = None
) -> Repaired | Obstruction | Unknown:
    """Change an outline a little, so that it becomes that of a disk of cloth; one of several loops, that of a surface.

    Outlines of pen strokes, and those of maps, are often no disks by a hair: they run through tiny loops at inner
    corners, or two of their strands have changed sides for a short way. Such a *loop*, from a crossing back to it, is
    left out; two strands that cross twice in a row, around a *lens*, change places.

    Parameters
    ----------
    outline : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
        Cusps stay what they are: no loop with a cusp is left out.
    allow : float, optional
        The part of the covered area that may be covered or uncovered. A place is covered if its winding number is not
        0.
    allow_layers : float, optional
        How much winding numbers may change in all, each change times its area, as a part of all winding numbers times
        their areas. Loops at inner corners often lie where the outline covers itself.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    Repaired or Obstruction or Unknown
        The first one is true. An obstruction has the reason ``"repair"``; its sentence says what would do without
        caps, where that was found: with small changes of the region, of the layers, or of both. Its ``value`` is then
        ``{"region": …, "layers": …}`` of what exceeds the caps least; less may do.

    Raises
    ------
    InputError
        If it is a Gauss code, which has no points, or a cap is no number from 0 on.
    GeneralPositionError
        If strands touch, and cusps that stay hold them together.
    PrecisionError
        If what was drawn covers another area than it should, or not as often. That has not been seen.

    Notes
    -----
    The move comes first that changes the covered area least; of several that change it equally, the one that changes
    the winding numbers least; of these the one furthest left, and lowest. Areas are compared exactly. Two strands
    in one direction change places at no price, so that is tried only where nothing else does. Moves that turn
    out not to be needed are taken back, and what is left is decided anew. So the answer does not depend on the points
    with which the loops begin, on their direction or on the unit; but another, smaller change may do as well.

    O((n + k) log n) for n points, k crossings and small loops: 10⁵ points with 1,000 loops take about a second.

    Examples
    --------
    A rectangle with a tiny loop at a corner:

    >>> found = repair([(0, 0), (60, 0), (60, 41), (61, 41), (61, 40), (0, 40)])
    >>> found
    <Repaired: 1 loop left out; 0.000416 of the region, 0.000416 of the layers>
    >>> found.outline.points.tolist()
    [[0.0, 0.0], [60.0, 0.0], [60.0, 40.0], [0.0, 40.0]]

    Half of a bow-tie would have to go:

    >>> repair([(0, 0), (2, 2), (2, 0), (0, 2)]).value
    {'region': 0.5, 'layers': 0.5}
    """
    for name, cap in (("allow", allow), ("allow_layers", allow_layers)):
        refuse_unless_number(name, cap)
        if not cap >= 0:
            raise InputError(f"{name} must be a number from 0 on, not {cap!r}")
    clock = Clock(time_limit)
    try:
        return _repaired(outline, Caps(float(allow), float(allow_layers)), clock)
    except (TimeoutError, TimeLimitError):
        sentence = f"Whether small changes make it that of a disk is unknown after {clock.spent:.3g} seconds."
        return Unknown("time limit", sentence, {"seconds": clock.spent})


def _repaired(given: OutlineLike, caps: Caps, clock: Clock) -> Repaired | Obstruction:
    drawn = watched_arrangement(given, "perturb", Watch(clock))
    if drawn.outline is None or drawn.given is None:
        raise InputError("a Gauss code has no points to be changed", hint="give the drawing")
    found = _within(drawn, caps, clock)
    if _may_lie_on_either_side(drawn):
        other = _within(watched_arrangement(drawn.given.reversed(), "perturb", Watch(clock)), caps, clock)
        found = min(filter(None, (found, _turned_back(other))), key=_how_much, default=None)
    return _beyond(plan_of(drawn), caps, clock) if found is None else found


def _within(drawn: Arrangement, caps: Caps, clock: Clock) -> Repaired | None:
    """Return the repair of a drawing within the caps."""
    plan = plan_of(drawn)
    found = _found(plan, caps, False, clock)
    return _found(plan, caps, True, clock) if found is None else found


def _may_lie_on_either_side(drawn: Arrangement) -> bool:
    """Tell whether nothing tells inside from outside, and strands touch, which are moved outward."""
    is_directed = drawn.winding.min() == 0 or (drawn.n_loops == 1 and drawn.turning_number != 0)
    return not is_directed and drawn.given is not drawn.outline


def _turned_back(found: Repaired | None) -> Repaired | None:
    """Return the repair of an outline that runs the other way."""
    if found is None:
        return None
    changes = tuple(replace(change, polygons=tuple(way[::-1] for way in change.polygons)) for change in found.changes)
    kept = [repair for repair in found.outline.repairs if repair not in found.changes]
    return replace(found, outline=outline_with(found.outline.reversed(), repairs=(*kept, *changes)), changes=changes)


def _how_much(found: Repaired) -> tuple[float, float]:
    return found.region_change, found.layer_change


@dataclass(eq=False)
class _Trial:
    """Draws what is left of an outline, and decides it anew; keeps the last one that was as wanted."""

    plan: Plan
    clock: Clock
    pen: Pen | None = None
    outline: Outline | None = None

    def __call__(self, left: Rerouted) -> bool:
        for opening in _OPENINGS if left.parted else _OPENINGS[-1:]:
            pen = pen_for(self.plan.drawn, opening)
            try:
                outline = redrawn(pen, left)
                is_wanted = _is_wanted(outline, self.clock)
            except (CurveError, GeneralPositionError):
                continue
            if is_wanted:
                self.pen, self.outline = pen, outline
                return True
        return False


def _is_wanted(outline: Outline, clock: Clock) -> bool:
    """Tell whether an outline of one loop bounds a disk; one of several, a surface."""
    if outline.n_loops == 1:
        return bounds_disk(outline)
    found = find_immersion(outline, time_limit=clock.left)
    if isinstance(found, Unknown):
        raise TimeoutError
    return bool(found)


def _found(plan: Plan, caps: Caps, all_lenses: bool, clock: Clock) -> Repaired | None:
    trial = _Trial(plan, clock)
    made = made_until(plan, Aim(caps, all_lenses), trial, clock)
    if made is None:
        return None
    moves = needed(plan, caps, made, trial, clock)
    assert trial.pen is not None
    assert trial.outline is not None
    before = [repair for repair in trial.pen.given.repairs if repair.kind != SPIKE]
    changes, left = _changes(plan, trial.pen, moves)
    anew = watched_arrangement(trial.outline, "perturb", Watch(clock))
    confirm(left, anew, trial.pen.opening, tuple(change.where for change in changes))
    changes = (*_spikes(trial.pen.given), *changes)
    return Repaired(outline_with(trial.outline, repairs=(*before, *changes)), changes, *_in_all(plan, left))


def _spikes(given: Outline) -> list[SmallChange]:
    return [SmallChange(SPIKE, repair.where, repair.size) for repair in given.repairs if repair.kind == SPIKE]


def _changes(plan: Plan, pen: Pen, moves: Sequence[Move]) -> tuple[tuple[SmallChange, ...], Rerouted]:
    """Make some moves; return what they changed, and what is left."""
    left, changes, whole = Rerouted.of(plan), [], wholes(plan)
    for move in moves:
        effect = left.effect(move)
        region, layers = _parts(plan, whole, left.winding, effect.times)
        strands = tuple(_strand(pen, left, run) for run in move.runs)
        size, where = diagonal(np.concatenate(strands)), min(pen.crossing(visit) for visit in move.visits)
        polygons = traced(pen, left, move, effect)
        changes.append(SmallChange(LENS if move.is_lens else LOOP, where, size, region, layers, polygons, strands))
    return tuple(changes), left


def _strand(pen: Pen, left: Rerouted, run: Run) -> Floats:
    inside = pen.along(left.darts(run), left.parted, False).places
    return np.concatenate([[pen.crossing(run.start)], inside, [pen.crossing(run.end)]])


def _in_all(plan: Plan, left: Rerouted) -> tuple[float, float]:
    """Return what all moves together changed, as :func:`_parts` does."""
    given = plan.drawn.winding.tolist()
    pairs = enumerate(zip(given, left.winding, strict=True))
    return _parts(plan, wholes(plan), given, {cell: now - then for cell, (then, now) in pairs if now != then})


def _parts(
    plan: Plan, whole: tuple[Measure, Measure], winding: list[int], times: Mapping[int, int]
) -> tuple[float, float]:
    """Return which part of the covered area a change covers or uncovers, and which part of all layers it changes."""
    covered, layers = (measure.rounded for measure in whole)
    changed = _area(plan, flips(winding, times)), _area(plan, {cell: abs(more) for cell, more in times.items()})
    return (changed[0] / covered, changed[1] / layers) if covered else (0.0, 0.0)


def _area(plan: Plan, times: Mapping[int, int]) -> float:
    return Measure.of(plan.areas, times).rounded


# ---- why there is none -----------------------------------------------------------------------------------------------


def _beyond(plan: Plan, caps: Caps, clock: Clock) -> Obstruction:
    """Return how much would have to be changed, as far as that is easily found."""
    what = "a disk" if plan.drawn.n_loops == 1 else "a surface"
    may = f"{percent(caps.region)} of the region and {percent(caps.layers)} of the layers may change"
    ways = sorted(_ways_beyond(plan, clock), key=partial(_excess, caps))
    if not ways:
        sentence = f"Leaving out loops and undoing lenses does not make it the outline of {what} where {may}."
        return Obstruction("repair", sentence, (), None, plan.drawn)
    named = ways[:1] + [way for way in ways[1:] if not _is_no_less(way, ways[0])]
    sentence = f"It would be the outline of {what} with {', or with '.join(map(_in_words, named))}; {may}."
    where = tuple(change.where for change in ways[0].changes)
    value = {"region": ways[0].region, "layers": ways[0].layers}
    return Obstruction("repair", f"{sentence} Less may do, too.", where, value, plan.drawn)


class _Way(NamedTuple):
    """What makes a surface, whatever it changes."""

    changes: tuple[SmallChange, ...]
    region: float
    layers: float


def _ways_beyond(plan: Plan, clock: Clock) -> list[_Way]:
    """Return what would do without caps: changing little of the region, and changing little of the layers."""
    if plan.drawn.n_crossings > _MOST_CROSSINGS:
        return []
    with suppress(TimeoutError, TimeLimitError):
        return [way for layers_first in (False, True) if (way := _way_beyond(plan, clock, layers_first))]
    return []


def _way_beyond(plan: Plan, clock: Clock, layers_first: bool) -> _Way | None:
    trial = _Trial(plan, clock)
    made = made_until(plan, Aim(_NO_CAPS, False, layers_first), trial, clock)
    if made is None:
        return None
    moves = needed(plan, _NO_CAPS, made, trial, clock)
    assert trial.pen is not None
    changes, left = _changes(plan, trial.pen, moves)
    return _Way(changes, *_in_all(plan, left))


def _excess(caps: Caps, way: _Way) -> tuple[float, float, float]:
    """Return by what factor a way is beyond the caps, and what it changes."""
    parts = zip((way.region, way.layers), caps, strict=True)
    factor = max(part / cap if cap else math.inf if part else 0.0 for part, cap in parts)
    return factor, way.region, way.layers


def _is_no_less(one: _Way, other: _Way) -> bool:
    return one.region >= other.region and one.layers >= other.layers


def _in_words(way: _Way) -> str:
    done = " and ".join(_counted_changes([change.kind for change in way.changes]))
    return f"{done}, which changes {percent(way.region)} of the region and {percent(way.layers)} of the layers"


def percent(part: float) -> str:
    """Return a part as people read it.

    Examples
    --------
    >>> percent(0.000416), percent(0.5)
    ('0.0416%', '50%')
    """
    return f"{100 * part:.3g}%"


def _counted_changes(kinds: Sequence[str]) -> list[str]:
    """Return how many changes there are of each kind, in words.

    Examples
    --------
    >>> _counted_changes(["lens undone", "loop left out", "loop left out"])
    ['2 loops left out', '1 lens undone']
    """
    plural = {LOOP: "loops left out", LENS: "lenses undone", SPIKE: "spikes taken out"}
    number = {kind: kinds.count(kind) for kind in plural}
    return [f"{count} {kind if count == 1 else plural[kind]}" for kind, count in number.items() if count]


def _doing(kinds: Sequence[str]) -> str:
    """Say what is done.

    Examples
    --------
    >>> _doing(["lens undone", "loop left out", "loop left out"])
    'leaving out 2 loops and undoing 1 lens'
    """
    words = {LOOP: ("leaving out", "loop", "loops"), LENS: ("undoing", "lens", "lenses")}
    words |= {SPIKE: ("taking out", "spike", "spikes")}
    number = {kind: kinds.count(kind) for kind in words}
    return " and ".join(
        f"{doing} {number[kind]} {one if number[kind] == 1 else many}"
        for kind, (doing, one, many) in words.items()
        if number[kind]
    )
