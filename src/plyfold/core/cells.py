"""Walks round the cells of a planar map, and the tree that joins them."""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer

__all__ = ["join_lakes", "sum_down", "walk_cells"]


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


def join_lakes(lake: WholeBuffer, other: WholeBuffer, joined: WholeBuffer, joins: WholeBuffer) -> None:
    """Join the lakes on both sides of each border, one after another, unless they are joined already (Kruskal).

    Parameters
    ----------
    lake, other : buffer of int
        The lakes on both sides of some borders.
    joined : buffer of int
        A lake that each lake has been joined to: at first itself.
    joins : buffer of int
        1 will be written for each border that joins two lakes.
    """
    for border in range(len(lake)):
        here, there = _representative(joined, lake[border]), _representative(joined, other[border])
        if here != there:
            joined[here] = there
            joins[border] = 1


def sum_down(highest_first: WholeBuffer, drain: WholeBuffer, total: WholeBuffer) -> None:
    """Add the total of each cell to that of the cell that it drains into, the highest cells first.

    Parameters
    ----------
    highest_first : buffer of int
        The cells, each before the one that it drains into.
    drain : buffer of int
        The lower cell that each cell drains into; a pit itself.
    total : buffer of int
        A number for each cell, to which those of all cells above it are added.
    """
    for place in range(len(highest_first)):
        cell = highest_first[place]
        if drain[cell] != cell:
            total[drain[cell]] += total[cell]


def _representative(joined: WholeBuffer, member: int) -> int:
    """Return the member that stands for all that were joined to a member, see `graphs.representative`."""
    while joined[member] != member:
        joined[member] = member = joined[joined[member]]
    return member
