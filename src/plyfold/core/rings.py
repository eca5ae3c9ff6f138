"""Rings of sheets around crossings: what is glued, concluded from three pairs of a ring for the fourth, in hot loops.

First whole seams are found: where all but one around a crossing are known, the last one follows, port by port. That is
all there is to do for most outlines. Where several seams around a crossing stay open, every single pair is followed.
"""

from __future__ import annotations

from plyfold.core.buffers import WholeBuffer, rough_room, whole_room

__all__ = ["Found", "Rings", "State", "Work", "close_rings", "step"]

# Among reasons: the other pairs of the seam. See `immersion.peeling`.
_LEFT_OVER = -2
# Equal to no port and no sheet: the own sheet of a bridge.
_NO_OWN = -9


class Rings:
    """The seams around each crossing in the order of the ring: b to top, a to bottom, b to bottom, a to top.

    ``own_a`` is the port of a's own sheet in the seam a to top, and ``own_b`` of b's; −9 for a bridge. ``at`` has for
    each seam the crossings at both ends, and ``place`` its places in their rings; −1 where there is none. They are made
    from ``corners``, rows (a to top, a to bottom, b to top, b to bottom), the sheets over the ``bottom`` cells, and the
    ``size`` of each seam, borders before bridges.
    """

    def __init__(self, corners: WholeBuffer, bottom: WholeBuffer, size: WholeBuffer, borders: int) -> None:
        self.corners, self.bottom, self.size, self.borders = corners, bottom, size, borders
        self.around = rough_room(len(corners))
        self.own_a, self.own_b = rough_room(len(bottom)), rough_room(len(bottom))
        self.at, self.place = rough_room(2 * len(size)), rough_room(2 * len(size))
        self.fill()

    def fill(self) -> None:
        """Make all that follows from the corners."""
        for end in range(len(self.at)):
            self.at[end] = self.place[end] = -1
        for at in range(len(self.bottom)):
            first = 4 * at
            self.own_a[at] = self.own_port(self.corners[first], self.corners[first + 1])
            self.own_b[at] = self.own_port(self.corners[first + 2], self.corners[first + 3])
            self.around[first], self.around[first + 1] = self.corners[first + 2], self.corners[first + 1]
            self.around[first + 2], self.around[first + 3] = self.corners[first + 3], self.corners[first]
            for place in range(4):
                self.note_end(self.around[first + place], at, place)

    def own_port(self, top: int, bottom: int) -> int:
        """Return the port of a strand's own sheet in its seam to the top."""
        return self.size[top] - 1 if max(top, bottom) < self.borders else _NO_OWN

    def note_end(self, seam: int, at: int, place: int) -> None:
        """Note that a seam ends at a crossing."""
        if seam >= 0:
            end = 2 * seam if self.at[2 * seam] < 0 else 2 * seam + 1
            self.at[end], self.place[end] = at, place


class Work:
    """``missing`` ports of each seam are open; the sums of their numbers, and of the sheets not yet reached.

    ``open_around`` is how many seams around each crossing are partly open, −1 where nothing is left to conclude;
    crossings that may be ready wait in ``ready``. ``stack[:top]`` holds the pairs found from which nothing has been
    concluded yet. ``reason`` says from where something is being concluded.
    """

    def __init__(
        self,
        rings: Rings,
        start: WholeBuffer,
        seam: WholeBuffer,
        in_tree: WholeBuffer,
        own: WholeBuffer,
    ) -> None:
        self.start, self.size, self.seam, self.in_tree, self.own = start, rings.size, seam, in_tree, own
        crossings, seams = len(rings.bottom), len(rings.size)
        self.missing, self.sum_port, self.sum_upper = whole_room(seams), whole_room(seams), whole_room(seams)
        self.open_around, self.ready = whole_room(crossings), whole_room(5 * crossings)
        self.stack = whole_room(len(seam))
        self.top, self.reason = 0, -1
        self.count()

    def count(self) -> None:
        """Count all ports as open."""
        for number in range(len(self.size)):
            size = self.size[number]
            self.missing[number] = size
            self.sum_port[number] = self.sum_upper[number] = size * (size - 1) // 2


class Found:
    """See `immersion.peeling.Peeled`."""

    def __init__(self, upper: WholeBuffer, port: WholeBuffer, because: WholeBuffer, failed: int) -> None:
        self.upper, self.port, self.because, self.failed = upper, port, because, failed


class State:
    """All three together."""

    def __init__(self, rings: Rings, work: Work, found: Found) -> None:
        self.rings, self.work, self.found = rings, work, found


def close_rings(state: State) -> int:
    """Write down what is known of each seam, and conclude, until nothing new comes; 0 at a contradiction."""
    _write_names(state.work, state.found)
    if _find_whole_seams(state) == 0:
        return 0
    _recall_pairs(state)
    return _conclude(state)


def _write_names(work: Work, found: Found) -> None:
    """Write down the seams of tree links with known own sheets, and those that have no choice."""
    for seam in range(len(work.size)):
        own, last = work.own[seam], work.size[seam] - 1
        if own >= 0:
            for port in range(last):
                _glue(work, found, seam, port, port + 1 if port >= own else port)
            _glue(work, found, seam, last, own)
        elif last == 0:
            _glue(work, found, seam, 0, 0)


def _find_whole_seams(state: State) -> int:
    """Find the last seam around a crossing, as long as there is one, and compare all four where they are known."""
    rings, work = state.rings, state.work
    waiting = 0
    for at in range(len(rings.bottom)):
        work.open_around[at] = 0
        for place in range(4):
            seam = rings.around[4 * at + place]
            if seam >= 0 and work.missing[seam] > 0:
                work.open_around[at] += 1
        if work.open_around[at] <= 1:
            work.ready[waiting] = at
            waiting += 1
    while waiting > 0:
        waiting -= 1
        at = work.ready[waiting]
        if work.open_around[at] == 1:
            seam = _find_last_seam(state, at)
            if seam < 0:
                return _fail(state, at)
            waiting = _know(rings, work, seam, waiting)
        elif work.open_around[at] == 0 and _is_closed(state, at) == 0:
            return _fail(state, at)
        work.open_around[at] = -1
    return 1


def _fail(state: State, at: int) -> int:
    state.found.failed = at
    return 0


def _find_last_seam(state: State, at: int) -> int:
    """Find the only open seam around a crossing from the three others, and return it; −1 at a contradiction."""
    rings, work, found = state.rings, state.work, state.found
    place = 0
    while rings.around[4 * at + place] < 0 or work.missing[rings.around[4 * at + place]] == 0:
        place += 1
    seam, bottom = rings.around[4 * at + place], rings.bottom[at]
    work.reason = at
    for port in range(work.size[seam]):
        lower = bottom + 1 if place == 2 and port == bottom else port
        upper = _walk_round(state, at, place, lower)
        here, there = (upper, lower) if place < 2 else (lower, upper)
        if _join(state, at, place, here, there) == 0:
            return -1
        if work.in_tree[seam] == 1 and _keep_order(work, found, seam, port, found.upper[work.start[seam] + port]) == 0:
            return -1
    return seam


def _walk_round(state: State, at: int, place: int, lower: int) -> int:
    """Go from the lower corner at a place to the upper one, the other way round."""
    sheet = lower
    for step_on in range(1, 4):
        if place < 2:
            sheet = step(state, at, (place + step_on) % 4, sheet, 1)
        else:
            sheet = step(state, at, (place + 4 - step_on) % 4, sheet, 0)
    return sheet


def _know(rings: Rings, work: Work, seam: int, waiting: int) -> int:
    """Count a seam as known at both its ends, and have crossings wait that may be ready."""
    for end in range(2):
        at = rings.at[2 * seam + end]
        if at >= 0 and work.open_around[at] > 0:
            work.open_around[at] -= 1
            if work.open_around[at] <= 1:
                work.ready[waiting] = at
                waiting += 1
    return waiting


def _is_closed(state: State, at: int) -> int:
    """Compare the four seams around a crossing that are known: 0 if a sheet over the top cell does not come back."""
    rings, work = state.rings, state.work
    top = max(rings.around[4 * at], rings.around[4 * at + 3])
    for sheet in range(work.size[top]):
        here = sheet
        for place in range(4):
            here = step(state, at, place, here, 1)
        if here != sheet:
            return 0
    return 1


def _recall_pairs(state: State) -> None:
    """Have all pairs wait that are known of seams with an end where others are open."""
    rings, work, found = state.rings, state.work, state.found
    work.top = 0
    for seam in range(len(work.size)):
        for end in range(2):
            at = rings.at[2 * seam + end]
            if at >= 0 and work.open_around[at] > 0 and (end == 0 or _is_settled(rings, work, rings.at[2 * seam])):
                for port in range(work.start[seam], work.start[seam + 1]):
                    if found.upper[port] >= 0:
                        work.stack[work.top] = port
                        work.top += 1


def _is_settled(rings: Rings, work: Work, at: int) -> bool:
    """Tell whether nothing is left to conclude around a crossing, or there is none."""
    return at < 0 or work.open_around[at] <= 0


def _glue(work: Work, found: Found, seam: int, port: int, sheet: int) -> int:
    """Note that a port leads to a sheet, and what that leaves for the last port of the seam; 0 if it cannot be."""
    start = work.start[seam]
    if port < 0 or port >= work.size[seam] or sheet < 0 or sheet >= work.size[seam]:
        return 0
    if found.upper[start + port] == sheet:
        return 1
    reason = work.reason
    while True:
        if found.upper[start + port] >= 0 or found.port[start + sheet] >= 0:
            return 0
        found.upper[start + port], found.port[start + sheet] = sheet, port
        found.because[start + port], reason = reason, _LEFT_OVER
        work.stack[work.top] = start + port
        work.top += 1
        work.missing[seam] -= 1
        work.sum_port[seam] -= port
        work.sum_upper[seam] -= sheet
        if work.missing[seam] != 1:
            return 1
        port, sheet = work.sum_port[seam], work.sum_upper[seam]


def _conclude(state: State) -> int:
    """Go round the crossings at both ends of all seams with something new; 0 at a contradiction."""
    rings, work, found = state.rings, state.work, state.found
    while work.top > 0:
        work.top -= 1
        here = work.stack[work.top]
        seam, sheet = work.seam[here], found.upper[here]
        port = here - work.start[seam]
        work.reason = _LEFT_OVER
        if work.in_tree[seam] == 1 and _keep_order(work, found, seam, port, sheet) == 0:
            found.failed = rings.at[2 * seam]
            return 0
        for end in range(2):
            at = work.reason = rings.at[2 * seam + end]
            if at >= 0 and _go_round(state, at, rings.place[2 * seam + end], port, sheet) == 0:
                found.failed = at
                return 0
    return 1


def _keep_order(work: Work, found: Found, seam: int, port: int, sheet: int) -> int:
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


def _go_round(state: State, at: int, place: int, port: int, sheet: int) -> int:
    """Conclude the fourth pair around a crossing, where with a new one three are known; 0 at a contradiction.

    The corners are in the top cell, on a's left and b's right, in the bottom cell, and on the other side; the seam at
    place i lies between corners i and i + 1.
    """
    bottom = state.rings.bottom[at]
    lower = bottom + 1 if place == 2 and port == bottom else port
    here, there = (sheet, lower) if place < 2 else (lower, sheet)
    after = step(state, at, (place + 1) % 4, there, 1)
    before = step(state, at, (place + 3) % 4, here, 0)
    if after >= 0 and before >= 0:
        return _join(state, at, (place + 2) % 4, after, before)
    if after >= 0:
        after = step(state, at, (place + 2) % 4, after, 1)
        return 1 if after < 0 else _join(state, at, (place + 3) % 4, after, here)
    if before >= 0:
        before = step(state, at, (place + 2) % 4, before, 0)
        return 1 if before < 0 else _join(state, at, (place + 1) % 4, there, before)
    return 1


def step(state: State, at: int, place: int, sheet: int, onward: int) -> int:
    """Go from a sheet at one corner across a seam to the next corner, or back; −1 if that is not known.

    Over the bottom cell, a's boundary has the number of sheets there, and b's one more. Over the side that a has left,
    b's boundary goes on as the port of b's own sheet, and over the other side a's.
    """
    rings, work, found = state.rings, state.work, state.found
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


def _join(state: State, at: int, place: int, here: int, there: int) -> int:
    """Note that two sheets at neighbouring corners are glued; 0 if they cannot be."""
    rings, work, found = state.rings, state.work, state.found
    seam, bottom = rings.around[4 * at + place], rings.bottom[at]
    lower, upper = (there, here) if place < 2 else (here, there)
    if place == 1 and (lower == bottom + 1 or upper == rings.own_b[at]):
        return 1 if lower == bottom + 1 and upper == rings.own_b[at] else 0
    if place == 2 and (lower == bottom or upper == rings.own_a[at]):
        return 1 if lower == bottom and upper == rings.own_a[at] else 0
    port = bottom if place == 2 and lower == bottom + 1 else lower
    if seam < 0:
        return 1 if port == upper else 0
    return _glue(work, found, seam, port, upper)
