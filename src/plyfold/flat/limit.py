"""What an outline that touches itself is a limit of: the first part of its certificate."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple, cast

import numpy as np

from plyfold.arrays import Ints, Reals
from plyfold.flat.sweep import sweep_as_drawn
from plyfold.immersion.immersion import Immersion, require_immersion
from plyfold.mesh.begun import drawings_of
from plyfold.mesh.refine import given_outline

__all__ = ["Limit", "limit_of"]


class Limit(NamedTuple):
    """A surface, and the outline that its boundary comes to: ``certify.check_limit(*limit)`` checks it.

    Parameters
    ----------
    loops : tuple of ndarray, shape (n, 2)
        The loops of the outline as they were given, with the surface on the left of each, and without spikes.
    moved : tuple of ndarray, shape (n, 2)
        The same where points in contact have begun to move outward: in fractions, infinitely near.
    faces : (m, 3) int
        Triangles on these points, numbered loop after loop, that are a surface with the moved outline as its boundary.
    cusps : tuple of ndarray, shape (n,)
        The index of each point.
    free : ndarray
        The points that moved in another way: cusps, of which several were in one place.
    twins : (3 m,) int
        The side beyond each side of each triangle, −1 on the boundary.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> limit_of(find_immersion([(0, 0), (4, 0), (0, 4)])).faces.tolist()
    [[0, 1, 2]]
    """

    loops: tuple[Reals, ...]
    moved: tuple[Reals, ...]
    faces: Ints
    cusps: tuple[Ints, ...]
    free: Ints
    twins: Ints


def limit_of(immersion: Immersion) -> Limit:
    """Return the surface over the outline with touching points moved apart, which shows that this is a limit.

    Parameters
    ----------
    immersion : Immersion

    Returns
    -------
    Limit
        What :func:`plyfold.certify.check_limit` asks for. If nothing touches, nothing has moved.

    Raises
    ------
    NotImmersibleError
        For the obstruction of an outline that bounds nothing.

    Notes
    -----
    That of :func:`triangulate`, in rational numbers where something touches.

    Examples
    --------
    >>> from plyfold import find_immersion
    >>> from plyfold.certify import check_limit
    >>> bow = find_immersion([(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)])
    >>> limit = limit_of(bow)
    >>> len(limit.faces), [point != (1, 1) for point in map(tuple, limit.moved[0][[1, 4]])]
    (4, [True, True])
    >>> check_limit(*limit)
    """
    *_, drawn = drawings_of(require_immersion(immersion).arrangement)
    triangles = sweep_as_drawn(replace(immersion, arrangement=drawn))
    given, points = given_outline(drawn), drawn.exact_points
    moved = (points != given.points).any(axis=1)
    loops = cast("list[Reals]", np.split(points, given.first_point[1:-1]))
    free = np.flatnonzero(moved & (np.concatenate(given.cusps) > 0))
    return Limit(given.loops, tuple(loops), triangles.faces, given.cusps, free, triangles.twin)
