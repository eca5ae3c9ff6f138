"""From a signed Gauss code to the points of a closed curve."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.drawing.flips import flipped
from plyfold.arrangement.drawing.relaxation import energy, relaxed
from plyfold.arrangement.drawing.skeleton import Skeleton, skeleton
from plyfold.arrangement.drawing.straight_lines import grid_drawing, tutte_drawing
from plyfold.arrays import Complexes, Ints
from plyfold.errors import GeneralPositionError, PrecisionError
from plyfold.outline.curve import Curve

__all__ = ["draw_code"]

# Shares of the edges that are rounded off; a half leaves no straight pieces.
_ROUNDINGS = (1 / 2, 1 / 4, 1 / 16, 1 / 64)
_POINTS_PER_BEND = 8
_POINTS_OF_A_CIRCLE = 48
_MOST_ROUNDS = 30
_ROUGHLY = 2e-3
_MOST_BEADS = 24
_MOST_CROSSINGS_DRAWN_TWICE = 60


def draw_code(wanted: Arrangement) -> Curve:
    """Return a smooth closed curve with the signed Gauss code of an arrangement.

    Parameters
    ----------
    wanted : Arrangement
        Only its code is used.

    Returns
    -------
    Curve
        In the direction of the arrangement, starting on the border before its first visit; the longer side of the
        bounding box is 2. The code was read back and is the same.

    Raises
    ------
    PrecisionError
        If no drawing with this code was found in double precision.

    Notes
    -----
    A triangulated disk around the curve is drawn with straight edges and then made even and round, keeping every
    triangle positively oriented; the curve is rounded last. Small curves are drawn twice, the second time with corners
    by the length of each border. About a tenth of a second for ten crossings, seconds for several hundred.

    Examples
    --------
    >>> limacon = Arrangement.from_gauss([1, 0], [True, False], 1)
    >>> arrange(draw_code(limacon)).gauss_code()
    ([1, 0], [True, False], 1)
    """
    if wanted.n_crossings == 0:
        return _curve(np.exp(2j * np.pi * np.arange(_POINTS_OF_A_CIRCLE) / _POINTS_OF_A_CIRCLE))
    for points in _candidates(*_along(wanted)):
        curve = _curve(_normalised(points))
        if _has_code(curve, wanted):
            return curve
    raise PrecisionError(
        f"no drawing of this code with {wanted.n_crossings} crossings was found in double precision",
        hint="cells nested many times in each other become too small",
    )


def _candidates(along: Complexes, path: Ints) -> Iterator[Complexes]:
    """Yield ever less rounded curves; in the last one only one strand at each crossing is moved off it, a little."""
    for share in _ROUNDINGS:
        yield _rounded(along, share)
    first = np.unique(path, return_index=True)[1]
    at_crossing = first[: len(path) - len(first)]
    straight = along.copy()
    straight[at_crossing] += _ROUNDINGS[-1] * (np.roll(along, 1) - along)[at_crossing]
    yield straight


def _along(wanted: Arrangement) -> tuple[Complexes, Ints]:
    """Return the corners of a polyline along the curve, each crossing twice, and their numbers."""
    places, disk = _even(skeleton(wanted))
    if wanted.n_crossings <= _MOST_CROSSINGS_DRAWN_TWICE:
        places, disk = _even(skeleton(wanted, _even_beads(places[disk.path], disk.path < wanted.n_crossings)))
    return relaxed(places, disk)[disk.path], disk.path


def _even_beads(along: Complexes, is_crossing: npt.NDArray[np.bool_]) -> Ints:
    """Return how many beads each border should have by its length."""
    visits = np.flatnonzero(is_crossing)
    step = np.roll(np.abs(np.roll(along, -1) - along), -visits[0])
    length = np.add.reduceat(step, visits - visits[0])
    return np.asarray(np.minimum(np.rint(length / step.mean()), _MOST_BEADS), dtype=np.int64)


def _even(disk: Skeleton) -> tuple[Complexes, Skeleton]:
    """Draw a skeleton and relax it roughly, with better triangles each time, until there are none."""
    places = relaxed(_start(disk), disk, _ROUGHLY)
    for _ in range(_MOST_ROUNDS):
        better = flipped(places, disk)
        if better is disk:
            break
        disk, places = better, relaxed(places, better, _ROUGHLY)
    return places, disk


def _start(disk: Skeleton) -> Complexes:
    """Return the smoother drawing of the two if doubles can hold it, else the one that they always can."""
    side = math.sqrt(len(disk.triangles))
    smooth = side * _normalised(tutte_drawing(disk.triangles, disk.rim))
    if np.isfinite(energy(smooth, disk)):
        return smooth
    return side * _normalised(grid_drawing(disk.triangles, disk.rim))


def _normalised(places: Complexes) -> Complexes:
    """Move the middle of the bounding box to the origin and scale its longer side to 2."""
    low = complex(places.real.min(), places.imag.min())
    size = complex(places.real.max(), places.imag.max()) - low
    return (places - low - size / 2) * (2 / max(size.real, size.imag))


def _rounded(along: Complexes, share: float) -> Complexes:
    """Replace each corner of a closed polyline by a parabola that touches both edges at a share of their lengths."""
    corner = along[:, None]
    start = corner + share * (np.roll(along, 1)[:, None] - corner)
    end = corner + share * (np.roll(along, -1)[:, None] - corner)
    t = (np.arange(_POINTS_PER_BEND) + 0.5) / _POINTS_PER_BEND
    return np.ravel(start * (1 - t) ** 2 + 2 * corner * t * (1 - t) + end * t**2)


def _curve(points: Complexes) -> Curve:
    return Curve(np.column_stack([points.real, points.imag]))


def _has_code(curve: Curve, wanted: Arrangement) -> bool:
    try:
        drawn = arrange(curve, "raise")
    except GeneralPositionError:
        return False
    same = np.array_equal(drawn.partner, wanted.partner) and np.array_equal(drawn.ccw, wanted.ccw)
    return same and not drawn.reversed and int(drawn.cell_of_dart[wanted.outer]) == 0
