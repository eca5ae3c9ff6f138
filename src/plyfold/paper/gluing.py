"""From a disk layout back to the immersion: which sheets are there, and how they are glued (§2.2 of the paper).

A disk layout tells only which borders share a sheet. The groups are disjoint regions of the disk; what is left of it
falls into *gaps*, and a sheet without own borders lies in one gap. Going from a sheet to the one beyond a border never
leaves the gap that the sheet's side there faces. Since nothing lies over the unbounded cell, counting the sides that
face a gap on both sides of each border tells how many sheets of each cell the gap holds, so a *room*, the sides that
face one gap along one border, has as many places on the left as on the right. Inside a room the gluing follows from

* the crossings on the boundary of the disk, each of which glues two own sheets to two others;
* the other crossings, around which three gluings give the fourth;
* counting: the last sheet on the left is glued to the last one on the right.

Where all that leaves a choice among sheets to which nothing is glued yet, they are alike, and any choice will do.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.errors import PlyfoldError
from plyfold.immersion.immersion import Immersion, require_memory_for_gluing

__all__ = ["glue_layout"]

# Rows of the gluing are kept in dictionaries here.
_BYTES_PER_PAIR = 1000

Gap: TypeAlias = int
Rooms: TypeAlias = list[dict[Gap, list[int]]]
"""For every dart and gap: the sheets over the cell on the left of the dart whose side over the dart faces the gap."""


def glue_layout(arrangement: Arrangement, groups: Sequence[Sequence[int]]) -> Immersion | None:
    """Build the immersion that has a given disk layout.

    Parameters
    ----------
    arrangement : Arrangement
        No cell has more groups than its winding number.
    groups : sequence of sequences of int
        A non-crossing partition of the borders into those that share a sheet, each group in order along the curve.

    Returns
    -------
    Immersion or None
        It has been checked against the definition. None if the groups fit no immersion.

    Notes
    -----
    O(Σ w), sheets counted once per border, but for rooms where nothing is decided: each choice looks at all of them.
    That a layout never leaves a choice among sheets that are not alike is not proved; on every immersion of up to six
    crossings and some hundred random ones of up to 1,900, none was left.

    Examples
    --------
    >>> from plyfold import arrange
    >>> ramp = arrange([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)])
    >>> glue_layout(ramp, [(0, 6), (1, 5), (2, 4), (3,), (7,)])
    <Immersion: 5 sheets over 5 cells>
    >>> print(glue_layout(ramp, [(0,), (1, 5), (2, 4), (3,), (6,), (7,)]))
    None
    """
    require_memory_for_gluing(arrangement, _BYTES_PER_PAIR)
    facing = _facing(arrangement, groups)
    inner = _inner_sheets(arrangement, facing)
    if not _fits(arrangement, groups, inner):
        return None
    first_sheet = np.cumsum(arrangement.winding) - arrangement.winding
    group_sheet = _number_groups(arrangement, groups, first_sheet)
    rooms = _rooms(arrangement, facing, inner, group_sheet)
    if any(_sizes(rooms[dart]) != _sizes(rooms[dart + 1]) for dart in range(0, len(rooms), 2)):
        return None
    own_sheet = np.empty(arrangement.n_borders, dtype=np.int64)
    for sheet, group in zip(group_sheet, groups, strict=True):
        own_sheet[list(group)] = sheet
    return _checked(arrangement, own_sheet, _glue(arrangement, rooms, own_sheet.tolist()))


def _checked(arrangement: Arrangement, own_sheet: Ints, gluing: Ints) -> Immersion | None:
    """Return the immersion with some rows as its gluing, None if it is none."""
    immersion = Immersion(arrangement, own_sheet, gluing[:, 2].astype(np.int32))
    try:
        immersion.check()
    except PlyfoldError:
        return None
    return immersion if np.array_equal(immersion.gluing, gluing) else None


# ---- gaps and rooms ------------------------------------------------------------------------------------------------


def _gap_before(n_borders: int, groups: Iterable[Sequence[int]]) -> list[Gap]:
    """Return the gap at the start of each border: regions of the disk outside the groups, called by their last border.

    Going round a gap one comes from the start of a border to the end of the one before it, and along that one's group
    to the start of the group's next border.
    """
    following = [0] * n_borders
    for group in groups:
        for border, after in zip(group, [*group[1:], group[0]], strict=True):
            following[border] = after
    gap = [-1] * n_borders
    for border in range(n_borders - 1, -1, -1):
        name, start = border, border
        while gap[start] < 0:
            gap[start] = name
            start = following[start - 1]
    return gap


def _facing(arrangement: Arrangement, groups: Sequence[Sequence[int]]) -> list[list[tuple[Gap, int]]]:
    """Return for each dart the sides over it of groups on its left: (gap faced, group).

    A sheet is a copy of its cell; walking around it, everything after an own border faces the gap at that border's
    end, up to the next own border.
    """
    gap = _gap_before(arrangement.n_borders, groups)
    facing: list[list[tuple[Gap, int]]] = [[] for _ in range(2 * arrangement.n_borders)]
    for number, group in enumerate(groups):
        own = {2 * border for border in group}
        darts = arrangement.cells[arrangement.left_cell[group[0]]]
        start = darts.index(2 * group[0])
        last = group[0]
        for dart in darts[start:] + darts[:start]:
            if dart in own:
                last = dart // 2
            else:
                facing[dart].append((gap[(last + 1) % len(gap)], number))
    return facing


def _inner_sheets(arrangement: Arrangement, facing: list[list[tuple[Gap, int]]]) -> list[Counter[Gap]]:
    """Return how many sheets without own borders each cell has in each gap, outward in from the unbounded cell."""
    cell_of = arrangement.cell_of_dart.tolist()
    inner: list[Counter[Gap]] = [Counter() for _ in range(arrangement.n_cells)]
    reached, waiting = {0}, deque([0])
    while waiting:
        cell = waiting.popleft()
        for dart in arrangement.cells[cell]:
            beyond = cell_of[dart ^ 1]
            if beyond not in reached:
                reached.add(beyond)
                waiting.append(beyond)
                inner[beyond].update(inner[cell])
                inner[beyond].update(gap for gap, _ in facing[dart])
                inner[beyond].subtract(gap for gap, _ in facing[dart ^ 1])
    return inner


def _fits(arrangement: Arrangement, groups: Sequence[Sequence[int]], inner: list[Counter[Gap]]) -> bool:
    """Tell whether every cell has as many sheets as its winding number, in no gap fewer than none."""
    of_groups = Counter(int(arrangement.left_cell[group[0]]) for group in groups)
    return all(
        min(counts.values(), default=0) >= 0 and counts.total() + of_groups[cell] == winding
        for cell, (counts, winding) in enumerate(zip(inner, arrangement.winding.tolist(), strict=True))
    )


def _number_groups(arrangement: Arrangement, groups: Sequence[Sequence[int]], first_sheet: Ints) -> list[int]:
    """Return a sheet for every group: the first ones of its cell, in the order of the groups."""
    free = first_sheet.tolist()
    sheets = []
    for group in groups:
        cell = int(arrangement.left_cell[group[0]])
        sheets.append(free[cell])
        free[cell] += 1
    return sheets


def _rooms(
    arrangement: Arrangement,
    facing: list[list[tuple[Gap, int]]],
    inner: list[Counter[Gap]],
    group_sheet: list[int],
) -> Rooms:
    """Return the rooms; over each cell the sheets without own borders have the highest numbers, gap by gap."""
    end = np.cumsum(arrangement.winding).tolist()
    inner_sheets: list[dict[Gap, list[int]]] = []
    for cell, counts in enumerate(inner):
        numbers = iter(range(end[cell] - counts.total(), end[cell]))
        inner_sheets.append({gap: [next(numbers) for _ in range(count)] for gap, count in sorted(counts.items())})
    rooms: Rooms = []
    for dart, cell in enumerate(arrangement.cell_of_dart.tolist()):
        room = {gap: list(sheets) for gap, sheets in inner_sheets[cell].items()}
        for gap, group in facing[dart]:
            room.setdefault(gap, []).append(group_sheet[group])
        rooms.append(room)
    return rooms


def _sizes(room: dict[Gap, list[int]]) -> dict[Gap, int]:
    return {gap: len(sheets) for gap, sheets in room.items() if sheets}


# ---- the gluing inside the rooms -----------------------------------------------------------------------------------


@dataclass
class _Seams:
    """The gluing as far as it is known: ``beyond[dart, sheet]`` lies across the dart from a sheet on its left."""

    next_dart: list[int]
    previous_dart: list[int]
    rooms: Rooms
    gap: dict[tuple[int, int], Gap]
    beyond: dict[tuple[int, int], int] = field(default_factory=dict)
    touched: set[int] = field(default_factory=set)


def _glue(arrangement: Arrangement, rooms: Rooms, own_sheet: list[int]) -> Ints:
    seams = _Seams(
        arrangement.next_dart.tolist(),
        np.argsort(arrangement.next_dart).tolist(),
        rooms,
        {(dart, sheet): gap for dart, room in enumerate(rooms) for gap, sheets in room.items() for sheet in sheets},
    )
    n = arrangement.n_borders
    for a in np.flatnonzero(arrangement.ccw).tolist():
        b = int(arrangement.partner[a])
        _join(seams, 2 * b, own_sheet[a - 1], own_sheet[a])
        _join(seams, 2 * ((a - 1) % n), own_sheet[b], own_sheet[b - 1])
    for dart in range(0, 2 * n, 2):
        for gap in rooms[dart]:
            for pair in _last(seams, dart, gap):
                _join(seams, *pair)
    _join_the_rest(seams)
    rows = [(dart // 2, sheet, other) for (dart, sheet), other in seams.beyond.items() if dart % 2]
    return np.array(sorted(rows), dtype=np.int64).reshape(-1, 3)


def _join(seams: _Seams, dart: int, left: int, right: int) -> None:
    """Glue a sheet on the left of a dart to one on its right, and draw all conclusions.

    What contradicts the gluing so far is left out; the check of the immersion will find it.
    """
    waiting = [(dart, left, right)]
    while waiting:
        dart, left, right = waiting.pop()
        ends = (dart, left), (dart ^ 1, right)
        gap = seams.gap.get(ends[0])
        if gap is None or gap != seams.gap.get(ends[1]) or any(end in seams.beyond for end in ends):
            continue
        seams.beyond[ends[0]], seams.beyond[ends[1]] = right, left
        seams.touched.update((left, right))
        waiting += [pair for pair in (_fourth(seams, *end) for end in ends) if pair]
        waiting += _last(seams, dart, gap)


def _fourth(seams: _Seams, dart: int, sheet: int) -> tuple[int, int, int] | None:
    """Go round the crossing at the end of a dart, both ways; if three steps are known, tell the fourth.

    The sheet is on the left of the dart, and the first step goes across it.
    """
    ahead, last = seams.previous_dart[dart ^ 1], seams.beyond[dart, sheet]
    behind, first = seams.next_dart[dart], sheet
    steps = 1
    while steps < 3 and (ahead, last) in seams.beyond:
        ahead, last = seams.previous_dart[ahead ^ 1], seams.beyond[ahead, last]
        steps += 1
    while steps < 3 and (behind, first) in seams.beyond:
        behind, first = seams.next_dart[behind ^ 1], seams.beyond[behind, first]
        steps += 1
    return (ahead, last, first) if steps == 3 else None


def _open(seams: _Seams, dart: int, gap: Gap) -> list[int]:
    """Return the sheets on the left of a dart that are still to be glued in a room."""
    return [sheet for sheet in seams.rooms[dart].get(gap, ()) if (dart, sheet) not in seams.beyond]


def _last(seams: _Seams, dart: int, gap: Gap) -> list[tuple[int, int, int]]:
    """Return the only pair left to be glued in a room, if it is the only one."""
    left, right = _open(seams, dart, gap), _open(seams, dart ^ 1, gap)
    return [(dart, left[0], right[0])] if len(left) == len(right) == 1 else []


def _join_the_rest(seams: _Seams) -> None:
    """Glue what nothing decides: sheets that are all alike, as nothing is glued to them, to sheets known already.

    Taking the room with the most known sheets on the other side, what is known grows outward and stays in one piece.
    """

    def known(dart: int, gap: Gap) -> int:
        return len(seams.touched.intersection(_open(seams, dart, gap)))

    while open_rooms := [
        (dart, gap) for dart, room in enumerate(seams.rooms) for gap in room if _open(seams, dart, gap)
    ]:
        dart, gap = min(open_rooms, key=lambda room: (known(*room), -known(room[0] ^ 1, room[1])))
        _join(seams, dart, _open(seams, dart, gap)[0], _open(seams, dart ^ 1, gap)[0])
