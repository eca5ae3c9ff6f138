"""Points as every stage expects them, finite doubles in an (n, 2) array, and the record of what was changed for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from plyfold.core.vertices import LARGEST_COORDINATE
from plyfold.errors import CurveError, PrecisionError
from plyfold.mistaken import Mistake, mistaken_array, mistaken_value

__all__ = [
    "Repair",
    "as_planar_points",
    "as_points",
    "diagonal",
    "left_out",
    "refuse_mistake",
    "refuse_tiny",
]

# Squares of this size are doubles still.
_SMALLEST_SIZE = 1e-152
_LARGEST_EXACT_INTEGER = 2**53
_NUMERIC_KINDS = "iuf"


@dataclass(frozen=True)
class Repair:
    """One thing that was changed in the input so that it could be used.

    Parameters
    ----------
    kind : str
        What was done, for example ``"gap bridged"`` or ``"repeated point dropped"``.
    where : tuple of two floats
        The place, in the coordinates of the input.
    size : float
        How far it reached, in the units of the input; 0 if nothing moved.

    Examples
    --------
    >>> print(Repair("gap bridged", (1.0, 2.5), 0.25))
    gap bridged at (1, 2.5), size 0.25
    """

    kind: str
    where: tuple[float, float]
    size: float

    def __str__(self) -> str:
        size = f", size {self.size:.6g}" if self.size else ""
        return f"{self.kind} at ({self.where[0]:.12g}, {self.where[1]:.12g}){size}"


def as_points(values: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return ``values`` as an (n, 2) array of finite doubles.

    Parameters
    ----------
    values : array-like, shape (n, 2)
        Points in order; x to the right, y up.

    Returns
    -------
    ndarray, shape (n, 2), float64
        A new array, so the caller's data stays untouched. Negative zeros become zeros.

    Raises
    ------
    CurveError
        If the shape is wrong, an entry is no number, not finite or beyond ``LARGEST_COORDINATE``,
        or an integer is too long for a double to hold it.

    Notes
    -----
    O(n).

    Examples
    --------
    >>> as_points([(0, 0), (2, 1)])
    array([[0., 0.],
           [2., 1.]])
    """
    return _finite_points(_raw_array(values))


def as_planar_points(values: npt.ArrayLike) -> tuple[npt.NDArray[np.float64], tuple[Repair, ...]]:
    """Return ``values`` as :func:`as_points` does, without a third column if there is one, and a record of that.

    Examples
    --------
    >>> points, repairs = as_planar_points([(0, 0, 5), (2, 1, 5)])
    >>> points.tolist(), str(*repairs)
    ([[0.0, 0.0], [2.0, 1.0]], 'z left out at (0, 0)')
    """
    raw = _raw_array(values)
    if raw.ndim != 2 or raw.shape[1] != 3:
        return _finite_points(raw), ()
    points = _finite_points(raw[:, :2])
    return points, left_out("z", points)


def left_out(coordinate: str, points: npt.NDArray[np.float64]) -> tuple[Repair, ...]:
    """Return the record that one more coordinate of the points was left out, at the first of them."""
    x, y = points[0].tolist()
    return (Repair(f"{coordinate} left out", (x, y), 0.0),)


def diagonal(points: npt.NDArray[np.float64]) -> float:
    """Return the diagonal of the bounding box of ``points``, shape (n, 2)."""
    return float(np.hypot(*np.ptp(points, axis=0)))


def _finite_points(raw: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    if raw.ndim != 2 or raw.shape[1] != 2:
        raise CurveError(
            f"points need the shape (n, 2), and these have {raw.shape}", hint="give one x and one y per point"
        )
    points = _doubles(raw)
    # Written so that NaN counts as too large.
    if not np.abs(points).max(initial=0.0) <= LARGEST_COORDINATE:
        _refuse_infinite(points)
        _refuse_huge(points)
    _refuse_rounded_integers(raw, points)
    return points


def _raw_array(values: npt.ArrayLike) -> npt.NDArray[Any]:
    if not isinstance(values, np.ndarray | list | tuple):
        refuse_mistake(mistaken_value(values))
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(float), np.nan)
    try:
        raw = np.asarray(values)
    except ValueError as error:
        raise CurveError("the points are not all of the same length", hint="give one x and one y per point") from error
    if raw.size == 0:
        return raw.astype(float).reshape(-1, 2)
    if raw.dtype.kind == "c" and raw.ndim == 1:
        return np.column_stack([raw.real, raw.imag])
    refuse_mistake(mistaken_array(raw))
    if raw.dtype.kind not in _NUMERIC_KINDS + "O":
        raise CurveError(f"the points are not real numbers but of type {raw.dtype}", hint="give plain numbers")
    return raw


def refuse_mistake(mistake: Mistake | None) -> None:
    """Raise CurveError if something was given in place of points."""
    if mistake is not None:
        raise CurveError(mistake.message, hint=mistake.hint)


def _doubles(raw: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    if raw.dtype.kind == "O" and any(isinstance(entry, str | bytes) for entry in raw.flat):
        raise CurveError("some coordinates are text", hint="give plain numbers")
    try:
        with np.errstate(over="ignore"):
            return raw.astype(np.float64) + 0.0
    except (TypeError, ValueError, OverflowError) as error:
        raise CurveError(f"some coordinates are not real numbers: {error}", hint="give plain numbers") from error


def _refuse_infinite(points: npt.NDArray[np.float64]) -> None:
    finite = np.isfinite(points).all(axis=1)
    if finite.all():
        return
    bad = np.flatnonzero(~finite)
    first = int(bad[0])
    others = f" (and {len(bad) - 1} more points like it)" if len(bad) > 1 else ""
    good = np.flatnonzero(finite)
    nearest = good[np.argmin(np.abs(good - first))] if len(good) else None
    x, y = points[first]
    raise CurveError(
        f"point {first} is not finite: ({x:g}, {y:g}){others}"
        + ("" if nearest is None else f"; next to point {nearest}"),
        where=[] if nearest is None else [points[nearest]],
        hint="remove the point or give it finite coordinates",
    )


def _refuse_huge(points: npt.NDArray[np.float64]) -> None:
    huge = np.flatnonzero((np.abs(points) > LARGEST_COORDINATE).any(axis=1))
    if len(huge):
        raise CurveError(
            f"point {huge[0]} has a coordinate beyond {LARGEST_COORDINATE:g}",
            where=[points[huge[0]]],
            hint="scale the curve down: no answer depends on its size",
        )


def refuse_tiny(points: npt.NDArray[np.float64], what: str) -> None:
    """Raise PrecisionError for a drawing so small that what is to be made of it would have areas that are no doubles.

    Examples
    --------
    >>> refuse_tiny(np.array([(0, 0), (1e-200, 0), (0, 1e-200)]), "polygons")
    Traceback (most recent call last):
    plyfold.errors.PrecisionError: a drawing of size 1e-200 is too small for polygons: areas have no double, at (0, 0)
      hint: scale it up, to at least 1e-152
    """
    if (size := float(np.ptp(points, axis=0).max())) < _SMALLEST_SIZE:
        raise PrecisionError(
            f"a drawing of size {size:.3g} is too small for {what}: areas have no double",
            where=points[:1],
            hint=f"scale it up, to at least {_SMALLEST_SIZE:g}",
        )


def _refuse_rounded_integers(raw: npt.NDArray[Any], points: npt.NDArray[np.float64]) -> None:
    """Integers beyond 2^53 may change when they become doubles, and then touching strands could part unseen."""
    if raw.dtype.kind not in "iuO":
        return
    for row, column in np.argwhere(np.abs(points) >= _LARGEST_EXACT_INTEGER):
        given = raw[row, column]
        if isinstance(given, int | np.integer) and int(given) != int(points[row, column]):
            raise CurveError(
                f"point {row} has an integer coordinate that double precision cannot hold: {given}",
                where=[points[row]],
                hint="subtract a common offset from all points first",
            )
