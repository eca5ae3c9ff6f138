"""Many outlines as they are taken in: the points of plain curves one after the other, and whatever else there is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints, freeze
from plyfold.errors import CurveError, InputError, PlyfoldError
from plyfold.immersion.verdict import plain_points
from plyfold.outline.curve import Curve

if TYPE_CHECKING:
    from plyfold.outline.given import OutlineLike

__all__ = ["ManyOutlines", "ManyOutlinesLike", "as_many"]

ManyOutlinesLike: TypeAlias = "Iterable[Any] | tuple[npt.ArrayLike, npt.ArrayLike]"
"""Whatever stands for many outlines, see :func:`as_many`."""

_HINT = "give a list of outlines, or an array of coordinates and one of offsets, (n, 2) and (m + 1,)"


@dataclass(frozen=True)
class ManyOutlines:
    """Outlines, each one row.

    Parameters
    ----------
    points : (n, 2) float
        Of all rows that are plain points, one after the other.
    first : (m + 1,) int
        Row i has the points ``first[i]`` up to ``first[i + 1]``; no points if it is among the others.
    others : mapping from row to object
        Whatever else stands for an outline; or the error that is the answer, because it could not be read.
    """

    points: Floats
    first: Ints
    others: Mapping[int, Any]

    def __post_init__(self) -> None:
        freeze(self)

    def __len__(self) -> int:
        return len(self.first) - 1

    def outline(self, row: int) -> OutlineLike:
        """Return what stands for one of the outlines.

        Raises
        ------
        PlyfoldError
            If it could not be read.
        """
        found: OutlineLike = self.others.get(row, self.points[self.first[row] : self.first[row + 1]])
        if isinstance(found, PlyfoldError):
            raise found
        return found

    def rows(self, start: int, stop: int) -> ManyOutlines:
        """Return some that follow each other."""
        first = self.first[start : stop + 1]
        others = {row - start: self.others[row] for row in range(start, stop) if row in self.others}
        return ManyOutlines(self.points[first[0] : first[-1]], first - first[0], others)

    def batches(self, size: int) -> Iterator[ManyOutlines]:
        """Yield all of them, so many at a time."""
        for start in range(0, len(self), size):
            yield self.rows(start, min(start + size, len(self)))


def as_many(outlines: ManyOutlinesLike) -> ManyOutlines:
    """Take many outlines in.

    Parameters
    ----------
    outlines : iterable, or tuple of two arrays
        One outline each: arrays of shape (n, 2), geometries of shapely, the bytes of WKB, or whatever else stands for
        an outline, in a list, an array, a column of pandas or Arrow, a ``GeoSeries`` or ``GeoDataFrame``; an array of
        shape (m, n, 2); or ``(coordinates, offsets)`` of shapes (n, 2) and (m + 1,), of curves.

    Returns
    -------
    ManyOutlines
        What is no outline is kept: whoever comes to its row says what is wrong with it.

    Raises
    ------
    InputError
        If it is none of these.

    Examples
    --------
    >>> import shapely
    >>> square = shapely.box(0, 0, 1, 1)
    >>> many = as_many([[(0, 0), (1, 0), (0, 1)], square, square.wkb, 42])
    >>> many.first.tolist(), many.others
    ([0, 3, 8, 13, 13], {3: 42})
    """
    if isinstance(outlines, ManyOutlines):
        return outlines
    if isinstance(outlines, tuple) and len(outlines) == 2 and np.ndim(outlines[1]) == 1 and np.ndim(outlines[0]) == 2:
        return _by_offsets(*map(np.asarray, outlines))
    # A frame has its outlines in a column.
    rows = _one_by_one(getattr(outlines, "geometry", outlines))
    given: list[Any] = list(map(_plain, rows))
    others = {row: rows[row] for row, points in enumerate(given) if points is None}
    if others:
        _take_geometries(given, others)
    empty = np.empty((0, 2))
    taken = [empty if points is None else points for points in given]
    first = np.zeros(len(rows) + 1, dtype=np.int64)
    np.cumsum([len(points) for points in taken], out=first[1:])
    return ManyOutlines(np.concatenate([empty, *taken]), first, others)


def _plain(row: object) -> Floats | None:
    """Return the points of what plainly is one curve without cusps."""
    if isinstance(row, Curve):
        return None if row.cusps[0].any() else row.points
    return plain_points(row)


def _by_offsets(coordinates: npt.NDArray[Any], offsets: npt.NDArray[Any]) -> ManyOutlines:
    points = plain_points(coordinates) if len(coordinates) else np.empty((0, 2))
    if points is None:
        raise InputError(f"coordinates of shape {coordinates.shape} are not those of points in a plane", hint=_HINT)
    if offsets.dtype.kind not in "iu" or len(offsets) == 0 or offsets[0] != 0 or offsets[-1] != len(points):
        raise InputError(f"offsets are whole numbers from 0 to the number of points, {len(points)}", hint=_HINT)
    first = offsets.astype(np.int64)
    if (np.diff(first) < 0).any():
        raise InputError("offsets do not fall", hint=_HINT)
    return ManyOutlines(points, first, {})


def _one_by_one(outlines: Any) -> Sequence[Any]:
    if isinstance(outlines, list | tuple):
        return outlines
    if isinstance(outlines, str | bytes) or not hasattr(outlines, "__iter__"):
        raise InputError(f"a {type(outlines).__name__} does not hold many outlines", hint=_HINT)
    return list(np.asarray(outlines) if hasattr(outlines, "__array__") else outlines)


def _take_geometries(given: list[Any], others: dict[int, Any]) -> None:
    """Give the rows of polygons without holes and of rings their points; what WKB cannot be read has an error."""
    rows = [row for row, other in others.items() if hasattr(other, "geom_type") or isinstance(other, bytes | bytearray)]
    for row, other in others.items():
        if other is None:
            others[row] = CurveError("there is no outline in this row")
    if not rows:
        return
    geometries = _read_geometries([others[row] for row in rows])
    for row, geometry in zip(rows, geometries.tolist(), strict=True):
        others[row] = CurveError("broken WKB") if geometry is None else geometry
    places, points = _plain_rings(geometries)
    for place, ring in zip(places.tolist(), points, strict=True):
        given[rows[place]] = ring
        del others[rows[place]]


def _read_geometries(values: list[Any]) -> npt.NDArray[np.object_]:
    """Return geometries as they are, and those of WKB; None where that is broken."""
    import shapely

    geometries = np.empty(len(values), dtype=object)
    geometries[:] = values
    is_binary = ~shapely.is_geometry(geometries)
    binary = [bytes(value) for value in geometries[is_binary]]
    with np.errstate(all="ignore"):  # NaN and infinity are refused by the curve
        geometries[is_binary] = shapely.from_wkb(np.array(binary, dtype=object), on_invalid="ignore")
    return geometries


def _plain_rings(geometries: npt.NDArray[np.object_]) -> tuple[Ints, list[Floats]]:
    """Return which geometries are one ring each, as `as_outline` has it, and the points of these."""
    import shapely

    single = shapely.get_num_geometries(geometries) == 1
    geometries = np.where(single, shapely.get_geometry(geometries, 0), geometries)
    kind = shapely.get_type_id(geometries)
    polygons = (kind == shapely.GeometryType.POLYGON) & (shapely.get_num_interior_rings(geometries) == 0)
    rings = np.where(polygons, shapely.get_exterior_ring(geometries), geometries)
    places = np.flatnonzero((polygons | (kind == shapely.GeometryType.LINEARRING)) & ~shapely.is_empty(geometries))
    points, row = shapely.get_coordinates(rings[places], return_index=True)
    return places, np.split(points + 0.0, np.flatnonzero(np.diff(row)) + 1) if len(places) else []
