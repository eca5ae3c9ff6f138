"""What all checks share: how they read what they are given."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.errors import CertificateError

__all__ = ["Bools", "Floats", "Ints", "as_faces", "different", "finite", "pair_keys"]

Floats: TypeAlias = npt.NDArray[np.float64]
Ints: TypeAlias = npt.NDArray[np.int64]
Bools: TypeAlias = npt.NDArray[np.bool_]


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


def different(points: Floats) -> tuple[Floats, Ints, Ints]:
    """Return the different points in order, where each occurs first, and the number of each point among them."""
    # As complex numbers they are sorted several times as fast as as rows.
    numbers = np.ascontiguousarray(points).view(np.complex128).ravel()
    found, first, number = np.unique(numbers, return_index=True, return_inverse=True)
    return found.view(np.float64).reshape(-1, 2), first, number


def pair_keys(pairs: Ints, count: int) -> Ints:
    """Return one number for each pair of numbers below the count, whichever comes first."""
    return np.asarray(pairs.min(axis=-1) * count + pairs.max(axis=-1))
