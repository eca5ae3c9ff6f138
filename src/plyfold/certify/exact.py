"""What all checks share: how they read what they are given."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias, cast

import numpy as np
import numpy.typing as npt

from plyfold.errors import CertificateError

__all__ = [
    "Bools",
    "Floats",
    "Ints",
    "Loops",
    "as_faces",
    "as_loops",
    "as_vertices",
    "different",
    "exact_points",
    "finite",
    "next_along_loops",
    "pair_keys",
]

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


@dataclass(frozen=True, eq=False)
class Loops:
    """Closed loops, with numbers for their points and edges, loop after loop; edge i starts at point i.

    Parameters
    ----------
    points : (n, 2) float
    first : (loops + 1,) int
        Loop l has the points from ``first[l]`` up to ``first[l + 1]``.
    cusps : (n,) int
        How many full turns the angle at each point has more than one sees.
    """

    points: Floats
    first: Ints
    cusps: Ints

    @property
    def following(self) -> Ints:
        """The point after each, along its loop."""
        return next_along_loops(self.first)

    @property
    def edges(self) -> Floats:
        """Both ends of each edge, (n, 2, 2)."""
        return np.stack([self.points, self.points[self.following]], axis=1)


def next_along_loops(first: Ints) -> Ints:
    """Return the place after each one, in closed rows that begin at ``first``, which ends with the length of all."""
    following = np.arange(1, int(first[-1]) + 1)
    following[first[1:] - 1] = first[:-1]
    return following


def as_loops(
    loops: npt.ArrayLike | Sequence[npt.ArrayLike], cusps: npt.ArrayLike | Sequence[npt.ArrayLike] | None = None
) -> Loops:
    """Return the points of one loop, or of a list of several, as an outline; and the cusps, in arrays of that shape."""
    several = _are_several(loops)
    rows = [finite(points, 2) for points in cast("Sequence[npt.ArrayLike]", loops if several else [loops])]
    lengths = [len(points) for points in rows]
    if not lengths or 0 in lengths:
        raise CertificateError("there is no loop, or one without points")
    found = Loops(np.concatenate(rows), np.append(0, np.cumsum(lengths)), _as_cusps(cusps, lengths, several))
    if len(same := np.flatnonzero((found.edges[:, 0] == found.edges[:, 1]).all(axis=1))):
        raise CertificateError("the curve has the same point twice in a row", where=found.points[same[:1]])
    return found


def exact_points(loops: npt.ArrayLike | Sequence[npt.ArrayLike]) -> list[tuple[Fraction, Fraction]]:
    """Return the points of one loop, or of a list of several, as rational numbers: exactly as they are given."""
    rows = cast("Sequence[npt.ArrayLike]", loops if _are_several(loops) else [loops])
    return [(Fraction(x), Fraction(y)) for row in rows for x, y in np.asarray(row).tolist()]


def _are_several(loops: npt.ArrayLike | Sequence[npt.ArrayLike]) -> bool:
    """Tell a list of loops from the points of one."""
    if isinstance(loops, np.ndarray):
        return loops.ndim == 3
    if not isinstance(loops, list | tuple) or not len(loops):
        return False
    return isinstance(loops[0], list | tuple | np.ndarray) and len(loops[0]) > 0 and np.ndim(loops[0][0]) > 0


def _as_cusps(cusps: npt.ArrayLike | Sequence[npt.ArrayLike] | None, lengths: list[int], several: bool) -> Ints:
    if cusps is None:
        return np.zeros(sum(lengths), dtype=np.int64)
    rows = [np.asarray(row) for row in cast("Sequence[npt.ArrayLike]", cusps if several else [cusps])]
    if [row.shape for row in rows] != [(length,) for length in lengths]:
        raise CertificateError("the cusps are not one number for each point, loop by loop")
    if any(row.dtype.kind not in "iu" or row.min() < 0 for row in rows):
        raise CertificateError("cusps must be whole numbers from 0 on")
    return np.concatenate(rows).astype(np.int64)


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


def as_vertices(numbers: npt.ArrayLike, n_vertices: int, what: str) -> Ints:
    """Return numbers of vertices, all of which exist."""
    array = np.asarray(numbers)
    if not array.size:
        return array.astype(np.int64)
    if array.dtype.kind not in "iu" or array.min() < 0 or array.max() >= n_vertices:
        raise CertificateError(f"{what} does not name vertices by whole numbers from 0 to {n_vertices - 1}")
    return array.astype(np.int64)


def different(points: Floats) -> tuple[Floats, Ints, Ints]:
    """Return the different points in order, where each occurs first, and the number of each point among them."""
    # As complex numbers they are sorted several times as fast as as rows.
    numbers = np.ascontiguousarray(points).view(np.complex128).ravel()
    found, first, number = np.unique(numbers, return_index=True, return_inverse=True)
    return found.view(np.float64).reshape(-1, 2), first, number


def pair_keys(pairs: Ints, count: int) -> Ints:
    """Return one number for each pair of numbers below the count, whichever comes first."""
    return np.asarray(pairs.min(axis=-1) * count + pairs.max(axis=-1))
