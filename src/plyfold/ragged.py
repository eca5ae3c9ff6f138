"""Ragged arrays: rows of different lengths, one after the other in one array."""

from __future__ import annotations

import numpy as np

from plyfold.arrays import Ints

__all__ = ["count_each", "next_in_rows", "pairs_in_each", "previous_in_rows", "starts_of"]


def starts_of(lengths: Ints) -> Ints:
    """Return where each row starts.

    Examples
    --------
    >>> starts_of(np.array([2, 0, 3])).tolist()
    [0, 2, 2]
    """
    return np.asarray(lengths.cumsum() - lengths)


def count_each(lengths: Ints) -> Ints:
    """Return 0, 1, … for each row, one after the other.

    Examples
    --------
    >>> count_each(np.array([2, 0, 3])).tolist()
    [0, 1, 0, 1, 2]
    """
    return np.arange(int(lengths.sum())) - starts_of(lengths).repeat(lengths)


def next_in_rows(first: Ints) -> Ints:
    """Return the place of the entry after each one, the first after the last of its row; no row is empty.

    Examples
    --------
    >>> next_in_rows(np.array([0, 2, 5])).tolist()
    [1, 0, 3, 4, 2]
    """
    following = np.arange(1, int(first[-1]) + 1)
    following[first[1:] - 1] = first[:-1]
    return following


def previous_in_rows(first: Ints) -> Ints:
    """Return the place of the entry before each one, the last before the first of its row; no row is empty.

    Examples
    --------
    >>> previous_in_rows(np.array([0, 2, 5])).tolist()
    [1, 0, 4, 2, 3]
    """
    previous = np.arange(-1, int(first[-1]) - 1)
    previous[first[:-1]] = first[1:] - 1
    return previous


def pairs_in_each(lengths: Ints) -> tuple[Ints, Ints]:
    """Return the places of all pairs of entries of the same row, the earlier one first.

    Examples
    --------
    >>> [places.tolist() for places in pairs_in_each(np.array([2, 0, 3]))]
    [[0, 2, 2, 3], [1, 3, 4, 4]]
    """
    later = np.repeat(lengths, lengths) - count_each(lengths) - 1
    first = np.repeat(np.arange(len(later)), later)
    return first, first + 1 + count_each(later)
