"""Where points of the drawing lie on one sheet."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats
from plyfold.errors import InputError
from plyfold.predicates import orient
from plyfold.surface.locate import Places, weights

if TYPE_CHECKING:
    from plyfold.surface.unwrap import UnwoundDisk

__all__ = ["places_in_sheet"]


def places_in_sheet(unwound: UnwoundDisk, points: Floats, sheet: int) -> Places:
    """Find the triangles of one sheet that points of the drawing, shape (p, 2), lie in.

    Raises
    ------
    InputError
        If a point is not below the sheet, or there is no such sheet.
    """
    import shapely

    if not 0 <= sheet < unwound.immersion.n_sheets:
        raise InputError(f"there is no sheet {sheet!r}; they have the numbers 0 to {unwound.immersion.n_sheets - 1}")
    faces = np.flatnonzero(unwound.sheet == sheet)
    corners = unwound.plane[unwound.faces[faces]]
    boxes = shapely.STRtree(shapely.box(*corners.min(axis=1).T, *corners.max(axis=1).T))
    point, face = boxes.query(shapely.points(points))
    inside = np.all([orient(corners[face, i], corners[face, i - 2], points[point]) >= 0 for i in range(3)], axis=0)
    found = np.full(len(points), -1)
    found[point[inside]] = face[inside]
    if len(lost := np.flatnonzero(found < 0)):
        raise InputError(f"{len(lost)} of {len(points)} points are not below sheet {sheet}", where=points[lost])
    return Places(faces[found], weights(points, corners[found]))
