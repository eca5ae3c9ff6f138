"""All ways to glue the sheets of an outline: what peeling leaves open, as a question to the SAT solver.

The chords of several loops, or of one loop that bounds a handle, may cross like the arcs on a surface with holes, so no
word tells which choices fit together. But the conditions are plain: every open port of a seam leads to one open sheet,
and around each crossing both ways from the bottom cell to the top cell lead to the same sheet. The names of sheets are
fixed along the dual tree, so every surface is one solution, and the own sheets of the ascending links determine it.

Open seams that meet nowhere have nothing to do with each other: they form *parts*, whose numbers multiply.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, combinations, count
from typing import TypeAlias

import numpy as np

from plyfold.arrays import Ints
from plyfold.graphs import components
from plyfold.immersion.corners import NO_SEAM
from plyfold.immersion.peeling import OutlineSeams, Peeled

__all__ = ["OpenPart", "open_around", "open_parts", "open_whole"]

# The variable that is always true.
_TRUE = 1
# Of more variables, fewer are compared at a time.
_AT_A_TIME = 5

# Sheets to which one may lead, each with the literal that says so.
Options: TypeAlias = list[tuple[int, int]]
# The same over two seams: the literals that say so together, and the sheet.
Ways: TypeAlias = list[tuple[list[int], int]]


@dataclass(frozen=True, eq=False)
class OpenPart:
    """Seams that are partly open, and the crossings where they meet: the clauses for what they may do.

    Parameters
    ----------
    seams : OutlineSeams
    known : Peeled
    members : (m,) int
        The open seams.
    meetings : (n,) int
        The crossings and feet at which one of them is.
    """

    seams: OutlineSeams
    known: Peeled
    members: Ints
    meetings: Ints

    @cached_property
    def _options(self) -> dict[int, list[Options]]:
        """The sheets to which the ports of each open seam may lead."""
        options: dict[int, list[Options]] = {}
        variable = _TRUE
        for seam in self.members.tolist():
            ports: list[Options] = []
            for sheets in self._possible(seam):
                if len(sheets) == 1:
                    ports.append([(sheets[0], _TRUE)])
                else:
                    ports.append([(sheet, variable + number) for number, sheet in enumerate(sheets, 1)])
                    variable += len(sheets)
            options[seam] = ports
        return options

    def _possible(self, seam: int) -> list[list[int]]:
        """Return the sheets to which each port of a seam may lead."""
        start, end = self.seams.start[seam : seam + 2]
        upper = self.known.upper[start:end].tolist()
        free = np.flatnonzero(self.known.port[start:end] < 0).tolist()
        last = len(upper) - 1
        in_order = bool(self.seams.in_tree[seam])
        return [
            [sheet]
            if sheet >= 0
            else [other for other in free if not in_order or port == last or other in (port, port + 1)]
            for port, sheet in enumerate(upper)
        ]

    @cached_property
    def n_variables(self) -> int:
        """Number of variables that say what leads where."""
        pairs = (literal for ports in self._options.values() for options in ports for _, literal in options)
        return max(pairs, default=_TRUE)

    @cached_property
    def choices(self) -> list[int]:
        """Variables that determine a solution: the own sheets of ascending links."""
        links = [seam for seam in self.members.tolist() if self.seams.in_tree[seam]]
        own = (self._options[seam][-1] for seam in links)
        return [literal for options in own for _, literal in options if literal != _TRUE]

    def clauses(self) -> Iterator[list[int]]:
        """Yield all clauses."""
        fresh = count(self.n_variables + 1)
        yield from self.of_seams(fresh)
        for number in self.meetings.tolist():
            yield from self.of_meeting(number, fresh)
        # It says nothing, and makes the solver's models name every variable.
        last = next(fresh)
        yield [last, -last]

    def of_seams(self, fresh: Iterator[int]) -> Iterator[list[int]]:
        """Yield what holds along every seam: each port leads to one sheet, and to each sheet leads one port."""
        yield [_TRUE]
        for ports in self._options.values():
            to_sheet: list[list[int]] = [[] for _ in ports]
            for sheet, literal in chain.from_iterable(ports):
                to_sheet[sheet].append(literal)
            for literals in chain(([literal for _, literal in options] for options in ports), to_sheet):
                yield literals or [-_TRUE]
                yield from _at_most_one(literals, fresh)

    def of_meeting(self, number: int, fresh: Iterator[int]) -> Iterator[list[int]]:
        """Yield what holds at a crossing or foot: both ways from the bottom to the top lead to the same sheet."""
        a_top, a_bottom, b_top, b_bottom = self.seams.around[number].tolist()
        bottom, borders = int(self.seams.bottom[number]), self.seams.arrangement.n_borders
        pairs = [
            (self._ways(self._leads(a_bottom, sheet), b_top), self._ways(self._leads(b_bottom, sheet), a_top))
            for sheet in range(bottom)
        ]
        if max(a_top, a_bottom) < borders:
            pairs.append((self._ways(self._leads(a_bottom, bottom), b_top), self._own(a_top)))
        if max(b_top, b_bottom) < borders:
            pairs.append((self._ways(self._leads(b_bottom, bottom), a_top), self._own(b_top)))
        for one_way, other_way in pairs:
            yield from _agree(one_way, other_way, fresh)

    def _leads(self, seam: int, port: int) -> Options:
        if seam == NO_SEAM:
            return [(port, _TRUE)]
        if seam in self._options:
            return self._options[seam][port]
        return [(int(self.known.upper[self.seams.start[seam] + port]), _TRUE)]

    def _own(self, seam: int) -> Ways:
        last = int(self.seams.size[seam]) - 1
        return [(_true_left_out(literal), sheet) for sheet, literal in self._leads(seam, last)]

    def _ways(self, first: Options, seam: int) -> Ways:
        return [
            (_true_left_out(literal, other), sheet)
            for side, literal in first
            for sheet, other in self._leads(seam, side)
        ]

    def choice(self, model: Sequence[int]) -> dict[int, int]:
        """Return the own sheets of the open ascending links in a solution, as counted in their cells."""
        links = [seam for seam in self._options if self.seams.in_tree[seam]]
        return {seam: _chosen(self._options[seam][-1], model) for seam in links}

    def some_of(self, wanted: Callable[[int, int, int], bool]) -> list[int]:
        """Return the clause that some pair of sheets is glued, among those wanted: told by seam, port and sheet."""
        literals = [
            literal
            for seam, ports in self._options.items()
            for port, options in enumerate(ports[: self._sheets_below(seam)])
            for sheet, literal in options
            if literal != _TRUE and wanted(seam, port, sheet)
        ]
        return literals or [-_TRUE]

    def _sheets_below(self, seam: int) -> int:
        """Return how many ports of a seam are sheets: all, but for the own sheet of a border."""
        return int(self.seams.size[seam]) - (seam < self.seams.arrangement.n_borders)

    def upper(self, model: Sequence[int]) -> Ints:
        """Return the sheets to which all ports lead in a solution."""
        upper = self.known.upper.copy()
        for seam, ports in self._options.items():
            start = int(self.seams.start[seam])
            for port, options in enumerate(ports, start):
                upper[port] = _chosen(options, model)
        return upper


def _chosen(options: Options, model: Sequence[int]) -> int:
    return next(sheet for sheet, literal in options if model[literal - 1] > 0)


def _true_left_out(*literals: int) -> list[int]:
    return [literal for literal in literals if literal != _TRUE]


def _at_most_one(literals: list[int], fresh: Iterator[int]) -> Iterator[list[int]]:
    """Yield clauses that at most one of some literals is true; of many, a new variable stands for all but the first."""
    if len(literals) > _AT_A_TIME + 1:
        rest = next(fresh)
        yield from _at_most_one([-rest, *literals[_AT_A_TIME:]], fresh)
        literals = [*literals[:_AT_A_TIME], rest]
    for one, other in combinations(literals, 2):
        yield [-one, -other]


def _agree(one_way: Ways, other_way: Ways, fresh: Iterator[int]) -> Iterator[list[int]]:
    """Yield clauses that two ways lead to the same sheet.

    Where one way has a literal for each sheet, the other way implies it. Otherwise each sheet gets a new variable.
    """
    one_is_plain, other_is_plain = (all(len(way) < 2 for way, _ in ways) for ways in (one_way, other_way))
    if one_is_plain:
        yield from _implied(other_way, one_way)
        if other_is_plain:
            yield from _implied(one_way, other_way)
    elif other_is_plain:
        yield from _implied(one_way, other_way)
    else:
        common = sorted({sheet for _, sheet in one_way} & {sheet for _, sheet in other_way})
        between: Ways = [([next(fresh)], sheet) for sheet in common]
        yield from _at_most_one([way[0] for way, _ in between], fresh)
        yield from _implied(one_way, between)
        yield from _implied(other_way, between)


def _implied(ways: Ways, plain: Ways) -> Iterator[list[int]]:
    """Yield clauses that whoever goes one way comes to the sheet of a plain one."""
    literal_of = {sheet: way for way, sheet in plain}
    for way, sheet in ways:
        if literal_of.get(sheet) != []:
            yield [*(-literal for literal in way), *literal_of.get(sheet, ())] or [-_TRUE]


def open_whole(seams: OutlineSeams, known: Peeled) -> OpenPart:
    """Return all that is open, as one part."""
    open_seams = _open_seams(seams, known)
    concerned = np.isin(seams.around, open_seams).any(axis=1)
    return OpenPart(seams, known, open_seams, np.flatnonzero(concerned))


def open_around(seams: OutlineSeams, known: Peeled, meetings: Ints) -> OpenPart:
    """Return what is open around some crossings and feet, whatever there is elsewhere."""
    return OpenPart(seams, known, np.intersect1d(_open_seams(seams, known), seams.around[meetings]), meetings)


def _open_seams(seams: OutlineSeams, known: Peeled) -> Ints:
    return np.unique(np.repeat(np.arange(len(seams.size)), seams.size)[known.upper < 0])


def open_parts(seams: OutlineSeams, known: Peeled) -> list[OpenPart]:
    """Return what is open, in parts that have nothing to do with each other; in the order of their first seams."""
    whole = open_whole(seams, known)
    if not len(whole.members):
        return []
    around = seams.around[whole.meetings]
    meeting, place = np.nonzero(np.isin(around, whole.members))
    place_of_member = np.searchsorted(whole.members, around[meeting, place])
    part = components(len(whole.members) + len(around), place_of_member, len(whole.members) + meeting)
    of_members, of_meetings = part[: len(whole.members)], part[len(whole.members) :]
    return [
        OpenPart(seams, known, whole.members[of_members == number], whole.meetings[of_meetings == number])
        for number in range(int(of_members.max()) + 1)
    ]
