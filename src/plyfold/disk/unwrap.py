"""The unwound disk: the cloth taken off the drawing and spread out as a round disk (figures 2, 4 and 6 of [MGR11]_).

A sheet of cloth that passes over itself has no single-valued map from the plane, but it has one from a round disk. The
boundary goes to the circle by arc length, the inside follows harmonically, and everything on the cloth is carried over:
sheets, borders, the seams between sheets, and the arcs that group the borders.

References
----------
.. [MGR11] U. Mukherjee, M. Gopi, J. Rossignac, "Immersion and Embedding of Self-Crossing Loops",
   Sketch-Based Interfaces and Modeling, 2011.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Protocol, runtime_checkable

import numpy as np
import numpy.typing as npt

from plyfold.arrays import Floats, Ints, freeze, read_only
from plyfold.certify import check_immersed_disk
from plyfold.colours import sheet_colour
from plyfold.disk.arcs import Arc, arcs_of
from plyfold.disk.motion import shapes_of_disk
from plyfold.disk.places import Missing, Places, locate, places_in_sheet
from plyfold.disk.round_map import round_map, runs_once_round
from plyfold.errors import CertificateError, InputError, PlyfoldError
from plyfold.flat.triangulate import chosen_immersion
from plyfold.halfedges import neighbours_of
from plyfold.immersion.immersion import Immersion, require_disk
from plyfold.io.mesh.model import DETAIL, Material, Model, size_of
from plyfold.io.mesh.saving import save_model
from plyfold.mesh.cells import DEFAULT_TRIANGLES, refuse_sizes, triangulate_cells
from plyfold.mesh.refine import given_outline, is_moved
from plyfold.mesh.sheets import glue_copies
from plyfold.mesh.strips import loop_left
from plyfold.outline.given import CurveLike
from plyfold.outline.points import as_points
from plyfold.wording import counted

__all__ = ["DISK_ENDINGS", "UnwoundDisk", "map_disk", "model_of_disk", "require_one_piece", "unwrap"]

# The files that hold texture coordinates.
DISK_ENDINGS = (".obj", ".ply", ".glb")

# How far beyond the circle a point may seem to be by rounding: a vertex is up to √2 units of the last place beyond it,
# and its distance from the middle is computed to one more.
_ROUNDING = 2 * np.finfo(np.float64).eps


@dataclass(frozen=True, eq=False)
class UnwoundDisk:
    """A triangulated round disk and its map to the plane, and to space if the immersion has been lifted.

    Parameters
    ----------
    immersion : Immersion
    disk : (n, 2) float
        Vertices in the unit disk. Those of the boundary lie on the unit circle by arc length of the curve, counter-
        clockwise from its first point at (1, 0). Every triangle is counter-clockwise, exactly.
    plane : (n, 2) float
        The same vertices in the drawing.
    space : (n, 3) float or None
        The same vertices of the lifted surface.
    faces : (m, 3) int
        Vertices of each triangle, counter-clockwise.
    sheet : (m,) int
        The sheet of each triangle.
    boundary : (b,) int
        Vertices along the curve in order, from its first point: 0, 1, …, b − 1.

    Examples
    --------
    >>> ramp = [(0, 0), (9, 0), (9, 6), (3, 6), (3, -3), (4, -3), (4, 5), (8, 5), (8, 1), (0, 1)]
    >>> unwound = unwrap(ramp, triangles=100)
    >>> unwound.to_plane([(1.0, 0.0)]).tolist()
    [[0.0, 0.0]]
    >>> unwound.check()
    """

    immersion: Immersion
    disk: Floats
    plane: Floats
    space: Floats | None
    faces: Ints
    sheet: Ints
    boundary: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        sheets = counted(len(np.unique(self.sheet)), "sheet")
        return f"<UnwoundDisk: {counted(len(self.faces), 'triangle')} in {sheets}>"

    def _repr_png_(self) -> bytes:
        from plyfold.draw.notebook import unwound_png

        return unwound_png(self)

    @cached_property
    def uv(self) -> Floats:
        """Texture coordinates of the vertices, (n, 2): the disk in the unit square, (disk + 1) / 2."""
        return read_only((self.disk + 1) / 2)

    @cached_property
    def border_start(self) -> Ints:
        """Where on the boundary each border begins: border i runs from ``boundary[border_start[i]]``.

        Raises InputError if points of the outline were moved apart: then borders are those of the moved outline.
        """
        self._require_borders()
        if self.immersion.arrangement.n_crossings == 0:
            return np.zeros(1, dtype=np.int64)
        # At a crossing the winding number on the left changes, so there and only there does the sheet change.
        sheet = self.sheet[self._boundary_faces]
        return np.flatnonzero(sheet != np.roll(sheet, 1))

    def border(self, number: int) -> Ints:
        """Return the vertices of a border, from end to end; without crossings, all of the boundary and the first again.

        Examples
        --------
        >>> unwrap([(0, 0), (2, 0), (0, 2)], triangles=1).border(0).tolist()
        [0, 1, 2, 0]
        """
        start = int(self.border_start[number])
        end = int(self.border_start[(number + 1) % len(self.border_start)])
        length = (end - start - 1) % len(self.boundary) + 2
        return np.asarray(self.boundary[(start + np.arange(length)) % len(self.boundary)])

    def border_corners(self, number: int) -> tuple[tuple[int, int], tuple[int, int]]:
        """Return the triangles along a border's first and last piece, with their corners where it starts and ends."""
        start = int(self.border_start[number])
        last = int(self.border_start[(number + 1) % len(self.border_start)]) - 1
        ends = []
        for place, vertex in ((start, self.boundary[start]), (last, self.boundary[last + 1])):
            face = int(self._boundary_faces[place])
            ends.append((face, self.faces[face].tolist().index(vertex)))
        return ends[0], ends[1]

    @cached_property
    def seams(self) -> Ints:
        """Edges where a sheet is glued to the next one, (e, 2): what the borders inside the disk are made of."""
        beyond = neighbours_of(self.faces)
        face, side = np.nonzero((beyond >= 0) & (self.sheet[beyond] > self.sheet[:, None]))
        return np.stack([self.faces[face, side], self.faces[face, (side + 1) % 3]], axis=1)

    @cached_property
    def arcs(self) -> tuple[Arc, ...]:
        """The arcs of the disk layout (§2.2 of [MGR11]_), each inside its sheet; they meet at ends only."""
        self._require_borders()
        return arcs_of(self)

    def _require_borders(self) -> None:
        if is_moved(self.immersion.arrangement):
            raise InputError("the borders of an outline that touches itself are not all there on its given points")

    @cached_property
    def _boundary_faces(self) -> Ints:
        """The triangle at each piece of the boundary."""
        face, side = np.nonzero(neighbours_of(self.faces) < 0)
        found = np.empty(len(self.boundary), dtype=np.int64)
        found[self.faces[face, side]] = face
        return found

    def places(self, points: npt.ArrayLike) -> Places:
        """Find the triangles that points of the unit disk lie in, shape (p, 2).

        Raises
        ------
        InputError
            If a point is outside the disk. Points between the circle and the sides of its polygon count as on these.
        """
        wanted = as_points(points)
        outside = np.flatnonzero(np.hypot(*wanted.T) > 1 + _ROUNDING)
        if len(outside):
            raise InputError(
                f"{len(outside)} of {len(wanted)} points are outside the unit disk",
                where=wanted[outside],
                hint="the disk has radius 1 and its middle at (0, 0)",
            )
        return locate(wanted, self.disk, self.faces)

    def to_plane(self, points: npt.ArrayLike) -> Floats:
        """Map points of the unit disk, shape (p, 2), to the drawing; linear in each triangle.

        Points between the circle and the sides of its polygon go where the nearest points on these go.
        """
        return self.places(points).of(self.plane, self.faces)

    def to_space(self, points: npt.ArrayLike) -> Floats:
        """Map points of the unit disk, shape (p, 2), to the lifted surface, shape (p, 3); as :meth:`to_plane`.

        Raises InputError if the disk has not been lifted.
        """
        if self.space is None:
            raise InputError("this disk has not been lifted", hint="lift(immersion).unwrap() gives one with heights")
        return self.places(points).of(self.space, self.faces)

    def to_sheet(self, points: npt.ArrayLike) -> Ints:
        """Return the sheet that each point of the unit disk lies in, shape (p,)."""
        return np.asarray(self.sheet[self.places(points).face])

    def from_plane(self, points: npt.ArrayLike, sheet: int, *, missing: Missing = "error") -> Floats:
        """Map points of the drawing that lie below one sheet to the unit disk, shape (p, 2).

        Parameters
        ----------
        points : (p, 2) array_like
            A point that is beyond the rim of the sheet by rounding errors alone counts as on it.
        sheet : int
        missing : {"error", "nan"}
            What is said of points that are not below the sheet.

        Returns
        -------
        (p, 2) float

        Raises
        ------
        InputError
            If points are not below the sheet, with the places of all of them; or there is no such sheet.
        """
        wanted = as_points(points)
        places, found = places_in_sheet(self, wanted, sheet, missing)
        there = np.full(wanted.shape, np.nan)
        there[found] = places.of(self.disk, self.faces)
        return there

    def export(self, path: str | os.PathLike[str], force: bool = False) -> None:
        """Write the disk flat on the table to a file, with its places in the round disk as texture coordinates.

        Parameters
        ----------
        path : path
            The ending chooses the format: ``.obj`` and ``.ply`` have vertices, triangles and texture coordinates in
            double precision; ``.glb`` has the round disk as a morph target, too, and an animation that unwinds it.
            Sheets have names and colours, in an ``.mtl`` file beside an OBJ.
        force : bool, optional
            Replace existing files.

        Raises
        ------
        InputError
            If the ending is none of these.
        FileExistsError
            If a file exists and ``force`` is not set.
        """
        if Path(path).suffix.lower() not in DISK_ENDINGS:
            raise InputError(
                f"{Path(path).name}: a disk with texture coordinates cannot be written so",
                hint=f"use one of {' '.join(DISK_ENDINGS)}",
            )
        save_model(lambda: model_of_disk(self), path, force)

    def check(self) -> None:
        """Prove with the independent checkers of :mod:`plyfold.certify` that the map is one-to-one.

        The drawing and the disk are one mesh, which is a disk. Every triangle is positive in both, and the boundary is
        the curve in one, and runs once along the unit circle in the other.

        Raises
        ------
        CertificateError
            Naming the condition and the place.
        """
        drawn = given_outline(self.immersion.arrangement)
        points, cusps = drawn.points, drawn.cusps[0]
        if is_moved(self.immersion.arrangement):
            points, cusps = loop_left(self.immersion.arrangement, self.plane, self.faces, self.boundary)
        check_immersed_disk(points, self.plane, self.faces, self.boundary, cusps)
        circle = self.disk[self.boundary]
        check_immersed_disk(circle, self.disk, self.faces, self.boundary)
        if not runs_once_round(circle):
            raise CertificateError("the boundary of the disk does not run once along the unit circle")


def model_of_disk(unwound: UnwoundDisk) -> Model:
    """Return the model of an immersed disk flat on the table, a material for each sheet; its shapes lead to the disk.

    Examples
    --------
    >>> list(model_of_disk(unwrap([(0, 0), (1, 0), (0, 1)], max_area=1.0)).shapes)
    ['unwinding 1', 'unwinding 2', 'unwinding 3', 'disk']
    """
    flat, *others = shapes_of_disk(unwound).items()
    return Model(
        vertices=flat[1],
        faces=unwound.faces,
        material=unwound.sheet,
        materials=tuple(Material(f"sheet_{i}", sheet_colour(i)) for i in range(unwound.immersion.n_sheets)),
        smooth=np.zeros(len(unwound.faces), dtype=np.int64),
        closed=False,
        detail=DETAIL * size_of(unwound.plane),
        uv=unwound.uv,
        shapes=dict(others),
    )


@runtime_checkable
class Lifted(Protocol):
    """A surface that can be spread out, such as :class:`~plyfold.Surface`."""

    def unwrap(self) -> UnwoundDisk:
        """Spread the cloth out as a round disk."""


def unwrap(
    surface: Lifted | Immersion | CurveLike, *, triangles: int = DEFAULT_TRIANGLES, max_area: float | None = None
) -> UnwoundDisk:
    """Spread an immersed disk out as a round one: the sheets side by side, as the cloth was before it was folded.

    Parameters
    ----------
    surface : Surface, Immersion, or a curve (as everywhere)
        Of a curve the first immersion is taken. It need not be liftable.
    triangles : int, optional
        Roughly how many triangles to make. A surface has its own.
    max_area : float, optional
        The largest area of a triangle in the drawing, in place of their number.

    Returns
    -------
    UnwoundDisk
        One-to-one, exactly: no triangle is flipped.

    Raises
    ------
    NotImmersibleError
        If the curve bounds no immersed disk.
    InputError
        If the outline touches itself so that what is left of the disk is in pieces.
    PrecisionError
        If double precision cannot hold the disk; it names the place.

    Notes
    -----
    Pieces of the curve shorter than 1e-7 of it count as that long. A sparse factorisation: half a second for 100,000
    triangles.

    References
    ----------
    .. [WZ14] O. Weber, D. Zorin, "Locally injective parametrization with arbitrary fixed boundaries", ACM
       Transactions on Graphics 33, 2014.

    Examples
    --------
    >>> unwound = unwrap([(0, 0), (2, 0), (0, 2)], triangles=1)
    >>> unwound.boundary.tolist(), unwound.sheet.tolist()
    ([0, 1, 2], [0])
    """
    if isinstance(surface, Lifted):
        return surface.unwrap()
    immersion = surface if isinstance(surface, Immersion) else chosen_immersion(surface, None)
    return _unwound_immersion(immersion, triangles, max_area)


def unwound_mesh(immersion: Immersion, space: Floats, faces: Ints, sheet: Ints, boundary: Ints) -> UnwoundDisk:
    """Spread out the triangles of a surface in space over an immersion."""
    plane = space[:, :2]
    return UnwoundDisk(immersion, round_map(plane, faces, boundary), plane, space, faces, sheet, boundary)


def map_disk(
    curve: CurveLike,
    immersion: Immersion | None = None,
    *,
    triangles: int = DEFAULT_TRIANGLES,
    max_area: float | None = None,
) -> tuple[Floats, Ints, Floats]:
    """Parametrise the disk that a curve bounds: a one-to-one map with a fixed boundary that may overlap itself [WZ14]_.

    Parameters
    ----------
    curve : Curve, (n, 2) array_like, shapely geometry or Arrangement
    immersion : Immersion, optional
        The disk meant, if the curve bounds several; by default the first one.
    triangles : int, optional
        Roughly how many triangles to make.
    max_area : float, optional
        Largest area of a triangle in the drawing, instead of ``triangles``.

    Returns
    -------
    vertices : (n, 2) float
        Positions in the drawing. The first ones are the boundary, in order from the curve's first point.
    faces : (m, 3) int
        Counter-clockwise triangles, a disk.
    uv : (n, 2) float
        The same vertices in the disk around (½, ½) in the unit square. Every triangle is counter-clockwise there, too;
        so each point of the disk has one place in the drawing, linear in each triangle and locally one-to-one.

    Raises
    ------
    NotImmersibleError
        If the curve bounds no immersed disk.
    InputError
        If a size is not positive or makes too many triangles, or the immersion is one of another curve; or if the disk
        is in pieces, as the outline touches itself.

    References
    ----------
    .. [WZ14] O. Weber, D. Zorin, "Locally injective parametrization with arbitrary fixed boundaries", ACM
       Transactions on Graphics 33, 2014.

    Examples
    --------
    >>> vertices, faces, uv = map_disk([(0, 0), (4, 0), (4, 4), (0, 4)], triangles=50)
    >>> vertices[0].tolist(), uv[0].tolist()
    ([0.0, 0.0], [1.0, 0.5])
    """
    unwound = _unwound_immersion(chosen_immersion(curve, immersion), triangles, max_area)
    return unwound.plane, unwound.faces, unwound.uv


def require_one_piece(places: Floats, first_boundary: Ints) -> None:
    """Refuse a disk that is in pieces on the given points, as it touches itself, by an InputError."""
    if (pieces := len(first_boundary) - 1) > 1:
        raise InputError(
            f"the outline touches itself, and what is left of the disk is in {pieces} pieces",
            where=places[first_boundary[:-1]],
            hint="give the outline of one of them",
        )


def _unwound_immersion(immersion: Immersion, triangles: int, max_area: float | None) -> UnwoundDisk:
    require_disk(immersion)
    if immersion.arrangement.curve is None:
        raise PlyfoldError("a disk needs a drawing, and this is a Gauss code alone")
    refuse_sizes(immersion.arrangement.curve.points, triangles, max_area)
    cells = triangulate_cells(immersion.arrangement, max_area, triangles)
    glued = glue_copies(immersion, cells)
    require_one_piece(cells.points[glued.planar_vertex], glued.first_boundary)
    plane = cells.points[glued.planar_vertex]
    disk = round_map(plane, glued.faces, glued.boundary)
    return UnwoundDisk(immersion, disk, plane, None, glued.faces, glued.sheet, glued.boundary)
