"""Making a straight-line drawing even and round without ever turning a triangle over.

Newton's method on an energy that is infinite where a triangle is flat: each triangle has a shape and size that it would
like, and the curve bends and changes its step as little as possible. Triangles all counter-clockwise and a boundary
that does not cross itself are together a drawing without crossings, so the curve keeps its code all the way. The shape
term is that of [HG00]_.

References
----------
.. [HG00] K. Hormann, G. Greiner, "MIPS: an efficient global parametrization method", Curve and Surface Design,
   Saint-Malo 1999, 2000.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import shapely
from scipy.sparse import coo_array, diags_array

from plyfold.arrangement.drawing.skeleton import Kind, Skeleton
from plyfold.arrays import Complexes, Floats, Ints
from plyfold.matrices import factorised

__all__ = ["energy", "relaxed"]


# How much each wish counts: the shape and the size of triangles, and a curve that bends and speeds up evenly.
_SHAPE = {Kind.CORNER: 25.0, Kind.CELL: 0.7, Kind.RING: 0.1}
_SIZE = {Kind.CORNER: 0.3, Kind.CELL: 3.0, Kind.RING: 0.0}
_BENDING = 35.0
_STEPPING = 5.0

_MOST_STEPS = 300
_SHORTEST_STEP = 1e-9

# A Jacobian is a row (a, b, c, d) of the matrix [[a, b], [c, d]]; this is the Hessian of its determinant ad − bc.
_DETERMINANT = np.array([[0, 0, 0, 1], [0, 0, -1, 0], [0, -1, 0, 0], [1, 0, 0, 0]], dtype=float)


class _Terms(NamedTuple):
    """A sum of functions of a few unknowns each: value, gradients (m, 6) and positive Hessians (m, 6, 6)."""

    unknowns: Ints
    gradient: Floats
    hessian: Floats


def relaxed(start: Complexes, skeleton: Skeleton, worthwhile: float = 1e-4) -> Complexes:
    """Return a better drawing of the skeleton.

    Parameters
    ----------
    start : (n,) complex
        A drawing in which no triangle is turned over and the boundary does not cross itself.
    skeleton : Skeleton
    worthwhile : float
        Stop when a step gains less than this part of the energy.

    Returns
    -------
    (n,) complex
        Again such a drawing.

    Notes
    -----
    Usually 5 to 50 sparse solves with twice as many unknowns as vertices.
    """
    places, cost = start, energy(start, skeleton)
    for _ in range(_MOST_STEPS):
        direction, slope = _newton(places, skeleton)
        length, reached = _step(places, direction, slope, cost, skeleton)
        places = places + length * direction
        gain, cost = cost - reached, reached
        if gain <= worthwhile * abs(cost):
            break
    return places


def energy(places: Complexes, skeleton: Skeleton) -> float:
    """Return how far a drawing is from even and round; infinite if a triangle is flat or turned over."""
    jacobian, determinant = _jacobians(places, skeleton)
    if not (determinant > 0).all():
        return float("inf")
    shape, size = _weights(skeleton)
    bend = _bends(places, skeleton)[0]
    distortion = shape * (jacobian**2).sum(axis=1) / (2 * determinant) + size * np.log(determinant) ** 2
    return float(distortion.sum() + _BENDING * (bend.imag**2).sum() + _STEPPING * (bend.real**2).sum())


def _step(
    places: Complexes, direction: Complexes, slope: float, cost: float, skeleton: Skeleton
) -> tuple[float, float]:
    """Return the longest step of 1, 1/2, 1/4, … that gains and keeps the boundary simple, and the energy after it."""
    length = 1.0
    while length > _SHORTEST_STEP:
        trial = places + length * direction
        reached = energy(trial, skeleton)
        if reached <= cost + 1e-4 * length * slope and _is_simple(trial[skeleton.rim]):
            return length, reached
        length /= 2
    return 0.0, cost


def _is_simple(loop: Complexes) -> bool:
    return bool(shapely.LinearRing(np.column_stack([loop.real, loop.imag])).is_simple)


def _newton(places: Complexes, skeleton: Skeleton) -> tuple[Complexes, float]:
    """Return the step that minimises a convex model of the energy, and the derivative along it."""
    n = len(places)
    terms = (_triangle_terms(places, skeleton), _curve_terms(places, skeleton))
    gradient = sum(np.bincount(term.unknowns.ravel(), term.gradient.ravel(), minlength=2 * n) for term in terms)
    step = -factorised(_assembled(terms, 2 * n)).solve(gradient)
    return step[:n] + 1j * step[n:], float(gradient @ step)


def _assembled(terms: tuple[_Terms, ...], size: int) -> Any:
    """Return the sum of all Hessians as a sparse matrix.

    Moving or turning everything costs nothing; a little more on the diagonal makes a solution unique all the same.
    """
    rows = np.concatenate([np.repeat(term.unknowns, 6, axis=1).ravel() for term in terms])
    columns = np.concatenate([np.tile(term.unknowns, 6).ravel() for term in terms])
    entries = np.concatenate([term.hessian.ravel() for term in terms])
    total = coo_array((entries, (rows, columns)), shape=(size, size)).tocsc()
    return (total + diags_array(np.full(size, 1e-8 * total.diagonal().mean()), format="csc")).tocsc()


def _weights(skeleton: Skeleton) -> tuple[Floats, Floats]:
    """Return how much the shape and the size of each triangle count."""
    shape, size = (np.array([table[kind] for kind in Kind])[skeleton.kind] for table in (_SHAPE, _SIZE))
    return shape, size


def _maps(skeleton: Skeleton) -> Floats:
    """Return for each triangle the (4, 6) matrix from its coordinates (three x, three y) to its Jacobian."""
    first, second = (skeleton.shapes[:, 1:] - skeleton.shapes[:, :1]).T
    area = (first.conjugate() * second).imag
    inverse = np.stack([second.imag, -second.real, -first.imag, first.real], axis=1) / area[:, None]
    by_x, by_y = inverse[:, 0::2], inverse[:, 1::2]
    result = np.zeros((len(area), 4, 6))
    for row, gradient in enumerate((by_x, by_y)):
        weights = np.column_stack([-gradient.sum(axis=1), gradient])
        result[:, row, :3] = result[:, row + 2, 3:] = weights
    return result


def _coordinates(vertices: Ints, n: int) -> Ints:
    return np.concatenate([vertices, vertices + n], axis=1)


def _jacobians(places: Complexes, skeleton: Skeleton) -> tuple[Floats, Floats]:
    """Return the Jacobians of the maps from the wanted shapes to the triangles, and their determinants."""
    coordinates = np.concatenate([places.real, places.imag])[_coordinates(skeleton.triangles, len(places))]
    jacobian = np.einsum("mij,mj->mi", _maps(skeleton), coordinates)
    a, b, c, d = jacobian.T
    return jacobian, a * d - b * c


def _triangle_terms(places: Complexes, skeleton: Skeleton) -> _Terms:
    """Differentiate ``shape · |J|² / 2 det J + size · log² det J``, and leave out directions of negative curvature."""
    jacobian, determinant = _jacobians(places, skeleton)
    shape, size = (weight[:, None] for weight in _weights(skeleton))
    det, logarithm = determinant[:, None], np.log(determinant)[:, None]
    norm = (jacobian**2).sum(axis=1, keepdims=True)
    cofactor = jacobian[:, ::-1] * (1, -1, -1, 1)
    by_det = 2 * size * logarithm / det - shape * norm / (2 * det**2)
    by_det_twice = 2 * size * (1 - logarithm) / det**2 + shape * norm / det**3
    mixed = jacobian[:, :, None] * cofactor[:, None, :]
    hessian = (
        (shape / det)[:, :, None] * np.eye(4)
        - (shape / det**2)[:, :, None] * (mixed + mixed.transpose(0, 2, 1))
        + by_det_twice[:, :, None] * cofactor[:, :, None] * cofactor[:, None, :]
        + by_det[:, :, None] * _DETERMINANT
    )
    maps = _maps(skeleton)
    return _Terms(
        unknowns=_coordinates(skeleton.triangles, len(places)),
        gradient=np.einsum("mij,mi->mj", maps, jacobian * shape / det + by_det * cofactor),
        hessian=maps.transpose(0, 2, 1) @ _positive(hessian) @ maps,
    )


def _positive(hessian: Floats) -> Floats:
    values, vectors = np.linalg.eigh(hessian)
    kept = np.maximum(values, 1e-9 * values[:, -1:])
    return np.asarray((vectors * kept[:, None, :]) @ vectors.transpose(0, 2, 1))


def _bends(places: Complexes, skeleton: Skeleton) -> tuple[Complexes, Complexes, Complexes]:
    """Return at each vertex of the curve log(step after / step before), whose imaginary part is the bend; and both."""
    along = places[skeleton.path]
    before, after = along - np.roll(along, 1), np.roll(along, -1) - along
    return np.log(after / before), before, after


def _curve_terms(places: Complexes, skeleton: Skeleton) -> _Terms:
    """Differentiate the squares of the bends' parts; of second derivatives keep those of a sum of squares (Gauss)."""
    bend, before, after = _bends(places, skeleton)
    slopes = np.column_stack([1 / before, -1 / before - 1 / after, 1 / after])
    stepping = np.concatenate([slopes.real, -slopes.imag], axis=1)
    bending = np.concatenate([slopes.imag, slopes.real], axis=1)
    path = skeleton.path
    neighbours = np.column_stack([np.roll(path, 1), path, np.roll(path, -1)])
    return _Terms(
        unknowns=_coordinates(neighbours, len(places)),
        gradient=2 * (_STEPPING * bend.real[:, None] * stepping + _BENDING * bend.imag[:, None] * bending),
        hessian=2 * (_STEPPING * _squares(stepping) + _BENDING * _squares(bending)),
    )


def _squares(rows: Floats) -> Floats:
    return np.asarray(rows[:, :, None] * rows[:, None, :])
