"""In which order variables are best counted out, so that few of them ever share a table."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations

from plyfold.clock import Clock

__all__ = ["elimination_order"]

# Members with more neighbours come last: it hardly matters in which order.
_MANY = 100


def elimination_order(groups: Iterable[Sequence[int]], clock: Clock) -> list[int]:
    """Return all members of some groups in an order in which to take them out one by one.

    To take one out joins all groups that it belongs to. Always next is the one that makes neighbours of the fewest
    pairs that have not been in a group together (*minimum fill-in*). Raises TimeoutError when the time is over.

    Examples
    --------
    >>> elimination_order([(1, 2), (2, 3), (2, 4)], Clock(None))
    [1, 3, 2, 4]
    """
    beside: dict[int, set[int]] = {}
    for group in groups:
        for member in group:
            beside.setdefault(member, set()).update(group)
    for member, others in beside.items():
        others.discard(member)
    return list(_taken_out(beside, clock))


def _taken_out(beside: dict[int, set[int]], clock: Clock) -> Iterator[int]:
    """Yield the members in order, given the neighbours of each; their sets are used up."""
    lacking = {member: _lacking(beside, member, clock) for member in beside}
    waiting = [(number, member) for member, number in lacking.items()]
    heapq.heapify(waiting)
    while waiting:
        number, member = heapq.heappop(waiting)
        if lacking.get(member) == number and len(beside[member]) <= _MANY:
            yield member
            del lacking[member]
            for changed in _take_out(beside, lacking, member, clock):
                heapq.heappush(waiting, (lacking[changed], changed))
    yield from sorted(lacking)


def _lacking(beside: dict[int, set[int]], member: int, clock: Clock) -> int:
    """Return how many pairs of neighbours of a member are no neighbours themselves."""
    clock.check()
    others = beside[member]
    number = len(others)
    return (number * (number - 1) - sum(len(others & beside[other]) for other in others)) // 2


def _take_out(beside: dict[int, set[int]], lacking: dict[int, int], member: int, clock: Clock) -> set[int]:
    """Make the neighbours of a member neighbours of each other, without it; return whose pairs have changed."""
    around = beside[member]
    changed = set(around)
    for other in around:
        beside[other].discard(member)
    for one, other in combinations(around, 2):
        if one not in beside[other]:
            for common in (beside[one] & beside[other]) - around:
                lacking[common] -= 1
                changed.add(common)
            beside[one].add(other)
            beside[other].add(one)
    for other in around:
        lacking[other] = _lacking(beside, other, clock)
    return changed
