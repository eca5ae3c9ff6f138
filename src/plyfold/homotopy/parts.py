"""The loops into which cuts at crossings part a curve, each with its own smaller arrangement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Ints, freeze
from plyfold.homotopy.cables import Cables
from plyfold.memory import require_memory

__all__ = ["CutVisits", "Part", "parts_between"]

CutVisits: TypeAlias = tuple[int, int]
"""The two visits to a crossing at which the curve is cut, the earlier first."""


@dataclass(frozen=True, eq=False)
class Part:
    """A loop of a curve that has been cut.

    Parameters
    ----------
    borders : (b,) int
        The borders of the curve that it runs along, in order: from the start of the curve, or from the cut on.
    visits : (v,) int
        The visits that it makes to its own crossings, in order.
    border_before : (v,) int
        The place in ``borders`` of the border at whose end each of these visits is.
    cut : tuple of (int, int) or None
        The visits to the crossing where it is cut off another loop: it begins with the border behind the first; None
        for the loop with the start of the curve.
    winding : (cells,) int
        How often it winds round each cell of the curve.
    arrangement : Arrangement
        Its own, as a code: in the direction that makes no winding number negative, if there is one.
    """

    borders: Ints
    visits: Ints
    border_before: Ints
    cut: CutVisits | None
    winding: Ints
    arrangement: Arrangement

    def __post_init__(self) -> None:
        freeze(self)


def parts_between(arranged: Arrangement, cables: Cables, cuts: Sequence[CutVisits]) -> list[Part]:
    """Return the loops between cuts, which do not interleave: first that with the start of the curve, then by cuts.

    Cost: O(k) for each.
    """
    size = 8 * (len(cuts) + 1) * arranged.n_cells
    require_memory(size, "the winding numbers of all loops", arranged, "give a curve with fewer crossings")
    loops, loop_of_border = _loops(arranged, dict(cuts))
    visits = len(arranged.partner)
    # A visit stays if the loop that arrives there comes back to it: then it goes on straight.
    arriving = np.roll(loop_of_border, 1)[:visits]
    stays = arriving == arriving[arranged.partner]
    stays[[visit for cut in cuts for visit in cut]] = False
    place_of_link = cables.places_of_borders
    parts = []
    for cut, borders in loops:
        end, places = (borders + 1) % arranged.n_borders, place_of_link[borders]
        at = np.flatnonzero(stays[end]) if visits else np.empty(0, dtype=np.int64)
        own = _arrangement(arranged, cables, end[at], at, places)
        parts.append(Part(borders, end[at], at, cut, _winding(cables, places), own))
    return parts


def _loops(arranged: Arrangement, partner_of_cut: dict[int, int]) -> tuple[list[tuple[CutVisits | None, Ints]], Ints]:
    """Return the cut and the borders of each loop, and the number of each border's loop."""
    n = arranged.n_borders
    jump = partner_of_cut | {high: low for low, high in partner_of_cut.items()}
    loop_of_border = np.full(n, -1)
    loops: list[tuple[CutVisits | None, Ints]] = []
    starts: list[tuple[CutVisits | None, int]] = [(None, n - 1)]
    starts += [(cut, cut[0]) for cut in sorted(partner_of_cut.items())]
    for cut, start in starts:
        borders = []
        border = start
        while loop_of_border[border] < 0:
            loop_of_border[border] = len(loops)
            borders.append(border)
            visit = (border + 1) % n
            border = jump.get(visit, visit)
        loops.append((cut, np.array(borders)))
    return loops, loop_of_border


def _winding(cables: Cables, places: Ints) -> Ints:
    """Return how often a loop winds round each cell, given its borders' places in the walk, −1 if they are no links."""
    links = places[places >= 0]
    change = np.zeros(len(cables.walk) + 1, dtype=np.int64)
    sign = np.where(cables.is_left[links], 1, -1)
    np.add.at(change, links, sign)
    np.subtract.at(change, cables.behind[links], sign)
    winding = np.empty(len(cables.walk), dtype=np.int64)
    winding[cables.walk] = np.cumsum(change)[:-1]
    return winding


def _arrangement(arranged: Arrangement, cables: Cables, visits: Ints, at: Ints, places: Ints) -> Arrangement:
    """Return the arrangement of a loop from the visits that it makes to its own crossings.

    The first of its links in the walk through the tree has no other one on the way to the root, so the outside is on
    its far side.
    """
    number = {visit: place for place, visit in enumerate(visits.tolist())}
    partner = [number[other] for other in arranged.partner[visits].tolist()]
    first = int(np.where(places >= 0, places, len(cables.walk)).argmin())
    border = (int(np.searchsorted(at, first)) - 1) % max(len(visits), 1)
    return Arrangement.from_gauss(partner, arranged.ccw[visits], 2 * border + int(cables.is_left[places[first]]))
