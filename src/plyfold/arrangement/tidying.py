"""Curves with fewer points, or smoother ones, that cross themselves as before: proved by comparing their codes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import InputError
from plyfold.options import refuse_unless_count, refuse_unless_flag, refuse_unless_number
from plyfold.outline.curve import Curve, Outline

__all__ = ["each_tidied", "simplified", "smoothed"]

# A point that still changes the code after its move was halved so often stays where it is.
_MOST_HALVINGS = 8

# More rounds of smoothing are refused: they would take long, and of most curves hardly more than a point is left.
_MOST_ROUNDS = 10_000


def each_tidied(outline: Outline, keep_code: bool, tidied: Callable[[Curve], Curve]) -> Outline:
    """Return an outline all of whose loops have been tidied; of several, no code can be kept."""
    refuse_unless_flag("keep_code", keep_code)
    if outline.n_loops == 1:
        return tidied(outline.curves[0])
    if keep_code:
        hint = "leave keep_code out, or take each of outline.curves by itself"
        raise InputError(f"keep_code keeps the code of one loop, and this outline has {outline.n_loops}", hint=hint)
    return Outline([tidied(curve) for curve in outline.curves], repairs=outline.repairs)


def simplified(curve: Curve, tolerance: float, keep_code: bool) -> Curve:
    """Return a curve with some of its points, see :meth:`Curve.simplified <plyfold.Curve.simplified>`."""
    refuse_unless_number("tolerance", tolerance)
    refuse_unless_flag("keep_code", keep_code)
    if not tolerance >= 0:
        raise InputError(f"the tolerance is a distance, and not {tolerance:g}")
    kept = curve.cusps[0] > 0
    kept[[0, _farthest(curve.points, curve.points[:1])]] = True
    wanted = arrange(curve) if keep_code else None
    while True:
        _keep_what_is_far(curve.points, kept, tolerance)  # also after a split: the others may be far from its edges
        found = _of_points(curve, kept)
        if found is None:
            _split(curve.points, kept, np.arange(int(kept.sum())))
        elif wanted is None or _is_alike(wanted, curve, found, kept):
            return found


def _of_points(curve: Curve, kept: Bools) -> Curve | None:
    """Return the curve with some of its points; None if these are not enough, or some lie on one another."""
    try:
        found = Curve(curve.points[kept], curve.repairs, curve.cusps[0][kept])
    except InputError:
        return None
    return found if len(found) == kept.sum() else None


def _farthest(points: Floats, line: Floats) -> int:
    """Return the number of the point that is farthest from a segment, or from a point."""
    return int(_distances(points, line).argmax())


def _distances(points: Floats, line: Floats) -> Floats:
    """Return the squares of the distances from a segment between the first and the last of some points."""
    start, along = line[0], line[-1] - line[0]
    away = points - start
    length = float(along @ along)
    share = np.clip(away @ along / length, 0, 1) if length else np.zeros(len(points))
    return np.asarray(((away - share[:, None] * along) ** 2).sum(axis=1))


def _keep_what_is_far(points: Floats, kept: Bools, tolerance: float) -> None:
    """Keep more points until all others are within the tolerance of the edges between them (Douglas and Peucker)."""
    n = len(points)
    ends = np.flatnonzero(kept)
    waiting = list(zip(ends.tolist(), [*ends[1:].tolist(), n], strict=True))
    while waiting:
        start, end = waiting.pop()
        inner = points[start + 1 : end]
        if not len(inner):
            continue
        distance = _distances(inner, points[[start, end % n]])
        if distance.max() > tolerance**2:
            middle = start + 1 + int(distance.argmax())
            kept[middle] = True
            waiting += [(start, middle), (middle, end)]


def _split(points: Floats, kept: Bools, edges: Ints) -> None:
    """Keep one more point along each of some edges, the farthest one."""
    ends = np.append(np.flatnonzero(kept), len(points))
    for edge in edges.tolist():
        start, end = int(ends[edge]), int(ends[edge + 1])
        if end - start > 1:
            kept[start + 1 + _farthest(points[start + 1 : end], points[[start, end % len(points)]])] = True


def _is_alike(wanted: Arrangement, curve: Curve, simpler: Curve, kept: Bools) -> bool:
    """Tell whether the points that are kept have the same code; if not, keep more where it differs."""
    found = arrange(simpler)
    if kept.all() or _same_code(wanted, found):
        return True
    before, after = _crossed(wanted, np.cumsum(kept) - 1), _crossed(found, np.arange(len(simpler)))
    edges = np.array([edge for edge in range(len(simpler)) if before[edge] != after[edge]], dtype=np.int64)
    long = np.diff(np.append(np.flatnonzero(kept), len(kept)))[edges] > 1
    _split(curve.points, kept, edges[long] if long.any() else np.arange(len(simpler)))
    return False


def _same_code(wanted: Arrangement, found: Arrangement) -> bool:
    same = [np.array_equal(getattr(wanted, name), getattr(found, name)) for name in ("partner", "ccw", "cusp_index")]
    return all(same) and wanted.reversed == found.reversed and int(found.cell_of_dart[wanted.outer]) == 0


def _crossed(arranged: Arrangement, stretch: Ints) -> dict[int, list[tuple[int, bool]]]:
    """Return what each stretch of a curve crosses, in order, from the stretch of each of its edges."""
    assert arranged.outline is not None
    edge = arranged.outline.next_point[arranged.visit_edge] if arranged.reversed else arranged.visit_edge
    of_visit = stretch[arranged.numbers[edge]]
    crossed: dict[int, list[tuple[int, bool]]] = defaultdict(list)
    for here, there, ccw in zip(
        of_visit.tolist(), of_visit[arranged.partner].tolist(), arranged.ccw.tolist(), strict=True
    ):
        crossed[here].append((there, ccw))
    return crossed


def smoothed(curve: Curve, rounds: int, keep_code: bool) -> Curve:
    """Return a curve whose points have moved, see :meth:`Curve.smoothed <plyfold.Curve.smoothed>`."""
    refuse_unless_count("rounds", rounds, most=_MOST_ROUNDS)
    refuse_unless_flag("keep_code", keep_code)
    fixed = curve.cusps[0] > 0
    goal = curve.points.copy()
    for _ in range(rounds):
        before = goal
        goal = np.where(fixed[:, None], goal, (np.roll(goal, 1, axis=0) + 2 * goal + np.roll(goal, -1, axis=0)) / 4)
        if np.array_equal(goal, before):
            break
    if not keep_code:
        return Curve(goal, curve.repairs, curve.cusps[0])
    return _moved(curve, goal)


def _moved(curve: Curve, goal: Floats) -> Curve:
    """Return the curve with its points as far on their way as its code allows: halfway, or less, where it changes."""
    wanted, every = arrange(curve), np.arange(len(curve))
    halvings = np.zeros(len(curve), dtype=np.int64)
    while True:
        share = np.where(halvings > _MOST_HALVINGS, 0.0, 0.5**halvings)
        moved = _between(curve, goal, share)
        found = None if moved is None else arrange(moved)
        if moved is not None and found is not None and (not share.any() or _same_code(wanted, found)):
            return moved
        before, after = _crossed(wanted, every), {} if found is None else _crossed(found, every)
        differ = np.array([before.get(edge) != after.get(edge) for edge in every.tolist()])
        near = differ | np.roll(differ, 1)
        near &= share > 0
        halvings[near if near.any() else share > 0] += 1


def _between(curve: Curve, goal: Floats, share: Floats) -> Curve | None:
    """Return the curve part of the way to a goal; None if points came to lie on one another or on one line."""
    try:
        moved = Curve(curve.points + share[:, None] * (goal - curve.points), curve.repairs, curve.cusps[0])
    except InputError:
        return None
    return moved if len(moved) == len(curve) else None
