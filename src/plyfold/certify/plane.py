"""What rounding can break in a mesh of the plane that contains the curve."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from plyfold.certify.exact import CertificateError, Ints, as_faces, finite
from plyfold.certify.immersed import common_places, require_along_curve, walk_along
from plyfold.certify.layered import require_no_overlap
from plyfold.certify.places import require_positive

__all__ = ["CertificateError", "check_rounded"]


def check_rounded(
    curve_points: npt.ArrayLike, points: npt.ArrayLike, triangles: npt.ArrayLike, chain: npt.ArrayLike
) -> None:
    """Check that rounding its points has left a mesh of the plane as it was.

    Parameters
    ----------
    curve_points : array_like, shape (n, 2)
    points : array_like, shape (p, 2)
    triangles : array_like of int, shape (t, 3)
        A mesh that without rounding is one of the plane, with the curve as edges.
    chain : array_like of int, shape (s,)
        The points of the mesh along the curve; crossings occur twice.

    Raises
    ------
    CertificateError
        If with the points as they are given, or with those on the curve at their exact places (see
        :func:`check_surface`), a triangle is not counter-clockwise, the chain does not advance along the curve, or
        triangles at the rim of the mesh overlap. It names the place.

    Notes
    -----
    As all triangles are counter-clockwise, they can overlap only where parts of the rim have got over one another.
    Cost: a small part of that of :func:`check_surface`, for it is done once for all sheets.

    Examples
    --------
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> check_rounded(square, square, [[0, 1, 2], [0, 2, 3]], [0, 1, 2, 3])
    """
    near = finite(points, 2)
    faces = as_faces(triangles, len(near))
    walk = walk_along(finite(curve_points, 2), near, np.asarray(chain))
    places = common_places(walk)
    require_along_curve(walk, places)
    require_positive(places, faces)
    require_no_overlap(faces[_at_rim(faces, len(near))], places)


def _at_rim(faces: Ints, count: int) -> Ints:
    """Return the triangles with a side that has nothing beyond."""
    start, end = faces, np.roll(faces, -1, axis=1)
    alone = ~np.isin(start * count + end, end * count + start)
    return np.flatnonzero(alone.any(axis=1))
