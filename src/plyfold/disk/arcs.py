"""The arcs of the disk layout, carried over to the unwound disk: they group the borders that lie on one sheet.

Each sheet is a disk, and is mapped to a round disk of its own. There the arcs are straight chords between the middles
of borders, that do not meet but at their ends. Taken back, they are curves inside the sheet.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats, Ints
from plyfold.disk.places import locate
from plyfold.disk.round_map import round_map
from plyfold.graphs import components
from plyfold.halfedges import ends_of, following, twins_of
from plyfold.immersion.immersion import Group

if TYPE_CHECKING:
    from plyfold.disk.unwrap import UnwoundDisk

__all__ = ["Arc", "arcs_of"]

_POINTS = 65
# A border alone in its sheet has an arc from a quarter of its length to three quarters.
_ENDS_OF_SELF_ARC = (0.25, 0.75)


@dataclass(frozen=True, eq=False)
class Arc:
    """An arc between consecutive borders of a sheet, or from a border to itself.

    Parameters
    ----------
    sheet : int
    borders : (int, int)
        The borders in whose middles it begins and ends.
    points : (p, 2) float
        The arc in the unwound disk.
    """

    sheet: int
    borders: tuple[int, int]
    points: Floats


def arcs_of(unwound: UnwoundDisk) -> tuple[Arc, ...]:
    """Return the arcs of all sheets that have borders of their own.

    Examples
    --------
    >>> from plyfold.disk.unwrap import unwrap
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> [arc.borders for arc in arcs_of(unwrap(ramp, triangles=100))]
    [(0, 6), (1, 5), (2, 4), (3, 3), (7, 7)]
    """
    return tuple(arc for group in unwound.immersion.disk_layout() for arc in _arcs_of_sheet(unwound, group))


def _arcs_of_sheet(unwound: UnwoundDisk, group: Group) -> list[Arc]:
    in_sheet = np.flatnonzero(unwound.sheet == group.sheet)
    faces = _parted(unwound.faces[in_sheet])
    vertex = np.empty(int(faces.max()) + 1, dtype=np.int64)
    vertex[faces] = unwound.faces[in_sheet]
    round_sheet = round_map(unwound.plane[vertex], faces, _boundary(faces))

    def on_border(border: int, share: float) -> Floats:
        corners = (faces[np.searchsorted(in_sheet, face), i] for face, i in unwound.border_corners(border))
        start, end = (np.arctan2(round_sheet[corner, 1], round_sheet[corner, 0]) for corner in corners)
        there = start + share * ((end - start) % (2 * np.pi) or 2 * np.pi)
        return np.array([np.cos(there), np.sin(there)])

    arcs = []
    for first, last in group.arcs:
        shares = _ENDS_OF_SELF_ARC if first == last else (0.5, 0.5)
        way = np.linspace(0, 1, _POINTS)[:, None]
        chord = (1 - way) * on_border(first, shares[0]) + way * on_border(last, shares[1])
        points = locate(chord, round_sheet, faces).of(unwound.disk[vertex], faces)
        arcs.append(Arc(group.sheet, (first, last), points))
    return arcs


def _parted(faces: Ints) -> Ints:
    """Return the triangles with new vertices: a sheet that touches itself at a point has two of them there."""
    twin = twins_of(faces)
    side = np.flatnonzero(twin >= 0)
    return components(len(twin), following(side), twin[side]).reshape(faces.shape)


def _boundary(faces: Ints) -> Ints:
    """Return the vertices on the boundary of a disk of triangles, in order."""
    start, end = ends_of(faces)
    rim = twins_of(faces) < 0
    after = dict(zip(start[rim].tolist(), end[rim].tolist(), strict=True))
    loop = [int(start[rim][0])]
    while len(loop) < len(after):
        loop.append(after[loop[-1]])
    return np.array(loop)
