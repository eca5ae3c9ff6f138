"""A solid from a surface: cloth of some thickness, watertight, to be printed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plyfold.arrays import Floats, Ints, freeze
from plyfold.certify import check_solid
from plyfold.errors import InputError, PrecisionError
from plyfold.halfedges import ends_of
from plyfold.io.mesh.saving import save_model
from plyfold.io.saving import Target
from plyfold.options import refuse_unless_number
from plyfold.ragged import next_in_rows
from plyfold.surface.files import Colouring, model_of_solid, trimesh_of
from plyfold.surface.left import kinds_of, may_touch

if TYPE_CHECKING:
    import trimesh

    from plyfold.surface.lift import Surface

__all__ = ["Solid", "thicken"]


@dataclass(frozen=True, eq=False)
class Solid:
    """The points at most half the thickness above or below a surface, bounded by triangles: of a disk, a ball.

    Parameters
    ----------
    surface : Surface
        In the middle of the solid.
    thickness : float
        Measured vertically, in units of the drawing.
    vertices : (2n, 3) float
        The upper side, vertex by vertex as in the surface, then the lower side. At a cusp, where all steps of a stair
        meet, the solid ends in a tip, and the lower side has no vertex of its own.
    faces : (2m + 2b, 3) int
        Counter-clockwise seen from the outside: the upper side, the lower side, and two triangles of the vertical wall
        for each edge of the boundary; one where that ends in a tip.
    sheet : (2m + 2b,) int
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
    thickness: float
    vertices: Floats
    faces: Ints
    sheet: Ints

    def __post_init__(self) -> None:
        freeze(self)

    def __repr__(self) -> str:
        return f"<Solid: {len(self.faces)} triangles, {self.thickness:g} thick>"

    def _repr_png_(self) -> bytes:
        from plyfold.draw.notebook import solid_png

        return solid_png(self)

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
        tips, touching = self.surface.cusps, may_touch(self.surface)
        check_solid(self.vertices, self.faces, self.thickness, pieces=pieces, tips=tips, touching=touching)

    def export(
        self,
        path: Target,
        force: bool = False,
        colours: Colouring = "layers",
        unwrapped: bool | None = None,
        ending: str | None = None,
    ) -> None:
        """Write the solid to a file; see :meth:`Surface.export`. There is no page of a solid.

        Parameters
        ----------
        path : path or binary file
            The ending chooses the format: ``.stl``, ``.3mf``, ``.glb``, ``.obj`` or ``.ply``.
        force : bool
            Replace an existing file.
        colours : {"layers", "sheets"}
            A colour for each layer, in smooth transition, or a material for each sheet.
        unwrapped : bool, optional
            With texture coordinates and other shapes, where the format has them.
        ending : str, optional
            Chooses the format, as an open file has no ending of its own.
        """
        save_model(lambda: model_of_solid(self, colours, unwrapped), path, force, ending)

    def to_trimesh(self, colours: Colouring = "layers") -> trimesh.Trimesh:
        """Return the solid as a mesh of trimesh_; see :meth:`Surface.to_trimesh`.

        .. _trimesh: https://trimesh.org
        """
        return trimesh_of(model_of_solid(self, colours, unwrapped=False))


def thicken(surface: Surface, thickness: float) -> Solid:
    """Give a surface a thickness.

    Parameters
    ----------
    surface : Surface
        That does not pass through itself.
    thickness : float
        Measured vertically, in units of the drawing; less than the surface's gap where sheets overlap. On a slope, the
        solid is thinner across.

    Returns
    -------
    Solid
        The surface moved up and down by half the thickness, and vertical walls along its boundary. Cost: O(n log n).
        Round a cusp the surface is a spiral stair as steep as one likes: it becomes thinner in the triangles there.

    Raises
    ------
    InputError
        If the thickness is not positive or not less than the gap, or the surface passes through itself.
    PrecisionError
        If the thickness, or what is left of the gap, is lost in rounding; it names the place.

    Notes
    -----
    Over every point of the drawing, the heights of different sheets differ by the gap at least, so the intervals of
    half the thickness round them are disjoint: the solid does not meet itself.
    """
    _refuse_thickness(surface, thickness)
    n, b = len(surface.vertices), len(surface.boundary)
    up = np.zeros((n, 3))
    up[:, 2] = thickness / 2
    up[surface.cusps] = 0.0
    below = n + np.arange(n) - np.searchsorted(surface.cusps, np.arange(n))
    below[surface.cusps] = surface.cusps
    vertices = np.concatenate([surface.vertices + up, np.delete(surface.vertices - up, surface.cusps, axis=0)])
    _require_strict_order(vertices, surface.faces, below)
    upper, following = surface.boundary, surface.boundary[next_in_rows(surface.first_boundary)]
    lower, lower_following = below[upper], below[following]
    walls = np.stack([lower, lower_following, following, lower, following, upper], axis=1).reshape(2 * b, 3)
    faces = np.concatenate([surface.faces, below[surface.faces[:, ::-1]], walls])
    sheet = np.concatenate([surface.sheet, surface.sheet, np.repeat(_sheets_along(surface), 2)])
    real = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return Solid(surface, float(thickness), vertices, faces[real], sheet[real])


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
    x, y, z = vertices[faces].transpose(2, 0, 1)
    # Copies of one triangle have their corners in the same order.
    order = np.lexsort((*z.T, *x.T, *y.T))
    lower, upper = faces[order[:-1]], faces[order[1:]]
    over = (vertices[lower, :2] == vertices[upper, :2]).all(axis=(1, 2))
    lower, upper = lower[over].ravel(), upper[over].ravel()
    low, high = np.concatenate([below, lower]), np.concatenate([np.arange(n), below[upper]])
    apart = (low != high) & (np.append(np.ones(n, dtype=bool), lower != upper))
    if len(bad := np.flatnonzero(apart & ~(vertices[high, 2] > vertices[low, 2]))):
        raise PrecisionError(
            "the solid is thinner than rounding errors, or what is between its sheets is",
            where=vertices[low[bad[:1]], :2],
            hint="choose a thickness between nothing and the gap",
        )


def _sheets_along(surface: Surface) -> Ints:
    """Return the sheet of the triangle at each edge of the boundary; edge i starts at the i-th boundary vertex."""
    start, end = ends_of(surface.faces)
    following, b = next_in_rows(surface.first_boundary), len(surface.boundary)
    side = np.flatnonzero((start < b) & (end == following[np.minimum(start, b - 1)]))
    sheet = np.empty(b, dtype=np.int64)
    sheet[start[side]] = surface.sheet[side // 3]
    return sheet
