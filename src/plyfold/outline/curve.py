"""Closed polylines, the input of everything else (the self-crossing loop of the paper, §2.1)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, cast

import numpy as np
import numpy.typing as npt

from plyfold.errors import CurveError, InputError
from plyfold.outline.points import Repair, as_planar_points, left_out
from plyfold.outline.strokes import join_strokes
from plyfold.predicates import orient

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


__all__ = [
    "Coded",
    "Curve",
    "CurveLike",
    "Drawn",
    "Geometry",
    "OutlineLike",
    "Repair",
    "are_several",
    "as_curve",
    "as_curves",
]


class Drawn(Protocol):
    """A value that was made from a curve, such as an arrangement."""

    @property
    def curve(self) -> Curve | None:
        """The curve, if it has coordinates."""


class Coded(Protocol):
    """A signed Gauss code."""

    @property
    def partner(self) -> Any:
        """The other visit to the same crossing, for each visit."""

    @property
    def ccw(self) -> Any:
        """Whether the other strand crosses from right to left, for each visit."""

    @property
    def outer(self) -> int:
        """A dart of the unbounded cell."""


class Geometry(Protocol):
    """A geometry of shapely."""

    @property
    def geom_type(self) -> str:
        """Its kind, such as ``"Polygon"``."""


CurveLike: TypeAlias = (
    "Curve | Drawn | Coded | Geometry | npt.NDArray[Any] | Sequence[Sequence[float]] | Sequence[npt.NDArray[Any]]"
)
"""Whatever stands for a closed curve: a curve, points of shape (n, 2), a shapely geometry, an arrangement or a code."""

OutlineLike: TypeAlias = "CurveLike | Sequence[CurveLike]"
"""Whatever stands for closed curves that bound a surface together: one curve, or a list of them."""


@dataclass(frozen=True, eq=False, init=False)
class Curve:
    """A closed polyline: the points in order, the last one joined to the first.

    Parameters
    ----------
    points : array-like, shape (n, 2) or (n, 3)
        Vertices in order, x to the right and y up, in any unit. If the last point repeats the first, it is left out;
        other points that repeat the one before them, and a third column, are left out and recorded in ``repairs``.
    repairs : iterable of Repair, optional
        What was changed before the points came here.

    Attributes
    ----------
    points : ndarray, shape (n, 2), float64, read-only
        At least three vertices, no two consecutive ones equal, not all on one line.
    repairs : tuple of Repair
        Everything that was changed in the input.
    rows : ndarray, shape (n,), int64, read-only
        The row that each vertex has in the array it was made from: 0 to n − 1, unless points were left out.

    Raises
    ------
    CurveError
        If the shape is wrong, a coordinate is not finite, fewer than three points differ, or all lie on one line
        (decided exactly; a figure eight with signed area 0 is a fine curve).

    Notes
    -----
    O(n log n). Curves are compared by identity.

    Examples
    --------
    >>> square = Curve([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)])
    >>> len(square)
    4
    >>> [str(repair) for repair in Curve([(0, 0), (1, 0), (1, 0), (0, 1)]).repairs]
    ['repeated point dropped at (1, 0)']
    """

    points: npt.NDArray[np.float64]
    repairs: tuple[Repair, ...]
    rows: npt.NDArray[np.int64]

    def __init__(self, points: npt.ArrayLike, repairs: Iterable[Repair] = ()) -> None:
        planar, flattened = as_planar_points(points)
        given = _without_closing_point(planar)
        rows = _fresh_rows(given)
        # All of them, mostly; a copy would cost more than the rest.
        kept = given if len(rows) == len(given) else given[rows]
        _refuse_degenerate(kept)
        kept.setflags(write=False)
        rows.setflags(write=False)
        object.__setattr__(self, "points", kept)
        object.__setattr__(self, "repairs", (*repairs, *flattened, *_dropped_points(given, rows)))
        object.__setattr__(self, "rows", rows)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"<Curve of {len(self)} points>"

    def _repr_svg_(self) -> str:
        from plyfold.draw.svg import curve_svg

        return curve_svg(self.points)

    @classmethod
    def from_strokes(cls, strokes: Iterable[npt.ArrayLike], max_gap: float | None = None) -> Curve:
        """Join strokes, given in any order and direction, into one closed curve.

        Parameters
        ----------
        strokes : iterable of array-likes, each of shape (m, 2)
            Pen strokes that together cover the loop (§4 of [MGR11]_).
        max_gap : float, optional
            Longest gap that may be bridged; by default a tenth of the diagonal of the bounding box.

        Returns
        -------
        Curve
            It starts with the first stroke in its given direction; every bridged gap is in ``repairs``.

        Raises
        ------
        StrokeError
            If there is no stroke, or a gap is longer than ``max_gap``; it names both ends.
        CurveError
            If the joined points are not a usable curve.

        Notes
        -----
        See :func:`plyfold.outline.strokes.join_strokes`, which does the work, for the cost.

        References
        ----------
        .. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
           Sketch-Based Interfaces and Modeling, 2011.

        Examples
        --------
        >>> curve = Curve.from_strokes([[(0, 0), (4, 0)], [(0, 3), (0, 0)], [(4, 0), (0, 3)]])
        >>> curve.points.tolist()
        [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]
        """
        points, repairs = join_strokes(strokes, max_gap)
        return cls(points, repairs)

    def reversed(self) -> Curve:
        """Return the same curve run the other way from the same first point.

        Returns
        -------
        Curve

        Notes
        -----
        O(n log n).

        Examples
        --------
        >>> Curve([(0, 0), (1, 0), (0, 1)]).reversed().points.tolist()
        [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]
        """
        return Curve(np.roll(self.points[::-1], 1, axis=0), self.repairs)


def as_curve(value: object) -> Curve:
    """Return whatever stands for a closed curve as a `Curve`.

    Parameters
    ----------
    value : Curve, array-like of shape (n, 2), shapely geometry, or a value with a ``curve``
        A third coordinate, of an array or a geometry, is left out, and ``repairs`` says so.
        Of the geometries: a ``LinearRing`` or a ``Polygon`` without holes; a ``LineString`` or ``MultiLineString``
        is taken as strokes, so its ends must nearly meet; a collection of one counts as that one.

    Returns
    -------
    Curve

    Raises
    ------
    CurveError
        If the value is not a usable curve.
    StrokeError
        If the ends of an open geometry are too far apart.

    Notes
    -----
    O(n log n).

    Examples
    --------
    >>> import shapely
    >>> len(as_curve(shapely.box(0, 0, 1, 1)))
    4
    """
    if isinstance(value, Curve):
        return value
    if isinstance(getattr(value, "geom_type", None), str):  # a GeoSeries has an array of them
        return _curve_of_geometry(cast("BaseGeometry", value))
    if hasattr(value, "curve"):
        return _curve_of_owner(value.curve)
    return Curve(cast("npt.ArrayLike", value))


def are_several(value: object) -> bool:
    """Tell a collection of closed curves from a single one.

    Examples
    --------
    >>> triangle = [(0, 0), (1, 0), (0, 1)]
    >>> are_several(triangle), are_several([triangle]), are_several([Curve(triangle), triangle])
    (False, True, True)
    """
    return isinstance(value, list | tuple | np.ndarray) and any(map(_is_curve, value))


def _is_curve(value: object) -> bool:
    if isinstance(value, list | tuple | np.ndarray):
        return len(value) > 0 and np.ndim(value[0]) == 1
    return isinstance(value, Curve) or any(hasattr(value, name) for name in ("geom_type", "curve", "partner"))


def as_curves(values: Sequence[object]) -> tuple[Curve, ...]:
    """Return each of several values as a :class:`Curve`; an error says which one is none.

    Examples
    --------
    >>> as_curves([[(0, 0), (1, 0), (0, 1)], 42])
    Traceback (most recent call last):
    plyfold.errors.CurveError: curve 1 of 2: points need the shape (n, 2), and these have ()
      hint: give one x and one y per point
    """
    curves = []
    for number, value in enumerate(values):
        try:
            curves.append(as_curve(value))
        except InputError as error:
            raise type(error)(f"curve {number} of {len(values)}: {error.message}", error.where, error.hint) from error
    return tuple(curves)


def _curve_of_owner(curve: object) -> Curve:
    if isinstance(curve, Curve):
        return curve
    raise CurveError("this arrangement has no coordinates", hint="make it from a curve instead of a Gauss code")


def _curve_of_geometry(geometry: BaseGeometry) -> Curve:
    if geometry.is_empty:
        raise CurveError(f"the {geometry.geom_type} is empty", hint="give a ring or line with points")
    match geometry.geom_type:
        case "Polygon":
            return _curve_of_polygon(geometry)
        case "LinearRing":
            return Curve(_planar(geometry), _left_out(geometry))
        case "LineString" | "MultiLineString":
            points, repairs = join_strokes(map(_planar, getattr(geometry, "geoms", [geometry])))
            return Curve(points, (*_left_out(geometry), *repairs))
    if len(parts := getattr(geometry, "geoms", [])) == 1:
        return as_curve(parts[0])
    hint = "give a LinearRing, a LineString or a Polygon without holes"
    raise CurveError(f"a {geometry.geom_type} is not one closed curve", hint=hint)


def _curve_of_polygon(polygon: BaseGeometry) -> Curve:
    if len(polygon.interiors):
        hole = _planar(polygon.interiors[0])
        raise CurveError("the polygon has a hole", where=hole[:1], hint="give its exterior alone")
    return Curve(_planar(polygon.exterior), _left_out(polygon))


def _planar(geometry: BaseGeometry) -> npt.NDArray[np.float64]:
    import shapely

    places: npt.NDArray[np.float64] = shapely.get_coordinates(geometry)
    return places


def _left_out(geometry: BaseGeometry) -> tuple[Repair, ...]:
    """Return the record of the altitudes and measures that a geometry has and a curve has not."""
    import shapely

    had = {"z": geometry.has_z, "m": shapely.geos_version >= (3, 12, 0) and geometry.has_m}
    return tuple(repair for name, has in had.items() if has for repair in left_out(name, _planar(geometry)))


def _without_closing_point(points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    closed = len(points) > 1 and np.array_equal(points[0], points[-1])
    return points[:-1] if closed else points


def _fresh_rows(points: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
    """Return the first row of each run of equal points; a run across the end belongs to the first point."""
    x, y = points.T
    if not ((x[1:] == x[:-1]) & (y[1:] == y[:-1])).any() and not np.array_equal(points[:1], points[-1:]):
        return np.arange(len(points))
    fresh = (points != np.roll(points, 1, axis=0)).any(axis=1)
    fresh[:1] = True
    last = np.flatnonzero(fresh)[-1:]
    fresh[last] = (last == 0) | (points[last] != points[:1]).any(axis=1)
    return np.flatnonzero(fresh)


def _dropped_points(points: npt.NDArray[np.float64], kept: npt.NDArray[np.int64]) -> list[Repair]:
    if len(kept) == len(points):
        return []
    places = dict.fromkeys((x, y) for x, y in np.delete(points, kept, axis=0).tolist())
    return [Repair("repeated point dropped", place, 0.0) for place in places]


def _refuse_degenerate(points: npt.NDArray[np.float64]) -> None:
    if _has_a_corner(points):
        return
    distinct = np.unique(points, axis=0)
    if len(distinct) < 3:
        count = "no points" if len(distinct) == 0 else f"only {len(distinct)} different point(s)"
        raise CurveError(f"the curve has {count}", where=distinct, hint="a closed curve needs at least three")
    # In lexicographic order the extreme points differ, and on a line they are its two ends.
    if not orient(distinct[0], distinct[-1], distinct).any():
        hint = "a curve that runs back and forth on one line bounds nothing"
        raise CurveError("all points lie on one line", where=[distinct[0], distinct[-1]], hint=hint)


def _has_a_corner(points: npt.NDArray[np.float64]) -> bool:
    """Tell whether one of the first points, or the one that seems farthest, is off the line through the first two."""
    if len(points) < 3:
        return False
    if orient(points[0], points[1], points[2:6]).any():
        return True
    x, y = (points - points[0]).T
    farthest = int(np.abs(x[1] * y - y[1] * x).argmax())
    return bool(orient(points[0], points[1], points[farthest]))
