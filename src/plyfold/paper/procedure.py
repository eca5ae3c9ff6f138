"""The paper's own procedure for one immersion: Algorithms 1 to 3 of §2.3 of [MGR11]_.

The borders are taken in order of the winding number of their cells. Each is joined by an arc in the disk layout to the
next border of the same cell, if that is a *valid construction*; first everything between the two is processed in the
same way. Borders joined by arcs form a group: they share a sheet. :func:`run_paper` forms the groups, and
:func:`find_immersion` glues and checks the sheets. The choice of arcs is greedy, and it can fail on a curve that
bounds a disk; then the obstruction says that the procedure failed, not that there is no immersion.

The pseudo-code leaves open what to do in the places below. The numbers come back in the comments.

1. *Which side?* The paper has the disk on the right of the curve. Here it is on the left, and a border belongs to the
   cell on its left; the lists are the same ones in mirror image.
2. *Next in the w-list* has two ends to it. The list is circular, so after the last border comes the first one of the
   lowest winding number that is left; heads and next borders are always ones not yet removed.
3. *Next of a border that has been removed* meanwhile: what followed it when it was removed, and so on.
4. *Adjacent borders of a cell* are those that meet at a corner of the cell, that is, at a crossing: there they are
   never on one sheet. Borders that are merely next to each other in the f-list may be joined.
5. *Which arcs may not be crossed?* All arcs drawn so far, and those for which RECURSE is still running: the worked
   example groups two borders first and then processes those between them, though the pseudo-code draws the arc last.
6. *RECURSE: the arc is drawn if F = C and F = W.* Read literally, an arc across the end of the w-list waits for all
   higher borders everywhere. The reading taken is "nothing is left between M and F", in the c-list or in the w-list.
7. *RECURSE: "else if N = next[M] in w:list"* compares with an N that has no value; if it assigns, the last branch is
   never reached. The reading taken, from the worked example: if the next border in the w-list lies between M and F,
   process that one, otherwise process the next in the c-list.
8. *PROCESS is called again* for a border removed meanwhile: nothing is left to do.
9. *Termination.* Nothing rules out that PROCESS(M) leads back to PROCESS(M). If nothing has been removed or drawn
   in between, the procedure would go on like that for ever, and counts as stuck.
10. *Wrong arcs between the same groups* are found by Algorithm 1 at the end only if a cell has too many groups; it
    never asks whether the sheets can be glued. Here they are glued, and the result is checked against the definition.

There is a second reading, ``"repaired"``, with two changes that the paper's prose suggests. An arc parts the borders
left into two *partitions*, and each is processed by itself, lowest winding number first, without looking at the other:
that is one way to understand "within each partition the borders are recursively processed". And a valid construction
must cut off a closed curve that turns once, since each part must bound a disk again: the turning condition. It is still
greedy, but far more often right; docs/paper.md has the figures.

References
----------
.. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
   Sketch-Based Interfaces and Modeling, 2011.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange
from plyfold.graphs import representative
from plyfold.immersion.dual_tree import around_cells, grow_dual_tree
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.obstructions import visible_obstruction
from plyfold.obstruction import Obstruction
from plyfold.paper.gluing import glue_layout

__all__ = ["PaperRun", "Reading", "find_immersion", "run_paper"]

Reading: TypeAlias = Literal["literal", "repaired"]
_Arc: TypeAlias = tuple[int, int]
Call: TypeAlias = Iterator["Call"]


@dataclass(frozen=True)
class PaperRun:
    """What the procedure did.

    Parameters
    ----------
    groups : tuple of tuple of int
        The borders that were joined, each group in order, groups in order of their first borders.
    arcs : tuple of (int, int)
        The arcs, in the order in which they were begun.
    calls : int
        How often PROCESS and RECURSE were entered, tail calls included.
    stuck_at : int or None
        The border at which the procedure went round in circles; None if it came to its end.

    Examples
    --------
    >>> from plyfold import arrange
    >>> run_paper(arrange([(0, 0), (1, 0), (0, 1)])).groups
    ((0,),)
    """

    groups: tuple[tuple[int, ...], ...]
    arcs: tuple[_Arc, ...]
    calls: int
    stuck_at: int | None = None


def find_immersion(curve: CurveLike, reading: Reading = "literal") -> Immersion | Obstruction:
    """Look for an immersion by the paper's greedy procedure (§2.3 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
    reading : {"literal", "repaired"}
        How the pseudo-code is understood; see :mod:`plyfold.paper.procedure`.

    Returns
    -------
    Immersion or Obstruction
        The immersion has been checked against the definition. An obstruction is a turning number other than 1, a
        negative winding number, or, with the reason ``"paper's procedure"`` and a border as its value, says only that
        the procedure failed: :func:`plyfold.find_immersion` decides.

    Notes
    -----
    The calls grow linearly with the number of borders unless the procedure gets stuck; each compares with all arcs
    drawn so far.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> [group.borders for group in find_immersion(ramp).disk_layout()]
    [(0, 6), (1, 5), (2, 4), (3,), (7,)]
    """
    arranged = arrange(curve)
    obstruction = visible_obstruction(arranged)
    if obstruction is not None:
        return obstruction
    run = run_paper(arranged, reading)
    if run.stuck_at is not None:
        return _failed(arranged, run.stuck_at, "went round in circles at")
    crowded = _crowded_group(arranged, run.groups)
    if crowded is not None:
        return _failed(arranged, crowded, "made more groups than the cell has sheets on the left of")
    immersion = glue_layout(arranged, run.groups)
    if immersion is None:
        largest = max(run.groups, key=len)
        return _failed(arranged, largest[0], "made groups that cannot be glued; the largest begins at")
    return immersion


def run_paper(arranged: Arrangement, reading: Reading = "literal") -> PaperRun:
    """Group the borders by the paper's procedure, without looking whether the groups make an immersion.

    Parameters
    ----------
    arranged : Arrangement
    reading : {"literal", "repaired"}

    Returns
    -------
    PaperRun

    Examples
    --------
    >>> limacon = Arrangement.from_gauss([1, 0], [True, False], outer=1)
    >>> run_paper(limacon)
    PaperRun(groups=((0,), (1,)), arcs=(), calls=2, stuck_at=None)
    """
    return _literal(arranged) if reading == "literal" else _repaired(arranged)


def _crowded_group(arranged: Arrangement, groups: tuple[tuple[int, ...], ...]) -> int | None:
    """Return a border of a cell that has more groups than its winding number, the error of Algorithm 1."""
    cells = arranged.left_cell.tolist()
    count = Counter(cells[group[0]] for group in groups)
    return next((group[0] for group in groups if count[cells[group[0]]] > arranged.winding[cells[group[0]]]), None)


def _failed(arranged: Arrangement, border: int, what: str) -> Obstruction:
    sentence = f"The paper's procedure {what} border {border}; that does not mean that there is no immersion."
    points = arranged.border_points(border).tolist() if arranged.curve is not None else []
    middle = tuple((x, y) for x, y in points[len(points) // 2 :][:1])
    return Obstruction("paper's procedure", sentence, middle, border, arranged)


def _joined(n_borders: int, arcs: Iterable[_Arc]) -> tuple[tuple[int, ...], ...]:
    """Return the groups that the arcs make."""
    group = list(range(n_borders))
    for m, f in arcs:
        low, high = sorted((representative(group, m), representative(group, f)))
        group[high] = low
    members: dict[int, list[int]] = {}
    for border in range(n_borders):
        members.setdefault(representative(group, border), []).append(border)
    return tuple(map(tuple, members.values()))


# ---- Algorithms 1 to 3 ---------------------------------------------------------------------------------------------


class _CircularList:
    """A circular linked list of borders, one of the paper's three kinds."""

    def __init__(self, borders: list[int]) -> None:
        self._after = dict(zip(borders, borders[1:] + borders[:1], strict=True))
        self._before = {after: border for border, after in self._after.items()}
        self._removed: set[int] = set()

    def next(self, border: int) -> int:
        """Return the next border that is still in the list; from the last one, itself (notes 2 and 3)."""
        after = self._after[border]
        while after in self._removed and after != self._after[after]:
            after = self._after[after]
        return after

    def remove(self, border: int) -> None:
        before, after = self._before[border], self._after[border]
        self._after[before], self._before[after] = after, before
        self._removed.add(border)


@dataclass
class _State:
    """The three lists and the arcs. One f-list serves all borders of its cell."""

    arranged: Arrangement
    c_list: _CircularList
    w_list: _CircularList
    f_list: list[_CircularList]
    next_dart: list[int]
    removed: set[int] = field(default_factory=set)
    arcs: dict[_Arc, None] = field(default_factory=dict)
    entered: dict[int, int] = field(default_factory=dict)
    calls: int = 0

    @property
    def progress(self) -> int:
        """How much has been removed and drawn; it never shrinks."""
        return len(self.removed) + len(self.arcs)


class _CircleError(Exception):
    """PROCESS was called for a border for which it was running already, and nothing had changed (note 9)."""


def _literal(arranged: Arrangement) -> PaperRun:
    """Algorithm 1, DETERMINE IMMERSION, but for its final test."""
    by_winding = _by_winding(arranged)
    state = _start(arranged, by_winding)
    for border in by_winding:
        while border not in state.removed:
            try:
                _run(_process(state, border))
            except _CircleError as circle:
                return PaperRun((), tuple(state.arcs), state.calls, stuck_at=circle.args[0])
    return PaperRun(_joined(arranged.n_borders, state.arcs), tuple(state.arcs), state.calls)


def _start(arranged: Arrangement, by_winding: list[int]) -> _State:
    cells = arranged.left_cell.tolist()
    members: dict[int, list[int]] = {}
    for border, cell in enumerate(cells):
        members.setdefault(cell, []).append(border)
    lists = {cell: _CircularList(borders) for cell, borders in members.items()}
    borders = list(range(arranged.n_borders))
    return _State(
        arranged,
        c_list=_CircularList(borders),
        w_list=_CircularList(by_winding),
        f_list=[lists[cell] for cell in cells],
        next_dart=arranged.next_dart.tolist(),
    )


def _by_winding(arranged: Arrangement) -> list[int]:
    winding = arranged.winding[arranged.left_cell].tolist()
    return sorted(range(arranged.n_borders), key=lambda border: (winding[border], border))


def _run(call: Call) -> None:
    """Run a call and the calls that it yields, on a stack of our own, as they can be nested thousands deep."""
    stack = [call]
    while stack:
        inner = next(stack[-1], None)
        if inner is None:
            stack.pop()
        else:
            stack.append(inner)


def _process(state: _State, m: int) -> Call:
    """Algorithm 2, PROCESS(M). Its last line, PROCESS M, is the loop (note 8)."""
    if state.entered.get(m) == state.progress:
        raise _CircleError(m)
    state.entered[m] = state.progress
    f_list = state.f_list[m]
    while m not in state.removed:
        state.calls += 1
        f = f_list.next(m)
        if f == m:
            _remove(state, m)
        elif _is_valid(state, m, f):
            yield _recurse(state, m, f)
            _remove(state, m)
        else:
            n = f_list.next(f)
            while _is_valid(state, f, n):
                yield _recurse(state, f, n)
                _remove(state, f)
                f, n = n, f_list.next(n)
            _remove(state, f)


def _recurse(state: _State, m: int, f: int) -> Call:
    """Algorithm 3, RECURSE(M, F). Each way out of its branches but the first is RECURSE(M, F) again: the loop."""
    state.arcs[m, f] = None  # note 5
    while True:
        state.calls += 1
        c, w = state.c_list.next(m), state.w_list.next(m)
        following = w if _is_left_between(state, m, w, f) else c  # note 7
        if not _is_left_between(state, m, following, f):  # note 6
            _remove(state, m)
            return
        yield _process(state, following)


def _is_left_between(state: _State, m: int, border: int, f: int) -> bool:
    n = state.arranged.n_borders
    return border not in state.removed and 0 < (border - m) % n < (f - m) % n


def _remove(state: _State, border: int) -> None:
    if border not in state.removed:
        state.removed.add(border)
        for border_list in (state.c_list, state.w_list, state.f_list[border]):
            border_list.remove(border)


def _is_valid(state: _State, m: int, f: int) -> bool:
    """Tell whether an arc from M to F is a valid construction (notes 4 and 5)."""
    return m != f and not _adjacent(state.next_dart, m, f) and not any(_cross(m, f, *arc) for arc in state.arcs)


def _adjacent(next_dart: list[int], m: int, f: int) -> bool:
    return next_dart[2 * m] == 2 * f or next_dart[2 * f] == 2 * m


def _cross(m: int, f: int, a: int, b: int) -> bool:
    """Tell whether two arcs cross; arcs that end on one border need not."""
    low, high = min(m, f), max(m, f)
    return len({m, f, a, b}) == 4 and (low < a < high) != (low < b < high)


# ---- the repaired reading ------------------------------------------------------------------------------------------


def _repaired(arranged: Arrangement) -> PaperRun:
    """Part the borders by arcs, each partition by itself; an arc goes to the next border that may be joined."""
    may_join = _cuts_off_a_disk(arranged)
    cells, following = arranged.left_cell.tolist(), arranged.next_dart.tolist()
    winding = arranged.winding[arranged.left_cell].tolist()
    partitions = [list(range(arranged.n_borders))]
    arcs: list[_Arc] = []
    calls = 0
    while partitions:
        rest = partitions.pop()
        while rest:
            calls += 1
            lowest = min(range(len(rest)), key=lambda place: winding[rest[place]])
            rest = rest[lowest:] + rest[:lowest]
            m = rest[0]
            same_cell = (place for place in range(1, len(rest)) if cells[rest[place]] == cells[m])
            allowed = (p for p in same_cell if not _adjacent(following, m, rest[p]) and may_join(m, rest[p]))
            place = next(allowed, None)
            if place is not None:
                arcs.append((m, rest[place]))
                partitions.append(rest[1:place])
            rest = rest[place or 1 :]
    return PaperRun(_joined(arranged.n_borders, arcs), tuple(arcs), calls)


def _cuts_off_a_disk(arranged: Arrangement) -> Callable[[int, int], bool]:
    """Return the turning condition for an arc between two borders of a cell: the curve that it cuts off turns once.

    On its way from M to F the curve must turn as much as the boundary of the cell does from M to F. Both are counted in
    quarter turns, from the start of the curve and of the cell's boundary; each gains a full turn where it starts anew.
    """
    turning = grow_dual_tree(arranged).turning
    position, since_start = around_cells(arranged, turning)
    potential = (np.cumsum(turning) - turning - since_start[0::2]).tolist()
    place: list[int] = position[0::2].tolist()
    return lambda m, f: potential[f] - potential[m] == 4 * ((place[f] < place[m]) - (f < m))
