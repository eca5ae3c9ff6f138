"""What is different between two immersions of one curve."""

from __future__ import annotations

import numpy as np

from plyfold.arrays import Ints
from plyfold.errors import InputError
from plyfold.graphs import components
from plyfold.immersion.immersion import Immersion, require_immersion

__all__ = ["changed_borders", "flip_distance"]


def changed_borders(first: Immersion, second: Immersion) -> tuple[int, ...]:
    """Return the borders that lie on a sheet together with other borders than before.

    Parameters
    ----------
    first, second : Immersion
        Of the same curve.

    Returns
    -------
    tuple of int
        Borders whose group in the disk layout is not the same; none if and only if the immersions are the same.

    Raises
    ------
    InputError
        If the immersions belong to different curves.

    Notes
    -----
    O(k log k).

    Examples
    --------
    >>> from plyfold import immersions
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> changed_borders(*immersions(milnor))
    (0, 1, 2, 3, 4, 6, 7, 8, 9, 10)
    """
    both = _meet(first, second)
    sizes = [_sizes(groups) for groups in (first.own_sheet, second.own_sheet, both)]
    changed = (sizes[0] != sizes[2]) | (sizes[1] != sizes[2])
    return tuple(np.flatnonzero(changed).tolist())


def flip_distance(first: Immersion, second: Immersion) -> int:
    """Return the least number of times that groups of the disk layout are joined or split on the way to another.

    Parameters
    ----------
    first, second : Immersion
        Of the same curve.

    Returns
    -------
    int
        The distance in the lattice of partitions, whose shortest ways join first and split afterwards.

    Raises
    ------
    InputError
        If the immersions belong to different curves.

    Notes
    -----
    O(k log k).

    Examples
    --------
    >>> from plyfold import immersions
    >>> milnor = [(88, 39), (62, 102), (-17, -15), (-17, -13), (44, -7), (-75, 180),
    ...           (-88, -39), (-62, -102), (17, 15), (17, 13), (-44, 7), (75, -180)]
    >>> flip_distance(*immersions(milnor))
    6
    """
    _meet(first, second)
    return _partition_distance(first.own_sheet, second.own_sheet)


def _partition_distance(first: Ints, second: Ints) -> int:
    """Return the distance of two partitions of the same things, given the group of each."""
    groups = np.unique(first, return_inverse=True)[1], np.unique(second, return_inverse=True)[1]
    sizes = int(groups[0].max()) + 1, int(groups[1].max()) + 1
    joined = components(sum(sizes), groups[0], groups[1] + sizes[0])
    return sum(sizes) - 2 * int(joined.max() + 1)


def _meet(first: Immersion, second: Immersion) -> Ints:
    """Return a number for each border that says in which group it is both times."""
    if require_immersion(first).arrangement.gauss_code() != require_immersion(second).arrangement.gauss_code():
        raise InputError("the immersions belong to different curves", hint="compare immersions of one curve")
    return np.asarray(first.own_sheet * second.n_sheets + second.own_sheet)


def _sizes(groups: Ints) -> Ints:
    """Return for each border the number of borders in its group."""
    _, inverse, count = np.unique(groups, return_inverse=True, return_counts=True)
    return np.asarray(count[inverse])
