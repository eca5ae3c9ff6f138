"""Check that a triangle mesh bounds a solid of given vertical thickness that does not meet itself."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from plyfold.certify.disk import closed_sides, require_pieces
from plyfold.certify.exact import Bools, Floats, Ints, as_faces, as_vertices, different, finite, pair_keys
from plyfold.certify.layered import check_layered, from_lowest_corner
from plyfold.certify.places import doubles
from plyfold.errors import CertificateError

__all__ = ["check_solid"]

# Twice the distance from the thickness is found in floating point but for this share of it.
_ROUNDING = 1e-15


def check_solid(  # noqa: PLR0913 - a mesh, and what it shall be
    vertices: npt.ArrayLike,
    faces: npt.ArrayLike,
    thickness: npt.ArrayLike,
    *,
    pieces: Iterable[int] = (1,),
    tips: npt.ArrayLike = (),
    touching: bool = False,
) -> None:
    """Check that triangles bound a solid that is as thick everywhere as it should be, and does not meet itself.

    Parameters
    ----------
    vertices : array_like, shape (v, 3)
        Positions; vertices with exactly equal x and y lie over one another.
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, counter-clockwise seen from the outside.
    thickness : float, or array_like of shape (v,)
        The vertical thickness: the same everywhere, or as it is at each vertex of the top, straight between them. What
        it says of other vertices is not read.
    pieces : iterable of int, optional
        The Euler characteristics of the connected pieces: 1 of a ball, 0 of a ring, and 1 less for each handle. By
        default the solid is one ball.
    tips : array_like of int, optional
        Vertices at which top and bottom meet: single ones, or whole rims, which have no walls.
    touching : bool, optional
        Whether walls of the solid may touch, see :func:`check_layered`.

    Raises
    ------
    CertificateError
        If the mesh is not closed, or its pieces have not twice these Euler characteristics; if going up over any place
        does not lead by turns into the solid through a triangle that faces down and out through one that faces up,
        right above it; if a corner of those two are not the roundings of numbers that are exactly the thickness apart;
        if triangles or edges over one another change their order; or if other triangles are not vertical walls between
        the two. It names the place.

    Notes
    -----
    Why this proves it: over every place the vertices alternate, bottom and top, and each top triangle lies over the
    bottom triangle that has the vertices right below. By :func:`check_layered`, the strict order at the corners goes
    for the triangles and edges. So between a bottom triangle and its top there is nothing else, and the prisms between
    them meet in common walls only; the remaining triangles are parts of such walls. The volume follows: the area seen
    from above, times the thickness. At a tip the solid has no thickness, and grows to it in the triangles around. No
    triangle has tips at all of its corners, for then it would be its own top.

    With ``touching``, vertices alternate where triangles lie over one another, and walls of the solid may touch.

    Cost: that of :func:`check_layered`.

    Examples
    --------
    >>> top, bottom = [(0, 0, 1), (1, 0, 1), (0, 1, 1)], [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    >>> walls = [(3, 4, 1), (3, 1, 0), (4, 5, 2), (4, 2, 1), (5, 3, 0), (5, 0, 2)]
    >>> check_solid(top + bottom, [(0, 1, 2), (5, 4, 3), *walls], thickness=1.0)
    >>> check_solid(top + bottom, [(0, 1, 2), (5, 4, 3), *walls], thickness=0.5)
    Traceback (most recent call last):
    plyfold.errors.CertificateError: top and bottom are not 0.5 apart, at (0, 0)
    """
    positions = finite(vertices, 3)
    triangles = as_faces(faces, len(positions))
    require_pieces(closed_sides(triangles, len(positions)), len(positions), [(0, 2 * int(euler)) for euler in pieces])
    turn = doubles(positions[:, :2]).turn(triangles)
    upper, lower, walls = triangles[turn > 0], triangles[turn < 0], triangles[turn == 0]
    top = _tops(positions, upper, lower, np.unique(as_vertices(tips, len(positions), "the row of tips")), touching)
    _require_thickness(positions, top, thickness)
    _require_prisms(upper, top[lower])
    _require_walls(positions, walls, lower, top)
    check_layered(positions, np.concatenate([upper, lower[:, ::-1]]), touching=touching)


def _tops(positions: Floats, upper: Ints, lower: Ints, tips: Ints, touching: bool) -> Ints:
    """Return for each vertex on the bottom the one right above it, for each other one −1; they must alternate.

    A tip is above itself.
    """
    is_top, is_bottom = np.zeros((2, len(positions)), dtype=bool)
    is_top[upper.ravel()] = is_bottom[lower.ravel()] = True
    both = np.zeros(len(positions), dtype=bool)
    both[tips] = True
    if len(bad := np.flatnonzero((is_top == is_bottom) != (both & is_top))):
        raise CertificateError("a vertex is not either on the top or on the bottom", where=positions[bad[:1]])
    if touching:
        return _tops_in_triangles(positions, upper, lower)
    x, y, z = positions.T
    order = np.lexsort((z, y, x))
    order = np.repeat(order, 1 + both[order])
    first, second = order[0::2], order[1::2]
    bottom = first[: len(second)]
    fits = is_bottom[bottom] & is_top[second] & (positions[bottom, :2] == positions[second, :2]).all(axis=1)
    _require_alternation(positions, first, second, fits)
    top = np.full(len(positions), -1)
    top[first] = second
    return top


def _tops_in_triangles(positions: Floats, upper: Ints, lower: Ints) -> Ints:
    """Return the same where vertices over one another may be beside each other: here triangles alternate."""
    below = different(positions[:, :2])[2]
    triangles = from_lowest_corner(below, np.concatenate([upper, lower[:, ::-1]]))
    place = below[triangles]
    order = np.lexsort((*positions[triangles, 2].T[::-1], *place.T[::-1]))
    first, second = order[0::2], order[1::2]
    bottom = first[: len(second)]
    fits = (bottom >= len(upper)) & (second < len(upper)) & (place[bottom] == place[second]).all(axis=1)
    _require_alternation(positions, triangles[first, 0], second, fits)
    top = np.full(len(positions), -1)
    top[triangles[bottom]] = triangles[second]
    return top


def _require_alternation(positions: Floats, first: Ints, second: Ints, fits: Bools) -> None:
    if len(first) > len(second) or not fits.all():
        raise CertificateError(
            "going up, top and bottom do not alternate", where=positions[first[[np.argmin([*fits, False])]], :2]
        )


def _require_thickness(positions: Floats, top: Ints, thickness: npt.ArrayLike) -> None:
    """Check that each vertex and the one above it are the roundings of numbers that are exactly the thickness apart."""
    bottom = np.flatnonzero((top >= 0) & (top != np.arange(len(top))))
    wanted = _thickness_at(thickness, len(positions))[top[bottom]]
    low, high = positions[bottom, 2], positions[top[bottom], 2]
    with np.errstate(over="ignore", invalid="ignore"):
        excess = 2 * (high - low - wanted + _lost(high, low))
        allowed = np.where(excess > 0, _doubled_room(high, low), _doubled_room(low, high))
        wrong = np.abs(excess) > allowed
        sure = np.abs(np.abs(excess) - allowed) > _ROUNDING * allowed
    for i in np.flatnonzero(~sure).tolist():
        wrong[i] = _is_wrong(Fraction(high[i]) - Fraction(low[i]) - Fraction(wanted[i]), high[i], low[i])
    if wrong.any():
        worst = int(np.argmax(wrong))
        raise CertificateError(f"top and bottom are not {wanted[worst]:g} apart", where=positions[bottom[[worst]], :2])


def _thickness_at(thickness: npt.ArrayLike, count: int) -> Floats:
    """Return the thickness at each vertex."""
    if isinstance(thickness, bool) or np.asarray(thickness).dtype.kind not in "iuf":
        raise CertificateError(f"the thickness must be a number or one for each vertex, not {thickness!r}")
    given = np.asarray(thickness, dtype=np.float64)
    if given.shape not in ((), (count,)) or not np.isfinite(given).all():
        raise CertificateError(f"the thickness must be a finite number or {count} of them, not {thickness!r}")
    return np.broadcast_to(given, count)


def _is_wrong(excess: Fraction, high: float, low: float) -> bool:
    """Tell whether an excess of the thickness is more than rounding can make it."""
    nearer = (high, low) if excess > 0 else (low, high)
    room = Fraction(nearer[0]) - Fraction(np.nextafter(nearer[0], -np.inf))
    return 2 * abs(excess) > room + Fraction(np.nextafter(nearer[1], np.inf)) - Fraction(nearer[1])


def _lost(a: Floats, b: Floats) -> Floats:
    """Return what rounding takes from a − b (Knuth's two-sum)."""
    difference = a - b
    minus_b = difference - a
    return np.asarray((a - (difference - minus_b)) - (b + minus_b))


def _doubled_room(high: Floats, low: Floats) -> Floats:
    """Return twice by how much numbers that round to these can be nearer to each other; it is a sum of two doubles."""
    return np.asarray((high - np.nextafter(high, -np.inf)) + (np.nextafter(low, np.inf) - low))


def _require_prisms(upper: Ints, lifted: Ints) -> None:
    """Check that the triangles right above those of the bottom are those of the top, the other way round."""
    first, second = (_sorted_rows(triangles) for triangles in (upper, lifted[:, ::-1]))
    if not np.array_equal(first, second):
        raise CertificateError("the triangles of the top are not right above those of the bottom")


def _sorted_rows(triangles: Ints) -> Ints:
    """Return the triangles in order, each from its lowest vertex."""
    turned = np.take_along_axis(triangles, (np.argmin(triangles, axis=1)[:, None] + np.arange(3)) % 3, axis=1)
    return np.asarray(turned[np.lexsort(turned.T)])


def _require_walls(positions: Floats, walls: Ints, lower: Ints, top: Ints) -> None:
    """Check that there are two vertical triangles at each edge on the rim of the bottom, and no others.

    Their corners are at the ends of the edge and of the one above it. As the mesh is closed, they fill what is between.
    At a tip there is one triangle alone, and none between two tips.
    """
    below = np.arange(len(positions))
    below[top[top >= 0]] = np.flatnonzero(top >= 0)
    at = np.sort(below[walls], axis=1)
    at_two_places = (at[:, 0] == at[:, 1]) != (at[:, 1] == at[:, 2])
    if len(bad := np.flatnonzero(~at_two_places)):
        raise CertificateError("a wall is not between one top and its bottom", where=positions[walls[bad[0]], :2])
    side = pair_keys(np.stack([lower, np.roll(lower, -1, axis=1)], axis=2).reshape(-1, 2), len(positions))
    edges, used = np.unique(side, return_counts=True)
    rim = edges[used == 1]
    ends = np.divmod(rim, len(positions))
    needed = np.repeat(rim, 2 - (top[ends[0]] == ends[0]) - (top[ends[1]] == ends[1]))
    wrong = _not_in_both(needed, pair_keys(at[:, [0, 2]], len(positions)))
    if len(wrong):
        raise CertificateError(
            "the walls are not along the rim of the bottom, two triangles at each edge",
            where=positions[np.array(divmod(wrong[0], len(positions))), :2],
        )


def _not_in_both(first: Ints, second: Ints) -> Ints:
    """Return the numbers that are not as often among the first as among the second."""
    known, which = np.unique(np.concatenate([first, second]), return_inverse=True)
    times = np.bincount(which, np.repeat([1.0, -1.0], [len(first), len(second)]), minlength=len(known))
    return np.asarray(known[times != 0])
