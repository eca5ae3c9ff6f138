"""All the ways in which the points of an outline that are in contact can move apart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrangement.drawn import drawn_map
from plyfold.arrangement.general_position import number_of_ways, separated
from plyfold.clock import UNWATCHED

__all__ = ["ways_apart"]


def ways_apart(arranged: Arrangement, inward: bool = False) -> Iterator[Arrangement]:
    """Yield arrangements of the same outline with the points in contact moved apart in all ways that matter.

    That is one, mostly; several if cusps lie on each other. An outline without contacts is arranged in one way.

    Parameters
    ----------
    arranged : Arrangement
    inward : bool, optional
        Move points inward, in place of outward. Then there is a surface just when the outline as given bounds one in
        the strict sense: with all angles as one sees them.

    Examples
    --------
    >>> from plyfold import arrange
    >>> pinched = arrange([(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)])
    >>> [way.winding.tolist() for inward in (False, True) for way in ways_apart(pinched, inward)]
    [[0, 1], [0, -1, 1, 1]]
    """
    if arranged.given is None or len(arranged.contacts) == 0:
        yield arranged
        return
    if not inward:
        yield arranged
    for way in range(0 if inward else 1, number_of_ways(arranged.given)):
        placed = separated(arranged.given, -1 if inward else 1, way=way)
        placed = replace(placed, numbers=arranged.numbers, turned_round=arranged.reversed)
        yield Arrangement.of_drawing(drawn_map(placed, UNWATCHED))
