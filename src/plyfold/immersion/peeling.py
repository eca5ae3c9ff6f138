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

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.rings import Found, Rings, State, Work, close_rings, step
from plyfold.immersion.corners import NO_SEAM, corners, corners_at_feet
from plyfold.immersion.dual_tree import grow_tree
from plyfold.immersion.immersion import Immersion
from plyfold.ragged import starts_of

__all__ = ["UNKNOWN", "OutlineSeams", "Peeled", "immersion_of", "outline_seams", "peel"]

UNKNOWN = -1
# Among reasons: the other pairs of the seam.
LEFT_OVER = -2


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
    in_tree: Bools
    own: Ints

    @property
    def is_border(self) -> Bools:
        """Whether each seam is a border, with an own sheet, and no bridge."""
        return np.arange(len(self.size)) < self.arrangement.n_borders


def outline_seams(arrangement: Arrangement) -> OutlineSeams:
    """Return the seams of an outline without cusps, with names for the sheets. Cost: O(k log k)."""
    bridged = arrangement.cell_of_dart[arrangement.bridges[:, 0]]
    left, right = np.append(arrangement.left_cell, bridged), np.append(arrangement.right_cell, bridged)
    size = arrangement.winding[left]
    around = np.concatenate([corners(arrangement), corners_at_feet(arrangement)])
    own = np.full(len(size), UNKNOWN)
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
        return self.failed != UNKNOWN

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
    upper, port, because = np.full((3, ports), UNKNOWN)
    if seams.size.max(initial=0) <= 1:  # no two sheets lie over each other
        return Peeled(np.zeros_like(upper), np.zeros_like(port), because, UNKNOWN)
    state = _state(seams, own, Found(flat(upper), flat(port), flat(because), UNKNOWN))
    close_rings(state)
    return Peeled(upper, port, because, state.found.failed)


def _state(seams: OutlineSeams, own: Ints, found: Found) -> State:
    around, bottom, size = all_flat(seams.around, seams.bottom, seams.size)
    rings = Rings(around, bottom, size, seams.arrangement.n_borders)
    seam = np.repeat(np.arange(len(seams.size)), seams.size)
    return State(rings, Work(rings, *all_flat(seams.start, seam, seams.in_tree.astype(np.int64), own)), found)


def reasons(seams: OutlineSeams, known: Peeled, meetings: Iterable[int]) -> Ints:
    """Return all crossings and feet from which it follows what is known around some of them, those included.

    The way leads back over all pairs from which something follows, to those known from the start.
    """
    found_pairs = Found(flat(known.upper), flat(known.port), flat(known.because), known.failed)
    state = _state(seams, seams.own, found_pairs)
    found = set(meetings)
    waiting = [pair for at in found for pair in _pairs_at(seams, known, at)]
    seen = set(waiting)
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


def _pairs_before(seams: OutlineSeams, state: State, pair: int, because: int) -> list[int]:
    """Return the pairs from which a pair follows, and perhaps more."""
    rings, work, found = state.rings, state.work, state.found
    if because == UNKNOWN:
        return []
    seam = int(work.seam[pair])
    start, end = seams.start[seam : seam + 2].tolist()
    if because == LEFT_OVER:
        return [other for other in range(start, end) if found.upper[other] >= 0]
    places = [rings.place[2 * seam + end] for end in range(2) if rings.at[2 * seam + end] == because]
    return [other for place in places for other in _ring(state, because, int(place), pair) if found.upper[other] >= 0]


def _ring(state: State, at: int, place: int, pair: int) -> Iterator[int]:
    """Yield the pairs around a crossing that are in a ring with a given one, at a place, as far as they are known."""
    rings, work, found = state.rings, state.work, state.found
    port, sheet = pair - int(work.start[work.seam[pair]]), int(found.upper[pair])
    lower = rings.bottom[at] + 1 if place == 2 and port == rings.bottom[at] else port
    corner = np.full(4, UNKNOWN)
    corner[[place, (place + 1) % 4]] = (sheet, lower) if place < 2 else (lower, sheet)
    for onward in (1, 2, 3, 2, 1):
        here, there = (place + onward) % 4, (place + onward + 1) % 4
        if corner[there] < 0 <= corner[here]:
            corner[there] = step(state, at, here, int(corner[here]), 1)
        elif corner[here] < 0 <= corner[there]:
            corner[here] = step(state, at, here, int(corner[there]), 0)
    for here in range(4):
        lower = int(corner[(here + 1) % 4 if here < 2 else here])
        seam, bottom = rings.around[4 * at + here], rings.bottom[at]
        port = bottom if here == 2 and lower == bottom + 1 else lower
        if seam >= 0 and 0 <= port < work.size[seam] and (here, lower) not in ((1, bottom + 1), (2, bottom)):
            yield int(work.start[seam]) + int(port)


def immersion_of(seams: OutlineSeams, upper: Ints) -> Immersion:
    """Build the immersion in which every port leads to a sheet."""
    arrangement = seams.arrangement
    seam = np.repeat(np.arange(len(seams.size)), seams.size)
    port = np.arange(len(upper)) - seams.start[seam]
    own = (port == seams.size[seam] - 1) & seams.is_border[seam]
    left = starts_of(arrangement.winding)[seams.left[seam]] + upper
    return Immersion(arrangement, left[own], left[~own].astype(np.int32))
