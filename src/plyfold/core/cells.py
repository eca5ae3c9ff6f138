"""Walks round the cells of a planar map, and the tree that joins them."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer, whole_room

__all__ = [
    "follow_darts",
    "join",
    "list_darts",
    "number_components",
    "number_joined",
    "root_of",
    "walk_cells",
    "walk_joined_cells",
]


def walk_cells(following: WholeBuffer, outer: int, darts: WholeBuffer, start: WholeBuffer, cell: WholeBuffer) -> int:
    """Walk round every cell from its lowest dart, round the unbounded one first.

    Parameters
    ----------
    following : buffer of int
        The dart after each dart around the cell on its left.
    outer : int
        A dart of the unbounded cell.
    darts, start : buffer of int
        Room for the darts, cell after cell, and for where each cell starts among them; one for each dart.
    cell : buffer of int
        Room for the cell of each dart, with −1 for all of them.

    Returns
    -------
    int
        How many cells there are.

    Examples
    --------
    >>> from array import array
    >>> darts, start, cell = array("q", [0] * 4), array("q", [0] * 4), array("q", [-1] * 4)
    >>> walk_cells(array("q", [2, 3, 0, 1]), 3, darts, start, cell), darts.tolist(), cell.tolist()
    (2, [1, 3, 0, 2], [1, 0, 1, 0])
    """
    lowest, dart = outer, following[outer]
    while dart != outer:
        lowest = min(lowest, dart)
        dart = following[dart]
    size = count = 0
    for place in range(-1, len(following)):
        dart = lowest if place < 0 else place
        if cell[dart] < 0:
            start[count] = size
            while cell[dart] < 0:
                cell[dart] = count
                darts[size] = dart
                size += 1
                dart = following[dart]
            count += 1
    return count


def follow_darts(
    partner: WholeBuffer, ccw: WholeBuffer, first_visit: WholeBuffer, following: WholeBuffer, room: WholeBuffer
) -> None:
    """Find the dart that follows each around the cell on its left, see `planar_map.next_darts`.

    Parameters
    ----------
    partner : buffer of int
        The other visit to the same crossing; a mark is its own partner.
    ccw : buffer of bool
        Whether the other strand crosses from right to left.
    first_visit : buffer of int
        The first visit of each loop, and their number.
    following : buffer of int
        Room for two darts for each border.
    room : buffer of int
        Room for two numbers for each visit.

    Examples
    --------
    >>> from array import array
    >>> following = array("q", [0] * 4)
    >>> room = memoryview(array("q", [0] * 4))
    >>> _ = follow_darts(array("q", [1, 0]), array("B", [1, 0]), array("q", [0, 2]), following, room)
    >>> following.tolist()
    [3, 1, 2, 0]
    """
    before, after = room[: len(partner)], room[len(partner) : 2 * len(partner)]
    border = 0
    for loop in range(len(first_visit) - 1):
        start, end = first_visit[loop], first_visit[loop + 1]
        for visit in range(start, end):
            after[visit] = border + visit - start
            before[visit] = after[visit] - 1 if visit > start else border + end - start - 1
        if end == start:
            following[2 * border], following[2 * border + 1] = 2 * border, 2 * border + 1
            border += 1
        border += end - start
    for visit in range(len(partner)):
        other = partner[visit]
        goes_on, turns_back = 2 * after[other], 2 * before[other] + 1
        if not (ccw[visit] or other == visit):
            goes_on, turns_back = turns_back, goes_on
        following[2 * before[visit]], following[2 * after[visit] + 1] = goes_on, turns_back


def walk_joined_cells(
    following: WholeBuffer,
    outside: WholeBuffer,
    same_cell: WholeBuffer,
    darts: WholeBuffer,
    start: WholeBuffer,
    cell: WholeBuffer,
) -> int:
    """Walk round every cell as :func:`walk_cells` does, where cells may have several boundary cycles.

    Those of one cell follow each other by their lowest darts.

    Parameters
    ----------
    following, darts, start, cell
        See there.
    outside : buffer of int
        Darts of the unbounded cell.
    same_cell : buffer of int
        Pairs of darts with the same cell on their left. With ``outside`` they tell of all cycles to which cells they
        belong.

    Returns
    -------
    int
        How many cells there are.

    Examples
    --------
    Two rings, one inside the other.

    >>> from array import array
    >>> darts, start, cell = array("q", [0] * 4), array("q", [0] * 4), array("q", [-1] * 4)
    >>> same = walk_joined_cells(array("q", [0, 1, 2, 3]), array("q", [1]), array("q", [2, 0]), darts, start, cell)
    >>> same, darts.tolist(), start.tolist()[:3], cell.tolist()
    (3, [1, 0, 2, 3], [0, 1, 3], [1, 0, 1, 2])
    """
    cycle, joined = whole_room(len(following)), whole_room(len(following) + 1)
    cycles = _walk_cycles(following, cycle, joined)
    for place in range(1, len(outside)):
        _join_cycles(joined, cycle[outside[0]], cycle[outside[place]])
    for pair in range(len(same_cell) // 2):
        _join_cycles(joined, cycle[same_cell[2 * pair]], cycle[same_cell[2 * pair + 1]])
    number = whole_room(cycles)
    number[root_of(joined, cycle[outside[0]])] = count = 1
    for dart in range(len(following)):
        lake = root_of(joined, cycle[dart])
        if number[lake] == 0:
            count += 1
            number[lake] = count
        cell[dart] = number[lake] - 1
    list_darts(following, cell, count, darts, start)
    return count


def _walk_cycles(following: WholeBuffer, cycle: WholeBuffer, joined: WholeBuffer) -> int:
    """Write down the cycles, from 1 on by their lowest darts, each joined to itself; return the next number."""
    count = 1
    for first in range(len(following)):
        if cycle[first] == 0:
            joined[count] = count
            dart = first
            while cycle[dart] == 0:
                cycle[dart] = count
                dart = following[dart]
            count += 1
    return count


def _join_cycles(joined: WholeBuffer, one: int, other: int) -> None:
    """Join the cells of two cycles."""
    joined[root_of(joined, one)] = root_of(joined, other)


def list_darts(following: WholeBuffer, cell: WholeBuffer, cells: int, darts: WholeBuffer, start: WholeBuffer) -> None:
    """List the darts cell by cell, cycle after cycle by their lowest darts, and note where each cell starts."""
    size, is_listed = whole_room(cells + 1), whole_room(len(cell))
    for dart in range(len(cell)):
        size[cell[dart] + 1] += 1
    for number in range(cells):
        start[number] = size[number]
        size[number + 1] += size[number]
    for first in range(len(cell)):
        dart, here = first, cell[first]
        while is_listed[dart] == 0:
            is_listed[dart] = 1
            darts[size[here]] = dart
            size[here] += 1
            dart = following[dart]


def number_components(start: WholeBuffer, end: WholeBuffer, joined: WholeBuffer, number: WholeBuffer) -> None:
    """Give numbers to the connected components of a graph in the order of their first nodes.

    Parameters
    ----------
    start, end : buffer of int
        The nodes at both ends of each edge.
    joined, number : buffer of int
        Room for each node: one that stands for its component, and the number of that.
    """
    for node in range(len(joined)):
        joined[node] = node
    for edge in range(len(start)):
        join(joined, start[edge], end[edge])
    number_joined(joined, number)


def join(joined: WholeBuffer, one: int, other: int) -> None:
    """Join the components of two nodes; the lowest node of each stands for it."""
    here, there = root_of(joined, one), root_of(joined, other)
    if here < there:
        joined[there] = here
    else:
        joined[here] = there


def number_joined(joined: WholeBuffer, number: WholeBuffer) -> None:
    """Give numbers to components in the order of their lowest nodes, which stand for them."""
    count = 0
    for node in range(len(joined)):
        if joined[node] == node:
            number[node] = count
            count += 1
        else:
            number[node] = number[root_of(joined, node)]


def root_of(joined: WholeBuffer, member: int) -> int:
    """Return the member that stands for all that were joined to a member, see `graphs.representative`."""
    while joined[member] != member:
        joined[member] = member = joined[joined[member]]
    return member
