"""Round bodies: surfaces blown up, thick in the middle and thin at the rim, as sketch modellers make them.

How thick a body is follows from the cloth alone, not from its heights. The *torsion function* u of the cloth,

    −Δu = 1, and u = 0 on the outline,

is solved on the glued sheets, so bodies over each other do not know of one another. Across a strip of width 2a it is
(a² − x²) / 2, so a thickness in proportion to √u makes every cross-section of a strip an ellipse, round at the rim, and
wider parts thicker in proportion. Then the cloth is lifted anew, with room for the bodies: over every point of the
drawing the surfaces in their middles are half of both thicknesses and the gap apart.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from plyfold.arrays import Bools, Floats, Ints
from plyfold.clock import UNWATCHED, Watch
from plyfold.errors import InputError, PrecisionError
from plyfold.halfedges import ends_of, twins_of
from plyfold.layering.layering import Layering
from plyfold.matrices import factorised, laplacian
from plyfold.mesh.cells import CellTriangulation, refuse_broken
from plyfold.mesh.sheets import SheetMesh, glue_copies
from plyfold.options import refuse_unless_number
from plyfold.surface.chords import halved
from plyfold.surface.energy import cotangent_laplacian
from plyfold.surface.glue import LiftedMesh, stack_sheets
from plyfold.surface.making import raised, steps_of
from plyfold.surface.stairs import Steps
from plyfold.surface.thicken import Solid, solid_round

if TYPE_CHECKING:
    from plyfold.surface.lift import Surface

__all__ = ["Profile", "inflate"]

Profile: TypeAlias = Literal["round", "flat"] | Callable[[Floats], Floats]

# Two sides never pull less on each other than this, with 1 for a square: so the torsion is above 0 everywhere inside.
_LEAST_PULL = 1e-3
# So much of the way along the edges that lead inward, further points make the rim round.
_NEAR_RIM = 0.25
# As thick as this part of what would be a circle in the cross-section of a strip, where no height is given.
_DEFAULT_ROUNDNESS = 0.5
_HIGHEST = 1000.0


def inflate(surface: Surface, height: float | None, profile: Profile, watch: Watch = UNWATCHED) -> Solid:
    """Return a round body in place of a surface; see :meth:`Surface.inflate`."""
    size = float(np.ptp(surface.vertices[:, :2], axis=0).max())
    layering = _refuse_wrong_kinds(surface, height, profile, size)
    steps = _with_round_rim(layering, without_flat_parts(layering, steps_of(layering, surface.making, watch), watch))
    mesh = stack_sheets(layering, steps.cells, watch)
    watch = watch.begin("blowing up")
    thickness = _thickness(steps.cells.points[mesh.planar_vertex], mesh, height, profile, watch)
    vertices = raised(mesh, steps, surface.gap, surface.making, watch=watch, thickness=thickness)
    middle = replace(
        surface,
        vertices=vertices,
        faces=mesh.faces,
        sheet=mesh.sheet,
        boundary=mesh.boundary,
        first_boundary=mesh.first_boundary,
        cusps=mesh.cusps,
    )
    return solid_round(middle, thickness)


def _refuse_wrong_kinds(surface: Surface, height: float | None, profile: object, size: float) -> Layering:
    """Refuse options of the wrong kind; return the layering of a surface that does not pass through itself."""
    if not isinstance(surface.layering, Layering):
        where = [curve[0] for curve in surface.intersections[:1]]
        raise InputError("a surface that passes through itself bounds no body", where=where)
    if height is not None:
        refuse_unless_number("height", height)
        if not 0 < height <= _HIGHEST * size:
            raise InputError(f"the height must be positive and at most {_HIGHEST * size:g}, not {height!r}")
    if not callable(profile) and profile not in get_args(get_args(Profile)[0]):
        raise InputError(f"there is no profile {profile!r}", hint='use "round", "flat" or a function')
    return surface.layering


# ---- a mesh in which front and back meet in the rim alone ------------------------------------------------------------


def without_flat_parts(layering: Layering, steps: Steps, watch: Watch = UNWATCHED) -> Steps:
    """Return triangles such that on the glued surface only edges of the rim join two vertices of the rim.

    Between other vertices of the rim, front and back of a body would coincide.

    Parameters
    ----------
    layering : Layering
    steps : Steps
    watch : Watch, optional

    Returns
    -------
    Steps
        With points in the middle of some edges; also in the middle of the side of a triangle that is a whole piece.

    Raises
    ------
    PrecisionError
        If double precision has no point there.
    """
    cells = steps.cells
    while len(flat := _flat_edges(glue_copies(layering.immersion, cells), cells.twin)):
        cells = halved(cells, flat)
        watch.step()
    return _with_cells(layering, steps, cells)


def _with_cells(layering: Layering, steps: Steps, cells: CellTriangulation) -> Steps:
    """Return the steps with points added to the cells, none of them on edges at cusps."""
    if cells is steps.cells:
        return steps
    refuse_broken(layering.immersion.arrangement, cells)
    more = np.full(len(cells.points) - len(steps.outer), -1)
    return Steps(cells, np.append(steps.outer, more) if len(steps.outer) else steps.outer)


def _with_round_rim(layering: Layering, steps: Steps) -> Steps:
    """Return triangles with further points on edges that lead from the rim inward, if double precision has any there.

    Near the rim the thickness grows like the root of the distance, so at a quarter of the way it is half.
    """
    with suppress(PrecisionError):
        spokes = _spokes(glue_copies(layering.immersion, steps.cells), steps)
        return _with_cells(layering, steps, halved(steps.cells, spokes, _NEAR_RIM))
    return steps


def _spokes(glued: SheetMesh, steps: Steps) -> Ints:
    """Return half-edges inside cells that lead from the rim inward on some sheet, one for each edge; none of stairs."""
    start, end = ends_of(glued.faces)
    rim, twin = len(glued.boundary), steps.cells.twin
    below = _below(glued, (start < rim) & (end >= rim))
    first, last = (corners[below] for corners in ends_of(steps.cells.triangles))
    stairs = np.append(steps.outer, np.full(len(steps.cells.points) - len(steps.outer), -1)) >= 0
    inside = ~np.isin(below, steps.cells.left) & ~np.isin(twin[below], steps.cells.left)
    below = below[inside & ~stairs[first] & ~stairs[last]]
    return np.setdiff1d(below, twin[below[twin[below] > below]])


def _flat_edges(glued: SheetMesh, twin_below: Ints) -> Ints:
    """Return the edges of the plane, each by one half-edge, that must have a point in their middle."""
    start, end = ends_of(glued.faces)
    twin, rim = twins_of(glued.faces), len(glued.boundary)
    flat = (start < rim) & (end < rim) & (twin >= 0)
    flat[0::3] |= (twin.reshape(-1, 3) < 0).all(axis=1)
    below = _below(glued, flat)
    return np.unique(np.where(twin_below[below] >= 0, np.minimum(below, twin_below[below]), below))


def _below(glued: SheetMesh, chosen: Bools) -> Ints:
    """Return the half-edges of the plane under some of the surface, each once."""
    copy, side = np.divmod(np.flatnonzero(chosen), 3)
    return np.unique(3 * (np.searchsorted(glued.first_copy, copy, side="right") - 1) + side)


# ---- how thick -------------------------------------------------------------------------------------------------------


def _thickness(places: Floats, mesh: LiftedMesh, height: float | None, profile: Profile, watch: Watch) -> Floats:
    """Return the thickness at each vertex, exactly 0 along the rim."""
    size = float(np.ptp(places, axis=0).max())
    corners = (places - places[0]) / size
    torsion = _torsion(mesh, corners, watch)
    highest = 2 * _DEFAULT_ROUNDNESS * size * np.sqrt(2 * torsion.max()) if height is None else float(height)
    rim, shares = len(mesh.boundary), np.zeros(len(torsion))
    if profile == "flat":
        shares[rim:] = _plateau(_depth(mesh, torsion, corners)[rim:], highest / size)
    else:
        bulge = np.sqrt(torsion / torsion.max())[rim:]
        shares[rim:] = bulge if profile == "round" else _asked(profile, bulge, places[rim:])
    return highest * shares


def _torsion(mesh: LiftedMesh, corners: Floats, watch: Watch) -> Floats:
    """Return the torsion function at each vertex: above 0 but for the rim, where it is 0.

    In slivers the cotangent matrix may have it below 0. So it is at least that of the matrix whose negative weights of
    edges, as flat triangles have them, are replaced by a small one: an M-matrix, whose inverse has no negative numbers.
    """
    rim = len(mesh.boundary)
    matrix, area = cotangent_laplacian(corners, mesh.faces, np.ones(len(mesh.faces)))
    entries = matrix.tocoo()
    upper = entries.row < entries.col
    pull = np.maximum(-entries.data[upper], _LEAST_PULL)
    stiffer = laplacian(entries.row[upper], entries.col[upper], pull)
    torsion = np.zeros((2, len(area)))
    for row, each in zip(torsion, (matrix, stiffer), strict=True):
        inner = each[rim:, rim:]
        row[rim:] = watch.wait_for(partial(factorised(inner, watch).solve, area[rim:]), len(area))
    return np.asarray(torsion.max(axis=0))


def _plateau(depth: Floats, height: float) -> Floats:
    """Return the shares of a plateau whose rim is round: a half circle, as far as there is room for one."""
    inward = np.minimum(depth / min(height / 2, depth.max()), 1.0)
    return np.asarray(np.sqrt(inward * (2 - inward)))


def _depth(mesh: LiftedMesh, torsion: Floats, corners: Floats) -> Floats:
    """Return about how far each vertex is from the rim, from the torsion and its slope (Spalding); exact on strips."""
    slope = np.hypot(*_gradient(torsion, mesh.faces, corners))
    return np.asarray(2 * torsion / (np.sqrt(slope**2 + 2 * torsion) + slope))


def _asked(profile: Profile, bulge: Floats, places: Floats) -> Floats:
    """Return the shares that a function gives, which must be more than 0 and at most 1."""
    assert callable(profile)
    shares = np.asarray(profile(bulge.copy()), dtype=np.float64)
    if shares.shape != bulge.shape:
        raise InputError(f"the profile must give {len(bulge)} numbers for as many, not an array of {shares.shape}")
    if len(wrong := np.flatnonzero(~((shares > 0) & (shares <= 1)))):
        raise InputError(
            f"the profile must be more than 0 and at most 1 inside of the outline, not {shares[wrong[0]]:g}",
            where=places[wrong[:1]],
        )
    return shares


def _gradient(values: Floats, faces: Ints, corners: Floats) -> Floats:
    """Return the gradient at each vertex, (2, v): the mean of those in the triangles around it, by area."""
    across = np.roll(corners[faces], -1, axis=1) - np.roll(corners[faces], 1, axis=1)
    double_area = np.abs(across[:, 0, 0] * across[:, 1, 1] - across[:, 0, 1] * across[:, 1, 0])
    # Side i, turned by a quarter, times the value at the opposite corner: the gradient times twice the area.
    x, y = (np.einsum("ti,ti->t", side, values[faces]) for side in (across[..., 1], -across[..., 0]))
    total, x, y = (np.bincount(faces.ravel(), np.repeat(part, 3), len(values)) for part in (double_area, x, y))
    return np.stack([x, y]) / np.maximum(total, np.finfo(float).tiny)
