"""General position (§2.1 and §4 of the paper): no vertex on a foreign edge, no three edges through one point.

A drawing that is not in general position has no answer of its own: each way of moving the touching strands apart is
another curve. The rule here is that strands which only touch come apart, strands which run through each other's
vertices cross once, and strands which run along each other end up side by side. Nothing else may change: a move is
accepted only if every pair of edges that crossed still does, and no pair crosses that was apart.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np

from plyfold.arrangement.crossings import Contacts, Visits, find_contacts, order_visits
from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GeneralPositionError, InputError
from plyfold.outline.curve import Curve, Repair
from plyfold.predicates import orient

__all__ = ["in_general_position", "touching_places"]

# Steps as fractions of the drawing's size: large enough for a mesh to survive, smaller where strands crowd.
_STEPS = [2.0**-exponent for exponent in (20, 24, 28, 32, 36, 40, 44)]
_GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))
_ATTEMPTS = 12
# A vertex must come clear of the edge it lay on by this fraction of the step, so that no rounding decides the answer.
_CLEARANCE = 0.02
# Steps have to be this many times the rounding of the coordinates, for the same reason.
_LEAST_STEP = 1000
_LARGEST_STEP = 0.002


def in_general_position(
    curve: Curve, policy: Literal["perturb", "raise"], watch: Watch = UNWATCHED
) -> tuple[Curve, Visits]:
    """Return the curve with touching strands moved apart, and its visits to the crossings.

    Parameters
    ----------
    curve : Curve
    policy : {"perturb", "raise"}
        Move vertices, or raise an error where one would have to be moved.
    watch : Watch, optional

    Returns
    -------
    Curve
        The same curve if it is in general position; else one with a :class:`~plyfold.outline.curve.Repair` per moved
        vertex. Which vertices move, and where to, does not depend on the starting point or the direction of the curve.
    Visits

    Raises
    ------
    GeneralPositionError
        With ``policy="raise"`` at every touching place; with ``"perturb"`` if the strands are too crowded to separate.
    """
    if policy not in ("perturb", "raise"):
        raise InputError(f'general_position must be "perturb" or "raise", not {policy!r}')
    contacts = find_contacts(curve.points, watch)
    visits = order_visits(curve.points, contacts)
    if _is_general(contacts, visits):
        return curve, visits
    if policy == "raise":
        raise GeneralPositionError(
            f"the curve is not in general position (vertices on other edges: {len(np.unique(contacts.touches[:, 0]))}, "
            f"meetings of three edges: {len(visits.triple)})",
            where=touching_places(curve.points, contacts, visits),
            hint='move these vertices, or use general_position="perturb"',
        )
    return _separate(curve, contacts, visits, watch)


def _is_general(contacts: Contacts, visits: Visits) -> bool:
    return len(contacts.touches) == 0 and len(visits.triple) == 0


def touching_places(points: Floats, contacts: Contacts, visits: Visits) -> list[tuple[float, float]]:
    """Return the vertices that lie on other edges, and the crossings on edges on which three edges meet."""
    touching = points[np.unique(contacts.touches[:, 0])]
    meeting = visits.point[np.isin(visits.edge, visits.triple[:, 0])]
    places = np.unique(np.concatenate([touching, meeting]), axis=0)
    return [(float(x), float(y)) for x, y in places]


def _separate(curve: Curve, contacts: Contacts, visits: Visits, watch: Watch) -> tuple[Curve, Visits]:
    """Try small moves of the touching vertices until the curve is in general position and nothing else has changed."""
    n = len(curve.points)
    required = _pair_numbers(contacts.edges, n)
    allowed = np.concatenate([required, _pair_numbers(_touching_pairs(contacts, n), n)])
    for moved, step in _candidates(curve.points):
        if _clearance(moved, contacts.touches) < _CLEARANCE * step:
            continue
        new_contacts = find_contacts(moved, watch)
        new_visits = order_visits(moved, new_contacts)
        found = _pair_numbers(new_contacts.edges, n)
        nothing_else = bool(np.isin(required, found).all() and np.isin(found, allowed).all())
        if nothing_else and _is_general(new_contacts, new_visits):
            return Curve(moved, curve.repairs + _moves(curve.points, moved), curve.cusps[0]), new_visits
    raise GeneralPositionError(
        "strands touch or overlap, and are too crowded to be moved apart",
        where=touching_places(curve.points, contacts, visits),
        hint="move these vertices by hand",
    )


def _pair_numbers(pairs: Ints, n: int) -> Ints:
    """Return a number for each pair of edges, shape (m, 2), whatever its order."""
    return np.asarray(pairs.min(axis=1) * n + pairs.max(axis=1))


def _touching_pairs(contacts: Contacts, n: int) -> Ints:
    """Return the pairs of edges that may cross after the move: those that touch before."""
    vertex, edge = contacts.touches.T
    return np.stack([np.concatenate([(vertex - 1) % n, vertex]), np.concatenate([edge, edge])], axis=1)


def _clearance(points: Floats, touches: Ints) -> float:
    """Return the least distance of a vertex from an edge that it used to lie on."""
    vertex, edge = touches.T
    start = points[edge]
    along = points[(edge + 1) % len(points)] - start
    away = points[vertex] - start
    share = np.clip((away * along).sum(axis=1) / (along * along).sum(axis=1), 0.0, 1.0)
    return float(np.hypot(*(away - share[:, None] * along).T).min(initial=np.inf))


def _moves(before: Floats, after: Floats) -> tuple[Repair, ...]:
    moved = np.flatnonzero((before != after).any(axis=1))
    size = np.hypot(*(after - before)[moved].T)
    return tuple(
        Repair("vertex moved", (x, y), how_far)
        for (x, y), how_far in zip(before[moved].tolist(), size.tolist(), strict=True)
    )


def _candidates(points: Floats) -> Iterator[tuple[Floats, float]]:
    """Yield ever more desperate ways to move the touching vertices, the same for every start and direction.

    First every vertex moves in the direction that its touch asks for; then in directions scattered at random, though
    the same in every run.
    """
    order = _canonical_order(points)
    frame = points[order]
    contacts = find_contacts(frame)
    displacement = _displacements(frame, contacts, order_visits(frame, contacts))
    size = float(np.ptp(points, axis=0).max())
    least = float(_LEAST_STEP * np.spacing(np.abs(points).max()))
    # Far from the origin, where coordinates are coarse, steps are as small as they can be.
    steps = [step * size for step in _STEPS if step * size > least] or ([least] if least < _LARGEST_STEP * size else [])
    for attempt in range(_ATTEMPTS):
        turned = _rotated(displacement, attempt * _GOLDEN_ANGLE * (1 + np.arange(len(points))))
        for step in steps:
            moved = np.empty_like(points)
            moved[order] = frame + step * turned
            yield moved, step


def _rotated(vectors: Floats, angle: Floats) -> Floats:
    cosine, sine = np.cos(angle), np.sin(angle)
    x, y = vectors.T
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)


def _canonical_order(points: Floats) -> Ints:
    """Return the vertices in an order that does not depend on the curve's start and direction."""
    n = len(points)
    lowest = np.flatnonzero((points == points[np.lexsort((points[:, 1], points[:, 0]))[0]]).all(axis=1))
    turns = [(start + direction * np.arange(n)) % n for start in lowest for direction in (1, -1)]
    return np.asarray(min(turns, key=lambda turn: points[turn].tolist()), dtype=np.int64)


def _displacements(points: Floats, contacts: Contacts, visits: Visits) -> Floats:
    """Return the direction in which each vertex is to move, shape (n, 2); zero for those that stay.

    Of vertices that coincide the first stays, unless it lies in the middle of an edge too, and the others move by
    1, 2, … steps, so that strands which run along each other for several laps end up in order.
    """
    displacement = np.zeros_like(points)
    n = len(points)
    rank = _rank_among_equals(points)
    vertex, edge = contacts.touches.T
    inside = (points[vertex] != points[edge]).any(axis=1) & (points[vertex] != points[(edge + 1) % n]).any(axis=1)
    steps = rank + np.isin(np.arange(n), vertex[inside])
    for v in np.unique(vertex).tolist():
        displacement[v] = steps[v] * _way_out(points, v, edge[vertex == v])
    for triple in visits.triple.tolist():
        last = max(triple)
        along = points[(last + 1) % len(points)] - points[last]
        displacement[last] = (1 + (last * _GOLDEN_ANGLE) % 1) * _left(_unit(along))
    return displacement


def _rank_among_equals(points: Floats) -> Ints:
    """Return for each vertex how many earlier vertices lie at the same place."""
    inverse = np.unique(points, axis=0, return_inverse=True)[1].reshape(-1)
    order = np.argsort(inverse, kind="stable")
    group_start = np.searchsorted(inverse[order], inverse[order])
    rank = np.empty(len(points), dtype=np.int64)
    rank[order] = np.arange(len(points)) - group_start
    return rank


def _way_out(points: Floats, vertex: int, edges: Ints) -> Floats:
    """Return the direction that takes a vertex off the edges it lies on."""
    n = len(points)
    here, before, after = points[vertex], points[vertex - 1], points[(vertex + 1) % n]
    start, end = points[edges], points[(edges + 1) % n]
    side_before, side_after = orient(start, end, before), orient(start, end, after)
    comes_along = any((side_before == 0) & _overlap(here, before, start, end))
    leaves_along = any((side_after == 0) & _overlap(here, after, start, end))
    if comes_along and leaves_along:  # a lap beside another one: step to the left
        aside = _left(_unit(here - before)) + _left(_unit(after - here))
        return _unit(aside) if np.hypot(*aside) > 0.1 else _left(_unit(here - before))
    if comes_along:  # turns off here: turn a little later, or step aside if the way on is straight
        return _unit(after - here) if side_after.any() else _left(_unit(here - before))
    if leaves_along:
        return _unit(before - here) if side_before.any() else _left(_unit(after - here))
    if any(side_before * side_after < 0):  # crosses: cross a little earlier
        return _unit(after - here)
    return _unit(_unit(before - here) + _unit(after - here))  # touches: draw back


def _left(direction: Floats) -> Floats:
    return np.array([-direction[1], direction[0]])


def _overlap(here: Floats, neighbour: Floats, start: Floats, end: Floats) -> Bools:
    """Tell for which edges the way from a point on them to a neighbour on their line begins within the edge."""
    forward = ((neighbour - here) * (end - start)).sum(axis=1) > 0
    ahead = np.where(forward[:, None], end, start)
    return np.asarray((here != ahead).any(axis=1))


def _unit(vectors: Floats) -> Floats:
    length = np.hypot(vectors[..., 0], vectors[..., 1])[..., None]
    return np.asarray(np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0))
