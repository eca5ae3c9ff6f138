"""Places of vertices in the plane, and exact signs: what all checks decide by.

A vertex between two points of the curve is a double, and few points of an edge are. It stands for the exact point of
its edge next to it, a pair of rational numbers. Signs are found in floating point, with a bound for what rounding and
the way to the exact point can do; where that does not decide, in rational numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import ClassVar, TypeAlias

import numpy as np
import numpy.typing as npt

from plyfold.certify.exact import Bools, Floats, Ints
from plyfold.errors import CertificateError

__all__ = ["ExactPlaces", "Point", "are_crossing", "doubles", "on_edges", "rationals", "require_positive"]

Point: TypeAlias = tuple[Fraction, Fraction]
Signs: TypeAlias = npt.NDArray[np.int8]

# The rounding error of a cross product of two differences is below 3.0000001 u (|left| + |right|), u = 2^-53.
_CROSS_ERROR = 6.7e-16
_UNDERFLOW = 1e-290
# Bounds are computed in a few roundings themselves.
_MORE = 1.000001


@dataclass(frozen=True, eq=False)
class ExactPlaces:
    """The places of vertices, named by their numbers.

    Parameters
    ----------
    near : (n, 2) float
        The vertices as doubles.
    edges : (n, 2) int
        Numbers of edges of the curve that each place is on, exactly; −1 for none.
    off : (n,) float
        No coordinate of the place differs more from the double; 0 if the double is the place. Otherwise the place is
        where its two edges cross, or the point of its only edge that is nearest to the double.
    curve : (m, 2, 2) float
        Both ends of each edge of the curve.
    """

    near: Floats
    edges: Ints
    off: Floats
    curve: Floats
    # Whether the doubles were given, and places are what they stand for.
    doubles_are_given: ClassVar[bool] = True

    def of(self, vertices: Ints) -> ExactPlaces:
        """Return the places of some vertices, numbered anew."""
        return ExactPlaces(self.near[vertices], self.edges[vertices], self.off[vertices], self.curve)

    def turn(self, triangles: Ints) -> Signs:
        """Return the signs of triangles, shape (m, 3): +1 if counter-clockwise, 0 if flat."""
        a, b, c = triangles.T
        return self.cross_sign(a, b, a, c)

    def cross_sign(self, a: Ints, b: Ints, c: Ints, d: Ints) -> Signs:
        """Return the signs of the cross products of a → b and c → d, all of shape (m,)."""
        return self.cross_sign_and_doubt(a, b, c, d)[0]

    def cross_sign_and_doubt(self, a: Ints, b: Ints, c: Ints, d: Ints) -> tuple[Signs, Bools]:
        """Return the signs of cross products, and where the points near by that are doubles may have another one."""
        off = self.off
        # To take rows is ten times as fast as to index them.
        p, q, r, s = (self.near.take(vertex, axis=0) for vertex in (a, b, c, d))
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            (ux, uy), (vx, vy) = (q - p).T, (s - r).T
            left, right = ux * vy, uy * vx
            cross = left - right
            bound = _CROSS_ERROR * (np.abs(left) + np.abs(right)) + _UNDERFLOW
            if off.any():
                first, second = off[a] + off[b], off[c] + off[d]
                reach = first * (np.abs(vx) + np.abs(vy)) + second * (np.abs(ux) + np.abs(uy)) + 2 * first * second
                bound += _MORE * reach
            sure = np.abs(cross) > bound
        sure &= np.isfinite(cross)
        signs = np.where(sure, np.sign(np.where(sure, cross, 0)), 0).astype(np.int8)
        unsure = np.flatnonzero(~sure)
        ends = np.stack([vertex[unsure] for vertex in (a, b, c, d)], axis=1)
        # The signs of what lies on one edge are 0 as they are.
        apart = ~self._on_one_edge(ends)
        signs[unsure[apart]] = self._exact_cross_signs(ends[apart])
        return signs, np.asarray(~sure)

    def step_sign(self, a: Ints, b: Ints, axis: Ints) -> Signs:
        """Return the signs of how much x (axis 0) or y (axis 1) grows from a to b."""
        start, end = self.near[a, axis], self.near[b, axis]
        with np.errstate(over="ignore", invalid="ignore"):
            sure = np.abs(end - start) > _MORE * (self.off[a] + self.off[b])
        sure |= (self.off[a] == 0) & (self.off[b] == 0)
        signs = (end > start).astype(np.int8) - (end < start)
        for i in np.flatnonzero(~sure).tolist():
            signs[i] = _sign(self.exact(int(b[i]))[axis[i]] - self.exact(int(a[i]))[axis[i]])
        return np.asarray(signs)

    def exact(self, vertex: int) -> Point:
        """Return a place in rational numbers."""
        double = _rational(self.near[vertex])
        if self.off[vertex] == 0:
            return double
        first, second = self.edges[vertex].tolist()
        if second >= 0 and (found := _crossing(*self._edge(first), *self._edge(second))):
            return found
        return _nearest(double, *self._edge(first))

    def is_on(self, vertex: int, edge: int) -> bool:
        """Tell whether a place is on the line through an edge."""
        start, end = self._edge(edge)
        return _cross(start, end, start, self.exact(vertex)) == 0

    def _edge(self, edge: int) -> tuple[Point, Point]:
        return _rational(self.curve[edge, 0]), _rational(self.curve[edge, 1])

    def _on_one_edge(self, vertices: Ints) -> Bools:
        """Tell which rows of vertices lie on one edge of the curve together."""
        edges = self.edges[vertices]
        shared = [(edges == edges[:, :1, which, None]).any(axis=2).all(axis=1) for which in range(2)]
        known = edges[:, 0] >= 0
        return np.asarray((shared[0] & known[:, 0]) | (shared[1] & known[:, 1]))

    def _exact_cross_signs(self, vertices: Ints) -> Signs:
        """Return the signs of cross products, shape (m, 4), in whole numbers: each place times its denominator."""
        places, number = np.unique(vertices, return_inverse=True)
        whole = np.array([self._whole(place) for place in places.tolist()], dtype=object).reshape(-1, 3)
        (ax, ay, a), (bx, by, b), (cx, cy, c), (dx, dy, d) = whole[number.reshape(-1, 4)].transpose(1, 2, 0)
        cross = (bx * a - ax * b) * (dy * c - cy * d) - (by * a - ay * b) * (dx * c - cx * d)
        return np.asarray((cross > 0).astype(np.int8) - (cross < 0))

    def _whole(self, vertex: int) -> tuple[int, int, int]:
        """Return a place as two whole numbers and what they are to be divided by; found once for each vertex."""
        if vertex not in self._known:
            x, y = self.near[vertex].tolist() if self.off[vertex] == 0 else self.exact(vertex)
            (across, of_x), (up, of_y) = x.as_integer_ratio(), y.as_integer_ratio()
            below = lcm(of_x, of_y)
            self._known[vertex] = across * (below // of_x), up * (below // of_y), below
        return self._known[vertex]

    @cached_property
    def _known(self) -> dict[int, tuple[int, int, int]]:
        return {}


def doubles(points: Floats) -> ExactPlaces:
    """Return places that are doubles."""
    nothing = np.full((len(points), 2), -1)
    return ExactPlaces(points, nothing, np.zeros(len(points)), np.empty((0, 2, 2)))


@dataclass(frozen=True, eq=False)
class _RationalPlaces(ExactPlaces):
    """Places that are given in rational numbers."""

    points: Sequence[Point]
    doubles_are_given: ClassVar[bool] = False

    def of(self, vertices: Ints) -> ExactPlaces:
        """Return the places of some vertices, numbered anew."""
        return rationals([self.points[vertex] for vertex in vertices.tolist()])

    def exact(self, vertex: int) -> Point:
        """Return a place in rational numbers."""
        return self.points[vertex]


def rationals(points: Sequence[Point]) -> ExactPlaces:
    """Return places that are given in rational numbers, as near to doubles as may be."""
    near = np.array(points, dtype=np.float64).reshape(-1, 2)
    is_double = [x == a and y == b for (x, y), (a, b) in zip(points, near.tolist(), strict=True)]
    off = np.where(is_double, 0.0, np.spacing(np.abs(near).max(axis=1)))
    return _RationalPlaces(near, np.full((len(near), 2), -1), off, np.empty((0, 2, 2)), points)


def on_edges(near: Floats, edges: Ints, curve: Floats, given: Bools) -> ExactPlaces:
    """Return places on edges with these ends; those that are given are doubles, whatever edges they are on."""
    off = np.zeros(len(near))
    moved = np.flatnonzero((edges[:, 0] >= 0) & ~given)
    first, second = edges[moved].T
    off[moved] = _distance(near[moved], first, curve)
    off[moved[_is_on_upright(near[moved], first, curve) & (second < 0)]] = 0.0
    crossing = moved[second >= 0]
    first, second = edges[crossing].T
    with np.errstate(divide="ignore", invalid="ignore"):
        both = off[crossing] + _distance(near[crossing], second, curve)
        off[crossing] = _MORE * both / _sine(first, second, curve)
    off[np.isnan(off)] = np.inf
    return ExactPlaces(near, edges, off, curve)


def are_crossing(curve: Floats, first: Ints, second: Ints) -> Bools:
    """Tell which pairs of edges, of a curve with these ends, are not parallel."""
    ends = np.concatenate([curve[first], curve[second]], axis=1).reshape(-1, 2)
    a, b, c, d = np.arange(len(ends)).reshape(-1, 4).T
    return np.asarray(doubles(ends).cross_sign(a, b, c, d) != 0)


def _directions(edge: Ints, curve: Floats) -> Floats:
    return np.asarray(curve[edge, 1] - curve[edge, 0])


def _is_on_upright(near: Floats, edge: Ints, curve: Floats) -> Bools:
    """Tell which edges are horizontal or vertical and have the double on their line."""
    start, end = curve[edge].swapaxes(0, 1)
    return np.asarray(((start == end) & (start == near)).any(axis=1))


def _distance(near: Floats, edge: Ints, curve: Floats) -> Floats:
    """Return upper bounds for the distances from the lines through edges, by Hesse's formula; infinite if unknown."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        (ux, uy), scale = _scaled(_directions(edge, curve))
        vx, vy = (near - curve[edge, 0]).T * scale
        left, right = ux * vy, uy * vx
        cross = np.abs(left - right) + _CROSS_ERROR * (np.abs(left) + np.abs(right)) + _UNDERFLOW
        far = _MORE * cross / np.hypot(ux, uy) / scale
    return np.where(far > 0, far, np.inf)


def _sine(first: Ints, second: Ints, curve: Floats) -> Floats:
    """Return lower bounds for the sines of the angles between edges; 0 if there is none."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        (ux, uy), (vx, vy) = (_scaled(_directions(edge, curve))[0] for edge in (first, second))
        left, right = ux * vy, uy * vx
        cross = np.abs(left - right) - _CROSS_ERROR * (np.abs(left) + np.abs(right)) - _UNDERFLOW
        sine = cross / (_MORE * np.hypot(ux, uy) * np.hypot(vx, vy))
    return np.where(sine > 0, sine, 0.0)


def _scaled(directions: Floats) -> tuple[Floats, Floats]:
    """Return the columns of directions scaled to about 1, and the powers of two for it."""
    scale = np.ldexp(1.0, -np.clip(np.frexp(np.abs(directions).max(axis=1))[1], -1000, 1000))
    return directions.T * scale, scale


def require_positive(places: ExactPlaces, triangles: Ints) -> None:
    """Check that all triangles are strictly counter-clockwise, also with the doubles that were given for corners."""
    a, b, c = triangles.T
    sign, doubt = places.cross_sign_and_doubt(a, b, a, c)
    again = np.flatnonzero(doubt & (places.off[triangles] > 0).any(axis=1) & places.doubles_are_given)
    sign[again] = np.minimum(sign[again], doubles(places.near).turn(triangles[again]))
    if len(bad := np.flatnonzero(sign <= 0)):
        raise CertificateError(f"triangle {bad[0]} is flat or turned over", where=places.near[triangles[bad[0]]])


def _rational(point: Floats) -> Point:
    x, y = point.tolist()
    return Fraction(x), Fraction(y)


def _cross(a: Point, b: Point, c: Point, d: Point) -> Fraction:
    return (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])


def _sign(number: Fraction | int) -> int:
    return (number > 0) - (number < 0)


def _along(start: Point, end: Point, share: Fraction) -> Point:
    return start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])


def _nearest(point: Point, start: Point, end: Point) -> Point:
    """Return the point nearest to a given one on the line through two others."""
    ux, uy = end[0] - start[0], end[1] - start[1]
    dot = ux * (point[0] - start[0]) + uy * (point[1] - start[1])
    return _along(start, end, dot / (ux * ux + uy * uy))


def _crossing(a: Point, b: Point, c: Point, d: Point) -> Point | None:
    """Return where the lines a → b and c → d cross; None if they are parallel."""
    sine = _cross(a, b, c, d)
    return _along(a, b, _cross(a, c, c, d) / sine) if sine else None
