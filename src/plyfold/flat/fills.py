"""What a drawing program would paint: fills by a rule, winding numbers at places, and masks of pixels."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt
import shapely

from plyfold.arrangement.noding import node_outline
from plyfold.arrays import Bools, Floats, Ints
from plyfold.errors import InputError
from plyfold.flat.rays import windings_round
from plyfold.flat.regions import regions
from plyfold.outline.curve import Outline
from plyfold.outline.given import OutlineLike, as_outline
from plyfold.outline.points import as_points, refuse_tiny
from plyfold.predicates import orient
from plyfold.ragged import count_each

if TYPE_CHECKING:
    from shapely import MultiPolygon

__all__ = ["FillRule", "coverage_mask", "fill", "winding_at"]

FillRule: TypeAlias = Literal["nonzero", "evenodd", "positive", "negative"]
OnOutline: TypeAlias = Literal["raise", "right"]

_RULES: dict[str, Callable[[Ints], Bools]] = {
    "nonzero": lambda winding: winding != 0,
    "evenodd": lambda winding: winding % 2 == 1,
    "positive": lambda winding: winding > 0,
    "negative": lambda winding: winding < 0,
}


def fill(outline: OutlineLike, rule: FillRule = "nonzero", *, at_least: int | None = None) -> MultiPolygon:
    """Return what closed curves paint by a fill rule.

    Parameters
    ----------
    outline : Outline, Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such curves
        Any closed curves, however they cross, touch, overlap or crowd.
    rule : {"nonzero", "evenodd", "positive", "negative"}
        Which winding numbers are painted. They are those of the points as given.
    at_least : int, optional
        Paint the places with this winding number or a larger one instead; at least 1.

    Returns
    -------
    shapely.MultiPolygon
        Valid; its corners are points of the curves and crossings, rounded to double precision. Nothing is moved, and
        nothing inside is cut.

    Raises
    ------
    InputError
        If there is no such rule, if ``at_least`` is no whole number from 1 on, or if both are given.
    PrecisionError
        If rounding its crossings makes the drawing cross itself ever more, or it is so small that areas have no double.

    Notes
    -----
    Exact up to the rounding of crossings. Layers add up: the areas of ``at_least`` 1, 2, … are together the area that
    is covered, each part as often as it is. O((n + k) log (n + k)) for n points and k crossings.

    Examples
    --------
    >>> pentagram = [(0, 3), (2, -3), (-3, 1), (3, 1), (-2, -3)]
    >>> fill(pentagram, "nonzero").area > fill(pentagram, "evenodd").area
    True
    >>> fill(pentagram, "negative").area == fill(pentagram[::-1], at_least=1).area
    True
    """
    outline, painted = as_outline(outline), _painted(rule, at_least)
    refuse_tiny(outline.points, "polygons")
    found = regions(node_outline(outline), lambda winding: painted(winding).astype(np.int64))
    return shapely.MultiPolygon([region.polygon for region in found])


def _painted(rule: str, at_least: int | None) -> Callable[[Ints], Bools]:
    """Return the function that tells which winding numbers are painted."""
    if at_least is None:
        if rule not in _RULES:
            raise InputError(f"there is no fill rule {rule!r}", hint="it is one of " + ", ".join(get_args(FillRule)))
        return _RULES[rule]
    if isinstance(at_least, bool) or not isinstance(at_least, int | np.integer) or at_least < 1:
        raise InputError(f"at_least is a whole number from 1 on, not {at_least!r}")
    if rule != "nonzero":
        raise InputError(f"at_least stands in the place of a rule, and the rule is {rule!r}", hint="give one of them")
    return lambda winding: winding >= at_least


# ---- winding numbers at places ---------------------------------------------------------------------------------------


def winding_at(outline: OutlineLike, points: npt.ArrayLike, *, on_outline: OnOutline = "raise") -> Ints:
    """Return how often closed curves wind round each of some places, counter-clockwise as they are given. Exact.

    Parameters
    ----------
    outline : Outline, Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such curves
    points : array_like, shape (m, 2) or (2,)
    on_outline : {"raise", "right"}
        What a place on the curves has: an error, or the winding number of the place infinitely little to its right
        and, if that is on them too, by far less above. That is the rule of :func:`coverage_mask`.

    Returns
    -------
    ndarray of int, shape (m,) or ()

    Raises
    ------
    InputError
        If a place lies on the curves; ``error.where`` has all of them.

    Notes
    -----
    O((n + m) log n) for n edges and m places, and the edges at the height of each place and right of it.

    Examples
    --------
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> winding_at(square + square, [(1, 1), (3, 1)]).tolist()
    [2, 0]
    >>> winding_at(square, [(0, 1), (2, 1), (1, 0), (1, 2)], on_outline="right").tolist()
    [1, 0, 1, 0]
    >>> winding_at(square, []).tolist()
    []
    """
    if on_outline not in get_args(OnOutline):
        raise InputError(f'on_outline must be "raise" or "right", not {on_outline!r}')
    drawn, given = as_outline(outline), np.asarray(points)
    places = as_points(given.reshape(-1, 2) if given.ndim == 1 else points)
    winding, touching = windings_round(places, drawn.points, drawn.points[drawn.next_point])
    if on_outline == "raise" and touching.any():
        raise InputError(
            "some of the places lie on the outline",
            where=places[touching],
            hint='on_outline="right" takes the winding number a little to the right',
        )
    return winding.reshape(given.shape[:-1] if given.size else len(winding))


# ---- masks -----------------------------------------------------------------------------------------------------------


def coverage_mask(
    outline: OutlineLike, shape: tuple[int, int], transform: Iterable[float] | None = None
) -> npt.NDArray[np.int32]:
    """Return how often closed curves wind round the centre of each pixel, counter-clockwise as they are given.

    Parameters
    ----------
    outline : Outline, Curve, array_like of shape (n, 2), shapely geometry or Arrangement; or a list of such curves
    shape : (rows, columns)
    transform : six numbers (a, b, c, d, e, f), optional
        A pixel's place in the drawing: x = a · column + b · row + c and y = d · column + e · row + f, where whole
        numbers are corners of pixels and their centres lie half a pixel further; an ``Affine`` of rasterio is one. By
        default (1, 0, 0, 0, 1, 0): row 0 lies between the heights 0 and 1. A picture whose row 0 is on top, over the
        same place, has (1, 0, 0, 0, −1, rows).

    Returns
    -------
    ndarray of int32, shape (rows, columns)
        Exact at the centres, whose coordinates are rounded to double precision. A centre on the curves counts as the
        place infinitely little to its right and, if that is on them too, by far less above: so of shapes that share
        sides no two have the same pixel, and none is left out.

    Raises
    ------
    InputError
        If the shape is none, or the transform has not six finite numbers or flattens the pixels.

    Notes
    -----
    O(rows · columns) and the pairs of an edge and a row that it passes; for rotated pixels as :func:`winding_at`.

    Examples
    --------
    >>> coverage_mask([(0, 0), (3, 0), (0, 3)], (3, 3), (1, 0, 0, 0, -1, 3))
    array([[0, 0, 0],
           [1, 0, 0],
           [1, 1, 0]], dtype=int32)
    """
    drawn = as_outline(outline)
    rows, columns = _checked_shape(shape)
    a, b, c, d, e, f = _checked_transform((1, 0, 0, 0, 1, 0) if transform is None else transform)
    column, row = np.arange(0.5, columns, dtype=np.float64), np.arange(0.5, rows, dtype=np.float64)
    if b == 0 and d == 0:
        return _scanned(drawn, a * column + c, e * row + f)
    x, y = a * column + (b * row + c)[:, None], d * column + (e * row + f)[:, None]
    return (
        winding_at(drawn, np.stack([x, y], axis=-1).reshape(-1, 2), on_outline="right")
        .reshape(x.shape)
        .astype(np.int32)
    )


def _checked_shape(shape: tuple[int, int]) -> tuple[int, int]:
    sizes = tuple(shape)
    if len(sizes) != 2 or not all(isinstance(size, int | np.integer) and size >= 0 for size in sizes):
        raise InputError(f"the shape of a mask is a number of rows and one of columns, not {shape!r}")
    return int(sizes[0]), int(sizes[1])


def _checked_transform(transform: Iterable[float]) -> list[float]:
    """Return the six numbers of a transform; an Affine has three more, 0, 0 and 1."""
    numbers = [float(number) for number in transform]
    if numbers[6:] == [0.0, 0.0, 1.0]:
        numbers = numbers[:6]
    if len(numbers) != 6 or not np.isfinite(numbers).all():
        raise InputError("a transform has six finite numbers", hint="(1, 0, 0, 0, 1, 0) leaves pixels as they are")
    a, b, _, d, e, _ = numbers
    if Fraction(a) * Fraction(e) == Fraction(b) * Fraction(d):
        raise InputError("the transform flattens the pixels: its determinant is 0")
    return numbers


def _scanned(drawn: Outline, x: Floats, y: Floats) -> npt.NDArray[np.int32]:
    """Return the winding number at each pair of a y and an x."""
    by_x, by_y = np.argsort(x, kind="stable"), np.argsort(y, kind="stable")
    row, passed, times = _passed_columns(drawn, x[by_x], y[by_y])
    steps = np.zeros((len(y), len(x) + 1), dtype=np.int32)
    np.add.at(steps, (row, passed), times.astype(np.int32))
    # An edge adds to all columns before the one that it passes.
    sums = np.cumsum(steps[:, ::-1], axis=1, dtype=np.int32)[:, ::-1][:, 1:]
    mask = np.empty((len(y), len(x)), dtype=np.int32)
    mask[np.ix_(by_y, by_x)] = sums
    return mask


def _passed_columns(drawn: Outline, x: Floats, y: Floats) -> tuple[Ints, Ints, Ints]:
    """Return row, number of columns to the left and direction wherever an edge passes a row; x and y ascend."""
    start, end = drawn.points, drawn.points[drawn.next_point]
    low, high = np.sort([start[:, 1], end[:, 1]], axis=0)
    first, last = np.searchsorted(y, low), np.searchsorted(y, high)
    count = last - first
    edge = np.repeat(np.arange(len(start)), count)
    row = np.repeat(first, count) + count_each(count)
    upward = start[edge, 1] < end[edge, 1]
    below, above = np.where(upward, edge, drawn.next_point[edge]), np.where(upward, drawn.next_point[edge], edge)
    passed = _columns_on_the_left(drawn.points[below], drawn.points[above], x, y[row])
    return row, passed, np.where(upward, 1, -1)


def _columns_on_the_left(low: Floats, high: Floats, x: Floats, height: Floats) -> Ints:
    """Return how many of some ascending x lie truly left of each upward edge at a height. Exact."""
    share = (height - low[:, 1]) / (high[:, 1] - low[:, 1])
    passed = np.searchsorted(x, low[:, 0] + share * (high[:, 0] - low[:, 0]))

    def is_left(column: Ints) -> Bools:
        return orient(low, high, np.stack([x[column], height], axis=1)) > 0

    while (too_many := (passed > 0) & ~is_left(np.maximum(passed - 1, 0))).any():
        passed = passed - too_many
    while (too_few := (passed < len(x)) & is_left(np.minimum(passed, len(x) - 1))).any():
        passed = passed + too_few
    return passed
