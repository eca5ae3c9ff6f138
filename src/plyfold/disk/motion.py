"""The motion from the round disk to the drawing laid flat, and from there to the lifted surface.

Moving every point straight to its place would fold the cloth over. Instead the lengths of all sides go from those in
the disk to those in the drawing, and at each time the triangles with these lengths are laid out in the plane, as in
[CWKB13]_. They fit together after small changes (:mod:`plyfold.disk.flatten`), so none is turned over, and a
spiral unrolls by as many turns as it has. Where a coarse mesh of thin cells leaves no lengths that fit, single
triangles are turned over on the way: 1 of 259 in one of forty random disks, 5 of 2,952 in *seven-flaps*.

References
----------
.. [CWKB13] R. Chen, O. Weber, D. Keren, M. Ben-Chen, "Planar shape interpolation with bounded distortion", ACM
   Transactions on Graphics 32, 2013.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.disk.flatten import Layout, angles_of, flattened, thin
from plyfold.disk.round_map import cross
from plyfold.errors import InputError

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk

__all__ = ["Motion", "shapes_of_disk", "turned_over"]

# Shorter sides, in a drawing of size 1, count as that long.
_SHORTEST = 1e-16
# How often the stretch is averaged with that of neighbours, until no triangle is torn by it at any of these times.
_SMOOTHINGS = (5, 20, 80)
_TRIALS = (0.25, 0.5, 0.75)
# Shapes from the flat drawing to the disk are so many that no cloth folds over on the straight way between them, up to
# a number; larger surfaces do without those between.
_MOST_SHAPES = 17
_MANY_VERTICES = 20_000


@dataclass(frozen=True, eq=False)
class Motion:
    """The way of a disk of cloth: round at time 0, laid flat over the drawing at 1, lifted at 2.

    Up to time 1 it is as wide as the drawing, in the same place. Every triangle stays counter-clockwise, but for single
    ones in cloth that is stretched very unevenly, and such as are thinner than rounding errors: there, lengths that fit
    together may need a side as long as the two others. :func:`turned_over` counts them.

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
        Between 0 and 1 a sparse factorisation or two, each like that of :meth:`Surface.unwrap`.
        """
        latest = 1 if self.unwound.space is None else 2
        if not 0 <= time <= latest:
            raise InputError(f"the time must be from 0 to {latest}, not {time!r}")
        if not 0 <= thickness <= 1:
            raise InputError(f"the thickness must be from 0 to 1, not {thickness!r}")
        heights = np.zeros(len(self.unwound.disk)) if self.unwound.space is None else self.unwound.space[:, 2]
        return np.column_stack([self._flat(min(time, 1.0)), heights * max(time - 1, thickness)])

    def shapes(self, most: int) -> list[Floats]:
        """Return the cloth from the drawing to the disk, each (n, 2), at so many times that it can move straight.

        Between one shape and the next no triangle turns over, or hardly one in a coarse mesh of thin cells. But there
        are no more than ``most`` (or 5) shapes: if they do not suffice, triangles turn over in the end.
        """
        times = [1.0, 0.75, 0.5, 0.25, 0.0]
        shapes = [self._flat(time) for time in times]
        while True:
            folded = [i for i, pair in enumerate(pairwise(shapes)) if turned_over(*pair, self.unwound.faces)]
            if not folded or len(times) + len(folded) > most:
                return shapes
            for step in reversed(folded):
                times.insert(step + 1, (times[step] + times[step + 1]) / 2)
                shapes.insert(step + 1, self._flat(times[step + 1]))

    @cached_property
    def disk(self) -> Floats:
        """The round disk at time 0, (n, 2): as wide as the drawing, in its middle, and turned to fit it best.

        Turned so that the triangles turn by nothing on the whole on their way to the drawing.
        """
        turn = self._directions(self._in_disk)[0, 0] - _way(self.unwound.disk, self.unwound.faces)
        turned = self.unwound.disk @ [(np.cos(turn), np.sin(turn)), (-np.sin(turn), np.cos(turn))]
        middle, size = _middle_and_size(self.unwound.plane)
        return np.asarray(middle + size / 2 * turned)

    def _flat(self, time: float) -> Floats:
        if time == 0:
            return self.disk
        return self.unwound.plane if time == 1 else self._between(time)

    def _between(self, time: float) -> Floats:
        mixed = _mixed(self._in_disk, self._in_plane, self._stretch, time)
        sides = flattened(mixed, self.unwound.faces, self._layout.inner)
        return self._in_place(self._layout.points(sides, self._directions(sides)), time)

    def _in_place(self, points: Floats, time: float) -> Floats:
        """Put the cloth where disk and drawing are, and make it as wide."""
        (disk, disk_size), (plane, plane_size) = _middle_and_size(self.disk), _middle_and_size(self.unwound.plane)
        middle, size = _middle_and_size(points)
        scale = ((1 - time) * disk_size + time * plane_size) / size
        return np.asarray((1 - time) * disk + time * plane + scale * (points - middle))

    @cached_property
    def _layout(self) -> Layout:
        return Layout(self.unwound.faces, self.unwound.boundary)

    def _directions(self, sides: Floats) -> Floats:
        """Return the directions of sides with these lengths, turned as the drawing is on the whole."""
        directions, (drawn, share) = self._layout.directions(sides), self._drawn
        return np.asarray(directions - share @ (directions - drawn).mean(axis=1))

    @cached_property
    def _drawn(self) -> tuple[Floats, Floats]:
        """The directions of the sides in the drawing, and the share that each triangle has of its area."""
        sides = self._in_plane
        area = sides[:, 0] * sides[:, 1] * np.sin(angles_of(sides)[:, 1])
        return self._layout.directions(sides) + _way(self.unwound.plane, self.unwound.faces), area / area.sum()

    @cached_property
    def _in_disk(self) -> Floats:
        """The lengths of all sides in the disk, (m, 3), if it were as wide as 1."""
        return _sides(self.unwound.disk / 2, self.unwound.faces)

    @cached_property
    def _in_plane(self) -> Floats:
        """The lengths of all sides in the drawing, (m, 3), if it were as wide as 1."""
        plane = self.unwound.plane - self.unwound.plane[0]
        return _sides(plane / np.ptp(plane, axis=0).max(), self.unwound.faces)

    @cached_property
    def _stretch(self) -> Floats:
        """The logarithm of how much longer the sides are in the drawing than in the disk, smoothed; (m, 3).

        Where nothing smooth keeps triangles whole, it is the same everywhere.
        """
        faces, plain = self.unwound.faces, np.log(self._in_plane / self._in_disk)
        smooth, done = plain, 0
        for wanted in _SMOOTHINGS:
            for _ in range(wanted - done):
                smooth = _smoother(smooth, faces)
            done = wanted
            if not any(thin(_mixed(self._in_disk, self._in_plane, smooth, time)).any() for time in _TRIALS):
                return smooth
        return np.full(plain.shape, plain.mean())


def shapes_of_disk(unwound: UnwoundDisk) -> dict[str, Floats]:
    """Return the disk flat on the table, on its way to be round, and round."""
    motion = Motion(unwound)
    if len(unwound.plane) < _MANY_VERTICES:
        drawn, *between, disk = motion.shapes(_MOST_SHAPES)
    else:
        drawn, between, disk = unwound.plane, [], motion.disk
    named = {"flat": drawn, **{f"unwinding {number + 1}": shape for number, shape in enumerate(between)}, "disk": disk}
    return {name: np.pad(shape, ((0, 0), (0, 1))) for name, shape in named.items()}


def turned_over(before: Floats, after: Floats, faces: Ints) -> int:
    """Return how many triangles turn over while their corners move straight from one place, (n, 2), to another.

    Examples
    --------
    >>> triangle = np.array([(0.0, 0), (2, 0), (0, 1)])
    >>> [turned_over(triangle, triangle[corners], np.array([(0, 1, 2)])) for corners in ([1, 2, 0], [0, 2, 1])]
    [0, 1]
    """
    sides = [(points[faces[:, 1:]] - points[faces[:, :1]]) / np.ptp(points, axis=0).max() for points in (before, after)]
    first, last = (cross(side[:, 0], side[:, 1]) for side in sides)
    mixed = (cross(sides[0][:, 0], sides[1][:, 1]) + cross(sides[1][:, 0], sides[0][:, 1])) / 2
    # On the way the area is first (1 − t)² + 2 mixed t (1 − t) + last t².
    stays = (first > 0) & (last > 0) & (mixed > -np.sqrt(first.clip(0)) * np.sqrt(last.clip(0)))
    return int(len(faces) - stays.sum())


def _mixed(start: Floats, end: Floats, stretch: Floats, time: float) -> Floats:
    """Return lengths between those of two meshes: their squares are mixed, after half-way stretches of both.

    Without these, lengths would go over at once where they grow a hundredfold, and in the end only where they shrink.
    """
    share = time * time * (3 - 2 * time)  # slowly at both ends: flat triangles open with the root of the share
    from_start, from_end = start * np.exp(share * stretch), end * np.exp((share - 1) * stretch)
    return np.sqrt((1 - share) * from_start**2 + share * from_end**2)


def _smoother(stretch: Floats, faces: Ints) -> Floats:
    """Return for each side the mean of two vertices' means over the sides around them."""
    ends = np.roll(faces, -1, axis=1)
    total = np.bincount(faces.ravel(), stretch.ravel()) + np.bincount(ends.ravel(), stretch.ravel())
    mean = total / (2 * np.bincount(faces.ravel()))
    return np.asarray((mean[faces] + mean[ends]) / 2)


def _sides(points: Floats, faces: Ints) -> Floats:
    """Return the lengths of sides, (m, 3), from corner i to i + 1."""
    way = points[np.roll(faces, -1, axis=1)] - points[faces]
    return np.maximum(np.hypot(way[..., 0], way[..., 1]), _SHORTEST)


def _middle_and_size(points: Floats) -> tuple[Floats, float]:
    low, high = points.min(axis=0), points.max(axis=0)
    return low / 2 + high / 2, float((high - low).max())


def _way(points: Floats, faces: Ints) -> float:
    """Return the direction of the first side."""
    x, y = points[faces[0, 1]] - points[faces[0, 0]]
    return float(np.arctan2(y, x))
