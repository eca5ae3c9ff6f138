"""Peeling: what is glued to what, sheet by sheet, as far as it follows from what is known.

A *seam* is what happens over a border or a bridge. It takes its *ports*, the sheets on the right and last the border's
own sheet, one-to-one to the sheets on the left. Around a crossing every sheet over the top cell goes on over the cells
beside it: it is glued there to one sheet each, or the boundary passes. So four corners, one in each cell, are joined in
a ring by four pairs of the four seams, and where three of the pairs are known, so is the fourth. The same holds at the
feet of bridges. And a seam of which all pairs but one are known has no choice for the last one.

The seams of the dual tree are known from the names of the sheets: a cell behind a descending link has the sheets of its
parent in the same order and the own sheet of the link last, one behind an ascending link has them all but one, in the
same order. That one is the only choice there is: once it is made for all ascending links, all pairs follow, or a
contradiction. Often they follow from fewer choices, or from none.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.compiled import called_from_loops, run_loop
from plyfold.immersion.corners import NO_SEAM, corners, corners_at_feet
from plyfold.immersion.dual_tree import grow_tree
from plyfold.immersion.immersion import Immersion
from plyfold.ragged import starts_of

__all__ = ["NOT_KNOWN", "OutlineSeams", "Peeled", "immersion_of", "outline_seams", "peel"]

NOT_KNOWN = -1
# Among reasons: the other pairs of the seam.
LEFT_OVER = -2
# Equal to no port and no sheet: the own sheet of a bridge.
_NONE = -9


@dataclass(frozen=True, eq=False)
class OutlineSeams:
    """The seams of an outline and what must agree; bridge j is seam n_borders + j.

    Parameters
    ----------
    arrangement : Arrangement
        Without cusps; no negative winding number.
    left, right : (seams,) int
        The cells on both sides.
    size : (seams,) int
        How many sheets lie on the left: that many ports has the seam.
    start : (seams + 1,) int
        Where the ports of each seam start, when all are written one after the other.
    around : (n, 4) int
        For each crossing, and then for each foot, the seams (a to top, a to bottom, b to top, b to bottom).
    bottom : (n,) int
        How many sheets lie over the bottom cell.
    in_tree : (seams,) bool
        The links of the dual tree.
    own : (seams,) int
        For links of the tree that descend the own sheet, as counted in the cell; −1 for all others.
    """

    arrangement: Arrangement
    left: Ints
    right: Ints
    size: Ints
    start: Ints
    around: Ints
    bottom: Ints
    in_tree: np.ndarray[tuple[int], np.dtype[np.bool_]]
    own: Ints

    @property
    def is_border(self) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Whether each seam is a border, with an own sheet, and no bridge."""
        return np.arange(len(self.size)) < self.arrangement.n_borders

    @property
    def choices(self) -> Ints:
        """The links of the tree that ascend: there a sheet must be chosen."""
        return np.flatnonzero(self.in_tree & (self.own < 0))


def outline_seams(arrangement: Arrangement) -> OutlineSeams:
    """Return the seams of an outline without cusps, with names for the sheets. Cost: O(k log k)."""
    bridged = arrangement.cell_of_dart[arrangement.bridges[:, 0]]
    left, right = np.append(arrangement.left_cell, bridged), np.append(arrangement.right_cell, bridged)
    size = arrangement.winding[left]
    around = np.concatenate([corners(arrangement), corners_at_feet(arrangement)])
    own = np.full(len(size), NOT_KNOWN)
    in_tree = np.zeros(len(size), dtype=bool)
    parent, link = grow_tree(arrangement)
    descends = arrangement.winding > arrangement.winding[parent]
    in_tree[link[1:]] = True
    own[link[descends]] = size[link[descends]] - 1
    return OutlineSeams(
        arrangement=arrangement,
        left=left,
        right=right,
        size=size,
        start=np.append(0, np.cumsum(size)),
        around=around,
        bottom=_bottom(arrangement, right, around),
        in_tree=in_tree,
        own=own,
    )


def _bottom(arrangement: Arrangement, right: Ints, around: Ints) -> Ints:
    """Return how many sheets lie over the cell on the right of both strands."""
    return np.asarray(arrangement.winding[right[around[:, [1, 3]].max(axis=1, initial=NO_SEAM)]])


@dataclass(frozen=True, eq=False)
class Peeled:
    """All that is known: both ways through every seam, −1 for what is open.

    Parameters
    ----------
    upper : (ports,) int
        The sheet on the left to which each port leads, as counted in its cell.
    port : (ports,) int
        The port that leads to each sheet on the left, seam by seam.
    because : (ports,) int
        The crossing or foot from which each pair follows, −1 for those known from the start, −2 for those that are left
        over in their seam by others.
    failed : int
        A crossing or foot at which something contradicts it, or −1.
    """

    upper: Ints
    port: Ints
    because: Ints
    failed: int

    @property
    def is_contradiction(self) -> bool:
        """Whether something contradicts itself, so that there is no immersion."""
        return self.failed != NOT_KNOWN

    @property
    def is_complete(self) -> bool:
        """Whether nothing is open."""
        return bool((self.upper >= 0).all())


def peel(seams: OutlineSeams, chosen: Mapping[int, int] | None = None) -> Peeled:
    """Find all that follows, given the own sheets of some ascending links. Cost: O(Σ w), over borders."""
    own = seams.own.copy()
    if chosen:
        own[list(chosen.keys())] = list(chosen.values())
    ports = int(seams.start[-1])
    nothing = np.full(ports, NOT_KNOWN)
    room = _Found(nothing, nothing.copy(), nothing.copy(), np.array([NOT_KNOWN]))
    found = run_loop(_peel, 4 * ports, _given(seams, own), room)
    return Peeled(found.upper, found.port, found.because, int(found.failed[0]))


class _Rings(NamedTuple):
    """The seams around each crossing in the order of the ring: b to top, a to bottom, b to bottom, a to top.

    ``own_a`` is the port of a's own sheet in the seam a to top, and ``own_b`` of b's; −9 for a bridge. ``at`` has for
    each seam the crossings at both ends, and ``place`` its places in their rings.
    """

    around: Ints
    bottom: Ints
    own_a: Ints
    own_b: Ints
    at: Ints
    place: Ints


class _Work(NamedTuple):
    """``missing`` ports of each seam are open; the sums of their numbers, and of the sheets not yet reached.

    ``stack[:top]`` holds the ports found from which nothing has been concluded yet. ``reason`` says from where
    something is being concluded.
    """

    start: Ints
    size: Ints
    seam: Ints
    in_tree: Ints
    own: Ints
    missing: Ints
    sum_port: Ints
    sum_upper: Ints
    stack: Ints
    top: Ints
    reason: Ints


class _Found(NamedTuple):
    """See :class:`Peeled`."""

    upper: Ints
    port: Ints
    because: Ints
    failed: Ints


_State: TypeAlias = tuple[_Rings, _Work, _Found]


def _given(seams: OutlineSeams, own: Ints) -> tuple[_Rings, _Work]:
    at, place = _ends(seams)
    a, b = seams.around[:, [0, 1]].max(axis=1, initial=NO_SEAM), seams.around[:, [2, 3]].max(axis=1, initial=NO_SEAM)
    rings = _Rings(
        around=seams.around[:, [2, 1, 3, 0]].ravel(),
        bottom=seams.bottom,
        own_a=np.where(seams.is_border[a], seams.size[seams.around[:, 0]] - 1, _NONE),
        own_b=np.where(seams.is_border[b], seams.size[seams.around[:, 2]] - 1, _NONE),
        at=at.ravel(),
        place=place.ravel(),
    )
    total = seams.size * (seams.size - 1) // 2
    work = _Work(
        start=seams.start,
        size=seams.size,
        seam=np.repeat(np.arange(len(seams.size)), seams.size),
        in_tree=seams.in_tree.astype(np.int64),
        own=own,
        missing=seams.size.copy(),
        sum_port=total,
        sum_upper=total.copy(),
        stack=np.zeros(int(seams.start[-1]), dtype=np.int64),
        top=np.zeros(1, dtype=np.int64),
        reason=np.array([NOT_KNOWN]),
    )
    return rings, work


def _ends(seams: OutlineSeams) -> tuple[Ints, Ints]:
    """Return the crossings at both ends of each seam, and its places in their rings; −1 where there is none."""
    rings = seams.around[:, [2, 1, 3, 0]].ravel()
    slots = np.flatnonzero(rings >= 0)
    slots = slots[np.argsort(rings[slots], kind="stable")]
    seam = rings[slots]
    second = np.append(False, seam[1:] == seam[:-1]).astype(np.int64)
    at, place = np.full((2, len(seams.size), 2), -1)
    at[seam, second], place[seam, second] = slots // 4, slots % 4
    return at, place


def _peel(given: tuple[_Rings, _Work], found: _Found) -> int:
    """Write down what is known of each seam, and conclude, until nothing new comes; 0 at a contradiction."""
    rings, work = given
    for seam in range(len(work.size)):
        known, work.reason[0] = 1, NOT_KNOWN
        if work.own[seam] >= 0:
            known = _glue(work, found, seam, work.size[seam] - 1, work.own[seam])
        elif work.size[seam] == 1:
            known = _glue(work, found, seam, 0, 0)
        if known == 0:
            found.failed[0] = rings.at[2 * seam]
            return 0
        if _conclude(rings, work, found) == 0:
            return 0
    return 1


@called_from_loops
def _glue(work: _Work, found: _Found, seam: int, port: int, sheet: int) -> int:
    """Note that a port leads to a sheet, and what that leaves for the last port of the seam; 0 if it cannot be."""
    start = work.start[seam]
    if port < 0 or port >= work.size[seam] or sheet < 0 or sheet >= work.size[seam]:
        return 0
    if found.upper[start + port] == sheet:
        return 1
    reason = work.reason[0]
    while True:
        if found.upper[start + port] >= 0 or found.port[start + sheet] >= 0:
            return 0
        found.upper[start + port], found.port[start + sheet] = sheet, port
        found.because[start + port], reason = reason, LEFT_OVER
        work.stack[work.top[0]] = start + port
        work.top[0] += 1
        work.missing[seam] -= 1
        work.sum_port[seam] -= port
        work.sum_upper[seam] -= sheet
        if work.missing[seam] != 1:
            return 1
        port, sheet = work.sum_port[seam], work.sum_upper[seam]


@called_from_loops
def _conclude(rings: _Rings, work: _Work, found: _Found) -> int:
    """Go round the crossings at both ends of all seams with something new; 0 at a contradiction."""
    state = rings, work, found
    while work.top[0] > 0:
        work.top[0] -= 1
        here = work.stack[work.top[0]]
        seam, sheet = work.seam[here], found.upper[here]
        port = here - work.start[seam]
        work.reason[0] = LEFT_OVER
        if work.in_tree[seam] == 1 and _keep_order(work, found, seam, port, sheet) == 0:
            found.failed[0] = rings.at[2 * seam]
            return 0
        for end in range(2):
            at = work.reason[0] = rings.at[2 * seam + end]
            if at >= 0 and _go_round(state, at, rings.place[2 * seam + end], port, sheet) == 0:
                found.failed[0] = at
                return 0
    return 1


@called_from_loops
def _keep_order(work: _Work, found: _Found, seam: int, port: int, sheet: int) -> int:
    """Conclude what follows for neighbours along a link of the tree: in order, ports skip the own sheet only."""
    last = work.size[seam] - 1
    if port == last:
        below = 1 if sheet == 0 else _glue(work, found, seam, sheet - 1, sheet - 1)
        return below if sheet == last or below == 0 else _glue(work, found, seam, sheet, sheet + 1)
    if sheet == port:
        return 1 if port == 0 else _glue(work, found, seam, port - 1, port - 1)
    if sheet == port + 1:
        return 1 if port + 1 == last else _glue(work, found, seam, port + 1, port + 2)
    return 0


@called_from_loops
def _go_round(state: _State, at: int, place: int, port: int, sheet: int) -> int:
    """Conclude the fourth pair around a crossing, where with a new one three are known; 0 at a contradiction.

    The corners are in the top cell, on a's left and b's right, in the bottom cell, and on the other side; the seam at
    place i lies between corners i and i + 1.
    """
    bottom = state[0].bottom[at]
    lower = bottom + 1 if place == 2 and port == bottom else port
    here, there = (sheet, lower) if place < 2 else (lower, sheet)
    after = _step(state, at, (place + 1) % 4, there, 1)
    before = _step(state, at, (place + 3) % 4, here, 0)
    if after >= 0 and before >= 0:
        return _join(state, at, (place + 2) % 4, after, before)
    if after >= 0:
        after = _step(state, at, (place + 2) % 4, after, 1)
        return 1 if after < 0 else _join(state, at, (place + 3) % 4, after, here)
    if before >= 0:
        before = _step(state, at, (place + 2) % 4, before, 0)
        return 1 if before < 0 else _join(state, at, (place + 1) % 4, there, before)
    return 1


@called_from_loops
def _step(state: _State, at: int, place: int, sheet: int, onward: int) -> Any:
    """Go from a sheet at one corner across a seam to the next corner, or back; −1 if that is not known.

    Over the bottom cell, a's boundary has the number of sheets there, and b's one more. Over the side that a has left,
    b's boundary goes on as the port of b's own sheet, and over the other side a's.
    """
    rings, work, found = state
    seam, bottom = rings.around[4 * at + place], rings.bottom[at]
    if (place < 2) == (onward == 1):  # down
        if place == 1 and sheet == rings.own_b[at]:
            return bottom + 1
        if place == 2 and sheet == rings.own_a[at]:
            return bottom
        down = sheet if seam < 0 else found.port[work.start[seam] + sheet]
        return bottom + 1 if place == 2 and down == bottom else down
    if place == 1 and sheet == bottom + 1:
        return rings.own_b[at]
    if place == 2 and sheet == bottom:
        return rings.own_a[at]
    port = bottom if place == 2 and sheet == bottom + 1 else sheet
    return port if seam < 0 else found.upper[work.start[seam] + port]


@called_from_loops
def _join(state: _State, at: int, place: int, here: int, there: int) -> int:
    """Note that two sheets at neighbouring corners are glued; 0 if they cannot be."""
    rings, work, found = state
    seam, bottom = rings.around[4 * at + place], rings.bottom[at]
    lower, upper = (there, here) if place < 2 else (here, there)
    if place == 1 and (lower == bottom + 1 or upper == rings.own_b[at]):
        return int(lower == bottom + 1 and upper == rings.own_b[at])
    if place == 2 and (lower == bottom or upper == rings.own_a[at]):
        return int(lower == bottom and upper == rings.own_a[at])
    port = bottom if place == 2 and lower == bottom + 1 else lower
    return int(port == upper) if seam < 0 else _glue(work, found, seam, port, upper)


def reasons(seams: OutlineSeams, known: Peeled) -> Ints:
    """Return crossings and feet that contradict each other, given what peeling found until it failed.

    From where it failed, back over all pairs from which something follows, to those known from the start.
    """
    state = *_given(seams, seams.own), _Found(known.upper, known.port, known.because, np.array([known.failed]))
    waiting = _pairs_at(seams, known, known.failed)
    seen, found = set(waiting), {known.failed}
    while waiting:
        pair = waiting.pop()
        because = int(known.because[pair])
        if because >= 0:
            found.add(because)
        fresh = set(_pairs_before(seams, state, pair, because)) - seen
        seen |= fresh
        waiting += fresh
    return np.array(sorted(found))


def _pairs_at(seams: OutlineSeams, known: Peeled, at: int) -> list[int]:
    """Return all known pairs of the seams around a crossing."""
    around = [seam for seam in seams.around[at].tolist() if seam != NO_SEAM]
    ports = np.concatenate([np.arange(seams.start[seam], seams.start[seam + 1]) for seam in around])
    pairs: list[int] = ports[known.upper[ports] >= 0].tolist()
    return pairs


def _pairs_before(seams: OutlineSeams, state: _State, pair: int, because: int) -> list[int]:
    """Return the pairs from which a pair follows, and perhaps more."""
    rings, work, found = state
    if because == NOT_KNOWN:
        return []
    seam = int(work.seam[pair])
    start, end = seams.start[seam : seam + 2].tolist()
    if because == LEFT_OVER:
        return [other for other in range(start, end) if found.upper[other] >= 0]
    places = [rings.place[2 * seam + end] for end in range(2) if rings.at[2 * seam + end] == because]
    return [other for place in places for other in _ring(state, because, int(place), pair) if found.upper[other] >= 0]


def _ring(state: _State, at: int, place: int, pair: int) -> Iterator[int]:
    """Yield the pairs around a crossing that are in a ring with a given one, at a place, as far as they are known."""
    rings, work, found = state
    port, sheet = pair - int(work.start[work.seam[pair]]), int(found.upper[pair])
    lower = rings.bottom[at] + 1 if place == 2 and port == rings.bottom[at] else port
    corner = np.full(4, NOT_KNOWN)
    corner[[place, (place + 1) % 4]] = (sheet, lower) if place < 2 else (lower, sheet)
    for step in (1, 2, 3, 2, 1):
        here, there = (place + step) % 4, (place + step + 1) % 4
        if corner[there] < 0 <= corner[here]:
            corner[there] = _step(state, at, here, int(corner[here]), 1)
        elif corner[here] < 0 <= corner[there]:
            corner[here] = _step(state, at, here, int(corner[there]), 0)
    for here in range(4):
        lower = int(corner[(here + 1) % 4 if here < 2 else here])
        seam, bottom = rings.around[4 * at + here], rings.bottom[at]
        port = bottom if here == 2 and lower == bottom + 1 else lower
        if seam >= 0 and 0 <= port < work.size[seam] and (here, lower) not in ((1, bottom + 1), (2, bottom)):
            yield int(work.start[seam]) + int(port)


def immersion_of(seams: OutlineSeams, upper: Ints) -> Immersion:
    """Build the immersion in which every port leads to a sheet."""
    arrangement = seams.arrangement
    first_sheet = starts_of(arrangement.winding)
    seam = np.repeat(np.arange(len(seams.size)), seams.size)
    port = np.arange(len(upper)) - seams.start[seam]
    own = (port == seams.size[seam] - 1) & seams.is_border[seam]
    left = first_sheet[seams.left[seam]] + upper
    right = first_sheet[seams.right[seam]] + port
    return Immersion(
        arrangement=arrangement,
        sheet_cell=np.repeat(np.arange(arrangement.n_cells), arrangement.winding),
        first_sheet=first_sheet,
        own_sheet=left[own],
        gluing=np.stack([seam[~own], right[~own], left[~own]], axis=1),
    )
