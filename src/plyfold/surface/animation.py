"""The motion from the round disk to the drawing laid flat, and from there to the lifted surface.

Moving every point straight to its place would fold the cloth over. So each triangle turns and stretches evenly
instead, a spiral by several full turns if it must, and the vertices follow as closely as they can.

References
----------
.. [ACL00] M. Alexa, D. Cohen-Or, D. Levin, "As-rigid-as-possible shape interpolation", SIGGRAPH 2000.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from plyfold.arrays import Complexes, Floats, Ints
from plyfold.errors import InputError
from plyfold.surface.locate import neighbours
from plyfold.surface.round_map import cotangents
from plyfold.surface.unwrap import UnwoundDisk

__all__ = ["Motion"]


@dataclass(frozen=True, eq=False)
class Motion:
    """The way of a disk of cloth: round at time 0, laid flat over the drawing at 1, lifted at 2.

    Parameters
    ----------
    unwound : UnwoundDisk

    Examples
    --------
    >>> from plyfold import lift
    >>> ramp = lift([(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)], gap=1.0)
    >>> motion = Motion(ramp.unwrap())
    >>> bool((motion.at(2.0) == ramp.vertices).all())
    True
    >>> float(motion.at(1.0)[:, 2].max())
    0.0
    """

    unwound: UnwoundDisk

    def at(self, time: float, thickness: float = 0.0) -> Floats:
        """Return where the vertices are, shape (n, 3).

        Parameters
        ----------
        time : float
            From 0 to 2; from 0 to 1, if the disk has not been lifted.
        thickness : float
            Share of the heights that is there from the first, so that sheets lie in their order when flat.

        Raises
        ------
        InputError
            If the time is not from 0 to 2 (or 1), or the thickness not from 0 to 1.

        Notes
        -----
        The first call costs a sparse factorisation, as :meth:`Surface.unwrap` does, and others a tenth of it.
        """
        latest = 1 if self.unwound.space is None else 2
        if not 0 <= time <= latest:
            raise InputError(f"the time must be from 0 to {latest}, not {time!r}")
        if not 0 <= thickness <= 1:
            raise InputError(f"the thickness must be from 0 to 1, not {thickness!r}")
        heights = np.zeros(len(self.unwound.disk)) if self.unwound.space is None else self.unwound.space[:, 2]
        return np.column_stack([self._flat(min(time, 1.0)), heights * max(time - 1, thickness)])

    @cached_property
    def disk(self) -> Floats:
        """The round disk at time 0, (n, 2): as wide as the drawing, in its middle, and turned to fit it best.

        Turned so that the triangles turn by nothing on the whole on their way to the drawing.
        """
        low, high = self.unwound.plane.min(axis=0), self.unwound.plane.max(axis=0)
        disk = _complex(self.unwound.disk) * np.exp(-1j * self._bend.mean_turn)
        return np.asarray(low / 2 + high / 2 + (high - low).max() / 2 * _pairs(disk))

    def _flat(self, time: float) -> Floats:
        if time == 0:
            return self.disk
        return self.unwound.plane if time == 1 else self._between(time)

    def _between(self, time: float) -> Floats:
        """Integrate the triangles' turns and stretches at a time between 0 and 1, by least squares."""
        unwound = self.unwound
        plane, size = _complex(unwound.plane - unwound.plane[0]), float(np.ptp(unwound.plane, axis=0).max())
        start, end = unwound.faces[:, [1, 2, 0]], unwound.faces[:, [2, 0, 1]]
        pull = self._weights * self._bend.at(1 - time, (plane[end] - plane[start]) / size)
        force = np.zeros(len(plane), dtype=np.complex128)
        np.add.at(force, end.ravel(), pull.ravel())
        np.add.at(force, start.ravel(), -pull.ravel())
        moved = np.zeros_like(force)
        moved[1:] = self._factors.solve(force[1:])
        return self._centred(_pairs(moved) * size, time)

    def _centred(self, moved: Floats, time: float) -> Floats:
        """Let the middle of the cloth move straight."""
        middle = (1 - time) * self.disk.mean(axis=0) + time * self.unwound.plane.mean(axis=0)
        return np.asarray(moved - moved.mean(axis=0) + middle)

    @cached_property
    def _bend(self) -> _Bend:
        size = float(np.ptp(self.unwound.plane, axis=0).max())
        plane, faces = (self.unwound.plane - self.unwound.plane[0]) / size, self.unwound.faces
        return _Bend.between(_complex(plane)[faces], _complex(self.unwound.disk)[faces] / 2, neighbours(faces))

    @cached_property
    def _weights(self) -> Floats:
        plane = self.unwound.plane - self.unwound.plane[0]
        return cotangents(plane[self.unwound.faces] / np.ptp(plane, axis=0).max())[..., 0]

    @cached_property
    def _factors(self) -> Any:
        """The factors of the cotangent Laplacian without its first row and column."""
        from scipy.sparse import csc_array, diags_array
        from scipy.sparse.linalg import splu

        start, end = self.unwound.faces[:, [1, 2, 0]].ravel(), self.unwound.faces[:, [2, 0, 1]].ravel()
        n = len(self.unwound.disk)
        one_way = csc_array((self._weights.ravel(), (start, end)), shape=(n, n))
        whole = one_way + one_way.T
        matrix = (diags_array(whole.sum(axis=0)) - whole).tocsc()[1:, 1:].astype(np.complex128)
        return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})


@dataclass(frozen=True, eq=False)
class _Bend:
    """What a map does in each triangle, z ↦ e^{iθ} (stretch · z + shear · z̄): it stretches and then turns by θ.

    The angles are those of one continuous function, so they may be more than a full turn; their mean is 0.
    """

    turn: Floats
    stretch: Floats
    shear: Complexes
    mean_turn: float

    @classmethod
    def between(cls, corners: Complexes, images: Complexes, beyond: Ints) -> _Bend:
        """Return the map of triangles, (m, 3), to others, but for the mean of its turns."""
        (e, f), (p, q) = ((triangle[:, 1:] - triangle[:, :1]).T for triangle in (corners, images))
        double_area = e * f.conj() - f * e.conj()
        linear = (p * f.conj() - q * e.conj()) / double_area
        turn = _continuous(np.angle(linear), beyond)
        area = np.abs(double_area)
        mean_turn = float((turn * area).sum() / area.sum())
        shear = (e * q - f * p) / double_area * np.exp(-1j * turn)
        return cls(turn - mean_turn, np.abs(linear), shear, mean_turn)

    def at(self, share: float, sides: Complexes) -> Complexes:
        """Apply a share of the map to sides of the triangles, (m, 3)."""
        stretch, shear = 1 + share * (self.stretch - 1), share * self.shear
        bent = stretch[:, None] * sides + shear[:, None] * sides.conj()
        return np.asarray(np.exp(1j * share * self.turn)[:, None] * bent)


def _continuous(turn: Floats, beyond: Ints) -> Floats:
    """Add full turns so that the angles of neighbouring triangles differ by less than half a turn.

    Neighbours turn their common side by the same angle, and this differs by less than a quarter turn from either's.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import breadth_first_order

    face, side = np.nonzero(beyond >= 0)
    graph = csr_array((np.ones(len(face)), (face, beyond[face, side])), shape=(len(turn), len(turn)))
    order, before = breadth_first_order(graph, 0)
    step = np.round((turn[before[order[1:]]] - turn[order[1:]]) / (2 * np.pi))
    full_turns = [0.0] * len(turn)
    for triangle, previous, more in zip(order[1:].tolist(), before[order[1:]].tolist(), step.tolist(), strict=True):
        full_turns[triangle] = full_turns[previous] + more
    return np.asarray(turn + 2 * np.pi * np.array(full_turns))


def _complex(points: Floats) -> Complexes:
    return points[:, 0] + 1j * points[:, 1]


def _pairs(numbers: Complexes) -> Floats:
    return np.column_stack([numbers.real, numbers.imag])
