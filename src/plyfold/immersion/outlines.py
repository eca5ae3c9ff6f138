"""All surfaces that an outline of any kind bounds: several loops, holes, handles, pieces.

An immersion is a choice of own sheets for the ascending links of the dual tree. What follows without any choice is
peeled off; the rest falls into parts that have nothing to do with each other, and the SAT solver lists the choices of
each.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from math import prod
from typing import TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints
from plyfold.clock import NO_LIMIT, UNWATCHED, Clock, Watch
from plyfold.errors import InputError
from plyfold.immersion.gluings import OpenPart, open_parts, open_whole
from plyfold.immersion.immersion import Immersion, require_memory_for_gluing
from plyfold.immersion.peeling import OutlineSeams, Peeled, immersion_of, outline_seams, peel
from plyfold.immersion.search_map import SearchMap, search_map_of
from plyfold.ragged import starts_of
from plyfold.sat import solutions_by_choice

__all__ = ["Surfaces", "count_surfaces", "find_surfaces", "list_surfaces", "nth_surface", "random_surface"]

# More immersions than this are not listed to draw one of them.
_MOST_LISTED = 100_000

# The own sheets of the ascending links of a part, as counted in their cells.
Choice: TypeAlias = dict[int, int]


@dataclass(frozen=True, eq=False)
class Surfaces:
    """All surfaces that an outline bounds, in a form to list and count them from.

    Parameters
    ----------
    search_map : SearchMap
    seams : OutlineSeams
        Those of the search map.
    known : Peeled
        What all of them have in common, as far as peeling tells.
    parts : list of OpenPart
        What is open.
    """

    search_map: SearchMap
    seams: OutlineSeams
    known: Peeled
    parts: list[OpenPart]


def find_surfaces(arranged: Arrangement) -> Surfaces | None:
    """Prepare all surfaces of an outline without a visible obstruction; None if peeling shows that there is none."""
    require_memory_for_gluing(arranged)
    search_map = search_map_of(arranged)
    seams = outline_seams(search_map.map)
    known = peel(seams)
    if known.is_contradiction:
        return None
    return Surfaces(search_map, seams, known, [] if known.is_complete else open_parts(seams, known))


def list_surfaces(surfaces: Surfaces, connected: bool = False, watch: Watch = UNWATCHED) -> Iterator[Immersion]:
    """List them, each once, in a stable order; only those in one piece if so demanded. May raise TimeLimitError."""
    with _in_time(watch):
        for choice in _choices(surfaces, connected, watch.clock):
            watch.step()
            yield _glued(surfaces, choice)


def count_surfaces(surfaces: Surfaces, connected: bool = False, watch: Watch = UNWATCHED) -> int:
    """Count them, exactly: the numbers of independent parts multiply. May raise TimeLimitError."""
    with _in_time(watch):
        if connected:
            return sum(1 for _ in _choices(surfaces, True, watch.clock))
        return prod(sum(1 for _ in _choices_of_part(part, watch.clock)) for part in surfaces.parts)


def nth_surface(surfaces: Surfaces, index: int) -> Immersion:
    """Return the one that is listed at a number below their count, by listing the choices of each part."""
    chosen: Choice = {}
    for choices in reversed([_listed(part) for part in surfaces.parts]):
        index, here = divmod(index, len(choices))
        chosen.update(choices[here])
    return _glued(surfaces, chosen)


def random_surface(surfaces: Surfaces, dice: np.random.Generator) -> Immersion | None:
    """Return any of them, all with the same probability; None if there is none."""
    chosen: Choice = {}
    for part in surfaces.parts:
        choices = _listed(part)
        if not choices:
            return None
        chosen.update(choices[int(dice.integers(len(choices)))])
    return _glued(surfaces, chosen)


def _listed(part: OpenPart) -> list[Choice]:
    """Return all choices of a part, if there are not too many."""
    choices: list[Choice] = []
    for choice in _choices_of_part(part, NO_LIMIT):
        if len(choices) == _MOST_LISTED:
            raise InputError(
                f"the outline has more than {_MOST_LISTED:,} immersions, too many to be numbered",
                hint="immersions(outline) lists them one by one",
            )
        choices.append(choice)
    return choices


@contextmanager
def _in_time(watch: Watch) -> Iterator[None]:
    """Raise the solver's TimeoutError as the TimeLimitError of a watch."""
    try:
        yield
    except TimeoutError:
        watch.step()
        raise


def _choices(surfaces: Surfaces, connected: bool, clock: Clock) -> Iterator[Choice]:
    """Yield the choices that make a surface, those of the last part changing first."""
    if connected:
        yield from _choices_in_one_piece(surfaces, clock)
        return
    listed = [_Kept(_choices_of_part(part, clock)) for part in surfaces.parts]
    for choices in _product(listed):
        yield {link: own for choice in choices for link, own in choice.items()}


def _choices_of_part(part: OpenPart, clock: Clock) -> Iterator[Choice]:
    return map(part.choice, solutions_by_choice(part.clauses(), part.choices, clock))


@dataclass(eq=False)
class _Kept:
    """What comes from somewhere, kept to be gone through again."""

    source: Iterator[Choice]
    kept: list[Choice] = field(default_factory=list)

    def __iter__(self) -> Iterator[Choice]:
        yield from self.kept
        for item in self.source:
            self.kept.append(item)
            yield item


def _product(listed: Sequence[_Kept]) -> Iterator[tuple[Choice, ...]]:
    """Yield all combinations, the last one changing first; nothing is asked for before it is needed."""
    if not listed:
        yield ()
        return
    for first in listed[0]:
        for rest in _product(listed[1:]):
            yield first, *rest


def _glued(surfaces: Surfaces, choice: Choice) -> Immersion:
    known = peel(surfaces.seams, choice) if choice else surfaces.known
    return surfaces.search_map.carried_back(immersion_of(surfaces.seams, known.upper))


# ---- in one piece --------------------------------------------------------------------------------------------------


def _choices_in_one_piece(surfaces: Surfaces, clock: Clock) -> Iterator[Choice]:
    """Yield the choices that make a connected surface.

    Where a solution has several pieces, the sheets of one of them must be glued to others in every solution wanted,
    which is one clause more.
    """
    if surfaces.known.is_complete:
        if _piece_of_sheet(surfaces.seams, surfaces.known.upper).max(initial=0) == 0:
            yield {}
        return
    whole = open_whole(surfaces.seams, surfaces.known)
    lacking = partial(_missing_link, whole)
    yield from map(whole.choice, solutions_by_choice(whole.clauses(), whole.choices, clock, lacking))


def _missing_link(whole: OpenPart, model: list[int]) -> list[int] | None:
    """Return the clause that some sheet of the smallest piece is glued to one of another piece; None if it is alone."""
    seams = whole.seams
    piece = _piece_of_sheet(seams, whole.upper(model))
    if piece.max(initial=0) == 0:
        return None
    smallest = int(np.bincount(piece).argmin())
    first_sheet = starts_of(seams.arrangement.winding)
    left, right = first_sheet[seams.left], first_sheet[seams.right]
    return whole.some_of(
        lambda seam, port, sheet: (piece[right[seam] + port] == smallest) != (piece[left[seam] + sheet] == smallest)
    )


def _piece_of_sheet(seams: OutlineSeams, upper: Ints) -> Ints:
    return immersion_of(seams, upper).piece_of_sheet
