"""Decide, count, list and sample the immersions of an outline (§2.3 of the paper).

What bounds disks alone, one loop with Euler characteristic 1, is asked for groupings of Blank's word. Every other
outline is asked for the gluings of its sheets.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import islice
from typing import Any, overload

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, arrange, watched_arrangement
from plyfold.arrangement.general_position import number_of_ways
from plyfold.arrangement.unless import arrangement_unless
from plyfold.arrangement.ways import ways_apart
from plyfold.clock import UNWATCHED, Clock, Watch
from plyfold.errors import InputError, TimeLimitError
from plyfold.immersion.contradiction import no_gluing
from plyfold.immersion.disks import bounds_disks, count_disks, find_disks, list_disks, no_grouping, nth_disk
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.obstructions import (
    is_visibly_no_disk,
    is_visibly_no_surface,
    may_bound_disk,
    touches_as_no_disk,
    visible_obstruction,
)
from plyfold.immersion.outlines import count_surfaces, find_surfaces, list_surfaces, nth_surface, random_surface
from plyfold.obstruction import Obstruction, Unknown
from plyfold.outline.given import OutlineLike

__all__ = [
    "best_immersion",
    "bounds_disk_by_values",
    "bounds_strictly",
    "count_immersions",
    "find_immersion",
    "immersions",
    "in_best_way",
    "nth_immersion",
    "sample_immersion",
    "watched_immersions",
]

# So many immersions are looked at one by one.
_FEW = 5


@overload
def find_immersion(curve: OutlineLike, connected: bool = False) -> Immersion | Obstruction: ...
@overload
def find_immersion(
    curve: OutlineLike, connected: bool = False, time_limit: float | None = None
) -> Immersion | Obstruction | Unknown: ...
def find_immersion(
    curve: OutlineLike, connected: bool = False, time_limit: float | None = None
) -> Immersion | Obstruction | Unknown:
    """Find an immersed surface that has an outline as its boundary, or say why there is none (§2.3 of [MGR11]_).

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
        One curve that turns once, apart from its cusps, bounds a disk; one that turns 1 − 2g times, a disk with g
        handles. Several bound one surface, perhaps in several pieces. Each has the surface on its left, so outer
        boundaries run counter-clockwise and holes clockwise.
    connected : bool, optional
        Demand a surface in one piece; by default, several will do.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    Immersion or Obstruction or Unknown
        The result is true if there is an immersion. An immersion has been checked against the definition. If the
        outline touches itself, it is that of the outline with points in contact moved outward, which exists if the
        outline is a limit of outlines of such surfaces; ``immersion.touches`` says where the surface has no width then.
        An obstruction names the theorem that fails: a cusp has too few sheets beside it (reason ``"cusp"``), the
        outline turns too often (``"turning number"``), a cell has a negative winding number (``"negative winding"``),
        the exhausted word of a disk has no grouping (``"no grouping"``), the conditions at some crossings, cusps and
        feet of bridges contradict each other (``"no gluing"``: ``value`` are visits there), or there are surfaces, but
        none in one piece (``"pieces"``). Unknown at the time limit only.

    Raises
    ------
    CurveError
        If the input is no closed curve, and no list of such.
    MemoryLimitError
        If the gluing of its sheets would not fit into memory. :func:`~plyfold.bounds_disk` decides without it.

    Notes
    -----
    Exact. For one curve that bounds disks polynomial; the decision follows [Bla67]_. After the crossings are known the
    cost is near-linear in the number of sheets, counted once per border, for ribbons and the like: 16,000 crossings
    take about 0.2 s. What propagation cannot settle, in curves that cover themselves dozens of times, goes to an
    interval program. For all others, what follows from the names of the sheets is found in the same time, and the rest
    goes to a SAT solver: letters and outlines of visible surfaces leave it nothing or little to do.

    References
    ----------
    .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
       Sketch-Based Interfaces and Modeling, 2011.
    .. [Bla67] S. J. Blank, "Extending immersions and regular homotopies in codimension one", thesis, Brandeis, 1967.

    Examples
    --------
    >>> limacon = [(3, 0), (1, 3), (-2, 0), (1, -3), (3, 0.5), (1, 1), (0.5, 0), (1, -1)]
    >>> print(find_immersion(limacon))
    The curve turns 2 times; what bounds a surface turns once, or less by an even number.
    >>> find_immersion([[(0, 0), (9, 0), (0, 9)], [(1, 1), (1, 3), (3, 1)]]).pieces
    (Piece(loops=(0, 1), euler_characteristic=0),)
    """
    clock = Clock(time_limit)
    watch = Watch(clock)
    try:
        arranged = in_best_way(watched_arrangement(curve, "perturb", watch), watch)
        return next(watched_immersions(arranged, watch, connected), None) or _why_not(arranged, connected, watch)
    except (TimeLimitError, TimeoutError):
        return _unknown("whether there is an immersion", clock)


def _why_not(arranged: Arrangement, connected: bool, watch: Watch) -> Obstruction:
    """Return the obstruction of an outline that has no immersion. May raise TimeLimitError or TimeoutError."""
    visible = visible_obstruction(arranged, connected)
    if visible is not None:
        return visible
    if may_bound_disk(arranged):
        return no_grouping(arranged)
    if connected and next(watched_immersions(arranged, watch), None) is not None:
        sentence = "No surface in one piece: all immersions are in several pieces."
        return Obstruction("pieces", sentence, (), None, arranged)
    return no_gluing(arranged, watch.clock)


def immersions(curve: OutlineLike, connected: bool = False) -> Iterator[Immersion]:
    """List all immersions of an outline, each once, in a stable order; nothing if there is none.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    connected : bool, optional
        List those in one piece alone; by default, all.

    Yields
    ------
    Immersion
        There can be exponentially many; they are made one at a time. Of disks, each takes time proportional to its size
        after the decision; of other surfaces, up to as many questions to a SAT solver as there are sheets to choose
        from, most of them easy.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> [len(immersion.disk_layout()) for immersion in immersions(milnor)]
    [9, 9]
    """
    yield from watched_immersions(in_best_way(arrange(curve)), UNWATCHED, connected)


def watched_immersions(arranged: Arrangement, watch: Watch, connected: bool = False) -> Iterator[Immersion]:
    """List the same as :func:`immersions`, or raise TimeLimitError."""
    place = _place_of_strict(arranged, watch, connected)
    if place:
        yield next(islice(_listed(arranged, watch, connected), place, None))
    for number, immersion in enumerate(_listed(arranged, watch, connected)):
        if number != place or not place:
            yield immersion


def _listed(arranged: Arrangement, watch: Watch, connected: bool = False) -> Iterator[Immersion]:
    """List the immersions as they are found."""
    watch = watch.begin("finding an immersion")
    if may_bound_disk(arranged):
        disks = None if is_visibly_no_disk(arranged) else find_disks(arranged, watch)
        if disks is not None:
            yield from list_disks(disks, watch)
    elif not is_visibly_no_surface(arranged, connected):
        surfaces = find_surfaces(arranged)
        if surfaces is not None:
            yield from list_surfaces(surfaces, connected, watch)


def _place_of_strict(arranged: Arrangement, watch: Watch, connected: bool = False) -> int:
    """Return which immersion is found as the first one that does not touch itself; 0 if there is none.

    It comes first in lists, for which immersion is found first depends on how the drawing lies on the page.
    """
    if arranged.given is None or len(arranged.contacts) == 0:
        return 0
    if len(list(islice(_listed(arranged, watch, connected), 2))) < 2:
        return 0
    for place, immersion in enumerate(_listed(arranged, watch, connected)):
        if not immersion.touches:
            return place
        if place + 1 == _FEW and not _bounds_strictly_by_moves(arranged):
            return 0
    return 0


@overload
def count_immersions(curve: OutlineLike, connected: bool = False) -> int: ...
@overload
def count_immersions(curve: OutlineLike, connected: bool = False, time_limit: float | None = None) -> int | Unknown: ...
def count_immersions(curve: OutlineLike, connected: bool = False, time_limit: float | None = None) -> int | Unknown:
    """Count the immersions of an outline, exactly.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    connected : bool, optional
        Count those in one piece alone; by default, all.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    int or Unknown
        0 if there is none. Immersions that differ by a deformation of the surface count once; curves stay different
        even where they run the same way. Unknown at the time limit only, and never for one curve that bounds disks:
        there the cost is polynomial in the number of crossings, however large the answer. Other surfaces are listed,
        but for parts that have nothing to do with each other, whose numbers multiply.

    Examples
    --------
    >>> count_immersions([(0, 0), (1, 0), (0, 1)])
    1
    >>> two_triangles_and_a_hole = [(0, 0), (9, 0), (0, 9)], [(-1, -1), (9, -1), (-1, 9)], [(1, 1), (1, 3), (3, 1)]
    >>> count_immersions(two_triangles_and_a_hole)
    2
    """
    clock = Clock(time_limit)
    watch = Watch(clock)
    try:
        return _count(in_best_way(watched_arrangement(curve, "perturb", watch), watch), connected, watch)
    except TimeLimitError:
        return _unknown("how many immersions there are", clock)


def _count(arranged: Arrangement, connected: bool, watch: Watch) -> int:
    """Return the number of immersions. May raise TimeLimitError."""
    if may_bound_disk(arranged):
        disks = None if is_visibly_no_disk(arranged) else find_disks(arranged)
        return 0 if disks is None else count_disks(disks)
    if is_visibly_no_surface(arranged, connected):
        return 0
    surfaces = find_surfaces(arranged)
    return 0 if surfaces is None else count_surfaces(surfaces, connected, watch.begin("counting the immersions"))


def bounds_disk_by_values(curve: OutlineLike, touching: bool = True) -> bool:
    """Tell what :func:`~plyfold.bounds_disk` does, of whatever stands for an outline, through its arrangement."""
    arranged = arrangement_unless(curve, touches_as_no_disk)
    if arranged is None:
        return False
    if touching or len(arranged.contacts) == 0:
        return any(map(_bounds_disk, ways_apart(arranged)))
    return may_bound_disk(arranged) and bounds_strictly(arranged)


def _bounds_disk(arranged: Arrangement) -> bool:
    return not is_visibly_no_disk(arranged) and bounds_disks(arranged)


def bounds_strictly(arranged: Arrangement) -> bool:
    """Tell whether the outline as given bounds a surface in the strict sense, which does not touch itself.

    A surface in the strict sense bears any small move, so one of those of the outline moved apart is the same, and
    touches itself nowhere.
    """
    firsts = (next(watched_immersions(way, UNWATCHED), None) for way in ways_apart(arranged))
    return any(first is not None and not first.touches for first in firsts)


def _bounds_strictly_by_moves(arranged: Arrangement) -> bool:
    """Tell the same by moves inward, which can make many crossings: for immersions too many to see each.

    Where cusps lie on each other, the surface may have the one beside the other on whatever side that moves, for it
    goes all the way round; so there each immersion is to be seen, and yes means no more than that.
    """
    if arranged.given is not None and number_of_ways(arranged.given) > 1:
        return True
    return any(_bounds_surface(way, UNWATCHED) for way in ways_apart(arranged, inward=True))


def in_best_way(arranged: Arrangement, watch: Watch = UNWATCHED) -> Arrangement:
    """Return an outline with cusps that lie on each other moved apart so that it bounds a surface, if there is a way.

    One that does not touch itself is better. All other outlines stay as they are.
    """
    if arranged.outline is None or not arranged.outline.has_cusps or len(arranged.contacts) == 0:
        return arranged
    good = []
    for way in ways_apart(arranged):
        first = next(watched_immersions(way, watch), None)
        if first is not None and not first.touches:
            return way
        good += [way] if first is not None else []
    return good[0] if good else arranged


def _bounds_surface(arranged: Arrangement, watch: Watch) -> bool:
    return next(_listed(arranged, watch), None) is not None


def sample_immersion(curve: OutlineLike, rng: np.random.Generator | int) -> Immersion | Obstruction:
    """Draw one of the immersions of an outline at random, all with the same probability.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    rng : numpy.random.Generator or int
        The source of randomness, or a seed for one.

    Returns
    -------
    Immersion or Obstruction
        As from :func:`find_immersion`. Cost: that of :func:`count_immersions`, however many disks there are.

    Raises
    ------
    InputError
        If ``rng`` is neither; or if a part of an outline that does not bound disks alone has more than 100,000
        immersions.

    Examples
    --------
    >>> import numpy as np
    >>> sample_immersion([(0, 0), (1, 0), (0, 1)], np.random.default_rng(1)).n_sheets
    1
    """
    dice, arranged = _dice(rng), in_best_way(arrange(curve))
    return _sampled(arranged, dice) or _why_not(arranged, False, UNWATCHED)


def _sampled(arranged: Arrangement, dice: np.random.Generator) -> Immersion | None:
    if may_bound_disk(arranged):
        disks = None if is_visibly_no_disk(arranged) else find_disks(arranged)
        return None if disks is None else nth_disk(disks, _random_below(count_disks(disks), dice))
    surfaces = None if is_visibly_no_surface(arranged) else find_surfaces(arranged)
    return None if surfaces is None else random_surface(surfaces, dice)


def _dice(rng: np.random.Generator | int) -> np.random.Generator:
    try:
        return np.random.default_rng(rng)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"the source of randomness must be a Generator or a whole number from 0 up, not {rng!r}"
        ) from error


def nth_immersion(curve: OutlineLike, index: int) -> Immersion:
    """Return the immersion that :func:`immersions` lists at a number, without making those before it.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    index : int
        From 0 to the number of immersions less 1.

    Returns
    -------
    Immersion
        Cost: that of :func:`count_immersions`, however large the index.

    Raises
    ------
    InputError
        If there are not so many immersions; or if a part of an outline that does not bound disks alone has more than
        100,000.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> nth_immersion(milnor, 1).own_sheet.tolist() == list(immersions(milnor))[1].own_sheet.tolist()
    True
    """
    arranged = in_best_way(arrange(curve))
    count = _count(arranged, False, UNWATCHED)
    if not 0 <= index < count:
        raise InputError(f"there is no immersion {index}", hint=f"the curve has {count}, numbered from 0")
    place = _place_of_strict(arranged, UNWATCHED)
    if place:
        # The strict one comes first, and those that are found before it after it.
        index = place if index == 0 else index - (index <= place)
    if may_bound_disk(arranged):
        disks = find_disks(arranged)
        assert disks is not None
        return nth_disk(disks, index)
    surfaces = find_surfaces(arranged)
    assert surfaces is not None
    return nth_surface(surfaces, index)


def best_immersion(curve: OutlineLike, key: Callable[[Immersion], Any]) -> Immersion | Obstruction:
    """Return the immersion with the smallest key, the first one of several.

    Parameters
    ----------
    curve : Curve, Outline, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of curves
    key : callable
        Takes an immersion and returns what to compare.

    Returns
    -------
    Immersion or Obstruction
        As from :func:`find_immersion`. A plain loop over :func:`immersions`: where there are thousands, sample some
        instead.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> best_immersion(milnor, key=lambda immersion: len(immersion.disk_layout())).n_sheets
    11
    """
    arranged = in_best_way(arrange(curve))
    return min(immersions(arranged), key=key, default=None) or find_immersion(arranged)


def _random_below(limit: int, rng: np.random.Generator) -> int:
    """Return a whole number from 0 to limit − 1, however large, all with the same probability."""
    while True:
        number = int.from_bytes(rng.bytes((limit.bit_length() + 7) // 8)) >> (-limit.bit_length() % 8)
        if number < limit:
            return number


def _unknown(question: str, clock: Clock) -> Unknown:
    seconds = clock.spent
    return Unknown("time limit", f"Unknown after {seconds:.3g} s: {question}.", {"seconds": seconds})
