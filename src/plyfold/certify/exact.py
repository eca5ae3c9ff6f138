"""What all checks share: their error, reading of the input, and exact signs."""

from __future__ import annotations

from fractions import Fraction
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.errors import PlyfoldError

__all__ = [
    "Bools",
    "CertificateError",
    "Floats",
    "Ints",
    "as_faces",
    "cross_sign",
    "finite",
    "pair_keys",
    "require_positive",
]

Floats: TypeAlias = npt.NDArray[np.float64]
Ints: TypeAlias = npt.NDArray[np.int64]
Bools: TypeAlias = npt.NDArray[np.bool_]

# The rounding error of a cross product of two differences is below 3.0000001 u (|left| + |right|), u = 2^-53.
_CROSS_ERROR = 6.7e-16
_UNDERFLOW = 1e-290


class CertificateError(PlyfoldError):
    """A checked mesh breaks a condition; the message names the condition and the place."""


def finite(points: npt.ArrayLike, columns: int) -> Floats:
    """Return the points as doubles, in the given number of columns, all finite."""
    array = np.asarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != columns:
        raise CertificateError(f"positions have shape {array.shape}, not (…, {columns})")
    if len(bad := np.flatnonzero(~np.isfinite(array).all(axis=1))):
        raise CertificateError(f"the position of vertex {bad[0]} is not finite")
    return array


def as_faces(faces: npt.ArrayLike, n_vertices: int) -> Ints:
    """Return the triangles as integers, each with three different vertices that exist."""
    array = np.asarray(faces)
    if array.ndim != 2 or array.shape[1] != 3 or not len(array) or array.dtype.kind not in "iu":
        raise CertificateError(f"faces have shape {array.shape} and type {array.dtype}, not (…, 3) integers")
    triangles = array.astype(np.int64)
    if triangles.min() < 0 or triangles.max() >= n_vertices:
        raise CertificateError(f"a triangle names a vertex that does not exist; there are {n_vertices}")
    twice = (triangles == np.roll(triangles, 1, axis=1)).any(axis=1)
    if twice.any():
        raise CertificateError(f"triangle {np.argmax(twice)} names a vertex twice")
    return triangles


def pair_keys(pairs: Ints, count: int) -> Ints:
    """Return one number for each pair of numbers below the count, whichever comes first."""
    return np.asarray(pairs.min(axis=-1) * count + pairs.max(axis=-1))


def require_positive(places: Floats, triangles: Ints) -> None:
    """Check that all triangles are strictly counter-clockwise."""
    a, b, c = places[triangles].swapaxes(0, 1)
    if len(bad := np.flatnonzero(cross_sign(a, b, a, c) <= 0)):
        raise CertificateError(f"triangle {bad[0]} is flat or turned over", where=places[triangles[bad[0]]])


def cross_sign(a: Floats, b: Floats, c: Floats, d: Floats) -> npt.NDArray[np.int8]:
    """Return the exact signs of the cross products of a → b and c → d, all of shape (m, 2)."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        left = (b[:, 0] - a[:, 0]) * (d[:, 1] - c[:, 1])
        right = (b[:, 1] - a[:, 1]) * (d[:, 0] - c[:, 0])
        cross = left - right
        sure = np.abs(cross) > _CROSS_ERROR * (np.abs(left) + np.abs(right)) + _UNDERFLOW
    sure &= np.isfinite(cross)
    signs = np.where(sure, np.sign(np.where(sure, cross, 0)), 0).astype(np.int8)
    for i in np.flatnonzero(~sure):
        signs[i] = _exact_cross_sign(*(point[i].tolist() for point in (a, b, c, d)))
    return signs


def _exact_cross_sign(a: list[float], b: list[float], c: list[float], d: list[float]) -> int:
    if (a[0] == b[0] or c[1] == d[1]) and (a[1] == b[1] or c[0] == d[0]):
        return 0
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = ((Fraction(x), Fraction(y)) for x, y in (a, b, c, d))
    cross = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    return (cross > 0) - (cross < 0)
