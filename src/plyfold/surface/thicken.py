"""A solid from a surface: what lies round it in some thickness, watertight, to be printed."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats, Ints, freeze
from plyfold.certify import check_solid
from plyfold.errors import InputError, PrecisionError, WallError
from plyfold.halfedges import ends_of
from plyfold.io.mesh.saving import refuse_ending, save_model
from plyfold.io.saving import Target, save_bytes
from plyfold.options import refuse_unless_number
from plyfold.ragged import next_in_rows
from plyfold.surface.files import Colouring, model_of_solid, smooth_parts, trimesh_of
from plyfold.surface.left import kinds_of, may_touch
from plyfold.surface.walls import Wall, thinner_places, thinnest_wall

if TYPE_CHECKING:
    import trimesh

    from plyfold.surface.lift import Surface

__all__ = ["Solid", "solid_round", "thicken"]


# Rounds of making a solid thicker where its walls are too thin, and by how much more than they seem to need.
_ROUNDS = 20
_A_LITTLE_MORE = 1.01
_STEEP = "it is steep there: ask for less, or lift it with a smaller gap or with softer cloth"


@dataclass(frozen=True, eq=False)
class Solid:
    """The points at most half the thickness above or below a surface, bounded by triangles: of a disk, a ball.

    Parameters
    ----------
    surface : Surface
        In the middle of the solid.
    thickness : (n,) float
        At each vertex of the surface, measured vertically, in units of the drawing; straight between them. It is 0
        at *tips*: at cusps, where all steps of a stair meet, and along the outline of a round body.
    vertices : (2n - t, 3) float
        The upper side, vertex by vertex as in the surface, then the lower side without the t tips: there the two sides
        have a vertex in common.
    faces : (2m + w, 3) int
        Counter-clockwise seen from the outside: the upper side, the lower side, and two triangles of the vertical wall
        for each edge of the boundary; one where that ends in a tip, and none between tips.
    sheet : (2m + w,) int
        The sheet that each triangle belongs to.

    Examples
    --------
    >>> from plyfold import lift
    >>> tile = lift([(0, 0), (4, 0), (0, 3)], max_area=10.0).thicken(0.5)
    >>> tile.vertices[:, 2].tolist(), len(tile.faces)
    ([0.25, 0.25, 0.25, -0.25, -0.25, -0.25], 8)
    >>> tile.check()
    """

    surface: Surface
    thickness: Floats
    vertices: Floats
    faces: Ints
    sheet: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        return f"<Solid: {len(self.faces)} triangles, {self.height:g} thick>"

    def _repr_png_(self) -> bytes:
        from plyfold.draw.notebook import solid_png

        return solid_png(self)

    @property
    def height(self) -> float:
        """The largest thickness."""
        return float(self.thickness.max())

    @property
    def tips(self) -> Ints:
        """The vertices at which the upper and the lower side meet."""
        return np.flatnonzero(self.thickness == 0)

    @cached_property
    def below(self) -> Ints:
        """The vertex of the lower side under each one of the upper side; at a tip that one itself. Shape (n,)."""
        return _below(len(self.thickness), self.tips)

    @property
    def smooth(self) -> Ints:
        """Numbers of the triangles, (f,): those with the same one are parts of one smooth face."""
        return smooth_parts(self)

    @property
    def volume(self) -> float:
        """What it holds: the thickness over the area, seen from above, of all sheets."""
        a, b, c = self.surface.vertices[self.surface.faces, :2].swapaxes(0, 1)
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        return float((ux * vy - uy * vx) @ self.thickness[self.surface.faces].mean(axis=1)) / 2

    @cached_property
    def wall(self) -> Wall | None:
        """How thin it really is, and where: the shortest straight way through it from its upper to its lower side.

        The thickness is vertical: where the solid is steep, it is thinner across. The wall is the least distance of a
        point of the upper side from one of the lower side, of which each sees the other: the straight line between
        them, seen from above, stays on the cloth. So neither the air between two sheets nor a slit is a wall. (Of two
        triangles the nearest corners, points beside corners and points of two sides are tried.) Left out are triangles
        with corners that are less than half as far from a tip, along the edges seen from above, as the solid is thick
        there: a round body comes to nothing at its rim. None if all are, as in a body that is higher than wide.
        """
        return thinnest_wall(self)

    def overhang(self, angle: float = 45.0) -> float:
        """Return which share of its area faces down and leans more than an angle.

        Parameters
        ----------
        angle : float
            In degrees: 0 for all that faces down at all, and nearly 90 for nothing but level ceilings. Printers need
            supports under what leans more than 45, as a rule.

        Returns
        -------
        float
            From 0 to 1; of a level slab a little less than a half.
        """
        refuse_unless_number("angle", angle)
        if not 0 <= angle < 90:
            raise InputError(f"the angle must be from 0 to less than 90 degrees, not {angle!r}")
        a, b, c = (self.vertices / np.abs(self.vertices).max())[self.faces].swapaxes(0, 1)
        across = np.cross(b - a, c - a)
        area = np.linalg.norm(across, axis=1)
        return float(area[-across[:, 2] > np.sin(np.radians(angle)) * area].sum() / area.sum())

    def check(self) -> None:
        """Prove with the independent checker :func:`plyfold.certify.check_solid` that it is a solid.

        It is closed and has its outside outside, it is as thick everywhere as it should be, to the last rounding, it
        has as many pieces, holes and handles as the surface, and it nowhere meets itself.

        Raises
        ------
        CertificateError
            Naming the condition and the place.
        """
        pieces = [euler for _, euler in kinds_of(self.surface)]
        # Upper vertices come first; what is said of the others is not read.
        thickness = np.append(self.thickness, np.zeros(len(self.vertices) - len(self.thickness)))
        touching = may_touch(self.surface)
        check_solid(self.vertices, self.faces, thickness, pieces=pieces, tips=self.tips, touching=touching)

    def export(  # noqa: PLR0913 - options of formats
        self,
        path: Target,
        force: bool = False,
        title: str | None = None,
        *,
        colours: Colouring = "layers",
        unwrapped: bool | None = None,
        ending: str | None = None,
    ) -> None:
        """Write the solid to a file; see :meth:`Surface.export`. There is no film of a solid.

        Parameters
        ----------
        path : path or binary file
            The ending chooses the format: ``.stl``, ``.3mf``, ``.glb``, ``.obj``, ``.ply``, or ``.html`` for a 3D page.
        force : bool
            Replace an existing file.
        title : str, optional
            Heading of the page; the file's name by default.
        colours : {"layers", "sheets"}
            A colour for each layer, in smooth transition, or a material for each sheet.
        unwrapped : bool, optional
            With texture coordinates and other shapes, where the format has them.
        ending : str, optional
            Chooses the format, as an open file has no ending of its own.
        """
        if refuse_ending(path, (".html",), ending) == ".html":
            from plyfold.draw.viewer import page

            name = Path(path).stem if isinstance(path, str | os.PathLike) else "plyfold"
            save_bytes(path, page(self, title=title or name).encode(), force)
        else:
            save_model(lambda: model_of_solid(self, colours, unwrapped), path, force, ending)

    def to_trimesh(self, colours: Colouring = "layers") -> trimesh.Trimesh:
        """Return the solid as a mesh of trimesh_; see :meth:`Surface.to_trimesh`.

        .. _trimesh: https://trimesh.org
        """
        return trimesh_of(model_of_solid(self, colours, unwrapped=False))


def thicken(surface: Surface, thickness: float, min_wall: float | None = None) -> Solid:
    """Give a surface a thickness.

    Parameters
    ----------
    surface : Surface
        That does not pass through itself.
    thickness : float
        Measured vertically, in units of the drawing; less than the surface's gap where sheets overlap. On a slope, the
        solid is thinner across.
    min_wall : float, optional
        Make the solid thicker where its wall, see :attr:`Solid.wall`, would be less.

    Returns
    -------
    Solid
        The surface moved up and down by half the thickness, and vertical walls along its boundary. Cost: O(n log n).
        Round a cusp the surface is a spiral stair as steep as one likes: it becomes thinner in the triangles there.

    Raises
    ------
    InputError
        If the thickness is not positive or not less than the gap, or the surface passes through itself.
    WallError
        If sheets over each other leave no room for such walls; it names the places.
    PrecisionError
        If the thickness, or what is left of the gap, is lost in rounding; it names the place.

    Notes
    -----
    Over every point of the drawing, the heights of different sheets differ by the gap at least, so the intervals of
    half the thickness round them are disjoint: the solid does not meet itself.
    """
    _refuse_thickness(surface, thickness)
    everywhere = np.full(len(surface.vertices), float(thickness))
    everywhere[surface.cusps] = 0.0
    return solid_round(surface, everywhere) if min_wall is None else _with_walls(surface, everywhere, min_wall)


def _with_walls(surface: Surface, thickness: Floats, wall: float) -> Solid:
    """Return a solid that is made thicker where its wall would be less than asked for, as far as there is room."""
    refuse_unless_number("min_wall", wall)
    if not 0 < wall < np.inf:
        raise InputError(f"the least wall must be a positive number, not {wall!r}")
    thickness = np.where(thickness > 0, np.maximum(thickness, wall), 0.0)
    for _ in range(_ROUNDS):
        _require_room(surface, thickness, wall)
        solid = solid_round(surface, thickness)
        triangles, lengths = thinner_places(solid, wall)
        if not len(triangles):
            return solid
        factor = np.ones(len(thickness))
        np.maximum.at(factor, surface.faces[triangles], (wall / lengths)[:, None] * _A_LITTLE_MORE)
        thickness = thickness * factor
    raise WallError(
        f"walls of {wall:g} are not reached", where=surface.vertices[surface.faces[triangles[:1], 0], :2], hint=_STEEP
    )


def _require_room(surface: Surface, thickness: Floats, wall: float) -> None:
    """Raise WallError where a body would meet the one above it."""
    lower, upper = _over_each_other(surface.vertices, surface.faces)
    room = surface.vertices[upper, 2] - surface.vertices[lower, 2]
    short = np.flatnonzero((thickness[lower] + thickness[upper]) / 2 >= room)
    if len(short):
        where = np.unique(surface.vertices[lower[short], :2], axis=0)
        raise WallError(f"sheets leave no room for walls of {wall:g}", where=where, hint=_STEEP)


def solid_round(surface: Surface, thickness: Floats) -> Solid:
    """Return the solid of some thickness at each vertex of a surface, which leaves room for it.

    Raises PrecisionError where the thickness, or what is between two bodies, is lost in rounding.
    """
    n, b, tips = len(surface.vertices), len(surface.boundary), np.flatnonzero(thickness == 0)
    up = np.zeros((n, 3))
    up[:, 2] = thickness / 2
    below = _below(n, tips)
    vertices = np.concatenate([surface.vertices + up, np.delete(surface.vertices - up, tips, axis=0)])
    _require_strict_order(vertices, surface.faces, below)
    upper, following = surface.boundary, surface.boundary[next_in_rows(surface.first_boundary)]
    lower, lower_following = below[upper], below[following]
    walls = np.stack([lower, lower_following, following, lower, following, upper], axis=1).reshape(2 * b, 3)
    faces = np.concatenate([surface.faces, below[surface.faces[:, ::-1]], walls])
    sheet = np.concatenate([surface.sheet, surface.sheet, np.repeat(_sheets_along(surface), 2)])
    real = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return Solid(surface, thickness, vertices, faces[real], sheet[real])


def _below(count: int, tips: Ints) -> Ints:
    """Return the numbers of the vertices of the lower side, which follow the upper ones and lack the tips."""
    below = count + np.arange(count) - np.searchsorted(tips, np.arange(count))
    below[tips] = tips
    return below


def _refuse_thickness(surface: Surface, thickness: float) -> None:
    refuse_unless_number("thickness", thickness)
    if not 0 < thickness < np.inf:
        raise InputError(f"the thickness must be a positive number, not {thickness!r}")
    if len(surface.passing):
        raise InputError("a surface that passes through itself bounds no solid", where=surface.intersections[0][:1])
    if surface.n_layers > 1 and thickness >= surface.gap:
        raise InputError(
            f"sheets that lie over each other are {surface.gap:g} apart, and cannot be {thickness:g} thick",
            hint="make the thickness smaller, or lift the curve with a larger gap",
        )


def _require_strict_order(vertices: Floats, faces: Ints, below: Ints) -> None:
    """Check that rounding has left both sides of each sheet apart, but for the tips, and neighbouring sheets."""
    n = len(below)
    lower, upper = _over_each_other(vertices, faces)
    low, high = np.concatenate([below, lower]), np.concatenate([np.arange(n), below[upper]])
    apart = low != high
    if len(bad := np.flatnonzero(apart & ~(vertices[high, 2] > vertices[low, 2]))):
        raise PrecisionError(
            "the solid is thinner than rounding errors, or what is between its sheets is",
            where=vertices[low[bad[:1]], :2],
            hint="choose a thickness between nothing and the gap",
        )


def _over_each_other(vertices: Floats, faces: Ints) -> tuple[Ints, Ints]:
    """Return the lower and the upper vertices where triangles lie next over each other; those in common left out."""
    x, y, z = vertices[faces].transpose(2, 0, 1)
    # Copies of one triangle have their corners in the same order.
    order = np.lexsort((*z.T, *x.T, *y.T))
    lower, upper = faces[order[:-1]], faces[order[1:]]
    over = (vertices[lower, :2] == vertices[upper, :2]).all(axis=(1, 2))
    lower, upper = lower[over].ravel(), upper[over].ravel()
    return lower[lower != upper], upper[lower != upper]


def _sheets_along(surface: Surface) -> Ints:
    """Return the sheet of the triangle at each edge of the boundary; edge i starts at the i-th boundary vertex."""
    start, end = ends_of(surface.faces)
    following, b = next_in_rows(surface.first_boundary), len(surface.boundary)
    side = np.flatnonzero((start < b) & (end == following[np.minimum(start, b - 1)]))
    sheet = np.empty(b, dtype=np.int64)
    sheet[start[side]] = surface.sheet[side // 3]
    return sheet
