"""General position (§2.1 and §4 of the paper): no vertex on a foreign edge, no three edges through one point.

An outline that touches itself is taken for the limit of others. First its spikes are taken out. Then each vertex that
touches something moves outward, infinitely little: that tells which edges cross, and in what order. At last the move is
made small enough for doubles to show the very same. Vertices that touch as cusps stay where they are.

Doubles may show it at no size: no move is small enough for strands that are nearly in contact, and large enough for the
rounding of coordinates. Then the outline in general position is the one that has begun to move, in fractions. All that
is combinatorial follows from it, so it is the same wherever doubles show it and where they do not. Whoever wants more
of the moved outline than pictures reads :attr:`Arrangement.exact_points`, which are doubles almost always; the exact
predicates take both.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from plyfold.arrangement.crossings import Contacts, Visits, find_contacts, order_visits
from plyfold.arrangement.crowded_cusps import crowded_cusps, cusps_that_stay, lie_inside, stay_inside
from plyfold.arrangement.infinitesimal import (
    MovingPoints,
    begin_to_move,
    begun_crossings,
    begun_visits,
    order_along_edges,
    same_outside,
    signed_pairs,
)
from plyfold.arrangement.meetings import meetings, visits_along
from plyfold.arrangement.nesting import nest, same_nest
from plyfold.arrangement.noding import Noding, node_outline
from plyfold.arrangement.outward import are_moved, outward_vectors, whole_vectors, winds_backward
from plyfold.arrangement.spikes import tips, without_spikes
from plyfold.arrays import Floats, Fractions, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import GeneralPositionError, InputError
from plyfold.outline.curve import Outline, Repair, backward_numbers, outline_of_points

__all__ = [
    "GeneralPosition",
    "InContact",
    "in_general_position",
    "moved_apart",
    "number_of_ways",
    "separated",
    "touching_points",
    "without_contacts",
]

# Sizes of moves as fractions of the drawing's: smaller ones where strands crowd.
_STEPS = [2.0**-exponent for exponent in range(20, 49, 4)]
# A step is so many times the rounding of the coordinates at least, so that there are directions to choose from.
_LEAST_STEP = 16
_LARGEST_STEP = 2.0**-4
_ATTEMPTS = 12


@dataclass(frozen=True, eq=False)
class GeneralPosition:
    """An outline in general position, and the one that it was given as.

    Parameters
    ----------
    outline : Outline
    given : Outline
        The same points in the same order where they were given, without spikes.
    numbers : (points,) int
        The number that each point has in the outline that came in.
    visits : Visits
        Of the outline in general position.
    turned_round : bool or None
        Whether the outline that came in was turned round, so that the surface lies on its left. None if that is not
        settled: it is as it came in, and there is nothing to tell inside from outside but its cells.
    begun : (points, 2) object or None
        Where the points are when they have begun to move: in fractions, and infinitely near to those of ``given``. What
        they draw, ``outline`` shows in doubles; but if these have no room for it, it has the given points. None
        without contacts.
    """

    outline: Outline
    given: Outline
    numbers: Ints
    visits: Visits
    turned_round: bool | None
    begun: Fractions | None = None

    @property
    def exact(self) -> Fractions | None:
        """The points in general position in fractions, where doubles do not show them; None elsewhere."""
        shown = self.begun is None or not np.array_equal(self.outline.points, self.given.points)
        return None if shown else self.begun


@dataclass(frozen=True, eq=False)
class InContact:
    """An outline that touches itself or has spikes.

    Parameters
    ----------
    outline : Outline
    left : Outline
        What is left of it without its spikes; the same one if it has none.
    kept : (points,) int
        The numbers of those points.
    contacts : Contacts
        The crossings and touches of the outline with its spikes.
    """

    outline: Outline
    left: Outline
    kept: Ints
    contacts: Contacts

    @cached_property
    def noding(self) -> Noding:
        """The exact noding of what is left."""
        return node_outline(self.left)


def in_general_position(
    outline: Outline, policy: Literal["perturb", "raise"], watch: Watch = UNWATCHED
) -> GeneralPosition:
    """Return an outline without spikes and with touching strands moved apart.

    Parameters
    ----------
    outline : Outline
    policy : {"perturb", "raise"}
        Take out spikes and move vertices, or raise an error where that would be done.
    watch : Watch, optional

    Returns
    -------
    GeneralPosition
        The same outline if it is in general position; else one with a :class:`~plyfold.outline.curve.Repair` per spike
        and per moved vertex. How the moved strands cross does not depend on where loops begin, which way they run, and
        where on the page they lie.

    Raises
    ------
    CurveError
        If nothing is left of the outline without its spikes.
    GeneralPositionError
        With ``policy="raise"`` at every touching place; with ``"perturb"`` where cusps that stay hold edges together.
    """
    if policy not in ("perturb", "raise"):
        raise InputError(f'general_position must be "perturb" or "raise", not {policy!r}')
    found = without_contacts(outline, policy, watch)
    return found if isinstance(found, GeneralPosition) else moved_apart(found, watch)


def without_contacts(
    outline: Outline, policy: Literal["perturb", "raise"], watch: Watch = UNWATCHED
) -> GeneralPosition | InContact:
    """Return an outline that is in general position as it is, or what there is to know before points of it move."""
    contacts = meetings(outline, watch)
    if policy == "raise" or len(contacts.touches) == 0:
        visits = visits_along(outline, contacts)
        if len(contacts.touches) == 0 and len(visits.triple) == 0:
            return GeneralPosition(outline, outline, np.arange(len(outline)), visits, None)
        if policy == "raise":
            raise _not_general(outline, contacts, visits)
    return InContact(outline, *without_spikes(outline), contacts)


def moved_apart(found: InContact, watch: Watch = UNWATCHED) -> GeneralPosition:
    """Return an outline in contact with its touching strands moved apart."""
    if found.left is not found.outline:
        rest = without_contacts(found.left, "perturb", watch)
        if isinstance(rest, GeneralPosition):
            return replace(rest, numbers=found.kept)
    placed = _directed(found, watch)
    return replace(placed, numbers=found.kept[placed.numbers])


def _not_general(outline: Outline, contacts: Contacts, visits: Visits) -> GeneralPositionError:
    what = "curve is" if outline.n_loops == 1 else "curves are"
    return GeneralPositionError(
        f"the {what} not in general position (vertices on other edges: {len(np.unique(contacts.touches[:, 0]))}, "
        f"meetings of three edges: {len(visits.triple)})",
        where=_places(outline, contacts, visits),
        hint='move these vertices, or use general_position="perturb"',
    )


def _places(outline: Outline, contacts: Contacts, visits: Visits) -> list[tuple[float, float]]:
    """Return the vertices that lie on other edges, and the crossings on edges on which three edges meet."""
    touching = outline.points[np.unique(contacts.touches[:, 0])]
    meeting = visits.point[np.isin(visits.edge, visits.triple[:, 0])]
    places = np.unique(np.concatenate([touching, meeting]), axis=0)
    return [(float(x), float(y)) for x, y in places]


def _directed(found: InContact, watch: Watch) -> GeneralPosition:
    """Turn an outline round if its surface lies on the right, and move its points outward."""
    outline = found.left
    if not winds_backward(outline, found.noding):
        return separated(outline, 1, watch, contacts=found.contacts if outline is found.outline else None)
    numbers = backward_numbers(outline.first_point)
    parts = (
        outline.points[numbers],
        outline.loop_of_point,
        np.concatenate(outline.cusps)[numbers],
        outline.rows[numbers],
    )
    moved = separated(outline_of_points(*parts, outline.repairs), 1, watch)
    return replace(moved, numbers=numbers[moved.numbers], turned_round=True)


def touching_points(outline: Outline) -> Ints:
    """Return the points of an outline that lie on foreign edges or on each other."""
    return np.unique(meetings(outline).touches[:, 0])


# ---- moves -----------------------------------------------------------------------------------------------------------


class _Touching(NamedTuple):
    """An outline with contacts, and whether its points are to move outward (``sense`` 1) or inward (−1)."""

    given: Outline
    contacts: Contacts
    sense: int
    watch: Watch


class _Moves(NamedTuple):
    """Points that move right of their edges, or left; and others, with the vectors along which they go."""

    points: Ints
    others: Ints
    vectors: Floats


def separated(
    given: Outline, sense: int, watch: Watch = UNWATCHED, way: int = 0, contacts: Contacts | None = None
) -> GeneralPosition:
    """Return an outline with its points in contact moved outward (``sense`` 1) or inward (−1), as little as need be.

    Parameters
    ----------
    given : Outline
        Without spikes, and with the surface on its left.
    sense : int
    watch : Watch, optional
    way : int, optional
        Which one to take of several ways, if there are some: from 0 up to :func:`number_of_ways`.
    contacts : Contacts, optional
        The crossings and touches of the outline, if they are known.

    Notes
    -----
    Where three edges meet inside all of them, their ends move in the same way. Whichever way they part, there are the
    same immersions. But only if all of them, or all but two, move outward, all sheets there have a cell in common, so
    that they lie over it in one order, as they must over the single point.
    """
    touching = _Touching(given, contacts or meetings(given, watch), sense, watch)
    stays, moves = _points_to_move(given, touching.contacts, way)
    scatter = 0
    while scatter < _ATTEMPTS:
        found = _moved(touching, moves, scatter)
        if isinstance(found, GeneralPosition):
            return found
        more = np.setdiff1d(np.concatenate([found, given.next_point[found]]), np.concatenate([stays, moves.points]))
        moves, scatter = moves._replace(points=np.union1d(moves.points, more)), scatter + (len(more) == 0)
    raise GeneralPositionError(
        "strands touch or overlap, and cusps that stay hold them together",
        where=_places(given, touching.contacts, visits_along(given, touching.contacts)),
        hint="move these vertices by hand",
    )


def number_of_ways(given: Outline) -> int:
    """Return in how many ways touching points may move: 1, but where cusps lie on each other."""
    return crowded_cusps(given, meetings(given)).n_ways if given.has_cusps else 1


def _points_to_move(given: Outline, contacts: Contacts, way: int) -> tuple[Ints, _Moves]:
    """Return the points in contact that do not move outward, for they are cusps; and the moves.

    All other points in contact move, and the ends of edges on which cusps lie: then these edges move outward, too.
    """
    vertex, edge = contacts.touches.T
    stays = cusps_that_stay(given, contacts)
    crowded = crowded_cusps(given, contacts)
    edges = edge[stays[vertex] & lie_inside(given, contacts)]
    if len(crowded.points):
        # Edges of cusps that give way may go inward; so all others move outward that meet there.
        edges = np.union1d(edges, visits_along(given, contacts).triple)
    points = np.setdiff1d(np.concatenate([vertex, edges, given.next_point[edges]]), np.flatnonzero(stays))
    return np.flatnonzero(stays), _Moves(points, crowded.points, crowded.way(way))


def _moved(touching: _Touching, moves: _Moves, scatter: int) -> GeneralPosition | Ints:
    """Return the outline with some points moved as little as need be, or the edges that stay together then."""
    given, sense = touching.given, touching.sense
    vectors = np.zeros_like(given.points)
    vectors[moves.points] = sense * outward_vectors(given, moves.points, scatter)
    vectors[moves.others] = moves.vectors
    exactly = whole_vectors(given, vectors, moves.points, sense)
    motion = begin_to_move(given.points, exactly, given.next_point)
    crossings, undecided = begun_crossings(motion, touching.contacts)
    if len(undecided) or not stay_inside(given, touching.contacts, motion.places, moves.others, sense):
        return np.unique(undecided)
    for step in _steps(given.points):
        points = given.points + step * vectors
        if are_moved(given, moves.points, points[moves.points], sense).all():
            found = _shown(touching, motion, crossings, points)
            if found is not None:
                return found
    return _as_begun(touching, motion, crossings)


def _shown(
    touching: _Touching, motion: MovingPoints, crossings: Contacts, points: Floats
) -> GeneralPosition | Ints | None:
    """Return the outline with its points moved, if it shows what is true of infinitely small moves; else None.

    Or the edges that meet in one point, however little they move.
    """
    given = touching.given
    found = find_contacts(points, touching.watch, given.first_point)
    wanted, shown = (signed_pairs(some.edges, some.from_right, len(points)) for some in (crossings, found))
    if len(found.touches) or not np.array_equal(wanted, shown):
        return None
    visits = order_visits(points, found, given.first_point)
    in_order, together = order_along_edges(motion, visits)
    if len(together):
        return np.unique(together)
    if len(visits.triple) or not (in_order.all() and _lie_alike(motion, points, given.first_point, visits)):
        return None
    return _placed(touching, points, visits, motion.places)


def _as_begun(touching: _Touching, motion: MovingPoints, crossings: Contacts) -> GeneralPosition | Ints:
    """Return the outline that has begun to move, or the edges of it that meet in one point."""
    visits = begun_visits(motion, crossings)
    if len(visits.triple):
        return np.unique(visits.triple)
    return _placed(touching, motion.points, visits, motion.places)


def _placed(touching: _Touching, points: Floats, visits: Visits, begun: Fractions) -> GeneralPosition:
    """Return an outline with its points moved."""
    given = touching.given
    repairs = *given.repairs, *_moves(given.points, points, begun)
    # A cusp at a tip has an angle of 360° that one sees; strands that move outward there leave next to none, and those
    # that move inward next to all of it.
    cusps = np.concatenate(given.cusps) + (tips(given) if given.has_cusps and touching.sense > 0 else 0)
    outline = outline_of_points(points, given.loop_of_point, cusps, given.rows, repairs)
    return GeneralPosition(outline, given, np.arange(len(given)), visits, False, begun)


def _lie_alike(motion: MovingPoints, points: Floats, first_point: Ints, visits: Visits) -> bool:
    """Tell whether moved loops show their outside where it is, and lie in each other, as when they begin to move."""
    if len(first_point) == 2:
        return same_outside(motion, points)
    begun = nest(motion.points, first_point, visits, exact=motion.moved)
    return same_nest(nest(points, first_point, visits), begun)


def _steps(points: Floats) -> list[float]:
    """Return how long a unit of a move may be, the longest first: parts of the drawing's size, as powers of two.

    Far from the origin, where coordinates are coarse, they are as short as they can be.
    """
    size = float(np.ldexp(1.0, np.frexp(np.ptp(points, axis=0).max())[1]))
    least = float(_LEAST_STEP * np.spacing(np.abs(points).max()))
    return [step * size for step in _STEPS if step * size >= least] or [least] * (least < _LARGEST_STEP * size)


def _moves(before: Floats, after: Floats, begun: Fractions) -> list[Repair]:
    """Return which points were moved, and how far: by 0 if that is less than doubles can tell."""
    moved = np.flatnonzero((before != begun).any(axis=1))
    size = np.hypot(*(after - before)[moved].T)
    places = zip(before[moved].tolist(), size.tolist(), strict=True)
    return [Repair("vertex moved", (x, y), how_far) for (x, y), how_far in places]
