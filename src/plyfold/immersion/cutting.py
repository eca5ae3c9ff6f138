"""Cutting a curve where every immersion is cut alike, until only its kernels are left (§2.3 of the paper).

All borders that see a cell with winding number 1 on their left lie on its one sheet. Cutting the disk along chords from
each to the next leaves the sheet and, around it, smaller disks. Their outlines are closed curves again, and crossings
between two of them are gone; so they may have new cells with winding number 1. What cannot be cut any further is a
*kernel*: all choices between immersions are choices within kernels (compare [EW20]_).

References
----------
.. [EW20] P. Evans, C. Wenk, "Combinatorial properties of self-overlapping curves and interior boundaries",
   Symposium on Computational Geometry, 2020.
"""

from __future__ import annotations

from bisect import bisect_right

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, CurveLike, arrange
from plyfold.immersion.immersion import require_disk, require_immersion
from plyfold.immersion.obstructions import require_curve_without_cusps
from plyfold.immersion.solve import find_immersion

__all__ = ["irreducible_kernels"]


def irreducible_kernels(curve: CurveLike) -> list[Arrangement]:
    """Cut a curve as the cells with winding number 1 tell, as often as possible, and return what is left.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement

    Returns
    -------
    list of Arrangement
        The pieces that still cross themselves, as codes without drawing. The number of immersions of the curve is the
        product of theirs. Cost: O(k) for each round of cuts.

    Raises
    ------
    NotImmersibleError
        If the curve bounds no disk.
    InputError
        If it bounds a disk with handles, has cusps, or is several.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> irreducible_kernels(ramp)
    []
    """
    arranged = arrange(curve)
    require_curve_without_cusps(arranged, "cutting into kernels")
    found = require_disk(require_immersion(find_immersion(arranged)))
    kernels, waiting = [], [found.arrangement]
    while waiting:
        piece = waiting.pop()
        parts = _cut(piece)
        waiting.extend(reversed(parts))
        if not parts and piece.n_crossings:
            kernels.append(piece)
    return kernels


def _cut(arrangement: Arrangement) -> list[Arrangement]:
    """Return the curves around the sheets over cells with winding number 1 that several borders belong to."""
    before = _cuts(arrangement)
    ends, partner_of = sorted(before), arrangement.partner.tolist()
    parts: list[Arrangement] = []
    used: set[int] = set()
    for start in ends:
        if start not in used:
            visits = _visits_of_part(before, ends, start, arrangement.n_borders)
            used.update((visit - 1) % arrangement.n_borders for visit in visits)
            parts.append(_part(arrangement, partner_of, visits))
    return parts


def _cuts(arrangement: Arrangement) -> dict[int, int]:
    """Return the chords along which to cut: for each border at the end of one, the border at its other end.

    The part outside a chord arrives at the first border and goes on from the second.
    """
    before: dict[int, int] = {}
    for cell in np.flatnonzero(arrangement.winding == 1).tolist():
        own = [dart // 2 for dart in arrangement.cells[cell] if dart % 2 == 0]
        if len(own) > 1:
            before.update(zip(own, own[-1:] + own[:-1], strict=True))
    return before


def _visits_of_part(before: dict[int, int], ends: list[int], start: int, n: int) -> list[int]:
    """Walk along the curve from a border at which a chord begins, and along the chords back to there."""
    visits: list[int] = []
    border = start
    while True:
        arrival = ends[bisect_right(ends, border) % len(ends)]
        visits += [(border + 1 + step) % n for step in range((arrival - border) % n or n)]
        border = before[arrival]
        if border == start:
            return visits


def _part(arrangement: Arrangement, partner_of: list[int], visits: list[int]) -> Arrangement:
    """Return the curve through some of the visits: crossings of which it keeps only one visit are gone.

    Its last border runs along a chord, and right of that the part winds zero times.
    """
    here = set(visits)
    kept = [visit for visit in visits if partner_of[visit] in here]
    number = {visit: at for at, visit in enumerate(kept)}
    partner = [number[partner_of[visit]] for visit in kept]
    return Arrangement.from_gauss(partner, arrangement.ccw[kept], outer=max(2 * len(kept) - 1, 1))
