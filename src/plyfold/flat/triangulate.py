"""Triangles on the curve's own points that make an immersed disk, as Shor and Van Wyk's program finds them."""

from __future__ import annotations

from typing import overload

import numpy as np

from plyfold.arrangement.arrangement import Arrangement, arrange
from plyfold.arrays import Floats, Ints
from plyfold.errors import GeneralPositionError, InputError, NotImmersibleError, PlyfoldError
from plyfold.flat.delaunay import delaunay_triangles, flip_edges
from plyfold.flat.sweep import sweep_triangles
from plyfold.immersion.immersion import Immersion, require_disk, require_immersion
from plyfold.immersion.solve import find_immersion
from plyfold.mesh.cells import refuse_max_area
from plyfold.outline.curve import Curve
from plyfold.outline.given import CurveLike, as_curve
from plyfold.predicates import orient

__all__ = ["chosen_immersion", "triangulate"]


@overload
def triangulate(curve: CurveLike, immersion: Immersion | None = None, refine: None = None) -> Ints: ...


@overload
def triangulate(curve: CurveLike, immersion: Immersion | None = None, *, refine: float) -> tuple[Floats, Ints]: ...


def triangulate(
    curve: CurveLike, immersion: Immersion | None = None, refine: float | None = None
) -> Ints | tuple[Floats, Ints]:
    """Cut the disk that a curve bounds into n − 2 triangles on the curve's own n points.

    Parameters
    ----------
    curve : Curve, array_like of shape (n, 2), shapely geometry or Arrangement
        It may cross itself.
    immersion : Immersion, optional
        The disk to triangulate, if the curve bounds several; by default the first one.
    refine : float, optional
        Largest area of a triangle, in square units of the drawing. Points are then added inside the disk, none on its
        boundary.

    Returns
    -------
    faces : (n − 2, 3) int
        Rows of three points of the curve, by their number in the array that was given, counter-clockwise (exactly, and
        strictly). Glued along their common sides they are a disk, immersed in the plane, with the curve as its
        boundary. A curve that runs clockwise keeps its numbers; the triangles are counter-clockwise all the same.
    points, faces : (m, 2) float and (m' , 3) int
        With ``refine``; the first n points are the curve's.

    Raises
    ------
    NotImmersibleError
        If the curve bounds no immersed disk; ``error.obstruction`` says why.
    MemoryLimitError
        If the gluing of the sheets would not fit into memory.
    InputError
        If ``refine`` is no positive number or makes too many triangles, or the immersion is one of another curve.
    GeneralPositionError
        If strands touch, and a triangle of the separated strands has no area on the points as they were given.

    Notes
    -----
    The same input and output as programs after Shor and Van Wyk [SW92]_ have, which take O(n³). Here a line sweeps
    over the disk: what it meets of the disk is intervals between two edges, however the sheets lie over each other, and
    only at corners where an interval is split does it have to be found, by a walk through the sheets. All signs are
    exact. O((n + k) log n) and some steps for each strand that is walked over; 60,000 points with 18,000 crossings take
    a hundredth of a second with numba, a quarter of a second without. That such triangles exist is proved in [SW92]_
    and [WZ14]_. Many are long and thin; those that ``refine`` makes are as round as
    the points of the outline let them; :func:`~plyfold.map_disk` divides the outline too.

    Points that repeat the one before them are left out (see :class:`~plyfold.Curve`): they do not count, and no face
    has them. If vertices had to be moved into general position, the triangles are those of the moved curve. They are
    returned if they are triangles of the points as given, too; given an arrangement, they are always those of
    ``arrangement.curve``, the moved points.

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
    """
    chosen = chosen_immersion(curve, immersion)
    if refine is not None:
        return _refined(chosen, refine)
    faces = _input_order(chosen.arrangement)[sweep_triangles(chosen)]
    return faces if isinstance(curve, Arrangement) else _faces_as_given(curve, faces, chosen.arrangement)


def chosen_immersion(curve: CurveLike, immersion: Immersion | None) -> Immersion:
    """Return the immersion asked for, or the curve's first; raise an error if there is none."""
    if immersion is None:
        drawing = arrange(curve)
        if drawing.curve is None:
            raise PlyfoldError("triangles need a drawing, and this arrangement is a Gauss code alone")
        found = find_immersion(drawing)
        if not isinstance(found, Immersion):
            raise NotImmersibleError(found)
        return found
    drawn = require_immersion(immersion).arrangement
    if not (_same(drawn, curve) if isinstance(curve, Arrangement) else _draws(drawn, as_curve(curve).points)):
        raise InputError("the immersion belongs to another curve", hint="make it from the same arrangement")
    return require_disk(immersion)


def _faces_as_given(curve: CurveLike, faces: Ints, drawn: Arrangement) -> Ints:
    """Give the points the numbers that the caller knows, and refuse triangles without area on his points."""
    assert drawn.curve is not None
    given = as_curve(curve)
    if not np.array_equal(drawn.curve.points[_input_order(drawn)], given.points):
        flat = faces[orient(*given.points[faces].swapaxes(0, 1)) <= 0]
        if len(flat):
            raise GeneralPositionError(
                "strands touch, and where they were separated a triangle has no area on the points as given",
                where=given.points[flat[0]],
                hint="take the moved points: a = arrange(curve), then triangulate(a) and a.curve.points",
            )
    return faces if isinstance(curve, Curve) else given.rows[faces]


def _same(drawn: Arrangement, other: Arrangement) -> bool:
    """Tell whether two arrangements are of the same points."""
    if drawn.curve is None or other.curve is None:
        return drawn is other
    return drawn.reversed == other.reversed and np.array_equal(drawn.curve.points, other.curve.points)


def _draws(drawn: Arrangement, points: Floats) -> bool:
    """Tell whether an arrangement is that of the given points, but for those moved into general position."""
    if drawn.curve is None or len(drawn.curve) != len(points):
        return False
    moved = {repair.where for repair in drawn.curve.repairs}
    differing = (drawn.curve.points[_input_order(drawn)] != points).any(axis=1)
    return all((x, y) in moved for x, y in points[differing].tolist())


def _input_order(drawn: Arrangement) -> Ints:
    """Return the number that each point of the arrangement's curve has in the input."""
    assert drawn.curve is not None
    n = len(drawn.curve.points)
    return -np.arange(n) % n if drawn.reversed else np.arange(n)


def _refined(immersion: Immersion, max_area: float) -> tuple[Floats, Ints]:
    """Triangulate with added points."""
    drawn = immersion.arrangement
    assert drawn.curve is not None
    if isinstance(max_area, bool) or not isinstance(max_area, int | float | np.number):
        raise InputError(f"the largest area of a triangle must be a number, not {max_area!r}")
    refuse_max_area(drawn.curve.points, max_area)
    number, points = _input_order(drawn), drawn.curve.points
    # Flips alone would take quadratic time where triangles are long.
    round_triangles = delaunay_triangles(points, sweep_triangles(immersion))
    return _split_large(points[number], number[round_triangles], max_area)


def _split_large(points: Floats, faces: Ints, max_area: float) -> tuple[Floats, Ints]:
    """Split triangles at their centres until none is larger than allowed, or none of those can be split exactly.

    Edges are flipped after each round, so that triangles stay as round as their points allow.
    """
    while True:
        faces = flip_edges(points, faces)
        a, b, c = points[faces].swapaxes(0, 1)
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        large = np.flatnonzero(ux * vy - uy * vx > 2 * max_area)
        centre = a[large] + ((b - a)[large] + (c - a)[large]) / 3
        inside = [orient(p[large], q[large], centre) > 0 for p, q in ((a, b), (b, c), (c, a))]
        large, centre = large[np.all(inside, axis=0)], centre[np.all(inside, axis=0)]
        if len(large) == 0:
            return points, faces
        new = len(points) + np.arange(len(large))
        first, second, third = faces[large].T
        parts = [(first, second, new), (second, third, new), (third, first, new)]
        faces = np.concatenate([np.delete(faces, large, axis=0), *(np.stack(part, axis=1) for part in parts)])
        points = np.concatenate([points, centre])
