"""Embeddings of a curve: layered disks over all its immersions at once (§5 of the paper: an open problem there).

Two ways lead to an embedding. Immersion by immersion the order of sheets is a small problem, but there can be 2^100
immersions. The equations between levels of borders (:mod:`plyfold.layering.levels.equations`) know all immersions at
once, but for curves that cover themselves many times they are harder than all of a few immersions. So few immersions
are gone through one by one, and where there are more of them the curve itself is asked.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange
from plyfold.arrangement.base import begun_at, numbered_from, visits_from_base
from plyfold.arrangement.several import are_several
from plyfold.arrays import Ints
from plyfold.clock import Clock
from plyfold.immersion.solve import bounds_disk, count_immersions, find_immersion, immersions
from plyfold.layering.layering import Layering
from plyfold.layering.levels.casing import layering_of_levels
from plyfold.layering.levels.clauses import LevelClauses, contradicting_crossings, list_levels, solve_levels
from plyfold.layering.levels.counting import count_level_solutions
from plyfold.layering.levels.equations import LevelEquations, level_equations
from plyfold.layering.levels.layered_surface import (
    LayeredSurface,
    count_layered_surfaces,
    find_layered_surface,
    layered_surfaces,
)
from plyfold.layering.orders.counting import count_layerings
from plyfold.layering.orders.listing import layerings
from plyfold.layering.orders.search import find_layering
from plyfold.obstruction import Obstruction, Unknown

__all__ = ["count_embeddings", "embeddings", "find_embedding"]

# Up to so many immersions are gone through one by one.
_FEW = 100


def find_embedding(
    curve: CurveLike, time_limit: float | None = None
) -> Layering | LayeredSurface | Obstruction | Unknown:
    """Find a layered surface without self-intersections over any immersion of the curve, or prove that there is none.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such
        Several curves bound one surface, with holes or handles: see :func:`~plyfold.find_layered_surface`.
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    Layering or Obstruction or Unknown
        The result is true if there is an embedding; it has been checked, and its ``immersion`` says over which
        immersion it lies. (For a list of curves it is a LayeredSurface.) An obstruction is that of
        :func:`~plyfold.find_immersion` if there is no immersion, and otherwise has the reason ``"no embedding"``:
        ``value`` is a tuple of crossings at which no levels of the strands fit together, whatever the immersion; as few
        as can be found with little effort. At the time limit the answer is Unknown.

    Notes
    -----
    Exact in both directions. The first immersions are tried one by one with :func:`~plyfold.find_layering`; if none of
    them lifts and there are more, the levels of all borders are a SAT problem with O(Σ w) variables and clauses, over
    borders. Whether an embedded disk can be decided in polynomial time is open [EM09]_. A chain of a hundred disks with
    5 immersions each, 1,200 crossings, takes about 0.2 s.

    References
    ----------
    .. [EM09] D. Eppstein, E. Mumford, "Self-overlapping curves revisited", SODA 2009.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> sorted(find_embedding(ramp).level.tolist())
    [1, 1, 1, 1, 2]
    """
    if are_several(curve):
        return find_layered_surface(curve, time_limit)
    clock, arranged = Clock(time_limit), arrange(curve)
    first = find_immersion(arranged)
    if isinstance(first, Obstruction):
        return first
    for immersion in islice(immersions(arranged), _FEW):
        found = find_layering(immersion, clock.left)
        if not isinstance(found, Obstruction):
            return found
    clauses = LevelClauses(_equations(arranged))
    try:
        level = solve_levels(clauses, clock) if count_immersions(arranged) > _FEW else None
    except TimeoutError:
        return _unknown("whether there is an embedding", arranged, clock)
    return _no_embedding(arranged, clauses, clock) if level is None else _checked(arranged, level)


def embeddings(curve: CurveLike) -> Iterator[Layering | LayeredSurface]:
    """List all embeddings of a curve, over all its immersions, each once, in a stable order; nothing if there is none.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such

    Yields
    ------
    Layering (or LayeredSurface)
        Checked. There can be exponentially many; they are made one at a time. Few immersions are gone through one by
        one. Otherwise each embedding takes at most k questions to the SAT solver, most of them easy, and none of them
        is in vain for long because an immersion does not lift.

    Examples
    --------
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> [layering.changes for layering in embeddings(milnor)]
    [6, 6, 6, 6]
    """
    if are_several(curve):
        yield from layered_surfaces(curve)
        return
    arranged = arrange(curve)
    total = count_immersions(arranged)
    if 0 < total <= _FEW:
        for immersion in immersions(arranged):
            yield from layerings(immersion)
    elif total:
        for level in list_levels(LevelClauses(_equations(arranged))):
            yield _checked(arranged, level)


def count_embeddings(curve: CurveLike, time_limit: float | None = None) -> int | Unknown:
    """Count the embeddings of a curve over all its immersions, exactly.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such
    time_limit : float, optional
        Seconds after which to give up; none by default.

    Returns
    -------
    int or Unknown
        0 if there is none. Turned upside down, an embedding is another one, so the number is even unless the curve does
        not cross itself. Unknown at the time limit.

    Notes
    -----
    For few immersions, the layerings of all of them. Otherwise the solutions of the equations between levels are
    counted, see :func:`plyfold.layering.levels.counting.count_level_solutions`: a curve falls apart where only one
    sheet lies, and the numbers of its parts multiply. A single part with many immersions and hundreds of crossings can
    be out of reach.

    Examples
    --------
    >>> from plyfold.gallery import chain
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> count_embeddings(milnor), count_embeddings(chain(milnor, 100)) == 4**100
    (4, True)
    """
    if are_several(curve):
        return count_layered_surfaces(curve, time_limit)
    clock, arranged = Clock(time_limit), arrange(curve)
    if not bounds_disk(arranged):
        return 0
    try:
        return _count(arranged, clock)
    except TimeoutError:
        return _unknown("how many embeddings there are", arranged, clock)


def _count(arranged: Arrangement, clock: Clock) -> int:
    if count_immersions(arranged) > _FEW:
        return count_level_solutions(_equations(arranged), clock)
    total = 0
    for immersion in immersions(arranged):
        number = count_layerings(immersion, clock.left)
        if clock.over or isinstance(number, Unknown):
            raise TimeoutError
        total += number
    return total


def _equations(arranged: Arrangement) -> LevelEquations:
    """Return the equations with borders and crossings numbered from the base visit on, for the order of answers."""
    return level_equations(numbered_from(arranged, arranged.base_visit))


def _checked(arranged: Arrangement, level: Ints) -> Layering:
    layering = layering_of_levels(arranged, begun_at(level, arranged.n_borders - arranged.base_visit))
    layering.immersion.check()
    layering.check()
    return layering


def _no_embedding(arranged: Arrangement, clauses: LevelClauses, clock: Clock) -> Obstruction:
    from_base = list(dict.fromkeys(arranged.crossing_of_visit[visits_from_base(arranged)].tolist()))
    crossings = tuple(sorted(from_base[crossing] for crossing in contradicting_crossings(clauses, clock)))
    number = count_immersions(arranged)
    which = "the only immersion does not lift" if number == 1 else f"none of the {_written(number)} immersions lifts"
    sentence = f"No embedding: {which}. No levels of the strands fit together at {len(crossings)} crossings."
    places = () if arranged.curve is None else tuple((x, y) for x, y in arranged.crossings[list(crossings)].tolist())
    return Obstruction("no embedding", sentence, places, crossings, arranged)


def _unknown(question: str, arranged: Arrangement, clock: Clock) -> Unknown:
    seconds, number = clock.spent, count_immersions(arranged)
    known = {"immersions": number, "crossings": arranged.n_crossings, "seconds": seconds}
    sentence = f"Unknown after {seconds:.3g} s: {question}. Number of immersions: {_written(number)}."
    return Unknown("time limit", sentence, known)


def _written(number: int) -> str:
    return str(number) if number < 10**6 else f"more than 2^{number.bit_length() - 1}"
