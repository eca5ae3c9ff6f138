"""A planar map numbered from its base visit: from a place in the drawing, not from the point where it was begun.

Where several answers are equally good, the first one is taken, and "first" is counted from there: so the same drawing
gets the same immersion and the same layering wherever its list of points begins, and whichever way it runs.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Ints, Shorts

__all__ = ["begun_at", "borders_numbered_back", "numbered_from", "visits_from_base"]

Values = TypeVar("Values", Ints, Shorts, Bools)


def visits_from_base(arrangement: Arrangement) -> Ints:
    """Return all visits in order along the curve, the base visit first."""
    n = len(arrangement.partner)
    return (arrangement.base_visit + np.arange(n)) % max(n, 1)


def numbered_from(arrangement: Arrangement, base: int) -> Arrangement:
    """Return the planar map of one curve, without the drawing, with visits, borders and darts numbered from a visit on.

    Cells and crossings keep their numbers. Cost: O(k).
    """
    if base == 0:
        return arrangement
    darts, visits = 2 * arrangement.n_borders, len(arrangement.partner)
    cell_darts = (arrangement.cell_darts - 2 * base) % darts
    outside = cell_darts[: arrangement.cell_start[1]]
    cell_darts[: len(outside)] = begun_at(outside, int(outside.argmin()))
    return replace(
        arrangement,
        partner=(begun_at(arrangement.partner, base) - base) % visits,
        ccw=begun_at(arrangement.ccw, base),
        outer=(arrangement.outer - 2 * base) % darts,
        next_dart=(begun_at(arrangement.next_dart, 2 * base) - 2 * base) % darts,
        cell_of_dart=begun_at(arrangement.cell_of_dart, 2 * base),
        cell_darts=cell_darts,
        crossing_of_visit=begun_at(arrangement.crossing_of_visit, base),
        cusp_index=begun_at(arrangement.cusp_index, base),
        outline=None,
        given=None,
        begun=None,
        numbers=np.empty(0, dtype=np.int64),
        marks=np.empty((0, 2)),
        crossings=np.empty((0, 2)),
        visit_edge=np.empty(0, dtype=np.int64),
    )


def borders_numbered_back(arrangement: Arrangement, values: Values) -> Values:
    """Return one value for each border, numbered as usual, of values numbered from the base visit on."""
    return begun_at(values, arrangement.n_borders - arrangement.base_visit)


def begun_at(array: Values, start: int) -> Values:
    """Return an array from a place on, then what is before it: ``np.roll`` in a tenth of the time for short ones."""
    return np.concatenate([array[start:], array[:start]])
