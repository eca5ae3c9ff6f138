"""Triangles and polygons of many outlines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Ints
from plyfold.flat.decompose import decompose
from plyfold.flat.triangulate import triangulate
from plyfold.many.answers import ManyAnswers, answers_of_rows, in_batches, joined_answers
from plyfold.many.given import ManyOutlines, ManyOutlinesLike, as_many

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["decompose_many", "triangulate_many"]

_NO_TRIANGLES = np.empty((0, 3), dtype=np.int64)
_NO_POLYGONS = np.empty(0, dtype=object)


def triangulate_many(outlines: ManyOutlinesLike, *, client: Client | None = None) -> ManyAnswers:
    """Cut the disks or surfaces that many outlines bound into triangles on the outlines' own points.

    Parameters
    ----------
    outlines : iterable, or tuple of two arrays
        As :func:`~plyfold.verdicts` takes them.
    client : distributed.Client, optional
        A Dask cluster that does the work.

    Returns
    -------
    ManyAnswers
        Item i is what :func:`~plyfold.triangulate` returns for outline i: its triangles, counter-clockwise, whose
        corners are numbers of its points; or that raises its error. ``values`` are the triangles of all, (n, 3) int.

    Raises
    ------
    InputError
        If what is given does not hold outlines.

    Notes
    -----
    A simple 30-gon takes about 50 µs.

    Examples
    --------
    >>> found = triangulate_many([[(0, 0), (4, 0), (4, 4), (0, 4)], [(0, 0), (4, 0), (0, 3)]])
    >>> found.values.tolist(), found.first.tolist()
    ([[0, 1, 3], [3, 1, 2], [0, 1, 2]], [0, 2, 3])
    """
    return joined_answers([*in_batches(as_many(outlines), _triangles, client)], _NO_TRIANGLES)


def _triangles(outlines: ManyOutlines) -> ManyAnswers:
    def one(row: int) -> Ints:
        return triangulate(outlines.outline(row))

    return answers_of_rows(outlines, one, _NO_TRIANGLES)


def decompose_many(outlines: ManyOutlinesLike, *, client: Client | None = None) -> ManyAnswers:
    """Cut the disks or surfaces that many outlines bound into simple polygons.

    Parameters
    ----------
    outlines : iterable, or tuple of two arrays
        As :func:`~plyfold.verdicts` takes them.
    client : distributed.Client, optional
        A Dask cluster that does the work.

    Returns
    -------
    ManyAnswers
        Item i has the polygons that :func:`~plyfold.decompose` returns for outline i, or raises its error. ``values``
        are the polygons of all, an array of geometries.

    Raises
    ------
    InputError
        If what is given does not hold outlines.

    Notes
    -----
    Each takes what the single call takes, a few milliseconds.

    Examples
    --------
    >>> found = decompose_many([[(0, 0), (4, 0), (4, 4), (0, 4)], [(0, 0), (4, 0), (0, 3)]])
    >>> [polygon.area for polygon in found.values], found.first.tolist()
    ([16.0, 6.0], [0, 1, 2])
    """
    return joined_answers([*in_batches(as_many(outlines), _polygons, client)], _NO_POLYGONS)


def _polygons(outlines: ManyOutlines) -> ManyAnswers:
    def one(row: int) -> npt.NDArray[np.object_]:
        found = decompose(outlines.outline(row))
        polygons = np.empty(len(found), dtype=object)
        polygons[:] = found
        return polygons

    return answers_of_rows(outlines, one, _NO_POLYGONS)
