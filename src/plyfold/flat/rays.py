"""Winding numbers of places, from the edges that rays to the right of them pass. Exact."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrays import Bools, Floats, Ints
from plyfold.predicates import orient

__all__ = ["windings_round"]

# How many rays are looked up at a time.
_LOOKUPS = 2**12


def windings_round(places: Floats, start: Floats, end: Floats, times: Ints | None = None) -> tuple[Ints, Bools]:
    """Return how often edges wind round each place, and whether it lies on one of them.

    Parameters
    ----------
    places : (m, 2) float
    start, end : (n, 2) float
        Of edges that are closed curves together.
    times : (n,) int, optional
        How often each is run; once by default.

    Returns
    -------
    winding : (m,) int
        For a place on an edge, that of the place infinitely little to its right and, if need be, by far less above.
    touching : (m,) bool
    """
    winding, touching = np.zeros(len(places), dtype=np.int64), np.zeros(len(places), dtype=bool)
    for place, edge in _edges_on_the_right(places, start, end):
        side = orient(start[edge], end[edge], places[place])
        passes = _passes(start[edge, 1], end[edge, 1], places[place, 1], side)
        np.add.at(winding, place, passes if times is None else passes * times[edge])
        low, high = np.minimum(start[edge], end[edge]), np.maximum(start[edge], end[edge])
        beside = (low <= places[place]) & (places[place] <= high)
        touching[place[(side == 0) & beside.all(axis=1)]] = True
    return winding, touching


def _edges_on_the_right(places: Floats, start: Floats, end: Floats) -> Iterator[tuple[Ints, Ints]]:
    """Yield pairs of a place and an edge at its height whose bounding box is not left of it."""
    ends = np.stack([start, end], axis=1)
    tree = shapely.STRtree(shapely.linestrings(ends))
    beyond = np.maximum(ends[..., 0].max(), places[:, 0])
    rays = shapely.linestrings(np.stack([places, np.stack([beyond, places[:, 1]], axis=1)], axis=1))
    for first in range(0, len(rays), _LOOKUPS):
        place, edge = tree.query(rays[first : first + _LOOKUPS])
        yield first + place, edge


def _passes(start: Floats, end: Floats, height: Floats, side: npt.NDArray[np.int8]) -> Ints:
    """Return what edges add to the winding number of places: those on the right that pass a little above the height."""
    upward = (start <= height) & (height < end) & (side > 0)
    downward = (end <= height) & (height < start) & (side < 0)
    return upward.astype(np.int64) - downward
