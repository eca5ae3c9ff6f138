"""A search for immersed disks that cannot be lifted, among those that go over into themselves after a part of a turn.

In a symmetric disk a pair of sheets that is carried along may come back as its own image, exchanged. Random disks
without symmetry hardly ever do that.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from itertools import islice
from typing import NamedTuple

import numpy as np

from plyfold.arrangement.arrangement import arrange
from plyfold.arrays import Floats
from plyfold.errors import InputError
from plyfold.immersion.immersion import Immersion
from plyfold.immersion.solve import immersions
from plyfold.layering.orders.search import find_layering
from plyfold.obstruction import Obstruction
from plyfold.outline.curve import Curve

__all__ = ["Unliftable", "search_symmetric"]

IMMERSIONS_TRIED = 50
SPREAD = 2.0
"""Apexes are spread normally round the centre, by so many times the radius of the first polygon."""

NEARLY_A_TURN = 1.99 * cmath.pi
TRIES = 20
"""Where the angles are nearly full, hardly a triangle fits: after so many tries for each, the curve is done."""


class Unliftable(NamedTuple):
    """A curve, an immersed disk that it bounds and that cannot be lifted, and the reason.

    Parameters
    ----------
    curve : Curve
    immersion : Immersion
    obstruction : Obstruction

    Examples
    --------
    >>> found = next(search_symmetric(np.random.default_rng(0)))
    >>> found.immersion.arrangement.curve is found.curve
    True
    """

    curve: Curve
    immersion: Immersion
    obstruction: Obstruction


def search_symmetric(
    rng: np.random.Generator, order: int = 3, triangles: int = 5, attempts: int | None = None
) -> Iterator[Unliftable]:
    """Search for symmetric curves that bound a disk that does not lift.

    Parameters
    ----------
    rng : numpy.random.Generator
    order : int, optional
        The curve goes over into itself after a turn by 1 / order; at least 2.
    triangles : int, optional
        How many random triangles, at most, are glued to each part of the regular polygon that a curve begins as: to
        each side, or to two sides of a rhomb if the order is 2.
    attempts : int, optional
        How many curves to try; no end by default.

    Yields
    ------
    Unliftable
        At most one for each curve. Every curve tried is the outline of glued triangles; the disk that does not lift may
        be another one with the same outline. The first fifty immersions of each curve are tried.

    Raises
    ------
    InputError
        If the order is less than 2.

    Notes
    -----
    About one curve in thirty of order 3, at a few milliseconds each. The smallest of them has 12 crossings and the code
    of the gallery's ``bennequin``: five immersions, of which two do not lift. Those of order 2 are rarer and larger:
    try 24 triangles.

    Examples
    --------
    >>> curve, immersion, obstruction = next(search_symmetric(np.random.default_rng(0)))
    >>> bool(find_layering(immersion)), obstruction.reason
    (False, 'reversed pair')
    """
    if order < 2:
        raise InputError(f"order {order} is no symmetry", hint="2 is a half turn")
    attempt = 0
    while attempts is None or attempt < attempts:
        attempt += 1
        yield from islice(_unliftable(Curve(_outline(rng, order, triangles))), 1)


def _unliftable(curve: Curve) -> Iterator[Unliftable]:
    for immersion in islice(immersions(arrange(curve)), IMMERSIONS_TRIED):
        found = find_layering(immersion)
        if isinstance(found, Obstruction):
            yield Unliftable(curve, immersion, found)


def _outline(rng: np.random.Generator, order: int, triangles: int) -> Floats:
    """Return the outline of triangles glued to a regular polygon, the same on all its sides."""
    turn = _root_of_unity(order)
    start = [1 + 0j] if order > 2 else [1 + 0j, 1j]
    part = _Part(turn, start, [cmath.pi * (1 - 2 / max(order, 4))] * len(start))
    for _ in range(TRIES * triangles):
        if len(part.points) < len(start) + triangles:
            part.glue(int(rng.integers(len(part.points))), SPREAD * complex(*rng.normal(size=2)))
    whole = np.concatenate([np.array(part.points) * turn**number for number in range(order)])
    return np.stack([whole.real, whole.imag], axis=1)


def _root_of_unity(order: int) -> complex:
    """Return the turn by 1 / order; a half turn and a quarter turn exactly."""
    turn = cmath.exp(2j * cmath.pi / order)
    return complex(round(turn.real, 15), round(turn.imag, 15))


class _Part(NamedTuple):
    """One part of a symmetric outline: after its last point comes its first one, turned; and the angles inside."""

    turn: complex
    points: list[complex]
    angles: list[float]

    def glue(self, edge: int, apex: complex) -> None:
        """Glue a triangle to an edge if it lies outside, and if its corners leave both ends less than a full turn."""
        last = edge + 1 == len(self.points)
        start, end = self.points[edge], self.points[0] * self.turn if last else self.points[edge + 1]
        if ((end - start).conjugate() * (apex - start)).imag >= 0:
            return
        angles = list(self.angles)
        angles[edge] += _angle(end, start, apex)
        angles[0 if last else edge + 1] += _angle(apex, end, start)
        if max(angles) < NEARLY_A_TURN:
            self.points.insert(edge + 1, apex)
            self.angles[:] = [*angles[: edge + 1], _angle(start, apex, end), *angles[edge + 1 :]]


def _angle(before: complex, corner: complex, behind: complex) -> float:
    """Return the angle at the corner of a triangle, less than π."""
    return abs(cmath.phase((before - corner) / (behind - corner)))
