"""Whatever stands for a closed curve or an outline, as the value that everything else takes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, cast

import numpy as np
import numpy.typing as npt

from plyfold.errors import CurveError
from plyfold.outline.curve import Curve, Cusps, Outline, outline_of_points
from plyfold.outline.direction import sense
from plyfold.outline.foreign import loops_of_path
from plyfold.outline.points import Repair, left_out
from plyfold.outline.strokes import join_strokes
from plyfold.outline.vertices import naming_the_curve

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


__all__ = [
    "Coded",
    "CurveLike",
    "Drawn",
    "Geometry",
    "OutlineLike",
    "are_several",
    "as_curve",
    "as_curves",
    "as_outline",
    "left_out_coordinates",
    "outline_of_curves",
    "outline_with",
]


class Drawn(Protocol):
    """A value that was made from an outline, such as an arrangement."""

    @property
    def outline(self) -> Outline | None:
        """The outline, if it has coordinates."""


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

OutlineLike: TypeAlias = "CurveLike | Outline | Sequence[CurveLike]"
"""Whatever stands for closed curves that bound a surface together: an outline, one curve, or a list of them."""


def as_curve(value: object) -> Curve:
    """Return whatever stands for a closed curve as a `Curve`.

    Parameters
    ----------
    value : Curve, array-like of shape (n, 2), shapely geometry, or a value with an ``outline``
        A third coordinate, of an array or a geometry, is left out, and ``repairs`` says so.
        Of the geometries: a ``LinearRing`` or a ``Polygon`` without holes; a ``LineString`` or ``MultiLineString``
        is taken as strokes, so its ends must nearly meet; a collection of one counts as that one.

    Returns
    -------
    Curve

    Raises
    ------
    CurveError
        If the value is not a usable curve, or an outline of several loops.
    StrokeError
        As from :func:`as_outline`.

    Examples
    --------
    >>> import shapely
    >>> len(as_curve(shapely.box(0, 0, 1, 1)))
    4
    >>> as_curve(Outline([[(0, 0), (1, 0), (0, 1)]]))
    <Curve of 3 points>
    """
    outline = as_outline(value)
    if isinstance(outline, Curve):
        return outline
    raise CurveError(
        f"this takes one closed curve, and the outline has {outline.n_loops} loops",
        where=[loop[0] for loop in outline.loops[1:2]],
        hint="give one of them alone",
    )


def as_outline(value: object) -> Outline:
    """Return whatever stands for an outline as an :class:`Outline`; where it has one loop, as a :class:`Curve`.

    Parameters
    ----------
    value : Outline, array-like of shape (n, 2), shapely geometry, a value with an ``outline``, or a list of curves
        Of the geometries besides those that :func:`as_curve` takes: a ``Polygon`` with holes, or a ``MultiPolygon``.
        Shells run counter-clockwise and holes clockwise, whatever their own order of points is.

    Returns
    -------
    Outline

    Raises
    ------
    CurveError
        If a part of it is no usable curve.
    StrokeError
        If the ends of an open geometry are too far apart.

    Notes
    -----
    O(n log n).

    Examples
    --------
    >>> import shapely
    >>> as_outline(shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2))
    <Outline of 2 loops, 8 points>
    """
    if isinstance(value, Outline):
        return value if isinstance(value, Curve) or value.n_loops > 1 else outline_with(value)
    if isinstance(getattr(value, "geom_type", None), str):  # a GeoSeries has an array of them
        return _outline_of_geometry(cast("BaseGeometry", value))
    if hasattr(value, "outline"):
        return as_outline(_outline_of_owner(value.outline))
    loops = loops_of_path(value)
    if loops is not None:
        return _outline_of_several(loops)
    if are_several(value):
        return _outline_of_several(cast("Sequence[object]", value))
    return Curve(cast("npt.ArrayLike", value))


def _outline_of_several(values: Sequence[object]) -> Outline:
    """Return curves as one outline; arrays go in as they are, for it knows their rows."""
    if len(values) == 1:
        return as_curves(values)[0]
    loops = []
    for number, value in enumerate(values):
        is_array = isinstance(value, list | tuple | np.ndarray) and not are_several(value)
        with naming_the_curve(number, len(values)):
            loops.append(cast("npt.ArrayLike", value) if is_array else as_curve(value))
    return _one_loop_as_curve(Outline(loops))


def _one_loop_as_curve(outline: Outline) -> Outline:
    """Return an outline as it is, but one whose other loops were left out as a curve."""
    if outline.n_loops > 1:
        return outline
    return outline_of_points(outline.points, outline.loop_of_point, outline.cusps[0], outline.rows, outline.repairs)


def outline_of_curves(curves: Sequence[Curve]) -> Outline:
    """Return several curves as one outline, and one as it is."""
    return curves[0] if len(curves) == 1 else Outline(curves)


def outline_with(outline: Outline, cusps: Cusps | None = None, repairs: Iterable[Repair] | None = None) -> Outline:
    """Return the same loops with other cusps or with another record of what was changed; one loop stays a curve.

    Examples
    --------
    >>> outline_with(Curve([(0, 0), (1, 0), (0, 1)]), [[0, 2, 0]])
    <Curve of 3 points, 1 cusp>
    """
    changed = Outline(
        outline.loops,
        outline.cusps if cusps is None else cusps,
        outline.repairs if repairs is None else repairs,
    )
    return Curve(changed.points, changed.repairs, changed.cusps[0]) if changed.n_loops == 1 else changed


def are_several(value: object) -> bool:
    """Tell a collection of closed curves from a single one.

    Examples
    --------
    >>> triangle = [(0, 0), (1, 0), (0, 1)]
    >>> are_several(triangle), are_several([triangle]), are_several([Curve(triangle), triangle])
    (False, True, True)
    """
    if isinstance(value, np.ndarray) and value.dtype != object:
        return value.ndim > 2 and len(value) > 0
    return isinstance(value, list | tuple | np.ndarray) and any(map(_is_curve, value))


def _is_curve(value: object) -> bool:
    if isinstance(value, np.ndarray) and value.dtype.kind == "c":
        return value.ndim == 1
    if isinstance(value, list | tuple | np.ndarray):
        return len(value) > 0 and np.ndim(value[0]) == 1
    return any(hasattr(value, name) for name in ("geom_type", "outline", "partner", "loops"))


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
        with naming_the_curve(number, len(values)):
            curves.append(as_curve(value))
    return tuple(curves)


def _outline_of_owner(outline: object) -> Outline:
    if isinstance(outline, Outline):
        return outline
    raise CurveError("this arrangement has no coordinates", hint="make it from a curve instead of a Gauss code")


def _outline_of_geometry(geometry: BaseGeometry) -> Outline:
    if geometry.is_empty:
        raise CurveError(f"the {geometry.geom_type} is empty", hint="give a ring or line with points")
    parts = getattr(geometry, "geoms", [])
    match geometry.geom_type:
        case "Polygon" if not len(geometry.interiors):
            return Curve(_planar(geometry.exterior), left_out_coordinates(geometry))
        case "Polygon" | "MultiPolygon" if len(parts) != 1:
            loops = [loop for polygon in parts or [geometry] for loop in _loops_of_polygon(polygon)]
            return _one_loop_as_curve(Outline(loops))
        case "LinearRing":
            return Curve(_planar(geometry), left_out_coordinates(geometry))
        case "LineString" | "MultiLineString":
            points, repairs = join_strokes(map(_planar, parts or [geometry]))
            return Curve(points, (*left_out_coordinates(geometry), *repairs))
    if len(parts) == 1:
        return as_outline(parts[0])
    hint = "give a LinearRing, a LineString, a Polygon or a MultiPolygon"
    raise CurveError(f"a {geometry.geom_type} is not one outline", hint=hint)


def _loops_of_polygon(polygon: BaseGeometry) -> list[Curve | npt.NDArray[np.float64]]:
    """Return shell and holes in the directions that leave the polygon on the left; as points what is no curve."""
    return [_loop_of_ring(polygon.exterior, 1), *(_loop_of_ring(ring, -1) for ring in polygon.interiors)]


def _loop_of_ring(ring: BaseGeometry, way: int) -> Curve | npt.NDArray[np.float64]:
    try:
        curve = Curve(_planar(ring), left_out_coordinates(ring))
    except CurveError:
        return _planar(ring)
    return curve.reversed() if sense(curve.points) == -way else curve


def _planar(geometry: BaseGeometry) -> npt.NDArray[np.float64]:
    import shapely

    places: npt.NDArray[np.float64] = shapely.get_coordinates(geometry)
    return places


def left_out_coordinates(geometry: BaseGeometry) -> tuple[Repair, ...]:
    """Return the record of the altitudes and measures that a geometry has and a curve has not."""
    import shapely

    had = {"z": geometry.has_z, "m": shapely.geos_version >= (3, 12, 0) and geometry.has_m}
    return tuple(repair for name, has in had.items() if has for repair in left_out(name, _planar(geometry)))
