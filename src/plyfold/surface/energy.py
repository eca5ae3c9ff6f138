"""The energy of the cloth: a thin plate that bends and a membrane that slopes, and how heights answer to forces.

With the cotangent Laplacian L and the area M that belongs to each vertex (a diagonal), the energy of heights z is

    E(z) = ½ ∫ ℓ² (Δz)² + |∇z|²  ≈  ½ zᵀ K z,    K = ℓ² L M⁻¹ L + L = L M⁻¹ (M + ℓ² L).

So K is a product of two matrices as sparse as L, and heights answer to forces by two systems of that kind, which cost
a tenth of one with K itself. Only where heights are held in whole regions K has to be factorised.

Cloth that is w times as stiff in a region has the weight w in both integrals there: ½ ∫ ℓ² (div w∇z)²/w + w |∇z|².
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.graphs import ways_from
from plyfold.halfedges import ends_of
from plyfold.matrices import diagonal_matrix, factorised, summed
from plyfold.ragged import next_in_rows
from plyfold.surface.glue import LiftedMesh, numbers_of_copies

__all__ = ["Cloth", "Response", "cloth_of", "cotangent_laplacian", "held_response", "response"]

# Heights that balance forces; several columns at a time if need be.
Response: TypeAlias = Callable[[Floats], Floats]

# Every side of a triangle ties its ends together a little: the only hold across a strip as thin as rounding errors.
_TIE = 1e-3
# Thinner triangles (double area by longest side squared) and smaller areas (by the mean) count as if they were not,
# for their numbers would drown all others.
_THINNEST = 1e-2
_SMALLEST = 1e-4
# Triangles at cusps have next to no energy: there is a hole in the cloth, round which it may climb.
_AT_CUSPS = 1e-6
# Nearer to a cusp than the bending length, that is this share of the way to the cusp.
_BENDING_AT_CUSPS = 0.25
# How much pieces that lie over each other are drawn together, with the energy of the slope as the unit of energy, and
# the mean width of the cloth as that of length.
_ATTRACTION = 1e-3


@dataclass(frozen=True, eq=False)
class Cloth:
    """The energy ½ zᵀ K z.

    Parameters
    ----------
    laplacian : (v, v) sparse array
        Of ½ ∫ w |∇z|².
    area : (v,) float
        What belongs to each vertex, times w.
    bending : float
        ℓ², the square of the length below which bending rules, and above which slope does.
    """

    laplacian: Any
    area: Floats
    bending: float

    @cached_property
    def stiffness(self) -> Any:
        """The matrix K; sparse, with about 19 entries in a row."""
        return self.bending * (self.laplacian @ diagonal_matrix(1 / self.area) @ self.laplacian) + self.laplacian

    def energy(self, z: Floats) -> float:
        """Return ½ zᵀ K z."""
        slope = self.laplacian @ z
        return float(self.bending * (slope / self.area) @ slope + z @ slope) / 2

    def smoothed(self, values: Floats, watch: Watch = UNWATCHED) -> Floats:
        """Return values that change within the bending length ℓ instead of at once."""
        return np.asarray(self.near(watch).solve(self.area * values))

    def near(self, watch: Watch) -> Any:
        """Return the factors of M + ℓ² L."""
        return factorised(diagonal_matrix(self.area) + self.bending * self.laplacian, watch)


def cloth_of(points: Floats, mesh: LiftedMesh, stiffness: float, flat: float, watch: Watch = UNWATCHED) -> Cloth:
    """Return the energy of a mesh in the drawing's units of length, whatever they are.

    Parameters
    ----------
    points : (p, 2) float
        The points of the planar triangulation.
    mesh : LiftedMesh
    stiffness : float
        ℓ as a fraction of the mean width of the cloth.
    flat : float
        How many times as stiff the cloth is where nothing overlaps; the change is gradual.
    watch : Watch, optional
    """
    corners = points[mesh.planar_vertex]
    corners = (corners - corners[0]) / np.ptp(corners, axis=0).max()
    outline = corners[mesh.boundary]
    perimeter = np.hypot(*(outline[next_in_rows(mesh.first_boundary)] - outline).T).sum()
    weight = np.where(np.isin(mesh.faces, mesh.cusps).any(axis=1), _AT_CUSPS, 1.0)
    laplacian, area = watch.wait_for(lambda: cotangent_laplacian(corners, mesh.faces, weight), len(weight))
    if len(mesh.first_boundary) > 2:
        laplacian = laplacian + _ties(mesh, area, _ATTRACTION * (perimeter / area.sum()) ** 2)
    mean_width = 2 * area.sum() / perimeter
    plain = Cloth(laplacian, area, (stiffness * mean_width) ** 2)
    if len(mesh.cusps):
        plain = replace(plain, area=area * _softness(corners, mesh, stiffness * mean_width))
    if flat == 1:
        return plain
    share = plain.smoothed(_alone(mesh).astype(np.float64), watch).clip(0, 1)
    weighted, _ = cotangent_laplacian(corners, mesh.faces, weight * flat ** share[mesh.faces].mean(axis=1))
    return Cloth(weighted, plain.area * flat**share, plain.bending)


def response(cloth: Cloth, watch: Watch = UNWATCHED) -> Response:
    """Return the heights that balance forces whose sum is 0, up to a constant."""
    # Hold one vertex: heights are known up to a constant.
    far, near = factorised(cloth.laplacian[1:, 1:], watch), cloth.near(watch)

    def balance(force: Floats) -> Floats:
        curved = np.zeros(force.shape)
        curved[1:] = watch.wait_for(lambda: far.solve(force[1:]), force.size)
        return np.asarray(watch.wait_for(lambda: near.solve((cloth.area * curved.T).T), force.size))

    return balance


def held_response(cloth: Cloth, held: Bools, watch: Watch = UNWATCHED) -> Response:
    """Return the heights that balance forces on vertices that are not held; those that are stay at 0."""
    free = np.flatnonzero(~held)
    inner = factorised(cloth.stiffness[free][:, free], watch)

    def balance(force: Floats) -> Floats:
        z = np.zeros(force.shape)
        z[free] = watch.wait_for(lambda: inner.solve(force[free]), force.size)
        return z

    return balance


def cotangent_laplacian(corners: Floats, faces: Ints, weight: Floats) -> tuple[Any, Floats]:
    """Return the matrix of ½ ∫ w |∇z|² and the area that belongs to each vertex."""
    triangle = corners[faces]
    n = len(corners)
    edges = np.roll(triangle, -1, axis=1) - np.roll(triangle, 1, axis=1)
    lengths = np.einsum("tix,tix->ti", edges, edges)
    double_area = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]
    double_area = np.maximum(double_area, _THINNEST * lengths.max(axis=1))
    local = np.einsum("tix,tjx->tij", edges, edges) / (2 * double_area)[:, None, None]
    local += _TIE * (3 * np.eye(3) - 1)
    local *= weight[:, None, None]
    rows, columns = np.repeat(faces, 3, axis=1).ravel(), np.tile(faces, (1, 3)).ravel()
    laplacian = summed(local.ravel(), rows, columns, (n, n))
    area = np.bincount(faces.ravel(), np.repeat(weight * double_area / 6, 3), minlength=n)
    return laplacian, np.maximum(area, _SMALLEST * area.mean())


def _softness(corners: Floats, mesh: LiftedMesh, length: float) -> Floats:
    """Return by which factor the cloth bends more easily at each vertex than elsewhere, where the outline has cusps.

    A spiral stair bends more and more towards its middle, and all of the cloth would yield to that. So near a cusp the
    bending length is only a share of the way to it. And outlines with cusps have folds far narrower than the cloth is
    on average: they would rather stand upright than bend in their width. So where triangles are narrower than usual,
    the bending length is as much shorter.
    """
    start, end = ends_of(mesh.faces)
    side = np.hypot(*(corners[start] - corners[end]).T)
    reach = length / _BENDING_AT_CUSPS
    way = ways_from(mesh.cusps, len(corners), np.stack([start, end], axis=1), side, reach)
    way[mesh.cusps] = side.min()
    (ux, uy), (vx, vy) = (corners[mesh.faces[:, i]].T - corners[mesh.faces[:, 0]].T for i in (1, 2))
    area = ux * vy - uy * vx
    width = area / side.reshape(-1, 3).max(axis=1)
    usual = area @ width / area.sum()
    around = np.bincount(mesh.faces.ravel(), np.repeat(width, 3)) / np.bincount(mesh.faces.ravel())
    return np.asarray(np.maximum(1.0, np.maximum(reach / way, usual / around)) ** 2)


def _ties(mesh: LiftedMesh, area: Floats, strength: float) -> Any:
    """Return the matrix of the energy that draws pieces together which lie over each other, in a linear system alone.

    Pieces that lie apart from all others are tied by one vertex each, so that their heights are known.
    """
    n = len(area)
    lower, upper = mesh.stacked[mesh.piece[mesh.stacked[:, 0]] != mesh.piece[mesh.stacked[:, 1]]].T
    apart = np.unique(mesh.heap, return_index=True)[1][1:]
    ends = np.concatenate([lower, np.zeros_like(apart)]), np.concatenate([upper, apart])
    weight = np.concatenate([strength * np.minimum(area[lower], area[upper]), np.ones(len(apart))])
    rows, columns = np.concatenate([*ends, *ends]), np.concatenate([*ends, *ends[::-1]])
    signs = np.concatenate([weight, weight, -weight, -weight])
    return summed(signs, rows, columns, (n, n))


def _alone(mesh: LiftedMesh) -> Bools:
    """Tell which vertices lie where nothing overlaps: above and below all triangles around them is no other one."""
    copies = numbers_of_copies(mesh)
    alone = np.ones(len(mesh.level), dtype=bool)
    alone[mesh.faces[np.repeat(copies > 1, copies)]] = False
    return alone
