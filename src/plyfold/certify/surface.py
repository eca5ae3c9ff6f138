"""Check everything that a lifted surface is said to be, or the plane mesh that its sheets are copies of."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

from plyfold.certify.disk import require_pieces, surface_sides
from plyfold.certify.exact import Ints, as_faces, as_loops, as_vertices, finite
from plyfold.certify.immersed import common_places, require_along_curve, require_immersed, walk_along, walked
from plyfold.certify.layered import require_gap, require_layered, require_no_overlap
from plyfold.certify.places import require_positive

__all__ = ["check_rounded", "check_surface"]


def check_surface(  # noqa: PLR0913 - the parts of a mesh, and what it shall be
    loops: npt.ArrayLike | Sequence[npt.ArrayLike],
    vertices: npt.ArrayLike,
    faces: npt.ArrayLike,
    boundary: npt.ArrayLike,
    gap: float = 0.0,
    *,
    passing: npt.ArrayLike = (),
    cusps: npt.ArrayLike | Sequence[npt.ArrayLike] | None = None,
    pieces: Iterable[tuple[int, int]] | None = None,
    touching: bool = False,
) -> None:
    """Check that a mesh in space is an embedded surface that seen from above is immersed and bounded by the outline.

    It is a disk if the outline is one curve that turns once, apart from its cusps.

    Parameters
    ----------
    loops : array_like, shape (n, 2), or a sequence of such
        The points of one closed curve or of several, with the surface on the left of each.
    vertices : array_like, shape (v, 3)
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, counter-clockwise seen from above.
    boundary : array_like of int, shape (b,)
        Vertices along the curve, from the curve's first point; one loop after the other.
    gap : float, optional
        Least vertical distance.
    passing : array_like of int, shape (e, 4), optional
        Edges along which sheets may pass through each other, see :func:`check_layered`.
    cusps : array_like of int, shape (n,), or a sequence of such, optional
        How many full turns the angle at each point of each loop has more than one sees; none by default.
    pieces : iterable of (int, int), optional
        What the connected pieces must be, see :func:`check_surface_mesh`.
    touching : bool, optional
        Whether the surface may touch itself where the outline does, see :func:`check_layered`.

    Raises
    ------
    CertificateError
        If :func:`check_immersed_surface`, :func:`check_surface_mesh` or :func:`check_layered` fails, the latter also
        where the vertices between points of the curve are at the exact points of their edges: over one another, at the
        crossing of their two edges.

    Examples
    --------
    >>> roof = [(0, 0, 0), (1, 0, 1), (1, 1, 0), (0, 1, 1)]
    >>> check_surface([(0, 0), (1, 0), (1, 1), (0, 1)], roof, [[0, 1, 2], [0, 2, 3]], [0, 1, 2, 3])
    """
    require_gap(gap)
    positions = finite(vertices, 3)
    sides = surface_sides(faces, len(positions))
    walk = walked(as_loops(loops, cusps), positions[:, :2], sides, boundary)
    if pieces is not None:
        require_pieces(sides, len(positions), pieces)
    places = common_places(walk)
    require_immersed(sides, walk, places)
    require_layered(positions, sides.start.reshape(-1, 3), places, gap, passing, touching=touching)


def check_rounded(
    loops: npt.ArrayLike | Sequence[npt.ArrayLike],
    points: npt.ArrayLike,
    triangles: npt.ArrayLike,
    chain: npt.ArrayLike,
    first: npt.ArrayLike | None = None,
) -> None:
    """Check that rounding its points has left a mesh of the plane as it was.

    Parameters
    ----------
    loops : array_like, shape (n, 2), or a sequence of such
    points : array_like, shape (p, 2)
    triangles : array_like of int, shape (t, 3)
        A mesh that without rounding is one of the plane, with the curve as edges.
    chain : array_like of int, shape (s,)
        The points of the mesh along the curve, one loop after the other; crossings occur twice.
    first : array_like of int, shape (loops + 1,), optional
        Where in the chain each loop begins, and last its length; 0 and that by default.

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
    row = as_vertices(chain, len(near), "the chain")
    walk = walk_along(as_loops(loops), near, row, np.asarray([0, len(row)] if first is None else first))
    places = common_places(walk)
    require_along_curve(walk, places)
    require_positive(places, faces)
    require_no_overlap(faces[_at_rim(faces, len(near))], places)


def _at_rim(faces: Ints, count: int) -> Ints:
    """Return the triangles with a side that has nothing beyond."""
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    there, back = np.sort(start * count + end), end * count + start
    # Sorted numbers are found in sorted ones several times as fast as others.
    order = np.argsort(back)
    at = np.searchsorted(there, back[order])
    alone = order[there[np.minimum(at, len(there) - 1)] != back[order]]
    return np.unique(alone // 3)
