"""Embeddings of an outline: layered surfaces over all its immersions at once (§5 of the paper: an open problem there).

Two ways lead to an embedding of a disk. Immersion by immersion the order of sheets is a small problem
(:mod:`plyfold.layering.orders`), but there can be 2^100 immersions. The equations between levels of borders
(:mod:`plyfold.layering.levels`) know all immersions at once, but for curves that cover themselves many times they are
harder than all of a few immersions. So few immersions are gone through one by one, and where there are more of them the
curve itself is asked; and so are several curves, or one that bounds a disk with handles. Each solution of the equations
glues sheets to a surface without self-intersections that has the curves as its boundary and lies to the left of them.
Its Euler characteristic is the sum of their turning numbers, less the indices of their cusps, for it lies flat without
branch points; the same holds for each of its pieces, which gives their genus. Nothing demands that the surface be in
one piece, unless it is asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import islice
from typing import cast

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement, arrange, watched_arrangement
from plyfold.arrangement.base_visit import borders_numbered_back
from plyfold.arrays import Ints
from plyfold.clock import Clock, Watch
from plyfold.errors import TimeLimitError
from plyfold.immersion.obstructions import is_visibly_no_surface, may_bound_disk, visible_obstruction
from plyfold.immersion.outlines import find_surfaces, list_surfaces
from plyfold.immersion.solve import (
    count_immersions,
    find_immersion,
    immersions,
    in_best_way,
    watched_immersions,
)
from plyfold.immersion.verdict import bounds_disk
from plyfold.layering.layering import Layering, layering_of_levels
from plyfold.layering.levels.casing import casing_of_visits
from plyfold.layering.levels.counting import count_level_solutions
from plyfold.layering.levels.equations import (
    Lacking,
    LevelClauses,
    all_wanted,
    level_clauses,
    level_equations,
    list_levels,
    no_levels,
    solve_levels,
)
from plyfold.layering.levels.pieces import not_cut_off
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.listing import layerings
from plyfold.layering.orders.search import find_layering, undecided
from plyfold.layering.tables import TooLargeError
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.given import OutlineLike

__all__ = ["count_embeddings", "embeddings", "find_embedding"]

# Up to so many immersions are gone through one by one; one of other outlines is, if it takes no more choices.
_FEW = 100
# Where no more sheets than this lie over each other, their orders are sooner found than the levels of borders.
_LOW = 8

_HOW_MANY = "how many embeddings there are"


def find_embedding(
    curve: OutlineLike, time_limit: float | None = None, connected: bool = False
) -> Layering | Obstruction | Unknown:
    """Find a layered surface without self-intersections that has the curve as its outline, or prove that there is none.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such
        One curve bounds a disk, or, if its turning number is 1 − 2g, a disk with g handles; the turns that are too many
        at cusps do not count. Several loops bound one surface, perhaps in several pieces; they may cross themselves and
        each other. Each has the surface on its left, so that outer boundaries run counter-clockwise and holes
        clockwise.
    time_limit : float, optional
        Seconds after which to give up; none by default.
    connected : bool, optional
        Demand a surface in one piece.

    Returns
    -------
    Layering or Obstruction or Unknown
        The result is true if there is an embedding; it has been checked, and its ``immersion`` says over which
        immersion it lies. An obstruction has the reason ``"turning number"``, ``"negative winding"``, ``"cusp"`` (one
        that cannot be) or, of a disk, ``"no grouping"`` (there is no immersion); ``"pieces"``, if all embeddings have
        several and one was demanded (``value`` has the loops of each piece of one); and otherwise ``"no embedding"``:
        ``value`` is a tuple of crossings, and of cusps as ``("cusp", visit)``, at which no levels of the strands fit
        together, whatever the immersion; as few as can be found with little effort. At the time limit the answer is
        Unknown.

    Raises
    ------
    GeneralPositionError
        If several curves touch or overlap, or three of their edges meet in a point.

    Notes
    -----
    Exact in both directions. The first immersions of a disk are tried one by one with :func:`~plyfold.find_layering`;
    if none of them lifts and there are more, the levels of all borders are a SAT problem with O(Σ w) variables and
    clauses, over borders. So they are for all other outlines, unless an immersion is soon found, and lifts. Whether an
    embedded disk can be decided in polynomial time is open [EM09]_. A chain of a hundred disks with 5 immersions each,
    1,200 crossings, takes about 0.2 s. Surfaces of several pieces are left out one kind after the other where one piece
    is demanded.

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> sorted(find_embedding(ramp).level.tolist())
    [1, 1, 1, 1, 2]
    >>> ring = find_embedding([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]])
    >>> ring.euler_characteristic, len(ring.pieces), ring.genus
    (0, 1, 0)
    >>> from plyfold import Curve
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> sorted(find_embedding(Curve(limacon, cusps={6: 1})).level.tolist())
    [1, 1, 1, 1, 2]
    """
    clock = Clock(time_limit)
    watch = Watch(clock)
    try:
        arranged = in_best_way(watched_arrangement(curve, "perturb", watch), watch)
        if not may_bound_disk(arranged):
            visible = visible_obstruction(arranged, connected)
            return _of_outline(arranged, clock, connected) if visible is None else visible
        return _over_immersions(arranged, clock)
    except TimeLimitError:
        return undecided("time limit", "whether there is an embedding", clock)


def _over_immersions(arranged: Arrangement, clock: Clock) -> Layering | Obstruction | Unknown:
    """Return a layering of one of the first immersions, or else ask the curve itself. May raise TimeLimitError."""
    examined = 0
    for immersion in islice(watched_immersions(arranged, Watch(clock)), _FEW):
        examined += 1
        found = find_layering(immersion, clock.left)
        if not isinstance(found, Obstruction):
            return found
    if not examined:
        return cast("Obstruction", find_immersion(arranged))
    number = count_immersions(arranged)
    if number > _FEW:
        return _from_levels(arranged, clock, because=f"none of the {_written(number)} immersions lifts; ")
    which = "the only immersion does not lift" if number == 1 else f"none of the {number} immersions lifts"
    return no_levels(arranged, level_clauses(arranged), clock, f"{which}; ")


def _of_outline(arranged: Arrangement, clock: Clock, connected: bool) -> Layering | Obstruction | Unknown:
    """Return an embedding of an outline that bounds more than disks. May raise TimeLimitError."""
    level = None if connected else _levels_at_hand(arranged, clock)
    return _from_levels(arranged, clock, connected) if level is None else layering_of_levels(arranged, level)


def _levels_at_hand(arranged: Arrangement, clock: Clock) -> Ints | None:
    """Return the levels of an embedding if it is soon found, over an immersion with few choices; else None."""
    highest = int(arranged.winding.max())
    if highest == 1:
        return np.ones(arranged.n_borders, dtype=np.int64)
    surfaces = find_surfaces(arranged) if highest <= _LOW else None
    if surfaces is None or sum(len(part.choices) for part in surfaces.parts) > _FEW:
        return None
    first = next(list_surfaces(surfaces, watch=Watch(clock)), None)
    found = None if first is None else find_layering(first, clock.left)
    return found.border_level if isinstance(found, Layering) else None


def _from_levels(
    arranged: Arrangement, clock: Clock, connected: bool = False, because: str = ""
) -> Layering | Obstruction | Unknown:
    clauses = level_clauses(arranged)
    try:
        level = solve_levels(clauses, clock)
        if level is None:
            return no_levels(arranged, clauses, clock, because)
        whole = next(list_levels(clauses, clock, _several_pieces(arranged, clauses)), None) if connected else level
    except TimeoutError:
        return _unknown("whether there is an embedding", arranged, clock)
    found = _layering(arranged, level if whole is None else whole)
    return _not_in_one_piece(found) if whole is None else found


def _several_pieces(arranged: Arrangement, clauses: LevelClauses) -> Lacking:
    """Return what forbids solutions of several pieces; of one loop there are none."""
    return partial(not_cut_off, arranged, clauses) if arranged.n_loops > 1 else all_wanted


def _not_in_one_piece(found: Layering) -> Obstruction:
    pieces = tuple(piece.loops for piece in found.immersion.uncut_pieces)
    sentence = f"No embedding in one piece: those that there are fall into pieces, such as {len(pieces)}."
    return Obstruction("pieces", sentence, (), pieces, found.immersion.arrangement)


def embeddings(curve: OutlineLike, over: npt.ArrayLike | None = None, connected: bool = False) -> Iterator[Layering]:
    """List all embeddings of an outline, over all its immersions, each once, in a stable order; nothing if none.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such
        As for :func:`find_embedding`.
    over : array_like of bool, shape (k,), (2k,) or (visits,), optional
        List only those with this casing, given as for :func:`~plyfold.embed_cased`: several if loops lie in others
        without crossing them, or if it does not determine whether the surface climbs or falls at cusps.
    connected : bool, optional
        List only those in one piece.

    Yields
    ------
    Layering
        Checked. There can be exponentially many; they are made one at a time. Few immersions are gone through one by
        one. Otherwise each embedding takes at most k + c + Σ w questions to the SAT solver, with c cusps and w added up
        over loops, most of them easy, and none of them is in vain for long because an immersion does not lift.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> [layering.changes for layering in embeddings(milnor)]
    [6, 6, 6, 6]
    """
    arranged = in_best_way(arrange(curve))
    casing = None if over is None else casing_of_visits(arranged, over)
    if is_visibly_no_surface(arranged, connected) or (may_bound_disk(arranged) and not bounds_disk(arranged)):
        return
    if casing is None and _has_few_immersions(arranged):
        for immersion in immersions(arranged):
            yield from layerings(immersion)
    else:
        clauses = level_clauses(arranged, casing)
        lacking = _several_pieces(arranged, clauses) if connected else all_wanted
        for level in list_levels(clauses, lacking=lacking):
            yield _layering(arranged, level)


def _has_few_immersions(arranged: Arrangement) -> bool:
    return may_bound_disk(arranged) and count_immersions(arranged) <= _FEW


def count_embeddings(curve: OutlineLike, time_limit: float | None = None, connected: bool = False) -> int | Unknown:
    """Count the embeddings of an outline over all its immersions, exactly.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such
    time_limit : float, optional
        Seconds after which to give up; none by default.
    connected : bool, optional
        Count only those in one piece.

    Returns
    -------
    int or Unknown
        0 if there is none. Turned upside down, an embedding is another one, so the number is even unless sheets nowhere
        lie on each other. Unknown at the time limit, or if a table would have more than two million rows.

    Notes
    -----
    Of any number of pieces. For a disk with few immersions, the layerings of all of them. Otherwise the solutions of
    the equations between levels are counted, see :func:`plyfold.layering.levels.counting.count_level_solutions`: a
    curve falls apart where only one sheet lies, and the numbers of its parts multiply. A single part with many
    immersions and hundreds of crossings can be out of reach. Where one piece is demanded of several loops, the
    embeddings are listed one by one.

    Examples
    --------
    >>> from plyfold.gallery import chain
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> count_embeddings(milnor), count_embeddings(chain(milnor, 100)) == 4**100
    (4, True)
    """
    clock = Clock(time_limit)
    watch = Watch(clock)
    try:
        arranged = in_best_way(watched_arrangement(curve, "perturb", watch), watch)
        return _count(arranged, clock, connected)
    except TimeLimitError:
        return undecided("time limit", _HOW_MANY, clock)


def _count(arranged: Arrangement, clock: Clock, connected: bool) -> int | Unknown:
    """Return the number of embeddings. May raise TimeLimitError."""
    if is_visibly_no_surface(arranged, connected) or (may_bound_disk(arranged) and not bounds_disk(arranged)):
        return 0
    if connected and arranged.n_loops > 1:
        return _count_in_one_piece(arranged, clock)
    if not _has_few_immersions(arranged):
        return _count_levels(arranged, clock)
    total = 0
    for immersion in watched_immersions(arranged, Watch(clock)):
        number = count_layerings(immersion, clock.left)
        if clock.over or isinstance(number, Unknown):
            return _unknown(_HOW_MANY, arranged, clock, "time limit" if clock.over else "size")
        total += number
    return total


def _layering(arranged: Arrangement, level: Ints) -> Layering:
    return layering_of_levels(arranged, borders_numbered_back(arranged, level))


def _count_in_one_piece(arranged: Arrangement, clock: Clock) -> int | Unknown:
    clauses = level_clauses(arranged)
    try:
        return sum(1 for _ in list_levels(clauses, clock, _several_pieces(arranged, clauses)))
    except TimeoutError:
        return _unknown(_HOW_MANY, arranged, clock)


def _count_levels(arranged: Arrangement, clock: Clock) -> int | Unknown:
    try:
        return count_level_solutions(level_equations(arranged), clock)
    except TimeoutError:
        return _unknown(_HOW_MANY, arranged, clock)
    except TooLargeError:
        return _unknown(_HOW_MANY, arranged, clock, "size")


def _unknown(question: str, arranged: Arrangement, clock: Clock, reason: str = "time limit") -> Unknown:
    left_open = undecided(reason, question, clock)
    known, sentence = dict(left_open.established) | {"crossings": arranged.n_crossings}, left_open.sentence
    if may_bound_disk(arranged):
        known["immersions"] = count_immersions(arranged)
        sentence += f" Number of immersions: {_written(count_immersions(arranged))}."
    return Unknown(reason, sentence, known)


def _written(number: int) -> str:
    return str(number) if number < 10**6 else f"more than 2^{number.bit_length() - 1}"
