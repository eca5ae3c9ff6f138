"""Few polygons that cover an immersed surface once: its triangles, put together as long as they do not overlap."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations, product
from typing import TYPE_CHECKING, Literal, overload

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrangement.arrangement import Arrangement
from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import InputError, PrecisionError
from plyfold.flat.delaunay import delaunay_triangles
from plyfold.flat.layers import signed_layers
from plyfold.flat.settle import settled_triangles
from plyfold.flat.triangulate import chosen_immersion
from plyfold.graphs import components, spanning_tree
from plyfold.halfedges import GluedTriangles, ends_of
from plyfold.immersion.immersion import Immersion
from plyfold.mesh.refine import given_outline
from plyfold.mesh.strips import as_numbers
from plyfold.outline.curve import Outline
from plyfold.outline.given import OutlineLike, as_outline
from plyfold.outline.points import refuse_tiny
from plyfold.predicates import orient

if TYPE_CHECKING:
    from shapely import Polygon

__all__ = ["decompose"]

# The triangles whose neighbourhoods are looked at together, so that no more memory is needed than for their pairs.
_AT_ONCE = 1000


@overload
def decompose(
    curve: OutlineLike, immersion: Immersion | None = None, *, signed: Literal[False] = False
) -> list[Polygon]: ...


@overload
def decompose(
    curve: OutlineLike, immersion: None = None, *, signed: Literal[True]
) -> tuple[list[Polygon], list[Polygon]]: ...


def decompose(
    curve: OutlineLike, immersion: Immersion | None = None, *, signed: bool = False
) -> list[Polygon] | tuple[list[Polygon], list[Polygon]]:
    """Cut the surface that an outline bounds, along straight chords, into few polygons that do not overlap themselves.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement; Outline, or a list of curves
        It may cross itself, and have holes and cusps.
    immersion : Immersion, optional
        The surface to cut, if the outline bounds several; by default the first one.
    signed : bool, optional
        Take any closed curves, whether they bound a surface or not, and however they touch, and return two lists. False
        by default.

    Returns
    -------
    list of shapely.Polygon, or a pair of such lists
        Polygons, counter-clockwise, whose corners are points of the outline as they were given; those of a disk are
        simple and have no holes. Together they cover each place as often as the outline winds round it. A curve without
        overlaps gives one polygon, and one that touches itself some that do not.

        If ``signed``, the polygons that count once, and those that count −1 times: they add up to the winding numbers
        of the points as given. They are the layers {w ≥ 1}, {w ≥ 2}, … and {w ≤ −1}, {w ≤ −2}, … without their holes,
        and have crossings, rounded, among their corners.

    Raises
    ------
    NotImmersibleError
        If the outline bounds no immersed surface; ``error.obstruction`` says why.
    PrecisionError
        If :func:`triangulate` cannot make its triangles, or the drawing is so small that areas have no double; it names
        the place.
    InputError
        If the immersion is one of another outline, or two sides of triangles join the same two cusps; or if ``signed``
        is asked of an immersion.

    Notes
    -----
    The triangles of :func:`triangulate` are a tree, and pairs of them that overlap must be separated. It is cut as near
    to the root as can be, from the leaves on: the least number of cuts where the tree is a path, and few where not.
    Pairs whose sides are edges of the curve that cross are known beforehand; others are looked for only in pieces that
    turn out to overlap all the same, and then it is cut again. Cost: O(n log n) for round triangles, expected, and the
    pairs looked at, few in most cases: a coil of 100,000 points takes half a second with numba, a spiral of 30,000 that
    winds round 17 times two seconds.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> len(decompose(ramp))
    2
    >>> eight = [(0, 0), (2, 2), (2, 0), (0, 2)]
    >>> positive, negative = decompose(eight, signed=True)
    >>> [part.area for part in positive], [part.area for part in negative]
    ([1.0], [1.0])
    """
    if signed:
        if immersion is not None:
            raise InputError("signed polygons are those of a curve, and of no immersion")
        return signed_layers(as_outline(curve))
    return _pieces_of_immersion(chosen_immersion(curve, immersion))


def _pieces_of_immersion(chosen: Immersion) -> list[Polygon]:
    """Return the polygons of an immersed surface."""
    drawn = chosen.arrangement
    refuse_tiny(given_outline(drawn).points, "polygons")
    settled = settled_triangles(chosen)
    points = given_outline(drawn).points[settled.point]
    # Round triangles overlap fewer others than long ones.
    triangles = delaunay_triangles(points, settled.triangles)
    if not chosen.is_disk or drawn.cusp_index.any():
        return _pieces_of_surface(points, triangles, _may_be_cusps(given_outline(drawn), points))
    faces = triangles.faces
    conflicts = _crossing_sides(drawn, faces) if len(settled.cuts) == 0 else [set() for _ in faces]
    tree = _forest(triangles)
    while True:
        piece = _pieces(conflicts, *tree)
        polygons = _outlined(points, faces, piece)
        overlapping = np.flatnonzero(~shapely.is_valid(polygons))
        if len(overlapping) == 0:
            return list(polygons)
        fresh = _overlaps(points, faces, _neighbourhoods(piece, overlapping, tree[1]))
        if not any(piece[one] == piece[other] for one, others in fresh.items() for other in others):
            where = points[faces[np.isin(piece, overlapping)]].reshape(-1, 2)
            raise PrecisionError("a polygon is as thin as rounding errors", where[:1])
        for triangle, others in fresh.items():
            conflicts[triangle] |= others


def _may_be_cusps(given: Outline, corners: Floats) -> Bools:
    """Tell which corners are where a cusp is: after a cut there, the turns may be those of another one in the place."""
    return np.isin(as_numbers(corners), as_numbers(given.points[np.concatenate(given.cusps) > 0]))


def _outlined(points: Floats, faces: Ints, piece: Ints) -> npt.NDArray[np.object_]:
    """Return the polygon of each piece: its corners follow each other in the order of the curve."""
    part, corner = np.divmod(np.unique(np.repeat(piece, 3) * len(points) + faces.ravel()), len(points))
    polygons: npt.NDArray[np.object_] = shapely.polygons(shapely.linearrings(points[corner], indices=part))
    return polygons


def _pieces_of_surface(points: Floats, triangles: GluedTriangles, is_cusp: Bools) -> list[Polygon]:
    """Return the pieces of a surface with holes or cusps: all triangles that overlap are found at once."""
    faces = triangles.faces
    conflicts: list[set[int]] = [set() for _ in faces]
    for triangle, others in _overlaps(points, faces, [np.arange(len(faces))], is_cusp).items():
        conflicts[triangle] |= others
    for one, other in _double_neighbours(triangles):
        conflicts[one].add(other)
    piece = _pieces(conflicts, *_forest(triangles))
    polygons = [shapely.coverage_union_all(shapely.polygons(points[faces[members]])) for members in _members(piece)]
    return [polygon for union in polygons for polygon in shapely.get_parts(shapely.orient_polygons(union)).tolist()]


def _double_neighbours(triangles: GluedTriangles) -> Iterator[tuple[int, int]]:
    """Yield pairs of triangles with sides between the same two cusps that are not the same edge, both ways round."""
    for edges in triangles.doubles:
        for one, other in permutations(edges.tolist(), 2):
            beside = [[side // 3 for side in (edge, triangles.twin[edge]) if side >= 0] for edge in (one, other)]
            yield from product(*beside)


def _forest(triangles: GluedTriangles) -> tuple[list[int], list[int]]:
    """Return the triangles in an order, and for each the one before it that it hangs on; −1 for one in each part."""
    faces = triangles.faces
    first, second = triangles.pairs.T // 3
    roots = np.unique(components(len(faces), first, second), return_index=True)[1]
    # Node 0, on which these hang, stands for no triangle.
    start, end = np.append(np.zeros_like(roots), first + 1), np.append(roots, second) + 1
    above, _, order = spanning_tree(len(faces) + 1, start, end)
    return (order[1:] - 1).tolist(), (above[1:] - 1).tolist()


def _crossing_sides(drawn: Arrangement, faces: Ints) -> list[set[int]]:
    """Return for each triangle those that overlap it because edges of the curve cross that are sides of the two."""
    n = len(faces) + 2
    start, end = ends_of(faces)
    on_curve = np.flatnonzero(end == (start + 1) % n)
    triangle = np.empty(n, dtype=np.int64)
    triangle[start[on_curve]] = on_curve // 3
    conflicts: list[set[int]] = [set() for _ in faces]
    at = triangle[drawn.visit_edge]
    for one, other in zip(at.tolist(), at[drawn.partner].tolist(), strict=True):
        conflicts[one].add(other)
    return conflicts


def _overlaps(points: Floats, faces: Ints, groups: list[Ints], is_cusp: Bools | None = None) -> dict[int, set[int]]:
    """Return for each triangle of some groups those of its group that overlap or touch it.

    Triangles with a common corner do neither: they are parts of its fan, which is less than a full turn. Only at a cusp
    the fan is more than that.
    """
    overlaps: dict[int, set[int]] = {}
    for members in groups:
        for first, second in _overlapping_boxes(points[faces[members]]):
            i, j = members[first], members[second]
            common = faces[i].T[:, None] == faces[j].T
            strange = np.flatnonzero(~common.any(axis=(0, 1)))
            meet = strange[~_apart(points[faces[i[strange]]], points[faces[j[strange]]])]
            if is_cusp is not None:
                at_cusp = (common.sum(axis=(0, 1)) == 1) & (common & is_cusp[faces[i].T][:, None]).any(axis=(0, 1))
                around = np.flatnonzero(at_cusp)
                meet = np.append(meet, around[_meet_at_corner(points, faces[i[around]], faces[j[around]])])
            for one, other in zip(i[meet].tolist(), j[meet].tolist(), strict=True):
                overlaps.setdefault(one, set()).add(other)
                overlaps.setdefault(other, set()).add(one)
    return overlaps


def _meet_at_corner(points: Floats, one: Ints, other: Ints) -> Bools:
    """Tell which pairs of triangles that have one corner in common have a direction from there in common."""
    row, corner, beyond = np.nonzero(one[:, :, None] == other[:, None, :])
    centre = points[one[row, corner]]
    a, b, c, d = (
        points[triangle[row, (at + step) % 3]] for triangle, at in ((one, corner), (other, beyond)) for step in (1, 2)
    )
    meet = np.zeros(len(one), dtype=bool)
    for ray, first, last in ((a, c, d), (b, c, d), (c, a, b), (d, a, b)):
        meet |= (orient(centre, first, ray) >= 0) & (orient(centre, ray, last) >= 0)
    return meet


def _neighbourhoods(piece: Ints, wanted: Ints, parent: list[int]) -> list[Ints]:
    """Return the triangles of each of the wanted pieces, and of the piece that it hangs on.

    That one gets larger if the wanted piece is cut.
    """
    hangs_on = np.arange(piece.max() + 1)
    above = piece[np.maximum(parent, 0)]
    top = np.flatnonzero((above != piece) & (np.array(parent) >= 0))
    hangs_on[piece[top]] = above[top]
    members = _members(piece)
    return [np.concatenate([members[p] for p in {one, hangs_on[one]}]) for one in wanted]


def _members(piece: Ints) -> list[Ints]:
    """Return the triangles of each piece."""
    by_piece = np.argsort(piece, kind="stable")
    return np.split(by_piece, np.flatnonzero(np.diff(piece[by_piece])) + 1)


def _overlapping_boxes(triangles: Floats) -> Iterator[tuple[Ints, Ints]]:
    """Yield pairs of triangles whose bounding boxes meet, some at a time, each pair once."""
    (left, low), (right, high) = triangles.min(axis=1).T, triangles.max(axis=1).T
    boxes = shapely.box(left, low, right, high)
    tree = shapely.STRtree(boxes)
    for begin in range(0, len(boxes), _AT_ONCE):
        first, second = tree.query(boxes[begin : begin + _AT_ONCE])
        once = begin + first < second
        yield begin + first[once], second[once]


def _apart(one: Floats, other: Floats) -> Bools:
    """Tell which pairs of triangles a line along a side of one of them separates; of those that are apart, one does."""
    apart = np.zeros(len(one), dtype=bool)
    for triangle, beyond in ((one, other), (other, one)):
        for side in range(3):
            rest = np.flatnonzero(~apart)
            start, end = triangle[rest, side], triangle[rest, (side + 1) % 3]
            apart[rest] = (orient(start, end, beyond[rest].swapaxes(0, 1)) < 0).all(axis=0)
    return apart


def _pieces(conflicts: list[set[int]], order: list[int], parent: list[int]) -> Ints:
    """Return the piece of each triangle; a piece joins that of the triangle it hangs on unless they conflict."""
    piece = list(range(len(order)))
    members = [[triangle] for triangle in piece]
    for triangle in reversed(order):
        if parent[triangle] < 0:
            continue
        small, large = sorted((piece[triangle], piece[parent[triangle]]), key=lambda p: len(members[p]))
        if all(piece[other] != large for member in members[small] for other in conflicts[member]):
            for member in members[small]:
                piece[member] = large
            members[large] += members[small]
    return np.unique(piece, return_inverse=True)[1]
