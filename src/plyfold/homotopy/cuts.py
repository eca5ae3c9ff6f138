"""Where a curve is cut, at crossings, into loops that contract each on its own.

PricedWord that cancel are joined by chords of a disk whose boundary is the curve. A cut at a crossing is a chord, too,
between its visits. If it crosses no chord of letters, all letters that cancel do so within the two loops, which
therefore cost no more together than the curve did. And a curve that cannot be cut without loss bounds a disk on its
left or on its right ([FKW17]_), so cuts are made until every loop does.

References
----------
.. [FKW17] B. T. Fasy, S. Karakoç, C. Wenk, "On minimum area homotopies of normal curves in the plane",
   arXiv:1707.02251, 2017.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Floats, Ints
from plyfold.clock import Watch
from plyfold.core.buffers import all_flat
from plyfold.core.cancelling import find_faces
from plyfold.homotopy.cables import Cables
from plyfold.homotopy.cancellation import PricedWord, cancelled, is_rare
from plyfold.homotopy.parts import Part, parts_between
from plyfold.immersion.verdict import bounds_disk

__all__ = ["Cutting", "cut_into_disks", "cut_into_simple_loops"]


@dataclass(frozen=True, eq=False)
class Cutting:
    """Where a curve is cut, and whether it bounds a disk with branch points.

    Parameters
    ----------
    cuts : tuple of (int, int)
        The two visits to each crossing where it is cut, the earlier first.
    keeps_sign : bool
        Whether all rare letters cancel: with winding numbers from 0 up, no place is swept more often than the curve
        winds round it, and the loops are one disk with branch points.
    """

    cuts: tuple[tuple[int, int], ...]
    keeps_sign: bool


def cut_into_disks(arranged: Arrangement, cables: Cables, weights: Floats, watch: Watch) -> Cutting:
    """Cut a curve where its contraction sweeps least. May raise TimeLimitError and MemoryLimitError."""
    if bounds_disk(arranged):
        return Cutting((), True)
    weight = weights[cables.walk]
    word = PricedWord(cables.label, cables.is_plus, weight, _is_free(weight))
    watch = watch.begin("finding the least homotopy")
    mate = cancelled(word, watch)
    watch.step()
    start = np.searchsorted(cables.border, np.arange(arranged.n_borders + 1))
    cuts = list(_lossless(arranged, mate, start))
    for part in parts_between(arranged, cables, cuts):
        if not bounds_disk(part.arrangement):
            cuts += _cuts_of_part(arranged, part, word, start, watch)
    return Cutting(tuple(sorted(cuts)), not (is_rare(word) & (mate < 0)).any())


def _is_free(weight: Floats) -> Floats:
    """Return 1 for cells that cost nothing: even so they are swept as rarely as costs the same."""
    return np.asarray(weight == 0, dtype=np.float64)


def _lossless(arranged: Arrangement, mate: Ints, start: Ints) -> list[tuple[int, int]]:
    """Return cuts that cross no chords of letters, nor each other; as many as fit beside each other in some order."""
    face = np.empty(len(mate) + 1, dtype=np.int64)
    find_faces(*all_flat(mate, face))
    first = arranged.first_visits
    second = arranged.partner[first]
    here = face[start[first]]
    fits = here == face[start[second]]
    order = np.lexsort((second - first, here))
    cuts: dict[int, list[tuple[int, int]]] = {}
    for crossing in order[fits[order]].tolist():
        among = cuts.setdefault(int(here[crossing]), [])
        low, high = int(first[crossing]), int(second[crossing])
        if not any((low < one < high) != (low < other < high) for one, other in among):
            among.append((low, high))
    return [cut for among in cuts.values() for cut in among]


def _cuts_of_part(
    arranged: Arrangement, part: Part, word: PricedWord, start: Ints, watch: Watch
) -> list[tuple[int, int]]:
    """Return cuts of a loop that bounds no disk, as many as there can be without loss.

    Its crossings are written into the word, as labels that cost nothing but ties: each that cancels is a cut.
    """
    visits, borders = part.visits, part.borders
    count = start[borders + 1] - start[borders]
    which = np.repeat(start[borders] - (np.cumsum(count) - count), count) + np.arange(count.sum())
    before = np.cumsum(count)[part.border_before]
    crossing = arranged.crossing_of_visit[visits]
    _, number = np.unique(crossing, return_inverse=True)
    cells, marks = len(word.weight), len(visits) // 2
    label = np.insert(word.label[which], before, cells + number)
    is_plus = np.insert(word.is_plus[which], before, arranged.ccw[visits])
    tie = np.append(_is_free(word.weight) * (marks + 1), np.ones(marks))
    marked = PricedWord(label, is_plus, np.append(word.weight, np.zeros(marks)), tie)
    mate = cancelled(marked, watch)
    places = np.flatnonzero(label >= cells)
    paired = visits[mate[places] >= 0]
    return [(visit, other) for visit in paired.tolist() if visit < (other := int(arranged.partner[visit]))]


def cut_into_simple_loops(arranged: Arrangement) -> Cutting:
    """Cut a curve wherever it comes back to a crossing on its way. This is quick, and sweeps more than needed."""
    partner = arranged.partner.tolist()
    way: list[int] = []
    on_way: set[int] = set()
    cuts = []
    for visit, other in enumerate(partner):
        if other in on_way and other != visit:
            cuts.append((other, visit))
            while way[-1] != other:
                on_way.discard(way.pop())
            on_way.discard(way.pop())
        else:
            way.append(visit)
            on_way.add(visit)
    return Cutting(tuple(sorted(cuts)), False)
