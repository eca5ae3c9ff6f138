"""What is left of an outline after loops are left out and lenses undone: other ways along the borders of its drawing.

Nothing is arranged anew: the cells stay those of the drawing, and each move changes their winding numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.lobes import quarter_turns
from plyfold.arrays import Ints
from plyfold.graphs import spanning_tree
from plyfold.mesh.refine import borders_at_points, drawn_outline
from plyfold.offers.areas import CellAreas, Measure, areas_of

__all__ = ["Effect", "Move", "Plan", "Rerouted", "Run", "plan_of"]


# What is narrower than so many roundings of coordinates.
_HAIR = 2.0**10
# Walks through more cells, and a part of all cells, take longer than numbers for all cells at once.
_FEW_CELLS, _CELLS_AT_ONCE = 16, 256
_ANY = (float("inf"), float("inf"))


class Run(NamedTuple):
    """A part of the outline, from one visit on to another."""

    start: int
    end: int


class Move(NamedTuple):
    """What is done to some runs: a single one is left out, from a crossing back to it; two change places.

    These two cross at both of their ends and nowhere between.
    """

    runs: tuple[Run, ...]

    @property
    def is_lens(self) -> bool:
        """Whether two runs change places."""
        return len(self.runs) == 2

    @property
    def visits(self) -> tuple[int, ...]:
        """The visits at the ends of the runs."""
        return tuple(visit for strand in self.runs for visit in strand)


class Effect(NamedTuple):
    """By how much a move changes the winding number of each cell; and the cells along its runs.

    Between two runs these are the cells between them, each as often as the way round goes round it. ``is_all`` is
    false if only some are there, since they are too large.
    """

    times: dict[int, int]
    inside: dict[int, int]
    is_all: bool


@dataclass(frozen=True, eq=False)
class Plan:
    """A drawing as lists, for walks along its borders and through its cells.

    Parameters
    ----------
    drawn : Arrangement
    areas : CellAreas
    partner, border_after, border_before, loop : list of int
        Of each visit.
    next_border, left, right : list of int
        Of each border.
    cusps : list of int
        How many cusps come before each visit along its loop and the earlier ones; last, all of them.
    parent, link : list of int
        Of each cell, the one before it on a way to the unbounded one, and a border between the two.
    """

    drawn: Arrangement
    areas: CellAreas
    partner: list[int]
    border_after: list[int]
    border_before: list[int]
    loop: list[int]
    next_border: list[int]
    left: list[int]
    right: list[int]
    cusps: list[int]
    parent: list[int]
    link: list[int]

    @cached_property
    def cells(self) -> tuple[tuple[int, ...], ...]:
        """The darts round each cell."""
        return self.drawn.cells

    def places(self, strand: Run) -> Iterator[int]:
        """Yield the borders of the drawing from one visit on to another one of its loop."""
        border, last = self.border_after[strand.start], self.border_before[strand.end]
        yield border
        while border != last:
            border = self.next_border[border]
            yield border

    @cached_property
    def tour(self) -> tuple[Ints, Ints, Ints]:
        """A walk into all cells from those before them on ways to the unbounded one, and back out of each.

        The borders passed, whether to their left (1) or to their right (−1), and at which step each cell is entered.
        """
        children: list[list[int]] = [[] for _ in self.parent]
        for cell in range(1, len(self.parent)):
            children[self.parent[cell]].append(cell)
        steps, entered, waiting = [], [0] * len(self.parent), [0]
        while waiting:
            cell = waiting.pop()
            if cell < 0:
                steps.append((self.link[~cell], 1 if self.right[self.link[~cell]] == ~cell else -1))
                continue
            entered[cell] = len(steps)
            steps.append((self.link[cell], 1 if self.left[self.link[cell]] == cell else -1))
            waiting += [~cell, *children[cell]]
        # The unbounded cell is entered through no border.
        steps[0] = (0, 0)
        border, sign = np.array(steps).T
        return border, sign, np.array(entered)

    def has_cusp(self, run: Run) -> bool:
        """Tell whether a cusp lies on a strand."""
        start, end = run
        before_start, before_end = self.cusps[start], self.cusps[end]
        if start < end:
            return before_end > before_start
        first, last = self.drawn.first_visit[self.loop[start] : self.loop[start] + 2].tolist()
        return bool(self.cusps[last] > before_start or before_end > self.cusps[first])

    @cached_property
    def leftmost(self) -> list[int]:
        """For each loop the border with its leftmost point, the lowest of several."""
        outline = drawn_outline(self.drawn)
        border = borders_at_points(self.drawn)[1]
        x, y = outline.points.T
        loop = self.drawn.loop_of_border[border]
        order = np.lexsort((y, x, loop))
        first: list[int] = border[order[np.unique(loop[order], return_index=True)[1]]].tolist()
        return first

    def has_leftmost(self, strand: Run) -> bool:
        """Tell whether the leftmost point of a loop is on a strand of it."""
        return self.leftmost[self.loop[strand.start]] in self.places(strand)

    def length(self, strand: Run) -> float:
        """Return how long the straight way from end to end of a strand is, in the unit of areas."""
        drawn = self.drawn
        start, end = self.areas.places[drawn.crossing_of_visit[[*strand]] - drawn.n_crossings]
        return float(np.hypot(*(end - start)))

    def narrow(self, length: float) -> float:
        """Return the area of what is so long and as narrow as rounding."""
        width = _HAIR * self.areas.grain
        return width * (length + width)

    def is_hair(self, strand: Run, ways: Sequence[list[int]], inside: Mapping[int, int]) -> bool:
        """Tell whether two ways from end to end of a strand are so near a straight one that rounding may confuse them.

        So are the cells between them, and what lies between each and a straight way, all together: what is cut off if
        both are cut short is as little as what the corners are off when rounded.
        """
        areas, narrow = self.areas, self.narrow(self.length(strand))
        between = Measure.of(areas, {cell: abs(times) for cell, times in inside.items()})
        return between.most <= narrow and all(areas.swept(way) <= narrow for way in ways if way)


def plan_of(drawn: Arrangement) -> Plan:
    """Return a drawing as lists."""
    parent, link, _ = spanning_tree(drawn.n_cells, drawn.left_cell, drawn.right_cell)
    return Plan(
        drawn=drawn,
        areas=areas_of(drawn),
        partner=drawn.partner.tolist(),
        border_after=drawn.border_after.tolist(),
        border_before=drawn.border_before.tolist(),
        loop=drawn.loop_of_border[drawn.border_after].tolist(),
        next_border=drawn.next_border.tolist(),
        left=drawn.left_cell.tolist(),
        right=drawn.right_cell.tolist(),
        cusps=np.append(0, np.cumsum(drawn.cusp_index > 0)).tolist(),
        parent=parent.tolist(),
        link=link.tolist(),
    )


@dataclass(eq=False)
class Rerouted:
    """An outline on its way, changed by every move.

    Parameters
    ----------
    plan : Plan
    winding : list of int
        Of each cell of the drawing.
    path : list of list of int
        The darts that are passed in place of each border of the drawing: itself at first.
    quarters : list of int
        How many quarters the outline turns there, its corner with what comes next included.
    turning : int
        How often the whole outline turns, cusps taken off.
    after, before : list of int
        For each visit that is still one the next and the previous of its loop. The feet of bridges count for nothing.
    is_live : list of bool
    parted : set of int
        The crossings at which two runs touch now, and are to come apart.
    cut_short : float
        How long all strands are, from end to end, that were cut short, in the unit of areas.
    """

    plan: Plan
    winding: list[int]
    path: list[list[int]]
    quarters: list[int]
    turning: int
    after: list[int]
    before: list[int]
    is_live: list[bool]
    parted: set[int]
    cut_short: float = 0.0

    @classmethod
    def of(cls, plan: Plan) -> Rerouted:
        """Return the outline as it is drawn."""
        drawn = plan.drawn
        is_live = (drawn.crossing_of_visit >= 0) | (drawn.cusp_index > 0)
        after, before = np.full((2, len(drawn.partner)), -1)
        for first, last in zip(drawn.first_visit[:-1], drawn.first_visit[1:], strict=True):
            live = first + np.flatnonzero(is_live[first:last])
            after[live], before[live] = np.roll(live, -1), np.roll(live, 1)
        return cls(
            plan=plan,
            winding=drawn.winding.tolist(),
            path=[[2 * border] for border in range(drawn.n_borders)],
            quarters=quarter_turns(drawn).tolist(),
            turning=drawn.euler_characteristic,
            after=after.tolist(),
            before=before.tolist(),
            is_live=is_live.tolist(),
            parted=set(),
        )

    # ---- what can be done --------------------------------------------------------------------------------------------

    def can_be_done(self, move: Move) -> bool:
        """Tell whether a move that once was possible still is."""
        if not all(self.is_live[visit] for visit in move.visits):
            return False
        return not move.is_lens or all(self.after[strand.start] == strand.end for strand in move.runs)

    def lenses_at(self, visit: int) -> Iterator[Move]:
        """Yield the lenses of which a strand begins at a visit: two where the other loop has these crossings alone."""
        partner, end = self.plan.partner, self.after[visit]
        start, last = partner[visit], partner[end]
        if partner[end] == end or start == visit or len({visit, start, end, last}) < 4:
            return
        for other in (Run(start, last), Run(last, start)):
            if self.after[other.start] == other.end:
                yield Move(tuple(sorted([Run(visit, end), other])))

    def runs_back(self, lens: Move) -> bool:
        """Tell whether the two runs of a lens run against each other."""
        return self.plan.partner[lens.runs[0].start] == lens.runs[1].end

    def darts(self, strand: Run) -> list[int]:
        """Return the darts along a strand."""
        return [dart for place in self.plan.places(strand) for dart in self.path[place]]

    def effect(self, move: Move, most: tuple[float, float] = _ANY) -> Effect:
        """Return what a move would do to winding numbers; not all of it if more would be changed: (region, layers)."""
        if not move.is_lens:
            times, is_all = self._wound(self._ways(move.runs[0], -1), 1, most)
            return Effect(times, times, is_all)
        one, other = move.runs
        # Backward along the first run, round what lies between the two.
        is_back = self.runs_back(move)
        ways = self._ways(one, -1) | self._ways(other, -1 if is_back else 1)
        inside, is_all = self._wound(ways, 2 if is_back else 0, most)
        return Effect({cell: 2 * times for cell, times in inside.items()} if is_back else {}, inside, is_all)

    def _wound(self, ways: Mapping[int, int], factor: int, most: tuple[float, float]) -> _Wound:
        return _wound(self.plan, ways, _Changed(self.plan, self.winding, factor), most)

    def _ways(self, strand: Run, way: int) -> dict[int, int]:
        """Return how often a strand passes borders forward, times ``way``."""
        return {dart // 2: -way if dart % 2 else way for dart in self.darts(strand)}

    def is_thin(self, lens: Move, inside: Mapping[int, int]) -> bool:
        """Tell whether what lies between the runs of a lens is on its inner side, given the cells there.

        If not, the rest of the drawing lies between them.
        """
        start = lens.runs[0].start
        dart = self.path[self.plan.border_after[start]][0]
        is_left = bool(self.plan.drawn.ccw[start]) != self.runs_back(lens)
        side = self.plan.left if is_left == (dart % 2 == 0) else self.plan.right
        return side[dart // 2] in inside

    # ---- doing it ----------------------------------------------------------------------------------------------------

    def make(self, move: Move, effect: Effect) -> set[int]:
        """Make a move, given its effect; return visits with new neighbours. Some of these may be none any more."""
        for cell, times in effect.times.items():
            self.winding[cell] += times
        ended = self._swap(move, effect.inside) if move.is_lens else self._leave_out(move.runs[0])
        return {beside for visit in ended for beside in self._end_visit(visit)}

    def _swap(self, lens: Move, inside: Mapping[int, int]) -> list[int]:
        """Let two runs change places; return the visits that are none any more.

        Strands that are too near each other to be told apart after rounding are cut short instead.
        """
        one, other = lens.runs
        ways = [self.darts(strand) for strand in (other, one)]
        if self.runs_back(lens):
            ways = [[dart ^ 1 for dart in reversed(way)] for way in ways]
        is_hair = self.plan.is_hair(one, ways, inside)
        self.cut_short += 2 * self.plan.length(one) * is_hair
        for strand, way in zip((one, other), ways, strict=True):
            for place in self.plan.places(strand):
                self.path[place] = []
            self.path[self.plan.border_after[strand.start]] = [] if is_hair else way
        self.parted.update(self.plan.drawn.crossing_of_visit[[*one]].tolist())
        return [*one, *other]

    def _leave_out(self, lobe: Run) -> list[int]:
        """Leave out a strand from a crossing back to it; return the visits that are none any more."""
        start, end = lobe
        corner = 1 if self.plan.drawn.ccw[end] else -1
        turns = corner
        for place in self.plan.places(lobe):
            self.path[place] = []
            turns += self.quarters[place]
            self.quarters[place] = 0
        # What is left turns at the crossing the other way.
        self.quarters[self.plan.border_before[start]] -= corner
        self.turning -= turns // 4
        return self.visits_in(lobe)

    def visits_in(self, lobe: Run) -> list[int]:
        """Return the visits along a lobe, and those of other strands there."""
        visits = [lobe.start]
        while visits[-1] != lobe.end:
            visits.append(self.after[visits[-1]])
        return [each for visit in visits for each in {visit, self.plan.partner[visit]}]

    def _end_visit(self, visit: int) -> tuple[int, int]:
        """Let a visit be none any more; return those beside it."""
        before, after = self.before[visit], self.after[visit]
        if self.is_live[visit]:
            self.is_live[visit] = False
            self.after[before], self.before[after] = after, before
        return before, after


# ---- winding numbers -------------------------------------------------------------------------------------------------


class _Wound(NamedTuple):
    """How often closed ways go round cells: of those where that is not 0.

    ``is_all`` is false if the walk through the cells was ended since they are too large.
    """

    times: dict[int, int]
    is_all: bool


@dataclass(eq=False)
class _Changed:
    """How much is surely changed where winding numbers grow by so many for each time that ways go round a cell."""

    plan: Plan
    winding: list[int]
    factor: int
    region: float = 0.0
    layers: float = 0.0

    def add(self, cell: int, times: int) -> None:
        """Take in how often ways go round a cell."""
        area, more = self.plan.areas.rounded[cell] - self.plan.areas.error[cell], self.factor * times
        self.layers += abs(more) * area
        if (self.winding[cell] != 0) != (self.winding[cell] + more != 0):
            self.region += area

    def is_more_than(self, most: tuple[float, float]) -> bool:
        """Tell whether too much is changed: (region, layers)."""
        return self.region > most[0] or self.layers > most[1]


def _wound(plan: Plan, ways: Mapping[int, int], changed: _Changed, most: tuple[float, float]) -> _Wound:
    """Return how often closed ways go round each cell, given how often they pass borders forward.

    Parameters
    ----------
    plan : Plan
    ways : mapping from border to int
    changed : _Changed
        Nothing yet.
    most : (region, layers)
        End when surely more is changed.

    Notes
    -----
    A walk through the cells that the ways go round; if these are many, all cells at once.
    """
    known = {0: 0}
    times: dict[int, int] = {}
    for border in ways:
        waiting = [_toward_the_outside(plan, ways, side[border], known) for side in (plan.left, plan.right)]
        while waiting:
            cell = waiting.pop()
            number = known[cell]
            if number == 0 or cell in times:
                continue
            times[cell] = number
            changed.add(cell, number)
            if changed.is_more_than(most):
                return _Wound(times, False)
            if len(times) > _FEW_CELLS + plan.drawn.n_cells // _CELLS_AT_ONCE:
                return _up_to(_wound_everywhere(plan, ways), replace(changed, region=0.0, layers=0.0), most)
            for dart in plan.cells[cell]:
                beyond = (plan.left if dart % 2 else plan.right)[dart // 2]
                if beyond not in times:
                    jump = ways.get(dart // 2, 0)
                    known[beyond] = number + (jump if dart % 2 else -jump)
                    waiting.append(beyond)
    return _Wound(times, True)


def _up_to(wound: Mapping[int, int], changed: _Changed, most: tuple[float, float]) -> _Wound:
    """Return how often ways go round cells; only some of these if surely too much is changed there."""
    times = {}
    for cell, number in wound.items():
        times[cell] = number
        changed.add(cell, number)
        if changed.is_more_than(most):
            return _Wound(times, False)
    return _Wound(times, True)


def _wound_everywhere(plan: Plan, ways: Mapping[int, int]) -> dict[int, int]:
    """Return how often closed ways go round each cell where that is not 0, in the order of the cells."""
    jump = np.zeros(plan.drawn.n_borders, dtype=np.int64)
    jump[list(ways)] = list(ways.values())
    border, sign, entered = plan.tour
    times = np.cumsum(sign * jump[border])[entered]
    cells = np.flatnonzero(times)
    return dict(zip(cells.tolist(), times[cells].tolist(), strict=True))


def _toward_the_outside(plan: Plan, ways: Mapping[int, int], cell: int, known: dict[int, int]) -> int:
    """Make known how often the ways go round a cell, from a cell of which it is known; return the cell."""
    chain, at = [], cell
    while at not in known:
        chain.append(at)
        at = plan.parent[at]
    for step in reversed(chain):
        border = plan.link[step]
        jump = ways.get(border, 0)
        known[step] = known[at] + (jump if plan.left[border] == step else -jump)
        at = step
    return cell
