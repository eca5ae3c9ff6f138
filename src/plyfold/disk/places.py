"""Which triangle of a convex triangulation a point lies in, for many points at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

import numpy as np

from plyfold.arrays import Floats, Ints, freeze
from plyfold.errors import InputError
from plyfold.halfedges import neighbours_of
from plyfold.predicates import orient

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk

__all__ = ["Missing", "Places", "locate", "places_in_sheet", "weights"]


@dataclass(frozen=True, eq=False)
class Places:
    """Points on a triangle mesh, without coordinates: weighted means of the corners of triangles.

    Parameters
    ----------
    face : (p,) int
    weights : (p, 3) float
        Of the triangle's corners, none negative, with sum 1.
    """

    face: Ints
    weights: Floats

    def __post_init__(self) -> None:
        freeze(self)

    def of(self, values: Floats, faces: Ints) -> Floats:
        """Return what vertices have, an array of shape (n, ...), at these places."""
        return np.asarray(np.einsum("pi,pi...->p...", self.weights, values[faces[self.face]]))


def locate(points: Floats, vertices: Floats, faces: Ints) -> Places:
    """Find the triangles that points lie in, by walks through the mesh.

    Parameters
    ----------
    points : (p, 2) float
    vertices : (n, 2) float
    faces : (m, 3) int
        Counter-clockwise triangles that cover a convex polygon once.

    Returns
    -------
    Places
        Triangles exact; a point outside the polygon is moved to the side where its walk leaves it. Cost: O(m log m),
        and a few steps for each point.

    Examples
    --------
    >>> square = np.array([(0.0, 0), (2, 0), (2, 2), (0, 2)])
    >>> places = locate(np.array([(1.5, 0.5)]), square, np.array([(0, 1, 2), (0, 2, 3)]))
    >>> places.face.tolist(), places.weights.tolist()
    ([0], [[0.25, 0.5, 0.25]])
    """
    from scipy.spatial import KDTree

    beyond = neighbours_of(faces)
    face = np.asarray(KDTree(vertices[faces].mean(axis=1)).query(points)[1], dtype=np.int64)
    walking = np.arange(len(points))
    # A walk that always takes the first way out may go in circles; one that takes any of them does not, for long.
    dice = np.random.default_rng(0)
    while len(walking):
        outside = _outside(points[walking], vertices[faces[face[walking]]])
        way = np.where(outside & (beyond[face[walking]] >= 0), dice.random(outside.shape), -1.0).argmax(axis=1)
        after = beyond[face[walking], way]
        going = outside[np.arange(len(way)), way] & (after >= 0)
        walking, after = walking[going], after[going]
        face[walking] = after
    return Places(face, weights(points, vertices[faces[face]]))


def _outside(points: Floats, corners: Floats) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    """Tell beyond which sides of its triangle each point lies; exact."""
    return np.stack([orient(corners[:, i], corners[:, (i + 1) % 3], points) < 0 for i in range(3)], axis=1)


def weights(points: Floats, corners: Floats) -> Floats:
    """Return the weights of the corners; at a corner exactly 1."""
    way = corners - points[:, None]
    opposite = [(way[:, i - 2, 0] * way[:, i - 1, 1] - way[:, i - 2, 1] * way[:, i - 1, 0]) for i in range(3)]
    areas = np.stack(opposite, axis=1).clip(0)
    flat = areas.sum(axis=1) == 0
    areas[flat] = _along_longest_side(points[flat], corners[flat])
    return np.asarray(areas / areas.sum(axis=1, keepdims=True))


def _along_longest_side(points: Floats, corners: Floats) -> Floats:
    """Return the weights of the corners of triangles without area in doubles: those of the longest side's ends."""
    side = np.roll(corners, -1, axis=1) - corners
    row, first = np.arange(len(points)), np.hypot(side[..., 0], side[..., 1]).argmax(axis=1)
    way, start = side[row, first], corners[row, first]
    share = (((points - start) * way).sum(axis=1) / (way * way).sum(axis=1)).clip(0, 1)
    found = np.zeros((len(points), 3))
    found[row, first], found[row, (first + 1) % 3] = 1 - share, share
    return found


# ---- where points of the drawing lie on one sheet --------------------------------------------------------------------

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
