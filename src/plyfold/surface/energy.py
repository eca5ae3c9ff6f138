"""The energy of the cloth: a thin plate that bends and a membrane that slopes.

With the cotangent Laplacian L and the area M that belongs to each vertex (a diagonal), the energy of heights z is

    E(z) = ½ ∫ ℓ² (Δz)² + |∇z|²  ≈  ½ zᵀ K z,    K = ℓ² L M⁻¹ L + L = L M⁻¹ (M + ℓ² L).

So K is a product of two matrices as sparse as L, which :mod:`plyfold.surface.answers` takes apart.

Cloth that is w times as stiff in a region has the weight w in both integrals there: ½ ∫ ℓ² (div w∇z)²/w + w |∇z|².
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.graphs import ways_from
from plyfold.halfedges import ends_of
from plyfold.matrices import diagonal_matrix, factorised, summed
from plyfold.surface.glue import LiftedMesh, numbers_of_copies
from plyfold.surface.grading import ClothMesh, double_areas

__all__ = ["Cloth", "cloth_of", "cotangent_laplacian"]

# Thinner triangles (double area by longest side squared) and smaller areas (by the mean) count as if they were not,
# for their numbers would drown all others.
_THINNEST = 1e-2
# Every side of such a triangle ties its ends together a little: the only hold along a strip as thin as rounding errors.
_TIE = 1e-3
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
        near = diagonal_matrix(self.area) + self.bending * self.laplacian
        return np.asarray(factorised(near, watch).solve(self.area * values))


def cloth_of(fine: ClothMesh, mesh: LiftedMesh, stiffness: float, flat: float, watch: Watch = UNWATCHED) -> Cloth:
    """Return the energy of a surface, of the heights of all vertices of a finer mesh.

    Parameters
    ----------
    fine : ClothMesh
        In units of the drawing, whatever those are.
    mesh : LiftedMesh
        The surface.
    stiffness : float
        ℓ as a fraction of the mean width of the cloth.
    flat : float
        How many times as stiff the cloth is where nothing overlaps; the change is gradual.
    watch : Watch, optional
    """
    places, faces, length = fine.places, fine.faces, stiffness * fine.width
    weight = np.where(np.isin(faces, mesh.cusps).any(axis=1), _AT_CUSPS, 1.0)
    laplacian, area = watch.wait_for(lambda: cotangent_laplacian(places, faces, weight), len(weight))
    ties = _ties(mesh, fine, _ATTRACTION * (2 / fine.width) ** 2) if len(mesh.first_boundary) > 2 else 0 * laplacian
    plain = Cloth(laplacian + ties, area, length**2)
    if len(mesh.cusps):
        plain = replace(plain, area=area * _softness(fine, mesh, length))
    if flat == 1:
        return plain
    share = plain.smoothed(_alone(fine, mesh), watch).clip(0, 1)
    weighted, _ = cotangent_laplacian(places, faces, weight * flat ** share[faces].mean(axis=1))
    return Cloth(weighted + ties, plain.area * flat**share, plain.bending)


def cotangent_laplacian(corners: Floats, faces: Ints, weight: Floats) -> tuple[Any, Floats]:
    """Return the matrix of ½ ∫ w |∇z|² and the area that belongs to each vertex."""
    triangle = corners[faces]
    n = len(corners)
    edges = np.roll(triangle, -1, axis=1) - np.roll(triangle, 1, axis=1)
    lengths = np.einsum("tix,tix->ti", edges, edges)
    double_area = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]
    least = _THINNEST * lengths.max(axis=1)
    tie = np.where(double_area < least, _TIE, 0.0)
    double_area = np.maximum(double_area, least)
    local = np.einsum("tix,tjx->tij", edges, edges) / (2 * double_area)[:, None, None]
    local += tie[:, None, None] * (3 * np.eye(3) - 1)
    local *= weight[:, None, None]
    rows, columns = np.repeat(faces, 3, axis=1).ravel(), np.tile(faces, (1, 3)).ravel()
    laplacian = summed(local.ravel(), rows, columns, (n, n))
    area = np.bincount(faces.ravel(), np.repeat(weight * double_area / 6, 3), minlength=n)
    return laplacian, np.maximum(area, _SMALLEST * area.mean())


def _softness(fine: ClothMesh, mesh: LiftedMesh, length: float) -> Floats:
    """Return by which factor the cloth bends more easily at each vertex than elsewhere, where the outline has cusps.

    A spiral stair bends more and more towards its middle, and all of the cloth would yield to that. So near a cusp the
    bending length is only a share of the way to it. And outlines with cusps have folds far narrower than the cloth is
    on average: they would rather stand upright than bend in their width. So where triangles are narrower than usual,
    the bending length is as much shorter.
    """
    places, faces = fine.places, fine.faces
    start, end = ends_of(faces)
    side = np.hypot(*(places[start] - places[end]).T)
    reach = length / _BENDING_AT_CUSPS
    way = ways_from(mesh.cusps, len(places), np.stack([start, end], axis=1), side, reach)
    way[mesh.cusps] = side.min()
    area = double_areas(places, faces)
    width = area / side.reshape(-1, 3).max(axis=1)
    usual = area @ width / area.sum()
    around = np.bincount(faces.ravel(), np.repeat(width, 3)) / np.bincount(faces.ravel())
    return np.asarray(np.maximum(1.0, np.maximum(reach / way, usual / around)) ** 2)


def _ties(mesh: LiftedMesh, fine: ClothMesh, strength: float) -> Any:
    """Return the matrix of the energy that draws pieces together which lie over each other, in a linear system alone.

    Pieces that lie apart from all others are tied by one vertex each, so that their heights are known.
    """
    n, area = len(fine.places), _shares(np.ones(len(mesh.faces)), fine.places, mesh.faces)
    lower, upper = mesh.stacked[mesh.piece[mesh.stacked[:, 0]] != mesh.piece[mesh.stacked[:, 1]]].T
    apart = np.unique(mesh.heap, return_index=True)[1][1:]
    ends = np.concatenate([lower, np.zeros_like(apart)]), np.concatenate([upper, apart])
    weight = np.concatenate([strength * np.minimum(area[lower], area[upper]), np.ones(len(apart))])
    rows, columns = np.concatenate([*ends, *ends]), np.concatenate([*ends, *ends[::-1]])
    signs = np.concatenate([weight, weight, -weight, -weight])
    return summed(signs, rows, columns, (n, n))


def _alone(fine: ClothMesh, mesh: LiftedMesh) -> Floats:
    """Return which share of the cloth around each vertex lies where nothing overlaps."""
    copies = numbers_of_copies(mesh)
    alone = np.repeat(copies == 1, copies)[fine.origin]
    around = _shares(np.ones(len(alone)), fine.places, fine.faces)
    return _shares(alone.astype(np.float64), fine.places, fine.faces) / np.maximum(around, np.finfo(float).tiny)


def _shares(values: Floats, places: Floats, faces: Ints) -> Floats:
    """Return the integral of values of triangles times the share of each vertex there, (v,)."""
    integral = np.abs(values * double_areas(places, faces) / 6)
    return np.asarray(np.bincount(faces.ravel(), np.repeat(integral, 3), minlength=len(places)), dtype=np.float64)
