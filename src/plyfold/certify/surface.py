"""Check everything that a lifted surface is said to be."""

from __future__ import annotations

import numpy.typing as npt

from plyfold.certify.exact import finite
from plyfold.certify.immersed import common_places, require_immersed, walked
from plyfold.certify.layered import require_gap, require_layered

__all__ = ["check_surface"]


def check_surface(  # noqa: PLR0913 - the parts of a mesh, and two options
    curve_points: npt.ArrayLike,
    vertices: npt.ArrayLike,
    faces: npt.ArrayLike,
    boundary: npt.ArrayLike,
    gap: float = 0.0,
    *,
    passing: npt.ArrayLike = (),
) -> None:
    """Check that a mesh in space is an embedded disk that seen from above is immersed and bounded by the curve.

    Parameters
    ----------
    curve_points : array_like, shape (n, 2)
        The closed curve with the surface on its left.
    vertices : array_like, shape (v, 3)
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, counter-clockwise seen from above.
    boundary : array_like of int, shape (b,)
        Vertices along the curve, from the curve's first point.
    gap : float, optional
        Least vertical distance.
    passing : array_like of int, shape (e, 4), optional
        Edges along which sheets may pass through each other, see :func:`check_layered`.

    Raises
    ------
    CertificateError
        If :func:`check_immersed_disk` or :func:`check_layered` fails, the latter also where the vertices between points
        of the curve are at the exact points of their edges: over one another, at the crossing of their two edges.

    Examples
    --------
    >>> roof = [(0, 0, 0), (1, 0, 1), (1, 1, 0), (0, 1, 1)]
    >>> check_surface([(0, 0), (1, 0), (1, 1), (0, 1)], roof, [[0, 1, 2], [0, 2, 3]], [0, 1, 2, 3])
    """
    require_gap(gap)
    positions = finite(vertices, 3)
    sides, walk = walked(curve_points, positions[:, :2], faces, boundary)
    places = common_places(walk)
    require_immersed(sides, walk, places)
    require_layered(positions, sides.start.reshape(-1, 3), places, gap, passing)
