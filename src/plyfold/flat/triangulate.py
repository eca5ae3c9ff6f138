"""Triangles on an outline's own points that make an immersed surface; for disks as Shor and Van Wyk's program does."""

from __future__ import annotations

from typing import Literal, NamedTuple, overload

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrangement.spikes import without_spikes
from plyfold.arrays import Floats, Ints
from plyfold.core.buffers import all_flat, flat
from plyfold.core.cloth import CLOCKWISE, cut_into_triangles
from plyfold.core.pauses import pause
from plyfold.core.vertices import without_closing_point
from plyfold.errors import InputError, NotImmersibleError, PrecisionError
from plyfold.flat.delaunay import delaunay_triangles, flip_edges
from plyfold.flat.settle import settled_triangles
from plyfold.halfedges import GluedTriangles, ends_of, split_in_three, split_in_two
from plyfold.immersion.immersion import Immersion, require_immersion
from plyfold.immersion.solve import find_immersion
from plyfold.immersion.verdict import plain_points
from plyfold.mesh.cells import refuse_max_area
from plyfold.mesh.refine import drawn_outline, given_outline
from plyfold.outline.curve import Outline
from plyfold.outline.given import OutlineLike, as_outline
from plyfold.predicates import orient

__all__ = ["chosen_immersion", "triangulate"]


@overload
def triangulate(
    curve: OutlineLike, immersion: Immersion | None = None, refine: None = None, *, twins: Literal[False] = False
) -> Ints: ...


@overload
def triangulate(
    curve: OutlineLike, immersion: Immersion | None = None, refine: None = None, *, twins: Literal[True]
) -> tuple[Ints, Ints]: ...


@overload
def triangulate(
    curve: OutlineLike, immersion: Immersion | None = None, *, refine: float, twins: Literal[False] = False
) -> tuple[Floats, Ints]: ...


def triangulate(
    curve: OutlineLike, immersion: Immersion | None = None, refine: float | None = None, *, twins: bool = False
) -> Ints | tuple[Ints, Ints] | tuple[Floats, Ints]:
    """Cut the disk that a curve bounds into n − 2 triangles on the curve's own n points, or the surface of any outline.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement; Outline, or a list of curves
        It may cross itself, have holes, and cusps, round which triangles wind as often as they say.
    immersion : Immersion, optional
        The surface to triangulate, if the outline bounds several; by default the first one.
    refine : float, optional
        Largest area of a triangle, in square units of the drawing. Points are then added inside the surface, none on
        its boundary. ``math.inf`` adds none for the sake of area, so that triangles are round and no more.
    twins : bool, optional
        Without ``refine``: tell also which sides are glued.

    Returns
    -------
    faces : (n − 2χ, 3) int
        Rows of three points of the outline, by their number in the arrays that were given, one after the other,
        counter-clockwise (exactly, and strictly, where the points were given); χ is the Euler characteristic, 1 for a
        disk. Glued along their common sides they are a surface, immersed in the plane, with the outline as its
        boundary. A curve that runs clockwise keeps its numbers; the triangles are counter-clockwise all the same.

        A surface that touches itself (``immersion.touches``) is cut there, and falls into pieces. Then n counts every
        corner of every piece, and χ is that of all pieces together. Where a point touches the inside of an edge, it is
        a corner on both sides: faces name points, and a point may be several corners of the surface.
    twins : (3 (n − 2χ),) int
        With ``twins``. The side beyond each side of each triangle, −1 on the boundary; side i of triangle t, from its
        corner i to the next one, is 3 t + i. Faces do not tell that where sides join the same points and are not the
        same edge: between cusps, round which the surface winds, and along cuts.
    points, faces : (m, 2) float and (m', 3) int
        With ``refine``: a mesh, of which faces tell how it is glued. The first points are the outline's, all of them;
        those that touch the inside of an edge where the surface is cut follow, once more for each corner there, so that
        pieces have no vertex in common. Where several edges of triangles join the same two cusps, all but one of them
        have a vertex in their middle.

    Raises
    ------
    NotImmersibleError
        If the outline bounds no immersed surface; ``error.obstruction`` says why.
    MemoryLimitError
        If the gluing of the sheets would not fit into memory.
    InputError
        If ``refine`` is no positive number or makes too many triangles, or is there together with ``twins``; or the
        immersion is one of another outline.
    PrecisionError
        If touching strands cannot be moved apart by as little as it takes to see how the surface lies; with ``refine``,
        if there is no double in the middle between two cusps.

    Notes
    -----
    The same input and output as programs after Shor and Van Wyk [SW92]_ have, which take O(n³). Here a line sweeps
    over the surface: what it meets of that is intervals between two edges, however the sheets lie over each other, and
    only at corners where an interval is split does it have to be found, by a walk through the sheets. All signs are
    exact. O((n + k) log n) and some steps for each strand that is walked over; 60,000 points with 18,000 crossings take
    a hundredth of a second. That such triangles exist is proved in [SW92]_
    and [WZ14]_. Many are long and thin; those that ``refine`` makes are as round as
    the points of the outline let them; :func:`~plyfold.map_disk` divides the outline too.

    Points that repeat the one before them are left out (see :class:`~plyfold.Curve`), and so are tips of spikes: they
    do not count, and no face has them. Where strands touch, the triangles are those of strands that are infinitely
    little apart, without the ones that have no area.

    References
    ----------
    .. [SW92] P. W. Shor, C. J. Van Wyk, "Detecting and decomposing self-overlapping curves", Computational
       Geometry 2, 1992.
    .. [WZ14] O. Weber, D. Zorin, "Locally injective parametrization with arbitrary fixed boundaries", ACM
       Transactions on Graphics 33, 2014.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> triangulate(ramp).shape
    (8, 3)
    >>> points, faces = triangulate([(0, 0), (6, 0), (0, 6)], refine=4.0)
    >>> len(points) > 3
    True

    Two triangles that meet in a point, and two that a neck joins, where the outline runs there and back:

    >>> triangulate([(0, 0), (1, 1), (2, 0), (2, 2), (1, 1), (0, 2)]).tolist()
    [[0, 4, 5], [1, 2, 3]]
    >>> triangulate([(0, 0), (1, 1), (2, 1), (3, 0), (3, 2), (2, 1), (1, 1), (0, 2)]).tolist()
    [[0, 6, 7], [2, 3, 4]]
    """
    if immersion is None and refine is None and not twins and (found := _without_values(curve)) is not None:
        return found
    # Codes and arrangements have partners; from all else an outline is made, once.
    outline = curve if hasattr(curve, "partner") else as_outline(curve)
    chosen = chosen_immersion(outline, immersion)
    came_in = _points_that_came_in(outline, chosen.arrangement)
    if refine is not None:
        if twins:
            raise InputError("with refine, faces tell which sides are twins", hint="leave out twins")
        return _refined(chosen, came_in, refine)
    settled = settled_triangles(chosen)
    faces = came_in.number[settled.point[settled.faces]]
    if isinstance(outline, Outline) and not isinstance(curve, Outline):
        faces = outline.rows[faces]
    return (faces, settled.triangles.twin) if twins else faces


def _without_values(curve: OutlineLike) -> Ints | None:
    """Return triangles of points that plainly draw a disk, from loop to loop without a value between; None otherwise.

    Points, stages and triangles are those that there are with values, so it is the same triangles.
    """
    points = plain_points(curve)
    if points is None or len(points) < 3:
        return None
    faces, sides = np.empty((2, len(points) - 1, 3), dtype=np.int64)
    count = cut_into_triangles(flat(points), pause, *all_flat(faces, sides))
    if count != CLOCKWISE:
        return faces[:count] if count >= 0 else None
    n = without_closing_point(flat(points))
    turned_round = np.roll(points[n - 1 :: -1], 1, axis=0)
    count = cut_into_triangles(flat(turned_round), pause, *all_flat(faces, sides))
    return -faces[:count] % n if count >= 0 else None


class _CameIn(NamedTuple):
    """The points of an outline as it came in, and the number that each point of its arrangement has among them."""

    points: Floats
    number: Ints


def _points_that_came_in(curve: OutlineLike, drawn: Arrangement) -> _CameIn:
    """Return the points of an outline; those of an arrangement without the spikes that were taken out."""
    if not isinstance(curve, Arrangement):
        return _CameIn(as_outline(curve).points, drawn.numbers)
    order = np.argsort(drawn.numbers)
    number = np.empty_like(order)
    number[order] = np.arange(len(order))
    return _CameIn(given_outline(drawn).points[order], number)


def chosen_immersion(curve: OutlineLike, immersion: Immersion | None) -> Immersion:
    """Return the immersion asked for, or the outline's first; raise an error if there is none."""
    if immersion is None:
        drawing = arrange(curve)
        drawn_outline(drawing)
        found = find_immersion(drawing)
        if not isinstance(found, Immersion):
            raise NotImmersibleError(found)
        return found
    drawn = require_immersion(immersion).arrangement
    if not (_same(drawn, curve) if isinstance(curve, Arrangement) else _draws(drawn, as_outline(curve))):
        raise InputError("the immersion belongs to another curve", hint="make it from the same arrangement")
    return immersion


def _same(drawn: Arrangement, other: Arrangement) -> bool:
    """Tell whether two arrangements are of the same points."""
    if drawn.outline is None or other.outline is None:
        return drawn is other
    return drawn.reversed == other.reversed and _alike(drawn.outline, other.outline, np.arange(len(other.outline)))


def _draws(drawn: Arrangement, outline: Outline) -> bool:
    """Tell whether an arrangement is that of an outline."""
    if drawn.outline is None:
        return False
    left, kept = (outline, np.arange(len(outline))) if len(drawn.numbers) == len(outline) else without_spikes(outline)
    if not np.array_equal(np.sort(drawn.numbers), kept):
        return False
    return _alike(given_outline(drawn), left, np.searchsorted(kept, drawn.numbers))


def _alike(used: Outline, outline: Outline, number: Ints) -> bool:
    """Tell whether an outline has the loops and cusps of another one, where its points have some numbers."""
    return (
        np.array_equal(used.first_point, outline.first_point)
        and np.array_equal(used.points, outline.points[number])
        and np.array_equal(np.concatenate(used.cusps), np.concatenate(outline.cusps)[number])
    )


def _refined(immersion: Immersion, came_in: _CameIn, max_area: float) -> tuple[Floats, Ints]:
    """Triangulate with added points."""
    given = given_outline(immersion.arrangement).points
    if isinstance(max_area, bool) or not isinstance(max_area, int | float | np.number):
        raise InputError(f"the largest area of a triangle must be a number, not {max_area!r}")
    refuse_max_area(given, max_area)
    point, inside = (settled := settled_triangles(immersion)).point, settled.inside
    points = np.concatenate([came_in.points, given[point[inside]]])
    number = np.where(inside, len(came_in.points) - 1 + np.cumsum(inside), came_in.number[point])
    # Flips alone would take quadratic time where triangles are long.
    faces, twin = delaunay_triangles(given[point], settled.triangles)
    return _split_double(*_split_large(points, GluedTriangles(number[faces], twin), max_area))


def _split_large(points: Floats, triangles: GluedTriangles, max_area: float) -> tuple[Floats, GluedTriangles]:
    """Split triangles at their centres until none is larger than allowed, or none of those can be split exactly.

    Edges are flipped after each round, so that triangles stay as round as their points allow.
    """
    while True:
        triangles = flip_edges(points, triangles)
        a, b, c = points[triangles.faces].swapaxes(0, 1)
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        large = np.flatnonzero(ux * vy - uy * vx > 2 * max_area)
        centre = a[large] + ((b - a)[large] + (c - a)[large]) / 3
        inside = [orient(p[large], q[large], centre) > 0 for p, q in ((a, b), (b, c), (c, a))]
        large, centre = large[np.all(inside, axis=0)], centre[np.all(inside, axis=0)]
        if len(large) == 0:
            return points, triangles
        triangles = split_in_three(triangles, large, len(points) + np.arange(len(large)))
        points = np.concatenate([points, centre])


def _split_double(points: Floats, triangles: GluedTriangles) -> tuple[Floats, Ints]:
    """Put points in the middle of edges that join the same points as another one; then corners tell what is glued."""
    while doubles := triangles.doubles:
        side = int(doubles[0][-1])
        ends = [ends[side] for ends in ends_of(triangles.faces)]
        middle = len(points)
        points = np.concatenate([points, (points[ends] / 2).sum(axis=0, keepdims=True)])
        triangles = split_in_two(triangles, side, middle)
        beside = triangles.faces[(triangles.faces == middle).any(axis=1)]
        if (orient(*points[beside].swapaxes(0, 1)) <= 0).any():
            raise PrecisionError(
                "two edges of triangles join the same two cusps, and double precision has no point between these",
                where=points[ends],
                hint="put a vertex on an edge near one of them",
            )
    return points, triangles.faces
