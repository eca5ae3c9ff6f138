"""Pen strokes joined into one closed loop.

The strokes "form parts of the entire loop and need not be in order" (§4 of the paper).

Every stroke has two ends: end ``2 i`` is the first point of stroke ``i``, end ``2 i + 1`` its last. A loop visits the
strokes one after the other; it is written as the list of the ends at which it enters them, so that it leaves the one
entered at ``e`` at ``e ^ 1``. The best loop has the least total gap from each leaving to the next entering; where
several strokes end in one place, so that joinings are equally short, the one that runs on straightest is best.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Set

import numpy as np
import numpy.typing as npt

from plyfold.errors import InputError, StrokeError
from plyfold.mistaken import mistaken_value
from plyfold.outline.points import Repair, as_planar_points, diagonal, refuse_mistake

__all__ = ["MOST_STROKES", "join_strokes"]

MOST_STROKES = 1000
"""More strokes than this are refused: joining takes memory with their number squared."""

_MOST_STROKES_OPTIMAL = 9
_GAP_SHARE = 0.1
_TURN_SHARE = 1e-9  # of the longest gap: what turning back costs, only enough to decide between equal gaps

_Points = npt.NDArray[np.float64]


def join_strokes(strokes: Iterable[npt.ArrayLike], max_gap: float | None = None) -> tuple[_Points, tuple[Repair, ...]]:
    """Join strokes, given in any order and direction, into one closed loop.

    Up to nine strokes are joined so that the total length of the gaps is least; more are joined by nearest ends first,
    then improved by turning round parts of the loop as long as that makes the total shorter. Of equally short loops the
    one that runs on straightest is taken, and always the same one, whatever the order and directions of the strokes.

    Parameters
    ----------
    strokes : iterable of array-likes, each of shape (m, 2) or (m, 3)
        Empty strokes are ignored; a stroke of one point is a place that the loop passes through. A third column is
        left out.
    max_gap : float, optional
        Longest gap that may be bridged, in the units of the points; by default a tenth of the diagonal of the bounding
        box of all points.

    Returns
    -------
    points : ndarray, shape (n, 2)
        The loop, closed implicitly; it starts with the first stroke in its given direction. Ends that coincide
        become one point.
    repairs : tuple of Repair
        One ``"gap bridged"`` for each gap, in order along the loop: its midpoint and length; before them
        ``"z left out"``, if some stroke had a third column.

    Raises
    ------
    StrokeError
        If there is no stroke, there are more than ``MOST_STROKES``, or a gap is longer than ``max_gap``.
    CurveError
        If a stroke has a point that is not finite or not a point.

    Notes
    -----
    At most 2^k k² steps for k ≤ 9 strokes, O(k² log k) and usually few rounds of O(k²) beyond.

    Examples
    --------
    >>> points, repairs = join_strokes([[(0, 0), (4, 0)], [(0, 3), (0, 0)], [(0, 3), (4, 0.5)]])
    >>> points.tolist()
    [[0.0, 0.0], [4.0, 0.0], [4.0, 0.5], [0.0, 3.0]]
    >>> print(*repairs)
    gap bridged at (4, 0.25), size 0.5
    """
    if not isinstance(strokes, Iterator | Set):
        refuse_mistake(mistaken_value(strokes))
    numbered = [(number, *found) for number, found in enumerate(map(as_planar_points, strokes)) if len(found[0])]
    numbers, given = [number for number, *_ in numbered], [stroke for _, stroke, _ in numbered]
    flattened = [repair for *_, repairs in numbered for repair in repairs]
    if not given:
        raise StrokeError("there is no stroke", hint="give at least one stroke with points")
    if len(given) > MOST_STROKES:
        raise StrokeError(f"there are {len(given)} strokes, more than {MOST_STROKES}", hint="join some of them first")
    loop = _loop(given)
    ends = _ends(given)
    _refuse_wide_gaps(ends, loop, _largest_gap(given, max_gap), numbers)
    return _chain(given, loop), (*flattened[:1], *_bridges(ends, loop))


def _ends(strokes: list[_Points]) -> _Points:
    return np.array([end for stroke in strokes for end in (stroke[0], stroke[-1])])


def _largest_gap(strokes: list[_Points], max_gap: float | None) -> float:
    if max_gap is None:
        return _GAP_SHARE * diagonal(np.concatenate(strokes))
    if not max_gap >= 0:
        raise InputError(f"max_gap is {max_gap}", hint="give a length, at least 0")
    return max_gap


def _loop(strokes: list[_Points]) -> list[int]:
    """Return the entered ends of the best loop from end 0 on, solved on a list that all orders and directions share."""
    turned = [_is_turned(stroke) for stroke in strokes]
    order = sorted(range(len(strokes)), key=lambda i: (strokes[i][::-1] if turned[i] else strokes[i]).tolist())
    original_end = [2 * i + (side ^ turned[i]) for i in order for side in (0, 1)]
    costs = _joining_costs(_ends(strokes)[original_end], _headings(strokes)[original_end])
    optimal = len(strokes) <= _MOST_STROKES_OPTIMAL
    best = _shortest_loop(costs) if optimal else _improved(_nearest_ends_loop(costs), costs)
    return _starting_at_first_stroke([original_end[end] for end in best])


def _is_turned(stroke: _Points) -> bool:
    return bool(stroke[::-1].tolist() < stroke.tolist())


def _headings(strokes: list[_Points]) -> _Points:
    """Return the unit vector in which each end points out of its stroke; zero for a stroke of one place."""
    return np.array([_heading(way) for stroke in strokes for way in (stroke[::-1], stroke)])


def _heading(stroke: _Points) -> _Points:
    steps = stroke[-1] - stroke
    step = steps[np.flatnonzero(steps.any(axis=1))[-1:]].sum(axis=0)
    length = float(np.hypot(*step))
    return np.asarray(step / (length or 1.0))


def _joining_costs(ends: _Points, headings: _Points) -> _Points:
    """Return for each pair of ends the gap between them, plus next to nothing for turning."""
    gaps = np.hypot(*(ends[:, None] - ends).T)
    turns = 1 + np.einsum("ik,jk->ij", headings, headings)
    return np.asarray(gaps + _TURN_SHARE * (float(gaps.max()) or 1.0) * turns)


def _starting_at_first_stroke(loop: list[int]) -> list[int]:
    if 0 not in loop:
        loop = _turned_round(loop)
    start = loop.index(0)
    return loop[start:] + loop[:start]


def _turned_round(loop: list[int]) -> list[int]:
    return [end ^ 1 for end in reversed(loop)]


def _shortest_loop(costs: _Points) -> list[int]:
    """Find the best loop by the cheapest paths from end 0 through each set of strokes (Held and Karp)."""
    count = len(costs) // 2
    paths: dict[tuple[int, int], tuple[float, list[int]]] = {(1, 0): (0.0, [0])}
    for _ in range(count - 1):
        longer: dict[tuple[int, int], tuple[float, list[int]]] = {}
        for (visited, last), (length, path) in paths.items():
            for end in range(2 * count):
                if visited >> (end >> 1) & 1:
                    continue
                state = (visited | 1 << (end >> 1), end)
                total = length + float(costs[last ^ 1, end])
                if state not in longer or total < longer[state][0]:
                    longer[state] = (total, [*path, end])
        paths = longer
    return min((length + float(costs[last ^ 1, 0]), path) for (_, last), (length, path) in paths.items())[1]


def _nearest_ends_loop(costs: _Points) -> list[int]:
    """Join the nearest two free ends again and again, never closing a loop before all strokes are in it."""
    count = len(costs)
    first, second = np.triu_indices(count, 1)
    far_end = [end ^ 1 for end in range(count)]  # of the chain that begins at this end, while the end is free
    joined = [-1] * count
    for pair in np.argsort(costs[first, second], kind="stable").tolist():
        a, b = int(first[pair]), int(second[pair])
        if joined[a] < 0 and joined[b] < 0 and far_end[a] != b:
            joined[a], joined[b] = b, a
            far_a, far_b = far_end[a], far_end[b]
            far_end[far_a], far_end[far_b] = far_b, far_a
    loop = [joined.index(-1)]
    while len(loop) < count // 2:
        loop.append(joined[loop[-1] ^ 1])
    return loop


def _improved(loop: list[int], costs: _Points) -> list[int]:
    """Turn round the part of the loop that saves most, until none saves more than rounding (2-opt)."""
    entered = np.array(loop)
    smallest_saving = 1e-12 * float(costs.max())
    for _ in range(10 * len(loop)):
        left_before = np.roll(entered, 1) ^ 1
        entered_after = np.roll(entered, -1)
        now = costs[left_before, entered]
        # saving[i, j]: turn round the strokes from the i-th to the j-th
        turned = costs[left_before[:, None], entered ^ 1] + costs[entered[:, None], entered_after]
        saving = np.triu(now[:, None] + np.roll(now, -1) - turned)
        saving[0, -1] = 0.0
        i, j = np.unravel_index(np.argmax(saving), saving.shape)
        if saving[i, j] <= smallest_saving:
            break
        entered[i : j + 1] = entered[i : j + 1][::-1] ^ 1
    return [int(end) for end in entered]


def _gap_ends(loop: list[int]) -> list[tuple[int, int]]:
    """Return for each stroke along the loop the end at which it is left and the end entered next."""
    return [(end ^ 1, following) for end, following in zip(loop, loop[1:] + loop[:1], strict=True)]


def _refuse_wide_gaps(ends: _Points, loop: list[int], largest: float, numbers: list[int]) -> None:
    leaving, entering = max(_gap_ends(loop), key=lambda gap: float(np.hypot(*(ends[gap[0]] - ends[gap[1]]))))
    length = float(np.hypot(*(ends[leaving] - ends[entering])))
    if length > largest:
        left, entered = (
            f"the {('start', 'end')[end % 2]} of stroke {numbers[end // 2]}" for end in (leaving, entering)
        )
        gap = f"{left} is {length:.3g} away from {entered}"
        raise StrokeError(
            f"{gap}, more than the largest gap that is bridged, {largest:.3g}",
            where=[ends[leaving], ends[entering]],
            hint="draw the missing part (in Python, Curve.from_strokes takes a larger max_gap)",
        )


def _chain(strokes: list[_Points], loop: list[int]) -> _Points:
    pieces = [strokes[end >> 1][:: -1 if end & 1 else 1] for end in loop]
    following = pieces[1:] + pieces[:1]
    return np.concatenate([_without_shared_end(piece, after) for piece, after in zip(pieces, following, strict=True)])


def _without_shared_end(piece: _Points, after: _Points) -> _Points:
    return piece[:-1] if len(piece) > 1 and np.array_equal(piece[-1], after[0]) else piece


def _bridges(ends: _Points, loop: list[int]) -> tuple[Repair, ...]:
    bridges = []
    for leaving, entering in _gap_ends(loop):
        a, b = ends[leaving], ends[entering]
        if length := float(np.hypot(*(b - a))):
            x, y = ((a + b) / 2).tolist()
            bridges.append(Repair("gap bridged", (x, y), length))
    return tuple(bridges)
