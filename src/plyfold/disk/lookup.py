"""Where points of the drawing lie on one sheet."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.disk.locate import Places, weights
from plyfold.errors import InputError
from plyfold.predicates import orient

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk

__all__ = ["Missing", "places_in_sheet"]

Missing: TypeAlias = Literal["error", "nan"]

# Points that were computed as means of three others may be beyond a side by this many units in the last place.
_ROUNDINGS = 4


def places_in_sheet(unwound: UnwoundDisk, points: Floats, sheet: int, missing: Missing) -> tuple[Places, Ints]:
    """Find the triangles of one sheet that points of the drawing, shape (p, 2), lie in.

    Points beyond the sheet's rim by rounding errors alone lie in the nearest triangle.

    Returns
    -------
    places : Places
        Of the points that are found.
    found : (q,) int
        Which points these are.

    Raises
    ------
    InputError
        If a point is not below the sheet, unless ``missing`` is ``"nan"``; or there is no such sheet.
    """
    import shapely

    if missing not in get_args(Missing):
        raise InputError(f"missing points cannot be answered by {missing!r}", hint='use "error" or "nan"')
    if not 0 <= sheet < unwound.immersion.n_sheets:
        raise InputError(f"there is no sheet {sheet!r}; they have the numbers 0 to {unwound.immersion.n_sheets - 1}")
    faces = np.flatnonzero(unwound.sheet == sheet)
    corners = unwound.plane[unwound.faces[faces]]
    boxes = shapely.STRtree(shapely.box(*corners.min(axis=1).T, *corners.max(axis=1).T))
    face = _inside(points, corners, boxes)
    outside = np.flatnonzero(face < 0)
    face[outside] = _beside(points[outside], corners, boxes)
    if missing == "error" and (face < 0).any():
        lost = points[face < 0]
        raise InputError(f"{len(lost)} of {len(points)} points are not below sheet {sheet}", where=lost)
    found = np.flatnonzero(face >= 0)
    return Places(faces[face[found]], weights(points[found], corners[face[found]])), found


def _inside(points: Floats, corners: Floats, boxes: Any) -> Ints:
    """Return a triangle that each point lies in, or −1; exact."""
    import shapely

    point, face = boxes.query(shapely.points(points))
    inside = np.all([orient(corners[face, i], corners[face, i - 2], points[point]) >= 0 for i in range(3)], axis=0)
    found = np.full(len(points), -1)
    found[point[inside]] = face[inside]
    return found


def _beside(points: Floats, corners: Floats, boxes: Any) -> Ints:
    """Return the nearest triangle to each point, or −1 if it is further than rounding errors."""
    import shapely

    found = np.full(len(points), -1)
    reach = _ROUNDINGS * np.spacing(np.abs(corners).max())
    at, face = boxes.query(shapely.points(points), predicate="dwithin", distance=reach)
    away = shapely.distance(shapely.points(points[at]), shapely.polygons(corners[face]))
    near = np.flatnonzero(away <= reach)
    nearest_last = near[np.argsort(-away[near], kind="stable")]
    found[at[nearest_last]] = face[nearest_last]
    return found
