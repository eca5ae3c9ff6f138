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

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import Watch
from plyfold.core.buffers import all_flat
from plyfold.core.cancelling import find_faces
from plyfold.homotopy.cables import Cables
from plyfold.homotopy.cancellation import PricedWord, cancelled
from plyfold.homotopy.parts import CutVisits, Part, parts_between
from plyfold.immersion.verdict import bounds_disk
from plyfold.ragged import starts_of

__all__ = ["cut_into_disks", "cut_into_simple_loops"]


def cut_into_disks(arranged: Arrangement, cables: Cables, weights: Floats, watch: Watch) -> list[CutVisits]:
    """Return cuts between loops that bound disks and sweep least. May raise TimeLimitError and MemoryLimitError.

    First come crossings whose cuts cross no letters that cancel; then, of loops that do not bound disks yet, as many as
    there can be.
    """
    watch = watch.begin("finding the least homotopy")
    weight = weights[cables.walk]
    word = PricedWord(cables.label, cables.is_plus, weight, _is_free(weight))
    cuts: list[CutVisits] = []
    for further in (_free_cuts, _most_cuts):
        for part in parts_between(arranged, cables, cuts):
            watch.step()
            if not bounds_disk(part.arrangement):
                cuts += further(arranged, part, *_word_of_part(cables, part, word), watch)
    return sorted(cuts)


def _is_free(weight: Floats) -> Floats:
    """Return 1 for cells that cost nothing: even so they are swept as rarely as costs the same."""
    return np.asarray(weight == 0, dtype=np.float64)


def _word_of_part(cables: Cables, part: Part, word: PricedWord) -> tuple[PricedWord, Ints]:
    """Return what a loop reads, and how many letters it has read at each visit to its own crossings."""
    low, high = np.searchsorted(cables.border, [part.borders, part.borders + 1])
    count = high - low
    which = (low - starts_of(count)).repeat(count) + np.arange(count.sum())
    own = PricedWord(word.label[which], word.is_plus[which], word.weight, word.tie)
    return own, np.cumsum(count)[part.border_before]


def _free_cuts(arranged: Arrangement, part: Part, word: PricedWord, gaps: Ints, watch: Watch) -> list[CutVisits]:
    """Return cuts of a loop that cross no chords of letters which cancel, nor each other."""
    mate = cancelled(word, watch)
    face = np.empty(len(mate) + 1, dtype=np.int64)
    find_faces(*all_flat(mate, face))
    here = dict(zip(part.visits.tolist(), face[gaps].tolist(), strict=True))
    cuts: dict[int, list[CutVisits]] = {}
    for low, high in sorted(_crossings(arranged, part), key=lambda cut: cut[1] - cut[0]):
        among = cuts.setdefault(here[low], [])
        if here[low] == here[high] and not any((low < one < high) != (low < other < high) for one, other in among):
            among.append((low, high))
    return [cut for among in cuts.values() for cut in among]


def _crossings(arranged: Arrangement, part: Part) -> list[CutVisits]:
    """Return the visits of a loop to each of its own crossings."""
    first = part.visits[part.visits < arranged.partner[part.visits]]
    return list(zip(first.tolist(), arranged.partner[first].tolist(), strict=True))


def _most_cuts(arranged: Arrangement, part: Part, word: PricedWord, gaps: Ints, watch: Watch) -> list[CutVisits]:
    """Return cuts of a loop that bounds no disk, as many as there can be without loss.

    Its crossings are written into the word, as labels that cost nothing but ties: each that cancels is a cut.
    """
    visits = part.visits
    number = np.unique(arranged.crossing_of_visit[visits], return_inverse=True)[1]
    cells, marks = len(word.weight), len(visits) // 2
    marked = PricedWord(
        label=np.insert(word.label, gaps, cells + number),
        is_plus=np.insert(word.is_plus, gaps, arranged.ccw[visits]),
        weight=np.append(word.weight, np.zeros(marks)),
        tie=np.append(word.tie * (marks + 1), np.ones(marks)),
    )
    is_cut: Bools = cancelled(marked, watch)[marked.label >= cells] >= 0
    cut = set(visits[is_cut].tolist())
    return [(low, high) for low, high in _crossings(arranged, part) if low in cut]


def cut_into_simple_loops(arranged: Arrangement) -> list[CutVisits]:
    """Return cuts wherever a curve comes back to a crossing on its way. This is quick, and sweeps more than needed."""
    way: list[int] = []
    on_way: set[int] = set()
    cuts = []
    for visit, other in enumerate(arranged.partner.tolist()):
        if other in on_way:
            cuts.append((other, visit))
            while way[-1] != other:
                on_way.discard(way.pop())
            on_way.discard(way.pop())
        else:
            way.append(visit)
            on_way.add(visit)
    return sorted(cuts)
